# SPDX-License-Identifier: LGPL-2.1-or-later
"""Diaphragms, openings and marks from the schedule to solids, cut files, tables and sheets."""

import copy
import io
import json
import math

import ezdxf
import FreeCAD
import numpy as np
import openpyxl
import Part
import pytest
from curved_members import HALF_AXES, diagonal, irregular
from flat_plates import rectangle
from schedule_books import GOOD, findings, one, write
from test_diaphragms import hollow, parts, straight
from test_nc1 import area as polygon_area
from test_nc1 import contour, traced
from test_nc1 import read as read_nc1

from BendTorsionWB import make, project
from BendTorsionWB.core.drawings.sheet import outside_frame, overlapping_texts
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.geometry import arc_contour
from BendTorsionWB.core.geometry.arc_contour import rounded_rectangle
from BendTorsionWB.core.geometry.arc_fit import enclosed_area
from BendTorsionWB.core.lofting import FlatHole, FlatMark
from BendTorsionWB.core.plates.diaphragm_input import Diaphragm
from BendTorsionWB.core.plates.hole_shape import hole_shape
from BendTorsionWB.exchange import dxf
from BendTorsionWB.exchange.nc1 import plate_nc1
from BendTorsionWB.objects import plate_set
from BendTorsionWB.objects.proxy import findings_of
from BendTorsionWB.shapes.flat_solid import flat_solid

DIAPHRAGMS = [
    {"s": "start", "t": 25.0, "gap": -20.0},
    {"s": 3000, "t": 16.0, "gap": 2.0, "snipe": 40.0, "manhole": "d=400", "closing": "top slot"},
    {"s": "60%", "t": 12.0, "gap": 1.0, "manhole": "300x400 r=50 at 0 20"},
]
OPENINGS = [
    {"face": "left", "s": 2000, "offset": 100.0, "shape": "d=120"},
    {"face": "bottom", "s": 6500, "shape": "slot 200x60", "rotation": 30.0},
    {"face": "right", "s": 6000, "offset": -60.0, "shape": "200x100 r=20"},
]
MARKS = [
    {"face": "left", "s": 3500, "text": "LIFT HERE"},
    {"face": "left", "s": 4000, "offset": -50.0, "text": "line 150 45deg"},
    {"face": "left", "s": 4500, "text": "punch"},
]


def meshed_volume(solid):
    """Volume enclosed by a fine mesh of a solid, about its own middle."""
    points, triangles = solid.tessellate(0.05)
    own = np.array(points) - np.array(solid.CenterOfMass)
    a, b, c = (own[corner] for corner in np.array(triangles).T)
    return (a * np.cross(b, c)).sum() / 6


def rows(table):
    return [{("closing_face" if k == "closing" else k): v for k, v in row.items()} for row in table]


def test_the_solid_of_a_flat_part_is_exact():
    """Volume, centre, validity; snipes, a round and a rounded hole."""
    row = Diaphragm(2000.0, 12.0, 3.0, 40.0, hole_shape("400x500 r=80"), (10.0, -20.0))
    for given in (row, Diaphragm(0.0, 30.0, -25.0, 0.0, hole_shape("d=333"), end="end")):
        flat = parts(straight(hollow()), given)[0].flats[0]
        solid = flat_solid(flat)
        assert solid.isValid() and solid.isClosed()
        assert solid.Volume == pytest.approx(flat.volume, rel=1e-9)
        assert np.allclose(solid.CenterOfMass, flat.centre_of_gravity, atol=1e-6)
        low, high = (0.0, 0.0) if given.end else (1994.0, 2006.0)
        assert (solid.BoundBox.XMin, solid.BoundBox.XMax) == pytest.approx(
            (6000.0, 6030.0) if given.end else (low, high), abs=1e-6
        )


@pytest.fixture(scope="module")
def plates():
    document = FreeCAD.newDocument("parts", hidden=True)
    surface = make.make_surface(document, "Hall", **dict(zip("abc", HALF_AXES)))
    section = make.make_section(document, "B800", h=800, b=800, t=20)
    axis = make.make_axis(document, "A1", surface, irregular(diagonal))
    member = make.make_member(document, "M1", axis, [section])
    made = make.make_plates(
        document,
        member,
        {"top": [9000.0]},
        diaphragms=rows(DIAPHRAGMS),
        openings=OPENINGS,
        marks=MARKS,
    )
    make.make_unfold(document, made)
    document.recompute()
    yield made
    FreeCAD.closeDocument(document.Name)


def test_solids_lose_their_openings_and_gain_the_flat_parts(plates):
    """Volumes of the kernel's meshes against own quadrature; closed and valid; figures of the
    object agree. The kernel's own volume of a long face with a hole is good to 1e-4 only."""
    assert plates.Status == "ok"
    value = plate_set.value(plates)
    assert list(plates.Marks)[-3:] == ["M1-E1", "M1-D1", "M1-D2"]
    solids = dict(zip(plates.Marks, plates.Shape.Solids, strict=True))
    holed = [item.plate for item in value.plates if item.plate.openings]
    assert sorted(plate.face for plate in holed) == ["bottom", "left", "right", "top"]
    for plate in holed:
        solid = solids[plate.mark]
        assert solid.isValid() and solid.isClosed()
        for opening in plate.openings:
            line = Part.makeLine(
                *(
                    FreeCAD.Vector(*(opening.spot.point + k * opening.spot.normal))
                    for k in (-50.0, 50.0)
                )
            )
            assert solid.common(line).Length == pytest.approx(0.0, abs=1e-6)
        assert meshed_volume(solid) == pytest.approx(plate.net_volume, rel=5e-5)
    assert plates.Mass == pytest.approx(7.85e-6 * plates.Volume.Value, rel=1e-9)
    assert sum(map(meshed_volume, solids.values())) == pytest.approx(plates.Volume.Value, rel=5e-5)
    # The kernel's volumes are good to 1e-5 only, which moves a centre 30 m off by 0.3 mm.
    volumes = [item.plate.net_volume for item in value.plates]
    volumes += [flat.volume for flat in value.flat]
    centres = np.array([solids[mark].CenterOfMass for mark in plates.Marks])
    centre = (np.array(volumes)[:, None] * centres).sum(axis=0) / sum(volumes)
    assert np.allclose(centre, plates.CentreOfGravity, atol=0.05)


def test_flat_parts_touch_no_wall(plates):
    """Gaps are gaps: no common volume; the end plate lies against the section."""
    solids = dict(zip(plates.Marks, plates.Shape.Solids, strict=True))
    flats = {mark: solids.pop(mark) for mark in ("M1-E1", "M1-D1", "M1-D2")}
    for mark, flat in flats.items():
        for wall in solids.values():
            if not flat.BoundBox.intersect(wall.BoundBox):
                continue
            assert flat.common(wall).Volume == pytest.approx(0.0, abs=1e-3)
            if mark == "M1-D2":
                assert flat.distToShape(wall)[0] > 1.0 - 0.01


def test_lists_of_a_document_are_checked_and_edits_reach_all(plates):
    """Different lengths and words without meaning empty the object and name the property."""
    before = list(plates.Marks)
    plates.DiaphragmGaps = [1.0]
    plates.Document.recompute()
    found = findings_of(plates)
    assert [f.code for f in found] == ["list-length"] and not plates.Shape.Solids
    assert found[0].position == "property DiaphragmGaps"
    plates.DiaphragmGaps = []
    plates.OpeningShapes = ["d=120", "triangle", "200x100 r=20"]
    plates.Document.recompute()
    assert "Openings, row 2" in plates.Status
    plates.OpeningShapes = ["d=120", "d=90", "200x100 r=20"]
    plates.DiaphragmGaps = [-20.0, 2.0, 1.0]
    plates.Document.recompute()
    assert plates.Status == "ok" and list(plates.Marks) == before


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    sheets = copy.deepcopy(GOOD)
    sheets["Points"] = sheets["Points"][:2] + [
        ["A1", 2, *(20000 * np.round([math.cos(0.2), math.sin(0.2)], 9)), 0],
        ["A1", 3, *(20000 * np.round([math.cos(0.4), math.sin(0.4)], 9)), 0],
    ]
    sheets["Members"] = sheets["Members"][:2]
    sheets["Members"][1][-1] = None
    sheets["Splits"] = sheets["Splits"][:1]
    tables = {"Diaphragms": rows(DIAPHRAGMS), "Openings": OPENINGS, "Marks": MARKS}
    for title, table in tables.items():
        columns = ["member", *dict.fromkeys(key for row in table for key in row)]
        sheets[title] = [columns] + [
            [{"member": "M1", **row}.get(column) for column in columns] for row in table
        ]
    sheets["Diaphragms"][0].append("material")
    sheets["Diaphragms"][1].append("Q355")
    folder = tmp_path_factory.mktemp("parts")
    result = project.build(write(folder / "hall.xlsx", sheets), folder / "out", workers=1)
    assert not result.failed, "\n".join(f.line() for f in result.findings)
    return folder / "out", result.records[0]


def test_a_schedule_with_all_of_it_gives_all_files(built):
    """Report, workbook, STEP: flat parts are plates like any other."""
    out, record = built
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))["members"][0]
    flats = {p["mark"]: p for p in report["plates"] if p["face"] in ("diaphragm", "end")}
    assert list(flats) == ["M1-E1", "M1-D1", "M1-D2"]
    assert {p["forming"] for p in flats.values()} == {"flat"}
    assert report["mass_kg"] == pytest.approx(sum(p["mass_kg"] for p in report["plates"]))
    for plate in report["plates"]:
        assert (out / plate["dxf"]).exists() and (out / plate["nc1"]).exists()
    book = openpyxl.load_workbook(out / "results.xlsx")
    table = [list(row) for row in book["Plates"].iter_rows(values_only=True)]
    listed = {row[table[0].index("plate")]: dict(zip(table[0], row)) for row in table[1:]}
    assert listed["M1-E1"]["material"] == "Q355" and listed["M1-D1"]["thickness"] == 16
    assert listed["M1-D1"]["length"] == pytest.approx(756.0, abs=0.1)
    points = [row for row in book["Points"].iter_rows(values_only=True) if row[0] == "M1-D1"]
    assert [row[1] for row in points] == [f"P-{k}" for k in range(1, 9)]
    shape = Part.Shape()
    shape.read(str(out / "model.step"))
    assert len(shape.Solids) == len(report["plates"])
    assert sum(s.Volume for s in shape.Solids) * 7.85e-6 == pytest.approx(record.mass, rel=1e-4)


def test_dxf_holds_openings_and_marks(built):
    """Read back by ezdxf: closed counter-clockwise contours of the record's areas, lines, texts."""
    out, record = built
    plates = {plate.mark: plate for plate in record.plates}
    holed = [plate for plate in record.plates if plate.holes]
    assert len(holed) == 6
    for plate in holed:
        space = ezdxf.readfile(out / f"plates/{plate.mark}.dxf").modelspace()
        inner = space.query('LWPOLYLINE[layer=="CUT_INNER"]')
        assert len(inner) == len(plate.holes) and all(line.closed for line in inner)
        areas = [enclosed_area(np.array(line.get_points("xyb"))) for line in inner]
        assert areas == pytest.approx([hole.area for hole in plate.holes], rel=2e-4)
        outer = space.query('LWPOLYLINE[layer=="CUT_OUTER"]')
        net = enclosed_area(np.array(outer[0].get_points("xyb"))) - sum(areas)
        assert net == pytest.approx(plate.area, rel=1e-4)
    left = next(p for p in record.plates if p.face == "left")
    space = ezdxf.readfile(out / f"plates/{left.mark}.dxf").modelspace()
    texts = {text.dxf.text for text in space.query('TEXT[layer=="MARK_TEXT"]')}
    assert {"LIFT HERE", "M1-D1", "M1-D2"} <= texts
    punch = next(mark.flat[0] for mark in left.marks if mark.kind == "punch")
    places = np.array([p.dxf.location.vec2 for p in space.query('POINT[layer=="PUNCH"]')])
    assert np.hypot(*(places - punch).T).min() < 1e-5
    line = next(mark.flat for mark in left.marks if mark.kind == "line" and not mark.text)
    ends = [
        np.array([e.dxf.start.vec2, e.dxf.end.vec2])
        for e in space.query('LINE[layer=="MARK_LINE"]')
    ]
    ends += [
        np.array(e.get_points("xy"))[[0, -1]] for e in space.query('LWPOLYLINE[layer=="MARK_LINE"]')
    ]
    assert min(np.abs(end - line[[0, -1]]).max() for end in ends) < 1e-5
    flat = ezdxf.readfile(out / "plates/M1-D2.dxf").modelspace()
    words = [text.dxf.text for text in flat.query('TEXT[layer=="MARK_TEXT"]')]
    assert words[0] == "M1-D2" and "marking face +S" in words
    assert plates["M1-D2"].marking_face == "+s"


def test_dxf_text_keeps_clear_of_openings():
    """A plate whose first long field has an opening bears its name in the next."""
    contour = rounded_rectangle(200.0, 200.0) + [250.0, 400.0, 0.0]
    hole = FlatHole("O-1", "200x200", arc_contour.runs(contour), None, 4e4)
    for holes, low, high in (((), 0.0, 500.0), ((hole,), 500.0, 1000.0)):
        stream = io.StringIO(dxf.plate_dxf(rectangle(holes=holes)).decode())
        texts = ezdxf.read(stream).modelspace().query("TEXT")
        places = [text.dxf.insert.x for text in texts if text.dxf.text == "M1-T1"]
        assert len(places) == 1 and low < places[0] < high


def test_nc1_drills_circles_and_cuts_the_rest(built):
    """BO with diameter, IK clockwise with radii, PU lines, SI texts."""
    out, record = built
    for plate in record.plates:
        blocks = read_nc1((out / f"nc1/{plate.mark}.nc1").read_bytes())["blocks"]
        holes = [row for name, found in blocks if name == "BO" for _, row in found]
        drilled = sorted(float(row.split()[-1]) for row in holes if "u" in row)
        circles = sorted(hole.circle[2] for hole in plate.holes if hole.circle)
        assert drilled == pytest.approx(circles, abs=0.006)
        cut = [contour(found) for name, found in blocks if name == "IK"]
        others = [hole.area for hole in plate.holes if not hole.circle]
        assert [-polygon_area(traced(c)) for c in cut] == pytest.approx(others, rel=1e-3)
        assert all(c[0][:2] == c[-1][:2] for c in cut)
        strokes = sum(name == "PU" for name, _ in blocks)
        assert strokes >= sum(mark.kind == "line" for mark in plate.marks)
        texts = [row.split()[-1] for name, found in blocks if name == "SI" for _, row in found]
        assert plate.mark in texts
        assert {mark.text.split()[-1] for mark in plate.marks if mark.text} <= set(texts)


def test_nc1_of_a_plate_made_by_hand():
    """A slanted text keeps its angle and place; an arc's radius is negative clockwise."""
    slot = rounded_rectangle(200.0, 80.0, 40.0) + [500.0, 300.0, 0.0]
    hole = FlatHole("O-1", "slot 200x80", arc_contour.runs(slot), None, arc_contour.area(slot))
    text = FlatMark("text", "UP", np.array([[600.0, 100.0], [610.0, 110.0]]))
    blocks = dict(read_nc1(plate_nc1(rectangle(holes=(hole,), marks=(text,))))["blocks"])
    assert {row[2] for row in contour(blocks["IK"])} <= {0.0, -40.0}
    # x, y, angle, height, text.
    words = next(row for _, row in blocks["SI"] if row.endswith("UP")).replace("u", " ").split()
    assert words[2:] == ["45.00", "12", "UP"]
    # Its middle at its place: half of two letters as wide as high before, half its height below.
    corner = np.array([float(words[0]), float(words[1])]) - [600.0, 100.0]
    own = corner @ np.array([[1.0, -1.0], [1.0, 1.0]]) / math.sqrt(2.0)
    np.testing.assert_allclose(own, [-12.0, -6.0], atol=0.01)


def test_sheets_show_them(built):
    """Flat parts on pages of their own; openings with their size and middle."""
    pages = member_sheets(built[1])
    flat = [page for page in pages if "flat parts" in page.title]
    assert len(flat) == 1 and len(flat[0].views) == 3
    words = " | ".join(text.text for text in flat[0].all_texts())
    assert "O-1 d=400 at 378.0, 378.0" in words and "P-8" in words
    curved = [page for page in pages if "flat patterns" in page.title]
    words = " | ".join(text.text for page in curved for text in page.all_texts())
    assert "d=120" in words and "slot 100x28" in words and "LIFT HERE" in words
    for page in (*flat, *curved):
        assert not outside_frame(page) and not overlapping_texts(page.all_texts())


def test_bad_cells_are_named_with_what_to_write(read):
    """At their sheet, row and column."""
    for sheet, heads, cells, column in (
        ("Diaphragms", ["s", "t"], ["middle", 12], "s"),
        ("Diaphragms", ["s", "t", "manhole"], [100, 12, "oval"], "manhole"),
        ("Diaphragms", ["s", "t", "closing_face"], [100, 12, "top glue"], "closing_face"),
        ("Diaphragms", ["s", "t", "material"], [100, 12, "Q999"], "material"),
        ("Openings", ["face", "s", "shape"], ["top", 100, "d=-5"], "shape"),
        ("Openings", ["face", "s", "shape"], ["north", 100, "d=5"], "face"),
        ("Openings", ["face", "s", "shape"], ["top", "-3%", "d=5"], "s"),
        ("Marks", ["face", "s", "text"], ["top", 100, None], "text"),
    ):
        book = [["member", *heads], ["M1", *cells]]
        finding = one(read, {}, lambda sheets, s=sheet, b=book: sheets.update({s: b}))
        assert finding.position == f"sheet {sheet}, row 2, column {column}"
    book = [["member", "s", "t"], ["M7", 100, 12]]
    finding = one(read, {}, lambda sheets: sheets.update({"Diaphragms": book}))
    assert (finding.code, finding.position) == (
        "unknown-name",
        "sheet Diaphragms, row 2, column member",
    )


def test_what_the_geometry_refuses_is_named_at_its_cell(tmp_path):
    """Rows of other members do not count; nothing is written."""
    sheets = copy.deepcopy(GOOD)
    sheets["Members"] = [*sheets["Members"][:2], ["M2", 1, "A1", "S1", *(None,) * 5]]
    sheets["Splits"] = sheets["Splits"][:1]
    sheets["Diaphragms"] = [["member", "s", "t", "manhole"], ["M2", 900, 10, None]]
    sheets["Diaphragms"] += [["M1", 900, 10, None], ["M1", 2000, 10, "d=700"]]
    sheets["Openings"] = [["member", "face", "s", "shape"], ["M1", "top", 10, "d=100"]]
    sheets["Marks"] = [["member", "face", "s", "offset", "text"], ["M1", "top", 900, 500, "punch"]]
    path = write(tmp_path / "hall.xlsx", sheets)
    found = findings(project.build, path, tmp_path / "out", ["M1"], 1)
    assert [f.position for f in found] == [
        "sheet Diaphragms, row 4, column manhole",
        "sheet Openings, row 2, column s",
        "sheet Marks, row 2, column s",
    ]
    assert not (tmp_path / "out").exists()
