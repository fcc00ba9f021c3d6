# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the rows of a schedule must be to each other: names that exist, order, sizes that fit."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
from scipy.spatial import cKDTree

from BendTorsionWB.exchange.file_name import same_file
from BendTorsionWB.exchange.report import PROJECT_SHEETS, sheet_name
from BendTorsionWB.exchange.schedule_axis_checks import check_frames, check_presets
from BendTorsionWB.exchange.schedule_cells import did_you_mean
from BendTorsionWB.exchange.schedule_columns import (
    CENTRE_PARAMETERS,
    FIRST_SEGMENT_COLUMNS,
    SETTINGS,
    SURFACE_PARAMETERS,
)
from BendTorsionWB.exchange.schedule_end_cuts import check_end_cuts
from BendTorsionWB.exchange.schedule_nodes import check_nodes
from BendTorsionWB.exchange.schedule_patterns import check_split
from BendTorsionWB.exchange.schedule_preps import check_preps
from BendTorsionWB.exchange.schedule_sections import check_faces, check_sections
from BendTorsionWB.exchange.schedule_workbook import Record, parse_cell

COINCIDENT_POINTS = 1e-3
"""mm: points of one axis closer than this are the same point written twice."""
BUILT_IN_MATERIALS = ("S355",)

# Keys that make a row unique, by sheet.
_KEYS = {
    "Settings": ("key",),
    "Materials": ("material",),
    "Surfaces": ("surface",),
    "Points": ("axis", "no"),
    "Axes": ("axis",),
    "Sections": ("section",),
    "Splits": ("member", "face"),
    "Pieces": ("member", "piece"),
    "Preps": ("prep",),
    "Status": ("plate",),
}
# Names that must be a row of another sheet: (sheet, column, the other sheet, its column).
_REFERENCES = (
    ("Points", "axis", "Axes", "axis"),
    ("Frames", "axis", "Axes", "axis"),
    ("Presets", "axis", "Axes", "axis"),
    ("Axes", "surface", "Surfaces", "surface"),
    ("Sections", "material", "Materials", "material"),
    ("Strips", "section", "Sections", "section"),
    ("Members", "axis", "Axes", "axis"),
    ("Members", "section", "Sections", "section"),
    ("Splits", "member", "Members", "member"),
    ("Diaphragms", "member", "Members", "member"),
    ("Diaphragms", "material", "Materials", "material"),
    ("Openings", "member", "Members", "member"),
    ("Marks", "member", "Members", "member"),
    ("Pieces", "member", "Members", "member"),
    ("Edges", "member", "Members", "member"),
    ("Nodes", "through", "Members", "member"),
    ("Nodes", "other", "Members", "member"),
)


def check(records: dict[str, list[Record] | None], faults: list) -> dict[str, object]:
    """Appends (place, finding) of everything wrong between the rows; returns the settings by key.

    Cells already found bad, and sheets that are absent where they must not be, are passed over:
    one error gives one finding.
    """
    settings = _settings(records["Settings"] or [], faults)
    for sheet, keys in _KEYS.items():
        _duplicates(records[sheet] or [], keys, faults)
    for sheet, column, other, key in _REFERENCES:
        _references(records, sheet, column, other, key, faults)
    _default_material(records, faults)
    check_preps(records, faults)
    for record in records["Surfaces"] or []:
        _surface(record, faults)
    if records["Points"] is not None and records["Axes"]:
        _points(records["Points"], records["Axes"], faults)
    check_frames(records["Frames"] or [], records["Axes"] or [], faults)
    check_presets(records["Presets"] or [], faults)
    sections = check_sections(records["Sections"] or [], records["Strips"] or [], faults)
    # Whether an axis may be a ring; that of a file is known when it is read.
    axes = {
        record["axis"]: record["closed"] or record["source"] is not None
        for record in records["Axes"] or []
    }
    _members(records["Members"] or [], sections, axes, faults)
    for sheet in ("Splits", "Openings", "Marks"):
        check_faces(records[sheet] or [], records["Members"] or [], sections, faults)
    for record in records["Splits"] or []:
        check_split(record, lambda *problem: _report(faults, *problem))
    check_nodes(records["Nodes"] or [], faults)
    check_end_cuts(
        records["Members"] or [],
        records["Surfaces"] or [],
        lambda *problem: _report(faults, *problem),
    )
    return settings


def _report(faults, record: Record, column, code, message, mend, **fields):
    faults.append((record.place, record.error(column, code, message, mend, **fields)))


def _settings(rows, faults) -> dict[str, object]:
    settings = {key: setting.default for key, setting in SETTINGS.items()}
    for record in rows:
        key = record["key"]
        if key is None:
            continue
        if key not in SETTINGS:
            near = did_you_mean(key, SETTINGS)
            mend = f"did you mean {near}?" if near else f"known keys: {', '.join(SETTINGS)}"
            _report(faults, record, "key", "unknown-name", "unknown setting", mend)
        elif record["value"] is not None:
            value, fault = parse_cell(record.place, SETTINGS[key], record["value"])
            settings[key] = value
            if fault is not None:
                message = f"{key}: {fault.message}"
                fields = {"value": fault.value, "limit": fault.limit, "unit": fault.unit}
                _report(faults, record, "value", fault.code, message, fault.mend, **fields)
    return settings


def _duplicates(rows, keys, faults):
    first: dict[tuple, Record] = {}
    for record in rows:
        name = tuple(record[key] for key in keys)
        if None in name:
            continue
        if name in first:
            what = " ".join(str(part) for part in name)
            row = first[name].place.row
            message = f"{' and '.join(keys)} {what} is already in row {row}"
            _report(faults, record, keys[-1], "duplicate", message, "delete or rename one of them")
        else:
            first[name] = record


def _references(records, sheet, column, other, key, faults):
    # A key cell that could not be read may be the very name looked for.
    if records[other] is None or any(key in record.bad for record in records[other]):
        return
    known = {record[key] for record in records[other]}
    if other == "Materials":
        known.update(BUILT_IN_MATERIALS)
    for record in records[sheet] or []:
        name = record[column]
        # Further segments repeat the axis of segment 1 or nothing.
        if sheet == "Members" and column == "axis" and record["segment"] != 1:
            continue
        if name is not None and name not in known:
            near = did_you_mean(name, known)
            mend = f"did you mean {near}? Otherwise add" if near else "correct it or add"
            message = f"unknown {key}: sheet {other} has no such row"
            _report(faults, record, column, "unknown-name", message, f"{mend} it to sheet {other}")


def _default_material(records, faults):
    if records["Materials"] is None:
        return
    known = {record["material"] for record in records["Materials"]} | {*BUILT_IN_MATERIALS}
    for record in records["Settings"] or []:
        is_name = record["key"] == "default_material" and record["value"] is not None
        if is_name and str(record["value"]).strip() not in known:
            message = "unknown material: sheet Materials has no such row"
            mend = "correct it or add it to sheet Materials"
            _report(faults, record, "value", "unknown-name", message, mend)


def _surface(record, faults):
    kind, given = record["kind"], record["parameters"]
    if kind is None or given is None or "file" in record.bad:
        return
    if kind == "file":
        _file_surface(record, given, faults)
        return
    if record["file"] is not None:
        message = f"a {kind} is described by its parameters, not by a file"
        _report(faults, record, "file", "file-not-used", message, "empty the cell, or kind file")
    needed = SURFACE_PARAMETERS[kind]
    example = " ".join(f"{key}=..." for key in needed) or "nothing, or x= y= z="

    def report(code, message, **fields):
        mend = f"{kind} takes {example}, and x= y= z= for its place"
        _report(faults, record, "parameters", code, message, mend, **fields)

    for key in given:
        if key not in needed and key not in CENTRE_PARAMETERS:
            report("bad-parameters", f"{kind} has no parameter {key}")
    for key in needed:
        if key not in given:
            report("bad-parameters", f"{kind} lacks the parameter {key}")
        elif given[key] <= 0.0:
            fields = {"limit": "above 0", "value": f"{key}={given[key]:g}"}
            report("out-of-range", f"parameter {key} is not positive", **fields)
    if kind == "cone" and given.get("angle", 0.0) >= 90.0:
        fields = {"value": given["angle"], "limit": "below 90", "unit": "degrees"}
        report("out-of-range", "the half angle is not below 90 degrees", **fields)
    if kind == "torus" and 0.0 < given.get("R", 0.0) <= given.get("r", 0.0):
        fields = {"value": given["r"], "limit": given["R"], "unit": "mm"}
        report("out-of-range", "r is not below R: the torus would cut itself", **fields)


def _file_surface(record, given, faults):
    if record["file"] is None:
        mend = "write a STEP, IGES or BREP file, relative to the schedule"
        _report(faults, record, "file", "value-missing", "kind file needs a file", mend)
    if given:
        message = "a surface from a file stands where the file puts it: no parameters"
        _report(faults, record, "parameters", "bad-parameters", message, "empty the cell")


def _points(points, axes, faults):
    by_axis = defaultdict(list)
    for record in points:
        by_axis[record["axis"]].append(record)
    # A row whose axis cannot be read may belong to any axis.
    count_is_known = not by_axis[None]
    for axis in axes:
        rows = by_axis[axis["axis"]]
        if axis["axis"] is None or "source" in axis.bad:
            continue
        if axis["source"] is not None:
            if rows:
                message = f"axis {axis['axis']} has a source and points"
                mend = "empty source, or delete its rows on sheet Points"
                _report(faults, axis, "source", "source-and-points", message, mend)
            continue
        least = 3 if axis["closed"] else 2
        if count_is_known and len(rows) < least:
            words = "three" if least == 3 else "two"
            message = f"axis {axis['axis']} has fewer than {words} points"
            mend = "add its points to sheet Points"
            fields = {"value": len(rows), "limit": f"at least {least}", "unit": "points"}
            _report(faults, axis, "axis", "too-few-points", message, mend, **fields)
    rings = {axis["axis"] for axis in axes if axis["closed"]}
    for name, rows in by_axis.items():
        whole = [row for row in rows if not row.bad & {"x", "y", "z"}]
        if name is None or len(whole) < 2:
            continue
        places = np.array([[row["x"], row["y"], row["z"]] for row in whole])
        ends = {min(whole, key=_number).place.row, max(whole, key=_number).place.row}
        for first, second in sorted(cKDTree(places).query_pairs(COINCIDENT_POINTS)):
            record, other = whole[second], whole[first]
            if name in rings and {record.place.row, other.place.row} == ends and len(whole) > 3:
                continue
            message = f"the point lies on point {other['no']} in row {other.place.row}"
            mend = "delete one of the two or correct its coordinates"
            fields = {"limit": f"{COINCIDENT_POINTS:g} mm apart"}
            fields["value"] = ", ".join(f"{figure:g}" for figure in places[second])
            _report(faults, record, "x", "coincident-points", message, mend, **fields)


def _number(record) -> int:
    return record["no"] or 0


def _members(rows, sections, axes, faults):
    type_of = {name: getattr(kind, "type", kind) for name, kind in sections.items()}
    members = defaultdict(list)
    for record in rows:
        if record["member"] is not None:
            members[record["member"]].append(record)
    spelling: dict[str, str] = {}
    of_project = {same_file(name) for name in PROJECT_SHEETS}
    for name, segments in members.items():
        other = spelling.setdefault(same_file(name), name)
        if other != name:
            message = f"member {name} differs from {other} by capitals or the code of letters only"
            mend = "rename one: their files would overwrite each other on some systems"
            _report(faults, segments[0], "member", "duplicate", message, mend)
        if same_file(sheet_name(name)) in of_project:
            message = f"{sheet_name(name)} is a file of the whole project"
            _report(faults, segments[0], "member", "file-name-twice", message, "rename the member")
        _segments(name, segments, axes, faults)
        _types(name, segments, type_of, faults)


def _segments(name, segments, axes, faults):
    seen: dict[int, Record] = {}
    last_cut: dict[bool, object] = {}
    in_order = True
    for wanted, record in enumerate(segments, 1):
        number = record["segment"]
        if number in seen and number is not None:
            first, again = seen[number].place.row, record.place.row
            message = (
                f"segment {number} of {name} is already in row {first}: two members share the "
                f"name, or the segment is given twice, in rows {first} and {again}"
            )
            mend = "number them 1, 2, 3 in order"
            if number == 1:
                mend += ", or give a second member another name"
            _report(faults, record, "segment", "duplicate", message, mend)
            in_order = False
            if number == 1:
                # A second member of the name: the rest of it says nothing of this one's segments.
                break
        elif number is not None and number != wanted and in_order:
            message = f"segments of {name} are not numbered 1, 2, 3 in order"
            mend = f"write {wanted}"
            _report(faults, record, "segment", "segment-order", message, mend, limit=wanted)
            in_order = False
        seen.setdefault(number, record)
        # Whatever its number says, the first row is judged as the first segment.
        if wanted == 1:
            _first_segment(name, record, axes, faults)
        else:
            _later_segment(name, record, segments[0]["axis"], axes, faults)
        _alignment(record, faults)
        cut = record["cut"]
        if cut is not None and wanted != 1:
            before = last_cut.get(cut.is_ratio)
            if before is not None and cut.value <= before["cut"].value and in_order:
                message = f"cuts of {name} do not rise"
                mend = f"write a cut beyond row {before.place.row}'s {before.given['cut']}"
                fields = {"limit": f"above {before.given['cut']}"}
                _report(faults, record, "cut", "cut-not-rising", message, mend, **fields)
            last_cut[cut.is_ratio] = record


def _first_segment(name, record, axes, faults):
    if record["axis"] is None and "axis" not in record.bad:
        message = f"member {name} has no axis"
        _report(faults, record, "axis", "value-missing", message, "fill in axis on segment 1")
    if record["cut"] is not None and record["axis"] in axes and not axes[record["axis"]]:
        message = f"segment 1 of {name} starts at the member's start and has no cut"
        mend = "empty the cell; the cut belongs on the row of segment 2, or the axis is closed"
        _report(faults, record, "cut", "cut-on-first-segment", message, mend)
    if record["align_to"] == "previous":
        message = f"segment 1 of {name} has no previous segment"
        _report(faults, record, "align_to", "nothing-previous", message, "write axis")


def _later_segment(name, record, axis, axes, faults):
    number = record.given.get("segment")
    if record["cut"] is None and "cut" not in record.bad:
        message = f"segment {number} of {name} has no cut"
        mend = "write where it starts: mm from the member's start, or a ratio such as 35%"
        _report(faults, record, "cut", "value-missing", message, mend)
    # An unknown axis of segment 1 is reported there.
    if record["axis"] is not None and axis in axes and record["axis"] != axis:
        message = f"segment {number} of {name} has another axis than segment 1"
        mend = f"write {axis}, or empty the cell"
        _report(faults, record, "axis", "axis-differs", message, mend, limit=axis)
    for column in FIRST_SEGMENT_COLUMNS:
        if column in record.given and column not in record.bad:
            message = f"{column} holds for the whole member {name}"
            mend = "empty the cell; write it on segment 1"
            _report(faults, record, column, "first-segment-only", message, mend)


def _alignment(record, faults):
    held = record["align"] or "top"
    if record["align_to"] == "surface" and not ("top" in held or "bottom" in held):
        message = f"a surface cannot hold alignment {held}: only the top or bottom face can"
        mend = "write axis, or align top or bottom, with left or right if need be"
        _report(faults, record, "align_to", "alignment", message, mend)


def _types(name, segments, type_of, faults):
    first = None
    for record in segments:
        kind = type_of.get(record["section"])
        if kind is None:
            continue
        if first is None:
            first = record
            continue
        wanted = type_of[first["section"]]
        if kind != wanted:
            message = f"member {name} changes from type {wanted} to {kind}"
            mend = f"use a section of type {wanted}, or two members"
            _report(faults, record, "section", "type-change", message, mend)
