# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plates: the strips of a member cut at their joints, and the measuring lines across each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from . import tolerances
from .finding import BendTorsionError, Finding, error, warning
from .joint_solver import JointRules, solve_joints
from .member import Member
from .section import Material, Strip
from .strips import StripRails, rails_between, section_integrand
from .volume import strip_volumes


@dataclass(frozen=True, eq=False)
class PlateLine:
    """A line across a plate at arc length s: `E-1` and `E-2` its ends, `L-k` the member's
    stations, `F-k` its folds, so that every panel between two lines is smooth. s_mid: where it
    crosses the mid-surface, which is folded at the mitre and not below the outer fold."""

    label: str
    s: float
    s_mid: float


@dataclass(frozen=True, eq=False)
class Plate:
    """One plate of a strip, from start to end on the axis, with its rails.

    inward: +1 when the normal P' × R of its surface (R from the first edge to the second) points
    into the section, -1 when it points outward.
    """

    member: str
    mark: str
    face: str
    letter: str
    strip: int
    edges: tuple[str, str]
    inward: int
    start: float
    end: float
    thickness: float
    material: Material
    rails: StripRails
    volume: float
    folds: tuple[float, ...]
    lines: tuple[PlateLine, ...]
    in_transition: bool


@dataclass(frozen=True)
class Joints:
    """Joints of one face: cumulative ratios of the axis length (0 … 1), cumulative mm, or
    `auto`, solved by the rules (no values)."""

    values: tuple[float, ...]
    kind: str = "ratio"

    def places(self, length: float) -> tuple[float, ...]:
        """Arc lengths of the joints inside the member."""
        scale = length if self.kind == "ratio" else 1.0
        places = (value * scale for value in self.values)
        return tuple(p for p in places if p < length - tolerances.SAME_STATION)


def split_plates(
    member: Member,
    joints: Mapping[str, Joints],
    spacing: float = 500.0,
    rules: JointRules | None = None,
) -> tuple[tuple[Plate, ...], tuple[Finding, ...]]:
    """Plates of all faces in face order then along +s, and findings on their joints.

    joints: face -> Joints; a face without an entry is cut only where the section asks for it.
    Raises BendTorsionError for joints out of order or beyond the axis, plates shorter than
    SHORTEST_PLATE, and `auto` joints no rule-keeping places exist for.
    """
    findings: list[Finding] = []
    law = member.law
    joints = _with_solved(member, joints, rules or JointRules())
    stations = member.stations(spacing)
    cuts: dict[str, np.ndarray] = {}
    for strip in law.strips:
        given = joints.get(strip.face, Joints(())).places(member.length)
        _check_joints(member, strip.face, joints.get(strip.face), findings)
        cuts[strip.face] = _edges(given, law.joints, law.folds, member.length)
    _check_lengths(member, cuts, findings)
    if any(f.severity == "error" for f in findings):
        raise BendTorsionError(findings)
    if rules is not None:
        findings += _check_rules(member, cuts, rules)
    spans = [
        (index, float(start), float(end))
        for index, strip in enumerate(law.strips)
        for start, end in zip(cuts[strip.face][:-1], cuts[strip.face][1:], strict=True)
    ]
    all_rails = rails_between(member, spans)
    built = iter(zip(all_rails, _volumes(member, all_rails), strict=True))
    plates = []
    for index, strip in enumerate(law.strips):
        edges = cuts[strip.face]
        for number, (start, end) in enumerate(zip(edges[:-1], edges[1:], strict=True), start=1):
            cells = [c for c in law.cells if c.start < end and c.end > start]
            rails, volume = next(built)
            plates.append(
                Plate(
                    member=member.name,
                    mark=f"{member.name}-{strip.letter}{number}",
                    face=strip.face,
                    letter=strip.letter,
                    strip=index,
                    edges=strip.edges,
                    inward=strip.inward,
                    start=float(start),
                    end=float(end),
                    thickness=float(cells[0].thickness[index]),
                    material=cells[0].materials[index],
                    rails=rails,
                    volume=volume,
                    folds=tuple(f for f in rails.boundaries if f in law.folds),
                    lines=_lines(stations, start, end, rails, law.folds),
                    in_transition=any(cell.is_transition for cell in cells),
                )
            )
    return tuple(plates), tuple(findings)


def _volumes(member: Member, plates: Sequence[StripRails]) -> list[float]:
    """∫A(1 − κ·e)ds between square ends (Pappus); surface quadrature of plates that are mitred."""
    mitred = [rails for rails in plates if rails.boundaries]
    by_surface = iter(strip_volumes(mitred) if mitred else ())
    return [
        next(by_surface)
        if rails.boundaries
        else float(section_integrand(member, rails).integral()[0])
        for rails in plates
    ]


def _with_solved(
    member: Member, joints: Mapping[str, Joints], rules: JointRules
) -> Mapping[str, Joints]:
    """The joints with those of `auto` faces solved for, given ones as they are."""
    if not any(item.kind == "auto" for item in joints.values()):
        return joints
    strips = member.law.strips
    given = {strip.face: joints.get(strip.face, Joints(())) for strip in strips}
    neighbours = {
        one.face: tuple(o.face for o in strips if o is not one and _neighbours(one, o))
        for one in strips
    }
    solved = solve_joints(
        member,
        {f: None if g.kind == "auto" else g.places(member.length) for f, g in given.items()},
        neighbours,
        rules,
    )
    return {**joints, **{face: Joints(places, "mm") for face, places in solved.items()}}


def _edges(
    given: Sequence[float], forced: Sequence[float], folds: Sequence[float], length: float
) -> np.ndarray:
    """Plate ends along the axis; a given joint at a forced one or at a fold is there exactly."""
    firm = (*forced, *folds)
    own = [next((f for f in firm if abs(g - f) <= tolerances.SAME_STATION), g) for g in given]
    return np.array(sorted({0.0, length, *own, *forced}))


def _lines(
    stations: np.ndarray, start: float, end: float, rails: StripRails, folds: Sequence[float]
) -> tuple[PlateLine, ...]:
    own = [(s, m) for s, m in zip(rails.boundaries, rails.mid_folds, strict=True) if s in folds]
    middle = [PlateLine(f"F-{k}", s, m) for k, (s, m) in enumerate(own, start=1)]
    at_folds = np.array([s for s, _ in own])
    for k, s in enumerate(stations):
        clear = min(s - start, end - s) > tolerances.STATION_AT_PLATE_END
        if clear and (np.abs(at_folds - s) > tolerances.STATION_AT_FOLD).all():
            middle.append(PlateLine(f"L-{k}", float(s), float(s)))
    middle.sort(key=lambda line: line.s)
    return (
        PlateLine("E-1", float(start), float(start)),
        *middle,
        PlateLine("E-2", float(end), float(end)),
    )


def _check_joints(
    member: Member, face: str, joints: Joints | None, findings: list[Finding]
) -> None:
    if joints is None:
        return
    values = np.asarray(joints.values, float)
    limit = 1.0 if joints.kind == "ratio" else member.length
    problem = ""
    if not np.isfinite(values).all() or (np.diff(values) <= 0).any():
        problem = "joints must rise"
    elif len(values) and values[0] <= 0:
        problem = "the first joint must lie after the start"
    elif len(values) and values[-1] > limit + tolerances.SAME_STATION:
        problem = "a joint lies beyond the end of the member"
    if problem:
        findings.append(
            error(
                "joints",
                member.name,
                problem,
                "give cumulative ratios up to 1, or cumulative mm up to the axis length",
                position=f"face {face}",
                value=" ".join(f"{v:g}" for v in joints.values),
                limit=float(limit),
            )
        )


def _check_lengths(member: Member, cuts: dict[str, np.ndarray], findings: list[Finding]) -> None:
    folds = np.array(member.law.folds)
    for face, edges in cuts.items():
        ends = np.unique(np.concatenate([edges, folds]))
        lengths = np.diff(ends)
        at = int(np.argmin(lengths))
        if lengths[at] >= tolerances.SHORTEST_PLATE:
            continue
        at_fold = not {ends[at], ends[at + 1]} <= set(edges)
        findings.append(
            error(
                "plate-too-short",
                member.name,
                "a joint lies beside a fold" if at_fold else "two joints leave a sliver",
                f"move the joint onto the {'fold' if at_fold else 'other'}, or farther from it",
                position=f"face {face}, s = {ends[at]:.1f} mm",
                value=float(lengths[at]),
                limit=tolerances.SHORTEST_PLATE,
                unit="mm",
            )
        )


def _neighbours(one: Strip, other: Strip) -> bool:
    """True for strips with a corner in common, and where one stops at the other."""
    stops = [(a.stops_at_first, a.stops_at_second, b.face) for a, b in ((one, other), (other, one))]
    return bool({one.first, one.second} & {other.first, other.second}) or any(
        stop is not None and stop.face == face for *both, face in stops for stop in both
    )


def _check_rules(member: Member, cuts: dict[str, np.ndarray], rules: JointRules) -> list[Finding]:
    """Warnings for given joints that the rules would place elsewhere; joints are never moved."""
    findings = []
    for face, edges in cuts.items():
        lengths = np.diff(edges)
        at = int(np.argmin(lengths))
        if lengths[at] < rules.shortest_piece:
            findings.append(
                warning(
                    "piece-too-short",
                    member.name,
                    "plate is shorter than the rules allow",
                    "move a joint",
                    position=f"face {face}, s = {edges[at]:.0f} mm",
                    value=float(lengths[at]),
                    limit=rules.shortest_piece,
                    unit="mm",
                )
            )
    forced = np.array(member.law.joints)
    findings += _beside_folds(member, cuts, rules)
    strips = member.law.strips
    for i, one in enumerate(strips):
        for other in strips[i + 1 :]:
            if not _neighbours(one, other):
                continue
            a, b = cuts[one.face][1:-1], cuts[other.face][1:-1]
            if not len(a) or not len(b):
                continue
            gap = np.abs(a[:, None] - b[None, :])
            if len(forced):
                both = (np.abs(a[:, None] - forced).min(axis=1) < tolerances.SAME_STATION)[
                    :, None
                ] & (np.abs(b[:, None] - forced).min(axis=1) < tolerances.SAME_STATION)[None, :]
                gap = np.where(both, np.inf, gap)
            at = np.unravel_index(int(np.argmin(gap)), gap.shape)
            if gap[at] < rules.stagger:
                findings.append(
                    warning(
                        "joints-not-staggered",
                        member.name,
                        f"joints of faces {one.face} and {other.face} are too close",
                        "move one of them",
                        position=f"s = {a[at[0]]:.0f} mm",
                        value=float(gap[at]),
                        limit=rules.stagger,
                        unit="mm",
                    )
                )
    return findings


def _beside_folds(member: Member, cuts: dict[str, np.ndarray], rules: JointRules) -> list[Finding]:
    """Warnings for joints too close beside a fold; a joint on the fold is none."""
    findings = []
    folds = np.array(member.law.folds)
    for face, edges in cuts.items():
        own = np.array([e for e in edges[1:-1] if e not in member.law.joints])
        if not len(own) or not len(folds):
            continue
        gap = np.abs(own[:, None] - folds[None, :]).min(axis=1)
        gap = np.where(gap <= tolerances.SAME_STATION, np.inf, gap)
        at = int(np.argmin(gap))
        if gap[at] < rules.fold_clearance - tolerances.SAME_STATION:
            findings.append(
                warning(
                    "joint-beside-fold",
                    member.name,
                    f"a joint of face {face} is too close to a fold",
                    "move the joint onto the fold, or farther from it",
                    position=f"s = {own[at]:.0f} mm",
                    value=float(gap[at]),
                    limit=rules.fold_clearance,
                    unit="mm",
                )
            )
    return findings
