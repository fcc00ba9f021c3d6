# SPDX-License-Identifier: LGPL-2.1-or-later
"""Axes through sparse exact points: distance to surface and to the true curve, beside peers.

Run: python3 benchmarks/axes.py [point sets]

Curves with exact truth (tests/exact_axes.py) on the 40/30/20 m ellipsoid, the torus 30/8 m, the
hyperbolic paraboloid z = xy/30 m and a rational bicubic free-form patch. Each set has 6 to 15
exact points with random gaps up to 1 : 50. RMS in mm over 1001 even parameters, the worst set and
the median one. Peers through the same points: scipy's cubic spline over chord length, OCC's
`BSplineCurve.interpolate`, and Eq. 2 of the paper read literally (points every metre on the
chords, then OCC). Then orders restored, and points rounded to 1 mm. Exit code 1 when a limit is
missed.
"""

import sys
import time
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial import cKDTree

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from BendTorsionWB import freecad_path  # noqa: E402

freecad_path.append()

import FreeCAD  # noqa: E402
import Part  # noqa: E402
from exact_axes import curves  # noqa: E402

from BendTorsionWB.core.axes.axis import axis_from_curve, fit_axis, fit_uncertainty  # noqa: E402
from BendTorsionWB.core.axes.axis_order import chain_points, chain_segments  # noqa: E402
from BendTorsionWB.core.axes.axis_rule import Geodesic, PlaneSection, curve_by_rule  # noqa: E402
from BendTorsionWB.core.finding import BendTorsionError  # noqa: E402

RMS_LIMIT = 0.003
GAP_RATIO = 50.0
SAMPLES = 1001


def to_surface(surface, points):
    distance = surface.closest(points).distance
    return float(np.sqrt(np.mean(distance**2))), float(np.abs(distance).max())


class Truth:
    """The exact curve as a dense polyline, for distances in it."""

    def __init__(self, exact):
        self.points = exact.derivatives(np.linspace(0.0, 1.0, 40001))[0]
        self.tree = cKDTree(self.points)

    def rms(self, points):
        _, near = self.tree.query(points)
        near = np.clip(near, 1, len(self.points) - 2)
        best = np.full(len(points), np.inf)
        for a, b in ((near - 1, near), (near, near + 1)):
            run = self.points[b] - self.points[a]
            t = ((points - self.points[a]) * run).sum(1) / (run**2).sum(1)
            foot = self.points[a] + np.clip(t, 0, 1)[:, None] * run
            best = np.minimum(best, np.linalg.norm(points - foot, axis=1))
        return float(np.sqrt(np.mean(best**2)))


def scipy_chord(points, closed):
    run = np.vstack([points, points[:1]]) if closed else points
    u = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(run, axis=0), axis=1))])
    spline = CubicSpline(u, run, bc_type="periodic" if closed else "not-a-knot")
    return spline(np.linspace(0, u[-1], SAMPLES))


def occ(points, closed):
    curve = Part.BSplineCurve()
    curve.interpolate([FreeCAD.Vector(*point) for point in points], PeriodicFlag=closed)
    u = np.linspace(curve.FirstParameter, curve.LastParameter, SAMPLES)
    return np.array([tuple(curve.value(float(value))) for value in u])


def equation_2(points, closed):
    run = np.vstack([points, points[:1]]) if closed else points
    parts = []
    for a, b in zip(run[:-1], run[1:]):
        count = int(np.ceil(np.linalg.norm(b - a) / 1000.0))
        parts.append(a + np.arange(count)[:, None] / count * (b - a))
    dense = np.vstack(parts if closed else [*parts, run[-1:]])
    return occ(dense, closed)


def accuracy(sets):
    print(
        f"{'curve':8} {'ours, mm to surface':>27} {'points':>7} {'ms':>5} "
        f"{'scipy':>14} {'OCC':>14} {'Eq. 2':>14} | to true curve, median"
    )
    print(
        f"{'':8} {'worst rms':>9} {'med. rms':>8} {'worst':>8} {'':>7} {'':>5} "
        + f"{'worst':>7} {'median':>6} " * 3
        + f"| {'ours':>6} {'scipy':>6} {'Eq. 2':>6} "
        f"{'told':>6}"
    )
    good = True
    for name, exact in curves().items():
        rng = np.random.default_rng(20)
        truth = Truth(exact)
        ours, peers, inside, refused = [], [], [], 0
        for seed in range(sets):
            points = exact.points(int(rng.integers(6, 16)), seed, GAP_RATIO)
            try:
                begin = time.perf_counter()
                axis = fit_axis(name, points, exact.surface, closed=exact.closed)
                took = 1e3 * (time.perf_counter() - begin)
            except BendTorsionError as problem:
                refused += 1
                print("   ", seed, problem)
                continue
            rms, worst = axis.distance_to(exact.surface, SAMPLES)
            ours.append((rms, worst, len(axis.control), took))
            others = [peer(points, exact.closed) for peer in (scipy_chord, occ, equation_2)]
            peers.append([to_surface(exact.surface, other)[0] for other in others])
            told = fit_uncertainty(name, points, exact.surface, closed=exact.closed)
            mine = axis.curve.evaluate(np.linspace(*axis.curve.domain, SAMPLES))[0]
            inside.append((truth.rms(mine), truth.rms(others[0]), truth.rms(others[2]), told.max()))
        ours, peers = np.array(ours), np.array(peers)
        good &= ours[:, 0].max() <= RMS_LIMIT
        pairs = " ".join(
            f"{peers[:, k].max():7.3g} {np.median(peers[:, k]):6.2g}" for k in range(3)
        )
        last = " ".join(f"{value:6.3g}" for value in np.median(inside, axis=0))
        print(
            f"{name:8} {ours[:, 0].max():9.5f} {np.median(ours[:, 0]):8.5f} "
            f"{ours[:, 1].max():8.5f} {np.median(ours[:, 2]):7.0f} {np.median(ours[:, 3]):5.0f} "
            f"{pairs} | {last}" + (f"  {refused} refused" if refused else "")
        )
    return good


def orders(sets):
    restored, bare, warned = 0, 0, 0
    table = list(curves().values())
    for seed in range(sets):
        rng = np.random.default_rng(seed)
        exact = table[seed % len(table)]
        count = int(rng.integers(9, 25))
        points = exact.points(count, seed, GAP_RATIO)
        run = np.vstack([points, points[:1]]) if exact.closed else points
        cuts = np.sort(rng.choice(np.arange(1, len(run) - 1), 4, replace=False))
        edges = [0, *cuts, len(run) - 1]
        segments = [run[a : b + 1] for a, b in zip(edges[:-1], edges[1:])]
        segments = [part[::-1] if rng.random() < 0.5 else part for part in segments]
        rng.shuffle(segments)
        chain = chain_segments("A", tuple(segments))
        restored += same_order(chain.points, points, exact.closed) and chain.closed == exact.closed
        # Bare points with gaps up to 1 : 3.
        points = exact.points(count, seed, 3.0)
        found = chain_points("A", rng.permutation(points), exact.closed)
        bare += same_order(found.points, points, exact.closed)
        warned += not same_order(found.points, points, exact.closed) and bool(found.findings)
    print(
        f"\n{restored} of {sets} shuffled, turned sets of segments restored; "
        f"{bare} of {sets} sets of bare points (gaps to 1 : 3), {warned} of the others warned of"
    )
    return restored == sets


def same_order(found, points, closed):
    if len(found) != len(points):
        return False
    if not closed:
        return min(np.abs(found - points).max(), np.abs(found[::-1] - points).max()) < 1e-9
    start = int(np.argmin(np.linalg.norm(points - found[0], axis=1)))
    turned = np.roll(points, -start, axis=0)
    back = np.vstack([turned[:1], turned[:0:-1]])
    return min(np.abs(found - turned).max(), np.abs(found - back).max()) < 1e-9


def rounded(sets):
    print("\npoints rounded to 1 mm: worst rms to surface, worst move, sets that say so")
    good = True
    for name, exact in curves().items():
        rms, moved, told = [], [], 0
        for seed in range(sets):
            points = np.round(exact.points(6 + seed % 10, seed, GAP_RATIO))
            axis = fit_axis(name, points, exact.surface, closed=exact.closed)
            rms.append(axis.distance_to(exact.surface, SAMPLES)[0])
            moved.append(axis.moved.max())
            told += any("rounded to 1 mm" in finding.message for finding in axis.findings)
        good &= max(rms) <= RMS_LIMIT and told == sets
        print(f"{name:8} {max(rms):9.5f} {max(moved):7.3f} {told:4d} of {sets}")
    return good


def by_rule():
    """Plane sections and geodesics: distance to surface and plane, closed forms, time."""
    print("\nby rule: largest distance to surface and plane, mm; geodesic curvature, 1/m; ms")
    table = curves()
    good = True
    for name in ("E-diag", "T-diag", "N-diag"):
        exact = table[name]
        ends = exact.derivatives(np.array([0.0, 1.0]))[0]
        normal = np.cross(ends[1] - ends[0], exact.surface.closest(ends[:1]).normals[0])
        for rule in (
            PlaneSection(tuple(ends[0]), tuple(normal), *map(tuple, ends)),
            Geodesic(*map(tuple, ends)),
        ):
            begin = time.perf_counter()
            curve, _, _ = curve_by_rule(name, rule, exact.surface)
            took = 1e3 * (time.perf_counter() - begin)
            axis = axis_from_curve(name, curve)
            s = np.linspace(0.0, axis.length, SAMPLES)[1:-1]
            points = axis.position(s)
            foot = exact.surface.closest(points)
            away = float(np.abs(foot.distance).max())
            if isinstance(rule, PlaneSection):
                second = float(np.abs((points - ends[0]) @ normal).max() / np.linalg.norm(normal))
            else:
                across = np.cross(foot.normals, axis.tangent(s))
                second = 1e3 * float(np.abs((axis.curvature(s) * across).sum(axis=1)).max())
            good &= away < 5e-6
            print(
                f"{name:8} {type(rule).__name__:12} {away:9.2g} {second:9.2g} "
                f"{len(curve.poles):5d} poles {took:6.0f}"
            )
    return good


if __name__ == "__main__":
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    results = [accuracy(number), orders(200), rounded(number), by_rule()]
    sys.exit(0 if all(results) else 1)
