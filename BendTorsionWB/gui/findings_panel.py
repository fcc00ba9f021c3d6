# SPDX-License-Identifier: LGPL-2.1-or-later
"""All findings of the document in a dock; a click selects the object and goes to the place."""

from __future__ import annotations

import re

import FreeCAD
import FreeCADGui

from BendTorsionWB.core.finding import SEVERITIES, BendTorsionError, Finding
from BendTorsionWB.gui import finding_words, member_display
from BendTorsionWB.gui.dock import DocumentDock, shown
from BendTorsionWB.gui.qt import QtGui, QtWidgets
from BendTorsionWB.gui.task_panel import colour_of
from BendTorsionWB.gui.tree import LINKED_ABOVE

translate = FreeCAD.Qt.translate
NAME = "BendTorsion_FindingsPanel"
COLUMNS = ("severity", "object", "position", "message", "value", "limit", "mend")
AROUND = 3000.0
"""Millimetres seen around a place the view goes to."""
_S = re.compile(r"\bs (?:= |near )(-?[\d.]+)")
_XYZ = re.compile(r"x(?:, y, z)? = (-?[\d.]+), (?:y = )?(-?[\d.]+), (?:z = )?(-?[\d.]+)")


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


def owner(document, obj, finding: Finding) -> tuple[object, str]:
    """The object a finding is about and the sub-element of a plate it names ('' for the whole)."""
    from BendTorsionWB import make

    for plates in document.Objects:
        if getattr(plates, "BT_Type", "") == "PlateSet" and finding.object in plates.Marks:
            names = make.sub_elements(plates, finding.object, "outer")
            return plates, names[0] if names else ""
    named = [item for item in document.Objects if item.Label in finding.objects]
    return (named[0] if named else obj), ""


def place_of(obj, finding: Finding) -> FreeCAD.Vector | None:
    """Where in space a finding is, read from its position: coordinates, or arc length on the axis
    of its object; None when it names neither."""
    import numpy as np

    from BendTorsionWB.objects import axis as axis_object

    at = _XYZ.search(finding.position)
    if at:
        return FreeCAD.Vector(*map(float, at.groups()))
    at = _S.search(finding.position)
    axis = _axis_of(obj)
    if at is None or axis is None:
        return None
    try:
        core = axis_object.value(axis)
    except BendTorsionError:
        return None
    s = min(max(float(at[1]), 0.0), core.length)
    return FreeCAD.Vector(*map(float, core.position(np.array([s]))[0]))


def view_of(document):
    """The 3D view of a document, brought to the front when a drawing page is; None without one."""
    shown = FreeCADGui.getDocument(document.Name)
    if hasattr(shown.ActiveView, "getCameraNode"):
        return shown.ActiveView
    views = shown.mdiViewsOfType("Gui::View3DInventor")
    if not views:
        return None
    frame = views[0].graphicsView()
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


def _axis_of(obj):
    while obj is not None and getattr(obj, "BT_Type", "") in LINKED_ABOVE:
        obj = getattr(obj, LINKED_ABOVE[obj.BT_Type])
    kind = getattr(obj, "BT_Type", "")
    return obj.Axis if kind == "Member" else obj if kind == "Axis" else None


class FindingsPanel(DocumentDock):
    """A row per finding."""

    def __init__(self):
        self.table = QtWidgets.QTableWidget(0, len(COLUMNS))
        self.table.setHorizontalHeaderLabels([translate("BendTorsion", name) for name in COLUMNS])
        self.table.setEditTriggers(QtWidgets.QAbstractItemView.NoEditTriggers)
        self.table.setSelectionBehavior(QtWidgets.QAbstractItemView.SelectRows)
        self.table.verticalHeader().setDefaultSectionSize(22)
        self.table.horizontalHeader().setStretchLastSection(True)
        self.table.cellClicked.connect(lambda row, _: self.show_row(row))
        self.table.itemActivated.connect(lambda item: self.show_row(item.row()))
        self.found: list[tuple[object, Finding]] = []
        super().__init__(NAME, translate("BendTorsion", "Findings"), self.table)

    def refresh(self) -> None:
        """List everything found in the document."""
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

    def show_row(self, row: int) -> None:
        """Select the object of a finding and go to its place."""
        if not 0 <= row < len(self.found):
            return
        obj, finding = self.found[row]
        obj, sub = owner(self.document, obj, finding)
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(self.document.Name, obj.Name, sub)
        for item in _shown_for(obj):
            FreeCADGui.Selection.addSelection(self.document.Name, item.Name)
        place = place_of(obj, finding)
        if place is not None:
            go_to(self.document, place)
        elif view_of(self.document) is not None:
            FreeCADGui.SendMsgToActiveView("ViewSelection")
