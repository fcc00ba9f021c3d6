# SPDX-License-Identifier: LGPL-2.1-or-later
"""A strain map as a picture, SVG or PNG: the pattern in colours, with a legend in numbers."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..core.colour_scale import hex_text, strain_text
from ..core.drawings.sheet import FONT_FAMILY
from ..core.patterns.strain_map import StrainMap
from .pdf import start_qt
from .svg import write_picture

WIDTH = 1200.0
MARGIN = 30.0
TEXT = 15.0
LEGEND_WIDTH, LEGEND_HEIGHT, LEGEND_STEPS = 600.0, 16.0, 60


@dataclass(frozen=True, eq=False)
class _Picture:
    """What is painted, px, y down: cells and legend bars (points (k, 2), colour), outline (k, 2),
    lines, and texts (x, y of the base line, anchor, text). Cells are clipped to the outline."""

    height: float
    cells: list[tuple[np.ndarray, str]]
    bars: list[tuple[np.ndarray, str]]
    outline: np.ndarray
    lines: list[np.ndarray]
    texts: list[tuple[float, float, str, str]]


def _picture(field: StrainMap) -> _Picture:
    corners = np.concatenate(field.outline)
    low, high = corners.min(axis=0), corners.max(axis=0)
    scale = (WIDTH - 2 * MARGIN) / float(high[0] - low[0])
    top = MARGIN + 2.4 * TEXT
    foot = top + float(high[1] - low[1]) * scale

    def placed(points: np.ndarray) -> np.ndarray:
        return np.stack(
            [MARGIN + (points[:, 0] - low[0]) * scale, top + (high[1] - points[:, 1]) * scale],
            axis=1,
        )

    colours = field.scale.colours(np.abs(field.strain))
    cells = [
        (
            placed(field.flat[[i, i + 1, i + 1, i], [j, j, j + 1, j + 1]]),
            hex_text(colours[i, j]),
        )
        for i in range(field.strain.shape[0])
        for j in range(field.strain.shape[1])
    ]
    title = (
        f"{field.mark}: strain of laying it flat, mode {field.mode}; largest "
        f"{strain_text(float(np.abs(field.strain).max()))}"
    )
    bars, texts = _legend(field, foot + 2.0 * TEXT)
    texts.append((MARGIN, MARGIN + TEXT, "start", title))
    height = foot + 5.5 * TEXT + MARGIN
    return _Picture(height, cells, bars, placed(corners), [*map(placed, field.lines)], texts)


def _legend(field: StrainMap, y: float) -> tuple[list, list]:
    steps = np.linspace(field.scale.low, field.scale.high, LEGEND_STEPS)
    edges = MARGIN + np.linspace(0.0, LEGEND_WIDTH, LEGEND_STEPS + 1)
    below = y + LEGEND_HEIGHT
    bars = [
        (np.array([(a, y), (b, y), (b, below), (a, below)]), hex_text(colour))
        for a, b, colour in zip(edges[:-1], edges[1:], field.scale.colours(steps), strict=True)
    ]
    ticks = field.scale.ticks().tolist()
    anchors = ["start", *["middle"] * (len(ticks) - 2), "end"][: len(ticks)]
    places = MARGIN + np.linspace(0.0, LEGEND_WIDTH, max(len(ticks), 2))
    texts = [
        (float(x), below + 1.3 * TEXT, anchor, strain_text(value))
        for x, anchor, value in zip(places, anchors, ticks)
    ]
    return bars, texts


def strain_svg(field: StrainMap) -> str:
    """The picture as SVG text, 1200 px wide; u runs to the right, v up."""
    picture = _picture(field)
    size = f"{WIDTH:g} {picture.height:.0f}"
    outline = _points(picture.outline)
    return "\n".join(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<svg xmlns="http://www.w3.org/2000/svg" version="1.1" width="{WIDTH:g}" '
            f'height="{picture.height:.0f}" viewBox="0 0 {size}" '
            f'font-family="{FONT_FAMILY}, Liberation Sans, sans-serif" font-size="{TEXT:g}">',
            f'<rect width="{WIDTH:g}" height="{picture.height:.0f}" fill="#ffffff"/>',
            f'<clipPath id="plate"><polygon points="{outline}"/></clipPath>',
            # Cells are outlined in their own colour, so that no seams show between them.
            '<g clip-path="url(#plate)" stroke-width="0.7">',
            *(_polygon(points, colour) for points, colour in picture.cells),
            "</g>",
            '<g stroke-width="0.7">',
            *(_polygon(points, colour) for points, colour in picture.bars),
            "</g>",
            '<g fill="none" stroke="#ffffff" stroke-width="0.8" stroke-opacity="0.6">',
            *(f'<polyline points="{_points(line)}"/>' for line in picture.lines),
            "</g>",
            f'<polygon points="{outline}" fill="none" stroke="#000000" stroke-width="1.5"/>',
            *(
                f'<text x="{x:.2f}" y="{y:.2f}" text-anchor="{anchor}">{text}</text>'
                for x, y, anchor, text in picture.texts
            ),
            "</svg>",
            "",
        ]
    )


def _points(points: np.ndarray) -> str:
    return " ".join(f"{x:.2f},{y:.2f}" for x, y in points)


def _polygon(points: np.ndarray, colour: str) -> str:
    return f'<polygon points="{_points(points)}" fill="{colour}" stroke="{colour}"/>'


def write_strain_picture(field: StrainMap, path: str | os.PathLike) -> None:
    """Write the picture, as PNG when the name ends so, else as SVG; whole or not at all.

    BendTorsionError when Qt for Python is missing (PNG); OSError when it cannot be written.
    """
    path = Path(path)
    png = path.suffix.lower() == ".png"
    write_picture(path, _png(_picture(field)) if png else strain_svg(field).encode())


def _png(picture: _Picture) -> bytes:
    qt_core, qt_gui = start_qt()
    image = qt_gui.QImage(int(WIDTH), int(round(picture.height)), qt_gui.QImage.Format_RGB32)
    image.fill(qt_gui.QColor("white"))
    painter = qt_gui.QPainter(image)
    try:
        painter.setRenderHint(qt_gui.QPainter.Antialiasing)

        def polygon(points: np.ndarray):
            return qt_gui.QPolygonF([qt_core.QPointF(float(x), float(y)) for x, y in points])

        outline = qt_gui.QPainterPath()
        outline.addPolygon(polygon(picture.outline))
        outline.closeSubpath()
        painter.setClipPath(outline)
        _fill(qt_gui, painter, picture.cells, polygon)
        painter.setClipping(False)
        _fill(qt_gui, painter, picture.bars, polygon)
        white = qt_gui.QColor("white")
        white.setAlphaF(0.6)
        painter.setPen(qt_gui.QPen(white, 0.8))
        painter.setBrush(qt_gui.QBrush())
        for line in picture.lines:
            painter.drawPolyline(polygon(line))
        painter.setPen(qt_gui.QPen(qt_gui.QColor("black"), 1.5))
        painter.drawPath(outline)
        font = qt_gui.QFont(FONT_FAMILY)
        font.setPixelSize(int(TEXT))
        painter.setFont(font)
        for x, y, anchor, text in picture.texts:
            wide = qt_gui.QFontMetricsF(font).horizontalAdvance(text)
            left = x - wide * {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor]
            painter.drawText(qt_core.QPointF(left, y), text)
    finally:
        # A painter that outlives its device crashes the process.
        painter.end()
    content = qt_core.QByteArray()
    buffer = qt_core.QBuffer(content)
    buffer.open(qt_core.QIODevice.WriteOnly)
    image.save(buffer, "PNG")
    return bytes(content.data())


def _fill(qt_gui, painter, shapes, polygon) -> None:
    for points, colour in shapes:
        painter.setPen(qt_gui.QPen(qt_gui.QColor(colour), 0.7))
        painter.setBrush(qt_gui.QBrush(qt_gui.QColor(colour)))
        painter.drawPolygon(polygon(points))
