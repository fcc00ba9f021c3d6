# SPDX-License-Identifier: LGPL-2.1-or-later
"""Documents written back as schedules that build to the same results, kind by kind."""

import math
from dataclasses import replace

import FreeCAD
import numpy as np
import openpyxl
import Part
import pytest
from curved_members import diagonal, irregular
from test_build import APART, schedule

from BendTorsionWB import make, project
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.memo import content_hash
from BendTorsionWB.document import build_document
from BendTorsionWB.exchange.schedule import read_schedule
from BendTorsionWB.exchange.schedule_columns import SETTINGS
from BendTorsionWB.objects.plate_set import value as plates_of
from BendTorsionWB.round_trip import difference, write_back, write_document_back

SPHERE = [
    (20000 * math.sin(a) * math.cos(b), 20000 * math.sin(a) * math.sin(b), 20000 * math.cos(a))
    for a, b in zip(np.linspace(0.1, 0.5, 6), np.linspace(0.3, 0.8, 6))
]


def figures(document):
    """Corners and volumes of all plates by mark: what the shop would get."""
    found = {}
    for obj in document.Objects:
        if getattr(obj, "BT_Type", "") == "PlateSet":
            assert obj.Status == "ok", obj.Status
            for item in plates_of(obj).plates:
                plate = item.plate
                found[plate.mark] = [plate.volume, plate.start, plate.end]
            for mark, solid in zip(obj.Marks, obj.Shape.Solids):
                found[mark] += [solid.BoundBox.XMin, solid.BoundBox.YMax, solid.BoundBox.ZMin]
    return found


def check(document, path, exactly=True):
    """The schedule written builds to the same results; what it cannot say."""
    document.recompute()
    before = figures(document)
    findings = write_back(document, path)
    given, jobs = project.read_jobs(path)
    again = build_document(given, jobs, sheets=False)
    try:
        again.recompute()
        after = figures(again)
    finally:
        FreeCAD.closeDocument(again.Name)
    if exactly:
        assert set(after) == set(before) and before
        for mark, numbers in before.items():
            assert after[mark] == pytest.approx(numbers, rel=1e-9, abs=1e-6), mark
    return findings


def member(document, surface, axis, **given):
    section = make.make_section(document, "B500", h=500, b=400, t=12)
    made = make.make_member(document, "M1", axis, [section], **given)
    make.make_unfold(document, make.make_plates(document, made))
    return made


@pytest.mark.parametrize("form", ["xlsx", "csv"])
def test_a_document_of_a_schedule_comes_back_as_the_same_schedule(tmp_path, form):
    path = schedule(tmp_path / "two.xlsx", APART)
    given, jobs = project.read_jobs(path)
    made = build_document(given, jobs)
    target = tmp_path / ("back.xlsx" if form == "xlsx" else "back")
    try:
        assert write_back(made, target) == ()
        first = target.read_bytes() if form == "xlsx" else b""
        write_back(made, target)
        assert form == "csv" or target.read_bytes() == first, "the same bytes each time"
    finally:
        FreeCAD.closeDocument(made.Name)
    assert difference(path, target) == ()
    assert read_schedule(target).members[0].segments[1].cut.value == 0.45


SURFACES = {
    "ellipsoid": {"a": 40000, "b": 30000, "c": 20000},
    "sphere": {"r": 20000.0, "origin": (100.0, -50.0, 0.1)},
    "cylinder": {"r": 20000.0, "offset": 12.5},
    "cone": {"r": 20000.0, "angle": 12.3, "flip": True},
    "torus": {"R": 30000.0, "r": 20000.0},
    "plane": {},
}


@pytest.mark.parametrize("kind", SURFACES)
def test_every_kind_of_surface(document, tmp_path, kind):
    surface = make.make_surface(document, "Hall", kind, **SURFACES[kind])
    axis = make.make_axis(document, "A1", surface, SPHERE, fit="keep", frame="minimal")
    member(document, surface, axis)
    assert check(document, tmp_path / "back.xlsx") == ()


def test_a_surface_of_faces_and_an_axis_of_an_edge_go_along_as_files(document, tmp_path):
    shell = document.addObject("Part::Feature", "Roof")
    shell.Shape = Part.makeSphere(20000)
    line = document.addObject("Part::Feature", "Line")
    spline = Part.BSplineCurve()
    spline.interpolate([FreeCAD.Vector(*p) for p in SPHERE])
    line.Shape = spline.toShape()
    surface = make.make_surface(document, "Hall", face=(shell, ""))
    axis = make.make_axis(document, "A1", surface, edge=(line, "Edge1"), fit="keep")
    member(document, surface, axis)
    check(document, tmp_path / "back.xlsx")
    assert {p.name for p in (tmp_path / "back files").iterdir()} == {
        "Hall surface.brep",
        "A1 axis.brep",
    }


AXES = {
    "points": {},
    "ring": {"closed": True},
    "ends": {"start_z": 19000.0, "end_dz": 40.0, "end_extension": -250.0, "max_spacing": 700.0},
    "turned": {"reverse": True},
    "by rule turned": {"direction": "rule"},
    "loose": {"order": "nearest"},
    "twist": {"twist": {0.0: 0.0, 0.5: 3.0, 1.0: 1.5}},
    "given angles": {"frame": "given", "given_angles": {0.0: 10.0, 8000.0: 25.0}},
    "given directions": {"frame": "given", "given_directions": {0: (0, 0, 1), 5000: (0, 0.1, 1)}},
    "preset": {"preset": {0.0: (0, 0, 0), 0.5: (0, 0, 30.0), 1.0: (0, 0, 0)}},
    "offset": {"fit": "offset"},
    "geodesic": {"rule": {"kind": "geodesic", "start": SPHERE[0], "end": SPHERE[-1]}},
}


@pytest.mark.parametrize("case", AXES)
def test_every_kind_of_axis(document, tmp_path, case):
    surface = make.make_surface(document, "Hall", "sphere", r=20000)
    points = SPHERE
    if case == "ring":
        points = [(r * 12000, s * 12000, 16000.0) for r, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    if "rule" in AXES[case]:
        points = ()
    axis = make.make_axis(document, "A1", surface, points, **AXES[case])
    member(document, surface, axis)
    assert check(document, tmp_path / "back.xlsx") == ()


SECTIONS = {
    "box1": {"h": 600, "b": 500, "t": 16, "t_top": 20, "gap1": 2},
    "box2": {"h": 600.5, "b": 500, "t": 16, "t_web": 12, "gap2": 1.5},
    "i": {"h": 600, "b": 300, "b_bottom": 250, "t": 12, "t_web": 8},
    "tee": {"h": 300, "b": 200, "t": 12},
    "channel": {"h": 300, "b": 100, "t": 10},
    "trapezoid": {"h": 600, "b": 500, "b_bottom": 300, "t": 14, "corner_joint": "webs"},
    "polygon": {"corners": [(-200, 0), (200, 0), (0, 300)], "t": 12, "thicknesses": [12, 10, 14]},
}


@pytest.mark.parametrize("type_", SECTIONS)
def test_every_type_of_section(document, tmp_path, type_):
    surface = make.make_surface(document, "Hall", "sphere", r=20000)
    axis = make.make_axis(document, "A1", surface, SPHERE)
    section = make.make_section(
        document, "S1", type_, **SECTIONS[type_], Material="Q420", fy="420 MPa"
    )
    made = make.make_member(document, "M1", axis, [section])
    make.make_unfold(document, make.make_plates(document, made))
    assert check(document, tmp_path / "back.xlsx") == ()
    assert any(
        m.name == "Q420" and m.fy == 420.0 for m in read_schedule(tmp_path / "back.xlsx").materials
    )


def test_a_member_with_all_it_can_have(document, tmp_path):
    surface = make.make_surface(document, "Hall", "ellipsoid", a=40000, b=30000, c=20000)
    axis = make.make_axis(document, "A1", surface, irregular(diagonal))
    sizes = ((800, 20), (600, 16), (600, 12))
    sections = [make.make_section(document, f"B{h}-{t}", h=h, b=h, t=t) for h, t in sizes]
    made = make.make_member(
        document,
        "M1",
        axis,
        sections,
        [
            {"align": "top", "offset_y": 10.0},
            {"cut": 7000.0, "slope": 4.0, "align": "top"},
            {"cut_ratio": 0.75, "align_to": "previous", "offset_z": -5.0},
        ],
        offset_z=-30.0,
        roll=2.5,
        rank=3,
    )
    joints = {"top": [0.3, 0.7], "left": [4000.0, 9000.0], "right": "auto"}
    plates = make.make_plates(document, made, joints, station_spacing=400.0, rule_pack="EU")
    make.make_unfold(document, plates)
    assert check(document, tmp_path / "back.xlsx") == ()
    row = read_schedule(tmp_path / "back.xlsx").member("M1")
    assert row.rank == 3 and row.segments[1].slope == 4.0


def test_what_a_schedule_cannot_say_is_named(document, tmp_path):
    surface = make.make_surface(document, "Hall", "sphere", r=20000)
    axis = make.make_axis(document, "A1", surface, SPHERE, roll=3.0, chord_sag=2.0)
    made = member(document, surface, axis)
    document.recompute()
    findings = check(document, tmp_path / "back.xlsx", exactly=False)
    told = {(f.object, f.position) for f in findings}
    assert {("A1", "property Roll"), ("A1", "property ChordSag")} <= told
    assert all(f.code == "not-in-schedule" and f.mend for f in findings)
    assert made.Label == "M1"


def two_at_a_node(document):
    """Two members that meet at a node, with plates, patterns and sheets; the node."""
    ground = make.make_surface(document, "Ground", "plane")
    section = make.make_section(document, "B", h=500, b=400, t=12)
    ends = {"M1": [(0, 0, 0), (4000, 0, 0)], "M2": [(1900, 200, 0), (1900, 3000, 0)]}
    axes = {name: make.make_axis(document, f"A-{name}", ground, ends[name]) for name in ends}
    members = [make.make_member(document, name, axes[name], [section]) for name in ends]
    plates = [make.make_plates(document, member) for member in members]
    node = make.make_node(document, *members, "K1", plates=plates)
    for own in plates:
        make.make_sheets(document, make.make_unfold(document, own))
    document.recompute()
    return node


def test_nothing_is_told_of_what_nobody_set(document, tmp_path):
    """A place of a node, a bed and pages of sheets that building finds by itself."""
    node = two_at_a_node(document)
    sheets = document.getObjectsByLabel("M1 sheets")[0]
    assert node.Place.Value == 0.0 and sheets.Bed is None and sheets.PlatePages
    assert write_back(document, tmp_path / "back.xlsx") == ()


def test_a_lost_expression_is_told_with_its_object_and_property(document, tmp_path):
    node = two_at_a_node(document)
    sizes = document.addObject("Spreadsheet::Sheet", "Sizes")
    sizes.set("A1", "=500 mm")
    document.getObjectsByLabel("B")[0].setExpression("Height", "Sizes.A1")
    node.setExpression("Gap", "2 mm + 1 mm")
    document.recompute()
    found = write_back(document, tmp_path / "back.xlsx")
    assert [(f.object, f.position, f.code, f.severity) for f in found] == [
        ("B", "property Height", "expression-not-in-schedule", "warning"),
        ("K1", "property Gap", "expression-not-in-schedule", "warning"),
    ]
    assert "Sizes.A1" in found[0].message and found[0].mend


OTHER_SETTINGS = {
    "project": "Hall",
    "author": "AB",
    "station_spacing": 450,
    "default_slope": 3,
    "transition_length": "total",
    "axis_tolerance": 0.002,
    "default_material": "S460",
    "bed_face": "bottom",
    "bed_plane": "middle",
    "bed_spacing": 1500,
    "bed_height": 650,
    "pin_pitch": 900,
    "lowest_pin": 200,
    "template_pitch": 3000,
    "template_clearance": 2,
    "site_x": 1000,
    "site_y": -2000.5,
    "site_z": 50,
    "site_rotation": 33,
    "site_unit": "m",
    "sheet_format": "A1",
    "sheet_standard": "AWS",
    "sheet_language": "zh",
    "sheet_unit": "ft-in",
    "rule_pack": "EU",
    "stock": "12000x2500; 16 S460 10000x2000",
    "layer_names": "CUT_OUTER=10 MARK_TEXT=text of plates",
    "mode": "energy",
    "flattened_surface": "outer",
    "marking_face": "outside",
    "shrinkage_along": 0.3,
    "shrinkage_across": 0.2,
    "joint_allowance": 1.5,
    "diaphragm_allowance": 0.5,
    "green_start": 20,
    "green_end": 25,
    "splice": "before forming",
    "contour": "widest",
}


@pytest.mark.parametrize("sheets", [True, False])
def test_every_setting_comes_back(tmp_path, sheets):
    assert set(OTHER_SETTINGS) == set(SETTINGS)
    assert all(value != SETTINGS[key].default for key, value in OTHER_SETTINGS.items())
    path = schedule(tmp_path / "given.xlsx", APART)
    book = openpyxl.load_workbook(path)
    for name in {"Settings", "Materials"} & set(book.sheetnames):
        book.remove(book[name])
    for name, rows in (
        ("Settings", [("key", "value"), *OTHER_SETTINGS.items()]),
        ("Materials", [("material", "density", "E", "fy"), ("S460", 7850, 210000, 460)]),
    ):
        page = book.create_sheet(name)
        for row in rows:
            page.append(row)
    book.save(path)
    given, jobs = project.read_jobs(path)
    saved = tmp_path / "given.FCStd"
    made = build_document(given, jobs, sheets)
    made.saveAs(str(saved))
    FreeCAD.closeDocument(made.Name)
    assert write_document_back(saved, tmp_path / "back.xlsx") == ()
    back, again = project.read_jobs(tmp_path / "back.xlsx")
    assert replace(back.settings, place=given.settings.place) == given.settings
    assert {name: content_hash(job) for name, job in again.items()} == {
        name: content_hash(job) for name, job in jobs.items()
    }


@pytest.mark.parametrize(
    "owner, link", [("M1", "Axis"), ("M1", "Section1"), ("A1", "Surface")], ids=lambda name: name
)
def test_what_lost_a_link_is_refused_by_name(document, tmp_path, owner, link):
    """Of a member or an axis whose source was deleted there is no row; no file is left."""
    ground = make.make_surface(document, "Ground", "plane")
    axis = make.make_axis(document, "A1", ground, [(0, 0, 0), (4000, 0, 0)])
    make.make_member(document, "M1", axis, [make.make_section(document, "B")])
    document.recompute()
    obj = document.getObjectsByLabel(owner)[0]
    document.removeObject(getattr(obj, link).Name)
    document.recompute()
    with pytest.raises(BendTorsionError) as caught:
        write_back(document, tmp_path / "lost.xlsx")
    finding = caught.value.findings[0]
    assert finding.code == "link-missing" and finding.object == owner and link in finding.position
    assert not (tmp_path / "lost.xlsx").exists()
