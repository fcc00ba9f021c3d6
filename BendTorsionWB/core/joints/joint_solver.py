# SPDX-License-Identifier: LGPL-2.1-or-later
"""Joints placed by rule: the fewest that keep every limit, then the most even pieces.

Faces that do not meet are cut alike; the two sets of faces that do meet are placed together by
dynamic programming over a grid of places, state: the last joint of each set. What cannot be is
said with the rule that binds and the nearest proposal that would do.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, Finding, error
from ..members.member import Member
from .face_runs import FaceRun, face_runs
from .stock import StockSheet, longest, sheets_for

GRID_STEPS = (10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
MOST_PLACES = 250

EVENNESS = 0.1
"""Weight of Σ(length/L)² against one joint; two sets of faces add up to less than one joint."""


@dataclass(frozen=True)
class JointRules:
    """Limits for joints and the plates between them, mm (rule pack)."""

    stagger: float = 200.0
    shortest_piece: float = 600.0
    longest_piece: float = 12000.0
    widest_piece: float = 2400.0
    fold_clearance: float = 100.0
    diaphragm_clearance: float = 100.0
    node_clearance: float = 600.0
    piece_end_clearance: float = 200.0
    narrowest_lane: float = 0.25
    """Of the face's width."""
    stock: tuple[StockSheet, ...] = ()
    """Sheets the schedule gives, which hold instead of longest_piece and widest_piece."""

    def within_stock(self, plates: Iterable[tuple[float, str]]) -> JointRules:
        """The rules with longest and widest piece of the stock there is for all of these
        thicknesses and grades."""
        if not self.stock:
            return self
        usual = StockSheet(self.longest_piece, self.widest_piece)
        own = [longest(sheets_for(self.stock, t, grade) or (usual,)) for t, grade in plates]
        return replace(
            self,
            longest_piece=min(sheet.length for sheet in own),
            widest_piece=min(sheet.width for sheet in own),
        )


KEEP_OUTS = ("diaphragm", "node", "piece_end")
"""Kinds of places joints keep clear of, folds apart; each has its `clearance` in the rules."""

RELAXED_IN_TURN = (
    "stagger",
    "fold_clearance",
    "diaphragm_clearance",
    "piece_end_clearance",
    "node_clearance",
    "shortest_piece",
    "longest_piece",
)
MEANING = {
    "stagger": "stagger between adjacent faces",
    "fold_clearance": "distance from folds",
    "diaphragm_clearance": "distance from diaphragms",
    "piece_end_clearance": "distance from piece ends",
    "node_clearance": "distance from nodes",
    "shortest_piece": "shortest piece",
    "longest_piece": "longest piece",
}


def solve_run(
    runs: Sequence[FaceRun],
    rules: JointRules,
    folds: Sequence[float],
    forced: Sequence[float] = (),
    member: str = "member",
    keep_outs: Mapping[str, Sequence[float]] | None = None,
) -> dict[str, tuple[float, ...]]:
    """Joints (arc lengths, between the ends) of each face without given ones.

    folds: places joints keep clear of; forced: cuts of all faces, staggered against as well;
    keep_outs: more places to keep clear of, by their kind, one of KEEP_OUTS.
    Raises BendTorsionError where the stock is narrower than a strip, or no joints keep all
    limits: with the rule that binds and the nearest proposal.
    """
    open_runs = [run for run in runs if run.given is None]
    for run in open_runs:
        widest = float(run.width.max())
        if widest > rules.widest_piece:
            raise BendTorsionError(
                error(
                    "stock-too-narrow",
                    member,
                    "the stock is narrower than the face",
                    "divide it into lanes, or use wider stock or a smaller section",
                    position=f"face {run.face}, s = {run.s[int(np.argmax(run.width))]:.0f} mm",
                    value=widest,
                    limit=rules.widest_piece,
                    unit="mm",
                )
            )
    kept = {"fold": folds, **(keep_outs or {})}
    found = _solved(runs, rules, kept, forced)
    if found is None:
        raise BendTorsionError(_why_not(runs, rules, kept, forced, member))
    return found


def _solved(
    runs: Sequence[FaceRun],
    rules: JointRules,
    kept: Mapping[str, Sequence[float]],
    forced: Sequence[float],
) -> dict[str, tuple[float, ...]] | None:
    start, end = runs[0].s[0], runs[0].s[-1]
    step = _step(end - start)
    found = _on_coarse(runs, rules, kept, forced)
    fewest = sum(_least_count(run, rules) for run in runs if run.given is None)
    if step > GRID_STEPS[0] and (found is None or sum(map(len, found.values())) > fewest):
        # A finer grid may save a joint where the limits leave less than a step to spare.
        finer = _on_grid(runs, rules, kept, forced, _grid(start, end, 0.5 * step))
        if finer is not None and (
            found is None or sum(map(len, finer.values())) < sum(map(len, found.values()))
        ):
            return finer
    return found


def _grid(start: float, end: float, step: float) -> np.ndarray:
    inner = step * np.arange(np.ceil(start / step), np.floor(end / step) + 1)
    inner = inner[
        (inner > start + tolerances.SHORTEST_PLATE) & (inner < end - tolerances.SHORTEST_PLATE)
    ]
    return np.concatenate([[start], inner, [end]])


def _least_count(run: FaceRun, rules: JointRules) -> int:
    return max(0, int(np.ceil(run.edges[:, -1].max() / rules.longest_piece - 1e-9)) - 1)


def _on_grid(
    runs: Sequence[FaceRun],
    rules: JointRules,
    kept: Mapping[str, Sequence[float]],
    forced: Sequence[float],
    s: np.ndarray,
) -> dict[str, tuple[float, ...]] | None:
    sets = _sets(runs)
    fixed = {run.face: run.given for run in runs if run.given is not None}
    result: dict[str, tuple[float, ...]] = {}
    for first, second in zip(sets[::2], [*sets[1::2], []][: len(sets[::2])], strict=True):
        pieces, allowed = [], []
        for group in (first, second):
            faces = [run.at(s) for run in group]
            pieces.append(_pieces(faces, rules, len(s)))
            placed = {**fixed, **result}
            near = {p for run in group for n in run.neighbours for p in placed.get(n, ())}
            near |= set(forced)
            clear = _clear(s, near, rules.stagger)
            for kind, places in kept.items():
                clear = clear & _clear(s, places, getattr(rules, f"{kind}_clearance"))
            allowed.append(clear)
        counts = (max(1, len(first)), max(1, len(second)))
        joints = _search(s, pieces, allowed, rules.stagger, counts)
        if joints is None:
            return None
        for group, places in zip((first, second), joints, strict=True):
            result.update({run.face: tuple(float(p) for p in places) for run in group})
    return result


def _sets(runs: Sequence[FaceRun]) -> list[list[FaceRun]]:
    """Open faces in sets of which no two meet, in pairs of sets that are placed together."""
    sets: list[list[FaceRun]] = []
    for run in runs:
        if run.given is not None:
            continue
        for group in sets:
            if not any(run.face in other.neighbours for other in group):
                group.append(run)
                break
        else:
            sets.append([run])
    return sets


def _clear(s: np.ndarray, of: Collection[float], distance: float) -> np.ndarray:
    places = np.array(sorted(of))
    if not len(places):
        return np.ones(len(s), bool)
    return np.abs(s[:, None] - places).min(axis=1) >= distance - tolerances.SAME_STATION


def _pieces(faces: Sequence[FaceRun], rules: JointRules, count: int) -> np.ndarray:
    """Which pairs of places (n, n) bound a piece that all faces of a set may have."""
    good = np.triu(np.ones((count, count), bool), 1)
    for run in (part for face in faces for part in _parts(face)):
        lengths = run.edges[:, None, :] - run.edges[:, :, None]
        longest, shortest = lengths.max(axis=0), lengths.min(axis=0)
        # A strip bowed in the plane needs width: the sagitta of its centre line.
        bow = longest * np.abs(run.turn[None, :] - run.turn[:, None]) / 8.0
        width = np.stack(
            [
                np.concatenate([np.zeros(i), np.maximum.accumulate(run.width[i:])])
                for i in range(count)
            ]
        )
        slack = tolerances.SAME_STATION
        good &= longest <= rules.longest_piece + slack
        good &= width + bow <= rules.widest_piece + slack
        # A part between thickness joints that the joints do not cut is as long as it is.
        whole = (run.edges[:, -1] - run.edges[:, 0]).min()
        uncut = (longest <= slack) | (shortest >= whole - slack if run.forced else False)
        good &= (shortest >= rules.shortest_piece - slack) | uncut
    return good


def _parts(run: FaceRun) -> list[FaceRun]:
    """A face between its thickness joints, each part at all places, held at its ends."""
    if not run.forced:
        return [run]
    ends = [run.s[0], *run.forced, run.s[-1]]
    return [
        replace(run.at(run.s.clip(a, b)), s=run.s) for a, b in zip(ends[:-1], ends[1:], strict=True)
    ]


def _search(
    s: np.ndarray,
    pieces: Sequence[np.ndarray],
    allowed: Sequence[np.ndarray],
    stagger: float,
    faces: tuple[int, int],
) -> tuple[np.ndarray, np.ndarray] | None:
    """Places of the joints of both sets, or None. State (i, j): the last joints of the sets, 0
    for none; joints are set from the start on, so that each is set after all lower ones."""
    n = len(s)
    whole = s[-1] - s[0]
    uneven = EVENNESS * ((s[None, :] - s[:, None]) / whole) ** 2
    cost = [
        np.where(good, count * (1.0 + uneven), np.inf)
        for good, count in zip(pieces, faces, strict=True)
    ]
    best = np.full((n, n), np.inf)
    best[0, 0] = 0.0
    came = np.zeros((2, n, n), np.int32)
    apart = np.abs(s[:, None] - s[None, :]) >= stagger - tolerances.SAME_STATION
    apart[0] = apart[:, 0] = True
    for k in range(1, n - 1):
        if allowed[0][k]:
            total = best[:k, :k] + cost[0][:k, k, None]
            came[0, k, :k] = np.argmin(total, axis=0)
            best[k, :k] = np.where(apart[k, :k], total.min(axis=0), np.inf)
        if allowed[1][k]:
            total = best[: k + 1, :k] + cost[1][None, :k, k]
            came[1, : k + 1, k] = np.argmin(total, axis=1)
            best[: k + 1, k] = np.where(apart[: k + 1, k], total.min(axis=1), np.inf)
    final = best + cost[0][:, -1, None] + cost[1][None, :, -1]
    i, j = np.unravel_index(int(np.argmin(final)), final.shape)
    if not np.isfinite(final[i, j]):
        return None
    one, two = [], []
    while i or j:
        if i > j:
            one.append(i)
            i = came[0, i, j]
        else:
            two.append(j)
            j = came[1, i, j]
    return s[one[::-1]], s[two[::-1]]


def _why_not(
    runs: Sequence[FaceRun],
    rules: JointRules,
    kept: Mapping[str, Sequence[float]],
    forced: Sequence[float],
    member: str,
) -> Finding:
    """The finding for a run without a solution: the rule that binds and the nearest value of it
    that has one, to a grid step; or that no single rule is to blame."""
    start, end = runs[0].s[0], runs[0].s[-1]
    position = f"s = {start:.0f} … {end:.0f} mm"
    for name in RELAXED_IN_TURN:
        strict = getattr(rules, name)
        loose = float(end - start) * 1.5 if name == "longest_piece" else 0.0
        proposal = _on_coarse(runs, replace(rules, **{name: loose}), kept, forced)
        if proposal is None:
            continue
        while abs(strict - loose) > GRID_STEPS[0]:
            middle = 0.5 * (strict + loose)
            found = _on_coarse(runs, replace(rules, **{name: middle}), kept, forced)
            if found is None:
                strict = middle
            else:
                loose, proposal = middle, found
        joints = ", ".join(
            f"{face} at {' '.join(f'{p:.0f}' for p in places)} mm" if places else f"none on {face}"
            for face, places in proposal.items()
        )
        return error(
            "joints-infeasible",
            member,
            f"no joints keep the rule: {MEANING[name]}",
            f"nearest: {MEANING[name]} {loose:.0f} mm, joints {joints}; or use other stock",
            position=position,
            value=float(round(loose)),
            limit=getattr(rules, name),
            unit="mm",
        )
    return error(
        "joints-infeasible",
        member,
        "no joints keep the rules, and no single rule is to blame",
        "use longer stock, or give the joints",
        position=position,
    )


def _on_coarse(
    runs: Sequence[FaceRun],
    rules: JointRules,
    kept: Mapping[str, Sequence[float]],
    forced: Sequence[float],
) -> dict[str, tuple[float, ...]] | None:
    start, end = runs[0].s[0], runs[0].s[-1]
    return _on_grid(runs, rules, kept, forced, _grid(start, end, _step(end - start)))


def _step(length: float) -> float:
    return next((g for g in GRID_STEPS if length / g <= MOST_PLACES), GRID_STEPS[-1])


def solve_joints(
    member: Member,
    given: Mapping[str, tuple[float, ...] | None],
    neighbours: Mapping[str, tuple[str, ...]],
    rules: JointRules,
    keep_outs: Mapping[str, Sequence[float]] | None = None,
    lanes: Mapping[str, Sequence[float]] | None = None,
) -> dict[str, tuple[float, ...]]:
    """Joints (arc lengths) of the faces whose given joints are None, between the forced ones.

    lanes: bounds of the lanes of faces that have some, 0 … 1 (lanes.bounds_of); the widest must
    come out of the stock. Raises BendTorsionError as solve_run does.
    """
    law = member.law
    solved: dict[str, list[float]] = {face: [] for face, places in given.items() if places is None}
    cuts = [0.0, *law.joints, member.length]
    for start, end in zip(cuts[:-1], cuts[1:], strict=True):
        runs = [
            replace(
                run,
                given=None
                if given[run.face] is None
                else tuple(p for p in given[run.face] if start < p < end),
            )
            for run in face_runs(member, neighbours, start, end, lanes or {})
        ]
        joints = solve_run(runs, rules, law.folds, law.all_joints, member.name, keep_outs)
        for face, places in joints.items():
            solved[face] += places
    return {face: tuple(places) for face, places in solved.items()}
