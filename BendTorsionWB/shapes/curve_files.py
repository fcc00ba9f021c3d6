# SPDX-License-Identifier: LGPL-2.1-or-later
"""Axes from the curves of STEP, IGES and BREP files, one of several by its name or number."""

from __future__ import annotations

import os
from pathlib import Path

import FreeCAD  # noqa: F401  Part crashes the interpreter when it is loaded before FreeCAD
import Part

from ..core.axes.axis_source import AxisSource
from ..core.finding import BendTorsionError, error
from .file_parts import told
from .from_part import curve_from_part
from .surface_files import pieces_in, shape_from_file


def part_axis(path: str | os.PathLike, name: str = "", object: str = "axis") -> AxisSource:
    """The exact curve of a file, or of its part called `name`: all edges that bound no face, which
    must form one chain.

    Raises BendTorsionError for files that cannot be read, names not there, no curve, and edges
    that form no single chain.
    """
    shape = shape_from_file(path, name, object)
    bounding = {edge.hashCode() for face in shape.Faces for edge in face.Edges}
    loose = [edge for edge in shape.Edges if edge.hashCode() not in bounding]
    if not loose:
        file = Path(path).name
        raise BendTorsionError(
            error(
                "axis-file-empty",
                object,
                f"{file}: there is no curve of its own in it",
                "export the axis as a wire or an edge",
                value=name or file,
            )
        )
    try:
        curve = curve_from_part(Part.Compound(loose), object)
    except BendTorsionError as problem:
        whole = shape_from_file(path, "", object) if name else shape
        curves = [piece for piece in pieces_in(path, whole) if piece.kind == "curve"]
        if len(curves) < 2 or problem.findings[0].code != "edge-chain":
            raise
        file, known = Path(path).name, told(curves)
        raise BendTorsionError(
            error(
                "axis-source-name",
                object,
                f"{file}: the file holds several curves"
                if not name
                else f"{file}: several curves are called {name!r}",
                f"name one of them after a #: {known}",
                value=len(curves),
                limit=1,
            )
        ) from None
    return AxisSource(name or Path(path).stem, curve=curve)
