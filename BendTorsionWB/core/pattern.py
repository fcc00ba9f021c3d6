# SPDX-License-Identifier: LGPL-2.1-or-later
"""From a plate to its lofting record: pattern frame, outline, lines, points, panels, errors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from . import measure, tolerances
from .development import ACROSS, Development, develop, shape_of, strain
from .lofting import DevelopedPlate, FoldLine, LoftingPoint, PanelMeasure, StationLine
from .piecewise import Piecewise
from .plates import Plate

OUTLINE_SAGITTA = 0.0005
LONGEST_OUTLINE_CHORD = 40.0


@dataclass(frozen=True, eq=False)
class Pattern:
    """A development in the pattern frame: (u, v) = turn @ plane point + shift."""

    development: Development
    turn: np.ndarray
    shift: np.ndarray

    def flat(self, s: np.ndarray, w: np.ndarray) -> np.ndarray:
        """Pattern points (n, 2) at (s, w)."""
        return turned(self.development.flat(s, w), self.turn) + self.shift


def turned(points: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """turn @ point for points (n, d). Not by BLAS, whose last bits vary with the alignment of
    memory from run to run: the same input must give the same bytes."""
    return sum(points[:, k, None] * turn[:, k] for k in range(points.shape[1]))


def develop_plate(plate: Plate, marking_face: str = "inside") -> DevelopedPlate:
    """The mid-surface of a plate laid flat, with everything a fitter measures.

    marking_face: `inside` or `outside`, the side the pattern is seen from. Raises BendTorsionError
    when the plate folds over itself.
    """
    development = develop(plate.rails.mid, plate.mark)
    runs = _outline_in_plane(development, plate)
    pattern = _pattern_frame(development, plate, runs, marking_face)
    outline = tuple(turned(run, pattern.turn) + pattern.shift for run in runs)
    if np.linalg.det(pattern.turn) < 0:
        outline = tuple(run[::-1] for run in reversed(outline))
    places = np.array([line.s_mid for line in plate.lines])
    lines = _lines(plate, pattern, places)
    placing, flat_to_placing = _placing_frames(plate, pattern)
    panels, errors = _panels(plate, development, places, lines)
    corners = np.concatenate(outline)
    stretch = strain(development, development.plane.nodes.ravel(), ACROSS)
    shape = shape_of(development.surface, development.plane.nodes[:, 1:-1].ravel(), ACROSS)
    worst_strain = float(np.abs(stretch).max())
    return DevelopedPlate(
        member=plate.member,
        mark=plate.mark,
        part=plate.mark,
        face=plate.face,
        letter=plate.letter,
        piece=1,
        thickness=plate.thickness,
        material=plate.material.name,
        outline=outline,
        lines=lines,
        folds=_folds(plate, pattern),
        points=_points(plate, pattern, places, placing, marking_face),
        panels=panels,
        length=float(corners[:, 0].max()),
        width=float(corners[:, 1].max()),
        area=_area(development),
        mass=plate.volume * plate.material.density,
        volume=plate.volume,
        s_start=plate.start,
        s_end=plate.end,
        length_error_max=float(np.abs(errors).max()),
        length_error_rms=float(np.sqrt(np.mean(errors**2))),
        length_error_bound=_bound(development, places, lines, panels),
        strain_max=worst_strain,
        locked_in_stress=worst_strain * plate.material.e,
        bending_radius_min=_radius(float(shape.sharpest.max())),
        forming=None,
        marking_face=marking_face,
        placing=placing,
        flat_to_placing=flat_to_placing,
        in_transition=plate.in_transition,
    )


def _outline_in_plane(development: Development, plate: Plate) -> list[np.ndarray]:
    """Smooth runs, head to tail, counter-clockwise in the plane: first edge along +s, end line,
    second edge back, start line."""
    runs = [_edge_runs(development, plate, 0.0), _edge_runs(development, plate, 1.0)]
    forth, back = runs[0], [run[::-1] for run in reversed(runs[1])]
    end = np.array([forth[-1][-1], back[0][0]])
    start = np.array([back[-1][-1], forth[0][0]])
    return [*forth, end, *back, start]


def _edge_runs(development: Development, plate: Plate, w: float) -> list[np.ndarray]:
    edges = [plate.start, *plate.rails.mid_folds, plate.end]
    runs = []
    for a, b in zip(edges[:-1], edges[1:], strict=True):
        probe = np.linspace(a, b, 33)
        points = development.flat(probe, np.full(33, w))
        chords = np.linalg.norm(np.diff(points, axis=0), axis=1)
        step_u, step_v = np.diff(points, axis=0).T.copy()
        turn = np.diff(np.unwrap(np.arctan2(step_v, step_u)))
        curvature = (np.abs(turn) / (0.5 * (chords[1:] + chords[:-1]))).max() + 1e-12
        longest = min(LONGEST_OUTLINE_CHORD, np.sqrt(8 * OUTLINE_SAGITTA / curvature))
        count = max(2, int(np.ceil(chords.sum() / longest)))
        runs.append(development.flat(np.linspace(a, b, count + 1), np.full(count + 1, w)))
    return runs


def _pattern_frame(
    development: Development, plate: Plate, runs: Sequence[np.ndarray], marking_face: str
) -> Pattern:
    ends = np.array([plate.start, plate.end])
    middles = development.flat(ends, np.full(2, 0.5))
    u = (middles[1] - middles[0]) / np.linalg.norm(middles[1] - middles[0])
    turn = np.array([u, [-u[1], u[0]]])
    # The plane is seen from the side of P' × R; the other face's view is its mirror image.
    seen_from_inside = plate.inward > 0
    if seen_from_inside != (marking_face == "inside"):
        turn[1] = -turn[1]
    corner = np.concatenate([turned(run, turn) for run in runs]).min(axis=0)
    return Pattern(development, turn, -corner)


def _lines(plate: Plate, pattern: Pattern, places: np.ndarray) -> tuple[StationLine, ...]:
    zero, one = np.zeros(len(places)), np.ones(len(places))
    first, second = pattern.flat(places, zero), pattern.flat(places, one)
    surface = pattern.development
    true = np.linalg.norm(surface.point(places, one) - surface.point(places, zero), axis=1)
    flat = np.linalg.norm(second - first, axis=1)
    return tuple(
        StationLine(line.label, line.s, np.array([first[i], second[i]]), float(true[i]),
                    float(flat[i]))
        for i, line in enumerate(plate.lines)
    )


def _folds(plate: Plate, pattern: Pattern) -> tuple[FoldLine, ...]:
    if not plate.folds:
        return ()
    s = np.array([line.s_mid for line in plate.lines if line.label.startswith("F")])
    flat = np.stack([pattern.flat(s, np.zeros(len(s))), pattern.flat(s, np.ones(len(s)))], axis=1)
    rails = pattern.development.surface
    normals = []
    for side in ("earlier", "later"):
        value, rate = rails(s, side), rails.derivative(s, side)
        tangent = 0.5 * (rate[:, :3] + rate[:, 3:])
        normal = np.cross(tangent, value[:, 3:] - value[:, :3])
        normals.append(normal / np.linalg.norm(normal, axis=1, keepdims=True))
    ruling = rails(s)[:, 3:] - rails(s)[:, :3]
    ruling /= np.linalg.norm(ruling, axis=1, keepdims=True)
    turn = (np.cross(normals[0], normals[1]) * ruling).sum(axis=1)
    angle = np.arctan2(turn, (normals[0] * normals[1]).sum(axis=1))
    # A turn of n = P' × R about +R tilts n forward: the side of n is convex there.
    convex = -plate.inward * angle
    return tuple(
        FoldLine(f"F-{i + 1}", plate.folds[i], float(convex[i]), flat[i]) for i in range(len(s))
    )


def _points(
    plate: Plate,
    pattern: Pattern,
    places: np.ndarray,
    placing: np.ndarray,
    marking_face: str,
) -> tuple[LoftingPoint, ...]:
    outer = plate.rails.outer(np.array([line.s for line in plate.lines])).reshape(-1, 2, 3)
    face = outer if marking_face == "outside" else plate.rails.inner(places).reshape(-1, 2, 3)
    across = face[:, 1] - face[:, 0]
    width = np.linalg.norm(across, axis=1)
    inset = np.minimum(tolerances.WITNESS_INSET, width / 4) / width
    zero = np.zeros(len(places))
    groups = {
        "arris": (outer[:, 0], outer[:, 1], zero, zero + 1.0),
        "witness": (
            face[:, 0] + inset[:, None] * across,
            face[:, 1] - inset[:, None] * across,
            inset,
            1.0 - inset,
        ),
    }
    points = []
    for kind, letter in (("arris", "P"), ("witness", "W")):
        first, second, w_first, w_second = groups[kind]
        flat = (pattern.flat(places, w_first), pattern.flat(places, w_second))
        local = tuple(turned(xyz, placing[:3, :3]) + placing[:3, 3] for xyz in (first, second))
        for i, line in enumerate(plate.lines):
            for side, xyz in enumerate((first, second)):
                points.append(
                    LoftingPoint(
                        f"{letter}-{2 * i + side + 1}",
                        line.label,
                        plate.edges[side],
                        kind,
                        line.s,
                        xyz[i],
                        local[side][i],
                        flat[side][i],
                    )
                )
    return tuple(points)


def _panels(
    plate: Plate,
    development: Development,
    places: np.ndarray,
    lines: Sequence[StationLine],
) -> tuple[tuple[PanelMeasure, ...], np.ndarray]:
    """Panel measures, and all flat-minus-true lengths: edges, whole edges, diagonals, lines."""
    outer = plate.rails.outer(np.array([line.s for line in plate.lines])).reshape(-1, 2, 3)
    first, second = outer[:, 0], outer[:, 1]
    folds = plate.rails.mid_folds
    measures = {
        f"edge {plate.edges[0]}": (
            measure.edge_lengths(development, places, folds, 0.0),
            np.linalg.norm(np.diff(first, axis=0), axis=1),
        ),
        f"edge {plate.edges[1]}": (
            measure.edge_lengths(development, places, folds, 1.0),
            np.linalg.norm(np.diff(second, axis=0), axis=1),
        ),
        "diagonal 1": (
            measure.geodesic_lengths(development, places, folds, 0.0),
            np.linalg.norm(second[1:] - first[:-1], axis=1),
        ),
        "diagonal 2": (
            measure.geodesic_lengths(development, places, folds, 1.0),
            np.linalg.norm(first[1:] - second[:-1], axis=1),
        ),
    }
    panels, errors = [], []
    for i in range(len(places) - 1):
        name = f"{plate.lines[i].label}/{plate.lines[i + 1].label}"
        for what, ((flat, arc), chord) in measures.items():
            panels.append(
                PanelMeasure(name, what, float(flat[i]), float(arc[i]), float(chord[i]))
            )
    for what, ((flat, arc), _) in measures.items():
        errors.append(flat - arc)
        if what.startswith("edge"):
            errors.append([flat.sum() - arc.sum()])
    errors.append([line.length_flat - line.length_3d for line in lines])
    return tuple(panels), np.concatenate(errors)


def _radius(curvature: float) -> float:
    """Radius, mm, of a curvature; infinite for what is flat to rounding."""
    return 1.0 / curvature if curvature > 1e-12 else np.inf


def _bound(
    development: Development,
    places: np.ndarray,
    lines: Sequence[StationLine],
    panels: Sequence[PanelMeasure],
) -> float:
    """The lower bound max |K|A²/(12(D + b + ℓ)) over the panels of a plate, mm: no flat pattern
    has smaller length errors on all sides and diagonals of that panel (self-stress of the plane
    quadrilateral; exact for rectangles, a few per cent high for panels that taper askew)."""
    gauss = shape_of(development.surface, 0.5 * (places[1:] + places[:-1]), np.array([0.5])).gauss
    lengths = np.array([panel.arc for panel in panels]).reshape(-1, 4)
    along, diagonal = lengths[:, :2].mean(axis=1), lengths[:, 2:].mean(axis=1)
    across = np.array([line.length_3d for line in lines])
    across = 0.5 * (across[1:] + across[:-1])
    area = along * across
    return float((np.abs(gauss[:, 0]) * area**2 / (12 * (diagonal + across + along))).max())


def _area(development: Development) -> float:
    """Area of the flat pattern, mm2: ∫ρ(p − m/2)ds of the finished plane curves."""
    plane, slope = development.plane.values, development.plane.derivative.values
    along = slope[..., 0] * np.cos(plane[..., 2]) + slope[..., 1] * np.sin(plane[..., 2])
    width = plane[..., 3]
    strip = width * along - 0.5 * width**2 * slope[..., 2]
    return float(Piecewise(development.plane.breaks, strip[..., None]).integral()[0])


def _placing_frames(plate: Plate, pattern: Pattern) -> tuple[np.ndarray, np.ndarray]:
    """Model -> placing and flat -> placing, (4, 4) each (paper's Orient on the outer face)."""
    ends = np.array([plate.start, plate.end])
    outer = plate.rails.outer(ends).reshape(2, 2, 3)
    inner = plate.rails.inner(ends).reshape(2, 2, 3)
    lengths = np.linalg.norm(outer[:, 1] - outer[:, 0], axis=1)
    start, other = (1, 0) if lengths[1] < lengths[0] - 0.01 else (0, 1)
    flat = np.stack([pattern.flat(ends, np.zeros(2)), pattern.flat(ends, np.ones(2))], axis=1)
    origin, x = outer[start, 0], outer[start, 1] - outer[start, 0]
    x = x / np.linalg.norm(x)
    third = outer[other].mean(axis=0) - origin
    z = np.cross(x, third)
    z /= np.linalg.norm(z)
    if z @ (outer.mean(axis=(0, 1)) - inner.mean(axis=(0, 1))) < 0:
        z = -z
    placing = np.eye(4)
    placing[:3, :3] = np.array([x, np.cross(z, x), z])
    placing[:3, 3] = -turned(origin[None], placing[:3, :3])[0]
    flat_origin = flat[start, 0]
    flat_x = flat[start, 1] - flat_origin
    flat_x = flat_x / np.linalg.norm(flat_x)
    flat_y = np.array([-flat_x[1], flat_x[0]])
    if (flat_y @ (flat[other].mean(axis=0) - flat_origin)) * (placing[1, :3] @ third) < 0:
        flat_y = -flat_y
    flat_to_placing = np.eye(4)
    flat_to_placing[:2, :2] = np.array([flat_x, flat_y])
    flat_to_placing[2, 2] = np.sign(np.linalg.det(flat_to_placing[:2, :2]))
    flat_to_placing[:2, 3] = -turned(flat_origin[None], flat_to_placing[:2, :2])[0]
    return placing, flat_to_placing
