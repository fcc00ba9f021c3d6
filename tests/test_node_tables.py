# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nodes as a build tells them: every meeting a row, errors once, marks and orders as expected."""

import json
from dataclasses import replace

import openpyxl
import pytest
from schedule_books import write

from BendTorsionWB.core.finding import BendTorsionError, warning
from BendTorsionWB.document_export import source_records, write_figures
from BendTorsionWB.exchange.schedule_jobs import at_rows
from BendTorsionWB.model_files import Wanted
from BendTorsionWB.project import build, read_project

NOTHING = Wanted(model=False, sheets=False)


def grid(path, ranks, nodes=(), names=("M2", "M10", "P1"), x=(1000.0, 3000.0), deep=360, **given):
    """Two ribs along y at two places x, and a purlin across both."""
    one, two, across = names
    ends = {
        one: ((x[0], -2000, 0), (x[0], 2000, 0)),
        two: ((x[1], -2000, 0), (x[1], 2000, 0)),
        across: ((-1500, 0, 0), (5500, 0, 0)),
    }
    sheets = {
        "Surfaces": [["surface", "kind", "parameters"], ["G", "plane", None]],
        "Axes": [
            ["axis", "surface", "fit", "frame"],
            *(["A" + name, "G", "keep", "fixed"] for name in ends),
        ],
        "Points": [
            ["axis", "no", "x", "y", "z"],
            *(
                ["A" + name, k, *point]
                for name, points in ends.items()
                for k, point in enumerate(points, start=1)
            ),
        ],
        "Sections": [
            ["section", "type", "h", "b", "t"],
            ["R", "box1", 500, 300, 12],
            ["Q", "box1", deep, 260, 10],
        ],
        "Members": [
            ["member", "segment", "axis", "section", "align", "rank"],
            *(
                [name, 1, "A" + name, "Q" if name == across else "R", "centre", rank]
                for name, rank in zip(ends, ranks, strict=True)
            ),
        ],
        **given,
    }
    if nodes:
        sheets["Nodes"] = [["node", "through", "other", "gap"], *nodes]
    return write(path, sheets)


def rows(book, name):
    header, *found = book[name].iter_rows(values_only=True)
    return [dict(zip(header, row, strict=True)) for row in found]


def made(path, out, **given):
    result = build(path, out, workers=1, wanted=NOTHING, **given)
    return (
        result,
        openpyxl.load_workbook(out / "results.xlsx"),
        json.loads((out / "report.json").read_text(encoding="utf-8")),
    )


@pytest.mark.parametrize("ranks", [(1, 1, 1), (None, None, None)])
def test_a_crossing_nobody_resolved_is_an_error_once_a_row_and_no_cut_files(tmp_path, ranks):
    """Also without any rank or row."""
    result, book, report = made(grid(tmp_path / "s.xlsx", ranks), tmp_path / "out")
    errors = [f for f in result.findings if f.severity == "error"]
    assert [f.code for f in errors] == ["node-unresolved"] * 2
    assert [f.object for f in errors] == ["M2, P1", "M10, P1"]
    assert [row["object"] for row in rows(book, "Checks") if row["severity"] == "error"] == [
        f.object for f in errors
    ]
    nodes = rows(book, "Nodes")
    assert [(row["through"], row["other"], row["status"]) for row in nodes] == [
        ("M2", "P1", "node-unresolved"),
        ("M10", "P1", "node-unresolved"),
    ]
    assert [row["x"] for row in nodes] == pytest.approx([1000.0, 3000.0])
    assert [row["status"] for row in report["nodes"]] == ["node-unresolved"] * 2
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    listed = page[page.index("<h2>Nodes</h2>") : page.index("<h2>Plates</h2>")]
    assert listed.count("<td>node-unresolved</td>") == 2
    assert not list((tmp_path / "out").glob("plates/*"))
    assert [len(member["plates"]) for member in report["members"]] == [0, 0, 0]


def test_a_node_in_error_leaves_the_others_their_rows(tmp_path):
    """One rib has a rank, so that one node is made and one is not."""
    result, book, report = made(grid(tmp_path / "s.xlsx", (1, 2, 2)), tmp_path / "out")
    assert [(row["node"], row["status"]) for row in rows(book, "Nodes")] == [
        ("N1", "ok"),
        (None, "node-unresolved"),
    ]
    # The rib without the error is cut out, the purlin and the other rib are not.
    assert [bool(member["plates"]) for member in report["members"]] == [True, False, False]
    assert {p.name[:3] for p in (tmp_path / "out" / "plates").glob("*.dxf")} == {"M2-"}
    assert result.failed


def test_rows_are_in_the_order_of_members_and_places(tmp_path):
    path = grid(tmp_path / "s.xlsx", (1, 1, 2), x=(3000.0, 1000.0))
    _, book, report = made(path, tmp_path / "out")
    assert [(row["node"], row["through"]) for row in rows(book, "Nodes")] == [
        ("N1", "M2"),
        ("N2", "M10"),
    ]
    assert [node["node"] for node in report["nodes"]] == ["N1", "N2"]
    steps = [row["node"] for row in rows(book, "NodeSteps")]
    assert steps == sorted(steps)
    path = grid(tmp_path / "t.xlsx", (2, 2, 1), x=(3000.0, 1000.0), deep=600)
    _, book, _ = made(path, tmp_path / "two")
    # By the place on the one that runs through.
    assert [(row["node"], row["through"], row["other"]) for row in rows(book, "Nodes")] == [
        ("N1", "P1", "M10"),
        ("N2", "P1", "M2"),
    ]


def test_welds_at_nodes_name_the_plate_landed_on(tmp_path):
    """Its mark, of the plate that is there: the rib is cut in two away from the node."""
    splits = {
        "Splits": [["member", "face", "joints"], ["M2", "left", "900"], ["M2", "right", "900"]]
    }
    path = grid(tmp_path / "s.xlsx", (1, 1, 2), **splits)
    _, book, _ = made(path, tmp_path / "out")
    marks = {row["plate"] for row in rows(book, "Plates")}
    welds = [row for row in rows(book, "Welds") if row["kind"] == "node"]
    assert len(welds) == 16
    assert {row["plate_2"] for row in welds} == {"M2-L2", "M2-R2", "M10-L1", "M10-R1"} <= marks
    joints = rows(book, "Plates")
    where = {row["plate"]: row for row in joints}
    assert where["M2-L2"]["face"] == "left"
    # Alone, the purlin knows the face only.
    _, book, _ = made(path, tmp_path / "one", only=["P1"])
    welds = [row for row in rows(book, "Welds") if row["kind"] == "node"]
    assert {row["plate_2"] for row in welds} == {"M2 left", "M2 right", "M10 left", "M10 right"}


@pytest.mark.parametrize(("gap", "limit"), [(60, 20.0), (-3, 0.0)])
def test_a_root_gap_out_of_bounds_is_refused_at_its_cell(tmp_path, gap, limit):
    path = grid(tmp_path / "s.xlsx", (1, 1, 2), [["K1", "M2", "P1", gap]])
    with pytest.raises(BendTorsionError) as raised:
        read_project(path)
    (finding,) = raised.value.findings
    assert "sheet Nodes, row 2, column gap" in finding.position
    assert float(finding.value) == gap
    assert finding.mend
    if gap > 0:
        assert (finding.code, finding.limit, finding.unit) == ("node-gap", limit, "mm")


def test_the_report_of_a_schedule_tells_the_same(tmp_path):
    """Without building: members in error have no plates, and their meeting has a row."""
    given = source_records(grid(tmp_path / "s.xlsx", (1, 2, 2)), workers=1)
    write_figures(given, tmp_path / "r.xlsx")
    book = openpyxl.load_workbook(tmp_path / "r.xlsx")
    assert [(row["node"], row["status"]) for row in rows(book, "Nodes")] == [
        ("N1", "ok"),
        (None, "node-unresolved"),
    ]
    assert {row["member"] for row in rows(book, "Plates")} == {"M2"}


def test_rows_of_edges_are_named_for_plates_too(tmp_path):
    """A warning of a diaphragm by its mark names the row of its member."""
    edges = [["member", "seam", "prep"], ["P1", "TL", "square"], ["M2", "diaphragms", "fillet"]]
    schedule, _, _ = read_project(grid(tmp_path / "s.xlsx", (1, 1, 2), Edges=edges))
    told = warning("diaphragm-skew", "M2-D1", "too sharp", "bevel it", position="edge 1")
    (found,) = at_rows(schedule, [told])
    assert found.position == "sheet Edges, row 3" and found.object == "M2-D1"
    assert at_rows(schedule, [replace(told, object="Q-D1")])[0].position == "edge 1"
