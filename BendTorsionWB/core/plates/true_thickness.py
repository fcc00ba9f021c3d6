# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far the model of a plate is from its thickness: both its faces are ruled, their distance is
true at the corners of the section, and where the plate twists larger half way between them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .. import tolerances
from ..finding import Finding, warning
from ..geometry.piecewise import evaluate_together
from .plates import Plate

STEP = 0.1
"""mm to both sides of a place, between which the direction along the plate is taken."""


def middle_thickness(plates: Sequence[Plate]) -> list[tuple[np.ndarray, np.ndarray]]:
    """Per plate arc lengths (n,) half way between its lines, and there the distance (n,) in mm of
    its faces half way across, along the outer face's normal.

    On a straight axis that turns by τ per mm it is t √(1 + (τ b / 2)²) in a face of breadth b.
    """
    places = [_between_lines(plate) for plate in plates]
    around = [np.concatenate([s - STEP, s, s + STEP]) for s in places]
    outer = evaluate_together([plate.rails.outer for plate in plates], around)
    inner = evaluate_together([plate.rails.inner for plate in plates], places)
    found = []
    for s, rails, below in zip(places, outer, inner, strict=True):
        first, second = rails[:, :3].reshape(3, -1, 3), rails[:, 3:].reshape(3, -1, 3)
        middle = 0.5 * (first + second)
        normal = np.cross(middle[2] - middle[0], second[1] - first[1])
        gap = 0.5 * (below[:, :3] + below[:, 3:]) - middle[1]
        away = np.abs((normal * gap).sum(axis=1)) / np.linalg.norm(normal, axis=1)
        found.append((s, away))
    return found


def thickness_findings(plates: Sequence[Plate]) -> list[Finding]:
    """A warning for each plate that is drawn thicker than it is by more than THICKNESS_DRAWN."""
    findings = []
    for plate, (s, drawn) in zip(plates, middle_thickness(plates) if plates else (), strict=True):
        most = int(drawn.argmax())
        more = float(drawn[most]) - plate.thickness
        if more > tolerances.THICKNESS_DRAWN:
            findings.append(
                warning(
                    "twist-thickens",
                    plate.mark,
                    "the plate twists: its solid is thicker half way across than at its edges, "
                    "where it is true, and its weight is too large",
                    "divide the face along its length, twist the member less, or allow for it",
                    position=f"s = {s[most]:.0f} mm",
                    value=more,
                    limit=tolerances.THICKNESS_DRAWN,
                    unit="mm",
                )
            )
    return findings


def _between_lines(plate: Plate) -> np.ndarray:
    lines = np.array([line.s for line in plate.lines])
    return 0.5 * (lines[1:] + lines[:-1])
