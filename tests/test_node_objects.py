# SPDX-License-Identifier: LGPL-2.1-or-later
"""Node objects: editing anything moves the node and everything cut at it, and nothing is stale."""

import json
import subprocess
import sys
from pathlib import Path

import FreeCAD
import openpyxl
import pytest
from curved_members import diagonal, irregular
from meeting_members import counter
from schedule_books import write
from workbook_parts import workbook_parts

from BendTorsionWB import make
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.document import build_document
from BendTorsionWB.document_nodes import nodes_told
from BendTorsionWB.document_rows import rows_of
from BendTorsionWB.objects import node as node_object
from BendTorsionWB.objects.proxy import findings_of
from BendTorsionWB.project import build, read_project


@pytest.fixture
def hall(document):
    """Two members that cross, their plates and the node between them, recomputed."""
    surface = make.make_surface(document, "Hall", "ellipsoid", a=40000, b=30000, c=20000)
    big = make.make_section(document, "Big", "box1", h=800, b=800, t=20)
    low = make.make_section(document, "Low", "box1", h=600, b=400, t=14)
    members, plates = [], []
    for name, curve, section in (("M1", diagonal, big), ("M2", counter, low)):
        axis = make.make_axis(document, f"A-{name}", surface, irregular(curve))
        members.append(make.make_member(document, name, axis, [section], [{"align": "top"}]))
        plates.append(make.make_plates(document, members[-1]))
    node = make.make_node(document, *members, "N1", plates=plates)
    document.recompute()
    assert node.Status == "ok", node.Status
    return {"big": big, "low": low, "M1": members[0], "M2": members[1], "node": node} | {
        "plates1": plates[0],
        "plates2": plates[1],
    }


def state(obj):
    return obj.Status, tuple(obj.Marks), round(obj.Volume.Value)


def test_limits_of_a_node_are_those_of_its_checks(document, hall):
    """What lies within is built, what lies beyond is an error; in whatever state the node is."""
    node = hall["node"]
    found = node_object.limits(node)
    node.Type, node.Gap = "stub", 500.0
    document.recompute()
    assert node.Status.startswith("error") and node_object.limits(node)["Gap"] == found["Gap"]
    node.Gap = 3.0
    assert node_object.limits(node) == found
    for name, beyond in (("Gap", 0.1), ("StubLength", 10.0)):
        least, most = found[name]
        assert most > least
        outside = [most + beyond] + ([least - beyond] if least else [])
        for value, good in [(most, True), (least, True), *((v, False) for v in outside)]:
            node.StubLength = found["StubLength"][0] + 200.0
            setattr(node, name, value)
            document.recompute()
            assert (node.Status == "ok") == good, (name, value, node.Status)
        node.Gap = 3.0
    node.Other = None
    document.recompute()
    assert node_object.limits(node) == {}


def test_a_node_cuts_its_branch_and_tells_what_it_is(hall):
    node, plates = hall["node"], hall["plates2"]
    assert node.Kind == "crossing" and list(node.LandsOn) == ["left", "right"]
    assert abs(node.CrossingAngle.Value - 88.3) < 0.1 and node.AxisDistance.Value < 0.1
    assert len(node.Shape.Wires) == 8
    assert list(plates.Marks) == [f"M2-{letter}{n}" for letter in "TBLR" for n in (1, 2)]
    assert plates.Status == "ok" and all(solid.isValid() for solid in plates.Shape.Solids)
    # The through member keeps its plates and gains a diaphragm below the branch's bottom flange.
    assert list(hall["plates1"].Marks) == ["M1-T1", "M1-B1", "M1-L1", "M1-R1", "M1-D1"]


def changed_by(document, hall, edit):
    before = state(hall["plates2"])
    edit()
    document.recompute()
    assert hall["plates2"].Status == "ok", hall["plates2"].Status
    return before[2] - state(hall["plates2"])[2]


def test_edits_of_the_through_member_move_the_cut(document, hall):
    """A broader, a lifted and a moved through member, each takes its own from the branch."""

    def broader():
        hall["big"].Breadth = 900

    # 2 x 50 mm of 600 x 400 x 14 less, along the branch.
    section = 2 * (600 + 400 - 28) * 14
    assert changed_by(document, hall, broader) == pytest.approx(100 * section, rel=0.02)
    place = hall["node"].PlaceOther.Value

    def moved():
        hall["M1"].Axis.StartExtension = 10.0
        hall["M2"].Axis.StartExtension = 500.0

    assert changed_by(document, hall, moved) < -400 * section / 2
    assert hall["node"].PlaceOther.Value == pytest.approx(place + 500.0, abs=0.5)
    hall["node"].Gap = 13.0
    assert changed_by(document, hall, lambda: None) == pytest.approx(20 * section, rel=0.02)


def test_ranks_decide_and_swap_the_branch(document, hall):
    hall["M1"].Rank, hall["M2"].Rank = 1, 2
    hall["node"].ThroughBy = "rank"
    document.recompute()
    assert len(hall["plates2"].Marks) == 8 and len(hall["plates1"].Marks) == 5
    hall["low"].Height, hall["low"].Breadth = 800, 800
    hall["M2"].Rank = 0
    hall["M1"].Rank = 0
    document.recompute()
    assert "node-unresolved" in hall["node"].Findings[0]
    assert hall["plates1"].Status != "ok" and hall["plates2"].Status != "ok"
    assert not hall["plates2"].Shape.Solids
    # In tables of the document it is a meeting with the code of its error, at its place.
    (told,) = nodes_told([hall["node"]], {}, {}, ())
    assert (told.node, told.status, told.faces) == ("N1", "node-unresolved", ())
    assert {told.through, told.other} == {"M1", "M2"} and told.gap == hall["node"].Gap.Value
    hall["M1"].Rank, hall["M2"].Rank = 3, 2
    document.recompute()
    assert hall["node"].Status == "ok", hall["node"].Status
    assert nodes_told([hall["node"]], {}, {}, ()) is None
    assert len(hall["plates1"].Marks) == 8 and len(hall["plates2"].Marks) == 4


def test_a_failing_node_puts_the_plates_in_error_and_coming_back_brings_them_back(document, hall):
    good = state(hall["plates2"])
    hall["low"].Height = 1200
    document.recompute()
    assert {f.code for f in findings_of(hall["node"])} == {"branch-wider-than-face"}
    for name in ("plates1", "plates2"):
        assert "branch-wider-than-face" in hall[name].Findings[0]
        assert not hall[name].Shape.Solids and not hall[name].Marks
    hall["low"].Height = 600
    document.recompute()
    assert state(hall["plates2"]) == good


def test_a_deleted_node_leaves_the_branch_whole(document, hall):
    document.removeObject(hall["node"].Name)
    document.recompute()
    assert len(hall["plates2"].Marks) == 4 and hall["plates2"].Status == "ok"


def schedule(path, nodes=(), ranks=(1, 2), height=600, far=False):
    """Two members that cross on the ellipsoid, or pass each other."""
    points = [
        [axis, number, *(float(v) for v in point + [0, 0, 3000.0 * (far and axis == "B")])]
        for axis, curve in (("A", diagonal), ("B", counter))
        for number, point in enumerate(irregular(curve), start=1)
    ]
    sheets = {
        "Surfaces": [
            ["surface", "kind", "parameters"],
            ["H", "ellipsoid", "a=40000 b=30000 c=20000"],
        ],
        "Axes": [["axis", "surface", "fit"], ["A", "H", "keep"], ["B", "H", "keep"]],
        "Points": [["axis", "no", "x", "y", "z"], *points],
        "Sections": [
            ["section", "type", "h", "b", "t"],
            ["S1", "box1", 800, 800, 20],
            ["S2", "box1", height, 400, 14],
        ],
        "Members": [
            ["member", "segment", "axis", "section", "align", "rank"],
            ["M1", 1, "A", "S1", "top", ranks[0]],
            ["M2", 1, "B", "S2", "top", ranks[1]],
        ],
    }
    if nodes:
        sheets["Nodes"] = [
            ["node", "through", "other", "s", "type", "gap", "stub_length", "diaphragms"],
            *nodes,
        ]
    return write(path, sheets)


def test_a_built_schedule_has_its_node_everywhere(tmp_path):
    row = ["K1", "M1", "M2", None, "stub", 4, 1200, "flanges"]
    result = build(schedule(tmp_path / "s.xlsx", [row]), tmp_path / "out", workers=1)
    assert not result.failed, [f.line() for f in result.findings]
    report = json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    one, two = report["members"]
    assert one["nodes"] == [] and [p["mark"] for p in one["plates"]][-1] == "M1-D1"
    (node,) = two["nodes"]
    assert (node["node"], node["through"], node["type"], node["gap_mm"]) == ("K1", "M1", "stub", 4)
    # Two field joints behind the stubs, and the cut between.
    assert len(two["plates"]) == 16
    book = openpyxl.load_workbook(tmp_path / "out" / "results.xlsx")
    assert [cell.value for cell in book["Nodes"][2]][:4] == ["K1", "crossing", "M1", "M2"]
    assert book["NodeSteps"].max_row == 1 + 8
    document = FreeCAD.openDocument(str(tmp_path / "out" / "model.FCStd"), hidden=True)
    try:
        (node,) = [o for o in document.Objects if getattr(o, "BT_Type", "") == "Node"]
        assert (node.Label, node.Type, node.Gap.Value) == ("K1", "stub", 4.0)
        assert node.Through.Label == "M1" and node.Status == "ok"
    finally:
        FreeCAD.closeDocument(document.Name)


def test_one_member_alone_is_still_cut_by_the_other(tmp_path):
    path = schedule(tmp_path / "s.xlsx")
    result = build(path, tmp_path / "out", ["M2"], workers=1)
    assert not result.failed and [len(r.plates) for r in result.records] == [8]


def test_a_crossing_nobody_resolved_gives_its_members_no_cut_files(tmp_path):
    path = schedule(tmp_path / "s.xlsx", ranks=(1, 1))
    result = build(path, tmp_path / "out", workers=1)
    (finding,) = [f for f in result.findings if f.severity == "error"]
    assert (finding.code, finding.object) == ("node-unresolved", "M1, M2")
    assert [r.plates for r in result.records] == [(), ()]
    assert not list((tmp_path / "out").glob("plates/*.dxf"))


def test_rows_of_nodes_are_checked(tmp_path):
    for row, code, column in (
        (["K1", "M1", "M1"], "node-of-itself", "other"),
        (["K1", "M1", "M9"], "unknown-name", "other"),
        (["K1", "M1", "M2", None, "stub"], "value-missing", "stub_length"),
        (["K1", "M1", "M2", None, "direct", None, 500], "not-used", "stub_length"),
    ):
        with pytest.raises(BendTorsionError) as raised:
            read_project(schedule(tmp_path / "s.xlsx", [row + [None] * (8 - len(row))]))
        (finding,) = raised.value.findings
        assert finding.code == code and f"column {column}" in finding.position


def test_a_row_of_members_that_do_not_meet_is_refused_at_its_cell(tmp_path):
    path = schedule(tmp_path / "s.xlsx", [["K1", "M1", "M2", *[None] * 5]], far=True)
    with pytest.raises(BendTorsionError) as raised:
        read_project(path)
    (finding,) = raised.value.findings
    assert finding.code == "node-not-found" and "sheet Nodes, row 2" in finding.position


def test_a_node_is_written_back_as_a_row_unless_ranks_make_it(tmp_path):
    row = ["K1", "M1", "M2", None, "stub", 4, 1200, "none"]
    for nodes, expected in (([row], True), ((), False)):
        given, jobs, found = read_project(schedule(tmp_path / "s.xlsx", nodes))
        document = build_document(given, jobs, sheets=False)
        try:
            document.recompute()
            rows = rows_of(document, tmp_path / "files")
        finally:
            FreeCAD.closeDocument(document.Name)
        assert ("Nodes" in rows) == expected
        _, _, again = read_project(write(tmp_path / "t.xlsx", rows))
        (one,), (two,) = found.nodes, again.nodes
        assert (one.name, one.through, one.s) == (two.name, two.through, two.s)
        asked = ("type", "gap", "stub_length", "diaphragms", "blend")
        for name in asked:
            before, after = (getattr(n.branches[0].row, name) for n in (one, two))
            assert before == after


EXAMPLE = Path(__file__).resolve().parent.parent / "resources" / "examples" / "concert_hall"


def test_the_concert_hall_with_purlins_has_its_nodes(tmp_path):
    target = tmp_path / "nodes.xlsx"
    script = EXAMPLE / "make_concert_hall_nodes.py"
    subprocess.run([sys.executable, "-B", str(script), str(target)], check=True)
    shipped = (EXAMPLE / "concert_hall_nodes.xlsx").read_bytes()
    assert workbook_parts(target.read_bytes()) == workbook_parts(shipped)
    _, _, found = read_project(target)
    assert not [f.line() for f in found.findings if f.severity == "error"]
    branches = [branch for node in found.nodes for branch in node.branches]
    assert len(found.nodes) >= 30 and {n.kind for n in found.nodes} >= {"crossing", "Y"}
    steps = [s.step for b in branches if not b.blends for s in b.steps if s.in_line]
    assert 0.7 < max(map(abs, steps)) < 2.7
    assert sum(bool(b.blends) for b in branches) == 2


def test_branches_beside_each_other_are_found_and_cut_by_the_nodes_alone(document, tmp_path):
    """Two struts that meet in one point of a girder: equal ranks are an error of both nodes, the
    later rank ends on the other, and an edited rank or EndsOn turns it round."""
    plane = make.make_surface(document, "Ground", "plane")
    big = make.make_section(document, "Big", "box1", h=600, b=400, t=16)
    low = make.make_section(document, "Low", "box1", h=300, b=260, t=10)
    members, plates = {}, {}
    for name, start, end, section in (
        ("X", (-2500, 0, 0), (2500, 0, 0), big),
        ("Y", (-1250, -2165, 0), (0, 0, 0), low),
        ("Z", (1250, -2165, 0), (0, 0, 0), low),
    ):
        axis = make.make_axis(document, f"A-{name}", plane, [start, end], fit="keep")
        members[name] = make.make_member(document, name, axis, [section])
        plates[name] = make.make_plates(document, members[name])
    nodes = {}
    for name, other in (("Y", "Z"), ("Z", "Y")):
        nodes[name] = make.make_node(
            document,
            members["X"],
            members[name],
            "K1",
            label=f"K1 {name}",
            plates=[plates["X"], plates[name]],
            beside=[members[other]],
        )
    document.recompute()
    for node in nodes.values():
        found = {f.code: f for f in findings_of(node) if f.severity == "error"}
        finding = found["node-branches-overlap"]
        assert finding.value > 20.0 and finding.limit == 0.0 and finding.unit == "mm"
        assert "s = 2500 mm of X" in finding.position and "ranks" in finding.mend
    assert not plates["Y"].Shape.Solids and not plates["Z"].Shape.Solids

    def lands(first, second):
        members["Y"].Rank, members["Z"].Rank = first, second
        document.recompute()
        assert [nodes[name].Status for name in "YZ"] == ["ok", "ok"]
        clash = plates["Y"].Shape.common(plates["Z"].Shape).Volume
        assert clash < 1e-3 and plates["Y"].Shape.Solids and plates["Z"].Shape.Solids
        return [list(nodes[name].LandsOn) for name in "YZ"]

    assert lands(1, 2) == [["right"], ["right and Y right"]]
    assert lands(2, 1) == [["right and Z left"], ["right"]]
    nodes["Y"].Beside = []
    nodes["Z"].Beside, nodes["Z"].EndsOn = [], [members["Y"]]
    assert lands(2, 1) == [["right"], ["right and Y right"]]
    header, *rows = rows_of(document, tmp_path)["Nodes"]
    named = [(row[header.index("through")], row[header.index("other")]) for row in rows]
    assert ("Y", "Z") in named
