# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a sheet: its frame and its title block, and figures with their units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ... import __version__
from ..lofting import MemberRecord
from .sheet import Polyline, Sheet, Table, Text, View, shortened, text_width, wrapped
from .sheet_style import TITLE_ROW, TITLE_WIDTH, SheetStyle, fixed
from .sheet_symbols import projection_symbol

SIGNED_CELLS = ("drawn", "checked", "approved", "date", "revision")
TEXT, LARGE = 1.8, 2.5
PROJECTION_CELL = 34.0
MEMBER_LABELS = ("member", "sections", "plates on this sheet", "member mass (net)")


@dataclass(frozen=True)
class Page:
    """A page before it has its number and title block. lists_plates: whether it has rows of the
    list of a member's plates."""

    heading: str
    marks: tuple[str, ...] = ()
    scale: str = "–"
    views: tuple[View, ...] = ()
    lines: tuple[Polyline, ...] = ()
    texts: tuple[Text, ...] = ()
    tables: tuple[Table, ...] = ()
    lists_plates: bool = False


@dataclass(frozen=True)
class Subject:
    """What a set of sheets is about, as its title blocks say: name of the member or the project's
    general arrangement, its sections, materials and net mass. labels: of name, sections, marks and
    mass in the title block. code: before the number of each drawing; the name without one."""

    name: str
    sections: str
    material: str
    mass: float | None
    labels: tuple[str, str, str, str] = MEMBER_LABELS
    code: str = ""


def subject_of(record: MemberRecord) -> Subject:
    """The subject of a member's sheets."""
    materials = ", ".join(dict.fromkeys(p.material for p in record.plates if p.material))
    return Subject(record.member, record.sections, materials, record.mass)


def finished(page: Page, subject: Subject, style: SheetStyle, number: int, of: int) -> Sheet:
    """The page with its frame, title block and number."""
    say, form = style.say, style.page
    marks_width = TITLE_WIDTH - PROJECTION_CELL
    units = say("mm") if style.unit == "mm" else say("ft-in; tables in; t: in (mm)")
    name, sections, marks, mass = style.headings(subject.labels)
    rows = (
        (
            (say("project"), style.project, 90.0),
            (say("drawing"), f"{subject.code or subject.name}-{number:02d}", 40.0),
            (say("sheet"), f"{number} / {of}", 25.0),
            (say("scale"), page.scale, 25.0),
        ),
        (
            (name, subject.name, 40.0),
            (sections, subject.sections, 80.0),
            (say("content"), page.heading, 60.0),
        ),
        (
            (marks, _marks_text(page.marks, marks_width, style), marks_width),
            (say("projection"), "", PROJECTION_CELL),
        ),
        (
            (say("material"), subject.material, 62.0),
            (mass, with_unit(subject.mass, 1, "kg"), 36.0),
            (say("units"), units, 36.0),
            (say("software"), f"BendTorsion {__version__}", 46.0),
        ),
        tuple((say(name), style.author if name == "drawn" else "", 36.0) for name in SIGNED_CELLS),
    )
    lines, texts = _title_block(rows, style)
    left, bottom, right, top = form.frame
    frame = Polyline(
        ((left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)), "wide"
    )
    fields = tuple((label, value) for row in rows for label, value, _ in row if value)
    return Sheet(
        f"{subject.name} {page.heading}",
        number,
        of,
        form.width,
        form.height,
        form.frame,
        page.views,
        (frame, *lines, *page.lines),
        (*texts, *page.texts),
        page.tables,
        fields,
    )


def _title_block(rows, style: SheetStyle) -> tuple[list[Polyline], list[Text]]:
    left, bottom, right, top = style.page.title_block
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
            texts += _value_texts(value, x + 1.2, y, width - 2.4)
            x += width
    middle = (right - 9.2, top - 2.5 * TITLE_ROW)
    lines += projection_symbol(middle, style.first_angle)
    return lines, texts


def _value_texts(value: str, x: float, y: float, room: float) -> list[Text]:
    """A value under its label in a cell whose top is y: as large as there is room for, in two lines
    when one is too short."""
    if not value:
        return []
    if text_width(value, LARGE) <= room:
        return [Text(x, y - TITLE_ROW + 1.5, LARGE, value)]
    if text_width(value, TEXT) <= room:
        return [Text(x, y - TITLE_ROW + 1.5, TEXT, value)]
    first, *rest = wrapped(value, TEXT, room)
    second = shortened(" ".join(rest), TEXT, room)
    return [Text(x, y - 5.35, TEXT, first), Text(x, y - 7.85, TEXT, second)]


def _marks_text(marks: Sequence[str], width: float, style: SheetStyle) -> str:
    """Marks one by one, as runs of a prefix when they are many, else how many there are."""
    if len(marks) <= 12:
        return ", ".join(marks)
    text = _spanned(marks, style.say("to"))
    fits = len(wrapped(text, TEXT, width - 2.4)) <= 2
    return text if fits else style.say("{}, see the list", len(marks))


def _spanned(marks: Sequence[str], to: str) -> str:
    """Many marks as `M1-T1 to M1-T5` per run of the same prefix."""
    runs: dict[str, list[str]] = {}
    for mark in marks:
        runs.setdefault(mark.rstrip("0123456789"), []).append(mark)
    return ", ".join(r[0] if len(r) == 1 else f"{r[0]} {to} {r[-1]}" for r in runs.values())


def with_unit(value: float | None, digits: int, unit: str, factor: float = 1.0) -> str:
    """A figure times `factor` with its unit; a dash when there is none."""
    return "–" if value is None else f"{fixed(value * factor, digits)} {unit}"
