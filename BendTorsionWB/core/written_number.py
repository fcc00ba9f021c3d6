# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers that are computed to be written into tables: without the last bits computing leaves.

What was given is written with all its digits, so that it reads back as itself.
"""

from __future__ import annotations

DIGITS = 12
CLOSE_TO = 4e-15
"""Relative: some eight times the distance of two neighbouring numbers."""


def plain(value: float) -> float:
    """The figure of up to DIGITS digits that a computed number is to CLOSE_TO, 4000.0 of
    3999.9999999999986; any other number as it is."""
    short = float(f"{value:.{DIGITS}g}")
    return short if abs(short - value) <= CLOSE_TO * abs(value) else float(value)


def per_cent(ratio: float) -> str:
    """A ratio in per cent, in the fewest digits that read back as the very same: `57.0%` of 0.57,
    whose hundredfold is 56.99999999999999."""
    hundredfold = ratio * 100.0
    for digits in (DIGITS, 15, 16):
        short = float(f"{hundredfold:.{digits}g}")
        if short / 100.0 == ratio:
            return f"{short!r}%"
    return f"{hundredfold!r}%"
