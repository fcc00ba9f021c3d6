# SPDX-License-Identifier: LGPL-2.1-or-later
"""What makes a sheet hard to read, found from its model alone: for tests of every kind of sheet.

Written apart from the code that places labels, so that a fault there is not repeated here.
"""

import re

import numpy as np

from BendTorsionWB.core.drawings.sheet import LINE_STYLES, Sheet, Text, text_box

LEAST_HEIGHT = 1.8
"""mm on paper."""
SHRUNK = 0.15
"""mm; a line may come as near as this into the box of a text, which is wider than its ink."""


def faults(sheet: Sheet) -> list[str]:
    """All that is wrong with a sheet, in words; empty of a readable one."""
    texts = [text for text in sheet.all_texts() if text.text.strip()]
    lines = [line for view in sheet.views for line in view.on_page()] + list(sheet.all_lines())
    boxes = np.array([text_box(text) for text in texts]).reshape(-1, 4, 2)
    found = [f"too small: {text.text!r}" for text in texts if text.height < LEAST_HEIGHT]
    found += [f"cut off: {text.text!r}" for text in texts if text.text.endswith("..")]
    found += [f"{a!r} on {b!r}" for a, b in _on_each_other(texts, boxes)]
    found += [f"{text!r} crossed by a line" for text in _crossed(texts, boxes, lines)]
    found += [f"outside: {what}" for what in _outside(sheet, texts, boxes, lines)]
    return [f"{sheet.title} {sheet.number}: {what}" for what in found]


def _on_each_other(texts: list[Text], boxes: np.ndarray):
    low, high = boxes.min(axis=1), boxes.max(axis=1)
    before = (low[:, None, 0] < high[None, :, 0]) & (low[:, None, 1] < high[None, :, 1])
    near = before & before.T
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


def _crossed(texts: list[Text], boxes: np.ndarray, lines) -> list[str]:
    """Texts with the ink of a line in them."""
    starts = np.array([p for line in lines for p in line.points[:-1]]).reshape(-1, 2)
    ends = np.array([p for line in lines for p in line.points[1:]]).reshape(-1, 2)
    ink = np.array([0.5 * LINE_STYLES[line.style][0] for line in lines for _ in line.points[1:]])
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    left, right = boxes.min(axis=1), boxes.max(axis=1)
    near = np.ones((len(boxes), len(starts)), dtype=bool)
    for axis in (0, 1):
        near &= low[:, axis] < right[:, axis, None]
        near &= high[:, axis] > left[:, axis, None]
    i, k = np.nonzero(near)
    box = boxes[i]
    along, up = box[:, 1] - box[:, 0], box[:, 3] - box[:, 0]
    size = np.stack([np.hypot(*along.T), np.hypot(*up.T)], axis=1)
    frame = np.stack([along, up], axis=1) / size[:, :, None]
    p = ((starts[k] - box[:, 0])[:, None] * frame).sum(axis=2)
    step = ((ends[k] - starts[k])[:, None] * frame).sum(axis=2)
    margin = (SHRUNK - ink[k])[:, None]
    # The part of each line between the sides of the box.
    step = np.where(np.abs(step) < 1e-12, 1e-12, step)
    first, second = (margin - p) / step, (size - margin - p) / step
    enter = np.minimum(first, second).max(axis=1).clip(min=0.0)
    leave = np.maximum(first, second).min(axis=1).clip(max=1.0)
    return [texts[n].text for n in np.unique(i[enter < leave])]


def _outside(sheet: Sheet, texts, boxes, lines):
    left, bottom, right, top = sheet.frame
    low, high = boxes.min(axis=1) < (left, bottom), boxes.max(axis=1) > (right, top)
    for number in np.flatnonzero((low | high).any(axis=1)):
        yield repr(texts[number].text)
    for line in lines:
        x, y = zip(*line.points)
        if min(x) < left - 1e-6 or max(x) > right + 1e-6:
            yield f"line at {min(x):.1f} to {max(x):.1f}"
        if min(y) < bottom - 1e-6 or max(y) > top + 1e-6:
            yield f"line at {min(y):.1f} to {max(y):.1f}"


def told(svg: str) -> str:
    """All texts of a page's symbol, whose long lines stand in parts, with single spaces."""
    return " ".join(re.findall(">([^<>]+)</text>", svg))
