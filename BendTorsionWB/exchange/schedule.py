# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reading a schedule: read_schedule(path) gives its frozen rows or all its errors."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.part_tables import PART_COLUMNS, material_text
from BendTorsionWB.core.welds.preps import prep_text
from BendTorsionWB.exchange.kept_rows import kept_rows
from BendTorsionWB.exchange.schedule_cells import Joints
from BendTorsionWB.exchange.schedule_checks import check
from BendTorsionWB.exchange.schedule_columns import SHEETS
from BendTorsionWB.exchange.schedule_nodes import NODE_COLUMNS
from BendTorsionWB.exchange.schedule_patterns import pattern_input
from BendTorsionWB.exchange.schedule_preps import prep_of_row
from BendTorsionWB.exchange.schedule_rows import (
    AxisRow,
    FrameRow,
    MaterialRow,
    MemberRow,
    NodeRow,
    PartRow,
    PointRow,
    PresetRow,
    Schedule,
    SectionRow,
    SegmentRow,
    Settings,
    SplitRow,
    StatusRow,
    SurfaceRow,
)
from BendTorsionWB.exchange.schedule_sections import section_values, strips_of
from BendTorsionWB.exchange.schedule_workbook import Place, Record, read_records

_BUILT_IN = Place("built in", "", None)


def read_schedule(path) -> Schedule:
    """The schedule workbook at path.

    Angles become radians, lengths stay mm, empty cells take their defaults. Raises
    BendTorsionError with one finding per error, in the order of sheets and rows.
    """
    records, faults = read_records(path)
    settings = check(records, faults)
    if faults:
        order = {sheet: index for index, sheet in enumerate(SHEETS)}
        faults.sort(key=lambda fault: (order.get(fault[0].sheet, len(order)), fault[0].row or 0))
        raise BendTorsionError(finding for _, finding in faults)
    return replace(_schedule(records, settings), folder=str(Path(path).parent))


def _schedule(records: dict[str, list[Record] | None], values: dict) -> Schedule:
    file = records["Members"][0].place.file
    settings = Settings(Place(file, "Settings"), **values)
    materials = [
        MaterialRow(row.place, row["material"], row["density"] * 1e-9, row["E"], row["fy"])
        for row in records["Materials"] or []
    ]
    if all(material.name != "S355" for material in materials):
        materials.append(MaterialRow(_BUILT_IN, "S355", 7.85e-6, 206000.0, 355.0))
    strips = strips_of(records["Strips"] or [])
    return Schedule(
        file,
        settings,
        tuple(materials),
        tuple(_surface(row) for row in records["Surfaces"]),
        _axes(records),
        tuple(
            _section(row, strips.get(row["section"], ()), settings) for row in records["Sections"]
        ),
        _members(records["Members"], settings),
        tuple(
            SplitRow(
                row.place,
                row["member"],
                row["face"],
                row["joints"] or Joints((), "ratio"),
                row["lanes"],
            )
            for row in records["Splits"] or []
        ),
        parts=_parts(records, materials),
        nodes=tuple(
            NodeRow(row.place, *(row[column] for column in NODE_COLUMNS))
            for row in records["Nodes"] or []
        ),
        statuses=tuple(
            StatusRow(row.place, row["plate"], row["status"]) for row in records["Status"] or []
        ),
        kept=kept_rows(records, vars(settings)),
    )


def _parts(records, materials) -> tuple[PartRow, ...]:
    grades = {m.name: material_text(m.name, m.density, m.E, m.fy) for m in materials}
    preps = {row["prep"]: prep_text(prep_of_row(row)) for row in records["Preps"] or []}
    rows = []
    for sheet, columns in PART_COLUMNS.items():
        for row in records[sheet] or []:
            cells = {column: row[column] for column in columns}
            if cells.get("material") is not None:
                cells["material"] = grades[cells["material"]]
            if cells.get("prep") in preps:
                cells["prep"] = preps[cells["prep"]]
            rows.append(PartRow(row.place, sheet, row["member"], tuple(cells.items())))
    return tuple(rows)


def _surface(row: Record) -> SurfaceRow:
    given = dict(row["parameters"])
    centre = tuple(given.pop(key, 0.0) for key in ("x", "y", "z"))
    if "angle" in given:
        given["angle"] = math.radians(given["angle"])
    sizes = tuple(given.items())
    return SurfaceRow(
        row.place,
        row["surface"],
        row["kind"],
        sizes,
        centre,
        row["offset"],
        row["flip"],
        row["file"],
    )


def _axes(records) -> tuple[AxisRow, ...]:
    points: dict[str, list[PointRow]] = {}
    for row in records["Points"]:
        point = PointRow(row.place, row["axis"], row["no"], row["x"], row["y"], row["z"])
        points.setdefault(point.axis, []).append(point)
    frames: dict[str, list[FrameRow]] = {}
    for row in records["Frames"] or []:
        z = None if row["x"] is None else (row["x"], row["y"], row["z"])
        frames.setdefault(row["axis"], []).append(FrameRow(row.place, row["s"], row["angle"], z))
    presets: dict[str, list[PresetRow]] = {}
    for row in records["Presets"] or []:
        move = row["dx"], row["dy"], row["dz"]
        presets.setdefault(row["axis"], []).append(PresetRow(row.place, row["s"], move))
    return tuple(
        AxisRow(
            row.place,
            row["axis"],
            row["surface"],
            row["frame"],
            row["fit"],
            row["max_spacing"],
            tuple(sorted(points.get(row["axis"], []), key=lambda point: point.number)),
            row["source"],
            row["closed"],
            row["start_z"],
            row["end_z"],
            row["start_dz"],
            row["end_dz"],
            row["start_extension"],
            row["end_extension"],
            tuple(frames.get(row["axis"], [])),
            tuple(presets.get(row["axis"], [])),
        )
        for row in records["Axes"]
    )


def _section(row: Record, strips, settings: Settings) -> SectionRow:
    material = row["material"] or settings.default_material
    return SectionRow(row.place, row["section"], material, **section_values(row, strips))


def _members(rows, settings: Settings) -> tuple[MemberRow, ...]:
    by_name: dict[str, list[Record]] = {}
    for row in rows:
        by_name.setdefault(row["member"], []).append(row)
    return tuple(
        MemberRow(
            first.place,
            name,
            first["axis"],
            tuple(_segment(row, settings) for row in [first, *others]),
            first["member_offset_y"],
            first["member_offset_z"],
            first["roll"],
            first["rank"],
            pattern_input(first, settings),
            first["start_cut"],
            first["end_cut"],
        )
        for name, (first, *others) in by_name.items()
    )


def _segment(row: Record, settings: Settings) -> SegmentRow:
    slope = settings.default_slope if row["slope"] is None else row["slope"]
    return SegmentRow(
        row.place,
        row["member"],
        row["segment"],
        row["section"],
        row["cut"],
        slope,
        row["align"],
        row["align_to"],
        row["offset_y"],
        row["offset_z"],
        row["stagger"],
        row["transition"],
    )
