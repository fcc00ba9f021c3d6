# SPDX-License-Identifier: LGPL-2.1-or-later
"""Diaphragms, openings, marks, pieces and welds as rows of tables: the words of one row, read.

Schedules and document objects hold such rows and read them here, so that both mean the same.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from .finding import BendTorsionError, error
from .joints.pieces import PieceInput, end_words
from .plates.diaphragm_input import ENDS, Diaphragm, closing_of
from .plates.face_marks import FaceMark, mark_words
from .plates.hole_shape import hole_shape, placed_hole
from .plates.openings import Opening
from .sections.section import Material
from .welds.edge_rows import EdgeTreatment
from .welds.preps import PLACES, own_findings, prep_of

PART_COLUMNS = {
    "Diaphragms": ("s", "t", "gap", "snipe", "manhole", "closing_face", "material"),
    "Openings": ("face", "s", "offset", "shape", "rotation"),
    "Marks": ("face", "s", "offset", "text"),
    "Pieces": (
        *("piece", "from", "to", "start_end", "end_end"),
        *("green_start", "green_end", "gap"),
    ),
    "Edges": ("seam", "from", "to", "prep", "place", "ndt"),
}
"""Columns of a member's rows, by table."""


def place_of(value: object) -> tuple[float, bool]:
    """Arc length in mm, or a ratio and True, of a number or of text such as `3000` or `35%`.
    Raises BendTorsionError for what is neither, or lies before the start or beyond 100%."""
    text = str(value).strip()
    is_ratio = text.endswith("%")
    try:
        number = float(text.removesuffix("%")) / (100.0 if is_ratio else 1.0)
    except ValueError:
        number = np.nan
    if not (np.isfinite(number) and number >= 0.0 and (number <= 1.0 or not is_ratio)):
        raise _bad(
            "place", "the place cannot be read", text, "write mm from the start, or 0% to 100%"
        )
    return number, is_ratio


def diaphragm_of(row: Mapping[str, object]) -> Diaphragm:
    """The diaphragm of a row: s (mm, %, `start` or `end`), t, gap, snipe, manhole, closing_face and
    material (`name, density kg/m3, E, fy`). Raises BendTorsionError for words that mean nothing."""
    at = str(row["s"]).strip()
    place, is_ratio = (0.0, False) if at in ENDS else place_of(at)
    manhole, offset = None, (0.0, 0.0)
    if row.get("manhole"):
        manhole, offset = placed_hole(row["manhole"])
    return Diaphragm(
        place,
        float(row["t"]),
        float(row.get("gap") or 0.0),
        float(row.get("snipe") or 0.0),
        manhole,
        offset,
        closing_of(row["closing_face"]) if row.get("closing_face") else None,
        material_of(row["material"]) if row.get("material") else None,
        is_ratio,
        at if at in ENDS else "",
    )


def opening_of(row: Mapping[str, object]) -> Opening:
    """The opening of a row: face, s (mm or %), offset mm, shape, rotation in degrees."""
    place, is_ratio = place_of(row["s"])
    return Opening(
        str(row["face"]),
        place,
        hole_shape(row["shape"]),
        float(row.get("offset") or 0.0),
        float(np.radians(float(row.get("rotation") or 0.0))),
        is_ratio,
    )


def mark_of(row: Mapping[str, object]) -> FaceMark:
    """The mark of a row: face, s (mm or %), offset mm, text."""
    place, is_ratio = place_of(row["s"])
    kind, text, length, angle = mark_words(row["text"])
    return FaceMark(
        str(row["face"]),
        place,
        float(row.get("offset") or 0.0),
        kind,
        text,
        length,
        angle,
        is_ratio,
    )


def piece_of(row: Mapping[str, object]) -> PieceInput:
    """The delivery piece of a row: piece, from and to (mm or %, empty: its neighbour's),
    start_end and end_end (`square`, `stepped top=80 …`), green_start, green_end and gap mm."""
    places = [None if row.get(end) in (None, "") else place_of(row[end]) for end in ("from", "to")]
    ends = []
    for end in ("start_end", "end_end"):
        try:
            ends.append(end_words(row.get(end)))
        except ValueError as problem:
            mend = "write square, or stepped top=80 bottom=-80"
            raise _bad("piece-end", str(problem), str(row[end]), mend) from None
    greens = (float(row.get(column) or 0.0) for column in ("green_start", "green_end", "gap"))
    return PieceInput(int(float(str(row["piece"]))), *places, *ends, *greens)


def edge_of(row: Mapping[str, object]) -> EdgeTreatment:
    """The weld of a row: seam (`TL`, `T1/T2`, `joints`), from and to (mm or %, empty: the ends),
    prep as `preps.prep_of` reads it, place and ndt, empty for the rules'.

    Raises BendTorsionError for words that mean nothing and grooves that cannot be."""
    ends = [
        (end, False) if row.get(column) in (None, "") else place_of(row[column])
        for column, end in (("from", 0.0), ("to", np.inf))
    ]
    place = str(row.get("place") or "")
    if place not in ("", *PLACES):
        raise _bad("weld-place", "the place cannot be read", place, "write shop or field")
    prep = prep_of(row["prep"]) if row.get("prep") else None
    if prep is not None and (found := own_findings(prep, prep.name)):
        raise BendTorsionError(found)
    return EdgeTreatment(
        str(row["seam"]),
        ends[0][0],
        ends[1][0],
        prep,
        place,
        str(row.get("ndt") or ""),
        ends[0][1],
        ends[1][1],
    )


READERS = {
    "Edges": edge_of,
    "Diaphragms": diaphragm_of,
    "Openings": opening_of,
    "Marks": mark_of,
    "Pieces": piece_of,
}
"""What reads a row of each table."""


def material_of(text: object) -> Material:
    """The material of `name, density, E, fy`, density in kg/m3, E and fy in MPa."""
    name, *numbers = (part.strip() for part in str(text).split(","))
    try:
        density, e, fy = map(float, numbers)
    except ValueError:
        density = e = fy = -1.0
    if not name or not min(density, e, fy) > 0.0:
        mend = "write its name, density in kg/m3, E and fy in MPa: S355, 7850, 206000, 355"
        raise _bad("material", "the material cannot be read", str(text), mend)
    return Material(name, density * 1e-9, e, fy)


def material_text(name: str, density: float, e: float, fy: float) -> str:
    """The text of `material_of`; density in kg/mm3."""
    return f"{name}, {density * 1e9!r}, {e!r}, {fy!r}"


def _bad(what: str, problem: str, value: str, mend: str) -> BendTorsionError:
    return BendTorsionError(error(f"part-{what}", what, problem, mend, value=value))
