# SPDX-License-Identifier: LGPL-2.1-or-later
"""Flat patterns as DXF files for cutting and marking: one plate per file, 1:1, mm, no splines."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from ..core.finding import BendTorsionError, error
from ..core.geometry.arc_contour import extents
from ..core.geometry.arc_fit import FIT_TOLERANCE
from ..core.lofting import DevelopedPlate, FoldLine
from ..core.patterns.cut_contour import cut_arcs, cut_contour
from ..core.patterns.forming import fold_direction
from ..core.patterns.gross import marked_ends
from ..core.patterns.inner_contours import text_field
from .dxf_bevels import add_bevel_texts
from .dxf_file import Layer, Space, dxf_bytes
from .dxf_inner import add_face_marks, add_face_texts, add_holes, clear_fields
from .dxf_labels import CHARACTER_WIDTH, SMALLEST_TEXT
from .dxf_text import LINE_PITCH, Pattern
from .plate_fields import SAME_PLACE, centre_of, field_size, longest, panels
from .plate_words import identity
from .whole_file import write_whole

CUT_OUTER = "CUT_OUTER"
CUT_INNER = "CUT_INNER"
MARK_LINE = "MARK_LINE"
MARK_ROLL = "MARK_ROLL"
MARK_FOLD = "MARK_FOLD"
MARK_BEVEL = "MARK_BEVEL"
MARK_TEXT = "MARK_TEXT"
PUNCH = "PUNCH"
REF = "REF"

# layer: AutoCAD colour index, line type, what is on it
_LAYERS = {
    CUT_OUTER: (7, "Continuous", "outer contour, one closed polyline, counter-clockwise"),
    CUT_INNER: (1, "Continuous", "inner contours, closed polylines"),
    MARK_LINE: (3, "Continuous", "measuring lines at member stations"),
    MARK_ROLL: (4, "Continuous", "roll lines with their radii"),
    MARK_FOLD: (6, "DASHED", "fold lines with their angles"),
    MARK_BEVEL: (30, "Continuous", "bevels of the edges, a text for each stretch"),
    MARK_TEXT: (2, "Continuous", "marks, labels, direction of the member"),
    PUNCH: (5, "Continuous", "witness points to punch"),
    REF: (8, "Continuous", "for information: points on the contour"),
}

LAYERS = {name: name for name in _LAYERS}
"""Layer names as written, by contract name; pass a changed copy to `write_plate_dxf`."""

MARK_GAP = 5.0
"""mm; mark lines stop this far before the contour."""

TEXT_HEIGHT = 25.0
"""mm; height of marking text where the plate leaves room for it."""


def write_plate_dxf(
    plate: DevelopedPlate,
    path: str | os.PathLike,
    layers: Mapping[str, str] = LAYERS,
    tolerance: float = FIT_TOLERANCE,
) -> None:
    """Write the flat pattern of `plate` to `path`: DXF R2010, 1:1, mm, pattern frame.

    layers: written name of each layer of `LAYERS`. tolerance: mm, largest distance of the
    contour from the pattern. The same plate gives the same bytes. Raises BendTorsionError when
    the outline does not close or runs clockwise, a layer name is not possible, or the file cannot
    be written; nothing is left at `path` then but what was there before.
    """
    write_whole(path, plate_dxf(plate, layers, tolerance))


def plate_dxf(
    plate: DevelopedPlate,
    layers: Mapping[str, str] = LAYERS,
    tolerance: float = FIT_TOLERANCE,
) -> bytes:
    """The DXF file of `write_plate_dxf` as bytes."""
    names = _layer_names(layers)
    outline, _ = cut_arcs(plate, tolerance)
    corners = np.array([(0.0, 0.0), extents(outline)])
    drawn = draw_plate(cut_contour(plate).plate, outline, names, tolerance)
    return dxf_bytes(layers_of(names), corners, drawn)


def layers_of(names: Mapping[str, str]) -> tuple[Layer, ...]:
    """The layers of a file; names: as `LAYERS`."""
    return tuple(Layer(names[key], *own) for key, own in _LAYERS.items())


def draw_plate(
    plate: DevelopedPlate,
    outline: np.ndarray,
    names: Mapping[str, str] = LAYERS,
    tolerance: float = FIT_TOLERANCE,
) -> Space:
    """The entities of a plate as it is cut, its outline fitted by arcs (m, 3)."""
    drawn = Pattern(Space())
    drawn.arcs(outline, names[CUT_OUTER])
    drawn.room.stay_inside(outline)
    add_holes(drawn, plate, names[CUT_INNER], tolerance)
    lines = _add_lines(drawn, plate, names)
    rolls = _add_roll_lines(drawn, plate, names[MARK_ROLL])
    _add_points(drawn.space, plate, names)
    add_face_marks(drawn, plate, names[MARK_LINE], names[PUNCH], tolerance)
    # Texts last, the large ones first: each takes what room the lines and other texts leave.
    centre, layer = centre_of(plate), names[MARK_TEXT]
    fields = longest(clear_fields(plate, panels(plate)))
    height = _text_height(plate, fields if plate.lines else [text_field(plate)])
    if fields:
        _add_identity(drawn, plate, fields, layer, height)
    else:
        _add_flat_identity(drawn, plate, layer)
    add_face_texts(drawn, plate, centre, height, layer)
    for text, line, own_layer, at in lines:
        drawn.line_text(text, line, centre, height, own_layer, at)
    add_bevel_texts(drawn, plate, names[MARK_BEVEL], centre, height)
    for text, line, own_layer, at in rolls:
        drawn.line_text(text, line, centre, 0.5 * height, own_layer, at)
    return drawn.space


class _Label(NamedTuple):
    """A text beside a line (2, 2), from the part `at` of it on."""

    text: str
    line: np.ndarray
    layer: str
    at: float


def _layer_names(layers: Mapping[str, str]) -> dict[str, str]:
    from ezdxf.lldxf.validator import is_valid_layer_name

    names = {**LAYERS, **layers}
    for key, name in names.items():
        if key not in LAYERS:
            problem, mend = f"layer {key!r} is not written", f"use one of {', '.join(LAYERS)}"
        elif not name or not is_valid_layer_name(name):
            problem = f"{name!r} cannot be a layer name"
            mend = 'use none of < > / \\ " : ; ? * | = `'
        else:
            continue
        raise BendTorsionError(error("dxf-layer", key, problem, mend, value=str(name)))
    if len({name.lower() for name in names.values()}) < len(names):
        raise BendTorsionError(
            error("dxf-layer", "layers", "two layers have one name", "name each layer differently")
        )
    return names


def _on_contour(plate: DevelopedPlate, line: str) -> bool:
    """Whether a line is an end line without green beyond it."""
    return line.startswith("E-") and line not in marked_ends(plate)


def _add_lines(drawn: Pattern, plate: DevelopedPlate, names: Mapping[str, str]) -> list[_Label]:
    """Draw measuring lines and folds; their labels, those of folds first."""
    ends = [line for line in plate.lines if _on_contour(plate, line.label)]
    stations = [line for line in plate.lines if not _on_contour(plate, line.label)]
    # In the order of precedence: what lies on the contour or on a fold is not drawn again.
    marks = [*ends, *plate.folds, *stations]
    flats = np.array([mark.flat for mark in marks]).reshape(-1, 2, 2)
    fresh = _first_of_their_place(flats.reshape(-1, 4))
    folds = {fold.label for fold in plate.folds}  # these carry their own text
    labels = []
    for mark, is_fresh in zip(marks[len(ends) :], fresh[len(ends) :]):
        is_fold = isinstance(mark, FoldLine)
        if is_fresh:
            a, b = _shortened(mark.flat)
            drawn.line(a, b, names[MARK_FOLD if is_fold else MARK_LINE])
        if is_fold and is_fresh:
            way = fold_direction(mark.angle, plate.marking_face)
            text = f"{mark.label} {abs(math.degrees(mark.angle)):.1f} deg {way}"
            labels.append(_Label(text, mark.flat, names[MARK_FOLD], 0.5))
        elif not is_fold and mark.label not in folds:
            labels.append(_Label(mark.label, mark.flat, names[MARK_TEXT], 0.2))
    return labels


def _add_roll_lines(drawn: Pattern, plate: DevelopedPlate, layer: str) -> list[_Label]:
    """Draw roll lines; their radii as labels."""
    rolls = () if plate.forming_data is None else plate.forming_data.roll_lines
    for roll in rolls:
        drawn.line(*_shortened(roll.flat), layer)
    return [_Label(roll.text(), roll.flat, layer, 0.5) for roll in rolls]


def _add_points(space: Space, plate: DevelopedPlate, names: Mapping[str, str]) -> None:
    for kind, layer in (("witness", PUNCH), ("arris", REF)):
        points = [
            point.flat
            for point in plate.points
            # Witness points of the end lines lie on the contour: nothing to punch.
            if point.kind == kind and not (kind == "witness" and _on_contour(plate, point.line))
        ]
        flats = np.array(points).reshape(-1, 2)
        for flat in flats[_first_of_their_place(flats)]:
            space.add_point(flat, names[layer])


def _add_identity(drawn: Pattern, plate: DevelopedPlate, fields: list, layer: str, height: float):
    """The plate's identity and its direction, in one of the fields."""
    panel = fields[0]
    foot, head = panel[0].mean(axis=0), panel[1].mean(axis=0)
    forward = (head - foot) / np.hypot(*(head - foot))
    rows = identity(plate)
    reads_along = _text_fit(panel, rows)[1]
    # Text reads from left to right or upwards in the pattern; the arrow alone tells where +s is.
    reading = forward if reads_along else np.array([-forward[1], forward[0]])
    if reading[0 if reads_along else 1] < 0.0:
        reading = -reading
    wide = max(map(len, rows)) * CHARACTER_WIDTH
    level, up, height = drawn.block(rows, wide, height, reading, fields, layer, below=1)
    # The arrow takes the row below the text, and its name stands after it.
    reach = 2.0 * height if reads_along else 0.6 * height
    tip = level + reach * forward
    barb = (0.8 if reads_along else 0.4) * height * forward
    side = 0.4 * height * np.array([-forward[1], forward[0]])
    for a, b in (
        (level - reach * forward, tip),
        (tip, tip - barb + side),
        (tip, tip - barb - side),
    ):
        drawn.space.add_line(a, b, layer)
    corner = level + (2.6 if reads_along else 0.8) * height * reading - 0.5 * height * up
    drawn.space.add_text("+s", corner, reading, height, layer)


def _add_flat_identity(drawn: Pattern, plate: DevelopedPlate, layer: str) -> None:
    """The identity of a flat part, level, where it has most room."""
    field, rows = text_field(plate), identity(plate)
    height = _text_height(plate, [field])
    wide = max(map(len, rows)) * CHARACTER_WIDTH
    drawn.block(rows, wide, height, np.array([1.0, 0.0]), [field], layer)


def _text_height(plate: DevelopedPlate, fields: list[tuple[np.ndarray, np.ndarray]]) -> float:
    """Height at which the identity fits into the first of the fields, mm."""
    if not fields:
        return SMALLEST_TEXT
    fitting, _ = _text_fit(fields[0], identity(plate))
    return round(max(SMALLEST_TEXT, fitting), 1)


def _text_fit(panel: tuple[np.ndarray, np.ndarray], rows: tuple[str, ...]) -> tuple[float, bool]:
    """Height, mm, at which rows and arrow fit into the field, and whether they read along +s."""
    length, width = field_size(panel)
    text_length = max(8, *map(len, rows)) * CHARACTER_WIDTH
    text_depth = (len(rows) + 1) * LINE_PITCH
    along = min(TEXT_HEIGHT, 0.8 * length / text_length, 0.6 * width / text_depth)
    across = min(TEXT_HEIGHT, 0.6 * width / text_length, 0.8 * length / text_depth)
    # Across the plate only where that makes the text much larger: short plates.
    return (along, True) if along >= 0.6 * across else (across, False)


def _first_of_their_place(rows: np.ndarray) -> np.ndarray:
    """(n,) whether no earlier row of (n, d) coordinates is the same place."""
    apart = np.abs(rows[:, None] - rows[None]).max(axis=2, initial=0.0)
    return ~np.tril(apart <= SAME_PLACE, -1).any(axis=1)


def _shortened(flat: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The line without its gaps before the contour."""
    across = flat[1] - flat[0]
    length = np.hypot(*across)
    gap = min(MARK_GAP, 0.25 * length) * across / length
    return flat[0] + gap, flat[1] - gap
