# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drawing blocks, and how they are packed on pages: row by row, what belongs together kept so."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from .sheet import Polyline, Table, Text, View

GAP = 5.0


@dataclass(frozen=True)
class Block:
    """A laid out part of a page. box: (left, bottom, right, top), mm about its own origin;
    left_out: labels that found no room."""

    mark: str
    views: tuple[View, ...]
    lines: tuple[Polyline, ...]
    texts: tuple[Text, ...]
    box: tuple[float, float, float, float]
    tables: tuple[Table, ...] = ()
    left_out: int = 0

    @property
    def size(self) -> tuple[float, float]:
        """Width and height, mm."""
        left, bottom, right, top = self.box
        return right - left, top - bottom

    def moved(self, dx: float, dy: float) -> Block:
        """The block shifted on the page."""
        left, bottom, right, top = self.box
        return Block(
            self.mark,
            tuple(
                replace(view, origin=(view.origin[0] + dx, view.origin[1] + dy))
                for view in self.views
            ),
            tuple(
                Polyline(tuple((x + dx, y + dy) for x, y in line.points), line.style)
                for line in self.lines
            ),
            tuple(replace(text, x=text.x + dx, y=text.y + dy) for text in self.texts),
            (left + dx, bottom + dy, right + dx, top + dy),
            tuple(replace(table, x=table.x + dx, y=table.y + dy) for table in self.tables),
        )


class _Row:
    """A row of blocks under way: columns of blocks that stand one below the other."""

    def __init__(self, width: float):
        self.width = width
        self.columns: list[list[float]] = []  # x, width, used height
        self.height = 0.0

    def place(self, wide: float, high: float) -> tuple[float, float] | None:
        """Where a block goes, right and down from the row's corner; None when it has no room."""
        for column in self.columns:
            if wide <= column[1] + 1e-6 and column[2] + GAP + high <= self.height + 1e-6:
                down = column[2] + GAP
                column[2] = down + high
                return column[0], down
        x = self.columns[-1][0] + self.columns[-1][1] + GAP if self.columns else 0.0
        if self.columns and x + wide > self.width + 1e-6:
            return None
        self.columns.append([x, wide, high])
        self.height = max(self.height, high)
        return x, 0.0


def shelf_height(sizes: Sequence[tuple[float, float]], width: float) -> float:
    """Height of blocks of these sizes filled in row by row, low ones below one another."""
    y, row = 0.0, _Row(width)
    for size in sizes:
        if row.place(*size) is None:
            y, row = y + row.height + GAP, _Row(width)
            row.place(*size)
    return y + row.height


def filled(sizes: Sequence[tuple[float, float]], width: float) -> tuple[list, float]:
    """Where blocks of these sizes go, (right, down) of each, set one after another as high as they
    go and then as far left, GAP apart; and the height they take (bottom-left filling along the
    skyline)."""
    skyline = [(0.0, 0.0)]  # where each step starts, and how far down it is taken
    places, lowest = [], 0.0
    for wide, high in sizes:
        tried = []
        for start, _ in skyline:
            if start == 0.0 or start + wide <= width + 1e-6:
                ends = [x for x, _ in skyline[1:]] + [width]
                under = zip(skyline, ends, strict=True)
                down = max(d for (x, d), e in under if e > start and x < start + wide + GAP)
                tried.append((down, start))
        down, x = min(tried)
        places.append((x, down))
        lowest = max(lowest, down + high)
        end = x + wide + GAP
        after = [d for at, d in skyline if at <= end][-1]
        kept = [step for step in skyline if not x <= step[0] <= end]
        steps = [*kept, (x, down + high + GAP)]
        if end < width:
            steps.append((end, after))
        skyline = sorted(steps)
    return places, lowest


def packed(
    groups: Sequence[Sequence[Block]], area: tuple[float, float, float, float]
) -> list[list[Block]]:
    """The blocks of each page, filled in row by row into an area (left, bottom, right, top).

    Each group starts a row, and a page when it fits on one but not on what is left of the page.
    """
    left, bottom, right, top = area
    width, height = right - left, top - bottom
    pages: list[list[Block]] = []
    y, row = 0.0, _Row(width)
    for group in groups:
        high = shelf_height([block.size for block in group], width)
        y, row = y + (row.height + GAP if row.columns else 0.0), _Row(width)
        if not pages or (y > 0.0 and y + high > height and high <= height):
            pages.append([])
            y = 0.0
        for block in group:
            place = row.place(*block.size)
            if place is None:
                y, row = y + row.height + GAP, _Row(width)
                place = row.place(*block.size)
            if y > 0.0 and y + row.height > height + 1e-6:
                pages.append([])
                y = 0.0
                if len(row.columns) > 1:  # the row was made higher: this block opens the page
                    row = _Row(width)
                    place = row.place(*block.size)
            x, down = place
            pages[-1].append(block.moved(left + x - block.box[0], top - y - down - block.box[3]))
    return pages
