# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rows under another name with the very same content: told as renamed in differences, by an update
and of plates; and not where the content differs or two are alike."""

import json

import FreeCAD
import openpyxl
import pytest
from test_build import APART, schedule
from test_update import brought, edit, labels

from BendTorsionWB import project
from BendTorsionWB.document import build_document
from BendTorsionWB.document_difference import document_changes
from BendTorsionWB.exchange.difference import write_changes
from BendTorsionWB.exchange.plate_status import read_statuses
from BendTorsionWB.exchange.renames import Reference, renames
from BendTorsionWB.project import Wanted
from BendTorsionWB.round_trip import difference

EVERY = {"M1": "M7", "A1": "A7", "B500": "X500", "Hall": "Dome"}


def renamed(path, target, names):
    """The schedule with these names in place of others, on all sheets."""
    book = openpyxl.load_workbook(path)
    for sheet in book.worksheets:
        for row in sheet.iter_rows():
            for cell in row:
                cell.value = names.get(cell.value, cell.value)
    book.save(target)
    return target


@pytest.fixture
def path(tmp_path):
    return schedule(tmp_path / "two.xlsx", APART)


def pairs(changes):
    return [(c.kind, c.before, c.after) for c in changes if c.what == "renamed"]


def test_only_one_of_the_same_content_on_either_side_is_a_rename():
    surface, other = {"a": 1.0, "b": (2.0, None)}, {"a": 1.0, "b": (2.5, None)}
    gone, came = {("S", "old"): surface}, {("S", "new"): surface, ("S", "other"): other}
    assert renames(gone, came, ["S"]) == {("S", "old"): "new"}
    assert renames(gone, {**came, ("S", "twin"): surface}, ["S"]) == {}
    assert renames({**gone, ("S", "twin"): surface}, came, ["S"]) == {}
    assert renames(gone, {("S", "other"): other}, ["S"]) == {}
    # What refers to something renamed has the same content as before.
    gone["A", "one"], came["A", "two"] = ({"on": Reference("S", name)} for name in ("old", "new"))
    assert renames(gone, came, ["S", "A"])["A", "one"] == "two"
    came["A", "two"] = {"on": Reference("S", "other")}
    assert ("A", "one") not in renames(gone, came, ["S", "A"])


def test_schedules_and_documents_tell_renamed_rows_in_one_line_each(path, tmp_path):
    alone = renamed(path, tmp_path / "alone.xlsx", {"M1": "M7"})
    [change] = difference(path, alone)
    assert change.line() == "renamed, by its content: members M1 -> M7"
    assert (change.member, change.what, change.name) == ("M7", "renamed", "M7")
    every = renamed(path, tmp_path / "every.xlsx", EVERY)
    changes = difference(path, every)
    kinds = ("surfaces", "sections", "axes", "members")
    names = (("Hall", "Dome"), ("B500", "X500"), ("A1", "A7"), ("M1", "M7"))
    assert pairs(changes) == [(kind, *pair) for kind, pair in zip(kinds, names)]
    others = [c for c in changes if c.what != "renamed"]
    assert [(c.name, c.property, c.after) for c in others] == [("A2", "surface", "Dome")]
    write_changes(changes, tmp_path / "changes.json")
    assert (
        json.loads((tmp_path / "changes.json").read_text(encoding="utf-8"))[0]["what"] == "renamed"
    )
    documents = []
    try:
        for one in (path, every):
            documents.append(build_document(*project.read_jobs(one), sheets=False))
        found = document_changes(*documents)
    finally:
        for document in documents:
            FreeCAD.closeDocument(document.Name)
    kinds = ("Surface", "SectionSpec", "Axis", "Member")
    assert pairs(found) == [(kind, *pair[1:]) for kind, pair in zip(kinds, pairs(changes))]
    assert [(c.name, c.property) for c in found if c.what != "renamed"] == [("A2", "Surface")]


def test_a_renamed_member_with_another_joint_is_no_rename(path, tmp_path):
    other = edit(
        renamed(path, tmp_path / "other.xlsx", {"M1": "M7"}), {("Splits", 2, "joints"): "0.3 1"}
    )
    changes = difference(path, other)
    assert not pairs(changes)
    assert {(c.what, c.name) for c in changes} >= {("removed", "M1"), ("added", "M7")}


def test_plates_under_another_name_are_no_rename_of_a_member_that_stays(path):
    documents = [build_document(*project.read_jobs(path), sheets=False) for _ in range(2)]
    try:
        [plates] = [o for o in documents[1].Objects if o.Label == "M1 plates"]
        plates.FromSchedule, plates.Label = "", "Shell"
        changes = document_changes(*documents)
    finally:
        for document in documents:
            FreeCAD.closeDocument(document.Name)
    assert not pairs(changes)
    told = {(c.what, c.name) for c in changes if c.kind == "PlateSet"}
    assert told == {("removed", "M1 plates"), ("added", "Shell")}


def test_an_update_names_what_looks_renamed_and_removes_nothing_by_that(path, tmp_path):
    given, jobs = project.read_jobs(path)
    document = build_document(given, jobs, sheets=False)
    try:
        document.recompute()
        every = renamed(path, tmp_path / "every.xlsx", EVERY)
        update = brought(document, every)
        assert [pair[1:] for pair in pairs(update.changes)] == [
            ("Hall", "Dome"),
            ("B500", "X500"),
            ("A1", "A7"),
            ("M1", "M7"),
        ]
        [told] = [f for f in update.findings if f.object == "M1"]
        assert "M7 has the same content, as when it is renamed" in told.message
        assert {"M1", "M1 plates", "M7", "M7 plates"} <= set(labels(document))
    finally:
        FreeCAD.closeDocument(document.Name)


def test_plates_of_a_renamed_member_are_void_and_new_and_told_to_be_the_same(path, tmp_path):
    out, plain = tmp_path / "out", Wanted(model=False, sheets=False)

    def build(book, *rows):
        (tmp_path / "cut.csv").write_text(
            "plate,status\n" + "".join(f"{r}\n" for r in rows), encoding="utf-8"
        )
        statuses = read_statuses(tmp_path / "cut.csv")
        found = project.build(book, out, workers=1, wanted=plain, statuses=statuses)
        plates = (
            json.loads((out / "revision.json").read_text(encoding="utf-8"))["plates"]
            if rows
            else []
        )
        return found, {plate["mark"]: plate for plate in plates}

    build(path)
    project.issue_folder(out, "A")
    other = renamed(path, tmp_path / "r.xlsx", {"M1": "M7"})
    found, plates = build(other, "M1-T1,cut", "M7-T2,cut")
    void = {mark for mark, plate in plates.items() if plate["what"] == "void"}
    new = {mark for mark, plate in plates.items() if plate["what"] == "new"}
    assert void and new == {mark.replace("M1-", "M7-") for mark in void}
    assert plates["M1-T3"]["note"] == "the same plate as M7-T3, which is new"
    assert plates["M7-T3"]["note"] == "the same plate as M1-T3, which is void"
    told = {f.object: f for f in found.findings if f.code.startswith("cut-plate")}
    assert told["M1-T1"].severity == "warning" and set(told) == {"M1-T1", "M7-T2"}
    assert "use as it is, its mark apart: the same plate as M7-T1" in told["M1-T1"].message
    # That a plate is cut which was never issued is an error all the same.
    assert told["M7-T2"].code == "cut-plate-new" and told["M7-T2"].severity == "error"
    # With another joint it is another member: its plates are no longer needed.
    edit(other, {("Splits", 2, "joints"): "0.3 1"})
    found, plates = build(other, "M1-T1,cut", "M7-T2,cut")
    assert plates["M1-B1"]["note"] == "" == plates["M7-B1"]["note"]
    told = {f.object: f for f in found.findings if f.code.startswith("cut-plate")}
    assert "scrap: the plate is no longer needed" in told["M1-T1"].message
    assert told["M7-T2"].code == "cut-plate-new" and told["M1-T1"].severity == "error"
