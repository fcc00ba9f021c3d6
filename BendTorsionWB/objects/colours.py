# SPDX-License-Identifier: LGPL-2.1-or-later
"""The properties by which plates and patterns are coloured; the view only paints what they say."""

from __future__ import annotations

import math
from collections.abc import Sequence

from BendTorsionWB.core.colour_scale import COLOUR_BY, UNKNOWN, colouring, hex_text
from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.core.lofting import DevelopedPlate
from BendTorsionWB.objects.proxy import Property

PROPERTIES = (
    Property(
        "App::PropertyEnumeration",
        "ColourBy",
        "Colours",
        "What the plates are coloured by in the window",
        COLOUR_BY[0],
        COLOUR_BY,
    ),
    Property(
        "App::PropertyFloatList",
        "ColourRange",
        "Colours",
        "Least and largest value of the colours, to compare members; empty: those of its own",
    ),
    Property(
        "App::PropertyColorList",
        "Colours",
        "Colours",
        "Colour of each plate, in mark order; empty for the view's own",
        output=True,
    ),
    Property(
        "App::PropertyStringList",
        "Legend",
        "Colours",
        "What the colours mean: colour and value",
        output=True,
    ),
)


def set_colours(obj, marks: Sequence[str], plates: Sequence[DevelopedPlate]) -> None:
    """Write Colours and Legend of an object that shows plates by these marks, in this order.
    Raises BendTorsionError for a ColourRange that is none."""
    found = colouring(plates, obj.ColourBy, _between(obj))
    by_mark = dict(zip((plate.mark for plate in plates), found.colours, strict=False))
    obj.Colours = [by_mark.get(mark, UNKNOWN) for mark in marks] if found.colours else []
    obj.Legend = [f"{hex_text(colour)} {text}" for text, colour in found.legend]


def _between(obj) -> tuple[float, float] | None:
    given = tuple(obj.ColourRange)
    if not given:
        return None
    if len(given) == 2 and -math.inf < given[0] <= given[1] < math.inf:
        return given
    raise BendTorsionError(
        error(
            "colour-range",
            obj.Label,
            "ColourRange is no least and largest value",
            "write two numbers, the lesser one first, or empty it",
            position="property ColourRange",
            value=", ".join(f"{number:g}" for number in given),
        )
    )
