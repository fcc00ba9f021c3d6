# SPDX-License-Identifier: LGPL-2.1-or-later
"""Part marks: shared by equal plates only, whatever their place, order and hand."""

import dataclasses
from dataclasses import replace

import numpy as np
import pytest
from curved_members import HALF_AXES
from flat_plates import member, rectangle

from BendTorsionWB.core.axes.axis import fit_axis
from BendTorsionWB.core.axes.frames import surface_frames
from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.lofting import FlatHole, FlatMark, MemberRecord
from BendTorsionWB.core.members.member import Member
from BendTorsionWB.core.members.thickness import Chamfer
from BendTorsionWB.core.members.zones import Segment, section_law
from BendTorsionWB.core.patterns.numbering import numbered
from BendTorsionWB.core.patterns.pattern import develop_plate
from BendTorsionWB.core.plates.plates import split_plates
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.welds.bevel_record import EdgeBevel

SURFACE = analytic_surface("ellipsoid", dict(zip("abc", HALF_AXES)))


def curve(mirror=(1, 1, 1), lower=0.2):
    t = np.linspace(0.0, 1.0, 9)
    u, v = 0.35 + 0.3 * t, lower + 0.25 * t
    unit = np.column_stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)])
    return unit * HALF_AXES * np.array(mirror)


def record(name, points, height=800, section=None):
    axis = fit_axis("A", points, SURFACE)
    section = section or box("B", "box1", height, 700, 20, gap1=3, gap2=3)
    law = section_law(name, [Segment(section)], axis.length)
    member = Member(name, surface_frames(axis, SURFACE), law)
    plates, _ = split_plates(member, {})
    developed = tuple(map(develop_plate, plates))
    return MemberRecord(name, "", "box1", plates=developed)


def parts(*records):
    return {
        p.mark: (p.part, p.quantity, p.opposite_hand) for r in numbered(records) for p in r.plates
    }


def test_members_of_equal_geometry_share_parts():
    """The ellipsoid is symmetric under half turns about its axes; so are the members."""
    turned = (-1, -1, 1)
    found = parts(record("M1", curve()), record("M2", curve(turned)))
    for letter in "TBLR":
        assert found[f"M2-{letter}1"] == found[f"M1-{letter}1"] == (f"M1-{letter}1", 2, "")


def test_a_reversed_axis_shares_nothing_for_its_lines_are_numbered_from_the_other_end():
    """The plates are congruent, but one file would mark +s and the lines of one of them wrong."""
    found = parts(record("M1", curve()), record("M2", curve()[::-1]))
    assert {part for part, _, _ in found.values()} == set(found)
    assert {quantity for _, quantity, _ in found.values()} == {1}


def test_plates_share_a_part_only_when_one_file_marks_them_all():
    one, two = rectangle("M1-T1"), rectangle("M1-T2")

    def shared(plate):
        (found,) = numbered([MemberRecord("M1", "", "", plates=(one, plate))])
        return found.plates[1].part == "M1-T1"

    assert shared(two)
    later = tuple(replace(line, label=line.label.replace("L-", "L-1")) for line in two.lines)
    assert any(line.label.startswith("L-") for line in one.lines)
    assert not shared(replace(two, lines=later))
    # Numbered from the other end it is the same turned by half a turn, with all that is on it.
    size = np.array([two.length, two.width])
    turned = tuple(replace(line, flat=size - line.flat) for line in two.lines)
    assert shared(replace(two, lines=turned))
    # With a mark near one end it is not: that end is E-1 of the one and E-2 of the other.
    stroke = FlatMark("line", "", np.array([[600.0, 0.0], [600.0, 800.0]]))
    one = replace(one, marks=(stroke,))
    assert shared(replace(two, marks=(stroke,)))
    assert not shared(replace(two, lines=turned, marks=(stroke,)))
    # Marked on the other face a symmetrical plate has the same contour but is another's mirror.
    other = {"inside": "outside", "outside": "inside"}[two.marking_face]
    assert not shared(replace(two, marking_face=other))


def test_mirrored_members_share_nothing_and_say_so():
    found = parts(record("M1", curve()), record("M2", curve((-1, 1, 1))))
    # The left web of the one is the mirror image of the right web of the other.
    twins = {"T": "T", "B": "B", "L": "R", "R": "L"}
    for letter, twin in twins.items():
        assert found[f"M1-{letter}1"] == (f"M1-{letter}1", 1, f"M2-{twin}1")
        assert found[f"M2-{letter}1"] == (f"M2-{letter}1", 1, f"M1-{twins[letter]}1")


def test_what_differs_in_size_shape_or_grade_is_another_part():
    one = record("M1", curve())
    higher = record("M2", curve(), height=801)
    elsewhere = record("M3", curve(lower=0.21))
    steel = dataclasses.replace(
        record("M4", curve()),
        plates=tuple(dataclasses.replace(p, material="S460") for p in record("M4", curve()).plates),
    )
    found = parts(one, higher, elsewhere, steel)
    assert found["M2-L1"] == ("M2-L1", 1, "")
    assert all(found[f"M{k}-T1"][0] == f"M{k}-T1" for k in (1, 3, 4))


def test_the_same_flat_shape_formed_otherwise_is_another_part():
    """Two plates of one rectangle, rolled to different radii."""
    one = record("M1", curve())
    plate = one.plates[0]
    bent = tuple(
        dataclasses.replace(p, local=p.local * [1, 1, 0] if p.kind == "arris" else p.local)
        for p in plate.points
    )
    other = MemberRecord(
        "M2", "", "box1", plates=(dataclasses.replace(plate, mark="M2-T1", points=bent),)
    )
    assert parts(one, other)["M2-T1"][0] == "M2-T1"


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 0, 1)])
def test_marks_do_not_depend_on_other_members(order):
    records = [
        record("M1", curve()),
        record("M2", curve((-1, -1, 1))),
        record("M9", curve(lower=0.3)),
    ]
    alone = parts(records[2])
    together = parts(*(records[k] for k in order))
    assert {mark: together[mark] for mark in alone} == alone


def test_a_part_mark_changes_with_the_plate_it_is_named_after_and_with_no_other():
    members = [record(name, curve()) for name in ("M1", "M2", "M3")]
    same = parts(*members)
    assert {mark: part for mark, (part, _, _) in same.items() if mark.endswith("-T1")} == {
        f"M{k}-T1": "M1-T1" for k in (1, 2, 3)
    }
    other = [record(f"M{k}", curve(), height=801) for k in (1, 2)]
    second = parts(members[0], other[1], members[2])
    assert [second[f"M{k}-L1"][:2] for k in (1, 2, 3)] == [
        ("M1-L1", 2),
        ("M2-L1", 1),
        ("M1-L1", 2),
    ]
    first = parts(other[0], members[1], members[2])
    assert [first[f"M{k}-L1"][:2] for k in (1, 2, 3)] == [
        ("M1-L1", 1),
        ("M2-L1", 2),
        ("M2-L1", 2),
    ]
    # Position marks are those of place alone.
    assert set(same) == set(second) == set(first)


def test_plates_that_differ_in_a_bevel_alone_are_different_parts():
    def cut(mark, side, angle=45.0):
        plate = rectangle(mark)
        bevel = EdgeBevel(
            side, "left", "", "", plate.s_start, plate.s_end, 0.0, (np.radians(angle), 14.0)
        )
        return dataclasses.replace(plate, bevels=(bevel,))

    plates = (
        cut("M1-T1", "first"),
        cut("M1-T2", "first"),
        cut("M1-T3", "second"),
        cut("M1-T4", "first", 50.0),
        rectangle("M1-T5"),
    )
    [record] = numbered([member("M1", plates)])
    # A rectangle with the other edge cut is the same turned round, but its +s is the other way.
    assert [p.part for p in record.plates] == ["M1-T1"] * 2 + ["M1-T3", "M1-T4", "M1-T5"]
    end = EdgeBevel("end", "E-2", "", "", 0.0, 800.0, 0.0, (np.radians(30.0), 18.0))
    ended = [dataclasses.replace(p, bevels=(*p.bevels, end)) for p in plates[:3]]
    [record] = numbered([member("M1", tuple(ended))])
    assert [p.part for p in record.plates] == ["M1-T1", "M1-T1", "M1-T3"]
    assert [p.opposite_hand for p in record.plates] == ["M1-T3", "M1-T3", "M1-T1"]


def test_plates_marked_or_chamfered_otherwise_are_different_parts():
    """What is marked for a diaphragm, and a chamfer, cannot be exchanged either."""
    first, second = rectangle("M1-T1"), rectangle("M1-T2")
    here, there = (
        FlatMark("line", f"M1-D{k}", np.array([[u, 0.0], [u, 800.0]]))
        for k, u in ((1, 600.0), (2, 900.0))
    )

    def shared(**changed):
        plates = (replace(first, marks=(here,)), replace(second, **changed))
        (found,) = numbered([MemberRecord("M1", "", "", plates=plates)])
        return found.plates[1].part == "M1-T1"

    assert shared(marks=(replace(here, text="M1-D7"),))
    assert not shared(marks=(there,)) and not shared(marks=())
    # Turned by half a turn the line lies 600 mm from the other end; so does +s of the plate.
    turned = replace(here, flat=np.array([[1800.0, 800.0], [1800.0, 0.0]]))
    assert not shared(marks=(turned,))
    first = replace(first, lines=())
    assert shared(marks=(turned,), lines=())
    chamfer = Chamfer(16.0, 4.0, "inner")
    assert not shared(marks=(here,), chamfers=(None, chamfer))


def test_holes_that_match_after_half_a_turn_are_no_difference():
    def hole(label, u, v):
        around = np.linspace(0.0, 2.0 * np.pi, 64)
        ring = np.column_stack([u + 50.0 * np.cos(around), v + 50.0 * np.sin(around)])
        return FlatHole(label, "d=100", (ring,), (u, v, 100.0), np.pi * 2500.0)

    # Of parts without lines, such as diaphragms, there is no +s to be wrong.
    bare = replace(rectangle("M1-T1"), lines=())
    one = replace(bare, holes=(hole("O-1", 300.0, 200.0), hole("O-2", 1500.0, 500.0)))
    two = replace(bare, mark="M1-T2", holes=(hole("O-1", 900.0, 300.0), hole("O-2", 2100.0, 600.0)))
    other = replace(two, mark="M1-T3", holes=(hole("O-1", 900.0, 350.0), two.holes[1]))
    (found,) = numbered([MemberRecord("M1", "", "", plates=(one, two, other))])
    assert [plate.part for plate in found.plates] == ["M1-T1", "M1-T1", "M1-T3"]


@pytest.mark.parametrize("off, equal", [(0.04, True), (0.3, False), (2.0, False)])
def test_outlines_are_equal_within_a_tenth_of_a_millimetre_however_large(off, equal):
    """Two corners cut off, by x and y, so that length, width and area stay when x changes."""

    def plate(mark, x, y):
        u, v = 2400.0, 800.0
        around = [(x, 0.0), (u, 0.0), (u, v - y), (u - x, v), (0.0, v), (0.0, y), (x, 0.0)]
        cut = replace(rectangle(mark), area=u * v - x * y, lines=())
        return replace(cut, outline=(np.array(around),))

    one, two = plate("M1-T1", 40.0, 40.0), plate("M1-T2", 40.0 + off, 1600.0 / (40.0 + off))
    (found,) = numbered([MemberRecord("M1", "", "", plates=(one, two))])
    assert [plate.part for plate in found.plates] == ["M1-T1", "M1-T1" if equal else "M1-T2"]
