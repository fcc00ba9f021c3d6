# SPDX-License-Identifier: LGPL-2.1-or-later
"""A schedule as jobs for the core, and the core's findings back at the cells they come from."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from ..core import part_tables, rules
from ..core.axes.axis_ends import AxisEnd
from ..core.axes.axis_input import AxisInput
from ..core.axes.axis_preset import Preset
from ..core.axes.axis_source import AxisSource
from ..core.axes.frames import FrameInput
from ..core.axes.frames_law import GivenDirection
from ..core.beds.bed_face import BedInput
from ..core.detailing import MemberInput, MemberJob, PlatesInput
from ..core.finding import BendTorsionError, Finding
from ..core.geometry.surface import Flipped, Offset, Surface, analytic_surface
from ..core.joints.lanes import Lanes
from ..core.joints.stock import stock_of
from ..core.members.zones import Segment
from ..core.plates.plates import Joints
from ..core.sections.section import Material, Section
from .schedule_end_cuts import core_cut
from .schedule_rows import AxisRow, MemberRow, Schedule, SegmentRow, Settings, SplitRow
from .schedule_sections import core_section

COLUMN_OF_CODE = {
    "cut-beyond-axis": "cut",
    "cut-order": "cut",
    "cut-on-first-segment": "cut",
    "chamfer-too-long": "cut",
    "stagger": "stagger",
    "stagger-without-change": "stagger",
    "thickness-joints-not-staggered": "stagger",
    "transitions-overlap": "cut",
    "transition-past-end": "cut",
    "transition-short": "slope",
    "slope": "slope",
    "alignment": "align",
    "alignment-to-surface": "align_to",
    "alignment-surface-border": "align_to",
    "type-change": "section",
    "bend-sharper-than-section": "section",
    "plate-folds-over": "section",
}
"""Column of the Members sheet a finding of the core is about."""

SPLIT_CODES = ("joints", "lanes", "plate-too-short", "stock-too-narrow", "joints-infeasible")
"""Codes of findings about a row of the Splits sheet."""

COLUMN_OF_AXIS_CODE = {
    "axis-along-normal": "surface",
    "axis-far-from-surface": "surface",
    "surface-border": "surface",
    "surface-crease": "surface",
    "surface-ambiguous": "surface",
    "axis-along-direction": "frame",
    "axis-end-closed": "closed",
    "axis-kink": "source",
}
"""Column of the Axes sheet a finding of the core is about."""


PARTS = {
    "Diaphragms": "diaphragms",
    "Openings": "openings",
    "Marks": "marks",
    "Pieces": "pieces",
    "Edges": "edges",
}
"""Field of PlatesInput the rows of a sheet go into."""

COLUMN_OF_PART_CODE = {
    "diaphragm-gap": "gap",
    "diaphragm-no-room": "gap",
    "diaphragm-thickness": "t",
    "diaphragm-snipe": "snipe",
    "manhole-ligament": "manhole",
    "diaphragm-closing": "closing_face",
    "diaphragm-slot": "closing_face",
    "diaphragm-outside": "s",
    "diaphragms-meet": "s",
    "end-plate-on-cut": "s",
    "piece-number": "piece",
    "pieces-overlap": "from",
    "prep-angle": "prep",
    "prep-land": "prep",
    "prep-backing": "prep",
    "prep-flat": "prep",
    "prep-corner": "prep",
    "bevel-steep": "prep",
    "fillet-angle": "prep",
    "fillet-leg": "prep",
    "fillet-ledge": "prep",
    "root-gap-too-wide": "prep",
    "root-gap-whole-seam": "prep",
    "root-gap-lanes": "prep",
    "edge-row-order": "from",
    "backing-clash": "snipe",
    "edge-row-unused": "seam",
    "root-gap-differs": "prep",
    "node-root-gap": "prep",
    "weld-access": "prep",
    "gap-too-wide": "prep",
    "section-gap": "prep",
    "plates-overlap": "prep",
    "pieces-leave-out": "from",
    "piece-beyond-member": "to",
    "piece-order": "to",
    "piece-end-face": "end_end",
    "piece-ends-differ": "start_end",
    "piece-end-at-member-end": "end_end",
    "piece-end-in-transition": "to",
    "delivery-piece-too-short": "to",
    "piece-gap": "gap",
    "piece-green": "green_end",
    "opening-face": "face",
    "opening-on-seam": "offset",
    "mark-face": "face",
    "mark-outside": "s",
}
"""Column of the sheets of parts a finding of the core is about."""

_PART = re.compile(r"(diaphragm|opening|mark|piece|edge) (\d+)")
"""A row of a sheet of parts, as the core names it."""


@dataclass(frozen=True)
class Files:
    """What the files of a schedule hold: surfaces by their name, sources by their axis's; and what
    was found about their units and sizes."""

    surfaces: Mapping[str, Surface] = field(default_factory=dict)
    sources: Mapping[str, AxisSource] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()


def surface_of(schedule: Schedule, name: str, files: Files = Files()) -> Surface:
    """The core surface of a Surfaces row; raises BendTorsionError at its cell."""
    row = schedule.surface(name)
    if row.kind == "file":
        surface = files.surfaces[name]
        surface = Flipped(surface) if row.flip else surface
        return Offset(surface, row.offset) if row.offset else surface
    try:
        return analytic_surface(
            row.kind, dict(row.sizes), row.centre, row.offset, row.flip, row.name
        )
    except BendTorsionError as problem:
        raise BendTorsionError(
            row.error(
                "offset" if f.code == "surface-offset" else "parameters",
                f.code,
                f.message,
                f.mend,
                value=f.value,
                limit=f.limit,
                unit=f.unit,
            )
            for f in problem.findings
        ) from problem


def section_of(schedule: Schedule, name: str) -> Section:
    """The core section of a Sections row."""
    row = schedule.section(name)
    grade = schedule.material(row.material)
    material = Material(grade.name, grade.density, grade.E, grade.fy)
    return core_section(row.name, vars(row), material)


def axis_input_of(row: AxisRow, tolerance: float, files: Files = Files()) -> AxisInput:
    """What the axis of a row is made from."""
    preset = None
    if row.presets:
        preset = Preset(
            np.array([item.s.value for item in row.presets]),
            np.array([item.move for item in row.presets]),
            "ratio" if row.presets[0].s.is_ratio else "length",
        )
    given = AxisInput(
        row.name,
        row.coordinates(),
        fit=row.fit,
        tolerance=tolerance,
        max_spacing=row.max_spacing,
        closed=row.closed,
        start=AxisEnd(row.start_z, row.start_dz, row.start_extension),
        end=AxisEnd(row.end_z, row.end_dz, row.end_extension),
        preset=preset,
    )
    return given if row.source is None else files.sources[row.name].into(given)


def frame_of(row: AxisRow) -> FrameInput:
    """The frame of an axis row: its rows of sheet Frames are the table of frame given, and an
    extra twist of every other frame."""
    table = tuple(
        GivenDirection(item.s.value, item.angle, item.z, item.s.is_ratio) for item in row.frames
    )
    if row.frame == "given":
        return FrameInput("given", given=table)
    return FrameInput(row.frame, twist=table)


def job_of(schedule: Schedule, row: MemberRow, files: Files = Files()) -> MemberJob:
    """The job of one member."""
    axis = schedule.axis(row.axis)
    settings = schedule.settings
    splits = schedule.splits_of(row.name)
    joints = {
        face: Joints(s.joints.values, s.joints.kind)
        for face, s in splits.items()
        if s.joints.values or s.joints.kind == "auto"
    }
    lanes = {face: Lanes(s.lanes.values, s.lanes.kind) for face, s in splits.items() if s.lanes}
    return MemberJob(
        surface_of(schedule, axis.surface, files),
        axis_input_of(axis, settings.axis_tolerance, files),
        MemberInput(
            row.name,
            tuple(_segment(schedule, segment) for segment in row.segments),
            row.offset_y,
            row.offset_z,
            row.roll,
            settings.transition_length,
            frame_of(axis),
            rules.thickness_rules(settings.rule_pack),
            *(
                core_cut(cell, lambda name: surface_of(schedule, name, files))
                for cell in (row.start_cut, row.end_cut)
            ),
        ),
        PlatesInput(
            joints,
            settings.station_spacing,
            rules.joint_rules(settings.rule_pack, stock_of(settings.stock)),
            rules.forming_rules(settings.rule_pack),
            lanes=lanes,
            welds=rules.weld_defaults(settings.rule_pack),
            **{
                name: tuple(
                    part_tables.READERS[sheet](dict(part.cells))
                    for part in schedule.parts_of(sheet, row.name)
                )
                for sheet, name in PARTS.items()
            },
        ),
        _bed(settings),
        row.patterns,
    )


def _bed(settings: Settings) -> BedInput:
    return BedInput(
        face=settings.bed_face,
        plane=settings.bed_plane,
        spacing=settings.bed_spacing,
        height=settings.bed_height,
        pin_pitch=settings.pin_pitch or 0.0,
        lowest_pin=settings.lowest_pin,
        template_pitch=settings.template_pitch,
        clearance=settings.template_clearance,
    )


def located(schedule: Schedule, row: MemberRow, finding: Finding) -> Finding:
    """A core finding about a member, at the cell of the schedule that causes it."""
    segment = re.match(r"segment (\d+)", finding.position)
    part = _PART.match(finding.position)
    if part:
        sheet = f"{part.group(1).capitalize()}s"
        source = schedule.parts_of(sheet, row.name)[int(part.group(2)) - 1]
        # Slots are openings, too.
        places = {"opening": "s", "diaphragm": "closing_face"}
        of_opening = finding.code.startswith("opening")
        default = places[part.group(1)] if of_opening else ""
        column = COLUMN_OF_PART_CODE.get(finding.code, default)
    elif finding.code.startswith("end-cut"):
        source = row.segments[0]
        column = f"{finding.position}_cut" if finding.position in ("start", "end") else ""
    elif finding.code == "surface-size":
        source, column = schedule.surface(schedule.axis(row.axis).surface), "parameters"
        column = "file" if source.kind == "file" else column
    elif finding.code.startswith(("axis", "surface", "frame", "preset")):
        source, column = _axis_cell(schedule.axis(row.axis), finding)
    elif finding.code in SPLIT_CODES:
        face = re.match(r"face (\w+)", finding.position)
        splits = schedule.splits_of(row.name)
        source = splits.get(face.group(1), row) if face else _first_auto(splits, row)
        column = "lanes" if finding.code == "lanes" else "joints"
        if source is row:
            column = ""
    else:
        number = int(segment.group(1)) if segment else 1
        source = row.segments[min(number, len(row.segments)) - 1]
        column = COLUMN_OF_CODE.get(finding.code, "")
    place = "" if segment or part else finding.position.removeprefix("at ")
    message = f"{finding.object}: {finding.message}" + (f" at {place}" if place else "")
    return source.error(
        column,
        finding.code,
        message,
        finding.mend,
        value=finding.value,
        limit=finding.limit,
        unit=finding.unit,
    )


def at_rows(schedule: Schedule, findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Findings about members and their plates with the sheet, row and column in place of `edge 3`
    and the like."""
    rows = {row.name: row for row in schedule.members}
    told = []
    for finding in findings:
        row = rows.get(finding.object) or rows.get(finding.object.rpartition("-")[0])
        if row is not None and _PART.fullmatch(finding.position):
            place = located(schedule, row, finding).position
            finding = replace(finding, position=place)
        told.append(finding)
    return tuple(told)


def _first_auto(splits: Mapping[str, SplitRow], row: MemberRow):
    """The row of Splits that asks for joints by rule, of all faces together; the member's row
    where none does."""
    return next((own for own in splits.values() if own.joints.kind == "auto"), row)


def _axis_cell(axis: AxisRow, finding: Finding):
    """The row and column of an axis a finding is about."""
    table = re.match(r"(point|station|preset row) (\d+)", finding.position)
    rows = {"point": axis.points, "station": axis.frames, "preset row": axis.presets}
    if table and len(rows[table.group(1)]) >= int(table.group(2)):
        column = "" if table.group(1) == "point" else "s"
        return rows[table.group(1)][int(table.group(2)) - 1], column
    if finding.code == "axis-end-height":
        return axis, f"{finding.position}_z"
    if finding.code == "axis-extension":
        return axis, f"{finding.position}_extension"
    default = "frame" if finding.code.startswith("frame") else ""
    return axis, COLUMN_OF_AXIS_CODE.get(finding.code, default)


def _segment(schedule: Schedule, row: SegmentRow) -> Segment:
    cut = row.cut
    return Segment(
        section_of(schedule, row.section),
        cut.value if cut else 0.0,
        row.slope,
        row.align,
        row.align_to,
        row.offset_y,
        row.offset_z,
        bool(cut and cut.is_ratio),
        row.transition,
        row.stagger,
    )
