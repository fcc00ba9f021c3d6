# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rows of a schedule that none of its members needs (sections, materials, surfaces, axes), its
defaults for empty cells, and what the shop has done with plates: kept in a document as JSON, so
that they come back from it."""

from __future__ import annotations

import json
import os
import re
import zipfile
from collections.abc import Mapping
from pathlib import Path
from xml.sax.saxutils import escape

from BendTorsionWB.exchange.schedule_columns import SETTINGS
from BendTorsionWB.exchange.schedule_workbook import Record
from BendTorsionWB.exchange.timeless import timeless_document
from BendTorsionWB.exchange.whole_file import whole_file

KEY = "BendTorsion rows"
"""Of the entry in the document's metadata."""
_NAMED = {
    "Materials": "material",
    "Surfaces": "surface",
    "Axes": "axis",
    "Sections": "section",
    "Preps": "prep",
    "Status": "plate",
}
"""By sheet: the column with the names of its rows; each after those its rows refer to."""
_BELOW = {"Points": "axis", "Frames": "axis", "Presets": "axis", "Strips": "section"}
"""By sheet with rows below those of another: the column that names these."""
_NEEDS = {"Axes": ("surface", "Surfaces"), "Sections": ("material", "Materials")}
_BUILT_IN = {"Materials": {"S355"}, "Surfaces": set()}
_DEFAULTS = {"default_slope": (int, float), "default_material": (str,)}
"""Settings that no object has: cells left empty take them, and objects have what came of it."""
_ITEM = re.compile(rf'(<Item key="{KEY}" value=")([^"]*)')


def kept_rows(records: Mapping[str, list[Record] | None], defaults: Mapping[str, object]) -> str:
    """Those rows as JSON: by sheet, cells by column. defaults: settings by key, those for empty
    cells among them; rows that name files stay out, since files lie beside the schedule."""
    material = defaults["default_material"]
    members = records["Members"] or []
    cuts = [row[cell] for row in members for cell in ("start_cut", "end_cut") if row[cell]]
    axes = {row["axis"] for row in members if row["axis"]}
    sections = {row["section"] for row in members}
    used = {
        "Axes": axes,
        "Sections": sections,
        "Surfaces": {row["surface"] for row in records["Axes"] or [] if row["axis"] in axes}
        | {cut.surface for cut in cuts if cut.surface},
        "Materials": {
            row["material"] or material
            for row in records["Sections"] or []
            if row["section"] in sections
        },
        "Preps": {row["prep"] for row in records["Edges"] or []},
        "Status": set(),
    }
    kept: dict[str, list[dict]] = {}
    for key in _DEFAULTS:
        if defaults[key] != SETTINGS[key].default:
            kept.setdefault("Settings", []).append({"key": key, "value": defaults[key]})
    for sheet, name in _NAMED.items():
        for row in records[sheet] or []:
            if row[name] not in used[sheet] and not row.given.keys() & {"file", "source"}:
                usual = {"material": material} if sheet == "Sections" else {}
                kept.setdefault(sheet, []).append({**usual, **_cells(row)})
    for sheet, name in _BELOW.items():
        owners = {row[name] for own in kept.values() for row in own if name in row}
        owners -= used["Axes" if name == "axis" else "Sections"]
        rows = [_cells(row) for row in records[sheet] or [] if row[name] in owners]
        if rows:
            kept[sheet] = rows
    return json.dumps(kept, sort_keys=True)


def _cells(row: Record) -> dict:
    """The cells of a row as read where that is a number or a text, so that files that say the same
    keep the same; as given where it is more."""
    read = {column: row[column] for column in row.given}
    return {
        column: value
        if isinstance(value, (float, int, str)) and not isinstance(value, bool)
        else str(row.given[column])
        for column, value in read.items()
    }


def _kept_rows(text: str) -> dict[str, list[dict]]:
    """Kept rows by sheet; damaged ones are none."""
    try:
        return {str(sheet): [dict(row) for row in rows] for sheet, rows in json.loads(text).items()}
    except (ValueError, TypeError, AttributeError):
        return {}


def kept_settings(text: str) -> dict[str, object]:
    """The kept defaults by key."""
    given = [(row.get("key"), row.get("value")) for row in _kept_rows(text).get("Settings", ())]
    return {key: value for key, value in given if isinstance(value, _DEFAULTS.get(key, ()))}


def add_kept(cells: dict[str, list[dict]], text: str, names: Mapping[str, str]) -> None:
    """Add kept rows to the cells of a schedule, by sheet, where there is no row of the name and
    what they refer to is there; a default material that is not goes. names: of members that are
    called otherwise now, whose plates are too."""
    kept = _kept_rows(text)
    for row in kept.get("Status", ()):
        member, hyphen, rest = str(row.get("plate")).rpartition("-")
        if member in names:
            row["plate"] = f"{names[member]}{hyphen}{rest}"
    added: dict[str, set] = {}
    for sheet, name in _NAMED.items():
        present = {row.get(name) for row in cells.get(sheet, ())}
        need, table = _NEEDS.get(sheet, ("", ""))
        there = {row.get(need) for row in cells.get(table, ())} | _BUILT_IN.get(table, set())
        for row in kept.get(sheet, ()):
            if row.get(name) not in present and (not table or row.get(need) in there):
                cells.setdefault(sheet, []).append(row)
                added.setdefault(name, set()).add(row.get(name))
    for sheet, name in _BELOW.items():
        own = [row for row in kept.get(sheet, ()) if row.get(name) in added.get(name, ())]
        if own:
            cells.setdefault(sheet, []).extend(own)
    known = {row["material"] for row in cells.get("Materials", ())} | _BUILT_IN["Materials"]
    settings = cells.get("Settings", ())
    gone = [r for r in settings if r["key"] == "default_material" and r["value"] not in known]
    cells["Settings"] = [row for row in settings if row not in gone]


def has_kept(path: Path, text: str) -> bool:
    """Whether a saved document has these rows kept, or is one that keeps none."""
    return _kept_in(path) in (None, _in_file(text))


def bring_kept(path: Path, text: str) -> None:
    """Put kept rows into a saved document in place of those there are, the rest as it is. Raises
    BendTorsionError for a file that cannot be written."""
    words = _in_file(text).replace("\\", "\\\\")
    with whole_file(path) as part:
        with zipfile.ZipFile(path) as source, zipfile.ZipFile(part, "w") as target:
            for info in source.infolist():
                content = source.read(info)
                if info.filename == "Document.xml":
                    content = _ITEM.sub(rf"\g<1>{words}", content.decode(), 1).encode()
                target.writestr(info, content)
        timeless_document(Path(os.fspath(part)))


def _in_file(text: str) -> str:
    """A text as FreeCAD writes it into a document."""
    return escape(text, {'"': "&quot;", "'": "&apos;"})


def _kept_in(path: Path) -> str | None:
    """The entry of a saved document as it stands in the file; None where it has none."""
    with zipfile.ZipFile(path) as archive, archive.open("Document.xml") as stream:
        head = b""
        # It stands before the objects, which are many.
        for piece in iter(lambda: stream.read(1 << 16), b""):
            head += piece
            if b"<Objects" in piece:
                break
    found = _ITEM.search(head.decode("utf-8", "replace"))
    return found and found[2]
