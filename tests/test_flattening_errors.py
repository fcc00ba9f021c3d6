# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors of laid plates by kind, surfaces laid flat, the way from the flat back to the model."""

import curved_members
import numpy as np
import pytest
import ruled_patches

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.flattening.development import develop, flat_area
from BendTorsionWB.core.flattening.developments import Developments
from BendTorsionWB.core.patterns.flattened_surface import SURFACES, on_surface
from BendTorsionWB.core.patterns.laid_flat import PatternInput, laid_flat
from BendTorsionWB.core.patterns.pattern import MODES, pattern_of
from BendTorsionWB.core.plates.plates import Joints, split_plates


@pytest.fixture(scope="module")
def member():
    return curved_members.tapered()


@pytest.fixture(scope="module")
def plates(member):
    return split_plates(member, {"top": Joints((0.4,)), "left": Joints((0.5,))})[0]


@pytest.mark.parametrize("rails", [ruled_patches.cylinder(), ruled_patches.cone()])
def test_developable_patches_keep_their_area(rails):
    for mode in ("edges", "energy"):
        laid = develop(rails, mode=mode)
        both = Developments((laid,))
        assert both.flat_areas()[0] == pytest.approx(both.curved_areas()[0], rel=1e-11)
        assert both.flat_areas()[0] == pytest.approx(flat_area(laid), rel=1e-15)


def test_the_area_of_a_helicoid_by_hand():
    # Unit speed along the axis and k r round it: ∫∫ sqrt(1 + k²r²) dr ds.
    k, half, length = 1e-4, 400.0, 6000.0
    x = k * half
    area = 2.0 * length * (0.5 / k) * (x * np.sqrt(1.0 + x * x) + np.arcsinh(x))
    laid = Developments((develop(ruled_patches.helicoid(0.1)),))
    assert laid.curved_areas()[0] == pytest.approx(area, rel=1e-12)


def test_edges_keeps_edges_and_lines_and_leaves_diagonals_and_centre(member, plates):
    for record in laid_flat(member, plates):
        errors = record.errors
        assert abs(errors.edge) < 1e-6 and abs(errors.line) < 1e-6 and errors.seam < 1e-6
        assert abs(errors.diagonal) == pytest.approx(record.length_error_max, abs=1e-7)
        assert errors.centre_line >= -1e-9 and errors.area >= 0.0


def test_the_centre_line_and_the_area_grow_as_the_twist_says():
    # `edges` makes the centre line longer by b/8 ∬|K|dA = L k²b²/8, the area by L k²b³/12.
    k, b, length = 3e-5, 800.0, 6000.0
    laid = Developments((develop(ruled_patches.helicoid(1e3 * k), mode="edges"),))
    (flat,), (true,) = laid.centre_lines()
    assert flat - true == pytest.approx(length * (k * b) ** 2 / 8.0, rel=1e-3)
    area = laid.flat_areas()[0] - laid.curved_areas()[0]
    assert area == pytest.approx(length * b**3 * k**2 / 12.0, rel=2e-3)


def test_modes_that_strain_the_edges_say_by_how_much_seams_miss(member, plates):
    for mode in ("energy", "elastic"):
        made = laid_flat(member, plates, PatternInput(mode))
        worst = max(record.errors.seam for record in made)
        assert 1e-4 < worst < 0.2
        assert max(abs(record.errors.area) for record in made) < 0.01


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("surface", SURFACES)
def test_flat_points_go_back_to_where_they_were_formed(plates, mode, surface):
    random = np.random.default_rng(7)
    for plate in plates[:: 3 if mode == "elastic" else 1]:
        pattern = pattern_of(plate, mode=mode, surface=surface)
        s = random.uniform(plate.start, plate.end, 60)
        w = random.uniform(0.0, 1.0, 60)
        rails = on_surface(plate, surface).rails.mid(s)
        model = rails[:, :3] + w[:, None] * (rails[:, 3:] - rails[:, :3])
        back = pattern.formed(pattern.flat(s, w))
        assert np.linalg.norm(back - model, axis=1).max() < 1e-6


def test_points_off_the_pattern_are_refused(plates):
    with pytest.raises(BendTorsionError) as caught:
        pattern_of(plates[0]).formed(np.array([[100.0, 5000.0]]))
    assert caught.value.findings[0].code == "point-off-pattern"


@pytest.mark.parametrize("surface", SURFACES)
def test_the_surface_laid_flat_is_the_one_measured(member, plates, surface):
    records = laid_flat(member, plates, PatternInput(surface=surface))
    for plate, record in zip(plates, records, strict=True):
        rails = getattr(plate.rails, surface)
        for k, line in enumerate(record.lines):
            if line.label.startswith("F"):
                continue
            ends = rails(np.array([plate.lines[k].s]))[0]
            true = np.linalg.norm(ends[3:] - ends[:3])
            assert line.length_3d == pytest.approx(true, abs=1e-9)
            assert line.length_flat == pytest.approx(true, abs=1e-6)
        assert record.length_error_max <= max(2.5 * record.length_error_bound, 1e-6)
        offsets = [edge.offset_outer for edge in record.edges]
        if surface == "outer":
            np.testing.assert_allclose(offsets, 0.0, atol=1e-9)


@pytest.mark.parametrize(
    "given", [PatternInput("best"), PatternInput(surface="top"), PatternInput(marking_face="left")]
)
def test_unknown_words_are_refused(member, plates, given):
    with pytest.raises(BendTorsionError) as caught:
        laid_flat(member, plates, given)
    assert caught.value.findings[0].code == "pattern-input"
