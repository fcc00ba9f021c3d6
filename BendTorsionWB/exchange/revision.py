# SPDX-License-Identifier: LGPL-2.1-or-later
"""What became of every plate since the last issue: same, changed by so much, new or void; and what
that means for plates already cut."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

from BendTorsionWB.core.finding import Finding, error, warning
from BendTorsionWB.core.patterns.outline_change import SAME, apart, deviation, trim
from BendTorsionWB.exchange.plate_outlines import CutOutline
from BendTorsionWB.exchange.whole_file import write_changed
from BendTorsionWB.exchange.xlsx_file import HUNDREDTH, TEXT, Column, Table, xlsx_bytes

STATUSES = ("cut", "trim", "scrap")
"""Of a plate in the shop: cut, so that it must not change, or its trimming or scrapping agreed."""
OPENING = 0.5
"""mm; an opening whose rim is no farther off is the one that is cut already."""
REVISION = "revision"


@dataclass(frozen=True)
class PlateChange:
    """A plate against the last issue. what: `same`, `changed`, `new` or `void`; deviation: mm
    between the outlines in their best alignment; length, width: mm more than before; note: what
    else changed; verdict: of a plate already cut."""

    mark: str
    what: str
    deviation: float | None = None
    length: float | None = None
    width: float | None = None
    note: str = ""
    status: str = ""
    verdict: str = ""


def plate_change(before: CutOutline | None, after: CutOutline | None) -> PlateChange:
    """The change of one plate, its files apart."""
    mark = (after or before).mark
    if before is None or after is None:
        return PlateChange(mark, "new" if before is None else "void")
    notes = [
        f"{what} {old:g} -> {new:g}" if isinstance(old, float) else f"{what} {old} -> {new}"
        for what, old, new in (
            ("thickness", before.thickness, after.thickness),
            ("material", before.material, after.material),
        )
        if old != new
    ]
    if not _same_holes(before, after):
        notes.append("openings")
    apart = deviation(before.outline, after.outline)
    return PlateChange(
        mark,
        "changed" if notes or apart > SAME else "same",
        apart,
        after.length - before.length,
        after.width - before.width,
        ", ".join(notes),
    )


def plate_changes(
    before: Mapping[str, CutOutline],
    after: Mapping[str, CutOutline],
    statuses: Mapping[str, str],
    run: Callable = map,
) -> tuple[PlateChange, ...]:
    """The changes of all plates, those there are now first. statuses: of STATUSES by mark; run:
    maps plate_change over plates, an executor's map for instance."""
    marks = list(dict.fromkeys((*after, *before)))
    apart = [mark for mark in marks if not _equal(before.get(mark), after.get(mark))]
    found = run(plate_change, [before.get(m) for m in apart], [after.get(m) for m in apart])
    changed = {change.mark: change for change in found}
    twins = _twins(before, after)
    changes = []
    for mark in marks:
        change = changed.get(mark) or PlateChange(mark, "same", 0.0, 0.0, 0.0)
        status, twin = statuses.get(mark, ""), twins.get(mark)
        if twin:
            own = "new" if change.what == "void" else "void"
            change = replace(change, note=f"the same plate as {twin}, which is {own}")
        if status and change.what != "same":
            verdict = _verdict(change, before.get(mark), after.get(mark))
            if twin and change.what == "void":
                verdict = f"use as it is, its mark apart: {change.note}"
            change = replace(change, status=status, verdict=verdict)
        changes.append(change)
    return tuple(changes)


def _twins(before: Mapping[str, CutOutline], after: Mapping[str, CutOutline]) -> dict[str, str]:
    """Marks of plates of members that are gone and of members that are new where all plates of the
    one are those of the other to the last digit, as when a member is renamed, each by the other;
    none where two members are alike."""
    sides = []
    for own, other in ((before, after), (after, before)):
        staying = {plate.member for plate in other.values()}
        members: dict[str, list[tuple]] = {}
        for mark, plate in own.items():
            if plate.member not in staying:
                content = (mark.removeprefix(plate.member), plate.thickness, plate.material)
                rings = tuple(ring.tobytes() for ring in (plate.outline, *plate.holes))
                members.setdefault(plate.member, []).append((*content, rings))
        alike: dict[tuple, list[str]] = {}
        for member, plates in members.items():
            alike.setdefault(tuple(sorted(plates)), []).append(member)
        sides.append(alike)
    found = {}
    for plates, gone in sides[0].items():
        came = sides[1].get(plates, ())
        if len(gone) == 1 == len(came):
            for ending, *_ in plates:
                one, other = f"{gone[0]}{ending}", f"{came[0]}{ending}"
                found |= {one: other, other: one}
    return found


def with_marking(
    changes: tuple[PlateChange, ...], same_files: set[str], statuses: Mapping[str, str]
) -> tuple[PlateChange, ...]:
    """The changes, with those added that only the files show: marks and texts. same_files: plates
    whose cut files are the issued ones to the byte."""
    return tuple(
        replace(
            change,
            what="changed",
            note="marking",
            status=statuses.get(change.mark, ""),
            verdict="use as it is: only its marking changed" if change.mark in statuses else "",
        )
        if change.what == "same" and change.mark not in same_files
        else change
        for change in changes
    )


def _equal(before: CutOutline | None, after: CutOutline | None) -> bool:
    if before is None or after is None or len(before.holes) != len(after.holes):
        return False
    return (before.thickness, before.material) == (after.thickness, after.material) and all(
        np.array_equal(old, new)
        for old, new in zip((before.outline, *before.holes), (after.outline, *after.holes))
    )


def _verdict(change: PlateChange, old: CutOutline | None, new: CutOutline | None) -> str:
    """What to do with a plate already cut."""
    if old is None:
        return ""
    if new is None:
        return "scrap: the plate is no longer needed"
    if old.thickness != new.thickness or old.material != new.material:
        return f"scrap: {change.note}"
    cut = trim(old.outline, new.outline, old.end_first)
    if not cut.possible:
        return f"scrap: {cut.missing:.1f} mm of material are missing"
    wanted = [cut.laid(hole) for hole in new.holes]
    if not all(_is_among(hole, wanted) for hole in old.holes):
        return "scrap: it has an opening where the new one has none"
    work = [f"trim {mm:.1f} mm at {side}" for side, mm in cut.sides]
    if len(new.holes) > len(old.holes):
        work.append("cut the new openings")
    return "; ".join(work) or "use as it is"


def _same_holes(before: CutOutline, after: CutOutline) -> bool:
    if len(before.holes) != len(after.holes):
        return False
    shift = before.outline.mean(axis=0) - after.outline.mean(axis=0)
    return all(
        deviation(old, new) <= SAME and apart(old, new + shift) <= OPENING
        for old, new in zip(before.holes, after.holes)
    )


def _is_among(hole: np.ndarray, others: Iterable[np.ndarray]) -> bool:
    return any(apart(hole, other) <= OPENING for other in others)


def cut_findings(changes: tuple[PlateChange, ...]) -> tuple[Finding, ...]:
    """An error for each plate marked `cut` that would change, or `trim` that cannot be trimmed; a
    warning where its change is agreed to or where it can be used all the same."""
    return tuple(_cut_finding(change) for change in changes if change.status)


def _cut_finding(change: PlateChange) -> Finding:
    scrap = change.verdict.startswith("scrap")
    usable = change.verdict.startswith("use as it is")
    if change.what == "new":
        return error(
            "cut-plate-new",
            change.mark,
            f"has the status {change.status}, but the last issue holds no such plate",
            "correct its mark, or take its row away until the plate is issued",
        )
    agreed = usable or change.status == "scrap" or (change.status == "trim" and not scrap)
    # A thickness, an opening or the end of a plate is no distance of outlines.
    far = change.deviation is not None and change.deviation > SAME
    figures = {"value": float(change.deviation), "limit": SAME, "unit": "mm"} if far else {}
    changes = f"is cut already and would be {change.what}: {change.verdict}"
    untrimmed = f"has the status trim, but cannot be trimmed: {change.verdict}"
    if far:
        # What comes off at one side alone is twice what the outlines are apart.
        off = f"{change.deviation:.2f}"
        changes = (
            f"is cut already and would be {change.what}, {off} mm off where it lies best on the "
            f"new one: {change.verdict}"
        )
        untrimmed = (
            f"has the status trim, but cannot be trimmed, {off} mm off where it lies best on the "
            f"new one: {change.verdict}"
        )
    if agreed:
        return warning("cut-plate-changes", change.mark, changes, "tell the shop", **figures)
    if change.status == "trim":
        return error(
            "cut-plate-no-trim",
            change.mark,
            untrimmed,
            "leave the plate as issued, or give it the status scrap when that is agreed to",
            **figures,
        )
    return error(
        "cut-plate-changes",
        change.mark,
        changes,
        f"leave the plate as issued, or give it the status {'scrap' if scrap else 'trim'} when "
        "that is agreed to",
        **figures,
    )


COLUMNS = (
    Column("plate", TEXT, 14),
    Column("what", TEXT, 10),
    Column("deviation", HUNDREDTH, 12),
    Column("length_change", HUNDREDTH, 14),
    Column("width_change", HUNDREDTH, 14),
    Column("note", TEXT, 30),
    Column("status", TEXT, 9),
    Column("verdict", TEXT, 44),
)


def rounded_row(fields: Mapping[str, object]) -> tuple:
    """The fields of a line of a table in their order, lengths to 0.01 mm: outlines are the same
    within more than that."""
    # A rounded -0.004 is no less than nothing.
    return tuple(round(v, 2) + 0.0 if isinstance(v, float) else v for v in fields.values())


def write_revision(since: str, changes: tuple[PlateChange, ...], out: Path) -> list[str]:
    """Write revision.xlsx and revision.json; their names. since: the issue compared with."""
    rows = [rounded_row(asdict(change)) for change in changes]
    counts = {what: sum(c.what == what for c in changes) for what in WHAT}
    notes = [("since", since), *counts.items()]
    table = Table("Plates", COLUMNS, rows, notes)
    write_changed(out / f"{REVISION}.xlsx", xlsx_bytes([table], f"Changes since revision {since}"))
    content = {"since": since, "plates": [asdict(change) for change in changes], **counts}
    write_changed(out / f"{REVISION}.json", (json.dumps(content, indent=1) + "\n").encode())
    return [f"{REVISION}.xlsx", f"{REVISION}.json"]


WHAT = ("same", "changed", "new", "void")
