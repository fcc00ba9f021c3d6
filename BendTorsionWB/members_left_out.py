# SPDX-License-Identifier: LGPL-2.1-or-later
"""Members that a build of some leaves out: neither asked for, nor known from a build before.

The others that were not asked for are in the tables, lists and the model as they were: what they
come from is what it was, so that nothing of the project's files is older than its cut files.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

from BendTorsionWB.core.detailing import MemberJob
from BendTorsionWB.core.finding import BETWEEN, BendTorsionError, Finding, error, note, warning
from BendTorsionWB.exchange.output_folder import OwnFile
from BendTorsionWB.exchange.schedule_cells import did_you_mean
from BendTorsionWB.exchange.schedule_jobs import Files, job_of
from BendTorsionWB.exchange.schedule_rows import MemberRow, Schedule
from BendTorsionWB.source_files import read_files

NAMED = 5
"""Members that were never built are named up to this many."""


@dataclass(frozen=True)
class LeftOut:
    """members: all that are left out; outdated: those of them with files in the folder, which are
    of a former state; findings: that name them."""

    members: frozenset[str] = frozenset()
    outdated: tuple[str, ...] = ()
    findings: tuple[Finding, ...] = ()

    def without_theirs(self, findings: Iterable[Finding]) -> tuple[Finding, ...]:
        """The findings, but for those about these members alone."""
        return tuple(f for f in findings if not self.members.issuperset(f.objects))


def check_named(source: str, only: Iterable[str], members: Iterable[str]) -> None:
    """Raises BendTorsionError for names of `only` that none of the members has. source: the
    schedule or document they are members of."""
    known = list(members)
    some = BETWEEN.join(known[:NAMED]) + (f"{BETWEEN}…" if len(known) > NAMED else "")
    found = []
    for name in dict.fromkeys(only):
        if name not in known:
            near = did_you_mean(name, known)
            mend = f"did you mean {near}?" if near else "use names of its members"
            fields = {"value": name, "limit": some}
            found.append(error("member-unknown", source, "there is no such member", mend, **fields))
    if found:
        raise BendTorsionError(found)


def left_out(
    source: str,
    members: Iterable[str],
    only: Collection[str],
    known: Collection[str],
    former: Mapping[str, OwnFile],
) -> LeftOut:
    """Of all members of a source, those neither in `only`, where any are, nor known. source: the
    schedule or document; former: the files in the folder."""
    left = [name for name in members if only and name not in only and name not in known]
    with_files = {own.member for own in former.values()}
    outdated = tuple(name for name in left if name in with_files)
    never = [name for name in left if name not in with_files]
    findings = [
        warning(
            "member-outdated",
            name,
            "was not asked for and is no longer as it was built: its files in the folder are of "
            "its former state, and the model, tables and lists leave it out",
            "build it as well before anything is cut or issued",
        )
        for name in outdated
    ]
    if never:
        more = f" and {len(never) - NAMED} more" if len(never) > NAMED else ""
        told = BETWEEN.join(never[:NAMED]) + more
        findings.append(
            note(
                "members-not-built",
                source,
                f"not asked for and not built yet, so that no file holds them: {told}",
                "build all members before figures of the whole project are used",
                value=float(len(never)),
            )
        )
    return LeftOut(frozenset(left), outdated, tuple(findings))


def read_jobs_of(
    schedule: Schedule, rows: Sequence[MemberRow], only: Collection[str] = ()
) -> tuple[dict[str, MemberJob], Files]:
    """The jobs of these members, and what the files they name hold. only: where there are any,
    others with faults are left out. Raises BendTorsionError."""

    def read(rows: Sequence[MemberRow]) -> tuple[dict[str, MemberJob], Files]:
        files = read_files(schedule, rows)
        return {row.name: job_of(schedule, row, files) for row in rows}, files

    def reads(row: MemberRow) -> bool:
        try:
            return bool(read([row]))
        except BendTorsionError:
            return False

    try:
        return read(rows)
    except BendTorsionError:
        if not only:
            raise
    return read([row for row in rows if row.name in only or reads(row)])
