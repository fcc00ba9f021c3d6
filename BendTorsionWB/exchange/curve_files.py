# SPDX-License-Identifier: LGPL-2.1-or-later
"""Axes from DXF files: splines, arcs, polylines, lines and points, by layer or handle."""

from __future__ import annotations

import struct
from pathlib import Path

import ezdxf
import numpy as np
from ezdxf.entities import Ellipse
from ezdxf.lldxf.const import DXFError
from ezdxf.math import rational_bspline_from_ellipse

from ..core.axes.axis_source import AxisSource, axis_source, found_source
from ..core.file_end import CUT_SHORT, MEND, is_cut_short
from ..core.finding import BendTorsionError, Finding, error, has_error, warning
from ..core.geometry.curve import Curve

# $INSUNITS to mm; 0 (no unit) counts as mm.
UNITS = {0: 1.0, 1: 25.4, 2: 304.8, 4: 1.0, 5: 10.0, 6: 1000.0, 14: 100.0}
LARGEST_FILE = 50e6
"""Bytes."""
DAMAGES = (
    DXFError,
    ArithmeticError,
    AssertionError,
    AttributeError,
    LookupError,
    RecursionError,
    StopIteration,
    struct.error,
    TypeError,
    ValueError,
)
"""What ezdxf raises for damaged files."""
KINDS = ("SPLINE", "ARC", "CIRCLE", "ELLIPSE", "LWPOLYLINE", "POLYLINE", "LINE", "POINT")


def dxf_axis(path: str | Path, name: str = "") -> AxisSource:
    """What a DXF file holds for an axis, in mm: everything on the layer `name`, or the one entity
    with that handle; the only layer when empty.

    Splines, arcs, ellipses and bulges exactly; straight polylines and lines as segments; points
    as bare points. Raises BendTorsionError for files that cannot be read and names not there.
    """
    path = Path(path)
    document = _document(path)
    sources = _sources(document, path.name)
    # Names in DXF are alike whatever their case.
    filled = {entity.dxf.layer.lower() for entity in _entities(document)}
    named = [layer.dxf.name for layer in document.layers]
    named += [entity.dxf.layer for entity in document.modelspace()]
    named = list(dict.fromkeys(named))
    layers = [layer for layer in sources if layer.lower() in filled]
    empty = [layer for layer in named if layer.lower() not in filled]
    source = found_source(name, sources, path.name, layers, empty)
    if has_error(source.findings):
        raise BendTorsionError(source.findings)
    return source


def dxf_unit(path: str | Path) -> float | None:
    """mm in the unit a DXF file declares; None when it tells none or cannot be read."""
    try:
        code = ezdxf.readfile(path).header.get("$INSUNITS", 0)
    except (OSError, *DAMAGES):
        return None
    return UNITS.get(code) if code else None


def dxf_axes(path: str | Path) -> dict[str, AxisSource]:
    """All sources of a DXF file: by layer, then by handle of each entity."""
    path = Path(path)
    return _sources(_document(path), path.name)


def _document(path: Path):
    if not path.is_file():
        raise BendTorsionError(
            error(
                "file-missing",
                path.name,
                "there is no such file",
                "write its path relative to the schedule",
                value=path.name,
            )
        )
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise DXFError(f"it is larger than {LARGEST_FILE / 1e6:g} MB")
        if is_cut_short(path, "DXF"):
            raise BendTorsionError(error("axis-file", path.name, CUT_SHORT, MEND))
        document = ezdxf.readfile(path)
    except (OSError, *DAMAGES) as problem:
        raise BendTorsionError(
            error(
                "axis-file",
                path.name,
                f"the file cannot be read as DXF: {problem}",
                "save it as DXF R2000 or later",
            )
        ) from problem
    return document


def _entities(document) -> list:
    """Those of the model an axis can be made from."""
    return [
        entity
        for entity in document.modelspace()
        if entity.dxftype() in KINDS
        and not (
            entity.dxftype() == "POLYLINE" and (entity.is_polygon_mesh or entity.is_poly_face_mesh)
        )
    ]


def _sources(document, file: str) -> dict[str, AxisSource]:
    code = document.header.get("$INSUNITS", 0)
    if code not in UNITS:
        raise BendTorsionError(
            error(
                "axis-file-unit",
                file,
                "the drawing's unit is none of mm, cm, dm, m, inch, foot",
                "set $INSUNITS to 4 (mm)",
                position="$INSUNITS",
                value=int(code),
            )
        )
    entities = _entities(document)
    inserts = len(document.modelspace().query("INSERT"))
    findings = (
        (
            warning(
                "axis-file-blocks",
                file,
                "blocks of the drawing were not looked into",
                "explode them when they hold the axis",
                value=inserts,
            ),
        )
        if inserts
        else ()
    )
    groups: dict[str, list] = {}
    for entity in entities:
        groups.setdefault(entity.dxf.layer, []).append(entity)
    for entity in entities:
        groups.setdefault(entity.dxf.handle, [entity])
    sources = {}
    for name, members in groups.items():
        try:
            # Numbers that cannot be are refused by name once they are read.
            with np.errstate(all="ignore"):
                sources[name] = _source(name, members, UNITS[code], findings)
        except BendTorsionError as problem:
            # A layer of many things is no axis; each of them may be one.
            sources[name] = AxisSource(name, findings=problem.findings)
        except DAMAGES as problem:
            message = f"an entity cannot be read: {problem}"
            damaged = error("axis-file", file, message, "draw it anew", position=name)
            sources[name] = AxisSource(name, findings=(damaged,))
    return sources


def _source(name: str, entities: list, scale: float, findings: tuple[Finding, ...]) -> AxisSource:
    curves, polylines, points = [], [], []
    for entity in entities:
        kind = entity.dxftype()
        if kind == "POINT":
            points.append(np.array(entity.dxf.location))
        elif kind in ("LWPOLYLINE", "POLYLINE") and _has_bulge(entity):
            for part in entity.virtual_entities():
                if part.dxftype() == "LINE":
                    polylines.append(_vertices(part))
                else:
                    curves.append(_curve(part))
        elif kind == "SPLINE" and not len(entity.control_points):
            # Fit points alone name no curve: they count as points in order.
            polylines.append(np.array([tuple(p) for p in entity.fit_points]).reshape(-1, 3))
        elif kind in ("LWPOLYLINE", "POLYLINE", "LINE"):
            polylines.append(_vertices(entity))
        else:
            curves.append(_curve(entity))
    return axis_source(name, tuple(curves), tuple(polylines), np.array(points), findings, scale)


def _has_bulge(entity) -> bool:
    if entity.dxftype() == "LWPOLYLINE":
        return entity.has_arc
    return any(vertex.dxf.bulge for vertex in entity.vertices)


def _vertices(entity) -> np.ndarray:
    if entity.dxftype() == "LINE":
        return np.array([tuple(entity.dxf.start), tuple(entity.dxf.end)])
    if entity.dxftype() == "POLYLINE":
        lines = [_vertices(part) for part in entity.virtual_entities()]
        return np.vstack([lines[0][:1], *(line[1:] for line in lines)])
    points = np.array([tuple(point) for point in entity.vertices_in_wcs()])
    return np.vstack([points, points[:1]]) if entity.closed else points


def _curve(entity) -> Curve:
    if entity.dxftype() == "SPLINE":
        spline = entity.construction_tool()
    else:
        if entity.dxftype() in ("ARC", "CIRCLE"):
            entity = Ellipse.from_arc(entity)
        spline = rational_bspline_from_ellipse(entity.construction_tool())
    weights = np.array(spline.weights(), float)
    return Curve(
        spline.degree,
        np.array(spline.knots(), float),
        np.array([tuple(point) for point in spline.control_points], float),
        None if not len(weights) or np.ptp(weights) == 0 else weights,
    )
