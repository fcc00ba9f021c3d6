# SPDX-License-Identifier: LGPL-2.1-or-later
"""All plates of one thickness and grade in one DXF file, side by side, each a block by its mark."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from ..core.lofting import DevelopedPlate, MemberRecord
from .dxf import LAYERS, layers_of
from .dxf_file import Frame, Space, dxf_bytes, new_frame, read_model
from .file_name import digits, same_file, seen

GAP = 100.0
"""mm; distance of the plates."""

FOLDER = "plates/all"
_REFUSED = re.compile(r'[<>:"/\\|?*;=`,]')


def groups_of(records: Sequence[MemberRecord]) -> dict[str, list[DevelopedPlate]]:
    """Plates by the name of the file they lie in, relative to the output folder, thick first."""
    groups: dict[tuple[str, str], list[DevelopedPlate]] = {}
    for record in records:
        for plate in record.plates:
            groups.setdefault((f"{plate.thickness:g}", plate.material), []).append(plate)
    named: dict[str, list[DevelopedPlate]] = {}
    taken = set()
    for thickness, material in sorted(groups, key=lambda key: (-float(key[0]), key[1])):
        grade = _REFUSED.sub("_", seen(material)).strip(" .")
        if same_file(f"{thickness} {grade}") in taken:
            # A shop takes the plates of a file for one grade.
            grade = f"{grade}-{digits(material)}"
        taken.add(same_file(f"{thickness} {grade}"))
        named[f"{FOLDER}/{thickness}mm {grade}.dxf"] = groups[thickness, material]
    return named


def nest_frame(marks: Sequence[str]) -> Frame:
    """What takes the time of nest_dxf and follows from the marks alone."""
    return new_frame(tuple(layers_of(LAYERS)), tuple(_block_names(marks)))


def nest_dxf(files: Sequence[tuple[str, bytes]], frame: Frame | None = None) -> bytes:
    """The file, of plates by mark and content of their own files: DXF R2010, 1:1, mm; every plate,
    as in its own file, is a block named by its mark and inserted once, on shelves from the left;
    layer 0 holds the insertions only. frame: nest_frame of the marks, where it was made before."""
    drawn = [read_model(content) for _, content in files]
    sizes = np.array([size for _, size in drawn])
    places = shelves(sizes)
    model, blocks = Space(), {}
    names = _block_names([mark for mark, _ in files])
    for name, (space, _), corner in zip(names, drawn, places, strict=True):
        blocks[name] = space
        model.add_block(name, corner)
    corners = np.concatenate([places, places + sizes])
    return dxf_bytes(layers_of(LAYERS), corners, model, blocks, frame)


def _block_names(marks: Sequence[str]) -> list[str]:
    names: dict[str, None] = {}
    for mark in marks:
        name = _REFUSED.sub("_", seen(mark))
        while name in names:
            name += "_"
        names[name] = None
    return list(names)


def shelves(sizes: np.ndarray) -> np.ndarray:
    """Lower left corners (n, 2) of rectangles (n, 2) on shelves, about as wide as they are high
    together, in their order, GAP apart."""
    width = max(float(sizes[:, 0].max()), float(np.sqrt(((sizes + GAP).prod(axis=1)).sum())))
    places, x, y, high = [], 0.0, 0.0, 0.0
    for length, depth in sizes.tolist():
        if x > 0.0 and x + length > width:
            x, y, high = 0.0, y + high + GAP, 0.0
        places.append((x, y))
        x += length + GAP
        high = max(high, depth)
    return np.array(places)
