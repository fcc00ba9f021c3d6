# SPDX-License-Identifier: LGPL-2.1-or-later
"""The assembly bed of a piece: its plane, saddles, side stops, pins and control points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from .. import tolerances
from ..finding import BendTorsionError, Finding, note
from ..geometry.piecewise import Piecewise
from ..geometry.rigid import moved
from ..geometry.vectors import crossed
from ..members.member import Member
from .bed_face import STEP, BedInput, DownFace, bed_fault, bed_frame, face_and_up
from .bed_record import Bed, ControlPoint, Pin, Saddle, Seat
from .templates import on_corners, template, template_lines

SEAT_INSET = 100.0
"""Distance of a seat from the face's edge, mm; a quarter of a face narrower than four of it."""
END_CLEARANCE = 200.0
"""Distance of the outermost saddles from the piece's ends, mm, so that the joints are free."""
STOP_RISE = 150.0
"""Height of a side stop up the face beside the lower seat, mm."""
LEAST_SPACING = 100.0
"""Least spacing of saddles, pins and templates, mm."""
STEEPEST = np.radians(15.0)
"""Slope of a face across the piece beyond which its stops carry it rather than its seats."""
NEWTON_STEPS = 8


def bed_of(
    member: Member,
    given: BedInput,
    spacing: float,
    piece: int,
    start: float,
    end: float,
    saddles_at: Sequence[float] = (),
    whole: Mapping[str, tuple[float, float]] | None = None,
    corner_ends: tuple[Mapping[int, float], Mapping[int, float]] = ({}, {}),
) -> Bed:
    """The bed of the piece from start to end; spacing: of the member's stations, mm; piece: its
    number, 0 when the whole member is one piece; saddles_at: arc lengths that have a saddle;
    whole: face -> the stretch it is whole on, between skew or stepped ends; corner_ends: corner ->
    where its line begins and ends, other than at start and end.

    Raises BendTorsionError for a face there is none of, one that does not face down on the plane
    asked for, and sizes that are not positive.
    """
    _check(member, given)
    face, up = face_and_up(member, given, start, end)
    to_bed = bed_frame(face, up, start, end)
    first, last = (whole or {}).get(face.name, (start, end))
    first, last = max(first, start), min(last, end)
    places = saddle_places(first, last, given.spacing, saddles_at)
    seats = _seats(face, places)
    heights = moved(to_bed, seats.reshape(-1, 3))[:, 2]
    to_bed[2, 3] += given.height - heights.min()
    dense = face.dense()
    left = int(moved(to_bed, dense[:, 0])[:, 1].mean() < moved(to_bed, dense[:, 1])[:, 1].mean())
    edges = np.stack([moved(to_bed, dense[:, k]) for k in (left, 1 - left)])
    pins, base = _pins(face, first, last, to_bed, given.pin_pitch, given.lowest_pin)
    stations = member.stations(spacing)
    corners = _corner_lines(member, start, end, corner_ends)
    name = member.name if not piece else f"{member.name}-P{piece}"
    return Bed(
        member=member.name,
        piece=piece,
        face=face.name,
        plane=given.plane,
        start=float(start),
        end=float(end),
        deviation=0.5 * float(np.ptp(edges[..., 2])),
        to_bed=to_bed,
        saddles=_saddles(member, face, to_bed, places, seats, left),
        points=_control_points(corners, stations, to_bed),
        templates=tuple(
            template(member, f"{name}-{label.replace('-', '')}", label, s, given.clearance, side)
            for label, s, side in template_lines(
                stations, start, end, given.template_pitch, given.template_lines
            )
        ),
        face_edges=edges,
        pins=pins,
        pin_base=base,
        lines=_drawn_lines(corners, to_bed),
    )


def steep_findings(bed: Bed) -> list[Finding]:
    """A note on a bed whose face lies too steeply to stand on it without stops."""
    worst = max(bed.saddles, key=lambda one: abs(one.slope))
    if abs(worst.slope) <= STEEPEST:
        return []
    return [
        note(
            "bed-steep",
            bed.name,
            f"face {bed.face} lies steeply on its bed",
            "lay another face down, make the bed level at mid-length, or deliver shorter pieces",
            position=f"saddle {worst.label}",
            value=float(np.degrees(abs(worst.slope))),
            limit=float(np.degrees(STEEPEST)),
            unit="°",
        )
    ]


def _check(member: Member, given: BedInput) -> None:
    sizes = {
        "saddle spacing": (given.spacing, LEAST_SPACING),
        "seat height": (given.height, 0.0),
        "template pitch": (given.template_pitch, LEAST_SPACING),
        "pin pitch": (given.pin_pitch or LEAST_SPACING, LEAST_SPACING),
        "lowest pin": (given.lowest_pin, 0.0),
    }
    findings = [
        bed_fault("bed-size", member, f"{name} is too small", "make it larger", size, least)
        for name, (size, least) in sizes.items()
        if not (np.isfinite(size) and size >= least)
    ]
    faces = [strip.face for strip in member.law.strips]
    if given.face not in ("auto", *faces):
        mend = f"use auto, {', '.join(faces)}"
        findings.append(
            bed_fault("bed-face", member, f"there is no face {given.face!r} to lie down", mend)
        )
    if not (np.isfinite(given.normal).all() and np.abs(given.normal).max() > 0.0):
        findings.append(
            bed_fault("bed-normal", member, "the bed's normal has no direction", "give x, y, z")
        )
    if findings:
        raise BendTorsionError(findings)


def saddle_places(
    start: float, end: float, spacing: float, wanted: Sequence[float] = ()
) -> np.ndarray:
    """Arc lengths (n,) of saddles: END_CLEARANCE inside both ends, at the wanted places between,
    and evenly between those so that none are farther apart than `spacing`."""
    clear = min(END_CLEARANCE, 0.25 * (end - start))
    first, last = start + clear, end - clear
    firm = sorted(s for s in wanted if first + clear < s < last - clear)
    edges = np.array([first, *firm, last])
    places = [
        np.linspace(a, b, int(np.ceil((b - a) / spacing - 1e-9)) + 1)[:-1]
        for a, b in zip(edges[:-1], edges[1:], strict=True)
    ]
    return np.array([*np.concatenate(places), last])


def _seats(face: DownFace, places: np.ndarray) -> np.ndarray:
    """Seat points (n, 2, 3) on the face, beside its first and second edge."""
    edges = face.at(places)
    across = edges[:, 1] - edges[:, 0]
    width = np.sqrt((across * across).sum(axis=1))
    inset = (np.minimum(SEAT_INSET, 0.25 * width) / width)[:, None] * across
    return np.stack([edges[:, 0] + inset, edges[:, 1] - inset], axis=1)


def _saddles(
    member: Member,
    face: DownFace,
    to_bed: np.ndarray,
    places: np.ndarray,
    seats: np.ndarray,
    left: int,
) -> tuple[Saddle, ...]:
    bedded = moved(to_bed, seats.reshape(-1, 3)).reshape(-1, 2, 3)
    stops = moved(to_bed, _beside(member, face, places).reshape(-1, 3)).reshape(-1, 2, 3)
    saddles = []
    for k, (s, pair) in enumerate(zip(places.tolist(), bedded, strict=True), start=1):
        # On a level saddle the stop stands at the first seat, not where rounding puts it.
        low = int(pair[1, 2] < pair[0, 2] - tolerances.SAME_STATION)
        rise = pair[left] - pair[1 - left]
        saddles.append(
            Saddle(
                f"S-{k}",
                s,
                Seat(face.edges[left], pair[left]),
                Seat(face.edges[1 - left], pair[1 - left]),
                float(np.arctan2(rise[2], np.hypot(rise[0], rise[1]))),
                "left" if low == left else "right",
                stops[k - 1, low],
            )
        )
    return tuple(saddles)


def _beside(member: Member, face: DownFace, places: np.ndarray) -> np.ndarray:
    """Points (n, 2, 3) up the faces beside the first and second edge: where a side stop touches.
    The edges themselves where there is no such face."""
    if not on_corners(member):
        return face.at(places)
    strip = member.law.strips[face.strip]
    start, end = face.rails.start, face.rails.end
    corners = member.corners(start, end)(places).reshape(len(places), -1, 3)
    count = corners.shape[1]
    points = []
    for corner, other in ((strip.first, strip.second), (strip.second, strip.first)):
        beside = next(k % count for k in (corner + 1, corner - 1) if k % count != other)
        up = corners[:, beside] - corners[:, corner]
        length = np.sqrt((up * up).sum(axis=1))
        rise = np.minimum(STOP_RISE, 0.25 * length) / length
        points.append(corners[:, corner] + rise[:, None] * up)
    return np.stack(points, axis=1)


def _pins(
    face: DownFace, start: float, end: float, to_bed: np.ndarray, pitch: float, lowest: float
) -> tuple[tuple[Pin, ...], float]:
    """Pins at the nodes of the grid below the face, and the height of their base."""
    if not pitch:
        return (), 0.0
    s = np.linspace(start, end, max(9, int(np.ceil((end - start) / STEP)) + 1))
    w = np.linspace(0.0, 1.0, 5)
    edges = face.at(s)
    patch = edges[:, None, 0] + w[None, :, None] * (edges[:, 1] - edges[:, 0])[:, None]
    plan = moved(to_bed, patch.reshape(-1, 3))[:, :2]
    low, high = np.ceil(plan.min(axis=0) / pitch), np.floor(plan.max(axis=0) / pitch)
    column, row = (
        part.ravel()
        for part in np.meshgrid(*(np.arange(a, b + 1) for a, b in zip(low, high)), indexing="ij")
    )
    nodes = pitch * np.stack([column, row], axis=1)
    _, nearest = cKDTree(plan).query(nodes)
    s, w = np.repeat(s, len(w))[nearest], np.tile(w, len(s))[nearest]
    for _ in range(NEWTON_STEPS):
        point, by_s, by_w = _patch(face, to_bed, s, w)
        miss = nodes - point[:, :2]
        area = by_s[:, 0] * by_w[:, 1] - by_s[:, 1] * by_w[:, 0]
        area = np.where(np.abs(area) > 1e-9, area, 1e-9)
        s = s + (miss[:, 0] * by_w[:, 1] - miss[:, 1] * by_w[:, 0]) / area
        w = w + (by_s[:, 0] * miss[:, 1] - by_s[:, 1] * miss[:, 0]) / area
        s, w = np.clip(s, start - STEP, end + STEP), np.clip(w, -0.5, 1.5)
    point, by_s, by_w = _patch(face, to_bed, s, w)
    found = (s >= start) & (s <= end) & (w >= 0.0) & (w <= 1.0)
    found &= np.abs(point[:, :2] - nodes).max(axis=1) < 1e-6
    if not found.any():
        return (), 0.0
    normal = crossed(by_s, by_w)
    tilt = np.arctan2(np.hypot(normal[:, 0], normal[:, 1]), np.abs(normal[:, 2]))
    base = float(point[found, 2].min()) - lowest
    return tuple(
        Pin(
            int(column[i]),
            int(row[i]),
            float(nodes[i, 0]),
            float(nodes[i, 1]),
            float(point[i, 2]) - base,
            float(tilt[i]),
        )
        for i in np.flatnonzero(found).tolist()
    ), base


def _patch(face: DownFace, to_bed: np.ndarray, s: np.ndarray, w: np.ndarray):
    """Points of the face at (s, w) in the bed frame and their derivatives, (n, 3) each."""
    edges, rates = face.at(s), face.rails.derivative(s).reshape(-1, 2, 3)
    turn = np.eye(4)
    turn[:3, :3] = to_bed[:3, :3]
    across, w = edges[:, 1] - edges[:, 0], w[:, None]
    by_s = rates[:, 0] + w * (rates[:, 1] - rates[:, 0])
    return moved(to_bed, edges[:, 0] + w * across), moved(turn, by_s), moved(turn, across)


@dataclass(frozen=True, eq=False)
class _CornerLines:
    """The corner lines of a piece: s -> (m * 3,), and where each begins and ends, (m,)."""

    at: Piecewise
    first: np.ndarray
    last: np.ndarray
    names: tuple[str, ...]

    def points(self, k: int, s: np.ndarray) -> np.ndarray:
        """Points (n, 3) of corner k."""
        return self.at(s)[:, 3 * k : 3 * k + 3]


def _corner_lines(
    member: Member, start: float, end: float, ends: tuple[Mapping[int, float], Mapping[int, float]]
) -> _CornerLines:
    names = member.law.sections[0].corner_names
    first, last = (
        np.array([own.get(k, place) for k in range(len(names))])
        for own, place in zip(ends, (start, end), strict=True)
    )
    at = member.corners(min(start, float(first.min())), max(end, float(last.max())))
    return _CornerLines(at, first, last, names)


def _control_points(
    corners: _CornerLines, stations: np.ndarray, to_bed: np.ndarray
) -> tuple[ControlPoint, ...]:
    """Corners at the ends, and at the stations they have in between."""
    middle = [(f"L-{k}", np.full(len(corners.names), s)) for k, s in enumerate(stations)]
    wanted = []
    for line, places in (("E-1", corners.first), *middle, ("E-2", corners.last)):
        for k in range(len(corners.names)):
            s = float(places[k])
            if line[0] != "L" or corners.first[k] + 1.0 < s < corners.last[k] - 1.0:
                wanted.append((line, k, s))
    s = np.array([place for *_, place in wanted])
    every = corners.at(s).reshape(len(s), -1, 3)
    xyz = every[np.arange(len(s)), [k for _, k, _ in wanted]]
    return tuple(
        ControlPoint(line, corners.names[k], place, point, on_bed)
        for (line, k, place), point, on_bed in zip(wanted, xyz, moved(to_bed, xyz), strict=True)
    )


def _drawn_lines(corners: _CornerLines, to_bed: np.ndarray) -> dict[str, np.ndarray]:
    """Corner lines in the bed frame, (n, 3) by name."""
    lines = {}
    for k, name in enumerate(corners.names):
        first, last = corners.first[k], corners.last[k]
        s = np.linspace(first, last, max(9, int(np.ceil((last - first) / STEP)) + 1))
        lines[name] = moved(to_bed, corners.points(k, s))
    return lines
