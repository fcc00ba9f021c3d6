# SPDX-License-Identifier: LGPL-2.1-or-later
"""Several PlateSets coloured by one figure on one scale, so that colours of members compare."""

from __future__ import annotations

from collections.abc import Sequence

from BendTorsionWB.core import detailing
from BendTorsionWB.core.colour_scale import limits
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.objects import colours, plate_set


def colour_by(plate_sets: Sequence, by: str) -> None:
    """Colour the plates of some PlateSets by one of `colour_scale.COLOUR_BY`, at once: nothing that
    depends on them is computed again. What is in error has no colours until it is mended."""
    laid = {}
    for obj in plate_sets if by != "none" else ():
        try:
            laid[obj.Name] = detailing.record_of(plate_set.value(obj)).plates
        except BendTorsionError:
            continue
    between = limits([plate for plates in laid.values() for plate in plates], by)
    for obj in plate_sets:
        touched = "Touched" in obj.State
        obj.ColourBy = by
        obj.ColourRange = list(between or ())
        if obj.Name in laid or by == "none":
            colours.set_colours(obj, obj.Marks, laid.get(obj.Name, ()))
        if not touched:
            obj.purgeTouched()
