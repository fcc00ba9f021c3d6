# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a build leaves in its folder: which files are ours, of which member, and made from what."""

from __future__ import annotations

import hashlib
import itertools
import json
import os
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from BendTorsionWB.core.finding import BETWEEN, BendTorsionError, Finding, error, warning
from BendTorsionWB.exchange.file_name import same_file
from BendTorsionWB.exchange.issued_folder import refuse_issued
from BendTorsionWB.exchange.known_hashes import KnownHashes, file_hash
from BendTorsionWB.exchange.left_out_files import kinds_gone
from BendTorsionWB.exchange.whole_file import not_written, remove_parts, write_whole

MANIFEST = ".bendtorsion.json"
"""The record of our files in the folder."""
JOURNAL = ".bendtorsion.journal"
"""What a build has written so far, a line (JSON) per file; gone when its record is whole."""
_FIELDS = ("member", "made_from", "sha256", "told")
_quoted = json.encoder.encode_basestring_ascii
UPDATED = "update "
"""How the key of a document begins that was brought up to date and may hold hand-made additions."""


@dataclass(frozen=True)
class OwnFile:
    """A file of ours. member: whose it is, empty for the whole building; made_from: key of its
    input; sha256: hash of what we wrote; told: findings of what was left in it, as JSON, that hold
    as long as it stays."""

    member: str
    made_from: str = ""
    sha256: str = ""
    told: str = ""

    def as_json(self, name: str = "") -> str:
        """Its fields for the record of the folder, after its name where one is given."""
        texts = (("name", name),) if name else ()
        texts += (("member", self.member), ("made_from", self.made_from), ("sha256", self.sha256))
        texts += (("told", self.told),) if self.told else ()
        return "".join(("{", ", ".join(f'"{key}": {_quoted(own)}' for key, own in texts), "}"))


def check_folder(out: Path) -> None:
    """Raises BendTorsionError when the folder cannot be written to or is of an issue, before hours
    of computing."""
    refuse_issued(out)
    existing = next(p for p in (out, *out.absolute().parents) if os.path.exists(p))
    if existing.is_dir() and os.access(existing, os.W_OK | os.X_OK):
        return
    name = str(existing)
    raise BendTorsionError(
        error("file-not-written", name, "cannot be written to", "choose another folder for --out")
        if existing.is_dir()
        else error("folder-is-file", name, "is a file, not a folder", "name a folder as --out")
    )


def check_project(out: Path, project: str, force: bool = False) -> None:
    """Raises BendTorsionError when the folder holds the files of a project of another name, unless
    forced: a build removes files that are no longer made. A project without a name is any."""
    other = _read(out).get("project", "")
    if not force and project and isinstance(other, str) and other not in ("", project):
        raise BendTorsionError(
            error(
                "folder-of-another-project",
                str(out),
                f"the folder holds the files of project {other!r}, this is {project!r}",
                "choose another folder, or add --force to replace that project's files",
            )
        )


def read_manifest(out: Path) -> dict[str, OwnFile]:
    """Our files by name as the last build left them, also one that was killed; nothing where the
    record is lost."""
    files = _read(out).get("files")
    found, within = {}, _Within(out)
    for name, item in files.items() if isinstance(files, dict) else ():
        own = _own_file(within, name, item)
        if own is not None:
            found[name] = own
    for name, own in _read_journal(out):
        # Begun and perhaps not done: what the record says holds as long as the file is of it.
        if name not in found or (own.sha256 and file_hash(out / name) == own.sha256):
            found[name] = own
    return found


def _own_file(within: _Within, name: str, item: object) -> OwnFile | None:
    """A file of a record that may be damaged; None for what is none within the folder."""
    try:
        if not isinstance(item, dict) or not within.holds(name):
            return None
    except (OSError, ValueError):
        return None
    return OwnFile(*(str(item.get(key, "")) for key in _FIELDS))


class _Within:
    """Tells which names lead to places within a folder, links followed; where a folder within it
    leads is looked at once."""

    def __init__(self, out: Path):
        self._whole = f"{os.path.realpath(out).rstrip(os.sep)}{os.sep}"
        self._folders: dict[str, bool] = {}

    def holds(self, name: str) -> bool:
        """Whether a name does; raises ValueError for what can be no name."""
        if "\0" in name:
            raise ValueError(name)
        folder, last = os.path.split(os.path.join(self._whole, name))
        if last in ("", os.curdir, os.pardir) or os.path.islink(os.path.join(folder, last)):
            return os.path.realpath(os.path.join(folder, last)).startswith(self._whole)
        if folder not in self._folders:
            place = os.path.realpath(folder).rstrip(os.sep)
            self._folders[folder] = f"{place}{os.sep}".startswith(self._whole)
        return self._folders[folder]


def is_unfinished(out: Path) -> bool:
    """Whether the last build of a folder was killed before its end."""
    return (out / JOURNAL).exists()


def _read_journal(out: Path) -> list[tuple[str, OwnFile]]:
    """Names and what is known of them, in the order they were written in; a line that was cut
    short when the program died is none."""
    try:
        *lines, _ = (out / JOURNAL).read_text(encoding="utf-8").split("\n")
    except (OSError, ValueError):
        return []
    found, within = [], _Within(out)
    for line in lines:
        try:
            item = json.loads(line)
            name = str(item["name"])
        except (ValueError, KeyError, TypeError):
            continue
        own = _own_file(within, name, item)
        if own is not None:
            found.append((name, own))
    return found


def _read(out: Path) -> dict:
    """The record of a folder, not to be changed; asked for again and again by a build."""
    place = out / MANIFEST
    try:
        told = place.stat()
        stamp = (str(place), told.st_ino, told.st_size, told.st_mtime_ns, told.st_ctime_ns)
        if _last_read.get("stamp") != stamp:
            former = json.loads(place.read_text(encoding="utf-8"))
            _last_read.update(stamp=stamp, record=former if isinstance(former, dict) else {})
    except (OSError, ValueError):
        return {}
    return _last_read["record"]


_last_read: dict = {}


def outdated_members(out: Path) -> list[str]:
    """Members that changed since the files of theirs were made that lie in the folder."""
    found = _read(out).get("outdated")
    return [str(name) for name in found] if isinstance(found, list) else []


def standing_errors(out: Path) -> dict[str, str]:
    """What the last build found in error, by object (a member, a plate, a file), in words."""
    found = _read(out).get("errors")
    return {str(k): str(v) for k, v in found.items()} if isinstance(found, dict) else {}


def write_manifest(
    out: Path,
    files: Mapping[str, OwnFile],
    project: str = "",
    outdated: Sequence[str] = (),
    errors: Mapping[str, str] | None = None,
) -> None:
    """Keep the record of a project's files. outdated: members these are no longer of; errors: as
    of `standing_errors`. Raises BendTorsionError."""
    lines = ",\n".join(f"{_quoted(name)}: {files[name].as_json()}" for name in sorted(files))
    told = f'"outdated": {json.dumps(list(outdated))}, ' if outdated else ""
    told += f'"errors": {json.dumps(dict(errors))}, ' if errors else ""
    text = f'{{"project": {json.dumps(project)}, {told}"files": {{\n{lines}\n}}}}\n'
    _last_read.clear()
    write_whole(out / MANIFEST, text.encode())


def remove(out: Path, names: Iterable[str]) -> None:
    """Remove files of ours; raises BendTorsionError for one that cannot go."""
    for name in names:
        try:
            (out / name).unlink(missing_ok=True)
        except OSError as failure:
            raise BendTorsionError(
                error(
                    "file-not-written",
                    str(out / name),
                    f"cannot be removed: {failure.strerror or failure}",
                    "close the program that holds it open, or allow writing to its folder",
                )
            ) from failure


class OutputFolder:
    """The output folder during a build: what was there, and what is there now."""

    def __init__(self, out: Path, former: dict[str, OwnFile], project: str = ""):
        self.out, self.former, self.now, self.project = out, former, {}, project
        self.errors = standing_errors(out)
        self._noted, self._within, self._hashes = False, _Within(out), KnownHashes(out)
        self._told: list[Finding] = []
        self._made: set[str] = set()
        for folder in {"", ".cache", *(os.path.dirname(name) for name in former)}:
            remove_parts(out / folder)

    def has(self, name: str, made_from: str) -> bool:
        """Whether the file is there already, from this very input."""
        own = self.former.get(name)
        same = own is not None and own.made_from == made_from != ""
        return name in self.now or (same and self._hashes.of(name) == own.sha256 != "")

    def keep(self, name: str) -> None:
        """The file stays as it is. Raises BendTorsionError as `write` for one written before."""
        self._once(name)
        self.now[name] = self.former[name]

    def begin(self, name: str, member: str = "") -> None:
        """The file is about to be written: after a kill the next build knows it as ours. Raises
        BendTorsionError as `write`."""
        self._once(name)
        self._note(name, OwnFile(member))

    def write(self, name: str, content: bytes, made_from: str, member: str = "") -> None:
        """Write a file. Raises BendTorsionError, also for a name this build has had before: another
        file of it would be lost."""
        self._once(name)
        own = OwnFile(member, made_from, hashlib.sha256(content).hexdigest())
        self._note(name, own)
        write_whole(self.out / name, content)
        self._hashes.wrote(name, own.sha256)
        self.now[name] = own

    def wrote(
        self,
        name: str,
        made_from: str,
        member: str = "",
        left: Iterable[Finding] = (),
        sha256: str = "",
    ) -> None:
        """The file, begun before, has just been written. left: as `left_in` tells it later; sha256:
        of the file, where it was taken before."""
        told = [finding.as_dict() for finding in left]
        if sha256:
            self._hashes.wrote(name, sha256)
        found = sha256 or self._hashes.of(name)
        self.now[name] = OwnFile(member, made_from, found, json.dumps(told) if told else "")
        self._note(name, self.now[name])

    def left_in(self, name: str) -> tuple[Finding, ...]:
        """What was found to be left in a file that stays as a build before wrote it; nothing where
        the record is damaged."""
        own = self.former.get(name)
        try:
            return tuple(Finding(**item) for item in json.loads(own.told)) if own else ()
        except (ValueError, TypeError):
            return ()

    def _once(self, name: str) -> None:
        if "\0" in name or not self._within.holds(name):
            mend = "rename the member, section or plate it is named after"
            raise BendTorsionError(error("file-outside", name, "lies outside the folder", mend))
        if same_file(name) in self._made:
            message, mend = "two files of the build have this name", "rename what it is named after"
            raise BendTorsionError(error("file-name-twice", name, message, mend))
        self._made.add(same_file(name))

    def _note(self, name: str, own: OwnFile) -> None:
        line = "".join((own.as_json(name), "\n"))
        try:
            self.out.mkdir(parents=True, exist_ok=True)
            if not self._noted and _read(self.out).get("project") != self.project:
                # Whose files they are is known from the first one on.
                write_manifest(self.out, self.former, self.project, errors=self.errors)
            # A line that was cut short must not swallow the next one.
            start = "" if self._noted else "\n"
            with open(self.out / JOURNAL, "a", encoding="utf-8", newline="\n") as stream:
                stream.write(start + line)
            self._noted = True
        except OSError as failure:
            raise BendTorsionError(not_written(self.out / name, failure)) from failure

    def save_by_hand(self, name: str) -> None:
        """Set a document aside that may hold work by hand, before another takes its place or none
        does, beside those set aside before; `close` tells."""
        own = self.former.get(name)
        place = self.out / name
        by_hand = own is None or own.made_from.startswith(UPDATED)
        if place.exists() and (by_hand or file_hash(place) != own.sha256):
            free = _free(place)
            os.replace(place, free)
            self._told.append(
                warning(
                    "document-set-aside",
                    name,
                    f"may hold work by hand and is kept as {free.name}",
                    "copy from it what is still needed, then delete it",
                )
            )

    def close(
        self,
        left_out: Collection[str] = (),
        outdated: Sequence[str] = (),
        refused: Collection[str] = (),
        findings: Iterable[Finding] = (),
    ) -> tuple[Finding, ...]:
        """Remove what is no longer made, and keep the record. left_out: members whose files stay as
        they are; outdated: those of them that changed since; refused: members in error, of which
        nothing is written; findings: of the build. Files changed by hand stay, documents brought up
        by an update are set aside, both with a warning; so is a member in error whose former files
        are removed, and what was removed of a kind of files the build was told to leave out."""
        found, lost, removed = [], [], []
        for name, own in self.former.items():
            if name in self.now:
                continue
            if own.member in left_out:
                self.now[name] = own
            elif not own.member and self._hashes.of(name) not in ("", own.sha256):
                found.append(
                    warning(
                        "file-outdated",
                        name,
                        "was changed by hand and is not of this build",
                        "build it again, or move it away",
                    )
                )
            elif name.endswith(".FCStd") and own.made_from.startswith(UPDATED):
                self.save_by_hand(name)
            else:
                remove(self.out, [name])
                removed.append(name)
                lost += [own.member] if own.member in refused else []
        if lost:
            found.append(
                warning(
                    "file-removed",
                    BETWEEN.join(dict.fromkeys(lost)),
                    "in error: the drawings and cut files of the build before were removed",
                    "mend the errors and build again; what was issued stays in its issue",
                    value=float(len(lost)),
                )
            )
        for kind, own in kinds_gone(removed, self.now).items() if not refused else ():
            found.append(
                warning(
                    "files-left-out",
                    kind,
                    "left out of this build; the files of the build before are removed",
                    "build again with them when they are needed, as for an issue",
                    value=BETWEEN.join(own[:3]),
                )
            )
        errors = {key: told for key, told in self.errors.items() if _is_of(key, left_out)}
        errors |= {f.object: f.message for f in findings if f.severity == "error"}
        write_manifest(self.out, self.now, self.project, outdated, errors)
        if self._noted:
            self._hashes.keep(self.now, os.stat(self.out / MANIFEST).st_mtime_ns)
        remove(self.out, [JOURNAL])
        return (*self._told, *found)


def _is_of(objects: str, members: Collection[str]) -> bool:
    """Whether the objects of a finding are of any of these members, or plates of theirs."""
    return any(
        own == name or own.startswith(f"{name}-")
        for own in objects.split(BETWEEN)
        for name in members
    )


def _free(place: Path) -> Path:
    """`model.former.FCStd` of `model.FCStd`, numbered when there is one already."""
    for number in itertools.count(1):
        ending = "former" if number == 1 else f"former-{number}"
        free = place.with_suffix(f".{ending}{place.suffix}")
        if not os.path.lexists(free):
            return free
