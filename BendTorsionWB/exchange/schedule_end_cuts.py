# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells that say how the ends of members are cut, and what they are in the core."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from ..core.geometry.surface import Surface
from ..core.members.end_cut import KINDS, SQUARE, EndCut
from .schedule_cells import BadCell, Number, did_you_mean, text

CUT_COLUMNS = ("start_cut", "end_cut")
_MEND = "write square, plumb, level, plane nx=1 ny=0 nz=0.5, or surface and its name"
_KEYS = {"plane": ("nx", "ny", "nz", "x", "y", "z", "offset")}
_ITEM = re.compile(r"(\w+)\s*=\s*(\S+)")


@dataclass(frozen=True)
class EndCutCell:
    """How an end is cut, as `core.end_cut.EndCut`, with the surface by its name."""

    kind: str
    offset: float = 0.0
    normal: tuple[float, float, float] | None = None
    point: tuple[float, float, float] | None = None
    surface: str = ""


def end_cut(value) -> EndCutCell:
    """`square`, `plumb`, `level`, `plane nx=1 ny=0 nz=0.5 x=0 y=0 z=0` (without the point through
    the end of the axis) or `surface NAME`; each with `offset=50`, mm outwards."""
    words = text(value)
    kind, _, rest = words.partition(" ")
    kind = kind.lower()
    if kind not in KINDS:
        near = did_you_mean(kind, KINDS)
        raise BadCell(
            "bad-end-cut",
            "unknown end cut",
            f"did you mean {near}? " + _MEND if near else _MEND,
            ", ".join(KINDS),
        )
    numbers: dict[str, float] = {}
    for key, figure in _ITEM.findall(rest):
        known = _KEYS.get(kind, ("offset",))
        if key not in known or key in numbers:
            what = "is given twice" if key in numbers else f"does not belong to {kind}"
            raise BadCell("bad-end-cut", f"{key} {what}", f"use {', '.join(known)}")
        try:
            numbers[key] = Number()(figure)
        except BadCell as bad:
            raise BadCell(bad.code, f"{key}: {bad.message}", _MEND, bad.limit) from None
    name = " ".join(_ITEM.sub("", rest).split())
    if bool(name) != (kind == "surface"):
        message = "the surface has no name" if kind == "surface" else f"cannot read '{name}'"
        raise BadCell("bad-end-cut", message, _MEND)
    normal = tuple(numbers.get(key, 0.0) for key in ("nx", "ny", "nz"))
    if kind == "plane" and not any(normal):
        raise BadCell("bad-end-cut", "the plane has no normal", _MEND)
    at = [key for key in ("x", "y", "z") if key in numbers]
    if at and len(at) < 3:
        raise BadCell("bad-end-cut", "the point needs x, y and z", _MEND)
    return EndCutCell(
        kind,
        numbers.get("offset", 0.0),
        normal if kind == "plane" else None,
        tuple(numbers[key] for key in at) if at else None,
        name,
    )


def check_end_cuts(records, surfaces, report: Callable) -> None:
    """Reports surfaces that are no rows of Surfaces, and cut ends of rings."""
    names = {record["surface"] for record in surfaces} - {None}
    for record in records:
        for column in CUT_COLUMNS:
            cell = record[column]
            if cell is not None and cell.surface and cell.surface not in names:
                near = did_you_mean(cell.surface, names)
                message = f"surface {cell.surface} is not a row of Surfaces"
                mend = f"did you mean {near}?" if near else "add it to sheet Surfaces"
                report(record, column, "unknown-name", message, mend)


def core_cut(cell: EndCutCell | None, surface_of: Callable[[str], Surface]) -> EndCut:
    """The core's end cut of a cell; surface_of gives a surface by its name."""
    if cell is None:
        return SQUARE
    surface = surface_of(cell.surface) if cell.surface else None
    return EndCut(cell.kind, cell.offset, cell.normal, cell.point, surface)
