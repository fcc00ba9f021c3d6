# SPDX-License-Identifier: LGPL-2.1-or-later
"""Delivery pieces: joints at their ends on every face, gaps, masses, what cannot be, and the same
through schedule, document and STEP."""

import json
import re

import FreeCAD
import numpy as np
import openpyxl
import Part
import pytest
from curved_members import HALF_AXES, diagonal, irregular
from schedule_books import write

from BendTorsionWB import make
from BendTorsionWB.core import detailing
from BendTorsionWB.core.axis_input import AxisInput
from BendTorsionWB.core.detailing import MemberInput, MemberJob, PlatesInput, detail
from BendTorsionWB.core.end_cut import EndCut
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.joint_solver import JointRules
from BendTorsionWB.core.pieces import PieceInput, end_text, end_words
from BendTorsionWB.core.plates import Joints
from BendTorsionWB.core.section import box
from BendTorsionWB.core.surface import Plane
from BendTorsionWB.core.zones import Segment
from BendTorsionWB.document import build_document, read_files
from BendTorsionWB.document_rows import rows_of
from BendTorsionWB.exchange.schedule import read_schedule
from BendTorsionWB.exchange.schedule_end_cuts import end_cut
from BendTorsionWB.exchange.schedule_jobs import job_of, located
from BendTorsionWB.objects.proxy import findings_of

BIG = box("B800", "box1", 800, 600, 20, gap1=2, gap2=2)
SMALL = box("B600", "box1", 600, 600, 20, gap1=2, gap2=2)
STEPPED = "stepped top=80 bottom=-80 left=0 right=40"
LENGTH = 24000.0


ONE = (Segment(BIG),)


def straight(pieces, segments=ONE, joints=None, rules=None, **cuts):
    """A member 24 m along x in these pieces."""
    return detail(
        MemberJob(
            Plane(),
            AxisInput("A1", np.array([(0, 0, 0), (LENGTH, 0, 0.0)])),
            MemberInput("M1", tuple(segments), **cuts),
            PlatesInput(joints or {}, rules=rules, pieces=tuple(pieces)),
        )
    )


def three(**first):
    return (
        PieceInput(1, end=(8000.0, False), **{"gap": 6.0, "end_end": end_words(STEPPED), **first}),
        PieceInput(2, end=(2 / 3, True), gap=4.0),
        PieceInput(3),
    )


@pytest.fixture(scope="module")
def delivered():
    return straight(three(), joints={"top": Joints((3000.0, 12000.0), "mm")})


def spans(detailed, face):
    return [(p.piece, p.s_start, p.s_end) for p in detailed.record.plates if p.face == face]


def test_without_rows_a_member_is_one_piece():
    whole = straight(())
    assert {plate.piece for plate in whole.record.plates} == {1}
    [own] = whole.record.pieces
    assert (own.piece.number, own.piece.start) == (1, 0.0)
    assert own.piece.end == pytest.approx(LENGTH)
    assert own.mass == pytest.approx(whole.record.mass, rel=1e-12)
    assert own.centre_of_gravity == pytest.approx(whole.record.centre_of_gravity, abs=1e-6)


def test_plates_end_at_piece_ends_stepped_or_square_half_a_gap_short(delivered):
    left = [(1, 0.0, 7997.0), (2, 8003.0, 15998.0), (3, 16002.0, LENGTH)]
    assert np.array(spans(delivered, "left")) == pytest.approx(np.array(left))
    assert spans(delivered, "right")[0] == pytest.approx((1, 0.0, 8037.0))
    assert spans(delivered, "bottom")[0] == pytest.approx((1, 0.0, 7917.0))
    top = [
        (1, 0.0, 3000.0),
        (1, 3000.0, 8077.0),
        (2, 8083.0, 12000.0),
        (2, 12000.0, 15998.0),
        (3, 16002.0, LENGTH),
    ]
    assert np.array(spans(delivered, "top")) == pytest.approx(np.array(top))


def test_the_plates_are_as_long_as_their_pieces_leave_them(delivered):
    """Square ends of a straight member: the pattern is a rectangle, the volume its area times t."""
    for plate in delivered.record.plates:
        length = plate.s_end - plate.s_start
        assert plate.length == pytest.approx(length, abs=1e-9)
        width = 556.0 if plate.face in ("top", "bottom") else 800.0
        assert plate.area == pytest.approx(length * width, rel=1e-12)
        assert plate.volume == pytest.approx(20.0 * length * width, rel=1e-12)


def test_masses_and_centres_of_pieces_add_up_to_the_members(delivered):
    record = delivered.record
    assert [own.piece.number for own in record.pieces] == [1, 2, 3]
    mass = sum(own.mass for own in record.pieces)
    assert mass == pytest.approx(record.mass, rel=1e-12)
    centre = sum(own.mass * own.centre_of_gravity for own in record.pieces) / mass
    assert centre == pytest.approx(record.centre_of_gravity, abs=1e-6)
    marks = [mark for own in record.pieces for mark in own.marks]
    assert sorted(marks) == sorted(plate.mark for plate in record.plates)
    # By hand: the lengths of the first piece's plates.
    lengths = {"top": 8077.0, "bottom": 7917.0, "left": 7997.0, "right": 8037.0}
    widths = {"top": 556.0, "bottom": 556.0, "left": 800.0, "right": 800.0}
    expected = sum(lengths[f] * widths[f] for f in lengths) * 20.0 * 7.85e-6
    assert record.pieces[0].mass == pytest.approx(expected, rel=1e-12)
    moment = sum(lengths[f] ** 2 / 2.0 * widths[f] for f in lengths) * 20.0 * 7.85e-6
    assert record.pieces[0].centre_of_gravity[0] == pytest.approx(moment / expected, abs=1e-6)


def test_solved_joints_keep_to_the_pieces_and_clear_of_their_ends():
    rules = JointRules(longest_piece=5000.0, shortest_piece=600.0)
    made = straight(three(), joints={"top": Joints((), "auto")}, rules=rules)
    top = spans(made, "top")
    assert {piece for piece, *_ in top} == {1, 2, 3}
    for _, start, end in top:
        assert 600.0 <= end - start <= 5000.0
    assert not [f for f in made.record.findings if f.code == "joint-beside-piece-end"]


def test_an_end_cut_and_pieces_go_together():
    made = straight(three(), end_cut=EndCut("plane", normal=(1.0, 0.2, 0.3)))
    last = [p for p in made.record.plates if p.piece == 3]
    for plate in last:
        ends = np.array([p.xyz for p in plate.points if p.line == "E-2"])
        off = (ends - [LENGTH, 0, 0]) @ [1.0, 0.2, 0.3]
        assert np.abs(off).max() < 1e-8
    mass = sum(own.mass for own in made.record.pieces)
    assert mass == pytest.approx(made.record.mass, rel=1e-12)


@pytest.mark.parametrize(
    ("pieces", "code", "row"),
    [
        ((PieceInput(1, end=(9000.0, False)), PieceInput(2, (8000.0, False))), "pieces-overlap", 2),
        (
            (PieceInput(1, end=(7000.0, False)), PieceInput(2, (8000.0, False))),
            "pieces-leave-out",
            2,
        ),
        ((PieceInput(1, end=(7000.0, False)),), "pieces-leave-out", 1),
        ((PieceInput(1, (5.0, False)),), "pieces-leave-out", 1),
        ((PieceInput(1, end=(30000.0, False)),), "piece-beyond-member", 1),
        ((PieceInput(1), PieceInput(2)), "piece-order", 1),
        ((PieceInput(1, end=(0.5, True)), PieceInput(1)), "piece-number", 2),
        (three(end_end=(("front", 30.0),)), "piece-end-face", 1),
        (three(gap=400.0), "piece-gap", 1),
        (three(gap=-1.0), "piece-gap", 1),
        (three(green_end=-5.0), "piece-green", 1),
        (
            (
                PieceInput(1, end=(0.5, True), end_end=end_words("stepped top=80")),
                PieceInput(2, start_end=end_words("stepped top=70")),
            ),
            "piece-ends-differ",
            2,
        ),
        ((PieceInput(1, end_end=end_words("stepped top=80")),), "piece-end-at-member-end", 1),
        ((PieceInput(1, start_end=end_words("stepped top=80")),), "piece-end-at-member-end", 1),
        (
            (PieceInput(1, end=(8000.0, False)), PieceInput(2, end=(8008.0, False)), PieceInput(3)),
            "delivery-piece-too-short",
            2,
        ),
    ],
)
def test_pieces_that_cannot_be_are_named_by_their_row(pieces, code, row):
    with pytest.raises(BendTorsionError) as caught:
        straight(pieces)
    found = {f.code: f for f in caught.value.findings}
    assert code in found
    assert found[code].position == f"piece {row}" and found[code].mend
    assert found[code].object == "M1"


def test_a_piece_does_not_end_inside_a_transition():
    segments = (Segment(BIG), Segment(SMALL, 8000.0))
    inside = (PieceInput(1, end=(8100.0, False)), PieceInput(2))
    with pytest.raises(BendTorsionError) as caught:
        straight(inside, segments)
    [found] = caught.value.findings
    assert found.code == "piece-end-in-transition"
    assert found.value == 8100.0 and found.limit == "8000.0 to 8250.0"
    # At either end of it, and stepped clear of it, it may.
    for end in (8000.0, 8250.0):
        made = straight((PieceInput(1, end=(end, False)), PieceInput(2)), segments)
        assert {plate.piece for plate in made.record.plates} == {1, 2}
    stepped = (
        PieceInput(1, end=(7900.0, False), end_end=end_words("stepped top=150")),
        PieceInput(2),
    )
    with pytest.raises(BendTorsionError):
        straight(stepped, segments)


def test_short_pieces_are_warned_of_by_the_rules():
    short = (PieceInput(1, end=(500.0, False)), PieceInput(2))
    found = straight(short, rules=JointRules()).record.findings
    [warned] = [f for f in found if f.code == "delivery-piece-too-short"]
    assert warned.severity == "warning" and warned.value == 500.0 and warned.limit == 600.0


def test_words_of_ends_are_read_and_written():
    assert end_words("square") == () and end_words("") is None and end_words(None) is None
    assert end_words("stepped top = 80 left=-3.5") == (("top", 80.0), ("left", -3.5))
    assert end_words(end_text(end_words(STEPPED))) == end_words(STEPPED)
    for wrong in ("stepped", "round", "square top=3", "stepped top", "stepped top=a"):
        with pytest.raises(ValueError):
            end_words(wrong)


SCHEDULE = {
    "Settings": [["key", "value"], ["station_spacing", 500]],
    "Surfaces": [
        ["surface", "kind", "parameters"],
        ["Hall", "plane", None],
        ["Column", "cylinder", "r=900 x=12700"],
    ],
    "Points": [["axis", "no", "x", "y", "z"], ["A1", 1, 0, 0, 0], ["A1", 2, 12000, 0, 0]],
    "Axes": [["axis", "surface"], ["A1", "Hall"]],
    "Sections": [["section", "type", "h", "b", "t"], ["S1", "box1", 800, 600, 20]],
    "Members": [
        ["member", "segment", "axis", "section", "start_cut", "end_cut"],
        ["M1", 1, "A1", "S1", "plane nx=1 ny=0.3 nz=0 offset=25", "surface Column"],
    ],
    "Pieces": [
        ["member", "piece", "to", "end_end", "green_start", "gap"],
        ["M1", 1, 5000, STEPPED, None, 6],
        ["M1", 2, None, None, 30, None],
    ],
}


def schedule_of(tmp_path, changes=None):
    sheets = {title: [list(row) for row in rows] for title, rows in SCHEDULE.items()}
    for (title, row, heading), value in (changes or {}).items():
        sheets[title][row][sheets[title][0].index(heading)] = value
    return read_schedule(write(tmp_path / "s.xlsx", sheets))


def jobs_of(schedule):
    files = read_files(schedule, schedule.members)
    return {row.name: job_of(schedule, row, files) for row in schedule.members}


def test_a_schedule_says_cuts_and_pieces(tmp_path):
    job = jobs_of(schedule_of(tmp_path))["M1"]
    assert job.member.start_cut == EndCut("plane", 25.0, (1.0, 0.3, 0.0))
    assert job.member.end_cut.kind == "surface" and job.member.end_cut.surface.r == 900.0
    first, second = job.plates.pieces
    assert first.end == (5000.0, False) and first.gap == 6.0
    assert dict(first.end_end) == {"top": 80.0, "bottom": -80.0, "left": 0.0, "right": 40.0}
    assert second.start is None and second.green_start == 30.0
    made = detail(job)
    assert made.record.pieces[1].piece.green_start == 30.0


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        ("slanted", "bad-end-cut"),
        ("plane", "bad-end-cut"),
        ("plane nx=1 nq=2", "bad-end-cut"),
        ("plane nx=1 x=3", "bad-end-cut"),
        ("plumb nx=1", "bad-end-cut"),
        ("surface", "bad-end-cut"),
        ("level deep", "bad-end-cut"),
        ("plumb offset=far", "not-a-number"),
    ],
)
def test_cut_cells_that_mean_nothing_are_refused(words, fault):
    with pytest.raises(ValueError) as caught:
        end_cut(words)
    assert caught.value.code == fault and caught.value.mend


@pytest.mark.parametrize(
    ("changes", "place"),
    [
        ({("Members", 1, "end_cut"): "surface Colunm"}, "sheet Members, row 2, column end_cut"),
        ({("Pieces", 1, "end_end"): "steped top=3"}, "sheet Pieces, row 2, column end_end"),
        ({("Pieces", 2, "member"): "M7"}, "sheet Pieces, row 3, column member"),
        ({("Pieces", 2, "piece"): 1}, "sheet Pieces, row 3, column piece"),
    ],
)
def test_bad_rows_are_named_by_their_cells(tmp_path, changes, place):
    with pytest.raises(BendTorsionError) as caught:
        schedule_of(tmp_path, changes)
    assert place in {f.position for f in caught.value.findings}


@pytest.mark.parametrize(
    ("changes", "code", "place"),
    [
        ({("Pieces", 1, "to"): 13000}, "piece-order", "sheet Pieces, row 2, column to"),
        ({("Pieces", 2, "to"): 11000}, "pieces-leave-out", "sheet Pieces, row 3, column from"),
        (
            {("Members", 1, "start_cut"): "level"},
            "end-cut-along-axis",
            "sheet Members, row 2, column start_cut",
        ),
        (
            {("Surfaces", 2, "parameters"): "r=100 x=12700"},
            "end-cut-misses",
            "sheet Members, row 2, column end_cut",
        ),
    ],
)
def test_what_geometry_refuses_is_named_by_its_cell(tmp_path, changes, code, place):
    schedule = schedule_of(tmp_path, changes)
    with pytest.raises(BendTorsionError) as caught:
        detail(jobs_of(schedule)["M1"])
    at = {
        f.code: located(schedule, schedule.member("M1"), f).position for f in caught.value.findings
    }
    assert at[code] == place


@pytest.fixture
def document():
    made = FreeCAD.newDocument("pieces", hidden=True)
    yield made
    FreeCAD.closeDocument(made.Name)


def test_a_document_of_a_schedule_has_cuts_and_pieces_and_keeps_them(tmp_path):
    schedule = schedule_of(tmp_path)
    jobs = jobs_of(schedule)
    truth = detail(jobs["M1"])
    built = build_document(schedule, jobs)
    try:
        built.recompute()
        _check_document(built, truth)
        file = str(tmp_path / "m.FCStd")
        built.saveAs(file)
        FreeCAD.closeDocument(built.Name)
        built = FreeCAD.openDocument(file, True)
        [plates] = [o for o in built.Objects if getattr(o, "BT_Type", "") == "PlateSet"]
        plates.Member.StartCutOffset = 60.0
        built.recompute()
        assert plates.Status == "ok"
        moved = truth.record.mass - plates.Mass
        assert -moved == pytest.approx(35.0 * 7.85e-6 * (2 * 560 * 20 + 2 * 800 * 20), rel=1e-6)
        plates.Member.StartCutOffset = 25.0
        built.recompute()
        _check_document(built, truth)
        # And back: the schedule of the document says the same.
        written = rows_of(built, tmp_path / "files")
        again = read_schedule(write(tmp_path / "again.xlsx", written))
        job = jobs_of(again)["M1"]
        assert job.plates.pieces == jobs["M1"].plates.pieces
        assert job.member.start_cut == jobs["M1"].member.start_cut
        assert job.member.end_cut.surface.key == jobs["M1"].member.end_cut.surface.key
    finally:
        FreeCAD.closeDocument(built.Name)


def _check_document(document, truth):
    errors = [
        f
        for o in document.Objects
        if "Findings" in o.PropertiesList
        for f in findings_of(o)
        if f.severity == "error"
    ]
    assert errors == []
    [plates] = [o for o in document.Objects if getattr(o, "BT_Type", "") == "PlateSet"]
    assert plates.Mass == pytest.approx(truth.record.mass, rel=1e-9)
    assert list(plates.PieceMasses) == pytest.approx([p.mass for p in truth.record.pieces])
    assert list(plates.MarkPieces) == [p.piece for p in truth.record.plates]
    for solid, plate in zip(plates.Shape.Solids, truth.record.plates, strict=True):
        # The kernel's own volume is 5e-5 off at curved cuts of long faces; its mesh is not.
        assert _mesh_volume(solid) == pytest.approx(plate.volume, rel=5e-6)
        assert solid.isValid() and solid.isClosed()
    # The member's own shape ends where its plates do.
    ends = [[v.Point.x for v in o.Shape.Vertexes] for o in (plates.Member, plates)]
    assert min(ends[0]) == pytest.approx(min(ends[1]), abs=1e-6)
    assert max(ends[0]) == pytest.approx(max(ends[1]), abs=1e-3)


def _mesh_volume(solid):
    points, triangles = solid.tessellate(0.02)
    corners = np.array(points)[np.array(triangles)]
    return float((np.cross(corners[:, 0], corners[:, 1]) * corners[:, 2]).sum()) / 6.0


def test_step_has_an_assembly_per_member_of_pieces(document, tmp_path):
    from BendTorsionWB.model_files import write_step

    surface = make.make_surface(document, "Hall", **dict(zip("abc", HALF_AXES)))
    section = make.make_section(document, "S", h=400, b=400, t=12)
    axis = make.make_axis(document, "A1", surface, irregular(diagonal))
    member = make.make_member(document, "M1", axis, [section])
    rows = [{"piece": 1, "to": "40%", "gap": 6, "end_end": "stepped top=60"}, {"piece": 2}]
    plates = make.make_plates(document, member, pieces=rows)
    document.recompute()
    assert [line.split()[0] for line in plates.Pieces] == ["1", "2"]
    write_step(document, ["M1"], tmp_path / "m.step")
    text = (tmp_path / "m.step").read_text()
    names = re.findall(r"PRODUCT\('([^']*)'", text)
    assert [name for name in names if name not in plates.Marks] == [
        "M1",
        "M1-P1",
        "M1-P2",
    ]
    pieces = {name: names.index(name) for name in ("M1-P1", "M1-P2")}
    for mark, piece in zip(plates.Marks, plates.MarkPieces, strict=True):
        assert (names.index(mark) > pieces["M1-P2"]) == (piece == 2)
    assert len(Part.read(str(tmp_path / "m.step")).Solids) == 8
    assert [
        o.Name for o in FreeCAD.listDocuments().values() if o.Name.startswith("assemblies")
    ] == []


def test_a_face_of_any_object_cuts_a_member_and_follows_it(document):
    surface = make.make_surface(document, "Ground", "plane")
    section = make.make_section(document, "S", h=400, b=300, t=12)
    axis = make.make_axis(document, "A1", surface, [(0, 0, 0), (5000, 0, 0)])
    block = document.addObject("Part::Feature", "Block")
    block.Shape = Part.makeBox(1000, 4000, 4000, FreeCAD.Vector(0, -2000, -2000))
    block.Placement = FreeCAD.Placement(
        FreeCAD.Vector(4700, 0, 0), FreeCAD.Rotation(FreeCAD.Vector(0, 1, 0), 20)
    )
    face = next(
        f"Face{k}" for k, f in enumerate(block.Shape.Faces, 1) if abs(f.CenterOfMass.x - 4700) < 1
    )
    member = make.make_member(
        document, "M1", axis, [section], end_cut={"kind": "surface", "face": (block, face)}
    )
    plates = make.make_plates(document, member)
    document.recompute()
    assert plates.Status == "ok"
    before = plates.Volume.Value
    assert plates.Shape.common(block.Shape).Volume < 1.0
    block.Placement.Base.x += 100.0
    block.touch()
    document.recompute()
    gained = 100.0 * 12.0 * (2 * 400 + 2 * 276)
    assert plates.Volume.Value - before == pytest.approx(gained, rel=1e-9)
    document.removeObject("Block")
    document.recompute()
    assert plates.Status != "ok" and plates.Shape.Solids == []
    [found] = [f for f in findings_of(member) if f.severity == "error"]
    assert "EndCutFace" in found.position


def test_tables_of_pieces_in_report_and_workbook(delivered, tmp_path):
    from BendTorsionWB.exchange.report import write_report
    from BendTorsionWB.exchange.results_workbook import write_results

    write_report([delivered.record], (), "0", tmp_path / "r.json")
    found = json.loads((tmp_path / "r.json").read_text())["members"][0]
    assert [p["piece"] for p in found["pieces"]] == [1, 2, 3]
    assert found["pieces"][0]["end_end"] == "stepped bottom=-80 right=40 top=80"
    assert {p["piece"] for p in found["plates"]} == {1, 2, 3}
    write_results([delivered.record], (), tmp_path / "r.xlsx")
    sheet = openpyxl.load_workbook(tmp_path / "r.xlsx")["Pieces"]
    header, *rows = sheet.iter_rows(values_only=True)
    table = [dict(zip(header, row)) for row in rows]
    assert [row["piece"] for row in table] == [1, 2, 3]
    for row, own in zip(table, delivered.record.pieces, strict=True):
        assert row["mass"] == own.mass and row["parts"] == len(own.marks)
        assert row["centre_x"] == own.centre_of_gravity[0]


def test_the_bed_is_per_piece(delivered):
    beds = detailing.beds_of(delivered.plates, detailing.BedInput()).beds
    assert [bed.piece for bed in beds] == [1, 2, 3]
