# SPDX-License-Identifier: LGPL-2.1-or-later
"""Control sections of a delivery piece, and the pages they share with its welds."""

from __future__ import annotations

import numpy as np

from ..beds.control_record import ControlSection
from ..lofting import MemberRecord
from .sheet import Polyline, Text, View, text_box, wrapped
from .sheet_labels import Labels, as_points, label_beyond
from .sheet_overview import SCALES
from .sheet_pack import Block, packed
from .sheet_page import Page
from .sheet_references import PLATE_LIST, reference
from .sheet_style import SheetStyle
from .sheet_weld import list_groups, weld_groups

CAPTION, FIGURES = 2.5, 1.8
SECTION_ROOM = 62.0
"""mm on paper that the largest section takes at most, where a choice of scale is left."""
DIMENSION_GAP = 6.0
ABOVE = 1.2
"""mm from a dimension line to its figure."""
_WHAT = {"E": "end", "F": "fold", "M": "mid-length"}
NOTE = (
    "Sections are seen along +s, up as the section's z axis; cross: the axis, to which dimensions "
    "are given. Weld symbols: the arrow points at the outer face of the plate that is cut; welds "
    "without a depth go through the whole plate. t: thickness, {}."
)


def section_pages(record: MemberRecord, heading: str, style: SheetStyle) -> list[Page]:
    """Pages of the sections and welds of a record; none when it has neither."""
    form = style.page
    lines = wrapped(
        style.say(NOTE, style.thickness_unit), FIGURES, form.note_width or form.right - form.left
    )
    foot = form.bottom + 1.0 if form.note_width else form.clear_bottom
    bottom = form.clear_bottom if form.note_width else foot + 3.2 * len(lines) + 2.0
    notes = [
        Text(form.left, foot + 3.2 * (len(lines) - 1 - k), FIGURES, line)
        for k, line in enumerate(lines)
    ]
    area = (form.left, bottom, form.right, form.top)
    groups = []
    scale = _scale(record.controls)
    if record.controls:
        groups.append([section_block(one, scale, style) for one in record.controls])
    symbols, *maps = weld_groups(record, scale, area, style) or [[]]
    groups += [symbols] if symbols else []
    # Lists are whole and follow the map, unless parts side by side or another order save a page.
    tried = []
    for whole in (True, False):
        lists = list_groups(record, area, whole, style)
        tried += [packed([*groups, *own], area) for own in ((*maps, *lists), (*lists, *maps))]
    pages = min(tried, key=len)
    return [
        Page(
            heading,
            (),
            f"1:{scale}" if any(block.views for block in page) else "–",
            tuple(view for block in page for view in block.views),
            tuple(line for block in page for line in block.lines),
            (*(text for block in page for text in block.texts), *notes),
            tuple(table for block in page for table in block.tables),
        )
        for page in pages
    ]


def _scale(sections: tuple[ControlSection, ...]) -> int:
    size = max((max(s.reach[0] + s.reach[1], s.reach[2] + s.reach[3]) for s in sections), default=1)
    return next((scale for scale in SCALES if size / scale <= SECTION_ROOM), SCALES[-1])


def _paper(ring: np.ndarray) -> np.ndarray:
    """(y, z) as seen along +s: y to the left."""
    return np.stack([-ring[:, 0], ring[:, 1]], axis=1)


def section_block(section: ControlSection, scale: int, style: SheetStyle) -> Block:
    """One section with its plates marked, height, breadth and place of the axis."""
    rings = [_paper(plate.ring) for plate in section.plates]
    polylines = [Polyline(as_points(np.vstack([ring, ring[:1]])), "medium") for ring in rings]
    left, right, up, down = (value / scale for value in section.reach)
    cross = [
        Polyline(((-3.0, 0.0), (3.0, 0.0)), "chain"),
        Polyline(((0.0, -3.0), (0.0, 3.0)), "chain"),
    ]
    segments = [np.stack([ring, np.roll(ring, -1, axis=0)], axis=1) / scale for ring in rings]
    segments += [np.array([line.points]) for line in cross]
    x_dim, y_dim = right + DIMENSION_GAP, -down - DIMENSION_GAP
    lines = [
        Polyline(((-left, y_dim), (right, y_dim))),
        Polyline(((x_dim, -down), (x_dim, up))),
        *(Polyline(((x, y_dim - 1.5), (x, -down - 1.0))) for x in (-left, 0.0, right)),
        *(Polyline(((right + 1.0, y), (x_dim + 1.5, y))) for y in (-down, 0.0, up)),
    ]
    lines += [
        Polyline(((x - 0.9, y_dim - 0.9), (x + 0.9, y_dim + 0.9)), "medium")
        for x in (-left, 0, right)
    ] + [
        Polyline(((x_dim - 0.9, y - 0.9), (x_dim + 0.9, y + 0.9)), "medium") for y in (-down, 0, up)
    ]
    labels = Labels(np.concatenate([*segments, *(np.array([line.points]) for line in lines)]))
    y_left, y_right, z_up, z_down = section.reach
    for value, x, y, angle in (
        (y_left, -0.5 * left, y_dim + ABOVE, 0.0),
        (y_right, 0.5 * right, y_dim + ABOVE, 0.0),
        (z_up, x_dim - ABOVE, 0.5 * up, 90.0),
        (z_down, x_dim - ABOVE, -0.5 * down, 90.0),
    ):
        if value > 0.5:
            text = Text(x, y, FIGURES, style.length(value), angle, "middle")
            if not labels.put(text):
                # Outside the narrow gap, beyond the dimension line.
                step = (0.0, -3.4) if angle == 0.0 else (3.4, 0.0)
                labels.put(Text(x + step[0], y + step[1], FIGURES, text.text, angle, "middle"))
    middle = np.mean([ring.mean(axis=0) for ring in rings], axis=0) / scale
    left_out = 0
    for plate, ring in zip(section.plates, rings, strict=True):
        own = ring.mean(axis=0) / scale
        along = ring[1] - ring[0]
        normal = np.array([along[1], -along[0]]) / max(np.hypot(*along), 1e-9)
        normal = normal if (own - middle) @ normal > 0.0 else -normal
        reach = np.max((ring / scale - own) @ normal)
        text = f"{plate.mark} t{style.thickness(plate.thickness)}"
        out = own + normal * reach
        beyond = ((out, own - normal), (own - normal * reach, own + normal))
        # Dimensions stand right and below, so the marks of those sides go inside.
        inside = normal[0] > 0.5 or normal[1] < -0.5
        left_out += not any(
            label_beyond(labels, text, end, far) for end, far in beyond[:: -1 if inside else 1]
        )
    caption = f"{section.label} {style.say(_WHAT[section.label[0]])}  s {style.length(section.s)}"
    bounds = np.array(
        [text_box(text) for text in labels.texts]
        + [[(-left, y_dim - 2.0)] * 4, [(x_dim + 2.0, up)] * 4]
    )
    low, high = bounds.min(axis=(0, 1)), bounds.max(axis=(0, 1))
    texts = [*labels.texts, Text(float(low[0]), float(high[1]) + 2.0, CAPTION, caption)]
    if left_out:
        texts.append(
            Text(
                float(low[0]),
                float(low[1]) - 3.0,
                FIGURES,
                style.say("labels left out: {}, see sheet {}", left_out, reference(PLATE_LIST)),
            )
        )
    boxes = np.concatenate([text_box(text) for text in texts])
    low, high = np.minimum(low, boxes.min(axis=0)), np.maximum(high, boxes.max(axis=0))
    view = View(section.label, float(scale), (0.0, 0.0), tuple(polylines))
    box = (float(low[0]), float(low[1]), float(high[0]), float(high[1]) + 1.0)
    return Block("", (view,), (*cross, *lines, *labels.leaders), tuple(texts), box)
