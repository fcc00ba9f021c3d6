# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a fitter measures on flat patterns: lines, folds, roll lines, points, panels, errors, and
the placing frames. All plates of a member together; each list is in their order."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np

from .. import tolerances
from ..columns import Columns
from ..flattening import measure
from ..flattening.surface_shape import gauss_from
from ..geometry.piecewise import Together, derivatives_together, parted
from ..geometry.vectors import crossed, dots, lengths
from ..lofting import FlatteningErrors, FoldLine, LoftingPoint, PanelMeasure, StationLine
from ..plates.lines_across import LinesAcross, turned_each
from .forming import roll_lines_of
from .forming_record import RollLine


def station_lines(across: LinesAcross) -> list[tuple[StationLine, ...]]:
    """The measuring lines with their lengths."""
    true, flat = across.true_lengths().tolist(), across.flat_lengths().tolist()
    lines = [line for plate in across.plates for line in plate.lines]
    made = [
        StationLine(line.label, line.s, *own)
        for line, *own in zip(lines, across.flat, true, flat, strict=True)
    ]
    return parted(tuple(made), across.counts)


def fold_lines(across: LinesAcross) -> list[tuple[FoldLine, ...]]:
    """The folds and their angles."""
    plates = across.plates
    rows = np.array(
        [line.label.startswith("F") for plate in plates for line in plate.lines], dtype=bool
    )
    if not rows.any():
        return [()] * len(plates)
    folded = [plate for plate in plates if plate.folds]
    counts = [len(plate.folds) for plate in folded]
    s = parted(across.places[rows], counts)
    rails = [plate.rails.mid for plate in folded]
    whole, rates = Together(rails), Together(derivatives_together(rails))
    normals = []
    for side in ("earlier", "later"):
        value, rate = whole(s, side), rates(s, side)
        tangent = 0.5 * (rate[:, :3] + rate[:, 3:])
        normal = crossed(tangent, value[:, 3:] - value[:, :3])
        normals.append(normal / lengths(normal)[:, None])
    ruling = across.rulings.ruling[rows]
    ruling = ruling / lengths(ruling)[:, None]
    turn = dots(crossed(normals[0], normals[1]), ruling)
    angle = np.arctan2(turn, dots(normals[0], normals[1]))
    inward = np.repeat([float(plate.inward) for plate in folded], counts)
    # A turn of n = P' × R about +R tilts n forward: the side of n is convex there.
    convex = parted((-inward * angle).tolist(), counts)
    flat = parted(across.flat[rows], counts)
    made = iter(
        tuple(
            FoldLine(f"F-{i + 1}", plate.folds[i], angles[i], places[i])
            for i in range(len(plate.folds))
        )
        for plate, angles, places in zip(folded, convex, flat, strict=True)
    )
    return [next(made) if plate.folds else () for plate in plates]


def roll_lines(
    across: LinesAcross,
    outlines: Sequence[Sequence[np.ndarray]],
    folds: Sequence[Sequence[FoldLine]],
) -> list[tuple[RollLine, ...]]:
    """Roll lines through the middles of the smooth panels, which are sampled already."""
    measured = across.measured
    wave = measured.wave.reshape(-1, measure.FINEST + 1)
    # One for each panel, in the longest of its smooth intervals.
    order = np.lexsort((wave[:, 0] - wave[:, -1], measured.panels))
    panels, first = np.unique(measured.panels[order], return_index=True)
    middle = order[first] * wave.shape[1] + measure.FINEST // 2
    places = measured.places
    s = places[panels] + measured.wave[middle] * (places[panels + 1] - places[panels])
    rulings = measured.rulings.of(middle)
    counts = [count - 1 for count in across.counts]
    rails = across.developments.rails_at(parted(s, counts))
    zero = np.zeros(len(s))
    turn = np.stack([pattern.turn for pattern in across.patterns])
    shift = np.stack([pattern.shift for pattern in across.patterns])
    owner = np.repeat(np.arange(len(counts)), counts)
    flat = np.stack([turned_each(rulings.flat(w), turn[owner]) for w in (zero, zero + 1.0)], axis=1)
    hand = np.sign(turn[:, 0, 0] * turn[:, 1, 1] - turn[:, 0, 1] * turn[:, 1, 0])
    return roll_lines_of(
        parted(s, counts),
        flat + shift[owner][:, None],
        [
            [*outline, *(fold.flat for fold in own)]
            for outline, own in zip(outlines, folds, strict=True)
        ],
        hand[owner],
        rails,
    )


def lofting_points(
    across: LinesAcross, placing: Sequence[np.ndarray], marking_face: str
) -> list[Columns]:
    """Arris and witness points, LoftingPoint, two of each per line."""
    outer = across.outer
    level = "outer" if marking_face == "outside" else "inner"
    face = getattr(across, level)
    width = lengths(face[:, 1] - face[:, 0])
    inset = np.minimum(tolerances.WITNESS_INSET, width / 4) / width
    witness_flat = np.stack([across.at(inset), across.at(1.0 - inset)], axis=1)
    # Two points a line, of arris and of witness points: (2, n, 2, …).
    xyz = np.stack([outer, across.on_face(level, inset)])
    flat = np.stack([across.flat, witness_flat])
    to_placing = np.stack(placing)[across.owner]
    turn, move = to_placing[:, :3, :3], to_placing[:, :3, 3]
    local = np.empty_like(xyz)
    for group in (0, 1):
        for side in (0, 1):
            local[group, :, side] = turned_each(xyz[group, :, side], turn) + move
    places = across.edge_places()
    found = []
    for k, plate in enumerate(across.plates):
        own, count = across.of(k), len(plate.lines)
        s = places[own].ravel()
        lines = tuple(label for line in plate.lines for label in (line.label, line.label))
        found.append(
            Columns(
                LoftingPoint,
                (
                    _point_labels(count),
                    lines * 2,
                    plate.edges * (2 * count),
                    ("arris",) * (2 * count) + ("witness",) * (2 * count),
                    np.concatenate([s, s]),
                    xyz[:, own].reshape(-1, 3),
                    local[:, own].reshape(-1, 3),
                    flat[:, own].reshape(-1, 2),
                ),
            )
        )
    return found


@cache
def _point_labels(lines: int) -> tuple[str, ...]:
    """`P-1` … and `W-1` …, two of each per line."""
    return tuple(f"{letter}-{k + 1}" for letter in "PW" for k in range(2 * lines))


class PanelLengths:
    """Lengths of the panels of all plates, flat, along the surface and straight between arris
    points: by what they are, edges, diagonals and lines."""

    def __init__(self, across: LinesAcross, lines: Sequence[Sequence[StationLine]]):
        self.across = across
        first, second = across.outer[:, 0], across.outer[:, 1]
        flat, arc = zip(
            across.panel_edges(0.0), across.panel_edges(1.0), *across.panel_diagonals(), strict=True
        )
        chords = (
            first[1:] - first[:-1],
            second[1:] - second[:-1],
            second[1:] - first[:-1],
            first[1:] - second[:-1],
        )
        # (n - 1, 4): both edges, both diagonals.
        self.flat, self.arc = np.stack(flat, axis=1), np.stack(arc, axis=1)
        self.chord = np.stack([lengths(chord) for chord in chords], axis=1)
        self.of_lines = [
            (
                np.array([line.length_flat for line in own]),
                np.array([line.length_3d for line in own]),
            )
            for own in lines
        ]

    def measures(self) -> list[Columns]:
        """The panel measures, PanelMeasure, four per panel."""
        found = []
        for k, plate in enumerate(self.across.plates):
            whats = (*(f"edge {edge}" for edge in plate.edges), "diagonal 1", "diagonal 2")
            names = tuple(
                name
                for one, two in zip(plate.lines[:-1], plate.lines[1:], strict=True)
                for name in (f"{one.label}/{two.label}",) * 4
            )
            own = self.across.panels_of(k)
            sizes = (part[own].ravel() for part in (self.flat, self.arc, self.chord))
            columns = (names, whats * (len(names) // 4), *sizes)
            found.append(Columns(PanelMeasure, columns))
        return found

    def errors(self, areas: np.ndarray) -> list[tuple[np.ndarray, FlatteningErrors]]:
        """Per plate all flat-minus-true lengths (edges, whole edges, diagonals, lines), and the
        errors by kind; those along seams need the neighbours (flattening_errors.with_seams).
        areas: of the plates laid flat, Developments.flat_areas."""
        developments = self.across.developments
        if developments.corrected:
            flat, true = self.across.measured.edge(0.5)
            centre = [
                float((flat - true)[self.across.panels_of(k)].sum())
                for k in range(len(self.across.plates))
            ]
        else:
            flat, true = developments.centre_lines()
            centre = (flat - true).tolist()
        area = (areas - developments.curved_areas()).tolist()
        found = []
        for k in range(len(self.across.plates)):
            own = self.across.panels_of(k)
            each = self.flat[own] - self.arc[own]
            whole = self.flat[own, :2].sum(axis=0) - self.arc[own, :2].sum(axis=0)
            line = self.of_lines[k][0] - self.of_lines[k][1]
            found.append(
                (
                    np.concatenate([each.ravel(), whole, line]),
                    FlatteningErrors(
                        edge=_largest(np.concatenate([each[:, :2].ravel(), whole])),
                        line=_largest(line),
                        diagonal=_largest(each[:, 2:].ravel()),
                        centre_line=centre[k],
                        area=area[k],
                    ),
                )
            )
        return found

    def bounds(self) -> list[float]:
        """The lower bounds max |K|A²/(12(D + b + ℓ)) over the panels of each plate, mm: no flat
        pattern has smaller length errors on all sides and diagonals of that panel (self-stress of
        the plane quadrilateral; exact for rectangles, a few per cent high for panels that taper
        askew)."""
        places = parted(self.across.places, self.across.counts)
        middles = [0.5 * (own[1:] + own[:-1]) for own in places]
        value = self.across.developments.rails_at(middles)
        gauss = parted(gauss_from(value[:, :6], value[:, 6:12], 0.5), [len(own) for own in middles])
        along = 0.5 * (self.arc[:, 0] + self.arc[:, 1])
        diagonal = 0.5 * (self.arc[:, 2] + self.arc[:, 3])
        across = np.concatenate([true for _, true in self.of_lines])
        across = 0.5 * (across[1:] + across[:-1])
        area = self.across.panel_areas(along, across)
        share = area**2 / (12 * (diagonal + across + along))
        return [
            float((np.abs(own) * share[self.across.panels_of(k)]).max())
            for k, own in enumerate(gauss)
        ]


def _largest(errors: np.ndarray) -> float:
    """The error largest in size, with its sign."""
    return float(errors[np.argmax(np.abs(errors))])


def placing_frames(across: LinesAcross) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Model -> placing and flat -> placing, (4, 4) each (paper's Orient on the outer face)."""
    rows = np.stack([across.starts, across.ends - 1], axis=1)
    outer, inner, flat = across.outer[rows], across.inner[rows], across.flat[rows]
    widths = lengths(outer[:, :, 1] - outer[:, :, 0])
    every = np.arange(len(rows))
    start = np.where(widths[:, 1] < widths[:, 0] - 0.01, 1, 0)
    other = 1 - start
    origin, x = outer[every, start, 0], outer[every, start, 1] - outer[every, start, 0]
    x = x / lengths(x)[:, None]
    third = 0.5 * (outer[every, other, 0] + outer[every, other, 1]) - origin
    z = crossed(x, third)
    z /= lengths(z)[:, None]
    outward = outer.mean(axis=(1, 2)) - inner.mean(axis=(1, 2))
    z *= np.where(dots(z, outward) < 0, -1.0, 1.0)[:, None]
    placing = np.tile(np.eye(4), (len(rows), 1, 1))
    placing[:, :3, :3] = np.stack([x, crossed(z, x), z], axis=1)
    placing[:, :3, 3] = -turned_each(origin, placing[:, :3, :3])
    flat_origin = flat[every, start, 0]
    flat_x = flat[every, start, 1] - flat_origin
    flat_x = flat_x / lengths(flat_x)[:, None]
    flat_y = np.stack([-flat_x[:, 1], flat_x[:, 0]], axis=1)
    away = 0.5 * (flat[every, other, 0] + flat[every, other, 1]) - flat_origin
    flip = dots(flat_y, away) * dots(placing[:, 1, :3], third) < 0
    flat_y *= np.where(flip, -1.0, 1.0)[:, None]
    flat_to_placing = np.tile(np.eye(4), (len(rows), 1, 1))
    flat_to_placing[:, :2, :2] = np.stack([flat_x, flat_y], axis=1)
    mirrored = flat_x[:, 0] * flat_y[:, 1] < flat_x[:, 1] * flat_y[:, 0]
    flat_to_placing[:, 2, 2] = np.where(mirrored, -1.0, 1.0)
    flat_to_placing[:, :2, 3] = -turned_each(flat_origin, flat_to_placing[:, :2, :2])
    return list(placing), list(flat_to_placing)
