# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ends of members cut by planes and surfaces: plates, patterns, figures and solids against closed
forms, invariances and the kernel."""

import dataclasses

import numpy as np
import pytest
from curved_members import member, rotation, tapered
from cut_members import (
    RADIUS,
    S800,
    end_run,
    job,
    plates_of,
    records_of,
    ring,
    straight,
)

from BendTorsionWB.core import detailing
from BendTorsionWB.core.axes.frames import FrameInput
from BendTorsionWB.core.axes.frames_screw import running_on
from BendTorsionWB.core.detailing import detail
from BendTorsionWB.core.geometry.surface import Cylinder, Plane, Sphere
from BendTorsionWB.core.members.contour_measure import trimmed_figures
from BendTorsionWB.core.members.end_cut import EndCut
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.patterns.pattern import develop_plate
from BendTorsionWB.core.plates.plates import split_plates
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.solids import solid_skins
from BendTorsionWB.core.solids.mass import solid_figures


def at_plane(y, z):
    """x of the tilted end of `straight`."""
    return 6000.0 - 0.3 * y + 0.5 * z


def test_a_straight_box_ends_where_the_planes_are(tilted):
    for face, plate in plates_of(tilted).items():
        for level in ("outer", "mid", "inner"):
            w = np.linspace(0.0, 1.0, 21)
            s = plate.cuts[1].at(level, w)
            value = getattr(plate.rails, level)(s)
            points = value[:, :3] + w[:, None] * (value[:, 3:] - value[:, :3])
            assert points[:, 0] == pytest.approx(at_plane(*points[:, 1:].T), abs=1e-8), face
            # On a straight axis s is x.
            assert s == pytest.approx(points[:, 0], abs=1e-8)


def test_patterns_of_a_straight_box_are_the_quadrilaterals_they_must_be(tilted):
    # Mid-surface of the top: z = 390, y from 280 - 2 to -280 + 3.
    top = records_of(tilted)["top"]
    y = np.array([278.0, -277.0])
    ends = [-0.4 * 390.0 * np.ones(2), at_plane(y, 390.0)]
    lengths = ends[1] - ends[0]
    width = float(np.ptp(y))
    assert top.area == pytest.approx(width * lengths.mean(), rel=1e-12)
    corners = np.array([line.flat for line in (top.lines[0], top.lines[-1])])
    assert np.linalg.norm(corners[1] - corners[0], axis=1) == pytest.approx(lengths, abs=1e-9)
    assert top.lines[-1].length_3d == pytest.approx(np.hypot(width, np.ptp(ends[1])), abs=1e-9)
    diagonal = [m for m in top.panels if m.what == "diagonal 1"]
    assert len(diagonal) == len(top.lines) - 1
    assert top.length_error_max < 1e-8
    # u along the chord between the middles of the end lines.
    middles = corners.mean(axis=1)
    assert middles[0, 1] == pytest.approx(middles[1, 1], abs=1e-9)


def test_points_of_cut_lines_are_the_corners_each_with_its_own_s(tilted):
    for face, plate in records_of(tilted).items():
        last = [p for p in plate.points if p.line == "E-2" and p.kind == "arris"]
        for point in last:
            assert point.xyz[0] == pytest.approx(at_plane(*point.xyz[1:]), abs=1e-8), face
            assert point.s == pytest.approx(point.xyz[0], abs=1e-8)
        witness = [p for p in plate.points if p.line == "E-2" and p.kind == "witness"]
        for point in witness:
            assert point.xyz[0] == pytest.approx(at_plane(*point.xyz[1:]), abs=1e-8), face
    left = plates_of(tilted)["left"]
    stations = [line.s for line in left.lines[1:-1]]
    assert stations and min(stations) > left.cuts[0].range[1]
    assert max(stations) < left.cuts[1].range[0]


def test_volume_and_centre_of_a_straight_box_are_those_of_the_prism(tilted):
    def prism(y, z, a=0.4, b=(0.3, 0.5)):
        """Volume and moment about x = 0 of a bar y0 … y1, z0 … z1 between the planes."""
        volume = moment = 0.0
        nodes, weights = np.polynomial.legendre.leggauss(4)
        for i, wy in zip(nodes, weights, strict=True):
            for j, wz in zip(nodes, weights, strict=True):
                yy, zz = np.mean(y) + i * np.ptp(y) / 2, np.mean(z) + j * np.ptp(z) / 2
                part = wy * wz * np.ptp(y) * np.ptp(z) / 4
                low, high = -a * zz, 6000.0 - b[0] * yy + b[1] * zz
                volume += part * (high - low)
                moment += part * (high**2 - low**2) / 2
        return volume, moment / volume

    for face, y, z in (
        ("top", (278.0, -277.0), (400.0, 380.0)),
        ("bottom", (278.0, -277.0), (-400.0, -380.0)),
        ("left", (300.0, 280.0), (400.0, -400.0)),
        ("right", (-300.0, -280.0), (400.0, -400.0)),
    ):
        volume, centre = prism(y, z)
        plate = records_of(tilted)[face]
        assert plate.volume == pytest.approx(volume, rel=1e-12)
        assert plate.mass == pytest.approx(7.85e-6 * volume, rel=1e-12)
        assert plate.centre_of_gravity[0] == pytest.approx(centre, abs=1e-7)


def test_painted_area_of_a_straight_box_is_its_skin_between_the_planes(tilted):
    lengths = {
        face: 6000.0 - 0.3 * y + 0.5 * z + 0.4 * z
        for face, (y, z) in {
            "top": (0.0, 400.0),
            "bottom": (0.0, -400.0),
            "left": (300.0, 0.0),
            "right": (-300.0, 0.0),
        }.items()
    }
    expected = sum(lengths[f] * (600.0 if f in ("top", "bottom") else 800.0) for f in lengths)
    assert detailing.painted_area(tilted.geometry) == pytest.approx(expected, rel=1e-9)


def test_a_plane_cut_of_a_right_cylinder_develops_to_a_sine(sine):
    """The plane through the axis end, n = (0, 1, 0.45): on the cylinder of radius r the cut is
    r sin φ − R sin φ_end + 0.45 z = 0, so in the pattern x = r φ is an arcsine of v."""
    end = sine.axis.position(np.array([sine.axis.length]))[0]
    for face, depth in (("top", 300.0 + 100.0 - 10.0), ("bottom", -390.0)):
        plate = records_of(sine)[face]
        radius = RADIUS + depth
        run = end_run(plate)
        corners = np.array([plate.lines[0].flat[0], plate.lines[0].flat[1]])
        start = corners.mean(axis=0)
        across = (corners[1] - corners[0]) / np.linalg.norm(corners[1] - corners[0])
        along = np.array([across[1], -across[0]])
        along *= np.sign((run.mean(axis=0) - start) @ along)
        x, v = (run - start) @ along, (run - start) @ across
        # The start line runs along z; whichever way, the sine is told by z = ± v.
        z = -v if abs(_sine(radius, end, v) - x).max() > 1.0 else v
        middle = 0.5 * (plates_of(sine)[face].rails.mid(np.zeros(1))[0, [2, 5]].sum())
        assert x == pytest.approx(_sine(radius, end, z + middle), abs=5e-4), face


def _sine(radius, end, z):
    return radius * np.arcsin((end[1] - 0.45 * z) / radius)


def test_the_pattern_of_a_cut_cylinder_is_exact(sine):
    for face in ("top", "bottom"):
        plate = records_of(sine)[face]
        assert plate.length_error_max < 1e-6
        assert plate.lines[-1].length_flat == pytest.approx(plate.lines[-1].length_3d, abs=1e-7)


def test_area_by_green_over_the_contour_is_the_area(sine, tilted):
    for detailed in (sine, tilted):
        for plate in detailed.record.plates:
            points = np.concatenate([run[:-1] for run in plate.outline])
            x, y = points.T
            green = 0.5 * abs((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())
            # The outline's chords are 0.0005 mm within the curve.
            assert plate.area == pytest.approx(
                green,
                abs=0.001
                * sum(np.linalg.norm(np.diff(run, axis=0), axis=1).sum() for run in plate.outline),
            )


def test_every_point_of_the_curves_lies_in_the_plane_and_on_the_plate(twisted, twisted_plates):
    for plate in twisted_plates:
        for k, cut in enumerate(plate.cuts):
            if cut is None:
                continue
            end = twisted.ends[k].surface
            for level in ("outer", "mid", "inner"):
                w = np.linspace(0.0, 1.0, 41)
                value = getattr(plate.rails, level)(cut.at(level, w))
                points = value[:, :3] + w[:, None] * (value[:, 3:] - value[:, :3])
                off = (points - np.array(end.point)) @ np.array(end.normal)
                assert np.abs(off).max() < 1e-7
            assert plate.start <= cut.range[k] <= plate.end


def test_figures_of_a_cut_that_is_square_are_those_of_the_solid(twisted):
    whole = tapered(cut=9000.0)
    plates = split_plates(whole, {})[0]
    skins = solid_skins.plate_skins(plates)
    for plate, own in zip(plates, solid_figures(skins), strict=True):
        figures = trimmed_figures(plate.rails, (None, None))
        assert figures.volume == pytest.approx(plate.volume, rel=1e-11)
        assert np.abs(figures.centre - own.centre).max() < 1e-3
        assert figures.face_areas == pytest.approx(own.face_areas, rel=1e-6)
        assert figures.end_areas == pytest.approx(own.end_areas, rel=1e-9)


def test_a_plane_divides_a_member_without_loss(twisted, twisted_plates):
    """The two sides of one plane make up the whole: the cut one, and the rest that the other side
    of the same plane leaves."""
    for plate in twisted_plates:
        for k, cut in enumerate(plate.cuts):
            if cut is None:
                continue
            other = dataclasses.replace(cut, surface=_Turned(cut.surface))
            near = [None, None]
            near[1 - k] = other
            far = [None, None]
            far[k] = cut
            parts = [trimmed_figures(plate.uncut, tuple(ends)) for ends in (near, far)]
            whole = trimmed_figures(plate.uncut, (None, None))
            assert sum(p.volume for p in parts) == pytest.approx(whole.volume, rel=1e-11)
            moment = sum(p.volume * p.centre for p in parts) / whole.volume
            assert np.abs(moment - whole.centre).max() < 1e-6
            areas = sum(p.face_areas for p in parts)
            assert areas == pytest.approx(whole.face_areas, rel=1e-9)


class _Turned:
    def __init__(self, surface):
        self.surface = surface

    def value_and_gradient(self, points):
        value, gradient = self.surface.value_and_gradient(points)
        return -value, -gradient


@pytest.mark.parametrize("mode", ["edges", "energy", "elastic"])
def test_patterns_keep_what_the_mode_keeps_up_to_the_cut(twisted_plates, mode):
    for plate in twisted_plates:
        record = develop_plate(plate, mode=mode)
        lines = [line.label for line in record.lines]
        assert lines[0] == "E-1" and lines[-1] == "E-2"
        if mode == "edges":
            for what in ("edge", "line"):
                edges = [p for p in record.panels if p.what.startswith(what)]
                assert all(abs(p.flat - p.arc) < 1e-7 for p in edges)
            assert record.length_error_max < max(6.0 * record.length_error_bound, 1e-6)
        for line in record.lines:
            assert abs(line.length_flat - line.length_3d) < 0.01
        area = sum(
            0.5 * (run[:-1, 0] * run[1:, 1] - run[1:, 0] * run[:-1, 1]).sum()
            for run in record.outline
        )
        assert record.area == pytest.approx(area, rel=1e-6)


def test_a_cut_patterns_panels_away_from_the_cut_are_those_of_the_square_plate(twisted_plates):
    square = {p.mark: p for p in split_plates(tapered(cut=9000.0), {})[0]}
    for plate in twisted_plates:
        cut = {(p.panel, p.what): p for p in develop_plate(plate).panels}
        whole = {(p.panel, p.what): p for p in develop_plate(square[plate.mark]).panels}
        common = [key for key in cut if key in whole and "E-" not in key[0]]
        assert len(common) > 20
        for key in common:
            assert cut[key].flat == pytest.approx(whole[key].flat, abs=2e-6)
            assert cut[key].arc == pytest.approx(whole[key].arc, abs=2e-6)
            assert cut[key].chord_outer == pytest.approx(whole[key].chord_outer, abs=1e-8)


def test_seams_of_cut_plates_end_together(twisted_plates):
    """The corner of the outer skin is cut once: webs at full height and the flange between them
    end in one plane, on each corner line at one place."""
    by = {p.mark: p for p in twisted_plates}
    left = by["M1-L1"].rails.outer(by["M1-L1"].cuts[0].corners("outer"))
    plane = by["M1-L1"].cuts[0].surface
    for corner, edge in ((left[0, :3], 0), (left[1, 3:], 1)):
        assert abs(plane.value_and_gradient(corner[None])[0][0]) < 1e-8, edge


def test_beyond_its_ends_the_axis_runs_on_as_a_screw():
    base = member([Segment(S800)])
    frames, length = base.frames, base.length
    at = frames.at(np.array([-300.0, 0.0, length, length + 300.0]))
    for low, high in ((0, 1), (2, 3)):
        assert at.ky[low] == pytest.approx(at.ky[high], rel=1e-9)
        assert at.twist[low] == pytest.approx(at.twist[high], rel=1e-9)
    for one, two in ((at.x, at.y), (at.y, at.z), (at.z, at.x)):
        assert np.abs((one * two).sum(axis=1)).max() < 1e-12
    assert np.linalg.norm(at.x, axis=1) == pytest.approx(np.ones(4), abs=1e-12)
    # Rates by differences across the end are those inside.
    step = 1e-2
    beyond = frames.at(length + step * np.array([0.0, 1.0, 2.0]))
    rate = (beyond.origin[2] - beyond.origin[0]) / (2 * step)
    assert rate == pytest.approx(beyond.x[1], abs=1e-9)
    bend = (beyond.x[2] - beyond.x[0]) / (2 * step)
    assert bend == pytest.approx(beyond.ky[1] * beyond.y[1] + beyond.kz[1] * beyond.z[1], abs=1e-9)


def test_a_circle_runs_on_as_the_circle_and_there_and_back_is_nothing():
    built = ring()
    frames, length = built.geometry.member.frames, built.axis.length
    at = frames.at(length + np.array([0.0, 200.0, 900.0]))
    turn = at.s / RADIUS
    circle = RADIUS * np.column_stack([np.cos(turn), np.sin(turn), 0 * turn])
    assert np.abs(at.origin - circle).max() < 0.01
    back = running_on(running_on(at, np.full(3, 700.0)), np.full(3, -700.0))
    for name in ("origin", "x", "y", "z"):
        assert np.abs(getattr(back, name) - getattr(at, name)).max() < 1e-10


def test_the_cut_moves_with_the_member_under_a_rigid_motion():
    turn, shift = rotation(), np.array([5000.0, -7000.0, 3000.0])
    points = np.array([(0, 0, 0), (2000, 300, 0), (4000, 900, 500), (6000, 1500, 1500.0)])
    normal = np.array([1.0, 0.3, 0.6])
    results = []
    for moved in (False, True):
        own = points @ turn.T + shift if moved else points
        up = turn @ [0.0, 0.0, 1.0] if moved else np.array([0.0, 0.0, 1.0])
        cut = EndCut("plane", normal=tuple(turn @ normal if moved else normal))
        frame = FrameInput("fixed", direction=tuple(up))
        given = job(own, Plane(), end=cut, frame=frame)
        axis = dataclasses.replace(given.axis, fit="keep")
        results.append(detail(dataclasses.replace(given, axis=axis)))
    one, two = results
    for a, b in zip(one.record.plates, two.record.plates, strict=True):
        assert a.area == pytest.approx(b.area, rel=1e-9)
        assert a.volume == pytest.approx(b.volume, rel=1e-9)
        assert turn @ a.centre_of_gravity + shift == pytest.approx(b.centre_of_gravity, abs=1e-5)
        for p, q in zip(a.points, b.points, strict=True):
            assert turn @ p.xyz + shift == pytest.approx(q.xyz, abs=1e-5)


def test_a_member_run_through_backwards_is_cut_alike():
    points = np.array([(0, 0, 0), (2000, 300, 0), (4000, 900, 500), (6000, 1500, 1500.0)])
    cut = EndCut("plane", normal=(1.0, 0.3, 0.6))
    made = []
    for order, ends in ((1, {"end": cut}), (-1, {"start": cut})):
        section = box("S", "box1", 800, 600, 20, gap1=2, gap2=2)
        given = job(points[::order], Plane(), frame=FrameInput("fixed"), section=section, **ends)
        axis = dataclasses.replace(given.axis, fit="keep")
        made.append(detail(dataclasses.replace(given, axis=axis)))
    forth, back = (records_of(detailed) for detailed in made)
    for face, other in (("top", "top"), ("bottom", "bottom"), ("left", "right"), ("right", "left")):
        assert forth[face].area == pytest.approx(back[other].area, rel=1e-9)
        assert forth[face].volume == pytest.approx(back[other].volume, rel=1e-9)
        centres = forth[face].centre_of_gravity, back[other].centre_of_gravity
        assert centres[0] == pytest.approx(centres[1], abs=1e-5)


def test_plumb_and_level_are_what_they_say():
    up = [(0, 0, 0), (3000, 0, 2000), (6000, 0, 4000)]
    for kind, normal in (("plumb", (1.0, 0.0, 0.0)), ("level", (0.0, 0.0, 1.0))):
        given = job(up, Plane(), end=EndCut(kind), frame=FrameInput("fixed"))
        given = dataclasses.replace(given, axis=dataclasses.replace(given.axis, fit="keep"))
        for plate in detail(given).record.plates:
            ends = [p.xyz for p in plate.points if p.line == "E-2"]
            off = (np.array(ends) - np.array(up[-1])) @ np.array(normal)
            assert np.abs(off).max() < 1e-8


def test_an_offset_moves_the_cut_outwards_along_the_tangent():
    for kind, offset in (("square", 40.0), ("plumb", -25.0)):
        plates = straight(end=EndCut(kind, offset=offset)).record.plates
        for plate in plates:
            ends = [p.xyz[0] for p in plate.points if p.line == "E-2"]
            assert ends == pytest.approx([6000.0 + offset] * len(ends), abs=1e-8)


def test_a_member_is_cut_at_a_cylinder_and_at_a_sphere():
    pole = Cylinder(900.0, (6800.0, 100.0, 0.0))
    ball = Sphere(2000.0, (-1900.0, 0.0, 200.0))
    built = straight(start=EndCut("surface", surface=ball), end=EndCut("surface", surface=pole))
    for plate in built.record.plates:
        for line, surface in (("E-1", ball), ("E-2", pole)):
            ends = np.array([p.xyz for p in plate.points if p.line == line])
            assert np.abs(surface.closest(ends).distance).max() < 1e-8
    top = records_of(built)["top"]
    # Seen from above the flange ends along a circle, which flat stays one.
    run = end_run(top)
    chord = np.linalg.norm(run[-1] - run[0])
    assert top.lines[-1].length_flat == pytest.approx(
        900.0 * 2.0 * np.arcsin(chord / 1800.0), abs=1e-6
    )
