# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curves and untrimmed surfaces of Rhino files (.3dm), by layer or object name, in mm."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..core.axes.axis_check import check_weights
from ..core.axes.axis_source import AxisSource, axis_source, found_source
from ..core.finding import BendTorsionError, error, has_error
from ..core.geometry.curve import Curve
from ..core.geometry.nurbs import NurbsPatch

UNITS = {
    "Microns": 1e-3,
    "Millimeters": 1.0,
    "Centimeters": 10.0,
    "Decimeters": 100.0,
    "Meters": 1e3,
    "Kilometers": 1e6,
    "Inches": 25.4,
    "Feet": 304.8,
    "Yards": 914.4,
}


def rhino_axis(path: str | Path, name: str = "") -> AxisSource:
    """What a Rhino file holds for an axis: the curves, polylines and points of the layer or object
    `name`; of the only one when empty. Raises BendTorsionError for files that cannot be read, names
    not there, and a missing rhino3dm."""
    path = Path(path)
    model, unit = _read(path)
    groups: dict[str, list] = {}
    for named, geometry in _named(model):
        if type(geometry).__name__.endswith("Curve") or type(geometry).__name__ == "Point":
            for key in named:
                groups.setdefault(key, []).append(geometry)
    sources = {}
    for key, members in groups.items():
        try:
            sources[key] = _source(key, members, unit)
        except BendTorsionError as problem:
            sources[key] = AxisSource(key, findings=problem.findings)
    source = found_source(name, sources, path.name)
    if has_error(source.findings):
        raise BendTorsionError(source.findings)
    return source


def rhino_patches(path: str | Path, name: str = "") -> tuple[NurbsPatch, ...]:
    """The untrimmed surfaces of the layer or object `name`, of the whole file when empty. Raises
    BendTorsionError as rhino_axis does, and for trimmed surfaces, whose edges would be lost."""
    path = Path(path)
    model, unit = _read(path)
    patches, trimmed, names = [], 0, {}
    for named, geometry in _named(model):
        kind = type(geometry).__name__
        if kind not in ("Brep", "Extrusion") and not kind.endswith("Surface"):
            continue
        for key in named:
            names.setdefault(key)
        if name and name.lower() not in (key.lower() for key in named):
            continue
        if kind == "Extrusion":
            geometry = geometry.ToBrep(False)
            kind = "Brep"
        if kind == "Brep" and not geometry.IsSurface:
            trimmed += 1
            continue
        surface = geometry.Faces[0].UnderlyingSurface() if kind == "Brep" else geometry
        patches.append(_patch(surface.ToNurbsSurface(), unit))
    if trimmed:
        raise _fault(
            "surface-trimmed",
            path,
            "it holds trimmed or joined surfaces, which are not read from Rhino files",
            "untrim and explode them in Rhino, or export STEP",
            value=trimmed,
        )
    if not patches:
        known = ", ".join(list(names)[:12]) or "no surface at all"
        message = f"no surface named {name!r}" if name else "there is no surface in it"
        raise _fault("surface-file-empty", path, message, f"it holds {known}")
    return tuple(patches)


def rhino_unit(path: str | Path) -> float | None:
    """mm in the unit of a Rhino file; None when it tells none."""
    model, _ = _read(Path(path))
    return UNITS.get(str(model.Settings.ModelUnitSystem).rpartition(".")[2])


def _read(path: Path):
    """The model of a file, and mm in its unit (1 when it tells none)."""
    try:
        import rhino3dm
    except ImportError:
        raise _fault(
            "rhino3dm-missing",
            path,
            "Rhino files need the Python package rhino3dm",
            "install it (pip install rhino3dm, on Debian in a virtual environment), or export STEP "
            "from Rhino",
        ) from None
    if not path.is_file():
        mend = "write its path relative to the schedule"
        raise _fault("file-missing", path, "there is no such file", mend)
    try:
        model = rhino3dm.File3dm.Read(str(path))
    except Exception as problem:
        raise _fault(
            "file-unreadable",
            path,
            f"it cannot be read as a Rhino file: {problem}",
            "save it again",
        ) from problem
    if model is None:
        raise _fault(
            "file-unreadable", path, "it cannot be read as a Rhino file", "save it again in Rhino"
        )
    return model, UNITS.get(str(model.Settings.ModelUnitSystem).rpartition(".")[2], 1.0)


def _named(model):
    """(names, geometry) of every object: its full layer path, the layer's own name, its name."""
    layers = {layer.Index: layer for layer in model.Layers}
    for item in model.Objects:
        layer = layers.get(item.Attributes.LayerIndex)
        names = [] if layer is None else [layer.FullPath, layer.Name]
        names.append(item.Attributes.Name)
        yield list(dict.fromkeys(filter(None, names))), item.Geometry


def _source(name: str, members, unit: float) -> AxisSource:
    curves, polylines, points = [], [], []
    for geometry in members:
        kind = type(geometry).__name__
        if kind == "Point":
            points.append(_place(geometry.Location))
        elif kind == "LineCurve":
            ends = geometry.PointAtStart, geometry.PointAtEnd
            polylines.append(np.array([_place(end) for end in ends]))
        elif kind == "PolylineCurve":
            count = geometry.PointCount
            polylines.append(np.array([_place(geometry.Point(k)) for k in range(count)]))
        else:
            place = f"segment {len(curves) + 1}"
            curves.append(_curve(name, geometry.ToNurbsCurve(), place))
    return axis_source(name, tuple(curves), tuple(polylines), np.array(points), unit=unit)


def _place(point) -> np.ndarray:
    return np.array([point.X, point.Y, point.Z])


def _curve(name: str, spline, position: str) -> Curve:
    poles = np.array([[p.X, p.Y, p.Z, p.W] for p in spline.Points])
    weights = poles[:, 3]
    check_weights(name, weights, position)
    return Curve(
        spline.Order - 1,
        _knots(spline.Knots, spline.Order - 1),
        poles[:, :3] / weights[:, None],
        None if np.ptp(weights) == 0.0 else weights / weights[0],
    )


def _patch(surface, unit: float) -> NurbsPatch:
    count = surface.Points.CountU, surface.Points.CountV
    poles = np.array(
        [
            [[p.X, p.Y, p.Z, p.W] for p in (surface.Points[u, v] for v in range(count[1]))]
            for u in range(count[0])
        ]
    )
    weights = poles[..., 3]
    degrees = surface.OrderU - 1, surface.OrderV - 1
    return NurbsPatch(
        *degrees,
        _knots(surface.KnotsU, degrees[0]),
        _knots(surface.KnotsV, degrees[1]),
        poles[..., :3] / weights[..., None] * unit,
        None if np.ptp(weights) == 0.0 else weights / weights[0, 0],
    )


def _knots(given, degree: int) -> np.ndarray:
    """Flat knots: Rhino leaves out the first and the last."""
    inner = np.array([given[k] for k in range(len(given))], float)
    if inner[0] == inner[degree - 1] and inner[-1] == inner[-degree]:
        return np.concatenate([inner[:1], inner, inner[-1:]])
    return np.concatenate([[2.0 * inner[0] - inner[1]], inner, [2.0 * inner[-1] - inner[-2]]])


def _fault(code: str, path: Path, message: str, mend: str, **fields) -> BendTorsionError:
    return BendTorsionError(error(code, path.name, message, mend, **fields))
