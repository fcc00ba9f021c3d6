# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables as an xlsx file: one sheet each, ready to filter and print, the same bytes every time.

Written directly because the usual library takes ten times as long for the tables of a building
and stamps the time into every file. Rows hold their texts and tell no numbers of their own, so that
those of each member can be made and packed by themselves (`row_block`), kept, and put together.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from xml.sax.saxutils import escape, quoteattr

from .zip_parts import Packed, packed, zip_bytes

TEXT = "@"
WHOLE = "0"
TENTH = "0.0"
HUNDREDTH = "0.00"
FINE = "0.0000"
STRAIN = "0.00E+00"

_FORMATS = (WHOLE, TENTH, FINE, STRAIN, HUNDREDTH)
_A3, _A4 = 8, 9  # paper sizes as numbered in the format
_WIDEST_ON_A4 = 200.0  # characters; wider tables are too small to read there
_WIDEST_UPRIGHT = 100.0  # characters that are as large on A4 upright, with half as many pages
_HEADER_STYLE = 1
_TEXT_STYLE = 2
_QUOTED_STYLE = 3  # text that looks like a formula stays text when the cell is edited
_FIRST_NUMBER_STYLE = 4
_FORMULA_STARTS = ("=", "+", "-", "@", "\t", "\r")
_NOT_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_DOCUMENT = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_LONGEST_TITLE = 80  # characters; a footer has at most 255 in all
_HEAD = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n'


@dataclass(frozen=True)
class Column:
    """A column: its machine-readable name, number format, width in characters, and unit. The cell
    of the heading holds the name alone; its number format shows the unit behind it."""

    name: str
    format: str = TENTH
    width: float = 12.0
    unit: str = ""


@dataclass(frozen=True)
class RowBlock:
    """Rows of a table made before: how many, and their text, packed."""

    count: int
    packed: Packed


@dataclass(frozen=True)
class Table:
    """A sheet: header row, rows of str, int, float or None; rows below the table as `notes`.

    NaN and infinite numbers are left empty. `notes` begin one row below the table and are not
    part of its filter. blocks: rows that stand before the others.
    """

    name: str
    columns: Sequence[Column]
    rows: Iterable[Sequence]
    notes: Sequence[Sequence] = ()
    blocks: Sequence[RowBlock] = ()


def xlsx_bytes(tables: Sequence[Table], title: str = "") -> bytes:
    """The xlsx file of `tables` in their order. Every text is a string cell, never a formula."""
    units = list(dict.fromkeys(c.unit for table in tables for c in table.columns if c.unit))
    sheets, heights = [], []
    for table in tables:
        parts, height = _sheet(table, units, title)
        sheets.append(parts)
        heights.append(height)
    return zip_bytes(
        (name, [packed(part) if isinstance(part, str) else part for part in parts])
        for name, parts in (
            ("[Content_Types].xml", [_content_types(len(tables))]),
            ("_rels/.rels", [_root_relations()]),
            ("docProps/core.xml", [_core(title)]),
            ("xl/workbook.xml", [_workbook(tables, heights, bool(title))]),
            ("xl/_rels/workbook.xml.rels", [_relations(len(tables))]),
            ("xl/styles.xml", [_styles(units)]),
            *((f"xl/worksheets/sheet{n}.xml", parts) for n, parts in enumerate(sheets, start=1)),
        )
    )


def row_block(table: Table) -> RowBlock:
    """The rows of a table, for a table of the same columns."""
    rows = _rows(table.rows, _number_styles(table))
    return RowBlock(len(rows), packed("".join(rows)))


def _sheet(
    table: Table, units: Sequence[str], title: str
) -> tuple[list[str | Packed], tuple[int, int]]:
    """XML of a sheet in parts, and the numbers of the last rows of the table and of the sheet."""
    letters = [_letters(index) for index in range(len(table.columns))]
    styles = _number_styles(table)
    heads = {"": _HEADER_STYLE}
    heads |= {unit: _FIRST_NUMBER_STYLE + len(_FORMATS) + k for k, unit in enumerate(units)}
    header = "".join(_text(column.name, heads[column.unit]) for column in table.columns)
    rows = _rows(table.rows, styles)
    last = 1 + sum(block.count for block in table.blocks) + len(rows)
    notes, number = _rows(table.notes, styles), last
    if notes:
        # The first tells its number: it leaves a row out.
        notes[0] = notes[0].replace("<row>", f'<row r="{last + 2}">', 1)
        number = last + 1 + len(notes)
    widths = "".join(
        f'<col min="{n}" max="{n}" width="{column.width:g}" customWidth="1"/>'
        for n, column in enumerate(table.columns, start=1)
    )
    area = f"A1:{letters[-1]}{last}"
    wide = sum(column.width for column in table.columns)
    paper = _A3 if wide > _WIDEST_ON_A4 else _A4
    turned = "portrait" if wide <= _WIDEST_UPRIGHT else "landscape"
    # A sign that codes begin with is doubled where it is meant.
    whose = f"{title[:_LONGEST_TITLE].replace('&', '&&')}: " if title else ""
    footer = f"&L{whose}&A&Crevision ______ by ______&R&P / &N"
    return [
        f'{_HEAD}<worksheet xmlns="{_MAIN}"><sheetPr><pageSetUpPr fitToPage="1"/></sheetPr>'
        f'<dimension ref="A1:{letters[-1]}{number}"/>'
        '<sheetViews><sheetView workbookViewId="0"><pane ySplit="1" topLeftCell="A2" '
        'activePane="bottomLeft" state="frozen"/><selection pane="bottomLeft" activeCell="A2" '
        'sqref="A2"/></sheetView></sheetViews><sheetFormatPr defaultRowHeight="15"/>'
        f'<cols>{widths}</cols><sheetData><row r="1">{header}</row>',
        *(block.packed for block in table.blocks if block.count),
        f"{''.join(rows)}{''.join(notes)}</sheetData>"
        f'<autoFilter ref="{area}"/>'
        '<printOptions gridLines="1"/>'
        '<pageMargins left="0.4" right="0.4" top="0.5" bottom="0.6" header="0.3" footer="0.3"/>'
        f'<pageSetup paperSize="{paper}" orientation="{turned}" fitToWidth="1" fitToHeight="0"/>'
        f"<headerFooter><oddFooter>{escape(_NOT_XML.sub(' ', footer))}</oddFooter></headerFooter>"
        "</worksheet>",
    ], (last, number)


def _number_styles(table: Table) -> list[int]:
    """The style of numbers in each column."""
    return [
        _FIRST_NUMBER_STYLE + _FORMATS.index(column.format) if column.format in _FORMATS else 0
        for column in table.columns
    ]


def _rows(rows: Iterable[Sequence], styles: Sequence[int]) -> list[str]:
    return [f"<row>{_cells(values, styles)}</row>" for values in rows]


def _cells(values: Sequence, styles: Sequence[int]) -> str:
    cells, left = [], 0
    for style, value in zip(styles, values):
        cell = ""
        if type(value) is float:
            # Most cells are numbers; infinite ones and none at all are left empty.
            if value - value == 0.0:
                cell = f'<c s="{style}"><v>{value!r}</v></c>'
        elif value is None or value == "":
            pass
        elif isinstance(value, str):
            cell = _text(value, _QUOTED_STYLE if value.startswith(_FORMULA_STARTS) else _TEXT_STYLE)
        elif isinstance(value, int):
            cell = f'<c s="{style}"><v>{int(value)}</v></c>'
        elif math.isfinite(value):
            cell = f'<c s="{style}"><v>{float(value)!r}</v></c>'
        # A cell without a place of its own stands beside the one before.
        if cell:
            cells.append("<c/>" * left + cell)
        left = 0 if cell else left + 1
    return "".join(cells)


@lru_cache(maxsize=4096)
def _text(text: str, style: int) -> str:
    # Members, marks and lines are named again and again.
    plain = escape(_NOT_XML.sub(" ", text))
    space = ' xml:space="preserve"' if plain != " ".join(plain.split()) else ""
    return f'<c s="{style}" t="inlineStr"><is><t{space}>{plain}</t></is></c>'


def _letters(index: int) -> str:
    letters = ""
    index += 1
    while index:
        index, rest = divmod(index - 1, 26)
        letters = chr(ord("A") + rest) + letters
    return letters


def _styles(units: Sequence[str]) -> str:
    custom = [format for format in _FORMATS if format != WHOLE]
    codes = "".join(
        f'<numFmt numFmtId="{n}" formatCode="{format}"/>'
        for n, format in enumerate(custom, start=164)
    )
    first = 164 + len(custom)
    codes += "".join(
        f'<numFmt numFmtId="{n}" formatCode="@&quot; ({escape(unit)})&quot;"/>'
        for n, unit in enumerate(units, start=first)
    )
    identity = {WHOLE: 1, **{format: n for n, format in enumerate(custom, start=164)}}
    plain = 'fontId="0" fillId="0" borderId="0" xfId="0"'
    cells = [
        f'<xf numFmtId="0" {plain}/>',
        '<xf numFmtId="0" fontId="1" fillId="2" borderId="0" xfId="0" applyFont="1" '
        'applyFill="1"/>',
        f'<xf numFmtId="49" {plain} applyNumberFormat="1"/>',
        f'<xf numFmtId="49" {plain} applyNumberFormat="1" quotePrefix="1"/>',
        *(
            f'<xf numFmtId="{identity[format]}" {plain} applyNumberFormat="1"/>'
            for format in _FORMATS
        ),
        *(
            f'<xf numFmtId="{n}" fontId="1" fillId="2" borderId="0" xfId="0" applyFont="1" '
            'applyFill="1" applyNumberFormat="1"/>'
            for n in range(first, first + len(units))
        ),
    ]
    count = len(custom) + len(units)
    return (
        f'{_HEAD}<styleSheet xmlns="{_MAIN}"><numFmts count="{count}">{codes}</numFmts>'
        '<fonts count="2"><font><sz val="10"/><name val="Arial"/></font>'
        '<font><b/><sz val="10"/><name val="Arial"/></font></fonts>'
        '<fills count="3"><fill><patternFill patternType="none"/></fill>'
        '<fill><patternFill patternType="gray125"/></fill><fill><patternFill patternType="solid">'
        '<fgColor rgb="FFD9E1EA"/><bgColor indexed="64"/></patternFill></fill></fills>'
        '<borders count="1"><border><left/><right/><top/><bottom/><diagonal/></border></borders>'
        '<cellStyleXfs count="1"><xf numFmtId="0" fontId="0" fillId="0" borderId="0"/>'
        f'</cellStyleXfs><cellXfs count="{len(cells)}">{"".join(cells)}</cellXfs>'
        '<cellStyles count="1"><cellStyle name="Normal" xfId="0" builtinId="0"/></cellStyles>'
        "</styleSheet>"
    )


def _workbook(tables: Sequence[Table], heights: Sequence[tuple[int, int]], areas: bool) -> str:
    sheets = "".join(
        f'<sheet name={quoteattr(table.name)} sheetId="{n}" r:id="rId{n}"/>'
        for n, table in enumerate(tables, start=1)
    )
    names = []
    for index, (table, (last, _)) in enumerate(zip(tables, heights)):
        column = _letters(len(table.columns) - 1)
        names.append(
            f'<definedName name="_xlnm._FilterDatabase" localSheetId="{index}" hidden="1">'
            f"'{table.name}'!$A$1:${column}${last}</definedName>"
        )
    # Not in workbooks without a title: rows are added to those by hand.
    for index, (table, (_, last)) in enumerate(zip(tables, heights) if areas else ()):
        column = _letters(len(table.columns) - 1)
        names.append(
            f'<definedName name="_xlnm.Print_Area" localSheetId="{index}">'
            f"'{table.name}'!$A$1:${column}${last}</definedName>"
        )
    for index, table in enumerate(tables):
        names.append(
            f'<definedName name="_xlnm.Print_Titles" localSheetId="{index}">'
            f"'{table.name}'!$1:$1</definedName>"
        )
    return (
        f'{_HEAD}<workbook xmlns="{_MAIN}" xmlns:r="{_DOCUMENT}"><bookViews><workbookView '
        'xWindow="0" yWindow="0" windowWidth="24000" windowHeight="12000"/></bookViews>'
        f"<sheets>{sheets}</sheets><definedNames>{''.join(names)}</definedNames></workbook>"
    )


def _relations(count: int) -> str:
    sheets = "".join(
        f'<Relationship Id="rId{n}" Type="{_DOCUMENT}/worksheet" Target="worksheets/sheet{n}.xml"/>'
        for n in range(1, count + 1)
    )
    return (
        f'{_HEAD}<Relationships xmlns="{_PACKAGE}/relationships">{sheets}'
        f'<Relationship Id="rId{count + 1}" Type="{_DOCUMENT}/styles" Target="styles.xml"/>'
        "</Relationships>"
    )


def _root_relations() -> str:
    return (
        f'{_HEAD}<Relationships xmlns="{_PACKAGE}/relationships">'
        f'<Relationship Id="rId1" Type="{_DOCUMENT}/officeDocument" Target="xl/workbook.xml"/>'
        f'<Relationship Id="rId2" Type="{_PACKAGE}/relationships/metadata/core-properties" '
        'Target="docProps/core.xml"/></Relationships>'
    )


def _core(title: str) -> str:
    return (
        f'{_HEAD}<cp:coreProperties xmlns:cp="{_PACKAGE}/metadata/core-properties" '
        'xmlns:dc="http://purl.org/dc/elements/1.1/">'
        f"<dc:title>{escape(_NOT_XML.sub(' ', title))}</dc:title></cp:coreProperties>"
    )


def _content_types(count: int) -> str:
    office = "application/vnd.openxmlformats-officedocument.spreadsheetml"
    sheets = "".join(
        f'<Override PartName="/xl/worksheets/sheet{n}.xml" ContentType="{office}.worksheet+xml"/>'
        for n in range(1, count + 1)
    )
    return (
        f'{_HEAD}<Types xmlns="{_PACKAGE}/content-types"><Default Extension="rels" '
        'ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
        '<Default Extension="xml" ContentType="application/xml"/>'
        f'<Override PartName="/xl/workbook.xml" ContentType="{office}.sheet.main+xml"/>{sheets}'
        f'<Override PartName="/xl/styles.xml" ContentType="{office}.styles+xml"/>'
        '<Override PartName="/docProps/core.xml" '
        'ContentType="application/vnd.openxmlformats-package.core-properties+xml"/></Types>'
    )
