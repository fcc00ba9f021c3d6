# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a member's sheets: its frame, its title block, and how figures are written."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from .. import __version__
from .lofting import MemberRecord
from .sheet import Polyline, Sheet, Table, Text, View, text_width, wrapped

PAGE = (420.0, 297.0)
FRAME = (20.0, 10.0, 410.0, 287.0)  # ISO 5457: 20 mm filing margin, 10 mm elsewhere
LEFT, BOTTOM, RIGHT, TOP = FRAME[0] + 3.0, FRAME[1] + 3.0, FRAME[2] - 3.0, FRAME[3] - 3.0
TITLE_ROW = 8.4
TITLE_BLOCK = (230.0, 10.0, 410.0, 10.0 + 5 * TITLE_ROW)
SIGNED_CELLS = ("drawn", "checked", "approved", "date", "revision")
TEXT = 1.8


@dataclass(frozen=True)
class Page:
    """A page before it has its number and title block."""

    heading: str
    marks: tuple[str, ...] = ()
    scale: str = "–"
    views: tuple[View, ...] = ()
    lines: tuple[Polyline, ...] = ()
    texts: tuple[Text, ...] = ()
    tables: tuple[Table, ...] = ()


def finished(
    page: Page, record: MemberRecord, project: str, author: str, number: int, of: int
) -> Sheet:
    """The page with its frame, title block and number."""
    materials = ", ".join(dict.fromkeys(p.material for p in record.plates if p.material))
    marks = ", ".join(page.marks) if len(page.marks) <= 12 else _spanned(page.marks)
    mass = with_unit(record.mass, 1, "kg")
    rows = (
        (
            ("project", project, 110.0),
            ("sheet", f"{number} / {of}", 35.0),
            ("scale", page.scale, 35.0),
        ),
        (
            ("member", record.member, 40.0),
            ("sections", record.sections, 85.0),
            ("content", page.heading, 55.0),
        ),
        (("plates on this sheet", marks, 180.0),),
        (
            ("material", materials, 70.0),
            ("member mass (net)", mass, 40.0),
            ("units", "mm", 20.0),
            ("software", f"BendTorsion {__version__}", 50.0),
        ),
        tuple((name, author if name == "drawn" else "", 36.0) for name in SIGNED_CELLS),
    )
    lines, texts = _title_block(rows)
    left, bottom, right, top = FRAME
    frame = Polyline(
        ((left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)), "wide"
    )
    fields = tuple((label, value) for row in rows for label, value, _ in row if value)
    return Sheet(
        f"{record.member} {page.heading}",
        number,
        of,
        *PAGE,
        FRAME,
        page.views,
        (frame, *lines, *page.lines),
        (*texts, *page.texts),
        page.tables,
        fields,
    )


def _title_block(rows) -> tuple[list[Polyline], list[Text]]:
    left, bottom, right, top = TITLE_BLOCK
    lines = [Polyline(((left, bottom), (left, top), (right, top)), "medium")]
    texts = []
    for k, row in enumerate(rows):
        y = top - k * TITLE_ROW
        if k:
            lines.append(Polyline(((left, y), (right, y)), "narrow"))
        x = left
        for label, value, width in row:
            if x > left:
                lines.append(Polyline(((x, y), (x, y - TITLE_ROW)), "narrow"))
            texts.append(Text(x + 1.2, y - 2.7, 1.8, label))
            if value:
                height = 2.5 if text_width(value, 2.5) <= width - 2.4 else TEXT
                value = wrapped(value, height, width - 2.4)[0] if value else ""
                texts.append(Text(x + 1.2, y - TITLE_ROW + 1.5, height, value))
            x += width
    return lines, texts


def _spanned(marks: Sequence[str]) -> str:
    """Many marks as `M1-T1 … M1-T5` per run of the same prefix."""
    runs: dict[str, list[str]] = {}
    for mark in marks:
        runs.setdefault(mark.rstrip("0123456789"), []).append(mark)
    return ", ".join(r[0] if len(r) == 1 else f"{r[0]} to {r[-1]}" for r in runs.values())


def fixed(value: float, digits: int) -> str:
    """A figure with its digits, and no minus before zero."""
    text = f"{value:.{digits}f}"
    return text.removeprefix("-") if float(text) == 0.0 else text


def with_unit(value: float | None, digits: int, unit: str, factor: float = 1.0) -> str:
    """A figure times `factor` with its unit; a dash when there is none."""
    return "–" if value is None else f"{fixed(value * factor, digits)} {unit}"
