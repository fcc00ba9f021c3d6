# SPDX-License-Identifier: LGPL-2.1-or-later
"""The assembly bed of a delivery piece: the frozen records its tables, sheet and templates are
written from. The bed frame has x along the piece, z up, and its floor at z = 0."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..geometry.rigid import inverse


@dataclass(frozen=True, eq=False)
class Seat:
    """A seat of a saddle, on the down face beside one of its edges: place (3,) in the bed frame,
    its third number the height above the floor."""

    edge: str
    place: np.ndarray


@dataclass(frozen=True, eq=False)
class Saddle:
    """A saddle at arc length s: its seats left and right (+y is left, along +x), the slope (rad)
    from right to left, and the side stop: a place (3,) on the face beside the lower seat."""

    label: str
    s: float
    left: Seat
    right: Seat
    slope: float
    stop_side: str
    stop: np.ndarray


@dataclass(frozen=True)
class Pin:
    """A pin of the grid below the down face: grid column and row, place in plan, height above the
    pins' base, and how far the face is off level there (rad)."""

    column: int
    row: int
    x: float
    y: float
    height: float
    tilt: float


@dataclass(frozen=True, eq=False)
class ControlPoint:
    """A corner of the section at a line: places (3,) in the model and on the bed."""

    line: str
    corner: str
    s: float
    xyz: np.ndarray
    bed: np.ndarray


@dataclass(frozen=True, eq=False)
class Template:
    """The section's outline at a line as a flat shape to cut, seen along +s.

    section: (n, 2) u to the right, v up (outwards) about the axis, counter-clockwise; outline: the
    same moved out by `clearance`, mm.
    """

    name: str
    member: str
    line: str
    s: float
    section: np.ndarray
    outline: np.ndarray
    clearance: float


@dataclass(frozen=True, eq=False)
class Bed:
    """A piece on its bed. face: the one that lies down. plane: how the bed's plane was found.

    deviation: mm, half the band of the face's edge lines about the plane. to_bed: (4, 4) model ->
    bed frame. pin_base: height of the pins' base above the floor. lines: corner lines (n, 3) by
    name, in the bed frame; face_edges: (2, n, 3) the edges of the down face, left first.
    """

    member: str
    piece: int
    face: str
    plane: str
    start: float
    end: float
    deviation: float
    to_bed: np.ndarray
    saddles: tuple[Saddle, ...]
    points: tuple[ControlPoint, ...]
    templates: tuple[Template, ...]
    face_edges: np.ndarray
    pins: tuple[Pin, ...] = ()
    pin_base: float = 0.0
    lines: dict[str, np.ndarray] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """`M1`, or `M1-P2` for a delivery piece of several."""
        return self.member if not self.piece else f"{self.member}-P{self.piece}"

    @property
    def to_model(self) -> np.ndarray:
        """(4, 4) bed frame -> model."""
        return inverse(self.to_bed)
