# SPDX-License-Identifier: LGPL-2.1-or-later
"""The workbench's pages in FreeCAD's preferences: new objects, files, language."""

from __future__ import annotations

import FreeCAD
import FreeCADGui

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.patterns.layer_names import layer_names
from BendTorsionWB.core.tolerances import LARGEST_SIZE, NEAREST_STATIONS, SMALLEST_SIZE
from BendTorsionWB.gui import ask, finding_words
from BendTorsionWB.gui.preferences import LAYER_WORDS, LAYERS, OTHERS, SECTIONS, SHEETS
from BendTorsionWB.gui.property_form import FLAWED
from BendTorsionWB.gui.qt import QtWidgets
from BendTorsionWB.gui.quantity_field import QuantityField

translate = FreeCAD.Qt.translate
LEAST = 0.0001
MOST = 1000.0
"""Of numbers without a unit."""
LIMITS = {
    **{item.name: (SMALLEST_SIZE, LARGEST_SIZE) for item in SECTIONS},
    "StationSpacing": (NEAREST_STATIONS,),
}
"""Of lengths that have some, mm."""
LANGUAGES = {"en": "English", "zh-CN": "简体中文"}
"""Languages the workbench speaks, by FreeCAD's names, each in itself."""
GENERAL = "User parameter:BaseApp/Preferences/General"


class _Page:
    """FreeCAD makes one when its preferences open, and calls loadSettings and saveSettings."""

    def __init__(self, title: str):
        self.form = QtWidgets.QWidget()
        self.form.setWindowTitle(title)
        self.fields = {}
        self.layout = QtWidgets.QVBoxLayout(self.form)

    def group(self, title: str, preferences):
        """A box of fields."""
        box = QtWidgets.QGroupBox(title)
        form = QtWidgets.QFormLayout(box)
        for item in preferences:
            if item.choices:
                field = QtWidgets.QComboBox()
                for choice in item.choices:
                    field.addItem(translate("BendTorsion", choice), choice)
            elif isinstance(item.default, float):
                limits = LIMITS.get(item.name, (LEAST,)) if item.unit else (0, MOST)
                field = QuantityField(item.default, item.unit, *limits)
                if item.default < 1.0:
                    field.setProperty("decimals", 4)
                field.line.textChanged.connect(lambda _, field=field: _mark(field))
            else:
                field = QtWidgets.QLineEdit()
                field.setPlaceholderText(item.default)
            field.setObjectName(item.name)
            label = translate("BendTorsion", item.label)
            if item in LAYERS:
                label = f"{label}: {_layer_words(item)}"
            form.addRow(label, field)
            self.fields[item.name] = item, field
        self.layout.addWidget(box)

    def note(self, text: str) -> None:
        """Words below the fields."""
        label = QtWidgets.QLabel(text)
        label.setWordWrap(True)
        self.layout.addWidget(label)
        self.layout.addStretch()

    def loadSettings(self):
        """Show what is preferred now."""
        for item, field in self.fields.values():
            if item.choices:
                field.setCurrentIndex(field.findData(item.value))
            elif isinstance(item.default, float):
                field.setProperty("rawValue", item.value)
            else:
                field.setText(item.value)

    def saveSettings(self):
        """Keep what the fields hold; what cannot be is told, and the value of before stays."""
        faults = [
            f"{translate('BendTorsion', item.label)}: {field.fault()}"
            for item, field in self.fields.values()
            if isinstance(field, QuantityField) and field.fault()
        ]
        if faults:
            words = translate("BendTorsion", "Not kept: {reasons}")
            ask.warn(words.format(reasons="\n".join(faults)))
        for item, field in self.fields.values():
            if item.choices:
                item.keep(field.currentData())
            elif isinstance(item.default, float):
                item.keep(float(field.property("rawValue")))
            else:
                item.keep(field.text().strip() or item.default)


def _mark(field) -> None:
    """Mark a field that holds what cannot be read; its former value is kept then."""
    reason = field.fault()
    field.setStyleSheet(FLAWED if reason else "")
    field.setToolTip(reason)


def _layer_words(item) -> str:
    return translate("BendTorsion", LAYER_WORDS[item.default])


class PreferencesPage(_Page):
    """What new objects start with."""

    def __init__(self):
        super().__init__(translate("BendTorsion", "New objects"))
        self.group(translate("BendTorsion", "Section"), SECTIONS)
        self.group(translate("BendTorsion", "Other objects"), OTHERS)
        self.note(
            translate(
                "BendTorsion",
                "New objects start with these. Objects that are there keep their own values, and"
                " documents their results.",
            )
        )


class OutputPage(_Page):
    """What new sheets and cut files start with, and the language of the window."""

    def __init__(self):
        super().__init__(translate("BendTorsion", "Files and language"))
        box = QtWidgets.QGroupBox(translate("BendTorsion", "Window"))
        form = QtWidgets.QFormLayout(box)
        self.shown = ""
        self.language = QtWidgets.QComboBox()
        self.language.setObjectName("WindowLanguage")
        form.addRow(translate("BendTorsion", "Language of FreeCAD"), self.language)
        self.layout.addWidget(box)
        self.group(translate("BendTorsion", "Drawing sheets"), SHEETS)
        self.group(translate("BendTorsion", "Layers of cut files"), LAYERS)
        for item, field in self._layers():
            words = _layer_words(item)
            field.setToolTip(words)
            field.setAccessibleDescription(words)
            field.textChanged.connect(lambda _: self._layers_fault())
        self.note(
            translate(
                "BendTorsion",
                "New sheets and flat patterns start with these; those that are there keep their"
                " own.",
            )
        )

    def loadSettings(self):
        """With the language FreeCAD speaks now."""
        super().loadSettings()
        now = FreeCADGui.getLocale()
        # By code: FreeCAD 1.1 has other names for its languages than 0.20.
        locales = FreeCADGui.supportedLocales()
        names = {name: LANGUAGES[code] for name, code in locales.items() if code in LANGUAGES}
        if now not in locales:
            # Without a language of its own, as where the system's is C, FreeCAD speaks English.
            now = next(name for name, code in locales.items() if code == "en")
        names.setdefault(now, now)
        self.shown = now
        self.language.clear()
        for name, own in names.items():
            self.language.addItem(own, name)
        self.language.setCurrentIndex(self.language.findData(now))

    def _layers(self) -> list:
        """(preference, field) of each layer."""
        return [pair for pair in self.fields.values() if pair[0] in LAYERS]

    def _layers_fault(self) -> str:
        """Why the names of layers cannot be, marked at their fields; empty when they can."""
        lines = [f"{item.default}={field.text().strip()}" for item, field in self._layers()]
        faults = {}
        try:
            layer_names((line for line in lines if not line.endswith("=")), "")
        except BendTorsionError as problem:
            faults = {f.value: finding_words.reason(f) for f in problem.findings}
        for (item, field), line in zip(self._layers(), lines, strict=True):
            reason = faults.get(line) or faults.get(line.split("=", 1)[1].lower(), "")
            field.setStyleSheet(FLAWED if reason else "")
            field.setToolTip(reason or _layer_words(item))
        return "\n".join(faults.values())

    def saveSettings(self):
        """FreeCAD speaks the language from now on, and when it starts again. Names of layers that
        cannot be are told, and those of before stay."""
        fault = self._layers_fault()
        if fault:
            for item, field in self._layers():
                field.setText(item.value)
            ask.warn(fault)
        super().saveSettings()
        wanted = self.language.currentData()
        if wanted and wanted != self.shown:
            FreeCAD.ParamGet(GENERAL).SetString("Language", wanted)
            FreeCADGui.setLocale(wanted)
