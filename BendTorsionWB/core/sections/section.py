# SPDX-License-Identifier: LGPL-2.1-or-later
"""A section: corners in (y, z) and the plate strips between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, Finding, error

BOX_TYPES = ("box1", "box2")
BOX_FACES = ("top", "bottom", "left", "right")
NEIGHBOURS = {
    "top": ("left", "right"),
    "bottom": ("left", "right"),
    "left": ("top", "bottom"),
    "right": ("top", "bottom"),
}


@dataclass(frozen=True)
class Material:
    """A steel grade: density kg/mm3, E and fy MPa."""

    name: str = "S355"
    density: float = 7.85e-6
    e: float = 206000.0
    fy: float = 355.0


STEEL = Material()
"""The grade of what names none."""


class Stop(NamedTuple):
    """Where an edge of a strip ends: gap mm clear of another strip's `inner` face, of its `outer`
    face, or of the `mitre` through both strips' outer and inner arrises."""

    face: str
    gap: float = 0.0
    at: str = "inner"


@dataclass(frozen=True)
class Strip:
    """One plate strip of a section, all numbers in the section's (y, z).

    first, second: indices of the corners its line runs between; the first edge carries the
    odd point numbers. inward: +1 when the plate lies to the left of first -> second seen along
    -x, -1 to its right. stops_at_first, stops_at_second: what its edges end at, or None to run
    to the corner and end square. edges: names of the first and second edge. line: depth in the
    plate at which the line runs, 0 on the outer face, 0.5 in the middle.
    """

    face: str
    letter: str
    first: int
    second: int
    thickness: float
    inward: int
    edges: tuple[str, str]
    stops_at_first: Stop | None = None
    stops_at_second: Stop | None = None
    line: float = 0.0

    @property
    def stops(self) -> tuple[Stop | None, Stop | None]:
        """What its first and its second edge end at."""
        return self.stops_at_first, self.stops_at_second


def strips_meet(one: Strip, other: Strip) -> bool:
    """True for strips with a corner in common, and where one stops at the other."""
    return bool({one.first, one.second} & {other.first, other.second}) or any(
        stop is not None and stop.face == b.face
        for a, b in ((one, other), (other, one))
        for stop in a.stops
    )


@dataclass(frozen=True)
class Section:
    """A section by its corners (n, 2), about the middle of its h and b, and its strips. mm.

    closed: the corners in their order are a ring of strips round a cell.
    """

    name: str
    type: str
    h: float
    b: float
    corners: tuple[tuple[float, float], ...]
    corner_names: tuple[str, ...]
    strips: tuple[Strip, ...]
    material: Material = Material()
    closed: bool = True

    @property
    def title(self) -> str:
        """Height x breadth x thicknesses, as steel detailers write it."""
        sizes = sorted({strip.thickness for strip in self.strips}, reverse=True)
        return f"{self.h:g}x{self.b:g}x" + "/".join(f"{t:g}" for t in sizes)


def box(
    name: str,
    type: str,
    h: float,
    b: float,
    t_top: float,
    t_bottom: float | None = None,
    t_web: float | None = None,
    gap1: float = 0.0,
    gap2: float = 0.0,
    material: Material = Material(),
) -> Section:
    """A welded box, h high and b wide over the outer faces.

    `box1`: webs full height, top and bottom between them, gap1 left and gap2 right. `box2`:
    flanges full breadth, webs between them, gap1 at the top and gap2 at the bottom (paper
    figure 7). Raises BendTorsionError when sizes cannot make a box.
    """
    t_bottom = t_top if t_bottom is None else t_bottom
    t_web = t_top if t_web is None else t_web
    findings = box_findings(name, type, h, b, t_top, t_bottom, t_web, gap1, gap2)
    if findings:
        raise BendTorsionError(findings)
    if type == "box1":
        flange_stops = (Stop("left", gap1), Stop("right", gap2))
        web_stops = (None, None)
    else:
        flange_stops = (None, None)
        web_stops = (Stop("top", gap1), Stop("bottom", gap2))
    corners = ((b / 2, h / 2), (-b / 2, h / 2), (-b / 2, -h / 2), (b / 2, -h / 2))
    across, down = ("left", "right"), ("top", "bottom")
    strips = (
        Strip("top", "T", 0, 1, t_top, 1, across, *flange_stops),
        Strip("bottom", "B", 3, 2, t_bottom, -1, across, *flange_stops),
        Strip("left", "L", 0, 3, t_web, -1, down, *web_stops),
        Strip("right", "R", 1, 2, t_web, 1, down, *web_stops),
    )
    return Section(name, type, h, b, corners, ("TL", "TR", "BR", "BL"), strips, material)


def box_findings(
    name: str,
    type: str,
    h: float,
    b: float,
    t_top: float,
    t_bottom: float,
    t_web: float,
    gap1: float,
    gap2: float,
) -> list[Finding]:
    """Errors of box sizes: not finite or positive, plates that fill the box, gaps too wide."""
    if type not in BOX_TYPES:
        return [
            error(
                "section-type",
                name,
                f"section type {type!r} is not supported yet",
                "use " + " or ".join(BOX_TYPES),
                value=type,
            )
        ]
    findings = size_findings(name, h=h, b=b, t_top=t_top, t_bottom=t_bottom, t_web=t_web)
    findings += [
        error(
            "section-gap",
            name,
            f"{key} must be zero or a positive length",
            f"give {key} in mm",
            value=float(value),
            limit=0.0,
            unit="mm",
        )
        for key, value in {"gap1": gap1, "gap2": gap2}.items()
        if not (np.isfinite(value) and value >= 0)
    ]
    if findings:
        return findings
    findings = thickness_findings(name, h, b, t_top, t_bottom, t_web)
    if findings:
        return findings
    clear = b - 2 * t_web if type == "box1" else h - t_top - t_bottom
    if gap1 + gap2 >= clear:
        findings.append(
            error(
                "gap-too-wide",
                name,
                "the root gaps leave no plate between its neighbours",
                "make gap1 and gap2 smaller",
                value=float(gap1 + gap2),
                limit=clear,
                unit="mm",
            )
        )
    elif clear - gap1 - gap2 < tolerances.NARROWEST_STRIP:
        findings.append(
            error(
                "strip-too-narrow",
                name,
                "the plate between its neighbours is hardly a plate",
                "use smaller gaps, thinner neighbours or a wider section",
                value=float(clear - gap1 - gap2),
                limit=tolerances.NARROWEST_STRIP,
                unit="mm",
            )
        )
    return findings


def size_findings(name: str, **sizes: float) -> list[Finding]:
    """Errors of sizes that are no lengths, hardly any, or larger than anything that is built."""
    return [
        error(
            "section-size",
            name,
            f"{key} must be a length, and one that can be made",
            f"give {key} in mm",
            value=float(value),
            limit=(
                tolerances.LARGEST_SIZE
                if value > tolerances.LARGEST_SIZE
                else tolerances.SMALLEST_SIZE
            ),
            unit="mm",
        )
        for key, value in sizes.items()
        if not tolerances.SMALLEST_SIZE <= value <= tolerances.LARGEST_SIZE
    ]


def thickness_findings(
    name: str, h: float, b: float, t_top: float, t_bottom: float, t_web: float
) -> list[Finding]:
    """Errors of plates that fill half the section or more."""
    return [
        error(
            "plate-too-thick",
            name,
            f"{key} fills half the section or more",
            f"make {key} thinner or {of} larger",
            value=float(thickness),
            limit=size / 2,
            unit="mm",
        )
        for key, thickness, size, of in (
            ("t_top", t_top, h, "h"),
            ("t_bottom", t_bottom, h, "h"),
            ("t_web", t_web, b, "b"),
        )
        if thickness >= size / 2
    ]
