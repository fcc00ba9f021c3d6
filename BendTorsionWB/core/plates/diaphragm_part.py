# SPDX-License-Identifier: LGPL-2.1-or-later
"""One diaphragm or end plate: its contour, and what it asks of the walls.

A diaphragm is plane and normal to the axis. Walls twist and taper, so its sides keep the gap from
the walls over its whole thickness: each is straight, along its wall, and as far in as the nearest
place of the wall asks. An end plate lies outside the square end of the section, against it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, error
from ..geometry import arc_contour
from ..lofting import WeldedSide
from ..members.member import Member
from ..sections.strip_lines import crossing
from .diaphragm_input import ENDS, SLOT_LENGTH, SLOT_PITCH, SLOT_SIDE
from .flat_plate import FlatPlate
from .hole_shape import HoleShape
from .openings import Cut
from .plate_places import PlateMark, nearest_places, places_along, rates, spot_at, surface_point
from .plates import Plate

WELDED_GAP = 5.0
"""mm; a fillet bridges no wider gap (AWS D1.1 7.21.1, 3/16 in)."""

_ACROSS = np.linspace(0.0, 1.0, 33)
_HEIGHTS = np.linspace(-1.0, 1.0, 5)
_PASSES = 3


class FlatPart:
    """One flat part in the making: the ring of its walls in its plane, and its contour."""

    def __init__(self, member, plates, row, place, mark, source):
        self.member, self.plates, self.row, self.source = member, plates, row, source
        at_end = {"start": 0.0, "end": member.length}.get(row.end)
        self.s = place if at_end is None else at_end
        self.half = 0.0 if row.end else 0.5 * row.thickness
        at = member.frames.at(np.array([self.s]))
        self.x, self.y, self.z = at.x[0], at.y[0], at.z[0]
        # Planes are measured from the axis at s; an end plate's middle lies outside it.
        self.origin = at.origin[0]
        self.level = "outer" if row.end else "inner"
        ring, self.walls = _ring(member)
        gaps = np.full(len(ring), row.gap)
        closing = row.closing
        if closing and closing.gap is not None:
            gaps = np.where([face == closing.face for face in self.walls], closing.gap, gaps)
        self.gaps = gaps
        self.corners = self._corners(ring, gaps)
        self.contour = self._contour()
        frame = np.eye(4)
        frame[:3, :3] = np.column_stack([self.y, self.z, self.x])
        frame[:3, 3] = self.origin + (place - self.s) * self.x
        holes = self._manhole()
        cells = member.law.cells
        cell = next((c for c in cells if c.start <= self.s < c.end), cells[-1])
        self.flat = FlatPlate(
            member=member.name,
            mark=mark,
            face="end" if row.end else "diaphragm",
            letter="E" if row.end else "D",
            piece=1,
            thickness=row.thickness,
            material=row.material or cell.materials[0],
            frame=frame,
            outline=self.contour,
            s=float(place),
            holes=holes,
            hole_titles=tuple(row.manhole.title for _ in holes),
        )
        self._check_ends()
        self.marks = [] if row.end else self._marks()
        self.cuts = self._slots() if closing and closing.kind == "slot" else []
        self.flat = replace(self.flat, sides=tuple(self._welded(ring)))

    def fault(self, code, message, mend, value=None, limit=None) -> BendTorsionError:
        return BendTorsionError(
            error(
                code,
                self.member.name,
                message,
                mend,
                position=self.source,
                value=value,
                limit=limit,
                unit="" if value is None else "mm",
            )
        )

    def in_plane(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Points (n, 2) of the part's plane below points (n, 3), and their heights over it."""
        off = points - self.origin
        return (
            np.column_stack([(off * self.y).sum(axis=1), (off * self.z).sum(axis=1)]),
            (off * self.x).sum(axis=1),
        )

    def wall_plates(self, face: str) -> list[int]:
        """The plates of a face within the part's thickness."""
        low, high = self.s - self.half, self.s + self.half
        slack = tolerances.SAME_STATION
        return [
            k
            for k, plate in enumerate(self.plates)
            if plate.face == face and plate.start <= high + slack and plate.end >= low - slack
        ]

    def _samples(self, face: str, along, low: float, high: float):
        """Places of a wall in the plane (n, 2) between low and high along its line, and the
        steepest slope of the wall against the axis there."""
        points, slopes = [], [0.0]
        for k in self.wall_plates(face):
            plate = self.plates[k]
            rails = getattr(plate.rails, self.level)
            ends, _ = self.in_plane(
                surface_point(rails, np.full(2, self._on(plate)), np.array([0.0, 1.0]))
            )
            first, second = (ends * along).sum(axis=1)
            span = np.sort((np.array([low, high]) - first) / (second - first))
            if plate.lane.letter:
                span = span.clip(0.0, 1.0)
                if span[1] - span[0] <= 0.0:
                    continue
            w = span[0] + _ACROSS * (span[1] - span[0])
            heights = _HEIGHTS * self.half if self.half else np.zeros(1)
            wide, high_of = np.tile(w, len(heights)), np.repeat(heights, len(w))
            s = self._at_height(plate, rails, wide, high_of)
            folds = getattr(plate.rails, f"{self.level}_folds")
            s = np.concatenate([s, np.repeat(np.array(folds, float), len(w))])
            wide = np.concatenate([wide, np.tile(w, len(folds))])
            plane, height = self.in_plane(surface_point(rails, s, wide))
            near = np.abs(height) <= self.half + tolerances.SAME_STATION
            points.append(plane[near])
            by_s, by_w = rates(rails, s[near], wide[near])
            normal = np.cross(by_s, by_w)
            tilt = np.abs((normal * self.x).sum(axis=1))
            level = (normal * self.y).sum(axis=1) ** 2 + (normal * self.z).sum(axis=1) ** 2
            slopes.append(float((tilt / np.sqrt(level)).max(initial=0.0)))
        return np.concatenate(points), max(slopes)

    def _on(self, plate: Plate) -> float:
        return float(min(max(self.s, plate.start), plate.end))

    def _at_height(self, plate: Plate, rails, w: np.ndarray, height: np.ndarray) -> np.ndarray:
        """s (n,) where the lines of constant w are `height` over the part's plane, or the end of
        the plate before that."""
        s = np.full(len(w), self._on(plate))
        for _ in range(20):
            _, reached = self.in_plane(surface_point(rails, s, w))
            rate = (rates(rails, s, w)[0] * self.x).sum(axis=1)
            step = (height - reached) / rate
            s = np.minimum(np.maximum(s + step, plate.start), plate.end)
            if np.abs(step).max() <= 1e-9:
                break
        return s

    def _corners(self, ring: np.ndarray, gaps: np.ndarray) -> np.ndarray:
        """Corners (m, 2) of the contour before the snipes, counter-clockwise as the walls."""
        count = len(ring)
        corners = ring
        for done in range(_PASSES):
            lines = np.empty((count, 2, 2))
            for k, face in enumerate(self.walls):
                a, b = corners[k], corners[(k + 1) % count]
                if done == 0:
                    a, b = self._wall_line(face, a, b)
                along = (b - a) / np.hypot(*(b - a))
                inward = np.array([-along[1], along[0]])
                low, high = float((a * along).sum()), float((b * along).sum())
                points, slope = self._samples(face, along, low, high)
                if self.half == 0.0:
                    slope = 0.0
                nearest = float((points * inward).sum(axis=1).max())
                base = (nearest + gaps[k] * np.sqrt(1.0 + slope * slope)) * inward
                lines[k] = base + low * along, base + high * along
            corners = crossing(np.roll(lines, 1, axis=0), lines)
            sides = np.roll(corners, -1, axis=0) - corners
            if ((sides * (lines[:, 1] - lines[:, 0])).sum(axis=1) <= 0.0).any():
                raise self.fault(
                    "diaphragm-no-room",
                    "the gaps leave no plate between the walls",
                    "make the gap smaller",
                    float(gaps.max()),
                )
        self.lines = lines
        return corners

    def _wall_line(self, face: str, a: np.ndarray, b: np.ndarray):
        """Ends of the wall's line in the plane, in the sense from a to b."""
        ends = []
        for k in self.wall_plates(face):
            plate = self.plates[k]
            rails = getattr(plate.rails, self.level)
            at = np.full(2, self._on(plate))
            ends.append(self.in_plane(surface_point(rails, at, np.array([0.0, 1.0])))[0])
        if not ends:
            raise self.fault("diaphragm-outside", f"face {face} has no plate there", "move it")
        ends = np.concatenate(ends)
        along = (ends * (b - a)).sum(axis=1)
        return ends[int(np.argmin(along))], ends[int(np.argmax(along))]

    def _contour(self) -> np.ndarray:
        snipe = self.row.snipe
        corners = self.corners
        before, after = np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0)
        to_before = np.sqrt(((before - corners) ** 2).sum(axis=1))
        to_after = np.sqrt(((after - corners) ** 2).sum(axis=1))
        if snipe <= 0.0:
            return _from_lower_left(arc_contour.polygon(corners))
        if 2.0 * snipe >= to_after.min():
            raise self.fault(
                "diaphragm-snipe",
                "the snipes leave nothing of a side",
                "make the snipe smaller",
                snipe,
                0.5 * float(to_after.min()),
            )
        cut = np.stack(
            [
                corners + snipe * (before - corners) / to_before[:, None],
                corners + snipe * (after - corners) / to_after[:, None],
            ],
            axis=1,
        )
        return _from_lower_left(arc_contour.polygon(cut.reshape(-1, 2)))

    def _manhole(self) -> tuple[np.ndarray, ...]:
        shape = self.row.manhole
        if shape is None:
            return ()
        middle = arc_contour.centroid(self.contour) + np.array(self.row.manhole_offset)
        hole = arc_contour.moved(shape.contour, shift=middle)
        ring = np.concatenate(arc_contour.fine_runs(hole, 20.0))
        ligament = arc_contour.clearance(self.contour, ring)
        if ligament < tolerances.MANHOLE_LIGAMENT:
            raise self.fault(
                "manhole-ligament",
                f"the manhole {shape.title} leaves too little plate beside it",
                "make it smaller, or move it",
                ligament,
                tolerances.MANHOLE_LIGAMENT,
            )
        return (hole,)

    def _check_ends(self) -> None:
        """Raises where a cut end of the member runs into the part."""
        for cut, name in zip(self.member.ends, ENDS, strict=True):
            if cut is None:
                continue
            corners = self.contour[:, :2]
            points = np.concatenate(
                [self.flat.in_model(corners, side * self.half) for side in (-1.0, 1.0)]
            )
            side, _ = cut.surface.value_and_gradient(points)
            if not (side > 0.0).all():
                raise self.fault(
                    "diaphragm-outside",
                    f"the cut at the member's {name} runs into it",
                    "move it away from the end",
                    float(self.s),
                )

    def _along_wall(self, face: str, side: tuple[np.ndarray, np.ndarray], height: float, parts):
        """Where the plane at `height` meets the inner face of a wall, at parts (n,) of a side of
        the contour: per plate its index and places s, w on the mid-surface of those on it."""
        along = side[1] - side[0]
        length = np.hypot(*along)
        along = along / length
        direction = along[0] * self.y + along[1] * self.z
        start = float((side[0] * along).sum())
        wanted = np.column_stack([np.full(len(parts), height), start + parts * length])
        for k in self.wall_plates(face):
            plate = self.plates[k]
            rails = plate.rails.inner
            first = (self._on(plate), 0.5)
            s, w, found = places_along(rails, self.origin, self.x, direction, wanted, first)
            slack = tolerances.SAME_STATION
            found &= (s >= plate.start - slack) & (s <= plate.end + slack)
            found &= (w >= 0.0) & (w <= 1.0)
            if not found.any():
                continue
            points = surface_point(rails, s[found], w[found])
            feet = nearest_places(plate.rails.mid, points, (s[found], w[found]))
            yield k, found, np.column_stack(feet)

    def _sides(self):
        """Per wall its face and the ends of its side of the contour, between the snipes."""
        corners, snipe = self.corners, max(self.row.snipe, 0.0)
        for k, face in enumerate(self.walls):
            a, b = corners[k], corners[(k + 1) % len(corners)]
            step = snipe * (b - a) / np.hypot(*(b - a))
            yield face, (a + step, b - step)

    def _welded(self, ring: np.ndarray) -> Iterator[WeldedSide]:
        """How each side is welded to its wall. An end plate is welded round the section, whose
        outer arrises the lengths are between."""
        closing = self.row.closing
        sides = list(self._sides())
        if self.row.end:
            outer = self._corners(ring, np.zeros(len(ring))) if self.gaps.any() else self.corners
            sides = [
                (face, (outer[k], outer[(k + 1) % len(outer)])) for k, face in enumerate(self.walls)
            ]
        for (face, (a, b)), gap in zip(sides, self.gaps, strict=True):
            length, how, room, slot = float(np.hypot(*(b - a))), "walls", 0.0, None
            if self.row.end:
                how, room, gap = "end", abs(float(gap)), 0.0
            elif closing and face == closing.face:
                length = sum(cut.shape.length for cut in self.cuts)
                slot = next(((c.shape.length, c.shape.breadth) for c in self.cuts), None)
                how = closing.kind
            elif gap > WELDED_GAP:
                how = "open"
            if how != "weld":
                middle = self.flat.in_model(0.5 * (a + b)[None])[0]
                yield WeldedSide(face, length, middle, how, float(gap), room, slot)

    def _marks(self) -> list[tuple[int, PlateMark]]:
        """Both faces of the diaphragm on the inner faces of the walls; the first bears its mark."""
        marks, named = [], set()
        for face, side in self._sides():
            length = float(np.hypot(*(side[1] - side[0])))
            parts = np.linspace(0.0, 1.0, 1 + max(2, int(np.ceil(length / 100.0))))
            for height in (-self.half, self.half):
                for k, _, places in self._along_wall(face, side, height, parts):
                    if len(places) < 2:
                        continue
                    text = "" if k in named else self.flat.mark
                    named.add(k)
                    marks.append((k, PlateMark("line", text, places)))
        return marks

    def _slots(self) -> list[Cut]:
        closing = self.row.closing
        face, side = next(item for item in self._sides() if item[0] == closing.face)
        room = float(np.hypot(*(side[1] - side[0])))
        walls = [self.plates[k] for k in self.wall_plates(face)]
        breadth = closing.breadth or max(p.thickness for p in walls) + SLOT_SIDE
        length = closing.length or max(SLOT_LENGTH, 3.0 * breadth)
        pitch = closing.pitch or SLOT_PITCH * length
        if pitch <= length or length > room:
            raise self.fault(
                "diaphragm-slot",
                "the slots have no room on their line",
                "make them shorter, or their pitch longer than they are",
                length,
                min(room, pitch),
            )
        # Half a pitch from the ends, where there is room for more than one.
        count = max(1, int(np.floor(room / pitch + 1e-9)))
        parts = 0.5 + (np.arange(count) - 0.5 * (count - 1)) * pitch / room
        shape = HoleShape(length, breadth, 0.5 * breadth)
        cuts, met = [], np.zeros(count, bool)
        for k, found, places in self._along_wall(face, side, 0.0, parts):
            fresh = found & ~met
            for s, w in places[fresh[found]]:
                spot = spot_at(self.plates[k].rails.mid, float(s), float(w))
                cuts.append(Cut(k, spot, shape, 0.5 * np.pi, self.source))
            met |= fresh
        return cuts


def _from_lower_left(contour: np.ndarray) -> np.ndarray:
    """The contour from its vertex at the lower left, at the end of the bottom side."""
    away = contour[:, :2] - contour[:, :2].min(axis=0)
    return np.roll(contour, -int(np.argmin(away[:, 0] + 2.0 * away[:, 1])), axis=0)


def _ring(member: Member) -> tuple[np.ndarray, tuple[str, ...]]:
    """The section's corners (m, 2) counter-clockwise, and the face from each to the next."""
    law = member.law
    corners = np.array(law.sections[0].corners, float)
    order = list(range(len(corners)))
    following = np.roll(corners, -1, axis=0)
    if (corners[:, 0] * following[:, 1] - corners[:, 1] * following[:, 0]).sum() < 0.0:
        order.reverse()
    between = {frozenset((strip.first, strip.second)): strip.face for strip in law.strips}
    walls = tuple(
        between[frozenset((a, b))] for a, b in zip(order, order[1:] + order[:1], strict=True)
    )
    return corners[order], walls
