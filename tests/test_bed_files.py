# SPDX-License-Identifier: LGPL-2.1-or-later
"""Beds in files and documents: the workbook and templates read back, the plan, the object."""

import io
import math

import ezdxf
import FreeCAD
import numpy as np
import openpyxl
import Part  # noqa: F401
import pytest
from curved_members import HALF_AXES, diagonal, irregular, tapered
from flat_plates import member as record_of
from flat_plates import rectangle

from BendTorsionWB import make
from BendTorsionWB.core.beds.bed import bed_of
from BendTorsionWB.core.beds.bed_face import BedInput
from BendTorsionWB.core.beds.placing import (
    from_placing,
    pattern_to_placing,
    placing_to_pattern,
    to_placing,
)
from BendTorsionWB.core.drawings.sheet import boxes_overlap, text_box
from BendTorsionWB.core.drawings.sheet_bed import bed_page, seat_rows
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_style import PLAIN_STYLE
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.lofting import FlatHole
from BendTorsionWB.core.patterns.pattern import develop_plate
from BendTorsionWB.core.plates.plates import split_plates
from BendTorsionWB.exchange.results_workbook import write_results
from BendTorsionWB.exchange.template_dxf import template_dxf
from BendTorsionWB.objects.proxy import findings_of
from BendTorsionWB.shapes import pattern_shape

MEMBER = tapered()
BED = bed_of(MEMBER, BedInput(pin_pitch=500.0, clearance=3.0), 500.0, 0, 0.0, MEMBER.length)


def rows(sheet):
    header = [cell.value for cell in sheet[1]]
    return [dict(zip(header, r, strict=True)) for r in sheet.iter_rows(min_row=2, values_only=True)]


@pytest.fixture(scope="module")
def book(tmp_path_factory):
    path = tmp_path_factory.mktemp("out") / "results.xlsx"
    plates = [develop_plate(plate) for plate in split_plates(MEMBER, {})[0]]
    write_results([record_of("M1", (*plates, rectangle()), beds=(BED,))], (), path)
    return openpyxl.load_workbook(path), plates


def test_the_workbook_holds_every_seat_pin_and_control_point(book):
    book, _ = book
    for row, saddle in zip(rows(book["Bed"]), BED.saddles, strict=True):
        assert (row["piece"], row["face"], row["saddle"]) == ("M1", BED.face, saddle.label)
        for side in ("left", "right"):
            place = [row[f"{side}_{axis}"] for axis in ("x", "y", "height")]
            assert place == getattr(saddle, side).place.tolist()
        assert row["slope"] == math.degrees(saddle.slope)
        assert (row["stop"], row["stop_height"]) == (saddle.stop_side, saddle.stop[2])
    pins = rows(book["Pins"])
    assert [(row["column"], row["row"]) for row in pins] == [(p.column, p.row) for p in BED.pins]
    assert min(row["height"] for row in pins) == pytest.approx(250.0)
    points = rows(book["Control"])
    there, back = (
        np.array([list(row.values())[2:]], float).reshape(3, 4) for row in rows(book["BedFrames"])
    )
    for row in points[:: len(points) // 9]:
        xyz, bed = ([row[f"{p}{a}"] for a in "xyz"] for p in ("", "bed_"))
        np.testing.assert_allclose(there[:, :3] @ xyz + there[:, 3], bed, atol=1e-6)
        np.testing.assert_allclose(back[:, :3] @ bed + back[:, 3], xyz, atol=1e-6)


def test_the_workbook_says_how_each_plate_is_formed(book):
    book, plates = book
    forming = rows(book["Forming"])
    assert [row["plate"] for row in forming] == [plate.mark for plate in plates]
    for row, plate in zip(forming, plates, strict=True):
        data = plate.forming_data
        assert (row["forming"], row["advice"]) == (plate.forming, data.advice)
        assert (row["value"], row["limit"]) == (data.forming_class.value, data.forming_class.limit)
        assert row["twist_per_metre"] == math.degrees(1000 * data.twist_max)
        assert row["may_stay_flat"] == ("yes" if plate.forming == "flat" else "no")
        assert row["corner_force"] == data.pull_down.corner_force
        assert (row["strain_u"], row["strain_v"]) == tuple(data.strain.flat)
    lines = rows(book["FormingLines"])
    assert [(row["plate"], row["line"]) for row in lines] == [
        (plate.mark, line.label)
        for plate in plates
        for line in (*plate.forming_data.roll_lines, *plate.forming_data.fold_lines)
    ]
    folds = [row for row in lines if row["kind"] == "fold"]
    assert folds and {row["direction"] for row in folds} == {"up", "down"}
    assert all(row["radius_middle"] is None for row in folds)
    rolls = [row for row in lines if row["kind"] == "roll"]
    assert all(row["radius_middle"] > 1000.0 and row["direction"] is None for row in rolls)


@pytest.mark.parametrize("board", BED.templates, ids=lambda board: board.line)
def test_a_template_is_cut_to_the_outline_and_marked(board):
    content = template_dxf(board)
    assert content == template_dxf(board)
    document = ezdxf.read(io.StringIO(content.decode()))
    assert not document.audit().errors
    assert document.header["$INSUNITS"] == 4
    space = document.modelspace()
    (contour,) = space.query("LWPOLYLINE")
    assert contour.closed and contour.dxf.layer == "CUT_OUTER"
    vertices = np.array(list(contour.get_points("xy")))
    corner = board.outline.min(axis=0)
    np.testing.assert_allclose(vertices, board.outline - corner, atol=1e-6)
    np.testing.assert_allclose(
        np.ptp(board.outline, axis=0), np.ptp(board.section, axis=0) + 6.0, atol=1e-6
    )
    texts = [text.dxf.text for text in space.query("TEXT")]
    assert texts[0] == board.name and "UP" in texts
    lines = space.query('LINE[layer=="MARK_LINE"]')
    assert len(lines) == 2
    middle = vertices.max(axis=0) / 2
    for line in lines:
        ends = np.array([(end.x, end.y) for end in (line.dxf.start, line.dxf.end)])
        assert np.abs(ends - middle).min(axis=1).max() < 1e-6
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    for entity in space.query("TEXT"):
        place = np.array([entity.dxf.insert.x, entity.dxf.insert.y])
        assert (low <= place).all() and (place <= high).all()


def test_roll_and_fold_lines_are_marked_in_the_cut_file():
    from BendTorsionWB.exchange.dxf import plate_dxf

    plate = next(p for p in (develop_plate(x) for x in split_plates(MEMBER, {})[0]) if p.folds)
    space = ezdxf.read(io.StringIO(plate_dxf(plate).decode())).modelspace()
    rolls = space.query('LINE[layer=="MARK_ROLL"]')
    for line, roll in zip(rolls, plate.forming_data.roll_lines, strict=True):
        ends = np.array([(end.x, end.y) for end in (line.dxf.start, line.dxf.end)])
        np.testing.assert_allclose(np.linalg.norm(ends - roll.flat, axis=1), 5.0, atol=1e-5)
    texts = [text.dxf.text for text in space.query('TEXT[layer=="MARK_ROLL"]')]
    assert texts == [roll.text() for roll in plate.forming_data.roll_lines]
    folds = [text.dxf.text for text in space.query('TEXT[layer=="MARK_FOLD"]')]
    assert folds == [
        f"{fold.label} {abs(math.degrees(fold.angle)):.1f} deg {fold.direction}"
        for fold in plate.forming_data.fold_lines
    ]


@pytest.mark.parametrize("spacing", [2000.0, 700.0])
@pytest.mark.parametrize("face", ["auto", "bottom"])
def test_nothing_overlaps_on_the_bed_plan(spacing, face):
    given = BedInput(face=face, spacing=spacing, pin_pitch=1000.0)
    page, _ = bed_page(bed_of(MEMBER, given, 500.0, 0, 0.0, MEMBER.length))
    boxes = [text_box(text) for text in page.texts]
    for k, box in enumerate(boxes):
        assert not any(boxes_overlap(box, other) for other in boxes[k + 1 :])
        assert (box[:, 0] >= PLAIN_STYLE.page.frame[0]).all() and (
            box[:, 0] <= PLAIN_STYLE.page.frame[2]
        ).all()
    title = np.array(
        [
            (x, y)
            for x in (PLAIN_STYLE.page.title_block[0], PLAIN_STYLE.page.title_block[2])
            for y in (PLAIN_STYLE.page.title_block[1], PLAIN_STYLE.page.title_block[3])
        ]
    )[[0, 1, 3, 2]]
    tables = [
        np.array(
            [(t.x, t.y), (t.x + sum(t.widths), t.y)]
            + [(t.x + sum(t.widths), t.y - t.height), (t.x, t.y - t.height)]
        )
        for t in page.tables
    ]
    assert not boxes_overlap(tables[0], tables[1])
    for table in tables:
        assert not boxes_overlap(table, title)
        assert not any(boxes_overlap(table, box) for box in boxes)


def test_the_plan_shows_each_saddle_at_its_place():
    page, _ = bed_page(BED)
    plan = page.views[0]
    wide = [line for line in page.lines if line.style == "wide"]
    for line, saddle in zip(wide, BED.saddles, strict=False):
        middle = (np.mean(line.points, axis=0) - plan.origin) * plan.scale
        wanted = 0.5 * (saddle.left.place[:2] + saddle.right.place[:2])
        np.testing.assert_allclose(middle, wanted, atol=1e-6)
    assert tuple(page.tables[0].rows) == tuple(seat_rows(BED)[: len(page.tables[0].rows)])
    titles = [sheet.title for sheet in member_sheets(record_of("M1", (rectangle(),), beds=(BED,)))]
    assert "M1 bed plan M1" in titles and "M1 bed M1: pins" in titles


def test_points_go_to_the_placing_frame_and_the_pattern_and_back():
    for plate in (develop_plate(plate) for plate in split_plates(MEMBER, {})[0]):
        xyz = np.array([point.xyz for point in plate.points])
        local = np.array([point.local for point in plate.points])
        np.testing.assert_allclose(to_placing(plate, xyz), local, atol=1e-6)
        np.testing.assert_allclose(from_placing(plate, local), xyz, atol=1e-6)
        flat = np.array([point.flat for point in plate.points])
        placed = pattern_to_placing(plate, flat)
        np.testing.assert_allclose(placing_to_pattern(plate, placed), flat, atol=1e-6)
        # The flat plate laid on the formed one: its first line begins at the origin, along x.
        first, second = placed[:2]
        if np.abs(first).max() < 1e-6:
            assert second[1] == pytest.approx(0.0, abs=1e-6) and second[0] > 0.0


@pytest.fixture(scope="module")
def document():
    document = FreeCAD.newDocument("Beds")
    surface = make.make_surface(document, "Hall", **dict(zip("abc", HALF_AXES, strict=True)))
    axis = make.make_axis(document, "A1", surface, irregular(diagonal)[:5])
    section = make.make_section(document, "Box", h=800, b=600, t=16)
    member = make.make_member(document, "M1", axis, [section])
    plates = make.make_plates(document, member, {"top": [0.5]})
    unfold = make.make_unfold(document, plates)
    bed = make.make_bed(document, plates, face="bottom", spacing=1500.0)
    sheets = make.make_sheets(document, unfold, bed=bed)
    document.recompute()
    yield document, section, plates, unfold, bed, sheets
    FreeCAD.closeDocument(document.Name)


def test_the_bed_object_follows_its_member_and_shows_its_posts(document):
    document, section, plates, _, bed, sheets = document
    assert bed.Status == "ok" and list(bed.DownFaces) == ["bottom"]
    count = len(bed.Saddles)
    assert len(bed.Shape.Edges) == 3 * count + 4
    frame = np.array(bed.Frames).reshape(4, 4)
    floor = [(frame @ [*vertex.Point, 1.0])[2] for vertex in bed.Shape.Vertexes]
    assert min(floor) == pytest.approx(0.0, abs=1e-6)
    # Seats stand on the plates: no gap between posts and the plates' solids.
    seats = [v for v, z in zip(bed.Shape.Vertexes, floor, strict=True) if z > 1.0]
    assert max(plates.Shape.distToShape(v)[0] for v in seats[::4]) < 0.01
    before, pages = list(bed.Saddles), sheets.PageCount
    bed.SaddleSpacing = 800.0
    document.recompute()
    assert len(bed.Saddles) > count
    bed.SaddleSpacing = 1500.0
    section.Height = 700.0
    document.recompute()
    assert list(bed.Saddles) != before and len(bed.Saddles) == count
    assert sheets.PageCount == pages


def test_a_bed_in_error_is_empty_and_its_sheets_say_so(document):
    document, _, _, _, bed, sheets = document
    bed.Face = "lid"
    document.recompute()
    (found,) = findings_of(bed)
    assert found.code == "bed-face" and "lid" in found.message
    assert not bed.Shape.Edges and not bed.Saddles
    assert sheets.PageCount == 1
    assert any(f.code == "bed-face" for f in findings_of(sheets))
    bed.Face = "top"
    document.recompute()
    assert bed.Status == "ok" and list(bed.DownFaces) == ["top"] and sheets.PageCount > 3


def test_colours_are_written_with_the_document_and_their_legend(document, tmp_path):
    document, _, plates, unfold, _, _ = document
    assert not plates.Colours and not unfold.Legend
    plates.ColourBy, unfold.ColourBy = "forming", "strain"
    document.recompute()
    assert len(plates.Colours) == len(plates.Marks)
    assert len(unfold.Colours) == len(unfold.Marks) and len(unfold.Legend) == 5
    worst = int(np.argmax(unfold.Strains))
    assert unfold.Colours[worst][:3] == pytest.approx((0xFE / 255, 0xE8 / 255, 0x38 / 255), abs=0.2)
    assert {line.split()[1] for line in plates.Legend} == set(unfold.Forming)
    path = str(tmp_path / "colours.FCStd")
    document.saveCopy(path)
    again = FreeCAD.openDocument(path, True)
    try:
        (copy,) = [o for o in again.Objects if getattr(o, "BT_Type", "") == "PlateSet"]
        assert copy.Colours == plates.Colours and copy.ColourBy == "forming"
    finally:
        FreeCAD.closeDocument(again.Name)


def test_patterns_are_faces_of_their_area_in_mark_order(document):
    _, _, _, unfold, _, _ = document
    faces = unfold.Shape.SubShapes
    assert [face.ShapeType for face in faces] == ["Face"] * len(unfold.Marks)
    np.testing.assert_allclose([face.Area for face in faces], unfold.Areas, rtol=1e-6)


def test_openings_are_left_out_of_a_pattern_face():
    square = np.array([[900.0, 300.0], [1100.0, 300.0], [1100.0, 500.0], [900.0, 500.0]])
    runs = tuple(np.array([a, b]) for a, b in zip(square, np.roll(square, -1, 0), strict=True))
    hole = FlatHole("O-1", "200x200", runs, None, 4e4)
    (face,) = pattern_shape.laid_out([rectangle(holes=(hole,))]).Faces
    assert face.Area == pytest.approx(2400.0 * 800.0 - 4e4) and len(face.Wires) == 2
    assert face.isValid()


def test_forming_figures_are_properties_in_mark_order(document):
    _, _, _, unfold, _, _ = document
    for name in ("FormingNotes", "Strains", "ForcedStresses", "BendingRadii", "Twists", "Moments"):
        assert len(getattr(unfold, name)) == len(unfold.Marks)
    assert all(note.startswith("forming: ") for note in unfold.FormingNotes)
    assert max(unfold.Strains) == pytest.approx(unfold.StrainMax, rel=1e-2)


def test_a_strain_map_of_a_plate_of_the_document(document, tmp_path):
    _, _, _, unfold, _, _ = document
    make.write_strain_map(unfold, "M1-B1", tmp_path / "b1.svg")
    assert "M1-B1: strain" in (tmp_path / "b1.svg").read_text(encoding="utf-8")
    with pytest.raises(BendTorsionError, match="M9-B1"):
        make.write_strain_map(unfold, "M9-B1", tmp_path / "no.svg")
