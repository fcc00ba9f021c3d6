# SPDX-License-Identifier: LGPL-2.1-or-later
"""Trimmed faces, faces that meet along trimmed edges, and creases inside a face."""

import FreeCAD  # noqa: F401  Part must not be loaded before it
import numpy as np
import Part
import pytest
from FreeCAD import Vector

from BendTorsionWB.core.geometry.patch_split import smooth_patches
from BendTorsionWB.core.geometry.patches import CREASE, PatchSurface
from BendTorsionWB.core.geometry.surface import Cylinder, Sphere
from BendTorsionWB.shapes.from_part import surface_from_part


def drilled_tube():
    """A cylinder face with two round holes in it."""
    tube = Part.makeCylinder(1000, 3000)
    return tube.cut(Part.makeCylinder(200, 4000, Vector(-2000, 0, 1000), Vector(1, 0, 0))).Faces[0]


def cut_sphere():
    box = Part.makeBox(600, 600, 3000, Vector(-200, -100, -1500))
    return next(f for f in Part.makeSphere(1000).common(box).Faces if f.CenterOfMass.z > 500)


@pytest.mark.parametrize(
    ("face", "exact"), [(drilled_tube(), Cylinder(1000.0)), (cut_sphere(), Sphere(1000.0))]
)
def test_outside_is_what_lies_beyond_the_wires(face, exact):
    rng = np.random.default_rng(2)
    given = rng.uniform([-1200, -400, 700], [1200, 400, 1300], (4000, 3))
    if isinstance(exact, Sphere):
        given = rng.uniform([-300, -200, 700], [500, 600, 1200], (4000, 3))
    truth = exact.closest(given)
    clear = truth.distance > -950
    foot = surface_from_part(face).closest(given[clear])
    feet = truth.points[clear]
    # FreeCAD's own distance from the untrimmed foot to the trimmed face says what is inside.
    some = np.arange(0, len(feet), 10)
    beyond = np.array([face.distToShape(Part.Vertex(Vector(*point)))[0] for point in feet[some]])
    # Within a hundredth of the wire either answer will do.
    sure = (beyond < 1e-7) | (beyond > 0.05)
    assert 0.05 < (beyond > 0.05).mean() < 0.95
    assert np.array_equal(foot.outside[some][sure], beyond[sure] > 0.05)
    inner = ~foot.outside
    assert np.abs(foot.points - feet)[inner].max() < 1e-8
    # The geometry does not stop at the wires: inside the u, v rectangle feet stay exact.
    if isinstance(exact, Cylinder):
        assert np.abs(foot.points - feet).max() < 1e-8


def test_a_foot_inside_its_face_goes_before_a_nearer_one_beyond_the_wires():
    # Two halves of one plane at different heights: each triangle's rectangle covers both.
    low = Part.Face(
        Part.makePolygon([Vector(0, 0, 0), Vector(900, 0, 0), Vector(0, 900, 0), Vector(0, 0, 0)])
    )
    high = Part.Face(
        Part.makePolygon(
            [Vector(900, 0, 50), Vector(900, 900, 50), Vector(0, 900, 50), Vector(900, 0, 50)]
        )
    )
    surface = surface_from_part(Part.Compound([low, high]))
    foot = surface.closest([[200, 200, 40], [700, 700, 10]])
    assert np.allclose(foot.points[:, 2], [0, 50])
    assert not foot.outside.any()


def test_faces_that_meet_along_a_trimmed_edge_face_one_way():
    # A dome cut by an oblique plane into two faces, one of them turned round.
    dome = Part.makeSphere(5000, Vector(), Vector(0, 0, 1), 0, 90, 360).Faces[0]
    block = Part.makeBox(40000, 20000, 40000, Vector(-20000, 0, -20000))
    block.rotate(Vector(), Vector(1, 0.2, 0), 70)
    faces = [*dome.common(block).Faces, *(f.reversed() for f in dome.cut(block).Faces)]
    assert len(faces) >= 2
    surface = surface_from_part(Part.Compound(faces))
    assert any(patch.trim is not None for patch in surface.patches)
    rng = np.random.default_rng(4)
    up = np.abs(rng.normal(size=(500, 3)))
    points = 5000 * up / np.linalg.norm(up, axis=1)[:, None]
    foot = surface.closest(points)
    assert np.abs(foot.distance).max() < 1e-7
    assert ((foot.normals * points).sum(axis=1) / 5000).min() > 1 - 1e-9
    assert not foot.outside.any()


def test_a_crease_inside_a_face_becomes_two_exact_patches():
    line = Part.BSplineCurve()
    line.buildFromPolesMultsKnots(
        [
            Vector(0, 0, 0),
            Vector(0, 2000, 300),
            Vector(0, 4000, 1500),
            Vector(0, 6000, 1000),
            Vector(0, 8000, 800),
        ],
        [3, 2, 3],
        [0, 1, 2],
        False,
        2,
    )
    face = line.toShape().extrude(Vector(9000, 0, 0))
    surface = surface_from_part(face)
    assert len(surface.patches) == 2
    whole = PatchSurface((surface_from_part(Part.makePlane(1, 1)).patches[0],))
    assert len(smooth_patches(whole.patches[0], CREASE)) == 1
    s = np.linspace(0.02, 1.98, 50)
    given = np.array([tuple(line.value(t) + Vector(4000, 0, 0)) for t in s])
    foot = surface.closest(given)
    assert np.abs(foot.points - given).max() < 1e-7
    assert (foot.normals[:, 2] > 0).all()
    tangents = np.array([tuple(line.tangent(t)[0]) for t in s])
    assert np.abs((foot.normals * tangents).sum(axis=1)).max() < 1e-9
