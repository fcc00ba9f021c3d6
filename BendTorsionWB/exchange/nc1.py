# SPDX-License-Identifier: LGPL-2.1-or-later
"""One plate as an NC1 file (DSTV, 7th edition): header, contour, marks and text.

The front face `v` is the marking face, so its coordinates are those of the pattern; y runs up from
the lower edge. Contours run counter-clockwise and end on their first point; an arc's radius stands
on its first point, positive when it turns counter-clockwise.
"""

from __future__ import annotations

import numpy as np

from ..core.arc_fit import fit_outline
from ..core.finding import BendTorsionError, error
from ..core.lofting import DevelopedPlate

LONGEST_TEXT = 80
MARK_GAP = 5.0
"""Marks stop this far before the contour, mm."""
TEXT_HEIGHT = 12
DENSITY = 7.85e-6


def plate_nc1(plate: DevelopedPlate, order: str = "", drawing: str = "") -> bytes:
    """The NC1 file of a plate: ASCII, CRLF, mm. order and drawing: header texts.

    Raises BendTorsionError for a contour that leaves the quadrant its header declares.
    """
    outline = fit_outline(plate.outline, name=plate.mark)
    if outline[:, :2].min() < -0.005:
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
    lines = ["ST", *_header(plate, order, drawing)]
    lines += ["AK", *_contour(outline)]
    marks = [(line.label, line.flat) for line in plate.lines if line.label.startswith("L")]
    marks += [(fold.label, fold.flat) for fold in plate.folds]
    for _, flat in marks:
        lines += ["PU", *_polyline(_shortened(flat))]
    # Those of the end lines lie on the contour.
    witnesses = [p for p in plate.points if p.kind == "witness" and not p.line.startswith("E")]
    if witnesses:
        lines.append("BO")
        lines += [f"  v {p.flat[0]:9.2f}m{p.flat[1]:9.2f}{0:9.2f}" for p in witnesses]
    lines.append("SI")
    centre = np.mean([line.flat.mean(axis=0) for line in plate.lines], axis=0)
    lines.append(_text(centre, plate.mark))
    for label, flat in marks:
        lines.append(_text(flat.mean(axis=0), label))
    lines.append("EN")
    return ("\r\n".join(lines) + "\r\n").encode("ascii")


def _header(plate: DevelopedPlate, order: str, drawing: str) -> list[str]:
    thickness = plate.thickness
    texts = [
        order or plate.member,
        drawing or plate.member,
        str(plate.piece),
        plate.mark,
        plate.material,
        "1",
        f"PL{thickness:g}*{plate.width:.0f}",
        "B",
    ]
    weight = plate.mass / plate.area * 1e6 if plate.area else DENSITY * thickness * 1e6
    numbers = [
        f"{plate.length:.2f}",
        f"{plate.width:.2f}",
        *[f"{thickness:.2f}"] * 3,
        "0.00",
        f"{weight:.3f}",
        "2.000",
        *["0.000"] * 4,
    ]
    return [f"  {_ascii(text)}" for text in [*texts, *numbers, "", "", "", ""]]


def _contour(outline: np.ndarray) -> list[str]:
    rows = []
    points = np.maximum(outline[:, :2], 0.0)
    following = np.roll(points, -1, axis=0)
    for (x, y), bulge, end in zip(points, outline[:, 2], following, strict=True):
        chord = float(np.hypot(*(end - (x, y))))
        radius = chord * (1 + bulge**2) / (4 * bulge) if abs(bulge) > 1e-12 else 0.0
        rows.append((x, y, radius))
    rows.append((points[0, 0], points[0, 1], 0.0))
    return [f"  v {x:9.2f}u{y:9.2f}{r:12.2f}" + f"{0:9.2f}" * 4 for x, y, r in rows]


def _polyline(points: np.ndarray) -> list[str]:
    return [f"  v {x:9.2f}u{y:9.2f}{0:9.2f}" for x, y in np.maximum(points, 0.0)]


def _shortened(flat: np.ndarray) -> np.ndarray:
    along = flat[1] - flat[0]
    length = float(np.hypot(*along))
    step = along / length * min(MARK_GAP, length / 4)
    return np.array([flat[0] + step, flat[1] - step])


def _text(place: np.ndarray, text: str) -> str:
    return f"  v {place[0]:9.2f}u{place[1]:9.2f}{0:9.2f}{TEXT_HEIGHT:4d} {_ascii(text)}"


def _ascii(text: str) -> str:
    return text.encode("ascii", "replace").decode()[:LONGEST_TEXT]
