# SPDX-License-Identifier: LGPL-2.1-or-later
"""A member 24 m long in delivery pieces, for tests; and a fixture."""

import numpy as np
import pytest

from BendTorsionWB.core.axes.axis_input import AxisInput
from BendTorsionWB.core.detailing import MemberInput, MemberJob, PlatesInput, detail
from BendTorsionWB.core.geometry.surface import Plane
from BendTorsionWB.core.joints.pieces import PieceInput, end_words
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.plates.plates import Joints
from BendTorsionWB.core.sections.section import box

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
