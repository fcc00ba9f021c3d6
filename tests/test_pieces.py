# SPDX-License-Identifier: LGPL-2.1-or-later
"""Delivery pieces: joints at their ends on every face, gaps, masses, what cannot be, and the same
through schedule, document and STEP."""

import json

import numpy as np
import openpyxl
import pytest
from piece_members import BIG, LENGTH, SMALL, STEPPED, straight, three

from BendTorsionWB.core import detailing
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.joints.joint_solver import JointRules
from BendTorsionWB.core.joints.pieces import PieceInput, end_text, end_words
from BendTorsionWB.core.members.end_cut import EndCut
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.plates.plates import Joints


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


def test_tables_of_pieces_in_report_and_workbook(delivered, tmp_path):
    from BendTorsionWB.exchange.report import write_report
    from BendTorsionWB.exchange.results_workbook import write_results

    write_report([delivered.record], (), "0", tmp_path / "r.json")
    found = json.loads((tmp_path / "r.json").read_text(encoding="utf-8"))["members"][0]
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
