# SPDX-License-Identifier: LGPL-2.1-or-later
"""Members for tests, made on exact curves of a 40/30/20 m ellipsoid, and their geometry by hand."""

import numpy as np

from BendTorsionWB.core.axes.axis import fit_axis
from BendTorsionWB.core.axes.frames import surface_frames
from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.members.member import Member
from BendTorsionWB.core.members.thickness import USUAL_RULES
from BendTorsionWB.core.members.zones import Segment, section_law
from BendTorsionWB.core.sections.section import box

HALF_AXES = np.array([40000.0, 30000.0, 20000.0])
ELLIPSOID = analytic_surface("ellipsoid", dict(zip("abc", HALF_AXES)))


def diagonal(t):
    """(n, 3): the ellipsoid along a diagonal of its longitude and latitude, 27 m, t in [0, 1]."""
    u, v = 0.35 + 0.7 * np.asarray(t), 0.2 + 0.55 * np.asarray(t)
    unit = np.column_stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)])
    return unit * HALF_AXES


def oblique(t):
    """(n, 3): an oblique plane section of the ellipsoid (a circle of the unit sphere), 21 m."""
    normal = np.array([0.55, 0.6, 0.58])
    normal /= np.linalg.norm(normal)
    one = np.cross(normal, [0.0, 0.0, 1.0])
    one /= np.linalg.norm(one)
    two = np.cross(normal, one)
    angle = 0.5 + 0.75 * np.asarray(t)[:, None]
    circle = np.cos(angle) * one + np.sin(angle) * two
    return (0.3 * normal + np.sqrt(1 - 0.09) * circle) * HALF_AXES


def on_torus(t):
    """(n, 3): a diagonal of the torus 30/8 m, 18 m long."""
    u, v = 0.2 + 0.45 * np.asarray(t), 0.4 + 1.1 * np.asarray(t)
    reach = 30000 + 8000 * np.cos(v)
    return np.column_stack([reach * np.cos(u), reach * np.sin(u), 8000 * np.sin(v)])


def irregular(curve, count=9, seed=0):
    """Points (count, 3) of a curve at irregular parameters, ends included, to 0.001 mm."""
    jitter = np.random.default_rng(seed).uniform(-0.35, 0.35, count - 2)
    inner = (np.arange(1, count - 1) + jitter) / (count - 1)
    return np.round(curve(np.concatenate([[0.0], inner, [1.0]])), 3)


def member(segments, curve=diagonal, surface=ELLIPSOID, name="M1", points=9, **law):
    """A member along the axis through irregular points of the curve."""
    axis = fit_axis("A1", irregular(curve, points), surface)
    return Member(
        name, surface_frames(axis, surface), section_law(name, segments, axis.length, **law)
    )


def tapered(type="box1", gap=3.0, slope=2.5, cut=9000.0, rules=USUAL_RULES, **placing):
    """800 x 800 x 20 then 600 x 600 x 16."""
    big = box("B800", type, 800, 800, 20, gap1=gap, gap2=gap + 1)
    small = box("B600", type, 600, 600, 16, gap1=gap, gap2=gap + 1)
    return member([Segment(big), Segment(small, cut, slope, **placing)], rules=rules)


def hand_frames(member, surface, s):
    """Origin, x, y, z (n, 3) at s, from positions of the axis and the surface's normals alone."""
    position = member.frames.axis.position
    origin = position(s)
    x = position(s + 0.5) - position(s - 0.5)
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    normal = surface.closest(origin).normals
    z = normal - (normal * x).sum(axis=1, keepdims=True) * x
    z /= np.linalg.norm(z, axis=1, keepdims=True)
    return origin, x, np.cross(z, x), z


def in_space(member, surface, s, plane):
    """(n, 3): the section point plane (n, 2) or (2,) at each s."""
    origin, _, y, z = hand_frames(member, surface, s)
    plane = np.broadcast_to(np.asarray(plane, float), (len(s), 2))
    return origin + plane[:, :1] * y + plane[:, 1:] * z


def rotation(seed=3):
    """A rotation matrix (3, 3) that is nothing special."""
    q, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return q * np.sign(np.linalg.det(q))
