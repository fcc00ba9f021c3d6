# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sheets of a member in a document: a SheetSet and, for each page, what TechDraw shows.

Pages pull their content from the SheetSet, so edits reach them by plain recompute. SheetSet.execute
only keeps the number of pages: it creates missing ones at once; surplus ones are removed by a
document observer when the recompute is over, because FreeCAD 0.20 forgets to clear its list of
objects removed during a recompute, removes them again after an undo, and crashes.
"""

from __future__ import annotations

import math
from functools import lru_cache

import FreeCAD
import Part

from BendTorsionWB.core.detailing import with_beds
from BendTorsionWB.core.drawings.sheet import Sheet
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_style import (
    FORMATS,
    LANGUAGES,
    LENGTH_UNITS,
    PLAIN_STYLE,
    STANDARDS,
    SheetStyle,
)
from BendTorsionWB.core.finding import BendTorsionError, error, has_error
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.core.site import UNITS, SiteDatum
from BendTorsionWB.objects.assembly_bed import value as beds_of_object
from BendTorsionWB.objects.proxy import Property, Proxy, findings_of, linked
from BendTorsionWB.sheets.techdraw import (
    configure_outline_view,
    configure_symbol,
    sheet_scale,
    symbol_svg,
    template_path,
    view_edges,
)


def sheets_of(sheet_set) -> tuple[Sheet, ...]:
    """The sheets of a SheetSet object; one that names the fault when there is nothing to draw."""
    return _laid_out(_record_of(sheet_set), style_of(sheet_set), sheet_set.PlatePages)


def style_of(sheet_set) -> SheetStyle:
    """How a SheetSet's sheets are drawn."""
    return SheetStyle(
        sheet_set.Project,
        sheet_set.Author,
        sheet_set.SheetFormat,
        sheet_set.SheetStandard,
        sheet_set.SheetLanguage,
        sheet_set.SheetUnit,
        SiteDatum(
            sheet_set.SiteX.Value,
            sheet_set.SiteY.Value,
            sheet_set.SiteZ.Value,
            math.radians(sheet_set.SiteRotation.Value),
            sheet_set.SiteUnit,
        ),
    )


def set_style(sheet_set, style: SheetStyle) -> None:
    """Have a SheetSet's sheets drawn so."""
    sheet_set.Project, sheet_set.Author = style.project, style.author
    sheet_set.SheetFormat, sheet_set.SheetStandard = style.format, style.standard
    sheet_set.SheetLanguage, sheet_set.SheetUnit = style.language, style.unit
    site = style.site
    sheet_set.SiteX, sheet_set.SiteY, sheet_set.SiteZ = site.x, site.y, site.z
    sheet_set.SiteRotation, sheet_set.SiteUnit = math.degrees(site.rotation), site.unit


@lru_cache(maxsize=64)
def _laid_out(record: MemberRecord, style: SheetStyle, plates: bool) -> tuple[Sheet, ...]:
    # Every page of a set asks for the same sheets in one recompute; records are kept by the memo.
    return member_sheets(record, style, plates)


def _record_of(sheet_set) -> MemberRecord:
    from BendTorsionWB.objects.unfold import member_record_of

    try:
        unfold = linked(sheet_set, "Unfold", "Unfold")
        found = findings_of(unfold)
        if has_error(found):
            return _faulty(sheet_set.Label, found)
        record = member_record_of(unfold)
        if sheet_set.Bed is None:
            return record
        bed = linked(sheet_set, "Bed", "AssemblyBed")
        found = findings_of(bed)
        if has_error(found):
            return _faulty(sheet_set.Label, found)
        return with_beds(record, beds_of_object(bed))
    except BendTorsionError as problem:
        return _faulty(sheet_set.Label, problem.findings)


def _faulty(name: str, findings) -> MemberRecord:
    return MemberRecord(name, "", "", findings=tuple(findings))


class SheetSet(Proxy):
    """All sheets of one member (App::FeaturePython)."""

    TYPE = "SheetSet"
    PROPERTIES = (
        Property("App::PropertyLink", "Unfold", "Sheets", "The flat patterns these sheets show"),
        Property("App::PropertyLink", "Bed", "Sheets", "The assembly bed shown, if any"),
        Property(
            "App::PropertyBool",
            "PlatePages",
            "Sheets",
            "Pages for the plates, too, about 0.1 s for each. The PDF has them always",
            True,
        ),
        Property("App::PropertyString", "Project", "Sheets", "Project name in the title block"),
        Property("App::PropertyString", "Author", "Sheets", "Drawn by, in the title block"),
        Property(
            "App::PropertyEnumeration",
            "SheetFormat",
            "Sheets",
            "Size of the pages",
            PLAIN_STYLE.format,
            tuple(FORMATS),
        ),
        Property(
            "App::PropertyEnumeration",
            "SheetStandard",
            "Sheets",
            "ISO: first angle, weld symbols of ISO 2553; AWS: third angle, of AWS A2.4",
            PLAIN_STYLE.standard,
            STANDARDS,
        ),
        Property(
            "App::PropertyEnumeration",
            "SheetLanguage",
            "Sheets",
            "Language of the labels",
            PLAIN_STYLE.language,
            LANGUAGES,
        ),
        Property(
            "App::PropertyEnumeration",
            "SheetUnit",
            "Sheets",
            "Unit of dimensions and sizes",
            PLAIN_STYLE.unit,
            LENGTH_UNITS,
        ),
        Property("App::PropertyDistance", "SiteX", "Site", "The model's origin on the site"),
        Property("App::PropertyDistance", "SiteY", "Site", "The model's origin on the site"),
        Property("App::PropertyDistance", "SiteZ", "Site", "The model's origin on the site"),
        Property(
            "App::PropertyAngle",
            "SiteRotation",
            "Site",
            "From the site's x axis to the model's, about the vertical",
        ),
        Property(
            "App::PropertyEnumeration",
            "SiteUnit",
            "Site",
            "Unit of site values on the sheets",
            PLAIN_STYLE.site.unit,
            tuple(UNITS),
        ),
        Property("App::PropertyInteger", "PageCount", "Result", "Number of pages", output=True),
    )

    def build(self, obj):
        sheets = sheets_of(obj)
        obj.PageCount = len(sheets)
        pages = _whole_pages(obj)
        for index, sheet in enumerate(sheets):
            if index not in pages:
                pages[index] = _add_page(obj, index, sheet)
            _adjust_page(pages[index], f"{obj.Label} {sheet.number}", sheet)
        if _surplus(obj.Document):
            _after_recompute.watch(obj.Document)
        return _record_of(obj).findings

    def clear(self, obj):
        """Nothing: in error there is the one page that says so."""


class PageOutlines(Proxy):
    """The outlines of one page as wires at model scale (Part::FeaturePython)."""

    TYPE = "PageOutlines"
    PROPERTIES = (
        Property("App::PropertyLink", "Set", "Sheets", "The sheet set this page belongs to"),
        Property("App::PropertyInteger", "Index", "Sheets", "Number of the page, from 0"),
    )

    def build(self, obj):
        obj.Shape = Part.Compound(
            [
                Part.makePolygon([FreeCAD.Vector(x, y, 0.0) for x, y in line.tolist()])
                for line in view_edges(_page_sheet(obj))
            ]
        )
        return ()

    def clear(self, obj):
        """Nothing: a page in error has its frame; a view of an empty shape would be invalid."""

    def onDocumentRestored(self, obj):
        """The wires belong to the page, not into the 3D view."""
        super().onDocumentRestored(obj)
        obj.Visibility = False


class PageSymbol(Proxy):
    """Labels, tables and title block of one page (TechDraw::DrawViewSymbolPython)."""

    TYPE = "PageSymbol"
    PROPERTIES = PageOutlines.PROPERTIES

    # Its view provider is TechDraw's own, so none is attached.
    def __init__(self, obj):
        obj.Proxy = self
        self.set_up(obj)

    def onDocumentRestored(self, obj):
        """Complete the properties of a file saved by an earlier version."""
        self.set_up(obj)

    def build(self, obj):
        # TechDraw recomputes its views when a document is opened; what they show is in the file.
        if obj.Document.Restoring and obj.Symbol:
            return ()
        symbol = symbol_svg(_page_sheet(obj))
        if symbol != obj.Symbol:
            obj.Symbol = symbol
        return ()


def _page_sheet(obj) -> Sheet:
    """The sheet a page object shows; one that says so when there is none for it."""
    sheets = sheets_of(obj.Set) if obj.Set is not None else ()
    if 0 <= obj.Index < len(sheets):
        return sheets[obj.Index]
    if obj.Set is None:
        code, message, mend = "link-missing", "the sheet set was deleted", "delete this page"
    else:
        code, message = "surplus-page", "this page is no longer used"
        mend = "put the objects in error right; it goes at the next recompute"
    return member_sheets(_faulty(obj.Label, (error(code, obj.Label, message, mend),)))[0]


def _members(sheet_set, kind: str) -> list:
    return [obj for obj in sheet_set.InList if getattr(obj, "BT_Type", "") == kind]


def _page_objects(outlines) -> list:
    """Page, template, views and outlines around a PageOutlines object, dependants first."""
    views = [obj for obj in outlines.InList if obj.isDerivedFrom("TechDraw::DrawViewPart")]
    pages = [
        page for view in views for page in view.InList if page.isDerivedFrom("TechDraw::DrawPage")
    ]
    symbols = [
        view
        for page in pages
        for view in page.Views
        if getattr(view, "BT_Type", "") == "PageSymbol" and view.Set == outlines.Set
    ]
    templates = [page.Template for page in pages if page.Template is not None]
    return [*pages, *templates, *symbols, *views, outlines]


def remove_pages(sheet_set) -> None:
    """Remove all pages of a SheetSet from its document, before it goes itself."""
    document = sheet_set.Document
    for outlines in _members(sheet_set, "PageOutlines"):
        for name in [obj.Name for obj in _page_objects(outlines)]:
            if document.getObject(name) is not None:
                document.removeObject(name)


def _whole_pages(sheet_set) -> dict[int, object]:
    """DrawPage by index. What is left of a page someone deleted is marked surplus."""
    pages = {}
    for outlines in _members(sheet_set, "PageOutlines"):
        objects = _page_objects(outlines)
        page = objects[0]
        whole = page.isDerivedFrom("TechDraw::DrawPage") and any(
            getattr(obj, "BT_Type", "") == "PageSymbol" for obj in objects
        )
        if whole and outlines.Index not in pages:
            pages[outlines.Index] = page
        elif outlines.Index >= 0:
            outlines.Index = -1
    return pages


def _add_page(sheet_set, index: int, sheet: Sheet):
    """A page with its template, outlines, view and symbol; gives the page."""
    document, number = sheet_set.Document, f"{index + 1:02d}"

    def add(kind: str, role: str):
        return document.addObject(kind, f"{sheet_set.Name}_{role}{number}")

    outlines = add("Part::FeaturePython", "Outlines")
    PageOutlines(outlines)
    symbol = add("TechDraw::DrawViewSymbolPython", "Symbol")
    PageSymbol(symbol)
    for obj in (outlines, symbol):
        obj.Set, obj.Index = sheet_set, index
    outlines.Visibility = False
    page, template = add("TechDraw::DrawPage", "Page"), add("TechDraw::DrawSVGTemplate", "Template")
    template.Template = template_path(sheet)
    page.Template = template
    view = add("TechDraw::DrawViewPart", "View")
    outlines.recompute()
    page.addView(view)
    page.addView(symbol)
    # After addView, which moves views to the middle of the page.
    configure_outline_view(view, outlines, sheet)
    configure_symbol(symbol, sheet)
    created = (outlines, template, symbol, view, page)
    for obj in created[1:]:
        obj.recompute()
    _after_recompute.watch(document, created)
    return page


def _adjust_page(page, label: str, sheet: Sheet) -> None:
    """Label, size and scale of a page, written only when they change."""
    if page.Label != label:
        page.Label = label
    template = page.Template
    if template is not None and _size_of(template) != (sheet.width, sheet.height):
        template.Template = template_path(sheet)
        for view in page.Views:
            if view.isDerivedFrom("TechDraw::DrawViewPart"):
                configure_outline_view(view, view.Source[0], sheet)
            elif getattr(view, "BT_Type", "") == "PageSymbol":
                configure_symbol(view, sheet)
    scale = 1.0 / sheet_scale(sheet)
    for view in page.Views:
        if view.isDerivedFrom("TechDraw::DrawViewPart") and abs(view.Scale / scale - 1) > 1e-12:
            view.Scale = scale


def _size_of(template) -> tuple[float, float]:
    return round(template.Width.Value, 3), round(template.Height.Value, 3)


def _surplus(document) -> list:
    """PageOutlines whose sheet is gone."""
    return [
        obj
        for obj in document.Objects
        if getattr(obj, "BT_Type", "") == "PageOutlines"
        and obj.Set is not None
        and not 0 <= obj.Index < obj.Set.PageCount
    ]


class _AfterRecompute:
    """Document observer that tidies up after a recompute that changed the number of pages."""

    def __init__(self):
        self.created: dict[str, list[str]] = {}
        self.registered = False

    def watch(self, document, created=()):
        """Tidy this document after the recompute under way."""
        if not self.registered:
            FreeCAD.addDocumentObserver(self)
            self.registered = True
        names = self.created.setdefault(document.Name, [])
        names.extend(obj.Name for obj in created)

    def slotRecomputedDocument(self, document):
        """Remove surplus pages; what was created is up to date already."""
        if document.Name not in self.created:
            return
        for name in self.created[document.Name]:
            obj = document.getObject(name)
            if obj is not None and obj.isValid():
                obj.purgeTouched()
        self.created[document.Name] = []
        # While some object is in error, FreeCAD goes on to read the list it has recomputed.
        if all(obj.isValid() for obj in document.Objects):
            for outlines in _surplus(document):
                for name in [obj.Name for obj in _page_objects(outlines)]:
                    if document.getObject(name) is not None:
                        document.removeObject(name)
            del self.created[document.Name]

    def slotDeletedDocument(self, document):
        """Forget a closed document."""
        self.created.pop(document.Name, None)


_after_recompute = _AfterRecompute()
