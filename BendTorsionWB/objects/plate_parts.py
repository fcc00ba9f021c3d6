# SPDX-License-Identifier: LGPL-2.1-or-later
"""The properties of a PlateSet that hold diaphragms, openings, marks, pieces and welds: a
list per column.

All lists of a table are as long as its list of places; one left empty means its default in all
rows.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.core.part_tables import PART_COLUMNS, READERS
from BendTorsionWB.objects import given
from BendTorsionWB.objects.given import Given
from BendTorsionWB.objects.proxy import Property

_NUMBERS = "App::PropertyFloatList"
_TEXTS = "App::PropertyStringList"

# By table and column: property, its type and its tooltip.
_LISTS = {
    ("Diaphragms", "s"): (
        "DiaphragmPlaces",
        _TEXTS,
        "Where: mm from the start, a ratio such as 35%, or start and end for end plates",
    ),
    ("Diaphragms", "t"): ("DiaphragmThicknesses", _NUMBERS, "Thickness, mm"),
    ("Diaphragms", "gap"): (
        "DiaphragmGaps",
        _NUMBERS,
        "Gap to each wall, mm; of end plates to the outer faces, negative for an overhang",
    ),
    ("Diaphragms", "snipe"): ("DiaphragmSnipes", _NUMBERS, "Legs of the corners cut off, mm"),
    ("Diaphragms", "manhole"): (
        "DiaphragmManholes",
        _TEXTS,
        "Manhole: d=400, 400x600, 400x600 r=100; at 50 -100 moves it along breadth and height",
    ),
    ("Diaphragms", "closing_face"): (
        "DiaphragmClosings",
        _TEXTS,
        "Face closed last: top slot, top slot 100x24 @ 250, top weld, top weld 10",
    ),
    ("Diaphragms", "material"): (
        "DiaphragmMaterials",
        _TEXTS,
        "Name, density kg/m3, E MPa, fy MPa; empty: that of the walls",
    ),
    ("Openings", "face"): ("OpeningFaces", _TEXTS, "Face"),
    ("Openings", "s"): ("OpeningPlaces", _TEXTS, "Where: mm from the start, or a ratio like 35%"),
    ("Openings", "offset"): (
        "OpeningOffsets",
        _NUMBERS,
        "From the middle of the face towards its second edge, mm",
    ),
    ("Openings", "shape"): (
        "OpeningShapes",
        _TEXTS,
        "d=120, 200x100, 200x100 r=20 or slot 120x40; the first size along the member",
    ),
    ("Openings", "rotation"): (
        "OpeningRotations",
        _NUMBERS,
        "Turns the shape from the member's direction towards the second edge, degrees",
    ),
    ("Marks", "face"): ("MarkFaces", _TEXTS, "Face"),
    ("Marks", "s"): ("MarkPlaces", _TEXTS, "Where: mm from the start, or a ratio such as 35%"),
    ("Marks", "offset"): (
        "MarkOffsets",
        _NUMBERS,
        "From the middle of the face towards its second edge, mm",
    ),
    ("Marks", "text"): ("MarkTexts", _TEXTS, "punch, line 200, line 200 90deg, or a text"),
    ("Pieces", "piece"): ("PieceNumbers", _NUMBERS, "Number of each delivery piece, along +s"),
    ("Pieces", "from"): (
        "PieceStarts",
        _TEXTS,
        "Where it starts: mm or a ratio such as 35%; empty: where the one before ends",
    ),
    ("Pieces", "to"): (
        "PieceEnds",
        _TEXTS,
        "Where it ends; empty: where the next starts, or the member ends",
    ),
    ("Pieces", "start_end"): (
        "PieceStartForms",
        _TEXTS,
        "square, or stepped top=80 bottom=-80; empty: as the one before ends",
    ),
    ("Pieces", "end_end"): (
        "PieceEndForms",
        _TEXTS,
        "square, or stepped top=80 bottom=-80; empty: as the next starts",
    ),
    ("Pieces", "green_start"): ("PieceGreenStarts", _NUMBERS, "Green length at its start, mm"),
    ("Pieces", "green_end"): ("PieceGreenEnds", _NUMBERS, "Green length at its end, mm"),
    ("Pieces", "gap"): ("PieceGaps", _NUMBERS, "Field gap to the next piece, mm"),
    ("Edges", "seam"): (
        "EdgeSeams",
        _TEXTS,
        "Weld: a seam such as TL, a joint such as T1/T2, a node, a diaphragm such as D1; "
        "or joints, nodes, diaphragms, end plates for all of them",
    ),
    ("Edges", "from"): (
        "EdgeStarts",
        _TEXTS,
        "Where it starts: mm or a ratio such as 35%; empty: at the start of the member",
    ),
    ("Edges", "to"): ("EdgeEnds", _TEXTS, "Where it ends; empty: at the end of the member"),
    ("Edges", "prep"): (
        "EdgePreps",
        _TEXTS,
        "bevel angle=40 land=6 gap=2 inner backing=30x6; types square, bevel, v, double-bevel, "
        "double-v, fillet; empty: that of the rule pack",
    ),
    ("Edges", "place"): ("EdgePlaces", _TEXTS, "shop or field; empty: field where pieces meet"),
    ("Edges", "ndt"): ("EdgeTests", _TEXTS, "Non-destructive test; empty: the rule pack's"),
}

PROPERTIES = tuple(
    Property(kind, name, table, tooltip) for (table, _), (name, kind, tooltip) in _LISTS.items()
)


def given_parts(obj) -> dict[str, tuple]:
    """Diaphragms, openings, marks and pieces of a PlateSet, by the names of PlatesInput's fields.

    Raises BendTorsionError for lists of different lengths and words that mean nothing."""
    return {table.lower(): _read(obj, table) for table in PART_COLUMNS}


def set_parts(obj, table: str, rows: Sequence[Mapping[str, object]]) -> None:
    """Write rows (column -> value) of a table, Diaphragms … Pieces, into a PlateSet's lists."""
    for item in lists_of_rows(obj.Label, table, rows):
        setattr(obj, item.property, item.value)


def lists_of_rows(label: str, table: str, rows: Sequence[Mapping[str, object]]) -> list[Given]:
    """The lists of a PlateSet for rows (column -> value) of a table. Raises BendTorsionError, by
    row and column, for columns the table has not, numbers that are none and words that mean
    nothing."""
    rows = given.read(label, table.lower(), rows, given.rows)
    for k, row in enumerate(rows, start=1):
        given.read(label, f"{table.lower()} row {k}", row, given.mapping)
        given.refuse_unknown(label, row, PART_COLUMNS[table], f"column of {table.lower()}")
    lists = []
    for column in PART_COLUMNS[table]:
        name, kind, _ = _LISTS[table, column]
        values = [row.get(column) for row in rows]
        if all(value in (None, "", 0.0) for value in values):
            values = []
        elif kind == _NUMBERS:
            values = [
                given.read(label, f"{table.lower()} row {k} {column}", value, _number)
                for k, value in enumerate(values, start=1)
            ]
        else:
            values = [_cell_text(value) for value in values]
        lists.append(Given(name, table.lower(), values))
    columns = dict(zip(PART_COLUMNS[table], (item.value for item in lists), strict=True))
    _read_rows(label, table, columns, len(rows))
    return lists


def _cell_text(value: object) -> str:
    """A cell as text; a whole number alike, whether it comes as 1500 or as 1500.0."""
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    return "" if value is None else str(value)


def _number(value: object) -> float:
    """A cell as a number, 0 when empty; ValueError (message, mend)."""
    try:
        number = float(value or 0.0)
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise ValueError("is no number", "give a number")
    return number


def rows_of(obj, table: str) -> list[dict[str, object]]:
    """The rows of a table as `set_parts` takes them; what is at its default is left out."""
    lists = {column: list(getattr(obj, _LISTS[table, column][0])) for column in PART_COLUMNS[table]}
    return [
        {column: values[k] for column, values in lists.items() if values and values[k] != ""}
        for k in range(max(map(len, lists.values())))
    ]


def column_tips(table: str) -> list[str]:
    """What each column of a table means."""
    return [_LISTS[table, column][2] for column in PART_COLUMNS[table]]


def number_columns(table: str) -> list[str]:
    """The columns of a table that hold numbers."""
    return [column for column in PART_COLUMNS[table] if _LISTS[table, column][1] == _NUMBERS]


def _read(obj, table: str) -> tuple:
    lists = {
        column: (name, list(getattr(obj, name)))
        for column in PART_COLUMNS[table]
        for name in [_LISTS[table, column][0]]
    }
    # Every row has a place, or a number.
    key = "s" if "s" in lists else PART_COLUMNS[table][0]
    count = len(lists[key][1])
    for name, values in lists.values():
        if len(values) not in (0, count):
            raise BendTorsionError(
                error(
                    "list-length",
                    obj.Label,
                    f"{name} and {lists[key][0]} have different lengths",
                    "give every row a value, or leave the list empty for the default",
                    position=f"property {name}",
                    value=len(values),
                    limit=count,
                )
            )
    columns = {column: values for column, (_, values) in lists.items()}
    return _read_rows(obj.Label, table, columns, count)


def _read_rows(label: str, table: str, columns: Mapping[str, Sequence], count: int) -> tuple:
    """Rows of a table, a list per column (empty: its default in all), as the core takes them.
    Raises BendTorsionError by row for words that mean nothing."""
    rows = []
    for k in range(count):
        row = {column: values[k] if values else "" for column, values in columns.items()}
        try:
            rows.append(READERS[table](row))
        except BendTorsionError as problem:
            raise BendTorsionError(
                replace(f, object=label, message=f"{table}, row {k + 1}: {f.message}")
                for f in problem.findings
            ) from problem
        except ValueError as problem:
            raise BendTorsionError(
                error(
                    "part-row",
                    label,
                    f"{table}, row {k + 1}: a number is missing or cannot be read",
                    "fill in the row",
                    value=", ".join(f"{name} {cell}" for name, cell in row.items() if cell != ""),
                )
            ) from problem
    return tuple(rows)
