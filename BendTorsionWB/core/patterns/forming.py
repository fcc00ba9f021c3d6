# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a plate gets its shape: stresses, the forming class and the rule that decided, roll lines,
and what it takes to pull the plate down. Springback is left to the shop."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..flattening.development import ACROSS, Development, strain_at_nodes
from ..flattening.surface_shape import SurfaceShape, shape_from, shape_inside
from ..geometry.piecewise import parted
from ..geometry.vectors import crossed, lengths
from ..sections.section import Material
from .forming_record import FoldBend, FormingClass, FormingRecord, Peak, PullDown, RollLine

POISSON = 0.3
GRAVITY = 9.80665e-3
"""kN per kg."""
_THREE = np.array([0.0, 0.5, 1.0])


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


def forming_of(
    development: Development,
    thickness: float,
    material: Material,
    mass: float,
    length: float,
    fold_angles: Sequence[float] = (),
    rules: FormingRules | None = None,
    *,
    shape: SurfaceShape | None = None,
    stretch: np.ndarray | None = None,
    placed: Callable[[np.ndarray], np.ndarray] | None = None,
    roll_lines: Sequence[RollLine] = (),
    fold_lines: Sequence[FoldBend] = (),
) -> FormingRecord:
    """The forming record of a plate: mass in kg, length (mm) between its end lines.

    shape and stretch: shape_inside and the strain of flattening at the same (n, k) places, when
    they are known already; placed: points (n, 2) of the development's plane -> pattern points.
    Roll lines are left out of a plate that may stay flat.
    """
    rules = rules or FormingRules()
    shape = shape_inside(development.surface, ACROSS) if shape is None else shape
    stretch = _stretch_inside(development) if stretch is None else stretch
    stress = forced_stress(shape, stretch, thickness, material)
    deviation = flat_deviation(development)
    strain = np.abs(stretch)
    kind = classify(
        deviation,
        float(stress.max()),
        float(shape.sharpest.max()),
        float(strain.max()),
        thickness,
        material,
        fold_angles,
        rules,
    )
    return FormingRecord(
        forming_class=kind,
        **_peaks(development, placed, strain=strain, stress=stress),
        locked_in_stress=material.e * float(strain.max()),
        bending_radius_min=_radius(float(shape.sharpest.max())),
        twist_max=float(np.abs(shape.twist).max()),
        flat_deviation=deviation,
        flat_tolerance=rules.flat_within,
        roll_lines=() if kind.name == "flat" else tuple(roll_lines),
        fold_lines=tuple(fold_lines),
        pull_down=pull_down(development, shape, thickness, material, mass, length),
    )


def _peaks(development: Development, placed, **fields: np.ndarray) -> dict[str, Peak]:
    """Where fields (n, k) at the places of shape_inside are largest."""
    nodes = development.surface.nodes[:, 1:-1].ravel()
    at = [np.unravel_index(int(np.argmax(field)), field.shape) for field in fields.values()]
    s, w = nodes[[i for i, _ in at]], ACROSS[[j for _, j in at]]
    if development.correction is None:
        # The nodes' own values: no evaluation. Copied, since numpy's sine of a strided view has
        # other last bits from run to run.
        nodal = development.plane.values[:, 1:-1].reshape(-1, 4)[[i for i, _ in at]]
        angle, reach = nodal[:, 2].copy(), w * nodal[:, 3]
        places = np.stack(
            [nodal[:, 0] - reach * np.sin(angle), nodal[:, 1] + reach * np.cos(angle)], axis=1
        )
    else:
        places = development.flat(s, w)
    places = places if placed is None else placed(places)
    return {
        name: Peak(float(field[at[k]]), float(s[k]), float(w[k]), places[k])
        for k, (name, field) in enumerate(fields.items())
    }


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
    deviation: float,
    stress: float,
    sharpest: float,
    strain: float,
    thickness: float,
    material: Material,
    fold_angles: Sequence[float],
    rules: FormingRules,
) -> FormingClass:
    """The forming class of a plate by rule: its deviation from a plane (mm), largest forced stress
    (MPa), largest curvature (1/mm) and largest strain of flattening.

    flat: within `flat_within` of a plane. elastic: forced stress within `elastic_stress`. cold:
    radius not below the cold radius and membrane strain below yield, since rolling gives none.
    hot: the rest. A fold beyond `fold_without_press` is pressed: cold at least.
    """
    fold = float(max((abs(angle) for angle in fold_angles), default=0.0))
    folded = fold > rules.fold_without_press
    if deviation <= rules.flat_within and not folded:
        return FormingClass("flat", "flat_within", deviation, rules.flat_within, "mm")
    mild = material.fy <= rules.mild_up_to
    ratio = rules.cold_radius_mild if mild else rules.cold_radius_low_alloy
    radius = 1.0 / max(sharpest, 1e-12)
    membrane = strain * material.e
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


def roll_lines_of(
    places: Sequence[np.ndarray],
    rulings: np.ndarray,
    borders: Sequence[Sequence[np.ndarray]],
    forward: np.ndarray,
    rails: np.ndarray,
) -> list[tuple[RollLine, ...]]:
    """Lines of least curvature through the middle of the rulings at places (k,) of each plate.

    rulings: (n, 2, 2) their ends in the pattern, plate after plate. borders: chains (k, 2) of
    points per plate, the runs of the outline and the folds, which a roll line ends at. forward
    (n,): -1 in a mirrored pattern, where +s lies to the left of the rulings. rails: (n, 18) of the
    surfaces at the places, with first and second rates. Radii at the ends are interpolated between
    the places. A line whose middle lies outside the border is left out.
    """
    shape = shape_from(rails[:, :6], rails[:, 6:12], rails[:, 12:], _THREE)
    bend, twist = shape.bend[:, 1], shape.twist[:, 1]
    # Principal directions of [[bend, twist], [twist, 0]]; the least lies nearest the ruling.
    skew = 0.5 * np.arctan2(np.where(bend < 0.0, 2.0, -2.0) * twist, np.abs(bend))
    middle = 0.5 * (rulings[:, 0] + rulings[:, 1])
    ruling = rulings[:, 1] - rulings[:, 0]
    ruling = ruling / lengths(ruling)[:, None]
    ahead = forward[:, None] * np.stack([ruling[:, 1], -ruling[:, 0]], axis=1)
    along = np.cos(skew)[:, None] * ruling + np.sin(skew)[:, None] * ahead
    counts = [len(own) for own in places]
    below, above, inside = (
        np.concatenate(part)
        for part in zip(
            *map(_hits, parted(middle, counts), parted(along, counts), borders), strict=True
        )
    )
    reach = np.stack([below, above], axis=1)
    ends = middle[:, None] + along[:, None] * reach[..., None]
    # Along the edges +s is nearly the direction ahead: the end lies this much farther on.
    moved = np.concatenate(places)[:, None] + np.sin(skew)[:, None] * reach
    sharp = [shape.sharpest[:, 0].copy(), shape.sharpest[:, 1], shape.sharpest[:, 2].copy()]
    for side in (0, 2):
        moved_there = parted(moved[:, side // 2], counts)
        at_edge = parted(sharp[side], counts)
        sharp[side] = np.concatenate(list(map(np.interp, moved_there, places, at_edge)))
    sharp = np.stack(sharp, axis=1)
    radius = np.where(sharp > 1e-12, 1.0 / np.maximum(sharp, 1e-12), np.inf)
    found = []
    for own, ok, *rows in zip(
        places, *(parted(part, counts) for part in (inside, ends, radius, skew)), strict=True
    ):
        given = zip(own.tolist(), rows[0], rows[1], rows[2].tolist(), strict=True)
        kept = (row for row, good in zip(given, ok.tolist(), strict=True) if good)
        found.append(tuple(RollLine(f"R-{k}", *row) for k, row in enumerate(kept, start=1)))
    return found


def _hits(
    middle: np.ndarray, along: np.ndarray, border: Sequence[np.ndarray]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """How far lines from `middle` (n, 2) along unit vectors (n, 2) run back and forth to the first
    of the chains (k, 2) of points, and whether both ends are found: (n,) each."""
    points = np.concatenate(border)
    chained = np.ones(len(points) - 1, bool)
    chained[np.cumsum([len(chain) for chain in border])[:-1] - 1] = False
    left = np.stack([-along[:, 1], along[:, 0]], axis=1)
    side = points[:, 0] * left[:, :1] + points[:, 1] * left[:, 1:]
    side -= (middle * left).sum(axis=1)[:, None]
    behind = side <= 0.0
    line, at = np.nonzero((behind[:, :-1] != behind[:, 1:]) & chained)
    share = side[line, at] / (side[line, at] - side[line, at + 1])
    met = points[at] + share[:, None] * (points[at + 1] - points[at])
    place = ((met - middle[line]) * along[line]).sum(axis=1)
    below, above = np.full(len(middle), -np.inf), np.full(len(middle), np.inf)
    np.minimum.at(above, line[place > 0.0], place[place > 0.0])
    np.maximum.at(below, line[place <= 0.0], place[place <= 0.0])
    found = np.isfinite(above) & np.isfinite(below)
    return np.where(found, below, 0.0), np.where(found, above, 0.0), found


def _radius(curvature: float) -> float:
    """Radius, mm, of a curvature; infinite for what is flat to rounding."""
    return 1.0 / curvature if curvature > 1e-12 else np.inf


def pull_down(
    development: Development,
    shape: SurfaceShape,
    thickness: float,
    material: Material,
    mass: float,
    length: float,
) -> PullDown:
    """Moments and forces of holding the flat plate in shape, its weight helping where it can.

    Moment E·b·t³/12(1 − ν²)·κ, torque G·b·t³/3·τ, corner force G·t³/3·τ (plate theory). Weight
    W gives W·L/8 at mid-length of a plate held at its ends, and W/4 at each free corner of a
    plate held at two opposite ones; the clamp at mid-length has a lever of L/4. length: L, mm.
    """
    width = float(development.plane.values[..., 3].max())
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


def fold_bends(folds: Sequence, marking_face: str) -> tuple[FoldBend, ...]:
    """The fold lines of a plate (lofting.FoldLine) as the shop bends them."""
    return tuple(
        FoldBend(
            fold.label, fold.s, fold.angle, fold_direction(fold.angle, marking_face), fold.flat
        )
        for fold in folds
    )
