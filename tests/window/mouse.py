# SPDX-License-Identifier: LGPL-2.1-or-later
"""For scripts that run inside FreeCAD's window: the mouse in the 3D view, as Qt tells of it."""

import FreeCADGui
import steps
from PySide import QtCore, QtGui

LEFT, NONE = QtCore.Qt.LeftButton, QtCore.Qt.NoButton


def view_widget():
    """The widget of the active 3D view that gets the mouse."""
    return FreeCADGui.ActiveDocument.ActiveView.graphicsView().viewport()


def pixel_of(point):
    """Where a point of the model is drawn, in the widget's own pixels."""
    x, y = FreeCADGui.ActiveDocument.ActiveView.getPointOnScreen(*map(float, point))
    ratio = view_widget().devicePixelRatioF()
    return QtCore.QPointF(x / ratio, view_widget().height() - 1 - y / ratio)


def send(kind, at, button=NONE, held=NONE):
    """One mouse event."""
    widget = view_widget()
    screen = QtCore.QPointF(widget.mapToGlobal(at.toPoint()))
    event = QtGui.QMouseEvent(kind, at, screen, button, held, QtCore.Qt.NoModifier)
    QtGui.QApplication.sendEvent(widget, event)
    QtGui.QApplication.processEvents()


def press(at):
    """The left button goes down, where the mouse was moved to."""
    send(QtCore.QEvent.MouseMove, at)
    send(QtCore.QEvent.MouseButtonPress, at, LEFT, LEFT)


def move(start, end, count=6):
    """The mouse is moved with its left button down."""
    for k in range(1, count + 1):
        at = start + (end - start) * (k / count)
        send(QtCore.QEvent.MouseMove, at, NONE, LEFT)
        steps.settle(1)


def release(at):
    """The left button comes up."""
    send(QtCore.QEvent.MouseButtonRelease, at, LEFT, NONE)
    steps.settle(4)


def drag(start, end):
    """From one place to another."""
    press(start)
    move(start, end)
    release(end)


def click(at):
    """Press and release at one place."""
    press(at)
    release(at)


def place(axis, s, up=0.0):
    """The place at arc length s of an Axis, (x, y, z), some mm along the height above it."""
    import numpy as np

    from BendTorsionWB.core.axes.frames import frames_of
    from BendTorsionWB.objects import axis as axis_object

    value = axis_object.value(axis)
    frames = frames_of(value, axis_object.surface_value(axis), axis_object.frame_value(axis))
    at = frames.at(np.array([s]))
    return at.origin[0] + up * at.z[0]
