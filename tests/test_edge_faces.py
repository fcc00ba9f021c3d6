# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edges of both thickness faces in the pattern: bevels, dihedrals and outlines of known shapes."""

from dataclasses import replace

import curved_members
import numpy as np
import pytest
import ruled_patches

from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.joints.lanes import Lanes
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.patterns.gross import polygon_area
from BendTorsionWB.core.patterns.laid_flat import PatternInput, laid_flat
from BendTorsionWB.core.plates.edge_faces import face_outline
from BendTorsionWB.core.plates.plates import split_plates
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.sections.section_types import i_section, polygon

DEGREE = np.pi / 180.0
PLANE = analytic_surface("plane", {})


def ring(count, radius=400.0):
    angle = 2.0 * np.pi * np.arange(count) / count
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def straight(section):
    """A member along a straight line on a plane, 6 m."""
    line = curved_members.member(
        [Segment(section)], lambda t: np.outer(t, [6000.0, 0.0, 0.0]), PLANE
    )
    return line, split_plates(line, {})[0]


@pytest.mark.parametrize("count", [3, 5, 6, 8])
def test_mitres_of_a_polygonal_box_halve_its_dihedral(count):
    member, plates = straight(polygon("P", ring(count), 20.0))
    interior = np.pi * (1.0 - 2.0 / count)
    for plate in laid_flat(member, plates):
        for edge in plate.edges:
            np.testing.assert_allclose(edge.dihedral, interior, atol=1e-9)
            np.testing.assert_allclose(edge.bevel, np.pi / 2 - interior / 2, atol=1e-9)
            np.testing.assert_allclose(edge.offset_outer, 10.0 / np.tan(interior / 2), atol=1e-6)
            np.testing.assert_allclose(edge.offset_inner, -edge.offset_outer, atol=1e-6)
            assert edge.widest(0) == "outer"


def test_box_edges_are_square_and_meet_at_right_angles():
    member, plates = straight(box("B", "box1", 800, 600, 20))
    for plate in laid_flat(member, plates):
        for edge in plate.edges:
            np.testing.assert_allclose(edge.dihedral, 90 * DEGREE, atol=1e-9)
            np.testing.assert_allclose(edge.bevel, 0.0, atol=1e-9)
            assert edge.widest(0) == "both"
    top, left = (next(p for p in laid_flat(member, plates) if p.face == f) for f in ("top", "left"))
    assert [edge.neighbour for edge in top.edges] == ["left", "right"]
    assert [edge.neighbour for edge in left.edges] == ["top", "bottom"]


def test_an_i_section_has_free_edges_and_a_web_square_to_its_flanges():
    member, plates = straight(i_section("I", 600, 300, 20, t_web=12))
    made = {plate.face: plate for plate in laid_flat(member, plates)}
    for face in ("top", "bottom"):
        for edge in made[face].edges:
            assert edge.neighbour == "" and np.isnan(edge.dihedral).all()
    for edge in made["web"].edges:
        assert edge.neighbour in ("top", "bottom")
        np.testing.assert_allclose(edge.dihedral, 90 * DEGREE, atol=1e-9)


def test_a_taper_opens_the_corner_by_the_two_slopes():
    # Both faces of a corner lean by 100 in 250: cos = -(-0.4)² / (1 + 0.4²).
    section = [box(f"B{b}", "box1", b, b, 20) for b in (800, 600)]
    member = curved_members.member(
        [Segment(section[0]), Segment(section[1], 3000.0, 2.5)],
        lambda t: np.outer(t, [6000.0, 0.0, 0.0]),
        PLANE,
    )
    plates = split_plates(member, {}, spacing=100.0)[0]
    wanted = np.arccos(-(0.4**2) / (1.0 + 0.4**2))
    for plate in laid_flat(member, plates):
        for edge in plate.edges:
            inside = (edge.s > 3020.0) & (edge.s < 3230.0)
            assert inside.sum() >= 2
            # Edges keep clear of their neighbours' mitres: a hair off their own line.
            np.testing.assert_allclose(edge.dihedral[inside], wanted, atol=2e-5)
    top = next(p for p in laid_flat(member, plates) if p.face == "top")
    # The plate between is cut along the inner face of the web beside it.
    inside = (top.edges[0].s > 3020.0) & (top.edges[0].s < 3230.0)
    np.testing.assert_allclose(top.edges[0].bevel[inside], np.pi / 2 - wanted, atol=2e-4)


def test_outlines_of_both_faces_of_a_mitred_plate():
    member, plates = straight(polygon("P", ring(6), 20.0))
    plate = laid_flat(member, plates)[0]
    side = 400.0  # of a hexagon, on its outer face
    for face, width in (("outer", side), ("inner", side - 40.0 / np.sqrt(3.0))):
        outline = face_outline(plate, face)
        assert all(
            np.allclose(a[-1], b[0], atol=1e-9)
            for a, b in zip(outline, (*outline[1:], outline[0]), strict=True)
        )
        points = np.concatenate(outline)
        np.testing.assert_allclose(np.ptp(points, axis=0), [6000.0, width], atol=1e-5)
        assert polygon_area(points) == pytest.approx(6000.0 * width, rel=1e-8)


def rolled(radius, thickness, slant):
    """A plate rolled to a radius about y, its edges slanted by `slant` mm between its faces."""

    def rails(level):
        off = (0.5 - level) * thickness
        half = 400.0 + 0.5 * (1.0 - 2.0 * level) * slant

        def function(s):
            angle = s / radius
            x, z = (radius + off) * np.sin(angle), (radius + off) * np.cos(angle)
            return np.column_stack([x, 0 * s - half, z, x, 0 * s + half, z])

        return ruled_patches.rails(function, 6000.0)

    return {name: rails(level) for name, level in (("outer", 0.0), ("mid", 0.5), ("inner", 1.0))}


@pytest.mark.parametrize("radius", [2000.0, 12000.0])
def test_a_rolled_plate_keeps_the_slant_of_its_edges(radius):
    member, plates = straight(box("B", "box1", 800, 600, 40))
    plate = next(p for p in plates if p.face == "top")
    own = rolled(radius, 40.0, 30.0)
    # Seen from outside P' × R points along -z, into the section, as the top's does.
    plate = replace(plate, rails=replace(plate.rails, **own))
    others = [p for p in plates if p.face != "top"]
    top = laid_flat(member, [plate, *others])[0]
    for edge in top.edges:
        np.testing.assert_allclose(edge.offset_outer, 15.0, atol=1e-6)
        np.testing.assert_allclose(edge.offset_inner, -15.0, atol=1e-6)
        np.testing.assert_allclose(edge.bevel, np.arctan(30.0 / 40.0), atol=1e-7)
    for face, width in (("outer", 830.0), ("inner", 770.0)):
        points = np.concatenate(face_outline(top, face))
        np.testing.assert_allclose(np.ptp(points, axis=0), [6000.0, width], atol=1e-3)


def test_offsets_are_those_of_feet_found_by_brute_force():
    member = curved_members.tapered("box2")
    plates, _ = split_plates(member, {}, lanes={"top": Lanes((0.4,))})
    made = laid_flat(member, plates)
    for plate, record in list(zip(plates, made, strict=True))[::2]:
        rails = plate.rails
        for number in (0, 1):
            edge = record.edges[number]
            for k in range(1, len(edge.lines) - 1, 5):
                if edge.lines[k].startswith("F"):
                    continue
                s = edge.s[k]
                point = rails.outer(np.array([s]))[0].reshape(2, 3)[number]
                place, width = foot(rails.mid, point, s, float(number))
                beside = rails.mid(np.array([place]))[0]
                rate = rails.mid.derivative(np.array([place]))[0].reshape(2, 3)[number]
                step = (width - number) * (beside[3:] - beside[:3])
                along = rate / np.linalg.norm(rate)
                out = np.linalg.norm(step - (step @ along) * along)
                out *= np.sign((width - number) * (1 if number else -1))
                assert edge.offset_outer[k] == pytest.approx(out, abs=1e-3)


def foot(mid, point, s, w):
    """The closest point of the extended mid-surface, by repeated least squares."""
    for _ in range(20):
        rails, rate = mid(np.array([s]))[0], mid.derivative(np.array([s]))[0]
        across = rails[3:] - rails[:3]
        along = rate[:3] + w * (rate[3:] - rate[:3])
        away = point - rails[:3] - w * across
        step = np.linalg.lstsq(np.column_stack([along, across]), away, rcond=None)[0]
        s, w = s + step[0], w + step[1]
    return s, w


@pytest.mark.parametrize("marking_face", ["inside", "outside"])
def test_flat_edges_lie_beside_the_outline_by_their_offsets(marking_face):
    member = curved_members.tapered("box1")
    plates, _ = split_plates(member, {})
    for plate in laid_flat(member, plates, PatternInput(marking_face=marking_face)):
        middle = np.mean([line.flat.mean(axis=0) for line in plate.lines], axis=0)
        for number, edge in enumerate(plate.edges):
            own = np.array([line.flat[number] for line in plate.lines])
            other = np.array([line.flat[1 - number] for line in plate.lines])
            outward = own - other
            outward /= np.linalg.norm(outward, axis=1, keepdims=True)
            for flat, offset in (
                (edge.flat_outer, edge.offset_outer),
                (edge.flat_inner, edge.offset_inner),
            ):
                away = np.linalg.norm(flat - own, axis=1)
                np.testing.assert_allclose(away, np.abs(offset), atol=1e-9)
                reach = ((flat - own) * outward).sum(axis=1)
                assert (np.sign(reach) == np.sign(offset))[np.abs(offset) > 1e-6].all()
        assert np.isfinite(middle).all()


def test_seams_between_lanes_lie_in_one_plane():
    member = curved_members.tapered()
    plates, _ = split_plates(member, {}, lanes={"left": Lanes((0.5,))})
    for plate in laid_flat(member, plates):
        for edge in plate.edges:
            if edge.edge.startswith("seam"):
                assert edge.neighbour == plate.face == "left"
                np.testing.assert_array_equal(edge.dihedral, np.pi)
