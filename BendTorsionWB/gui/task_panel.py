# SPDX-License-Identifier: LGPL-2.1-or-later
"""A task panel: fields edited with live preview, what the checks find, OK and Cancel."""

from __future__ import annotations

import json

import FreeCAD
import FreeCADGui

from BendTorsionWB.gui import resources
from BendTorsionWB.gui.held_commands import HeldCommands
from BendTorsionWB.gui.preview import Preview
from BendTorsionWB.gui.property_form import FLAWED
from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets

translate = FreeCAD.Qt.translate
DELAY = 150
"""Milliseconds after the last key press until the preview is recomputed."""
COLOURS = {"error": "#c62828", "warning": "#b26a00", "note": "#5f7d95"}
MOST_SHOWN = 8
MARGIN = 60
"""Width of what FreeCAD draws around a task panel."""


class TaskPanel:
    """Base of the task panels: subclasses fill `self.body` with fields and call `changed` after
    each edit of an object of `preview`."""

    def __init__(self, preview: Preview, title: str, icon: str):
        self.preview = preview
        self.form = QtWidgets.QWidget()
        self.form.setWindowTitle(title)
        self.form.setWindowIcon(QtGui.QIcon(resources.icon(icon)))
        self.body = QtWidgets.QVBoxLayout(self.form)
        self.findings = QtWidgets.QLabel()
        self.findings.setWordWrap(True)
        self.findings.setObjectName("findings")
        self.forms = []
        self.refused: dict[QtWidgets.QWidget, str] = {}
        self.timer = QtCore.QTimer()
        self.timer.setSingleShot(True)
        self.timer.timeout.connect(self.update)
        self.errors_before: set[str] = set()
        self.closed = False
        self.held: HeldCommands | None = None
        self.escape = None
        self.width_before = 0

    def show(self) -> None:
        """Open it at the side of the window."""
        # Here, not above: the panel is known before the first 3D view is.
        from BendTorsionWB.gui.view_mouse import EscapeInView

        self.body.addWidget(self.findings)
        self.body.addStretch()
        # What is new has no errors to be excused.
        self.errors_before = set() if self.preview.create else self._own_errors()
        self.show_findings()
        self.held = HeldCommands(self._gone)
        self.escape = EscapeInView(self.preview.document, self.reject)
        self.observer = _Closing(self)
        FreeCAD.addDocumentObserver(self.observer)
        FreeCADGui.Control.showDialog(self)
        self._make_room()
        self.judge()
        first = next((f for form in self.forms for f in form.fields.values()), None)
        if first is not None:
            first.setFocus()

    def _make_room(self) -> None:
        """Widen the side of the window when the fields do not fit."""
        dock = self._dock()
        wanted = self.form.sizeHint().width() + MARGIN
        if dock is not None and dock.width() < wanted:
            self.width_before = dock.width()
            FreeCADGui.getMainWindow().resizeDocks([dock], [wanted], QtCore.Qt.Horizontal)

    def _dock(self):
        """The dock the panel stands in, or None."""
        dock = self.form.parent()
        while dock is not None and not isinstance(dock, QtWidgets.QDockWidget):
            dock = dock.parent()
        return dock

    def watch(self, form) -> None:
        """Count a form among those that allow OK."""
        self.forms.append(form)
        form.judged = self.show_findings

    def add_form(self, form, title: str = "") -> None:
        """Add a form, in a box of its own when it has a title."""
        self.watch(form)
        if not title:
            self.body.addWidget(form)
            return
        box = QtWidgets.QGroupBox(title)
        QtWidgets.QVBoxLayout(box).addWidget(form)
        self.body.addWidget(box)

    def refuse(self, field, reason: str, sign: str = "") -> None:
        """Mark a field that stands in no form with what is wrong with it, or take the mark off."""
        self.refused.pop(field, None)
        if reason:
            self.refused[field] = reason
        field.setStyleSheet(FLAWED if reason else "")
        field.setToolTip(reason or sign)
        self.show_findings()

    def faults(self) -> list[str]:
        """What keeps the panel from OK: fields that hold what cannot be, and errors of what is
        edited that were not there before."""
        own = [reason for form in self.forms for reason in form.told()]
        return [*own, *self.refused.values(), *sorted(self._own_errors() - self.errors_before)]

    def _own_errors(self) -> set[str]:
        texts = [text for obj in self.preview.objects for text in getattr(obj, "Findings", ())]
        records = map(json.loads, texts)
        return {record["message"] for record in records if record["severity"] == "error"}

    def judge(self) -> None:
        """Allow OK when nothing speaks against it."""
        dock = self._dock()
        for box in dock.findChildren(QtWidgets.QDialogButtonBox) if dock is not None else ():
            button = box.button(QtWidgets.QDialogButtonBox.Ok)
            if button is not None:
                button.setEnabled(not self.faults())

    def changed(self) -> None:
        """Recompute soon; edits that follow at once share one recompute."""
        if not self.closed:
            self.timer.start(DELAY)

    def update(self) -> None:
        """Recompute and show what is found."""
        self.timer.stop()
        self.preview.document.recompute()
        self.show_findings()

    def show_findings(self) -> None:
        """The findings of what is edited and of all that depends on it, errors first."""
        found = {}
        for obj in self.preview.objects:
            for item in (obj, *obj.InListRecursive):
                for text in getattr(item, "Findings", ()):
                    found[text] = json.loads(text)
        records = sorted(found.values(), key=lambda record: list(COLOURS).index(record["severity"]))
        own = [reason for form in self.forms for reason in form.told()] + [*self.refused.values()]
        lines = [*map(_fault_line, own), *(_line(record) for record in records[:MOST_SHOWN])]
        if len(records) > MOST_SHOWN:
            more = translate("BendTorsion", "and {count} more").format(
                count=len(records) - MOST_SHOWN
            )
            lines.append(more)
        self.findings.setText("<br>".join(lines))
        self._flag(records)
        self.judge()

    def property_of(self, record: dict) -> str:
        """The property a finding is about, when it names one."""
        return record["position"].removeprefix("property ")

    def _flag(self, records) -> None:
        """Mark the fields of properties that findings are about."""
        for form in self.forms:
            labels = {obj.Label for obj in form.objects}
            own = [
                record
                for record in records
                if record["severity"] == "error" and record["object"] in labels
            ]
            reasons = {
                self.property_of(record): f"{record['message']}. {record['mend']}"
                for record in reversed(own)
            }
            for name in form.fields:
                form.flag(name, reasons.get(name, ""))

    def getStandardButtons(self):
        """OK and Cancel."""
        buttons = QtWidgets.QDialogButtonBox.Ok | QtWidgets.QDialogButtonBox.Cancel
        # FreeCAD takes a number; flags of PySide2 are one, those of PySide6 have one.
        return int(getattr(buttons, "value", buttons))

    def accept(self) -> bool:
        """Keep the edits, as one undo step; not while something speaks against it."""
        if self.timer.isActive():
            self.update()
        if self.faults():
            self.show_findings()
            return False
        self._end(self.preview.accept)
        return True

    def reject(self) -> bool:
        """Take everything back."""
        self._end(self.preview.cancel)
        return True

    def _end(self, finish) -> None:
        if self.closed:
            return
        self.stop()
        FreeCAD.removeDocumentObserver(self.observer)
        name, dock = self.preview.document.Name, self._dock()
        finish()
        FreeCADGui.Control.closeDialog()
        FreeCADGui.getDocument(name).resetEdit()
        if dock is not None and self.width_before:
            # As wide as the user has it, once the panel is gone.
            window, width = FreeCADGui.getMainWindow(), self.width_before
            QtCore.QTimer.singleShot(
                0, lambda: window.resizeDocks([dock], [width], QtCore.Qt.Horizontal)
            )

    def _gone(self) -> None:
        """Cancel what something else has closed; its fields are gone."""
        self.stop()
        FreeCAD.removeDocumentObserver(self.observer)
        self.preview.cancel()

    def stop(self) -> None:
        """Let no field edit anything from now on."""
        self.closed = True
        self.timer.stop()
        if self.held is not None:
            self.held.release()
        if self.escape is not None:
            self.escape.stop()
        for form in self.forms:
            form.ended = True


class _Closing:
    """Closes the panel with its document, and with the object it edits."""

    def __init__(self, panel: TaskPanel):
        self.panel = panel

    def slotDeletedDocument(self, document):
        """Called by FreeCAD before a document goes."""
        panel = self.panel
        if document == panel.preview.document and not panel.closed:
            panel.stop()
            FreeCADGui.Control.closeDialog()
            QtCore.QTimer.singleShot(0, lambda: FreeCAD.removeDocumentObserver(self))

    def slotDeletedObject(self, obj):
        """Called by FreeCAD before an object goes, also when the panel itself takes it back."""
        panel = self.panel
        if panel.closed or obj not in panel.preview.objects:
            return
        panel.stop()
        QtCore.QTimer.singleShot(0, self._object_gone)

    def _object_gone(self) -> None:
        panel = self.panel
        panel.closed = False
        panel._end(panel.preview.leave)


def _fault_line(reason: str) -> str:
    return f'<span style="color:{COLOURS["error"]}">&#9679;</span> {reason}'


def _line(record: dict) -> str:
    text = f"{record['object']}: {record['message']}"
    value, limit = record.get("value"), record.get("limit")
    if isinstance(value, float) and isinstance(limit, float):
        text += f" ({value:.5g} / {limit:.5g} {record['unit']})"
    if record["mend"]:
        text += f" &rarr; {record['mend']}"
    return f'<span style="color:{COLOURS[record["severity"]]}">&#9679;</span> {text}'
