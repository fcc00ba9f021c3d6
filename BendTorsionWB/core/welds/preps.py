# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edge preparations: the groove a weld asks for, and what of it each plate is cut to."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from ..finding import BendTorsionError, Finding, error

TYPES = ("square", "bevel", "v", "double-bevel", "double-v", "fillet", "double-fillet")
"""Grooves by the shape of the joint: `bevel` and `double-bevel` cut one plate, `v` and `double-v`
both; `square`, `fillet` and `double-fillet` cut none."""

SLOT = "slot"
"""Type of the weld that fills the slots of a face closed last; no row asks for it by name."""

WHOLE_ANGLE = math.radians(1.0)
"""rad; groove angles the program finds are told in steps of this."""

SIDES = ("outer", "inner")
PLACES = ("shop", "field")


@dataclass(frozen=True)
class Prep:
    """An edge preparation. angle: included angle of the groove, rad; land: depth left square at
    the root, mm; gap: root opening, mm; side: face the groove opens to; backing: width and
    thickness of the backing bar, mm, or None; leg: of a fillet, mm, 0 where it is not told."""

    name: str
    type: str
    angle: float = 0.0
    land: float = 0.0
    gap: float = 0.0
    side: str = "outer"
    backing: tuple[float, float] | None = None
    leg: float = 0.0

    @property
    def cut_angle(self) -> float:
        """Bevel of each cut plate, rad: the whole angle of a bevel, half of that of a V."""
        return 0.5 * self.angle if self.type in ("v", "double-v") else self.angle

    @property
    def is_cut(self) -> bool:
        return self.type not in ("square", "fillet", "double-fillet", SLOT)

    @property
    def is_fillet(self) -> bool:
        return self.type in ("fillet", "double-fillet")

    def depth(self, thickness: float) -> float:
        """Depth of the groove from its side, mm; of a double groove each side's."""
        if not self.is_cut:
            return 0.0
        depth = max(thickness - self.land, 0.0)
        return 0.5 * depth if self.type.startswith("double") else depth


_SIZES = ("angle", "land", "gap", "leg")
NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?")
"""A size of a preparation, mm or degrees."""


def prep_of(words: object, name: str = "") -> Prep:
    """The preparation of text such as `bevel angle=40 land=6 gap=2 inner backing=30x6`, angle in
    degrees; `name:` may come before it. Raises BendTorsionError for words that mean nothing."""
    text = str(words).strip()
    head, colon, rest = text.partition(":")
    name, text = (head.strip(), rest.strip()) if colon else (name or text, text)
    kind, *parts = text.split() or [""]
    given: dict[str, object] = {}
    try:
        if kind not in TYPES:
            raise ValueError(f"type {kind!r} is none of {', '.join(TYPES)}")
        for part in parts:
            key, equals, value = part.partition("=")
            if part in SIDES:
                given["side"] = part
            elif key == "backing" and equals:
                wide, thick = map(float, value.split("x"))
                given["backing"] = (wide, thick)
            elif key in _SIZES and NUMBER.fullmatch(value):
                given[key] = math.radians(float(value)) if key == "angle" else float(value)
            else:
                raise ValueError(f"{part!r} is no size of a preparation")
    except ValueError as problem:
        raise BendTorsionError(
            error(
                "prep",
                name,
                f"the preparation cannot be read: {problem}",
                "write it such as bevel angle=40 land=6 gap=2 outer backing=30x6",
                value=text,
            )
        ) from None
    return Prep(name, kind, **given)


def prep_text(prep: Prep) -> str:
    """The text of `prep_of`, its name before it when it has one of its own."""
    sizes = [f"angle={round(math.degrees(prep.angle), 9):g}"] if prep.angle else []
    sizes += [f"{key}={getattr(prep, key)!r}" for key in _SIZES[1:] if getattr(prep, key)]
    sizes += ["inner"] if prep.side == "inner" else []
    sizes += ["backing={!r}x{!r}".format(*prep.backing)] if prep.backing else []
    text = " ".join([prep.type, *sizes])
    return text if prep.name in ("", text) else f"{prep.name}: {text}"


def prep_findings(prep: Prep, thickness: float, name: str, where: str = "") -> list[Finding]:
    """Errors, about a member, of a preparation on a plate of this thickness: those of
    `own_findings`, and a land as thick as the plate."""
    findings = own_findings(prep, name, where)
    if prep.is_cut and prep.land >= thickness:
        findings.append(
            error(
                "prep-land",
                name,
                f"the land of preparation {prep.name} leaves no groove in the plate",
                "give a land smaller than the thickness, or type square",
                value=prep.land,
                limit=thickness,
                position=where,
                unit="mm",
            )
        )
    return findings


def own_findings(prep: Prep, name: str, where: str = "") -> list[Finding]:
    """Errors of a preparation whatever the plate: no angle, a backing bar where it is welded from
    both sides."""
    findings = []
    if prep.is_cut and not 0.0 < prep.angle < math.radians(150.0):
        findings.append(
            error(
                "prep-angle",
                name,
                f"preparation {prep.name} of type {prep.type} has no such groove angle",
                "give the included angle of the groove in degrees, more than 0 and less than 150",
                value=math.degrees(prep.angle),
                limit=150.0,
                position=where,
                unit="degrees",
            )
        )
    if prep.backing and prep.type.startswith("double"):
        findings.append(
            error(
                "prep-backing",
                name,
                f"preparation {prep.name} is welded from both sides and has a backing bar",
                "leave the backing empty, or weld from one side",
                position=where,
            )
        )
    return findings
