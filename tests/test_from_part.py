# SPDX-License-Identifier: LGPL-2.1-or-later
"""Part faces and edges become exact core surfaces and curves."""

import math
import pickle

import FreeCAD
import numpy as np
import Part
import pytest
from FreeCAD import Placement, Rotation, Vector

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.nurbs import NurbsPatch
from BendTorsionWB.core.geometry.patches import PatchSurface
from BendTorsionWB.core.geometry.surface import (
    Cone,
    Cylinder,
    Ellipsoid,
    Flipped,
    Plane,
    Sphere,
    Torus,
)
from BendTorsionWB.shapes.from_part import curve_from_part, patch_from_face, surface_from_part

HALF = math.atan(0.5)


def random_points(count, low, high, seed=4):
    return np.random.default_rng(seed).uniform(low, high, (count, 3))


def freeform():
    """A rational bicubic roof of 4 × 3 spans, about 30 × 20 m."""
    rng = np.random.default_rng(11)
    poles = [
        [Vector(5e3 * i, 4e3 * j, 4e3 + rng.uniform(-1.5e3, 1.5e3)) for j in range(6)]
        for i in range(7)
    ]
    weights = rng.uniform(0.7, 1.4, (7, 6)).tolist()
    surface = Part.BSplineSurface()
    surface.buildFromPolesMultsKnots(
        poles,
        [4, 1, 1, 1, 4],
        [4, 1, 1, 4],
        [0, 1, 2, 3, 4],
        [0, 1, 2, 3],
        False,
        False,
        3,
        3,
        weights,
    )
    return surface


def dome():
    """The upper half of a 40/30/20 m ellipsoid as one rational B-spline surface."""
    face = Part.makeSphere(1000, Vector(), Vector(0, 0, 1), 0, 90, 360)
    matrix = FreeCAD.Matrix()
    matrix.scale(40, 30, 20)
    shape = face.transformGeometry(matrix)
    return next(f for f in shape.Faces if f.BoundBox.ZLength > 1e3)


@pytest.mark.parametrize(
    ("shape", "expected", "low", "high"),
    [
        (Part.makeSphere(5e3), Sphere(5e3), [-8e3] * 3, [8e3] * 3),
        (Part.makeTorus(30e3, 8e3), Torus(30e3, 8e3), [-40e3, -40e3, -9e3], [40e3, 40e3, 9e3]),
        (Part.makeCylinder(5e3, 9e3).Faces[0], Cylinder(5e3), [-7e3, -7e3, 10], [7e3, 7e3, 8e3]),
        (
            Part.makeCone(5e3, 0, 10e3).Faces[0],
            Cone(5e3, -HALF),
            [-3e3, -3e3, 2e3],
            [3e3, 3e3, 6e3],
        ),
        (Part.makePlane(9e3, 7e3), Plane(), [0, 0, -5e3], [9e3, 7e3, 5e3]),
    ],
    ids=["sphere", "torus", "cylinder", "cone", "plane"],
)
def test_quadrics_agree_with_closed_forms_anywhere_in_space(shape, expected, low, high):
    given = random_points(3000, low, high)
    placement = Placement(Vector(12e3, -7e3, 3e3), Rotation(Vector(1, 2, 3), 40))
    turn = np.array(placement.Rotation.toMatrix().A).reshape(4, 4)[:3, :3]
    shift = np.array(placement.Base)
    moved = shape.copy()
    moved.Placement = placement
    truth = expected.closest(given)
    for surface, points in (
        (surface_from_part(shape), given),
        (surface_from_part(moved), given @ turn.T + shift),
    ):
        foot = surface.closest(points)
        use = ~foot.outside
        assert use.mean() > 0.8
        feet, normals = foot.points, foot.normals
        if surface.key != surface_from_part(shape).key:
            feet, normals = (feet - shift) @ turn, normals @ turn
        assert np.abs(foot.distance - truth.distance)[use].max() < 1e-9
        # Beside the centre line of the torus a foot is less certain than its distance.
        clear = use & (np.abs(truth.distance) < 7.5e3)
        assert np.abs(feet - truth.points)[clear].max() < 1e-9
        assert np.abs(normals - truth.normals)[clear].max() < 1e-12


def test_pole_points_and_seam_give_the_right_normals():
    surface = surface_from_part(Part.makeSphere(5e3))
    rng = np.random.default_rng(6)
    reach = 10.0 ** rng.uniform(-9, 3, (300, 1))
    near = np.linalg.norm(rng.normal(size=(300, 1)), axis=1)[:, None] * reach
    turn = rng.uniform(0, 2 * np.pi, 300)
    near = near * np.column_stack([np.cos(turn), np.sin(turn), 0 * turn])
    given = np.vstack(
        [
            [
                [0, 0, 6e3],
                [0, 0, -4e3],
                [0, 0, 5e3],
                [6e3, 0, 0],
                [5e3, 1e-12, 100],
                [5e3, -1e-12, 10],
            ],
            near + [0, 0, 5.5e3],
            near - [0, 0, 4.5e3],
        ]
    )
    foot, truth = surface.closest(given), Sphere(5e3).closest(given)
    assert np.abs(foot.distance - truth.distance).max() < 1e-9
    assert np.abs(np.hypot(*(foot.points - truth.points)[:6, :2].T)).max() < 1e-9
    # Within a hundredth of a millimetre of the pole point the turn around it is lost in rounding.
    clear = np.hypot(*truth.points[:, :2].T) > 0.01
    assert np.abs(foot.points - truth.points)[clear].max() < 1e-7
    assert np.abs(foot.points - truth.points).max() < 1e-3
    assert np.abs(foot.normals - truth.normals)[clear].max() < 1e-9
    assert np.abs(foot.normals - truth.normals).max() < 1e-6
    assert not foot.outside.any() and not foot.ambiguous.any()


def test_ambiguous_points_are_flagged():
    sphere = surface_from_part(Part.makeSphere(5e3)).closest([[0, 0, 0], [1, 0, 0]])
    assert sphere.ambiguous.tolist() == [True, False]
    assert np.isfinite(sphere.normals).all()
    assert abs(abs(sphere.distance[0]) - 5e3) < 1e-9
    # Between two parallel plates the middle plane has two feet.
    upper = Part.makePlane(900, 900, Vector(0, 0, 40))
    plates = Part.Compound([Part.makePlane(900, 900), upper])
    foot = surface_from_part(plates).closest([[300, 300, 20], [300, 300, 21]])
    assert foot.ambiguous.tolist() == [True, False]


def test_freeform_agrees_with_parts_own_projection():
    spline = freeform()
    surface = surface_from_part(spline.toShape())
    rng = np.random.default_rng(9)
    u, v = rng.uniform(0.2, 3.8, 60), rng.uniform(0.2, 2.8, 60)
    given = np.array(
        [
            spline.value(a, b) + spline.normal(a, b) * h
            for a, b, h in zip(u, v, rng.uniform(-600, 600, 60), strict=True)
        ]
    )
    foot = surface.closest(given)
    part = np.array([tuple(spline.value(*spline.parameter(Vector(*point)))) for point in given])
    assert np.abs(foot.points - part).max() < 1e-9
    assert (foot.normals[:, 2] > 0).all() and not foot.outside.any()
    normals = np.array([tuple(spline.normal(*spline.parameter(Vector(*point)))) for point in given])
    normals *= np.sign(normals[:, 2:])
    assert np.abs(foot.normals - normals).max() < 1e-12


def test_derivatives_against_part():
    spline = freeform()
    patch = patch_from_face(spline.toShape())
    rng = np.random.default_rng(1)
    u, v = rng.uniform(0, 4, 20), rng.uniform(0, 3, 20)
    u[:2], v[:2] = [0, 4], [3, 0]
    found = patch.evaluate(u, v)
    for k, (a, b) in enumerate(zip(u, v, strict=True)):
        truth = [
            spline.value(a, b),
            *(spline.getDN(a, b, *order) for order in ((1, 0), (0, 1), (2, 0), (1, 1), (0, 2))),
        ]
        for mine, part in zip(found, truth, strict=True):
            assert np.abs(mine[k] - part).max() < 1e-8


def split(face, rows, columns):
    """The face's B-spline cut into rows × columns patches."""
    patch = patch_from_face(face)
    (u0, u1), (v0, v1) = patch.domain
    us, vs = np.linspace(u0, u1, columns + 1), np.linspace(v0, v1, rows + 1)
    faces = []
    for i in range(columns):
        for j in range(rows):
            piece = face.toNurbs().Faces[0].Surface
            piece.segment(us[i], us[i + 1], vs[j], vs[j + 1])
            faces.append(patch_from_face(piece.toShape()))
    return faces


def swapped(patch):
    """The same patch with u and v exchanged."""
    weights = None if patch.weights is None else patch.weights.T
    return NurbsPatch(
        patch.degree_v,
        patch.degree_u,
        patch.knots_v,
        patch.knots_u,
        patch.poles.transpose(1, 0, 2),
        weights,
        patch.sense,
    )


def reversed_sense(patch):
    return NurbsPatch(
        patch.degree_u,
        patch.degree_v,
        patch.knots_u,
        patch.knots_v,
        patch.poles,
        patch.weights,
        -patch.sense,
    )


def test_48_patches_half_reversed_a_third_swapped_face_outwards():
    patches = split(dome(), 4, 12)
    assert len(patches) == 48
    patches = [reversed_sense(p) if k % 2 else p for k, p in enumerate(patches)]
    patches = [swapped(p) if k % 3 == 1 else p for k, p in enumerate(patches)]
    truth_surface = Ellipsoid(40e3, 30e3, 20e3)
    rng = np.random.default_rng(7)
    given = rng.normal(size=(4000, 3))
    given[:, 2] = np.abs(given[:, 2]) + 0.02
    given /= np.linalg.norm(given / [40e3, 30e3, 20e3], axis=1)[:, None]
    given *= rng.uniform(0.97, 1.05, (4000, 1))
    given[:50, 1] = 0  # along patch borders
    surface = PatchSurface(tuple(patches))
    foot, truth = surface.closest(given), truth_surface.closest(given)
    inside = truth.points[:, 2] > 1
    assert not foot.outside[inside].any() and not foot.ambiguous.any()
    assert np.abs(foot.points - truth.points)[inside].max() < 1e-9
    assert np.abs(foot.normals - truth.normals)[inside].max() < 1e-12
    # Whatever order the faces come in.
    again = PatchSurface(tuple(patches[::-1])).closest(given[:200])
    assert np.abs(again.normals - foot.normals[:200]).max() < 1e-12
    assert pickle.loads(pickle.dumps(surface)).key == surface.key
    assert np.array_equal(Flipped(surface).closest(given[:9]).normals, -foot.normals[:9])


def test_a_box_with_sharp_edges_faces_outwards():
    box = Part.makeBox(4e3, 3e3, 2e3)
    patches = [patch_from_face(face) for face in box.Faces]
    patches = [reversed_sense(p) if k in (0, 2, 3) else p for k, p in enumerate(patches)]
    foot = PatchSurface(tuple(patches)).closest(
        [[2e3, 1e3, 2.1e3], [2e3, 1e3, -50], [-9, 1e3, 1e3], [2e3, 3.2e3, 900], [4.1e3, 1e3, 2.1e3]]
    )
    assert np.allclose(foot.normals[:4], [[0, 0, 1], [0, 0, -1], [-1, 0, 0], [0, 1, 0]])
    assert np.allclose(foot.distance[:4], [100, 50, 9, 200])
    assert foot.ambiguous.tolist() == [False] * 4 + [True]
    assert not foot.outside.any()


def test_points_past_the_border_are_flagged():
    surface = surface_from_part(Part.makePlane(900, 700))
    foot = surface.closest(
        [[450, 350, 10], [900, 350, 10], [901, 350, 10], [-40, -30, 0], [0, 0, 5]]
    )
    assert foot.outside.tolist() == [False, False, True, True, False]
    assert np.allclose(foot.points[3], 0)
    # Two halves of one plane: their common border is no border of the surface, its end is.
    other = Part.makePlane(450, 700, Vector(450, 0, 0))
    halves = Part.Compound([Part.makePlane(450, 700), other])
    foot = surface_from_part(halves).closest([[450, 350, 7], [450, 0, 7], [450, -20, 7]])
    assert foot.outside.tolist() == [False, False, True]
    assert not foot.ambiguous.any()


def test_open_surfaces_follow_the_outward_rule():
    for face in (dome(), dome().reversed()):
        assert surface_from_part(face).closest([[0, 0, 20.5e3]]).distance[0] == pytest.approx(500)
    for flat in (Part.makePlane(9, 9), Part.makePlane(9, 9).reversed()):
        assert surface_from_part(flat).closest([[4, 4, 1]]).distance[0] == pytest.approx(1)
    wall = Part.makePlane(9, 9, Vector(), Vector(-1, 0, 0))
    assert surface_from_part(wall).closest([[1, 0, 0]]).normals[0] == pytest.approx([1, 0, 0])


def test_a_trimmed_part_of_a_torus_across_the_seam():
    face = Part.makeTorus(30e3, 8e3).Faces[0].Surface.toShape(5.5, 7.5, 5.0, 8.0)
    surface = surface_from_part(face)
    u, v = np.meshgrid(np.linspace(5.6, 7.4, 15), np.linspace(5.1, 7.9, 15))
    radius = 30e3 + 8.5e3 * np.cos(v)
    given = np.column_stack(
        [(radius * np.cos(u)).ravel(), (radius * np.sin(u)).ravel(), (8.5e3 * np.sin(v)).ravel()]
    )
    foot = surface.closest(given)
    assert np.abs(np.abs(foot.distance) - 500).max() < 1e-9
    assert not foot.outside.any()


def test_shapes_without_faces_are_refused():
    for shape in (Part.Shape(), Part.makeLine(Vector(), Vector(1, 0, 0))):
        with pytest.raises(BendTorsionError) as caught:
            surface_from_part(shape, "Roof")
        assert caught.value.findings[0].object == "Roof"


def test_faces_without_breadth_are_refused_with_their_area():
    """As one that a reader lost the sweep of."""
    line = Part.Circle(Vector(), Vector(0, 1, 0), 2e4).toShape(0, 3)
    face = Part.makeRuledSurface(line, line.translated(Vector(0, 1e-5, 0)))
    with pytest.raises(BendTorsionError) as caught:
        surface_from_part(face, "Roof")
    (finding,) = caught.value.findings
    assert (finding.code, finding.position) == ("face-conversion", "Face1")
    assert "its area is 0.6 mm2, less than 1" in finding.message


def distance_to_shape(points, shape):
    return max(Part.Vertex(*point).distToShape(shape)[0] for point in points)


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize(
    "edge",
    [
        Part.makeLine(Vector(1, 2, 3), Vector(700, -5, 40)),
        Part.makeCircle(500, Vector(9, 9, 9), Vector(1, 1, 1), 20, 290),
        Part.makeCircle(500),
        Part.BSplineCurve(
            [
                Vector(0, 0, 0),
                Vector(50, 90, 5),
                Vector(80, -40, 9),
                Vector(200, 0, 0),
                Vector(260, 10, 80),
            ]
        ).toShape(0.2, 0.7),
        Part.makeHelix(100, 250, 60).Edges[0],
    ],
    ids=["line", "arc", "circle", "trimmed spline", "helix"],
)
def test_edges_become_exact_curves_in_their_direction(edge, turned):
    if turned:
        edge = edge.reversed()
    curve = curve_from_part(edge)
    tolerance = 1e-9 if edge.Curve.TypeId != "Part::GeomBSplineCurve" or edge.isClosed() else 1e-6
    along = curve.evaluate(np.linspace(*curve.domain, 40))[0]
    assert distance_to_shape(along, edge) < tolerance
    ends = [tuple(edge.firstVertex(True).Point), tuple(edge.lastVertex(True).Point)]
    assert np.abs(along[[0, -1]] - ends).max() < tolerance


def test_a_wire_becomes_one_curve_whatever_the_order_of_its_edges():
    arc = Part.Arc(Vector(1e3, 0, 0), Vector(1.5e3, 200, 0), Vector(2e3, 900, 300)).toShape()
    first = Part.makeLine(Vector(0, 0, 0), Vector(1e3, 0, 0))
    last = Part.makeLine(Vector(5e3, 2e3, 0), Vector(2e3, 900, 300))
    chain = Part.Compound([last, first, arc])
    curve = curve_from_part(chain)
    points = curve.evaluate(np.linspace(*curve.domain, 3000))[0]
    assert distance_to_shape(points[::20], chain) < 1e-9
    assert curve.domain[1] == pytest.approx(chain.Length, rel=1e-9)
    polygon = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    assert polygon == pytest.approx(chain.Length, rel=1e-4)
    ends = points[[0, -1]] if points[0, 0] < points[-1, 0] else points[[-1, 0]]
    assert np.allclose(ends, [[0, 0, 0], [5e3, 2e3, 0]])


def test_edges_that_form_no_chain_are_refused():
    apart = Part.Compound(
        [
            Part.makeLine(Vector(0, 0, 0), Vector(1, 0, 0)),
            Part.makeLine(Vector(5, 0, 0), Vector(9, 0, 0)),
        ]
    )
    with pytest.raises(BendTorsionError) as caught:
        curve_from_part(apart, "Axis7")
    assert caught.value.findings[0].object == "Axis7"
    with pytest.raises(BendTorsionError):
        curve_from_part(Part.Shape())
