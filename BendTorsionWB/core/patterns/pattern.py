# SPDX-License-Identifier: LGPL-2.1-or-later
"""From plates to their lofting records: pattern frame, outline, and what is measured there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..flattening.development import (
    ACROSS,
    RULING_MODES,
    Development,
    develop_together,
)
from ..flattening.developments import Developments
from ..flattening.elastic import relaxed
from ..geometry.piecewise import parted
from ..geometry.vectors import lengths
from ..lofting import DevelopedPlate, plate_identity
from ..members.contour_measure import trimmed_area
from ..plates.face_marks import flat_marks
from ..plates.lines_across import LinesAcross, Pattern, turned, turned_each
from ..plates.openings import flat_holes
from ..plates.plates import Plate
from .flattened_surface import on_surface
from .forming import FormingRules, fold_bends, forming_of
from .outline import outline_in_plane, outlines_in_plane
from .plate_measures import (
    PanelLengths,
    fold_lines,
    lofting_points,
    placing_frames,
    roll_lines,
    station_lines,
)

MODES = (*RULING_MODES, "elastic")
"""Ways of laying a plate flat."""


def develop_plate(
    plate: Plate,
    marking_face: str = "inside",
    mode: str = "edges",
    rules: FormingRules | None = None,
    surface: str = "mid",
) -> DevelopedPlate:
    """The mid-surface of a plate laid flat, as develop_plates."""
    return develop_plates([plate], marking_face, mode, rules, surface)[0]


def develop_plates(
    plates: Sequence[Plate],
    marking_face: str = "inside",
    mode: str = "edges",
    rules: FormingRules | None = None,
    surface: str = "mid",
) -> list[DevelopedPlate]:
    """The mid-surfaces of plates laid flat, with everything a fitter measures.

    marking_face: `inside` or `outside`, the side the pattern is seen from. mode: one of MODES.
    surface: laid flat and measured in place of the middle, one of flattened_surface.SURFACES.
    Raises BendTorsionError for the first plate that folds over itself.
    """
    if not plates:
        return []
    plates = [on_surface(plate, surface) for plate in plates]
    developments = Developments(tuple(developments_of(plates, mode)))
    runs = outlines_in_plane(developments, plates)
    patterns, outlines = _pattern_frames(developments, plates, runs, marking_face)
    across = LinesAcross(plates, patterns, developments)
    folds, lines = fold_lines(across), station_lines(across)
    rolled = roll_lines(across, outlines, folds)
    placing, flat_to_placing = placing_frames(across)
    points = lofting_points(across, placing, marking_face)
    measured = PanelLengths(across, lines)
    areas = developments.flat_areas()
    panels, errors, bounds = measured.measures(), measured.errors(areas), measured.bounds()
    pieces = developments.pieces
    inside = [n * (developments.plane.shape[1] - 2) for n in pieces]
    shapes = developments.shape_inside(ACROSS).parted(inside)
    stretch = developments.strain_at_nodes(ACROSS)
    stretch = parted(stretch.reshape(*developments.plane.shape[:2], -1), pieces)
    found = []
    for k, (plate, pattern) in enumerate(zip(plates, patterns, strict=True)):
        corners = np.concatenate(outlines[k])
        worst_strain = float(np.abs(stretch[k]).max())
        mass = plate.net_volume * plate.material.density
        holes, area_of_holes = flat_holes(plate, pattern)
        area = trimmed_area(pattern.development, plate.cuts) if plate.is_cut else float(areas[k])
        ends = across.flat[[across.starts[k], across.ends[k] - 1]]
        forming = forming_of(
            pattern.development,
            plate.thickness,
            plate.material,
            mass,
            float(np.hypot(*(ends[1] - ends[0]).mean(axis=0))),
            [fold.angle for fold in folds[k]],
            rules,
            shape=shapes[k],
            stretch=stretch[k][:, 1:-1].reshape(-1, len(ACROSS)),
            placed=lambda points, own=pattern: turned(points, own.turn) + own.shift,
            roll_lines=rolled[k],
            fold_lines=fold_bends(folds[k], marking_face),
        )
        every, by_kind = errors[k]
        found.append(
            DevelopedPlate(
                **plate_identity(plate),
                outline=outlines[k],
                lines=lines[k],
                folds=folds[k],
                points=points[k],
                panels=panels[k],
                length=float(corners[:, 0].max()),
                width=float(corners[:, 1].max()),
                area=area - area_of_holes,
                mass=mass,
                volume=plate.net_volume,
                s_start=plate.start,
                s_end=plate.end,
                length_error_max=float(np.abs(every).max()),
                length_error_rms=float(np.sqrt(np.mean(every**2))),
                length_error_bound=bounds[k],
                strain_max=worst_strain,
                locked_in_stress=worst_strain * plate.material.e,
                bending_radius_min=forming.bending_radius_min,
                forming=forming.forming_class.name,
                marking_face=marking_face,
                placing=placing[k],
                flat_to_placing=flat_to_placing[k],
                in_transition=plate.in_transition,
                forming_data=forming,
                errors=by_kind,
                holes=holes,
                marks=flat_marks(plate, pattern),
                chamfers=plate.chamfers,
            )
        )
    return found


def pattern_and_outline(
    plate: Plate, mode: str = "edges", marking_face: str = "inside"
) -> tuple[Pattern, tuple[np.ndarray, ...]]:
    """The mid-surface of a plate laid flat in its pattern frame, and its outline there as smooth
    runs, counter-clockwise."""
    developments = Developments(tuple(developments_of([plate], mode)))
    runs = outlines_in_plane(developments, [plate])
    (pattern,), (outline,) = _pattern_frames(developments, [plate], runs, marking_face)
    return pattern, outline


def developments_of(plates: Sequence[Plate], mode: str) -> list[Development]:
    """The mid-surfaces of plates laid flat: `edges` keeps both edges, `energy` strains least of
    all patterns with rigid rulings, `elastic` of all patterns."""
    rails, marks = [plate.rails.mid for plate in plates], [plate.mark for plate in plates]
    if mode == "elastic":
        starts = develop_together(rails, marks, "energy")
        return [
            relaxed(start, plate.rails.mid_folds, plate.mark)
            for start, plate in zip(starts, plates, strict=True)
        ]
    return develop_together(rails, marks, mode)


def development_of(plate: Plate, mode: str) -> Development:
    """As developments_of, of one plate."""
    return developments_of([plate], mode)[0]


def outline_of(plate: Plate, mode: str = "edges") -> list[np.ndarray]:
    """The outline alone, as smooth runs in the development's plane."""
    return outline_in_plane(development_of(plate, mode), plate)


def pattern_of(
    plate: Plate, marking_face: str = "inside", mode: str = "edges", surface: str = "mid"
) -> Pattern:
    """The pattern frame of a plate, in which points are mapped both ways."""
    return pattern_and_outline(on_surface(plate, surface), mode, marking_face)[0]


def _pattern_frames(
    developments: Developments,
    plates: Sequence[Plate],
    runs: Sequence[Sequence[np.ndarray]],
    marking_face: str,
) -> tuple[list[Pattern], list[tuple[np.ndarray, ...]]]:
    """The pattern frames and the outlines in them, counter-clockwise."""
    # Runs end with the end line and the start line.
    ends = np.array(
        [[[line[0], line[-1]] for line in (own[-1], own[len(own) // 2 - 1])] for own in runs]
    )
    middles = 0.5 * (ends[:, :, 0] + ends[:, :, 1])
    if developments.corrected:
        places = [np.array([plate.start, plate.end]) for plate in plates]
        middles = developments.flat(places, np.full(2 * len(plates), 0.5)).reshape(-1, 2, 2)
    u = middles[:, 1] - middles[:, 0]
    u = u / lengths(u)[:, None]
    turn = np.stack([u, np.stack([-u[:, 1], u[:, 0]], axis=1)], axis=1)
    # The plane is seen from the side of P' × R; the other face's view is its mirror image.
    seen_from_inside = np.array([plate.inward > 0 for plate in plates])
    turn[seen_from_inside != (marking_face == "inside"), 1] *= -1.0
    sizes = [[len(run) for run in own] for own in runs]
    counts = np.array([sum(own) for own in sizes])
    points = np.concatenate([run for own in runs for run in own])
    points = turned_each(points, np.repeat(turn, counts, axis=0))
    shift = -np.minimum.reduceat(points, np.cumsum(counts) - counts, axis=0)
    points += np.repeat(shift, counts, axis=0)
    patterns, outlines = [], []
    for k, own in enumerate(parted(points, counts.tolist())):
        patterns.append(Pattern(developments.each[k], turn[k], shift[k]))
        outline = parted(own, sizes[k])
        if turn[k, 0, 0] * turn[k, 1, 1] < turn[k, 0, 1] * turn[k, 1, 0]:
            outline = [run[::-1] for run in reversed(outline)]
        outlines.append(tuple(outline))
    return patterns, outlines
