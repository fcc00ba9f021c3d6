# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document templates: they open cleanly, follow their spreadsheet, and can be exported."""

import sys
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import FreeCAD
import pytest

from BendTorsionWB.__main__ import main
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.document_templates import FOLDER, TITLES, new_document
from BendTorsionWB.model_files import checked_recompute
from BendTorsionWB.objects.proxy import findings_of
from BendTorsionWB.objects.schema import SCHEMA_VERSION

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


@pytest.mark.parametrize("name", TITLES)
def test_a_template_opens_cleanly_and_follows_its_spreadsheet(opened, name):
    document = opened(name)
    members = kinds(document, "Member")
    assert len(members) == (1 if name == "member" else 3)
    assert bool(kinds(document, "SheetSet")) == (name == "project")
    assert bool(kinds(document, "ArrangementSet")) == (name == "project")
    for obj in document.Objects:
        if hasattr(obj, "BT_Type"):
            assert (obj.Proxy.TYPE, obj.SchemaVersion) == (obj.BT_Type, SCHEMA_VERSION)
    pages = [obj for obj in document.Objects if obj.isDerivedFrom("TechDraw::DrawPage")]
    assert bool(pages) == (name == "project")
    for obj in document.Objects:
        if getattr(obj, "BT_Type", "") in ("Axis", "Member", "PlateSet", "Unfold"):
            obj.touch()
    assert checked_recompute(document) == ()
    # An example teaches nothing by warnings.
    ours = [obj for obj in document.Objects if "Findings" in obj.PropertiesList]
    found = [finding for obj in ours for finding in findings_of(obj)]
    assert [finding.line() for finding in found if finding.severity != "note"] == []
    before = sum(plates.Mass for plates in kinds(document, "PlateSet"))
    sheet = document.getObject("Sizes")
    assert all(sheet.get(alias).getValueAs("mm") is not None for alias, *_ in make_templates.SIZES)
    given = {"plate": 20, "radius": 32000, "height": 640, "breadth": 540, "end_height": 480}
    for alias, value in (given | {"spacing": 3500, "camber": 50}).items():
        sheet.set(alias, f"={value} mm")
    assert checked_recompute(document) == ()
    after = sum(plates.Mass for plates in kinds(document, "PlateSet"))
    assert after > 1.2 * before > 0
    surface = kinds(document, "Surface")[0]
    assert surface.r.Value == 32000.0
    for member in members:
        middle = member.Axis.Shape.BoundBox.Center
        assert middle.Length < 32000.0 < middle.Length + 2500.0
        assert member.OffsetZ.Value == 50.0
    places = [member.Axis.RuleOrigin.x for member in members]
    assert places == ([0.0] if name == "member" else [-3500.0, 0.0, 3500.0])
    for own in kinds(document, "SectionSpec"):
        assert (own.Thickness.Value, own.Breadth.Value) == (20.0, 540.0)
        assert own.Height.Value == (480.0 if own.Label == "Tip" else 640.0)


def test_the_script_makes_a_template_that_is_free_of_errors(tmp_path, monkeypatch):
    only = {"member": make_templates.TEMPLATES["member"]}
    monkeypatch.setattr(make_templates, "TEMPLATES", only)
    for folder in ("one", "two"):
        (tmp_path / folder).mkdir()
        make_templates.write(tmp_path / folder)
    first, second = (tmp_path / folder / "member.FCStd" for folder in ("one", "two"))
    assert first.read_bytes() == second.read_bytes()
    # The one in the repository was made with the properties objects have today.
    kept = saved_properties(FOLDER / "member.FCStd")
    assert kept == saved_properties(first) and "BT_Type" in kept["Axis"]


def saved_properties(path):
    """Names of the properties a file holds, by object; those FreeCAD's own kinds have differ from
    release to release and are told without a group."""
    with zipfile.ZipFile(path) as archive:
        root = ElementTree.fromstring(archive.read("Document.xml"))
    return {
        item.get("name"): sorted(
            own.get("name") for own in item.iter("Property") if own.get("group") is not None
        )
        for item in root.find("ObjectData")
    }


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
