# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the drawing of a node is about: each branch with its ends there, and the node's frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..lofting import MemberRecord
from ..nodes.node_ends import PlateEnd, axis_at, corner_lines
from ..nodes.node_record import NodeRecord


@dataclass(frozen=True, eq=False)
class Joining:
    """A branch at a node as drawn: its record of the node, its member, its ends there."""

    node: NodeRecord
    record: MemberRecord
    ends: tuple[PlateEnd, ...]


def node_frame(through: MemberRecord, place: np.ndarray) -> np.ndarray:
    """(3, 3) rows at the node: along the member that runs through, its y, and up off its top."""
    _, x = axis_at(through, place)
    axis = through.wireframe["axis"]
    k = 2 * int(np.argmin(((axis - place) ** 2).sum(axis=1)))
    lines = corner_lines(through)
    top = [line[k] for name, line in lines.items() if name.startswith("T")]
    bottom = [line[k] for name, line in lines.items() if name.startswith("B")]
    up = np.array([0.0, 0.0, 1.0])
    if top and bottom:
        up = np.mean(top, axis=0) - np.mean(bottom, axis=0)
    up = up - x * (up * x).sum()
    if np.linalg.norm(up) < 1e-6:
        up = np.array([0.0, 1.0, 0.0]) - x * x[1]
    up = up / np.linalg.norm(up)
    return np.array([x, np.cross(up, x), up])
