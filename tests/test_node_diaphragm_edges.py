# SPDX-License-Identifier: LGPL-2.1-or-later
"""Square edges of diaphragms askew at a node: what is told of them in cut files and tables, rows of
edges that ask for fillets there, and backing bars that run into them."""

import math
from dataclasses import replace

import ezdxf
import numpy as np
import openpyxl
import pytest
from test_sheet_node import LOW, X, at, details
from test_sheet_node import straight as job

from BendTorsionWB.core.drawings.sheet_node import node_sheets
from BendTorsionWB.core.drawings.sheet_style import PLAIN_STYLE
from BendTorsionWB.core.nodes.node_input import NodeInput
from BendTorsionWB.core.welds.edge_rows import EdgeTreatment
from BendTorsionWB.core.welds.preps import prep_of
from BendTorsionWB.exchange import results_workbook
from BendTorsionWB.exchange.dxf import write_plate_dxf
from BendTorsionWB.exchange.nc1 import plate_nc1

INSIDE = 200.0 - 16.0
"""mm from the axis to the inner faces of the webs of X."""


def crossed(degrees, through=(), branch=(), diaphragms="flanges and webs", **rules):
    """Records of a box and one that crosses it at an angle, with rows of edges of either."""
    jobs = {m[0]: job(*m) for m in (X, ("Y", at(degrees, -2500), at(degrees, 2500), LOW))}
    for name, rows in (("X", through), ("Y", branch)):
        plates = replace(jobs[name].plates, edges=tuple(rows))
        jobs[name] = replace(jobs[name], plates=plates)
    return [
        one.record for one in details(jobs, (NodeInput("X", "Y", diaphragms=diaphragms),), **rules)
    ]


def row(where, prep):
    return EdgeTreatment(where, prep=prep_of(prep))


def askew(record):
    """Stretches of diaphragms' sides that stand askew to walls, with their plates."""
    return [
        (plate, bevel)
        for plate in record.plates
        for bevel in plate.bevels
        if plate.face == "diaphragm"
    ]


@pytest.mark.parametrize("degrees", [40.0, 65.0, 140.0])
def test_the_face_a_square_edge_opens_to_is_told(degrees):
    """By the distance of both faces from the web's inner face, in the plane of the diaphragm."""
    record = crossed(degrees)[0]
    sharp = min(degrees, 180.0 - degrees)
    found = [
        (plate, bevel)
        for plate, bevel in askew(record)
        if record_face(record, bevel) in ("left", "right")
    ]
    assert len(found) >= 4
    ways = set()
    for plate, bevel in found:
        assert math.degrees(bevel.opening[0]) == pytest.approx(90.0 - sharp, abs=0.051)
        assert (bevel.natural, bevel.outer[1], bevel.inner[1]) == (0.0, 0.0, 0.0)
        points = {point.label: point.xyz for point in plate.points}
        one, two = (points[label] for label in bevel.edge.split("/"))
        z = np.linalg.inv(plate.placing)[:3, 2]
        room = [INSIDE - abs(0.5 * (one + two)[1] + h * z[1]) for h in (0.0, -plate.thickness)]
        gaps = [r / math.sin(math.radians(sharp)) for r in room]
        assert min(gaps) == pytest.approx(2.0 / math.sin(math.radians(sharp)), abs=1e-6)
        assert max(gaps) - min(gaps) == pytest.approx(12.0 / math.tan(math.radians(sharp)))
        assert bevel.opening[1] == ("up" if gaps[0] > gaps[1] else "down")
        ways.add(bevel.opening[1])
        weld = next(w for w in record.welds if w.mark == bevel.weld)
        if sharp < 60.0:
            assert weld.prep.side == {"up": "outer", "down": "inner"}[bevel.opening[1]]
            assert bevel.prep == "skew"
    assert ways == {"up", "down"}


def record_face(record, bevel):
    weld = next(w for w in record.welds if w.mark == bevel.weld)
    return next(plate.face for plate in record.plates if plate.mark == weld.plates[1])


def test_cut_files_and_tables_say_that_the_edge_is_square(tmp_path):
    record = crossed(40.0)[0]
    plate, bevel = askew(record)[0]
    words = f"square, open 50.0 deg {bevel.opening[1]}"
    write_plate_dxf(plate, tmp_path / "d.dxf")
    texts = {
        e.dxf.text: e.dxf.layer for e in ezdxf.readfile(tmp_path / "d.dxf").query("TEXT MTEXT")
    }
    assert texts[words] == "MARK_BEVEL"
    # Along its side, inside the plate.
    (drawn,) = ezdxf.readfile(tmp_path / "d.dxf").query(f'TEXT[text=="{words}"]')
    side = plate.side_ends(bevel.edge)
    way = (side[1] - side[0]) / np.hypot(*(side[1] - side[0]))
    reading = np.array([math.cos(t := math.radians(drawn.dxf.rotation)), math.sin(t)])
    assert abs((reading * way).sum()) == pytest.approx(1.0, abs=1e-6)
    for part in (0.0, 0.6 * drawn.dxf.height * len(words)):
        u, v = np.array(drawn.dxf.insert)[:2] + part * reading
        assert 0.0 < u < plate.length and 0.0 < v < plate.width
    text = plate_nc1(plate).decode()
    assert f"{bevel.edge} {words}" in text
    contour = text.split("AK\r\n")[1].split("BO")[0].split("SI")[0].splitlines()
    assert all(line.split()[-4:] == ["0.00"] * 4 for line in contour if line.startswith("  v"))
    results_workbook.write_results([record], (), tmp_path / "r.xlsx")
    head, *rows = openpyxl.load_workbook(tmp_path / "r.xlsx")["Bevels"].iter_rows(values_only=True)
    told = [dict(zip(head, own, strict=True)) for own in rows]
    (own,) = [r for r in told if (r["plate"], r["edge"]) == (plate.mark, bevel.edge)]
    assert (own["side"], own["natural"], own["land"]) == ("wall", 0.0, plate.thickness)
    assert own["angle_opening"] == pytest.approx(50.0)
    assert (own["opening_face"], own["prep"], own["weld"]) == (
        bevel.opening[1],
        "skew",
        bevel.weld,
    )
    for language, say in (("en", "open 50°"), ("zh", "开口 50°")):
        pages = node_sheets(tuple(crossed(40.0)), replace(PLAIN_STYLE, language=language))
        cells = [c for p in pages for table in p.tables for one in table.rows for c in one]
        assert sum(say in cell for cell in cells) == len(askew(record))


def test_square_crossings_and_flanges_have_no_open_edges():
    assert not askew(crossed(90.0)[0])
    assert not askew(crossed(40.0, diaphragms="none")[0])


def test_fillets_of_a_row_are_not_made_where_a_diaphragm_is_askew():
    rows = [row("diaphragms", "double-fillet leg=8")]
    record = crossed(40.0, through=rows)[0]
    welds = [w for w in record.welds if w.kind == "diaphragm"]
    skew = [w for w in welds if w.dihedral < math.radians(60.0)]
    square = [w for w in welds if w not in skew]
    assert skew and all((w.prep.type, w.prep.name, w.row) == ("bevel", "skew", 0) for w in skew)
    assert square and all((w.prep.leg, w.row) == (8.0, 1) for w in square)
    told = [f for f in record.findings if f.code == "diaphragm-skew"]
    assert told and all(f.position == "edge 1" for f in told)
    assert all("double-fillet its row asks for is not made there" in f.message for f in told)
    plain = [f for f in crossed(40.0)[0].findings if f.code == "diaphragm-skew"]
    assert plain and not any(f.position or "not made" in f.message for f in plain)


@pytest.mark.parametrize(("degrees", "sharp"), [(40.0, True), (75.0, False)])
def test_fillets_of_a_row_are_not_made_where_a_branch_lands_too_sharp(degrees, sharp):
    record = crossed(degrees, branch=[row("N1", "fillet leg=8")])[1]
    welds = [w for w in record.welds if w.kind == "node"]
    fillets = {w.mark for w in welds if w.prep.is_fillet}
    outside = {w.mark: 180.0 - math.degrees(w.dihedral) for w in welds}
    assert fillets == {mark for mark, angle in outside.items() if 59.9 < angle < 135.1}
    told = [f for f in record.findings if f.code == "node-fillet"]
    assert bool(told) == sharp == (len(fillets) < len(welds))
    for finding in told:
        assert finding.position == "edge 1" and finding.value == pytest.approx(degrees)
        others = {w.mark for w in welds} - fillets
        assert all(mark in finding.message for mark in others)
        grooved = {b.weld for p in record.plates for b in p.bevels if b.outer[1]}
        assert others & grooved and not fillets & grooved


@pytest.mark.parametrize("degrees", [90.0, 55.0])
def test_a_backing_bar_runs_into_a_diaphragm_of_a_node(degrees):
    """The far corner of the bar, along x, lies in the diaphragm until the snipe clears it."""
    rows = [row("TL", "bevel angle=45 gap=6 backing=30x6")]
    found = clashes(crossed(degrees, through=rows, snipe=10.0)[0])
    assert found
    needed = max(f.limit for f in found.values())
    for snipe, clash in ((needed - 0.5, True), (needed + 0.5, False)):
        record = crossed(degrees, through=rows, snipe=snipe)[0]
        assert bool(clashes(record)) == clash
        assert any(map(corner_inside, webs(record))) == clash
    assert not clashes(crossed(degrees, snipe=10.0)[0])


def clashes(record):
    return {f.object: f for f in record.findings if f.code == "backing-clash"}


def webs(record):
    """Diaphragms that close the box."""
    return [p for p in record.plates if p.face == "diaphragm" and p.holes]


def corner_inside(plate):
    """Whether the far edge of a bar 30x6 under the top of X, which ends at the left web, runs
    through a face of a diaphragm."""
    seen = False
    normal = np.linalg.inv(plate.placing)[:3, 2]
    ring = np.array([point.xyz for point in plate.points])
    y, z = INSIDE - 30.0, 284.0 - 6.0
    for depth in (0.0, plate.thickness):
        face = ring - depth * normal
        away = (y - face[0, 1]) * normal[1] + (z - face[0, 2]) * normal[2]
        spot = np.array([face[0, 0] - away / normal[0], y, z])
        following = np.roll(face, -1, axis=0)
        sides = np.cross(following - face, spot - face) @ normal
        seen |= bool((sides > 0.0).all() or (sides < 0.0).all())
    return seen
