# SPDX-License-Identifier: LGPL-2.1-or-later
"""Members whose ends are cut, for tests: straight, round a cylinder and twisted; and fixtures."""

import numpy as np
import pytest
from curved_members import tapered

from BendTorsionWB.core.axes.axis import fit_axis
from BendTorsionWB.core.axes.axis_input import AxisInput
from BendTorsionWB.core.axes.frames import FrameInput, surface_frames
from BendTorsionWB.core.detailing import MemberInput, MemberJob, PlatesInput, detail
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.surface import Cylinder, Plane
from BendTorsionWB.core.members.end_cut import SQUARE, EndCut, with_end_cuts
from BendTorsionWB.core.members.member import Member
from BendTorsionWB.core.members.zones import Segment, section_law
from BendTorsionWB.core.plates.plates import split_plates
from BendTorsionWB.core.sections.section import box

S800 = box("B800", "box1", 800, 600, 20, gap1=2, gap2=3)
RADIUS = 12000.0


def job(points, surface, start=SQUARE, end=SQUARE, frame=None, section=S800):
    given = MemberInput(
        "M1",
        (Segment(section),),
        frame=frame or FrameInput(),
        start_cut=start,
        end_cut=end,
    )
    return MemberJob(surface, AxisInput("A1", np.array(points, float)), given, PlatesInput())


def member_from(points):
    """The member itself, along points in the plane z = 0."""
    axis = fit_axis("A1", np.array(points, float), Plane())
    law = section_law("M1", [Segment(S800)], axis.length)
    return Member("M1", surface_frames(axis, Plane()), law)


def straight(start=SQUARE, end=SQUARE):
    """A member 6 m along x, z up: h 800, b 600, t 20."""
    return detail(job([(0, 0, 0), (6000, 0, 0)], Plane(), start, end))


def ring(start=SQUARE, end=SQUARE, angle=0.6):
    """A member round a cylinder of 12 m, whose top and bottom plates are right cylinders."""
    turn = np.linspace(0.0, angle, 121)
    points = np.column_stack([RADIUS * np.cos(turn), RADIUS * np.sin(turn), 0.0 * turn])
    return detail(job(points, Cylinder(RADIUS), start, end))


def plates_of(detailed):
    return {item.plate.face: item.plate for item in detailed.plates.plates}


def records_of(detailed):
    return {plate.face: plate for plate in detailed.record.plates}


def end_run(plate):
    """The run of the outline along line E-2."""
    ends = plate.lines[-1].flat
    miss = [min(abs(run[[0, -1]] - e).max() for e in (ends, ends[::-1])) for run in plate.outline]
    return plate.outline[int(np.argmin(miss))]


def findings_of(call, *arguments):
    with pytest.raises(BendTorsionError) as caught:
        call(*arguments)
    return {found.code: found for found in caught.value.findings}


TILT = EndCut("plane", normal=(1.0, 0.3, -0.5))


@pytest.fixture(scope="module")
def tilted():
    return straight(start=EndCut("plane", normal=(1.0, 0.0, 0.4)), end=TILT)


@pytest.fixture(scope="module")
def sine():
    return ring(end=EndCut("plane", normal=(0.0, 1.0, 0.45)))


@pytest.fixture(scope="module")
def twisted():
    """A tapered member on the ellipsoid, both ends askew."""
    return with_end_cuts(
        tapered(cut=9000.0), (EndCut("plumb"), EndCut("plane", normal=(-2.0, 1.0, 2.0)))
    )


@pytest.fixture(scope="module")
def twisted_plates(twisted):
    return split_plates(twisted, {})[0]
