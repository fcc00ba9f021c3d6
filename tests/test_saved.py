# SPDX-License-Identifier: LGPL-2.1-or-later
"""Documents saved by earlier releases, by newer ones, and by a FreeCAD without the workbench."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import FreeCAD
import pytest
from carried_document import compare, differences, figures

from BendTorsionWB.__main__ import main
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.model_files import checked_recompute
from BendTorsionWB.objects import repair, schema
from BendTorsionWB.objects.proxy import Proxy, findings_of

SAVED = Path(__file__).resolve().parent / "saved"
DOCUMENTS = sorted(SAVED.glob("*.FCStd"))
NEWEST = SAVED / f"schema_{schema.SCHEMA_VERSION}.FCStd"

WITHOUT = """
import os, sys
import FreeCAD
document = FreeCAD.openDocument(os.environ["DOCUMENT"])
ours = [obj for obj in document.Objects if hasattr(obj, "BT_Type")]
assert ours and not any(name.startswith("BendTorsionWB") for name in sys.modules)
shapes = [obj for obj in ours if obj.TypeId == "Part::FeaturePython" and obj.Shape.Faces]
document.recompute()
kept = [obj for obj in shapes if obj.Shape.Faces and obj.Shape.isValid()]
document.saveAs(os.environ["RESAVED"])
with open(os.environ["RESULT"], "w") as stream:
    stream.write(f"{len(ours)} {len(shapes)} {len(kept)}")
"""


def opened(path):
    return FreeCAD.openDocument(str(path), hidden=True)


def by_label(document):
    return {obj.Label: obj for obj in document.Objects if hasattr(obj, "BT_Type")}


def test_there_is_a_saved_document_of_every_schema():
    numbers = {int(path.stem.split("_")[1]) for path in DOCUMENTS}
    assert numbers == set(range(1, schema.SCHEMA_VERSION + 1))
    assert set(schema.STEPS) == set(range(1, schema.SCHEMA_VERSION))


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.stem)
def test_a_document_of_every_schema_has_the_figures_it_was_saved_with(path):
    assert compare(path, path.with_suffix(".json")) == []


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.stem)
def test_a_migrated_document_is_of_this_schema_and_follows_its_spreadsheet(path):
    document = opened(path)
    try:
        ours = by_label(document)
        assert {obj.SchemaVersion for obj in ours.values()} == {schema.SCHEMA_VERSION}
        section = ours["B500"]
        assert not set(schema.SIZES_OF_SCHEMA_1) & set(section.PropertiesList)
        assert dict(section.ExpressionEngine) == {"Breadth": "Sizes.breadth"}
        before = ours["M1 plates"].Mass
        document.Sizes.set("A1", "700 mm")
        assert checked_recompute(document) == ()
        assert section.Breadth.Value == 700.0 and ours["M1 plates"].Mass > 1.05 * before
    finally:
        FreeCAD.closeDocument(document.Name)


def test_expressions_of_other_objects_follow_a_renamed_size():
    document = opened(SAVED / "schema_1_sizes_by_letter.FCStd")
    try:
        section, plates = by_label(document)["B500"], by_label(document)["M1 plates"]
        plates.setExpression("StationSpacing", f"{section.Name}.Breadth * 2")
        section.addProperty("App::PropertyLength", "b")
        other = by_label(document)["B600"]
        other.setExpression("Height", "<<B500>>.b + 1 mm")
        schema._rename_in_expressions(section, "b", "Breadth")
        written = dict(other.ExpressionEngine)["Height"].replace(" ", "")
        assert written == "<<B500>>.Breadth+1mm"
        assert dict(plates.ExpressionEngine)["StationSpacing"] == f"{section.Name}.Breadth * 2"
        document.recompute()
        assert other.Height.Value == pytest.approx(611.0)
    finally:
        FreeCAD.closeDocument(document.Name)


def test_an_object_of_a_newer_schema_is_not_guessed_at():
    document = opened(NEWEST)
    try:
        member = by_label(document)["M1"]
        member.SchemaVersion = schema.SCHEMA_VERSION + 1
        member.Proxy.onDocumentRestored(member)
        assert member.SchemaVersion == schema.SCHEMA_VERSION + 1
        member.touch()
        document.recompute()
        (found,) = findings_of(member)
        assert found.code == "schema-newer" and found.limit == schema.SCHEMA_VERSION
        assert not member.Shape.Faces and not by_label(document)["M1 plates"].Shape.Faces
    finally:
        FreeCAD.closeDocument(document.Name)


@pytest.fixture(scope="module")
def resaved(tmp_path_factory):
    """A document opened and saved by FreeCAD's console program, which does not know of us."""
    folder = tmp_path_factory.mktemp("without")
    shutil.copy(NEWEST, folder / "original.FCStd")
    (folder / "script.py").write_text(WITHOUT, encoding="utf-8")
    (folder / "freecad").mkdir()
    environment = {
        **{name: value for name, value in os.environ.items() if name != "PYTHONPATH"},
        "HOME": str(folder),
        "FREECAD_USER_HOME": str(folder / "freecad"),
        "DOCUMENT": str(folder / "original.FCStd"),
        "RESAVED": str(folder / "resaved.FCStd"),
        "RESULT": str(folder / "result.txt"),
    }
    done = subprocess.run(
        ["freecadcmd", str(folder / "script.py")],
        env=environment,
        cwd=folder,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=120,
    )
    assert (folder / "result.txt").exists(), done.stdout[-2000:] + done.stderr[-2000:]
    return folder


def test_without_the_workbench_a_document_shows_its_shapes(resaved):
    ours, shapes, kept = map(int, (resaved / "result.txt").read_text(encoding="utf-8").split())
    saved = json.loads(NEWEST.with_suffix(".json").read_text(encoding="utf-8"))
    assert ours == len(saved)
    # Dome, member, plates and patterns; sections and the axis are wires.
    assert shapes == kept == 4


def test_a_document_saved_without_the_workbench_is_refused_until_it_is_repaired(resaved, tmp_path):
    path, mended = str(resaved / "resaved.FCStd"), str(tmp_path / "mended.FCStd")
    document = opened(path)
    try:
        assert len(repair.bare_objects(document)) == len(by_label(document))
        with pytest.raises(BendTorsionError) as problem:
            checked_recompute(document)
        assert {f.code for f in problem.value.findings} == {"object-bare"}
    finally:
        FreeCAD.closeDocument(document.Name)
    assert main(["repair", path, "--out", mended]) == 0
    assert compare(Path(mended), NEWEST.with_suffix(".json")) == []
    document = opened(mended)
    try:
        assert all(isinstance(obj.Proxy, Proxy) for obj in by_label(document).values())
        by_label(document)["B500"].Height = 450
        assert checked_recompute(document) == ()
        now = figures(document)
    finally:
        FreeCAD.closeDocument(document.Name)
    saved = json.loads(NEWEST.with_suffix(".json").read_text(encoding="utf-8"))
    assert differences(saved["M1 plates"], now["M1 plates"])


def test_a_whole_document_is_left_as_it_is(tmp_path, capsys):
    path = tmp_path / "whole.FCStd"
    shutil.copy(NEWEST, path)
    before = path.read_bytes()
    assert main(["repair", str(path)]) == 0
    assert path.read_bytes() == before and "nothing to repair" in capsys.readouterr().out


def test_what_no_release_knows_is_named_and_nothing_is_changed(resaved):
    document = opened(resaved / "resaved.FCStd")
    try:
        by_label(document)["M1"].BT_Type = "Membrane"
        with pytest.raises(BendTorsionError) as problem:
            repair.repair(document)
        assert [f.code for f in problem.value.findings] == ["kind-unknown"]
        assert len(repair.bare_objects(document)) == len(by_label(document))
    finally:
        FreeCAD.closeDocument(document.Name)


def test_every_kind_of_object_can_be_repaired():
    from BendTorsionWB import make  # noqa: F401 - loads every kind

    def below(kind):
        return {kind}.union(*map(below, kind.__subclasses__()))

    kinds = {kind for kind in below(Proxy) if kind.__module__.startswith("BendTorsionWB.objects.")}
    assert kinds - {Proxy} == set(repair.KINDS.values())


def test_differences_are_told():
    assert differences({"a": [1.0, "x"]}, {"a": [1.0 + 1e-7, "y"]}) == [
        ".a[0]: 1.0 became 1.0000001",
        ".a[1]: 'x' became 'y'",
    ]
    assert differences({"a": 1.0}, {"a": 1.0 + 1e-10}) == []
    assert differences({"Moments": [1.0]}, {"Moments": [1.0 + 1e-7]})
    assert not differences({"Moments": [1.0]}, {"Moments": [1.0 + 1e-7]}, anew=True)
    assert differences({"a": [1.0]}, {"a": []}) and differences({"a": 1.0}, {})


def test_the_carried_document_is_a_program_of_its_own(tmp_path):
    script = [sys.executable, str(Path(__file__).with_name("carried_document.py"))]
    subprocess.run([*script, "save", str(tmp_path / "lane")], check=True, capture_output=True)
    done = subprocess.run(
        [*script, "compare", str(tmp_path / "lane")],
        check=True,
        capture_output=True,
        encoding="utf-8",
    )
    assert "16 objects compared, 0 differ" in done.stdout
