# SPDX-License-Identifier: LGPL-2.1-or-later
"""The tree: what is folded under which object, and the worst finding of an object and its parts."""

from __future__ import annotations

import json

CLAIMED = {
    "Member": ("PlateSet",),
    "PlateSet": ("Unfold", "AssemblyBed"),
    "Unfold": ("SheetSet",),
}
"""What the tree shows below an object, of the objects that depend on it."""
LINKED_ABOVE = {"PlateSet": "Member", "Unfold": "Plates", "AssemblyBed": "Plates"} | {
    "SheetSet": "Unfold"
}
"""The property by which an object names the one it is shown below."""
TRIED: set[str] = set()
"""Names of objects that are tried out and will be made anew when kept, or have just come back.
FreeCAD's tree takes one that comes at the same address for the one it had folded away, and leaves
it at the top, unless it was told in between that there is none."""
ORDER = {"": 0, "note": 0, "warning": 1, "error": 2}

PAGE_PARTS = ("PageOutlines", "PageSymbol")
"""What is ours of a drawing page; symbols have a page to themselves where there are no outlines."""


def children(obj) -> list:
    """The objects shown below an object."""
    kind = getattr(obj, "BT_Type", "")
    found = []
    if kind == "Member" and obj.Axis is not None and _only_user(obj.Axis, obj):
        found.append(obj.Axis)
    if kind in CLAIMED:
        found += [user for user in obj.InList if getattr(user, "BT_Type", "") in CLAIMED[kind]]
    if kind in ("SheetSet", "ArrangementSet", "NodeSheets"):
        found += [*pages(obj), *_outlines(obj)]
    return [item for item in found if item.Name not in TRIED]


def parents(obj) -> list:
    """The objects above, nearest first, as far as they are part of a document."""
    found = []
    while obj is not None:
        kind = getattr(obj, "BT_Type", "")
        if kind == "Axis":
            users = [user for user in obj.InList if _only_user(obj, user)]
            obj = users[0] if users else None
        else:
            obj = getattr(obj, LINKED_ABOVE[kind], None) if kind in LINKED_ABOVE else None
        if obj is not None and not _is_in_document(obj):
            obj = None
        if obj is not None:
            found.append(obj)
    return found


def ask_again(obj) -> None:
    """Have FreeCAD ask an object for what is folded below it: it does when the object changes, and
    a new child is no change of it."""
    # An output: written anew, it asks for no recompute, and nothing for saving.
    obj.setPropertyStatus("Findings", "NoModify")
    obj.Findings = obj.Findings
    obj.setPropertyStatus("Findings", "-NoModify")


def _is_in_document(obj) -> bool:
    """Whether an object was not taken out with those that link to it, which still do."""
    try:
        return bool(obj.Name)
    except RuntimeError:
        return False


def worst(obj) -> str:
    """`error`, `warning` or nothing: the worst finding of an object and of all shown below it."""
    found = ""
    for item in (obj, *children(obj)):
        own = _severity(item) if item is obj else worst(item)
        if ORDER[own] > ORDER[found]:
            found = own
    return found


def _severity(obj) -> str:
    """The worst finding of an object by itself: what it repeats of an object it is made from, and
    works in spite of, has its badge there."""
    above = {text for item in obj.OutList for text in getattr(item, "Findings", ())}
    found = {
        severity
        for text in getattr(obj, "Findings", ())
        if (severity := json.loads(text)["severity"]) == "error" or text not in above
    }
    return "error" if "error" in found else "warning" if "warning" in found else ""


def _only_user(axis, member) -> bool:
    """Whether a member is the only one along an axis."""
    members = {
        user.Name
        for user in axis.InList
        if getattr(user, "BT_Type", "") == "Member" and user.Axis == axis
    }
    return members == {member.Name}


def sheets_of(page):
    """The set of sheets that a drawing page is one of; None for other objects."""
    views = page.Views if page.isDerivedFrom("TechDraw::DrawPage") else ()
    for view in views:
        for item in (view, *getattr(view, "Source", ())):
            if getattr(item, "BT_Type", "") in PAGE_PARTS:
                return item.Set
    return None


def pages(sheet_set) -> list:
    """The drawing pages of a set of sheets, also those that have only just come."""
    views = [
        view
        for item in _outlines(sheet_set)
        for view in item.InList
        if view.isDerivedFrom("TechDraw::DrawViewPart")
    ]
    found = [
        page
        for view in views or _page_parts(sheet_set)
        for page in view.InList
        if page.isDerivedFrom("TechDraw::DrawPage")
    ]
    return list(dict.fromkeys(found))


def _outlines(sheet_set) -> list:
    return [item for item in _page_parts(sheet_set) if item.BT_Type == "PageOutlines"]


def _page_parts(sheet_set) -> list:
    return [user for user in sheet_set.InList if getattr(user, "BT_Type", "") in PAGE_PARTS]
