# SPDX-License-Identifier: LGPL-2.1-or-later
"""Frames at stations, and how they run on as a screw: with constant curvatures and twist.

A frame whose rates are constant in itself moves along a one-parameter group of rigid motions, so
what follows needs no integration (Murray, Li & Sastry 1994, ch. 2). It is exact on straight lines,
circles and helices, depends on nothing but the end, and meets it with equal curvature and twist.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class FrameStations:
    """Frames at stations s (n,): origin, x, y, z (n, 3) and curvatures ky, kz, twist (n,).

    x' = ky y + kz z, y' = -ky x + twist z, z' = -kz x - twist y (rates per mm).
    """

    s: np.ndarray
    origin: np.ndarray
    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    ky: np.ndarray
    kz: np.ndarray
    twist: np.ndarray


def running_on(at: FrameStations, distance: np.ndarray) -> FrameStations:
    """The frames `distance` (n,) mm behind those given (negative: before), on their screws."""
    turn = np.column_stack([at.twist, -at.kz, at.ky])
    size = np.sqrt((turn * turn).sum(axis=1))
    angle = size * distance
    small = np.abs(angle) < 1e-3
    safe = np.where(small, 1.0, angle)
    square = angle * angle
    # sin a / a, (1 - cos a) / a², (a - sin a) / a³.
    one = np.where(small, 1.0 - square / 6.0 * (1.0 - square / 20.0), np.sin(safe) / safe)
    two = np.where(
        small, 0.5 - square / 24.0 * (1.0 - square / 30.0), 2.0 * (np.sin(0.5 * safe) / safe) ** 2
    )
    three = np.where(
        small, 1.0 / 6.0 - square / 120.0 * (1.0 - square / 42.0), (safe - np.sin(safe)) / safe**3
    )
    by = turn * distance[:, None]

    def turned(vector: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        first = np.cross(by, vector)
        return vector, first, np.cross(by, first)

    def in_space(vector: np.ndarray) -> np.ndarray:
        return vector[:, :1] * at.x + vector[:, 1:2] * at.y + vector[:, 2:] * at.z

    axes = []
    for k in range(3):
        own, first, second = turned(np.tile(np.eye(3)[k], (len(distance), 1)))
        axes.append(in_space(own + one[:, None] * first + two[:, None] * second))
    own, first, second = turned(np.tile(np.eye(3)[0], (len(distance), 1)))
    way = distance[:, None] * (own + two[:, None] * first + three[:, None] * second)
    return FrameStations(at.s + distance, at.origin + in_space(way), *axes, at.ky, at.kz, at.twist)
