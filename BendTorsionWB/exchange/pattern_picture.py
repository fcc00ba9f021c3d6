# SPDX-License-Identifier: LGPL-2.1-or-later
"""A flat pattern as SVG text: contour, openings, measuring, fold and roll lines."""

from __future__ import annotations

from html import escape

import numpy as np

from ..core.lofting import DevelopedPlate

WIDTH, MARGIN, TEXT = 1200.0, 30.0, 14.0
_STYLES = {"fold": "#9334a8", "roll": "#0a7d8c", "line": "#3a7d44"}


def pattern_svg(plate: DevelopedPlate) -> str:
    """The net pattern of a plate, 1200 px wide; u runs to the right, v up."""
    points = np.concatenate(plate.outline)
    low, high = points.min(axis=0), points.max(axis=0)
    scale = (WIDTH - 2 * MARGIN) / float(high[0] - low[0])
    foot = MARGIN + 2.0 * TEXT + float(high[1] - low[1]) * scale
    height = foot + 1.5 * TEXT + MARGIN

    def placed(flat: np.ndarray) -> np.ndarray:
        away = (flat - low) * scale
        return np.column_stack([MARGIN + away[:, 0], foot - away[:, 1]])

    folds = {fold.label for fold in plate.folds}
    lines = [("line", line.label, line.flat) for line in plate.lines if line.label not in folds]
    lines += [("fold", fold.label, fold.flat) for fold in plate.folds]
    if plate.forming_data is not None:
        lines += [("roll", "", roll.flat) for roll in plate.forming_data.roll_lines]
    loops = [plate.outline, *(hole.runs for hole in plate.holes)]
    rings = [_points(placed(np.concatenate(runs))) for runs in loops]
    title = f"{plate.mark}: {plate.length:.1f} x {plate.width:.1f} x {plate.thickness:g} mm, "
    title += f"{plate.material}, marking face {plate.marking_face}"
    texts = [_text(MARGIN, MARGIN, title, "#000000", "start")]
    taken: list[float] = []
    # Folds are named before the measuring lines beside them.
    for kind, label, flat in sorted(lines, key=lambda line: line[0]):
        x, y = placed(flat)[np.argmin(flat[:, 1])]
        if label and all(abs(x - other) > 3.0 * TEXT for other in taken):
            taken.append(x)
            texts.append(_text(x, y + 1.3 * TEXT, label, _STYLES[kind], "middle"))
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:g} {height:.0f}" '
            f'font-family="DejaVu Sans, sans-serif" font-size="{TEXT:g}" role="img">',
            '<g fill="none" stroke-width="1">',
            *(
                f'<polyline points="{_points(placed(flat))}" stroke="{_STYLES[kind]}"/>'
                for kind, _, flat in lines
            ),
            "</g>",
            '<g fill="none" stroke="#000000" stroke-width="1.6">',
            *(f'<polygon points="{ring}"/>' for ring in rings),
            "</g>",
            *texts,
            "</svg>",
        ]
    )


def _points(points: np.ndarray) -> str:
    return " ".join(f"{x:.2f},{y:.2f}" for x, y in points)


def _text(x: float, y: float, text: str, colour: str, anchor: str) -> str:
    place = f'x="{x:.2f}" y="{y:.2f}" fill="{colour}" text-anchor="{anchor}"'
    return f"<text {place}>{escape(text)}</text>"
