# SPDX-License-Identifier: LGPL-2.1-or-later
"""Backing bars that run into diaphragms: the snipe that clears each, and what to do without one.

A bar lies with its width on the inside of the plate that ends at the seam, against the other plate.
A diaphragm keeps its gap from both and has its corner cut off by the snipe.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from .. import tolerances
from ..finding import Finding, warning
from ..plates.diaphragm_input import Diaphragm
from .weld_record import Weld


def snipe_needed(bar: tuple[float, float], gaps: tuple[float, float], dihedral: float) -> float:
    """Legs, mm, of the snipe that clears a bar, width and thickness mm, in a corner of walls at an
    angle, rad; gaps: mm from the diaphragm to the wall the bar lies on and to the other. 0 where
    the bar lies within a gap.

    In coordinates along the two walls the far corner of the bar is at (b - t cot, t / sin), the
    corner of the diaphragm at (gap of the other, gap of the own) / sin."""
    width, thickness = bar
    sine = math.sin(dihedral)
    beyond = width - thickness / math.tan(dihedral) - gaps[1] / sine
    above = (thickness - gaps[0]) / sine
    return 0.0 if min(beyond, above) <= tolerances.WELD_FIGURE else beyond + above


def backing_clashes(
    member: str,
    length: float,
    welds: Sequence[Weld],
    faces: Mapping[str, str],
    rows: Sequence[Diaphragm],
) -> Iterator[Finding]:
    """A warning, by `diaphragm k`, for each diaphragm that a backing bar inside the member runs
    into, of the bar that asks for most. length: of the axis, mm; faces: of plates by their marks;
    rows: of sheet Diaphragms."""
    backed = [
        weld
        for weld in welds
        if weld.kind in ("seam", "lane") and weld.prep.backing and weld.prep.side == "outer"
    ]
    for number, row in enumerate(rows, start=1):
        place = row.s * (length if row.s_is_ratio else 1.0)
        here = [w for w in backed if not row.end and w.start <= place <= w.end]
        across = [(w, w.prep.backing[1]) for w in here if w.kind == "lane"]
        across = [
            (w, t) for w, t in across if t > _gap(row, faces[w.plates[0]]) + tolerances.WELD_FIGURE
        ]
        if across:
            weld, thickness = max(across, key=lambda item: item[1])
            yield _clash(
                member,
                number,
                weld,
                "between its corners, where no snipe clears it",
                f"give a gap of {thickness:g} mm, weld without a bar, or end the bar there",
                _gap(row, faces[weld.plates[0]]),
                thickness,
            )
        corners = [
            (w, snipe_needed(w.prep.backing, _gaps(row, w, faces), w.dihedral))
            for w in here
            if w.kind == "seam"
        ]
        if not corners:
            continue
        weld, needed = max(corners, key=lambda item: item[1])
        if needed > row.snipe + tolerances.WELD_FIGURE:
            whole = math.ceil(needed - tolerances.WELD_FIGURE)
            yield _clash(
                member,
                number,
                weld,
                f"with its snipe of {row.snipe:g} mm",
                f"give a snipe of {whole} mm, or a narrower bar, or end the bar at the diaphragm",
                row.snipe,
                needed,
            )


def _gaps(row: Diaphragm, weld: Weld, faces: Mapping[str, str]) -> tuple[float, float]:
    return _gap(row, faces[weld.plates[0]]), _gap(row, faces[weld.plates[1]])


def _gap(row: Diaphragm, face: str) -> float:
    closing = row.closing
    own = closing and closing.face == face and closing.gap is not None
    return closing.gap if own else row.gap


def _clash(member, number, weld, where, mend, value, limit) -> Finding:
    bar = "{:g}x{:g}".format(*weld.prep.backing)
    return warning(
        "backing-clash",
        member,
        f"the backing bar {bar} of weld {weld.mark} runs into the diaphragm {where}",
        mend,
        position=f"diaphragm {number}",
        value=float(value),
        limit=float(limit),
        unit="mm",
    )
