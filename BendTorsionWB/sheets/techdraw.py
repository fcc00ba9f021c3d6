# SPDX-License-Identifier: LGPL-2.1-or-later
"""A sheet on a TechDraw page: its views as one part view, all else as one symbol view.

The outlines of a page are wires laid out as on paper, times the page's scale, together with the
frame. The frame bounds everything, so the view, which TechDraw centres on the bounding box of its
source, always belongs at the middle of the frame.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from ..core.drawings.sheet import (
    FONT_FAMILY,
    LINE_STYLES,
    WIDTH_MARGIN,
    Sheet,
    Text,
    text_width,
)
from ..core.drawings.sheet_page import SIGNED_CELLS
from ..core.drawings.sheet_style import FORMATS, TITLE_WIDTH, PageFormat
from .qt import qt_major
from .svg import sized_anew, svg_document

TEMPLATES = Path(__file__).resolve().parents[2] / "resources" / "templates" / "techdraw"
PIXELS_PER_MM = 96.0 / 25.4
LONGEST_PART = 40.0
"""mm of a line of text that the symbol of a page has in one piece."""


def template_path(sheet: Sheet) -> str:
    """The product's own template of the sheet's size: the fields filled in by hand."""
    for form in FORMATS.values():
        if (form.width, form.height) == (sheet.width, sheet.height):
            return str(TEMPLATES / f"{form.name.replace(' ', '_')}.svg")
    raise ValueError(f"there is no template of {sheet.width:g} x {sheet.height:g} mm")


def template_svg(form: PageFormat) -> str:
    """The template of a page format: empty fields in the signed cells of the title block."""
    left, bottom, _, _ = form.title_block
    cell = TITLE_WIDTH / len(SIGNED_CELLS)
    size = f"{form.width:g}", f"{form.height:g}"
    return "\n".join(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            "<!-- SPDX-License-Identifier: LGPL-2.1-or-later -->",
            '<svg xmlns="http://www.w3.org/2000/svg" '
            'xmlns:freecad="http://www.freecadweb.org/wiki/index.php?title=Svg_Namespace" '
            f'version="1.1" width="{size[0]}mm" height="{size[1]}mm" '
            f'viewBox="0 0 {size[0]} {size[1]}">',
            f'  <g font-family="{FONT_FAMILY}" font-size="3.43" fill="#000000" stroke="none">',
            *(
                f'    <text freecad:editable="{name}" x="{left + k * cell + 1.2:.1f}" '
                f'y="{form.height - bottom - 1.5:.1f}" xml:space="preserve"><tspan> </tspan></text>'
                for k, name in enumerate(SIGNED_CELLS)
            ),
            "  </g>",
            "</svg>",
            "",
        ]
    )


def sheet_scale(sheet: Sheet) -> float:
    """The one scale of the sheet's views (20 means 1:20); 1 without views."""
    scales = {view.scale for view in sheet.views}
    if len(scales) > 1:
        raise ValueError(f"sheet {sheet.number} has views at several scales: {sorted(scales)}")
    return scales.pop() if scales else 1.0


def view_edges(sheet: Sheet) -> list[np.ndarray]:
    """Polylines (n, 2) for the part view, mm: page coordinates times the sheet's scale.

    The frame comes first, then the unbroken lines of all views.
    """
    scale = sheet_scale(sheet)
    left, bottom, right, top = sheet.frame
    frame = ((left, bottom), (right, bottom), (right, top), (left, top), (left, bottom))
    polylines = [frame] + [
        line.points for line in _view_lines(sheet) if not LINE_STYLES[line.style][1]
    ]
    arrays = [np.array(points) * scale for points in polylines]
    return [line[_moving(line)] for line in arrays if np.ptp(line, axis=0).max() > 1e-6]


def symbol_svg(sheet: Sheet, alone: bool = False) -> str:
    """The SVG of the symbol view that covers the page: labels, tables, title block, line weights;
    alone: all there is to see.

    FreeCAD 0.20 draws every edge of a part view as an unbroken hairline, so the lines of views that
    are wide or dashed are drawn over it here.
    """
    lines = [line for line in _view_lines(sheet) if alone or line.style != "narrow"]
    lines += sheet.all_lines()
    texts = [part for text in sheet.all_texts() for part in _parts(text)]
    return svg_document(sheet, lines, texts, *_symbol_unit(), joined=True)


def _parts(text: Text) -> list[Text]:
    """A long level line in parts, each where it begins: the letters that Qt draws of an SVG drift
    from their places, by up to 1 % of a line."""
    if text.angle or text.anchor != "start" or text_width(text.text, text.height) < LONGEST_PART:
        return [text]
    words = text.text.split(" ")
    parts, begin = [], 0
    for end in range(1, len(words) + 1):
        longer = " ".join(words[begin : end + 1])
        if end == len(words) or text_width(longer, text.height) > LONGEST_PART:
            before = " ".join(["", *words[:begin], ""])[1:]
            x = text.x + text_width(before, text.height) / WIDTH_MARGIN
            parts.append(replace(text, x=x, text=" ".join(words[begin:end])))
            begin = end
    return parts


def _symbol_unit() -> tuple[str, float]:
    """Unit of a symbol's size, and how many make a millimetre on the page: with Qt 5 FreeCAD draws
    millimetres 6 % small and pixels at 1/96 inch; with Qt 6 pixels at 0.1 mm."""
    return ("mm", 1.0) if qt_major() >= 6 else ("", PIXELS_PER_MM)


def resized_symbol(svg: str) -> str:
    """A symbol of symbol_svg, perhaps of a document saved with another Qt, in this Qt's unit."""
    return sized_anew(svg, *_symbol_unit())


def configure_outline_view(view, source, sheet: Sheet) -> None:
    """Set a TechDraw::DrawViewPart to show `source` (the wires of view_edges) where it belongs."""
    view.Source = [source]
    view.Direction = (0.0, 0.0, 1.0)
    view.XDirection = (1.0, 0.0, 0.0)
    view.ScaleType = "Custom"  # before Scale, which is ignored otherwise
    view.Scale = 1.0 / sheet_scale(sheet)
    left, bottom, right, top = sheet.frame
    view.X, view.Y = (left + right) / 2.0, (bottom + top) / 2.0
    view.LockPosition = True


def configure_symbol(symbol, sheet: Sheet) -> None:
    """Set a TechDraw::DrawViewSymbol to cover the page at 1:1."""
    symbol.ScaleType = "Custom"
    symbol.Scale = 1.0
    symbol.X, symbol.Y = sheet.width / 2.0, sheet.height / 2.0
    symbol.LockPosition = True


def _view_lines(sheet: Sheet):
    return [line for view in sheet.views for line in view.on_page()]


def _moving(line: np.ndarray) -> np.ndarray:
    """False where a point repeats the one before it."""
    return np.concatenate([[True], np.abs(np.diff(line, axis=0)).max(axis=1) > 1e-6])
