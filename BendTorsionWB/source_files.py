# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the files named by a schedule's surfaces and axes hold, and what they say of their size."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from BendTorsionWB.core.axes.axis_source import AxisSource
from BendTorsionWB.core.finding import BendTorsionError, Finding
from BendTorsionWB.exchange.file_extent import extent_findings, unit_of
from BendTorsionWB.exchange.outside_files import file_of
from BendTorsionWB.exchange.rhino_files import rhino_axis, rhino_patches, rhino_unit
from BendTorsionWB.exchange.schedule_jobs import Files
from BendTorsionWB.exchange.schedule_rows import AxisRow, MemberRow, Schedule, SurfaceRow

MEASURED = 200
"""Faces whose box is measured, which takes some 10 ms each."""


def read_files(schedule: Schedule, rows: Sequence[MemberRow]) -> Files:
    """What the files named by these members' surfaces and axes hold, with a note of the unit and
    size of each; raises BendTorsionError at their cells."""
    axes = [schedule.axis(name) for name in dict.fromkeys(row.axis for row in rows)]
    cuts = [cut.surface for row in rows for cut in (row.start_cut, row.end_cut) if cut is not None]
    named = [
        schedule.surface(name)
        for name in dict.fromkeys([*(axis.surface for axis in axes), *filter(None, cuts)])
    ]
    surfaces, sources, boxes, faults = {}, {}, {}, []

    def read(row, column: str, reader) -> None:
        try:
            reader(row)
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

    def read_surface(row) -> None:
        from BendTorsionWB.shapes.from_part import surface_from_part

        shape = faces_of(schedule, row)
        surfaces[row.name] = surface_from_part(shape, row.name)
        # FreeCAD's plain box holds the poles of a patch, which lie far outside it.
        few = len(shape.Faces) <= MEASURED
        box = shape.optimalBoundingBox(False) if few else shape.BoundBox
        boxes["surface", row.name] = np.array(
            [[box.XMin, box.YMin, box.ZMin], [box.XMax, box.YMax, box.ZMax]]
        )

    def read_axis(row) -> None:
        sources[row.name] = _source_of(schedule, row)
        boxes["axis", row.name] = _box(sources[row.name])

    for row in named:
        if row.file is not None:
            read(row, "file", read_surface)
    for row in axes:
        if row.source is not None:
            read(row, "source", read_axis)
    if faults:
        raise BendTorsionError(_once(faults))
    return Files(surfaces, sources, _findings(schedule, axes, boxes))


def _once(faults: Sequence[Finding]) -> list[Finding]:
    """The faults; a package that is missing is told at the first cell alone that needs it."""
    missing = [finding for finding in faults if finding.code == "rhino3dm-missing"]
    return [finding for finding in faults if finding not in missing[1:]]


def faces_of(schedule: Schedule, row: SurfaceRow):
    """The faces of a surface file, or of one named part of it, as a Part shape; raises
    BendTorsionError."""
    path = file_of(schedule.folder, row.file.file, row.name)
    if path.suffix.lower() == ".3dm":
        from BendTorsionWB.shapes.patch_shape import faces_of_patches

        return faces_of_patches(rhino_patches(path, row.file.part))
    from BendTorsionWB.shapes.surface_files import faces_from_file

    return faces_from_file(path, row.file.part, row.name)


def _source_of(schedule: Schedule, row: AxisRow) -> AxisSource:
    path = file_of(schedule.folder, row.source.file, row.name)
    if path.suffix.lower() == ".dxf":
        # Its library takes a moment to load.
        from BendTorsionWB.exchange.curve_files import dxf_axis

        return dxf_axis(path, row.source.part)
    if path.suffix.lower() == ".3dm":
        return rhino_axis(path, row.source.part)
    from BendTorsionWB.shapes.curve_files import part_axis

    return part_axis(path, row.source.part, row.name)


def _box(source: AxisSource) -> np.ndarray:
    """(2, 3) the bounding box of what an axis is made from, of a curve that of its poles."""
    if source.curve is not None:
        points = source.curve.poles
    elif source.segments is not None:
        points = np.vstack(source.segments)
    else:
        points = source.points
    return np.array([points.min(axis=0), points.max(axis=0)])


def _findings(schedule: Schedule, axes: Sequence[AxisRow], boxes) -> tuple[Finding, ...]:
    sizes = {key: float(np.linalg.norm(box[1] - box[0])) for key, box in boxes.items()}
    on: dict[str, list[float]] = {}
    for axis in axes:
        points = axis.coordinates()
        size = sizes.get(("axis", axis.name))
        if size is None and len(points):
            size = float(np.linalg.norm(np.ptp(points, axis=0)))
        if size:
            on.setdefault(axis.surface, []).append(size)
    found: dict[Finding, None] = {}
    for (kind, name), box in boxes.items():
        row = schedule.surface(name) if kind == "surface" else schedule.axis(name)
        given = row.file if kind == "surface" else row.source
        path = Path(schedule.folder) / given.file
        if kind == "surface":
            beside = max(on.get(name, ()), default=None)
        else:
            beside = sizes.get(("surface", row.surface)) or _described(schedule, row.surface)
        label = f"{given.file}#{given.part}" if given.part else given.file
        told = extent_findings(label, box, _unit(path), beside, _tells_units(path))
        found.update(dict.fromkeys(replace(f, position=f"{kind} {name}") for f in told))
    return tuple(found)


def _described(schedule: Schedule, name: str) -> float | None:
    """The largest size of a surface given by its parameters; a plane has none."""
    sizes = [value for key, value in schedule.surface(name).sizes if key != "angle"]
    return max(sizes, default=None)


def _unit(path: Path) -> float | None:
    kind = path.suffix.lower()
    if kind == ".dxf":
        from BendTorsionWB.exchange.curve_files import dxf_unit

        return dxf_unit(path)
    return rhino_unit(path) if kind == ".3dm" else unit_of(path)


def _tells_units(path: Path) -> bool:
    return path.suffix.lower() not in (".brep", ".brp")
