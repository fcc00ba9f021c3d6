# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shapes of openings as they are written in tables: `d=120`, `200x100 r=20`, `slot 120x40`."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from ..finding import BendTorsionError, error
from ..geometry.arc_contour import rounded_rectangle

MEND = "write d=120, 200x100, 200x100 r=20 or slot 120x40"
_SIZE = r"([0-9]+(?:\.[0-9]*)?|\.[0-9]+)"
_SIGNED = r"([+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+))"
_CIRCLE = re.compile(rf"d\s*=\s*{_SIZE}", re.IGNORECASE)
_RECTANGLE = re.compile(rf"{_SIZE}\s*[x×]\s*{_SIZE}(?:\s+r\s*=\s*{_SIZE})?", re.IGNORECASE)
_SLOT = re.compile(rf"slot\s+{_SIZE}\s*[x×]\s*{_SIZE}", re.IGNORECASE)
_AT = re.compile(rf"(.*?)\s+at\s+{_SIGNED}\s+{_SIGNED}", re.IGNORECASE)


@dataclass(frozen=True)
class HoleShape:
    """A rectangle `length` (along its x) by `breadth` with corners of `radius`, mm: round when
    the radius is half of both, a slot when it is half of the smaller."""

    length: float
    breadth: float
    radius: float = 0.0

    @property
    def is_circle(self) -> bool:
        return self.length == self.breadth == 2.0 * self.radius

    @property
    def title(self) -> str:
        """The shape as it is written in tables."""
        if self.is_circle:
            return f"d={self.length:g}"
        if 2.0 * self.radius == min(self.length, self.breadth):
            return f"slot {self.length:g}x{self.breadth:g}"
        corner = f" r={self.radius:g}" if self.radius else ""
        return f"{self.length:g}x{self.breadth:g}{corner}"

    @property
    def contour(self) -> np.ndarray:
        """The contour (m, 3) about its middle."""
        return rounded_rectangle(self.length, self.breadth, self.radius)


def hole_shape(text: str) -> HoleShape:
    """The shape of a text; raises BendTorsionError for one that is none."""
    words = " ".join(str(text).split())
    if match := _CIRCLE.fullmatch(words):
        size = float(match[1])
        shape = HoleShape(size, size, 0.5 * size)
    elif match := _RECTANGLE.fullmatch(words):
        shape = HoleShape(float(match[1]), float(match[2]), float(match[3] or 0.0))
    elif match := _SLOT.fullmatch(words):
        length, breadth = float(match[1]), float(match[2])
        shape = HoleShape(length, breadth, 0.5 * breadth)
        if length <= breadth:
            raise _bad(words, "a slot must be longer than it is wide")
    else:
        raise _bad(words, "the shape cannot be read")
    if not 0.0 < min(shape.length, shape.breadth) <= max(shape.length, shape.breadth) < 1e5:
        raise _bad(words, "the shape has no size")
    if 2.0 * shape.radius > min(shape.length, shape.breadth):
        raise _bad(words, "the corners are rounder than the shape is wide")
    return shape


def placed_hole(text: str) -> tuple[HoleShape, tuple[float, float]]:
    """The shape of a text such as `d=400 at 50 -100`, and its offset (0, 0 when none is given)."""
    words = " ".join(str(text).split())
    if match := _AT.fullmatch(words):
        return hole_shape(match[1]), (float(match[2]), float(match[3]))
    return hole_shape(words), (0.0, 0.0)


def _bad(text: str, problem: str) -> BendTorsionError:
    return BendTorsionError(error("hole-shape", text or "shape", problem, MEND, value=text))
