# SPDX-License-Identifier: LGPL-2.1-or-later
"""The record of a branch at a node, as tables and files show it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

OK = "ok"
"""Status of what is a node."""


@dataclass(frozen=True)
class FlangeStep:
    """A corner of a branch where it lands: way of its side, its face and that it is compared with,
    the edge of its face, the step (mm, positive where the branch stands above), the angle between
    the faces (rad), and whether both plates are in line, so that the limits hold. through_face: a
    face of the through member, or, with its name before it, of the branch (`on`) it lands on
    there; on is empty for the through member."""

    way: int
    face: str
    through_face: str
    edge: str
    step: float
    angle: float
    in_line: bool
    on: str = ""


@dataclass(frozen=True)
class NodeRecord:
    """A branch at a node, or a meeting that is none: places on both axes, distance of the axes,
    root gap and stub in mm, angle in rad; x, y, z of the node; faces it lands on, per side from its
    start; steps and angles
    of its faces to the through member's; diaphragms: how many it asks for inside; limits: of
    steps (mm) and angles (rad) where plates are in line. manhole: the least diameter of those in
    its diaphragms, mm, None without any. status: `ok`, or the code of the error that leaves no
    node; where nothing says which member runs through, `through` and `other` are just the two."""

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
    manhole: float | None = None
    status: str = OK

    @property
    def largest_step(self) -> float | None:
        """Largest step of plates in line, mm, or None where none are."""
        return max((abs(step.step) for step in self.steps if step.in_line), default=None)

    @property
    def largest_angle(self) -> float | None:
        """Largest angle between plates in line, rad, or None where none are."""
        return max((step.angle for step in self.steps if step.in_line), default=None)


def in_order(nodes: Iterable[NodeRecord], members: Sequence[str]) -> list[NodeRecord]:
    """Records by the member that runs through, in this order of names, the place on it, and the
    branch."""
    rank = {name: k for k, name in enumerate(members)}
    return sorted(
        nodes,
        key=lambda own: (
            rank.get(own.through, len(rank)),
            own.s_through,
            rank.get(own.other, len(rank)),
        ),
    )
