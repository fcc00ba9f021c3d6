# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a project's sheets are drawn: page format, standard, language, unit, title block."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace

from ..site import AT_ORIGIN, SiteDatum
from .sheet_terms import CHINESE

STANDARDS = ("ISO", "AWS")
"""ISO: first angle, weld symbols of ISO 2553 and GB/T 324; AWS: third angle, those of AWS A2.4."""
LANGUAGES = ("en", "zh")
LENGTH_UNITS = ("mm", "ft-in")
INCH_HEADINGS = {
    "t": "t, in (mm)",
    "sections": "sections, mm",
    "centre x, y, z": "centre x, y, z, in",
}
"""Headings that need their units on sheets in inches: sections are named by their millimetres."""
_FIGURE = re.compile(r"\d+(?:\.\d+)?")
_SHAPES = {"slot": "slot {}", "manhole": "manhole {}"}
"""Words before the sizes of an opening, with the label of the shape."""
TITLE_WIDTH, TITLE_ROW, TITLE_ROWS = 180.0, 8.4, 5
INCH = 25.4
SAME_THICKNESS = 0.01
"""mm; a plate nearer than this to whole sixteenths of an inch is rolled to them."""


@dataclass(frozen=True)
class PageFormat:
    """A page, mm: A4 upright, all others across."""

    name: str
    width: float
    height: float

    @property
    def frame(self) -> tuple[float, float, float, float]:
        """Left, bottom, right, top; ISO 5457: 20 mm filing margin, 10 mm elsewhere."""
        return (20.0, 10.0, self.width - 10.0, self.height - 10.0)

    @property
    def left(self) -> float:
        return self.frame[0] + 3.0

    @property
    def bottom(self) -> float:
        return self.frame[1] + 3.0

    @property
    def right(self) -> float:
        return self.frame[2] - 3.0

    @property
    def top(self) -> float:
        return self.frame[3] - 3.0

    @property
    def title_block(self) -> tuple[float, float, float, float]:
        """Left, bottom, right, top of the title block, in the lower right corner of the frame."""
        _, bottom, right, _ = self.frame
        return (right - TITLE_WIDTH, bottom, right, bottom + TITLE_ROWS * TITLE_ROW)

    @property
    def clear_bottom(self) -> float:
        """The lowest height clear of the title block all across the page."""
        return self.title_block[3] + 3.0

    @property
    def is_small(self) -> bool:
        """True when views and their tables do not go on one page."""
        return self.note_width < 120.0

    @property
    def note_width(self) -> float:
        """Width left of the title block, for notes; zero where there is none worth using."""
        width = self.title_block[0] - self.left - 5.0
        return width if width > 40.0 else 0.0


FORMATS = {
    page.name: page
    for page in (
        PageFormat("A4", 210.0, 297.0),
        PageFormat("A3", 420.0, 297.0),
        PageFormat("A2", 594.0, 420.0),
        PageFormat("A1", 841.0, 594.0),
        PageFormat("ARCH A", 12 * INCH, 9 * INCH),
        PageFormat("ARCH B", 18 * INCH, 12 * INCH),
        PageFormat("ARCH C", 24 * INCH, 18 * INCH),
        PageFormat("ARCH D", 36 * INCH, 24 * INCH),
    )
}


@dataclass(frozen=True)
class SheetStyle:
    """What all sheets of a project have in common. format: a key of FORMATS; standard, language,
    unit: of STANDARDS, LANGUAGES, LENGTH_UNITS; site: where the model lies."""

    project: str = ""
    author: str = ""
    format: str = "A3"
    standard: str = "ISO"
    language: str = "en"
    unit: str = "mm"
    site: SiteDatum = SiteDatum()

    @property
    def page(self) -> PageFormat:
        return FORMATS[self.format]

    @property
    def is_sited(self) -> bool:
        """True when the site's coordinates are not the model's own."""
        return replace(self.site, unit=AT_ORIGIN.unit) != AT_ORIGIN

    @property
    def first_angle(self) -> bool:
        """True when views from above lie below those from the front."""
        return self.standard == "ISO"

    def say(self, text: str, *values: object) -> str:
        """A label in the style's language, `{}` in it replaced by values. Words without a Chinese
        term, such as names, stay as they are."""
        if self.language == "zh":
            text = CHINESE.get(text, text)
        return text.format(*values) if values else text

    def said(self, texts: tuple[str, ...]) -> tuple[str, ...]:
        """Several labels, such as the headings of a table."""
        return tuple(map(self.say, texts))

    def headings(self, names: tuple[str, ...]) -> tuple[str, ...]:
        """Several labels, those of INCH_HEADINGS with their units on sheets in inches."""
        inches = self.unit == "ft-in"
        return self.said(tuple(INCH_HEADINGS.get(n, n) for n in names) if inches else names)

    def length(self, value: float, digits: int = 1) -> str:
        """A length, mm, as it is written: with digits of a millimetre, or to 1/16 inch."""
        return feet_inches(value) if self.unit == "ft-in" else fixed(value, digits)

    def measure(self, value: float, digits: int = 1) -> str:
        """A measure in a table, mm, with digits of a millimetre, or in decimal inches at least as
        fine: sixteenths would be coarser than what a table is there for."""
        return fixed(value / INCH, digits + 2) if self.unit == "ft-in" else fixed(value, digits)

    def fine(self, value: float) -> str:
        """A small size, mm, such as of a weld or a groove, with its first decimal; or in decimal
        inches at least as fine, as sixteenths may differ from it by a millimetre."""
        return f'{self.measure(value)}"' if self.unit == "ft-in" else fixed(value, 1)

    def thickness(self, value: float) -> str:
        """A plate's thickness, mm, in tables headed `t`. On sheets in inches a plate
        rolled to a fraction is told by it, `5/8`; one rolled in millimetres by decimal inches with
        its millimetres, by which it is ordered, in brackets: `0.630 (16)`."""
        if self.unit == "mm":
            return f"{value:g}"
        sixteenths = round(value / INCH * 16.0)
        if sixteenths and abs(value - sixteenths * INCH / 16.0) < SAME_THICKNESS:
            return feet_inches(value, foot=False).removesuffix('"')
        return f"{fixed(value / INCH, 3)} ({value:g})"

    @property
    def thickness_unit(self) -> str:
        """The unit of `thickness`."""
        return "in (mm)" if self.unit == "ft-in" else "mm"

    def plate(self, thickness: float) -> str:
        """A thickness with its units, as plates are ordered: `16 mm`, `5/8"`, `0.630" (16 mm)`."""
        if self.unit == "mm":
            return f"{thickness:g} mm"
        inches, bracket, metric = self.thickness(thickness).partition(" (")
        return f'{inches}" ({metric.removesuffix(")")} mm)' if bracket else f'{inches}"'

    def shape(self, title: str) -> str:
        """The shape of an opening, such as `slot 120x40`, `manhole D400`, or sizes such as `30x6`,
        as sheets write them: with decimal inches for its millimetres."""
        kind = next((own for own in _SHAPES if title.startswith(f"{own} ")), "")
        sizes = title.removeprefix(f"{kind} ")
        if self.unit == "ft-in":
            sizes = _FIGURE.sub(lambda figure: self.fine(float(figure[0])), sizes)
        return self.say(_SHAPES[kind], sizes) if kind else sizes

    @property
    def measured_in(self) -> str:
        """The unit of measures in tables."""
        return "in" if self.unit == "ft-in" else "mm"

    def size(self, length: float, width: float) -> str:
        """Length and width of a plate with their unit."""
        unit = "" if self.unit == "ft-in" else " mm"
        return f"{self.length(length)} × {self.length(width)}{unit}"

    def with_unit(self, value: float | None, digits: int = 1) -> str:
        """A length with its unit; a dash when there is none."""
        if value is None:
            return "–"
        return self.length(value, digits) + ("" if self.unit == "ft-in" else " mm")

    @property
    def told_length(self) -> Callable[[float], str] | None:
        """What writes the lengths of findings beside mm; None where sheets are in mm."""
        return _told_inches if self.unit == "ft-in" else None


PLAIN_STYLE = SheetStyle()


def feet_inches(value: float, foot: bool = True) -> str:
    """A length, mm, in feet, inches and sixteenths: `12'-3 1/16"`, below a foot, and without
    `foot`, `3 1/2"`."""
    sixteenths = int(abs(value) / INCH * 16.0 + 0.5)
    feet, rest = divmod(sixteenths, 192) if foot else (0, sixteenths)
    inches, part = divmod(rest, 16)
    whole = 16
    while part and part % 2 == 0:
        part, whole = part // 2, whole // 2
    text = f"{feet}'-{inches}" if feet else f"{inches}"
    if part:
        text = f"{text} {part}/{whole}" if feet or inches else f"{part}/{whole}"
    return ("-" if value < 0.0 and sixteenths else "") + text + '"'


def _told_inches(value: float) -> str:
    fine = abs(value) < INCH / 16.0
    return f'{value / INCH:.4g}"' if fine else feet_inches(value)


def fixed(value: float, digits: int) -> str:
    """A figure with its digits, and no minus before zero."""
    text = f"{value:.{digits}f}"
    return text.removeprefix("-") if float(text) == 0.0 else text
