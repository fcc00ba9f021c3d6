# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the model lies on the site: it stays local, what surveyors read carries site values."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .finding import Finding, warning

UNITS = {"mm": 1.0, "m": 0.001}
"""Site units written to lists, per millimetre."""
_WHOLE = 1e-6
"""mm; values nearer than this to a whole number have no fraction."""
_ON_EARTH = {"site_x": 6.5e7, "site_y": 6.5e7, "site_z": 1e4}
"""Metres; no survey tells more: an easting with the number of its zone, of 60, before it."""


@dataclass(frozen=True)
class SiteDatum:
    """x, y, z: mm on the site of the model's origin; rotation: rad from the site's x axis to the
    model's, about z; unit: of the values shown."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    rotation: float = 0.0
    unit: str = "mm"

    def of(self, points: np.ndarray) -> np.ndarray:
        """Site values (..., 3), in the unit, of model points (..., 3) mm."""
        cos, sin = np.cos(self.rotation), np.sin(self.rotation)
        x, y, z = points[..., 0], points[..., 1], points[..., 2]
        turned = np.stack([cos * x - sin * y + self.x, sin * x + cos * y + self.y, z + self.z], -1)
        return turned * UNITS[self.unit]


AT_ORIGIN = SiteDatum()
"""The model where it is."""


def datum_findings(site: SiteDatum) -> tuple[Finding, ...]:
    """A warning for each value of a datum shown in metres that looks as if it were written in
    metres: with a part of a millimetre, or a place less than a metre from the site's origin. None
    of a value too large to be metres anywhere on Earth."""
    if site.unit != "m":
        return ()
    found = []
    for name, value in (("site_x", site.x), ("site_y", site.y), ("site_z", site.z)):
        if abs(value) > _ON_EARTH[name]:
            continue
        fraction = abs(value - round(value)) > _WHOLE
        if fraction or (name != "site_z" and 0.0 < abs(value) < 1000.0):
            found.append(
                warning(
                    "site-unit",
                    "Settings",
                    f"{name} is read in mm: {_figure(value)} mm is {value * UNITS['m']:.6f} m on "
                    "the site; site_unit is the unit of lists and sheets alone",
                    f"if it is in metres write {_figure(value / UNITS['m'])}, in mm",
                    position=name,
                    value=value,
                    unit="mm",
                )
            )
    return tuple(found)


def _figure(value: float) -> str:
    """A value as it is written in a cell, without an exponent."""
    return f"{value:.6f}".rstrip("0").rstrip(".")
