# SPDX-License-Identifier: LGPL-2.1-or-later
"""A schedule as jobs for the core, and the core's findings back at the cells they come from."""

from __future__ import annotations

import re

from ..core import rules
from ..core.detailing import AxisInput, MemberInput, MemberJob, PlatesInput
from ..core.finding import BendTorsionError, Finding
from ..core.plates import Joints
from ..core.section import Material, Section, box
from ..core.surface import Surface, analytic_surface
from ..core.zones import Segment
from .schedule import MemberRow, Schedule, SegmentRow

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


def surface_of(schedule: Schedule, name: str) -> Surface:
    """The core surface of a Surfaces row; raises BendTorsionError at its cell."""
    row = schedule.surface(name)
    try:
        return analytic_surface(
            row.kind, dict(row.sizes), row.centre, row.offset, row.flip, row.name
        )
    except BendTorsionError as problem:
        raise BendTorsionError(
            row.error("offset" if f.code == "surface-offset" else "parameters", f.code, f.message,
                      f.mend, value=f.value, limit=f.limit, unit=f.unit)
            for f in problem.findings
        ) from problem


def section_of(schedule: Schedule, name: str) -> Section:
    """The core section of a Sections row."""
    row = schedule.section(name)
    grade = schedule.material(row.material)
    return box(
        row.name, row.type, row.h, row.b, row.t_top, row.t_bottom, row.t_web, row.gap1, row.gap2,
        Material(grade.name, grade.density, grade.E, grade.fy),
    )


def job_of(schedule: Schedule, row: MemberRow) -> MemberJob:
    """The job of one member."""
    axis = schedule.axis(row.axis)
    settings = schedule.settings
    joints = {
        face: Joints(split.joints.values, split.joints.kind)
        for face, split in schedule.splits_of(row.name).items()
    }
    return MemberJob(
        surface_of(schedule, axis.surface),
        AxisInput(
            axis.name,
            axis.coordinates(),
            fit=axis.fit,
            tolerance=settings.axis_tolerance,
            max_spacing=axis.max_spacing,
        ),
        MemberInput(
            row.name,
            tuple(_segment(schedule, segment) for segment in row.segments),
            row.offset_y,
            row.offset_z,
            row.roll,
            settings.transition_length,
        ),
        PlatesInput(joints, settings.station_spacing, rules.joint_rules(settings.rule_pack)),
    )


def located(schedule: Schedule, row: MemberRow, finding: Finding) -> Finding:
    """A core finding about a member, at the cell of the schedule that causes it."""
    segment = re.match(r"segment (\d+)", finding.position)
    if finding.code.startswith("axis"):
        source, column = schedule.axis(row.axis), ""
        point = re.match(r"point (\d+)", finding.position)
        if point:
            source = source.points[int(point.group(1)) - 1]
        elif finding.code == "axis-along-normal":
            column = "surface"
    elif finding.code in ("joints", "plate-too-short"):
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
        column, finding.code, message, finding.mend,
        value=finding.value, limit=finding.limit, unit=finding.unit,
    )


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
