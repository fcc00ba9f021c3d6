# SPDX-License-Identifier: LGPL-2.1-or-later
"""A task panel: fields edited with live preview, what the checks find, OK and Cancel."""

from __future__ import annotations

import time
from contextlib import suppress

import FreeCAD
import FreeCADGui

from BendTorsionWB.core.finding import Finding
from BendTorsionWB.gui import finding_words, resources
from BendTorsionWB.gui.held_commands import HeldCommands
from BendTorsionWB.gui.preview import Preview
from BendTorsionWB.gui.property_form import FLAWED
from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets
from BendTorsionWB.gui.recomputing import HeldInput, Stopped, recompute, recompute_each

translate = FreeCAD.Qt.translate
PROMPT = 150
"""Milliseconds after what is dragged or clicked until the preview is recomputed."""
DELAY = 400
"""Milliseconds after the last key press until the preview is recomputed."""
HEAVY = 1.5
"""Seconds of a preview that waits until the field is left: nobody types on meanwhile."""
SECONDS_OF = {"PlateSet": 0.25, "PageSymbol": 0.2}
"""What the plates of a member, and a page, are taken to last before a preview is measured."""
UNSHOWN = "border: 1px dashed #b26a00;"
COLOURS = {"error": "#c62828", "warning": "#b26a00", "note": "#5f7d95"}
GONE = 200
"""Milliseconds after which FreeCAD has taken a closed panel down."""
MOST_SHOWN = 8
LIGHTER = 170
"""Per cent of the lightness on a dark ground."""
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
        self.seconds: float | None = None
        self.unshown: QtWidgets.QWidget | None = None
        self.following = False
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
        self.show_findings()
        self.held = HeldCommands(self._gone)
        self.escape = EscapeInView(self.preview.document, self.reject)
        self.observer = _Closing(self)
        FreeCAD.addDocumentObserver(self.observer)
        FreeCADGui.Control.showDialog(self)
        QtWidgets.QApplication.instance().focusChanged.connect(self._focus_moved)
        self.following = True
        self._make_room()
        self._name_buttons()
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
        edited and what follows from it that were not there before: one of two may be mended."""
        own = [reason for form in self.forms for reason in form.told()]
        related = self._related()
        elsewhere = [obj for obj in related if obj not in self.preview.objects]
        told = finding_words.further_errors(related, self.preview.errors, elsewhere)
        return [*own, *self.refused.values(), *told]

    def _related(self) -> list:
        """What is edited and all that depends on it."""
        return [item for obj in self.preview.objects for item in (obj, *obj.InListRecursive)]

    def judge(self) -> None:
        """Allow OK when nothing speaks against it; the button says what does."""
        faults = self.faults()
        for button in self._buttons(QtWidgets.QDialogButtonBox.Ok):
            button.setEnabled(not faults)
            button.setToolTip("\n".join(faults))

    def _buttons(self, kind) -> list:
        """The buttons of a kind, OK or Cancel, beside the fields."""
        dock = self._dock()
        boxes = dock.findChildren(QtWidgets.QDialogButtonBox) if dock is not None else ()
        return [box.button(kind) for box in boxes if box.button(kind) is not None]

    def _name_buttons(self) -> None:
        """In the language of the window: Qt's own translations are not on every machine."""
        for button in self._buttons(QtWidgets.QDialogButtonBox.Ok):
            button.setText(translate("BendTorsion", "OK"))
        for button in self._buttons(QtWidgets.QDialogButtonBox.Cancel):
            button.setText(translate("BendTorsion", "Cancel"))

    def changed(self) -> None:
        """Recompute soon; edits that follow at once share one recompute. What takes long waits
        until the field that is typed into is left."""
        if self.closed:
            return
        self.timer.stop()
        field = self._typed_into()
        if field is not None and self.lasts() > HEAVY:
            self.unshown = field
            self.show_findings()
        else:
            self.timer.start(DELAY)

    def moved(self) -> None:
        """Recompute at once: what is dragged or clicked is seen on the way."""
        if not self.closed:
            self.timer.start(PROMPT)

    def lasts(self) -> float:
        """Seconds a preview takes: as long as the longest so far, or what so many parts may."""
        if self.seconds is not None:
            return self.seconds
        kinds = {obj.Name: getattr(obj, "BT_Type", "") for obj in self._related()}
        return sum(SECONDS_OF.get(kind, 0.0) for kind in kinds.values())

    def _typed_into(self):
        """The field of the panel that has the keyboard, or None."""
        field = QtWidgets.QApplication.focusWidget()
        if isinstance(field, QtWidgets.QLineEdit):
            above = field.parent()
            field = above if isinstance(above, QtWidgets.QAbstractSpinBox) else field
        elif not isinstance(field, QtWidgets.QAbstractSpinBox):
            return None
        return field if self.form.isAncestorOf(field) else None

    def _focus_moved(self, _, now) -> None:
        """Show what was typed once its field is left, unless for Cancel."""
        if self.closed or self.unshown is None or not isinstance(now, QtWidgets.QWidget):
            return
        if now in (self.unshown, self.unshown.findChild(QtWidgets.QLineEdit)):
            return
        if now not in self._buttons(QtWidgets.QDialogButtonBox.Cancel):
            self.timer.start(DELAY)

    def update(self) -> None:
        """Recompute and show what is found; Esc and Cancel stop it, and the panel."""
        self.timer.stop()
        started = time.process_time()
        stopped = False
        if self.lasts() > HEAVY:
            held = HeldInput(self._show_progress, self._on_cancel)
            try:
                recompute_each(self.preview.document, held.report)
            except Stopped:
                stopped = True
            finally:
                held.release()
        else:
            recompute(self.preview.document)
        if stopped:
            self.reject()
            return
        self.seconds = max(self.seconds or 0.0, time.process_time() - started)
        self._mark_unshown("")
        self.unshown = None
        self.show_findings()

    def _mark_unshown(self, style: str) -> None:
        """Mark the field that is not shown yet, unless it is marked with what is wrong."""
        # The fields of a segment go with it.
        with suppress(RuntimeError):
            if self.unshown is not None and self.unshown.styleSheet() != FLAWED:
                self.unshown.setStyleSheet(style)

    def _show_progress(self, what: str, done: int, count: int) -> None:
        words = translate("BendTorsion", "Computing {what}, {done} of {count}; Esc stops")
        self.findings.setText(words.format(what=what, done=done + 1, count=count))

    def _on_cancel(self, point) -> bool:
        """Whether a point of the screen is on Cancel."""
        buttons = self._buttons(QtWidgets.QDialogButtonBox.Cancel)
        return any(button.rect().contains(button.mapFromGlobal(point)) for button in buttons)

    def show_findings(self) -> None:
        """The findings of what is edited and of all that depends on it, errors first."""
        found = {}
        for item in self._related():
            for text in getattr(item, "Findings", ()):
                found[text] = finding_words.of_text(text)
        findings = sorted(found.values(), key=lambda one: list(COLOURS).index(one.severity))
        own = [reason for form in self.forms for reason in form.told()] + [*self.refused.values()]
        lines = [*map(_fault_line, own), *map(_line, findings[:MOST_SHOWN])]
        if len(findings) > MOST_SHOWN:
            more = translate("BendTorsion", "and {count} more").format(
                count=len(findings) - MOST_SHOWN
            )
            lines.append(more)
        if self.unshown is not None:
            words = translate(
                "BendTorsion", "Not shown yet: it takes a while; leave the field (Tab)"
            )
            lines.insert(len(own), words)
        self.findings.setText("<br>".join(lines))
        self._flag(findings)
        self._mark_unshown(UNSHOWN)
        self.judge()

    def property_of(self, finding: Finding) -> str:
        """The property a finding is about, when it names one."""
        return finding.position.removeprefix("property ")

    def _flag(self, findings) -> None:
        """Mark the fields of properties that findings are about."""
        for form in self.forms:
            labels = {obj.Label for obj in form.objects}
            own = [one for one in findings if one.severity == "error" and one.object in labels]
            reasons = {self.property_of(one): finding_words.reason(one) for one in reversed(own)}
            for name in form.fields:
                form.flag(name, reasons.get(name, ""))

    def getStandardButtons(self):
        """OK and Cancel."""
        buttons = QtWidgets.QDialogButtonBox.Ok | QtWidgets.QDialogButtonBox.Cancel
        # FreeCAD takes a number; flags of PySide2 are one, those of PySide6 have one.
        return int(getattr(buttons, "value", buttons))

    def accept(self) -> bool:
        """Keep the edits, as one undo step; not while something speaks against it."""
        if self.timer.isActive() or self.unshown is not None:
            self.update()
        if self.closed or self.faults():
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

            def narrow():
                if not FreeCADGui.Control.activeDialog():
                    window.resizeDocks([dock], [width], QtCore.Qt.Horizontal)

            # Again when the fields are gone, which may be wider than that until then.
            for pause in (0, GONE):
                QtCore.QTimer.singleShot(pause, narrow)

    def _gone(self) -> None:
        """Cancel what something else has closed; its fields are gone."""
        self.stop()
        FreeCAD.removeDocumentObserver(self.observer)
        self.preview.cancel()

    def stop(self) -> None:
        """Let no field edit anything from now on."""
        if self.following:
            QtWidgets.QApplication.instance().focusChanged.disconnect(self._focus_moved)
            self.following = False
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


def colour_of(severity: str, widget) -> str:
    """The colour of a severity, to be read beside the text of a widget: lighter where that is."""
    colour = QtGui.QColor(COLOURS[severity])
    light = widget.palette().color(QtGui.QPalette.Text).lightness() > 128
    return (colour.lighter(LIGHTER) if light else colour).name()


def _fault_line(reason: str) -> str:
    return f'<span style="color:{COLOURS["error"]}">&#9679;</span> {reason}'


def _line(finding: Finding) -> str:
    colour = COLOURS[finding.severity]
    return f'<span style="color:{colour}">&#9679;</span> {finding_words.short_line(finding)}'
