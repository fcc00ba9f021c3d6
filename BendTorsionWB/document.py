# SPDX-License-Identifier: LGPL-2.1-or-later
"""The document of a schedule: its objects."""

from __future__ import annotations

import math
from dataclasses import astuple

from BendTorsionWB.core.axes.axis_input import AxisInput
from BendTorsionWB.core.detailing import MemberJob
from BendTorsionWB.core.patterns.layer_names import named_layers
from BendTorsionWB.exchange.schedule_end_cuts import EndCutCell
from BendTorsionWB.exchange.schedule_jobs import PARTS, job_of
from BendTorsionWB.exchange.schedule_rows import AxisRow, MemberRow, Schedule
from BendTorsionWB.interrupts import stop_if_asked
from BendTorsionWB.source_files import faces_of, read_files


def build_document(
    schedule: Schedule, jobs: dict[str, MemberJob], sheets: bool = True, hidden: bool = True
):
    """A new document with the objects of the jobs' members, not yet recomputed. sheets: with
    their drawing sheets; hidden: without a view of it in the window."""
    import FreeCAD

    from BendTorsionWB import make
    from BendTorsionWB.document_settings import keep_rows, keep_style

    document = FreeCAD.newDocument("model", hidden=hidden)
    keep_style(document, schedule.settings.sheet_style)
    keep_rows(document, schedule.kept)
    surfaces, sections, axes, made = {}, {}, {}, {}
    everyone = {**jobs, **_met_elsewhere(schedule, jobs)}
    with equal_labels():
        for name, job in everyone.items():
            stop_if_asked()
            row = schedule.member(name)
            axis_row = schedule.axis(row.axis)
            surface = axis_row.surface
            if surface not in surfaces:
                surfaces[surface] = _make_surface(make, document, schedule, surface)
            for segment in row.segments:
                if segment.section not in sections:
                    section = _make_section(make, document, schedule, segment.section)
                    sections[segment.section] = section
            if row.axis not in axes:
                axis = _make_axis(make, document, axis_row, job.axis, surfaces[surface])
                axes[row.axis] = axis
            for cut in (row.start_cut, row.end_cut):
                if cut is not None and cut.surface and cut.surface not in surfaces:
                    at = _make_surface(make, document, schedule, cut.surface)
                    surfaces[cut.surface] = at
            member = _make_member(
                make, document, schedule, row, job, axes[row.axis], sections, surfaces
            )
            plates = None
            if name in jobs:
                plates = _make_plates(make, document, schedule, row, job, member, sheets)
            made[name] = member, plates
        _make_nodes(make, document, schedule, jobs, made)
        drawn = [obj for obj in document.Objects if getattr(obj, "BT_Type", "") == "SheetSet"]
        if drawn:
            make.make_arrangement(document, drawn)
            if any(getattr(obj, "BT_Type", "") == "Node" for obj in document.Objects):
                make.make_node_sheets(document, drawn)
    mark_from_schedule(document.Objects)
    return document


def _met_elsewhere(schedule: Schedule, jobs: dict[str, MemberJob]) -> dict[str, MemberJob]:
    """Jobs of members that are not built here but meet some that are."""
    met = {name for job in jobs.values() for node in job.meets for name in node.members}
    rows = [row for row in schedule.members if row.name in met and row.name not in jobs]
    files = read_files(schedule, rows)
    return {row.name: job_of(schedule, row, files) for row in rows}


def _make_nodes(make, document, schedule: Schedule, jobs: dict[str, MemberJob], made) -> None:
    """A Node for each branch of the nodes of these jobs' members."""
    by_row = {frozenset((row.through, row.other)): row.through for row in schedule.nodes}
    nodes = {node.name: node for job in jobs.values() for node in job.meets}
    for node in nodes.values():
        through, its_plates = made[node.through]
        for branch in node.branches:
            other, plates = made[branch.member]
            beside, first = [], []
            for name in dict.fromkeys(b.member for b in node.branches if b is not branch):
                row = by_row.get(frozenset((name, branch.member)))
                if row is None:
                    beside.append(made[name][0])
                elif row == name:
                    first.append(made[name][0])
            make.make_node(
                document,
                through,
                other,
                node.name,
                label=node.name if len(node.branches) == 1 else f"{node.name} {branch.member}",
                type=branch.row.type,
                gap=branch.gap,
                stub_length=branch.row.stub_length,
                diaphragms=branch.row.diaphragms,
                blend=branch.row.blend,
                place=branch.s_through,
                by_rank=frozenset((node.through, branch.member)) not in by_row,
                rule_pack=schedule.settings.rule_pack,
                plates=[item for item in (its_plates, plates) if item is not None],
                beside=beside,
                ends_on=first,
            )


def _degrees(angle: float) -> float:
    """rad as the degrees they were read from: the way there and back leaves a trace in the last
    digits, and the row written back would be another."""
    return round(math.degrees(angle), 12)


def equal_labels():
    """Let a member and its axis bear one name; FreeCAD would number the second."""
    from BendTorsionWB.objects.preference import preference

    return preference("Document", "DuplicateLabels", True)


def mark_from_schedule(objects) -> None:
    """Note on objects that they follow a row of the schedule, under the name they have now."""
    from BendTorsionWB.objects.proxy import HIDDEN, READ_ONLY

    for obj in objects:
        obj.addProperty(
            "App::PropertyString",
            "FromSchedule",
            "Base",
            "Name under which the object follows the schedule",
            READ_ONLY | HIDDEN,
        )
        obj.FromSchedule = obj.Label


def _make_surface(make, document, schedule: Schedule, name: str):
    row = schedule.surface(name)
    if row.kind == "file":
        faces = _feature(document, f"{name} file", faces_of(schedule, row))
        return make.make_surface(document, name, face=(faces, ""), offset=row.offset, flip=row.flip)
    sizes = {key: _degrees(value) if key == "angle" else value for key, value in row.sizes}
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
    angles = {item.s.value: _degrees(item.angle) for item in row.frames if item.z is None}
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
    sizes = {
        key: getattr(row, key)
        for key in ("h", "b", "b_bottom", "gap1", "gap2")
        if getattr(row, key) is not None
    }
    if row.corner_joint:
        sizes["corner_joint"] = row.corner_joint
    if row.type == "polygon":
        sizes |= {"corners": row.corners, "thicknesses": row.thicknesses}
    if row.type == "strips":
        sizes["strips"] = [astuple(strip) for strip in row.strips]
    return make.make_section(
        document,
        name,
        row.type,
        t=row.t_top or 0.0,
        t_top=0.0,
        t_bottom=row.t_bottom if row.t_bottom not in (None, row.t_top) else 0.0,
        t_web=row.t_web if row.t_web not in (None, row.t_top) else 0.0,
        Material=grade.name,
        Density=grade.density * 1e9,
        E=f"{grade.E!r} MPa",
        fy=f"{grade.fy!r} MPa",
        **sizes,
    )


def _make_member(
    make, document, schedule: Schedule, row: MemberRow, job: MemberJob, axis, sections, surfaces
):
    segments = []
    for segment in row.segments:
        values = {
            "align": segment.align,
            "align_to": segment.align_to,
            "offset_y": segment.offset_y,
            "offset_z": segment.offset_z,
            "slope": segment.slope,
            "stagger": segment.stagger,
            "transition": segment.transition,
        }
        if segment.cut is not None:
            values["cut_ratio" if segment.cut.is_ratio else "cut"] = segment.cut.value
        segments.append(values)
    return make.make_member(
        document,
        row.name,
        axis,
        [sections[s.section] for s in row.segments],
        segments,
        offset_y=row.offset_y,
        offset_z=row.offset_z,
        roll=_degrees(row.roll),
        transition_length=schedule.settings.transition_length,
        rank=row.rank or 0,
        thickness=job.member.thickness,
        start_cut=_cut_at(row.start_cut, surfaces),
        end_cut=_cut_at(row.end_cut, surfaces),
    )


def _cut_at(cell: EndCutCell | None, surfaces):
    """An end cut as make_member takes it."""
    if cell is None:
        return "square"
    return {**vars(cell), "face": surfaces.get(cell.surface)}


def _make_plates(
    make, document, schedule: Schedule, row: MemberRow, job: MemberJob, member, sheets: bool
):
    """The PlateSet of a member, with its patterns, bed and sheets."""
    settings = schedule.settings
    splits = schedule.splits_of(row.name)
    joints, lanes = (
        {
            face: "auto" if given.kind == "auto" else given.values
            for face, split in splits.items()
            if (given := getattr(split, what)) is not None
        }
        for what in ("joints", "lanes")
    )
    plates = make.make_plates(
        document,
        member,
        joints,
        lanes=lanes,
        station_spacing=settings.station_spacing,
        rule_pack=settings.rule_pack,
        stock=settings.stock,
        **{
            name: [dict(part.cells) for part in schedule.parts_of(sheet, row.name)]
            for sheet, name in PARTS.items()
        },
    )
    unfold = make.make_unfold(
        document,
        plates,
        row.patterns.mode,
        flattened_surface=row.patterns.surface,
        marking_face=row.patterns.marking_face,
        contour=row.patterns.contour,
        layers=named_layers(settings.layer_names),
        **vars(row.patterns.allowances),
    )
    bed = make.make_bed(document, plates, **vars(job.bed))
    if sheets:
        from BendTorsionWB.objects import sheet_content

        sheets = make.make_sheets(document, unfold, bed=bed, plate_pages=False)
        sheet_content.set_style(sheets, settings.sheet_style)
    return plates
