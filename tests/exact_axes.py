# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curves on surfaces with everything known in closed form: axes, normals, torsion by quadrature."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from BendTorsionWB.core.axes.axis import Axis
from BendTorsionWB.core.geometry.curve import Curve
from BendTorsionWB.core.geometry.nurbs import NurbsPatch
from BendTorsionWB.core.geometry.patches import PatchSurface
from BendTorsionWB.core.geometry.piecewise import resolve
from BendTorsionWB.core.geometry.surface import Ellipsoid, Surface, Torus

HALL = (40e3, 30e3, 20e3)
_GAUSS = np.polynomial.legendre.leggauss(16)


@dataclass(frozen=True, eq=False)
class ExactCurve:
    """A curve t in [0, 1] -> C, C', N (n, 3) and dN/dt, on a surface that core can evaluate."""

    name: str
    surface: Surface
    derivatives: Callable
    closed: bool = False
    knots: tuple[float, ...] = ()

    def panels(self, count: int = 512) -> np.ndarray:
        """Even parameters, and those where the surface is less than smooth."""
        return np.union1d(np.linspace(0.0, 1.0, count + 1), self.knots)

    def _quadrature(self, t: np.ndarray, integrand) -> np.ndarray:
        """Integral from 0 to each of the rising t, by composite Gauss."""
        edges = np.union1d(self.panels(), t)
        half = 0.5 * np.diff(edges)
        nodes = (0.5 * (edges[1:] + edges[:-1]))[:, None] + half[:, None] * _GAUSS[0]
        values = integrand(nodes.ravel()).reshape(nodes.shape)
        total = np.concatenate([[0.0], np.cumsum((values * _GAUSS[1]).sum(axis=1) * half)])
        return total[np.searchsorted(edges, t)]

    def length_to(self, t: np.ndarray) -> np.ndarray:
        """Arc length at rising t, mm."""
        return self._quadrature(
            np.atleast_1d(t), lambda at: np.linalg.norm(self.derivatives(at)[1], axis=1)
        )

    def torsion_to(self, t: np.ndarray) -> np.ndarray:
        """Torsion angle of the surface frame against the rotation-minimising one, rad: the
        integral of the geodesic torsion, in the sense of x, y, z right-handed."""

        def rate(at):
            _, speed, normal, turn = self.derivatives(at)
            x = speed / np.linalg.norm(speed, axis=1)[:, None]
            return -(turn * np.cross(normal, x)).sum(axis=1)

        return self._quadrature(np.atleast_1d(t), rate)

    def parameters_at(self, s: np.ndarray) -> np.ndarray:
        """t of arc lengths s (n,), by Newton on the quadrature."""
        edges = self.panels()
        arc = self.length_to(edges)
        t = np.interp(s, arc, edges)
        for _ in range(20):
            order = np.argsort(t)
            length = np.empty(len(t))
            length[order] = self.length_to(t[order])
            step = (length - s) / np.linalg.norm(self.derivatives(t)[1], axis=1)
            t = np.clip(t - step, 0.0, 1.0)
            if np.abs(step).max() < 1e-15:
                break
        return t

    def axis(self) -> Axis:
        """The exact curve as a core axis."""
        length = float(self.length_to(np.ones(1))[0])
        breaks = self.length_to(np.union1d(np.linspace(0, 1, 17), self.knots))
        breaks[0], breaks[-1] = 0.0, length
        edges = self.panels()
        arc = self.length_to(edges)

        def position(s):
            t = np.interp(s, arc, edges)
            where = np.clip(np.searchsorted(arc, s, side="right") - 1, 0, len(edges) - 2)
            for _ in range(8):
                # Gauss from the panel's start.
                half = 0.5 * (t - edges[where])
                nodes = edges[where][:, None] + half[:, None] * (1 + _GAUSS[0])
                speed = np.linalg.norm(self.derivatives(nodes.ravel())[1], axis=1)
                here = arc[where] + (speed.reshape(nodes.shape) * _GAUSS[1]).sum(axis=1) * half
                t = t - (here - s) / np.linalg.norm(self.derivatives(t)[1], axis=1)
            return self.derivatives(np.clip(t, 0.0, 1.0))[0]

        resolved = resolve(position, breaks, 5e4)
        ends = resolved(np.array([0.0, length]))
        line = Curve(1, np.array([0.0, 0.0, length, length]), ends)
        return Axis(self.name, line, resolved, ends, np.zeros(2), ends, (), self.closed)

    def points(self, count: int, seed: int, ratio: float = 8.0) -> np.ndarray:
        """Irregular exact points (count, 3) from end to end; gaps up to 1 : ratio."""
        rng = np.random.default_rng(seed)
        number = count if self.closed else count - 1
        gaps = ratio ** rng.uniform(0, 1, number)
        t = np.concatenate([[0.0], np.cumsum(gaps) / gaps.sum()])
        return self.derivatives(t[:-1] if self.closed else t)[0]


def parametric(patch, u, v, du, dv):
    """derivatives(t) of a curve u(t), v(t); patch: u, v -> S, Su, Sv, Suu, Suv, Svv."""

    def derivatives(t):
        s, su, sv, suu, suv, svv = patch(u(t), v(t))
        ut, vt = du(t)[:, None], dv(t)[:, None]
        cross = np.cross(su, sv)
        rate = np.cross(suu * ut + suv * vt, sv) + np.cross(su, suv * ut + svv * vt)
        size = np.linalg.norm(cross, axis=1)[:, None]
        normal = cross / size
        turn = (rate - (rate * normal).sum(axis=1)[:, None] * normal) / size
        return s, su * ut + sv * vt, normal, turn

    return derivatives


def _columns(*parts):
    return np.column_stack(np.broadcast_arrays(*parts))


def _ellipsoid(u, v):
    a, b, c = HALL
    cu, su, cv, sv = np.cos(u), np.sin(u), np.cos(v), np.sin(v)
    z = np.zeros_like(u)
    return (
        _columns(a * cu * cv, b * su * cv, c * sv),
        _columns(-a * su * cv, b * cu * cv, z),
        _columns(-a * cu * sv, -b * su * sv, c * cv),
        _columns(-a * cu * cv, -b * su * cv, z),
        _columns(a * su * sv, -b * cu * sv, z),
        _columns(-a * cu * cv, -b * su * cv, -c * sv),
    )


def _torus(u, v, R=30e3, r=8e3):
    cu, su, cv, sv = np.cos(u), np.sin(u), np.cos(v), np.sin(v)
    w, z = R + r * cv, np.zeros_like(u)
    return (
        _columns(w * cu, w * su, r * sv),
        _columns(-w * su, w * cu, z),
        _columns(-r * cu * sv, -r * su * sv, r * cv),
        _columns(-w * cu, -w * su, z),
        _columns(r * su * sv, -r * cu * sv, z),
        _columns(-r * cu * cv, -r * su * cv, -r * sv),
    )


def _saddle(u, v, k=30e3):
    one, z = np.ones_like(u), np.zeros_like(u)
    zero = _columns(z, z, z)
    return (
        _columns(u, v, u * v / k),
        _columns(one, z, v / k),
        _columns(z, one, u / k),
        zero,
        _columns(z, z, one / k),
        zero,
    )


def saddle_surface() -> PatchSurface:
    """z = xy / 30 m over 40 × 40 m, a bilinear patch."""
    poles = np.array([[[x, y, x * y / 30e3] for y in (-20e3, 20e3)] for x in (-20e3, 20e3)])
    knots = np.array([-20e3, -20e3, 20e3, 20e3])
    return PatchSurface((NurbsPatch(1, 1, knots, knots, poles),))


def free_form() -> NurbsPatch:
    """A rational bicubic roof, 30 × 20 m, of 5 × 4 spans."""
    rng = np.random.default_rng(7)
    i, j = np.meshgrid(np.linspace(0, 1, 8), np.linspace(0, 1, 7), indexing="ij")
    height = 6e3 * np.sin(np.pi * i) * np.sin(np.pi * j) + rng.uniform(-600, 600, i.shape)
    poles = np.stack([30e3 * i, 20e3 * j, height], axis=2)
    return NurbsPatch(
        3,
        3,
        np.array([0, 0, 0, 0, 1, 2, 3, 4, 5, 5, 5, 5.0]),
        np.array([0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4.0]),
        poles,
        rng.uniform(0.8, 1.25, i.shape),
    )


def _line(a, b):
    return (lambda t: a + (b - a) * t), (lambda t: np.full_like(t, b - a))


def _bent(a, b, swing, waves=1.0):
    w = 2 * math.pi * waves
    return (
        lambda t: a + (b - a) * t + swing * np.sin(w * t),
        lambda t: (b - a) + swing * w * np.cos(w * t),
    )


def _wave(a, swing):
    w = 2 * math.pi
    return (
        lambda t: a + swing * (np.sin(w * t) + 0.7 * np.cos(2 * w * t + 0.4)),
        lambda t: swing * w * (np.cos(w * t) - 1.4 * np.sin(2 * w * t + 0.4)),
    )


def _curve(name, surface, patch, u, v, closed=False, knots=()):
    return ExactCurve(name, surface, parametric(patch, u[0], v[0], u[1], v[1]), closed, knots)


def _section() -> ExactCurve:
    """An oblique plane section of the ellipsoid, an arc of an ellipse."""
    axes = np.array(HALL)
    normal = np.array([0.3, 0.9, 0.35])
    normal /= np.linalg.norm(normal)
    # On the unit sphere the section is a circle.
    m = normal * axes
    size = np.linalg.norm(m)
    m, height = m / size, 6e3 / size
    p = np.cross(m, [0, 0, 1.0])
    p /= np.linalg.norm(p)
    q = np.cross(m, p)
    radius = math.sqrt(1 - height**2)
    first, last = -math.pi / 2 - 0.42, -math.pi / 2 + 0.42
    if (height * m + radius * np.sin(-math.pi / 2) * q)[2] < 0:
        q = -q

    def derivatives(t):
        w = first + (last - first) * t
        unit = height * m + radius * (np.cos(w)[:, None] * p + np.sin(w)[:, None] * q)
        rate = radius * (last - first) * (-np.sin(w)[:, None] * p + np.cos(w)[:, None] * q)
        gradient, turn = unit / axes, rate / axes
        length = np.linalg.norm(gradient, axis=1)[:, None]
        normals = gradient / length
        turn = (turn - (turn * normals).sum(axis=1)[:, None] * normals) / length
        return unit * axes, rate * axes, normals, turn

    return ExactCurve("E-plane", Ellipsoid(*HALL), derivatives)


def curves() -> dict[str, ExactCurve]:
    """The curves figures are measured on, by name."""
    hall, ring = Ellipsoid(*HALL), Torus(30e3, 8e3)
    saddle, patch = saddle_surface(), free_form()
    free = PatchSurface((patch,))
    knots = tuple(sorted({*(np.array([1, 2, 3, 4]) - 0.6) / 3.8, *(np.array([1, 2, 3]) - 0.5) / 3}))
    turn = 2 * math.pi
    made = [
        _section(),
        _curve("E-diag", hall, _ellipsoid, _line(0.2, 0.9), _line(0.35, 0.95)),
        _curve("E-S", hall, _ellipsoid, _line(0.3, 1.1), _bent(0.6, 0.7, 0.12)),
        _curve("T-diag", ring, _torus, _line(0.0, 0.7), _line(0.2, 2.1)),
        _curve("HP-line", saddle, _saddle, _line(9e3, 9e3), _line(-12e3, 12e3)),
        _curve("HP-S", saddle, _saddle, _line(-13e3, 13e3), _bent(-2e3, 3e3, 2e3)),
        _curve("N-diag", free, patch.evaluate, _line(0.6, 4.4), _line(0.5, 3.5), knots=knots),
        _curve("E-ring", hall, _ellipsoid, _line(0.0, turn), _line(1.0, 1.0), True),
        _curve("T-ring", ring, _torus, _line(0.0, turn), _line(0.0, turn), True),
        _curve("E-wave", hall, _ellipsoid, _line(0.0, turn), _wave(0.6, 0.15), True),
    ]
    return {curve.name: curve for curve in made}
