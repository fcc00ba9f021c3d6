# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document templates: they open cleanly, follow their spreadsheet, and can be exported."""

import sys
from pathlib import Path

import FreeCAD
import pytest

from BendTorsionWB.__main__ import main
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.document_templates import FOLDER, TITLES, new_document
from BendTorsionWB.model_files import checked_recompute

sys.path.insert(0, str(FOLDER))

import make_templates


@pytest.fixture
def opened(tmp_path):
    """open(name): a new document from that template, as a person would start it."""
    documents = []

    def call(name):
        new_document(name, tmp_path / f"{name}.FCStd")
        documents.append(FreeCAD.openDocument(str(tmp_path / f"{name}.FCStd"), hidden=True))
        return documents[-1]

    yield call
    for document in documents:
        FreeCAD.closeDocument(document.Name)


def kinds(document, kind):
    return [obj for obj in document.Objects if getattr(obj, "BT_Type", "") == kind]


def test_each_template_is_there_and_made_by_the_script():
    assert set(TITLES) == set(make_templates.TEMPLATES)
    assert {path.stem for path in FOLDER.glob("*.FCStd")} == set(TITLES)


@pytest.mark.slow
@pytest.mark.parametrize("name", TITLES)
def test_a_template_opens_cleanly_and_follows_its_spreadsheet(opened, name):
    document = opened(name)
    members = kinds(document, "Member")
    assert len(members) == (1 if name == "member" else 3)
    assert bool(kinds(document, "SheetSet")) == (name == "project")
    assert all(obj.Proxy.TYPE == obj.BT_Type for obj in document.Objects if hasattr(obj, "BT_Type"))
    for obj in document.Objects:
        if getattr(obj, "BT_Type", "") in ("Axis", "Member", "PlateSet", "Unfold"):
            obj.touch()
    assert checked_recompute(document) == ()
    before = sum(plates.Mass for plates in kinds(document, "PlateSet"))
    sheet = document.getObject("Sizes")
    assert all(sheet.get(alias).getValueAs("mm") is not None for alias, *_ in make_templates.SIZES)
    sheet.set("plate", "=20 mm")
    sheet.set("radius", "=32000 mm")
    assert checked_recompute(document) == ()
    after = sum(plates.Mass for plates in kinds(document, "PlateSet"))
    assert after > 1.2 * before > 0
    surface = kinds(document, "Surface")[0]
    assert surface.r.Value == 32000.0
    for member in members:
        middle = member.Axis.Shape.BoundBox.Center
        assert middle.Length < 32000.0 < middle.Length + 2500.0


@pytest.mark.slow
def test_the_script_makes_a_template_that_is_free_of_errors(tmp_path, monkeypatch):
    only = {"member": make_templates.TEMPLATES["member"]}
    monkeypatch.setattr(make_templates, "TEMPLATES", only)
    for folder in ("one", "two"):
        (tmp_path / folder).mkdir()
        make_templates.write(tmp_path / folder)
    first, second = (tmp_path / folder / "member.FCStd" for folder in ("one", "two"))
    assert first.read_bytes() == second.read_bytes()


def test_new_on_the_command_line(tmp_path, capsys):
    target = tmp_path / "dome.FCStd"
    assert main(["new", "--template", "member", "--out", str(target)]) == 0
    assert target.read_bytes() == (FOLDER / "member.FCStd").read_bytes()
    capsys.readouterr()
    assert main(["new", "--template", "member", "--out", str(target)]) == 2
    assert "is there already" in capsys.readouterr().err
    assert main(["new"]) == 0
    listed = capsys.readouterr().out
    assert all(name in listed for name in TITLES)
    for template, name in (("hall", "x.FCStd"), ("member", "x.txt")):
        with pytest.raises(BendTorsionError):
            new_document(template, tmp_path / name)
    assert [p.name for p in Path(tmp_path).iterdir()] == ["dome.FCStd"]
