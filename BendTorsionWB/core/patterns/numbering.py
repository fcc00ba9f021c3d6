# SPDX-License-Identifier: LGPL-2.1-or-later
"""Part marks: one mark for plates that are equal in every respect, flat and formed.

A position mark is unique and names a plate's place. Plates that a shop could exchange share a
`part`: the position mark of the first of them. Mirror images are never shared; they are noted as
of opposite hand.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.spatial import cKDTree

from ..lofting import DevelopedPlate, MemberRecord
from ..members.thickness import Chamfer
from .gross import as_cut
from .outline_change import apart

FLAT_EQUAL = 0.1
"""mm: the outlines, holes and marks of equal plates lie this near to each other."""

FORMED_EQUAL = 0.5
"""mm: so do their formed corner lines, each in its plate's placing frame."""

BEVEL_PLACE = 2.0
"""mm: equal bevels begin and end this near to each other."""

BEVEL_ANGLE = 0.15
"""degrees: their angles differ by no more."""

_SAMPLES = 65
_MARK_SAMPLES = 9


@dataclass(frozen=True, eq=False)
class _Shape:
    """What two plates are compared by: contours (k, n, 2) of the outline and the holes, about the
    middle of the plate; formed corner lines (2, n, 3) in the placing frame; bevels (k, 9): where
    each begins and ends, about the middle, and its angles (degrees) and depths. marks: kind and
    text, without those that name a plate, and places (n, 2) of what is marked besides the measuring
    lines. chamfers: at the start and the end. labels: of its lines and folds with their places
    (2, 2), by which it is marked; faces: it is marked on, and its contour is of."""

    contours: tuple[np.ndarray, ...]
    formed: np.ndarray
    bevels: np.ndarray
    marks: tuple[tuple[str, np.ndarray], ...]
    chamfers: tuple[Chamfer | None, Chamfer | None]
    labels: tuple[tuple[str, np.ndarray], ...]
    faces: tuple[str, str]


def numbered(records: Sequence[MemberRecord]) -> tuple[MemberRecord, ...]:
    """The records with `part`, `quantity` and `opposite_hand` of every plate filled in.

    Equal: same thickness, grade and face kind, outline and holes, as cut, within FLAT_EQUAL,
    bevels, chamfers, marks, and formed corner lines within FORMED_EQUAL; and marked alike: on the
    same face, with the same lines in the same places along the same +s, since one file marks them
    all. Parts without lines may also be equal turned by half a turn.
    """
    plates = [plate for record in records for plate in record.plates]
    parts, hands = _parts([as_cut(plate) for plate in plates])
    quantity = Counter(parts)
    marked = iter((part, quantity[part], hand) for part, hand in zip(parts, hands, strict=True))
    return tuple(with_shared(record, [next(marked) for _ in record.plates]) for record in records)


def shared_marks(record: MemberRecord) -> tuple[tuple[str, int, str], ...]:
    """Part, quantity and opposite hand of each plate: what a record owes to other members."""
    return tuple((plate.part, plate.quantity, plate.opposite_hand) for plate in record.plates)


def with_shared(record: MemberRecord, shared: Sequence[tuple[str, int, str]]) -> MemberRecord:
    """The record with these, one per plate."""
    marked = list(zip(record.plates, shared_marks(record), map(tuple, shared), strict=True))
    # Most plates of a building have no like, and are told so already.
    if all(before == after for _, before, after in marked):
        return record
    plates = tuple(
        plate
        if before == after
        else replace(plate, part=after[0], quantity=after[1], opposite_hand=after[2])
        for plate, before, after in marked
    )
    return replace(record, plates=plates)


def _parts(plates: Sequence[DevelopedPlate]) -> tuple[list[str], list[str]]:
    if not plates:
        return [], []
    near = _alike(plates)
    shapes: dict[int, _Shape] = {}

    def shape(i: int) -> _Shape:
        if i not in shapes:
            shapes[i] = _shape_of(plates[i])
        return shapes[i]

    owner = list(range(len(plates)))
    mirrored = [-1] * len(plates)
    for i, candidates in enumerate(near):
        for j in candidates:
            if j >= i or owner[j] != j:
                continue
            if _same(shape(i), shape(j)):
                owner[i] = j
                break
            if mirrored[j] < 0 and _same(_mirror(shape(i)), shape(j), marked_alike=False):
                mirrored[i], mirrored[j] = j, i
    hands = [mirrored[o] for o in owner]
    return (
        [plates[o].mark for o in owner],
        [plates[owner[h]].mark if h >= 0 else "" for h in hands],
    )


def _alike(plates: Sequence[DevelopedPlate]) -> list[list[int]]:
    """For every plate those of the same sizes, thickness and grade, in order."""
    kinds = sorted({(p.material, p.letter in "DE") for p in plates})
    sizes = np.array(
        [
            [
                p.length,
                p.width,
                p.area / max(p.length, 1.0),
                1e3 * p.thickness,
                1e6 * kinds.index((p.material, p.letter in "DE")),
                1e3 * len(p.holes),
            ]
            for p in plates
        ]
    )
    tree = cKDTree(sizes)
    return [sorted(found) for found in tree.query_ball_point(sizes, 3.0 * FLAT_EQUAL)]


def _shape_of(plate: DevelopedPlate) -> _Shape:
    middle = 0.5 * np.array([plate.length, plate.width])
    loops = [plate.outline, *(hole.runs for hole in plate.holes)]
    contours = tuple(np.concatenate(runs) - middle for runs in loops)
    return _Shape(
        contours,
        _formed(plate),
        _bevels(plate, middle),
        _marks(plate, middle),
        plate.chamfers,
        tuple((line.label, line.flat - middle) for line in (*plate.lines, *plate.folds)),
        (plate.marking_face, plate.contour_face),
    )


def _marks(plate: DevelopedPlate, middle: np.ndarray) -> tuple[tuple[str, np.ndarray], ...]:
    found = []
    for mark in plate.marks:
        at = np.linspace(0.0, len(mark.flat) - 1.0, _MARK_SAMPLES)
        places = np.column_stack(
            [np.interp(at, range(len(mark.flat)), mark.flat[:, k]) for k in (0, 1)]
        )
        # A line bears the name of the diaphragm on it, which is another one's on its like.
        words = mark.text if mark.kind == "text" else ""
        found.append((f"{mark.kind} {words}", places - middle))
    return tuple(found)


def _bevels(plate: DevelopedPlate, middle: np.ndarray) -> np.ndarray:
    rows = []
    for bevel in plate.bevels:
        if bevel.side in ("start", "end"):
            line = plate.lines[0 if bevel.side == "start" else -1]
            parts = np.array([[bevel.start], [bevel.end]]) / line.length_3d
            ends = line.flat[0] + parts * (line.flat[1] - line.flat[0])
        elif bevel.side == "wall":
            ends = plate.side_ends(bevel.edge)
        else:
            number = 0 if bevel.side == "first" else 1
            s = [line.s for line in plate.lines]
            flat = np.array([line.flat[number] for line in plate.lines])
            at = [bevel.start, bevel.end]
            ends = np.column_stack([np.interp(at, s, flat[:, k]) for k in (0, 1)])
        # A side of a flat part has no tilt but an opening: that of either face is another.
        opening = bevel.opening[0] * (-1.0 if bevel.opening[1] == "down" else 1.0)
        angles = np.degrees([bevel.natural + opening, bevel.outer[0], bevel.inner[0]])
        depths = bevel.outer[1], bevel.inner[1]
        rows.append([*(ends - middle).ravel(), *angles, *depths])
    return np.array(rows).reshape(-1, 9)


def _formed(plate: DevelopedPlate) -> np.ndarray:
    """The two formed corner lines at even lengths, between the plate's own ends, in such an order
    that second − first, +s and outward are right-handed."""
    arris = [p for p in plate.points if p.kind == "arris"]
    if len(arris) < 4 or len(arris) % 2:
        return np.zeros((2, _SAMPLES, 3))
    lines = np.array([p.local for p in arris]).reshape(-1, 2, 3)
    out = []
    for side in (0, 1):
        points = lines[:, side]
        step = np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1))
        along = np.concatenate([[0.0], np.cumsum(np.maximum(step, 1e-9))])
        at = np.linspace(0.0, along[-1], _SAMPLES)
        out.append(make_interp_spline(along, points, k=min(3, len(points) - 1))(at))
    formed = np.array(out)
    # The placing frame's z points outward; edges are taken in one sense about it.
    across, forth = formed[1, 0] - formed[0, 0], formed[0, 1] - formed[0, 0]
    return formed if across[0] * forth[1] - across[1] * forth[0] > 0.0 else formed[::-1]


def _mirror(shape: _Shape) -> _Shape:
    """The same plate of opposite hand: its image in a plane, edges exchanged so that the outer
    face stays on the same side of first edge, second edge and +s."""
    flat, space = np.array([1.0, -1.0]), np.array([-1.0, 1.0, 1.0])
    return _Shape(
        tuple(contour * flat for contour in shape.contours),
        shape.formed[::-1] * space,
        shape.bevels * np.array([1.0, -1.0, 1.0, -1.0, *np.ones(5)]),
        tuple((kind, places * flat) for kind, places in shape.marks),
        shape.chamfers,
        tuple((label, places * flat) for label, places in shape.labels),
        shape.faces,
    )


def _turned(shape: _Shape) -> _Shape:
    """The same plate turned by half a turn: its end at the start."""
    return _Shape(
        tuple(-contour for contour in shape.contours),
        shape.formed[::-1, ::-1],
        shape.bevels * np.array([*-np.ones(4), *np.ones(5)]),
        tuple((kind, -places) for kind, places in shape.marks),
        shape.chamfers[::-1],
        tuple((label, -places) for label, places in shape.labels),
        shape.faces,
    )


def _same(one: _Shape, other: _Shape, marked_alike: bool = True) -> bool:
    if marked_alike and one.faces != other.faces:
        return False
    return any(
        own.chamfers == other.chamfers
        and (not marked_alike or _same_marks(own.labels, other.labels))
        and _same_bevels(own.bevels, other.bevels)
        and _same_marks(own.marks, other.marks)
        and _congruent(own.formed, other.formed)
        # Last, for it costs most: of like sizes there are many in a large building.
        and _near(own.contours[0], other.contours[0])
        and all(any(_near(a, b) for b in other.contours[1:]) for a in own.contours[1:])
        for own in (one, _turned(one))
    )


def _same_marks(a: tuple, b: tuple) -> bool:
    """True when each mark of one plate has its like in the other, within FLAT_EQUAL."""
    return len(a) == len(b) and all(
        any(
            kind == other
            and min(np.abs(places - one).max() for one in (like, like[::-1])) <= FLAT_EQUAL
            for other, like in b
        )
        for kind, places in a
    )


def _same_bevels(a: np.ndarray, b: np.ndarray) -> bool:
    """True when each bevel of one plate has its like in the other, places within BEVEL_PLACE."""
    if len(a) != len(b):
        return False
    limit = np.array([*[BEVEL_PLACE] * 4, *[BEVEL_ANGLE] * 3, FLAT_EQUAL, FLAT_EQUAL])
    turned = b[:, [2, 3, 0, 1, *range(4, 9)]]
    like = (np.abs(a[:, None] - b[None]) <= limit).all(axis=2)
    like |= (np.abs(a[:, None] - turned[None]) <= limit).all(axis=2)
    return bool(like.any(axis=0).all() and like.any(axis=1).all())


def _near(a: np.ndarray, b: np.ndarray) -> bool:
    """True when two contours (n, 2) lie within FLAT_EQUAL of each other."""
    return apart(a, b) <= FLAT_EQUAL


def _congruent(one: np.ndarray, other: np.ndarray) -> bool:
    """True when a rotation and a shift, no reflection, lay two sets of points (2, n, 3) on each
    other within FORMED_EQUAL (Kabsch)."""
    a, b = one.reshape(-1, 3), other.reshape(-1, 3)
    a, b = a - a.mean(axis=0), b - b.mean(axis=0)
    u, _, v = np.linalg.svd(a.T @ b)
    hand = np.sign(np.linalg.det(u @ v))
    turn = u @ np.diag([1.0, 1.0, hand]) @ v
    return bool(np.sqrt(((a @ turn - b) ** 2).sum(axis=1)).max() <= FORMED_EQUAL)
