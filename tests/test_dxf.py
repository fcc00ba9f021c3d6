# SPDX-License-Identifier: LGPL-2.1-or-later
"""Arc fitting and DXF files: read back by ezdxf and measured against the pattern."""

import os
import re
from collections import Counter
from dataclasses import replace
from datetime import datetime

import ezdxf
import numpy as np
import pytest
from ezdxf.math import bulge_to_arc
from flat_plates import annular_sector, rectangle, wavy

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.arc_fit import deviation, enclosed_area, fit_arcs, fit_outline
from BendTorsionWB.exchange.dxf import LAYERS, write_plate_dxf
from BendTorsionWB.exchange.whole_file import whole_file, write_whole

FOLDED = {"folds": ((1730.0, 0.02), (2130.0, -0.02))}
PLATES = {
    "rectangle": rectangle(),
    "sector": annular_sector(),
    "wavy": wavy(),
    "folded": rectangle("M1-R2", **FOLDED),
    "short": rectangle("M1-R4", length=150.0, width=800.0),
    "narrow": annular_sector("M1-B3", 4000.0, 120.0, 0.2, marking_face="outside"),
}


def circle(radius, angle, count=500):
    a = np.linspace(0.0, angle, count)
    return radius * np.stack((np.cos(a), np.sin(a)), axis=-1)


def kinks(arcs):
    """Angles between neighbouring arcs where they meet, rad."""
    chord = np.diff(arcs[:, :2], axis=0)
    heading = np.arctan2(chord[:, 1], chord[:, 0])
    half = 2.0 * np.arctan(arcs[:-1, 2])
    turn = (heading - half)[1:] - (heading + half)[:-1]
    return (turn + np.pi) % (2 * np.pi) - np.pi


def flattened(polyline, step):
    """Dense points of a read polyline, by ezdxf's own arc conversion."""
    points = []
    vertices = list(polyline.get_points("xyb"))
    for (x, y, bulge), (x1, y1, _) in zip(vertices, vertices[1:] + vertices[:1]):
        start, end = np.array([x, y]), np.array([x1, y1])
        share = np.arange(0.0, 1.0, step)[:, None]
        if abs(bulge) < 1e-9:
            points.append(start + share * (end - start))
            continue
        centre, a0, a1, radius = bulge_to_arc(start, end, bulge)
        a = a0 + (share if bulge > 0 else 1.0 - share) * ((a1 - a0) % (2 * np.pi))
        centre = np.array([centre.x, centre.y])
        points.append(centre + radius * np.concatenate((np.cos(a), np.sin(a)), axis=1))
    return np.concatenate(points)


def written(plate, tmp_path, **options):
    path = tmp_path / f"{plate.mark}.dxf"
    write_plate_dxf(plate, path, **options)
    return path, ezdxf.readfile(path)


def test_arcs_lower_than_nc1_tells_are_lines():
    """An arc of 30 km radius over 600 mm rises 1.5 µm: a line, within the tolerance all the same;
    one just above the limit stays an arc, and tolerances tighter than the limit hold."""
    x = np.linspace(0.0, 600.0, 200)

    def run(rise):
        return np.column_stack([x, 4.0 * rise * x * (600.0 - x) / 600.0**2])

    for rise in (0.0015, 0.0049, -0.0049):
        assert fit_arcs(run(rise))[:, 2].tolist() == [0.0, 0.0]
    assert abs(fit_arcs(run(0.0051))[0, 2]) == pytest.approx(2 * 0.0051 / 600.0, rel=0.01)
    wave = np.column_stack([x, 0.019 * np.sin(x / 40.0)])
    for tolerance in (0.02, 0.01, 0.002):
        for dense in (run(0.0049), run(0.03), wave):
            arcs = fit_arcs(dense, tolerance)
            chord = np.hypot(*np.diff(arcs[:, :2], axis=0).T)
            rise = 0.5 * chord * np.abs(arcs[:-1, 2])
            assert ((rise == 0.0) | (rise >= min(0.005, 0.25 * tolerance))).all()
            assert deviation(arcs, dense).max() <= tolerance


def test_a_straight_run_is_one_line():
    run = np.linspace([0.0, 0.0], [9000.0, 400.0], 300)
    assert np.array_equal(fit_arcs(run), [[0.0, 0.0, 0.0], [9000.0, 400.0, 0.0]])


@pytest.mark.parametrize("degrees", [0.5, 30, 90, 165, -60])
def test_a_circle_arc_is_one_arc_with_its_bulge(degrees):
    angle = np.radians(degrees)
    arcs = fit_arcs(circle(7000.0, angle))
    assert len(arcs) == 2
    assert arcs[0, 2] == pytest.approx(np.tan(angle / 4), rel=1e-9)


@pytest.mark.parametrize("degrees", [180, 270, 350])
def test_an_arc_of_half_a_circle_or_more_is_split(degrees):
    run = circle(500.0, np.radians(degrees))
    arcs = fit_arcs(run)
    assert np.abs(arcs[:, 2]).max() < 1.0
    assert len(arcs) <= 4
    assert 4 * np.arctan(arcs[:, 2]).sum() == pytest.approx(np.radians(degrees), rel=1e-9)
    assert deviation(arcs, run).max() < 1e-9


@pytest.mark.parametrize("tolerance", [0.1, 0.02, 0.002])
def test_free_curves_are_few_tangent_arcs_within_tolerance(tolerance):
    u = np.linspace(0.0, 1.0, 600)
    curves = {
        "wave": np.stack((12000 * u, 100 * np.sin(6 * u)), axis=-1),
        "parabola": np.stack((12000 * u, 500 * (2 * u - 1) ** 2), axis=-1),
        "ellipse": np.stack((12000 * np.cos(2 * u), 5000 * np.sin(2 * u)), axis=-1),
    }
    for run in curves.values():
        arcs = fit_arcs(run, tolerance)
        assert np.array_equal(arcs[[0, -1], :2], run[[0, -1]])
        assert deviation(arcs, run).max() <= tolerance
        assert np.abs(kinks(arcs)).max() < 1e-9
    # Arcs of a spiral need a number that grows with the cube root of the precision.
    wave = curves["wave"]
    assert len(fit_arcs(wave, tolerance)) < 1.4 * 32 * (0.02 / tolerance) ** (1 / 3)


def test_a_line_running_into_an_arc_and_coarse_noisy_points_stay_within_tolerance():
    x = np.linspace(0.0, 12000.0, 500)
    bend = np.stack((x, np.maximum(x - 6000.0, 0.0) ** 2 / 60000.0), axis=-1)
    noisy = bend + np.random.default_rng(7).normal(0.0, 1e-4, bend.shape)
    for run in (bend, noisy, bend[::60], bend[[0, 200, 499]]):
        arcs = fit_arcs(run)
        assert deviation(arcs, run).max() <= 0.02
        assert np.array_equal(arcs[[0, -1], :2], run[[0, -1]])


def test_the_area_of_an_arc_polyline_is_exact():
    half_disc = np.array([[0.0, 0.0, 1.0], [10.0, 0.0, 0.0]])
    assert enclosed_area(half_disc) == pytest.approx(np.pi * 25.0 / 2.0, rel=1e-12)
    shallow = np.array([[0.0, 0.0, 9.99e-4], [10.0, 0.0, 0.0]])
    angle = 4 * np.arctan(9.99e-4)
    radius = 5.0 / np.sin(angle / 2)
    exact = radius**2 * (angle**3 / 12.0) * (1 - angle**2 / 20.0)
    assert enclosed_area(shallow) == pytest.approx(exact, rel=1e-8)


def test_open_and_mirrored_outlines_are_refused_by_name():
    runs = PLATES["sector"].outline
    with pytest.raises(BendTorsionError, match="M9-T1.*does not close"):
        fit_outline((*runs[:3], runs[3] + 0.01), name="M9-T1")
    with pytest.raises(BendTorsionError, match="M9-T1.*clockwise"):
        fit_outline([run[::-1] for run in runs[::-1]], name="M9-T1")
    with pytest.raises(BendTorsionError, match="not numbers"):
        fit_outline((runs[0] * np.nan, *runs[1:]))


@pytest.mark.parametrize("name", PLATES)
def test_the_file_is_read_back_clean_with_one_closed_contour(name, tmp_path):
    plate = PLATES[name]
    _, document = written(plate, tmp_path)
    audit = document.audit()
    assert not audit.errors and not audit.fixes
    assert document.dxfversion >= "AC1015"
    assert document.header["$INSUNITS"] == 4
    assert document.header["$MEASUREMENT"] == 1
    assert set(LAYERS) <= {layer.dxf.name for layer in document.layers}
    space = document.modelspace()
    assert {entity.dxftype() for entity in space} <= {"LWPOLYLINE", "LINE", "POINT", "TEXT"}
    contours = space.query('*[layer=="CUT_OUTER"]')
    assert len(contours) == 1
    assert contours[0].dxftype() == "LWPOLYLINE" and contours[0].closed
    assert len(space.query("LWPOLYLINE")) == 1
    assert not space.query('*[layer=="CUT_INNER"]') and not space.query('*[layer=="MARK_ROLL"]')


@pytest.mark.parametrize("name", PLATES)
def test_the_contour_is_the_pattern(name, tmp_path):
    plate = PLATES[name]
    _, document = written(plate, tmp_path)
    contour = document.modelspace().query("LWPOLYLINE")[0]
    vertices = np.array(list(contour.get_points("xyb")))
    ring = np.concatenate((vertices, vertices[:1]))
    pattern = np.concatenate(plate.outline)
    assert deviation(ring, pattern).max() <= 0.02
    # And the other way: every place of the contour lies on the pattern's dense polygon.
    dense = np.column_stack((np.concatenate((pattern, pattern[:1])), np.zeros(len(pattern) + 1)))
    keep = np.concatenate(([True], np.linalg.norm(np.diff(dense[:, :2], axis=0), axis=1) > 1e-9))
    outline = flattened(contour, max(0.005, 0.002 * len(vertices)))
    assert deviation(dense[keep], outline).max() <= 0.02 + 0.012
    # The area error of a contour within tolerance is below tolerance times perimeter.
    perimeter = np.linalg.norm(np.diff(pattern, axis=0), axis=1).sum()
    assert enclosed_area(vertices) == pytest.approx(plate.area, abs=0.02 * perimeter)
    assert enclosed_area(vertices) > 0.0
    assert np.abs(outline.min(axis=0)).max() < 0.02
    assert outline.max(axis=0) == pytest.approx([plate.length, plate.width], abs=0.02)


def test_exact_arcs_are_written_as_exact_arcs(tmp_path):
    plate = PLATES["sector"]
    _, document = written(plate, tmp_path)
    vertices = np.array(list(document.modelspace().query("LWPOLYLINE")[0].get_points("xyb")))
    assert len(vertices) == 4
    assert enclosed_area(vertices) == pytest.approx(plate.area, rel=1e-8)
    assert sorted(np.round(4 * np.arctan(vertices[:, 2]), 9)) == [-0.5, 0.0, 0.0, 0.5]


@pytest.mark.parametrize("name", PLATES)
def test_marks_are_complete_inside_and_never_twice(name, tmp_path):
    plate = PLATES[name]
    _, document = written(plate, tmp_path)
    space = document.modelspace()
    lines = space.query('LINE[layer=="MARK_LINE"]')
    assert len(lines) == sum(line.label.startswith("L-") for line in plate.lines)
    for line, expected in zip(lines, [item for item in plate.lines if item.label[0] == "L"]):
        ends = np.array([(end.x, end.y) for end in (line.dxf.start, line.dxf.end)])
        assert np.linalg.norm(ends - expected.flat, axis=1) == pytest.approx([5.0, 5.0], abs=1e-5)
    assert len(space.query('LINE[layer=="MARK_FOLD"]')) == len(plate.folds)
    assert document.layers.get("MARK_FOLD").dxf.linetype == "DASHED"
    for layer, kind in (("PUNCH", "witness"), ("REF", "arris")):
        places = [point.dxf.location for point in space.query(f'POINT[layer=="{layer}"]')]
        points = np.array([(place.x, place.y) for place in places]).reshape(-1, 2)
        # Witness points of the end lines lie on the contour and are not punched.
        expected = [
            point.flat
            for point in plate.points
            if point.kind == kind and (kind == "arris" or point.line[0] != "E")
        ]
        assert np.allclose(points, np.array(expected).reshape(-1, 2), atol=1e-6)
    texts = [text.dxf.text for text in space.query("TEXT")]
    for wanted in (plate.mark, "t20 Q355B", f"marking face {plate.marking_face.upper()}", "+s"):
        assert wanted in texts
    assert {line.label for line in plate.lines if line.label[0] == "L"} <= set(texts)
    keys = Counter()
    for entity in space:
        if entity.dxftype() == "LINE":
            ends = (entity.dxf.start, entity.dxf.end)
            keys[tuple(sorted(end.round(2).xyz for end in ends))] += 1
        elif entity.dxftype() == "POINT":
            keys[entity.dxf.location.round(2).xyz] += 1
    assert max(keys.values()) == 1


@pytest.mark.parametrize("name", PLATES)
def test_text_lies_within_the_plate_and_apart_from_other_text(name, tmp_path):
    plate = PLATES[name]
    _, document = written(plate, tmp_path)
    ring = np.concatenate(plate.outline)
    boxes = []
    for text in document.modelspace().query("TEXT"):
        a = np.radians(text.dxf.rotation)
        reading, up = np.array([np.cos(a), np.sin(a)]), np.array([-np.sin(a), np.cos(a)])
        corner = np.array([text.dxf.insert.x, text.dxf.insert.y])
        width, height = len(text.dxf.text) * text.dxf.height, text.dxf.height
        assert 2.5 <= height <= 25.0
        across = np.array([[0, 0], [width, 0], [width, height], [0, height]])
        box = corner + across @ np.array([reading, up])
        assert all(inside(ring, place) for place in box), text.dxf.text
        boxes.append(box)
    for n, box in enumerate(boxes):
        for other in boxes[:n]:
            assert separated(box, other)


def inside(ring, place):
    a, b = ring, np.roll(ring, -1, axis=0)
    crosses = (a[:, 1] > place[1]) != (b[:, 1] > place[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        x = a[:, 0] + (place[1] - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
    return np.count_nonzero(crosses & (x > place[0])) % 2 == 1


def separated(box, other):
    """Separating axis test of two rectangles."""
    for polygon in (box, other):
        for edge in np.diff(polygon[:3], axis=0):
            p, q = box @ edge, other @ edge
            if p.max() < q.min() or q.max() < p.min():
                return True
    return False


def test_lines_at_a_fold_or_an_end_are_not_drawn_twice(tmp_path):
    plate = rectangle("M1-T9", folds=((1000.0, 0.02),))
    _, document = written(plate, tmp_path)
    space = document.modelspace()
    assert len(space.query('LINE[layer=="MARK_LINE"]')) == 3  # 500, 1500, 2000
    fold = space.query('TEXT[layer=="MARK_FOLD"]')[0].dxf.text
    assert fold == "F-1 1.1 deg up"


@pytest.mark.parametrize("length", [2400.0, 150.0])
def test_the_arrow_points_along_the_member_whatever_the_pattern_shows(length, tmp_path):
    plate = rectangle(length=length)
    turned = np.array([[-1.0, 0.0], [0.0, -1.0]])
    corner = np.array([length, 800.0])
    reverse = replace(
        plate,
        outline=tuple(run @ turned + corner for run in plate.outline),
        lines=tuple(replace(line, flat=line.flat @ turned + corner) for line in plate.lines),
        points=tuple(replace(p, flat=p.flat @ turned + corner) for p in plate.points),
    )
    for item, sign in ((plate, 1.0), (reverse, -1.0)):
        _, document = written(item, tmp_path)
        space = document.modelspace()
        shaft, *barbs = space.query('LINE[layer=="MARK_TEXT"]')
        run = shaft.dxf.end - shaft.dxf.start
        assert np.sign(run.x) == sign and abs(run.y) < 1e-6
        assert len(barbs) == 2 and all(barb.dxf.start == shaft.dxf.end for barb in barbs)
        assert all(-90.0 <= text.dxf.rotation <= 90.0 for text in space.query("TEXT"))
        height = space.query("TEXT")[0].dxf.height
        assert height > 0.6 * min(25.0, length * 0.8 / 9.6)


def test_layer_names_can_be_changed_and_bad_ones_are_refused(tmp_path):
    plate = PLATES["rectangle"]
    path, document = written(plate, tmp_path, layers={"CUT_OUTER": "轮廓 1"})
    assert len(document.modelspace().query('LWPOLYLINE[layer=="轮廓 1"]')) == 1
    assert "CUT_OUTER" not in document.layers
    path.unlink()
    for layers in ({"CUT": "A"}, {"PUNCH": "a/b"}, {"PUNCH": ""}, {"PUNCH": "ref"}):
        with pytest.raises(BendTorsionError, match="layer"):
            write_plate_dxf(plate, path, layers=layers)
        assert not path.exists()


def test_same_plate_same_bytes_and_nothing_of_the_time_or_machine(tmp_path):
    for plate in PLATES.values():
        first, second = tmp_path / "a.dxf", tmp_path / "b.dxf"
        write_plate_dxf(plate, first)
        write_plate_dxf(plate, second)
        content = first.read_bytes()
        assert content == second.read_bytes()
        assert str(datetime.now().year).encode() + b"-" not in content
        assert not re.search(rb"\{(?!0{8}-)[0-9A-Fa-f]{8}-", content)
        assert b"\n-0.0\n" not in content


def test_a_file_appears_whole_or_not_at_all(tmp_path):
    path = tmp_path / "plates" / "x.step"
    write_whole(path, b"old")
    with pytest.raises(ZeroDivisionError), whole_file(path) as part:
        assert part.suffix == ".step" and part.parent == path.parent
        part.write_bytes(b"half")
        raise ZeroDivisionError
    assert path.read_bytes() == b"old"
    assert os.listdir(path.parent) == ["x.step"]
    with pytest.raises(BendTorsionError, match="x.step.*->") as failure, whole_file(path):
        raise OSError(28, "No space left on device")
    assert "free space" in failure.value.findings[0].mend
    assert str(failure.value).count("\n") == 0
    (tmp_path / "busy").write_bytes(b"")
    with pytest.raises(BendTorsionError, match="a file stands where a folder is needed"):
        write_whole(tmp_path / "busy" / "y.dxf", b"")
