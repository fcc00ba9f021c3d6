# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the window's tables read and write, without a window: rows of members, joints, segments."""

import FreeCAD
import Part
import pytest

from BendTorsionWB import make
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.gui import member_rows
from BendTorsionWB.gui.joint_words import joints_text, parse_joints, set_joints
from BendTorsionWB.gui.row_table import block_of


@pytest.fixture
def document():
    """A member of three segments on a plane with plates."""
    made = FreeCAD.newDocument("Rows")
    ground = make.make_surface(made, "Ground", "plane")
    axis = make.make_axis(made, "A1", ground, [(0, 0, 0), (12000, 0, 0)])
    sections = [make.make_section(made, f"B{h}", h=h, b=500, t=12) for h in (500, 700)]
    used = [sections[0], sections[1], sections[0]]
    segments = [{}, {"cut": 4000}, {"cut_ratio": 0.75}]
    member = make.make_member(made, "M1", axis, used, segments)
    make.make_plates(made, member, {"top": [0.5], "left": "auto"})
    made.recompute()
    yield made
    FreeCAD.closeDocument(made.Name)


def column(name):
    """The number of a column."""
    return member_rows.COLUMNS.index(name)


def apply(edits):
    """Do what the table does."""
    for obj, name, value in edits:
        setattr(obj, name, value)


def test_rows_show_what_the_schedule_would_say(document):
    """Cuts in mm or per cent, joints as typed, cells without a meaning locked."""
    rows = member_rows.rows_of(document)
    assert [row.text("cut") for row in rows] == ["", "4000", "75%"]
    assert [row.text("section") for row in rows] == ["B500", "B700", "B500"]
    assert [rows[0].text(face) for face in member_rows.FACES] == ["0.5", "", "auto", ""]
    assert rows[0].is_locked("cut") and not rows[1].is_locked("cut")
    assert rows[1].is_locked("top") and not rows[0].is_locked("top")


def test_every_open_cell_can_be_written_back_as_it_is(document):
    """Text of a cell, read as an edit, changes nothing."""
    rows = member_rows.rows_of(document)
    before = [[row.text(name) for name in member_rows.COLUMNS] for row in rows]
    cells = {
        (r, c): before[r][c]
        for r, row in enumerate(rows)
        for c, name in enumerate(member_rows.COLUMNS)
        if not row.is_locked(name)
    }
    edits, reasons = member_rows.edits_of(rows, cells)
    assert reasons == {}
    apply(edits)
    assert [[row.text(name) for name in member_rows.COLUMNS] for row in rows] == before


def test_faces_of_one_row_keep_each_other_automatic(document):
    """`auto` on two faces in one paste, and taken off a third."""
    rows = member_rows.rows_of(document)
    cells = {(0, column("top")): "auto", (0, column("right")): "auto", (0, column("left")): "6000"}
    edits, reasons = member_rows.edits_of(rows, cells)
    apply(edits)
    assert reasons == {}
    assert [rows[0].text(face) for face in member_rows.FACES] == ["auto", "", "6000", "auto"]


@pytest.mark.parametrize(
    ("name", "row", "text", "reason"),
    [
        ("section", 0, "B900", "no section 'B900'"),
        ("cut", 1, "-5", "behind the start"),
        ("cut", 1, "120%", "between 0% and 100%"),
        ("cut", 1, "nan", "cannot be read"),
        ("cut", 1, "1,200", "can mean 1200 or 1.2"),
        ("cut", 1, "4 m 500 mm", "no sign between two values"),
        ("cut", 1, "5 kg", "another unit"),
        ("slope", 1, "2.5 mm", "a number alone"),
        ("offset_z", 0, "= 5 mm", "for the panel of the object"),
        ("slope", 1, "-1", "0 or more"),
        ("align", 0, "middle", "none of centre"),
        ("offset_y", 0, "ten", "cannot be read"),
        ("top", 0, "4000 3000", "must rise"),
        ("top", 0, "0.5 3000", "mixed"),
    ],
)
def test_text_that_means_nothing_has_a_reason(document, name, row, text, reason):
    """The cell is named, nothing is to be written."""
    rows = member_rows.rows_of(document)
    edits, reasons = member_rows.edits_of(rows, {(row, column(name)): text})
    assert edits == []
    assert reason in reasons[row, column(name)]


@pytest.mark.parametrize(
    ("name", "row", "text", "property", "value"),
    [
        ("cut", 1, "4 m + 35 mm", "Cut2", 4035.0),
        ("cut", 1, "100/3%", "CutRatio2", 1.0 / 3.0),
        ("slope", 1, "5/2", "Slope2", 2.5),
        ("offset_y", 0, "2 * (1 cm)", "OffsetY1", 20.0),
        ("offset_z", 0, "-1/2 in", "OffsetZ1", -12.7),
        ("offset_z", 0, "", "OffsetZ1", 0.0),
        ("align", 0, "Top-Left", "Align1", "top-left"),
        ("align_to", 1, "PREVIOUS", "AlignTo2", "previous"),
        ("transition", 1, "Smooth", "Transition2", "smooth"),
        ("section", 0, "b700", "Section1", "B700"),
        ("top", 0, "Auto", "AutoJoints", ["left", "top"]),
        ("top", 0, "2 m; 4 m + 5 cm", "JointsTop", [2000.0, 4050.0]),
    ],
)
def test_cells_take_what_the_panels_take(document, name, row, text, property, value):
    """Units, sums, fractions, and words in any capital letters."""
    edits, reasons = member_rows.edits_of(
        member_rows.rows_of(document), {(row, column(name)): text}
    )
    assert reasons == {}
    apply(edits)
    read = next(getattr(obj, own) for obj, own, _ in edits if own == property)
    read = getattr(read, "Label", getattr(read, "Value", read))
    assert read == (pytest.approx(value) if isinstance(value, float) else value)


def test_a_cell_that_follows_an_expression_is_locked(document):
    """A value written there would be gone with the next recompute."""
    member = document.getObjectsByLabel("M1")[0]
    member.setExpression("OffsetY2", "Length / 100")
    row = member_rows.rows_of(document)[1]
    assert row.lock_reason("offset_y") == "it follows = Length / 100"
    assert not row.is_locked("offset_z")


def test_joints_round_trip(document):
    """Text to lists and back."""
    plates = next(obj for obj in document.Objects if getattr(obj, "BT_Type", "") == "PlateSet")
    for text in ("auto", "", "2500 7000.5", "0.25 0.5"):
        set_joints(plates, "bottom", text)
        assert joints_text(plates, "bottom") == text
    assert parse_joints("2000; 4000") == [2000.0, 4000.0]


def test_a_cut_divides_a_segment_and_removing_it_restores_the_shape(document):
    """A cut with the section of the segment it divides changes no volume; others keep theirs."""
    member = next(obj for obj in document.Objects if getattr(obj, "BT_Type", "") == "Member")
    volume = member.Shape.Volume
    assert make.add_cut(member, (6500.0, 300.0, 40.0)) == 3
    document.recompute()
    assert member.Segments == 4 and member.Status == "ok"
    assert [member.Section3.Label, member.Section4.Label] == ["B700", "B500"]
    assert member.Cut3.Value == pytest.approx(6500.0)
    assert member.CutRatio4 == 0.75
    assert member.Shape.Volume == pytest.approx(volume, rel=1e-9)
    make.remove_segment(member, 3)
    document.recompute()
    assert member.Segments == 3 and member.CutRatio3 == 0.75
    assert member.Shape.Volume == pytest.approx(volume, rel=1e-9)


def test_cuts_and_segments_that_cannot_be(document):
    """Beyond the axis; the number of no segment."""
    member = next(obj for obj in document.Objects if getattr(obj, "BT_Type", "") == "Member")
    with pytest.raises(BendTorsionError, match="not between the ends"):
        make.add_cut(member, 12000.0)
    with pytest.raises(BendTorsionError, match="cannot be taken away"):
        make.remove_segment(member, 4)
    assert member.Segments == 3


def test_edges_are_sorted_into_chains():
    """Two edges that meet are one chain, a third apart is its own; one chain alone has no names."""
    from BendTorsionWB.gui.chains import chains

    points = [FreeCAD.Vector(x, 0, 0) for x in (0, 1000, 2000, 5000, 6000)]
    edges = [Part.makeLine(points[k], points[k + 1]) for k in (1, 0, 3)]
    assert chains(Part.Compound(edges)) == [["Edge1", "Edge2"], "Edge3"]
    assert chains(Part.Compound(edges[:2])) == [""]


def test_blocks_as_spreadsheets_copy_them():
    """Tabs and line ends; what holds a quote, a tab or a line break is quoted (RFC 4180)."""
    assert block_of("1\t2\r\n3\t\r\n") == [["1", "2"], ["3", ""]]
    assert block_of('"0.2 0.4"\t"a ""b"""\n5\t6') == [["0.2 0.4", 'a "b"'], ["5", "6"]]
    assert block_of('"two\nlines"\tx') == [["two\nlines", "x"]]
    assert block_of("") == []


def test_what_a_cell_can_hold_is_offered(document):
    row = member_rows.rows_of(document)[1]
    assert row.choices("section") == ["B500", "B700"]
    assert len(row.choices("align")) == 9 and "top-left" in row.choices("align")
    assert row.choices("cut") == []


def test_an_error_of_a_member_is_at_the_cell_it_names(document):
    """A cut beyond the end is at the cut of its segment, and gone when it is mended."""
    rows = member_rows.rows_of(document)
    assert member_rows.faults(rows) == {}
    rows[1].member.Cut2 = 99000.0
    document.recompute()
    found = member_rows.faults(member_rows.rows_of(document))
    assert "beyond the end" in found[1, column("cut")]
    assert {c for _, c in found} == {column("cut")}
    rows[1].member.Cut2 = 4000.0
    document.recompute()
    assert member_rows.faults(member_rows.rows_of(document)) == {}


def test_cells_without_a_meaning_have_a_reason(document):
    """Each locked cell says why; no other does."""
    rows = member_rows.rows_of(document)
    for row in rows:
        for name in member_rows.COLUMNS:
            assert bool(row.lock_reason(name)) == row.is_locked(name)
    assert "first segment" in rows[0].lock_reason("cut")
    assert "first segment" in rows[1].lock_reason("top")
    assert rows[0].lock_reason("top") == "" == rows[1].lock_reason("cut")


def test_the_middle_of_a_segment_counts_cuts_in_mm_and_in_parts(document):
    """12 m with cuts at 4 m and 75 %."""
    from BendTorsionWB.objects.segment_edit import middle_of

    member = document.getObjectsByLabel("M1")[0]
    assert [middle_of(member, k) for k in (1, 2, 3)] == [2000.0, 6500.0, 10500.0]
