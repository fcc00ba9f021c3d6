# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plates: the strips of a member cut at their joints, and the measuring lines across each."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, Finding, error, warning
from ..joints.joint_checks import rule_findings
from ..joints.joint_solver import JointRules, solve_joints
from ..joints.lanes import Lane, Lanes, bounds_of, lane_findings, lanes_between
from ..members.contour import EndCurves
from ..members.contour_measure import TrimmedFigures
from ..members.member import Member
from ..members.strips import StripRails
from ..members.thickness import Chamfer
from ..sections.section import Material, strips_meet
from .bodies import bodies
from .plate_places import PlateMark, PlateOpening

SAME_GAP = 0.005
"""mm; root gaps told twice that differ by less are one."""


@dataclass(frozen=True, eq=False)
class PlateLine:
    """A line across a plate at arc length s: `E-1` and `E-2` its ends, `L-k` the member's
    stations, `F-k` its folds, so that every panel between two lines is smooth. s_mid: where it
    crosses the mid-surface, which is folded at the mitre and not below the outer fold. At a cut
    end both are those half way across."""

    label: str
    s: float
    s_mid: float


@dataclass(frozen=True, eq=False)
class Plate:
    """One plate of a strip, from start to end on the axis, with its rails.

    inward: +1 when the normal P' × R of its surface (R from the first edge to the second) points
    into the section, -1 when it points outward. lane: its share of the face's width. cuts: the
    curves of ends that are no section planes; start, end and the rails then reach as far as the
    farthest point of a curve, and `uncut` beyond it, for the solid that is cut, figures being
    those of what is left. piece: number of its delivery piece. chamfers: at the ends, towards
    thinner plates; they are in the rails, not in the mid-surface.
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
    lane: Lane = Lane()
    cuts: tuple[EndCurves | None, EndCurves | None] = (None, None)
    uncut: StripRails | None = None
    figures: TrimmedFigures | None = None
    piece: int = 1
    openings: tuple[PlateOpening, ...] = ()
    marks: tuple[PlateMark, ...] = ()
    chamfers: tuple[Chamfer | None, Chamfer | None] = (None, None)

    @property
    def net_volume(self) -> float:
        """Volume without the openings, mm3."""
        return self.volume - sum(opening.volume for opening in self.openings)

    @property
    def is_cut(self) -> bool:
        """True when an end is no section plane."""
        return self.uncut is not None

    def line_places(self, level: str) -> np.ndarray:
        """Arc lengths (k, 2) of the lines on the first and second edge of the surface `outer`,
        `mid` or `inner`."""
        places = [line.s if level == "outer" else line.s_mid for line in self.lines]
        both = np.repeat(np.array(places)[:, None], 2, axis=1)
        for k, cut in zip((0, -1), self.cuts, strict=True):
            if cut is not None:
                both[k] = cut.corners(level)
        return both


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
    lanes: Mapping[str, Lanes] | None = None,
    keep_outs: Mapping[str, Sequence[float]] | None = None,
    root_gaps: Sequence[tuple[str, float, str]] = (),
) -> tuple[tuple[Plate, ...], tuple[Finding, ...]]:
    """Plates of all faces in face order then along +s, and findings on their joints.

    joints: face -> Joints; a face without an entry is cut only where the section asks for it.
    lanes: face -> Lanes of faces divided along their length. keep_outs: arc lengths joints keep
    clear of, by their kind (joint_solver.KEEP_OUTS). root_gaps: joint (`T1/T2`, `joints` of
    all), root gap and row it is of, left between the plates in equal halves; the last row holds.
    Raises BendTorsionError for joints out of order or beyond the axis, plates shorter than
    SHORTEST_PLATE, and `auto` joints no rule-keeping places exist for.
    """
    findings: list[Finding] = []
    law = member.law
    bounds = bounds_of(member, lanes or {}, rules or JointRules())
    joints = _with_solved(member, joints, rules or JointRules(), keep_outs, bounds)
    stations = member.stations(spacing)
    cuts: dict[str, np.ndarray] = {}
    for index, strip in enumerate(law.strips):
        given = joints.get(strip.face, Joints(())).places(member.length)
        _check_joints(member, strip.face, joints.get(strip.face), findings)
        given = _clear_of_gaps(member, strip.face, given, findings)
        cuts[strip.face] = _edges(given, law.joints_of(index), law.folds, member.length)
    _check_lengths(member, cuts, findings)
    if any(f.severity == "error" for f in findings):
        raise BendTorsionError(findings)
    if rules is not None:
        findings += rule_findings(member, cuts, rules, _adjacent(member), keep_outs or {})
        findings += lane_findings(member.name, bounds, rules)
    stretches = {face: _stretches(member, own) for face, own in cuts.items()}
    spans = [
        (index, start, end)
        for index, strip in enumerate(law.strips)
        for start, end in stretches[strip.face]
    ]
    member = replace(member, root_gaps=_root_gaps(member, stretches, root_gaps))
    across = {k: lanes_between(bounds.get(s.face, (0.0, 1.0))) for k, s in enumerate(law.strips)}
    built = iter(bodies(member, spans, across))
    plates = []
    for index, strip in enumerate(law.strips):
        for number, (start, end) in enumerate(stretches[strip.face], start=1):
            cells = [c for c in law.cells if c.start < end and c.end > start]
            first, last = member.opened(strip.face, start, end)
            for lane in across[index]:
                body = next(built)
                rails = body.rails
                plates.append(
                    Plate(
                        member=member.name,
                        mark=f"{member.name}-{strip.letter}{number}{lane.letter}",
                        face=strip.face,
                        letter=strip.letter,
                        strip=index,
                        edges=lane.edges(strip.edges),
                        inward=strip.inward,
                        start=float(rails.mid.start if body.cuts[0] else first),
                        end=float(rails.mid.end if body.cuts[1] else last),
                        thickness=float(cells[0].thickness[index]),
                        material=cells[0].materials[index],
                        rails=rails,
                        volume=body.volume,
                        folds=tuple(f for f in rails.boundaries if f in law.folds),
                        lines=_lines(stations, first, last, rails, law.folds, body.cuts),
                        in_transition=any(cell.is_transition for cell in cells),
                        lane=lane,
                        chamfers=law.chamfers_of(index, start, end),
                        cuts=body.cuts,
                        uncut=body.uncut,
                        figures=body.figures,
                        piece=member.piece_at(strip.face, 0.5 * (start + end)),
                    )
                )
    return tuple(plates), tuple(findings)


def _stretches(member: Member, edges: np.ndarray) -> list[tuple[float, float]]:
    """Start and end of the plates between edges; what a node takes is none."""
    taken = {(gap.start, gap.end) for gap in member.gaps}
    pairs = zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True)
    return [pair for pair in pairs if pair not in taken]


def _root_gaps(
    member: Member,
    stretches: Mapping[str, Sequence[tuple[float, float]]],
    given: Sequence[tuple[str, float, str]],
) -> tuple[tuple[str, float, float], ...]:
    """(face, place, gap) of the joints within a member that have a root gap and no field gap.
    Raises BendTorsionError at the first where both are given and differ."""
    if not given:
        return ()
    found = []
    for strip in member.law.strips:
        fields = {piece.end_of(strip.face): piece.gap for piece in member.pieces[:-1]}
        for k, (before, behind) in enumerate(itertools.pairwise(stretches[strip.face]), start=1):
            at = before[1]
            letters = (f"{strip.letter}{k}", f"{strip.letter}{k + 1}")
            own = [item for item in given if item[0] == "joints" or _lane_apart(item[0]) == letters]
            _, gap, row = own[-1] if own else ("", 0.0, "")
            field = fields.get(at, 0.0)
            if not gap or at != behind[0]:
                continue
            if not field:
                found.append((strip.face, at, gap))
            elif abs(field - gap) > SAME_GAP:
                raise BendTorsionError(
                    error(
                        "root-gap-differs",
                        member.name,
                        f"the preparation has a root gap of {gap:g} mm, sheet Pieces leaves "
                        f"{field:g} mm between {' and '.join(letters)}",
                        "make them the same, or leave one of them empty: the other holds then",
                        position=row,
                        value=float(gap),
                        limit=float(field),
                        unit="mm",
                    )
                )
    return tuple(found)


def _lane_apart(name: str) -> tuple[str, ...]:
    """The plates of a joint `T1a/T2a` without the letters of their lanes."""
    return tuple(plate.rstrip("abcdefghijklmnopqrstuvwxyz") for plate in name.split("/"))


def _clear_of_gaps(
    member: Member, face: str, given: Sequence[float], findings: list[Finding]
) -> tuple[float, ...]:
    """The joints a node does not take, with a warning for each it takes."""
    taken = [s for s in given if any(gap.takes(s) for gap in member.gaps)]
    findings += [
        warning(
            "joint-in-node",
            member.name,
            f"a joint of face {face} lies in a node and falls away",
            "move the joint clear of the node, or delete it",
            position=f"s = {s:.0f} mm",
            value=float(s),
            unit="mm",
        )
        for s in taken
    ]
    return tuple(s for s in given if s not in taken)


def _with_solved(
    member: Member,
    joints: Mapping[str, Joints],
    rules: JointRules,
    keep_outs: Mapping[str, Sequence[float]] | None,
    lanes: Mapping[str, Sequence[float]],
) -> Mapping[str, Joints]:
    """The joints with those of `auto` faces solved for, given ones as they are."""
    if not any(item.kind == "auto" for item in joints.values()):
        return joints
    given = {strip.face: joints.get(strip.face, Joints(())) for strip in member.law.strips}
    solved = solve_joints(
        member,
        {f: None if g.kind == "auto" else g.places(member.length) for f, g in given.items()},
        _adjacent(member),
        rules,
        keep_outs,
        lanes,
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
    stations: np.ndarray,
    start: float,
    end: float,
    rails: StripRails,
    folds: Sequence[float],
    cuts: tuple[EndCurves | None, EndCurves | None],
) -> tuple[PlateLine, ...]:
    own = [(s, m) for s, m in zip(rails.boundaries, rails.mid_folds, strict=True) if s in folds]
    middle = [PlateLine(f"F-{k}", s, m) for k, (s, m) in enumerate(own, start=1)]
    at_folds = np.array([s for s, _ in own])
    # Whole rulings only: none that runs into a cut end.
    first = start if cuts[0] is None else cuts[0].range[1]
    last = end if cuts[1] is None else cuts[1].range[0]
    for k, s in enumerate(stations):
        clear = min(s - first, last - s) > tolerances.STATION_AT_PLATE_END
        if clear and (np.abs(at_folds - s) > tolerances.STATION_AT_FOLD).all():
            middle.append(PlateLine(f"L-{k}", float(s), float(s)))
    middle.sort(key=lambda line: line.s)
    ends = [
        PlateLine(f"E-{k + 1}", float(place), float(place))
        if cut is None
        else PlateLine(f"E-{k + 1}", *(float(cut.at(at, 0.5 * np.ones(1))[0]) for at in _CUT_AT))
        for k, (place, cut) in enumerate(zip((start, end), cuts, strict=True))
    ]
    return (ends[0], *middle, ends[1])


_CUT_AT = ("outer", "mid")
"""Where s and s_mid of a cut end line are taken, half way across."""


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
        if lengths[at] >= tolerances.SHORTEST_PLATE - tolerances.SAME_STATION:
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


def _adjacent(member: Member) -> dict[str, tuple[str, ...]]:
    """The faces each face meets."""
    strips = member.law.strips
    return {
        one.face: tuple(o.face for o in strips if o is not one and strips_meet(one, o))
        for one in strips
    }
