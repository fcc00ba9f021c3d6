# SPDX-License-Identifier: LGPL-2.1-or-later
"""Flat patterns as DXF files for cutting and marking: one plate per file, 1:1, mm, no splines."""

from __future__ import annotations

import io
import math
import os
from collections.abc import Mapping

import ezdxf
import numpy as np
from ezdxf.document import Drawing
from ezdxf.lldxf.validator import is_valid_layer_name

from ..core.finding import BendTorsionError, error
from ..core.geometry.arc_fit import FIT_TOLERANCE, fit_outline
from ..core.lofting import DevelopedPlate, FoldLine
from ..core.patterns.cut_contour import cut_contour
from ..core.patterns.forming import fold_direction
from ..core.patterns.gross import marked_ends
from ..core.patterns.inner_contours import text_field
from .collection import without_collection
from .dxf_bevels import add_bevel_texts
from .dxf_inner import add_face_marks, add_holes, add_level_text, clear_fields
from .dxf_text import (
    CHARACTER_WIDTH,
    SMALLEST_TEXT,
    add_line_text,
    add_text,
    figure,
    place,
)
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

_LINE_PITCH = 1.6  # distance of text lines over their height
_SAME_PLACE = 0.01  # mm; lines and points closer than this are one
_DASHED = [18.0, 12.0, -6.0]  # mm: pattern length, dash, gap


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
    plate = cut_contour(plate).plate
    outline = fit_outline(plate.outline, tolerance, plate.mark)
    with without_collection():
        document = new_document(names, outline[:, :2])
        draw_plate(document.modelspace(), plate, outline, names, tolerance)
        return document_bytes(document)


def draw_plate(
    space,
    plate: DevelopedPlate,
    outline: np.ndarray,
    names: Mapping[str, str] = LAYERS,
    tolerance: float = FIT_TOLERANCE,
) -> None:
    """Draw a plate as it is cut, its outline fitted by arcs (m, 3), into a layout or a block."""
    # Rounding to 1e-6 mm keeps last-bit differences between machines out of the file.
    space.add_lwpolyline(
        [(figure(x), figure(y), round(float(b), 12) + 0.0) for x, y, b in outline],
        format="xyb",
        close=True,
        dxfattribs={"layer": names[CUT_OUTER]},
    )
    panels = clear_fields(plate, _panels(plate))
    height = _text_height(plate, panels)
    _add_lines(space, plate, names, height)
    _add_roll_lines(space, plate, names, height)
    _add_points(space, plate, names)
    add_bevel_texts(space, plate, names[MARK_BEVEL], _centre(plate), height)
    add_holes(space, plate, names[CUT_INNER], tolerance)
    layers = names[MARK_LINE], names[MARK_TEXT], names[PUNCH]
    add_face_marks(space, plate, layers, _centre(plate), height, tolerance)
    if panels:
        _add_marks(space, plate, panels, names, height)
    else:
        field, rows = text_field(plate), _identity(plate)
        level = round(max(SMALLEST_TEXT, _text_fit(field, rows)[0]), 1)
        middle = 0.5 * (field[0].mean(axis=0) + field[1].mean(axis=0))
        add_level_text(space, rows, middle, level, _LINE_PITCH, names[MARK_TEXT])


def _layer_names(layers: Mapping[str, str]) -> dict[str, str]:
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


def new_document(names: Mapping[str, str], corners: np.ndarray) -> Drawing:
    """A document with our layers and units, showing all corners (n, 2)."""
    document = ezdxf.new("R2010")
    header = document.header
    header["$INSUNITS"] = 4
    header["$MEASUREMENT"] = 1
    header["$LUNITS"] = 2
    header["$PDMODE"] = 2
    header["$PDSIZE"] = 10.0
    document.linetypes.add("DASHED", pattern=_DASHED, description="Dashed __ __ __ __")
    for key, (colour, linetype, description) in _LAYERS.items():
        layer = document.layers.add(names[key], color=colour, linetype=linetype)
        layer.description = description
    low, high = corners.min(axis=0), corners.max(axis=0)
    space = document.modelspace()
    space.dxf.extmin = (figure(low[0]), figure(low[1]), 0.0)
    space.dxf.extmax = (figure(high[0]), figure(high[1]), 0.0)
    space.dxf.limmin, space.dxf.limmax = place(low), place(high)
    document.set_modelspace_vport(
        1.1 * max(float(high[1] - low[1]), float(high[0] - low[0]) / 2.0, 1.0),
        tuple(figure(value) for value in (low + high) / 2.0),
    )
    return document


def document_bytes(document: Drawing) -> bytes:
    """The document's text without time stamps and unique identifiers."""
    document.ezdxf_metadata()["CREATED_BY_EZDXF"] = ezdxf.__version__
    # ezdxf declares the types in use in the order of a set, another one in every process.
    for name in sorted(document.entitydb.dxf_types_in_use()):
        document.classes.add_class(name)
    stream = io.StringIO()
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        document.write(stream)
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before
    return document.encode(stream.getvalue())


def _on_contour(plate: DevelopedPlate, line: str) -> bool:
    """Whether a line is an end line without green beyond it."""
    return line.startswith("E-") and line not in marked_ends(plate)


def _add_lines(space, plate: DevelopedPlate, names: Mapping[str, str], height: float) -> None:
    ends = [line for line in plate.lines if _on_contour(plate, line.label)]
    stations = [line for line in plate.lines if not _on_contour(plate, line.label)]
    # In the order of precedence: what lies on the contour or on a fold is not drawn again.
    marks = [*ends, *plate.folds, *stations]
    flats = np.array([mark.flat for mark in marks]).reshape(-1, 2, 2)
    fresh = _first_of_their_place(flats.reshape(-1, 4))
    centre = _centre(plate)
    for mark, is_fresh in zip(marks[len(ends) :], fresh[len(ends) :]):
        if not is_fresh:
            continue
        is_fold = isinstance(mark, FoldLine)
        attributes = {"layer": names[MARK_FOLD if is_fold else MARK_LINE]}
        a, b = _shortened(mark.flat)
        space.add_line(place(a), place(b), dxfattribs=attributes)
        if is_fold:
            way = fold_direction(mark.angle, plate.marking_face)
            text = f"{mark.label} {abs(math.degrees(mark.angle)):.1f} deg {way}"
            middle = 0.5 * (mark.flat[0] + mark.flat[1])
            add_line_text(space, text, middle, mark.flat[1], centre, height, attributes)


def _add_roll_lines(space, plate: DevelopedPlate, names: Mapping[str, str], height: float) -> None:
    """Roll lines with their radii; text is half the height of other marks."""
    rolls = () if plate.forming_data is None else plate.forming_data.roll_lines
    attributes, centre = {"layer": names[MARK_ROLL]}, _centre(plate)
    for roll in rolls:
        a, b = _shortened(roll.flat)
        space.add_line(place(a), place(b), dxfattribs=attributes)
        middle = 0.5 * (roll.flat[0] + roll.flat[1])
        add_line_text(space, roll.text(), middle, roll.flat[1], centre, 0.5 * height, attributes)


def _add_points(space, plate: DevelopedPlate, names: Mapping[str, str]) -> None:
    for kind, layer in (("witness", PUNCH), ("arris", REF)):
        points = [
            point.flat
            for point in plate.points
            # Witness points of the end lines lie on the contour: nothing to punch.
            if point.kind == kind and not (kind == "witness" and _on_contour(plate, point.line))
        ]
        flats = np.array(points).reshape(-1, 2)
        for flat in flats[_first_of_their_place(flats)]:
            space.add_point(place(flat), dxfattribs={"layer": names[layer]})


def _add_marks(
    space,
    plate: DevelopedPlate,
    panels: list[tuple[np.ndarray, np.ndarray]],
    names: Mapping[str, str],
    height: float,
) -> None:
    """The plate's identity and direction in its longest panel, and the labels of its lines."""
    attributes = {"layer": names[MARK_TEXT]}
    panel = _text_panel(panels)
    foot, head = panel[0].mean(axis=0), panel[1].mean(axis=0)
    forward = (head - foot) / np.hypot(*(head - foot))
    middle = 0.5 * (foot + head)
    rows = _identity(plate)
    reads_along = _text_fit(panel, rows)[1]
    # Text reads from left to right or upwards in the pattern; the arrow alone tells where +s is.
    reading = forward if reads_along else np.array([-forward[1], forward[0]])
    if reading[0 if reads_along else 1] < 0.0:
        reading = -reading
    up = np.array([-reading[1], reading[0]])
    pitch = _LINE_PITCH * height
    half = 0.5 * max(map(len, rows)) * CHARACTER_WIDTH * height
    for row, text in enumerate(rows):
        rise = (0.5 * len(rows) - row) * pitch
        corner = middle + rise * up - half * reading - 0.5 * height * up
        add_text(space, text, corner, reading, height, attributes)
    # The arrow takes the row below the text, and its name stands after it.
    level = middle - 0.5 * len(rows) * pitch * up
    reach = 2.0 * height if reads_along else 0.6 * height
    tip = level + reach * forward
    barb = (0.8 if reads_along else 0.4) * height * forward
    side = 0.4 * height * np.array([-forward[1], forward[0]])
    for a, b in (
        (level - reach * forward, tip),
        (tip, tip - barb + side),
        (tip, tip - barb - side),
    ):
        space.add_line(place(a), place(b), dxfattribs=attributes)
    corner = level + (2.6 if reads_along else 0.8) * height * reading - 0.5 * height * up
    add_text(space, "+s", corner, reading, height, attributes)
    folds = {fold.label for fold in plate.folds}  # these carry their own text
    centre = _centre(plate)
    for line in plate.lines:
        if _on_contour(plate, line.label) or line.label in folds:
            continue
        first, second = line.flat
        fifth = first + 0.2 * (second - first)
        add_line_text(space, line.label, fifth, second, centre, height, attributes)


def _identity(plate: DevelopedPlate) -> tuple[str, ...]:
    up = plate.marking_face.upper()
    down = {"INSIDE": "OUTSIDE", "OUTSIDE": "INSIDE"}.get(up, "-S")
    return (
        plate.mark,
        f"{plate.member} {plate.face} {plate.piece}",
        f"t{plate.thickness:g} {plate.material}",
        f"marking face {up}",
        f"{down} below, contour {plate.contour.upper()}",
    )


def _panels(plate: DevelopedPlate) -> list[tuple[np.ndarray, np.ndarray]]:
    """The fields between consecutive lines and folds along +s, as pairs of (2, 2) lines."""
    marks = sorted((*plate.lines, *plate.folds), key=lambda mark: mark.s)
    fields = []
    for a, b in zip(marks[:-1], marks[1:]):
        if np.hypot(*(b.flat.mean(axis=0) - a.flat.mean(axis=0))) > _SAME_PLACE:
            fields.append((a.flat, b.flat))
    return fields


def _centre(plate: DevelopedPlate) -> np.ndarray:
    """A point amid the pattern: the middle of its line or fold nearest to half way along +s."""
    half = 0.5 * (plate.s_start + plate.s_end)
    middle = min((*plate.lines, *plate.folds), key=lambda mark: abs(mark.s - half), default=None)
    return np.zeros(2) if middle is None else middle.flat.mean(axis=0)


def _field_size(panel: tuple[np.ndarray, np.ndarray]) -> tuple[float, float]:
    """Length along the member and smaller width of a field, mm."""
    a, b = panel
    length = np.hypot(*(b.mean(axis=0) - a.mean(axis=0)))
    return float(length), float(min(np.hypot(*(a[1] - a[0])), np.hypot(*(b[1] - b[0]))))


def _text_panel(panels: list[tuple[np.ndarray, np.ndarray]]) -> tuple[np.ndarray, np.ndarray]:
    lengths = [_field_size(panel)[0] for panel in panels]
    # The first of the long ones: equal lengths may differ in their last bits.
    return panels[next(i for i, length in enumerate(lengths) if length >= max(lengths) - 1.0)]


def _text_height(plate: DevelopedPlate, panels: list[tuple[np.ndarray, np.ndarray]]) -> float:
    """Height at which the identity fits into its field, mm."""
    if not panels:
        return SMALLEST_TEXT
    fitting, _ = _text_fit(_text_panel(panels), _identity(plate))
    return round(max(SMALLEST_TEXT, fitting), 1)


def _text_fit(panel: tuple[np.ndarray, np.ndarray], rows: tuple[str, ...]) -> tuple[float, bool]:
    """Height, mm, at which rows and arrow fit into the field, and whether they read along +s."""
    length, width = _field_size(panel)
    text_length = max(8, *map(len, rows)) * CHARACTER_WIDTH
    text_depth = (len(rows) + 1) * _LINE_PITCH
    along = min(TEXT_HEIGHT, 0.8 * length / text_length, 0.6 * width / text_depth)
    across = min(TEXT_HEIGHT, 0.6 * width / text_length, 0.8 * length / text_depth)
    # Across the plate only where that makes the text much larger: short plates.
    return (along, True) if along >= 0.6 * across else (across, False)


def _first_of_their_place(rows: np.ndarray) -> np.ndarray:
    """(n,) whether no earlier row of (n, d) coordinates is the same place."""
    apart = np.abs(rows[:, None] - rows[None]).max(axis=2, initial=0.0)
    return ~np.tril(apart <= _SAME_PLACE, -1).any(axis=1)


def _shortened(flat: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The line without its gaps before the contour."""
    across = flat[1] - flat[0]
    length = np.hypot(*across)
    gap = min(MARK_GAP, 0.25 * length) * across / length
    return flat[0] + gap, flat[1] - gap
