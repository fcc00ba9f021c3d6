# SPDX-License-Identifier: LGPL-2.1-or-later
"""The window in other languages: every text has a translation, in the .ts and in the .qm."""

import ast
import re
import sys
from pathlib import Path

import FreeCAD  # noqa: F401 - before the objects, which need it
import pytest

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import translations  # noqa: E402

FILES = sorted(translations.FOLDER.glob("*.ts"))
SHOWN_BY = {
    *("QLabel", "QPushButton", "QCheckBox", "QGroupBox", "QAction", "setText", "setTitle"),
    *("setWindowTitle", "setToolTip", "setStatusTip", "showMessage", "addRow"),
}


def test_the_languages_shipped():
    assert [path.stem for path in FILES] == ["BendTorsion_zh-CN"]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_text_of_the_sources_is_translated(path):
    """`python3 scripts/translations.py` adds what is missing to the .ts, to be translated there."""
    texts = translations.source_texts()
    assert len(texts) > 200
    missing = translations.missing(path)
    assert not missing, "\n".join(f"{file}: {text}" for file, _, text in missing)
    # And nothing the sources no longer say.
    assert set(translations.translations(path)) == set(texts)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_figures_come_in_the_same_fields(path):
    """A translation has the fields {name:format} of its source, and the same file endings."""
    for (_, text), translated in translations.translations(path).items():
        for pattern in (r"\{[^}]*\}", r"\(\*\.\w+\)"):
            assert sorted(re.findall(pattern, translated)) == sorted(re.findall(pattern, text))


def test_the_compiled_files_are_those_of_the_sources():
    """Read by Qt, each .qm gives what its .ts says."""
    from BendTorsionWB.gui.qt import QtCore

    for path in FILES:
        translator = QtCore.QTranslator()
        assert translator.load(str(path.with_suffix(".qm")))
        for (context, text), translated in translations.translations(path).items():
            assert translator.translate(context, text) == translated


def test_writing_the_file_again_changes_nothing():
    for path in FILES:
        language = path.stem.split("_", 1)[1].replace("-", "_")
        known = translations.translations(path)
        again = translations.ts_text(language, translations.source_texts(), known)
        assert again == path.read_text(encoding="utf-8")


def test_a_new_text_is_listed_until_it_is_translated(tmp_path, monkeypatch):
    """Told with its file, unfinished in the .ts."""
    path = tmp_path / "BendTorsion_zh-CN.ts"
    source = tmp_path / "new.py"
    source.write_text('text = translate("BendTorsion", "Brand" " new & <old>")\n', encoding="utf-8")
    monkeypatch.setattr(translations, "property_texts", dict)
    monkeypatch.setattr(translations, "SOURCES", (source,))
    monkeypatch.setattr(translations, "ROOT", tmp_path)
    texts = translations.source_texts()
    assert texts == {("BendTorsion", "Brand new & <old>"): "new.py"}
    path.write_text(translations.ts_text("zh_CN", texts, {}), encoding="utf-8")
    assert translations.missing(path) == [("new.py", "BendTorsion", "Brand new & <old>")]
    known = {("BendTorsion", "Brand new & <old>"): "新 & <旧>"}
    path.write_text(translations.ts_text("zh_CN", texts, known), encoding="utf-8")
    assert translations.missing(path) == [] and translations.translations(path) == known


def test_choices_of_properties_are_among_the_words():
    """What the core names and the window shows is there to be translated."""
    from BendTorsionWB import document_templates
    from BendTorsionWB.objects import (
        assembly_bed,
        axis,
        member,
        node,
        plate_set,
        section_spec,
        surface,
        unfold,
    )

    words = {text for context, text in translations.source_texts() if context == "BendTorsion"}
    kinds = (surface.Surface, axis.Axis, section_spec.SectionSpec, member.Member)
    kinds += (plate_set.PlateSet, unfold.Unfold, node.Node, assembly_bed.AssemblyBed)
    declared = [item for kind in kinds for item in kind.PROPERTIES]
    choices = {c for item in (*declared, *member.segment_properties(1)) for c in item.choices}
    assert len(choices) > 50
    assert {choice for choice in choices if choice} - words == set()
    assert set(document_templates.TITLES.values()) <= words


# They read the English of a finding to know what it is about.
READ_ONLY = {
    ("member_panel.py", "property_of"),
    ("panels_model.py", "property_of"),
    ("member_rows.py", "faults"),
}


def test_findings_reach_the_window_by_their_words_alone():
    """Nothing but `finding_words` shows a finding: no line, message, mend, error or status."""
    faults = []
    for path in sorted((ROOT / "BendTorsionWB" / "gui").glob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        parents = {
            inner: node.name
            for node in ast.walk(tree)
            if isinstance(node, ast.FunctionDef)
            for inner in ast.walk(node)
        }
        for node in ast.walk(tree):
            if (path.name, parents.get(node)) in READ_ONLY or path.name == "finding_words.py":
                continue
            name = getattr(node, "attr", "")
            key = getattr(getattr(node, "slice", None), "value", "")
            told = isinstance(node, ast.Call) and getattr(node.func, "id", "") == "str"
            caught = told and getattr(node.args[0], "id", "") == "problem"
            if name in ("message", "mend") or key in ("message", "mend"):
                faults.append(f"{path.name}:{node.lineno}: {name or key}")
            called = getattr(node, "func", None) if isinstance(node, ast.Call) else None
            if getattr(called, "attr", "") == "line" and not node.args:
                if getattr(called.value, "id", "") != "self":
                    faults.append(f"{path.name}:{node.lineno}: line")
            if name == "Status" or (caught and _takes(tree, node, "BendTorsionError")):
                faults.append(f"{path.name}:{node.lineno}: {name or 'str(problem)'}")
    assert not faults, "\n".join(faults)


def _takes(tree, inner, error: str) -> bool:
    """Whether an expression stands where an error is caught."""
    return any(
        isinstance(node, ast.ExceptHandler)
        and inner in ast.walk(node)
        and error in ast.unparse(node.type or ast.Constant(""))
        for node in ast.walk(tree)
    )


def test_no_text_reaches_the_window_untranslated():
    """No literal words are given straight to a widget; marks like `…` and `-` may be."""
    faults = []
    for path in sorted((ROOT / "BendTorsionWB" / "gui").glob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            name = (
                getattr(node.func, "attr", getattr(node.func, "id", ""))
                if isinstance(node, ast.Call)
                else ""
            )
            for argument in node.args if name in SHOWN_BY else ():
                if isinstance(argument, ast.Constant) and re.search(
                    r"[A-Za-z]{2}", str(argument.value)
                ):
                    faults.append(f"{path.name}:{node.lineno}: {argument.value}")
    assert not faults, "\n".join(faults)
