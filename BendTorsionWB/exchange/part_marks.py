# SPDX-License-Identifier: LGPL-2.1-or-later
"""Part marks from build to build: a partial build takes those of the last whole one."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..core.finding import Finding, note
from ..core.lofting import MemberRecord
from ..core.patterns.numbering import numbered, shared_marks, with_shared
from .whole_file import write_or_remove

FILE = ".bendtorsion-parts.json"
"""Name of the record of part marks in the output folder."""


@dataclass(frozen=True)
class PartMarks:
    """Records with their part marks, what was found, and the text to keep of a whole build."""

    records: tuple[MemberRecord, ...]
    findings: tuple[Finding, ...] = ()
    kept: str = ""


def part_marks(
    folder: Path, records: Sequence[MemberRecord], keys: Mapping[str, str], partial: bool
) -> PartMarks:
    """Number the plates of all members together. keys: of what each comes from.

    partial: other members are not built. Members unchanged since the last whole build have its
    marks; the others are numbered among themselves, and a note says so.
    """
    if not partial:
        made = numbered(records)
        content = {r.member: [keys[r.member], *map(list, shared_marks(r))] for r in made}
        # A line a member: an encoder that indents takes ten times as long.
        lines = ",\n".join(
            f"{json.dumps(name)}: {json.dumps(own)}" for name, own in content.items()
        )
        return PartMarks(made, (), f"{{\n{lines}\n}}\n")
    known = _read(folder / FILE)
    found: dict[str, MemberRecord] = {}
    for record in records:
        key, *shared = known.get(record.member, [""])
        if key == keys[record.member] and len(shared) == len(record.plates):
            found[record.member] = with_shared(record, shared)
    changed = [record for record in records if record.member not in found]
    found |= {record.member: record for record in numbered(changed)}
    findings = tuple(
        note(
            "part-marks-partial",
            record.member,
            "its part marks were not compared with those of members that are not built",
            "build all members before parts are ordered by part mark",
        )
        for record in changed
    )
    return PartMarks(tuple(found[record.member] for record in records), findings)


def keep_part_marks(folder: Path, marks: PartMarks) -> None:
    """Keep the marks of a whole build; where that cannot be they are found again."""
    if marks.kept:
        write_or_remove(folder / FILE, marks.kept.encode())


def built_from(folder: Path) -> dict[str, str]:
    """The keys of what members came from in the last whole build, by name."""
    return {name: own[0] for name, own in _read(folder / FILE).items()}


def _read(path: Path) -> dict[str, list]:
    """Of each member its key, then part, quantity and opposite hand of its plates; what is damaged
    is as good as absent."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        return {
            str(name): [str(key), *((str(p), int(q), str(h)) for p, q, h in plates)]
            for name, (key, *plates) in content.items()
        }
    except (OSError, AttributeError, TypeError, ValueError):
        return {}
