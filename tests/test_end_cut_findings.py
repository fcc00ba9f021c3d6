# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ends of members that cannot be cut as asked: named with their end, place, limit and mend."""

import dataclasses

import numpy as np
import pytest
from curved_members import member, tapered
from cut_members import (
    RADIUS,
    S800,
    TILT,
    findings_of,
    job,
    member_from,
    straight,
)

from BendTorsionWB.core.detailing import detail
from BendTorsionWB.core.geometry.surface import Cylinder, Sphere
from BendTorsionWB.core.members.contour import end_curves
from BendTorsionWB.core.members.end_cut import SQUARE, EndCut, with_end_cuts
from BendTorsionWB.core.members.strips import strip_rails
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.plates.plates import Joints, split_plates


@pytest.mark.parametrize(
    ("cut", "code"),
    [
        (EndCut("plane", normal=(0.05, 1.0, 0.0)), "end-cut-along-axis"),
        (EndCut("level"), "end-cut-along-axis"),
        (EndCut("plane", normal=(1.0, 0.0, 0.0), point=(2000.0, 0, 0)), "end-cut-beyond-middle"),
        (EndCut("plane", normal=(1.0, 0.0, 0.0), point=(60000.0, 0, 0)), "end-cut-misses"),
        (EndCut("plane", normal=(0.0, 0.0, 0.0)), "end-cut-normal"),
        (EndCut("plane"), "end-cut-normal"),
        (EndCut("slanted"), "end-cut-kind"),
        (EndCut("surface"), "end-cut-surface"),
        (EndCut("surface", surface=Sphere(100.0, (6000.0, 0.0, 0.0))), "end-cut-misses"),
    ],
)
def test_cuts_that_cannot_be_are_named_with_their_end(cut, code):
    found = findings_of(straight, SQUARE, cut)
    assert code in found
    assert found[code].object == "M1" and found[code].position == "end" and found[code].mend


class _Along:
    """A function of x alone."""

    def __init__(self, value, slope):
        self.value, self.slope = value, slope

    def value_and_gradient(self, points):
        x = points[:, 0]
        return self.value(x), np.column_stack([self.slope(x), 0.0 * x, 0.0 * x])


@pytest.mark.parametrize(
    ("value", "slope", "code"),
    [
        (lambda x: x - 9000.0, lambda x: 1.0 + 0.0 * x, "end-leaves-nothing"),
        (lambda x: x + 9000.0, lambda x: 1.0 + 0.0 * x, "end-missed"),
        (
            lambda x: (x - 100.0) * (x - 900.0) * (x - 2000.0) * 1e-6,
            lambda x: (3.0 * x**2 - 6000.0 * x + 2.09e6) * 1e-6,
            "end-cut-twice",
        ),
    ],
)
def test_ends_that_miss_a_plate_or_cut_it_twice_are_located(value, slope, code):
    flat = member_from([(0, 0, 0), (6000, 0, 0)])
    rails = strip_rails(flat, 0, 0.0, 6000.0)
    found = findings_of(end_curves, "M1 top", rails, _Along(value, slope), 0)
    assert found[code].object == "M1 top" and found[code].mend
    assert "w = 0.00" in found[code].position and "outer surface" in found[code].position


def test_a_cut_over_a_joint_or_a_transition_is_refused():
    built = member([Segment(S800)])
    skew = with_end_cuts(built, (EndCut("plumb"), SQUARE))
    found = findings_of(split_plates, skew, {"top": Joints((60.0,), "mm")})
    assert "end-cut-over-joint" in found and "top" in found["end-cut-over-joint"].position
    found = findings_of(with_end_cuts, tapered(cut=200.0), (EndCut("plumb"), SQUARE))
    assert found["end-cut-in-transition"].limit == 200.0


def test_the_same_cut_is_the_same_member_and_another_is_another(tilted):
    again = straight(start=EndCut("plane", normal=(1.0, 0.0, 0.4)), end=TILT)
    assert again.plates is tilted.plates
    assert straight().plates is not tilted.plates


def test_a_ring_has_no_ends_to_cut():
    turn = np.linspace(0.0, 2.0 * np.pi, 25)[:-1]
    points = RADIUS * np.column_stack([np.cos(turn), np.sin(turn), 0.0 * turn])
    given = job(points, Cylinder(RADIUS), end=EndCut("plumb"))
    closed = dataclasses.replace(given.axis, closed=True)
    found = findings_of(detail, dataclasses.replace(given, axis=closed))
    assert "end-cut-closed" in found
