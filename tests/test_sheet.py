# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sheets: what is drawn is to scale, readable, inside its frame, and survives its files."""

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from BendTorsionWB.core.drawings.sheet import Sheet, outside_frame, overlapping_texts, text_width
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_pattern import pattern_block
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.finding import error, warning
from BendTorsionWB.core.lofting import (
    DevelopedPlate,
    FoldLine,
    LoftingPoint,
    MemberRecord,
    StationLine,
)

STYLE = SheetStyle("Concert hall")
CORNERS = {"TL": (400, 0), "TR": (-400, 0), "BR": (-400, -800), "BL": (400, -800)}
EDGES = {"top": ("TL", "TR"), "bottom": ("BL", "BR"), "left": ("TL", "BL"), "right": ("TR", "BR")}
SIDES = {
    face: ("left", "right") if face in ("top", "bottom") else ("top", "bottom") for face in EDGES
}


def rail(s, total, y, z):
    """A corner of the member: an arch of a rise of total² / 320 m, bowed sideways 600 mm."""
    rise = 300.0 + (total * s - s**2) / 8e4
    return np.stack([s, y + 600.0 * np.sin(s / total * np.pi), rise + z], axis=-1)


def strip_plate(
    mark="M1-T1", face="top", length=4000.0, width=800.0, start=0.0, radius=20000.0, total=21100.0
):
    """A plate bent in its own plane: concentric arcs, lines every 500 mm, one fold."""
    stations = np.linspace(0.0, length, int(length // 500) + 1)

    def at(s, v):
        angle = (s - length / 2) / radius
        return np.stack([(radius - v) * np.sin(angle), (radius - v) * np.cos(angle)], axis=-1)

    fine = np.linspace(0.0, length, 300)
    first, second = at(fine, width), at(fine, 0.0)
    outline = [
        first,
        np.array([first[-1], second[-1]]),
        second[::-1],
        np.array([second[0], first[0]]),
    ]
    corner = np.concatenate(outline).min(axis=0)
    outline = tuple(run - corner for run in outline)
    size = np.concatenate(outline).max(axis=0)
    lines, points = [], []
    for k, s in enumerate(stations):
        label = {0: "E-1", len(stations) - 1: "E-2"}.get(k, f"L-{k + int(start // 500)}")
        ends = np.array([at(s, width), at(s, 0.0)]) - corner
        lines.append(StationLine(label, start + s, ends, width, width))
        for e, edge in enumerate(SIDES[face]):
            xyz = rail(start + s, total, *CORNERS[EDGES[face][e]])
            points.append(
                LoftingPoint(
                    f"P-{2 * k + 1 + e}", label, edge, "arris", start + s, xyz, xyz, ends[e]
                )
            )
    points.append(
        replace(
            points[0],
            label="W-1",
            kind="witness",
            flat=points[0].flat + 50.0 * (points[1].flat - points[0].flat) / width,
        )
    )
    s = 0.4 * length
    fold = FoldLine("F-1", start + s, np.radians(3.2), np.array([at(s, width), at(s, 0)]) - corner)
    area = 0.5 * ((radius**2) - (radius - width) ** 2) * length / radius
    return DevelopedPlate(
        member="M1",
        mark=mark,
        part=mark,
        face=face,
        letter=face[0].upper(),
        piece=1,
        thickness=20.0,
        material="S355",
        outline=outline,
        lines=tuple(lines),
        folds=(fold,),
        points=tuple(points),
        panels=(),
        length=size[0],
        width=size[1],
        area=area,
        mass=area * 20.0 * 7.85e-6,
        volume=area * 20.0,
        s_start=start,
        s_end=start + length,
        length_error_max=0.004,
        length_error_rms=0.001,
        length_error_bound=0.003,
        strain_max=2.1e-5,
        locked_in_stress=4.0,
        bending_radius_min=40000.0,
        forming=None,
        marking_face="inside",
        placing=np.eye(4),
        flat_to_placing=np.eye(4),
    )


def strip_member(name="M1", lengths=(4000.0, 5200.0, 3400.0, 6000.0, 2500.0), findings=()):
    """A member of four faces with the same split on each, shifted face by face."""
    plates, total = [], float(sum(lengths))
    for face, letter, shift in (
        ("top", "T", 0),
        ("bottom", "B", 1),
        ("left", "L", 2),
        ("right", "R", 3),
    ):
        start = 0.0
        for k in range(len(lengths)):
            length = lengths[(k + shift) % len(lengths)]
            mark = f"{name}-{letter}{k + 1}"
            plates.append(strip_plate(mark, face, length, 800.0, start, 2e4, total))
            start += length
    s = np.linspace(0.0, total, 200)
    wireframe = {"axis": rail(s, total, 0.0, 0.0)}
    wireframe |= {key: rail(s, total, *corner) for key, corner in CORNERS.items()}
    for index, label in ((0, "start"), (-1, "end"), (60, "joint 1"), (120, "joint 2")):
        ring = np.array([wireframe[key][index] for key in CORNERS])
        wireframe[label] = np.vstack([ring, ring[:1]])
    return MemberRecord(
        member=name,
        sections="800x800x20 / 600x600x16",
        section_type="box1",
        length=total,
        mass=sum(plate.mass for plate in plates),
        axis_to_surface_rms=0.0011,
        axis_to_surface_max=0.0031,
        torsion_error_max=1e-5,
        total_torsion=0.31,
        plates=tuple(plates),
        wireframe=wireframe,
        findings=tuple(findings),
    )


def moved_apart(sheet):
    """All texts of a sheet and the view frames, for messages."""
    return [(a.text, b.text) for a, b in overlapping_texts(sheet.all_texts())]


WARNINGS = [
    warning(
        "joint-stagger",
        "M1",
        "joints of two faces are closer than the rule asks",
        "move it",
        position=f"s={k} mm",
        value=120.0 + k,
        limit=200.0,
        unit="mm",
    )
    for k in range(9)
]
MEMBERS = {
    "usual": strip_member(findings=WARNINGS),
    "long": strip_member("M-LONG-12", (12000.0, 14000.0)),
    "short": strip_member("B7", (900.0, 700.0)),
    "many": strip_member("M3", tuple(np.linspace(1100.0, 1900.0, 16))),
}


@pytest.mark.parametrize("member", MEMBERS)
def test_nothing_overlaps_or_leaves_the_frame(member):
    sheets = member_sheets(MEMBERS[member], STYLE)
    assert [sheet.number for sheet in sheets] == list(range(1, len(sheets) + 1))
    for sheet in sheets:
        assert moved_apart(sheet) == []
        assert outside_frame(sheet) == []
        assert min(text.height for text in sheet.all_texts()) >= 1.8


@pytest.mark.parametrize("member", MEMBERS)
def test_every_plate_is_drawn_once_to_scale_and_every_point_is_listed(member):
    record = MEMBERS[member]
    sheets = member_sheets(record)
    views = {view.name: view for sheet in sheets[1:] for view in sheet.views}
    assert sorted(views) == sorted(plate.mark for plate in record.plates)
    for plate in record.plates:
        drawn = np.concatenate(
            [line.points for line in views[plate.mark].on_page() if line.style == "wide"]
        )
        size = np.ptp(drawn, axis=0) * views[plate.mark].scale
        assert size == pytest.approx((plate.length, plate.width), abs=0.2)
    rows = [
        row
        for sheet in sheets
        for table in sheet.tables
        if table.header[0] == "point"
        for row in table.rows
    ]
    assert len(rows) == len(set(rows)) == sum(len(plate.points) for plate in record.plates)


def test_page_scale_is_the_same_for_all_its_views():
    for record in MEMBERS.values():
        for sheet in member_sheets(record):
            assert len({view.scale for view in sheet.views}) <= 1


def test_pattern_labels_every_point_line_and_fold_when_there_is_room():
    plate = strip_plate()
    block = pattern_block(plate, 15)
    labels = {text.text for text in block.texts}
    assert {point.label for point in plate.points if point.kind == "arris"} <= labels
    assert {line.label for line in plate.lines} <= labels
    assert "F-1 3.2° up" in labels
    assert plate.mark in labels
    corner = np.concatenate(plate.outline).min(axis=0)
    centers = [np.mean(line.points, axis=0) * 15 for line in block.lines]
    assert sum(np.allclose(center, plate.points[-1].flat - corner) for center in centers) == 2


def test_drawn_outline_stays_on_the_pattern():
    plate = strip_plate()
    (view,) = pattern_block(plate, 20).views
    drawn = [np.array(line.points) for line in view.polylines if line.style == "wide"]
    for run, line in zip(plate.outline, drawn, strict=True):
        assert len(line) <= len(run)
        assert _distances(run, line).max() / view.scale < 0.0101


def _distances(points, line):
    """Distance of each point to the nearest segment of a polyline."""
    start, step = line[:-1], np.diff(line, axis=0)
    share = ((points[:, None] - start) * step).sum(axis=2) / (step**2).sum(axis=1)
    foot = start + np.clip(share, 0.0, 1.0)[..., None] * step
    return np.min(np.linalg.norm(points[:, None] - foot, axis=2), axis=1)


def test_title_block_names_what_the_page_holds():
    record = MEMBERS["usual"]
    sheets = member_sheets(record, STYLE)
    for sheet in sheets:
        fields = dict(sheet.fields)
        assert fields["project"] == "Concert hall"
        assert fields["member"] == "M1"
        assert fields["sections"] == record.sections
        assert fields["material"] == "S355"
        assert fields["sheet"] == f"{sheet.number} / {len(sheets)}"
        assert fields["units"] == "mm"
        assert f"{record.mass:.1f} kg" == fields["member mass (net)"]
        if sheet.views and sheet.number > 1:
            assert fields["plates on this sheet"] == ", ".join(v.name for v in sheet.views)
            assert fields["scale"] == f"1:{sheet.views[0].scale:g}"
    first = " ".join(text.text for text in sheets[0].all_texts())
    assert "Warnings (9)" in first and "joints of two faces" in first


def test_member_in_error_gives_one_sheet_that_says_so():
    wrong = error(
        "thickness",
        "M9",
        "plates are thicker than half the section",
        "reduce t",
        value=500.0,
        limit=400.0,
        unit="mm",
    )
    (sheet,) = member_sheets(MemberRecord("M9", "", "box1", findings=(wrong,)))
    text = " ".join(item.text for item in sheet.all_texts())
    assert "M9: IN ERROR" in text and "reduce t" in text and "500" in text
    assert sheet.views == () and moved_apart(sheet) == [] and outside_frame(sheet) == []


def test_sheets_survive_json():
    for sheet in member_sheets(MEMBERS["usual"]):
        again = Sheet.from_dict(json.loads(json.dumps(sheet.as_dict())))
        assert again == sheet and hash(again) == hash(sheet)


@pytest.fixture
def qt_program():
    """A Python that has Qt."""
    return sys.executable


def test_text_width_is_never_less_than_the_fonts(qt_program):
    script = (
        "from BendTorsionWB.sheets.qt import qt_modules\n"
        "_, qt = qt_modules()\n"
        "app = qt.QGuiApplication(['t', '-platform', 'offscreen'])\n"
        "font = qt.QFont('DejaVu Sans'); font.setPixelSize(729 * 4)\n"
        "import sys; text = sys.stdin.read()\n"
        "print(*(qt.QFontMetricsF(font).horizontalAdvance(t) / 2916 / 0.729\n"
        "        for t in text.splitlines()))\n"
    )
    samples = ["M12-T3", "L-12", "P-104", "-40000.5", "4000.0 × 812.3", "face top, WAV 3.2°", "–"]
    done = subprocess.run(
        [qt_program, "-c", script],
        cwd=Path(__file__).resolve().parent.parent,
        input="\n".join(samples),
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    real = [float(value) for value in done.stdout.split()]
    for sample, width in zip(samples, real, strict=True):
        assert width <= text_width(sample, 1.0) <= 1.05 * width
