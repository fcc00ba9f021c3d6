# SPDX-License-Identifier: LGPL-2.1-or-later
"""The section law as cells: each a polynomial of arc length that goes on in the next one."""

import numpy as np
import pytest
from curved_members import member

from BendTorsionWB.core.members.cells import FaceSteps, powers, shifted
from BendTorsionWB.core.members.zones import Segment, section_law
from BendTorsionWB.core.sections.section import box

BIG = box("B800", "box1", 800, 700, 24, gap1=3.0, gap2=5.0)
SMALL = box("B600", "box1", 600, 640, 16, gap1=2.0)
LENGTH = 20000.0


def law(transition="linear", **given):
    segments = [Segment(BIG), Segment(SMALL, 9000.0, 2.5, transition=transition, **given)]
    return section_law("M1", segments, LENGTH)


@pytest.mark.parametrize("smooth", [False, True])
def test_powers_run_from_the_first_value_to_the_last(smooth):
    """Linear: at a constant rate; smooth: without slope at the ends, 1.5 times the mean midway."""
    first, last = np.array([[2.0, -1.0]]), np.array([[5.0, 3.0]])
    length = 40.0
    coefficients = powers(first, last, length, smooth)
    assert len(coefficients) == (4 if smooth else 2)

    def value(d):
        return sum(c * d**k for k, c in enumerate(coefficients))

    def rate(d):
        return sum(k * c * d ** (k - 1) for k, c in enumerate(coefficients) if k)

    np.testing.assert_allclose(value(0.0), first, rtol=1e-14)
    np.testing.assert_allclose(value(length), last, rtol=1e-12)
    mean = (last - first) / length
    np.testing.assert_allclose(rate(0.0), 0.0 * mean if smooth else mean, atol=1e-15)
    np.testing.assert_allclose(rate(length), 0.0 * mean if smooth else mean, atol=1e-14)
    np.testing.assert_allclose(rate(length / 2), (1.5 if smooth else 1.0) * mean, rtol=1e-12)


@pytest.mark.parametrize("smooth", [False, True])
def test_a_polynomial_about_another_point_is_the_same(smooth):
    draw = np.random.default_rng(5)
    first, last = draw.uniform(-9, 9, (2, 3, 2))
    coefficients = powers(first, last, 50.0, smooth)
    value, rate, bends = shifted(coefficients, 17.0)
    assert (bends is not None) == smooth
    second, third = (0.0, 0.0) if bends is None else bends
    for d in (-17.0, 0.0, 3.0, 33.0):
        own = value + d * rate + d**2 * second + d**3 * third
        other = sum(c * (17.0 + d) ** k for k, c in enumerate(coefficients))
        np.testing.assert_allclose(own, other, atol=1e-12)


@pytest.mark.parametrize("transition", ["linear", "smooth"])
def test_cells_follow_each_other_with_the_same_corners_and_lines(transition):
    """Corners at the end of a cell are those at the start of the next; so are what strips are made
    of, which come by another way; rates are those of the corners."""
    built = law(transition)
    cells = built.cells
    assert cells[0].start == 0.0 and cells[-1].end == built.length == LENGTH
    assert {cell.label for cell in cells} == {"d-1", "b-1", "d-2"}
    assert [cell.is_transition for cell in cells] == [cell.label == "b-1" for cell in cells]
    nothing = np.zeros(1)
    for k, cell in enumerate(cells):
        places = np.linspace(cell.start, cell.end, 7)
        corners = cell.corners_at(places)
        sites = built.sites(np.full(7, k), places, *(np.zeros((3, 7))))
        np.testing.assert_allclose(sites.corners, corners, atol=1e-9)
        step = 1e-3
        ahead, behind = (cell.corners_at(places + way * step) for way in (1.0, -1.0))
        np.testing.assert_allclose(sites.motion, (ahead - behind) / (2 * step), atol=1e-7)
        last = cell.corners_at(np.array([cell.end + step]))
        before = cell.corners_at(np.array([cell.end - step]))
        np.testing.assert_allclose(cell.end_rates, (last - before)[0] / (2 * step), atol=1e-7)
        if k:
            meets = cells[k - 1]
            assert meets.end == cell.start
            own = cell.corners_at(np.array([cell.start]))
            np.testing.assert_allclose(meets.corners_at(np.array([cell.start])), own, atol=1e-9)
            one, other = (built.sites(np.array([i]), np.array([cell.start]), *[nothing] * 3)
                          for i in (k - 1, k))  # fmt: skip
            np.testing.assert_allclose(one.gaps, other.gaps, atol=1e-9)


@pytest.mark.parametrize("transition", ["linear", "smooth"])
def test_gaps_and_thickness_run_with_the_section(transition):
    """Half way through a transition gaps are the mean of both sides; a plate is as thick as its
    stock less what its chamfer takes, which grows evenly to the difference at the joint."""
    built = law(transition)
    zone = [k for k, cell in enumerate(built.cells) if cell.is_transition]
    middle = 0.5 * (built.cells[zone[0]].start + built.cells[zone[-1]].end)
    at = next(k for k in zone if built.cells[k].start <= middle <= built.cells[k].end)
    sites = built.sites(np.array([at]), np.array([middle]), *[np.zeros(1)] * 3)
    top = [strip.face for strip in built.strips].index("top")
    np.testing.assert_allclose(sites.gaps[0, top], [2.5, 2.5], atol=1e-9)
    change = next(c for c in built.changes if c.strip == top)
    begin, end = change.chamfer
    assert end == change.place and change.depth == 8.0
    for part in (0.25, 0.75):
        s = begin + part * (end - begin)
        k = next(i for i, c in enumerate(built.cells) if c.start <= s <= c.end)
        sites = built.sites(np.array([k]), np.array([s]), *[np.zeros(1)] * 3)
        assert sites.stock[0, top] == 24.0
        assert sites.thickness[0, top] == pytest.approx(24.0 - 8.0 * part, abs=1e-9)


def test_joints_and_chamfers_are_told_of_each_face():
    """A face is cut where its own plate changes, and only the thicker side has a chamfer."""
    built = law()
    for change in built.changes:
        assert built.joints_of(change.strip) == (change.place,)
        before = built.chamfers_of(change.strip, 0.0, change.place)
        behind = built.chamfers_of(change.strip, change.place, LENGTH)
        assert before[0] is None and behind == (None, None)
        assert before[1].length == pytest.approx(change.chamfer[1] - change.chamfer[0])
        assert (before[1].depth, before[1].faces) == (8.0, "inner")
    assert built.all_joints == tuple(sorted({c.place for c in built.changes}))
    assert len(built.changes) == 4


def test_a_step_cuts_every_face_at_once_and_has_no_length():
    """Slope 0: every face ends at the cut."""
    built = section_law("M1", [Segment(BIG), Segment(SMALL, 9000.0, 0.0)], LENGTH)
    assert all(built.joints_of(k) == (9000.0,) for k in range(4))
    assert built.all_joints == built.joints == (9000.0,)
    assert [cell.label for cell in built.cells] == ["d-1", "d-2"]
    assert built.zone_ends.tolist() == [True]
    assert built.felt.all()


def test_a_strip_feels_its_own_changes_and_those_of_the_strips_it_stops_at():
    """Webs of a box1 stop at nothing: where only a flange changes they run on; flanges stop at the
    webs and feel theirs."""
    built = law()
    faces = [strip.face for strip in built.strips]
    webs = [faces.index("left"), faces.index("right")]
    for k, row in enumerate(built.felt):
        before, after = built.cells[k], built.cells[k + 1]
        if built.zone_ends[k]:
            assert before.label != after.label and row.all()
            continue
        changed = before.thickness != after.thickness
        for cell in (before, after):
            if cell.chamfer is not None:
                changed = changed | (cell.chamfer[1] != 0.0)
        assert changed.any()
        assert row[webs].tolist() == changed[webs].tolist()
        for face in ("top", "bottom"):
            own = faces.index(face)
            assert row[own] == (changed[own] or changed[webs].any())


def test_what_rails_are_made_from_changes_with_every_size_but_the_end():
    """Prints are the same for the same law, and another's where anything differs."""
    one, again = law().prints, law().prints
    assert one == again and len(one) == len(law().cells)
    assert law("smooth").prints != one
    assert law(offset_y=1.0).prints[0] == one[0] and law(offset_y=1.0).prints != one
    longer = section_law("M1", [Segment(BIG), Segment(SMALL, 9000.0, 2.5)], LENGTH + 500.0)
    assert longer.prints == one


def test_the_largest_face_step_counts_either_way():
    assert FaceSteps(1.0, -7.0, 3.0, 2.0).largest == 7.0
    assert FaceSteps(1.0, 2.0, -3.0, 9.0).largest == 9.0


def test_a_member_on_its_law_has_the_corners_of_the_cells():
    built = member([Segment(BIG), Segment(SMALL, 9000.0, 2.5)])
    s = np.array([8000.0])
    at = built.frames.at(s)
    plane = built.law.cells[0].corners_at(s)[0]
    wanted = at.origin[0] + plane[:, :1] * at.y[0] + plane[:, 1:] * at.z[0]
    found = built.corners(0.0, built.length)(s).reshape(-1, 3)
    np.testing.assert_allclose(found, wanted, atol=1e-8)
