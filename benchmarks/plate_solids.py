# SPDX-License-Identifier: LGPL-2.1-or-later
"""Time and volume error of one plate solid: B-rep text against Part.makeLoft.

Run: python3 benchmarks/plate_solids.py [repeats]

The plate (240 x 8, 3618 long on its axis) turns 45° about an axis of radius 6000 that lies 300
from its centre line, so that its volume is known: V = A ∫ (1 - κ·e) ds. Every row starts from the
same corners at n even stations; the fit of the rails is part of our time. CPU time, best run.
"""

import sys
import time
from pathlib import Path

import numpy as np
from scipy.interpolate import make_interp_spline

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from BendTorsionWB import freecad_path

freecad_path.append()

import FreeCAD  # noqa: E402
import Part  # noqa: E402

from BendTorsionWB.shapes import brep  # noqa: E402

LENGTH, RADIUS, TURN, OFFSET = 3618.0, 6000.0, np.pi / 4, 300.0
BATCH = 100
PLATE = np.array([(-120.0, 4.0), (120.0, 4.0), (120.0, -4.0), (-120.0, -4.0)]) + (0, OFFSET)
VOLUME = 240 * 8 * LENGTH * (1 - OFFSET / RADIUS * np.sin(TURN) / TURN)


def corners(s):
    """The rails' points at arc lengths s (k,) of the axis: (k, 4, 3)."""
    angle, turn = (s / RADIUS)[:, None], (TURN * s / LENGTH)[:, None]
    y, z = PLATE.T
    inwards = y * np.sin(turn) + z * np.cos(turn)
    aside = y * np.cos(turn) - z * np.sin(turn)
    reach = RADIUS - inwards
    return np.stack([reach * np.sin(angle), aside, RADIUS - reach * np.cos(angle)], axis=-1)


def rails(points, s):
    """One piece (knots, poles): clamped cubic rails through the points."""
    step = 1.0
    ends = corners(np.array([-step, step, LENGTH - step, LENGTH + step]))
    first, last = (ends[1] - ends[0]) / (2 * step), (ends[3] - ends[2]) / (2 * step)
    spline = make_interp_spline(s, points, 3, bc_type=([(1, first)], [(1, last)]))
    return spline.t, spline.c.swapaxes(0, 1)


def lofted(points, ruled):
    rings = [[FreeCAD.Vector(*p) for p in (*ring, ring[0])] for ring in points.tolist()]
    return Part.makeLoft([Part.makePolygon(ring) for ring in rings], True, ruled)


def timed(build, repeats):
    """Least CPU milliseconds of build(), and its last result."""
    times = []
    for _ in range(repeats):
        start = time.process_time()
        result = build()
        times.append(1e3 * (time.process_time() - start))
    return min(times), result


def methods(n):
    """Name, build() and solids per build of each way, from n stations."""
    s = np.linspace(0, LENGTH, n)
    points = corners(s)
    return (
        ("B-rep text", lambda: [brep.tube_solid([rails(points, s)])], 1),
        (
            f"B-rep text, {BATCH} at once",
            lambda: brep.tube_solids([[rails(points, s)] for _ in range(BATCH)]),
            BATCH,
        ),
        ("Part.makeLoft smooth", lambda: [lofted(points, False)], 1),
        ("Part.makeLoft ruled", lambda: [lofted(points, True)], 1),
    )


def main():
    repeats = int(sys.argv[1]) if len(sys.argv) > 1 else 31
    print(f"FreeCAD {'.'.join(FreeCAD.Version()[:3])}, OCCT {Part.OCC_VERSION}")
    print(f"{'n':>3}  {'method':<28}{'ms/solid':>9}{'valid':>7}{'faces':>7}{'volume error':>14}")
    for n in (20, 50):
        for name, build, count in methods(n):
            milliseconds, solids = timed(build, repeats if count == 1 else 5)
            solid = solids[-1]
            print(
                f"{n:3d}  {name:<28}{milliseconds / count:9.2f}{solid.isValid()!s:>7}"
                f"{len(solid.Faces):7d}{solid.Volume / VOLUME - 1:14.1e}"
            )


if __name__ == "__main__":
    main()
