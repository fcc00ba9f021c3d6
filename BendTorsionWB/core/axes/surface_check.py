# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is wrong with a surface along an axis: creases, borders, ambiguous feet, a likely unit."""

from __future__ import annotations

import numpy as np

from .. import tolerances
from ..finding import Finding, error, note, warning
from ..geometry.surface import (
    Cone,
    Cylinder,
    Ellipsoid,
    Flipped,
    Offset,
    Plane,
    Sphere,
    Surface,
    Torus,
)
from .axis import Axis

SMALLEST_SURFACE = 1000.0
"""mm: a surface smaller than this as a whole is no building's."""
LARGEST_SURFACE = 5e6
"""mm: a surface larger than this as a whole is no building's."""
CREASE = np.radians(0.1)
"""Normals of two sides of a line that differ by more make a crease no section can follow."""
_SAMPLES = 50.0
_SAME_PLACE = 1e-3
"""mm within which a change of the normal counts as a jump."""


def surface_findings(surface: Surface, axis: Axis, turns_sections: bool = True) -> list[Finding]:
    """Findings of a surface under an axis, each with its arc lengths.

    Stretches past the border or the wires, feet that are not unique, and creases the axis
    crosses. Where the sections take their direction from the surface (`turns_sections`), creases
    and ambiguous feet are errors: no frame is right there. Else they are notes.
    """
    count = int(np.ceil(axis.length / _SAMPLES)) + 1
    s = np.linspace(0.0, axis.length, max(count, 201))
    foot = surface.closest(axis.surface_points(s))
    grave = error if turns_sections else note
    findings = []
    for first, last in _stretches(foot.outside, s):
        inside = (s >= first) & (s <= last)
        beyond = np.linalg.norm(axis.surface_points(s) - foot.points, axis=1)[inside].max()
        findings.append(
            warning(
                "surface-border",
                axis.name,
                "the axis runs past the border of the surface; directions are those of the "
                "border, or of the surface continued",
                "extend the surface or shorten the axis",
                position=_place(first, last),
                value=float(beyond),
                unit="mm",
            )
        )
    creases = _creases(axis, surface, s, foot.normals)
    for place, angle in creases:
        findings.append(
            grave(
                "surface-crease",
                axis.name,
                "the axis crosses a crease of the surface",
                "smooth the surface there, end the axis at the crease, or use frame minimal, "
                "fixed or given",
                position=_place(place, place),
                value=float(np.degrees(angle)),
                limit=float(np.degrees(CREASE)),
                unit="°",
            )
        )
    at = np.array([place for place, _ in creases])
    for first, last in _stretches(foot.ambiguous, s):
        if len(at) and np.abs(at - 0.5 * (first + last)).min() <= max(last - first, _SAMPLES):
            continue
        findings.append(
            grave(
                "surface-ambiguous",
                axis.name,
                "points of the axis have several nearest points on the surface, or none with "
                "one normal",
                "bring the axis nearer to the surface, or use another frame",
                position=_place(first, last),
            )
        )
    return findings


def size_findings(surface: Surface, name: str) -> list[Finding]:
    """A warning for a surface of a size no building has in mm, naming the likely unit."""
    size = surface_size(surface)
    if size is None or SMALLEST_SURFACE <= size <= LARGEST_SURFACE:
        return []
    small = size < SMALLEST_SURFACE
    unit = "metres" if small else "micrometres"
    return [
        warning(
            "surface-size",
            name,
            f"the surface measures {size:.6g} mm; it is likely given in {unit}",
            f"give it in mm: {'multiply' if small else 'divide'} by 1000",
            value=float(size),
            limit=SMALLEST_SURFACE if small else LARGEST_SURFACE,
            unit="mm",
        )
    ]


def surface_size(surface: Surface) -> float | None:
    """Largest extent, mm; the diameter of endless surfaces of revolution, None for a plane."""
    if isinstance(surface, (Offset, Flipped)):
        return surface_size(surface.surface)
    if isinstance(surface, Plane):
        return None
    if isinstance(surface, Ellipsoid):
        return 2.0 * max(surface.a, surface.b, surface.c)
    if isinstance(surface, Torus):
        return 2.0 * (surface.R + surface.r)
    if isinstance(surface, (Sphere, Cylinder, Cone)):
        return 2.0 * surface.r
    return surface.size


def _creases(axis, surface, s, normals) -> list[tuple[float, float]]:
    """Places and angles (rad) where the normal along the axis jumps, by bisection."""
    low, high = s[:-1], s[1:]
    before, after = normals[:-1], normals[1:]
    while len(low):
        angle = _angle(before, after)
        suspect = angle > CREASE
        low, high, before, after = low[suspect], high[suspect], before[suspect], after[suspect]
        if not len(low) or (high - low).max() <= _SAME_PLACE:
            break
        middle = 0.5 * (low + high)
        between = surface.closest(axis.surface_points(middle)).normals
        low, high = np.concatenate([low, middle]), np.concatenate([middle, high])
        before, after = np.concatenate([before, between]), np.concatenate([between, after])
    order = np.argsort(low)
    found: list[tuple[float, float]] = []
    for k in order:
        place, angle = float(0.5 * (low[k] + high[k])), float(_angle(before, after)[k])
        if not found or place - found[-1][0] > 1.0:
            found.append((place, angle))
    return found


def _angle(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    return 2.0 * np.arcsin(np.clip(0.5 * np.linalg.norm(second - first, axis=1), 0.0, 1.0))


def _stretches(flags: np.ndarray, s: np.ndarray) -> list[tuple[float, float]]:
    """First and last s of each run of flagged stations."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(int)))
    return [(float(s[a]), float(s[b - 1])) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def _place(first: float, last: float) -> str:
    if last - first <= tolerances.SAME_STATION:
        return f"s = {first:.0f} mm"
    return f"s = {first:.0f} to {last:.0f} mm"
