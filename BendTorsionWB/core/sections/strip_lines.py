# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lines and edges of plate strips in the section plane, for many places at once.

A strip is a line between two corners, a thickness across it, and a limit at each edge: square at
the corner, or clear of another strip's inner face, outer face or mitre. Thickness is normal to
the plate: where the line moves across the plate by a = dn/ds ÷ (1 − κ·r), the frame's own turning
included, it measures t·√(1 + a²) in the section plane.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from .section import Section, Strip

_SQUARE, _INNER, _OUTER, _MITRE = range(4)
_LIMITS = {"inner": _INNER, "outer": _OUTER, "mitre": _MITRE}


@dataclass(frozen=True, eq=False)
class StripTable:
    """The strips of a section as arrays: (k,), and per edge (k, 2); no neighbour is the strip
    itself."""

    first: np.ndarray
    second: np.ndarray
    inward: np.ndarray
    line: np.ndarray
    neighbour: np.ndarray
    limit: np.ndarray


def strip_table(strips: Sequence[Strip]) -> StripTable:
    """The table of strips; each stop must name one of them."""
    index = {strip.face: k for k, strip in enumerate(strips)}
    stops = [strip.stops for strip in strips]
    return StripTable(
        np.array([strip.first for strip in strips]),
        np.array([strip.second for strip in strips]),
        np.array([float(strip.inward) for strip in strips]),
        np.array([strip.line for strip in strips]),
        np.array([[index[s.face] if s else k for s in pair] for k, pair in enumerate(stops)]),
        np.array([[_LIMITS[s.at] if s else _SQUARE for s in pair] for pair in stops]),
    )


@dataclass(frozen=True, eq=False)
class Sites:
    """The section at n places: corners and their motion d/ds (n, m, 2), thickness (n, k), that of
    the stock (n, k) before it is chamfered, gaps (n, k, 2), and what the axis does there:
    curvatures ky, kz and twist (n,)."""

    corners: np.ndarray
    motion: np.ndarray
    thickness: np.ndarray
    stock: np.ndarray
    gaps: np.ndarray
    ky: np.ndarray
    kz: np.ndarray
    twist: np.ndarray

    def __getitem__(self, chosen) -> Sites:
        return Sites(*(getattr(self, field.name)[chosen] for field in fields(self)))


def section_site(section: Section) -> Sites:
    """The one site of a section that does not vary, on a straight axis."""
    corners = np.array([section.corners], float)
    gaps = [[s.gap if s else 0.0 for s in strip.stops] for strip in section.strips]
    zero = np.zeros(1)
    thickness = np.array([[s.thickness for s in section.strips]])
    return Sites(
        corners,
        np.zeros_like(corners),
        thickness,
        thickness,
        np.array([gaps]),
        zero,
        zero,
        zero,
    )


def section_polygons(section: Section) -> np.ndarray:
    """The strips' cross-sections (k, 4, 2): outer first, outer second, inner second, inner first
    edge."""
    table, site = strip_table(section.strips), section_site(section)
    k = np.arange(len(section.strips))
    sites = site[np.zeros(len(k), int)]
    corner = [
        edge_points(table, sites, k, np.full(len(k), edge), np.full(len(k), float(depth)))
        for edge, depth in ((0, 0), (1, 0), (1, 1), (0, 1))
    ]
    return np.stack(corner, axis=1)


def own_lines(table: StripTable, sites: Sites, strip: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """Lines (n, 2, 2) of strips (n,), first to second corner, at depths (n,): 0 outer … 1 inner.

    The mid-surface, 0.5, is that of the stock: plates are developed and cut before they are
    chamfered."""
    n = np.arange(len(strip))
    corner = np.stack([table.first[strip], table.second[strip]], axis=1)
    line = sites.corners[n[:, None], corner]
    normal = table.inward[strip][:, None] * left_of(line)
    turning = sites.twist[:, None, None] * np.stack([-line[..., 1], line[..., 0]], axis=2)
    motion = sites.motion[n[:, None], corner] + turning
    across = motion[..., 0] * normal[:, :1] + motion[..., 1] * normal[:, 1:]
    stretch = 1.0 - sites.ky[:, None] * line[..., 0] - sites.kz[:, None] * line[..., 1]
    thickness = np.where(depth == 0.5, sites.stock[n, strip], sites.thickness[n, strip])
    inset = (depth - table.line[strip]) * thickness
    inset = inset[:, None] * np.sqrt(1.0 + (across / stretch) ** 2)
    return line + inset[:, :, None] * normal[:, None]


def limits(
    table: StripTable, sites: Sites, strip: np.ndarray, edge: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The lines (n, 2, 2) edges (n,) of strips end at, and the unit directions (n, 2) into them."""
    n = np.arange(len(strip))
    kind, other = table.limit[strip, edge], table.neighbour[strip, edge]
    line = own_lines(table, sites, other, np.where(kind == _INNER, 1.0, 0.0))
    into = table.inward[other][:, None] * left_of(line)
    square = kind == _SQUARE
    if square.any():
        ends = np.stack([table.first[strip], table.second[strip]], axis=1)[square]
        ends = sites.corners[n[square, None], ends]
        along = unit(ends[:, 1] - ends[:, 0])
        into[square] = np.where((edge[square] == 0)[:, None], along, -along)
        corner = ends[np.arange(len(ends)), edge[square]]
        across = np.column_stack([-along[:, 1], along[:, 0]])
        line[square] = np.stack(
            [corner, corner + table.inward[strip[square]][:, None] * across], axis=1
        )
    mitre = kind == _MITRE
    if mitre.any():
        sub, one, two = sites[mitre], strip[mitre], other[mitre]
        arris = [
            crossing(
                own_lines(table, sub, one, np.full(len(one), depth)),
                own_lines(table, sub, two, np.full(len(one), depth)),
            )
            for depth in (0.0, 1.0)
        ]
        line[mitre] = np.stack(arris, axis=1)
        into[mitre] = left_of(line[mitre])
    either = kind >= _OUTER
    if either.any():
        # From whichever side the strip comes: towards its other corner.
        far = np.where(edge == 0, table.second[strip], table.first[strip])[either]
        far = sites.corners[n[either], far]
        side = ((far - line[either, 0]) * into[either]).sum(axis=1)
        into[either] *= np.where(side < 0, -1.0, 1.0)[:, None]
    line = line + sites.gaps[n, strip, edge][:, None, None] * into[:, None]
    return line, into


def edge_points(
    table: StripTable,
    sites: Sites,
    strip: np.ndarray,
    edge: np.ndarray,
    depth: np.ndarray,
    relief: np.ndarray | float = 0.0,
) -> np.ndarray:
    """Points (n, 2) of edges of strips at depths; relief: how far each keeps clear of its limit."""
    line, into = limits(table, sites, strip, edge)
    line = line + (np.zeros(len(strip)) + relief)[:, None, None] * into[:, None]
    return crossing(own_lines(table, sites, strip, depth), line)


def unit(vectors: np.ndarray) -> np.ndarray:
    """Vectors (n, 2) of length one."""
    return vectors / np.sqrt(vectors[:, 0] ** 2 + vectors[:, 1] ** 2)[:, None]


def left_of(line: np.ndarray) -> np.ndarray:
    """Unit normals (n, 2) to the left of lines (n, 2, 2)."""
    along = unit(line[:, 1] - line[:, 0])
    return np.column_stack([-along[:, 1], along[:, 0]])


def crossing(line: np.ndarray, limit: np.ndarray) -> np.ndarray:
    """Where lines (n, 2, 2) cross limits (n, 2, 2), (n, 2)."""
    along, across = line[:, 1] - line[:, 0], limit[:, 1] - limit[:, 0]
    gap = limit[:, 0] - line[:, 0]
    determinant = along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0]
    part = (gap[:, 0] * across[:, 1] - gap[:, 1] * across[:, 0]) / determinant
    return line[:, 0] + part[:, None] * along
