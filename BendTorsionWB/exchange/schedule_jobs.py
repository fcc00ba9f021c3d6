# SPDX-License-Identifier: LGPL-2.1-or-later
"""A schedule as jobs for the core, and the core's findings back at the cells they come from."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ..core import rules
from ..core.axis_ends import AxisEnd
from ..core.axis_input import AxisInput
from ..core.axis_preset import Preset
from ..core.axis_source import AxisSource
from ..core.detailing import MemberInput, MemberJob, PlatesInput
from ..core.finding import BendTorsionError, Finding
from ..core.frames import FrameInput
from ..core.frames_law import GivenDirection
from ..core.plates import Joints
from ..core.section import Material, Section, box
from ..core.surface import Flipped, Offset, Surface, analytic_surface
from ..core.zones import Segment
from .schedule import AxisRow, MemberRow, Schedule, SegmentRow

COLUMN_OF_CODE = {
    "cut-beyond-axis": "cut",
    "cut-order": "cut",
    "transitions-overlap": "cut",
    "transition-past-end": "cut",
    "slope": "slope",
    "alignment": "align",
    "type-change": "section",
    "bend-sharper-than-section": "section",
    "plate-folds-over": "section",
}
"""Column of the Members sheet a finding of the core is about."""

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


@dataclass(frozen=True)
class Files:
    """What the files of a schedule hold: surfaces by their name, sources by their axis's."""

    surfaces: Mapping[str, Surface] = field(default_factory=dict)
    sources: Mapping[str, AxisSource] = field(default_factory=dict)


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
    return box(
        row.name,
        row.type,
        row.h,
        row.b,
        row.t_top,
        row.t_bottom,
        row.t_web,
        row.gap1,
        row.gap2,
        Material(grade.name, grade.density, grade.E, grade.fy),
    )


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
    joints = {
        face: Joints(split.joints.values, split.joints.kind)
        for face, split in schedule.splits_of(row.name).items()
    }
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
        ),
        PlatesInput(
            joints,
            settings.station_spacing,
            rules.joint_rules(settings.rule_pack),
            rules.forming_rules(settings.rule_pack),
        ),
    )


def located(schedule: Schedule, row: MemberRow, finding: Finding) -> Finding:
    """A core finding about a member, at the cell of the schedule that causes it."""
    segment = re.match(r"segment (\d+)", finding.position)
    if finding.code == "surface-size":
        source, column = schedule.surface(schedule.axis(row.axis).surface), "parameters"
        column = "file" if source.kind == "file" else column
    elif finding.code.startswith(("axis", "surface", "frame", "preset")):
        source, column = _axis_cell(schedule.axis(row.axis), finding)
    elif finding.code in ("joints", "plate-too-short", "stock-too-narrow", "joints-infeasible"):
        face = re.match(r"face (\w+)", finding.position)
        splits = schedule.splits_of(row.name)
        source, column = splits.get(face.group(1) if face else "", row), "joints"
        if source is row:
            column = ""
    else:
        number = int(segment.group(1)) if segment else 1
        source = row.segments[min(number, len(row.segments)) - 1]
        column = COLUMN_OF_CODE.get(finding.code, "")
    place = "" if segment else finding.position
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
    )
