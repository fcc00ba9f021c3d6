# SPDX-License-Identifier: LGPL-2.1-or-later
"""Skins follow their rails, with one parameter for all, and enclose the volume they should."""

import FreeCAD  # noqa: F401
import numpy as np
import pytest
from curved_members import ELLIPSOID, in_space, member, tapered

from BendTorsionWB.core.geometry.piecewise import sample
from BendTorsionWB.core.members.skin import skin
from BendTorsionWB.core.members.strips import strip_rails
from BendTorsionWB.core.members.volume import skin_volume, strip_volume
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.shapes import brep

BREAKS = np.array([0.0, 2000.0, 4000.0])


def ring_rails(radius, half=(100.0, 10.0), angle=0.5):
    """Four corners of a rectangle swept round a circle, by arc length on radius."""

    def corners(s):
        a = s / radius
        reach = radius + half[0] * np.array([1, -1, -1, 1])
        height = half[1] * np.array([1, 1, -1, -1])
        x, y = np.cos(a)[:, None] * reach, np.sin(a)[:, None] * reach
        return np.stack([x, y, np.broadcast_to(height, x.shape)], axis=2).reshape(len(s), 12)

    return sample(corners, np.linspace(0, radius * angle, 5))


def test_the_skin_follows_its_rails_to_the_tolerance_between_stations():
    built = member([Segment(box("S", "box1", 800, 800, 20))])
    corners = built.corners(0.0, built.length)
    for tolerance in (0.01, 1e-5):
        [piece] = skin((corners,), tolerance=tolerance)
        s = np.linspace(0, built.length, 3001)
        miss = np.linalg.norm(piece.at(s) - corners(s).reshape(-1, 4, 3), axis=2)
        assert miss.max() <= tolerance


def test_the_corners_of_a_24_m_diagonal_are_true_to_half_a_micrometre():
    built = member([Segment(box("S", "box1", 800, 800, 20))])
    [piece] = skin((built.corners(0.0, 24000.0),))
    s = np.linspace(1.0, 24000.0 - 1.0, 997)
    for k, (y, z) in enumerate([(400, 400), (-400, 400), (-400, -400), (400, -400)]):
        truth = in_space(built, ELLIPSOID, s, (y, z))
        assert np.linalg.norm(piece.at(s)[:, k] - truth, axis=1).max() <= 5e-4


def test_folds_stay_sharp_and_nothing_overshoots():
    built = tapered()
    corners, folds = built.corners(0.0, built.length), built.law.folds
    pieces = skin((corners,), (folds,))
    assert len(pieces) == 3
    for one, two, fold in zip(pieces, pieces[1:], folds):
        assert one.knots[-1] == two.knots[0] == fold
        at = np.array([fold])
        assert np.abs(one.at(at) - two.at(at)).max() < 1e-9
        assert np.abs(one.at(at).ravel() - corners(at)[0]).max() < 1e-9
    for piece in pieces:
        near = np.clip([folds[0] - 250.0, folds[1] + 250.0], piece.knots[0], piece.knots[-1])
        s = np.linspace(*near, 301)[1:-1]
        assert np.abs(piece.at(s) - corners(s).reshape(-1, 4, 3)).max() < 1e-3


def test_all_rails_of_a_piece_share_stations_and_knots():
    steep = sample(
        lambda s: np.column_stack([s, np.sin(s / 150), 0 * s, s, 0 * s, 0 * s + 9]), BREAKS
    )
    [piece] = skin((steep,), tolerance=1e-3)
    assert piece.poles.shape[:1] == (2,) and piece.poles.shape[1] == len(piece.knots) - 4
    s = np.linspace(0, 4000, 501)
    assert np.abs(piece.at(s).reshape(-1, 6) - steep(s)).max() < 2e-3


def test_volume_of_a_ring_sector_by_pappus():
    rails = ring_rails(3000.0)
    [piece] = skin((rails,), tolerance=1e-6)
    assert skin_volume([piece]) == pytest.approx(200 * 20 * 3000 * 0.5, rel=1e-7)


def test_volume_does_not_depend_on_where_the_solid_lies():
    rails = ring_rails(3000.0)
    far = sample(lambda s: rails(s) + np.tile([7e4, -3e4, 5e4], 4), rails.breaks)
    [here], [there] = skin((rails,)), skin((far,))
    assert skin_volume([there]) == pytest.approx(skin_volume([here]), rel=1e-9)


def test_a_folded_strip_has_the_volume_of_its_skin_and_of_the_kernels_solid():
    built = tapered("box2", align="bottom", align_to="previous", slope=4.0)
    for k in range(4):
        rails = strip_rails(built, k, 6000.0, 9300.0)
        pieces = skin(
            (rails.outer, rails.inner), (rails.boundaries, rails.inner_folds), tolerance=1e-5
        )
        ring = [type(p)(p.knots, p.poles[[0, 1, 3, 2]]) for p in pieces]
        volume = strip_volume(rails)
        assert skin_volume(ring) == pytest.approx(volume, rel=1e-7)
        solid = brep.tube_solid([(p.knots, p.poles) for p in ring])
        assert solid.Volume == pytest.approx(volume, rel=1e-4)
