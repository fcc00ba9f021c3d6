# SPDX-License-Identifier: LGPL-2.1-or-later
"""The fields of a flat pattern between its lines, where its texts stand."""

from __future__ import annotations

import numpy as np

from ..core.lofting import DevelopedPlate

SAME_PLACE = 0.01
"""mm; lines and points closer than this are one."""


def panels(plate: DevelopedPlate) -> list[tuple[np.ndarray, np.ndarray]]:
    """The fields between consecutive lines and folds along +s, as pairs of (2, 2) lines."""
    marks = sorted((*plate.lines, *plate.folds), key=lambda mark: mark.s)
    fields = []
    for a, b in zip(marks[:-1], marks[1:]):
        if np.hypot(*(b.flat.mean(axis=0) - a.flat.mean(axis=0))) > SAME_PLACE:
            fields.append((a.flat, b.flat))
    return fields


def centre_of(plate: DevelopedPlate) -> np.ndarray:
    """A point amid the pattern: between the middles of the lines or folds before and behind half
    way along +s; of a flat part the middle of its size."""
    marks = sorted((*plate.lines, *plate.folds), key=lambda mark: mark.s)
    if not marks:
        points = np.concatenate(plate.outline)
        return 0.5 * (points.min(axis=0) + points.max(axis=0))
    half = 0.5 * (plate.s_start + plate.s_end)
    before = [mark for mark in marks if mark.s < half] or marks[:1]
    behind = [mark for mark in marks if mark.s >= half] or marks[-1:]
    return 0.5 * (before[-1].flat.mean(axis=0) + behind[0].flat.mean(axis=0))


def field_size(panel: tuple[np.ndarray, np.ndarray]) -> tuple[float, float]:
    """Length along the member and smaller width of a field, mm."""
    a, b = panel
    length = np.hypot(*(b.mean(axis=0) - a.mean(axis=0)))
    return float(length), float(min(np.hypot(*(a[1] - a[0])), np.hypot(*(b[1] - b[0]))))


def longest(fields: list[tuple[np.ndarray, np.ndarray]]) -> list[tuple[np.ndarray, np.ndarray]]:
    """Up to three long fields, first those in order whose lengths differ in their last bits."""
    lengths = [field_size(panel)[0] for panel in fields]
    order = sorted(range(len(fields)), key=lambda k: (round(max(lengths) - lengths[k]), k))
    return [fields[k] for k in order[:3]]
