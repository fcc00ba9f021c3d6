# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bevels of plate edges: angles from weld and neighbour, stepped; contours of every face."""

from dataclasses import replace

import numpy as np
import pytest
from flat_plates import rectangle

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.lofting import PlateEdge
from BendTorsionWB.core.patterns.cut_contour import cut_contour
from BendTorsionWB.core.patterns.gross import gross_pattern
from BendTorsionWB.core.welds.bevels import SHORTEST_STRETCH, with_bevels
from BendTorsionWB.core.welds.preps import prep_of
from BendTorsionWB.core.welds.weld_record import Weld
from BendTorsionWB.exchange.dxf_bevels import bevel_text

LENGTH, WIDTH, THICKNESS = 2400.0, 800.0, 20.0
DEGREE = np.radians(1.0)


def edge(plate, name, neighbour, bevel):
    """An edge of a plate, bevel a function of s: the faces end half the step to both sides."""
    s = np.array([line.s for line in plate.lines])
    angle = np.array([bevel(place) for place in s])
    half = 0.5 * THICKNESS * np.tan(angle)
    flat = np.zeros((len(s), 2))
    labels = tuple(line.label for line in plate.lines)
    return PlateEdge(
        name, neighbour, labels, s, angle, np.full(len(s), 0.5 * np.pi), half, -half, flat, flat
    )


def flange(first=lambda s: 0.0, **changed):
    """A top plate between a left and a right one; its first edge tilted as told."""
    plate = rectangle(length=LENGTH, width=WIDTH, **changed)
    edges = (edge(plate, "left", "left", first), edge(plate, "right", "right", lambda s: 0.0))
    return replace(plate, edges=edges)


def beside(letter, face):
    return replace(rectangle(f"M1-{letter}1"), face=face, letter=letter)


def seam(prep, plates=("M1-T1", "M1-L1"), start=0.0, end=LENGTH):
    return Weld(
        "M1-TL-T1/L1",
        "M1",
        1,
        "seam",
        "TL",
        plates,
        start,
        end,
        end - start,
        (THICKNESS, THICKNESS),
        0.5 * np.pi,
        prep_of(prep),
        "shop",
        "",
    )


def joint(prep, plates):
    return replace(seam(prep, plates), kind="joint", mark="M1-T1/T2", start=LENGTH, end=LENGTH)


def bevels_of(plate, *welds, step=DEGREE, contour="mid"):
    others = [beside("L", "left"), beside("R", "right")]
    return with_bevels([plate, *others], welds, step, contour)[0]


def test_a_bevel_is_the_groove_less_what_the_neighbour_leaves():
    tilt = np.radians(5.0)
    [bevel] = bevels_of(flange(lambda s: tilt), seam("bevel angle=45 land=6")).bevels
    assert (bevel.side, bevel.edge, bevel.start, bevel.end) == ("first", "left", 0.0, LENGTH)
    # The groove is measured from the neighbour, on which the untouched edge lies.
    assert np.degrees(bevel.outer[0]) == pytest.approx(40.0)
    assert bevel.outer[1] == 14.0 and bevel.inner == (0.0, 0.0)
    [inner] = bevels_of(flange(lambda s: tilt), seam("bevel angle=45 land=6 inner")).bevels
    assert np.degrees(inner.inner[0]) == pytest.approx(50.0) and inner.outer == (0.0, 0.0)


def test_only_the_plate_that_fits_the_other_is_cut_but_both_of_a_v():
    plate = flange()
    assert bevels_of(plate, seam("bevel angle=45 land=6", ("M1-L1", "M1-T1"))).bevels == ()
    [one] = bevels_of(plate, seam("v angle=60 land=2", ("M1-L1", "M1-T1"))).bevels
    assert np.degrees(one.outer[0]) == pytest.approx(30.0)
    assert bevels_of(plate, seam("fillet")).bevels == ()


def test_stretches_are_few_whole_and_within_half_a_step():
    for step in (0.5 * DEGREE, 2.5 * DEGREE):
        plate = flange(lambda s: np.radians(6.0) * np.sin(np.pi * s / LENGTH))
        bevels = bevels_of(plate, seam("bevel angle=45 land=6"), step=step).bevels
        assert bevels[0].start == 0.0 and bevels[-1].end == LENGTH
        assert all(a.end == b.start for a, b in zip(bevels, bevels[1:], strict=False))
        own = plate.edges[0]
        steepest = float(np.abs(np.diff(own.bevel) / np.diff(own.s)).max())
        limit = 0.5 * step + np.radians(0.05) + SHORTEST_STRETCH * steepest
        for bevel in bevels:
            s = np.linspace(bevel.start, bevel.end, 50)
            off = np.interp(s, own.s, own.bevel) - bevel.natural
            assert np.abs(off).max() <= limit
            assert bevel.end - bevel.start >= SHORTEST_STRETCH
        # Up and down again: no fewer stretches can hold the angle.
        rise = float(own.bevel.max())
        assert len(bevels) <= 2 * np.ceil(rise / step) + 1


def test_rows_of_one_preparation_are_one_stretch_and_others_apart():
    groove = "bevel angle=45 land=6"
    halves = (seam(groove, end=1000.0), replace(seam(groove, start=1000.0), mark="M1-TL-T1/L2"))
    [whole] = bevels_of(flange(), *halves).bevels
    assert (whole.start, whole.end) == (0.0, LENGTH)
    assert whole.weld == "M1-TL-T1/L1 M1-TL-T1/L2"
    other = seam("bevel angle=30 land=2", start=1000.0)
    two = bevels_of(flange(), halves[0], other).bevels
    assert [(b.start, b.end) for b in two] == [(0.0, 1000.0), (1000.0, LENGTH)]


def test_an_edge_no_torch_can_cut_is_refused_by_name():
    with pytest.raises(BendTorsionError, match="M1-T1.*cannot be cut"):
        bevels_of(flange(lambda s: np.radians(-20.0)), seam("bevel angle=60 land=6"))


def size(plate):
    cut = cut_contour(plate).plate
    return cut.length, cut.width


def test_contours_of_every_face_of_a_rectangle_by_hand():
    groove, tip = "bevel angle=45 land=6", 14.0
    for marking_face, moved in (("inside", 0.0), ("outside", -tip)):
        plate = flange(marking_face=marking_face)
        for contour, step in (("mid", 0.0), ("top", moved), ("root", 0.0), ("widest", 0.0)):
            made = bevels_of(plate, seam(groove), contour=contour)
            assert size(made) == pytest.approx((LENGTH, WIDTH + step), abs=1e-9)


def test_ends_and_edges_of_a_moved_contour_meet():
    welds = (
        seam("bevel angle=45 land=6"),
        joint("v angle=60 land=2", ("M1-T1", "M1-T2")),
        joint("v angle=60 land=2", ("M1-T0", "M1-T1")),
    )
    plate = bevels_of(flange(marking_face="outside"), *welds, contour="top")
    assert [b.side for b in plate.bevels] == ["first", "end", "start"]
    cut = cut_contour(plate)
    end = 18.0 * np.tan(np.radians(30.0))
    assert (cut.plate.length, cut.plate.width) == pytest.approx(
        (LENGTH - 2 * end, WIDTH - 14.0), abs=1e-9
    )
    runs = cut.plate.outline
    for run, following in zip(runs, [*runs[1:], runs[0]], strict=True):
        assert run[-1] == pytest.approx(following[0], abs=1e-9)
    # Marks move with the corner the contour's frame begins at.
    before = plate.lines[2].flat[0]
    assert cut.plate.lines[2].flat[0] == pytest.approx(before - [end, 14.0], abs=1e-9)
    assert [None if b is None else b.side for b in cut.bevels].count(None) == 1


def test_the_faces_of_a_tilted_edge_lie_apart_by_the_tilt():
    tilt = np.radians(10.0)
    plate = flange(lambda s: tilt)
    assert [b.natural for b in bevels_of(plate).bevels] == pytest.approx([tilt])
    step = 0.5 * THICKNESS * np.tan(tilt)
    for marking_face, moved in (("inside", -step), ("outside", step)):
        own = replace(bevels_of(plate, contour="top"), marking_face=marking_face)
        assert size(own)[1] == pytest.approx(WIDTH + moved, abs=1e-9)
    assert size(bevels_of(plate, contour="widest"))[1] == pytest.approx(WIDTH + step, abs=1e-9)


def test_a_step_in_the_groove_is_a_step_in_the_contour():
    welds = seam("bevel angle=45 land=6", end=1000.0), seam("bevel angle=45 land=10", start=1000.0)
    made = bevels_of(flange(marking_face="outside"), *welds, contour="top")
    ring = np.concatenate(cut_contour(made).plate.outline)
    x, y = ring.T
    area = 0.5 * abs((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())
    assert area == pytest.approx(LENGTH * WIDTH - 1000.0 * 14.0 - 1400.0 * 10.0, abs=0.1)


def test_allowances_and_green_go_with_the_contour():
    welds = seam("bevel angle=45 land=6"), joint("v angle=60 land=2", ("M1-T1", "M1-T2"))
    made = bevels_of(flange(marking_face="outside"), *welds, contour="top")
    plate = replace(made, gross=gross_pattern(made, 1.001, 1.0, 0.0, 30.0))
    cut = cut_contour(plate)
    # Green is cut off at the fit-up: that end is square.
    assert not [b for b in cut.bevels if b is not None and b.side == "end"]
    assert cut.plate.length == pytest.approx(1.001 * LENGTH + 30.0, abs=1e-6)
    assert cut.plate.width == pytest.approx(WIDTH - 14.0, abs=1e-9)


def test_texts_tell_angle_face_and_land():
    plate = flange()
    [outer] = bevels_of(plate, seam("bevel angle=45 land=6")).bevels
    assert bevel_text(outer, "inside", 20.0) == "45.0 deg down land 6"
    assert bevel_text(outer, "outside", 20.0) == "45.0 deg up land 6"
    [both] = bevels_of(plate, seam("double-v angle=60 land=2")).bevels
    assert bevel_text(both, "inside", 20.0) == "30.0/30.0 deg up/down land 2"
    [tilted] = bevels_of(flange(lambda s: np.radians(3.0))).bevels
    assert bevel_text(tilted, "inside", 20.0) == "3.0 deg up"
