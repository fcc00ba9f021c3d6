# SPDX-License-Identifier: LGPL-2.1-or-later
"""The reading of cells that say where diaphragms, openings and marks are, and what they are.

Words stay words: `core/part_tables.py` says what they mean, here and in documents.
"""

from __future__ import annotations

from collections.abc import Callable

from ..core.finding import BendTorsionError
from ..core.joints.pieces import end_words
from ..core.joints.stock import stock_of
from ..core.plates.diaphragm_input import ENDS, closing_of
from ..core.plates.face_marks import mark_words
from ..core.plates.hole_shape import hole_shape, placed_hole
from ..core.written_number import per_cent
from .schedule_cells import BadCell, along, text


def place(value) -> str:
    """A place of a member: mm from its start, or 0% to 100%."""
    found = along(value)
    return per_cent(found.value) if found.is_ratio else repr(found.value)


def place_or_end(value) -> str:
    """A place of a member, or its `start` or `end`."""
    word = text(value).lower()
    return word if word in ENDS else place(value)


def piece_end(value) -> str:
    """`square`, or `stepped` with an offset per face."""
    word = text(value)
    try:
        end_words(word)
    except ValueError as problem:
        mend = "write square, or stepped top=80 bottom=-80"
        raise BadCell("bad-piece-end", str(problem), mend) from None
    return word


def backing(value) -> tuple[float, float]:
    """Width and thickness of a backing bar, mm, of text such as `30x6`."""
    word = text(value)
    try:
        wide, thick = map(float, word.lower().replace("×", "x").split("x"))
        if not 0.0 < thick <= wide < 1000.0:
            raise ValueError(word)
    except ValueError:
        mend = "write width x thickness, such as 30x6"
        raise BadCell("bad-backing", "no width and thickness of a backing bar", mend) from None
    return wide, thick


def _words(reader: Callable, code: str) -> Callable:
    def read(value) -> str:
        word = text(value)
        try:
            reader(word)
        except BendTorsionError as problem:
            finding = problem.findings[0]
            raise BadCell(code, finding.message, finding.mend) from None
        return word

    return read


shape = _words(hole_shape, "bad-shape")
manhole = _words(placed_hole, "bad-shape")
closing = _words(closing_of, "bad-closing-face")
mark = _words(mark_words, "bad-mark")
stock = _words(stock_of, "bad-stock")
