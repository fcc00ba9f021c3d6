# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes concert_hall_nodes.xlsx: the sixteen ribs of the concert hall, crossed by three purlins.

Run `python3 make_concert_hall_nodes.py [TARGET]`. The same program writes the same bytes.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import make_concert_hall as hall
import numpy as np

# Level of the purlin in mm, its first and its last rib; the last purlin ends on its outer ribs.
PURLINS = ((3400, 1, 16, "beyond"), (7600, 1, 16, "beyond"), (11200, 6, 12, "inside"))
BEYOND = 2200.0
POINT_SPACING = 3000.0

SECTIONS = (
    ("R800", "box1", 800, 800, 20, None, None),
    ("R600", "box1", 600, 600, 16, None, None),
    ("R800-2", "box2", 800, 800, 20, None, None),
    ("R600-2", "box2", 600, 600, 16, None, None),
    ("P600", "box1", 600, 400, 14, None, None),
    ("P400", "box1", 400, 300, 12, None, None),
    ("P600-2", "box2", 600, 400, 14, None, None),
)
# Tops are flush, so that the glazing runs through: ribs, then purlins.
ALONE, NARROWER, SECOND = "R800", ("R800", "R600"), ("R800-2", "R600-2")
RIB_SECTIONS = (
    *(NARROWER, SECOND, "R800", NARROWER, SECOND, "R800-2", NARROWER, "R800"),
    *("R800", NARROWER, "R800-2", SECOND, NARROWER, "R800", SECOND, NARROWER),
)
PURLIN_SECTIONS = ("P600", "P600-2", "P400")
# Where a rib gets narrower, of its length: between its nodes.
CUT = "68%"
SETTINGS = (
    ("project", "Concert hall, entrance ribs and purlins"),
    ("author", None),
    ("station_spacing", 500),
)
NODES = (
    ("N-entrance", "M8", "P1", None, "stub", 4, 1150, "flanges", None),
    (None, "M9", "P1", None, "direct", 5, None, "flanges and webs", None),
    (None, "M8", "P2", None, "stub", None, 1150, "flanges", None),
    (None, "M10", "P1", None, "direct", None, None, "flanges", "yes"),
    (None, "M11", "P1", None, "direct", None, None, "none", "yes"),
)
HEADINGS = hall.HEADINGS | {
    "Nodes": (
        *("node", "through", "other", "s", "type", "gap", "stub_length", "diaphragms", "blend"),
    )
}
CHOICES = hall.CHOICES | {
    ("Nodes", "type"): "direct,stub",
    ("Nodes", "diaphragms"): "flanges,flanges and webs,none",
}


def at_level(rib: int, level: float) -> np.ndarray:
    """The point (3,) of rib 0..15 at a level, mm."""
    points = hall.rib_curve(rib)
    k = int(np.argmax(points[:, 2] >= level))
    share = (level - points[k - 1, 2]) / (points[k, 2] - points[k - 1, 2])
    return points[k - 1] + share * (points[k] - points[k - 1])


def purlin_points(level: float, first: int, last: int, ends: str) -> np.ndarray:
    """(n, 3) mm: points of a level line of the ellipsoid from rib to rib, to 0.001 mm."""
    a, b, c = hall.HALF_AXES
    flat = math.sqrt(1.0 - (level / c) ** 2)
    angles = [
        math.atan2(y / b, x / a) for x, y, _ in (at_level(r - 1, level) for r in (first, last))
    ]
    angle = np.linspace(*angles, 20001)
    if ends == "beyond":
        step = (angles[1] - angles[0]) * 0.2
        angle = np.linspace(angles[0] - step, angles[1] + step, 28001)
    line = np.column_stack(
        [a * flat * np.cos(angle), b * flat * np.sin(angle), np.full(len(angle), level)]
    )
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    start, end = (arc[np.argmin(np.abs(angle - at))] for at in angles)
    if ends == "beyond":
        start, end = start - BEYOND, end + BEYOND
    count = 1 + math.ceil((end - start) / POINT_SPACING)
    chosen = line[np.searchsorted(arc, np.linspace(start, end, count))]
    return np.round(chosen, 3)


def rows() -> dict[str, list[tuple]]:
    """The cells below the headings of every sheet."""
    given = hall.rows()
    members, splits = [], []
    for number, sections in enumerate(RIB_SECTIONS, 1):
        sections = (sections,) if isinstance(sections, str) else sections
        for segment, section in enumerate(sections, 1):
            first = segment == 1
            members.append(
                (
                    f"M{number}",
                    segment,
                    f"A{number}" if first else None,
                    section,
                    None if first else CUT,
                    None,
                    "top",
                    *(None,) * 6,
                    1 if first else None,
                )
            )
        splits += [(f"M{number}", face, "auto") for face in ("top", "bottom", "left", "right")]
    axes, points = list(given["Axes"]), list(given["Points"])
    for number, (purlin, section) in enumerate(zip(PURLINS, PURLIN_SECTIONS), 1):
        axes.append((f"B{number}", "Hall", "surface", "pull", None))
        members.append((f"P{number}", 1, f"B{number}", section, None, None, "top", *(None,) * 6, 2))
        points += [
            (f"B{number}", index, *(float(figure) for figure in point))
            for index, point in enumerate(purlin_points(*purlin), 1)
        ]
    return given | {
        "Settings": list(SETTINGS),
        "Axes": axes,
        "Points": points,
        "Sections": [(*row, "S355") for row in SECTIONS],
        "Members": members,
        "Splits": splits,
        "Nodes": list(NODES),
    }


if __name__ == "__main__":
    here = Path(__file__).resolve().parent
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else here / "concert_hall_nodes.xlsx"
    hall.write(target, hall.workbook(rows(), HEADINGS, CHOICES))
