# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a report of a fault needs, in one file: versions, preferences, the schedule and what is
found in it, without names of users, machines and folders."""

from __future__ import annotations

import csv
import getpass
import io
import json
import locale
import os
import platform
import re
import socket
import sys
import tempfile
import traceback
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from importlib import metadata
from pathlib import Path

import FreeCAD

from BendTorsionWB import __version__
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.document_export import source_records
from BendTorsionWB.exchange import report
from BendTorsionWB.exchange.csv_folder import csv_bytes, read_folder
from BendTorsionWB.exchange.schedule_headings import sheet_name
from BendTorsionWB.exchange.whole_file import write_whole
from BendTorsionWB.exchange.workbook_file import open_workbook
from BendTorsionWB.round_trip import write_document_back

PREFERENCES = "User parameter:BaseApp/Preferences/Mod/BendTorsion"
LIBRARIES = ("numpy", "scipy", "ezdxf", "openpyxl", "rhino3dm", "distributed")
_SHORTEST_NAME = 3
# A path from a root, a drive, a share or a home, down to its last part.
_PATH = re.compile(
    r"(?:file:/{2,3}|(?<![\w.:/\\])(?:[A-Za-z]:[\\/]|\\\\|~?/))(?:[^\\/\n\"'<>|]*[\\/])*"
    r"(?=[^\\/\s\"'<>|]+[\s\"'<>|,;:)]|[^\\/\s\"'<>|]+$)",
    re.MULTILINE,
)
_MAIL = re.compile(r"[\w.+%-]+@[\w-]+(?:\.[\w-]+)+")
_ABOUT = """What BendTorsion collected for a report, all of it text to read before it is sent:
versions.json     programs and libraries
preferences.json  BendTorsion's preferences in FreeCAD
findings.txt      what is found in the schedule or document
schedule/         its tables, one file each
Folders, user, machine, the author and e-mail addresses are left out; names of members, projects
and marks are as given.
"""


def write_bundle(path: str | os.PathLike, source: str | os.PathLike = "") -> tuple[str, ...]:
    """Write the bundle (.zip); returns the names of its files. source: a schedule or a document.

    A source that cannot be read is no fault here: what is wrong with it is in findings.txt.
    Raises BendTorsionError when `path` cannot be written.
    """
    texts = {
        "about.txt": _ABOUT,
        "versions.json": _json(versions()),
        "preferences.json": _json(preferences()),
    }
    if source:
        texts["findings.txt"] = _findings(Path(source))
        texts |= {f"schedule/{name}.csv": text for name, text in _tables(Path(source)).items()}
    persons = {str(preferences().get("Author", "")), *_authors(texts)}
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in texts.items():
            private = without_persons(without_places(text), persons)
            archive.writestr(zipfile.ZipInfo(name), private.encode("utf-8"))
    write_whole(Path(path), stream.getvalue())
    return tuple(texts)


def versions() -> dict[str, str]:
    """Programs, libraries and system, by name."""
    found = {
        "BendTorsion": __version__,
        "FreeCAD": " ".join(FreeCAD.Version()[:4]),
        "Python": sys.version.split()[0],
        "system": f"{platform.system()} {platform.release()} {platform.machine()}",
        "processors": str(os.cpu_count()),
        "language": ".".join(part for part in locale.getlocale() if part) or "none",
    }
    try:
        import Part

        found["Open CASCADE"] = Part.OCC_VERSION
    except ImportError:
        found["Open CASCADE"] = "not there"
    for name in LIBRARIES:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            found[name] = "not there"
    return found


def preferences() -> dict[str, object]:
    """BendTorsion's own preferences that are set in FreeCAD."""
    contents = FreeCAD.ParamGet(PREFERENCES).GetContents() or []
    return {name: value for _, name, value in sorted(contents, key=lambda item: item[1])}


def without_places(text: str) -> str:
    """A text with paths cut to their last part, and without the names of user and machine."""
    text = _PATH.sub("", text)
    for name, instead in ((_user(), "user"), (socket.gethostname(), "machine")):
        if len(name) >= _SHORTEST_NAME:
            text = re.sub(rf"(?<!\w){re.escape(name)}(?!\w)", instead, text)
    return text


def without_persons(text: str, authors: Iterable[str] = ()) -> str:
    """A text without e-mail addresses and without the names of those who drew the sheets."""
    text = _MAIL.sub("e-mail", text)
    for name in authors:
        # One letter would be that of a face.
        if len(name) > 1:
            text = re.sub(rf"(?<!\w){re.escape(name)}(?!\w)", "author", text)
    return text


def _authors(texts: Mapping[str, str]) -> Iterator[str]:
    """Who drew the sheets, by the tables of settings among these files."""
    for name, text in texts.items():
        folder, _, table = name.removesuffix(".csv").partition("/")
        if folder == "schedule" and sheet_name(table) == "Settings":
            for key, value, *_ in filter(lambda row: len(row) > 1, csv.reader(io.StringIO(text))):
                if key.strip().lower() == "author":
                    yield value.strip()


def _user() -> str:
    try:
        return getpass.getuser()
    except (KeyError, OSError, ImportError):
        return ""


def _json(values: Mapping) -> str:
    return json.dumps(values, indent=2, ensure_ascii=False, sort_keys=True) + "\n"


def _findings(source: Path) -> str:
    """What building the source finds, a line each; where a fault of the program arose."""
    try:
        given = source_records(source)
    except BendTorsionError as problem:
        return "\n".join(finding.line() for finding in problem.findings) + "\n"
    except Exception:  # noqa: BLE001 - faults of the program are what the bundle is for
        return traceback.format_exc()
    records = tuple(given.records.values())
    findings = report.all_findings(records, given.findings)
    lines = [finding.line() for finding in findings]
    return "\n".join([*lines, *report.summary_lines(records, findings)]) + "\n"


def _tables(source: Path) -> dict[str, str]:
    """The source's sheets as CSV; an empty table says why there is none."""
    try:
        if source.is_dir():
            book = read_folder(source)
        elif source.suffix.lower() == ".fcstd":
            with tempfile.TemporaryDirectory() as folder:
                write_document_back(source, Path(folder) / "schedule")
                book = read_folder(Path(folder) / "schedule")
        else:
            book = open_workbook(source)[0]
    except BendTorsionError:
        return {}
    except Exception:  # noqa: BLE001 - faults of the program are what the bundle is for
        return {"unreadable": traceback.format_exc()}
    return {
        sheet.title: csv_bytes(list(sheet.iter_rows(values_only=True))).decode("utf-8-sig")
        for sheet in book.worksheets
    }
