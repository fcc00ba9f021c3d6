# SPDX-License-Identifier: LGPL-2.1-or-later
"""Joints keep clear of diaphragms, nodes and piece ends: solved ones, and given ones by warning."""

import curved_members
import numpy as np
import pytest
from test_joint_solver import FACES, box_run, keeps_all

from BendTorsionWB.core import rules as rule_packs
from BendTorsionWB.core.detailing import PlatesInput
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.joints.joint_solver import KEEP_OUTS, JointRules, solve_run
from BendTorsionWB.core.plates.diaphragm_input import Diaphragm
from BendTorsionWB.core.plates.plates import Joints, split_plates


def clear(joints, places, distance):
    return all(
        abs(p - q) >= distance - 1e-6 for own in joints.values() for p in own for q in places
    )


@pytest.mark.parametrize("kind", KEEP_OUTS)
def test_solved_joints_keep_their_distance(kind):
    limits = JointRules(**{f"{kind}_clearance": 700.0})
    places = tuple(np.arange(1000.0, 30000.0, 2000.0))
    joints = solve_run(box_run(30000.0), limits, (), keep_outs={kind: places})
    assert sum(map(len, joints.values())) == 8
    assert keeps_all(joints, 30000.0, limits) and clear(joints, places, 700.0)


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("diaphragm", "distance from diaphragms"),
        ("node", "distance from nodes"),
        ("piece_end", "distance from piece ends"),
    ],
)
def test_too_much_to_keep_clear_of_is_said_with_the_nearest_that_would_do(kind, words):
    field = f"{kind}_clearance"
    limits = JointRules(stagger=100.0, longest_piece=2000.0, **{field: 900.0})
    places = (0.0, 1500.0, 3000.0)
    with pytest.raises(BendTorsionError) as caught:
        solve_run(box_run(3000.0), limits, (), keep_outs={kind: places})
    (finding,) = caught.value.findings
    assert finding.code == "joints-infeasible" and words in finding.message
    assert (finding.limit, finding.unit) == (900.0, "mm")
    eased = JointRules(stagger=100.0, longest_piece=2000.0, **{field: finding.value - 1.0})
    joints = solve_run(box_run(3000.0), eased, (), keep_outs={kind: places})
    assert clear(joints, places, finding.value - 1.0)
    assert f"{finding.value:.0f} mm" in finding.mend
    # Two joints 100 apart between places 1500 apart: no more than 700 from either.
    assert 650.0 <= finding.value <= 700.0


@pytest.mark.parametrize("kind", KEEP_OUTS)
def test_given_joints_too_close_are_warned_of_in_mm(kind):
    member = curved_members.tapered()
    limits = JointRules(longest_piece=3e4, **{f"{kind}_clearance": 250.0})
    plates, findings = split_plates(
        member,
        {"top": Joints((5000.0,), "mm"), "left": Joints((6000.0,), "mm")},
        rules=limits,
        keep_outs={kind: (5100.0,)},
    )
    (finding,) = [f for f in findings if f.code.startswith("joint-beside")]
    assert finding.code == f"joint-beside-{kind.replace('_', '-')}"
    assert finding.severity == "warning" and "face top" in finding.message
    assert (finding.value, finding.limit, finding.unit) == (pytest.approx(100.0), 250.0, "mm")
    assert next(p.end for p in plates if p.face == "top") == 5000.0


def test_a_joint_on_the_end_of_a_piece_is_no_fault():
    member = curved_members.tapered()
    joints = dict.fromkeys(FACES, Joints((5000.0,), "mm"))
    limits = JointRules(longest_piece=3e4, stagger=0.0)
    _, findings = split_plates(member, joints, rules=limits, keep_outs={"piece_end": (5000.0,)})
    assert not [f for f in findings if "piece-end" in f.code]


def test_diaphragms_and_nodes_of_the_input_are_kept_clear_of():
    given = PlatesInput(
        diaphragms=(
            Diaphragm(3000.0, 16.0),
            Diaphragm(0.5, 16.0, s_is_ratio=True),
            Diaphragm(0.0, 16.0, end="start"),
        ),
        nodes=(700.0,),
    )
    assert given.keep_outs(8000.0, (4500.0,)) == {
        "diaphragm": [3000.0, 4000.0],
        "node": [700.0],
        "piece_end": [4500.0],
    }


@pytest.mark.parametrize("pack", rule_packs.PACKS)
def test_every_pack_has_the_clearances_with_unit_source_and_status(pack):
    for kind in KEEP_OUTS:
        rule = rule_packs.rule(pack, f"{kind}_clearance")
        assert rule.unit == "mm" and rule.source and "to be verified" in rule.line()
        assert getattr(rule_packs.joint_rules(pack), f"{kind}_clearance") == rule.value > 0.0
