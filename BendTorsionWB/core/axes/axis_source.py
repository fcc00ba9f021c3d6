# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a file holds for an axis: an exact curve, loose segments, or bare points."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

import numpy as np

from ..finding import BendTorsionError, Finding, error
from ..geometry.curve import Curve
from .axis_check import check_coordinates, check_curve
from .axis_input import AxisInput
from .axis_order import chain_curves


@dataclass(frozen=True, eq=False)
class AxisSource:
    """One named thing of a file, in mm: curve, or segments ((m, 3), …), or points (k, 3) in no
    order. findings: what was found while it was read."""

    name: str
    curve: Curve | None = None
    segments: tuple[np.ndarray, ...] | None = None
    points: np.ndarray | None = None
    findings: tuple[Finding, ...] = ()

    def into(self, given: AxisInput) -> AxisInput:
        """The axis input with this source in place of its own."""
        return replace(
            given,
            curve=self.curve,
            segments=self.segments,
            points=self.points,
            rule=None,
            order="given" if self.points is None else "nearest",
        )


def axis_source(
    name: str,
    curves: tuple[Curve, ...],
    polylines: tuple[np.ndarray, ...],
    points: np.ndarray,
    findings: tuple[Finding, ...] = (),
    unit: float = 1.0,
) -> AxisSource:
    """One source from everything that bears one name: exact curves, joined (with polylines as
    exact legs between them); or else polylines as segments; or else bare points. All are in units
    of `unit` mm.

    Raises BendTorsionError for nothing, for numbers out of range, and for curves that do not form
    one chain.
    """
    for k, curve in enumerate(curves, start=1):
        check_curve(name, curve, f"segment {k}", unit)
    for k, line in enumerate(polylines, start=len(curves) + 1):
        check_coordinates(name, line, f"segment {k}", unit=unit)
    points = np.asarray(points, float).reshape(-1, 3)
    check_coordinates(name, points, "point", range(1, len(points) + 1), unit)
    curves = tuple(replace(curve, poles=curve.poles * unit) for curve in curves)
    polylines = tuple(line * unit for line in polylines)
    if curves:
        legs = tuple(_leg(a, b) for line in polylines for a, b in zip(line[:-1], line[1:]))
        curve, found = chain_curves(name, (*curves, *legs))
        return AxisSource(name, curve=curve, findings=(*findings, *found))
    if polylines:
        return AxisSource(name, segments=polylines, findings=findings)
    if len(points):
        return AxisSource(name, points=points * unit, findings=findings)
    raise BendTorsionError(
        error(
            "axis-source-empty",
            name,
            "no curve, line or point bears this name",
            "name a layer or object that holds the axis",
        )
    )


def found_source(
    name: str,
    sources: Mapping[str, AxisSource],
    file: str,
    layers: Collection[str] = (),
    empty: Collection[str] = (),
) -> AxisSource:
    """The source of that name, whatever its case; the only one when the name is empty. layers: the
    names that are told where there are more; empty: layers without a source. Raises
    BendTorsionError naming what there is."""
    if not name and len(sources) == 1:
        return next(iter(sources.values()))
    exact = sources.get(name)
    alike = [source for key, source in sources.items() if key.lower() == name.lower()]
    if exact is not None or len(alike) == 1:
        return exact or alike[0]
    known = ", ".join(list(layers or sources)[:12])
    if not name and sources:
        raise BendTorsionError(
            error(
                "axis-source-name",
                file,
                "the file holds several curves",
                f"name one of them after a #: {known}",
            )
        )
    mend = f"use {known}" if known else "name a file that holds the axis"
    bare = next((layer for layer in empty if layer.lower() == name.lower()), None)
    if bare is not None:
        message = f"layer {bare} holds no curves, lines or points"
        raise BendTorsionError(error("axis-source-empty", file, message, mend, position=name))
    message = f"no curve named {name!r} in the file"
    raise BendTorsionError(error("axis-source-name", file, message, mend, position=name))


def _leg(start: np.ndarray, end: np.ndarray) -> Curve:
    length = float(np.linalg.norm(end - start))
    return Curve(1, np.array([0.0, 0.0, length, length]), np.array([start, end]))
