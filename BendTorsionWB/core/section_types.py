# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sections other than the welded box: I/H, tee, channel, polygonal boxes, free lists of strips.

All give the same thing, strips between corners, and nothing downstream asks which it was. Sizes
are mm over the outer faces; the origin is the middle of height and breadth.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from string import ascii_uppercase

import numpy as np

from .finding import BendTorsionError, Finding, error
from .section import BOX_TYPES, STEEL, Material, Section, Stop, Strip, box
from .strip_lines import section_polygons

TYPES = (*BOX_TYPES, "i", "tee", "channel", "trapezoid", "polygon", "strips")
CORNER_JOINTS = ("mitre", "flanges", "webs", "ring")
SIDES = {"left": (1, 0.0), "right": (-1, 0.0), "middle": (1, 0.5)}

_ACROSS, _DOWN = ("left", "right"), ("top", "bottom")


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
    t_bottom, t_web = t_bottom or t_top, t_web or t_top
    _sized(name, h=h, b=b, b_bottom=b_bottom, t_top=t_top, t_bottom=t_bottom, t_web=t_web)
    _thin(name, h, min(b, b_bottom), t_top, t_bottom, t_web)
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
    return _checked(
        Section(name, "i", h, max(b, b_bottom), corners, names, strips, material, False)
    )


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
    t_web = t_web or t_top
    _sized(name, h=h, b=b, t_top=t_top, t_web=t_web)
    _thin(name, h, b, t_top, t_top, t_web)
    corners = ((b / 2, h / 2), (-b / 2, h / 2), (0.0, h / 2), (0.0, -h / 2))
    strips = (
        Strip("top", "T", 0, 1, t_top, 1, _ACROSS),
        Strip("web", "W", 2, 3, t_web, -1, _DOWN, Stop("top", gap1), None, 0.5),
    )
    names = ("TL", "TR", "WT", "WB")
    return _checked(Section(name, "tee", h, b, corners, names, strips, material, False))


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
    t_bottom, t_web = t_bottom or t_top, t_web or t_top
    _sized(name, h=h, b=b, t_top=t_top, t_bottom=t_bottom, t_web=t_web)
    _thin(name, h, b, t_top, t_bottom, t_web)
    corners = ((b / 2, h / 2), (-b / 2, h / 2), (-b / 2, -h / 2), (b / 2, -h / 2))
    strips = (
        Strip("top", "T", 0, 1, t_top, 1, _ACROSS),
        Strip("bottom", "B", 3, 2, t_bottom, -1, _ACROSS),
        Strip("web", "W", 0, 3, t_web, -1, _DOWN, Stop("top", gap1), Stop("bottom", gap2)),
    )
    names = ("TL", "TR", "BR", "BL")
    return _checked(Section(name, "channel", h, b, corners, names, strips, material, False))


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
    t_bottom, t_web = t_bottom or t_top, t_web or t_top
    _sized(name, h=h, b=b, b_bottom=b_bottom, t_top=t_top, t_bottom=t_bottom, t_web=t_web)
    _thin(name, h, min(b, b_bottom), t_top, t_bottom, t_web)
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
        raise BendTorsionError(_unknown(name, "joint", joint, CORNER_JOINTS[:3]))
    strips = (
        Strip("top", "T", 0, 1, t_top, 1, _ACROSS, *across),
        Strip("bottom", "B", 3, 2, t_bottom, -1, _ACROSS, *across),
        Strip("left", "L", 0, 3, t_web, -1, _DOWN, *down),
        Strip("right", "R", 1, 2, t_web, 1, _DOWN, *down),
    )
    names = ("TL", "TR", "BR", "BL")
    return _checked(
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
        raise BendTorsionError(_unknown(name, "joint", joint, ("mitre", "ring")))
    sizes = np.broadcast_to(np.asarray(thickness, float), (count,)).tolist()
    _sized(name, **{f"t{k + 1}": t for k, t in enumerate(sizes)})
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
    return _centred(name, "polygon", points, names, strips, material, True)


def ring_of_sides(sides: Sequence[float], angles: Sequence[float]) -> np.ndarray:
    """Corners (n, 2) of a closed ring from the lengths of its first n - 1 sides and the inner
    angles (rad) at the corners between them; the first side runs at the top towards -y, the last
    one closes."""
    headings = np.pi + np.concatenate([[0.0], np.cumsum(np.pi - np.asarray(angles, float))])
    lengths = np.asarray(sides, float)
    steps = lengths[:, None] * np.column_stack([np.cos(headings), np.sin(headings)])
    return np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])


@dataclass(frozen=True)
class StripRow:
    """A row of a free strip list: a plate from (y1, z1) to (y2, z2), mm.

    side: where the plate lies from its line, walking it seen along -x: `left`, `right`, or
    `middle`. stop1, stop2: what its ends stop at: `face`, on the side the strip comes from, or
    `face inner`, `face outer`, `face mitre`, each with a gap as `face 3`; empty to end square.
    """

    face: str
    letter: str
    y1: float
    z1: float
    y2: float
    z2: float
    t: float
    side: str = "middle"
    stop1: str = ""
    stop2: str = ""


def strip_list(name: str, rows: Sequence[StripRow], material: Material = STEEL) -> Section:
    """A section from a table of strips; ends at the same place share a corner. Raises
    BendTorsionError naming the row for what makes no section."""
    findings: list[Finding] = []
    faces = [row.face for row in rows]
    letters = [row.letter for row in rows]
    points: list[tuple[float, float]] = []
    strips = []
    for number, row in enumerate(rows, start=1):
        place = f"strip {number}"
        if row.side not in SIDES:
            findings.append(replace(_unknown(name, "side", row.side, SIDES), position=place))
        if not row.face or faces.count(row.face) > 1 or letters.count(row.letter) > 1:
            findings.append(
                error(
                    "strip-name",
                    name,
                    "two strips have the same face or letter, or one has none",
                    "give each strip its own",
                    position=place,
                    value=f"{row.face} {row.letter}",
                )
            )
        stops = []
        for text, far in ((row.stop1, (row.y2, row.z2)), (row.stop2, (row.y1, row.z1))):
            try:
                stops.append(_stop(text, [other for other in rows if other is not row], far))
            except ValueError as problem:
                findings.append(
                    error(
                        "strip-stop",
                        name,
                        str(problem),
                        "write a face of the list, then outer or mitre if not its inner face, then "
                        "a gap in mm",
                        position=place,
                        value=text,
                    )
                )
        ends = []
        for end in ((float(row.y1), float(row.z1)), (float(row.y2), float(row.z2))):
            if end not in points:
                points.append(end)
            ends.append(points.index(end))
        if row.side in SIDES and len(stops) == 2:
            inward, line = SIDES[row.side]
            strips.append(
                Strip(row.face, row.letter, *ends, row.t, inward, ("first", "second"), *stops, line)
            )
    if findings or not strips:
        raise BendTorsionError(
            findings
            or error("section-strips", name, "the section has no strips", "add a row per plate")
        )
    _sized(name, **{f"t of {row.face}": row.t for row in rows})
    names = tuple(f"C{k + 1}" for k in range(len(points)))
    return _centred(name, "strips", np.array(points), names, strips, material, False)


def _stop(text: str, rows: Sequence[StripRow], far: tuple[float, float]) -> Stop | None:
    words = text.split()
    if not words:
        return None
    other = next((row for row in rows if row.face == words[0]), None)
    if other is None:
        raise ValueError(f"there is no other strip {words[0]!r} to stop at")
    if len(words) > 1 and words[1] in ("inner", "outer", "mitre"):
        at, rest = words[1], words[2:]
    else:
        y, z, dy, dz = other.y1, other.z1, other.y2 - other.y1, other.z2 - other.z1
        left = dy * (far[1] - z) - dz * (far[0] - y) > 0
        at = "inner" if left == (SIDES.get(other.side, (1,))[0] > 0) else "outer"
        rest = words[1:]
    try:
        gap = float(rest[0]) if rest else 0.0
    except ValueError:
        raise ValueError(f"{rest[0]!r} is no gap") from None
    return Stop(words[0], gap, at)


def _centred(name, kind, points, names, strips, material, closed) -> Section:
    low, high = points.min(axis=0), points.max(axis=0)
    breadth, height = (high - low).tolist()
    corners = tuple(map(tuple, (points - 0.5 * (low + high)).tolist()))
    return _checked(
        Section(name, kind, height, breadth, corners, names, tuple(strips), material, closed)
    )


def _sized(name: str, **sizes: float) -> None:
    """Raises BendTorsionError for sizes that are no positive lengths."""
    findings = [
        error(
            "section-size",
            name,
            f"{key} must be a positive length",
            f"give {key} in mm",
            value=float(value),
            limit=0.0,
            unit="mm",
        )
        for key, value in sizes.items()
        if not (np.isfinite(value) and value > 0)
    ]
    if findings:
        raise BendTorsionError(findings)


def _thin(name: str, h: float, b: float, t_top: float, t_bottom: float, t_web: float) -> None:
    """Raises BendTorsionError for plates that fill half the section or more."""
    findings = [
        error(
            "plate-too-thick",
            name,
            f"{key} fills half the section or more",
            f"make {key} thinner or {of} larger",
            value=float(t),
            limit=size / 2,
            unit="mm",
        )
        for key, t, size, of in (
            ("t_top", t_top, h, "h"),
            ("t_bottom", t_bottom, h, "h"),
            ("t_web", t_web, b, "b"),
        )
        if t >= size / 2
    ]
    if findings:
        raise BendTorsionError(findings)


def _unknown(name: str, what: str, value, known: Sequence[str]) -> Finding:
    return error(
        f"section-{what}",
        name,
        f"{what} {value!r} is not known",
        f"use {', '.join(known)}",
        value=str(value),
    )


def _checked(section: Section) -> Section:
    """The section; raises BendTorsionError for gaps below zero, plates without breadth between
    their neighbours, and plates that overlap."""
    findings = []
    for strip in section.strips:
        for stop in (strip.stops_at_first, strip.stops_at_second):
            if stop and not (np.isfinite(stop.gap) and stop.gap >= 0):
                findings.append(
                    error(
                        "section-gap",
                        section.name,
                        "gap must be zero or a positive length",
                        "give the gap in mm",
                        position=f"face {strip.face}",
                        value=float(stop.gap),
                        limit=0.0,
                        unit="mm",
                    )
                )
    if findings:
        raise BendTorsionError(findings)
    with np.errstate(divide="ignore", invalid="ignore"):
        plates = section_polygons(section)
    corners = np.array(section.corners)
    for strip, plate in zip(section.strips, plates, strict=True):
        along = corners[strip.second] - corners[strip.first]
        breadths = [(plate[1] - plate[0]) @ along, (plate[2] - plate[3]) @ along]
        clear = min(breadths) / max(float(np.hypot(*along)), 1e-9)
        if not clear > 1e-6:
            findings.append(
                error(
                    "gap-too-wide",
                    section.name,
                    "nothing is left of the plate between its neighbours",
                    "use smaller gaps, thinner neighbours or a wider section",
                    position=f"face {strip.face}",
                    value=float(clear),
                    limit=0.0,
                    unit="mm",
                )
            )
    if not findings:
        findings += [
            error(
                "plates-overlap",
                section.name,
                f"plates {one.face} and {other.face} overlap",
                "let one stop at the other, or make them thinner",
            )
            for i, one in enumerate(section.strips)
            for j, other in enumerate(section.strips[:i])
            if overlap(plates[i], plates[j]) > 1e-6
        ]
    if findings:
        raise BendTorsionError(findings)
    return section


def overlap(one: np.ndarray, other: np.ndarray) -> float:
    """How deep two convex polygons (n, 2) enter each other, mm; below zero when they are clear."""
    depths = []
    for ring in (one, other):
        edges = np.roll(ring, -1, axis=0) - ring
        normals = np.column_stack([-edges[:, 1], edges[:, 0]])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        a, b = one @ normals.T, other @ normals.T
        depths.append(np.minimum(a.max(axis=0) - b.min(axis=0), b.max(axis=0) - a.min(axis=0)))
    return float(np.concatenate(depths).min())


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
        raise BendTorsionError(_unknown(name, "type", type, TYPES))
    maker = makers[type]
    taken = maker.__code__.co_varnames[1 : maker.__code__.co_argcount]
    return maker(name, **{k: v for k, v in sizes.items() if k in taken}, material=material)
