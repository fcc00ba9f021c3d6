# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solved joints keep every rule, are as few as an exhaustive search finds, or say why not."""

import itertools

import curved_members
import numpy as np
import pytest

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.joints.joint_solver import FaceRun, JointRules, solve_joints, solve_run
from BendTorsionWB.core.patterns.pattern import develop_plate
from BendTorsionWB.core.plates.plates import Joints, split_plates
from BendTorsionWB.core.sections.section import NEIGHBOURS

FACES = tuple(NEIGHBOURS)


def box_run(length, width=800.0, given=None, stretch=None, turn=0.0):
    """The four faces of a straight box; stretch: edge length per axis length by face."""
    s = np.linspace(0.0, length, 41)
    given, stretch = given or {}, stretch or {}
    return [
        FaceRun(
            face,
            NEIGHBOURS[face],
            s,
            np.stack([s, s * stretch.get(face, 1.0)]),
            np.full(41, width),
            turn * s / length,
            given.get(face),
        )
        for face in FACES
    ]


def keeps_all(joints, length, rules, folds=(), stretch=None):
    """True when joints of all faces keep the rules, tested one by one."""
    stretch = stretch or {}
    for face, places in joints.items():
        ends = np.array([0.0, *places, length])
        longest = np.diff(ends) * max(1.0, stretch.get(face, 1.0))
        shortest = np.diff(ends) * min(1.0, stretch.get(face, 1.0))
        if longest.max() > rules.longest_piece + 1e-6:
            return False
        if shortest.min() < rules.shortest_piece - 1e-6:
            return False
        if any(abs(p - f) < rules.fold_clearance - 1e-6 for p in places for f in folds):
            return False
        for other in NEIGHBOURS[face]:
            if any(abs(p - q) < rules.stagger - 1e-6 for p in places for q in joints[other]):
                return False
    return True


def fewest_by_trying_all(length, rules, folds, step):
    """The least number of joints over the four faces, on a grid, opposite faces alike."""
    grid = np.arange(step, length, step)
    sets = [
        set_
        for count in range(4)
        for set_ in itertools.combinations(grid, count)
        if np.diff([0.0, *set_, length]).max() <= rules.longest_piece
        and np.diff([0.0, *set_, length]).min() >= rules.shortest_piece
        and all(abs(p - f) >= rules.fold_clearance for p in set_ for f in folds)
    ]
    counts = [
        2 * (len(one) + len(two))
        for one in sets
        for two in sets
        if all(abs(p - q) >= rules.stagger for p in one for q in two)
    ]
    return min(counts, default=None)


@pytest.mark.parametrize("seed", range(12))
def test_as_few_joints_as_trying_all_finds(seed):
    random = np.random.default_rng(seed)
    length = 100.0 * random.integers(16, 30)
    rules = JointRules(
        stagger=100.0 * random.integers(1, 4),
        shortest_piece=100.0 * random.integers(2, 6),
        longest_piece=100.0 * random.integers(8, 16),
        fold_clearance=100.0,
    )
    folds = tuple(100.0 * random.integers(3, 14, size=2))
    expected = fewest_by_trying_all(length, rules, folds, 100.0)
    assert expected is not None
    joints = solve_run(box_run(length), rules, folds)
    assert keeps_all(joints, length, rules, folds)
    assert sum(map(len, joints.values())) <= expected
    assert solve_run(box_run(length), rules, folds) == joints


def test_no_joint_where_one_piece_will_do():
    joints = solve_run(box_run(11900.0), JointRules(), ())
    assert joints == dict.fromkeys(FACES, ())


def test_pieces_are_as_even_as_the_stagger_allows():
    joints = solve_run(box_run(20000.0), JointRules(), ())
    assert sorted(joints["top"] + joints["left"]) == [9900.0, 10100.0]
    assert joints["top"] == joints["bottom"] and joints["left"] == joints["right"]


def test_the_longest_edge_governs():
    # 5 % longer on the outside of the bend: 11500 of the axis is 12075 of plate.
    stretch = {"left": 1.05}
    joints = solve_run(box_run(11500.0, stretch=stretch), JointRules(), ())
    assert len(joints["left"]) == 1 and joints["top"] == ()
    assert keeps_all(joints, 11500.0, JointRules(), stretch=stretch)


def test_a_face_bowed_in_its_plane_is_cut_for_the_width_of_the_stock():
    # Sagitta Lψ/8: 10 m turning 1.2 rad rises 1500 mm, 800 wide on 1400: two pieces.
    joints = solve_run(box_run(10000.0, turn=1.2), JointRules(widest_piece=1400.0), ())
    assert len(joints["top"]) == 1
    assert solve_run(box_run(10000.0, turn=0.4), JointRules(widest_piece=1400.0), ())["top"] == ()


def test_given_joints_stay_and_are_kept_clear_of():
    given = {"top": (6000.0, 12000.0)}
    joints = solve_run(box_run(18000.0, given=given), JointRules(), ())
    assert "top" not in joints
    for face in ("left", "right"):
        assert all(abs(p - g) >= 200.0 for p in joints[face] for g in given["top"])
    assert keeps_all({**joints, **given}, 18000.0, JointRules())


@pytest.mark.parametrize(
    ("length", "rules", "binding", "field"),
    [
        (1700.0, JointRules(longest_piece=950.0, shortest_piece=800.0), "stagger", "stagger"),
        (1100.0, JointRules(longest_piece=600.0), "shortest piece", "shortest_piece"),
        (
            2000.0,
            JointRules(longest_piece=1100.0, shortest_piece=600.0, fold_clearance=800.0),
            "distance from folds",
            "fold_clearance",
        ),
    ],
)
def test_what_cannot_be_is_said_with_the_rule_and_a_proposal_that_works(
    length, rules, binding, field
):
    folds = (1000.0,) if field == "fold_clearance" else ()
    with pytest.raises(BendTorsionError) as caught:
        solve_run(box_run(length), rules, folds, member="M7")
    (finding,) = caught.value.findings
    assert (finding.code, finding.object) == ("joints-infeasible", "M7")
    assert binding in finding.message
    assert finding.limit == getattr(rules, field)
    relaxed = JointRules(**{**vars(rules), field: finding.value - 1.0})
    proposal = solve_run(box_run(length), relaxed, folds)
    assert keeps_all(proposal, length, relaxed, folds)
    # And it is the nearest: asking a grid step more of the rule finds nothing.
    strict = JointRules(**{**vars(rules), field: finding.value + 25.0})
    with pytest.raises(BendTorsionError):
        solve_run(box_run(length), strict, folds)
    for place in proposal["top"]:
        assert f"{place:.0f}" in finding.mend


def test_stock_narrower_than_a_face_is_refused():
    with pytest.raises(BendTorsionError) as caught:
        solve_run(box_run(9000.0, width=2500.0), JointRules(), ())
    finding = caught.value.findings[0]
    assert (finding.code, finding.value, finding.limit) == ("stock-too-narrow", 2500.0, 2400.0)


@pytest.fixture(scope="module")
def member():
    return curved_members.tapered()


def test_plates_of_a_member_fit_the_stock_and_keep_the_rules(member):
    rules = JointRules(longest_piece=6000.0, widest_piece=1100.0)
    joints = {face: Joints((), "auto") for face in FACES}
    plates, findings = split_plates(member, joints, rules=rules)
    assert findings == ()
    for plate in plates:
        record = develop_plate(plate)
        assert record.length <= 6000.0 and record.width <= 1100.0
        assert plate.end - plate.start >= 250.0
    forced = set(member.law.joints)
    places = {face: {p.end for p in plates if p.face == face} - {member.length} for face in FACES}
    for face in FACES:
        assert forced <= places[face]
        for other in NEIGHBOURS[face]:
            for a, b in itertools.product(places[face] - forced, places[other]):
                assert abs(a - b) >= rules.stagger


def test_faces_with_given_joints_are_left_alone(member):
    given = (5000.0, 9250.0, 14000.0, 20000.0)
    solved = solve_joints(
        member,
        {face: given if face == "top" else None for face in FACES},
        NEIGHBOURS,
        JointRules(),
    )
    assert set(solved) == {"bottom", "left", "right"}
    joints, _ = split_plates(
        member,
        {"top": Joints(given, "mm"), "left": Joints((), "auto")},
        rules=JointRules(),
    )
    ends = [plate.end for plate in joints if plate.face == "top"]
    forced = member.law.joints_of(FACES.index("top"))
    np.testing.assert_allclose(ends, sorted({*given, *forced, member.length}))


def test_auto_joints_too_short_for_the_stretch_name_the_member(member):
    with pytest.raises(BendTorsionError) as caught:
        split_plates(member, {"top": Joints((), "auto")}, rules=JointRules(widest_piece=700.0))
    assert caught.value.findings[0].object == member.name
    assert caught.value.findings[0].code == "stock-too-narrow"
