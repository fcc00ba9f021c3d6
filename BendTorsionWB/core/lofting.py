# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lofting data of plates and members: the frozen records every file and sheet is written from.

Pattern coordinates (u, v) are those of the pattern frame: seen from the marking face, u along the
chord between the midpoints of the end lines, the corner of the bounding box at (0, 0).
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .finding import Finding


@dataclass(frozen=True, eq=False)
class StationLine:
    """A measuring line across a plate: `E-1` and `E-2` at its ends, `L-k` at member stations.

    s: arc length on the axis, mm. flat: (2, 2) its ends on the first and second edge.
    length_3d, length_flat: mm, on the flattened surface.
    """

    label: str
    s: float
    flat: np.ndarray
    length_3d: float
    length_flat: float


@dataclass(frozen=True, eq=False)
class FoldLine:
    """A ruling the plate is folded along. angle: rad, positive where the outer face is convex."""

    label: str
    s: float
    angle: float
    flat: np.ndarray


@dataclass(frozen=True, eq=False)
class LoftingPoint:
    """A numbered point of a plate.

    label: `P-1`…; line: label of its line; edge: `left` `right` `top` `bottom`; kind: `arris` (on
    the outer face's corner line) or `witness` (on the marking face, 50 mm inside the edge).
    xyz: (3,) model; local: (3,) placing frame; flat: (2,) pattern frame; mm.
    """

    label: str
    line: str
    edge: str
    kind: str
    s: float
    xyz: np.ndarray
    local: np.ndarray
    flat: np.ndarray


@dataclass(frozen=True)
class PanelMeasure:
    """One length of a panel (`panel` = `E-1/L-3`). what: `edge left`, `diagonal 1`, …

    flat: mm on the pattern; arc: mm along the flattened surface (edges along the curve, diagonals
    geodesic); chord_outer: straight mm between the arris points on the formed outer face.
    """

    panel: str
    what: str
    flat: float
    arc: float
    chord_outer: float


@dataclass(frozen=True, eq=False)
class DevelopedPlate:
    """One plate with its flat pattern and lofting data.

    outline: smooth runs (k, 2), head to tail, counter-clockwise, chord sagitta <= 0.001 mm; runs
    meet at corners and folds. placing: (4, 4) model -> placing frame (X from the first point of
    the start line to its second, Z outward). flat_to_placing: (4, 4) (u, v, 0, 1) -> placing
    frame. Lengths mm, area mm2, mass kg; length_error_* compare flat with formed lengths of
    edges, lines and geodesic diagonals on the flattened surface; length_error_bound is the proven
    lower bound of length_error_max for any flat pattern. strain_max is the largest principal
    strain of flattening. locked_in_stress: MPa. bending_radius_min: mm. in_transition: the plate
    lies, in part or whole, in a transition zone.
    """

    member: str
    mark: str
    part: str
    face: str
    letter: str
    piece: int
    thickness: float
    material: str
    outline: tuple[np.ndarray, ...]
    lines: tuple[StationLine, ...]
    folds: tuple[FoldLine, ...]
    points: tuple[LoftingPoint, ...]
    panels: tuple[PanelMeasure, ...]
    length: float
    width: float
    area: float
    mass: float
    volume: float
    s_start: float
    s_end: float
    length_error_max: float
    length_error_rms: float
    length_error_bound: float
    strain_max: float
    locked_in_stress: float
    bending_radius_min: float
    forming: str | None
    marking_face: str
    placing: np.ndarray
    flat_to_placing: np.ndarray
    in_transition: bool = False


@dataclass(frozen=True, eq=False)
class MemberRecord:
    """One member with its developed plates and the figures reported for it.

    wireframe: named (n, 3) model polylines for overview drawings: `axis`, the corner lines
    `TL` `TR` `BR` `BL`, end outlines and joints. sections: text of the sections in order, such
    as `800x800x20 / 600x600x16`. Angles in radians, lengths mm, mass kg. An object in error has
    no plates and at least one error finding.
    """

    member: str
    sections: str
    section_type: str
    length: float | None = None
    mass: float | None = None
    axis_to_surface_rms: float | None = None
    axis_to_surface_max: float | None = None
    torsion_error_max: float | None = None
    total_torsion: float | None = None
    plates: tuple[DevelopedPlate, ...] = ()
    wireframe: dict[str, np.ndarray] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()
