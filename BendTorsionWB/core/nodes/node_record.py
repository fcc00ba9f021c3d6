# SPDX-License-Identifier: LGPL-2.1-or-later
"""The record of a branch at a node, as tables and files show it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class FlangeStep:
    """A corner of a branch where it lands: way of its side, its face and the through member's,
    the edge of its face, the step (mm, positive where the branch stands above), the angle between
    the faces (rad), and whether both plates are in line, so that the limits hold."""

    way: int
    face: str
    through_face: str
    edge: str
    step: float
    angle: float
    in_line: bool


@dataclass(frozen=True)
class NodeRecord:
    """A branch at a node: places on both axes, distance of the axes, root gap and stub in mm,
    angle in rad; x, y, z of the node; faces it lands on, per side from its start; steps and angles
    of its faces to the through member's; diaphragms: how many it asks for inside; limits: of
    steps (mm) and angles (rad) where plates are in line."""

    node: str
    kind: str
    through: str
    other: str
    s_through: float
    s_other: float
    x: float
    y: float
    z: float
    angle: float
    axis_distance: float
    type: str
    gap: float
    stub_length: float
    faces: tuple[str, ...]
    steps: tuple[FlangeStep, ...]
    diaphragms: int
    limits: tuple[float, float] | None = None

    @property
    def largest_step(self) -> float | None:
        """Largest step of plates in line, mm, or None where none are."""
        return max((abs(step.step) for step in self.steps if step.in_line), default=None)

    @property
    def largest_angle(self) -> float | None:
        """Largest angle between plates in line, rad, or None where none are."""
        return max((step.angle for step in self.steps if step.in_line), default=None)
