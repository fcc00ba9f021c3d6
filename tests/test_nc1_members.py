# SPDX-License-Identifier: LGPL-2.1-or-later
"""NC1 and DXF of a ring, of cut ends, openings, polygons and every face a contour may be of."""

import io
import json
import math

import ezdxf
import numpy as np
import pytest
from curved_members import diagonal
from schedule_books import write
from test_nc1 import area, contour, read, traced

from BendTorsionWB.core.patterns.cut_contour import cut_contour
from BendTorsionWB.document_export import source_records
from BendTorsionWB.exchange.dxf import plate_dxf
from BendTorsionWB.exchange.nc1 import plate_nc1
from BendTorsionWB.exchange.report import report_json


def circle(count=12, radius=7400.0, z=3000.0):
    turns = 2.0 * np.pi * np.arange(count) / count
    return np.column_stack([radius * np.cos(turns), radius * np.sin(turns), np.full(count, z)])


def stretch(start, end):
    return diagonal(np.linspace(start, end, 7))


SHEETS = {
    "Surfaces": [
        ["surface", "kind", "parameters"],
        ["Ball", "sphere", "r=8000"],
        ["Hall", "ellipsoid", "a=40000 b=30000 c=20000"],
    ],
    "Axes": [
        ["axis", "surface", "closed"],
        *(["R", "Ball", "yes"], ["A", "Hall", None], ["P", "Hall", None]),
    ],
    "Sections": [
        ["section", "type", "h", "b", "t", "corners", "corner_joint"],
        ["B", "box1", 400, 400, 12, None, None],
        ["C", "box2", 500, 400, 20, None, None],
        ["W", "polygon", None, None, 16, "-300 -300; 300 -300; 450 100; 0 400; -450 100", "ring"],
    ],
    "Members": [
        ["member", "segment", "axis", "section", "start_cut", "end_cut", "contour", "green_end"],
        ["R", 1, "R", "B", None, None, None, None],
        ["A", 1, "A", "C", "plumb", "level", "widest", 30],
        ["P", 1, "P", "W", None, "plumb", "root", None],
    ],
    "Openings": [
        ["member", "face", "s", "offset", "shape", "rotation"],
        ["A", "top", "20%", -100, "d=60", None],
        ["A", "left", "40%", 30, "200x100 r=20", 30],
        ["A", "bottom", "60%", 0, "slot 120x40", 90],
        ["R", "top", 3000, 0, "d=60", None],
    ],
    "Marks": [
        ["member", "face", "s", "offset", "text"],
        ["A", "top", "44%", 100, "punch"],
        ["A", "top", "45%", 120, "line 100 30deg"],
        ["A", "left", "55%", 0, "LIFT HERE"],
    ],
    "Diaphragms": [
        ["member", "s", "t", "gap", "snipe", "manhole"],
        ["A", "35%", 12, 2, 30, "d=200"],
    ],
}


@pytest.fixture(scope="module")
def records(tmp_path_factory):
    axes = {"R": circle(), "A": stretch(0.1, 0.5), "P": stretch(0.1, 0.4)}
    rows = [
        [name, k, *map(float, xyz)]
        for name, points in axes.items()
        for k, xyz in enumerate(points, start=1)
    ]
    sheets = SHEETS | {"Points": [["axis", "no", "x", "y", "z"], *rows]}
    path = write(tmp_path_factory.mktemp("odd") / "odd.xlsx", sheets)
    found = source_records(path, workers=1)
    assert all(record.plates for record in found.records.values())
    return list(found.records.values())


@pytest.fixture(scope="module")
def plates(records):
    return [plate for record in records for plate in record.plates]


def test_the_report_of_every_kind_of_member_is_strict_json(records):
    text = json.dumps(report_json(records, (), "1.0"), allow_nan=False)
    assert all(f'"{record.member}"' in text for record in records)


def test_contours_are_closed_counter_clockwise_and_as_large_as_headers_say(plates):
    for plate in plates:
        file = read(plate_nc1(plate))
        header, blocks = file["header"], file["blocks"]
        assert [kind for kind, _ in blocks].count("AK") == 1 and len(header) == 24
        points = contour(dict(blocks)["AK"])
        path = traced(points, 2000)
        assert points[0][:2] == points[-1][:2] and area(path) > 0.0, plate.mark
        assert path.min() > -0.011, plate.mark
        for text, size in zip(header[8:10], path.max(axis=0), strict=True):
            assert float(text) == pytest.approx(size, abs=0.03), plate.mark
        inner = [traced(contour(rows)) for kind, rows in blocks if kind == "IK"]
        assert all(area(ring) < 0.0 for ring in inner)
        cut = cut_contour(plate).plate
        holes = sum(hole.area for hole in cut.holes if hole.circle is None)
        assert -sum(map(area, inner)) == pytest.approx(holes, rel=1e-3)
        # Short edges would be taken for a fault by a controller.
        assert np.hypot(*np.diff(np.array(points)[:, :2], axis=0).T).min() > 0.05, plate.mark


def test_bevels_leave_no_more_than_the_thickness_and_turn_no_farther_than_a_torch(plates):
    told = 0
    for plate in plates:
        for _, _, _, angle1, depth1, angle2, depth2 in contour(
            dict(read(plate_nc1(plate))["blocks"])["AK"]
        ):
            told += bool(depth1 or depth2)
            assert depth1 + depth2 <= plate.thickness + 0.011
            assert abs(angle1) <= 75.0 and abs(angle2) <= 75.0
    assert told > 20


def test_holes_punches_and_texts_of_both_files_are_the_same(plates):
    for plate in plates:
        blocks = read(plate_nc1(plate))["blocks"]
        space = ezdxf.read(io.StringIO(plate_dxf(plate).decode())).modelspace()
        bores = [row for kind, rows in blocks if kind == "BO" for _, row in rows]
        punches = sorted(
            tuple(float(part) for part in row.split("m")[0:1] + row.split("m")[1].split()[:1])
            for row in bores
            if "m" in row
        )
        drawn = sorted(
            (p.dxf.location.x, p.dxf.location.y) for p in space.query("*[layer=='PUNCH']")
        )
        assert np.allclose(np.array(punches), np.array(drawn), atol=0.0051), plate.mark
        round_holes = [row for row in bores if "m" not in row]
        assert len(round_holes) == sum(hole.circle is not None for hole in plate.holes)
        others = [kind for kind, _ in blocks if kind == "IK"]
        assert len(others) + len(round_holes) == len(plate.holes)
        assert len(plate.holes) == len(space.query("*[layer=='CUT_INNER']"))
        texts = {
            row.split(maxsplit=4)[-1] for kind, rows in blocks if kind == "SI" for _, row in rows
        }
        assert {mark.text for mark in plate.marks if mark.text} <= texts


def test_what_a_header_says_of_the_contour_is_on_the_pattern_too(plates):
    faces = {"R": "mid", "A": "widest", "P": "root"}
    for plate in plates:
        header = read(plate_nc1(plate))["header"]
        texts = [
            t.dxf.text for t in ezdxf.read(io.StringIO(plate_dxf(plate).decode())).query("TEXT")
        ]
        face = faces[plate.member]
        assert header[20] == f"contour {face}" and f"contour {face.upper()}" in texts, plate.mark
        assert header[21] == f"marking face {plate.marking_face}"
        assert math.isclose(float(header[12]), plate.thickness)
