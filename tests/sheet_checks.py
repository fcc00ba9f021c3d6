# SPDX-License-Identifier: LGPL-2.1-or-later
"""What makes a sheet hard to read, found from its model alone: for tests of every kind of sheet.

Written apart from the code that places labels, so that a fault there is not repeated here.
"""

import numpy as np

from BendTorsionWB.core.drawings.sheet import LINE_STYLES, Sheet, Text, text_box

LEAST_HEIGHT = 1.8
"""mm on paper."""
SHRUNK = 0.15
"""mm; a line may come as near as this into the box of a text, which is wider than its ink."""


def faults(sheet: Sheet, places: bool = True) -> list[str]:
    """All that is wrong with a sheet, in words; empty of a readable one."""
    texts = [text for text in sheet.all_texts() if text.text.strip()]
    lines = [line for view in sheet.views for line in view.on_page()] + list(sheet.all_lines())
    boxes = np.array([text_box(text) for text in texts]).reshape(-1, 4, 2)
    found = [f"{sheet.title}: too small: {t.text!r}" for t in texts if t.height < LEAST_HEIGHT]
    found += [f"{sheet.title}: cut off: {t.text!r}" for t in texts if t.text.endswith("..")]
    found += [f"{sheet.title}: {a!r} on {b!r}" for a, b in _on_each_other(texts, boxes)]
    found += [f"{sheet.title}: {a!r} crossed by a line {b}" for a, b in _crossed(texts, boxes, lines)]
    found += [f"{sheet.title}: outside: {what}" for what in _outside(sheet, texts, boxes, lines)]
    return found


def _on_each_other(texts: list[Text], boxes: np.ndarray):
    low, high = boxes.min(axis=1), boxes.max(axis=1)
    near = np.all((low[:, None] < high[None]) & (low[None] < high[:, None]), axis=2)
    for i, j in zip(*np.nonzero(np.triu(near, 1)), strict=True):
        if _meet(boxes[i], boxes[j]):
            yield texts[i].text, texts[j].text


def _meet(first: np.ndarray, second: np.ndarray) -> bool:
    """Whether two rectangles (4, 2) have a point in common that is inner to both."""
    for box in (first, second):
        for axis in (box[1] - box[0], box[3] - box[0]):
            axis = axis / np.hypot(*axis)
            a, b = first @ axis, second @ axis
            if a.max() <= b.min() + 1e-9 or b.max() <= a.min() + 1e-9:
                return False
    return True


def _crossed(texts: list[Text], boxes: np.ndarray, lines):
    """Texts with a line through them, and where the line runs."""
    starts = np.array([p for line in lines for p in line.points[:-1]]).reshape(-1, 2)
    ends = np.array([p for line in lines for p in line.points[1:]]).reshape(-1, 2)
    half = np.array(
        [0.5 * LINE_STYLES[line.style][0] for line in lines for _ in line.points[1:]]
    )
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    for text, box in zip(texts, boxes, strict=True):
        left, top = box.min(axis=0), box.max(axis=0)
        near = np.flatnonzero(np.all((low < top) & (high > left), axis=1))
        if not len(near):
            continue
        along, up = box[1] - box[0], box[3] - box[0]
        wide, tall = np.hypot(*along), np.hypot(*up)
        frame = np.column_stack([along / wide, up / tall])
        a, b = (starts[near] - box[0]) @ frame, (ends[near] - box[0]) @ frame
        # Points along each line, 0.05 mm apart at most.
        for p, q, edge, k in zip(a, b, half[near], near, strict=True):
            t = np.linspace(0.0, 1.0, int(np.hypot(*(q - p)) / 0.05) + 2)[:, None]
            at, margin = p + (q - p) * t, SHRUNK - edge
            inside = np.all((at > margin) & (at < (wide - margin, tall - margin)), axis=1)
            if np.any(inside):
                yield text.text, (starts[k].round(1).tolist(), ends[k].round(1).tolist())
                break


def _outside(sheet: Sheet, texts, boxes, lines):
    left, bottom, right, top = sheet.frame
    for text, box in zip(texts, boxes, strict=True):
        (x0, y0), (x1, y1) = box.min(axis=0), box.max(axis=0)
        if x0 < left or y0 < bottom or x1 > right or y1 > top:
            yield repr(text.text)
    for line in lines:
        x, y = np.array(line.points).T
        if min(x) < left - 1e-6 or max(x) > right + 1e-6:
            yield f"line at {min(x):.1f} to {max(x):.1f}"
        if min(y) < bottom - 1e-6 or max(y) > top + 1e-6:
            yield f"line at {min(y):.1f} to {max(y):.1f}"
