# SPDX-License-Identifier: LGPL-2.1-or-later
"""How much thicker than the plate its solid is where it twists: closed form, nearest points, and
what is told."""

import numpy as np
import pytest
from scipy.optimize import minimize

from BendTorsionWB.core.axes.axis import fit_axis
from BendTorsionWB.core.axes.frames import FrameInput, frames_of
from BendTorsionWB.core.axes.frames_law import GivenDirection
from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.members.member import Member
from BendTorsionWB.core.members.segment import Segment
from BendTorsionWB.core.members.zones import section_law
from BendTorsionWB.core.plates.plates import split_plates
from BendTorsionWB.core.plates.true_thickness import middle_thickness, thickness_findings
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.tolerances import THICKNESS_DRAWN

LENGTH = 6000.0


def plates(turn, thickness=20.0, height=600.0):
    """Of a box on a straight line that turns by `turn` degrees from end to end."""
    ground = analytic_surface("plane", {})
    line = fit_axis("A", np.array([[0.0, 0, 0], [LENGTH / 2, 0, 0], [LENGTH, 0, 0]]), ground)
    law = GivenDirection(0.0, 0.0), GivenDirection(LENGTH, np.radians(turn))
    frames = frames_of(line, ground, FrameInput(twist=law))
    law = section_law("M", [Segment(box("B", "box1", height, 500, thickness))], LENGTH)
    return split_plates(Member("M", frames, law), {})[0]


@pytest.mark.parametrize("turn, thickness", [(20.0, 20.0), (90.0, 20.0), (90.0, 40.0)])
def test_a_twisted_plate_is_thicker_half_way_across_by_the_closed_form(turn, thickness):
    """t √(1 + (τ b / 2)²), b the face from corner to corner of the section, where it is true."""
    rate = np.radians(turn) / LENGTH
    found = plates(turn, thickness)
    for plate, (_, drawn) in zip(found, middle_thickness(found), strict=True):
        half = 250.0 if plate.face in ("top", "bottom") else 300.0
        more = thickness * (np.sqrt(1.0 + (rate * half) ** 2) - 1.0)
        assert drawn - thickness == pytest.approx(more, rel=1e-3)


def test_the_distance_is_that_of_the_nearest_point():
    for plate, (s, drawn) in zip(
        plates(90.0, 40.0), middle_thickness(plates(90.0, 40.0)), strict=True
    ):
        k = len(s) // 2
        ends = np.split(plate.rails.inner([s[k]])[0], 2)

        def away(at, rails=plate.rails.outer, point=0.5 * (ends[0] + ends[1])):
            first, second = np.split(rails([at[0] * LENGTH])[0], 2)
            return np.linalg.norm(first + at[1] * (second - first) - point)

        nearest = minimize(away, [s[k] / LENGTH, 0.5], method="Nelder-Mead", tol=1e-10)
        assert drawn[k] == pytest.approx(nearest.fun, abs=2e-3)


def test_it_is_told_with_the_figure_from_a_tenth_of_a_millimetre_on():
    assert thickness_findings(plates(45.0)) == [] == thickness_findings([])
    found = thickness_findings(plates(90.0, 40.0))
    assert {finding.object for finding in found} == {"M-L1", "M-R1"}
    for finding in found:
        assert finding.code == "twist-thickens" and finding.severity == "warning"
        assert THICKNESS_DRAWN == finding.limit < finding.value < 0.13
