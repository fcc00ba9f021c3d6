# SPDX-License-Identifier: LGPL-2.1-or-later
"""How BendTorsion objects show in the tree and the 3D view; nothing here is needed to compute."""

from __future__ import annotations

from contextlib import suppress

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui import (
    editors,
    first_view,
    icons,
    legend,
    macro,
    member_display,
    page_drawing,
    tree,
)
from BendTorsionWB.gui.qt import QtCore, QtGui

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

# Colour (red, green, blue) and transparency in per cent a new object starts with; the user's from
# then on. Each stands out at 3:1 or more on white and on the dark themes' ground.
APPEARANCE = {
    "Surface": ((0.45, 0.58, 0.70), 75),
    "Member": ((0.45, 0.55, 0.65), 40),
    "PlateSet": ((0.78, 0.52, 0.12), 0),
    "Node": ((0.85, 0.27, 0.27), 0),
    "Unfold": ((0.22, 0.50, 0.78), 0),
}
AXIS_COLOUR = (0.84, 0.37, 0.0)
"""Of the line of a new axis, and so of the frames on it."""
TRANSFORM = 1
"""FreeCAD's mode of editing in which the mouse moves an object."""


HIDDEN_AT_FIRST = ("SectionSpec", "Unfold", "PageOutlines", "AssemblyBed")
"""Flat patterns, pages and section outlines lie about the origin, not where the building is; beds
stand under the members while they are put together, not in the building."""

_LABELS = QT_TRANSLATE_NOOP("App::Property", "Labels")
PROPERTIES = {
    "PlateSet": (
        (
            "App::PropertyBool",
            "ShowMarks",
            _LABELS,
            QT_TRANSLATE_NOOP("App::Property", "Show the mark of each plate"),
        ),
        (
            "App::PropertyBool",
            "ShowPoints",
            _LABELS,
            QT_TRANSLATE_NOOP("App::Property", "Show station lines and the labels of L and P"),
        ),
    ),
    "Axis": (
        (
            "App::PropertyBool",
            "ShowFrames",
            QT_TRANSLATE_NOOP("App::Property", "Frames"),
            QT_TRANSLATE_NOOP("App::Property", "Show where the height of sections points"),
        ),
        (
            "App::PropertyLength",
            "FrameHeight",
            QT_TRANSLATE_NOOP("App::Property", "Frames"),
            QT_TRANSLATE_NOOP("App::Property", "Height of the ribbon; 0 for one that suits"),
        ),
    ),
}
"""Properties of the view by kind of object: type, name, group, tooltip."""
HIDDEN_BY_ERROR = "HiddenByError"
_hiding: list = []
"""Objects hidden for being empty at the moment; who hides one otherwise wants it to stay hidden."""


class ViewProvider:
    """The icon and the look of one object, what the tree shows below it and what a double click
    opens; its state is in the properties of the view."""

    def __init__(self, view):
        view.Proxy = self
        self.attach(view)

    def attach(self, view):
        """Remember the object; FreeCAD calls this for new and restored objects."""
        self.object = view.Object
        self.visible, self.is_new = view.Visibility, True
        QtCore.QTimer.singleShot(0, self._settle)
        present = view.PropertiesList
        for kind, name, group, tooltip in PROPERTIES.get(self.object.BT_Type, ()):
            if name not in present:
                view.addProperty(kind, name, group, tooltip)
        if HIDDEN_BY_ERROR not in present:
            view.addProperty("App::PropertyBool", HIDDEN_BY_ERROR, "Base", "")
            view.setEditorMode(HIDDEN_BY_ERROR, 2)

    def updateData(self, obj, name):
        """Follow the shape, the colours and the findings of the object."""
        view = obj.ViewObject
        if name == "Shape":
            hide_when_empty(obj)
            self._draw(view)
        if name in ("Shape", "Colours"):
            paint(obj)
        if name in ("Legend", "ColourBy"):
            legend.schedule(obj.Document)
        if name == tree.LINKED_ABOVE.get(obj.BT_Type):
            QtCore.QTimer.singleShot(0, lambda at=(obj.Document.Name, obj.Name): _fold(*at))
        if name == tree.LINKED_ABOVE.get(obj.BT_Type) and getattr(obj, name) is not None:
            # The tree asks an object for its children only after one of its properties was set.
            above = getattr(obj, name)
            above.Visibility = above.Visibility
        if name == "Findings":
            # A deletion done again tells of findings of what has no view any more.
            with suppress(RuntimeError):
                for item in (obj, *tree.parents(obj)):
                    item.ViewObject.signalChangeIcon()

    def onChanged(self, view, name):
        """Follow what is switched in the view's properties."""
        obj = getattr(self, "object", None)
        if obj is None:
            return
        if name == "Visibility":
            if not (view.Visibility or obj in _hiding or obj.Document.Restoring):
                if getattr(view, HIDDEN_BY_ERROR, False):
                    setattr(view, HIDDEN_BY_ERROR, False)
            self._tell_member(view)
            hide_when_empty(obj)
        if name in ("Visibility", "ShowMarks", "ShowPoints", "ShowFrames", "FrameHeight"):
            self._draw(view)
        if name == "Visibility" and "ColourBy" in obj.PropertiesList:
            legend.schedule(obj.Document)

    def onDelete(self, view, names):
        """The legend goes with what it explains; the object may."""
        if "ColourBy" in self.object.PropertiesList:
            legend.schedule(self.object.Document)
        return True

    def isShow(self):
        """Whether the tree shows it as seen: a member by its plates, too, while its own shape is
        hidden."""
        obj = getattr(self, "object", None)
        if obj is None:
            return False
        if obj.ViewObject.Visibility or obj.BT_Type != "Member":
            return obj.ViewObject.Visibility
        return bool(member_display.plates_shown(obj))

    def claimChildren(self):
        """The objects the tree shows below this one."""
        obj = getattr(self, "object", None)
        return [] if obj is None else tree.children(obj)

    def getIcon(self):
        """The icon in the tree, with a badge for the worst finding of the object and all below."""
        obj = getattr(self, "object", None)
        return icons.icon_of(obj.BT_Type, tree.worst(obj)) if obj is not None else ""

    def doubleClicked(self, view):
        """Edit the object in its task panel; what has none is left to FreeCAD."""
        if self.object.BT_Type not in editors.PANELS:
            return False
        FreeCADGui.getDocument(self.object.Document.Name).setEdit(self.object.Name)
        return True

    def setEdit(self, view, mode=0):
        """Open the task panel. What is built in its place cannot be moved with the mouse; all other
        modes of editing are FreeCAD's."""
        if mode == TRANSFORM and not getattr(self.object.Proxy, "LAID_APART", True):
            return False
        panel = editors.edit_panel(self.object) if mode == 0 else None
        if panel is None:
            return False if mode == 0 else None
        self.panel = panel
        panel.show()
        return True

    def unsetEdit(self, view, mode=0):
        """Editing ends: an open panel is cancelled."""
        panel = self.__dict__.pop("panel", None)
        if panel is not None:
            panel.reject()
        return True

    def setupContextMenu(self, view, menu):
        """What to show of a member."""
        if self.object.BT_Type != "Member":
            return
        for mode, text in member_display.MODES.items():
            action = QtGui.QAction(translate("BendTorsion", text), menu)
            action.triggered.connect(lambda checked=False, mode=mode: _show_as(self.object, mode))
            menu.addAction(action)

    def dumps(self):
        """Nothing to save."""
        return None

    def loads(self, state):
        """Nothing to restore."""
        return None

    __getstate__ = dumps
    __setstate__ = loads

    def _settle(self) -> None:
        self.is_new = False

    def _tell_member(self, view) -> None:
        """Let a member and its plates follow each other, in the view and in the tree."""
        obj, before, self.visible = self.object, self.visible, view.Visibility
        if obj.BT_Type == "Member" and obj not in _hiding:
            member_display.follow(obj, before)
        if obj.BT_Type == "PlateSet" and obj.Member is not None:
            # A deletion done again tells of what has no view any more.
            with suppress(RuntimeError):
                obj.Member.ViewObject.signalChangeIcon()

    def _draw(self, view) -> None:
        """Labels and ribbons beside the shape, made when they are first to be seen."""
        wanted = {
            name
            for name in ("ShowMarks", "ShowPoints", "ShowFrames")
            if getattr(view, name, False) and view.Visibility
        }
        if not wanted and not hasattr(self, "beside"):
            return
        from BendTorsionWB.gui import beside_shape

        if not hasattr(self, "beside"):
            self.beside = beside_shape.holder(view)
        height = _frame_height(view)
        self.labels = beside_shape.fill(self.beside, self.object, wanted, height)


def _show_as(member, mode: str) -> None:
    with macro.recorded(member.Document):
        macro.in_window("member_display", "show_as", [member], mode)


def _frame_height(view) -> float:
    height = getattr(view, "FrameHeight", None)
    return height.Value if height is not None else 0.0


def attach(obj) -> None:
    """Give `obj` its view provider, unless it came back with one from the file.

    Files saved without a window come back without view providers and with everything hidden.
    """
    view = obj.ViewObject
    if obj.BT_Type == "PageOutlines" and obj.Document.Restoring:
        page_drawing.wait(obj)
    if isinstance(view.Proxy, ViewProvider):
        return
    if obj.Document.Restoring:
        first_view.on_open(obj.Document)
    ViewProvider(view)
    if obj.BT_Type == "PageOutlines":
        page_drawing.follow()
        page_drawing.plain(obj)
    if obj.BT_Type in APPEARANCE:
        colour, transparency = APPEARANCE[obj.BT_Type]
        view.ShapeColor = colour
        view.Transparency = transparency
    if obj.BT_Type == "Axis":
        view.LineColor = AXIS_COLOUR
    view.Visibility = _shown(obj)
    paint(obj)


def hide_when_empty(obj) -> None:
    """Hide an object whose shape is empty, because of an error, and show it again once it has one.

    FreeCAD reports a fault of its own for a visible empty shape, and would leave the old picture.
    """
    view = obj.ViewObject
    shape = getattr(obj, "Shape", None)
    if view is None or not hasattr(view, HIDDEN_BY_ERROR) or shape is None or shape.isNull():
        return
    empty = not shape.SubShapes
    if empty == view.Visibility and (empty or getattr(view, HIDDEN_BY_ERROR)):
        _hiding.append(obj)
        view.Visibility = not empty
        _hiding.remove(obj)
        setattr(view, HIDDEN_BY_ERROR, empty)
        # While FreeCAD tells of a change this spares the shape only; the picture follows later.
        QtCore.QTimer.singleShot(0, lambda at=(obj.Document.Name, obj.Name): _follow(*at))


def _follow(document: str, name: str) -> None:
    """Show or hide an object in the 3D view as its view's Visibility says."""
    found = FreeCAD.listDocuments().get(document)
    obj = found.getObject(name) if found is not None else None
    if obj is not None:
        shown = FreeCADGui.getDocument(document)
        modified = shown.Modified
        _hiding.append(obj)
        obj.Visibility = obj.ViewObject.Visibility
        obj.ViewObject.show() if obj.Visibility else obj.ViewObject.hide()
        _hiding.remove(obj)
        # The picture alone: a document that is as it was saved stays so. FreeCAD 0.20 lets no
        # script take the mark back.
        with suppress(AttributeError):
            shown.Modified = modified


def _fold(document: str, name: str) -> None:
    """Have the tree ask the object above for what is folded below it."""
    found = FreeCAD.listDocuments().get(document)
    obj = found.getObject(name) if found is not None else None
    for item in tree.parents(obj)[:1] if obj is not None else ():
        tree.ask_again(item)


def paint(obj) -> None:
    """Give plates and patterns the colours their object says, or the view's own again."""
    view, colours = obj.ViewObject, getattr(obj, "Colours", None)
    if colours is None or view is None:
        return
    # Solids and patterns have faces; colours of lines FreeCAD loses while they are hidden.
    parts = obj.Shape.SubShapes
    if len(parts) != len(colours):
        _colour_faces(obj, [])
        return
    _colour_faces(
        obj, [colour for part, colour in zip(parts, colours, strict=True) for _ in part.Faces]
    )


def _colour_faces(obj, colours: list) -> None:
    """A colour for each face, or the object's own for all when there are none. FreeCAD 1.0 and
    later keep them in materials, the first of which is the object's own."""
    view = obj.ViewObject
    if "ShapeAppearance" not in view.PropertiesList:
        view.DiffuseColor = colours or [view.ShapeColor]
    elif colours or len(view.ShapeAppearance) > 1:
        clear = view.Transparency / 100.0
        view.ShapeAppearance = [
            FreeCAD.Material(DiffuseColor=tuple(colour), Transparency=clear)
            for colour in colours or [APPEARANCE[obj.BT_Type][0]]
        ]


def _shown(obj) -> bool:
    """Whether an object is to be seen at first: of a member its plates, once it has some."""
    if obj.BT_Type in HIDDEN_AT_FIRST:
        return False
    return obj.BT_Type != "Member" or not any(
        getattr(user, "BT_Type", "") == "PlateSet" for user in obj.InList
    )
