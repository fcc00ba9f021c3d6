# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sheets of a member in a document: a SheetSet and, for each page, what TechDraw shows.

Pages pull their content from the SheetSet, so edits reach them by plain recompute. SheetSet.execute
only keeps the number of pages: it creates missing ones at once; surplus ones are removed by a
document observer when the recompute is over (`sheet_pages`).
"""

from __future__ import annotations

import FreeCAD
import Part

from BendTorsionWB.core.drawings.sheet import LINE_STYLES, Sheet
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_style import (
    FORMATS,
    LANGUAGES,
    LENGTH_UNITS,
    PLAIN_STYLE,
    STANDARDS,
)
from BendTorsionWB.core.finding import error
from BendTorsionWB.core.site import UNITS
from BendTorsionWB.objects.proxy import Property, Proxy, bare_finding, is_bare
from BendTorsionWB.objects.sheet_content import (
    faulty,
    keep_record,
    kept_record,
    laid_out,
    style_of,
)
from BendTorsionWB.objects.sheet_pages import (
    after_recompute,
    heads,
    is_outlined,
    let_wait,
    page_objects,
    surplus,
)
from BendTorsionWB.objects.told import PROGRESS
from BendTorsionWB.sheets.qt import settle_threads
from BendTorsionWB.sheets.techdraw import (
    configure_outline_view,
    configure_symbol,
    resized_symbol,
    sheet_scale,
    symbol_svg,
    template_path,
    view_edges,
)


def sheets_of(sheet_set) -> tuple[Sheet, ...]:
    """The sheets of a SheetSet or an ArrangementSet; one that names the fault when there is nothing
    to draw, or nothing computes the set."""
    if is_bare(sheet_set):
        return member_sheets(faulty(sheet_set.Label, (bare_finding(sheet_set),)))
    return sheet_set.Proxy.sheets(sheet_set)


class SheetSet(Proxy):
    """All sheets of one member (App::FeaturePython)."""

    TYPE = "SheetSet"
    OUTLINED = True
    """Whether views are TechDraw views, which can be dimensioned: 0.2 s for a page."""
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

    def sheets(self, obj) -> tuple[Sheet, ...]:
        """What its pages show, of the record of its last recompute."""
        return laid_out(kept_record(obj), style_of(obj), obj.PlatePages)

    def build(self, obj):
        record = keep_record(obj)
        keep_pages(obj, record.findings)
        return record.findings

    def clear(self, obj):
        """Nothing: in error there is the one page that says so."""


def keep_pages(sheet_set, findings) -> None:
    """As many pages as there are sheets, each of the size and scale of its sheet. findings: of what
    the sheets show. Where something lost what computes it nobody knows how many there should be,
    and pages, with what was drawn on them by hand, stay."""
    after_recompute.register()
    sheets = sheets_of(sheet_set)
    unknown = any(finding.code == "object-bare" for finding in findings)
    sheet_set.PageCount = max(len(sheets), sheet_set.PageCount if unknown else 0)
    pages = _whole_pages(sheet_set)
    for index, sheet in enumerate(sheets):
        if index not in pages:
            PROGRESS.get()(f"{sheet_set.Label} {sheet.number}", index, len(sheets))
            pages[index] = _add_page(sheet_set, index, sheet)
        _adjust_page(pages[index], f"{sheet_set.Label} {sheet.number}", sheet)
    if surplus(sheet_set.Document):
        after_recompute.watch(sheet_set.Document)


class PageOutlines(Proxy):
    """The outlines of one page as wires at model scale (Part::FeaturePython)."""

    TYPE = "PageOutlines"
    PROPERTIES = (
        Property("App::PropertyLink", "Set", "Sheets", "The sheet set this page belongs to"),
        Property("App::PropertyInteger", "Index", "Sheets", "Number of the page, from 0"),
    )

    def build(self, obj):
        wires = [
            Part.makePolygon([FreeCAD.Vector(x, y, 0.0) for x, y in line.tolist()])
            for line in view_edges(_page_sheet(obj))
        ]
        # What lies in another shape is saved by another byte, and TechDraw puts the outlines into
        # one of its own, in FreeCAD 1.1 sooner or later: they have been in one from the start.
        obj.Shape = Part.Compound([Part.Compound(wires)]).childShapes()[0]
        return ()

    def clear(self, obj):
        """Nothing: a page in error has its frame; a view of an empty shape would be invalid."""

    def onDocumentRestored(self, obj):
        """The wires belong to the page, not into the 3D view. Pages the window let wait to be
        opened are drawn at once without one."""
        super().onDocumentRestored(obj)
        obj.Visibility = False
        for view in obj.InList:
            if view.isDerivedFrom("TechDraw::DrawViewPart"):
                _thin_lines(view)
        if not FreeCAD.GuiUp:
            for page in page_objects(obj):
                if page.isDerivedFrom("TechDraw::DrawPage"):
                    page.KeepUpdated = True


class PageSymbol(Proxy):
    """Labels, tables and title block of one page (TechDraw::DrawViewSymbolPython)."""

    TYPE = "PageSymbol"
    PROPERTIES = PageOutlines.PROPERTIES

    # Its view provider is TechDraw's own, so none is attached.
    def __init__(self, obj):
        obj.Proxy = self
        self.set_up(obj)

    def onDocumentRestored(self, obj):
        """Complete the properties of a file saved by an earlier version; show it at its size."""
        self.set_up(obj)
        obj.Symbol = resized_symbol(obj.Symbol)

    def build(self, obj):
        # TechDraw recomputes its views when a document is opened; what they show is in the file.
        if obj.Document.Restoring and obj.Symbol:
            return ()
        symbol = symbol_svg(_page_sheet(obj), obj.Set is not None and not is_outlined(obj.Set))
        if symbol != obj.Symbol:
            obj.Symbol = symbol
        return ()


def _page_sheet(obj) -> Sheet:
    """The sheet a page object shows; one that says so when there is none for it."""
    sheets = sheets_of(obj.Set) if obj.Set is not None else ()
    if 0 <= obj.Index < len(sheets):
        return sheets[obj.Index]
    if sheets and 0 <= obj.Index < obj.Set.PageCount:
        return sheets[0]
    if obj.Set is None:
        code, message, mend = "link-missing", "the sheet set was deleted", "delete this page"
    else:
        code, message = "surplus-page", "this page is no longer used"
        mend = "put the objects in error right; it goes at the next recompute"
    return member_sheets(faulty(obj.Label, (error(code, obj.Label, message, mend),)))[0]


def remove_pages(sheet_set) -> None:
    """Remove all pages of a SheetSet from its document, before it goes itself."""
    document = sheet_set.Document
    settle_threads()
    for head in heads(sheet_set):
        for name in [obj.Name for obj in page_objects(head)]:
            if document.getObject(name) is not None:
                document.removeObject(name)


def _whole_pages(sheet_set) -> dict[int, object]:
    """DrawPage by index. What is left of a page someone deleted is marked surplus."""
    pages = {}
    for head in heads(sheet_set):
        objects = page_objects(head)
        page = objects[0]
        whole = page.isDerivedFrom("TechDraw::DrawPage") and any(
            getattr(obj, "BT_Type", "") == "PageSymbol" for obj in objects
        )
        if whole and head.Index not in pages:
            pages[head.Index] = page
        elif head.Index >= 0:
            head.Index = -1
    return pages


def _add_page(sheet_set, index: int, sheet: Sheet):
    """A page with its template, outlines, view and symbol; gives the page."""
    document, number = sheet_set.Document, f"{index + 1:02d}"

    def add(kind: str, role: str):
        return document.addObject(kind, f"{sheet_set.Name}_{role}{number}")

    symbol = add("TechDraw::DrawViewSymbolPython", "Symbol")
    PageSymbol(symbol)
    symbol.Set, symbol.Index = sheet_set, index
    page, template = add("TechDraw::DrawPage", "Page"), add("TechDraw::DrawSVGTemplate", "Template")
    template.Template = template_path(sheet)
    page.Template = template
    # In the window it is drawn when it is opened.
    if FreeCAD.GuiUp and is_outlined(sheet_set):
        let_wait(page)
    outlined = [_add_outlines(sheet_set, index, add)] if is_outlined(sheet_set) else []
    views = [view for _, view in outlined]
    # The list itself: addView moves views to the middle of the page, and that of FreeCAD 1.1 takes
    # no view that Python computes.
    page.Views = [*page.Views, *views, symbol]
    for outlines, view in outlined:
        configure_outline_view(view, outlines, sheet)
        _thin_lines(view)
    configure_symbol(symbol, sheet)
    if FreeCAD.GuiUp and not views and "ShowFrames" in page.ViewObject.PropertiesList:
        page.ViewObject.ShowFrames = False
    created = (template, symbol, *views, page)
    for obj in created:
        obj.recompute()
    after_recompute.watch(document, (*(outlines for outlines, _ in outlined), *created))
    return page


def _add_outlines(sheet_set, index: int, add) -> tuple:
    """The outlines of a page and the view that shows them."""
    outlines = add("Part::FeaturePython", "Outlines")
    PageOutlines(outlines)
    outlines.Set, outlines.Index = sheet_set, index
    outlines.Visibility = False
    outlines.recompute()
    return outlines, add("TechDraw::DrawViewPart", "View")


def _thin_lines(view) -> None:
    """Edges as thin as the sheet's: FreeCAD 1.0 and later draw them 0.7 mm wide unless told (0.20
    as hairlines, whatever it is told). Only the window keeps widths."""
    if FreeCAD.GuiUp:
        view.ViewObject.LineWidth = LINE_STYLES["narrow"][0]


def _adjust_page(page, label: str, sheet: Sheet) -> None:
    """Label, size and scale of a page, written only when they change."""
    former = page.Label
    if former != label:
        page.Label = label
    _label_parts(page, former)
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


def _label_parts(page, former: str) -> None:
    """Labels after their page's for the parts of a page, those that nobody gave another; former:
    the page's label before."""
    parts = [] if page.Template is None else [(page.Template, "fields")]
    for view in page.Views:
        source = view.Source[:1] if view.isDerivedFrom("TechDraw::DrawViewPart") else ()
        if getattr(view, "BT_Type", "") == "PageSymbol":
            parts.append((view, "text"))
        elif source and getattr(source[0], "BT_Type", "") == "PageOutlines":
            parts += [(view, "views"), (source[0], "lines")]
    for part, name in parts:
        label = f"{page.Label} {name}"
        if part.Label in (part.Name, f"{former} {name}") and part.Label != label:
            part.Label = label


def _size_of(template) -> tuple[float, float]:
    return round(template.Width.Value, 3), round(template.Height.Value, 3)
