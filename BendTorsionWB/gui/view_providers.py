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


class ViewProvider:
    """The icon and the look of one object; holds no state."""

    def __init__(self, view):
        view.Proxy = self

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
    view.Visibility = not _shown_by_its_plates(obj)


def _shown_by_its_plates(obj) -> bool:
    return obj.BT_Type == "Member" and any(
        getattr(user, "BT_Type", "") == "PlateSet" for user in obj.InList
    )
