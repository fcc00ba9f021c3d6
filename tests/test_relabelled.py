# SPDX-License-Identifier: LGPL-2.1-or-later
"""A member under another label in the document is the same member: written back, compared, brought
up to the schedule written of it, with what hangs on it by hand."""

import FreeCAD
import pytest
from test_build import APART, schedule
from test_update import brought, edit, labels, of_label

from BendTorsionWB import project
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.document import build_document, equal_labels
from BendTorsionWB.document_difference import document_changes
from BendTorsionWB.document_update import Update
from BendTorsionWB.round_trip import difference, write_back

FOLLOWING = ("plates", "patterns", "bed")


@pytest.fixture
def path(tmp_path):
    return schedule(tmp_path / "two.xlsx", APART)


def told(changes):
    return [(c.what, c.kind, c.before, c.after) for c in changes]


def test_a_relabelled_member_is_itself_in_the_schedule_written_of_it(made, path, tmp_path):
    member = of_label(made, "M1", "Member")
    mirror = made.addObject("Part::Mirroring", "Mirror")
    mirror.Source = of_label(made, "M1 plates", "PlateSet")
    member.Label = "R1"
    made.recompute()
    back = tmp_path / "back.xlsx"
    assert write_back(made, back) == ()
    assert told(difference(path, back)) == [("renamed", "members", "M1", "R1")]
    given, jobs = project.read_jobs(back)
    anew = build_document(given, jobs, sheets=False)
    try:
        assert document_changes(made, anew) == () == document_changes(anew, made)
    finally:
        FreeCAD.closeDocument(anew.Name)
    first = build_document(*project.read_jobs(path), sheets=False)
    try:
        [change] = document_changes(first, made)
        assert change.line() == "renamed, by its label: Member M1 -> R1 (members R1)"
    finally:
        FreeCAD.closeDocument(first.Name)
    names = {obj.Name for obj in made.Objects}
    update = brought(made, back, removing=True)
    assert [c.line() for c in update.changes] == ["renamed, by its label: Member M1 -> R1"]
    assert not update.findings and {obj.Name for obj in made.Objects} == names
    assert not [label for label in labels(made) if label.startswith("M1")]
    assert {f"R1 {rest}" for rest in FOLLOWING} <= set(labels(made))
    assert of_label(made, "R1", "Member") == member and mirror.Source.Member == member
    again = brought(made, back)
    assert not again.changes and not again.findings
    made.recompute()
    assert all(obj.Status == "ok" for obj in made.Objects if hasattr(obj, "Status"))


def test_a_label_by_hand_does_not_outdo_a_row_of_the_name(made, path, tmp_path):
    """The schedule still has the row: the label goes back; and a row of its own is another one."""
    member = of_label(made, "M1", "Member")
    member.Label = "M2x"
    update = brought(made, path)
    assert [(c.property, c.after) for c in update.changes] == [("Label", "M1")]
    assert member.Label == "M1"


def test_axis_section_and_surface_under_other_labels_are_themselves_too(made, path, tmp_path):
    for kind, was, now in (
        ("Axis", "A1", "Ridge"),
        ("SectionSpec", "B500", "Heavy"),
        ("Surface", "Hall", "Dome"),
    ):
        of_label(made, was, kind).Label = now
    made.recompute()
    back = tmp_path / "back.xlsx"
    assert write_back(made, back) == ()
    count = len(made.Objects)
    update = brought(made, back)
    assert {c.line().partition(" (")[0] for c in update.changes} == {
        "renamed, by its label: Axis A1 -> Ridge",
        "renamed, by its label: SectionSpec B500 -> Heavy",
        "renamed, by its label: Surface Hall -> Dome",
    }
    assert len(made.Objects) == count and not update.findings


def test_nodes_follow_the_label_of_their_members(tmp_path):
    from test_node_objects import schedule as crossing

    given, jobs = project.read_jobs(crossing(tmp_path / "s.xlsx"))
    document = build_document(given, jobs, sheets=False)
    try:
        document.recompute()
        [node] = [obj for obj in document.Objects if getattr(obj, "BT_Type", "") == "Node"]
        of_label(document, "M2", "Member").Label = "R2"
        document.recompute()
        back = tmp_path / "back.xlsx"
        assert write_back(document, back) == ()
        update = brought(document, back)
        assert [c.what for c in update.changes] == ["renamed"] and not update.findings
        assert [o for o in document.Objects if getattr(o, "BT_Type", "") == "Node"] == [node]
    finally:
        FreeCAD.closeDocument(document.Name)


def test_sheets_go_with_their_member_and_follow_its_label_whichever_files_are_wanted(path):
    """Also where the update makes no sheets: those of a member whose row is gone were left behind,
    in error."""
    given, jobs = project.read_jobs(path)
    document = build_document(given, jobs)
    try:
        kept = of_label(document, "M1 sheets", "SheetSet")
        edit(path, drop=["M2"])
        for removing in (False, True):
            given, jobs = project.read_jobs(path)
            template = build_document(given, jobs, sheets=False)
            update = Update(removing)
            update.bring(document, template, sheets=False)
            FreeCAD.closeDocument(template.Name)
            names = labels(document)
            if not removing:
                [finding] = [f for f in update.findings if f.object == "M2"]
                assert "M2 sheets" in finding.message and "M2 sheets" in names
        assert not [name for name in names if name.startswith("M2")]
        assert kept.Unfold is not None and "general arrangement" in names
        of_label(document, "M1", "Member").Label = "R1"
        for sheet in ("Members", "Splits"):
            edit(path, {(sheet, row, "member"): "R1" for row in rows_of(path, sheet, "M1")})
        update = brought(document, path)
        assert not update.findings and kept.Label == "R1 sheets"
    finally:
        FreeCAD.closeDocument(document.Name)


def test_sheets_of_nodes_go_with_the_last_node_and_nothing_is_in_error(tmp_path):
    from test_node_objects import schedule as crossing

    path = crossing(tmp_path / "s.xlsx")
    document = build_document(*project.read_jobs(path))
    try:
        document.recompute()
        assert any(o.BT_Type == "NodeSheets" for o in document.Objects if hasattr(o, "BT_Type"))
        update = brought(document, edit(path, drop=["M2"]), removing=True)
        document.recompute()
        kinds = {o.BT_Type for o in document.Objects if hasattr(o, "BT_Type")}
        assert not update.findings and not kinds & {"Node", "NodeSheets"}
        assert {"SheetSet", "ArrangementSet"} <= kinds
        faults = {o.Label: o.Status for o in document.Objects if hasattr(o, "Status")}
        assert set(faults.values()) == {"ok"}, faults
    finally:
        FreeCAD.closeDocument(document.Name)


def test_what_the_shop_has_cut_follows_the_label_of_its_member(path, tmp_path):
    import openpyxl

    book = openpyxl.load_workbook(path)
    sheet = book.create_sheet("Status")
    for row in (("plate", "status"), ("M1-T1", "cut"), ("M2-T1", "cut")):
        sheet.append(row)
    book.save(path)
    given, jobs = project.read_jobs(path)
    document = build_document(given, jobs, sheets=False)
    back = tmp_path / "back.xlsx"
    try:
        of_label(document, "M1", "Member").Label = "R1"
        document.recompute()
        assert write_back(document, back) == ()
    finally:
        FreeCAD.closeDocument(document.Name)
    rows = openpyxl.load_workbook(back)["Status"].iter_rows(min_row=2, max_col=2, values_only=True)
    assert set(rows) == {("R1-T1", "cut"), ("M2-T1", "cut")}
    assert told(difference(path, back)) == [("renamed", "members", "M1", "R1")]


def rows_of(path, sheet, member):
    import openpyxl

    rows = openpyxl.load_workbook(path)[sheet].iter_rows(values_only=True)
    return [number for number, row in enumerate(rows, start=1) if row[0] == member]


def exchange(document, *pairs):
    """Give objects each other's labels, as the property editor lets a user."""
    with equal_labels():
        for kind, one, other in pairs:
            own = of_label(document, one, kind), of_label(document, other, kind)
            own[0].Label, own[1].Label = other, one


@pytest.mark.parametrize("kind, one, other", [("Member", "M1", "M2"), ("Axis", "A1", "A2")])
def test_exchanged_labels_are_renames_and_no_row_reaches_the_other_object(
    made, path, tmp_path, kind, one, other
):
    mirror = made.addObject("Part::Mirroring", "Mirror")
    mirror.Source = of_label(made, "M1 plates", "PlateSet")
    before = of_label(made, one, kind)
    length = of_label(made, "M1", "Member").Axis.Length.Value
    exchange(made, (kind, one, other))
    made.recompute()
    back = tmp_path / "back.xlsx"
    assert write_back(made, back) == ()
    names = {obj.Name for obj in made.Objects}
    # As it is now the document is what was written of it; and against the first it is renamed.
    anew = build_document(*project.read_jobs(back), sheets=False)
    first = build_document(*project.read_jobs(path), sheets=False)
    try:
        assert document_changes(made, anew) == () == document_changes(anew, made)
        changes = document_changes(first, made)
        assert {(c.what, c.before, c.after) for c in changes} == {
            ("renamed", one, other),
            ("renamed", other, one),
        }
    finally:
        FreeCAD.closeDocument(anew.Name)
        FreeCAD.closeDocument(first.Name)
    update = brought(made, back, removing=True)
    assert {c.line().partition(" (")[0] for c in update.changes} == {
        f"renamed, by its label: {kind} {one} -> {other}",
        f"renamed, by its label: {kind} {other} -> {one}",
    }
    assert not update.findings and {obj.Name for obj in made.Objects} == names
    assert before.Label == other == before.FromSchedule
    plates = mirror.Source
    assert plates.Label == ("M2 plates" if kind == "Member" else "M1 plates")
    assert plates.Member.Axis.Length.Value == pytest.approx(length)
    again = brought(made, back)
    assert not again.changes and not again.findings
    made.recompute()
    assert all(obj.Status == "ok" for obj in made.Objects if hasattr(obj, "Status"))


def test_exchanged_labels_go_back_where_the_schedule_is_as_it_was(made, path):
    exchange(made, ("Member", "M1", "M2"))
    update = brought(made, path)
    assert {(c.property, c.before, c.after) for c in update.changes} == {
        ("Label", "M2", "M1"),
        ("Label", "M1", "M2"),
    }
    assert not brought(made, path).changes


def test_labels_handed_on_from_one_to_the_next_are_followed(made, path, tmp_path):
    """M1 is M2 now, and what was M2 is M5."""
    objects = [of_label(made, name, "Member") for name in ("M1", "M2")]
    objects[1].Label = "M5"
    objects[0].Label = "M2"
    made.recompute()
    back = tmp_path / "back.xlsx"
    assert write_back(made, back) == ()
    update = brought(made, back, removing=True)
    assert {c.line() for c in update.changes} == {
        "renamed, by its label: Member M1 -> M2",
        "renamed, by its label: Member M2 -> M5",
    }
    assert [obj.FromSchedule for obj in objects] == ["M2", "M5"]


def test_exchanged_labels_with_rows_changed_as_well_are_refused_by_name(made, path):
    """Neither way is any of the two as its row, so neither may get the other's."""
    exchange(made, ("Member", "M1", "M2"))
    add_column(path, "Members", "roll")
    edit(path, {("Members", row, "roll"): 5 for row in (2, 4)})
    labelled, opened = labels(made), {*FreeCAD.listDocuments()}
    with pytest.raises(BendTorsionError) as refused:
        brought(made, path)
    for name in {*FreeCAD.listDocuments()} - opened:
        FreeCAD.closeDocument(name)
    assert {(f.code, f.object) for f in refused.value.findings} == {
        ("labels-exchanged", "M1"),
        ("labels-exchanged", "M2"),
    }
    assert labels(made) == labelled


def add_column(path, sheet, heading):
    import openpyxl

    book = openpyxl.load_workbook(path)
    book[sheet].cell(1, book[sheet].max_column + 1, heading)
    book.save(path)


def test_sections_exchanged_with_their_members_are_followed(made, path, tmp_path):
    exchange(made, ("SectionSpec", "B600", "B500"), ("Member", "M1", "M2"))
    heavy = of_label(made, "B500", "SectionSpec")
    made.recompute()
    back = tmp_path / "back.xlsx"
    assert write_back(made, back) == ()
    update = brought(made, back)
    assert {c.what for c in update.changes} == {"renamed"} and len(update.changes) == 4
    assert heavy.Height.Value == 600.0 and heavy.FromSchedule == "B500"
