# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: preferences, and what they do to new and to existing objects."""

import os
import sys

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps


def figures(document):
    """The numbers of a document that any preference could have changed."""
    found = {}
    for item in document.Objects:
        for name in ("Volume", "Mass", "Length", "Height", "StationSpacing", "Tolerance"):
            if name in item.PropertiesList:
                value = getattr(item, name)
                found[f"{item.Label}.{name}"] = getattr(value, "Value", value)
        for name in ("RulePack", "Mode", "Project", "Author", "SheetFormat", "Slope2"):
            if name in item.PropertiesList:
                found[f"{item.Label}.{name}"] = getattr(item, name)
        # Whatever is declared as an input, a preference of today or of later.
        inputs = item.Proxy.declared(item) if hasattr(item, "BT_Type") else ()
        for given in inputs:
            if not given.output:
                found[f"{item.Label}.{given.name} as text"] = str(getattr(item, given.name))
        if "LayerNames" in item.PropertiesList:
            found[f"{item.Label}.LayerNames"] = list(item.LayerNames)
    return found


def make_all():
    """One object of each kind as commands make them; their figures and the recorded lines."""
    from BendTorsionWB.gui import macro

    document = FreeCAD.newDocument("New")
    with macro.undo_step(document, "all"):
        surface = macro.make("make_surface", document, "Ground", "plane")
        axis = macro.make("make_axis", document, "A1", surface, [(0, 0, 0), (4000, 0, 0)])
        section = macro.make("make_section", document, "S")
        member = macro.make("make_member", document, "M1", axis, [section], [{}])
        macro.recompute()
        macro.make("add_cut", member, 2000.0)
        plates = macro.make("make_plates", document, member)
        unfold = macro.make("make_unfold", document, plates)
        macro.make("make_sheets", document, unfold)
        macro.recompute()
    console = FreeCADGui.getMainWindow().findChild(QtGui.QPlainTextEdit, "Python console")
    lines = [line[4:] for line in console.toPlainText().splitlines() if "make.make_" in line]
    made = [line[4:] for line in console.toPlainText().splitlines() if "make.add_cut" in line]
    found = figures(document)
    FreeCAD.closeDocument(document.Name)
    return {"figures": found, "lines": lines[-7:], "all": made}


def before():
    """New objects of a fresh profile, and an existing document."""
    document = FreeCAD.openDocument(os.environ["BENDTORSION_WINDOW_DOCUMENT"])
    return {"new": make_all(), "existing": figures(document)}


def changed():
    """Open FreeCAD's preferences at the page, give other values, press OK."""
    result = {}

    def fill():
        dialog = QtGui.QApplication.activeModalWidget()
        if dialog is None:
            QtCore.QTimer.singleShot(500, fill)
            return
        page = next(w for w in dialog.findChildren(QtGui.QWidget) if w.objectName() == "Height")
        result["page"] = page.parent().parent().windowTitle()
        result["texts"] = [label.text() for label in page.parent().findChildren(QtGui.QLabel)]
        field = {
            name: dialog.findChild(QtGui.QWidget, name)
            for name in (
                *("Height", "StationSpacing", "AxisTolerance", "RulePack", "Author", "Slope"),
                *("LayerCUT_OUTER", "SheetFormat", "WindowLanguage"),
            )
        }
        result["shown"] = [
            field[name].property("rawValue")
            for name in ("Height", "StationSpacing", "AxisTolerance")
        ]
        for name, value in (("Height", 750.0), ("StationSpacing", 250.0), ("AxisTolerance", 0.001)):
            field[name].setProperty("rawValue", value)
        field["RulePack"].setCurrentIndex(field["RulePack"].findData("EU"))
        field["Author"].setText("A. Detailer")
        field["Slope"].setProperty("rawValue", 4.0)
        field["LayerCUT_OUTER"].setText("10")
        field["SheetFormat"].setCurrentIndex(field["SheetFormat"].findData("A1"))
        steps.picture("preferences")
        tabs = dialog.findChildren(QtGui.QTabWidget)
        own = [tab for tab in tabs if tab.isVisible()]
        if own:
            own[0].setCurrentIndex(1)
        steps.picture("preferences_files")
        result["languages"] = [
            field["WindowLanguage"].itemText(k) for k in range(field["WindowLanguage"].count())
        ]
        dialog.findChild(QtGui.QDialogButtonBox).button(QtGui.QDialogButtonBox.Ok).click()

    QtCore.QTimer.singleShot(1500, fill)
    FreeCADGui.runCommand("BendTorsion_Preferences")
    return result


def after():
    """The existing document recomputed and new objects made with the other preferences."""
    document = next(iter(FreeCAD.listDocuments().values()))
    for item in document.Objects:
        item.touch()
    document.recompute()
    return {"existing": figures(document), "new": make_all()}


def layers():
    """Names of layers that cannot be: marked, told, and not kept."""
    from BendTorsionWB.gui import ask
    from BendTorsionWB.gui.preferences_page import OutputPage

    page = OutputPage()
    page.loadSettings()
    fields = {item.name: field for item, field in page.fields.values()}
    told, ask.warn = [], lambda text: told.append(text)
    fields["LayerPUNCH"].setText("a/b")
    fields["LayerREF"].setText("10")
    marked = [
        bool(fields[name].styleSheet()) for name in ("LayerPUNCH", "LayerREF", "LayerCUT_INNER")
    ]
    page.saveSettings()
    again = OutputPage()
    again.loadSettings()
    kept = {
        item.name: field.text()
        for item, field in again.fields.values()
        if item.name.startswith("Layer")
    }
    return {"marked": marked, "told": told, "kept": kept}


def sizes():
    """A size that cannot be, and one beyond the limit: marked, told, and not kept."""
    from BendTorsionWB.gui import ask
    from BendTorsionWB.gui.preferences_page import PreferencesPage

    page = PreferencesPage()
    page.loadSettings()
    fields = {item.name: field for item, field in page.fields.values()}
    told, ask.warn = [], lambda text: told.append(text)
    for name, text in (
        ("Height", "bf"),
        ("Breadth", "1 km"),
        ("StationSpacing", "5 mm"),
        ("Slope", "3"),
    ):
        line = fields[name].findChild(QtGui.QLineEdit)
        line.selectAll()
        line.insert(text)
    names = ("Height", "Breadth", "StationSpacing", "Slope")
    marked = [bool(fields[name].styleSheet()) for name in names]
    page.saveSettings()
    again = PreferencesPage()
    again.loadSettings()
    kept = {item.name: field.property("rawValue") for item, field in again.fields.values()}
    return {"marked": marked, "told": told, "kept": kept}


def language():
    """The other language, by the page: at once, and kept for the next start."""
    from BendTorsionWB.gui.preferences_page import OutputPage

    page = OutputPage()
    # What FreeCAD says where it was told no language, and the system's is C.
    before = FreeCADGui.getLocale
    FreeCADGui.getLocale = lambda: "C"
    page.loadSettings()
    count, general = page.language.count(), "User parameter:BaseApp/Preferences/General"
    told = FreeCAD.ParamGet(general).GetString("Language")
    page.saveSettings()
    same = FreeCAD.ParamGet(general).GetString("Language") == told
    of_c = [page.language.currentText(), count, same]
    FreeCADGui.getLocale = before
    page.loadSettings()
    labels = [label.text() for label in page.form.findChildren(QtGui.QLabel)]
    page.language.setCurrentIndex(page.language.findText("简体中文"))
    page.saveSettings()
    steps.settle()
    kept = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/General").GetString("Language")
    return {
        "now": FreeCADGui.supportedLocales()[FreeCADGui.getLocale()],
        "kept": FreeCADGui.supportedLocales()[kept],
        "word": FreeCAD.Qt.translate("BendTorsion", "Height h"),
        "of C": of_c,
        "layers": [text for text in labels if text.partition(":")[0].isupper()],
    }


steps.run(before, changed, after, layers, sizes, language)
