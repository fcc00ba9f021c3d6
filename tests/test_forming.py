# SPDX-License-Identifier: LGPL-2.1-or-later
"""Forming classes, stresses, roll lines and pull-down forces against closed forms."""

import curved_members
import numpy as np
import pytest
import ruled_patches

from BendTorsionWB.core.flattening.development import ACROSS, develop
from BendTorsionWB.core.flattening.surface_shape import shape_inside, shape_of
from BendTorsionWB.core.patterns.forming import (
    FormingRules,
    flat_deviation,
    fold_direction,
    forming_of,
    pull_down,
    roll_lines_of,
)
from BendTorsionWB.core.patterns.pattern import develop_plate
from BendTorsionWB.core.plates.plates import Joints, split_plates
from BendTorsionWB.core.sections.section import Material

STEEL = Material()
SHEAR = STEEL.e / 2.6
DENSITY = 7.85e-6


def straight_cylinder(radius, length=6000.0):
    return develop(ruled_patches.cylinder(radius, 800.0, length, skew=0.0, wave=0.0))


def formed(development, thickness=20.0, material=STEEL, mass=None, **more):
    mass = 800 * 6000 * thickness * DENSITY if mass is None else mass
    more.setdefault("roll_lines", roll_lines(development))
    return forming_of(development, thickness, material, mass, chord(development), **more)


def chord(development):
    """Straight length between the middles of the end lines in the plane."""
    plane = development.plane
    ends = development.flat(np.array([plane.start, plane.end]), np.array([0.5, 0.5]))
    return float(np.hypot(*(ends[1] - ends[0])))


def roll_lines(development, places=None, mirrored=False):
    """Roll lines in the plane, or in its mirror image, within its four edges."""
    plane = development.plane
    if places is None:
        places = np.linspace(plane.start, plane.end, 9)[1:-1]
    flip = np.array([-1.0, 1.0]) if mirrored else 1.0
    dense = np.linspace(plane.start, plane.end, 2001)
    first, second = (development.flat(dense, np.full(2001, w)) * flip for w in (0.0, 1.0))
    rulings = np.stack(
        [development.flat(places, np.full(len(places), w)) * flip for w in (0.0, 1.0)], axis=1
    )
    border = [first, np.array([first[-1], second[-1]]), second, np.array([second[0], first[0]])]
    return rolled(development, places, rulings, border, -1.0 if mirrored else 1.0)


def rolled(development, places, rulings, border, forward=1.0):
    """The roll lines of one plate."""
    rails = development.surface.with_rates(places)
    forward = np.full(len(places), forward)
    return roll_lines_of([places], rulings, [border], forward, rails)[0]


def test_a_cylinder_has_its_radius_and_no_twist_nor_membrane_strain():
    record = formed(straight_cylinder(12000.0))
    assert record.bending_radius_min == pytest.approx(12000.0, rel=1e-9)
    assert record.twist_max < 1e-12
    assert record.strain.value < 1e-10
    # Plane strain bending: von Mises of σ11 = E't/2R and σ22 = νσ11.
    bending = STEEL.e / (1 - 0.09) * 20.0 / 24000.0 * np.sqrt(1 - 0.3 + 0.09)
    assert record.stress.value == pytest.approx(bending, rel=1e-6)


def test_a_twisted_plate_has_its_twist_corner_forces_and_shear():
    record = formed(develop(ruled_patches.helicoid(0.03)))
    assert record.twist_max == pytest.approx(3e-5, rel=1e-4)
    corner = SHEAR * 20.0**3 / 3.0 * 3e-5
    assert record.pull_down.corner_force == pytest.approx(1e-3 * corner, rel=1e-4)
    assert record.pull_down.torque == pytest.approx(1e-6 * corner * 800.0, rel=1e-4)
    assert record.pull_down.moment == pytest.approx(0.0, abs=1e-6)
    # Shear √3·G·t·τ everywhere; membrane E'τ²b²/8 in the middle of the `edges` pattern.
    membrane = STEEL.e / (1 - 0.09) * (3e-5 * 800.0) ** 2 / 8.0 * np.sqrt(1 - 0.3 + 0.09)
    shear = np.sqrt(3.0) * SHEAR * 20.0 * 3e-5
    assert record.stress.value == pytest.approx(np.hypot(membrane, shear), rel=2e-3)


def test_pure_twist_yields_where_plate_theory_says():
    # 7.4 degrees per metre for 20 mm of S355; narrow, so that no membrane stress joins in.
    twist = STEEL.fy / (np.sqrt(3.0) * SHEAR * 20.0)
    assert np.degrees(1e3 * twist) == pytest.approx(7.4, abs=0.05)
    record = formed(develop(ruled_patches.helicoid(1e3 * twist, width=10.0)))
    assert record.stress.value == pytest.approx(STEEL.fy, rel=1e-3)


def class_at(radius, **more):
    return formed(straight_cylinder(radius, 3000.0), **more).forming_class


def test_the_class_changes_where_its_rule_says():
    factor = np.sqrt(1 - 0.3 + 0.09) / (1 - 0.09)
    limit = STEEL.e * factor * 20.0 / (2 * 100.0)
    assert class_at(1.001 * limit).name == "elastic"
    stiff = class_at(0.999 * limit)
    assert (stiff.name, stiff.rule, stiff.limit) == ("cold", "elastic_stress", 100.0)
    assert stiff.value == pytest.approx(100.0 / 0.999, rel=1e-6)
    assert class_at(25.01 * 20.0).name == "cold"
    sharp = class_at(24.99 * 20.0)
    assert (sharp.name, sharp.rule, sharp.limit) == ("hot", "cold_radius_low_alloy", 500.0)
    mild = Material("Q235", fy=235.0)
    assert class_at(20.01 * 20.0, material=mild).name == "cold"
    assert class_at(19.99 * 20.0, material=mild).rule == "cold_radius_mild"


def test_membrane_strain_beyond_yield_is_formed_hot():
    # Eτ²b²/8 = fy: rolling stretches nothing.
    twist = np.sqrt(8.0 * STEEL.fy / STEEL.e) / 800.0
    below, above = (
        formed(develop(ruled_patches.helicoid(1e3 * f * twist)), 10.0).forming_class
        for f in (0.98, 1.03)
    )
    assert below.name == "cold"
    assert (above.name, above.rule) == ("hot", "membrane_yield")


def test_folds_are_pressed_and_flat_plates_stay_flat():
    plane = develop(ruled_patches.plane())
    assert formed(plane).forming_class.name == "flat"
    assert formed(plane).roll_lines == ()
    assert formed(plane).advice == "may stay flat"
    folded = formed(plane, fold_angles=[0.0, -0.05]).forming_class
    assert (folded.name, folded.rule) == ("cold", "fold_without_press")
    assert folded.value == pytest.approx(np.degrees(0.05))
    assert formed(plane, fold_angles=[0.001]).forming_class.name == "flat"


def test_flat_deviation_is_half_the_rise_of_an_arc():
    radius, length = 2e6, 6000.0
    rise = radius * (1 - np.cos(length / (2 * radius)))
    development = straight_cylinder(radius)
    assert flat_deviation(development) == pytest.approx(rise / 2, rel=1e-3)
    wide, narrow = rise / 2 * 1.01, rise / 2 * 0.99
    assert formed(development, rules=FormingRules(wide)).forming_class.name == "flat"
    assert formed(development, rules=FormingRules(narrow)).forming_class.name == "elastic"


def test_roll_lines_of_a_cone_are_its_generators_and_carry_its_radius():
    rails = ruled_patches.cone()
    lines = roll_lines(develop(rails), np.array([1500.0, 3000.0, 4500.0]))
    for line in lines:
        assert line.skew == pytest.approx(0.0, abs=1e-7)
        ends = rails(np.array([line.s])).reshape(2, 3)
        # Radius of curvature at distance d from the apex: d·tan(half angle).
        distances = np.linalg.norm([ends[0], ends.mean(axis=0), ends[1]], axis=1)
        np.testing.assert_allclose(line.radius, distances * np.tan(0.4), rtol=1e-7)
        apart = np.linalg.norm(ends[1] - ends[0])
        assert np.linalg.norm(line.flat[1] - line.flat[0]) == pytest.approx(apart, abs=1e-6)


def test_roll_lines_lie_across_the_sharpest_curvature():
    development = develop(ruled_patches.bent_in_plane(lambda s: 600.0 + 0.0 * s, twist=0.1))
    places = np.array([2500.0, 3000.0])
    for line in roll_lines(development, places):
        assert 0.05 < abs(line.skew) < np.pi / 4
        shape = shape_of(development.surface, np.array([line.s]), np.array([0.5]))
        bend, twist = shape.bend[0, 0], shape.twist[0, 0]
        matrix = np.array([[bend, twist], [twist, 0.0]])
        values, vectors = np.linalg.eigh(matrix)
        least = vectors[:, np.argmin(np.abs(values))]
        own = np.array([np.sin(line.skew), np.cos(line.skew)])
        assert abs(least @ own) == pytest.approx(1.0, abs=1e-9)
        assert line.radius[1] == pytest.approx(1.0 / np.abs(values).max(), rel=1e-9)


def test_curvatures_of_a_surface_are_consistent():
    rails = ruled_patches.bent_in_plane(lambda s: 600.0 + 0.0 * s, twist=0.1)
    shape = shape_inside(rails, ACROSS)
    np.testing.assert_allclose(shape.gauss, -(shape.twist**2), rtol=1e-9)
    np.testing.assert_allclose(
        shape.sharpest, np.abs(shape.bend) / 2 + np.hypot(shape.bend / 2, shape.twist), rtol=1e-9
    )


def pulled(development, mass):
    shape = shape_inside(development.surface, ACROSS)
    return pull_down(development, shape, 20.0, STEEL, mass, chord(development))


def test_weight_pulls_a_plate_down_until_it_drops_in():
    arc = straight_cylinder(50000.0)
    stiffness = STEEL.e / (1 - 0.09) * 800.0 * 20.0**3 / 12.0
    moment = 1e-6 * stiffness / 50000.0
    light = pulled(arc, 0.0)
    assert light.moment == pytest.approx(moment, rel=1e-7)
    assert light.clamp_middle == pytest.approx(4.0 * moment / 6.0, rel=1e-3)
    assert not light.drops_in
    # W·L/8 = M, W in kN.
    enough = 8.0 * moment / 6.0 / 9.80665e-3
    assert pulled(arc, 1.01 * enough).drops_in
    assert not pulled(arc, 0.99 * enough).drops_in


def test_the_sheet_says_what_to_do():
    gentle = formed(straight_cylinder(60000.0))
    assert gentle.forming_class.name == "elastic"
    assert gentle.advice == "drops in"
    twisted = formed(develop(ruled_patches.helicoid(0.02)))
    force = twisted.pull_down.clamp_corner
    assert force == pytest.approx(
        twisted.pull_down.corner_force - 800 * 6000 * 20 * DENSITY * 9.80665e-3 / 4, rel=1e-9
    )
    assert twisted.advice == f"clamp with {force:.1f} kN at each free corner"
    assert formed(straight_cylinder(12000.0)).advice == "pre-form cold"


@pytest.mark.parametrize(
    ("angle", "face", "direction"),
    [(0.1, "inside", "up"), (0.1, "outside", "down"), (-0.1, "inside", "down")],
)
def test_folds_are_up_or_down_seen_from_the_marking_face(angle, face, direction):
    # angle > 0: the outer face is convex, so that a plate seen from inside closes on the eye.
    assert fold_direction(angle, face) == direction


def test_roll_lines_of_a_cylinder_are_its_generators_with_its_radius():
    development = develop(ruled_patches.cylinder(12000.0))
    lines = roll_lines(development)
    assert [line.label for line in lines] == [f"R-{k}" for k in range(1, 8)]
    for line in lines:
        np.testing.assert_allclose(line.radius, 12000.0, rtol=2e-9)
        ruling = development.flat(np.full(2, line.s), np.array([0.0, 1.0]))
        np.testing.assert_allclose(line.flat, ruling, atol=1e-4)
        assert line.text() == f"{line.label} R 12.0 m"


def test_roll_lines_end_on_the_outline_and_are_mirrored_with_the_pattern():
    development = develop(ruled_patches.bent_in_plane(lambda s: 600.0 + 0.0 * s, twist=0.1))
    places = np.array([400.0, 2500.0, 5600.0])
    plain, mirrored = (roll_lines(development, places, flip) for flip in (False, True))
    outline = [development.flat(np.linspace(0, 6000, 3001), np.full(3001, w)) for w in (0.0, 1.0)]
    outline += [development.flat(np.full(801, s), np.linspace(0, 1, 801)) for s in (0.0, 6000.0)]
    outline = np.concatenate(outline)
    for one, other in zip(plain, mirrored, strict=True):
        np.testing.assert_allclose(other.flat * (-1.0, 1.0), one.flat, atol=1e-9)
        np.testing.assert_allclose(other.radius, one.radius)
        for end in one.flat:
            assert np.hypot(*(outline - end).T).min() < 2.0
        middle = development.flat(np.array([one.s]), np.array([0.5]))[0]
        along = one.flat[1] - one.flat[0]
        off = middle - one.flat[0]
        assert abs(along[0] * off[1] - along[1] * off[0]) / np.hypot(*along) < 1e-9


def test_a_roll_line_stops_at_a_fold():
    middle, across = np.array([[500.0, 300.0]]), np.array([[[500.0, 0.0], [500.0, 600.0]]])
    development = develop(ruled_patches.cylinder(skew=0.0, wave=0.0))
    square = np.array([[0.0, 0.0], [6000.0, 0.0], [6000.0, 600.0], [0.0, 600.0], [0.0, 0.0]])
    fold = np.array([[400.0, 450.0], [600.0, 450.0]])
    (free,), (stopped,) = (
        rolled(development, np.array([500.0]), across, border)
        for border in ([square], [square, fold])
    )
    np.testing.assert_allclose(free.flat, across[0], atol=1e-9)
    np.testing.assert_allclose(stopped.flat, [across[0, 0], [500.0, 450.0]], atol=1e-9)
    assert np.allclose(middle[0], free.flat.mean(axis=0))
    outside = across + (0.0, 700.0)
    assert rolled(development, np.array([500.0]), outside, [square]) == ()


def test_peaks_are_where_the_fields_are_largest():
    development = develop(ruled_patches.helicoid(0.04))
    record = formed(development)
    for peak in (record.strain, record.stress):
        np.testing.assert_allclose(
            peak.flat, development.flat(np.array([peak.s]), np.array([peak.w]))[0]
        )
    # `edges` keeps both edges: the middle of the plate is strained most, by τ²b²/8.
    assert record.strain.w == 0.5
    assert record.strain.value == pytest.approx((4e-5 * 800) ** 2 / 8, rel=2e-3)
    assert record.locked_in_stress == STEEL.e * record.strain.value


def test_every_plate_of_a_member_has_its_forming_data():
    member = curved_members.tapered()
    plates = split_plates(member, {"top": Joints((0.5,))})[0]
    inside, outside = (
        [develop_plate(plate, marking_face=face) for plate in plates]
        for face in ("inside", "outside")
    )
    assert any(plate.folds for plate in inside)
    for one, other in zip(inside, outside, strict=True):
        data = one.forming_data
        assert data.forming_class.name == one.forming
        assert data.strain.value <= one.strain_max
        assert data.bending_radius_min == one.bending_radius_min
        assert [bend.label for bend in data.fold_lines] == [fold.label for fold in one.folds]
        for bend, back in zip(data.fold_lines, other.forming_data.fold_lines, strict=True):
            assert {bend.direction, back.direction} == {"up", "down"}
        assert len(data.roll_lines) == len(one.lines) - 1
        corners = np.concatenate(one.outline)
        for line, back in zip(data.roll_lines, other.forming_data.roll_lines, strict=True):
            assert np.allclose(line.radius, back.radius) and line.skew == pytest.approx(back.skew)
            assert (line.flat >= corners.min(axis=0) - 1e-6).all()
            assert (line.flat <= corners.max(axis=0) + 1e-6).all()
            # Seen from the other face, across the plate is the other way round.
            np.testing.assert_allclose(
                np.hypot(*(line.flat[1] - line.flat[0])), np.hypot(*(back.flat[1] - back.flat[0]))
            )
        assert data.note().startswith(f"forming: {one.forming} (")
