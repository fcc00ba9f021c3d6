# SPDX-License-Identifier: LGPL-2.1-or-later
"""All flat patterns of a member as SVG text, to one scale, coloured by strain: a row per face."""

from __future__ import annotations

from html import escape

import numpy as np

from ..core.colour_scale import ColourScale, hex_text, strain_text
from ..core.lofting import DevelopedPlate, MemberRecord

WIDTH, MARGIN, GAP, TEXT = 1100.0, 8.0, 10.0, 11.0
LEGEND_WIDTH, LEGEND_HEIGHT = 240.0, 9.0
_STEPS = 24
_DARK = 0.45
"""Lightness below which text is white."""


def patterns_svg(record: MemberRecord, highest: float) -> str:
    """The net patterns, faces from top to bottom, plates from the start to the end; the colours run
    from no strain to `highest`. Empty text without plates."""
    rows: dict[str, list[DevelopedPlate]] = {}
    for plate in record.plates:
        rows.setdefault(plate.face, []).append(plate)
    if not rows:
        return ""
    scale = min(
        (WIDTH - 2 * MARGIN - GAP * (len(own) - 1)) / sum(plate.length for plate in own)
        for own in rows.values()
    )
    colours = ColourScale(0.0, highest)
    shapes, texts, top = [], [], MARGIN
    for face, own in rows.items():
        texts.append(_text(MARGIN, top + TEXT, face, "start", "#5b6876"))
        top += 1.4 * TEXT
        depth = max(plate.width for plate in own) * scale
        left = MARGIN
        for plate in own:
            ring = _ring(plate, scale)
            points = np.column_stack([left + ring[:, 0], top + depth - ring[:, 1]])
            colour = colours.colours(np.array(plate.strain_max))
            shapes.append(f'<polygon points="{_points(points)}" fill="{hex_text(colour)}"/>')
            middle = left + 0.5 * plate.length * scale
            ink = "#ffffff" if float(colour.mean()) < _DARK else "#000000"
            level = top + depth - 0.5 * plate.width * scale + 0.35 * TEXT
            if plate.length * scale > 0.62 * TEXT * len(plate.mark):
                texts.append(_text(middle, level, plate.mark, "middle", ink))
            left += plate.length * scale + GAP
        top += depth + 0.6 * TEXT
    legend = _legend(colours, top)
    height = top + 3.4 * TEXT
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:g} {height:.0f}" '
            f'font-family="DejaVu Sans, sans-serif" font-size="{TEXT:g}" role="img">',
            '<g stroke="#1d2733" stroke-width="0.7">',
            *shapes,
            "</g>",
            *texts,
            *legend,
            "</svg>",
        ]
    )


def _ring(plate: DevelopedPlate, scale: float) -> np.ndarray:
    """The outline in px, thinned to what a picture shows."""
    runs = []
    for run in plate.outline:
        reach = float(np.hypot(*np.diff(run, axis=0).T).sum()) * scale
        count = max(2, min(len(run), int(reach / 8.0) + 2))
        runs.append(run[np.linspace(0, len(run) - 1, count).round().astype(int)])
    points = np.concatenate(runs)
    return (points - points.min(axis=0)) * scale


def _legend(colours: ColourScale, top: float) -> list[str]:
    step = LEGEND_WIDTH / _STEPS
    fills = colours.colours(np.linspace(colours.low, colours.high, _STEPS))
    bars = [
        f'<rect x="{MARGIN + k * step:.1f}" y="{top:.1f}" width="{step + 0.3:.1f}" '
        f'height="{LEGEND_HEIGHT:g}" fill="{hex_text(fill)}"/>'
        for k, fill in enumerate(fills)
    ]
    foot = top + LEGEND_HEIGHT + 1.2 * TEXT
    words = [
        _text(MARGIN, foot, "strain 0", "start", "#000000"),
        _text(MARGIN + LEGEND_WIDTH, foot, strain_text(colours.high), "end", "#000000"),
    ]
    return [*bars, *words]


def _points(points: np.ndarray) -> str:
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in points)


def _text(x: float, y: float, text: str, anchor: str, colour: str) -> str:
    place = f'x="{x:.1f}" y="{y:.1f}" fill="{colour}" text-anchor="{anchor}"'
    return f"<text {place}>{escape(text)}</text>"
