# SPDX-License-Identifier: LGPL-2.1-or-later
"""The outline of a flat pattern, as smooth runs in the plane of its development."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..flattening.development import Development
from ..flattening.developments import Developments
from ..geometry.piecewise import parted
from ..geometry.vectors import lengths
from ..members.contour import EndCurves
from ..plates.plates import Plate

OUTLINE_SAGITTA = 0.0005
LONGEST_OUTLINE_CHORD = 40.0


def outline_in_plane(development: Development, plate: Plate) -> list[np.ndarray]:
    """Smooth runs, head to tail, counter-clockwise in the plane: first edge along +s, end line,
    second edge back, start line."""
    return outlines_in_plane(Developments((development,)), [plate])[0]


def outlines_in_plane(
    developments: Developments, plates: Sequence[Plate]
) -> list[list[np.ndarray]]:
    """outline_in_plane of many plates."""
    spans = [_spans(plate) for plate in plates]
    probes = _along(developments, [[(*span, 33) for span in own] for own in spans])
    counts = (_chord_counts(np.array(probes)) + 1).tolist()
    counts = parted(counts, [len(own) for own in spans])
    runs = _along(
        developments,
        [
            [(*span, n) for span, n in zip(own, chords, strict=True)]
            for own, chords in zip(spans, counts, strict=True)
        ],
    )
    runs = parted(runs, [len(own) for own in spans])
    return [_closed(*given) for given in zip(developments.each, plates, runs, strict=True)]


def _spans(plate: Plate) -> list[tuple[float, float, float]]:
    """Both edges between corners and folds: (from, to, w)."""
    corners = plate.line_places("mid")[[0, -1]].tolist()
    spans = []
    for k in (0, 1):
        edges = [corners[0][k], *plate.rails.mid_folds, corners[1][k]]
        spans += [(a, b, float(k)) for a, b in zip(edges[:-1], edges[1:], strict=True)]
    return spans


def _closed(development: Development, plate: Plate, runs: Sequence[np.ndarray]) -> list[np.ndarray]:
    """The runs of both edges with the end lines between them."""
    smooth = len(plate.rails.mid_folds) + 1
    forth, back = runs[:smooth], [run[::-1] for run in reversed(runs[smooth:])]
    end, start = (
        [_end_line(development, s, a, b)] if cut is None else _cut_line(development, cut, a, b)
        for s, cut, a, b in zip(
            (plate.end, plate.start),
            plate.cuts[::-1],
            (forth[-1][-1], back[-1][-1]),
            (back[0][0], forth[0][0]),
            strict=True,
        )
    )
    return [*forth, *end, *back, *start]


def _along(
    developments: Developments, spans: Sequence[Sequence[tuple[float, float, float, int]]]
) -> list[np.ndarray]:
    """Points (n, 2) at n even places from a to b along the lines of constant w (a, b, w, n) of
    each."""
    every = [span for own in spans for span in own]
    counts = [n for *_, n in every]
    a, b, w, _ = np.repeat(np.array(every), counts, axis=0).T
    ends = np.cumsum(counts)
    number = np.arange(ends[-1]) - np.repeat(ends - counts, counts)
    s = a + (b - a) * (number / np.repeat(np.array(counts) - 1, counts))
    s[ends - 1] = b[ends - 1]
    places = parted(s, [sum(n for *_, n in own) for own in spans])
    return parted(developments.flat(places, w), counts)


def _chord_counts(points: np.ndarray) -> np.ndarray:
    """Chords (k,) that keep the sagitta of runs through evenly spaced points (k, 33, 2)."""
    step = points[:, 1:] - points[:, :-1]
    chords = lengths(step)
    (x, y), (x_next, y_next) = ((one[..., 0], one[..., 1]) for one in (step[:, :-1], step[:, 1:]))
    turn = np.arctan2(x * y_next - y * x_next, x * x_next + y * y_next)
    curvature = (np.abs(turn) / (0.5 * (chords[:, 1:] + chords[:, :-1]))).max(axis=1) + 1e-12
    longest = np.minimum(LONGEST_OUTLINE_CHORD, np.sqrt(8 * OUTLINE_SAGITTA / curvature))
    return np.maximum(2, np.ceil(chords.sum(axis=1) / longest).astype(int))


def _end_line(development: Development, s: float, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The end line from a to b: straight, unless a correction bends the rulings."""
    if development.correction is None:
        return np.array([a, b])
    w = np.linspace(0.0, 1.0, 33)
    points = development.flat(np.full(33, s), w)
    points = points if np.allclose(points[0], a) else points[::-1]
    return np.concatenate([[a], points[1:-1], [b]])


def _cut_line(
    development: Development, cut: EndCurves, a: np.ndarray, b: np.ndarray
) -> list[np.ndarray]:
    """The end line along a cut from a to b, mapped point by point, a run per smooth stretch."""

    def mapped(low: float, high: float, count: int) -> np.ndarray:
        w = np.linspace(low, high, count)
        return development.flat(cut.at("mid", w), w)

    probes = [mapped(*part, 33)[None] for part in cut.stretches]
    runs = [
        mapped(*part, int(_chord_counts(probe)[0]) + 1)
        for part, probe in zip(cut.stretches, probes, strict=True)
    ]
    ends = runs[0][0], runs[-1][-1]
    if ((ends[0] - a) ** 2).sum() > ((ends[1] - a) ** 2).sum():
        runs = [run[::-1] for run in reversed(runs)]
    for before, after in zip(runs[:-1], runs[1:], strict=True):
        after[0] = before[-1]
    runs[0] = np.concatenate([[a], runs[0][1:]])
    runs[-1] = np.concatenate([runs[-1][:-1], [b]])
    return runs
