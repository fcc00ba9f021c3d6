# SPDX-License-Identifier: LGPL-2.1-or-later
"""The mouse and the Esc key in a 3D view, before FreeCAD turns or selects by them; where places of
the model stand on its screen.

FreeCAD selects what is under the mouse before a callback of its scene is asked, so what is dragged
is taken from the events of the window.
"""

from __future__ import annotations

from collections.abc import Callable

import FreeCAD
import FreeCADGui
import numpy as np

from BendTorsionWB.gui.label_layer import on_screen
from BendTorsionWB.gui.qt import QtCore, QtGui, living

KIND = "Gui::View3DInventor"


def view_of(document: str):
    """The 3D view of a document by its name, or None; looked up each time, as FreeCAD crashes at
    one that was closed."""
    found = FreeCAD.listDocuments().get(document)
    views = FreeCADGui.getDocument(document).mdiViewsOfType(KIND) if found else ()
    return views[0] if views else None


class EscapeInView(QtCore.QObject):
    """Calls `escaped` when Esc is pressed in the 3D view of a document, until `stop`."""

    def __init__(self, document, escaped: Callable[[], None]):
        super().__init__()
        self.escaped = escaped
        view = view_of(document.Name)
        self.widget = living(view.graphicsView) if view is not None else None
        if self.widget is not None:
            self.widget.installEventFilter(self)

    def stop(self) -> None:
        """Leave the key to FreeCAD."""
        try:
            if self.widget is not None:
                self.widget.removeEventFilter(self)
        except RuntimeError:
            pass  # The view was closed, its widget is gone.
        self.widget = None

    def eventFilter(self, widget, event):
        """Called by Qt before the view has the event."""
        # PySide knows events by their address, and gives what lived there before.
        if not isinstance(event, QtCore.QEvent):
            return False
        if event.type() != QtCore.QEvent.KeyPress or event.key() != QtCore.Qt.Key_Escape:
            return False
        # Later: what is called takes this filter away.
        QtCore.QTimer.singleShot(0, self.escaped)
        return True


class ViewMouse(QtCore.QObject):
    """Tells `target` of what happens in the 3D view of a document: `press(at)`, `move(at, held)`,
    `release(at)`, `escape()`, with at in pixels from the lower left; an event it answers with True
    goes no further. `stop` ends it."""

    def __init__(self, document, target):
        super().__init__()
        self.target, self.document = target, document.Name
        self.widgets, self.scene = [], None
        self.escaped = False
        view = view_of(self.document)
        if view is not None:
            self.scene = view.getSceneGraph()
            frame = living(view.graphicsView)
            self.widgets = [frame, frame.viewport()] if frame is not None else []
            for widget in self.widgets:
                widget.installEventFilter(self)

    def stop(self) -> None:
        """Leave the events to FreeCAD."""
        for widget in self.widgets:
            try:
                widget.removeEventFilter(self)
                widget.unsetCursor()
            except RuntimeError:
                pass  # The view was closed, its widgets are gone.
        self.widgets = []

    def eventFilter(self, widget, event):
        """Called by Qt before the view has the event."""
        # PySide knows events by their address, and gives what lived there before.
        if not isinstance(event, QtCore.QEvent):
            return False
        kind = event.type()
        if kind in (QtCore.QEvent.KeyPress, QtCore.QEvent.ShortcutOverride):
            return event.key() == QtCore.Qt.Key_Escape and self._escape(kind)
        if len(self.widgets) < 2 or widget is not self.widgets[1]:
            return False
        if kind == QtCore.QEvent.MouseMove:
            held = bool(event.buttons() & QtCore.Qt.LeftButton)
            return bool(self.target.move(self._place(event), held))
        if kind not in (QtCore.QEvent.MouseButtonPress, QtCore.QEvent.MouseButtonRelease):
            return False
        if event.button() != QtCore.Qt.LeftButton:
            return False
        if kind == QtCore.QEvent.MouseButtonRelease:
            return bool(self.target.release(self._place(event)))
        taken = bool(self.target.press(self._place(event)))
        if taken:
            self.widgets[0].setFocus()
        return taken

    def _escape(self, kind) -> bool:
        """Whether the target takes Esc; Qt tells of one press twice, before its shortcuts and
        after, and what is taken the first time is taken the second."""
        self.escaped = self.escaped or bool(self.target.escape())
        taken = self.escaped
        if kind == QtCore.QEvent.KeyPress:
            self.escaped = False
        return taken

    def point_at(self, hand: bool) -> None:
        """Show over the view that what is under the mouse can be dragged, or not."""
        if self.widgets and hand:
            self.widgets[1].setCursor(QtGui.QCursor(QtCore.Qt.SizeAllCursor))
        elif self.widgets:
            self.widgets[1].unsetCursor()

    def pixels(self, places) -> tuple[np.ndarray, np.ndarray]:
        """`label_layer.on_screen` of places (n, 3) in this view."""
        view = view_of(self.document)
        if view is None:
            return np.zeros((len(places), 2)), np.zeros(len(places))
        size = view.getSize()
        camera, shape = view.getCameraNode(), size[0] / max(size[1], 1)
        volume = camera.getViewVolume(shape)
        if shape < 1.0:
            volume.scale(1.0 / shape)
        return on_screen(places, np.array(volume.getMatrix().getValue()), size)

    def _place(self, event) -> np.ndarray:
        """Pixels of the screen from the lower left."""
        widget = self.widgets[1]
        at = event.position() if hasattr(event, "position") else event.localPos()
        ratio = widget.devicePixelRatioF()
        return np.array([at.x() * ratio, (widget.height() - 1 - at.y()) * ratio])
