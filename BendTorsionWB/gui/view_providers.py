# SPDX-License-Identifier: LGPL-2.1-or-later
"""How BendTorsion objects show in the tree and the 3D view; nothing here is needed to compute."""

from __future__ import annotations

from BendTorsionWB.gui import resources

# Colour (red, green, blue) and transparency in per cent a new object starts with; the user's from
# then on.
APPEARANCE = {
    "Surface": ((0.62, 0.72, 0.80), 75),
    "Member": ((0.45, 0.55, 0.65), 40),
    "PlateSet": ((0.93, 0.72, 0.26), 0),
    "Unfold": ((0.18, 0.44, 0.69), 0),
}


HIDDEN_AT_FIRST = ("SectionSpec", "Unfold", "PageOutlines")
"""Flat patterns, pages and section outlines lie about the origin, not where the building is."""

CLAIMED = {
    "Member": ("PlateSet",),
    "PlateSet": ("Unfold",),
    "Unfold": ("SheetSet",),
    "SheetSet": ("PageOutlines",),
}
"""What the tree shows below an object, of the objects that depend on it."""


class ViewProvider:
    """The icon and the look of one object and what the tree shows below it; saves no state."""

    def __init__(self, view):
        view.Proxy = self

    def attach(self, view):
        """Remember the object for the tree; FreeCAD calls this for new and restored objects."""
        self.object = view.Object

    def claimChildren(self):
        """The objects the tree shows below this one."""
        obj = getattr(self, "object", None)
        if obj is None:
            return []
        kinds = CLAIMED.get(obj.BT_Type, ())
        return [user for user in obj.InList if getattr(user, "BT_Type", "") in kinds]

    def getIcon(self):
        """Path of the icon in the tree."""
        return resources.icon("BendTorsion")

    def dumps(self):
        """Nothing to save."""
        return None

    def loads(self, state):
        """Nothing to restore."""
        return None

    __getstate__ = dumps
    __setstate__ = loads


def attach(obj) -> None:
    """Give `obj` its view provider, unless it came back with one from the file.

    Files saved without a window come back without view providers and with everything hidden.
    """
    view = obj.ViewObject
    if isinstance(view.Proxy, ViewProvider):
        return
    ViewProvider(view)
    if obj.BT_Type in APPEARANCE:
        colour, transparency = APPEARANCE[obj.BT_Type]
        view.ShapeColor = colour
        view.Transparency = transparency
    view.Visibility = _shown(obj)


def _shown(obj) -> bool:
    """Whether an object is to be seen at first: of a member its plates, once it has some."""
    if obj.BT_Type in HIDDEN_AT_FIRST:
        return False
    return obj.BT_Type != "Member" or not any(
        getattr(user, "BT_Type", "") == "PlateSet" for user in obj.InList
    )
