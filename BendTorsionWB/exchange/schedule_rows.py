# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rows of a schedule, frozen, and the Schedule they make: what every sheet says."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.finding import Finding
from BendTorsionWB.core.patterns.laid_flat import PLAIN, PatternInput
from BendTorsionWB.core.sections.section_strips import StripRow
from BendTorsionWB.core.site import SiteDatum
from BendTorsionWB.exchange.schedule_cells import Cut, FilePart, Joints
from BendTorsionWB.exchange.schedule_end_cuts import EndCutCell
from BendTorsionWB.exchange.schedule_workbook import Place


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
    stock: str = ""
    layer_names: str = ""
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
    workbook lies, which names of files are relative to; kept: rows that no member needs, as
    `kept_rows` has them."""

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
    kept: str = field(default="", compare=False, repr=False)

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
