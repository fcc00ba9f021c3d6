# SPDX-License-Identifier: LGPL-2.1-or-later
"""Corners of a section at its seams: what of one plate stands beside the other for a fillet, and
whether both plates are cut at the seam or one alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..members.cells import SectionLaw
from ..sections.section import Strip
from ..sections.strip_lines import edge_points


@dataclass(frozen=True)
class SeamEnds:
    """The edges (strip, 0 or 1) of the two plates of a seam that stop at the other plate, and the
    part of the root gap each keeps."""

    name: str
    edges: tuple[tuple[int, int], ...]
    shares: tuple[float, ...]


def seam_ends(strips: Sequence[Strip]) -> tuple[SeamEnds, ...]:
    """The seams of a section at which a plate stops at another, by the letters of both."""
    index = {strip.face: k for k, strip in enumerate(strips)}
    found: dict[tuple[int, int], list[tuple[int, int, str]]] = {}
    for k, strip in enumerate(strips):
        for edge, stop in enumerate(strip.stops):
            if stop is not None and stop.face in index:
                pair = min(k, index[stop.face]), max(k, index[stop.face])
                found.setdefault(pair, []).append((k, edge, stop.at))
    seams = []
    for (one, two), ends in found.items():
        # Where one runs to the other's outer face, the plate that stops inside keeps the gap.
        inner = [end for end in ends if end[2] != "outer"] or ends
        kept = inner if all(at == "mitre" for *_, at in inner) else inner[:1]
        name = strips[one].letter + strips[two].letter
        edges = tuple((k, edge) for k, edge, _ in ends)
        chosen = {(k, edge) for k, edge, _ in kept}
        shares = tuple(1.0 / len(kept) if end in chosen else 0.0 for end in edges)
        seams.append(SeamEnds(name, edges, shares))
    return tuple(seams)


@dataclass(frozen=True, eq=False)
class SeamCorner:
    """A seam at arc lengths s (n,): mitred, both plates end at it; ledge (n, 2): mm the plate that
    runs through stands over the outer and over the inner face of the one that ends at it."""

    mitred: bool
    s: np.ndarray
    ledge: np.ndarray

    def least(self, side: str, low: float, high: float) -> float:
        """The smallest ledge, mm, on the `outer` or the `inner` side between two arc lengths."""
        own = self.ledge[:, ("outer", "inner").index(side)]
        within = own[(self.s > low) & (self.s < high)]
        ends = np.interp([low, high], self.s, own)
        return float(np.concatenate([ends, within]).min())


def seam_corners(law: SectionLaw) -> Mapping[str, SeamCorner]:
    """The corners of a member's seams by their names, at the ends of its cells."""
    cells = np.repeat(np.arange(len(law.cells)), 2)
    s = np.array([place for cell in law.cells for place in (cell.start, cell.end)])
    zero = np.zeros(len(s))
    sites = law.sites(cells, s, zero, zero, zero)
    index = {strip.face: k for k, strip in enumerate(law.strips)}

    def points(strip: int, edge: int, depth: float) -> np.ndarray:
        own = [np.full(len(s), value) for value in (strip, edge)]
        return edge_points(law.table, sites, *own, np.full(len(s), depth))

    found = {}
    for seam in seam_ends(law.strips):
        ends = [(strip, edge, law.strips[strip].stops[edge]) for strip, edge in seam.edges]
        mitred = all(stop.at == "mitre" for *_, stop in ends)
        # Of two that stop at each other, the one that stops inside is the one that abuts.
        strip, edge, stop = next((end for end in ends if end[2].at == "inner"), ends[0])
        other, level = index[stop.face], 1.0 if stop.at == "inner" else 0.0
        outer, inner = points(strip, edge, 0.0), points(strip, edge, 1.0)
        across = outer - inner
        across = across / np.sqrt((across * across).sum(axis=1))[:, None]
        reach = [((points(other, k, level) - outer) * across).sum(axis=1) for k in (0, 1)]
        back = [((inner - points(other, k, level)) * across).sum(axis=1) for k in (0, 1)]
        ledge = np.column_stack([np.maximum(*reach), np.maximum(*back)]).clip(min=0.0)
        found[seam.name] = SeamCorner(mitred, s, ledge)
    return found
