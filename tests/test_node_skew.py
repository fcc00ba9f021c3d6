# SPDX-License-Identifier: LGPL-2.1-or-later
"""Askew at a node: dihedrals, grooves and gaps of diaphragms, bevels flatter than a head cuts, and
branches that end near each other or near an end."""

import math

import numpy as np
import pytest
from meeting_members import along_x, at_angle, found, straight
from test_sheet_node import LOW, X, at, details
from test_sheet_node import straight as job

from BendTorsionWB.core.nodes.node_input import NodeInput
from BendTorsionWB.core.rules import weld_defaults
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.welds.preps import prep_text

BOTH = "flanges and webs"


def crossed(degrees):
    """Records of a box and one that crosses it at an angle, with diaphragms of all its plates."""
    jobs = {m[0]: job(*m) for m in (X, ("Y", at(degrees, -2500), at(degrees, 2500), LOW))}
    rows = (NodeInput("X", "Y", diaphragms=BOTH),)
    return [one.record for one in details(jobs, rows)]


def web_welds(record):
    """The welds on the walls the branch lands on, of diaphragms that continue its webs."""
    findings = {f.object: f for f in record.findings if f.code.startswith("diaphragm-")}
    return findings, [
        w
        for w in record.welds
        if w.kind == "diaphragm" and w.plates[1].split("-")[1][0] in "LR" and w.name in ("D1", "D2")
    ] + [
        w
        for w in record.welds
        if w.kind == "diaphragm"
        and w.plates[1].split("-")[1][0] in "LR"
        and w.name not in ("D1", "D2")
    ]


@pytest.mark.parametrize("degrees", [40.0, 55.0])
def test_webs_that_cross_askew_have_a_groove_and_no_fillets(degrees):
    findings, welds = web_welds(crossed(degrees)[0])
    skew = [w for w in welds if abs(math.degrees(w.dihedral) - degrees) < 1e-3]
    assert len(skew) >= 4
    for weld in skew:
        assert weld.prep.type == "bevel"
        assert math.degrees(weld.prep.angle) == pytest.approx(90.0 - degrees)
        # 2 mm from the wall to the nearer face, in the plane of the plate.
        assert weld.prep.gap == pytest.approx(2.0 / math.sin(math.radians(degrees)), abs=0.06)
    assert {f.code for f in findings.values()} == {"diaphragm-skew"}
    for finding in findings.values():
        assert finding.value == pytest.approx(degrees, abs=1e-3)
        assert finding.limit == pytest.approx(60.0)
        assert finding.unit == "deg" and "bevel the edge" in finding.mend
        wide = 2.0 / math.sin(math.radians(degrees)) + 12.0 / math.tan(math.radians(degrees))
        assert f"leaves {wide:.0f} mm" in finding.message


def test_a_square_edge_opens_fillets_by_the_dihedral():
    findings, welds = web_welds(crossed(65.0)[0])
    askew = [w for w in welds if abs(math.degrees(w.dihedral) - 65.0) < 1e-3]
    wide = 2.0 / math.sin(math.radians(65.0)) + 12.0 / math.tan(math.radians(65.0))
    assert askew and all(w.prep.type == "double-fillet" for w in askew)
    assert [w.prep.gap for w in askew] == pytest.approx([round(wide)] * len(askew))
    assert {f.code for f in findings.values()} == {"diaphragm-gap"}
    assert all(f.value == pytest.approx(wide, abs=0.06) for f in findings.values())
    assert all(f.limit == 5.0 and "25 degrees" in f.mend for f in findings.values())


def test_square_crossings_keep_their_fillets():
    findings, welds = web_welds(crossed(90.0)[0])
    assert welds and not findings
    assert {prep_text(w.prep) for w in welds} == {"diaphragm: double-fillet gap=2.0 leg=9.0"}


def test_a_bevel_flatter_than_the_head_cuts_is_told_at_its_end():
    """A web at 40 degrees has 70 degrees of bevel on the sharp side: 50 of lean, 20 of groove."""
    record = crossed(40.0)[1]
    told = [f for f in record.findings if f.code == "bevel-beyond-head"]
    limit = math.degrees(weld_defaults("EU").largest_bevel)
    steep = {
        (plate.mark, bevel.edge)
        for plate in record.plates
        for bevel in plate.bevels
        if max(map(abs, np.degrees(bevel.angles))) > limit
    }
    assert steep and {(f.object, f.position.split()[1].rstrip(",")) for f in told} == steep
    for finding in told:
        assert finding.value > finding.limit == pytest.approx(limit) and finding.unit == "deg"
        assert finding.severity == "warning" and "two passes" in finding.mend
    assert not [f for f in crossed(90.0)[1].findings if f.code == "bevel-beyond-head"]


def test_axes_that_coincide_are_one_duplicate():
    twin = straight("Y", (-6000, 0, 0), (6000, 0, 0), section=box("S", "box1", 300, 200, 10))
    base = straight("X", (-6000, 0, 0), (6000, 0, 0), section=box("B", "box1", 600, 400, 16))
    result = found(base, twin)
    (finding,) = result.findings
    assert finding.code == "node-angle" and finding.objects == ("X", "Y")
    assert "duplicate" in finding.message and "delete Y" in finding.mend
    assert len(result.unmade) == 1


def test_a_branch_too_near_an_end_is_told_once_by_the_larger_length():
    y = straight("Y", (-5950, -2500, 0), (-5750, 2500, 0), section=box("S", "box1", 300, 200, 10))
    result = found(along_x(), y)
    (finding,) = [f for f in result.findings if f.code == "node-at-end"]
    x = along_x()
    assert finding.value < finding.limit and x.name in finding.mend
    assert str(math.ceil(finding.limit - finding.value - 1e-6)) in finding.mend


def test_three_in_a_circle_are_told_that_nothing_runs_through():
    rows = (NodeInput("X", "Y"), NodeInput("Y", "Z"), NodeInput("Z", "X"))
    result = found(along_x(), at_angle(60, "Y"), at_angle(120, "Z"), rows=rows)
    (finding,) = [f for f in result.findings if f.severity == "error"]
    assert finding.code == "node-three-through" and finding.objects == ("X", "Y", "Z")
    assert "nothing runs through" in finding.message and "x = " in finding.position
    assert not result.nodes and len(result.unmade) == 3


SLIM = box("S", "box1", 300, 200, 10)


def struts(apart):
    """Two square struts on one face, their sides this far apart there."""
    half = 0.5 * apart + 100.0
    return [
        straight(name, (side * half, 3000, 0), (side * half, 0, 0), section=SLIM)
        for name, side in (("Y", -1.0), ("Z", 1.0))
    ]


@pytest.mark.parametrize("apart", [10.0, 19.0])
def test_struts_side_by_side_are_moved_apart_and_not_together(apart):
    result = found(along_x(), *struts(apart))
    (finding,) = [f for f in result.findings if f.code == "node-branches-near"]
    assert finding.objects == ("Y", "Z") and finding.limit == 100.0
    assert finding.value == pytest.approx(apart, abs=1e-6)
    assert f"{100.0 - apart:.0f} mm or more away" in finding.mend
    assert "members-nearly-touch" not in {f.code for f in result.findings}
    assert [node.kind for node in result.nodes] == ["K"]


def test_struts_that_only_near_each_other_where_they_are_cut_away_are_not_told():
    """Their axes end at the axis of the box, 5 mm apart there and 300 mm at its face."""
    y = straight("Y", (-2200, 3000, 0), (-105, 0, 0), section=SLIM)
    z = straight("Z", (2200, 3000, 0), (105, 0, 0), section=SLIM)
    result = found(along_x(), y, z)
    assert not {f.code for f in result.findings} & {"members-nearly-touch", "node-branches-near"}


@pytest.mark.parametrize(("x", "kind"), [(5350.0, "corner"), (4600.0, "T")])
def test_a_corner_is_within_a_depth_of_the_end(x, kind):
    """On a box 600 deep that ends at 6000: a strut 200 broad at 550 and at 1300 from the end."""
    base = straight("X", (-6000, 0, 0), (6000, 0, 0), section=box("B", "box1", 600, 400, 16))
    y = straight("Y", (x, 3000, 0), (x, 0, 0), section=SLIM)
    (node,) = found(base, y).nodes
    assert node.kind == kind


def test_diaphragms_without_access_are_told_once_for_a_node():
    """Both flanges 70 mm inside those of the box."""
    result = found(along_x(), at_angle(90, section=box("S", "box1", 440, 300, 12)))
    (finding,) = [f for f in result.findings if f.code == "node-diaphragm-access"]
    assert "top of Y" in finding.position and "bottom of Y" in finding.position
