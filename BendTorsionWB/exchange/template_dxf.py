# SPDX-License-Identifier: LGPL-2.1-or-later
"""A template as a DXF file: the board to cut, its centre lines, its name and which way is up."""

from __future__ import annotations

import numpy as np

from ..core.beds.bed_record import Template
from .dxf import CUT_OUTER, LAYERS, MARK_LINE, MARK_TEXT, layers_of
from .dxf_file import Space, dxf_bytes

MARK_GAP = 5.0
"""mm; centre lines stop this far before the contour."""


def template_dxf(board: Template) -> bytes:
    """The file of a template: DXF R2010, 1:1, mm, seen along +s, the lower left corner of its
    bounding box at (0, 0). Layers and settings are those of plates."""
    outline = board.outline - board.outline.min(axis=0)
    width, height = outline.max(axis=0)
    space = Space()
    space.add_polyline(np.column_stack([outline, np.zeros(len(outline))]), LAYERS[CUT_OUTER])
    for a, b in centre_lines(outline):
        space.add_line(a, b, LAYERS[MARK_LINE])
    layer = LAYERS[MARK_TEXT]
    size = min(25.0, width / 14.0, height / 14.0)
    rows = (board.name, f"{board.member} {board.line}  s {board.s:.1f}", "seen along +s")
    for k, text in enumerate(rows):
        corner = (0.08 * width, 0.5 * height - (2.0 + 1.8 * k) * size)
        space.add_text(text, corner, (1.0, 0.0), round(size, 2), layer)
    foot, tip = (0.75 * width, 0.58 * height), (0.75 * width, 0.58 * height + 6.0 * size)
    for a, b in (
        (foot, tip),
        (tip, (tip[0] - size, tip[1] - 2.0 * size)),
        (tip, (tip[0] + size, tip[1] - 2.0 * size)),
    ):
        space.add_line(a, b, layer)
    space.add_text("UP", (foot[0] + size, foot[1]), (1.0, 0.0), round(size, 2), layer)
    return dxf_bytes(layers_of(LAYERS), outline, space)


def centre_lines(outline) -> list:
    """The upright and the level line through the middle of the bounding box of a polygon (n, 2),
    as ends inside it: [((u, v), (u, v)), ...]."""
    middle = 0.5 * (outline.min(axis=0) + outline.max(axis=0))
    lines = []
    for along in (1, 0):
        across = 1 - along
        hits = []
        for a, b in zip(outline, [*outline[1:], outline[0]], strict=True):
            low, high = a[across] - middle[across], b[across] - middle[across]
            if (low <= 0.0) != (high <= 0.0):
                hits.append(a[along] + low / (low - high) * (b[along] - a[along]))
        if len(hits) >= 2 and max(hits) - min(hits) > 2 * MARK_GAP:
            ends = []
            for hit, gap in ((min(hits), MARK_GAP), (max(hits), -MARK_GAP)):
                end = middle.copy()
                end[along] = hit + gap
                ends.append(end)
            lines.append(tuple(ends))
    return lines
