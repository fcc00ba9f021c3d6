# SPDX-License-Identifier: LGPL-2.1-or-later
"""NC1 files, read by a reader written from the format's description alone."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from flat_plates import rectangle, strip

from BendTorsionWB.core.lofting import MemberRecord, PlateEdge
from BendTorsionWB.core.welds.bevel_record import EdgeBevel
from BendTorsionWB.exchange.nc1 import plate_nc1
from BendTorsionWB.exchange.nc1_text import text_findings


def read(content: bytes) -> dict:
    """Header lines and blocks of an NC1 file; a missing face letter repeats the one before."""
    text = content.decode("ascii")
    assert text.endswith("\r\n") and "\n" not in text.replace("\r\n", "")
    lines = text.split("\r\n")[:-1]
    assert lines[0] == "ST" and lines[-1] == "EN"
    header, blocks, index = [], [], 1
    while not lines[index].isalpha() or len(lines[index]) != 2:
        assert lines[index].startswith("  ") or not lines[index]
        header.append(lines[index].strip())
        index += 1
    for line in lines[index:-1]:
        if len(line) == 2 and line.isalpha():
            blocks.append((line, []))
        else:
            face, rest = line.split(maxsplit=1)
            blocks[-1][1].append((face, rest))
    return {"header": header, "blocks": blocks}


def contour(rows) -> list[tuple[float, ...]]:
    """x, y, radius, angle1, depth1, angle2, depth2 of each point."""
    points = []
    for face, rest in rows:
        assert face == "v"
        x, rest = rest.split("u", 1)
        numbers = [float(part) for part in rest.split()]
        assert len(numbers) == 6
        points.append((float(x), *numbers))
    return points


def traced(points, per_arc=200) -> np.ndarray:
    """The contour as a dense polygon, arcs by their radius."""
    path = []
    for (x, y, r, *_), (x2, y2, *_) in zip(points[:-1], points[1:], strict=True):
        a, b = np.array([x, y]), np.array([x2, y2])
        if not r:
            path.append(a[None])
            continue
        chord = np.hypot(*(b - a))
        left = np.array([-(b - a)[1], (b - a)[0]]) / chord
        centre = (a + b) / 2 + math.copysign(math.sqrt(max(r * r - chord**2 / 4, 0)), r) * left
        start = math.atan2(*(a - centre)[::-1])
        turn = 2 * math.asin(chord / 2 / abs(r)) * math.copysign(1, r)
        angle = start + turn * np.linspace(0, 1, per_arc, endpoint=False)
        path.append(centre + abs(r) * np.column_stack([np.cos(angle), np.sin(angle)]))
    return np.concatenate(path)


def area(path: np.ndarray) -> float:
    x, y = path.T
    return 0.5 * float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())


def curved(mark="M1-T1"):
    radius = 30000.0

    def edge(offset):
        own = radius - offset
        return lambda s: np.column_stack(
            [own * np.sin(s / radius), radius - own * np.cos(s / radius)]
        )

    angle = 4000.0 / radius
    return strip(
        mark, edge(0.0), edge(800.0), 4000.0, area=0.5 * angle * (radius**2 - (radius - 800.0) ** 2)
    )


@pytest.mark.parametrize("plate", [rectangle(), curved()])
def test_the_contour_is_closed_counter_clockwise_and_as_large_as_its_header(plate):
    file = read(plate_nc1(plate))
    header = file["header"]
    assert header[3] == plate.mark and header[4] == plate.material and header[7] == "B"
    assert len(header) == 24
    points = contour(dict(file["blocks"])["AK"])
    assert points[0][:2] == points[-1][:2]
    path = traced(points)
    assert area(path) == pytest.approx(plate.area, abs=0.02 * 2 * (plate.length + plate.width))
    assert path.min() >= -0.01
    assert float(header[8]) == pytest.approx(path[:, 0].max(), abs=0.03)
    assert float(header[9]) == pytest.approx(path[:, 1].max(), abs=0.03)
    assert float(header[14]) == pytest.approx(plate.mass / plate.area * 1e6, abs=1e-3)


def test_arcs_lie_on_the_pattern():
    plate = curved()
    points = contour(dict(read(plate_nc1(plate))["blocks"])["AK"])
    assert any(p[2] for p in points) and len(points) < 20
    path = traced(points)
    runs = np.concatenate(plate.outline)
    nearest = [np.min(np.hypot(*(path - p).T)) for p in runs[::5]]
    spacing = np.hypot(*np.diff(path, axis=0).T).max()
    assert max(nearest) <= 0.03 + spacing / 2


def test_marks_are_on_the_plate_and_named():
    plate = curved()
    blocks = read(plate_nc1(plate))["blocks"]
    kinds = [kind for kind, _ in blocks]
    assert kinds[0] == "AK" and kinds[-1] == "SI"
    texts = [
        rest.split(maxsplit=4)[-1] for kind, rows in blocks if kind == "SI" for _, rest in rows
    ]
    labels = [line.label for line in plate.lines if line.label.startswith("L")]
    assert texts[0].endswith(plate.mark)
    assert [t.split()[-1] for t in texts[1:]] == labels
    assert kinds.count("PU") == len(labels)


def test_same_plate_same_bytes():
    assert plate_nc1(curved()) == plate_nc1(curved())


def bevel(side, outer=(0.0, 0.0), inner=(0.0, 0.0), natural=0.0, start=0.0, end=4000.0):
    angles = [(math.radians(angle), depth) for angle, depth in (outer, inner)]
    return EdgeBevel(side, "left", "", "", start, end, math.radians(natural), *angles)


def bevels_on(points, y):
    """Bevel fields of the lines of a contour that run along y."""
    pairs = zip(points[:-1], points[1:], strict=True)
    return [a[3:] for a, b in pairs if abs(a[1] - y) < 0.1 and abs(b[1] - y) < 0.1]


def cut(*bevels, **changed):
    plate = replace(rectangle(length=4000.0), bevels=bevels, edges=square_edges(4000.0))
    return contour(dict(read(plate_nc1(replace(plate, **changed)))["blocks"])["AK"])


def square_edges(length):
    s, none = np.array([0.0, length]), np.zeros(2)
    return tuple(
        PlateEdge(name, name, ("E-1", "E-2"), s, none, none, none, none, none, none)
        for name in ("left", "right")
    )


def test_bevels_stand_on_the_first_point_of_their_line_and_are_told_from_both_faces():
    # Marked inside: the front is the inner face. A groove from the outer face is cut from the back.
    points = cut(bevel("first", outer=(45.0, 14.0)))
    assert bevels_on(points, 0.0) == [(0.0, 6.0, 45.0, 14.0)]
    assert bevels_on(points, 800.0) == [(0.0, 0.0, 0.0, 0.0)]
    points = cut(bevel("first", outer=(45.0, 14.0)), marking_face="outside")
    assert bevels_on(points, 0.0) == [(45.0, 14.0, 0.0, 6.0)]
    # Of an edge tilted by its neighbour one face is cut back, over the whole thickness.
    points = cut(bevel("second", natural=5.0))
    assert bevels_on(points, 800.0) == [(5.0, 20.0, 0.0, 0.0)]
    points = cut(bevel("second", natural=5.0), marking_face="outside")
    assert bevels_on(points, 800.0) == [(-5.0, 20.0, 0.0, 0.0)]


@pytest.mark.parametrize("marking_face", ["inside", "outside"])
def test_depths_from_both_faces_make_the_thickness_less_the_land_between_two_grooves(marking_face):
    for own, land in (
        (bevel("first", outer=(40.0, 14.0), natural=3.0), 0.0),
        (bevel("first", inner=(40.0, 14.0), natural=3.0), 0.0),
        (bevel("first", outer=(30.0, 9.0), inner=(30.0, 9.0)), 2.0),
    ):
        [(angle1, depth1, angle2, depth2)] = bevels_on(cut(own, marking_face=marking_face), 0.0)
        assert depth1 + depth2 == 20.0 - land
        assert {abs(angle1), abs(angle2)} <= {3.0, 30.0, 40.0}


def test_a_bevel_that_changes_along_an_edge_changes_at_a_point():
    halves = (
        bevel("first", outer=(45.0, 14.0), end=1500.0),
        bevel("first", outer=(50.0, 14.0), start=1500.0),
    )
    points = cut(*halves)
    assert any(p[:2] == (1500.0, 0.0) for p in points)
    assert [fields[2] for fields in bevels_on(points, 0.0)] == [45.0, 50.0]


def test_the_contour_of_a_face_begins_at_its_own_corner_and_is_as_large_as_its_header():
    plate = replace(
        rectangle(length=4000.0),
        bevels=(bevel("first", inner=(45.0, 14.0)),),
        edges=square_edges(4000.0),
        contour="top",
    )
    file = read(plate_nc1(plate))
    path = traced(contour(dict(file["blocks"])["AK"]))
    assert path.min(axis=0) == pytest.approx([0.0, 0.0])
    assert path.max(axis=0) == pytest.approx([4000.0, 786.0])
    assert [float(file["header"][k]) for k in (8, 9)] == pytest.approx([4000.0, 786.0])
    assert file["header"][20] == "contour top" and file["header"][21] == "marking face inside"
    # Marks keep their place on the plate: its corner is 14 mm nearer to them.
    marks = [row for kind, rows in file["blocks"] if kind == "BO" for _, row in rows]
    places = [float(row.split("m")[1].split()[0]) for row in marks]
    assert min(places) == pytest.approx(50.0 - 14.0)


def test_an_edge_all_but_straight_is_a_line_and_fields_stay_apart():
    """An arc of 0.001 mm over 4 m has a radius of 2e9 mm, which no field holds: a line."""

    def bowed(sagitta):
        return strip(
            "M1-T1",
            lambda s: np.column_stack([s, sagitta * (2.0 * s / 4000.0 - 1.0) ** 2]),
            lambda s: np.column_stack([s, np.full_like(s, 800.0)]),
            4000.0,
            area=3.2e6,
        )

    straight = contour(dict(read(plate_nc1(bowed(0.001)))["blocks"])["AK"])
    assert all(point[2] == 0.0 for point in straight)
    curved = contour(dict(read(plate_nc1(bowed(0.5)))["blocks"])["AK"])
    radius = 2000.0**2 / (2.0 * 0.5)
    assert max(abs(p[2]) for p in curved) == pytest.approx(radius, rel=0.2)
    # Where an arc of the widest radius begins every field is read by itself.
    for sagitta in (0.006, 0.02, -0.006):
        points = contour(dict(read(plate_nc1(bowed(sagitta)))["blocks"])["AK"])
        assert max(abs(p[2]) for p in points) == pytest.approx(2e6 / abs(sagitta), rel=0.01)


def test_texts_that_are_not_ascii_have_a_name_of_their_own_and_a_note():
    """No question marks: what stands for a name is the same in every file, and told."""
    plate = replace(rectangle("主拱1-T3"), member="主拱1", material="Stål 355")
    file = read(plate_nc1(plate, "深圳音乐厅"))
    order, drawing, _, mark, grade, *_ = file["header"]
    assert re.fullmatch("U[0-9A-F]{6}", order) and grade == "Stal 355"
    assert re.fullmatch("U[0-9A-F]{6}_1-T3", mark) and mark == f"{drawing}-T3"
    assert read(plate_nc1(replace(plate, member="次拱1"), ""))["header"][1] != drawing
    record = MemberRecord("主拱1", "", "", plates=(plate,))
    found = {f.position: f for f in text_findings([record], "深圳音乐厅")}
    assert set(found) == {"order", "member", "grade"}
    assert found["order"].value == order and "深圳音乐厅" in found["order"].message
    assert all(f.severity == "note" and f.code == "nc1-text" for f in found.values())
    assert text_findings([replace(record, member="M1", plates=(rectangle(),))], "Hall") == ()
