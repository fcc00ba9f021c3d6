# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cut ends in cut files and solids, against the patterns and the kernel."""

import ezdxf
import numpy as np
import pytest
from curved_members import ELLIPSOID
from cut_members import straight

from BendTorsionWB.core import detailing
from BendTorsionWB.core.axes.frames import FrameInput
from BendTorsionWB.core.geometry.surface import Cylinder
from BendTorsionWB.core.members.end_cut import EndCut
from BendTorsionWB.core.solids import solid_skins
from BendTorsionWB.core.solids.cut_skin import cut_skin_area
from BendTorsionWB.exchange.dxf import write_plate_dxf
from BendTorsionWB.shapes import cut_solid


def test_the_cut_file_holds_the_curved_end_and_its_points(sine, tmp_path):
    for plate in sine.record.plates:
        write_plate_dxf(plate, tmp_path / "p.dxf")
        space = ezdxf.readfile(tmp_path / "p.dxf").modelspace()
        [outer] = space.query('LWPOLYLINE[layer=="CUT_OUTER"]')
        points = np.array(outer.get_points("xyb"))
        following = np.roll(points[:, :2], -1, axis=0)
        x, y, chord = points[:, 0], points[:, 1], following - points[:, :2]
        area = 0.5 * (x * following[:, 1] - following[:, 0] * y).sum()
        # A bulge b adds the segment of its arc, angle 4 atan b over the chord.
        angle = 4.0 * np.arctan(points[:, 2])
        length = np.linalg.norm(chord, axis=1)
        bent = np.abs(angle) > 1e-12
        radius = length[bent] / (2.0 * np.sin(0.5 * angle[bent]))
        area += 0.5 * (radius**2 * (angle[bent] - np.sin(angle[bent]))).sum()
        assert area == pytest.approx(plate.area, abs=0.02 * length.sum())
        ends = {tuple(np.round(p[:2], 6)) for p in points}
        for corner in plate.lines[-1].flat:
            assert min(np.hypot(*(corner - e)) for e in ends) < 1e-5


@pytest.mark.parametrize("kind", ["planes", "surface"])
def test_solids_are_cut_where_the_plates_end(kind, tilted, sine):
    built = sine
    if kind == "surface":
        pole = Cylinder(900.0, (6800.0, 100.0, 0.0))
        built = straight(end=EndCut("surface", surface=pole))
    solids = [solid for solid, _ in cut_solid.plate_solids(built.plates.plates)]
    for item, solid in zip(built.plates.plates, solids, strict=True):
        assert solid.isValid() and solid.isClosed()
        assert solid.Volume == pytest.approx(item.plate.volume, rel=2e-6)
    figures = detailing.figures_of(built.plates)
    for own, solid in zip(figures.solids, solids, strict=True):
        assert np.array(solid.CenterOfMass) == pytest.approx(own.centre, abs=0.02)
    outside = cut_solid.member_solids(built.geometry)
    assert len(outside) == 1 and outside[0].isValid()
    for item in built.plates.plates:
        point = item.plate.rails.mid(np.array([item.plate.cuts[1].range[0] - 20.0]))[0, :3]
        assert outside[0].distToShape(_vertex(point))[0] < 21.0


def _vertex(point):
    import FreeCAD
    import Part

    return Part.Vertex(FreeCAD.Vector(*point))


def test_painted_area_of_a_cut_twisted_box_is_that_of_the_kernels_solid(twisted):
    geometry = detailing.MemberGeometry(twisted, ELLIPSOID, FrameInput(), ())
    tubes = solid_skins.corner_tubes(twisted, twisted.reach)
    area = cut_skin_area(twisted, tubes)
    [solid] = cut_solid.member_solids(_hashed(geometry))
    assert area == pytest.approx(solid.Area - _end_area(solid, twisted), rel=1e-5)


def _end_area(solid, built):
    """Area of the faces that lie in an end plane."""
    total = 0.0
    for face in solid.Faces:
        points = np.array([vertex.Point for vertex in face.Vertexes])
        for end in built.ends:
            if np.abs(end.surface.value_and_gradient(points)[0]).max() < 1e-3:
                total += face.Area
    return total


def _hashed(geometry):
    object.__setattr__(geometry, "_made_from", f"test {id(geometry)}")
    return geometry


def test_a_round_surface_that_comes_again_beyond_the_other_end_cuts_the_near_one():
    """A box that leaves a tank by its wall at 200 mm; the opposite wall is 0.8 m beyond its end.
    The outer solid is 800 mm times ∫ (6000 - 3500 + (R² - y²)½) dy over its breadth."""
    radius, middle, half = 3300.0, 3500.0, 300.0
    tank = Cylinder(radius, (middle, 0.0, 0.0))
    built = straight(start=EndCut("surface", surface=tank))
    segment = half * np.sqrt(radius**2 - half**2) + radius**2 * np.arcsin(half / radius)
    [solid] = cut_solid.member_solids(built.geometry)
    assert solid.isValid()
    expected = 800.0 * (2.0 * half * (6000.0 - middle) + segment)
    assert solid.Volume == pytest.approx(expected, rel=1e-6)
