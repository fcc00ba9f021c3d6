# SPDX-License-Identifier: LGPL-2.1-or-later
"""Given joints held against the rules `auto` joints are solved by: warnings, nothing is moved."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from .. import tolerances
from ..finding import Finding, warning
from ..members.member import Member
from .joint_solver import JointRules


def rule_findings(
    member: Member,
    cuts: Mapping[str, np.ndarray],
    rules: JointRules,
    adjacent: Mapping[str, Sequence[str]],
    keep_outs: Mapping[str, Sequence[float]],
) -> list[Finding]:
    """Warnings for joints the rules would place elsewhere.

    cuts: face -> ends of its plates, rising; adjacent: face -> faces it meets; keep_outs: places
    to keep clear of, by their kind.
    """
    findings = []
    for face, edges in cuts.items():
        lengths = np.diff(edges)
        for gap in member.gaps:
            lengths[edges[:-1] == gap.start] = np.inf
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
    findings += _beside(member, cuts, "fold", member.law.folds, rules)
    for kind, places in keep_outs.items():
        findings += _beside(member, cuts, kind, places, rules)
    faces = list(cuts)
    for i, one in enumerate(faces):
        for other in faces[i + 1 :]:
            if other in adjacent[one]:
                findings += _stagger(member, one, other, cuts, rules)
    return findings


def _stagger(
    member: Member, one: str, other: str, cuts: Mapping[str, np.ndarray], rules: JointRules
) -> list[Finding]:
    """A warning for joints of two faces that meet, too close; forced on both they are none."""
    a, b = cuts[one][1:-1], cuts[other][1:-1]
    if not len(a) or not len(b):
        return []
    forced = np.array(member.law.all_joints)
    gap = np.abs(a[:, None] - b[None, :])
    if len(forced):
        is_forced = [
            np.abs(own[:, None] - forced).min(axis=1) < tolerances.SAME_STATION for own in (a, b)
        ]
        gap = np.where(is_forced[0][:, None] & is_forced[1][None, :], np.inf, gap)
    at = np.unravel_index(int(np.argmin(gap)), gap.shape)
    if gap[at] >= rules.stagger:
        return []
    return [
        warning(
            "joints-not-staggered",
            member.name,
            f"joints of faces {one} and {other} are too close",
            "move one of them",
            position=f"s = {a[at[0]]:.0f} mm",
            value=float(gap[at]),
            limit=rules.stagger,
            unit="mm",
        )
    ]


# kind: what stands beside the joint, and what mends it
_BESIDE = {
    "fold": ("a fold", "move the joint onto the fold, or farther from it"),
    "diaphragm": ("a diaphragm", "move the joint or the diaphragm"),
    "node": ("a node", "move the joint farther from the node"),
    "piece_end": ("the end of a piece", "move the joint onto the end of the piece, or farther"),
}
_ON_IT_IS_GOOD = ("fold", "piece_end")


def _beside(
    member: Member,
    cuts: Mapping[str, np.ndarray],
    kind: str,
    places: Sequence[float],
    rules: JointRules,
) -> list[Finding]:
    """Warnings for joints too close beside places of a kind, the worst of each face. A joint on a
    fold or a piece's end is none, nor is one that a thickness change forces."""
    findings = []
    limit = getattr(rules, f"{kind}_clearance")
    beside = np.array(sorted(places))
    for face, edges in cuts.items():
        own = np.array([e for e in edges[1:-1] if e not in member.law.all_joints])
        if not len(own) or not len(beside):
            continue
        gap = np.abs(own[:, None] - beside[None, :]).min(axis=1)
        if kind in _ON_IT_IS_GOOD:
            gap = np.where(gap <= tolerances.SAME_STATION, np.inf, gap)
        at = int(np.argmin(gap))
        if gap[at] < limit - tolerances.SAME_STATION:
            what, mend = _BESIDE[kind]
            findings.append(
                warning(
                    f"joint-beside-{kind.replace('_', '-')}",
                    member.name,
                    f"a joint of face {face} is too close to {what}",
                    mend,
                    position=f"s = {own[at]:.0f} mm",
                    value=float(gap[at]),
                    limit=limit,
                    unit="mm",
                )
            )
    return findings
