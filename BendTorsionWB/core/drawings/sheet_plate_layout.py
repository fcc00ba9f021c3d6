# SPDX-License-Identifier: LGPL-2.1-or-later
"""How plates and their tables share pages: in columns, in order, as large as there is room for."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..lofting import DevelopedPlate
from .sheet_overview import SCALES
from .sheet_pack import GAP, Block, filled
from .sheet_pattern import CAPTION_ROOM, CAPTION_ROW
from .sheet_tables import ROW_HEIGHT, TITLE_ROOM, Listing

STATION_ROOM = 16.0
"""mm on paper that station lines keep at least, where a choice of scale is left."""
MORE_PAGES = 1.25
"""Times the fewest pages any scale needs that a larger scale may cost."""
LABEL_ROOM = (28.0, 18.0)
"""mm; what labels and dimensions add to a pattern's width and height, about."""
LEAST_ROWS = 8
UNDIVIDED = 1.15
"""Times the height of a pattern that its tables may take beside it for being divided less."""
MOST_COLUMNS = 4
LEAST_COLUMN = 170.0
"""mm; columns of a page are made no narrower than this."""
COLUMN_GAP = 10.0

Size = tuple[float, float]


@dataclass(frozen=True)
class Column:
    """A column of a page: its place from the left, its width and height, mm."""

    left: float
    width: float
    height: float


def columns_of(area: tuple[float, float, float, float], count: int) -> list[Column]:
    """So many equal columns of an area (left, bottom, right, top)."""
    left, bottom, right, top = area
    width = (right - left - COLUMN_GAP * (count - 1)) / count
    return [Column(left + k * (width + COLUMN_GAP), width, top - bottom) for k in range(count)]


def column_counts(area: tuple[float, float, float, float]) -> range:
    """How many columns a page may have."""
    most = int((area[2] - area[0] + COLUMN_GAP) // (LEAST_COLUMN + COLUMN_GAP))
    return range(1, min(max(most, 1), MOST_COLUMNS) + 1)


def estimate(plate: DevelopedPlate, scale: float) -> Size:
    """About the size of a pattern's block, mm."""
    wide = max(plate.length / scale + LABEL_ROOM[0], CAPTION_ROOM)
    lines = 2 + math.ceil(400.0 / wide)
    return wide, plate.width / scale + LABEL_ROOM[1] + 6.0 + CAPTION_ROW * lines


def rows_beside(
    size: Size,
    listings: Sequence[Listing],
    column: Column,
    taken: float = 0.0,
    whole: bool = False,
) -> tuple[int, float]:
    """How many rows a table has at most, so that a pattern of this size takes the least height with
    its tables, and that height, mm; where they are more than a column of which so much is taken,
    as many as go below the pattern in it. whole: tables are cut as little as it allows."""
    counts = [(sum(listing.widths), len(listing.rows), listing) for listing in listings]
    longest = max((rows for _, rows, _ in counts), default=1)
    most = min(longest, int((column.height - TITLE_ROOM) // ROW_HEIGHT) - 1)
    found = []
    for cap in np.unique(np.geomspace(min(LEAST_ROWS, most), most, 12).astype(int)).tolist():
        sizes = [
            (wide, TITLE_ROOM + ROW_HEIGHT * (min(listing.most(cap), rows - start) + 1))
            for wide, rows, listing in counts
            for start in range(0, rows, listing.most(cap))
        ]
        found.append((filled([size, *sizes], column.width)[1], cap))
    least = min(high for high, _ in found)
    if taken + least > column.height:
        room = column.height - taken - size[1] - GAP - TITLE_ROOM
        below = int(room // ROW_HEIGHT) - 1
        return (below if LEAST_ROWS <= below < most else most), least
    # Whole tables rather than parts of them, where they are hardly higher.
    enough = column.height if whole else max(least + 1.0, UNDIVIDED * size[1])
    enough = min(enough, column.height)
    return max((cap, high) for high, cap in found if high <= enough)


def standing(
    groups: Sequence[Sequence[Block]],
    columns: Sequence[Column],
    top: float,
    divided: bool = False,
) -> tuple[list[Block], list[list[Block]]]:
    """The blocks of groups placed in columns hanging from a height, group by group and column by
    column, each group whole where a column holds it unless they may be divided; and what found no
    room."""
    placed: list[Block] = []
    rest = [list(group) for group in groups]
    for column in columns:
        y = 0.0
        while rest:
            own = rest[0]
            if any(block.views and block.size[0] > column.width + 1e-6 for block in own):
                break
            places, high = filled([block.size for block in own], column.width)
            count = len(own)
            if y + high > column.height + 1e-6:
                # One higher than any column is divided, its pattern not left without a table.
                if high <= column.height + 1e-6 and not divided:
                    break
                while count and y + high > column.height + 1e-6:
                    count -= 1
                    high = filled([b.size for b in own[:count]], column.width)[1]
                if not count or (y > 0.0 and count < 2):
                    break
            for block, (right, down) in zip(own[:count], places, strict=False):
                x = column.left + right - block.box[0]
                placed.append(block.moved(x, top - y - down - block.box[3]))
            del own[:count]
            y += high + GAP
            if own:
                break
            del rest[0]
    return placed, rest


class Fitting:
    """What plates need on a page, at any scale and in any number of columns, by estimate."""

    def __init__(
        self,
        plates: Sequence[DevelopedPlate],
        listings: dict[str, list[Listing]],
        area: tuple[float, float, float, float],
    ):
        self.plates, self.listings, self.area = plates, listings, area
        self.counts = column_counts(area)
        self._heights: dict[tuple[str, float, int], float] = {}

    def height(self, plate: DevelopedPlate, scale: float, count: int) -> float:
        """Of a plate with its tables in one of `count` columns; infinite where it is too wide."""
        key = (plate.mark, scale, count)
        if key not in self._heights:
            column = columns_of(self.area, count)[0]
            size = estimate(plate, scale)
            fits = size[0] <= column.width and size[1] <= column.height
            own = self.listings[plate.mark]
            wide = max((sum(listing.widths) for listing in own), default=0.0)
            fits = fits and (count == 1 or wide <= column.width)
            high = rows_beside(size, own, column)[1] if fits else math.inf
            self._heights[key] = high
        return self._heights[key]

    def columns(self, plates: Sequence[DevelopedPlate], scale: float) -> int:
        """The fewest columns in which these plates stand on one page; 0 where they do not."""
        room = self.area[3] - self.area[1]
        for count in self.counts:
            used, y = 1, 0.0
            for plate in plates:
                high = self.height(plate, scale, count)
                if y and y + high > room:
                    used, y = used + 1, 0.0
                y += high + GAP
                if high > room or used > count:
                    break
            else:
                return count
        return 0

    def scale(self) -> int:
        """The largest scale that fits every plate and needs few pages, of those at which station
        lines do not come too close."""
        width, height = self.area[2] - self.area[0], self.area[3] - self.area[1]
        fitting = [
            scale
            for scale in SCALES
            if all(
                wide <= width and high <= height
                for wide, high in (estimate(plate, scale) for plate in self.plates)
            )
        ] or [SCALES[-1]]
        pages: dict[int, float] = {}
        for scale in fitting:
            if pages and 500.0 / scale < STATION_ROOM:
                break
            pages[scale], start = 0.0, 0
            while start < len(self.plates):
                count = self.page(start, scale)
                one = self.height(self.plates[start], scale, 1) / height
                pages[scale] += 1.0 if math.isinf(one) else max(1.0, one)
                start += count
        enough = MORE_PAGES * min(pages.values())
        return next(scale for scale, count in pages.items() if count <= enough)

    def tries(self, plates: Sequence[DevelopedPlate], usual: int) -> list[tuple[int, int]]:
        """Scales and numbers of columns for a page of these plates, the largest scale first; last
        the usual one."""
        larger = [(scale, self.columns(plates, scale)) for scale in SCALES if scale < usual]
        found = [(scale, count) for scale, count in larger if plates and count]
        return [*found, (usual, self.columns(plates, usual) or 1)]

    def page(self, start: int, scale: float) -> int:
        """How many plates from one on go on a page, at least that one, where one is left."""
        if start >= len(self.plates):
            return 0
        count = 1
        while start + count < len(self.plates) and self.columns(
            self.plates[start : start + count + 1], scale
        ):
            count += 1
        return count
