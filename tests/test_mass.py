# SPDX-License-Identifier: LGPL-2.1-or-later
"""Centres of gravity, painted areas and surfaces: closed forms, and the kernel's own figures."""

import FreeCAD  # noqa: F401  (Part needs it loaded first)
import numpy as np
import pytest

from BendTorsionWB.core import detailing
from BendTorsionWB.core.axes.axis_input import AxisInput
from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.sections.section import Material, box
from BendTorsionWB.core.sections.section_properties import section_properties
from BendTorsionWB.core.sections.section_types import (
    channel,
    i_section,
    polygon,
    t_section,
    trapezoid,
)
from BendTorsionWB.core.solids.mass import solid_figures
from BendTorsionWB.shapes import brep

PLANE = analytic_surface("plane", {})
R = 20000.0
CYLINDER = analytic_surface("cylinder", {"r": R})
SECTIONS = (
    box("B1", "box1", 800, 600, 20, 24, 16, gap1=3),
    box("B2", "box2", 800, 600, 20, 24, 16, gap2=2),
    i_section("I", 600, 300, 20, 24, 12, b_bottom=200),
    t_section("T", 500, 300, 20, 12),
    channel("C", 500, 200, 20, 16, 12, gap1=1),
    trapezoid("Z", 600, 500, 300, 20, 16, 12, joint="flanges"),
    polygon("P", [(0, 0), (500, 0), (600, 400), (100, 500)], 16),
)


def plates_of(section, points, surface, more=(), **given):
    axis = detailing.axis_of(AxisInput("A1", np.asarray(points, float)), surface)
    segments = (Segment(section, **given), *more)
    made = detailing.member_of(detailing.MemberInput("M1", segments), axis, surface)
    return detailing.plates_of(made, detailing.PlatesInput())


def straight(section, **given):
    return plates_of(section, [(0, 0, 0), (5000, 0, 0)], PLANE, **given)


@pytest.mark.parametrize("section", SECTIONS, ids=lambda s: s.name)
def test_a_straight_member_has_its_section_s_centroid_mass_and_perimeter(section):
    record = detailing.record_of(straight(section))
    found = section_properties(section)
    y, z = found.centroid
    assert record.centre_of_gravity == pytest.approx([2500.0, y, z], abs=1e-6)
    assert record.mass == pytest.approx(5000.0 * found.mass_per_length, rel=1e-9)
    assert record.painted_area == pytest.approx(5000.0 * found.painted_area, rel=1e-9)
    together = sum(plate.painted_area for plate in record.plates)
    gaps = 5000.0 * sum(
        stop.gap
        for strip in section.strips
        for stop in (strip.stops_at_first, strip.stops_at_second)
        if stop
    )
    # The mouths of root gaps belong to the member's skin and to no plate.
    assert together == pytest.approx(record.painted_area - (gaps if section.closed else 0.0))


def test_a_plate_bent_to_a_circle_lies_at_the_centroid_of_an_annular_sector():
    angle = 0.5
    turns = np.linspace(-angle / 2, angle / 2, 5)
    points = np.column_stack([R * np.cos(turns), R * np.sin(turns), 0.0 * turns])
    section = box("B", "box2", 800, 600, 20)
    record = detailing.record_of(plates_of(section, points, CYLINDER))
    for plate in record.plates:
        low, high = {"top": (380, 400), "bottom": (-400, -380)}.get(plate.face, (-380, 380))
        a, b = R + low, R + high
        reach = 2 / 3 * (b**3 - a**3) / (b**2 - a**2) * np.sin(angle / 2) / (angle / 2)
        across = {"left": 290.0, "right": -290.0}.get(plate.face, 0.0)
        # z is radial, x tangent: y = z × x is -Z or +Z by the sense of the axis.
        assert plate.centre_of_gravity[:2] == pytest.approx([reach, 0.0], abs=2e-3)
        assert abs(plate.centre_of_gravity[2]) == pytest.approx(abs(across), abs=1e-6)
    top = next(plate for plate in record.plates if plate.face == "top")
    # box2: the flange runs to the corners, its 20 mm edges are seen.
    sides = 2 * 0.5 * angle * ((R + 400) ** 2 - (R + 380) ** 2)
    assert top.painted_area == pytest.approx(angle * (R + 400) * 600 + sides, rel=3e-6)
    assert record.painted_area == pytest.approx(
        angle * 600 * ((R + 400) + (R - 400)) + angle * ((R + 400) ** 2 - (R - 400) ** 2), rel=3e-6
    )


def test_materials_of_different_density_pull_the_centre():
    light = box("L", "box2", 800, 600, 20, material=Material("A", 2.7e-6))
    heavy = box("H", "box2", 800, 600, 20, material=Material("B", 7.85e-6))
    plates = plates_of(
        light, [(0, 0, 0), (6000, 0, 0)], PLANE, [Segment(heavy, 2000.0, stagger="none")]
    )
    centre = detailing.record_of(plates).centre_of_gravity
    expected = (2.7 * 2000 * 1000 + 7.85 * 4000 * 4000) / (2.7 * 2000 + 7.85 * 4000)
    assert centre == pytest.approx([expected, 0.0, 0.0], abs=1e-6)


def test_the_figures_are_the_kernel_s_where_the_kernel_is_exact():
    """Faces of one knot span, where Open CASCADE integrates exactly; twisted, tapered, folded."""
    rng = np.random.default_rng(4)
    for _ in range(6):
        count = int(rng.integers(3, 6))
        angle = (np.arange(count) + rng.uniform(-0.2, 0.2, count)) * (2 * np.pi / count)
        ring = 300.0 * np.column_stack([0 * angle, np.cos(angle), np.sin(angle)])
        knots = np.repeat([0.0, 3000.0], 4)
        poles = [ring + [k * 1000.0, 40.0 * k, 0.0] for k in range(4)]
        poles = np.stack(poles, axis=1)
        poles[:, 1:3] += rng.uniform(-8, 8, (count, 2, 3))
        poles[:, 3] = poles[:, 3] @ _turn(0.1).T
        from BendTorsionWB.core.members.skin import SkinPiece

        [own] = solid_figures([[SkinPiece(knots, poles)]])
        solid = brep.tube_solid([(knots, poles)])
        assert own.volume == pytest.approx(solid.Volume, rel=1e-6)
        centre = np.array(solid.CenterOfMass)
        assert np.abs(own.centre - centre).max() <= 1e-6 * 3000.0
        areas = [face.Area for face in solid.Faces]
        assert own.face_areas == pytest.approx(areas[:count], rel=1e-6)
        assert own.end_areas == pytest.approx(areas[count:], rel=1e-6)
        assert own.surface == pytest.approx(solid.Area, rel=1e-6)


def _turn(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


def test_a_tapered_member_agrees_with_a_fine_mesh_of_its_own_rails():
    """Volume, centre and area of every plate by tetrahedra and triangles between its exact rails,
    extrapolated (Richardson) from two step widths."""
    from curved_members import ELLIPSOID, diagonal, irregular

    axis = detailing.axis_of(AxisInput("A1", irregular(diagonal)), ELLIPSOID)
    segments = (
        Segment(box("B8", "box1", 800, 800, 20, gap1=3)),
        Segment(box("B6", "box1", 600, 600, 20, gap1=3), 9000.0),
    )
    made = detailing.member_of(detailing.MemberInput("M1", segments), axis, ELLIPSOID)
    plates = detailing.plates_of(made, detailing.PlatesInput())
    figures = solid_figures([item.skin for item in plates.plates])
    for item, own in zip(plates.plates, figures, strict=True):
        volume, centre, outer = (
            (4 * fine - coarse) / 3
            for coarse, fine in zip(_meshed(item.plate, 200), _meshed(item.plate, 400), strict=True)
        )
        assert own.volume == pytest.approx(volume, rel=1e-6)
        assert np.abs(own.centre - centre).max() < 1e-6 * item.plate.end
        assert own.face_areas[0] == pytest.approx(outer, rel=1e-6)


def _meshed(plate, count):
    """Volume, centre and outer area from flat triangles between stations."""
    rings = []
    rails = plate.rails
    for side, folds in ((rails.outer, rails.outer_folds), (rails.inner, rails.inner_folds)):
        edges = [side.start, *folds, side.end]
        s = np.concatenate(
            [np.linspace(a, b, count + 1) for a, b in zip(edges[:-1], edges[1:], strict=True)]
        )
        rings.append(side(s).reshape(-1, 2, 3))
    outer, inner = rings
    ring = np.stack([outer[:, 0], outer[:, 1], inner[:, 1], inner[:, 0]], axis=1)
    hub = ring.mean(axis=(0, 1))
    ring = ring - hub
    volume, first, area = 0.0, np.zeros(3), 0.0
    for j in range(4):
        a, b = ring[:, j], ring[:, (j + 1) % 4]
        # Both ways of cutting each quadrilateral, half each: of second order in the step.
        for one, other, third in (
            (a[:-1], a[1:], b[1:]), (a[:-1], b[1:], b[:-1]),
            (a[:-1], a[1:], b[:-1]), (a[1:], b[1:], b[:-1]),
        ):  # fmt: skip
            own = 0.5 * (np.cross(one, other) * third).sum(axis=1) / 6.0
            volume += own.sum()
            first += (own[:, None] * (one + other + third) / 4.0).sum(axis=0)
    # Triangles as wide as the plate would take the edges' tilt for the face's.
    w = np.linspace(0.0, 1.0, 17)[:, None, None]
    grid = (1.0 - w) * ring[:, 0] + w * ring[:, 1]
    for one, other, third in (
        (grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:]), (grid[:-1, :-1], grid[1:, 1:], grid[1:, :-1])
    ):  # fmt: skip
        area += 0.5 * np.linalg.norm(np.cross(other - one, third - one), axis=2).sum()
    for k, sign in ((0, 1.0), (-1, -1.0)):
        for one, other, third in ((0, 1, 2), (0, 2, 3)):
            own = sign * float(np.cross(ring[k, one], ring[k, other]) @ ring[k, third]) / 6.0
            volume += own
            first += own * (ring[k, one] + ring[k, other] + ring[k, third]) / 4.0
    return abs(volume), first / volume + hub, area


def test_an_open_member_with_staggered_joints_is_painted_whole():
    thick = i_section("I1", 600, 300, 24, t_web=16)
    thin = i_section("I2", 600, 300, 16, t_web=10)
    points = [(0, 0, 0), (9000, 0, 0)]
    plates = plates_of(thick, points, PLANE, [Segment(thin, 4000.0)])
    assert len({item.plate.start for item in plates.plates}) > 2
    record = detailing.record_of(plates)
    assert record.painted_area == pytest.approx(sum(plate.painted_area for plate in record.plates))
    least, most = (section_properties(s).painted_area for s in (thick, thin))
    assert 9000.0 * least < record.painted_area < 9000.0 * most
