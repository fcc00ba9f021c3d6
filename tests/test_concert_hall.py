# SPDX-License-Identifier: LGPL-2.1-or-later
"""The example: written with the same bytes, and the case it is meant to be."""

import importlib.util
import itertools
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.spatial import cKDTree
from workbook_parts import workbook_parts

from BendTorsionWB.exchange.schedule import read_schedule

ROOT = Path(__file__).resolve().parent.parent
HALL = ROOT / "resources" / "examples" / "concert_hall"


@pytest.fixture(scope="module")
def make_concert_hall():
    path = HALL / "make_concert_hall.py"
    spec = importlib.util.spec_from_file_location("make_concert_hall", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def hall():
    return read_schedule(HALL / "concert_hall.xlsx")


def test_concert_hall_is_written_with_the_same_bytes(tmp_path, make_concert_hall):
    for name in ("first.xlsx", "second.xlsx"):
        make_concert_hall.write(tmp_path / name)
    first = (tmp_path / "first.xlsx").read_bytes()
    assert first == (tmp_path / "second.xlsx").read_bytes()
    shipped = (HALL / "concert_hall.xlsx").read_bytes()
    assert workbook_parts(first) == workbook_parts(shipped)


def test_concert_hall_is_the_case_wanted(hall):
    half_axes = dict(hall.surface("Hall").sizes)
    assert half_axes == {"a": 40000.0, "b": 30000.0, "c": 20000.0}
    assert [member.name for member in hall.members] == [f"M{n}" for n in range(1, 17)]
    inverse = 1.0 / np.array(list(half_axes.values()))
    curves = []
    for axis in hall.axes:
        points = axis.coordinates()
        assert 8 <= len(points) <= 12
        assert np.all(points == np.round(points, 3))
        assert points[:, 2].min() >= 300.0
        # Distance to the ellipsoid to first order: F / |grad F|.
        distance = (np.sum((points * inverse) ** 2, axis=1) - 1.0) / 2.0
        distance /= np.linalg.norm(points * inverse**2, axis=1)
        assert np.abs(distance).max() < 0.001
        chords = np.linalg.norm(np.diff(points, axis=0), axis=1)
        assert chords.max() / chords.min() > 1.2
        along = np.concatenate([[0.0], np.cumsum(chords)])
        curve = CubicSpline(along, points)(np.linspace(0.0, along[-1], 600))
        assert 15000.0 < np.linalg.norm(np.diff(curve, axis=0), axis=1).sum() < 26000.0
        curves.append(curve)
    trees = [cKDTree(curve) for curve in curves]
    clear = [
        trees[one].query(curves[other])[0].min()
        for one, other in itertools.combinations(range(len(curves)), 2)
    ]
    # The alignments may push two neighbours half their breadth towards each other.
    assert min(clear) > 2600.0


def test_concert_hall_shows_what_a_schedule_can_say(hall):
    segments = [segment for member in hall.members for segment in member.segments]
    assert {len(member.segments) for member in hall.members} == {1, 2, 3}
    assert {hall.section(segment.section).type for segment in segments} == {"box1", "box2"}
    assert {segment.slope for segment in segments} == {0.0, 2.5, 4.0, 6.0}
    assert {segment.cut.is_ratio for segment in segments if segment.cut} == {True, False}
    assert len({segment.align for segment in segments}) >= 7
    assert {segment.align_to for segment in segments} == {"axis", "previous"}
    assert any(hall.section(segment.section).gap1 == 3.0 for segment in segments)
    assert any(member.roll == pytest.approx(math.radians(5.0)) for member in hall.members)
    paper = {
        "left": (0.2, 0.4, 0.6, 0.8),
        "right": (0.15, 0.35, 0.45, 0.75),
        "top": (0.1, 0.3, 0.55, 0.7, 0.85),
        "bottom": (0.25, 0.5, 0.65, 0.9),
    }
    as_paper = [
        {face: split.joints.values for face, split in hall.splits_of(member.name).items()} == paper
        for member in hall.members
    ]
    assert sum(as_paper) >= 12
    kinds = {split.joints.kind for split in hall.splits}
    assert kinds == {"ratio", "mm"} and hall.splits_of("M7") == {}
