# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a schedule asks for lanes, flattening and allowances, and how that reaches the documents."""

import pytest
from schedule_books import one

from BendTorsionWB.core.joints.lanes import Lanes
from BendTorsionWB.core.patterns.gross import Allowances
from BendTorsionWB.core.patterns.laid_flat import PLAIN
from BendTorsionWB.exchange.schedule_jobs import SPLIT_CODES, job_of


def test_nothing_said_is_plain(read):
    schedule = read()
    assert schedule.member("M1").patterns == PLAIN
    assert job_of(schedule, schedule.member("M1")).plates.lanes == {}


def test_settings_hold_where_the_member_says_nothing(read):
    settings = {"mode": "energy", "shrinkage_along": 0.6, "splice": "before forming"}
    changes = {}
    for row, (key, value) in enumerate(settings.items(), start=5):
        changes |= {("Settings", row, "key"): key, ("Settings", row, "value"): value}
    changes |= {
        ("Members", 2, "shrinkage_along"): 0.9,
        ("Members", 2, "joint_allowance"): 1.5,
        ("Members", 2, "green_end"): 50,
        ("Members", 2, "marking_face"): "outside",
        ("Members", 2, "flattened_surface"): "outer",
    }
    schedule = read(changes)
    given = schedule.member("M1").patterns
    assert (given.mode, given.surface, given.marking_face) == ("energy", "outer", "outside")
    assert given.allowances == Allowances(
        shrinkage_along=0.9, joint=1.5, green_end=50.0, splice="before forming"
    )
    assert job_of(schedule, schedule.member("M1")).patterns == given


def test_lanes_go_with_or_without_joints(read):
    schedule = read({("Splits", 2, "lanes"): "0.3 0.6 1", ("Splits", 3, "lanes"): "auto"})
    plates = job_of(schedule, schedule.member("M1")).plates
    assert plates.lanes == {"top": Lanes((0.3, 0.6)), "left": Lanes((), "auto")}
    alone = read({("Splits", 2, "joints"): None, ("Splits", 2, "lanes"): "450"})
    plates = job_of(alone, alone.member("M1")).plates
    assert plates.lanes["top"] == Lanes((450.0,), "mm")
    assert set(plates.joints) == {"left"}


@pytest.mark.parametrize(
    ("sheet", "column", "value", "code", "word"),
    [
        ("Splits", "lanes", "0.6 0.3", "lanes-not-rising", "rising"),
        ("Splits", "lanes", "0.6 800", "lanes-mixed", "ratios"),
        ("Members", "mode", "best", "unknown-value", "edges"),
        ("Members", "shrinkage_along", -1, "out-of-range", "at least 0"),
        ("Members", "joint_allowance", 80, "out-of-range", "at most 50"),
        ("Members", "splice", "later", "unknown-value", "before forming"),
    ],
)
def test_a_bad_cell_is_named(read, sheet, column, value, code, word):
    finding = one(read, {(sheet, 2, column): value})
    assert finding.position == f"sheet {sheet}, row 2, column {column}"
    assert finding.code == code and word in finding.mend


def test_allowances_belong_to_the_first_segment(read):
    finding = one(read, {("Members", 3, "joint_allowance"): 1.0})
    assert finding.code == "first-segment-only"


def test_findings_on_lanes_are_said_at_the_splits():
    assert "lanes" in SPLIT_CODES


def test_documents_hold_it_as_properties_and_follow_an_edit(tmp_path):
    import FreeCAD

    from BendTorsionWB import make
    from BendTorsionWB.objects import unfold as unfold_object

    document = FreeCAD.newDocument("patterns", hidden=True)
    try:
        surface = make.make_surface(document, "S", "cylinder", r=20000.0)
        points = [(20000.0, 0.0, 0.0), (19960.0, 1200.0, 1500.0), (19840.0, 2500.0, 3000.0)]
        axis = make.make_axis(document, "A1", surface, points)
        member = make.make_member(
            document, "M1", axis, [make.make_section(document, "B", h=600, b=600, t=16)]
        )
        plates = make.make_plates(
            document, member, {"left": [0.5]}, lanes={"top": [0.5], "bottom": "auto"}, nodes=[900]
        )
        unfold = make.make_unfold(
            document, plates, shrinkage_along=1.0, green_start=40.0, flattened_surface="mid"
        )
        document.recompute()
        assert plates.Status == unfold.Status == "ok"
        assert list(plates.Marks)[:2] == ["M1-T1a", "M1-T1b"]
        assert all(g > 1.0009 * n for g, n in zip(unfold.GrossAreas, unfold.Areas, strict=True))
        assert 0.0 <= unfold.SeamMismatchMax < 1e-6 and unfold.EdgeErrorMax < 1e-6
        before = list(unfold.GrossAreas)
        unfold.ShrinkageAlong, unfold.GreenStart = 0.0, 0.0
        document.recompute()
        assert list(unfold.GrossAreas) == pytest.approx(list(unfold.Areas))
        assert before != list(unfold.GrossAreas)
        plates.LanesTop = [0.4, 700.0]
        document.recompute()
        assert "mixed" in plates.Status + " ".join(plates.Findings)
        plates.LanesTop = []
        unfold.JointAllowance = -1.0
        document.recompute()
        assert len(plates.Marks) == 5
        record = unfold_object.pattern_input(unfold)
        assert record.allowances.joint == -1.0 and "allowance" in " ".join(unfold.Findings)
    finally:
        FreeCAD.closeDocument(document.Name)
