# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sheets as SVG text: whole pages in millimetres, and the parts other renderers embed."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Iterable
from pathlib import Path
from xml.sax.saxutils import escape

from ..core.drawings.sheet import (
    CAP_HEIGHT,
    CJK_FAMILIES,
    FONT_FAMILY,
    LINE_STYLES,
    Polyline,
    Sheet,
    Text,
)

GROUP = 8
FINE = 100.0


def svg_text(sheet: Sheet) -> str:
    """The whole sheet as an SVG document, 1 user unit = 1 mm, text as text."""
    lines = [*(line for view in sheet.views for line in view.on_page()), *sheet.all_lines()]
    return svg_document(sheet, lines, sheet.all_texts(), "mm")


def write_svg(sheet: Sheet, path: str | Path) -> None:
    """Write one sheet as SVG; the file appears whole or not at all. OSError when it cannot."""
    write_picture(path, svg_text(sheet).encode("utf-8"))


def write_picture(path: str | Path, content: bytes) -> None:
    """Write a file whole or not at all. OSError when it cannot."""
    path = Path(path)
    handle, temporary = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def svg_document(
    sheet: Sheet,
    lines: Iterable[Polyline],
    texts: Iterable[Text],
    unit: str,
    per_mm: float = 1.0,
    joined: bool = False,
) -> str:
    """Lines and texts (page mm) as an SVG of the sheet's size; `per_mm` size units make a mm.
    joined: all lines of a style as one path, for readers that take their time with each element,
    and letters in units of 0.01 mm, for those that round their size down to whole units (Qt 6)."""
    drawn = _paths(lines, sheet.height) if joined else [_line(line, sheet.height) for line in lines]
    per_unit = FINE if joined else 1.0
    size = _size(sheet.width, sheet.height, unit, per_mm)
    return "\n".join(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<svg xmlns="http://www.w3.org/2000/svg" version="1.1" {size} '
            f'viewBox="0 0 {_number(sheet.width)} {_number(sheet.height)}" xml:space="preserve">',
            f'<g fill="none" stroke="#000000" stroke-linecap="round" stroke-linejoin="round" '
            f'font-family="{", ".join((FONT_FAMILY, *CJK_FAMILIES))}, sans-serif">',
            *_grouped(drawn),
            f'<g fill="#000000" stroke="none"{_scaled(1.0 / per_unit)}>',
            *_grouped([_text(text, sheet.height, per_unit) for text in texts if text.text.strip()]),
            "</g>",
            "</g>",
            "</svg>",
            "",
        ]
    )


def sized_anew(svg: str, unit: str, per_mm: float = 1.0) -> str:
    """An SVG of svg_document with its size in another unit; any other text as it is."""

    def size(found: re.Match) -> str:
        return f"{_size(float(found[2]), float(found[3]), unit, per_mm)} {found[1]}"

    box = r'width="[^"]*" height="[^"]*" (viewBox="0 0 ([0-9.]+) ([0-9.]+)")'
    return re.sub(box, size, svg, count=1)


def _size(width: float, height: float, unit: str, per_mm: float) -> str:
    return f'width="{_number(width * per_mm)}{unit}" height="{_number(height * per_mm)}{unit}"'


def _grouped(elements: list[str]) -> list[str]:
    # TechDraw's search of a symbol takes time with the square of the siblings: 2 s for 2000.
    while len(elements) > GROUP:
        elements = [
            "\n".join(["<g>", *elements[start : start + GROUP], "</g>"])
            for start in range(0, len(elements), GROUP)
        ]
    return elements


def _paths(lines: Iterable[Polyline], page_height: float) -> list[str]:
    by_style: dict[str, list[str]] = {}
    for line in lines:
        points = "L".join(f"{_number(x)},{_number(page_height - y)}" for x, y in line.points)
        by_style.setdefault(line.style, []).append(f"M{points}")
    return [
        f'<path d="{"".join(parts)}" stroke-width="{_number(LINE_STYLES[style][0])}"'
        f"{_dashes(style)}/>"
        for style, parts in by_style.items()
    ]


def _dashes(style: str) -> str:
    dashes = LINE_STYLES[style][1]
    return f' stroke-dasharray="{",".join(_number(d) for d in dashes)}"' if dashes else ""


def _line(line: Polyline, page_height: float) -> str:
    width = LINE_STYLES[line.style][0]
    points = " ".join(f"{_number(x)},{_number(page_height - y)}" for x, y in line.points)
    dash = _dashes(line.style)
    return f'<polyline points="{points}" stroke-width="{_number(width)}"{dash}/>'


def _scaled(factor: float) -> str:
    return "" if factor == 1.0 else f' transform="scale({_number(factor)})"'


def _text(text: Text, page_height: float, scale: float) -> str:
    x, y = _number(scale * text.x), _number(scale * (page_height - text.y))
    turn = f' transform="rotate({_number(-text.angle)} {x} {y})"' if text.angle else ""
    # Each attribute takes TechDraw's search time: what all texts share stands in their group.
    anchor = "" if text.anchor == "start" else f' text-anchor="{text.anchor}"'
    return (
        f'<text x="{x}" y="{y}" font-size="{_number(scale * text.height / CAP_HEIGHT)}"'
        f"{anchor}{turn}>{escape(text.text)}</text>"
    )


def _number(value: float) -> str:
    text = f"{value:.4f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
