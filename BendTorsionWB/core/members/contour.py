# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ends of a plate that are no section planes: where each of its surfaces ends, as s over w.

An end is any signed function of space, positive on the side that stays (a plane, another member's
face). On a surface of the plate, X(s, w), it is solved for s along lines of constant w.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..finding import BendTorsionError, error
from ..geometry.piecewise import Piecewise, resolve
from .member import EndSurface
from .strips import LEVELS, StripRails

CURVE_SIZE = 1000.0
"""End curves are resolved as functions of this size, mm: to about 1e-9 mm."""
LOOKED_AT = 129
"""Places along a fibre at which the side is asked for, and with it how often the end cuts it."""
FIBRES = np.linspace(0.0, 1.0, 33)
"""Lines of constant w that must be cut exactly once."""
_DEEPEST = 7
_STEPS = 60
_HALVINGS = 44
_LAST_STEP = 1e-7


@dataclass(frozen=True, eq=False)
class EndCurves:
    """Where a plate ends: w -> s (1,) on its outer, mid and inner surface, w from 0 on the first
    edge to 1 on the second; and the surface it ends at."""

    outer: Piecewise
    mid: Piecewise
    inner: Piecewise
    surface: EndSurface

    def at(self, level: str, w: np.ndarray) -> np.ndarray:
        """Arc lengths (n,) at w (n,) on the surface `outer`, `mid` or `inner`."""
        return getattr(self, level)(np.asarray(w, float))[:, 0]

    def corners(self, level: str) -> np.ndarray:
        """Arc lengths (2,) on the first and the second edge."""
        return self.at(level, np.array([0.0, 1.0]))

    @cached_property
    def range(self) -> tuple[float, float]:
        """The least and the greatest arc length of the three curves."""
        found = [
            np.concatenate([curve.values.ravel(), curve(FIBRES).ravel()])
            for curve in (self.outer, self.mid, self.inner)
        ]
        return float(min(f.min() for f in found)), float(max(f.max() for f in found))


def end_curves(name: str, rails: StripRails, surface: EndSurface, end: int) -> EndCurves:
    """The curves at the start (end 0) or the end (1) of a plate whose rails reach beyond them.

    Raises BendTorsionError, with the place, where a fibre is missed or cut more than once, and
    where nothing of the plate would be left.
    """
    curves = (_curve(name, getattr(rails, level), level, surface, end) for level in LEVELS)
    return EndCurves(*curves, surface)


def _curve(name: str, rails: Piecewise, level: str, surface: EndSurface, end: int) -> Piecewise:
    places, brackets = _brackets(name, rails, level, surface, end)

    def cut(w: np.ndarray) -> np.ndarray:
        near = np.clip(np.searchsorted(FIBRES, w) - 1, 0, len(FIBRES) - 2)
        low = np.minimum(brackets[near], brackets[near + 1])
        high = np.maximum(brackets[near], brackets[near + 1]) + 1
        low, high = (low - 1).clip(0), (high + 1).clip(None, len(places) - 1)
        return fibre_cuts(rails, surface, w, places[low], places[high])[:, None]

    breaks = np.array([0.0, *_switches(cut, rails, surface), 1.0])
    return resolve(cut, breaks, CURVE_SIZE, _DEEPEST)


def _switches(cut, rails: Piecewise, surface: EndSurface) -> list[float]:
    """Where a curve passes from one to another part of an end surface, w rising: it has a corner
    there."""
    if len(getattr(surface, "parts", ())) < 2:
        return []

    def part_at(w: np.ndarray) -> np.ndarray:
        value = rails(cut(w)[:, 0])
        return surface.part_at(value[:, :3] + w[:, None] * (value[:, 3:] - value[:, :3]))

    parts = part_at(FIBRES)
    found = []
    for k in np.flatnonzero(parts[1:] != parts[:-1]):
        low, high = FIBRES[k], FIBRES[k + 1]
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            same = bool(part_at(np.array([middle]))[0] == parts[k])
            low, high = (middle, high) if same else (low, middle)
        found.append(0.5 * (low + high))
    return found


def _brackets(name, rails, level, surface, end) -> tuple[np.ndarray, np.ndarray]:
    """Places along the rails, and per fibre the last of them before it is cut."""
    places = np.union1d(np.linspace(rails.start, rails.end, LOOKED_AT), rails.breaks)
    value = rails(places)
    points = value[:, None, :3] + FIBRES[:, None] * (value[:, None, 3:] - value[:, None, :3])
    side, _ = surface.value_and_gradient(points.reshape(-1, 3))
    stays = side.reshape(len(places), -1) >= 0.0
    changes = stays[1:] != stays[:-1]
    count = changes.sum(axis=0)
    far = stays[-1 if end == 0 else 0]
    which = "start" if end == 0 else "end"
    for wrong, code, message, mend in (
        (
            ~far & (count == 0),
            "end-leaves-nothing",
            f"nothing of the plate is left by the cut at its {which}",
            "move the cut outwards, or move the joint away from the end",
        ),
        (
            count == 0,
            "end-missed",
            f"the cut at the {which} misses the plate",
            "move the cut onto the member, or extend the axis",
        ),
        (
            (count > 1) | ~far,
            "end-cut-twice",
            f"the cut at the {which} crosses the plate more than once",
            "use a surface that crosses each fibre of the member once",
        ),
    ):
        if wrong.any():
            fibre = int(np.argmax(wrong))
            at = float(places[int(np.argmax(changes[:, fibre]))])
            raise BendTorsionError(
                error(
                    code,
                    name,
                    message,
                    mend,
                    position=f"{level} surface, w = {FIBRES[fibre]:.2f}, s = {at:.0f} mm",
                    value=int(count[fibre]),
                    limit=1,
                )
            )
    return places, np.argmax(changes, axis=0)


def fibre_cuts(
    rails: Piecewise, surface: EndSurface, w: np.ndarray, low: np.ndarray, high: np.ndarray
) -> np.ndarray:
    """Arc lengths (n,) between low and high (n,) where lines of constant w (n,) end, by Newton
    steps kept within the bracket."""
    rate = rails.derivative
    w = np.asarray(w, float)[:, None]

    def on_fibre(values: np.ndarray) -> np.ndarray:
        return values[:, :3] + w * (values[:, 3:] - values[:, :3])

    def step(s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        value, gradient = surface.value_and_gradient(on_fibre(rails(s)))
        return value, (gradient * on_fibre(rate(s))).sum(axis=1)

    return bracketed_roots(step, low, high)


def bracketed_roots(step, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Roots (n,) between low and high of step(s) -> (value, slope), by Newton's method; where a
    step leaves its bracket, the bracket is halved."""
    low, high = np.array(low, float), np.array(high, float)
    at_low = step(low)[0]
    s = 0.5 * (low + high)
    for _ in range(_STEPS):
        value, slope = step(s)
        same = (value >= 0.0) == (at_low >= 0.0)
        low, high = np.where(same, s, low), np.where(same, high, s)
        with np.errstate(divide="ignore", invalid="ignore"):
            new = s - value / slope
        outside = ~((new >= low) & (new <= high))
        new = np.where(outside, 0.5 * (low + high), new)
        moved = np.abs(new - s).max()
        s = new
        if moved <= _LAST_STEP:
            break
    return s
