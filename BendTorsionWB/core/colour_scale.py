# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colours of values and classes, safe for colour-blind eyes, with a legend in numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .lofting import DevelopedPlate

COLOUR_BY = (
    *("none", "strain", "length error", "forming", "thickness"),
    *("deviation", "curvature", "twist"),
)
"""What plates and patterns are coloured by."""

ANCHORS = np.array(
    [
        [int(code[k : k + 2], 16) / 255.0 for k in (0, 2, 4)]
        for code in (
            "4A7AC2 6288B8 7A95AE 919FA1 A5A892 B7B182 C9BB70 DBC95C EDD84A FEE838".split()
        )
    ]
)
"""Blue over grey to yellow: rising in lightness and told apart by all, as cividis (Nuñez, Anderton
& Renslow 2018), but light enough at its lower end to stand out at 3:1 from a dark view."""

CLASS_COLOURS = {
    "flat": (0.0, 158 / 255, 115 / 255),
    "elastic": (86 / 255, 180 / 255, 233 / 255),
    "cold": (230 / 255, 159 / 255, 0.0),
    "hot": (213 / 255, 94 / 255, 0.0),
}
"""Of forming classes (Okabe & Ito 2008)."""

FACE_COLOURS = {
    "T": (0.45, 0.62, 0.80),
    "B": (0.55, 0.68, 0.50),
    "L": (0.86, 0.70, 0.42),
    "R": (0.78, 0.52, 0.46),
    "D": (0.62, 0.55, 0.72),
    "E": (0.50, 0.50, 0.55),
}
"""Of faces by their letter, for models seen outside this program."""

UNKNOWN = (0.6, 0.6, 0.6)
TICKS = 5

Colour = tuple[float, float, float]


@dataclass(frozen=True)
class ColourScale:
    """Colours between two values, the lower one dark."""

    low: float
    high: float

    def colours(self, values: np.ndarray) -> np.ndarray:
        """Red, green, blue (..., 3), 0 to 1, of values (...); beyond the ends, the ends'."""
        span = self.high - self.low
        share = (np.asarray(values, float) - self.low) / span if span > 0.0 else np.zeros(1)
        share = np.broadcast_to(np.clip(share, 0.0, 1.0), np.shape(values))
        at = np.linspace(0.0, 1.0, len(ANCHORS))
        return np.stack([np.interp(share, at, ANCHORS[:, k]) for k in range(3)], axis=-1)

    def ticks(self) -> np.ndarray:
        """Values (n,) of a legend, ends included."""
        return np.linspace(self.low, self.high, TICKS if self.high > self.low else 1)


@dataclass(frozen=True)
class Colouring:
    """A colour for each plate, and the legend: text and colour of each step."""

    colours: tuple[Colour, ...]
    legend: tuple[tuple[str, Colour], ...]


def strain_text(strain: float) -> str:
    """A strain as micrometres per metre."""
    return f"{1e6 * strain:.1f} µm/m".replace("-0.0 ", "0.0 ")


_FIGURES = {
    "strain": (lambda plate: plate.strain_max, strain_text),
    "length error": (lambda plate: plate.length_error_max, lambda value: f"{value:.4f} mm"),
    "thickness": (lambda plate: plate.thickness, lambda value: f"{value:g} mm"),
    "deviation": (
        lambda plate: _formed(plate, "flat_deviation"),
        lambda value: f"{value:.1f} mm",
    ),
    "curvature": (
        lambda plate: 1e3 / plate.bending_radius_min,
        lambda value: f"{value:.4f} 1/m",
    ),
    "twist": (
        lambda plate: math.degrees(1e3 * _formed(plate, "twist_max")),
        lambda value: f"{value:.3f} °/m",
    ),
}
"""By COLOUR_BY: the figure of a plate, and how it is written; classes are no figures."""


def limits(plates: Sequence[DevelopedPlate], by: str) -> tuple[float, float] | None:
    """The least and the largest value of a scale for some plates; None where there is no figure.
    All but thicknesses count from 0."""
    if by not in _FIGURES:
        return None
    values = [_FIGURES[by][0](plate) for plate in plates]
    known = [value for value in values if math.isfinite(value)]
    if not known:
        return None
    return (min(known) if by == "thickness" else 0.0), max(known)


def colouring(
    plates: Sequence[DevelopedPlate], by: str, between: tuple[float, float] | None = None
) -> Colouring:
    """The plates coloured by one of COLOUR_BY; plates without the figure are grey. between: least
    and largest value of the scale, those of the plates themselves when left out."""
    if by == "none" or not plates:
        return Colouring((), ())
    if by == "forming":
        classes = [plate.forming for plate in plates]
        present = [name for name in CLASS_COLOURS if name in classes]
        return Colouring(
            tuple(CLASS_COLOURS.get(name, UNKNOWN) for name in classes),
            tuple((name, CLASS_COLOURS[name]) for name in present),
        )
    figure, written = _FIGURES[by]
    values = np.array([figure(plate) for plate in plates], float)
    known = np.isfinite(values)
    if not known.any():
        return Colouring((UNKNOWN,) * len(plates), ())
    scale = ColourScale(*(between or limits(plates, by)))
    if written(scale.low) == written(scale.high):
        # All the same as far as it is written: no colour would tell more.
        scale = ColourScale(scale.low, scale.low)
    steps = np.unique(values[known]) if by == "thickness" else scale.ticks()
    painted = scale.colours(np.where(known, values, scale.low))
    legend = [
        (written(value), _plain(colour))
        for value, colour in zip(steps.tolist(), scale.colours(steps), strict=True)
    ]
    return Colouring(
        tuple(
            _plain(colour) if is_known else UNKNOWN
            for colour, is_known in zip(painted, known, strict=True)
        ),
        tuple(dict.fromkeys(legend)),
    )


def face_colour(letter: str) -> Colour:
    """The colour of a face by its letter; other sections' faces take those of the box in turn."""
    palette = tuple(FACE_COLOURS.values())
    return FACE_COLOURS.get(letter) or palette[sum(map(ord, letter)) % len(palette)]


def _formed(plate: DevelopedPlate, figure: str) -> float:
    """A figure of how a plate is formed; flat parts have none."""
    return math.nan if plate.forming_data is None else float(getattr(plate.forming_data, figure))


def hex_text(colour: Sequence[float]) -> str:
    """`#rrggbb`."""
    return "#" + "".join(f"{round(255 * float(part)):02x}" for part in colour)


def _plain(colour: np.ndarray) -> Colour:
    return tuple(float(part) for part in colour)
