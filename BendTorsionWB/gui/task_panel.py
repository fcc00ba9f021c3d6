# SPDX-License-Identifier: LGPL-2.1-or-later
"""A task panel: fields edited with live preview, what the checks find, OK and Cancel."""

from __future__ import annotations

import html
import time
from contextlib import suppress

import FreeCAD
import FreeCADGui

from BendTorsionWB.core.finding import BendTorsionError, Finding
from BendTorsionWB.gui import finding_words, resources, standard_buttons
from BendTorsionWB.gui.closing import Closing
from BendTorsionWB.gui.findings_box import FindingsBox
from BendTorsionWB.gui.held_commands import HeldCommands
from BendTorsionWB.gui.panel_room import GONE, PanelRoom
from BendTorsionWB.gui.preview import Preview
from BendTorsionWB.gui.property_form import FLAWED, FRAME
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
UNSHOWN = FRAME.format(style="dashed", colour="#b26a00")
COLOURS = {"error": "#c62828", "warning": "#b26a00", "note": "#5f7d95"}
MOST_SHOWN = 50
LIGHTER = 170
"""Per cent of the lightness on a dark ground."""


class TaskPanel:
    """Base of the task panels: subclasses fill `self.body` with fields and call `changed` after
    each edit of an object of `preview`."""

    def __init__(self, preview: Preview, title: str, icon: str):
        self.preview = preview
        self.form = _Form(self._name_buttons)
        self.form.setWindowTitle(title)
        self.form.setWindowIcon(QtGui.QIcon(resources.icon(icon)))
        self.body = QtWidgets.QVBoxLayout(self.form)
        self.findings = FindingsBox()
        self.forms = []
        self.refused: dict[QtWidgets.QWidget, str] = {}
        self.timer = QtCore.QTimer()
        self.timer.setSingleShot(True)
        self.timer.timeout.connect(self._due)
        self.seconds: float | None = None
        self.unshown: QtWidgets.QWidget | None = None
        self.following = False
        self.closed = False
        self.held: HeldCommands | None = None
        self.escape = None
        self.room = PanelRoom(self.form)

    def show(self) -> None:
        """Open it at the side of the window."""
        # Here, not above: the panel is known before the first 3D view is.
        from BendTorsionWB.gui.view_mouse import EscapeInView

        self.body.addWidget(self.findings)
        self.body.addStretch()
        self.show_findings()
        self.held = HeldCommands(self._gone)
        self.escape = EscapeInView(self.preview.document, self.reject)
        self.observer = Closing(self)
        FreeCAD.addDocumentObserver(self.observer)
        FreeCADGui.Control.showDialog(self)
        QtWidgets.QApplication.instance().focusChanged.connect(self._focus_moved)
        self.following = True
        self.room.widen(self.width())
        self._name_buttons()
        self.judge()
        self._take_keyboard()
        if self.room.over_view():
            # The keyboard goes back to the view once the panel has found its place.
            for pause in (0, GONE):
                QtCore.QTimer.singleShot(pause, self._take_keyboard)

    def _take_keyboard(self) -> None:
        """Give the keyboard to the first field, unless one has it."""
        now = QtWidgets.QApplication.focusWidget()
        if self.closed or (now is not None and self.form.isAncestorOf(now)):
            return
        first = self.first_field()
        if first is not None:
            first.setFocus()

    def width(self) -> int:
        """Pixels the fields ask for."""
        return self.form.sizeHint().width()

    def first_field(self):
        """The field that is typed into first, or None."""
        return next((f for form in self.forms for f in form.fields.values()), None)

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
        edited and what follows from it that were not there before: one of two may be mended.
        Errors of what is not computed yet are none: OK computes it first."""
        own = [reason for form in self.forms for reason in form.told()]
        if self.timer.isActive() or self.unshown is not None:
            return [*own, *self.refused.values()]
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
        return [box.button(kind) for box in self._boxes() if box.button(kind) is not None]

    def _name_buttons(self) -> None:
        if not self.closed:
            standard_buttons.name(*self._boxes())

    def _boxes(self) -> list:
        """What holds OK and Cancel."""
        dock = self.room.dock()
        return dock.findChildren(QtWidgets.QDialogButtonBox) if dock is not None else []

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
            self.judge()

    def moved(self) -> None:
        """Recompute at once: what is dragged or clicked is seen on the way."""
        if not self.closed:
            self.timer.start(PROMPT)
            self.judge()

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
        if now is self.unshown or self.unshown.isAncestorOf(now):
            return
        if _asked() is None and now not in self._buttons(QtWidgets.QDialogButtonBox.Cancel):
            self.timer.start(DELAY)

    def _due(self) -> None:
        """Recompute, but not behind a question, which could not be answered meanwhile."""
        if _asked() is None:
            self.update()
        else:
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
        self.findings.tell([words.format(what=what, done=done + 1, count=count)])

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
        own = [reason for form in self.forms for reason in form.told()]
        own += [line for reason in self.refused.values() for line in reason.splitlines()]
        lines = [_line("error", html.escape(reason, quote=False)) for reason in own]
        lines += [
            _line(one.severity, finding_words.short_line(one)) for one in findings[:MOST_SHOWN]
        ]
        severities = ["error"] * len(own) + [one.severity for one in findings]
        errors = lines[: severities.count("error")]
        if len(findings) > MOST_SHOWN:
            more = translate("BendTorsion", "and {count} more")
            lines.append(more.format(count=len(findings) - MOST_SHOWN))
        if self.unshown is not None and not own:
            words = translate(
                "BendTorsion", "Not shown yet: it takes a while; leave the field (Tab)"
            )
            lines.insert(len(own), words)
        self.findings.tell(lines, finding_words.counts(severities), errors)
        self._flag(findings)
        self._mark_unshown(UNSHOWN)
        self.judge()

    def tell(self, problem: BendTorsionError) -> None:
        """Say why what was asked for cannot be."""
        lines = [_line(one.severity, finding_words.short_line(one)) for one in problem.findings]
        self.findings.tell(lines, errors=lines)

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
        name = self.preview.document.Name
        finish()
        FreeCADGui.Control.closeDialog()
        FreeCADGui.getDocument(name).resetEdit()
        self.room.give_back()

    def _gone(self) -> None:
        """Cancel what something else has closed; its fields are gone."""
        self.stop()
        FreeCAD.removeDocumentObserver(self.observer)
        self.preview.cancel()
        self.room.give_back()

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


def _asked():
    """The question that waits for an answer, such as FreeCAD's whether to save; or None."""
    return QtWidgets.QApplication.activeModalWidget()


class _Form(QtWidgets.QWidget):
    """The widget FreeCAD shows."""

    def __init__(self, name_buttons):
        super().__init__()
        self.name_buttons = name_buttons

    def changeEvent(self, event):
        """Keep the names of the buttons above it."""
        if not isinstance(event, QtCore.QEvent):
            # PySide knows events by their address, and gives what lived there before.
            return
        super().changeEvent(event)
        standard_buttons.name_again(event, self.name_buttons)


def colour_of(severity: str, widget) -> str:
    """The colour of a severity, to be read beside the text of a widget: lighter where that is."""
    colour = QtGui.QColor(COLOURS[severity])
    light = widget.palette().color(QtGui.QPalette.Text).lightness() > 128
    return (colour.lighter(LIGHTER) if light else colour).name()


def _line(severity: str, told: str) -> str:
    return f'<span style="color:{COLOURS[severity]}">&#9679;</span> {told}'
