# SPDX-License-Identifier: LGPL-2.1-or-later
"""Delivery pieces: the stretches a member is made, delivered and erected in.

The end of a piece is a joint of every face: square in one section plane, or stepped by an offset
per face. Between two pieces the plates of each stop half the field gap short of the joint.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import tolerances
from ..finding import BendTorsionError, Finding, error, warning
from ..members.member import Member
from ..members.piece_record import Piece
from .joint_solver import JointRules

LONGEST_GAP = 100.0
"""mm: a field gap wider than this is a slip of the pen."""


@dataclass(frozen=True)
class PieceInput:
    """One piece as given: from start to end, mm on the axis or parts of its length (None: the end
    of the piece before, the start of the one behind). start_end, end_end: how it ends, the offset
    of each face along the axis in mm, none for square, None as the neighbour has it. green: mm
    left on its plates there. gap: mm to the next piece."""

    number: int
    start: tuple[float, bool] | None = None
    end: tuple[float, bool] | None = None
    start_end: tuple[tuple[str, float], ...] | None = None
    end_end: tuple[tuple[str, float], ...] | None = None
    green_start: float = 0.0
    green_end: float = 0.0
    gap: float = 0.0


def end_words(value: object) -> tuple[tuple[str, float], ...] | None:
    """Offsets of faces of `square` (none) or `stepped top=80 bottom=-80`; None of empty text.
    Raises ValueError for anything else."""
    words = str(value or "").replace(" =", "=").replace("= ", "=").split()
    if not words:
        return None
    kind, *offsets = words
    if kind == "square" and not offsets:
        return ()
    if kind != "stepped" or not offsets:
        raise ValueError("write square, or stepped with an offset per face in mm")
    found: dict[str, float] = {}
    for item in offsets:
        face, equals, number = item.partition("=")
        if not equals or not face or face in found:
            raise ValueError(f"cannot read the offset {item}")
        found[face] = float(number)
        if not np.isfinite(found[face]):
            raise ValueError(f"cannot read the offset {item}")
    return tuple(found.items())


def end_text(offsets: Sequence[tuple[str, float]]) -> str:
    """The words of `end_words`."""
    return " ".join(["stepped", *(f"{f}={d:g}" for f, d in offsets)]) if offsets else "square"


def with_pieces(
    member: Member, given: Sequence[PieceInput], rules: JointRules | None = None
) -> tuple[Member, tuple[Finding, ...]]:
    """The member in pieces, cut at their ends on every face, and findings; without rows what lies
    between its nodes and stubs is a piece, all of it one, number 1, without nodes.

    Raises BendTorsionError, by `piece k` of the rows, for pieces that overlap or leave a part of
    the member out, ends that two rows give differently, ends inside a transition, and pieces
    shorter than SHORTEST_PLATE.
    """
    if not given:
        return replace(member, pieces=_between_nodes(member)), ()
    findings: list[Finding] = []
    pieces = _placed(member, given, findings)
    if findings:
        raise BendTorsionError(findings)
    for row, piece in enumerate(pieces, start=1):
        findings += _piece_findings(member, row, piece, row == len(pieces), rules)
    if any(found.severity == "error" for found in findings):
        raise BendTorsionError(findings)
    square, stepped = set(member.law.joints), set(member.law.piece_joints)
    for piece in pieces[:-1]:
        if not piece.end_offsets:
            square.add(piece.end)
        else:
            stepped |= {(k, piece.end_of(s.face)) for k, s in enumerate(member.law.strips)}
    law = replace(member.law, joints=tuple(sorted(square)), piece_joints=tuple(sorted(stepped)))
    return replace(member, law=law, pieces=tuple(pieces)), tuple(findings)


def _between_nodes(member: Member) -> tuple[Piece, ...]:
    taken = {(gap.start, gap.end) for gap in member.gaps}
    places = {0.0, member.length, *member.stub_ends, *(p for pair in taken for p in pair)}
    edges = sorted(places)
    kept = [pair for pair in zip(edges[:-1], edges[1:], strict=True) if pair not in taken]
    return tuple(Piece(number, start, end) for number, (start, end) in enumerate(kept, start=1))


def _error(member: Member, row: int, code: str, message: str, mend: str, **fields) -> Finding:
    return error(code, member.name, message, mend, position=f"piece {row}", **fields)


def _placed(member: Member, given: Sequence[PieceInput], findings: list[Finding]) -> list[Piece]:
    """The pieces end to end, in the order of their rows."""
    length, count = member.length, len(given)
    numbers = [piece.number for piece in given]
    pieces: list[Piece] = []
    reached, ended = 0.0, ()
    for row, piece in enumerate(given, start=1):
        if numbers.index(piece.number) != row - 1 or piece.number < 1:
            findings.append(
                _error(
                    member,
                    row,
                    "piece-number",
                    "the number is another piece's, or below 1",
                    "number the pieces 1, 2, 3",
                    value=piece.number,
                )
            )
        start = reached if piece.start is None else _along(piece.start, length)
        if abs(start - reached) > tolerances.SAME_STATION:
            over = start < reached
            findings.append(
                _error(
                    member,
                    row,
                    "pieces-overlap" if over else "pieces-leave-out",
                    "the piece starts before the one before it ends"
                    if over
                    else "a part of the member before the piece is in none",
                    f"write {reached:.6g}, or leave it empty",
                    value=start,
                    limit=reached,
                    unit="mm",
                )
            )
        following = given[row] if row < count else None
        if piece.end is not None:
            end = _along(piece.end, length)
        elif following is None:
            end = length
        elif following.start is not None:
            end = _along(following.start, length)
        else:
            end = np.nan
        if following is None and abs(end - length) > tolerances.SAME_STATION:
            beyond = end > length
            findings.append(
                _error(
                    member,
                    row,
                    "piece-beyond-member" if beyond else "pieces-leave-out",
                    "the last piece ends beyond the member"
                    if beyond
                    else "the end of the member is in no piece",
                    "leave its end empty, or add a piece",
                    value=end,
                    limit=length,
                    unit="mm",
                )
            )
        end = length if following is None else end
        if start < length < end - tolerances.SAME_STATION:
            message, mend = "the piece ends beyond the member", "write a place on the member"
            findings.append(
                _error(
                    member,
                    row,
                    "piece-beyond-member",
                    message,
                    mend,
                    value=end,
                    limit=length,
                    unit="mm",
                )
            )
            return pieces
        if not start < end <= length + tolerances.SAME_STATION:
            findings.append(
                _error(
                    member,
                    row,
                    "piece-order",
                    "the piece has no end behind its start",
                    "write where it ends, mm or a ratio, on the row of the piece or the next",
                    value=None if np.isnan(end) else end,
                    limit=start,
                    unit="mm",
                )
            )
            return pieces
        offsets = _joint_offsets(member, row, piece, following, findings)
        own = (piece.start_end or ()) if row == 1 else ended
        pieces.append(
            Piece(
                piece.number,
                reached if abs(start - reached) <= tolerances.SAME_STATION else start,
                end,
                own,
                offsets,
                piece.green_start,
                piece.green_end,
                piece.gap if following is not None else 0.0,
            )
        )
        reached, ended = end, offsets
    return pieces


def _along(place: tuple[float, bool], length: float) -> float:
    value, is_ratio = place
    return value * length if is_ratio else value


def _joint_offsets(
    member: Member,
    row: int,
    piece: PieceInput,
    following: PieceInput | None,
    findings: list[Finding],
) -> tuple[tuple[str, float], ...]:
    """How the joint behind a piece is stepped, which both its rows may say."""
    faces = [strip.face for strip in member.law.strips]
    both = [(row, piece.end_end)]
    both += [(row + 1, following.start_end)] if following is not None else []
    for number, offsets in both:
        unknown = [face for face, _ in offsets or () if face not in faces]
        if unknown:
            findings.append(
                _error(
                    member,
                    number,
                    "piece-end-face",
                    f"there is no face {unknown[0]}",
                    f"use {', '.join(faces)}",
                    value=unknown[0],
                )
            )
    said = [offsets for _, offsets in both if offsets is not None]
    if len(said) == 2 and _stepped(said[0]) != _stepped(said[1]):
        findings.append(
            _error(
                member,
                row + 1,
                "piece-ends-differ",
                "the piece starts otherwise than the one before it ends",
                "write the same, or leave one of them empty",
                value=end_text(said[1]),
                limit=end_text(said[0]),
            )
        )
    at_member_end = [] if following is not None else [(row, piece.end_end)]
    at_member_end += [(row, piece.start_end)] if row == 1 else []
    for number, offsets in at_member_end:
        if _stepped(offsets or ()):
            findings.append(
                _error(
                    member,
                    number,
                    "piece-end-at-member-end",
                    "the ends of the member itself are not stepped",
                    "write square, or an end cut of the member",
                    value=end_text(offsets),
                )
            )
    found = _stepped(said[0]) if said else {}
    return tuple(found.items())


def _stepped(offsets: Sequence[tuple[str, float]]) -> dict[str, float]:
    """The offsets that are any, by face."""
    return {face: offset for face, offset in sorted(offsets) if offset}


def _piece_findings(
    member: Member, row: int, piece: Piece, is_last: bool, rules: JointRules | None
) -> list[Finding]:
    findings = []
    law = member.law
    for strip in law.strips if not is_last else ():
        at = piece.end_of(strip.face)
        inside = [
            cell
            for cell in law.cells
            if cell.is_transition
            and cell.start + tolerances.SAME_STATION < at < cell.end - tolerances.SAME_STATION
        ]
        if inside:
            zone = [cell for cell in law.cells if cell.label == inside[0].label]
            findings.append(
                _error(
                    member,
                    row,
                    "piece-end-in-transition",
                    f"the piece ends inside transition {inside[0].label} on face {strip.face}",
                    f"end it before {zone[0].start:.1f} or behind {zone[-1].end:.1f} mm",
                    value=at,
                    limit=f"{zone[0].start:.1f} to {zone[-1].end:.1f}",
                    unit="mm",
                )
            )
            break
    lengths = {s.face: piece.end_of(s.face) - piece.start_of(s.face) for s in law.strips}
    face = min(lengths, key=lengths.get)
    shortest = lengths[face] - piece.gap
    for limit, kind in (
        (tolerances.SHORTEST_PLATE, error),
        (rules.shortest_piece if rules else 0.0, warning),
    ):
        if shortest < limit:
            findings.append(
                kind(
                    "delivery-piece-too-short",
                    member.name,
                    f"the piece is shorter on face {face} than a plate may be",
                    "move its ends apart, or step them less",
                    position=f"piece {row}",
                    value=shortest,
                    limit=limit,
                    unit="mm",
                )
            )
            break
    if not 0.0 <= piece.gap <= LONGEST_GAP:
        findings.append(
            _error(
                member,
                row,
                "piece-gap",
                "the field gap is negative or too wide",
                f"write 0 to {LONGEST_GAP:g} mm",
                value=piece.gap,
                limit=LONGEST_GAP,
                unit="mm",
            )
        )
    for name, green in (("green_start", piece.green_start), ("green_end", piece.green_end)):
        if not (np.isfinite(green) and green >= 0.0):
            findings.append(
                _error(
                    member,
                    row,
                    "piece-green",
                    f"{name} must not be negative",
                    "write mm left on the plates for cutting on site, or 0",
                    value=green,
                    limit=0.0,
                    unit="mm",
                )
            )
    return findings
