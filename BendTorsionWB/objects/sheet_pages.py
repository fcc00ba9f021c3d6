# SPDX-License-Identifier: LGPL-2.1-or-later
"""The objects a drawing page is made of, and the removal of pages that are no longer used.

Surplus pages go when a recompute is over: FreeCAD 0.20 forgets to clear its list of objects
removed during a recompute, removes them again after an undo, and crashes.
"""

from __future__ import annotations

import FreeCAD

from BendTorsionWB.objects.sheet_content import forget_records
from BendTorsionWB.sheets.qt import settle_threads


def is_outlined(sheet_set) -> bool:
    """Whether the pages of a set have TechDraw views; the symbol shows all there is without."""
    return getattr(sheet_set.Proxy, "OUTLINED", True)


def heads(sheet_set) -> list:
    """What a set's pages are known by, one of each: outlines, or symbols where they are all."""
    kind = "PageOutlines" if is_outlined(sheet_set) else "PageSymbol"
    return [obj for obj in sheet_set.InList if getattr(obj, "BT_Type", "") == kind]


def page_objects(head) -> list:
    """Page, template, symbol, views and outlines around the head of a page, dependants first."""
    views = [obj for obj in head.InList if obj.isDerivedFrom("TechDraw::DrawViewPart")]
    pages = [
        page
        for view in views or [head]
        for page in view.InList
        if page.isDerivedFrom("TechDraw::DrawPage")
    ]
    symbols = [
        view
        for page in pages
        for view in page.Views
        if getattr(view, "BT_Type", "") == "PageSymbol" and view.Set == head.Set
    ]
    templates = [page.Template for page in pages if page.Template is not None]
    own = [] if head in symbols else [head]
    return [*pages, *templates, *symbols, *views, *own]


def let_wait(page) -> None:
    """Let a page wait to be opened before TechDraw draws it; that it is drawn then is no edit."""
    page.setPropertyStatus("KeepUpdated", "NoModify")
    page.KeepUpdated = False


def surplus(document) -> list:
    """The heads of pages whose sheet is gone."""
    return [
        obj
        for obj in document.Objects
        if getattr(obj, "BT_Type", "") in ("PageOutlines", "PageSymbol")
        and obj.Set is not None
        and is_outlined(obj.Set) == (obj.BT_Type == "PageOutlines")
        and not 0 <= obj.Index < obj.Set.PageCount
    ]


class _AfterRecompute:
    """Document observer that tidies up after a recompute that changed the number of pages."""

    def __init__(self):
        self.created: dict[str, list[str]] = {}
        self.registered = False

    def register(self):
        """Be told of recomputes and of documents that are closed, from now on."""
        if not self.registered:
            FreeCAD.addDocumentObserver(self)
            self.registered = True

    def watch(self, document, created=()):
        """Tidy this document after the recompute under way."""
        self.register()
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
            templates = [o for o in document.Objects if o.isDerivedFrom("TechDraw::DrawTemplate")]
            settled = [template.Name for template in templates if "Touched" not in template.State]
            unused = surplus(document)
            if unused:
                settle_threads()
            for head in unused:
                for name in [obj.Name for obj in page_objects(head)]:
                    if document.getObject(name) is not None:
                        document.removeObject(name)
            # FreeCAD 1.1 touches every template when the number of pages changes.
            for template in filter(None, map(document.getObject, settled)):
                template.purgeTouched()
            del self.created[document.Name]

    def slotDeletedDocument(self, document):
        """Forget a closed document."""
        self.created.pop(document.Name, None)
        forget_records(document)


after_recompute = _AfterRecompute()
