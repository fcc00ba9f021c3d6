# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sheet model: what is drawn on a page, before any renderer; and how wide text is.

Page coordinates are mm with the origin at the lower left corner of the paper, y up. Everything is
frozen, hashable and made of plain values, so a sheet can be stored as JSON and compared.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from functools import lru_cache

import numpy as np

# Width in mm, and dash lengths in mm, of each line style (ISO 128: wide, medium, narrow).
LINE_STYLES: dict[str, tuple[float, tuple[float, ...]]] = {
    "wide": (0.5, ()),
    "medium": (0.35, ()),
    "narrow": (0.18, ()),
    "dashed": (0.35, (3.0, 1.5)),
    "chain": (0.18, (7.0, 1.2, 0.8, 1.2)),
}
FONT_FAMILY = "DejaVu Sans"
CJK_FAMILIES = ("WenQuanYi Micro Hei", "Noto Sans CJK SC", "Droid Sans Fallback")
CAP_HEIGHT = 0.729  # of the em square in DejaVu Sans; a text's height is its capitals' height
DESCENT = 0.236
WIDTH_MARGIN = 1.02  # renderers round font sizes
ANCHORS = ("start", "middle", "end")

# Advance widths of the printable ASCII characters of DejaVu Sans, in thousandths of the em.
_ASCII_WIDTHS = tuple(
    int(width)
    for width in """
    318 401 460 838 636 950 780 275 390 390 500 838 318 361 318 337
    636 636 636 636 636 636 636 636 636 636 337 337 838 838 838 531
    1000 684 686 698 770 632 575 775 752 295 295 656 557 863 748 787
    603 787 695 635 611 732 684 989 685 611 685 390 337 390 838 500
    500 613 635 550 635 615 352 635 634 278 278 579 278 974 634 612
    635 635 411 521 392 634 592 818 592 592 525 636 337 636 838""".split()
)
_OTHER_WIDTHS = {"°": 500, "·": 318, "–": 500, "²": 401, "³": 401, "×": 838, "±": 838}

Point = tuple[float, float]


@dataclass(frozen=True)
class Polyline:
    """A run of straight segments. points: (x, y) mm; style: a key of LINE_STYLES."""

    points: tuple[Point, ...]
    style: str = "narrow"


@dataclass(frozen=True)
class View:
    """Geometry to scale. polylines in model mm; page = origin + model / scale (20 means 1:20)."""

    name: str
    scale: float
    origin: Point
    polylines: tuple[Polyline, ...]

    def on_page(self) -> tuple[Polyline, ...]:
        """The polylines in page mm."""
        (x0, y0), scale = self.origin, self.scale
        return tuple(
            Polyline(tuple((x0 + x / scale, y0 + y / scale) for x, y in line.points), line.style)
            for line in self.polylines
        )


@dataclass(frozen=True)
class Text:
    """One line of text. (x, y): the anchor on the base line; height: of capitals, mm;
    angle: degrees counter-clockwise; anchor: `start`, `middle` or `end` of the line."""

    x: float
    y: float
    height: float
    text: str
    angle: float = 0.0
    anchor: str = "start"


@dataclass(frozen=True)
class Table:
    """A ruled table. (x, y): upper left corner; align: `<`, `^` or `>` for each column."""

    x: float
    y: float
    widths: tuple[float, ...]
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    align: str
    row_height: float = 4.0
    text_height: float = 1.8

    @property
    def height(self) -> float:
        """Height of header and rows, mm."""
        return self.row_height * (len(self.rows) + 1)


@dataclass(frozen=True)
class Sheet:
    """One page. fields: (name, value) pairs of the title block, as data."""

    title: str
    number: int
    of: int
    width: float
    height: float
    frame: tuple[float, float, float, float]
    views: tuple[View, ...] = ()
    lines: tuple[Polyline, ...] = ()
    texts: tuple[Text, ...] = ()
    tables: tuple[Table, ...] = ()
    fields: tuple[tuple[str, str], ...] = ()

    def all_lines(self) -> tuple[Polyline, ...]:
        """Lines and table rules, without the views, in page mm."""
        return self.lines + tuple(rule for table in self.tables for rule in table_rules(table))

    def all_texts(self) -> tuple[Text, ...]:
        """Texts and table cells."""
        return self.texts + tuple(cell for table in self.tables for cell in table_texts(table))

    def as_dict(self) -> dict:
        """The sheet as plain JSON data."""
        return asdict(self)

    @staticmethod
    def from_dict(data: dict) -> Sheet:
        """The sheet of `as_dict`, also after a round trip through JSON."""
        values = {key: _frozen(value) for key, value in data.items()}
        values["views"] = tuple(
            View(view["name"], view["scale"], _frozen(view["origin"]), _polylines(view))
            for view in data["views"]
        )
        values["lines"] = _polylines({"polylines": data["lines"]})
        values["texts"] = tuple(Text(**text) for text in data["texts"])
        values["tables"] = tuple(
            Table(**{key: _frozen(value) for key, value in table.items()})
            for table in data["tables"]
        )
        return Sheet(**values)


def _polylines(view: dict) -> tuple[Polyline, ...]:
    return tuple(Polyline(_frozen(line["points"]), line["style"]) for line in view["polylines"])


def _frozen(value):
    return tuple(_frozen(item) for item in value) if isinstance(value, (list, tuple)) else value


@lru_cache(maxsize=65536)
def text_width(text: str, height: float) -> float:
    """Width in mm of `text` with capitals of `height` mm, never less than it will be drawn.

    Characters beyond the table count a full em, which also holds for Chinese.
    """
    total = sum(
        _ASCII_WIDTHS[ord(character) - 32]
        if " " <= character <= "~"
        else _OTHER_WIDTHS.get(character, 1000)
        for character in text
    )
    return WIDTH_MARGIN * total / 1000.0 * height / CAP_HEIGHT


def text_box(text: Text) -> np.ndarray:
    """The (4, 2) corners of the rectangle a text covers, descenders included, page mm."""
    width = text_width(text.text, text.height)
    left = -width * {"start": 0.0, "middle": 0.5, "end": 1.0}[text.anchor]
    low, right, high = -DESCENT / CAP_HEIGHT * text.height, left + width, text.height
    cos, sin = math.cos(math.radians(text.angle)), math.sin(math.radians(text.angle))
    return np.array(
        [
            (text.x + x * cos - y * sin, text.y + x * sin + y * cos)
            for x, y in ((left, low), (right, low), (right, high), (left, high))
        ]
    )


def boxes_overlap(first: np.ndarray, second: np.ndarray, clearance: float = 0.0) -> bool:
    """True when two convex polygons (n, 2) come closer than `clearance` mm.

    Separating axes; exact for parallel sides, on the safe side at corners.
    """
    # Rectangles mostly: plain numbers are faster than arrays of four.
    both = first.tolist(), second.tolist()
    for polygon in both:
        x0, y0 = polygon[-1]
        for x1, y1 in polygon:
            dx, dy = x1 - x0, y1 - y0
            length = math.hypot(dx, dy)
            x0, y0 = x1, y1
            if length > 0.0:
                x, y = dy / length, -dx / length
                a, b = ([px * x + py * y for px, py in points] for points in both)
                if max(min(a) - max(b), min(b) - max(a)) >= clearance:
                    return False
    return True


def overlapping_texts(texts: Iterable[Text]) -> list[tuple[Text, Text]]:
    """Pairs of texts that cover each other."""
    texts = [text for text in texts if text.text.strip()]
    if not texts:
        return []
    boxes = np.array([text_box(text) for text in texts])
    low, high = boxes.min(axis=1), boxes.max(axis=1)
    near = np.all((low[:, None] < high[None]) & (low[None] < high[:, None]), axis=2)
    first, second = np.nonzero(np.triu(near, 1))
    return [
        (texts[i], texts[j])
        for i, j in zip(first, second, strict=True)
        if boxes_overlap(boxes[i], boxes[j])
    ]


def outside_frame(sheet: Sheet, tolerance: float = 1e-6) -> list[Text | Polyline]:
    """Everything on the sheet that leaves its frame."""
    low, high = np.array(sheet.frame[:2]) - tolerance, np.array(sheet.frame[2:]) + tolerance
    items = [(line, np.array(line.points)) for line in sheet.all_lines()]
    items += [(line, np.array(line.points)) for view in sheet.views for line in view.on_page()]
    items += [(text, text_box(text)) for text in sheet.all_texts()]
    return [item for item, points in items if np.any(points < low) or np.any(points > high)]


def wrapped(text: str, height: float, width: float) -> list[str]:
    """`text` broken into lines at most `width` mm wide, at spaces and between Chinese characters,
    not before their closing marks; words wider than that are cut."""
    lines, line = [], ""
    for gap, word in _WORDS.findall(text.strip()):
        longer = f"{line}{' ' if gap and line else ''}{word}"
        if text_width(longer, height) <= width:
            line = longer
            continue
        if line:
            lines.append(line)
        while text_width(word, height) > width and len(word) > 1:
            cut = _fitting(word, height, width)
            lines.append(word[:cut])
            word = word[cut:]
        line = word
    return [*lines, line] if line else lines


_CHINESE = "\u2e80-\u9fff\uf900-\ufaff\uff00-\uffef"
_CLOSING = "，。；：、）！？”"
_WORDS = re.compile(rf"(\s*)([{_CHINESE}][{_CLOSING}]*|[^\s{_CHINESE}]+[{_CLOSING}]*)")
"""Words, and Chinese characters with the closing marks behind them; before them the space."""


def _fitting(line: str, height: float, width: float) -> int:
    return max(
        1, next((n for n in range(len(line), 0, -1) if text_width(line[:n], height) <= width), 1)
    )


def shortened(text: str, height: float, width: float) -> str:
    """`text`, cut and ended with `..` when wider than `width` mm."""
    if text_width(text, height) <= width:
        return text
    return text[: _fitting(text, height, width - text_width("..", height))].rstrip() + ".."


def table_rules(table: Table) -> tuple[Polyline, ...]:
    """The ruling of a table: its border and header medium, rows and columns narrow."""
    right = table.x + sum(table.widths)
    bottom = table.y - table.height
    head = table.y - table.row_height
    rules = [
        Polyline(
            (
                (table.x, table.y),
                (right, table.y),
                (right, bottom),
                (table.x, bottom),
                (table.x, table.y),
            ),
            "medium",
        ),
        Polyline(((table.x, head), (right, head)), "medium"),
    ]
    for row in range(2, len(table.rows) + 1):
        y = table.y - row * table.row_height
        rules.append(Polyline(((table.x, y), (right, y)), "narrow"))
    for x in table.x + np.cumsum(table.widths[:-1]):
        rules.append(Polyline(((float(x), table.y), (float(x), bottom)), "narrow"))
    return tuple(rules)


def table_texts(table: Table) -> tuple[Text, ...]:
    """The cells of a table as texts, cut where wider than their column."""
    pad, height = 1.0, table.text_height
    lefts = [table.x + sum(table.widths[:column]) for column in range(len(table.widths))]
    cells = []
    for number, row in enumerate((table.header, *table.rows)):
        y = table.y - (number + 0.5) * table.row_height - height / 2
        for left, width, align, value in zip(lefts, table.widths, table.align, row, strict=True):
            if not value:
                continue
            x, anchor = {
                "<": (left + pad, "start"),
                "^": (left + width / 2, "middle"),
                ">": (left + width - pad, "end"),
            }[align]
            text = shortened(value, height, width - 1.6 * pad)
            cells.append(Text(x, y, height, text, anchor=anchor))
    return tuple(cells)
