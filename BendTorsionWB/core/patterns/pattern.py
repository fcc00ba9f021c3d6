# SPDX-License-Identifier: LGPL-2.1-or-later
"""From a plate to its lofting record: pattern frame, outline, lines, points, panels, errors."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .. import tolerances
from ..flattening import measure
from ..flattening.development import (
    ACROSS,
    RULING_MODES,
    Development,
    Rulings,
    develop,
    flat_area,
    gauss_of,
    shape_inside,
    strain_at_nodes,
)
from ..flattening.elastic import relaxed
from ..geometry.piecewise import parted
from ..geometry.vectors import crossed, lengths
from ..lofting import DevelopedPlate, FoldLine, LoftingPoint, PanelMeasure, StationLine
from ..members.contour_measure import trimmed_area
from ..plates.face_marks import flat_marks
from ..plates.lines_across import LinesAcross, Pattern, across_of, turned
from ..plates.openings import flat_holes
from ..plates.plates import Plate
from .flattened_surface import on_surface
from .flattening_errors import flattening_errors
from .forming import FormingRules, fold_bends, forming_of, roll_lines_of
from .forming_record import RollLine
from .outline import outline_in_plane

MODES = (*RULING_MODES, "elastic")
"""Ways of laying a plate flat."""


def develop_plate(
    plate: Plate,
    marking_face: str = "inside",
    mode: str = "edges",
    rules: FormingRules | None = None,
    surface: str = "mid",
) -> DevelopedPlate:
    """The mid-surface of a plate laid flat, with everything a fitter measures.

    marking_face: `inside` or `outside`, the side the pattern is seen from. mode: one of MODES.
    surface: laid flat and measured in place of the middle, one of flattened_surface.SURFACES.
    Raises BendTorsionError when the plate folds over itself.
    """
    plate = on_surface(plate, surface)
    pattern, outline = pattern_and_outline(plate, mode, marking_face)
    development = pattern.development
    across = across_of(plate, pattern)
    folds = _folds(plate, pattern)
    lines = _lines(across)
    placing, flat_to_placing = _placing_frames(across)
    panels, errors = _panels(across, lines)
    corners = np.concatenate(outline)
    stretch = strain_at_nodes(development, ACROSS)
    stretch_inside = stretch.reshape(*development.plane.nodes.shape, -1)[:, 1:-1]
    shape = shape_inside(development.surface, ACROSS)
    worst_strain = float(np.abs(stretch).max())
    mass = plate.net_volume * plate.material.density
    holes, area_of_holes = flat_holes(plate, pattern)
    forming = forming_of(
        development,
        plate.thickness,
        plate.material,
        mass,
        float(np.hypot(*(across.flat[-1] - across.flat[0]).mean(axis=0))),
        [fold.angle for fold in folds],
        rules,
        shape=shape,
        stretch=stretch_inside.reshape(-1, len(ACROSS)),
        placed=lambda points: turned(points, pattern.turn) + pattern.shift,
        roll_lines=_roll_lines(across, outline, folds),
        fold_lines=fold_bends(folds, marking_face),
    )
    return DevelopedPlate(
        member=plate.member,
        mark=plate.mark,
        part=plate.mark,
        face=plate.face,
        letter=plate.letter,
        piece=plate.piece,
        thickness=plate.thickness,
        material=plate.material.name,
        outline=outline,
        lines=lines,
        folds=folds,
        points=_points(across, placing, marking_face),
        panels=panels,
        length=float(corners[:, 0].max()),
        width=float(corners[:, 1].max()),
        area=(trimmed_area(development, plate.cuts) if plate.is_cut else flat_area(development))
        - area_of_holes,
        mass=mass,
        volume=plate.net_volume,
        s_start=plate.start,
        s_end=plate.end,
        length_error_max=float(np.abs(errors).max()),
        length_error_rms=float(np.sqrt(np.mean(errors**2))),
        length_error_bound=_bound(development, across, lines, panels),
        strain_max=worst_strain,
        locked_in_stress=worst_strain * plate.material.e,
        bending_radius_min=_radius(float(shape.sharpest.max())),
        forming=forming.forming_class.name,
        marking_face=marking_face,
        placing=placing,
        flat_to_placing=flat_to_placing,
        in_transition=plate.in_transition,
        forming_data=forming,
        errors=flattening_errors(development, across.measured, lines, panels),
        holes=holes,
        marks=flat_marks(plate, pattern),
        chamfers=plate.chamfers,
    )


def pattern_and_outline(
    plate: Plate, mode: str = "edges", marking_face: str = "inside"
) -> tuple[Pattern, tuple[np.ndarray, ...]]:
    """The mid-surface of a plate laid flat in its pattern frame, and its outline there as smooth
    runs, counter-clockwise."""
    development = development_of(plate, mode)
    runs = outline_in_plane(development, plate)
    pattern, outline = _pattern_frame(development, plate, runs, marking_face)
    if _is_mirrored(pattern.turn):
        outline = tuple(run[::-1] for run in reversed(outline))
    return pattern, outline


def development_of(plate: Plate, mode: str) -> Development:
    """The mid-surface of a plate laid flat: `edges` keeps both edges, `energy` strains least of
    all patterns with rigid rulings, `elastic` of all patterns."""
    if mode == "elastic":
        start = develop(plate.rails.mid, plate.mark, "energy")
        return relaxed(start, plate.rails.mid_folds, plate.mark)
    return develop(plate.rails.mid, plate.mark, mode)


def outline_of(plate: Plate, mode: str = "edges") -> list[np.ndarray]:
    """The outline alone, as smooth runs in the development's plane."""
    return outline_in_plane(development_of(plate, mode), plate)


def pattern_of(
    plate: Plate, marking_face: str = "inside", mode: str = "edges", surface: str = "mid"
) -> Pattern:
    """The pattern frame of a plate, in which points are mapped both ways."""
    plate = on_surface(plate, surface)
    development = development_of(plate, mode)
    runs = outline_in_plane(development, plate)
    return _pattern_frame(development, plate, runs, marking_face)[0]


def _pattern_frame(
    development: Development, plate: Plate, runs: Sequence[np.ndarray], marking_face: str
) -> tuple[Pattern, tuple[np.ndarray, ...]]:
    """The pattern frame and the runs of the outline in it."""
    # Runs end with the end line and the start line.
    middles = [0.5 * (run[0] + run[-1]) for run in (runs[-1], runs[len(runs) // 2 - 1])]
    if development.correction is not None:
        middles = development.flat(np.array([plate.start, plate.end]), np.full(2, 0.5))
    u = (middles[1] - middles[0]) / lengths(middles[1] - middles[0])
    turn = np.array([u, [-u[1], u[0]]])
    # The plane is seen from the side of P' × R; the other face's view is its mirror image.
    seen_from_inside = plate.inward > 0
    if seen_from_inside != (marking_face == "inside"):
        turn[1] = -turn[1]
    points = turned(np.concatenate(runs), turn)
    shift = -points.min(axis=0)
    outline = parted(points + shift, [len(run) for run in runs])
    return Pattern(development, turn, shift), tuple(outline)


def _is_mirrored(turn: np.ndarray) -> bool:
    """Whether a matrix (2, 2) of unit rows turns the plane over."""
    return turn[0, 0] * turn[1, 1] < turn[0, 1] * turn[1, 0]


def _lines(across: LinesAcross) -> tuple[StationLine, ...]:
    true, flat = across.true_lengths(), across.flat_lengths()
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
        normal = crossed(tangent, value[:, 3:] - value[:, :3])
        normals.append(normal / lengths(normal)[:, None])
    ruling = rails(s)[:, 3:] - rails(s)[:, :3]
    ruling /= lengths(ruling)[:, None]
    turn = (crossed(normals[0], normals[1]) * ruling).sum(axis=1)
    angle = np.arctan2(turn, (normals[0] * normals[1]).sum(axis=1))
    # A turn of n = P' × R about +R tilts n forward: the side of n is convex there.
    convex = -plate.inward * angle
    return tuple(
        FoldLine(f"F-{i + 1}", plate.folds[i], float(convex[i]), flat[i]) for i in range(len(s))
    )


def _roll_lines(
    across: LinesAcross, outline: Sequence[np.ndarray], folds: Sequence[FoldLine]
) -> tuple[RollLine, ...]:
    """Roll lines through the middles of the smooth panels, which are sampled already."""
    measured = across.measured
    wave = measured.wave.reshape(-1, measure.FINEST + 1)
    # One for each panel, in the longest of its smooth intervals.
    order = np.lexsort((wave[:, 0] - wave[:, -1], measured.panels))
    panels, first = np.unique(measured.panels[order], return_index=True)
    middle = order[first] * wave.shape[1] + measure.FINEST // 2
    places = measured.places
    s = places[panels] + measured.wave[middle] * (places[panels + 1] - places[panels])
    rulings = Rulings(
        *(None if part is None else part[middle] for part in vars(measured.rulings).values())
    )
    zero, turn = np.zeros(len(s)), across.pattern.turn
    flat = np.stack([turned(rulings.flat(w), turn) for w in (zero, zero + 1.0)], axis=1)
    return roll_lines_of(
        across.pattern.development,
        s,
        flat + across.pattern.shift,
        [*outline, *(fold.flat for fold in folds)],
        float(np.sign(turn[0, 0] * turn[1, 1] - turn[0, 1] * turn[1, 0])),
        np.concatenate([rulings.first, rulings.first + rulings.ruling], axis=1),
    )


def _points(
    across: LinesAcross, placing: np.ndarray, marking_face: str
) -> tuple[LoftingPoint, ...]:
    plate, outer = across.plate, across.outer
    level = "outer" if marking_face == "outside" else "inner"
    face = getattr(across, level)
    width = lengths(face[:, 1] - face[:, 0])
    inset = np.minimum(tolerances.WITNESS_INSET, width / 4) / width
    inside, places = across.on_face(level, inset), across.edge_places()
    groups = {
        "P": ("arris", (outer[:, 0], outer[:, 1]), (across.flat[:, 0], across.flat[:, 1])),
        "W": (
            "witness",
            (inside[:, 0], inside[:, 1]),
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
                        float(places[i, side]),
                        xyz[i],
                        local[side][i],
                        flat[side][i],
                    )
                )
    return tuple(points)


def _panels(
    across: LinesAcross, lines: Sequence[StationLine]
) -> tuple[tuple[PanelMeasure, ...], np.ndarray]:
    """Panel measures, and all flat-minus-true lengths: edges, whole edges, diagonals, lines."""
    plate, measured = across.plate, across.lengths
    first, second = across.outer[:, 0], across.outer[:, 1]
    diagonals = measured.geodesics()
    measures = {
        f"edge {plate.edges[0]}": (measured.edge(0.0), first[1:] - first[:-1]),
        f"edge {plate.edges[1]}": (measured.edge(1.0), second[1:] - second[:-1]),
        "diagonal 1": (diagonals[0], second[1:] - first[:-1]),
        "diagonal 2": (diagonals[1], first[1:] - second[:-1]),
    }
    chords = {what: lengths(chord) for what, (_, chord) in measures.items()}
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
    lines_across: LinesAcross,
    lines: Sequence[StationLine],
    panels: Sequence[PanelMeasure],
) -> float:
    """The lower bound max |K|A²/(12(D + b + ℓ)) over the panels of a plate, mm: no flat pattern
    has smaller length errors on all sides and diagonals of that panel (self-stress of the plane
    quadrilateral; exact for rectangles, a few per cent high for panels that taper askew)."""
    places = lines_across.places
    gauss = gauss_of(development.surface, 0.5 * (places[1:] + places[:-1]), 0.5)
    arcs = np.array([panel.arc for panel in panels]).reshape(-1, 4)
    along, diagonal = 0.5 * (arcs[:, 0] + arcs[:, 1]), 0.5 * (arcs[:, 2] + arcs[:, 3])
    across = np.array([line.length_3d for line in lines])
    across = 0.5 * (across[1:] + across[:-1])
    area = lines_across.panel_areas(along, across)
    return float((np.abs(gauss) * area**2 / (12 * (diagonal + across + along))).max())


def _placing_frames(across: LinesAcross) -> tuple[np.ndarray, np.ndarray]:
    """Model -> placing and flat -> placing, (4, 4) each (paper's Orient on the outer face)."""
    outer, inner, flat = (values[[0, -1]] for values in (across.outer, across.inner, across.flat))
    widths = lengths(outer[:, 1] - outer[:, 0])
    start, other = (1, 0) if widths[1] < widths[0] - 0.01 else (0, 1)
    origin, x = outer[start, 0], outer[start, 1] - outer[start, 0]
    x = x / lengths(x)
    third = outer[other].mean(axis=0) - origin
    z = crossed(x, third)
    z /= lengths(z)
    if z @ (outer.mean(axis=(0, 1)) - inner.mean(axis=(0, 1))) < 0:
        z = -z
    placing = np.eye(4)
    placing[:3, :3] = np.array([x, crossed(z, x), z])
    placing[:3, 3] = -turned(origin[None], placing[:3, :3])[0]
    flat_origin = flat[start, 0]
    flat_x = flat[start, 1] - flat_origin
    flat_x = flat_x / lengths(flat_x)
    flat_y = np.array([-flat_x[1], flat_x[0]])
    if (flat_y @ (flat[other].mean(axis=0) - flat_origin)) * (placing[1, :3] @ third) < 0:
        flat_y = -flat_y
    flat_to_placing = np.eye(4)
    flat_to_placing[:2, :2] = np.array([flat_x, flat_y])
    flat_to_placing[2, 2] = -1.0 if _is_mirrored(flat_to_placing[:2, :2]) else 1.0
    flat_to_placing[:2, 3] = -turned(flat_origin[None], flat_to_placing[:2, :2])[0]
    return placing, flat_to_placing
