# SPDX-License-Identifier: LGPL-2.1-or-later
"""Members that meet, for tests: straight ones on a plane, and twisted ones on an ellipsoid."""

import numpy as np
from curved_members import ELLIPSOID, HALF_AXES, diagonal, member

from BendTorsionWB.core.axes.axis import fit_axis
from BendTorsionWB.core.axes.frames import FrameInput, frames_of
from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.members.member import Member
from BendTorsionWB.core.members.zones import Segment, section_law
from BendTorsionWB.core.nodes.node_input import NodeRules
from BendTorsionWB.core.nodes.nodes import find_nodes
from BendTorsionWB.core.sections.section import box

PLANE = analytic_surface("plane", {})


def straight(name, start, end, section=None, segments=None, **law):
    """A member along a straight line, z upwards."""
    axis = fit_axis(f"A-{name}", np.array([start, end], float), None, fit="keep")
    frames = frames_of(axis, None, FrameInput("fixed"))
    segments = segments or [Segment(section or box("B", "box1", 600, 400, 16))]
    return Member(name, frames, section_law(name, segments, axis.length, **law))


def along_x(name="X", y=0.0, z=0.0, length=12000.0, **given):
    """A straight member along x, its middle at x = 0."""
    return straight(name, (-length / 2, y, z), (length / 2, y, z), **given)


def at_angle(degrees, name="Y", back=6000.0, ahead=6000.0, x=0.0, z=0.0, **given):
    """A straight member through (x, 0, z) at an angle to the x axis."""
    way = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees)), 0.0])
    middle = np.array([x, 0.0, z])
    return straight(name, middle - back * way, middle + ahead * way, **given)


def counter(t):
    """(n, 3): a curve on the ellipsoid that crosses the diagonal in its middle."""
    u, v = 0.55 + 0.3 * np.asarray(t), 0.75 - 0.55 * np.asarray(t)
    unit = np.column_stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)])
    return unit * HALF_AXES


def twisted_pair(first=None, second=None):
    """Two twisted members on the ellipsoid that cross, M1 and M2."""
    first = first or [Segment(box("B800", "box1", 800, 800, 20))]
    second = second or [Segment(box("B780", "box1", 800, 600, 16))]
    return {
        "M1": member(first, curve=diagonal, name="M1"),
        "M2": member(second, curve=counter, name="M2"),
    }


__all__ = ["ELLIPSOID", "PLANE", "along_x", "at_angle", "counter", "straight", "twisted_pair"]


def found(*members, ranks=None, rows=(), rules=None):
    """The nodes of members, each running through those after it unless `ranks` says otherwise."""
    ranks = ranks or {member.name: k for k, member in enumerate(members)}
    by_name = {member.name: member for member in members}
    return find_nodes(by_name, ranks, rows, rules or NodeRules())
