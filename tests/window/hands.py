# SPDX-License-Identifier: LGPL-2.1-or-later
"""For scripts that run inside FreeCAD's window: select, run commands, type, press, answer."""

import contextlib

import FreeCAD
import FreeCADGui
import steps
from PySide import QtCore, QtGui

SHOWN = []


def window():
    """FreeCAD's main window."""
    return FreeCADGui.getMainWindow()


def run(name, pause=5):
    """Run a command of the workbench; what it showed instead of working."""
    from BendTorsionWB.gui import command

    SHOWN.clear()
    command._show = SHOWN.append
    FreeCADGui.runCommand(f"BendTorsion_{name}")
    steps.settle(pause)
    return list(SHOWN)


def select(*items):
    """Select objects, or (object, sub-element)."""
    FreeCADGui.Selection.clearSelection()
    for item in items:
        obj, sub = item if isinstance(item, tuple) else (item, "")
        FreeCADGui.Selection.addSelection(obj.Document.Name, obj.Name, sub)


def offered(name):
    """The actions of a command of FreeCAD once it offers them: FreeCAD 1.1 looks at what is
    selected a little later."""
    actions = FreeCADGui.Command.get(name).getAction()
    for action in actions:
        steps.until(action.isEnabled)
    return actions


def trigger(name):
    """Choose a command of FreeCAD as its menu, its button or its keys do."""
    for action in offered(name):
        action.trigger()
    steps.settle(8)


def press(button):
    """Press OK or Cancel of the task panel."""
    boxes = [box for box in window().findChildren(QtGui.QDialogButtonBox) if box.isVisible()]
    boxes[0].button(getattr(QtGui.QDialogButtonBox, button)).click()
    steps.settle()


def field(name, kind=QtGui.QWidget):
    """A field of the task panel by its name."""
    return next(w for w in window().findChildren(kind, name) if w.isVisible())


def form():
    """The widget of the task panel, with its fields and what is found."""
    for widget in window().findChildren(QtGui.QLabel, "findings"):
        while not widget.windowTitle():
            widget = widget.parentWidget()
        if widget.isVisible():
            return widget
    raise LookupError("no task panel is open")


def key(widget, code, text="", modifiers=QtCore.Qt.NoModifier):
    """A key pressed in a widget."""
    for kind in (QtCore.QEvent.KeyPress, QtCore.QEvent.KeyRelease):
        event = QtGui.QKeyEvent(kind, code, modifiers, text)
        QtGui.QApplication.sendEvent(widget, event)


def retype(widget, text):
    """Select what a field holds and type over it."""
    widget.setFocus()
    line = widget if isinstance(widget, QtGui.QLineEdit) else widget.findChild(QtGui.QLineEdit)
    line.selectAll()
    for letter in text:
        key(line, 0, letter)
    steps.settle()


def answered(answer):
    """Call a function with the next dialog that is shown, as soon as it is."""

    def look():
        dialog = QtGui.QApplication.activeModalWidget()
        if dialog is None or not dialog.isVisible():
            QtCore.QTimer.singleShot(100, look)
        else:
            steps.settle(2)
            answer(dialog)

    QtCore.QTimer.singleShot(100, look)


def named(label, document=None):
    """The object with a label."""
    return (document or FreeCAD.ActiveDocument).getObjectsByLabel(label)[0]


@contextlib.contextmanager
def asked(**answers):
    """Answer the questions of `gui.ask` by name."""
    from BendTorsionWB.gui import ask

    before = {name: getattr(ask, name) for name in answers}
    for name, answer in answers.items():
        setattr(ask, name, lambda *_, answer=answer: answer)
    try:
        yield
    finally:
        for name, function in before.items():
            setattr(ask, name, function)
