# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which decimal mark the numbers typed as text in a schedule have, as the plain ones among them
show, and with it the reading of those that can mean two things, such as `320,101`."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from .schedule_cells import BadCell, text, two_ways
from .schedule_columns import SETTINGS, SHEETS, reads_numbers
from .schedule_headings import TITLE_ROWS, heading_name, heading_row

_NUMERAL = re.compile(r"(?<![\w.,，．+-])[+-]?[0-9０-９.,，．]+(?:[eE][+-]?[0-9]+)?(?![\w.,，．])")
_AMBIGUOUS = re.compile(r"[+-]?[1-9]\d{0,2}([.,])\d{3}")
_DECIMAL = re.compile(r"[+-]?\d*([.,])\d+([eE][+-]?\d+)?")
_GROUPED = re.compile(r"[+-]?\d{1,3}(?:(?:\.\d{3})+(,)|(?:,\d{3})+(\.))\d+")
_WORD = re.compile(r"[^\W\d_]")


@dataclass(frozen=True)
class DecimalMarks:
    """What the numbers of a file show. comma, point: the first number that has it for its decimal
    mark, with its place, empty without one; comma_groups, point_groups: whether it parts thousands
    in numbers with a decimal mark; semicolons: whether a CSV file has its cells parted by them, as
    spreadsheets write that have decimal commas."""

    comma: str = ""
    point: str = ""
    comma_groups: bool = False
    point_groups: bool = False
    semicolons: bool = False

    def plain(self, cell: str) -> str:
        """The text of a cell with its ambiguous numbers as the others are, with a decimal point.
        Raises BadCell where the file shows both marks or none."""
        parts, end = [], 0
        for found in _numerals(cell):
            parts += [cell[end : found.start()], self._plain(found[0])]
            end = found.end()
        return "".join([*parts, cell[end:]])

    def _plain(self, written: str) -> str:
        numeral = unicodedata.normalize("NFKC", written)
        ambiguous = _AMBIGUOUS.fullmatch(numeral)
        if not ambiguous:
            return written
        mark = ambiguous[1]
        own, other = (self.comma, self.point) if mark == "," else (self.point, self.comma)
        groups = self.comma_groups if mark == "," else self.point_groups
        as_decimal = own or mark == "," and self.semicolons
        if other and groups and not as_decimal:
            return numeral.replace(mark, "")
        # A point is a decimal mark unless the file shows another.
        if not other and (as_decimal or mark == "."):
            return numeral.replace(mark, ".")
        message = "the comma may be a decimal mark or part thousands"
        if mark == ".":
            message = "the point may be a decimal mark or part thousands"
        if self.comma and self.point:
            message = f"the file has both decimal marks: {self.comma}; {self.point}"
        elif other:
            message = f"the file has another decimal mark: {other}"
        raise BadCell("not-a-number", message, two_ways(numeral))


def decimal_marks(workbook, separators: Mapping[str, str]) -> DecimalMarks:
    """What the numbers typed as text in a schedule's sheets show; separators: what parts the cells
    of each sheet read from a CSV file."""
    shown: dict[str, str] = {}
    groups = set()
    for sheet in workbook.worksheets:
        for row, cell in _cells(sheet):
            for found in _numerals(cell):
                numeral = unicodedata.normalize("NFKC", found[0])
                grouped, decimal = _GROUPED.fullmatch(numeral), _DECIMAL.fullmatch(numeral)
                if _AMBIGUOUS.fullmatch(numeral) or not (grouped or decimal):
                    continue
                mark = (grouped[1] or grouped[2]) if grouped else decimal[1]
                shown.setdefault(mark, f"sheet {sheet.title}, row {row}: {found[0]}")
                if grouped:
                    groups.add("." if mark == "," else ",")
    return DecimalMarks(
        shown.get(",", ""),
        shown.get(".", ""),
        "," in groups,
        "." in groups,
        ";" in separators.values(),
    )


def holds_numbers(sheet: str, column, key) -> bool:
    """Whether cells of this column of a sheet are read as numbers, of Settings those of this
    key."""
    if sheet == "Settings" and column.name == "value":
        column = SETTINGS.get(text(key)) if key is not None else None
    return column is not None and reads_numbers(column)


def _cells(sheet) -> Iterator[tuple[int, str]]:
    """Row and text of the cells of a sheet in which numbers are typed as text."""
    declared = {column.name: column for column in SHEETS.get(sheet.title, ())}
    if not declared:
        return
    above = [[cell.value for cell in row] for row in sheet.iter_rows(max_row=TITLE_ROWS)]
    top = heading_row(above, declared)
    names = {}
    for index, value in enumerate(above[top - 1] if above else (), start=1):
        if value is not None:
            names.setdefault(heading_name(value, declared), index)
    columns = {index: declared[name] for name, index in names.items() if name in declared}
    for (row, index), cell in list(sheet._cells.items()):
        if row > top and index in columns and isinstance(cell.value, str):
            key = sheet.cell(row, names["key"]).value if "key" in names else None
            if holds_numbers(sheet.title, columns[index], key):
                yield row, cell.value


def _numerals(cell: str) -> Iterator[re.Match]:
    """The numbers in a cell; in one with words those of `key=number` alone: others may belong to a
    name."""
    worded = _WORD.search(re.sub(r"[eE][+-]?\d", "", cell))
    for found in _NUMERAL.finditer(cell):
        if not worded or cell[: found.start()].rstrip().endswith("="):
            yield found
