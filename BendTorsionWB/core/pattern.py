# SPDX-License-Identifier: LGPL-2.1-or-later
"""From a plate to its lofting record: pattern frame, outline, lines, points, panels, errors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from . import measure, tolerances
from .development import (
    ACROSS,
    RULING_MODES,
    Development,
    Rulings,
    crossed,
    develop,
    flat_area,
    gauss_of,
    shape_inside,
    strain_at_nodes,
)
from .elastic import relaxed
from .forming import FormingRules, classify
from .lofting import DevelopedPlate, FoldLine, LoftingPoint, PanelMeasure, StationLine
from .plates import Plate

MODES = (*RULING_MODES, "elastic")
"""Ways of laying a plate flat."""

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


def develop_plate(
    plate: Plate,
    marking_face: str = "inside",
    mode: str = "edges",
    rules: FormingRules | None = None,
) -> DevelopedPlate:
    """The mid-surface of a plate laid flat, with everything a fitter measures.

    marking_face: `inside` or `outside`, the side the pattern is seen from. mode: one of MODES.
    Raises BendTorsionError when the plate folds over itself.
    """
    development = development_of(plate, mode)
    runs = _outline_in_plane(development, plate)
    pattern, outline = _pattern_frame(development, plate, runs, marking_face)
    if np.linalg.det(pattern.turn) < 0:
        outline = tuple(run[::-1] for run in reversed(outline))
    across = _LinesAcross(plate, pattern)
    folds = _folds(plate, pattern)
    lines = _lines(across)
    placing, flat_to_placing = _placing_frames(across)
    panels, errors = _panels(across, lines)
    corners = np.concatenate(outline)
    stretch = strain_at_nodes(development, ACROSS)
    stretch_inside = stretch.reshape(*development.plane.nodes.shape, -1)[:, 1:-1]
    shape = shape_inside(development.surface, ACROSS)
    worst_strain = float(np.abs(stretch).max())
    forming = classify(
        development,
        shape,
        stretch_inside.reshape(-1, len(ACROSS)),
        plate.thickness,
        plate.material,
        [fold.angle for fold in folds],
        rules or FormingRules(),
    )
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
        folds=folds,
        points=_points(across, placing, marking_face),
        panels=panels,
        length=float(corners[:, 0].max()),
        width=float(corners[:, 1].max()),
        area=flat_area(development),
        mass=plate.volume * plate.material.density,
        volume=plate.volume,
        s_start=plate.start,
        s_end=plate.end,
        length_error_max=float(np.abs(errors).max()),
        length_error_rms=float(np.sqrt(np.mean(errors**2))),
        length_error_bound=_bound(development, across.places, lines, panels),
        strain_max=worst_strain,
        locked_in_stress=worst_strain * plate.material.e,
        bending_radius_min=_radius(float(shape.sharpest.max())),
        forming=forming.name,
        marking_face=marking_face,
        placing=placing,
        flat_to_placing=flat_to_placing,
        in_transition=plate.in_transition,
    )


def development_of(plate: Plate, mode: str) -> Development:
    """The mid-surface of a plate laid flat: `edges` keeps both edges, `energy` strains least of
    all patterns with rigid rulings, `elastic` of all patterns."""
    if mode == "elastic":
        start = develop(plate.rails.mid, plate.mark, "energy")
        return relaxed(start, plate.rails.mid_folds, plate.mark)
    return develop(plate.rails.mid, plate.mark, mode)


def outline_of(plate: Plate, mode: str = "edges") -> list[np.ndarray]:
    """The outline alone, as smooth runs in the development's plane."""
    return _outline_in_plane(development_of(plate, mode), plate)


class _LinesAcross:
    """What all lofting data reads at the lines across a plate, evaluated once: rulings of the
    mid-surface, corners of the outer face (n, 2, 3), ends in the pattern (n, 2, 2)."""

    def __init__(self, plate: Plate, pattern: Pattern):
        self.plate, self.pattern = plate, pattern
        self.places = np.array([line.s_mid for line in plate.lines])
        self.measured = measure.panel_samples(
            pattern.development, self.places, plate.rails.mid_folds
        )
        self.rulings: Rulings = self.measured.ends
        self.outer = plate.rails.outer(np.array([line.s for line in plate.lines]))
        self.outer = self.outer.reshape(-1, 2, 3)
        self.inner = plate.rails.inner(self.places).reshape(-1, 2, 3)
        zero = np.zeros(len(self.places))
        self.flat = np.stack([self.at(zero), self.at(zero + 1.0)], axis=1)

    def at(self, w: np.ndarray) -> np.ndarray:
        """Pattern points (n, 2) at w (n,) of the lines."""
        return turned(self.rulings.flat(w), self.pattern.turn) + self.pattern.shift

    def flat_lengths(self) -> np.ndarray:
        """Lengths (n,) of the lines in the pattern, along their curve when a correction bends
        them."""
        if self.rulings.correction is None:
            return np.linalg.norm(self.flat[:, 1] - self.flat[:, 0], axis=1)
        count = len(self.places)
        points = np.stack(
            [self.at(np.full(count, w)) for w in np.linspace(0.0, 1.0, measure.FINEST + 1)], axis=1
        )
        return measure.sampled_lengths(points)


def _outline_in_plane(development: Development, plate: Plate) -> list[np.ndarray]:
    """Smooth runs, head to tail, counter-clockwise in the plane: first edge along +s, end line,
    second edge back, start line."""
    edges = [plate.start, *plate.rails.mid_folds, plate.end]
    spans = [(a, b, w) for w in (0.0, 1.0) for a, b in zip(edges[:-1], edges[1:], strict=True)]
    probes = _along(development, [(a, b, w, 33) for a, b, w in spans])
    runs = _along(
        development,
        [(*span, _chord_count(points) + 1) for span, points in zip(spans, probes, strict=True)],
    )
    forth, back = runs[: len(edges) - 1], [run[::-1] for run in reversed(runs[len(edges) - 1 :])]
    ends = (plate.end, plate.start)
    end, start = (
        _end_line(development, s, a, b)
        for s, a, b in zip(ends, (forth[-1][-1], back[-1][-1]), (back[0][0], forth[0][0]))
    )
    return [*forth, end, *back, start]


def _along(
    development: Development, spans: Sequence[tuple[float, float, float, int]]
) -> list[np.ndarray]:
    """Points (n, 2) at n even places from a to b along the lines of constant w (a, b, w, n)."""
    s = np.concatenate([np.linspace(a, b, n) for a, b, _, n in spans])
    counts = [n for *_, n in spans]
    w = np.repeat([w for _, _, w, _ in spans], counts)
    return np.split(development.flat(s, w), np.cumsum(counts)[:-1])


def _chord_count(points: np.ndarray) -> int:
    """Chords that keep the sagitta of a run through evenly spaced points (33, 2)."""
    step = np.diff(points, axis=0)
    chords = np.sqrt((step * step).sum(axis=1))
    turn = np.diff(np.unwrap(np.arctan2(step[:, 1].copy(), step[:, 0].copy())))
    curvature = (np.abs(turn) / (0.5 * (chords[1:] + chords[:-1]))).max() + 1e-12
    longest = min(LONGEST_OUTLINE_CHORD, np.sqrt(8 * OUTLINE_SAGITTA / curvature))
    return max(2, int(np.ceil(chords.sum() / longest)))


def _end_line(development: Development, s: float, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The end line from a to b: straight, unless a correction bends the rulings."""
    if development.correction is None:
        return np.array([a, b])
    w = np.linspace(0.0, 1.0, 33)
    points = development.flat(np.full(33, s), w)
    points = points if np.allclose(points[0], a) else points[::-1]
    return np.concatenate([[a], points[1:-1], [b]])


def _pattern_frame(
    development: Development, plate: Plate, runs: Sequence[np.ndarray], marking_face: str
) -> tuple[Pattern, tuple[np.ndarray, ...]]:
    """The pattern frame and the runs of the outline in it."""
    # Runs end with the end line and the start line.
    middles = [0.5 * (run[0] + run[-1]) for run in (runs[-1], runs[len(runs) // 2 - 1])]
    if development.correction is not None:
        middles = development.flat(np.array([plate.start, plate.end]), np.full(2, 0.5))
    u = (middles[1] - middles[0]) / np.linalg.norm(middles[1] - middles[0])
    turn = np.array([u, [-u[1], u[0]]])
    # The plane is seen from the side of P' × R; the other face's view is its mirror image.
    seen_from_inside = plate.inward > 0
    if seen_from_inside != (marking_face == "inside"):
        turn[1] = -turn[1]
    points = turned(np.concatenate(runs), turn)
    shift = -points.min(axis=0)
    ends = np.cumsum([len(run) for run in runs])[:-1]
    return Pattern(development, turn, shift), tuple(np.split(points + shift, ends))


def _lines(across: _LinesAcross) -> tuple[StationLine, ...]:
    ruling = across.rulings.ruling
    true = np.sqrt((ruling * ruling).sum(axis=1))
    flat = across.flat_lengths()
    return tuple(
        StationLine(line.label, line.s, across.flat[i], float(true[i]), float(flat[i]))
        for i, line in enumerate(across.plate.lines)
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
    across: _LinesAcross, placing: np.ndarray, marking_face: str
) -> tuple[LoftingPoint, ...]:
    plate, outer = across.plate, across.outer
    face = outer if marking_face == "outside" else across.inner
    between = face[:, 1] - face[:, 0]
    width = np.linalg.norm(between, axis=1)
    inset = np.minimum(tolerances.WITNESS_INSET, width / 4) / width
    step = inset[:, None] * between
    groups = {
        "P": ("arris", (outer[:, 0], outer[:, 1]), (across.flat[:, 0], across.flat[:, 1])),
        "W": (
            "witness",
            (face[:, 0] + step, face[:, 1] - step),
            (across.at(inset), across.at(1.0 - inset)),
        ),
    }
    points = []
    for letter, (kind, (first, second), flat) in groups.items():
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
    across: _LinesAcross, lines: Sequence[StationLine]
) -> tuple[tuple[PanelMeasure, ...], np.ndarray]:
    """Panel measures, and all flat-minus-true lengths: edges, whole edges, diagonals, lines."""
    plate, measured = across.plate, across.measured
    first, second = across.outer[:, 0], across.outer[:, 1]
    diagonals = measured.geodesics()
    measures = {
        f"edge {plate.edges[0]}": (measured.edge(0.0), first[1:] - first[:-1]),
        f"edge {plate.edges[1]}": (measured.edge(1.0), second[1:] - second[:-1]),
        "diagonal 1": (diagonals[0], second[1:] - first[:-1]),
        "diagonal 2": (diagonals[1], first[1:] - second[:-1]),
    }
    chords = {what: np.linalg.norm(chord, axis=1) for what, (_, chord) in measures.items()}
    panels, errors = [], []
    for i in range(measured.count):
        name = f"{plate.lines[i].label}/{plate.lines[i + 1].label}"
        for what, ((flat, arc), _) in measures.items():
            panels.append(
                PanelMeasure(name, what, float(flat[i]), float(arc[i]), float(chords[what][i]))
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
    gauss = gauss_of(development.surface, 0.5 * (places[1:] + places[:-1]), 0.5)
    lengths = np.array([panel.arc for panel in panels]).reshape(-1, 4)
    along, diagonal = lengths[:, :2].mean(axis=1), lengths[:, 2:].mean(axis=1)
    across = np.array([line.length_3d for line in lines])
    across = 0.5 * (across[1:] + across[:-1])
    area = along * across
    return float((np.abs(gauss) * area**2 / (12 * (diagonal + across + along))).max())


def _placing_frames(across: _LinesAcross) -> tuple[np.ndarray, np.ndarray]:
    """Model -> placing and flat -> placing, (4, 4) each (paper's Orient on the outer face)."""
    outer, inner, flat = (values[[0, -1]] for values in (across.outer, across.inner, across.flat))
    lengths = np.linalg.norm(outer[:, 1] - outer[:, 0], axis=1)
    start, other = (1, 0) if lengths[1] < lengths[0] - 0.01 else (0, 1)
    origin, x = outer[start, 0], outer[start, 1] - outer[start, 0]
    x = x / np.linalg.norm(x)
    third = outer[other].mean(axis=0) - origin
    z = crossed(x, third)
    z /= np.linalg.norm(z)
    if z @ (outer.mean(axis=(0, 1)) - inner.mean(axis=(0, 1))) < 0:
        z = -z
    placing = np.eye(4)
    placing[:3, :3] = np.array([x, crossed(z, x), z])
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
