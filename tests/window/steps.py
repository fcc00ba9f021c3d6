# SPDX-License-Identifier: LGPL-2.1-or-later
"""For scripts that run inside FreeCAD's window: steps in order, pictures, what the window says."""

import json
import os
import traceback
from pathlib import Path

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

PAUSE = 60


def run(*steps):
    """Work through the steps once the window is up, write what each returns as JSON, end FreeCAD.

    A step that raises is recorded under its name, so that one broken step does not hide others.
    """
    QtCore.QTimer.singleShot(0, lambda: _run(steps))


def _run(steps):
    results = {}
    try:
        _arrange_window()
        # FreeCAD asks in a message box when the workbench cannot be loaded.
        QtCore.QTimer.singleShot(20000, _refuse_box)
        FreeCADGui.activateWorkbench("BendTorsionWorkbench")
        for step in steps:
            try:
                results[step.__name__] = step()
            except Exception:  # noqa: BLE001 - the failure is the result, whatever it was
                results[step.__name__] = {"failed": traceback.format_exc()}
        results["report_view"] = report_view()
        with open(os.environ["BENDTORSION_WINDOW_RESULT"], "w", encoding="utf-8") as file:
            json.dump(results, file)
    finally:
        os._exit(0)


def _arrange_window():
    """The tree and the properties at the left, the 3D view beside them, no consoles."""
    window = FreeCADGui.getMainWindow()
    window.showNormal()
    window.setGeometry(0, 0, 1600, 1000)
    for dock in window.findChildren(QtGui.QDockWidget):
        dock.setVisible(dock.objectName() == "Combo View")
    settle()


def side():
    """The dock of the tree and the properties: FreeCAD 1.0 gave it another name, and panels another
    dock in the same place."""
    docks = FreeCADGui.getMainWindow().findChildren(QtGui.QDockWidget)
    return next(dock for dock in docks if dock.objectName() in ("Combo View", "Model"))


def narrow(width=400):
    """Give the tree and the properties a width, as a panel leaves them wide."""
    main = FreeCADGui.getMainWindow()
    main.resizeDocks([side()], [width], QtCore.Qt.Horizontal)
    tree = document_tree()
    tree.setColumnWidth(0, width - 30)
    settle(2)


def _refuse_box():
    box = QtGui.QApplication.activeModalWidget()
    if isinstance(box, QtGui.QMessageBox) and box.windowTitle().startswith("Workbench"):
        box.reject()


def settle(times=5):
    """Let the window catch up with what was done."""
    for _ in range(times):
        QtGui.QApplication.processEvents()
        QtCore.QThread.msleep(PAUSE)
    QtGui.QApplication.processEvents()


def until(holds):
    """Let the window catch up until something holds, for a second or two at most."""
    for _ in range(20):
        if holds():
            return
        settle(1)


def still(view):
    """Let the view turn to where it was told to: FreeCAD 1.0 turns it little by little."""
    before = None
    while before != view.getCamera():
        before = view.getCamera()
        settle()


def report_view():
    """The text of the Report view."""
    return FreeCADGui.getMainWindow().findChild(QtGui.QTextEdit, "Report view").toPlainText()


def picture(name):
    """The window with dialogs before it, as PNG in the folder BENDTORSION_WINDOW_PICTURES."""
    settle()
    folder = Path(os.environ["BENDTORSION_WINDOW_PICTURES"])
    folder.mkdir(parents=True, exist_ok=True)
    at = FreeCADGui.getMainWindow().frameGeometry()
    screen = QtGui.QApplication.primaryScreen()
    shown = screen.grabWindow(0, at.x(), at.y(), at.width(), at.height())
    shown.save(str(folder / f"{name}.png"))


def cut_labels(widget):
    """Texts of visible labels, buttons and boxes that have less room than they need."""
    cut = []
    for kind in (QtGui.QLabel, QtGui.QAbstractButton):
        for item in widget.findChildren(kind):
            wraps = kind is QtGui.QLabel and item.wordWrap()
            short = item.width() < item.minimumSizeHint().width()
            if item.isVisible() and item.text() and not wraps and short:
                cut.append(item.text())
    return cut


def words(widget):
    """Texts of visible labels, check boxes and group boxes."""
    kinds = (QtGui.QLabel, QtGui.QCheckBox)
    found = [w.text() for kind in kinds for w in widget.findChildren(kind) if w.isVisible()]
    found += [box.title() for box in widget.findChildren(QtGui.QGroupBox) if box.isVisible()]
    return [text for text in found if text]


def document_tree():
    """The tree of the documents; FreeCAD 1.1 has others in its window."""
    trees = FreeCADGui.getMainWindow().findChildren(QtGui.QTreeWidget)
    return next(tree for tree in trees if tree.metaObject().className() == "Gui::TreeWidget")


def drawn(obj):
    """Whether the 3D view draws the shape of an object."""
    from pivy import coin

    search = coin.SoSearchAction()
    search.setType(coin.SoSwitch.getClassTypeId())
    search.apply(obj.ViewObject.RootNode)
    return search.getPath().getTail().whichChild.getValue() >= 0


def tree_items():
    """The texts of the tree with their depth, as they stand; documents have depth 1, though from
    FreeCAD 1.0 on there is nothing above them."""
    found = [(depth, at.data()) for depth, at in tree_rows()]
    labels = {document.Label for document in FreeCAD.listDocuments().values()}
    if found and found[0][1] in labels:
        found = [(depth + 1, text) for depth, text in found]
    return found


def tree_rows(parent=None, depth=0):
    """The rows of the tree with their depth. As indices of its model: PySide keeps an item of the
    tree by its address, and gives it in place of what lives there later."""
    model = document_tree().model()
    parent = parent or QtCore.QModelIndex()
    for k in range(model.rowCount(parent)):
        at = model.index(k, 0, parent)
        yield depth, at
        yield from tree_rows(at, depth + 1)
