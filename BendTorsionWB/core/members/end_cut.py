# SPDX-License-Identifier: LGPL-2.1-or-later
"""End cuts of members: square, plumb, level, in a plane or at a surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import tolerances
from ..axes.frames import Frames
from ..finding import BendTorsionError, Finding, error
from ..geometry.surface import Surface
from .contour import bracketed_roots
from .member import EndSurface, Member, MemberEnd, to_space

KINDS = ("square", "plumb", "level", "plane", "surface")
FLATTEST_CUT = np.radians(10.0)
"""Least angle, rad, between the axis and the cut that still ends a member."""
FARTHEST = 6.0
"""A cut is looked for up to this times the section's diagonal beyond the axis end."""
_BETWEEN_CORNERS = np.linspace(0.0, 1.0, 5)[:-1]
_PLACES = 129


@dataclass(frozen=True)
class EndCut:
    """What ends a member: `square` to the axis; `plumb`, in the upright plane across the axis;
    `level`; `plane`, by its normal and a point of it (None: the end of the axis); `surface`. All
    but the last two run through the end of the axis, moved outwards along its tangent by offset.
    """

    kind: str = "square"
    offset: float = 0.0
    normal: tuple[float, float, float] | None = None
    point: tuple[float, float, float] | None = None
    surface: Surface | None = None


SQUARE = EndCut()


@dataclass(frozen=True)
class PlaneEnd:
    """A plane by a point and its unit normal, which points to the side that stays."""

    point: tuple[float, float, float]
    normal: tuple[float, float, float]

    def value_and_gradient(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Signed distances (n,) and their gradients (n, 3)."""
        normal = np.array(self.normal)
        away = points - np.array(self.point)
        return (away * normal).sum(axis=1), np.broadcast_to(normal, points.shape)


@dataclass(frozen=True)
class SurfaceEnd:
    """A surface, less a distance along its normals; sign: +1 when its outer side stays."""

    surface: Surface
    sign: float
    offset: float = 0.0

    def value_and_gradient(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Signed distances (n,) and their gradients (n, 3)."""
        foot = self.surface.closest(points)
        return self.sign * foot.distance - self.offset, self.sign * foot.normals


def with_end_cuts(member: Member, cuts: Sequence[EndCut]) -> Member:
    """The member with its ends cut as asked (start, end).

    Raises BendTorsionError for a cut that cannot be placed, nearly runs along the axis, misses
    the section or reaches beyond its segment or the middle of the member.
    """
    if all(cut == SQUARE for cut in cuts):
        return member
    findings: list[Finding] = []
    ends: list[MemberEnd | None] = []
    for which, cut in enumerate(cuts):
        ends.append(None)
        if cut == SQUARE:
            continue
        try:
            surface = _surface(member, cut, which)
            ends[-1] = _ended(member, surface, cut, which)
        except BendTorsionError as problem:
            findings += problem.findings
    if findings:
        raise BendTorsionError(findings)
    return replace(member, ends=tuple(ends))


def _problem(member: Member, which: int, code: str, message: str, mend: str, **fields):
    return BendTorsionError(
        error(code, member.name, message, mend, position=("start", "end")[which], **fields)
    )


def _surface(member: Member, cut: EndCut, which: int) -> EndSurface:
    frames: Frames = member.frames
    if frames.axis.closed:
        raise _problem(
            member,
            which,
            "end-cut-closed",
            "a member on a closed axis has no ends to cut",
            "clear the cut",
            value=cut.kind,
        )
    if cut.kind not in KINDS:
        raise _problem(
            member,
            which,
            "end-cut-kind",
            f"end cut {cut.kind!r} is not known",
            f"use one of {', '.join(KINDS)}",
            value=str(cut.kind),
        )
    at = frames.at(np.array([member.length if which else 0.0]))
    tangent, end = at.x[0], at.origin[0]
    if cut.kind == "surface":
        if cut.surface is None:
            raise _problem(
                member, which, "end-cut-surface", "the surface to cut at is missing", "name one"
            )
        # Which side stays is told by the member's middle.
        middle = frames.at(np.array([0.5 * member.length])).origin
        side = float(cut.surface.closest(middle).distance[0])
        return SurfaceEnd(cut.surface, 1.0 if side >= 0.0 else -1.0, -cut.offset)
    normal = {
        "square": tangent,
        "plumb": tangent * [1.0, 1.0, 0.0],
        "level": np.array([0.0, 0.0, 1.0]),
        "plane": np.array(cut.normal if cut.normal is not None else (np.nan,) * 3, float),
    }[cut.kind]
    size = float(np.sqrt((normal * normal).sum()))
    if not (np.isfinite(size) and size > 1e-9):
        raise _problem(
            member,
            which,
            "end-cut-normal",
            "the axis is upright, so that there is no plumb cut across it"
            if cut.kind == "plumb"
            else "the normal of the cut has no length",
            "use square or level" if cut.kind == "plumb" else "give a normal such as 1 0 0",
            value=str(cut.normal) if cut.kind == "plane" else cut.kind,
        )
    inwards = -1.0 if which else 1.0
    normal = normal / size
    along = float((normal * tangent).sum())
    normal = normal * (inwards if along >= 0.0 else -inwards)
    point = end if cut.point is None else np.array(cut.point, float)
    point = point - inwards * cut.offset * tangent
    return PlaneEnd(tuple(point.tolist()), tuple(normal.tolist()))


def _ended(member: Member, surface: EndSurface, cut: EndCut, which: int) -> MemberEnd:
    """The end with the least and the greatest arc length at which the section is cut."""
    cell = member.law.cells[-1 if which else 0]
    length, inwards = member.length, -1.0 if which else 1.0
    corners = cell.corners_at(np.array([cell.end if which else cell.start]))[0]
    reach = FARTHEST * float(np.ptp(corners, axis=0).sum()) + abs(cut.offset)
    outer, middle = (length + reach, 0.5 * length) if which else (-reach, 0.5 * length)
    _check_angle(member, surface, which, outer, middle)
    places = np.linspace(outer, middle, _PLACES)
    points = _fibres(member, cell, places)
    side = surface.value_and_gradient(points.reshape(-1, 3))[0].reshape(points.shape[:2])
    stays = side >= 0.0
    if not stays[-1].all():
        raise _problem(
            member,
            which,
            "end-cut-beyond-middle",
            "the cut takes more than half of the member away",
            "move the cut outwards, or check its normal and point",
            value=float(-side[-1].min()),
            limit=0.0,
            unit="mm",
        )
    if stays.all(axis=0).any():
        raise _problem(
            member,
            which,
            "end-cut-misses",
            "the cut misses the member: it lies this far beyond it",
            "move it onto the member, or extend the axis",
            value=float(side.min(axis=0).max()),
            limit=0.0,
            unit="mm",
        )
    # The innermost change of side is the cut: a round surface may be crossed again farther out.
    last = len(places) - 2 - np.argmax((stays[1:] != stays[:-1])[::-1], axis=0)
    fibre = np.arange(points.shape[1])

    def step(s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        own = _fibres(member, cell, s)[fibre, fibre]
        ahead, behind = (_fibres(member, cell, s + d)[fibre, fibre] for d in (0.5, -0.5))
        value, gradient = surface.value_and_gradient(own)
        return value, (gradient * (ahead - behind)).sum(axis=1)

    low, high = places[last], places[last + 1]
    found = bracketed_roots(step, np.minimum(low, high), np.maximum(low, high))
    if isinstance(surface, SurfaceEnd):
        at = _fibres(member, cell, found)[fibre, fibre]
        beyond = surface.surface.closest(at).outside
        if beyond.any():
            raise _problem(
                member,
                which,
                "end-cut-misses",
                "the surface to cut at ends within the section",
                "use a larger face",
                value=int(beyond.sum()),
                limit=0,
            )
    least, greatest = float(found.min()), float(found.max())
    inner = least if which else greatest
    limit = cell.start if which else cell.end
    single = len(member.law.cells) == 1
    if not single and inwards * (limit - inner) < tolerances.SHORTEST_PLATE:
        raise _problem(
            member,
            which,
            "end-cut-in-transition",
            "the cut reaches into a transition or over a change of thickness",
            "move the transition away from the end, or cut steeper",
            value=inner,
            limit=limit,
            unit="mm",
        )
    return MemberEnd(surface, least, greatest)


def _check_angle(member, surface, which, outer, middle) -> None:
    """The angle between axis and cut, where the axis meets it."""
    s = np.linspace(outer, middle, _PLACES)
    at = member.frames.at(s)
    value, gradient = surface.value_and_gradient(at.origin)
    beyond = np.flatnonzero(value < 0.0)
    nearest = int(beyond[-1]) if len(beyond) else int(np.argmin(np.abs(value)))
    size = np.sqrt((gradient[nearest] ** 2).sum())
    angle = float(np.arcsin(min(1.0, abs((gradient[nearest] * at.x[nearest]).sum()) / size)))
    if angle < FLATTEST_CUT:
        raise _problem(
            member,
            which,
            "end-cut-along-axis",
            "the cut all but runs along the axis",
            "turn the cut across the axis",
            value=float(np.degrees(angle)),
            limit=float(np.degrees(FLATTEST_CUT)),
            unit="degrees",
        )


def _fibres(member: Member, cell, s: np.ndarray) -> np.ndarray:
    """Points (n, k, 3) of the section's outline at places s (n,) of the member, and beyond it."""
    corners = cell.corners_at(s)
    ends = np.array([(strip.first, strip.second) for strip in member.law.strips])
    first, second = corners[:, ends[:, 0]], corners[:, ends[:, 1]]
    between = [first + w * (second - first) for w in _BETWEEN_CORNERS]
    return to_space(member.frames.at(s), np.concatenate([corners, *between], axis=1))
