# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solids written as B-rep text: closed forms, orientation, sharing, and use by other operations."""

import FreeCAD
import numpy as np
import Part
import pytest
from scipy.interpolate import make_interp_spline

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.shapes import brep

PLATE = np.array([(-120.0, 4.0), (120.0, 4.0), (120.0, -4.0), (-120.0, -4.0)])
TRIANGLE = np.array([(0.0, 0.0), (50.0, 0.0), (10.0, 30.0)])
HEXAGON = np.array([(np.cos(a), np.sin(a)) for a in np.arange(6) * np.pi / 3]) * 80
CONCAVE = np.array([(0, 0), (60, 0), (60, 10), (10, 10), (10, 60), (0, 60)], float)
RINGS = {"triangle": TRIANGLE, "plate": PLATE, "angle": CONCAVE}


def area(ring):
    y, z = ring.T
    return 0.5 * abs(np.sum(y * np.roll(z, -1) - z * np.roll(y, -1)))


def straight(first, last, start=0.0, end=1.0):
    """A piece with straight rails between two rings (m, 3)."""
    ratios = np.array([0, 1 / 3, 2 / 3, 1])[None, :, None]
    poles = first[:, None] * (1 - ratios) + last[:, None] * ratios
    return np.repeat([start, end], 4), poles


def section(ring, x, scale=1.0):
    return np.column_stack([np.full(len(ring), x), ring * scale])


def sweep(rail_points, rail_tangents, s):
    """Clamped cubic rails through rail_points(s) -> (m, 3)."""
    ends = [[(1, rail_tangents(x))] for x in (s[0], s[-1])]
    spline = make_interp_spline(s, np.array([rail_points(x) for x in s]), 3, bc_type=tuple(ends))
    return spline.t, spline.c.swapaxes(0, 1)


def twisted(ring, length=3618.0, turn=np.pi / 4, stations=25):
    """The ring turning about the straight x axis."""
    rate = turn / length

    def points(s):
        c, d = np.cos(rate * s), np.sin(rate * s)
        return section(ring @ np.array([(c, d), (-d, c)]), s)

    def tangents(s):
        rest = points(s)
        return np.column_stack([np.ones(len(ring)), -rate * rest[:, 2], rate * rest[:, 1]])

    return sweep(points, tangents, np.linspace(0, length, stations))


def bent(ring, radius=5000.0, angle=0.7, stations=25):
    """The ring swept round the z axis, its first coordinate outwards."""

    def points(a):
        r = radius + ring[:, 0]
        return np.column_stack([r * np.cos(a), r * np.sin(a), ring[:, 1]])

    def tangents(a):
        r = radius + ring[:, 0]
        return np.column_stack([-r * np.sin(a), r * np.cos(a), 0 * r])

    return sweep(points, tangents, np.linspace(0, angle, stations))


def folded(ring):
    """Straight, then tapering to 0.7 and turning aside, then straight again: two folds."""
    marks = (0.0, 900.0, 1400.0, 2500.0)
    rings = [section(ring, x, scale) for x, scale in zip(marks, (1, 1, 0.7, 0.7), strict=True)]
    rings[2] += (0, 30, 12)
    rings[3] += (0, 30, 12)
    return [straight(rings[k], rings[k + 1], marks[k], marks[k + 1]) for k in range(3)]


def folded_volume(ring):
    taper = (1 + 4 * 0.85**2 + 0.7**2) / 6
    return area(ring) * (900 + 500 * taper + 1100 * 0.7**2)


def reverse(pieces):
    """The same rails named the other way round."""
    return [(knots, poles[::-1]) for knots, poles in pieces]


def assert_sound(solid, pieces, volume, relative):
    rails, spans = len(pieces[0][1]), len(pieces)
    assert solid.ShapeType == "Solid" and solid.isClosed() and solid.isValid()
    assert len(solid.Faces) == rails * spans + 2
    assert len(solid.Edges) == rails * (2 * spans + 1)
    assert len(solid.Vertexes) == rails * (spans + 1)
    assert all(len(solid.ancestorsOfType(edge, Part.Face)) == 2 for edge in solid.Edges)
    assert solid.Volume == pytest.approx(volume, rel=relative)
    assert max(shape.Tolerance for shape in (*solid.Vertexes, *solid.Edges, *solid.Faces)) < 1.1e-7


def assert_outward(solid):
    for face in solid.Faces:
        u0, u1, v0, v1 = face.ParameterRange
        for u, v in ((0.5, 0.5), (0.07, 0.6), (0.6, 0.07), (0.3, 0.3), (0.8, 0.45)):
            u, v = u0 + u * (u1 - u0), v0 + v * (v1 - v0)
            point, normal = face.valueAt(u, v), face.normalAt(u, v)
            if face.isPartOfDomain(u, v):
                break
        assert face.isPartOfDomain(u, v)
        assert solid.isInside(point - normal * 0.5, 1e-6, False)
        assert not solid.isInside(point + normal * 0.5, 1e-6, False)


CASES = [
    (shape, name, sense)
    for shape in ("prism", "twisted", "bent", "folded")
    for name in RINGS
    for sense in ("given", "reversed")
]


def case(shape, name):
    ring = RINGS[name]
    if shape == "prism":
        first, last = section(ring, 0), section(ring, 3000)
        return [straight(first, last, 0, 3000)], area(ring) * 3000, 1e-12
    if shape == "twisted":
        return [twisted(ring)], area(ring) * 3618, 1e-6
    if shape == "bent":
        y, z = ring.T
        w = y * np.roll(z, -1) - z * np.roll(y, -1)
        centroid = np.sum((y + np.roll(y, -1)) * w) / (3 * np.sum(w))
        return [bent(ring)], area(ring) * 0.7 * (5000 + centroid), 1e-6
    return folded(ring), folded_volume(ring), 1e-9


@pytest.mark.parametrize(("shape", "name", "sense"), CASES)
def test_solid_is_sound_outward_and_has_the_closed_form_volume(shape, name, sense):
    pieces, volume, relative = case(shape, name)
    if sense == "reversed":
        pieces = reverse(pieces)
    solid = brep.tube_solid(pieces)
    assert_sound(solid, pieces, volume, relative)
    assert_outward(solid)
    if sense == "given":
        solid.check(True)  # the Boolean operations' own check: raises


def test_far_from_the_origin_and_askew_the_ends_stay_plane():
    axes = np.linalg.qr(np.array([(1.0, 2, 3), (-2, 1, 0.5), (0.3, 0.7, -1)]))[0]
    knots, poles = twisted(PLATE)
    pieces = [(knots, poles @ axes.T + (3e5, -2e5, 8e4))]
    solid = brep.tube_solid(pieces)
    assert_sound(solid, pieces, area(PLATE) * 3618, 1e-6)
    assert all(type(face.Surface) is Part.Plane for face in solid.Faces[-2:])


def test_a_mirrored_tube_is_the_same_amount_of_steel():
    pieces = [twisted(PLATE)]
    mirrored = [(knots, poles * (1, -1, 1)) for knots, poles in pieces]
    solid = brep.tube_solid(mirrored)
    assert_sound(solid, mirrored, brep.tube_solid(pieces).Volume, 1e-12)
    assert_outward(solid)


def test_faces_come_piece_by_piece_then_the_caps_and_corners_are_exact():
    pieces = folded(HEXAGON)
    solid = brep.tube_solid(pieces)
    rings = [pieces[0][1][:, 0], *[poles[:, -1] for _, poles in pieces]]
    expected = [
        {tuple(rings[k + a][(j + b) % 6]) for a in (0, 1) for b in (0, 1)}
        for k in range(3)
        for j in range(6)
    ]
    expected += [set(map(tuple, rings[0])), set(map(tuple, rings[-1]))]
    assert [{tuple(vertex.Point) for vertex in face.Vertexes} for face in solid.Faces] == expected
    assert all(type(face.Surface) is Part.Plane for face in solid.Faces[-2:])


def test_rails_and_ruled_faces_are_the_given_splines():
    knots, poles = twisted(PLATE, stations=9)
    solid = brep.tube_solid([(knots, poles)])
    for j in range(4):
        surface = solid.Faces[j].Surface
        assert (surface.UDegree, surface.VDegree) == (3, 1)
        given = np.stack([poles[j], poles[(j + 1) % 4]], axis=1)
        assert np.array_equal(
            np.array([[tuple(p) for p in row] for row in surface.getPoles()]), given
        )
        assert np.array_equal(np.repeat(surface.getUKnots(), surface.getUMultiplicities()), knots)


def test_a_twisted_end_is_capped_by_a_ruled_face():
    first, last = section(PLATE, 0), section(PLATE, 800)
    last[0] += (3, 0, 7)
    # Trilinear body: two Gauss points each way integrate its Jacobian exactly.
    volume = 0
    gauss = 0.5 + np.array([-1, 1]) / np.sqrt(12)
    for x, u, v in np.stack(np.meshgrid(gauss, gauss, gauss), -1).reshape(-1, 3):
        rows = (1 - x) * first + x * last
        along = np.array([(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v]) @ (last - first)
        across = np.array([(v - 1, 1 - v, v, -v), (u - 1, -u, u, 1 - u)]) @ rows
        volume += abs(np.linalg.det([along, *across])) / 8
    for pieces in ([straight(first, last)], [straight(last, first)]):
        for rails in (pieces, reverse(pieces)):
            solid = brep.tube_solid(rails)
            assert_sound(solid, rails, volume, 1e-9)
            assert_outward(solid)
            solid.check(True)
            kinds = [type(face.Surface) for face in solid.Faces[-2:]]
            assert {*kinds} == {Part.Plane, Part.BSplineSurface}


def test_many_solids_from_one_text_equal_single_ones():
    tubes = [[twisted(PLATE)], folded(HEXAGON), [bent(TRIANGLE)], reverse(folded(PLATE))]
    solids = brep.tube_solids(tubes)
    for solid, pieces in zip(solids, tubes, strict=True):
        single = brep.tube_solid(pieces)
        assert solid.isValid() and solid.ShapeType == "Solid"
        assert len(solid.Faces) == len(single.Faces)
        assert solid.Volume == pytest.approx(single.Volume, rel=1e-14)
        assert solid.CenterOfMass.isEqual(single.CenterOfMass, 1e-9)
    together = brep.compound(solids)
    assert together.ShapeType == "Compound" and len(together.Solids) == 4
    assert brep.tube_solids([]) == []


def test_same_input_gives_the_same_text_and_the_text_its_solid():
    pieces = folded(PLATE)
    text = brep.tube_text(pieces)
    assert text == brep.tube_text([(k.copy(), p.copy()) for k, p in pieces])
    shape = Part.Shape()
    shape.importBrepFromString(text)
    assert shape.isValid() and shape.Volume == pytest.approx(folded_volume(PLATE), rel=1e-9)


def test_empty_is_a_compound_of_nothing():
    shape = brep.empty()
    assert shape.ShapeType == "Compound" and not shape.isNull() and shape.SubShapes == []


def test_step_round_trip_keeps_validity_and_volume(tmp_path):
    solid = brep.tube_solid([twisted(PLATE)])
    path = tmp_path / "plate.step"
    solid.exportStep(str(path))
    back = Part.Shape()
    back.read(str(path))
    assert back.isValid() and len(back.Solids) == 1 and len(back.Faces) == 6
    assert back.Volume == pytest.approx(solid.Volume, rel=1e-9)


@pytest.mark.parametrize("pieces", [[twisted(PLATE)], [bent(PLATE)], folded(PLATE)])
def test_booleans_split_the_solid_without_loss(pieces):
    solid = brep.tube_solid(pieces)
    bore = Part.makeCylinder(30, 400, solid.CenterOfMass - FreeCAD.Vector(0, 0, 200))
    rest, core = solid.cut(bore), solid.common(bore)
    assert rest.isValid() and core.isValid() and core.Volume > 1000
    assert rest.Volume + core.Volume == pytest.approx(solid.Volume, rel=1e-6)


def test_a_bent_plate_contains_its_centre_line():
    solid = brep.tube_solid([bent(PLATE)])
    for angle in (0.01, 0.35, 0.69):
        centre = FreeCAD.Vector(5000 * np.cos(angle), 5000 * np.sin(angle), 0)
        assert solid.isInside(centre, 1e-6, False)
        assert not solid.isInside(centre + FreeCAD.Vector(0, 0, 4.01), 1e-6, False)
    assert solid.distToShape(Part.Vertex(5200, 0, 0))[0] == pytest.approx(80, abs=1e-6)


def test_degenerate_tubes_are_refused_with_a_finding():
    thin = PLATE * [(1, 1), (1, 0), (1, 0), (1, 1)]
    line = np.column_stack([np.arange(4.0), np.zeros(4)])
    apart = folded(PLATE)
    apart[1] = (apart[1][0], apart[1][1] + 0.01)
    bump = section(HEXAGON, 500)
    bump[0, 0] += 5
    refused = {
        "solid-rails-meet": [straight(section(PLATE, 0), section(thin, 100))],
        "solid-without-volume": [straight(section(PLATE, 0), section(PLATE, 0))],
        "solid-end-without-area": [straight(section(PLATE, 0), section(line, 100))],
        "solid-pieces-apart": apart,
        "solid-end-not-plane": [straight(section(HEXAGON, 0), bump)],
    }
    for code, pieces in refused.items():
        with pytest.raises(BendTorsionError) as raised:
            brep.tube_solids([[twisted(PLATE)], pieces])
        assert [(f.code, f.object) for f in raised.value.findings] == [(code, "tube 2")]


def test_malformed_arrays_are_refused():
    knots, poles = twisted(PLATE, stations=9)
    kinked = knots.copy()
    kinked[5:7] = kinked[4]
    for bad in (
        (knots[1:], poles),
        (knots, poles[:2]),
        (knots[::-1], poles),
        (kinked, poles),
        (knots, poles * np.nan),
        (np.linspace(0, 1, len(knots)), poles),
    ):
        with pytest.raises(ValueError, match="piece 1"):
            brep.tube_solid([bad])
