# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files, folders and choices asked of the user; each None when the question is cancelled."""

from __future__ import annotations

import itertools
from pathlib import Path

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui.qt import QtCore, QtWidgets

translate = FreeCAD.Qt.translate


def open_file(title: str, kinds: str) -> str | None:
    """A file that is there."""
    window = FreeCADGui.getMainWindow()
    return QtWidgets.QFileDialog.getOpenFileName(window, title, "", kinds)[0] or None


def save_file(title: str, kinds: str, suffix: str, name: str = "") -> str | None:
    """A file to write, its name ending in suffix unless the user gave another one. name: the one
    proposed, numbered where there is such a file already."""
    window = FreeCADGui.getMainWindow()
    path = QtWidgets.QFileDialog.getSaveFileName(window, title, _free(name, suffix), kinds)[0]
    if path and "." not in path.rsplit("/", 1)[-1]:
        path += suffix
    return path or None


def _free(name: str, suffix: str) -> str:
    """The path of a file of that name in the user's documents that is not there yet."""
    if not name:
        return ""
    folder = QtCore.QStandardPaths.writableLocation(QtCore.QStandardPaths.DocumentsLocation)
    paths = (Path(folder) / f"{name}{k}{suffix}" for k in itertools.chain([""], itertools.count(2)))
    return str(next(path for path in paths if not path.exists()))


def folder(title: str) -> str | None:
    """A folder to write into."""
    return QtWidgets.QFileDialog.getExistingDirectory(FreeCADGui.getMainWindow(), title) or None


def choice(title: str, label: str, choices: list[str]) -> str | None:
    """One of several."""
    dialog = QtWidgets.QInputDialog(FreeCADGui.getMainWindow())
    dialog.setWindowTitle(title)
    dialog.setLabelText(label)
    dialog.setComboBoxItems(choices)
    dialog.setComboBoxEditable(False)
    dialog.setTextValue(choices[0])
    dialog.setOkButtonText(translate("BendTorsion", "OK"))
    dialog.setCancelButtonText(translate("BendTorsion", "Cancel"))
    return dialog.textValue() if answered(dialog) else None


def warn(text: str) -> None:
    """Show what could not be done, and wait until it is read."""
    window = FreeCADGui.getMainWindow()
    warning, ok = QtWidgets.QMessageBox.Warning, QtWidgets.QMessageBox.Ok
    box = QtWidgets.QMessageBox(warning, "BendTorsion", text, ok, window)
    box.button(ok).setText(translate("BendTorsion", "OK"))
    answered(box)


def offer(text: str, yes: str, no: str) -> bool:
    """Tell something and offer two ways on, the first by Enter; whether that was taken."""
    window = FreeCADGui.getMainWindow()
    question, none = QtWidgets.QMessageBox.Question, QtWidgets.QMessageBox.NoButton
    box = QtWidgets.QMessageBox(question, "BendTorsion", text, none, window)
    taken = []
    first = box.addButton(yes, QtWidgets.QMessageBox.AcceptRole)
    first.clicked.connect(lambda *_: taken.append(True))
    box.addButton(no, QtWidgets.QMessageBox.RejectRole)
    box.setDefaultButton(first)
    answered(box)
    return bool(taken)


def answered(dialog) -> int:
    """Show a dialog until it is answered; 0 when it is cancelled. It is deleted as soon as FreeCAD
    goes on."""
    try:
        return dialog.exec_() if hasattr(dialog, "exec_") else dialog.exec()
    finally:
        # The window, whose child it is, would keep it.
        dialog.deleteLater()


def tell(text: str) -> None:
    """Show what was done in the status bar for a while."""
    FreeCADGui.getMainWindow().statusBar().showMessage(text, 10000)
