# SPDX-License-Identifier: LGPL-2.1-or-later
"""IFC files, read back by a reader of STEP physical files written for this test."""

import math
import re
from types import SimpleNamespace

import FreeCAD
import numpy as np
import Part
import pytest

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.site import SiteDatum
from BendTorsionWB.exchange.ifc import ifc_bytes
from BendTorsionWB.exchange.ifc_entities import global_id
from BendTorsionWB.exchange.ifc_fragment import Assembly, PlateSolid
from BendTorsionWB.shapes.boundary_of import boundary_of

HOLE = FreeCAD.Vector(5, 8, -1)


def drilled():
    return Part.makeBox(10, 20, 30).cut(Part.makeCylinder(3, 50, HOLE)).Solids[0]


def twisted():
    """A bar between two squares a quarter turn apart along a spline."""
    start = Part.makePolygon(
        [FreeCAD.Vector(*p) for p in ((0, 0, 0), (20, 0, 0), (20, 8, 0), (0, 8, 0), (0, 0, 0))]
    )
    end = start.copy()
    end.rotate(FreeCAD.Vector(10, 4, 0), FreeCAD.Vector(0, 0, 1), 25)
    end.translate(FreeCAD.Vector(0, 0, 100))
    return Part.makeLoft([start, end], True).Solids[0]


def plate(mark, solid, material="S355"):
    record = SimpleNamespace(
        mark=mark,
        part=mark,
        piece=1,
        face="top",
        forming="cold",
        thickness=20.0,
        area=2e5,
        volume=solid.Volume,
        mass=solid.Volume * 7.85e-6,
        length=100.0,
        width=20.0,
        material=material,
        gross=None,
        marking_face="inside",
        bevels=(),
    )
    return PlateSolid(record, boundary_of(solid, mark), (0.5, 0.5, 0.75))


def written(*plates, project="Hall", **site):
    content = ifc_bytes(project, [Assembly("M1-1", "M1", plates)], SiteDatum(**site), "1.0")
    return entities(content.decode("ascii"))


def entities(text):
    """Number -> (type, arguments), every argument as text, references and lists resolved apart."""
    found = {}
    for number, kind, body in re.findall(r"^#(\d+)=(\w+)\((.*)\);$", text, re.M):
        found[int(number)] = (kind, arguments(body))
    assert len(found) == text.count("\n#")
    return found


def arguments(body):
    depth, quoted, current, out = 0, False, "", []
    for letter in body:
        if letter == "'":
            quoted = not quoted
        if not quoted:
            depth += (letter == "(") - (letter == ")")
            if letter == "," and depth == 0:
                out.append(current)
                current = ""
                continue
        current += letter
    return [*out, current]


def of_kind(found, kind):
    return {number: value for number, (name, value) in found.items() if name == kind}


def references(text):
    return [int(number) for number in re.findall(r"#(\d+)", text)]


def test_every_reference_leads_to_an_earlier_entity():
    found = written(plate("M1-T1", drilled()), plate("M1-T2", twisted()))
    for number, (_, values) in found.items():
        for value in values:
            if not value.startswith("'"):
                assert all(ref in found and ref < number for ref in references(value))


@pytest.mark.parametrize("solid", [drilled, twisted])
def test_shells_are_closed_and_look_outwards(solid):
    """Every edge is used twice, once each way, and every loop runs head to tail."""
    solid = solid()
    found = written(plate("M1-T1", solid))
    uses = {}
    for edge, forward in ((v[2], v[3]) for v in of_kind(found, "IFCORIENTEDEDGE").values()):
        uses.setdefault(edge, []).append(forward)
    assert all(sorted(ways) == [".F.", ".T."] for ways in uses.values())
    loops = of_kind(found, "IFCEDGELOOP")
    oriented, edges = of_kind(found, "IFCORIENTEDEDGE"), of_kind(found, "IFCEDGECURVE")
    for loop in loops.values():
        ends = []
        for item in references(loop[0]):
            curve, forward = references(oriented[item][2])[0], oriented[item][3] == ".T."
            pair = edges[curve][:2]
            ends.append(pair if forward else pair[::-1])
        for one, following in zip(ends, ends[1:] + ends[:1], strict=True):
            assert one[1] == following[0]


@pytest.mark.parametrize("solid", [drilled, twisted])
def test_curves_lie_on_both_faces_they_bound(solid):
    """Read back the vertices: each lies on the plane faces it belongs to."""
    found = written(plate("M1-T1", solid()))
    assert len(of_kind(found, "IFCADVANCEDFACE")) == len(solid().Faces)
    assert len(of_kind(found, "IFCVERTEXPOINT")) == len(solid().Vertexes)
    for number, (origin, normal) in planes(found).items():
        for vertex in vertices_of(found, number):
            assert abs((vertex - origin) @ normal) < 1e-6


def planes(found):
    out = {}
    for number, face in of_kind(found, "IFCADVANCEDFACE").items():
        surface = references(face[1])[0]
        if found[surface][0] == "IFCPLANE":
            place = found[references(found[surface][1][0])[0]][1]
            origin, axis = (numbers(found, references(p)[0]) for p in place[:2])
            out[number] = origin, axis
    assert out
    return out


def numbers(found, number):
    return np.array([float(v) for v in found[number][1][0].strip("()").split(",")])


def vertices_of(found, face):
    for bound in references(found[face][1][0]):
        for item in references(found[references(found[bound][1][0])[0]][1][0]):
            for end in references(",".join(found[references(found[item][1][2])[0]][1][:2])):
                yield numbers(found, references(found[end][1][0])[0])


def test_identities_follow_from_project_and_mark_alone():
    one = written(plate("M1-T1", drilled()), plate("M1-T2", drilled()))
    two = written(plate("M1-T2", twisted()))
    tags = [{v[7]: v[0] for v in of_kind(found, "IFCPLATE").values()} for found in (one, two)]
    assert tags[0]["'M1-T2'"] == tags[1]["'M1-T2'"] != tags[0]["'M1-T1'"]
    assert global_id("Hall", "plate", "M1-T1") != global_id("Dome", "plate", "M1-T1")
    every = [v[0] for name, v in one.values() if re.fullmatch(r"'[0-9A-Za-z_$]{22}'", v[0])]
    assert len(every) == len(set(every)) and all(v[1] in "0123" for v in every)


def test_site_and_quantities():
    found = written(plate("M1-T1", drilled()), x=1000.0, y=-2.5, z=30.0, rotation=math.radians(30))
    site = next(iter(of_kind(found, "IFCSITE").values()))
    place = found[references(found[references(site[5])[0]][1][1])[0]][1]
    assert numbers(found, references(place[0])[0]) == pytest.approx([1000.0, -2.5, 30.0])
    assert numbers(found, references(place[2])[0]) == pytest.approx([math.sqrt(0.75), 0.5, 0.0])
    weights = {v[0]: float(v[3]) for v in of_kind(found, "IFCQUANTITYWEIGHT").values()}
    assert weights["'NetWeight'"] == pytest.approx(drilled().Volume * 7.85e-6)
    assert len(of_kind(found, "IFCMATERIAL")) == 1


def test_names_of_any_script_are_written_in_plain_letters():
    content = ifc_bytes("音乐厅 O'Neil", [Assembly("M1-1", "M1", (plate("M1-T1", drilled()),))])
    assert rb"\X2\97F34E505385\X0\ O''Neil" in content
    assert max(content) < 128


def test_same_solids_give_the_same_bytes():
    plates = plate("M1-T1", twisted()), plate("M1-T1", twisted())
    assert len({ifc_bytes("Hall", [Assembly("M1-1", "M1", (p,))]) for p in plates}) == 1


def test_a_solid_of_two_shells_is_refused_by_name():
    hollow = Part.makeBox(10, 10, 10).cut(Part.makeBox(4, 4, 4, FreeCAD.Vector(3, 3, 3)))
    with pytest.raises(BendTorsionError, match="M1-T1.*one shell"):
        boundary_of(hollow.Solids[0], "M1-T1")
