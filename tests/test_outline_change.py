# SPDX-License-Identifier: LGPL-2.1-or-later
"""Deviation of outlines in their best alignment, and trimming, against plates known in closed
form."""

import numpy as np
import pytest

from BendTorsionWB.core.patterns.outline_change import MISSING, apart, deviation, trim


def plate(length=6000.0, width=800.0, sag=0.0, slant=0.0, count=120):
    """A plate between two parallel parabolas, its end slanting by `slant` over the width."""
    u = np.linspace(0.0, 1.0, count)
    bow = 4.0 * sag * u * (1.0 - u)
    low = np.column_stack([u * length, bow])
    high = np.column_stack([u * (length + slant), bow + width])
    return np.vstack([low, high[::-1]])


def moved(points, angle=0.02, by=(31.0, -17.0)):
    c, s = np.cos(angle), np.sin(angle)
    return points @ np.array([[c, s], [-s, c]]) + by


@pytest.mark.parametrize("sag", [0.0, 40.0, 200.0])
def test_a_plate_moved_and_turned_is_the_same(sag):
    assert deviation(plate(sag=sag), moved(plate(sag=sag))) < 1e-6
    assert deviation(plate(sag=sag), plate(sag=sag)) == 0.0


def test_how_far_outlines_are_apart_where_they_lie():
    assert apart(plate(), plate()) == pytest.approx(0.0, abs=1e-9)
    assert apart(plate(), plate() + (3.0, 0.0)) == pytest.approx(3.0, abs=1e-6)


@pytest.mark.parametrize("more", [1.0, 10.0, 60.0])
def test_longer_and_wider_plates_deviate_by_half_at_each_side(more):
    assert deviation(plate(), plate(6000.0 + more)) == pytest.approx(more / 2, abs=1e-3)
    assert deviation(plate(), moved(plate(width=800.0 + more))) == pytest.approx(more / 2, abs=1e-3)
    assert deviation(plate(6000.0 + more), plate()) == pytest.approx(more / 2, abs=1e-3)


def test_more_bow_deviates_by_half_of_it():
    # The best line between two parabolas of different rise halves the difference.
    assert deviation(plate(sag=40.0), plate(sag=46.0)) == pytest.approx(3.0, rel=0.01)


def test_one_vertex_out_of_place_is_found_between_stations():
    harmed = plate()
    harmed[30, 1] += 5.0
    assert 2.4 < deviation(plate(), harmed) < 5.0


@pytest.mark.parametrize(
    ("new", "side", "off"),
    [
        (plate(5990.0), "E-2", 10.0),
        (plate(width=780.0), "upper edge", 20.0),
        (plate(slant=-30.0), "E-2", 30.0),
    ],
)
def test_a_smaller_plate_is_cut_from_the_old_one_at_one_side(new, side, off):
    found = trim(plate(), moved(new, 0.001, (3.0, 2.0)))
    assert found.possible
    assert dict(found.sides) == {side: pytest.approx(off, abs=2.5 * MISSING)}


def test_the_ends_are_named_by_where_they_lie():
    assert [name for name, _ in trim(plate(), plate(slant=-30.0), True).sides] == ["E-1"]


@pytest.mark.parametrize(("start", "end", "side"), [(108.0, 6000.0, "E-1"), (0.0, 5892.0, "E-2")])
def test_what_comes_off_does_so_at_the_end_that_moved(start, end, side):
    """The bow changes by little, and the new plate would do anywhere along the old one to within
    what may be missing; marks and openings hold only where the edges lie on each other."""

    def bent(first, last):
        u = np.linspace(first, last, 2000)
        low = np.column_stack([u, 4e-6 * u**2 + 8e-11 * u**3])
        high = np.column_stack([u, 800.0 + 4e-6 * u**2 - 8e-11 * u**3])
        return np.vstack([low, high[::-1]])

    found = trim(bent(0.0, 6000.0), moved(bent(start, end), 0.01))
    assert found.missing < 0.01
    assert dict(found.sides) == {side: pytest.approx(108.0, abs=2.5 * MISSING)}
    point = np.array([[3000.0, 400.0]])
    assert found.laid(moved(point, 0.01)) == pytest.approx(point, abs=0.5)


def test_both_sides_come_off_where_both_must():
    found = trim(plate(), plate(5990.0, 780.0))
    assert {name for name, _ in found.sides} == {"E-2", "upper edge"}


@pytest.mark.parametrize(
    ("new", "missing"), [(plate(6004.0), 2.0), (plate(width=801.0), 0.5), (plate(sag=10.0), 5.0)]
)
def test_material_that_is_missing_makes_it_impossible(new, missing):
    found = trim(plate(), new)
    assert not found.possible and found.sides == ()
    assert found.missing == pytest.approx(missing, rel=0.02)


def test_a_plate_within_what_may_be_missing_stays_as_it_is():
    found = trim(plate(), plate(6000.1))
    assert found.possible and found.sides == ()
