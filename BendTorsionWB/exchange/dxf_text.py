# SPDX-License-Identifier: LGPL-2.1-or-later
"""Coordinates and texts as they are written to DXF files."""

from __future__ import annotations

import math

import numpy as np

SMALLEST_TEXT = 2.5  # mm; below this no plotter marks legibly
CHARACTER_WIDTH = 1.0  # width over height of a letter, on the safe side
_DECIMALS = 6  # of coordinates, mm
_SAME_PLACE = 0.01  # mm; what is no farther off a line is on it


def add_line_text(
    space,
    text: str,
    start: np.ndarray,
    end: np.ndarray,
    centre: np.ndarray,
    height: float,
    attributes: dict,
) -> None:
    """Text along a line from `start` towards `end`, beside it on the side of the plate's centre."""
    across = end - start
    length = np.hypot(*across)
    fitting = 0.8 * length / (len(text) * CHARACTER_WIDTH)
    height = round(max(SMALLEST_TEXT, min(height, fitting)), 1)
    along = across / length
    reading = along if along[1] > 0.0 or (along[1] == 0.0 and along[0] > 0.0) else -along
    corner = start if reading is along else start + len(text) * CHARACTER_WIDTH * height * along
    left = np.array([-reading[1], reading[0]])
    beside = 0.4 if (centre - start) @ left > -_SAME_PLACE else -1.4
    add_text(space, text, corner + beside * height * left, reading, height, attributes)


def add_text(
    space, text: str, corner: np.ndarray, reading: np.ndarray, height: float, attributes: dict
) -> None:
    """One line of text from its lower left corner along `reading`, a unit vector."""
    printable = "".join(character if character.isprintable() else " " for character in text)
    space.add_text(
        printable,
        dxfattribs={
            **attributes,
            "height": height,
            "rotation": round(math.degrees(math.atan2(reading[1], reading[0])), _DECIMALS) + 0.0,
            "insert": place(corner),
        },
    )


def place(flat: np.ndarray) -> tuple[float, float]:
    """A point as written."""
    return figure(flat[0]), figure(flat[1])


def figure(value: float) -> float:
    """A coordinate as written; adding zero turns -0.0 into 0.0."""
    return round(float(value), _DECIMALS) + 0.0
