# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lanes: faces divided along into plates that share their seams to the digit and add up."""

import numpy as np
import pytest
from curved_members import member, tapered

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.joints.joint_solver import JointRules
from BendTorsionWB.core.joints.lanes import Lanes
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.patterns.laid_flat import laid_flat
from BendTorsionWB.core.plates.plates import Joints, split_plates
from BendTorsionWB.core.sections.section import box

FACES = ("top", "bottom", "left", "right")


@pytest.fixture(scope="module")
def taper():
    return tapered()


@pytest.fixture(scope="module")
def divided(taper):
    return split_plates(
        taper,
        {"top": Joints((0.4,))},
        lanes={"top": Lanes((0.3, 0.6)), "left": Lanes((300.0,), "mm")},
    )[0]


def test_marks_and_edges_name_the_lanes(divided):
    top = [p for p in divided if p.face == "top" and p.mark.startswith("M1-T2")]
    assert [p.mark for p in top] == ["M1-T2a", "M1-T2b", "M1-T2c"]
    assert [p.edges for p in top] == [
        ("left", "seam 1"),
        ("seam 1", "seam 2"),
        ("seam 2", "right"),
    ]
    assert {p.mark for p in divided if p.face == "bottom"} == {"M1-B1", "M1-B2"}


def test_rails_of_lanes_are_linear_in_those_of_the_face(taper, divided):
    whole = {p.mark: p for p in split_plates(taper, {"top": Joints((0.4,))})[0]}
    for number in (1, 2, 3):
        face = whole[f"M1-T{number}"]
        lanes = [p for p in divided if p.mark[:-1] == face.mark]
        s = np.linspace(face.start, face.end, 41)
        for level in ("outer", "mid", "inner"):
            rails = getattr(face.rails, level)(s)
            one, two = rails[:, :3], rails[:, 3:]
            for lane, (a, b) in zip(lanes, ((0.0, 0.3), (0.3, 0.6), (0.6, 1.0)), strict=True):
                own = getattr(lane.rails, level)(s)
                expected = np.hstack([one + a * (two - one), one + b * (two - one)])
                np.testing.assert_allclose(own, expected, atol=1e-8)
        assert [line.s for line in lanes[0].lines] == [line.s for line in face.lines]
        assert sum(p.volume for p in lanes) == pytest.approx(face.volume, rel=1e-9)


def test_both_sides_of_a_seam_have_one_length_flat_and_formed(taper, divided):
    plates = {p.mark: p for p in laid_flat(taper, divided)}
    for one, two, seam in (
        ("M1-T1a", "M1-T1b", "seam 1"),
        ("M1-T2b", "M1-T2c", "seam 2"),
        ("M1-L1a", "M1-L1b", "seam 1"),
    ):
        sides = [
            {p.panel: (p.flat, p.arc) for p in plates[mark].panels if p.what == f"edge {seam}"}
            for mark in (one, two)
        ]
        assert sides[0].keys() == sides[1].keys() and len(sides[0]) > 1
        np.testing.assert_allclose(*(list(side.values()) for side in sides), atol=1e-6)
        assert plates[one].errors.seam < 1e-6


def test_mm_are_measured_at_the_widest_place(taper, divided):
    left = next(p for p in divided if p.mark == "M1-L1a")
    widths = np.linalg.norm(
        left.rails.outer.values[..., 3:] - left.rails.outer.values[..., :3], axis=2
    )
    assert widths.max() == pytest.approx(300.0, abs=1e-3)


def test_auto_takes_as_few_even_lanes_as_the_stock_allows():
    wide = member([Segment(box("W", "box2", 2600, 2600, 30))])
    rules = JointRules(widest_piece=2400.0)
    auto = dict.fromkeys(FACES, Lanes((), "auto"))
    joints = dict.fromkeys(FACES, Joints((), "auto"))
    plates, findings = split_plates(wide, joints, rules=rules, lanes=auto)
    assert findings == ()
    assert {p.lane.letter for p in plates if p.face == "top"} == {"a", "b"}
    for record in laid_flat(wide, plates):
        assert record.width <= 2400.0 and record.length <= 12000.0
    with pytest.raises(BendTorsionError) as caught:
        split_plates(wide, joints, rules=rules)
    assert caught.value.findings[0].code == "stock-too-narrow"
    narrow = JointRules(widest_piece=600.0)
    with pytest.raises(BendTorsionError) as caught:
        split_plates(wide, joints, rules=narrow, lanes=auto)
    finding = caught.value.findings[0]
    assert (finding.code, finding.value) == ("stock-too-narrow", 600.0)
    assert finding.limit == pytest.approx(650.0, abs=0.01) and "651" in finding.mend


@pytest.mark.parametrize(
    ("given", "word"),
    [
        (Lanes((0.6, 0.3)), "rise"),
        (Lanes((-0.2, 0.3)), "rise"),
        (Lanes((0.5, 1.2)), "beyond"),
        (Lanes((400.0, 900.0), "mm"), "beyond"),
        (Lanes((0.5, 0.501)), "no width"),
        (Lanes((float("nan"),)), "numbers"),
        (Lanes(tuple(np.linspace(0.02, 0.98, 40))), "more than"),
    ],
)
def test_seams_that_cannot_be_are_refused_at_their_face(taper, given, word):
    with pytest.raises(BendTorsionError) as caught:
        split_plates(taper, {}, lanes={"top": given})
    (finding,) = caught.value.findings
    assert finding.code == "lanes" and word in finding.message
    assert "face top" in finding.position and finding.mend


def test_lanes_of_an_unknown_face_are_refused(taper):
    with pytest.raises(BendTorsionError) as caught:
        split_plates(taper, {}, lanes={"lid": Lanes((0.5,))})
    assert "lid" in caught.value.findings[0].message


def test_lanes_narrower_than_a_quarter_are_a_warning(taper):
    _, findings = split_plates(
        taper, {}, rules=JointRules(longest_piece=3e4), lanes={"top": Lanes((0.2,))}
    )
    (finding,) = [f for f in findings if f.code == "lane-too-narrow"]
    assert (finding.value, finding.limit) == (pytest.approx(0.2), 0.25)
