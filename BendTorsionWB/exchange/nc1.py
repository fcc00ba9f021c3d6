# SPDX-License-Identifier: LGPL-2.1-or-later
"""One plate as an NC1 file (DSTV, 7th edition): header, contour, marks and text.

The front face `v` is the marking face, so its coordinates are those of the pattern; y runs up from
the lower edge. Contours run counter-clockwise and end on their first point; an arc's radius stands
on its first point, positive when it turns counter-clockwise.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..core.finding import BendTorsionError, error
from ..core.geometry.arc_contour import extents, reversed_contour
from ..core.geometry.arc_fit import FIT_TOLERANCE, STRAIGHT_SAGITTA
from ..core.lofting import DevelopedPlate, FoldLine
from ..core.patterns.cut_contour import cut_arcs, cut_contour
from ..core.patterns.forming import fold_direction
from ..core.patterns.gross import marked_ends
from ..core.patterns.inner_contours import hole_contour, line_stroke
from ..core.welds.bevel_record import EdgeBevel
from .nc1_labels import LineLabel, PlacedText, placed_texts
from .nc1_text import ascii_text

MARK_GAP = 5.0
"""Marks stop this far before the contour, mm."""
DENSITY = 7.85e-6


def plate_nc1(plate: DevelopedPlate, order: str = "", drawing: str = "") -> bytes:
    """The NC1 file of a plate: ASCII, CRLF, mm. order and drawing: header texts.

    Raises BendTorsionError for a contour that leaves the quadrant its header declares.
    """
    cut = cut_contour(plate)
    outline, run = cut_arcs(plate, FIT_TOLERANCE)
    plate = cut.plate
    green = marked_ends(plate)
    # A vertex may be off the pattern by the fit's tolerance.
    if outline[:, :2].min() < -FIT_TOLERANCE:
        raise BendTorsionError(
            error(
                "nc1-contour",
                plate.mark,
                "the contour has negative coordinates",
                "report this with the document",
                value=float(outline[:, :2].min()),
                limit=0.0,
                unit="mm",
            )
        )
    lines = ["ST", *_header(plate, outline, order, drawing)]
    bevels = [_bevel_fields(cut.bevels[k], plate) for k in run]
    lines += ["AK", *_contour(outline, bevels)]
    for hole in plate.holes:
        if hole.circle is None:
            lines += ["IK", *_contour(reversed_contour(hole_contour(hole)))]
    folds = {fold.label for fold in plate.folds}  # these carry their own text
    marks = [
        LineLabel(line.label, line.flat, 0.2)
        for line in plate.lines
        if (line.label.startswith("L") or line.label in green) and line.label not in folds
    ]
    marks += [LineLabel(_fold_text(plate, fold), fold.flat, 0.5) for fold in plate.folds]
    if plate.forming_data is not None:
        marks += [LineLabel(r.text(), r.flat, 0.5) for r in plate.forming_data.roll_lines]
    strokes = [np.column_stack([_shortened(mark.flat), np.zeros(2)]) for mark in marks]
    for stroke in strokes:
        lines += ["PU", *_polyline(stroke[:, :2])]
    drawn = [line_stroke(mark) for mark in plate.marks if mark.kind == "line"]
    for stroke in drawn:
        lines += ["PU", *_stroke(stroke)]
    # Those of the end lines lie on the contour.
    witnesses = [
        p
        for p in plate.points
        if p.kind == "witness" and (not p.line.startswith("E") or p.line in green)
    ]
    punches = [*(p.flat for p in witnesses), *(m.flat[0] for m in plate.marks if m.kind == "punch")]
    circles = [hole.circle for hole in plate.holes if hole.circle is not None]
    if punches or circles:
        lines.append("BO")
        lines += [f"  v {u:9.2f}u{v:9.2f}{diameter:9.2f}" for u, v, diameter in circles]
        lines += [f"  v {u:9.2f}m{v:9.2f}{0:9.2f}" for u, v in punches]
    lines.append("SI")
    lines += map(_text, placed_texts(plate, outline, [*strokes, *drawn], punches, marks))
    lines.append("EN")
    return ("\r\n".join(lines) + "\r\n").encode("ascii")


def _fold_text(plate: DevelopedPlate, fold: FoldLine) -> str:
    way = fold_direction(fold.angle, plate.marking_face)
    return f"{fold.label} {abs(math.degrees(fold.angle)):.1f} deg {way}"


def _header(plate: DevelopedPlate, outline: np.ndarray, order: str, drawing: str) -> list[str]:
    thickness = plate.thickness
    # Of the contour as it stands below, which readers compare, not of the pattern it is fitted to.
    length, width = extents(outline)
    texts = [
        order or plate.member,
        drawing or plate.member,
        str(plate.piece),
        plate.mark,
        plate.material,
        "1",
        f"PL{thickness:g}*{width:.0f}",
        "B",
    ]
    weight = plate.mass / plate.area * 1e6 if plate.area else DENSITY * thickness * 1e6
    numbers = [
        f"{length:.2f}",
        f"{width:.2f}",
        *[f"{thickness:.2f}"] * 3,
        "0.00",
        f"{weight:.3f}",
        "2.000",
        *["0.000"] * 4,
    ]
    part = f"part {plate.part}, {plate.quantity} off" if plate.quantity > 1 else ""
    free = [f"contour {plate.contour_face}", f"marking face {plate.marking_face}", part, ""]
    return [f"  {ascii_text(text)}" for text in [*texts, *numbers, *free]]


SQUARE = (0.0, 0.0, 0.0, 0.0)


def _contour(outline: np.ndarray, bevels: Sequence[tuple[float, ...]] = ()) -> list[str]:
    """Lines of a closed contour; bevels: the four fields of the arc from each vertex on."""
    rows = []
    points = np.maximum(outline[:, :2], 0.0)
    following = np.roll(points, -1, axis=0)
    fields = bevels or [SQUARE] * len(points)
    for point, bulge, end, own in zip(points, outline[:, 2], following, fields, strict=True):
        rows.append((*point, _radius(point, end, bulge), *own))
    rows.append((points[0, 0], points[0, 1], 0.0, *SQUARE))
    return [
        f"  v {x:9.2f}u{y:9.2f} {r:11.2f}" + "".join(f"{value + 0.0:9.2f}" for value in own)
        for x, y, r, *own in rows
    ]


def _bevel_fields(bevel: EdgeBevel | None, plate: DevelopedPlate) -> tuple[float, ...]:
    """angle1, depth1 from the front face, angle2, depth2 from the back: degrees, positive where
    that face is cut back. Together the depths are the thickness, less the land of a double
    groove; without a groove the whole edge is told from the front."""
    if bevel is None:
        return SQUARE
    natural, (outer, inner) = bevel.natural, bevel.cut_depths
    outer, inner = (bevel.outer[0], outer), (bevel.inner[0], inner)
    front, back, tilt = (inner, outer, natural) if _inside(plate) else (outer, inner, -natural)
    if not front[1] and not back[1]:
        if not natural:
            return SQUARE
        front = (tilt, plate.thickness)
    elif not front[1]:
        front = (tilt, plate.thickness - back[1])
    elif not back[1]:
        back = (-tilt, plate.thickness - front[1])
    return math.degrees(front[0]), front[1], math.degrees(back[0]), back[1]


def _inside(plate: DevelopedPlate) -> bool:
    return plate.marking_face == "inside"


def _polyline(points: np.ndarray) -> list[str]:
    return [f"  v {x:9.2f}u{y:9.2f}{0:9.2f}" for x, y in np.maximum(points, 0.0)]


def _stroke(arcs: np.ndarray) -> list[str]:
    """An open arc polyline, the radius of each arc on its first point."""
    points = np.maximum(arcs[:, :2], 0.0)
    radii = [*map(_radius, points[:-1], points[1:], arcs[:-1, 2]), 0.0]
    return [f"  v {x:9.2f}u{y:9.2f} {r:11.2f}" for (x, y), r in zip(points, radii, strict=True)]


def _radius(start: np.ndarray, end: np.ndarray, bulge: float) -> float:
    """Signed radius of an arc, positive counter-clockwise; 0 of a line, or of what is one."""
    chord = float(np.hypot(*(end - start)))
    rise = 0.5 * chord * abs(bulge)
    return chord * (1 + bulge**2) / (4 * bulge) if rise >= STRAIGHT_SAGITTA else 0.0


def _shortened(flat: np.ndarray) -> np.ndarray:
    along = flat[1] - flat[0]
    length = float(np.hypot(*along))
    step = along / length * min(MARK_GAP, length / 4)
    return np.array([flat[0] + step, flat[1] - step])


def _text(placed: PlacedText) -> str:
    (u, v), text = placed.corner, placed.text
    return f"  v {u:9.2f}u{v:9.2f}{round(placed.angle, 2) + 0.0:9.2f}{placed.height:4d} {text}"
