# SPDX-License-Identifier: LGPL-2.1-or-later
"""An update of a split model leaves each member in the document it is in, with what hangs on it."""

import FreeCAD
import pytest
from test_build import APART, schedule, short
from test_hand_work import FLAGS, add_notes, has_notes, run
from test_update import edit

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.linked_documents import linked_documents
from BendTorsionWB.exchange.split_model import kept_groups, split_size
from BendTorsionWB.model_files import ModelPart, write_linked_model

THREE = (*APART, short(0.35, 0.55))
FIRST, SECOND = "model/001", "model/002"


def held(out, part):
    document = FreeCAD.openDocument(str(out / f"{part}.FCStd"), hidden=True)
    try:
        return [o.Label for o in document.Objects if getattr(o, "BT_Type", "") == "Member"]
    finally:
        FreeCAD.closeDocument(document.Name)


def parts(out):
    return [name.removesuffix(".FCStd") for name in linked_documents(out / "model.FCStd")]


def test_new_members_fill_the_last_document_and_nobody_moves(tmp_path, monkeypatch):
    from BendTorsionWB.exchange import split_model

    model = tmp_path / "model.FCStd"
    in_documents = {"001": [("M1", "M1"), ("M2", "R2")], "003": [("M5", "M5")]}
    write_linked_model([ModelPart(f"model/{n}", ("M",)) for n in in_documents], model, 2)
    (tmp_path / "model").mkdir()
    for number in in_documents:
        (tmp_path / "model" / f"{number}.FCStd").touch()
    monkeypatch.setattr(split_model, "_members", lambda path: in_documents[path.stem])
    assert split_size(model) == 2
    # M1 is gone, M2 is called R2 by hand, four are new.
    groups = kept_groups(model, ["N1", "R2", "N2", "M5", "N3", "N4"], 2)
    assert groups == {
        "model/001": ("R2",),
        "model/003": ("N1", "M5"),
        "model/004": ("N2", "N3"),
        "model/005": ("N4",),
    }
    # The row counts before the label.
    assert kept_groups(model, ["M2", "R2"], 2)["model/001"] == ("M2",)


def test_no_split_is_found_in_one_document_or_none(tmp_path):
    assert split_size(tmp_path / "none.FCStd") == 0
    (tmp_path / "damaged.FCStd").write_bytes(b"PK")
    assert split_size(tmp_path / "damaged.FCStd") == 0


def test_an_update_keeps_the_split_and_work_by_hand_wherever_it_is(tmp_path, capsys):
    path, out = schedule(tmp_path / "three.xlsx", THREE), tmp_path / "out"
    assert run(capsys, "build", path, "--out", out, "--split", 2, *FLAGS)[0] == 0
    assert parts(out) == [FIRST, SECOND]
    for part in (FIRST, SECOND):
        add_notes(out / f"{part}.FCStd")
    # The first is gone: the third stays in its own document all the same.
    edit(path, {("Sections", 3, "h"): 520}, drop=["M1"])
    code, told = run(capsys, "update", path, "--out", out, *FLAGS)
    assert code == 0 and "the model stays split by 2" in told
    assert "M1 is in the document and no longer in the schedule" in told
    assert parts(out) == [FIRST, SECOND]
    assert held(out, FIRST) == ["M1", "M2"] and held(out, SECOND) == ["M3"]
    code, told = run(capsys, "update", path, "--out", out, "--remove", *FLAGS)
    assert code == 0 and held(out, FIRST) == ["M2"] and held(out, SECOND) == ["M3"]
    assert "set-aside" not in told and not list(out.rglob("*former*"))
    # A document whose members all are gone stays with them, until they are to go.
    edit(path, drop=["M2"])
    code, told = run(capsys, "update", path, "--out", out, *FLAGS)
    assert code == 0 and "M2 is in the document and no longer in the schedule" in told
    assert parts(out) == [FIRST, SECOND] and held(out, FIRST) == ["M2"]
    assert not (out / f"{FIRST}.step").exists() and (out / f"{SECOND}.step").exists()
    code, told = run(capsys, "update", path, "--out", out, "--remove", *FLAGS)
    assert code == 0 and parts(out) == [SECOND] and held(out, SECOND) == ["M3"]
    assert has_notes(out / "model" / "001.former.FCStd") and has_notes(out / f"{SECOND}.FCStd")
    # New ones fill the document there is room in; the same again changes nothing.
    schedule(path, THREE)
    assert run(capsys, "update", path, "--out", out, *FLAGS)[0] == 0
    assert parts(out) == [SECOND, "model/003"] and held(out, SECOND) == ["M3", "M1"]
    before = {file: file.read_bytes() for file in out.rglob("*.FCStd")}
    code, told = run(capsys, "update", path, "--out", out, "--split", 2, *FLAGS)
    assert code == 0 and before == {file: file.read_bytes() for file in out.rglob("*.FCStd")}


def test_members_left_out_stay_in_their_documents(tmp_path, capsys):
    path, out = schedule(tmp_path / "three.xlsx", THREE), tmp_path / "out"
    assert run(capsys, "build", path, "--out", out, "--split", 1, *FLAGS)[0] == 0
    edit(path, {("Sections", 3, "h"): 520})
    before = (out / "model" / "001.FCStd").read_bytes(), (out / "model" / "001.step").read_bytes()
    code, _ = run(capsys, "update", path, "--out", out, "--only", "M2", *FLAGS)
    assert code == 0 and len(parts(out)) == 3
    after = (out / "model" / "001.FCStd").read_bytes(), (out / "model" / "001.step").read_bytes()
    assert before == after


def test_labels_exchanged_across_documents_are_refused_and_within_one_followed(
    tmp_path, monkeypatch
):
    """No member goes from one document to another: its row would meet the other's object."""
    from BendTorsionWB.exchange import split_model

    model = tmp_path / "model.FCStd"
    (tmp_path / "model").mkdir()
    write_linked_model([ModelPart(f"model/00{n}", ("M",)) for n in (1, 2)], model, 2)
    for number in ("001", "002"):
        (tmp_path / "model" / f"{number}.FCStd").touch()
    held = {"001": [("M1", "M3"), ("M2", "M2")], "002": [("M3", "M1")]}
    monkeypatch.setattr(split_model, "_members", lambda path: held[path.stem])
    with pytest.raises(BendTorsionError) as refused:
        kept_groups(model, ["M1", "M2", "M3"], 2)
    assert [(f.code, f.object, f.limit) for f in refused.value.findings] == [
        ("labels-exchanged", "M3", "M1"),
        ("labels-exchanged", "M1", "M3"),
    ]
    held |= {"001": [("M1", "M2"), ("M2", "M1")], "002": [("M3", "M3")]}
    assert kept_groups(model, ["M1", "M2", "M3"], 2)[FIRST] == ("M1", "M2")


def bytes_of(out, part):
    return {kind: (out / f"{part}.{kind}").read_bytes() for kind in ("FCStd", "step", "ifc")}


def test_the_first_update_after_a_build_leaves_documents_of_other_members_alone(tmp_path, capsys):
    """And writes of a member beside the changed one, whose solids come from the document, the STEP
    and IFC that a build of the same schedule writes."""
    path, out, new = schedule(tmp_path / "three.xlsx", THREE), tmp_path / "out", tmp_path / "new"
    edit(path, {("Sections", 3, "h"): 500, ("Members", 4, "section"): "B500"})
    assert run(capsys, "build", path, "--out", out, "--split", 2, *FLAGS)[0] == 0
    assert held(out, FIRST) == ["M1", "M2"]
    before = {part: bytes_of(out, part) for part in (FIRST, SECOND)}
    edit(path, {("Members", 4, "align"): "centre"})
    code, told = run(capsys, "update", path, "--out", out, *FLAGS)
    assert code == 0 and "Member M2: " in told
    assert bytes_of(out, SECOND) == before[SECOND] != {} and bytes_of(out, FIRST) != before[FIRST]
    assert run(capsys, "build", path, "--out", new, "--split", 2, *FLAGS)[0] == 0
    for kind in ("step", "ifc"):
        assert bytes_of(out, FIRST)[kind] == bytes_of(new, FIRST)[kind], kind
    # A document of the build that somebody drew in is brought up, and keeps what was drawn.
    add_notes(out / f"{SECOND}.FCStd")
    assert run(capsys, "update", path, "--out", out, *FLAGS)[0] == 0
    assert has_notes(out / f"{SECOND}.FCStd")
