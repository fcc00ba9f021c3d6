# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ends of a plate that are no section planes: where each of its surfaces ends, as s over w.

An end is any signed function of space, positive on the side that stays (a plane, another member's
face). On a surface of the plate, X(s, w), it is solved for s along lines of constant w.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..finding import BendTorsionError, error
from ..geometry.piecewise import Piecewise, resolve
from .member import EndSurface
from .mitres import LEVELS
from .strips import StripRails

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
    edge to 1 on the second; and the surface it ends at. switches: per surface the places w where
    the curve has a corner, as another part of the end surface takes over."""

    outer: Piecewise
    mid: Piecewise
    inner: Piecewise
    surface: EndSurface
    switches: tuple[tuple[float, ...], ...] = ((), (), ())

    def corners_at(self, d: float) -> tuple[float, ...]:
        """The corners w at depth d, 0 at the outer and 1 at the inner surface."""
        outer, mid, inner = self.switches
        if not len(outer) == len(mid) == len(inner):
            # One lies on some of the surfaces only.
            return tuple(sorted({*outer, *mid, *inner}))
        parts = (1.0 - d) * (1.0 - 2.0 * d), 4.0 * d * (1.0 - d), d * (2.0 * d - 1.0)
        return tuple(
            parts[0] * a + parts[1] * b + parts[2] * c
            for a, b, c in zip(outer, mid, inner, strict=True)
        )

    @property
    def stretches(self) -> tuple[tuple[float, float], ...]:
        """From and to (w) of the smooth stretches of the mid-surface's curve."""
        edges = (0.0, *self.switches[1], 1.0)
        return tuple(zip(edges[:-1], edges[1:], strict=True))

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
    levels = [getattr(rails, level) for level in LEVELS]
    bounds = _brackets(name, levels, surface, end)

    def cut(w: np.ndarray, chosen: Sequence[int]) -> np.ndarray:
        near = np.clip(np.searchsorted(FIBRES, w) - 1, 0, len(FIBRES) - 2)
        low, high, start = (np.stack([bounds[k][j][near] for k in chosen]) for j in range(3))
        rails = [levels[k] for k in chosen]
        return _cuts(rails, surface, w, low, high, start, end == 1).T

    switches = tuple(
        tuple(_switches(lambda w, k=k: cut(w, (k,))[:, 0], level, surface))
        for k, level in enumerate(levels)
    )
    if not any(switches):
        # All three at once: the closest points of the surface are what takes the time.
        found = resolve(lambda w: cut(w, (0, 1, 2)), np.array([0.0, 1.0]), CURVE_SIZE, _DEEPEST)
        curves = [Piecewise(found.breaks, found.values[..., k : k + 1]) for k in range(3)]
    else:
        curves = [
            resolve(lambda w, k=k: cut(w, (k,)), np.array([0.0, *own, 1.0]), CURVE_SIZE, _DEEPEST)
            for k, own in enumerate(switches)
        ]
    return EndCurves(*curves, surface, switches)


def _switches(cut, rails: Piecewise, surface: EndSurface) -> list[float]:
    """Where a curve passes from one to another part of an end surface, w rising: it has a corner
    there."""
    if len(getattr(surface, "parts", ())) < 2:
        return []

    def part_at(w: np.ndarray) -> np.ndarray:
        value = rails(cut(w))
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


def _brackets(name, levels, surface, end) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Per surface of a plate, and between each two fibres: places along the rails before and
    behind the cut, and about where it is."""
    places = [
        np.union1d(np.linspace(rails.start, rails.end, LOOKED_AT), rails.breaks) for rails in levels
    ]
    points = []
    for rails, own in zip(levels, places, strict=True):
        value = rails(own)
        fibres = value[:, None, :3] + FIBRES[:, None] * (value[:, None, 3:] - value[:, None, :3])
        points.append(fibres.reshape(-1, 3))
    side, _ = surface.value_and_gradient(np.concatenate(points))
    sides = np.split(side, np.cumsum([len(own) for own in points])[:-1])
    return [
        _bracket(name, level, end, own, side.reshape(len(own), -1))
        for level, own, side in zip(LEVELS, places, sides, strict=True)
    ]


def _bracket(name, level, end, places, side) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """As `_brackets`, of one surface with the side (k, n) its fibres are on at places (k,)."""
    stays = side >= 0.0
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
    last = np.argmax(changes, axis=0)
    fibre = np.arange(len(FIBRES))
    before, behind = side[last, fibre], side[last + 1, fibre]
    about = places[last] + before / (before - behind) * (places[last + 1] - places[last])
    low = (np.minimum(last[:-1], last[1:]) - 1).clip(0)
    high = (np.maximum(last[:-1], last[1:]) + 2).clip(None, len(places) - 1)
    return places[low], places[high], 0.5 * (about[:-1] + about[1:])


def fibre_cuts(
    rails: Piecewise, surface: EndSurface, w: np.ndarray, low: np.ndarray, high: np.ndarray
) -> np.ndarray:
    """Arc lengths (n,) between low and high (n,) where lines of constant w (n,) end, by Newton
    steps kept within the bracket."""
    return _cuts([rails], surface, w, low[None], high[None])[0]


def _cuts(levels, surface, w, low, high, start=None, stays=None) -> np.ndarray:
    """As `fibre_cuts`, of several surfaces at once: (m, n); start (m, n): about where; stays:
    whether the plate stays at the low ends."""
    w = np.asarray(w, float)[:, None]
    rates = [rails.derivative for rails in levels]

    def on_fibres(functions, s: np.ndarray) -> np.ndarray:
        values = [function(own) for function, own in zip(functions, np.split(s, len(levels)))]
        return np.concatenate([v[:, :3] + w * (v[:, 3:] - v[:, :3]) for v in values])

    def step(s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        value, gradient = surface.value_and_gradient(on_fibres(levels, s))
        return value, (gradient * on_fibres(rates, s)).sum(axis=1)

    start = None if start is None else start.ravel()
    return bracketed_roots(step, low.ravel(), high.ravel(), start, stays).reshape(low.shape)


def bracketed_roots(
    step, low: np.ndarray, high: np.ndarray, start: np.ndarray | None = None, stays=None
) -> np.ndarray:
    """Roots (n,) between low and high of step(s) -> (value, slope), by Newton's method from
    `start` (half way where it is None); where a step leaves its bracket, the bracket is halved.
    stays: whether the values at low are positive, where that is known."""
    low, high = np.array(low, float), np.array(high, float)
    at_low = step(low)[0] >= 0.0 if stays is None else np.full(len(low), stays)
    s = 0.5 * (low + high) if start is None else np.minimum(np.maximum(start, low), high)
    for _ in range(_STEPS):
        value, slope = step(s)
        same = (value >= 0.0) == at_low
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
