# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the forming shop is told of one plate: class, stresses, roll and fold lines, pull-down.
Springback is left to the shop."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

SPRINGBACK = "Springback is left to the shop: radii and angles are of the finished plate."
"""Said on every sheet that shows how a plate is formed."""


@dataclass(frozen=True)
class FormingClass:
    """`flat`, `elastic`, `cold` or `hot`; the rule that decided, with its value and limit.

    The deciding rule is the one that ruled out the next easier class; for `flat` the one met.
    """

    name: str
    rule: str
    value: float
    limit: float
    unit: str

    def line(self) -> str:
        """Class and deciding rule in one line."""
        sign = "≤" if self.name == "flat" else "<" if self.rule.startswith("cold") else ">"
        return f"{self.name} ({self.rule}: {self.value:.1f} {sign} {self.limit:.1f} {self.unit})"


@dataclass(frozen=True, eq=False)
class Peak:
    """Where a field is largest: its value, arc length s (mm), w across from the first edge (0)
    to the second (1), and place (2,) in the pattern, mm."""

    value: float
    s: float
    w: float
    flat: np.ndarray


@dataclass(frozen=True, eq=False)
class RollLine:
    """A line of least curvature, straight in the pattern: label `R-k`; ends (2, 2), mm; radius
    (3,) mm of the mid-surface across it at its first end, middle and second end; skew: rad to
    the ruling through its middle, positive when its second end is towards +s."""

    label: str
    s: float
    flat: np.ndarray
    radius: np.ndarray
    skew: float

    def text(self) -> str:
        """`R-3 R 26.4 m`, with both end radii where they differ."""
        first, middle, second = self.radius
        if np.isfinite(self.radius).all() and abs(second - first) > 0.02 * middle:
            return f"{self.label} R {_metres(first)} to {_metres(second)}"
        return f"{self.label} R {_metres(middle)}"


@dataclass(frozen=True, eq=False)
class FoldBend:
    """A fold line `F-k` with its ends (2, 2) in the pattern; angle: rad, positive where the outer
    face is convex; direction: `up` or `down` seen from the marking face."""

    label: str
    s: float
    angle: float
    direction: str
    flat: np.ndarray


@dataclass(frozen=True)
class PullDown:
    """What pulls a flat plate elastically into shape: bending moment across the plate and torque
    along it, kNm; the alternating corner force of that torque, kN; clamping forces at mid-length
    and at each corner, kN, that remain when the plate's own weight helps."""

    moment: float
    torque: float
    corner_force: float
    clamp_middle: float
    clamp_corner: float

    @property
    def drops_in(self) -> bool:
        """True when the plate's own weight is enough."""
        return self.clamp_middle == 0.0 and self.clamp_corner == 0.0


@dataclass(frozen=True, eq=False)
class FormingRecord:
    """Everything the forming shop asks of one plate.

    strain: peak principal strain of laying flat; locked_in_stress: MPa, its membrane stress E·ε.
    stress: peak, MPa, of forcing the flat plate elastically into shape (bending, twist and
    membrane; von Mises on the faces). bending_radius_min: mm; twist_max: rad/mm. flat_deviation:
    mm, half the band of the formed plate about its best plane; flat_tolerance: what may stay flat.
    """

    forming_class: FormingClass
    strain: Peak
    locked_in_stress: float
    stress: Peak
    bending_radius_min: float
    twist_max: float
    flat_deviation: float
    flat_tolerance: float
    roll_lines: tuple[RollLine, ...]
    fold_lines: tuple[FoldBend, ...]
    pull_down: PullDown

    @property
    def may_stay_flat(self) -> bool:
        """True when the plate may be built in as it was cut."""
        return self.forming_class.name == "flat"

    @property
    def advice(self) -> str:
        """`may stay flat`, `drops in`, `clamp with …` or `pre-form …`."""
        kind, down = self.forming_class, self.pull_down
        if kind.name == "flat":
            return "may stay flat"
        if kind.name in ("cold", "hot"):
            how = "press at the folds" if kind.rule == "fold_without_press" else "pre-form"
            return f"{how} {kind.name}"
        if down.drops_in:
            return "drops in"
        parts = []
        if down.clamp_middle:
            parts.append(f"{down.clamp_middle:.1f} kN at mid-length")
        if down.clamp_corner:
            parts.append(f"{down.clamp_corner:.1f} kN at each free corner")
        return "clamp with " + " and ".join(parts)

    def note(self) -> str:
        """The forming note of a drawing, one line."""
        parts = [f"forming: {self.forming_class.line()}", self.advice]
        if not self.may_stay_flat:
            if np.isfinite(self.bending_radius_min):
                parts.append(f"R min {_metres(self.bending_radius_min)}")
            parts.append(f"twist {np.degrees(1e3 * self.twist_max):.2f}°/m")
            parts.append(f"locked-in stress {self.locked_in_stress:.0f} MPa")
        return "; ".join(parts)


def _metres(radius: float) -> str:
    return f"{1e-3 * radius:.1f} m" if radius < 1e6 else "over 1 km"
