# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shortest paths on ruled surfaces and the mid-surface of a box face, apart from the program's own.

The path is a polygon with its corners on even rulings; Newton's method finds where on them it is
shortest, and three counts of rulings extrapolate to the smooth curve.
"""

import numpy as np

COUNTS = (16, 32, 64)


def path_length(rails, start, end):
    """Length of the shortest path between start = (s, w) and end on rails(s (n,)) -> (n, 2, 3)."""
    lengths = [_polygon(rails, start, end, count) for count in COUNTS]
    first, second = ((4 * b - a) / 3 for a, b in zip(lengths, lengths[1:]))
    return (16 * second - first) / 15


def _polygon(rails, start, end, count):
    s = np.linspace(start[0], end[0], count + 1)
    pair = rails(s)
    origin, ruling = pair[:, 0], pair[:, 1] - pair[:, 0]
    w = np.linspace(start[1], end[1], count + 1)
    for _ in range(30):
        chords = np.diff(origin + w[:, None] * ruling, axis=0)
        size = np.linalg.norm(chords, axis=1)
        unit = chords / size[:, None]
        inner = ruling[1:-1]
        slope = ((unit[:-1] - unit[1:]) * inner).sum(axis=1)
        # Second derivatives of |chord|: the part of each ruling across it, by its length.
        before = inner - (inner * unit[:-1]).sum(axis=1, keepdims=True) * unit[:-1]
        after = inner - (inner * unit[1:]).sum(axis=1, keepdims=True) * unit[1:]
        hessian = np.diag((before**2).sum(axis=1) / size[:-1] + (after**2).sum(axis=1) / size[1:])
        off = -(after[:-1] * before[1:]).sum(axis=1) / size[1:-1]
        hessian += np.diag(off, 1) + np.diag(off, -1)
        step = np.linalg.solve(hessian, slope)
        w[1:-1] -= step
        if np.abs(step).max() < 1e-13:
            break
    return np.linalg.norm(np.diff(origin + w[:, None] * ruling, axis=0), axis=1).sum()


def frames_by_differences(position, normals, s, roll=0.0):
    """Origin, x, y, z (n, 3) at s: x from neighbouring positions, z the normal less its x part."""
    origin = position(s)
    x = position(s + 0.5) - position(s - 0.5)
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    z = normals(origin)
    z = z - (z * x).sum(axis=1, keepdims=True) * x
    z /= np.linalg.norm(z, axis=1, keepdims=True)
    y = np.cross(z, x)
    return origin, x, np.cos(roll) * y + np.sin(roll) * z, np.cos(roll) * z - np.sin(roll) * y


def box_mid_rails(position, normals, corners, face, type, thickness, gaps=(0.0, 0.0), roll=0.0):
    """rails(s) -> (n, 2, 3): the mid-surface of one face of a box whose section does not vary.

    corners: TL, TR, BR, BL in (y, z); thickness: by face; gaps: gap1, gap2 of the section. Plates
    are thick at right angles to themselves: where the twist tilts a face by a, its inset in the
    section is t √(1 + a²).
    """
    ends = {"top": (0, 1), "bottom": (3, 2), "left": (0, 3), "right": (1, 2)}
    between = type == "box1" and face in ("top", "bottom")
    between |= type == "box2" and face in ("left", "right")
    neighbours = ("left", "right") if face in ("top", "bottom") else ("top", "bottom")
    centre = np.mean(corners, axis=0)

    def rails(s):
        origin, x, y, z = frames_by_differences(position, normals, s, roll)
        step = 2.0
        before, after = (
            frames_by_differences(position, normals, s + d, roll) for d in (-step, step)
        )
        twist = -((after[3] - before[3]) * y).sum(axis=1) / (2 * step)
        ky, kz = (((after[1] - before[1]) * v).sum(axis=1) / (2 * step) for v in (y, z))

        def line(of, depth):
            """Two points (n, 2, 2) of a face's line in the section, at a depth from outside."""
            outer = np.array([corners[k] for k in ends[of]])
            along = outer[1] - outer[0]
            normal = np.array([-along[1], along[0]]) / np.linalg.norm(along)
            normal *= np.sign(normal @ (centre - outer[0]))
            points = []
            for corner in outer:
                tilt = twist * (normal @ [-corner[1], corner[0]])
                tilt = tilt / (1 - ky * corner[0] - kz * corner[1])
                inset = depth * thickness[of] * np.sqrt(1 + tilt**2)
                points.append(corner + inset[:, None] * normal)
            return np.stack(points, axis=1), normal

        own, _ = line(face, 0.5)
        result = []
        for k, (neighbour, gap) in enumerate(zip(neighbours, gaps)):
            if between:
                limit, inward = line(neighbour, 1.0)
                limit = limit + gap * inward
            else:
                # Down from the corner, square to the face.
                corner = np.array(corners[ends[face][k]])
                other = np.array(corners[ends[face][1 - k]]) - corner
                limit = np.stack([corner, corner + [-other[1], other[0]]])
                limit = np.broadcast_to(limit, (len(s), 2, 2))
            result.append(_crossing(own, limit))
        return np.stack([origin + p[:, :1] * y + p[:, 1:] * z for p in result], axis=1)

    return rails


def _crossing(one, two):
    """Where lines (n, 2, 2) cross lines (n, 2, 2)."""
    a, b = one[:, 1] - one[:, 0], two[:, 1] - two[:, 0]
    gap = two[:, 0] - one[:, 0]
    part = (gap[:, 0] * b[:, 1] - gap[:, 1] * b[:, 0]) / (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    return one[:, 0] + part[:, None] * a
