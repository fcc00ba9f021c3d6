# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a plate gets its shape: stresses, the forming class and the rule that decided, roll lines,
and what it takes to pull the plate down. Springback is left to the shop."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .development import (
    ACROSS,
    Development,
    SurfaceShape,
    crossed,
    shape_inside,
    shape_of,
    strain_at_nodes,
)
from .section import Material

POISSON = 0.3
GRAVITY = 9.80665e-3
"""kN per kg."""
CLASSES = ("flat", "elastic", "cold", "hot")


@dataclass(frozen=True)
class FormingRules:
    """Limits of the forming classes (rule pack): deviation from a plane a plate may keep, mm;
    stress an elastically pulled plate may lock in, MPa; least cold radius over thickness, for
    low-alloy and mild steel; yield that parts them, MPa; fold angle that needs no press, rad."""

    flat_within: float = 1.0
    elastic_stress: float = 100.0
    cold_radius_low_alloy: float = 25.0
    cold_radius_mild: float = 20.0
    mild_up_to: float = 245.0
    fold_without_press: float = np.radians(0.1)


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


@dataclass(frozen=True, eq=False)
class RollLine:
    """A line of least curvature, straight in the plane from the first to the second edge: ends
    (2, 2) in the plane, radius (3,) mm rolled about it at its ends and middle, angle (rad) it is
    askew to the ruling through its middle."""

    s: float
    flat: np.ndarray
    radius: np.ndarray
    skew: float


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
        return self.clamp_middle == 0.0 and self.clamp_corner == 0.0


@dataclass(frozen=True, eq=False)
class Forming:
    """Everything the forming shop asks of one plate. twist_max: rad/mm. flat_deviation: mm, half
    the band about the best plane. stress_max: MPa, of forcing the flat plate elastically into
    shape (bending, twist and membrane; von Mises on the faces)."""

    forming_class: FormingClass
    strain_max: float
    stress_max: float
    bending_radius_min: float
    twist_max: float
    flat_deviation: float
    roll_lines: tuple[RollLine, ...]
    pull_down: PullDown
    advice: str


def forming_of(
    development: Development,
    thickness: float,
    material: Material,
    mass: float,
    places: np.ndarray,
    fold_angles: Sequence[float] = (),
    rules: FormingRules | None = None,
) -> Forming:
    """The forming record of a plate: mass in kg, roll lines through the middle at `places`."""
    rules = rules or FormingRules()
    shape, stretch = shape_inside(development.surface, ACROSS), _stretch_inside(development)
    stress = forced_stress(shape, stretch, thickness, material)
    kind = classify(development, shape, stretch, thickness, material, fold_angles, rules)
    down = pull_down(development, shape, thickness, material, mass)
    sharpest = float(shape.sharpest.max())
    return Forming(
        forming_class=kind,
        strain_max=float(np.abs(stretch).max()),
        stress_max=float(stress.max()),
        bending_radius_min=1.0 / sharpest if sharpest > 1e-12 else np.inf,
        twist_max=float(np.abs(shape.twist).max()),
        flat_deviation=flat_deviation(development),
        roll_lines=() if kind.name == "flat" else roll_lines(development, places),
        pull_down=down,
        advice=_advice(kind, down),
    )


def _stretch_inside(development: Development) -> np.ndarray:
    """Strain of flattening (n, k) at the places of shape_inside."""
    nodes = development.plane.nodes
    stretch = strain_at_nodes(development, ACROSS).reshape(*nodes.shape, len(ACROSS))
    return stretch[:, 1:-1].reshape(-1, len(ACROSS))


def forced_stress(
    shape: SurfaceShape, stretch: np.ndarray, thickness: float, material: Material
) -> np.ndarray:
    """Von Mises stress (n, k), MPa, on the worse face of a flat plate held elastically in shape.

    Rulings stay straight and rigid: plane strain along them, σ22 = νσ11; bending E't/2R, twist
    G·t·τ (pure twist yields at τ = fy/(√3·G·t)), membrane −E'e.
    """
    modulus = material.e / (1.0 - POISSON**2)
    along = modulus * (np.abs(stretch) + 0.5 * thickness * np.abs(shape.bend))
    shear = material.e / (2.0 * (1.0 + POISSON)) * thickness * shape.twist
    return np.sqrt((1.0 - POISSON + POISSON**2) * along**2 + 3.0 * shear**2)


def classify(
    development: Development,
    shape: SurfaceShape,
    stretch: np.ndarray,
    thickness: float,
    material: Material,
    fold_angles: Sequence[float],
    rules: FormingRules,
) -> FormingClass:
    """The forming class of a plate by rule; shape and stretch at common places (n, k).

    flat: within `flat_within` of a plane. elastic: forced stress within `elastic_stress`. cold:
    radius not below the cold radius and membrane strain below yield, since rolling gives none.
    hot: the rest. A fold beyond `fold_without_press` is pressed: cold at least.
    """
    fold = float(max((abs(angle) for angle in fold_angles), default=0.0))
    folded = fold > rules.fold_without_press
    deviation = flat_deviation(development)
    if deviation <= rules.flat_within and not folded:
        return FormingClass("flat", "flat_within", deviation, rules.flat_within, "mm")
    stress = float(forced_stress(shape, stretch, thickness, material).max())
    mild = material.fy <= rules.mild_up_to
    ratio = rules.cold_radius_mild if mild else rules.cold_radius_low_alloy
    radius = 1.0 / max(float(shape.sharpest.max()), 1e-12)
    membrane = float(np.abs(stretch).max()) * material.e
    if radius < ratio * thickness:
        rule = "cold_radius_mild" if mild else "cold_radius_low_alloy"
        return FormingClass("hot", rule, radius, ratio * thickness, "mm")
    if membrane > material.fy:
        return FormingClass("hot", "membrane_yield", membrane, material.fy, "MPa")
    if stress > rules.elastic_stress:
        return FormingClass("cold", "elastic_stress", stress, rules.elastic_stress, "MPa")
    if folded:
        limit = rules.fold_without_press
        return FormingClass(
            "cold", "fold_without_press", float(np.degrees(fold)), float(np.degrees(limit)), "°"
        )
    return FormingClass("elastic", "flat_within", deviation, rules.flat_within, "mm")


def flat_deviation(development: Development) -> float:
    """Half the band, mm, of heights of the mid-surface about its best plane (least squares): what
    a piece left flat is off by."""
    values = development.surface.values
    points = np.concatenate([values[..., :3].reshape(-1, 3), values[..., 3:].reshape(-1, 3)])
    corners = values[0, 0, :3], values[0, 0, 3:], values[-1, -1, :3], values[-1, -1, 3:]
    x = 0.5 * (corners[2] + corners[3] - corners[0] - corners[1])
    x = x / np.sqrt((x * x).sum())
    z = crossed(corners[3] - corners[0], corners[2] - corners[1])
    z = z - (z * x).sum() * x
    z = z / np.sqrt((z * z).sum())
    y = crossed(z, x)
    a, b, h = ((points * axis).sum(axis=1) for axis in (x, y, z))
    a, b, h = a - a.mean(), b - b.mean(), h - h.mean()
    aa, ab, bb = (a * a).sum(), (a * b).sum(), (b * b).sum()
    ah, bh = (a * h).sum(), (b * h).sum()
    determinant = aa * bb - ab * ab
    slope_a, slope_b = (ah * bb - bh * ab) / determinant, (bh * aa - ah * ab) / determinant
    height = (h - slope_a * a - slope_b * b) / np.sqrt(1.0 + slope_a**2 + slope_b**2)
    return float(0.5 * (height.max() - height.min()))


def roll_lines(development: Development, places: np.ndarray) -> tuple[RollLine, ...]:
    """Lines of least curvature through the middle of the rulings at places (n,)."""
    places = np.asarray(places, float)
    shape = shape_of(development.surface, places, np.array([0.5]))
    bend, twist = shape.bend[:, 0], shape.twist[:, 0]
    # Principal directions of [[bend, twist], [twist, 0]]; the least lies nearest the ruling.
    skew = 0.5 * np.arctan2(np.where(bend < 0.0, 2.0, -2.0) * twist, np.abs(bend))
    half = np.full(len(places), 0.5)
    middle = development.flat(places, half)
    by_s, by_w = development.jacobian(places, half)
    ruling = by_w / np.sqrt((by_w * by_w).sum(axis=1, keepdims=True))
    normal = np.column_stack([ruling[:, 1], -ruling[:, 0]])
    along = np.cos(skew)[:, None] * ruling + np.sin(skew)[:, None] * normal
    ends, radii = [], []
    for w in (0.0, 1.0):
        s, at = _edge_hit(development, places, middle, along, w)
        ends.append(development.flat(s, at))
        radii.append(_radius_about(development, s, at))
    radii.insert(1, _radius_about(development, places, half))
    return tuple(
        RollLine(
            float(places[i]),
            np.array([ends[0][i], ends[1][i]]),
            np.array([float(radius[i]) for radius in radii]),
            float(skew[i]),
        )
        for i in range(len(places))
    )


def _radius_about(development: Development, s: np.ndarray, w: np.ndarray) -> np.ndarray:
    sharpest = np.array(
        [
            shape_of(development.surface, s[i : i + 1], w[i : i + 1]).sharpest[0, 0]
            for i in range(len(s))
        ]
    )
    return np.where(sharpest > 1e-12, 1.0 / np.maximum(sharpest, 1e-12), np.inf)


def _edge_hit(
    development: Development, places: np.ndarray, middle: np.ndarray, along: np.ndarray, w: float
) -> tuple[np.ndarray, np.ndarray]:
    """(s, w) where lines through `middle` meet the edge w, or the end line they meet before."""
    s, at = places.copy(), np.full(len(places), w)
    plane = development.plane
    for _ in range(12):
        gap = development.flat(s, at) - middle
        rate, _ = development.jacobian(s, at)
        off = gap[:, 0] * along[:, 1] - gap[:, 1] * along[:, 0]
        s = s - off / (rate[:, 0] * along[:, 1] - rate[:, 1] * along[:, 0])
        s = np.clip(s, plane.start - 1.0, plane.end + 1.0)
    beyond = (s < plane.start) | (s > plane.end)
    s = np.clip(s, plane.start, plane.end)
    if beyond.any():
        at[beyond] = development.ruling_crossing(
            s[beyond], middle[beyond], middle[beyond] + along[beyond]
        )
    return s, at


def pull_down(
    development: Development,
    shape: SurfaceShape,
    thickness: float,
    material: Material,
    mass: float,
) -> PullDown:
    """Moments and forces of holding the flat plate in shape, its weight helping where it can.

    Moment E·b·t³/12(1 − ν²)·κ, torque G·b·t³/3·τ, corner force G·t³/3·τ (plate theory). Weight
    W gives W·L/8 at mid-length of a plate held at its ends, and W/4 at each free corner of a
    plate held at two opposite ones; the clamp at mid-length has a lever of L/4.
    """
    plane = development.plane
    width = float(plane.values[..., 3].max())
    ends = development.flat(np.array([plane.start, plane.end]), np.array([0.5, 0.5]))
    length = float(np.sqrt(((ends[1] - ends[0]) ** 2).sum()))
    weight = mass * GRAVITY
    stiffness = material.e * width * thickness**3 / (12.0 * (1.0 - POISSON**2))
    moment = stiffness * float(np.abs(shape.bend).max()) * 1e-6
    shear = material.e / (2.0 * (1.0 + POISSON))
    corner = shear * thickness**3 / 3.0 * float(np.abs(shape.twist).max()) * 1e-3
    lever = length * 1e-3
    return PullDown(
        moment=moment,
        torque=corner * width * 1e-3,
        corner_force=corner,
        clamp_middle=max(0.0, 4.0 * moment / lever - 0.5 * weight),
        clamp_corner=max(0.0, corner - 0.25 * weight),
    )


def fold_direction(angle: float, marking_face: str) -> str:
    """`up` or `down`, seen from the marking face: up brings the plate beside the fold towards
    the eye. angle > 0 folds the outer face convex."""
    return "up" if (angle > 0) == (marking_face == "inside") else "down"


def _advice(kind: FormingClass, down: PullDown) -> str:
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
