# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes concert_hall.xlsx: sixteen ribs of a concert hall's entrance on an ellipsoid.

Run `python3 make_concert_hall.py [TARGET]`. The same program writes the same bytes.
"""

from __future__ import annotations

import datetime
import io
import math
import random
import sys
import zipfile
from pathlib import Path

import numpy as np
from openpyxl import Workbook
from openpyxl.styles import Font, PatternFill
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.datavalidation import DataValidation

HALF_AXES = (40000.0, 30000.0, 20000.0)
SEED = 20
RIBS = 16
# Distance between neighbouring rib planes. Two 800 mm boxes, each pushed by its alignment half
# its breadth towards the other, still keep more than 1 m clear.
PLANE_SPACING = 2750.0

# length of the rib in mm, height of its foot, turn and lean of its plane in degrees
SHAPES = (
    (15200, 320, -1.6, 21.0),
    (17100, 450, -1.4, 21.4),
    (18800, 380, -1.2, 21.8),
    (20500, 600, -1.0, 22.2),
    (22300, 340, -0.8, 22.6),
    (24100, 520, -0.6, 23.0),
    (25400, 410, -0.4, 23.4),
    (25900, 330, -0.2, 23.8),
    (25600, 480, 0.0, 24.2),
    (24700, 350, 0.2, 24.6),
    (23300, 560, 0.4, 25.0),
    (21900, 370, 0.6, 25.4),
    (20100, 440, 0.8, 25.8),
    (18300, 310, 1.0, 26.2),
    (16700, 500, 1.2, 26.6),
    (15400, 360, 1.4, 27.0),
)
POINT_COUNTS = (8, 9, 8, 10, 9, 11, 12, 11, 12, 10, 11, 9, 10, 9, 8, 8)

SETTINGS = (("project", "Concert hall, entrance ribs"), ("author", None), ("station_spacing", 500))
SECTIONS = (
    ("B800-1", "box1", 800, 800, 20, None, None),
    ("B600-1", "box1", 600, 600, 16, None, None),
    ("B800-1G", "box1", 800, 800, 20, 3, 3),
    ("B800-2", "box2", 800, 800, 20, None, None),
    ("B600-2", "box2", 600, 600, 16, None, None),
)
# segments of M1, M2, ...: section and then what differs from the defaults
SEGMENTS = (
    (("B800-1", {}), ("B600-1", {"cut": 7000})),
    (
        ("B800-2", {"align": "top"}),
        ("B600-2", {"cut": "45%", "align": "top"}),
    ),
    (("B800-1", {"rank": 1}),),
    (
        ("B800-1", {}),
        ("B600-1", {"cut": "35%", "slope": 4}),
        ("B800-1", {"cut": "70%", "slope": 4}),
    ),
    (
        ("B800-2", {"align": "bottom"}),
        ("B600-2", {"cut": 9500, "slope": 6, "align": "bottom"}),
    ),
    (("B800-1G", {}), ("B600-1", {"cut": "50%", "align": "left", "align_to": "previous"})),
    (("B600-1", {"offset_z": -60}),),
    (
        ("B800-2", {}),
        ("B600-2", {"cut": "55%", "slope": 0, "align": "top", "align_to": "previous"}),
    ),
    (
        ("B800-1", {"align": "top-left"}),
        ("B600-1", {"cut": 12400, "slope": 4, "align": "top-left"}),
    ),
    (("B800-2", {"roll": 5}), ("B600-2", {"cut": "60%"})),
    (
        ("B800-1", {"member_offset_z": -150}),
        ("B600-1", {"cut": 10800, "align": "top", "align_to": "previous"}),
    ),
    (
        ("B800-2", {}),
        ("B600-2", {"cut": "40%", "align": "right", "align_to": "previous", "offset_y": 25}),
    ),
    (
        ("B800-2", {}),
        ("B600-2", {"cut": 6900, "align": "bottom", "align_to": "previous"}),
        ("B800-2", {"cut": 13600, "align": "bottom", "align_to": "previous"}),
    ),
    (("B800-2", {"align": "top"}),),
    (
        ("B800-1", {"align": "bottom-right"}),
        ("B600-1", {"cut": "48%", "align": "bottom-right", "offset_z": 20}),
    ),
    (("B800-1", {}), ("B600-1", {"cut": 7300, "slope": 6})),
)
RATIOS = {
    "left": "0.2 0.4 0.6 0.8 1",
    "right": "0.15 0.35 0.45 0.75 1",
    "top": "0.1 0.3 0.55 0.7 0.85 1",
    "bottom": "0.25 0.5 0.65 0.9 1",
}
JOINTS_MM = {
    3: {
        "left": "3800 7600 11400 15200",
        "right": "2900 6700 8600 14100",
        "top": "1900 5700 10400 13200 16000",
        "bottom": "4700 9400 12300 16900",
    },
    16: {"left": "4000 11500", "right": "2500 9500", "top": "5000 10500", "bottom": "3250 12500"},
}
WITHOUT_JOINTS = (7,)

HEADINGS = {
    "Settings": ("key", "value"),
    "Materials": ("material", "density", "E", "fy"),
    "Surfaces": ("surface", "kind", "parameters", "offset", "flip"),
    "Axes": ("axis", "surface", "frame", "fit", "max_spacing"),
    "Points": ("axis", "no", "x", "y", "z"),
    "Sections": ("section", "type", "h", "b", "t", "gap1", "gap2", "material"),
    "Members": (
        *("member", "segment", "axis", "section", "cut", "slope", "align", "align_to"),
        *("offset_y", "offset_z", "member_offset_y", "member_offset_z", "roll", "rank"),
    ),
    "Splits": ("member", "face", "joints"),
}
CHOICES = {
    ("Sections", "type"): "box1,box2",
    ("Members", "align"): (
        "centre,top,bottom,left,right,top-left,top-right,bottom-left,bottom-right"
    ),
    ("Members", "align_to"): "axis,previous",
    ("Splits", "face"): "top,bottom,left,right",
    ("Axes", "fit"): "pull,keep",
}
NUMBER_FORMATS = {("Points", "x"): "0.000", ("Points", "y"): "0.000", ("Points", "z"): "0.000"}
WIDE = {("Settings", "key"): 20, ("Settings", "value"): 30, ("Surfaces", "parameters"): 28}
WIDE |= {("Splits", "joints"): 32}
FIXED_DATE = datetime.datetime(2025, 1, 1)


def rib_curve(rib: int) -> np.ndarray:
    """(n, 3) mm: rib 0..15 on the ellipsoid from its foot upwards, finely.

    The rib is a plane section of the ellipsoid; the plane turns and leans against the principal
    directions, so that the rib bends and twists.
    """
    _, foot, turn, lean = SHAPES[rib]
    turn, lean = math.radians(24.0 + turn), math.radians(lean)
    normal = np.array(
        [math.cos(turn) * math.cos(lean), math.sin(turn) * math.cos(lean), math.sin(lean)]
    )
    half_axes = np.array(HALF_AXES)
    # The section in the space where the ellipsoid is the unit sphere: a circle.
    scaled = normal * half_axes
    distance = (rib - (RIBS - 1) / 2.0) * PLANE_SPACING / np.linalg.norm(scaled)
    axis = scaled / np.linalg.norm(scaled)
    level = np.cross(axis, [0.0, 0.0, 1.0])
    level /= np.linalg.norm(level)
    up = np.cross(level, axis)
    radius = math.sqrt(1.0 - distance**2)
    # From below the low end on the front (y < 0) over the top, finely: arc length by chords.
    sign = 1.0 if level[1] > 0.0 else -1.0
    angles = np.linspace(-0.6, math.pi, 200001)
    around = distance * axis + radius * (
        -sign * np.cos(angles)[:, None] * level + np.sin(angles)[:, None] * up
    )
    curve = around * half_axes
    return curve[np.argmax(curve[:, 2] >= foot) :]


def rib_points(rib: int) -> np.ndarray:
    """(n, 3) mm: irregular points of rib 0..15, rounded to 0.001 mm."""
    length, curve = SHAPES[rib][0], rib_curve(rib)
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
    chance = random.Random(SEED * 1000 + rib)
    steps = [0.55 + chance.random() for _ in range(POINT_COUNTS[rib] - 1)]
    ratios = np.concatenate([[0.0], np.cumsum(steps) / sum(steps)])
    chosen = curve[np.searchsorted(arc, ratios * length)]
    return np.round(chosen, 3)


def rows() -> dict[str, list[tuple]]:
    """The cells below the headings of every sheet."""
    numbers = range(1, RIBS + 1)
    members = []
    for number, segments in zip(numbers, SEGMENTS):
        for segment, (section, given) in enumerate(segments, 1):
            axis = f"A{number}" if segment == 1 else None
            more = [given.get(column) for column in HEADINGS["Members"][4:]]
            members.append((f"M{number}", segment, axis, section, *more))
    splits = []
    for number in numbers:
        if number not in WITHOUT_JOINTS:
            joints = JOINTS_MM.get(number, RATIOS)
            splits += [(f"M{number}", face, text) for face, text in joints.items()]
    points = [
        (f"A{number}", index, *(float(figure) for figure in point))
        for number in numbers
        for index, point in enumerate(rib_points(number - 1), 1)
    ]
    a, b, c = (f"{half_axis:g}" for half_axis in HALF_AXES)
    return {
        "Settings": list(SETTINGS),
        "Materials": [("S355", 7850, 206000, 355)],
        "Surfaces": [("Hall", "ellipsoid", f"a={a} b={b} c={c}", None, None)],
        "Axes": [(f"A{number}", "Hall", "surface", "pull", None) for number in numbers],
        "Points": points,
        "Sections": [(*row, "S355") for row in SECTIONS],
        "Members": members,
        "Splits": splits,
    }


def workbook(cells=None, headings=HEADINGS, choices=CHOICES) -> Workbook:
    """The schedule with headings frozen and lists to choose from."""
    book = Workbook()
    book.remove(book.active)
    for title, lines in (cells or rows()).items():
        sheet = book.create_sheet(title)
        sheet.append(headings[title])
        for line in lines:
            sheet.append(line)
        sheet.freeze_panes = "A2"
        for cell in sheet[1]:
            cell.font = Font(bold=True)
            cell.fill = PatternFill("solid", fgColor="D9E2EC")
            letter = get_column_letter(cell.column)
            column = (title, cell.value)
            sheet.column_dimensions[letter].width = WIDE.get(column, max(11, len(cell.value) + 3))
            if column in NUMBER_FORMATS:
                for (below,) in sheet[f"{letter}2:{letter}{sheet.max_row}"]:
                    below.number_format = NUMBER_FORMATS[column]
            if column in choices:
                # What is told of a wrong entry is said in full: openpyxl 3.1 would tell nothing.
                listed = DataValidation(
                    "list",
                    formula1=f'"{choices[column]}"',
                    allow_blank=True,
                    showErrorMessage=True,
                    showInputMessage=True,
                    showDropDown=None,
                )
                listed.add(f"{letter}2:{letter}1000")
                sheet.add_data_validation(listed)
    book.properties.creator = "BendTorsion"
    book.properties.created = FIXED_DATE
    return book


def write(target: Path, book: Workbook | None = None):
    """Writes the workbook with fixed dates, parts stored as they are: the same bytes each time."""
    raw, fixed = io.BytesIO(), io.BytesIO()
    book = book or workbook()
    book.save(raw)
    # Saving stamps the hour of the writing into the properties.
    stamped = f"{book.properties.modified:%Y-%m-%dT%H:%M:%SZ}".encode()
    date = f"{FIXED_DATE:%Y-%m-%dT%H:%M:%SZ}".encode()
    with zipfile.ZipFile(raw) as source, zipfile.ZipFile(fixed, "w") as archive:
        for name in source.namelist():
            content = source.read(name)
            if name == "docProps/core.xml":
                content = content.replace(stamped, date)
            item = zipfile.ZipInfo(name, FIXED_DATE.timetuple()[:6])
            item.external_attr = 0o644 << 16
            archive.writestr(item, content)
    target.write_bytes(fixed.getvalue())


if __name__ == "__main__":
    here = Path(__file__).resolve().parent
    write(Path(sys.argv[1]) if len(sys.argv) > 1 else here / "concert_hall.xlsx")
