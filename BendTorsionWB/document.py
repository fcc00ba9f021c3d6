# SPDX-License-Identifier: LGPL-2.1-or-later
"""The document of a schedule: its objects, and the files its surfaces and axes come from."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from BendTorsionWB.core.axis_input import AxisInput
from BendTorsionWB.core.axis_source import AxisSource
from BendTorsionWB.core.detailing import MemberJob
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.curve_files import dxf_axis
from BendTorsionWB.exchange.schedule import AxisRow, MemberRow, Schedule, SurfaceRow
from BendTorsionWB.exchange.schedule_jobs import Files


def read_files(schedule: Schedule, rows: Sequence[MemberRow]) -> Files:
    """What the files named by these members' surfaces and axes hold; raises BendTorsionError at
    their cells."""
    axes = [schedule.axis(name) for name in dict.fromkeys(row.axis for row in rows)]
    named = [schedule.surface(name) for name in dict.fromkeys(axis.surface for axis in axes)]
    surfaces, sources, faults = {}, {}, []

    def read(into: dict, row, column: str, reader) -> None:
        try:
            into[row.name] = reader(schedule, row)
        except BendTorsionError as problem:
            faults.extend(
                row.error(
                    column,
                    f.code,
                    f"{f.object}: {f.message}",
                    f.mend,
                    value=f.value,
                    limit=f.limit,
                    unit=f.unit,
                )
                for f in problem.findings
            )

    for row in named:
        if row.file is not None:
            read(surfaces, row, "file", _file_surface)
    for row in axes:
        if row.source is not None:
            read(sources, row, "source", _file_axis)
    if faults:
        raise BendTorsionError(faults)
    return Files(surfaces, sources)


def _file_surface(schedule: Schedule, row: SurfaceRow):
    from BendTorsionWB.shapes.from_part import surface_from_part

    return surface_from_part(_faces(schedule, row), row.name)


def _faces(schedule: Schedule, row: SurfaceRow):
    """The faces of a surface file, or of one named part of it, as a Part shape."""
    from BendTorsionWB.shapes.surface_files import faces_from_file

    return faces_from_file(Path(schedule.folder) / row.file.file, row.file.part, row.name)


def _file_axis(schedule: Schedule, row: AxisRow) -> AxisSource:
    path = Path(schedule.folder) / row.source.file
    if path.suffix.lower() == ".dxf":
        return dxf_axis(path, row.source.part)
    from BendTorsionWB.shapes.curve_files import part_axis

    return part_axis(path, row.source.part)


def build_document(schedule: Schedule, jobs: dict[str, MemberJob], progress=None):
    """A new document with the objects of the jobs' members, not yet recomputed."""
    import FreeCAD

    from BendTorsionWB import make

    document = FreeCAD.newDocument("model", hidden=True)
    surfaces, sections = {}, {}
    for done, name in enumerate(jobs, start=1):
        row = schedule.member(name)
        axis_row = schedule.axis(row.axis)
        if axis_row.surface not in surfaces:
            surfaces[axis_row.surface] = _make_surface(make, document, schedule, axis_row.surface)
        for segment in row.segments:
            if segment.section not in sections:
                sections[segment.section] = _make_section(make, document, schedule, segment.section)
        _make_member(
            make, document, schedule, row, jobs[name], surfaces[axis_row.surface], sections
        )
        if progress is not None:
            progress("objects", done, len(jobs))
    return document


def _make_surface(make, document, schedule: Schedule, name: str):
    row = schedule.surface(name)
    if row.kind == "file":
        faces = _feature(document, f"{name} file", _faces(schedule, row))
        return make.make_surface(document, name, face=(faces, ""), offset=row.offset, flip=row.flip)
    sizes = {key: math.degrees(value) if key == "angle" else value for key, value in row.sizes}
    return make.make_surface(
        document, name, row.kind, origin=row.centre, offset=row.offset, flip=row.flip, **sizes
    )


def _make_axis(make, document, row: AxisRow, given: AxisInput, surface):
    """The axis as the job has it; what a file holds becomes a feature the axis links to."""
    from BendTorsionWB.shapes import curve_shape

    made_from = {}
    if given.curve is not None:
        shape = curve_shape.edge(given.curve)
        made_from = {
            "edge": (_feature(document, f"{row.name} file", shape), ""),
            "source_use": "curve",
        }
    elif given.segments is not None:
        shape = curve_shape.polylines(given.segments)
        made_from = {"edge": (_feature(document, f"{row.name} file", shape), "")}
    else:
        made_from = {"points": given.points, "order": given.order}
    angles = {item.s.value: math.degrees(item.angle) for item in row.frames if item.z is None}
    directions = {item.s.value: item.z for item in row.frames if item.z is not None}
    table = {"twist": angles}
    if row.frame == "given":
        table = {"given_angles": angles, "given_directions": directions}
    return make.make_axis(
        document,
        row.name,
        surface,
        closed=row.closed,
        fit=row.fit,
        tolerance=given.tolerance,
        max_spacing=given.max_spacing or 0.0,
        start_z=row.start_z,
        end_z=row.end_z,
        start_dz=row.start_dz,
        end_dz=row.end_dz,
        start_extension=row.start_extension,
        end_extension=row.end_extension,
        frame=row.frame,
        preset={item.s.value: item.move for item in row.presets},
        **table,
        **made_from,
    )


def _feature(document, label: str, shape):
    """A plain shape in the document, for what was read from a file."""
    feature = document.addObject("Part::Feature", "File")
    feature.Label, feature.Shape = label, shape
    return feature


def _make_section(make, document, schedule: Schedule, name: str):
    row = schedule.section(name)
    grade = schedule.material(row.material)
    return make.make_section(
        document,
        name,
        row.type,
        h=row.h,
        b=row.b,
        t=row.t_top,
        t_top=0.0,
        t_bottom=row.t_bottom if row.t_bottom != row.t_top else 0.0,
        t_web=row.t_web if row.t_web != row.t_top else 0.0,
        gap1=row.gap1,
        gap2=row.gap2,
        Material=grade.name,
        Density=grade.density * 1e9,
        E=f"{grade.E!r} MPa",
        fy=f"{grade.fy!r} MPa",
    )


def _make_member(
    make, document, schedule: Schedule, row: MemberRow, job: MemberJob, surface, sections
) -> None:
    settings = schedule.settings
    axis_row = schedule.axis(row.axis)
    axis = _make_axis(make, document, axis_row, job.axis, surface)
    segments = []
    for segment in row.segments:
        values = {
            "align": segment.align,
            "align_to": segment.align_to,
            "offset_y": segment.offset_y,
            "offset_z": segment.offset_z,
        }
        if segment.cut is not None:
            values["cut_ratio" if segment.cut.is_ratio else "cut"] = segment.cut.value
            values["slope"] = segment.slope
        segments.append(values)
    member = make.make_member(
        document,
        row.name,
        axis,
        [sections[s.section] for s in row.segments],
        segments,
        offset_y=row.offset_y,
        offset_z=row.offset_z,
        roll=math.degrees(row.roll),
        transition_length=settings.transition_length,
        rank=row.rank or 0,
    )
    joints = {
        face: "auto" if split.joints.kind == "auto" else split.joints.values
        for face, split in schedule.splits_of(row.name).items()
    }
    plates = make.make_plates(
        document,
        member,
        joints,
        station_spacing=settings.station_spacing,
        rule_pack=settings.rule_pack,
    )
    unfold = make.make_unfold(document, plates)
    make.make_sheets(document, unfold, settings.project, settings.author)
