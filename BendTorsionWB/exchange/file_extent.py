# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an architect's file says of its size: unit and bounding box, and whether to believe it."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from ..core.finding import Finding, note, warning

SMALLEST, LARGEST = 500.0, 2e6
"""mm; a surface or axis of a building is no smaller and no larger."""
TIMES = 100.0
"""How many times larger or smaller than what belongs to it a thing may be."""

_SI = {"KILO": 1e6, "": 1e3, "DECI": 100.0, "CENTI": 10.0, "MILLI": 1.0, "MICRO": 1e-3}
_NAMED = {"INCH": 25.4, "FOOT": 304.8, "IN": 25.4, "FT": 304.8, "MM": 1.0, "CM": 10.0, "M": 1e3}
_NAMED |= {"KM": 1e6, "MIL": 0.0254, "UM": 1e-3, "MILLIMETER": 1.0, "METER": 1e3, "METRE": 1e3}


def unit_of(path: str | Path) -> float | None:
    """mm in the unit a STEP or IGES file declares; None when it tells none, as BREP files do."""
    path = Path(path)
    kind = path.suffix.lower()
    try:
        text = path.read_bytes().decode("latin-1")
    except OSError:
        return None
    if kind in (".step", ".stp"):
        found = re.search(
            r"LENGTH_UNIT\(\)[^;]*?SI_UNIT\(\s*(?:\$|\.(\w+)\.)\s*,\s*\.METRE\.", text
        ) or re.search(r"SI_UNIT\(\s*(?:\$|\.(\w+)\.)\s*,\s*\.METRE\.", text)
        named = re.search(r"CONVERSION_BASED_UNIT\(\s*'(\w+)'[^;]*?LENGTH_UNIT", text)
        if named and named.group(1).upper() in _NAMED:
            return _NAMED[named.group(1).upper()]
        return _SI.get(found.group(1) or "") if found else None
    if kind in (".iges", ".igs"):
        start = "".join(line[:72] for line in text.splitlines() if line[72:73] == "G")
        named = re.search(r",\d+H(\w+),\d+,[\d.Ee+-]*,\d+H\d{6}", start)
        return _NAMED.get(named.group(1).upper()) if named else None
    return None


def extent_findings(
    name: str,
    box: np.ndarray,
    unit: float | None,
    beside: float | None = None,
    asked: bool = False,
) -> tuple[Finding, ...]:
    """A note of the unit and size of what a file holds, and a warning where they are hard to
    believe.

    name: the file, with the part read. box: (2, 3) mm. unit: mm in the file's unit, None when it
    tells none. beside: size, mm, of what belongs to it (the axes of a surface, the surface of an
    axis). asked: whether this kind of file should tell a unit.
    """
    size = np.asarray(box[1]) - np.asarray(box[0])
    whole = float(np.linalg.norm(size))
    shown = " x ".join(f"{length / 1000.0:.3f}" for length in size)
    at = ", ".join(f"{x / 1000.0:.3f}" for x in np.mean(box, axis=0))
    text = "tells no unit, mm taken" if unit is None else f"unit {unit_text(unit)}"
    found = [note("file-read", name, f"{text}; {shown} m around {at} m")]
    doubt = ""
    if not SMALLEST <= whole <= LARGEST:
        doubt = f"it measures {whole / 1000.0:.4g} m"
    elif beside and not 1.0 / TIMES <= whole / beside <= TIMES:
        doubt = f"it measures {whole / 1000.0:.4g} m, what belongs to it {beside / 1000.0:.4g} m"
    if doubt:
        factor = _factor(whole, beside)
        found.append(
            warning(
                "file-unit-doubtful",
                name,
                f"{doubt}: is its unit right?",
                f"export it in mm{factor}",
                value=whole,
                limit=f"{SMALLEST:g} to {LARGEST:g}",
                unit="mm",
            )
        )
    elif unit is None and asked:
        found.append(
            warning(
                "file-unit-unknown",
                name,
                "tells no unit; its numbers are taken as mm",
                "set its unit where it was drawn",
            )
        )
    return tuple(found)


def unit_text(unit: float) -> str:
    """The name of a unit of so many mm."""
    names = {1.0: "mm", 10.0: "cm", 100.0: "dm", 1e3: "m", 25.4: "inch", 304.8: "foot", 1e6: "km"}
    return names.get(unit, f"{unit:g} mm")


def _factor(whole: float, beside: float | None) -> str:
    """Whether metres taken as mm, or the reverse, would explain the size."""
    if not beside or whole <= 0.0:
        return ""
    for ratio, word in ((whole / beside, "large"), (beside / whole, "small")):
        if 200.0 <= ratio <= 5000.0:
            return f"; it seems 1000 times too {word}"
    return ""
