# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is asked of a node, and the limits nodes are checked by."""

from __future__ import annotations

import math
from dataclasses import dataclass

TYPES = ("direct", "stub")
DIAPHRAGMS = ("flanges", "flanges and webs", "none")


ALMOST = 1e-6
"""mm or rad; what is as near to its limit is at it."""


@dataclass(frozen=True)
class NodeRules:
    """Limits of nodes.

    least_angle: of crossing, rad. near: members that pass closer without touching are told, mm.
    end_distance: from a branch to the end of the member that runs through, mm. shortest_branch:
    left of a branch beyond a node, mm. overhang: the part of its plate's thickness that a branch
    may stand over the face it lands on. same: branches on one member nearer together make one
    node, mm. flange_step (mm) and flange_angle (rad): of branch against through flanges. gap:
    root gap where none is given, mm. widest_gap: largest root gap, mm, gap_over_thickness: over the
    thinner plate. snipe, wall_gap: of diaphragms, mm. access: least room to
    weld beside one, mm. manhole: least diameter that is access; manhole_edge: least plate left
    between a manhole and the edge or a line another plate lands on, mm.
    """

    least_angle: float = math.radians(30.0)
    near: float = 20.0
    end_distance: float = 50.0
    shortest_branch: float = 600.0
    overhang: float = 0.5
    same: float = 200.0
    flange_step: float = 2.0
    flange_angle: float = math.radians(2.0)
    gap: float = 3.0
    widest_gap: float = 20.0
    gap_over_thickness: float = 2.0
    manhole: float = 400.0
    manhole_edge: float = 50.0
    snipe: float = 30.0
    wall_gap: float = 2.0
    access: float = 100.0


@dataclass(frozen=True)
class NodeInput:
    """What is asked of the meeting of two members: `through` runs through. name may be left
    out, and so may s (mm on the through member, or a ratio of its length) where they meet once.
    gap: None for the rules'. stub_length: mm, of type `stub`. diaphragms: one of DIAPHRAGMS. blend:
    the branch is made flush with the through member over its last 2h."""

    through: str
    other: str
    name: str = ""
    s: float | None = None
    type: str = "direct"
    gap: float | None = None
    stub_length: float = 0.0
    diaphragms: str = "flanges"
    blend: bool = False
    s_is_ratio: bool = False

    def place(self, length: float) -> float:
        """The place asked for, mm on the through member of this length."""
        return self.s * length if self.s_is_ratio else self.s
