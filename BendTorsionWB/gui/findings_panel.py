# SPDX-License-Identifier: LGPL-2.1-or-later
"""All findings of the document in a dock; a click, or a key that makes a row the current one,
selects what it is about and goes to the place."""

from __future__ import annotations

import FreeCAD
import FreeCADGui

from BendTorsionWB.core.finding import SEVERITIES, Finding
from BendTorsionWB.gui import finding_places, finding_words, member_display
from BendTorsionWB.gui.dock import DocumentDock, shown
from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets, living
from BendTorsionWB.gui.task_panel import colour_of

translate = FreeCAD.Qt.translate
NAME = "BendTorsion_FindingsPanel"
COLUMNS = ("severity", "object", "position", "message", "value", "limit", "mend")
AROUND = 3000.0
"""Millimetres seen around a place the view goes to."""
SETTLED = 500
"""Milliseconds in which what a selection sets going takes the keyboard, if at all."""


def show(document) -> FindingsPanel:
    """Show the panel."""
    panel = shown(FindingsPanel, NAME)
    panel.soon()
    return panel


def findings_of(document) -> list[tuple[object, Finding]]:
    """Every finding with the object it was found on, errors first, each once."""
    from BendTorsionWB.objects import proxy

    found: dict[Finding, object] = {}
    for obj in document.Objects if document is not None else ():
        if "Findings" in obj.PropertiesList:
            for finding in proxy.findings_of(obj):
                found.setdefault(finding, obj)
    pairs = [(obj, finding) for finding, obj in found.items()]
    return sorted(pairs, key=lambda pair: SEVERITIES.index(pair[1].severity))


def view_of(document):
    """The 3D view of a document, brought to the front when a drawing page is; None without one."""
    shown = FreeCADGui.getDocument(document.Name)
    if hasattr(shown.ActiveView, "getCameraNode"):
        return shown.ActiveView
    views = shown.mdiViewsOfType("Gui::View3DInventor")
    if not views:
        return None
    frame = living(views[0].graphicsView)
    while frame is not None and not isinstance(frame, QtWidgets.QMdiSubWindow):
        frame = frame.parentWidget()
    if frame is not None:
        frame.mdiArea().setActiveSubWindow(frame)
    return views[0]


def go_to(document, place: FreeCAD.Vector) -> None:
    """Turn the view's middle to a place, near enough to see what is there."""
    view = view_of(document)
    if view is None:
        return
    camera = view.getCameraNode()
    direction = view.getViewDirection()
    if hasattr(camera, "height"):
        camera.height = 2.0 * AROUND
        distance = max(camera.focalDistance.getValue(), 2.0 * AROUND)
    else:
        distance = 2.0 * AROUND
    camera.focalDistance = distance
    eye = place - direction * distance
    camera.position.setValue(eye.x, eye.y, eye.z)


def _shown_for(obj) -> list:
    """The plates that are seen in place of a hidden member."""
    if getattr(obj, "BT_Type", "") != "Member" or obj.ViewObject.Visibility:
        return []
    return member_display.plates_shown(obj)


class _Rows(QtWidgets.QTableWidget):
    """A table whose keys select elsewhere, and that keeps the keyboard meanwhile: a view that comes
    before a drawing page takes it at once, FreeCAD 1.1 gives it to the view a moment later."""

    def __init__(self, columns: int):
        super().__init__(0, columns)
        self.moves = 0

    def keep_keyboard(self) -> None:
        """Take the keyboard back from whatever but the user takes it in the next moment."""
        self.moves += 1
        QtCore.QTimer.singleShot(SETTLED, self._let_go)

    def _let_go(self) -> None:
        self.moves -= 1

    def focusOutEvent(self, event):
        """Called by Qt when the keyboard goes elsewhere."""
        super().focusOutEvent(event)
        if self.moves and event.reason() == QtCore.Qt.OtherFocusReason:
            QtCore.QTimer.singleShot(0, self.setFocus)


class FindingsPanel(DocumentDock):
    """A row per finding."""

    def __init__(self):
        self.table = _Rows(len(COLUMNS))
        self.table.setEditTriggers(QtWidgets.QAbstractItemView.NoEditTriggers)
        self.table.setSelectionBehavior(QtWidgets.QAbstractItemView.SelectRows)
        self.table.verticalHeader().setDefaultSectionSize(22)
        self.table.horizontalHeader().setStretchLastSection(True)
        self.table.cellClicked.connect(lambda row, _: self.show_row(row))
        self.table.itemActivated.connect(lambda item: self.show_row(item.row()))
        self.table.currentCellChanged.connect(self._moved)
        self.found: list[tuple[object, Finding]] = []
        self.filling = False
        super().__init__(NAME, translate("BendTorsion", "Findings"), self.table)

    def refresh(self) -> None:
        """List everything found in the document."""
        self.filling = True
        try:
            self._fill()
        finally:
            self.filling = False

    def _fill(self) -> None:
        self.table.setHorizontalHeaderLabels([translate("BendTorsion", name) for name in COLUMNS])
        self.found = findings_of(self.document)
        self.table.setRowCount(len(self.found))
        for r, (_, finding) in enumerate(self.found):
            line = finding_words.line(finding)
            for c, text in enumerate(finding_words.cells(finding, COLUMNS)):
                item = QtWidgets.QTableWidgetItem(text)
                item.setToolTip(line)
                if c == 0:
                    item.setForeground(QtGui.QColor(colour_of(finding.severity, self.table)))
                self.table.setItem(r, c, item)
        self.table.resizeColumnsToContents()
        severities = [finding.severity for _, finding in self.found]
        text = translate(
            "BendTorsion", "Findings: {errors} errors, {warnings} warnings, {notes} notes"
        )
        counts = {f"{name}s": severities.count(name) for name in SEVERITIES}
        self.setWindowTitle(text.format(**counts))

    def _moved(self, row: int, column: int, before: int, _: int) -> None:
        """Go where a key moved to; a mouse that is pressed tells by its click."""
        if self.filling or row == before or QtWidgets.QApplication.mouseButtons():
            return
        if self.table.hasFocus():
            self.table.keep_keyboard()
        self.show_row(row)

    def show_row(self, row: int) -> None:
        """Select what a finding is about and go to its place."""
        if not 0 <= row < len(self.found):
            return
        obj, finding = self.found[row]
        about, place = finding_places.places_of(self.document, obj, finding)
        FreeCADGui.Selection.clearSelection()
        for item, name in about:
            FreeCADGui.Selection.addSelection(self.document.Name, item.Name, name)
            for instead in _shown_for(item):
                FreeCADGui.Selection.addSelection(self.document.Name, instead.Name)
        if place is not None:
            go_to(self.document, place)
        elif view_of(self.document) is not None:
            FreeCADGui.SendMsgToActiveView("ViewSelection")
