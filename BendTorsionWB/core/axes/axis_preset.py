# SPDX-License-Identifier: LGPL-2.1-or-later
"""The fabrication axis: the design axis displaced by camber or an erection preset."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline, make_interp_spline

from .. import tolerances
from ..finding import BendTorsionError, error, note
from ..geometry.curve_edit import arc_length, curve_through, parameters_at
from ..geometry.piecewise import merged_breaks, resolve
from .axis import Axis, arc_length_position
from .axis_check import checked_shape

FOLLOWS = 1e-6
"""mm: the fabrication axis's spline follows the displaced design axis to this."""


@dataclass(frozen=True, eq=False)
class Preset:
    """Displacements (k, 3) mm in x, y, z at places (k,) of the design axis: arc lengths in mm
    from its trimmed start, or ratios of its length when `by` is 'ratio'."""

    places: np.ndarray
    displacements: np.ndarray
    by: str = "length"


def with_preset(axis: Axis, preset: Preset) -> Axis:
    """The fabrication axis: the design axis plus a cubic spline of the displacements.

    Not-a-knot, periodic on a closed axis; one row displaces the whole axis. Before the first and
    after the last row their displacement is held, level. The result keeps `design` and
    `design_place`; its control points are the displaced ones, `control_design` the others. Raises
    BendTorsionError for rows that are not numbers, twice at one place, or not on the axis.
    """
    s, moves, findings = _checked(axis, preset)
    displace = _law(s, moves, axis)
    design = axis.position

    def position(at: np.ndarray) -> np.ndarray:
        return design(at) + displace(at)

    breaks = merged_breaks(s, start=0.0, end=axis.length, least=1.0)
    curve, _ = curve_through(position, breaks, FOLLOWS)
    fabricated = arc_length_position(curve, axis.closed)
    arc = arc_length(curve)
    place = resolve(
        lambda at: parameters_at(curve, np.clip(at, 0.0, arc(np.array([arc.end]))[0, 0]))[:, None],
        fabricated.breaks,
        max(axis.length, 1.0),
    )
    where = axis.place_of(axis.control)
    findings += checked_shape(axis.name, fabricated, axis.closed)
    return replace(
        axis,
        curve=curve,
        position=fabricated,
        control=axis.control + displace(where),
        findings=(*axis.findings, *findings),
        design=axis,
        design_place=place,
    )


def _checked(axis: Axis, preset: Preset):
    places = np.asarray(preset.places, float).ravel()
    moves = np.asarray(preset.displacements, float).reshape(-1, 3)
    problems = []
    finite = np.isfinite(places) & np.isfinite(moves).all(axis=1)
    for row in np.flatnonzero(~finite):
        problems.append(
            error(
                "preset-not-a-number",
                axis.name,
                "displacement is not a number",
                "give place, dx, dy, dz",
                position=f"preset row {row + 1}",
            )
        )
    s = places * axis.length if preset.by == "ratio" else places
    off = finite & ((s < -tolerances.SAME_STATION) | (s > axis.length + tolerances.SAME_STATION))
    for row in np.flatnonzero(off):
        problems.append(
            error(
                "preset-beyond-axis",
                axis.name,
                "the row is not on the axis",
                "give a place between 0 and the axis's length",
                position=f"preset row {row + 1}",
                value=float(s[row]),
                limit=axis.length,
                unit="mm",
            )
        )
    if axis.closed and len(s) > 1:
        first, last = (np.abs(s - end) <= tolerances.SAME_STATION for end in (0.0, axis.length))
        if first.any() and last.any():
            start, end = int(np.argmax(first)), int(np.argmax(last))
            if not np.allclose(moves[start], moves[end], atol=1e-6):
                problems.append(
                    error(
                        "preset-does-not-close",
                        axis.name,
                        "a closed axis starts and ends at one place, but its rows there differ",
                        "give the first and the last row the same displacement",
                        position=f"preset row {end + 1}",
                    )
                )
            s, moves = np.delete(s, end), np.delete(moves, end, axis=0)
    order = np.argsort(s, kind="stable")
    twice = np.flatnonzero(np.diff(s[order]) < 1.0)
    for row in order[twice + 1]:
        problems.append(
            error(
                "preset-twice",
                axis.name,
                "two rows for one place of the axis",
                "delete one of them",
                position=f"preset row {row + 1}",
                value=float(s[row]),
                unit="mm",
            )
        )
    if not len(s):
        problems.append(error("preset-empty", axis.name, "the preset has no rows", "add rows"))
    if problems:
        raise BendTorsionError(problems)
    s, moves = np.clip(s[order], 0.0, axis.length), moves[order]
    findings = []
    if len(s) > 1 and not axis.closed and (s[0] > 1.0 or s[-1] < axis.length - 1.0):
        findings.append(
            note(
                "preset-held",
                axis.name,
                "the preset does not reach the axis's ends: its first and last "
                "displacement are held there",
                "add rows at the ends",
            )
        )
    return s, moves, findings


def _law(s: np.ndarray, moves: np.ndarray, axis: Axis):
    """Displacement (m, 3) at arc lengths (m,)."""
    if len(s) == 1:
        return lambda at: np.broadcast_to(moves[0], (len(at), 3))
    if axis.closed:
        spline = CubicSpline(
            np.append(s, s[0] + axis.length), np.vstack([moves, moves[:1]]), bc_type="periodic"
        )
        return lambda at: spline(s[0] + np.mod(at - s[0], axis.length))
    held = s[0] > 1.0, s[-1] < axis.length - 1.0
    if any(held):
        level = [(1, np.zeros(3))]
        # Held ends join level; the other end keeps its natural not-a-knot run.
        if len(s) >= 4 or all(held):
            conditions = tuple((1, np.zeros(3)) if end else "not-a-knot" for end in held)
            spline = CubicSpline(s, moves, bc_type=conditions)
        else:
            degree = len(s)
            knots = np.repeat(s[[0, -1]], degree + 1)
            spline = make_interp_spline(
                s,
                moves,
                k=degree,
                t=knots,
                bc_type=(level if held[0] else None, level if held[1] else None),
            )
    else:
        spline = make_interp_spline(s, moves, k=min(3, len(s) - 1))
    return lambda at: spline(np.clip(at, s[0], s[-1]))
