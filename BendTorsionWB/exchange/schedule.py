# SPDX-License-Identifier: LGPL-2.1-or-later
"""The schedule workbook as frozen rows: read_schedule(path) gives a Schedule or all its errors."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from BendTorsionWB.core.finding import BendTorsionError, Finding
from BendTorsionWB.core.laid_flat import PLAIN, PatternInput
from BendTorsionWB.core.part_tables import PART_COLUMNS, material_text
from BendTorsionWB.core.preps import Prep, prep_text
from BendTorsionWB.core.section_strips import StripRow
from BendTorsionWB.core.sheet_style import SheetStyle
from BendTorsionWB.core.site import SiteDatum
from BendTorsionWB.exchange.schedule_cells import Cut, FilePart, Joints
from BendTorsionWB.exchange.schedule_checks import check
from BendTorsionWB.exchange.schedule_columns import SHEETS
from BendTorsionWB.exchange.schedule_end_cuts import EndCutCell
from BendTorsionWB.exchange.schedule_nodes import NODE_COLUMNS
from BendTorsionWB.exchange.schedule_patterns import pattern_input
from BendTorsionWB.exchange.schedule_sections import section_values, strips_of
from BendTorsionWB.exchange.schedule_workbook import Place, Record, read_records

_BUILT_IN = Place("built in", "", None)


@dataclass(frozen=True)
class Row:
    """What every row knows: its place in the file, which is no part of its value."""

    place: Place = field(compare=False, repr=False)

    def where(self, column: str = "") -> str:
        """`concert_hall.xlsx, sheet Members, row 7, column cut`."""
        position = self.place.position(column)
        return f"{self.place.file}, {position}" if position else self.place.file

    def error(self, column: str, code: str, message: str, mend: str = "", **fields) -> Finding:
        """An error finding at a cell of this row (object: the file; position: the cell)."""
        return self.place.error(column, code, message, mend, **fields)


@dataclass(frozen=True)
class Settings(Row):
    """Settings of the whole schedule; mm. docs/schedule.md says what each does."""

    project: str
    author: str
    station_spacing: float
    default_slope: float
    transition_length: str
    axis_tolerance: float
    default_material: str
    rule_pack: str
    bed_face: str = "auto"
    bed_plane: str = "fit"
    bed_spacing: float = 2000.0
    bed_height: float = 700.0
    pin_pitch: float | None = None
    lowest_pin: float = 250.0
    template_pitch: float = 3500.0
    template_clearance: float = 0.0
    site_x: float = 0.0
    site_y: float = 0.0
    site_z: float = 0.0
    site_rotation: float = 0.0
    site_unit: str = "mm"
    sheet_format: str = "A3"
    sheet_standard: str = "ISO"
    sheet_language: str = "en"
    sheet_unit: str = "mm"

    @property
    def site(self) -> SiteDatum:
        """Where the model lies on the site."""
        return SiteDatum(self.site_x, self.site_y, self.site_z, self.site_rotation, self.site_unit)

    @property
    def sheet_style(self) -> SheetStyle:
        """How the sheets are drawn."""
        return SheetStyle(
            self.project,
            self.author,
            self.sheet_format,
            self.sheet_standard,
            self.sheet_language,
            self.sheet_unit,
            self.site,
        )

    mode: str = "edges"
    flattened_surface: str = "mid"
    marking_face: str = "inside"
    shrinkage_along: float = 0.0
    shrinkage_across: float = 0.0
    joint_allowance: float = 0.0
    diaphragm_allowance: float = 0.0
    green_start: float = 0.0
    green_end: float = 0.0
    splice: str = "after forming"
    contour: str = "mid"


@dataclass(frozen=True)
class MaterialRow(Row):
    """density in kg/mm3; E and fy in MPa."""

    name: str
    density: float
    E: float
    fy: float


@dataclass(frozen=True)
class SurfaceRow(Row):
    """sizes: the kind's parameters, mm (cone `angle`: rad); centre, offset: mm; file: of kind
    `file`, else None."""

    name: str
    kind: str
    sizes: tuple[tuple[str, float], ...]
    centre: tuple[float, float, float]
    offset: float
    flip: bool
    file: FilePart | None


@dataclass(frozen=True)
class PointRow(Row):
    """A given point of an axis; mm."""

    axis: str
    number: int
    x: float
    y: float
    z: float


@dataclass(frozen=True)
class FrameRow(Row):
    """A direction at a place of an axis: angle in rad, or z the direction."""

    s: Cut
    angle: float | None
    z: tuple[float, float, float] | None


@dataclass(frozen=True)
class PresetRow(Row):
    """A displacement at a place of an axis; mm."""

    s: Cut
    move: tuple[float, float, float]


@dataclass(frozen=True)
class AxisRow(Row):
    """points in the order of their numbers, none with a source; max_spacing, start_z and end_z in
    mm or None; dz and extensions in mm."""

    name: str
    surface: str
    frame: str
    fit: str
    max_spacing: float | None
    points: tuple[PointRow, ...]
    source: FilePart | None
    closed: bool
    start_z: float | None
    end_z: float | None
    start_dz: float
    end_dz: float
    start_extension: float
    end_extension: float
    frames: tuple[FrameRow, ...]
    presets: tuple[PresetRow, ...]

    def coordinates(self) -> np.ndarray:
        """(n, 3) mm, in order."""
        points = [(point.x, point.y, point.z) for point in self.points]
        return np.array(points, float).reshape(-1, 3)


@dataclass(frozen=True)
class SectionRow(Row):
    """All mm, as `section_values` gives them: sizes of a catalogue section filled in, thicknesses
    resolved from t and the single columns; None or empty for what the type does not take."""

    name: str
    material: str
    type: str
    h: float | None
    b: float | None
    t_top: float | None
    t_bottom: float | None
    t_web: float | None
    gap1: float
    gap2: float
    b_bottom: float | None
    corner_joint: str
    corners: tuple[tuple[float, float], ...]
    thicknesses: tuple[float, ...]
    strips: tuple[StripRow, ...]


@dataclass(frozen=True)
class SegmentRow(Row):
    """One segment and the transition before it; cut is None on segment 1 of an open axis. Offsets
    in mm."""

    member: str
    number: int
    section: str
    cut: Cut | None
    slope: float
    align: str
    align_to: str
    offset_y: float
    offset_z: float
    stagger: str = "auto"
    transition: str = "linear"


@dataclass(frozen=True)
class MemberRow(Row):
    """A member and its segments in order; offsets in mm, roll in rad, rank kept for nodes;
    patterns: how its plates are laid flat; start_cut, end_cut: how its ends are cut."""

    name: str
    axis: str
    segments: tuple[SegmentRow, ...]
    offset_y: float
    offset_z: float
    roll: float
    rank: int | None
    patterns: PatternInput = PLAIN
    start_cut: EndCutCell | None = None
    end_cut: EndCutCell | None = None


@dataclass(frozen=True)
class SplitRow(Row):
    """The joints of one face of a member, and the seams of its lanes (None: one lane)."""

    member: str
    face: str
    joints: Joints
    lanes: Joints | None = None


@dataclass(frozen=True)
class PartRow(Row):
    """A diaphragm, an opening or a mark: its cells by column, as `core/part_tables` reads them."""

    sheet: str
    member: str
    cells: tuple[tuple[str, object], ...]


@dataclass(frozen=True)
class NodeRow(Row):
    """The meeting of two members: `through` runs through; lengths in mm, gap None for the
    rules'."""

    name: str | None
    through: str
    other: str
    s: Cut | None
    type: str
    gap: float | None
    stub_length: float
    diaphragms: str
    blend: bool


@dataclass(frozen=True)
class StatusRow(Row):
    """What the shop has done with a plate: cut, or its trimming or scrapping agreed to."""

    name: str
    status: str


@dataclass(frozen=True)
class Schedule:
    """A whole schedule, free of every error that can be told without geometry. folder: where the
    workbook lies, which names of files are relative to."""

    file: str
    settings: Settings
    materials: tuple[MaterialRow, ...]
    surfaces: tuple[SurfaceRow, ...]
    axes: tuple[AxisRow, ...]
    sections: tuple[SectionRow, ...]
    members: tuple[MemberRow, ...]
    splits: tuple[SplitRow, ...]
    folder: str = field(default="", compare=False, repr=False)
    parts: tuple[PartRow, ...] = ()
    nodes: tuple[NodeRow, ...] = ()
    statuses: tuple[StatusRow, ...] = ()

    def material(self, name: str) -> MaterialRow:
        """The material of this name; KeyError when there is none, as for the three below."""
        return _named(self.materials, name)

    def surface(self, name: str) -> SurfaceRow:
        return _named(self.surfaces, name)

    def axis(self, name: str) -> AxisRow:
        return _named(self.axes, name)

    def section(self, name: str) -> SectionRow:
        return _named(self.sections, name)

    def member(self, name: str) -> MemberRow:
        return _named(self.members, name)

    def splits_of(self, member: str) -> dict[str, SplitRow]:
        """The member's split rows by face; faces without a row have no entry."""
        return {split.face: split for split in self.splits if split.member == member}

    def parts_of(self, sheet: str, member: str) -> tuple[PartRow, ...]:
        """The member's rows of sheet Diaphragms, Openings, Marks or Pieces."""
        return tuple(p for p in self.parts if p.member == member and p.sheet == sheet)


def _named(rows, name):
    for row in rows:
        if row.name == name:
            return row
    raise KeyError(name)


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
    )


def _parts(records, materials) -> tuple[PartRow, ...]:
    grades = {m.name: material_text(m.name, m.density, m.E, m.fy) for m in materials}
    preps = {row["prep"]: prep_text(_prep(row)) for row in records["Preps"] or []}
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


def _prep(row: Record) -> Prep:
    angle = math.radians(row["angle"])
    sizes = (row[name] for name in ("land", "gap", "side", "backing"))
    return Prep(row["prep"], row["type"], angle, *sizes)


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
