# SPDX-License-Identifier: LGPL-2.1-or-later
"""The figures of a member that have limits, and what is found where one is beyond its limit."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from ..core.finding import Finding, has_error, note, warning
from ..core.lofting import DevelopedPlate, MemberRecord

AXIS_RMS_LIMIT = 0.003
"""mm; axis to surface, root mean square, points exact on the surface."""

TORSION_ERROR_LIMIT = 0.001
"""degrees; largest angle between the built z axis and the wanted one."""

LENGTH_ERROR_LIMIT = 0.012
"""mm; worst flat length error of a plate in a constant zone."""

LENGTH_ERROR_LIMIT_TRANSITION = 0.02
"""mm; worst flat length error of a plate with folds."""

BOUND_FACTOR_LIMIT = 2.5
"""Worst length error over its proven lower bound."""

LENGTH_ERROR_FLOOR = 1e-6
"""mm; a length error below this passes whatever its bound."""


def degrees(angle: float | None) -> float | None:
    """An angle in radians as degrees; None stays None, and what is not finite becomes None."""
    return None if angle is None else number(math.degrees(angle))


def number(value: float | None) -> float | None:
    """A figure that strict JSON can hold: None where there is none, or it is not finite."""
    if value is None or not math.isfinite(value):
        return None
    return float(value)


def largest(values: Iterable[float]) -> float | None:
    """The largest value; NaN when any is NaN, so that no failed figure hides; None of nothing."""
    return max(values, key=lambda value: (math.isnan(value), value), default=None)


def worst_length_error(plates: Iterable[DevelopedPlate], in_transition: bool) -> float | None:
    """Largest length error, mm, among the plates in transitions or outside them."""
    return largest(p.length_error_max for p in plates if p.in_transition == in_transition)


def worst_bound_factor(plates: Iterable[DevelopedPlate]) -> float | None:
    """Largest length error over its bound, of the plates whose error is above the floor."""
    factors = [own for own in map(_bound_factor, plates) if own != 0.0]
    return largest(factors)


FIGURES = (
    ("axis rms", AXIS_RMS_LIMIT, 5),
    ("torsion °", TORSION_ERROR_LIMIT, 6),
    ("flat", LENGTH_ERROR_LIMIT, 5),
    ("flat tran", LENGTH_ERROR_LIMIT_TRANSITION, 5),
    ("x bound", BOUND_FACTOR_LIMIT, 2),
)
"""The figures of a member that have limits: name, limit and digits shown."""

NOTED = ("axis rms", "x bound")
"""Figures beyond which there is a note: they tell about the input and the pattern, and a member is
none the worse for them."""


def figures(record: MemberRecord) -> tuple[float | None, ...]:
    """A member's FIGURES: axis rms mm, torsion error degrees, worst flat length error mm of plates
    outside and in transitions, worst error over its proven bound; None where there is none."""
    return (
        record.axis_to_surface_rms,
        degrees(record.torsion_error_max),
        worst_length_error(record.plates, False),
        worst_length_error(record.plates, True),
        worst_bound_factor(record.plates),
    )


def passes(value: float | None, limit: float) -> bool:
    """Whether a figure is within its limit; one that does not exist is."""
    return value is None or value <= limit


def within_limits(record: MemberRecord) -> bool:
    """Whether a member is free of errors and no figure is beyond a limit: one beyond which there is
    a note only, such as the usual factor over the proven bound, is none."""
    return (
        bool(record.plates)
        and not has_error(record.findings)
        and all(finding.severity == "note" for finding in limit_findings(record))
    )


def signs(values: Iterable[float | None]) -> tuple[str, ...]:
    """For each of FIGURES `!` where it is beyond its limit, `*` where that is a note only, else
    nothing."""
    return tuple(
        "" if passes(value, limit) else "*" if name in NOTED else "!"
        for value, (name, limit, _) in zip(values, FIGURES, strict=True)
    )


def limit_findings(record: MemberRecord) -> Iterator[Finding]:
    """A finding for each figure of a member beyond its limit, at the plate that is worst."""
    axis, turned, _, _, _ = figures(record)
    if not passes(axis, AXIS_RMS_LIMIT):
        yield note(
            "axis-rms",
            record.member,
            "the axis is farther from its surface than the limit, as one is that is kept off it",
            "leave it where that is meant; else project its curve onto the surface, or give "
            "points, or more of them, and fit = pull",
            value=axis,
            limit=AXIS_RMS_LIMIT,
            unit="mm",
        )
    if not passes(turned, TORSION_ERROR_LIMIT):
        yield warning(
            "torsion-error",
            record.member,
            "the built section is turned away from the surface normal by more than the limit",
            "report this with the document",
            value=turned,
            limit=TORSION_ERROR_LIMIT,
            unit="deg",
        )
    for in_transition, limit in (
        (False, LENGTH_ERROR_LIMIT),
        (True, LENGTH_ERROR_LIMIT_TRANSITION),
    ):
        own = [p for p in record.plates if p.in_transition == in_transition]
        beyond = [p for p in own if not p.length_error_max <= limit]
        if beyond:
            worst = _worst(beyond, lambda plate: plate.length_error_max)
            yield warning(
                "length-error",
                worst.mark,
                f"{_plates(beyond)} of the member: flat lengths differ from formed ones by more "
                "than the limit",
                "narrow the plate, or lay it flat with mode elastic",
                value=number(worst.length_error_max),
                limit=limit,
                unit="mm",
            )
    beyond = [p for p in record.plates if not _bound_factor(p) <= BOUND_FACTOR_LIMIT]
    if beyond:
        worst = _worst(beyond, _bound_factor)
        yield note(
            "length-error-bound",
            worst.mark,
            f"{_plates(beyond)} of the member: the flat length error is larger than the least any "
            f"pattern can have by more than the usual factor, as in skew panels; it is "
            f"{worst.length_error_max:.4f} mm",
            "lay it flat with mode elastic where that is too much",
            value=number(_bound_factor(worst)),
            limit=BOUND_FACTOR_LIMIT,
        )


def _plates(plates: list[DevelopedPlate]) -> str:
    return "1 plate" if len(plates) == 1 else f"{len(plates)} plates"


def _worst(plates: list[DevelopedPlate], value) -> DevelopedPlate:
    return max(plates, key=lambda plate: (math.isnan(value(plate)), value(plate)))


def _bound_factor(plate: DevelopedPlate) -> float:
    """Length error over its bound; 0 of an error too small to matter."""
    if plate.length_error_max <= LENGTH_ERROR_FLOOR:
        return 0.0
    bound = plate.length_error_bound
    return plate.length_error_max / bound if bound > 0.0 else math.inf
