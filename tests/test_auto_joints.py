# SPDX-License-Identifier: LGPL-2.1-or-later
"""Joints by rule that cannot be: said at the cell that asks for them, with what would do."""

import pytest
from test_joint_solver import box_run

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.joints.joint_solver import JointRules, solve_run
from BendTorsionWB.exchange.schedule_jobs import located

AUTO = {("Splits", 3, "joints"): "auto"}


def infeasible():
    """What the solver says of plates that must be longer than the stock."""
    rules = JointRules(longest_piece=2000.0, shortest_piece=1500.0, stagger=700.0)
    with pytest.raises(BendTorsionError) as caught:
        solve_run(box_run(3100.0), rules, (), member="M1")
    return caught.value.findings[0]


def test_joints_by_rule_that_cannot_be_point_at_the_cell_that_asks_for_them(read):
    found = infeasible()
    schedule = read(AUTO)
    line = located(schedule, schedule.member("M1"), found).line()
    assert "sheet Splits, row 3, column joints" in line
    # Without one the member is the place.
    schedule = read()
    assert "sheet Members" in located(schedule, schedule.member("M1"), found).line()


def test_the_proposal_reads_as_a_sentence():
    mend = infeasible().mend
    assert "none mm" not in mend and " joints " in mend
    assert all(f" {face}" in mend for face in ("top", "bottom", "left", "right"))
