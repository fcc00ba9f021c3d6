# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stock: the plate sizes a shop has or orders, by thickness and grade.

Plates lie along the rolling direction, so a plate fits a sheet that is as long and as wide.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from ..finding import BendTorsionError, error

_NUMBER = r"[0-9]+(?:\.[0-9]+)?"
_THICKNESS = re.compile(rf"(?<!\S)({_NUMBER})(?:\s*mm)?(?!\S)", re.IGNORECASE)
_SIZE = re.compile(rf"({_NUMBER})\s*[x×*]\s*({_NUMBER})", re.IGNORECASE)
SMALLEST, LARGEST = 200.0, 50000.0
"""mm; sides of a sheet."""


@dataclass(frozen=True)
class StockSheet:
    """A sheet length by width, mm, of a thickness (None: of any) and a grade (empty: of any)."""

    length: float
    width: float
    thickness: float | None = None
    grade: str = ""


def stock_of(words: object) -> tuple[StockSheet, ...]:
    """The sheets of `12000x2500; 16 10000x2000; 30 S460 8000x2200`: before the size a thickness,
    a grade, both or none. Raises BendTorsionError for what is none of these."""
    sheets = []
    for part in filter(None, (part.strip() for part in re.split(r"[;\n]", str(words or "")))):
        size = _SIZE.search(part)
        before = part[: size.start()].replace(",", " ") if size else ""
        numbers = _THICKNESS.findall(before)
        grades = _THICKNESS.sub(" ", before).split()
        if not size or part[size.end() :].strip() or len(numbers) > 1 or len(grades) > 1:
            raise _unread(part)
        length, width = float(size[1]), float(size[2])
        thickness = float(numbers[0]) if numbers else None
        if not SMALLEST <= width <= length <= LARGEST or thickness == 0.0:
            raise _unread(part)
        sheets.append(StockSheet(length, width, thickness, grades[0] if grades else ""))
    return tuple(sheets)


def _unread(part: str) -> BendTorsionError:
    return BendTorsionError(
        error(
            "stock",
            "stock",
            "the stock cannot be read",
            "write length x width in mm, before it a thickness, a grade or both where it is theirs "
            "alone: 12000x2500; 16 10000x2000; 30 S460 8000x2200",
            value=part,
        )
    )


def sheets_for(stock: Sequence[StockSheet], thickness: float, grade: str) -> tuple[StockSheet, ...]:
    """The sheets of a thickness and grade: those that name both, else the thickness, else the
    grade, else those that name neither."""
    own = [
        sheet
        for sheet in stock
        if sheet.thickness in (None, thickness) and sheet.grade in ("", grade)
    ]
    closest = max((_named(sheet) for sheet in own), default=0)
    return tuple(sheet for sheet in own if _named(sheet) == closest)


def _named(sheet: StockSheet) -> int:
    return 2 * (sheet.thickness is not None) + bool(sheet.grade)


def longest(sheets: Sequence[StockSheet]) -> StockSheet:
    """The longest sheet, of as long ones the widest."""
    return max(sheets, key=lambda sheet: (sheet.length, sheet.width))


def smallest_for(sheets: Sequence[StockSheet], length: float, width: float) -> StockSheet | None:
    """The sheet of least area a plate can be cut from, None where there is none."""
    fitting = [sheet for sheet in sheets if length <= sheet.length and width <= sheet.width]
    return min(fitting, key=lambda s: (s.length * s.width, s.length), default=None)
