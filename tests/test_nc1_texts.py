# SPDX-License-Identifier: LGPL-2.1-or-later
"""Texts of NC1 files: none on another, on what is marked, in an opening or off the plate."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from flat_plates import rectangle
from test_nc1 import contour, read, traced

from BendTorsionWB.core.detailing import detail
from BendTorsionWB.core.geometry.arc_contour import inside, polygon
from BendTorsionWB.core.lofting import FlatHole, StationLine
from BendTorsionWB.exchange.dxf_labels import CHARACTER_WIDTH
from BendTorsionWB.exchange.nc1 import plate_nc1
from BendTorsionWB.project import read_jobs

HALL = Path(__file__).parents[1] / "resources/examples/concert_hall/concert_hall.xlsx"


def text_boxes(blocks):
    """(text, corners (4, 2)) of every text, a letter as wide as it is high."""
    found = []
    for _, row in (row for kind, rows in blocks if kind == "SI" for row in rows):
        x, rest = row.split("u", 1)
        y, angle, height, text = rest.split(maxsplit=3)
        turn = np.radians(float(angle))
        way, up = np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)])
        corner, high = np.array([float(x), float(y)]), float(height)
        right, top = len(text) * CHARACTER_WIDTH * high * way, high * up
        found.append((text, np.array([corner, corner + right, corner + right + top, corner + top])))
    return found


def apart(one, other):
    """Whether a line parts two convex polygons."""
    for ring in (one, other):
        for a, b in zip(ring, np.roll(ring, -1, axis=0), strict=True):
            normal = np.array([a[1] - b[1], b[0] - a[0]])
            p, q = one @ normal, other @ normal
            if p.max() <= q.min() + 1e-6 or q.max() <= p.min() + 1e-6:
                return True
    return False


def openings(blocks):
    """Dense polygons of the holes, and squares about the punches."""
    around = np.linspace(0.0, 2.0 * np.pi, 36, endpoint=False)
    ring = np.column_stack([np.cos(around), np.sin(around)])
    for kind, rows in blocks:
        if kind == "IK":
            yield traced(contour(rows), 20)
        for _, row in rows if kind == "BO" else ():
            x, rest = row.replace("m", "u").split("u", 1)
            y, diameter = (float(part) for part in rest.split())
            yield np.array([float(x), y]) + 0.5 * max(diameter, 1.0) * ring


def faults(plate):
    blocks = read(plate_nc1(plate))["blocks"]
    found, boxes = [], text_boxes(blocks)
    for k, (text, box) in enumerate(boxes):
        found += [f"{text} on {other}" for other, own in boxes[:k] if not apart(box, own)]
        found += [f"{text} in a hole" for hole in openings(blocks) if not apart(box, hole)]
    for kind, rows in blocks:
        if kind == "PU":
            places = [row.replace("u", " ").split()[:2] for _, row in rows]
            points = np.array(places, float)
            lines = [np.array([a, b, a]) for a, b in pairwise(points)]
            found += [f"{text} on a line" for text, b in boxes for p in lines if not apart(b, p)]
    ring = polygon(traced(contour(dict(blocks)["AK"]), 20))
    found += [f"{text} off the plate" for text, box in boxes if not inside(ring, box).all()]
    return found


def round_hole(label, u, v, diameter):
    turn = np.linspace(0.0, 2.0 * np.pi, 64)
    ring = np.array([u, v]) + 0.5 * diameter * np.column_stack([np.cos(turn), np.sin(turn)])
    return FlatHole(label, f"d={diameter:g}", (ring,), (u, v, diameter), 0.25 * np.pi * diameter**2)


@pytest.mark.parametrize("diameter", [120.0, 600.0])
def test_the_mark_the_label_and_the_hole_in_the_middle_do_not_meet(diameter):
    plate = rectangle()
    at = 0.5 * plate.length
    across = np.array([[at, 0.0], [at, plate.width]])
    middle = StationLine("L-1", at, across, plate.width, plate.width)
    plate = replace(plate, lines=(plate.lines[0], middle, plate.lines[-1]))
    assert faults(plate) == []
    hole = round_hole("O-1", at, 0.5 * plate.width, diameter)
    beside = round_hole("O-2", at, 0.2 * plate.width, 100.0)
    assert faults(replace(plate, holes=(hole, beside))) == []


@pytest.mark.parametrize("name", ["M5", "M12"])
def test_texts_of_members_of_the_hall(name):
    _, jobs = read_jobs(HALL, only=[name])
    record = detail(jobs[name]).record
    assert len(record.plates) > 10
    found = {plate.mark: faults(plate) for plate in record.plates}
    assert {mark: own for mark, own in found.items() if own} == {}
