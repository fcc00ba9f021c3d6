# SPDX-License-Identifier: LGPL-2.1-or-later
"""NC1 files, read by a reader written from the format's description alone."""

import math

import numpy as np
import pytest
from flat_plates import rectangle, strip

from BendTorsionWB.exchange.nc1 import plate_nc1


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


def contour(rows) -> list[tuple[float, float, float]]:
    points = []
    for face, rest in rows:
        assert face == "v"
        x, rest = rest.split("u", 1)
        numbers = [float(part) for part in rest.split()]
        assert len(numbers) == 6
        points.append((float(x), numbers[0], numbers[1]))
    return points


def traced(points, per_arc=200) -> np.ndarray:
    """The contour as a dense polygon, arcs by their radius."""
    path = []
    for (x, y, r), (x2, y2, _) in zip(points[:-1], points[1:], strict=True):
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
    assert any(r for _, _, r in points) and len(points) < 20
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
