# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sections other than the welded box: I/H, tee, channel, polygonal boxes.

All give the same thing, strips between corners, and nothing downstream asks which it was. Sizes
are mm over the outer faces; the origin is the middle of height and breadth.
"""

from __future__ import annotations

from collections.abc import Sequence
from string import ascii_uppercase

import numpy as np

from ..finding import BendTorsionError, error
from .section import (
    BOX_TYPES,
    STEEL,
    Material,
    Section,
    Stop,
    Strip,
    box,
    size_findings,
    thickness_findings,
)
from .section_checks import centred, checked, refuse, unknown
from .section_strips import strip_list

TYPES = (*BOX_TYPES, "i", "tee", "channel", "trapezoid", "polygon", "strips")
CORNER_JOINTS = ("mitre", "flanges", "webs", "ring")

_ACROSS, _DOWN = ("left", "right"), ("top", "bottom")


def _thicknesses(
    name: str,
    h: float,
    t_top: float,
    t_bottom: float | None,
    t_web: float | None,
    **breadths: float,
) -> tuple[float, float]:
    """Thicknesses of the bottom and the web, that of the top where none is given; breadths by name.
    Raises BendTorsionError for sizes that make no section."""
    t_bottom = t_top if t_bottom is None else t_bottom
    t_web = t_top if t_web is None else t_web
    refuse(size_findings(name, h=h, **breadths, t_top=t_top, t_bottom=t_bottom, t_web=t_web))
    refuse(thickness_findings(name, h, min(breadths.values()), t_top, t_bottom, t_web))
    return t_bottom, t_web


def i_section(
    name: str,
    h: float,
    b: float,
    t_top: float,
    t_bottom: float | None = None,
    t_web: float | None = None,
    gap1: float = 0.0,
    gap2: float = 0.0,
    b_bottom: float | None = None,
    material: Material = STEEL,
) -> Section:
    """An I or H: flanges b (the bottom one b_bottom) wide, the web in their middle between them,
    gap1 at the top and gap2 at the bottom. Raises BendTorsionError for sizes that make none."""
    b_bottom = b if b_bottom is None else b_bottom
    t_bottom, t_web = _thicknesses(name, h, t_top, t_bottom, t_web, b=b, b_bottom=b_bottom)
    corners = (
        (b / 2, h / 2),
        (-b / 2, h / 2),
        (-b_bottom / 2, -h / 2),
        (b_bottom / 2, -h / 2),
        (0.0, h / 2),
        (0.0, -h / 2),
    )
    strips = (
        Strip("top", "T", 0, 1, t_top, 1, _ACROSS),
        Strip("bottom", "B", 3, 2, t_bottom, -1, _ACROSS),
        Strip("web", "W", 4, 5, t_web, -1, _DOWN, Stop("top", gap1), Stop("bottom", gap2), 0.5),
    )
    names = ("TL", "TR", "BR", "BL", "WT", "WB")
    return checked(Section(name, "i", h, max(b, b_bottom), corners, names, strips, material, False))


def t_section(
    name: str,
    h: float,
    b: float,
    t_top: float,
    t_web: float | None = None,
    gap1: float = 0.0,
    material: Material = STEEL,
) -> Section:
    """A tee: a flange b wide at the top, the web under its middle, gap1 between them."""
    t_web = t_top if t_web is None else t_web
    refuse(size_findings(name, h=h, b=b, t_top=t_top, t_web=t_web))
    refuse(thickness_findings(name, h, b, t_top, t_top, t_web))
    corners = ((b / 2, h / 2), (-b / 2, h / 2), (0.0, h / 2), (0.0, -h / 2))
    strips = (
        Strip("top", "T", 0, 1, t_top, 1, _ACROSS),
        Strip("web", "W", 2, 3, t_web, -1, _DOWN, Stop("top", gap1), None, 0.5),
    )
    names = ("TL", "TR", "WT", "WB")
    return checked(Section(name, "tee", h, b, corners, names, strips, material, False))


def channel(
    name: str,
    h: float,
    b: float,
    t_top: float,
    t_bottom: float | None = None,
    t_web: float | None = None,
    gap1: float = 0.0,
    gap2: float = 0.0,
    material: Material = STEEL,
) -> Section:
    """A channel open to the right: flanges b wide, the web on the left between them, gap1 at the
    top and gap2 at the bottom."""
    t_bottom, t_web = _thicknesses(name, h, t_top, t_bottom, t_web, b=b)
    corners = ((b / 2, h / 2), (-b / 2, h / 2), (-b / 2, -h / 2), (b / 2, -h / 2))
    strips = (
        Strip("top", "T", 0, 1, t_top, 1, _ACROSS),
        Strip("bottom", "B", 3, 2, t_bottom, -1, _ACROSS),
        Strip("web", "W", 0, 3, t_web, -1, _DOWN, Stop("top", gap1), Stop("bottom", gap2)),
    )
    names = ("TL", "TR", "BR", "BL")
    return checked(Section(name, "channel", h, b, corners, names, strips, material, False))


def trapezoid(
    name: str,
    h: float,
    b: float,
    b_bottom: float,
    t_top: float,
    t_bottom: float | None = None,
    t_web: float | None = None,
    gap1: float = 0.0,
    gap2: float = 0.0,
    joint: str = "flanges",
    material: Material = STEEL,
) -> Section:
    """A box with sloping webs, b wide at the top and b_bottom at the bottom.

    joint: which plates run to the corner, bevelled flush with the others' outer faces: `flanges`
    (gap1 top, gap2 bottom) or `webs` (gap1 left, gap2 right); or `mitre` (no gaps).
    """
    t_bottom, t_web = _thicknesses(name, h, t_top, t_bottom, t_web, b=b, b_bottom=b_bottom)
    corners = ((b / 2, h / 2), (-b / 2, h / 2), (-b_bottom / 2, -h / 2), (b_bottom / 2, -h / 2))
    if joint == "flanges":
        across = (Stop("left", 0.0, "outer"), Stop("right", 0.0, "outer"))
        down = (Stop("top", gap1), Stop("bottom", gap2))
    elif joint == "webs":
        across = (Stop("left", gap1), Stop("right", gap2))
        down = (Stop("top", 0.0, "outer"), Stop("bottom", 0.0, "outer"))
    elif joint == "mitre":
        across = (Stop("left", 0.0, "mitre"), Stop("right", 0.0, "mitre"))
        down = (Stop("top", 0.0, "mitre"), Stop("bottom", 0.0, "mitre"))
    else:
        raise BendTorsionError(unknown(name, "joint", joint, CORNER_JOINTS[:3]))
    strips = (
        Strip("top", "T", 0, 1, t_top, 1, _ACROSS, *across),
        Strip("bottom", "B", 3, 2, t_bottom, -1, _ACROSS, *across),
        Strip("left", "L", 0, 3, t_web, -1, _DOWN, *down),
        Strip("right", "R", 1, 2, t_web, 1, _DOWN, *down),
    )
    names = ("TL", "TR", "BR", "BL")
    return checked(
        Section(name, "trapezoid", h, max(b, b_bottom), corners, names, strips, material)
    )


def polygon(
    name: str,
    corners: Sequence[Sequence[float]],
    thickness: float | Sequence[float],
    joint: str = "mitre",
    gap: float = 0.0,
    material: Material = STEEL,
) -> Section:
    """A closed ring of plates between corners (n, 2) in (y, z), n >= 3, in either sense.

    Plates are `side1`, `side2`, … from the corners as given, marked A, B, …; thickness: one, or
    one per side. joint: `mitre`, or `ring`: each plate runs over the one after it at its second
    corner, and stops gap clear of the one before at its first.
    """
    points = np.asarray(corners, float)
    count = len(points)
    if points.ndim != 2 or points.shape[1] != 2 or not 3 <= count <= len(ascii_uppercase):
        raise BendTorsionError(
            error(
                "section-corners",
                name,
                "a polygonal box needs 3 to 26 corners (y, z)",
                "give a corner per plate",
                value=count,
                limit="3 to 26",
            )
        )
    if joint not in ("mitre", "ring"):
        raise BendTorsionError(unknown(name, "joint", joint, ("mitre", "ring")))
    sizes = np.broadcast_to(np.asarray(thickness, float), (count,)).tolist()
    refuse(size_findings(name, **{f"t{k + 1}": t for k, t in enumerate(sizes)}))
    following = np.roll(points, -1, axis=0)
    area = 0.5 * (points[:, 0] * following[:, 1] - points[:, 1] * following[:, 0]).sum()
    faces = [f"side{k + 1}" for k in range(count)]
    strips = []
    for k, face in enumerate(faces):
        before, after = faces[k - 1], faces[(k + 1) % count]
        stops = (
            (Stop(before, gap, "mitre"), Stop(after, gap, "mitre"))
            if joint == "mitre"
            else (Stop(before, gap), Stop(after, 0.0, "outer"))
        )
        strips.append(
            Strip(
                face,
                ascii_uppercase[k],
                k,
                (k + 1) % count,
                sizes[k],
                1 if area > 0 else -1,
                (before, after),
                *stops,
            )
        )
    names = tuple(f"C{k + 1}" for k in range(count))
    return centred(name, "polygon", points, names, strips, material, True)


def ring_of_sides(sides: Sequence[float], angles: Sequence[float]) -> np.ndarray:
    """Corners (n, 2) of a closed ring from the lengths of its first n - 1 sides and the inner
    angles (rad) at the corners between them; the first side runs at the top towards -y, the last
    one closes."""
    headings = np.pi + np.concatenate([[0.0], np.cumsum(np.pi - np.asarray(angles, float))])
    lengths = np.asarray(sides, float)
    steps = lengths[:, None] * np.column_stack([np.cos(headings), np.sin(headings)])
    return np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])


def section_of(name: str, type: str, material: Material = STEEL, **sizes) -> Section:
    """The section of a type (`TYPES`) from the sizes its constructor takes; what it does not take
    is left aside. Raises BendTorsionError for an unknown type and sizes that make none."""
    makers = {
        "i": i_section,
        "tee": t_section,
        "channel": channel,
        "trapezoid": trapezoid,
        "polygon": polygon,
        "strips": strip_list,
    }
    if type in BOX_TYPES:
        wanted = ("h", "b", "t_top", "t_bottom", "t_web", "gap1", "gap2")
        return box(name, type, **{k: sizes[k] for k in wanted if k in sizes}, material=material)
    if type not in makers:
        raise BendTorsionError(unknown(name, "type", type, TYPES))
    maker = makers[type]
    taken = maker.__code__.co_varnames[1 : maker.__code__.co_argcount]
    return maker(name, **{k: v for k, v in sizes.items() if k in taken}, material=material)
