# SPDX-License-Identifier: LGPL-2.1-or-later
"""Issues: the files of a build frozen under a revision, with a list of what was transmitted.

`issued/B` holds copies of the files that changed since the issue before, their names ending in
`_B`, and transmittal.json with the hash and revision of every file that is valid now. Nothing in
it is ever written again.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
from collections.abc import Callable, Collection, Iterable, Mapping
from concurrent.futures import Future
from dataclasses import asdict, dataclass, replace
from pathlib import Path, PurePosixPath

from BendTorsionWB.core.finding import BETWEEN, BendTorsionError, error
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.exchange.csv_folder import csv_bytes
from BendTorsionWB.exchange.issued_folder import ISSUED, OUTLINES, TRANSMITTAL
from BendTorsionWB.exchange.known_hashes import file_hash
from BendTorsionWB.exchange.left_out_files import kinds_gone
from BendTorsionWB.exchange.output_folder import (
    is_unfinished,
    outdated_members,
    read_manifest,
    standing_errors,
)
from BendTorsionWB.exchange.plate_outlines import (
    CutOutline,
    cut_outline,
    read_outlines,
    start_packing,
    write_outlines,
)
from BendTorsionWB.exchange.report import dxf_name, nc1_name
from BendTorsionWB.exchange.revision import (
    REVISION,
    PlateChange,
    plate_changes,
    rounded_row,
    with_marking,
    write_revision,
)
from BendTorsionWB.exchange.revision_stamp import stamped
from BendTorsionWB.exchange.whole_file import (
    not_written,
    part_beside,
    remove_parts,
    write_or_remove,
    write_whole,
)
from BendTorsionWB.exchange.xlsx_file import HUNDREDTH, TEXT, WHOLE, Column, Table, xlsx_bytes

KEPT_OUTLINES = ".bendtorsion-outlines.npz"
"""The outlines of the plates of a folder, as the last build left them."""
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9.-]{0,15}")
_NOT_ISSUED = ("revision.xlsx", "revision.json", "report.json")


@dataclass(frozen=True)
class IssuedFile:
    """A line of a transmittal. name: of the build's file; issued_as: path below `issued`;
    revision: in which it changed last; what: same, changed, new or void in this issue; sha256 and
    bytes: as issued; built: sha256 of the build's file where that has not the revision in it."""

    name: str
    issued_as: str
    revision: str
    what: str
    member: str
    plate: str
    deviation: float | None
    sha256: str
    bytes: int
    built: str = ""

    def is_of(self, sha256: str) -> bool:
        """Whether it was issued from a file of this hash."""
        return sha256 == (self.built or self.sha256)


@dataclass(frozen=True)
class Issue:
    """A frozen issue: its revision, its number from 1, and its lines by file name."""

    revision: str
    number: int
    note: str
    files: Mapping[str, IssuedFile]


def last_issue(out: Path) -> Issue | None:
    """The latest issue of a folder; raises BendTorsionError for a transmittal that cannot be
    read."""
    return max(_issues(out), key=lambda issue: issue.number, default=None)


def issued_marks(out: Path) -> set[str]:
    """Marks of all plates that were ever issued; raises BendTorsionError as last_issue does."""
    return {item.plate for issue in _issues(out) for item in issue.files.values() if item.plate}


def _issues(out: Path) -> list[Issue]:
    found = []
    # What begins with a point was never issued: the program was killed over it.
    for path in sorted((out / ISSUED).glob(f"[!.]*/{TRANSMITTAL}.json")):
        try:
            content = json.loads(path.read_text(encoding="utf-8"))
            files = {item["name"]: IssuedFile(**item) for item in content["files"]}
            found.append(Issue(content["revision"], int(content["number"]), content["note"], files))
        except (OSError, ValueError, KeyError, TypeError) as problem:
            raise _fault(
                "issue-unreadable", str(path), f"cannot be read: {problem}", "restore it"
            ) from problem
    return found


def issued_outlines(out: Path, issue: Issue | None) -> Mapping[str, CutOutline]:
    """The outlines of an issue by mark."""
    return read_outlines(out / ISSUED / issue.revision / OUTLINES) if issue else {}


def unchanged_marks(out: Path, issue: Issue) -> set[str]:
    """Marks of plates whose cut files in the folder are those of the issue to the byte."""
    same: dict[str, bool] = {}
    for item in issue.files.values():
        if item.plate and item.what != "void":
            equal = item.is_of(file_hash(out / item.name))
            same[item.plate] = same.get(item.plate, True) and equal
    return {mark for mark, equal in same.items() if equal}


def issue(out: Path, revision: str, outlines: Path, note: str = "") -> Issue:
    """Freeze the files of a built folder under a revision. outlines: the file of the build's plate
    outlines. Raises BendTorsionError for a revision there is already, files that are not as the
    build left them, a build in error or without a kind of file the issue before has, and a folder
    without a build; then nothing is written."""
    out = Path(out)
    target = out / ISSUED / revision
    former = last_issue(out)
    _check(out, revision, target)
    if is_unfinished(out):
        raise _fault("issue-nothing", str(out), "the last build did not end", "build it again")
    outdated = outdated_members(out)
    if outdated:
        raise BendTorsionError(
            error(
                "issue-outdated",
                name,
                "was left out of the last build and has changed since",
                "build all members first",
            )
            for name in outdated
        )
    standing = standing_errors(out)
    if standing:
        raise BendTorsionError(
            error(
                "issue-in-error",
                name,
                f"was in error in the last build: {told}",
                "mend it and build again",
            )
            for name, told in standing.items()
        )
    manifest = {n: own for n, own in read_manifest(out).items() if n not in _NOT_ISSUED}
    now = read_outlines(outlines)
    if not manifest or not now:
        raise _fault("issue-nothing", str(out), "there is no whole build", "build it first")
    if former:
        _refuse_left_out(former, manifest)
    wrong = [name for name, own in manifest.items() if file_hash(out / name) != own.sha256]
    if wrong:
        raise BendTorsionError(
            finding for name in wrong for finding in _changed(out / name).findings
        )
    before = issued_outlines(out, former)
    same = unchanged_marks(out, former) if former else set()
    changes = {c.mark: c for c in with_marking(plate_changes(before, now, {}), same, {})}
    marks = {made: mark for mark in now for made in (dxf_name(mark), nc1_name(mark))}
    lines, copies = {}, []
    for name, own in sorted(manifest.items()):
        old = former.files.get(name) if former else None
        if old is not None and old.what != "void" and old.is_of(own.sha256):
            line = IssuedFile(**{**asdict(old), "what": "same", "deviation": None})
        else:
            issued_as = _revised(name, revision)
            change = changes.get(marks.get(name, ""))
            content = _content(out, name, own.sha256, revision)
            line = IssuedFile(
                name,
                f"{revision}/{issued_as}",
                revision,
                "new" if old is None or old.what == "void" else "changed",
                own.member,
                marks.get(name, ""),
                change.deviation if change else None,
                hashlib.sha256(content).hexdigest(),
                len(content),
                own.sha256,
            )
            copies.append((name, issued_as))
        lines[name] = line
    for name, old in former.files.items() if former else ():
        if name not in lines and old.what != "void":
            lines[name] = IssuedFile(**{**asdict(old), "what": "void", "deviation": None})
    made = Issue(revision, former.number + 1 if former else 1, note, lines)
    _freeze(out, target, made, copies, now)
    return made


def _refuse_left_out(former: Issue, names: Iterable[str]) -> None:
    valid = [name for name, item in former.files.items() if item.what != "void"]
    gone = kinds_gone(valid, names)
    if gone:
        raise BendTorsionError(
            error(
                "issue-left-out",
                kind,
                f"was left out of the last build, and issue {former.revision} has it",
                f"build the same schedule again with the {kind}, then issue it",
                value=BETWEEN.join(own[:3]),
            )
            for kind, own in gone.items()
        )


def _check(out: Path, revision: str, target: Path) -> None:
    if not _NAME.fullmatch(revision):
        mend = "use letters, digits, points and hyphens, such as B or P02"
        raise _fault("revision-name", revision or "--rev", "is no name for a revision", mend)
    taken = {p.name.lower() for p in (out / ISSUED).glob("*") if not p.name.startswith(".")}
    if revision.lower() in taken:
        raise _fault("revision-exists", str(target), "is issued already", "choose another --rev")


def _content(out: Path, name: str, sha256: str, revision: str) -> bytes:
    """A file of the build with the revision in it; raises BendTorsionError when it is not as the
    build left it."""
    try:
        content = (out / name).read_bytes()
    except OSError:
        content = b""
    if hashlib.sha256(content).hexdigest() != sha256:
        raise _changed(out / name)
    return stamped(name, content, revision)


def _revised(name: str, revision: str) -> str:
    path = PurePosixPath(name)
    return str(path.with_name(f"{path.stem}_{revision}{path.suffix}"))


def _freeze(out: Path, target: Path, made: Issue, copies, outlines) -> None:
    part = part_beside(target)
    remove_parts(target.parent)
    try:
        for name, issued_as in copies:
            (part / issued_as).parent.mkdir(parents=True, exist_ok=True)
            content = _content(out, name, made.files[name].built, made.revision)
            (part / issued_as).write_bytes(content)
        part.mkdir(parents=True, exist_ok=True)
        write_outlines(outlines.values(), part / OUTLINES)
        _write_transmittal(made, part)
        for path in part.rglob("*"):
            if path.is_file():
                path.chmod(0o444)
        os.rename(part, target)
    except BendTorsionError as problem:
        # Of a file in a folder that is hidden and gone by now.
        raise BendTorsionError(replace(f, object=str(target)) for f in problem.findings) from None
    except OSError as failure:
        raise BendTorsionError(not_written(target, failure)) from failure
    finally:
        shutil.rmtree(part, ignore_errors=True)


COLUMNS = (
    Column("file", TEXT, 30),
    Column("issued_as", TEXT, 34),
    Column("revision", TEXT, 10),
    Column("what", TEXT, 10),
    Column("member", TEXT, 12),
    Column("plate", TEXT, 14),
    Column("deviation", HUNDREDTH, 11),
    Column("sha256", TEXT, 66),
    Column("bytes", WHOLE, 12),
)


def _write_transmittal(made: Issue, folder: Path) -> None:
    rows = [rounded_row(_told(line)) for line in made.files.values()]
    counts = [(what, counted(made)[what]) for what in ("new", "changed", "same", "void")]
    notes = [("revision", made.revision), ("note", made.note), *counts]
    table = Table("Transmittal", COLUMNS, rows, notes)
    title = f"Transmittal {made.revision}"
    write_whole(folder / f"{TRANSMITTAL}.xlsx", xlsx_bytes([table], title))
    write_whole(
        folder / f"{TRANSMITTAL}.csv", csv_bytes([[column.name for column in COLUMNS], *rows])
    )
    content = {
        "revision": made.revision,
        "number": made.number,
        "note": made.note,
        "files": [asdict(line) for line in made.files.values()],
    }
    text = json.dumps(content, indent=1, ensure_ascii=False) + "\n"
    write_whole(folder / f"{TRANSMITTAL}.json", text.encode())


def counted(made: Issue) -> dict[str, int]:
    """How many files are new, changed, same and void."""
    return {
        what: sum(line.what == what for line in made.files.values())
        for what in ("new", "changed", "same", "void")
    }


@dataclass(frozen=True)
class Comparison:
    """A build against the last issue: the outlines of the folder's plates now, and as they are
    kept, the changes of those built, and all marks there are or were in an issue."""

    issue: Issue | None
    outlines: Mapping[str, CutOutline]
    packed: Future[bytes]
    changes: tuple[PlateChange, ...]
    marks: frozenset[str]


def compared(
    out: Path,
    kept: Path,
    records: Iterable[MemberRecord],
    statuses: Mapping[str, str],
    left_out: Collection[str] = (),
    run: Callable = map,
) -> Comparison:
    """Compare the plates of a build with the last issue. kept: the file of the folder's outlines;
    left_out: members whose plates stay as they were."""
    former = last_issue(out)
    records = list(records)
    now = {plate.mark: cut_outline(plate) for record in records for plate in record.plates}
    before = issued_outlines(out, former)
    before = {mark: plate for mark, plate in before.items() if plate.member not in left_out}
    changes = plate_changes(before, now, statuses, run) if former else ()
    if left_out:
        others = read_outlines(kept).values()
        now |= {plate.mark: plate for plate in others if plate.member in left_out}
    packed = start_packing([now[mark] for mark in sorted(now)])
    return Comparison(former, now, packed, changes, frozenset({*now, *issued_marks(out)}))


def comparison_files(found: Comparison) -> list[str]:
    """Names of the files write_comparison writes."""
    return [] if found.issue is None else [f"{REVISION}.xlsx", f"{REVISION}.json"]


def write_comparison(
    found: Comparison,
    out: Path,
    kept: Path,
    statuses: Mapping[str, str],
    refused: Collection[str] = (),
) -> list[str]:
    """Keep the outlines, and write what changed since the last issue; names of the files. refused:
    members in error, of which there are no files to compare. Outlines that cannot be kept leave
    the build as it is; it cannot be issued then."""
    write_or_remove(kept, found.packed.result())
    if found.issue is None:
        return []
    same = unchanged_marks(out, found.issue)
    same |= {mark for mark, plate in found.outlines.items() if plate.member in refused}
    changes = with_marking(found.changes, same, statuses)
    return write_revision(found.issue.revision, changes, out)


def _told(line: IssuedFile) -> dict[str, object]:
    """The fields of a line that the receiver's tables have."""
    return {name: value for name, value in asdict(line).items() if name != "built"}


def _changed(path: Path) -> BendTorsionError:
    return _fault("file-changed", str(path), "is not as the build left it", "build it again")


def _fault(code: str, object: str, message: str, mend: str) -> BendTorsionError:
    return BendTorsionError(error(code, object, message, mend))
