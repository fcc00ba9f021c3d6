# SPDX-License-Identifier: LGPL-2.1-or-later
"""Flat patterns as Part wires and faces, written as B-rep text and parsed: the kernel took as long
to find the plane and the loops of faces it was given as everything else of a member's objects."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import Part
from scipy.interpolate import make_interp_spline

from BendTorsionWB.core.lofting import DevelopedPlate
from BendTorsionWB.shapes.brep_text import TOLERANCE, BrepText

ROW_GAP = 200.0
"""Clear distance between patterns laid out one above the other, mm."""

_PLANE = "1 0 0 0 0 0 1 1 0 0 0 1 0\n"
"""The XY plane."""

Run = np.ndarray
"""Points (n, 2) an edge runs through: straight between two, else a spline."""


def laid_out(plates: Sequence[DevelopedPlate]) -> Part.Compound:
    """The patterns of all plates as faces with their openings, in order, each row starting above
    the one before: an edge per smooth run, faces looking up."""
    faces, height = [], 0.0
    for plate in plates:
        shift = np.array([0.0, height])
        loops = [plate.outline, *(hole.runs for hole in plate.holes)]
        faces.append([[np.asarray(run) + shift for run in loop] for loop in loops])
        height += plate.width + ROW_GAP
    return plane_faces(faces)


def plane_faces(faces: Sequence[Sequence[Sequence[Run]]]) -> Part.Compound:
    """Faces in the XY plane that look up: of each its closed loops of runs head to tail, the outer
    one first, either way round."""
    if not faces:
        return Part.Compound([])
    loops = [loop for face in faces for loop in face]
    # A vertex and an edge per run, a wire per loop, the faces and what holds them.
    text = _Faces(2 * sum(map(len, loops)) + len(loops) + len(faces) + 1)
    plane = text.surface(_PLANE)
    text.compound([text.loops(plane, face) for face in faces])
    return Part.Compound(text.parsed().Faces)


class _Faces(BrepText):
    """The text of faces in the XY plane."""

    def loops(self, plane: int, loops: Sequence[Sequence[Run]]) -> int:
        """A face of loops."""
        wires = []
        for k, runs in enumerate(loops):
            # The face lies to the left of its wires.
            turned = (_area(runs) > 0.0) != (k == 0)
            wires.append(f"{'-' if turned else '+'}{self.ring(runs)} 0 ")
        return self.face(plane, "".join(wires))

    def ring(self, runs: Sequence[Run]) -> int:
        """A wire of runs."""
        starts = np.array([run[0] for run in runs])
        ends = np.roll([run[-1] for run in runs], 1, axis=0)
        gaps = np.sqrt(((starts - ends) ** 2).sum(axis=1)).tolist()
        vertices = [
            self.vertex(f"{x!r} {y!r} 0", max(TOLERANCE, 2.0 * gap))
            for (x, y), gap in zip(starts.tolist(), gaps, strict=True)
        ]
        edges = []
        for k, run in enumerate(runs):
            curve, length = _curve(run)
            ends = vertices[k], vertices[(k + 1) % len(runs)]
            edges.append(self.edge(curve, f"0 {length!r}", [], *ends))
        return self.wire("".join(f"+{edge} 0 " for edge in edges))


def _curve(run: Run) -> tuple[str, float]:
    """The text of a curve through a run, and where it ends: it is run through by lengths."""
    steps = np.diff(run, axis=0)
    length = np.concatenate([[0.0], np.cumsum(np.sqrt((steps**2).sum(axis=1)))])
    if len(run) == 2:
        (x, y), (along_x, along_y) = run[0].tolist(), (steps[0] / length[1]).tolist()
        return f"1 {x!r} {y!r} 0 {along_x!r} {along_y!r} 0\n", float(length[1])
    degree = min(3, len(run) - 1)
    # Knots at the points, but for the second and the last but one of a cubic.
    inner = length[2:-2] if degree == 3 else length[:0]
    knots = np.concatenate([np.zeros(degree + 1), inner, np.repeat(length[-1:], degree + 1)])
    spline = make_interp_spline(length, run, degree, knots, check_finite=False)
    poles = spline.c
    poles[[0, -1]] = run[[0, -1]]
    points = "".join(map("%.17g %.17g 0 ".__mod__, map(tuple, poles.tolist())))
    last = float(length[-1])
    table = "".join(map("%r 1\n".__mod__, inner.tolist()))
    table = f"0 {degree + 1}\n{table}{last!r} {degree + 1}\n"
    return f"7 0 0 {degree} {len(poles)} {len(inner) + 2} {points}\n{table}", last


def _area(runs: Sequence[Run]) -> float:
    """Area within a loop, positive when it runs counter-clockwise."""
    x, y = np.concatenate([run[:-1] for run in runs]).T
    return 0.5 * float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())
