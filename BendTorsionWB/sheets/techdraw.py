# SPDX-License-Identifier: LGPL-2.1-or-later
"""A sheet on a TechDraw page: its views as one part view, all else as one symbol view.

The outlines of a page are wires laid out as on paper, times the page's scale, together with the
frame. The frame bounds everything, so the view, which TechDraw centres on the bounding box of its
source, always belongs at the middle of the frame.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..core.sheet import LINE_STYLES, Sheet
from .svg import svg_document

TEMPLATE = Path(__file__).resolve().parents[2] / "resources" / "templates" / "A3_landscape.svg"
PIXELS_PER_MM = 96.0 / 25.4  # FreeCAD with Qt 5 takes a symbol's size in pixels of 1/96 inch


def template_path() -> str:
    """The product's own A3 landscape template: centring marks and the fields filled in by hand."""
    return str(TEMPLATE)


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


def symbol_svg(sheet: Sheet) -> str:
    """The SVG of the symbol view that covers the page: labels, tables, title block, line weights.

    FreeCAD 0.20 draws every edge of a part view as an unbroken hairline, so the lines of views that
    are wide or dashed are drawn over it here.
    """
    lines = [line for line in _view_lines(sheet) if line.style != "narrow"]
    lines += sheet.all_lines()
    return svg_document(sheet, lines, sheet.all_texts(), "", PIXELS_PER_MM)


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
