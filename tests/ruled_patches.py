# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ruled patches of known shape as rails s -> (6,), for tests and benchmarks."""

import numpy as np

from BendTorsionWB.core.geometry.piecewise import resolve


def rails(function, length, spans=9):
    """Rails from a function s (n,) -> (n, 6), to rounding."""
    return resolve(function, np.linspace(0.0, length, spans), 1e4)


def cylinder(radius=12000.0, width=800.0, length=6000.0, skew=800.0, wave=0.2):
    """On a cylinder about y; the rails wander along it, rulings are its generators."""

    def function(s):
        angle, y = s / radius, skew * s / length
        w = width * (1.0 + wave * np.sin(3.0 * s / length))
        x, z = radius * np.sin(angle), radius * np.cos(angle)
        return np.column_stack([x, y, z, x, y + w, z])

    return rails(function, length)


def cone(length=6000.0, radius=3000.0, half_angle=0.4):
    """On a cone with its apex at the origin, rulings its generators, both rails wavy."""

    def function(s):
        angle = s / radius
        unit = np.column_stack(
            [
                np.sin(half_angle) * np.cos(angle),
                np.sin(half_angle) * np.sin(angle),
                np.full(len(s), np.cos(half_angle)),
            ]
        )
        near, far = 4000.0 + 200.0 * np.sin(2.0 * angle), 5000.0 + 300.0 * np.cos(angle)
        return np.concatenate([unit * near[:, None], unit * far[:, None]], axis=1)

    return rails(function, length)


def helicoid(twist, width=800.0, length=6000.0):
    """A straight plate turning `twist` rad/m about its centre line, the x axis."""

    def function(s):
        y, z = 0.5 * width * np.cos(1e-3 * twist * s), 0.5 * width * np.sin(1e-3 * twist * s)
        return np.column_stack([s, -y, -z, s, y, z])

    return rails(function, length)


def bent_in_plane(width, radius=5000.0, twist=0.2, length=6000.0):
    """Centre line on a circle in the plate's plane, turning `twist` rad/m; width(s) mm."""

    def function(s):
        angle, roll = (s / radius)[:, None], (1e-3 * twist * s)[:, None]
        centre = radius * np.concatenate([np.sin(angle), 1.0 - np.cos(angle), 0.0 * angle], axis=1)
        inwards = np.concatenate([-np.sin(angle), np.cos(angle), 0.0 * angle], axis=1)
        across = np.cos(roll) * inwards + np.sin(roll) * np.array([0.0, 0.0, 1.0])
        half = 0.5 * width(s)[:, None]
        return np.concatenate([centre - half * across, centre + half * across], axis=1)

    return rails(function, length, 17)


def plane(width=800.0, length=6000.0):
    """A flat plate, tapering to half its width."""

    def function(s):
        w = width * (1.0 - 0.5 * s / length)
        return np.column_stack([s, 0.0 * s, 0.0 * s, s, w, 0.0 * s])

    return rails(function, length)
