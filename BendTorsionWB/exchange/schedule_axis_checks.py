# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks between the rows of Axes, Frames and Presets."""

from __future__ import annotations

from collections import defaultdict


def check_frames(frames, axes, faults: list) -> None:
    """Frames: an angle or a direction per row, directions for frame given only, places rising
    within an axis and of one kind; frame given has rows."""
    frame_of = {axis["axis"]: axis["frame"] for axis in axes if axis["axis"] is not None}
    by_axis = defaultdict(list)
    for record in frames:
        by_axis[record["axis"]].append(record)
        parts = [record[key] for key in "xyz"]
        if record.bad & {"angle", "x", "y", "z"}:
            continue
        turned, directed = record["angle"] is not None, any(part is not None for part in parts)
        if turned == directed:
            mend = "fill in angle, or x, y and z"
            message = "a row gives either an angle or a direction"
            _report(faults, record, "angle", "frame-row", message, mend)
        elif directed and (None in parts or not any(parts)):
            message = "a direction needs x, y and z, not all 0"
            _report(faults, record, "x", "frame-row", message, "fill in x, y and z")
        elif directed and frame_of.get(record["axis"], "given") != "given":
            message = "directions hold for frame given only"
            mend = "set frame given on sheet Axes, or write an angle"
            _report(faults, record, "x", "frame-row", message, mend)
    for name, rows in by_axis.items():
        kinds = {record["angle"] is None for record in rows}
        if frame_of.get(name) == "given" and len(kinds) == 2:
            message = f"rows of axis {name} mix angles and directions"
            _report(faults, rows[-1], "angle", "frame-row", message, "write one or the other")
    _places(by_axis, "Frames", faults)
    for axis in axes:
        if axis["frame"] == "given" and axis["axis"] is not None and not by_axis[axis["axis"]]:
            message = f"frame given of axis {axis['axis']} has no rows"
            mend = "add angles or directions to sheet Frames"
            _report(faults, axis, "frame", "frame-table-empty", message, mend)


def check_presets(presets, faults: list) -> None:
    """Presets: places rising within an axis and of one kind."""
    by_axis = defaultdict(list)
    for record in presets:
        by_axis[record["axis"]].append(record)
    _places(by_axis, "Presets", faults)


def _places(by_axis, sheet, faults):
    for name, rows in by_axis.items():
        rows = [row for row in rows if row["s"] is not None]
        for before, row in zip(rows[:-1], rows[1:]):
            if row["s"].is_ratio != before["s"].is_ratio:
                message = f"{sheet} of axis {name} mix mm and %"
                _report(faults, row, "s", "places-mixed", message, "write mm only, or % only")
                break
            if row["s"].value <= before["s"].value:
                message = f"{sheet} of axis {name} do not rise"
                mend = f"write a place beyond row {before.place.row}'s {before.given['s']}"
                _report(faults, row, "s", "places-not-rising", message, mend)


def _report(faults, record, column, code, message, mend):
    faults.append((record.place, record.error(column, code, message, mend)))
