# SPDX-License-Identifier: LGPL-2.1-or-later
"""Length errors and times of flat patterns, beside FreeCAD's flatmesh and libigl.

Run: python3 benchmarks/flattening.py [plates [members]]

Error: largest flat minus true length over both edges (per panel <= 500 and whole), station lines
and geodesic diagonals of the panels, mm. Bound: the proven floor |K|A²/(12(D + b + l)) of any
flat pattern. The ring is a closed member split at its seam, the lanes a wide box in lanes of its
stock. Elastic: largest distance to the optimum with knots twice as dense. CPU time on one
core, best of several runs. flatmesh and libigl get about 2000 triangles and 60 s a
plate; of a group, they get the plate of the largest bound, if it has no fold. Whole members get
edges, seams and allowances besides.
"""

import multiprocessing
import os
import sys
import time
from dataclasses import replace
from pathlib import Path

# Before numpy, which reads it once.
os.environ.update(dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "1"))

import numpy as np
from scipy.interpolate import RectBivariateSpline

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

import curved_members  # noqa: E402
import ruled_patches  # noqa: E402

from BendTorsionWB import freecad_path  # noqa: E402
from BendTorsionWB.core.axes.axis import fit_axis  # noqa: E402
from BendTorsionWB.core.axes.frames import surface_frames  # noqa: E402
from BendTorsionWB.core.flattening.development import develop  # noqa: E402
from BendTorsionWB.core.flattening.elastic import distance, relaxed  # noqa: E402
from BendTorsionWB.core.flattening.measure import panel_samples  # noqa: E402
from BendTorsionWB.core.flattening.surface_shape import shape_of  # noqa: E402
from BendTorsionWB.core.geometry.piecewise import Piecewise  # noqa: E402
from BendTorsionWB.core.geometry.surface import analytic_surface  # noqa: E402
from BendTorsionWB.core.joints.lanes import Lanes  # noqa: E402
from BendTorsionWB.core.members.member import Member  # noqa: E402
from BendTorsionWB.core.members.zones import Segment, section_law  # noqa: E402
from BendTorsionWB.core.patterns.gross import Allowances, as_cut  # noqa: E402
from BendTorsionWB.core.patterns.laid_flat import PatternInput, laid_flat  # noqa: E402
from BendTorsionWB.core.patterns.pattern import develop_plate, development_of, outline_of  # noqa: E402
from BendTorsionWB.core.plates.plates import Joints, split_plates  # noqa: E402
from BendTorsionWB.core.sections.section import BOX_FACES  # noqa: E402

SECONDS = 60
ROUNDING = 1e-6


def wavy(s):
    return 700.0 + 200.0 * np.sin(np.pi * s / 1500.0)


def sliver(s):
    return 10.0 + 890.0 * np.sin(np.pi * s / 6000.0) ** 2


def patches():
    """Name, rails, folds of the reference set that are not plates of a member."""
    yield "cylinder R 12 m", ruled_patches.cylinder()
    yield "cone", ruled_patches.cone()
    for twist in (0.01, 0.03, 0.06, 0.1):
        yield f"helicoid {twist:g} rad/m", ruled_patches.helicoid(twist)
    yield "R 5 m, 0.2 rad/m, 800", ruled_patches.bent_in_plane(lambda s: 800.0 + 0.0 * s)
    yield "R 5 m, 0.2 rad/m, 500-900", ruled_patches.bent_in_plane(wavy)
    yield "R 5 m, 0.2 rad/m, 10-900-10", ruled_patches.bent_in_plane(sliver)


def steep(t):
    """(n, 3): 27 m of the 40/30/20 ellipsoid along which the normal turns 0.010 to 0.024 rad/m."""
    u, v = 0.9 + 0.6 * np.asarray(t), 0.1 + 0.7 * np.asarray(t)
    unit = np.column_stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)])
    return unit * curved_members.HALF_AXES


def ellipsoid_plates():
    """Plates of the 800 box and of its taper to 600 on the 40/30/20 ellipsoid, by group."""
    big = curved_members.box("B800", "box1", 800, 800, 20)
    small = curved_members.box("B600", "box1", 600, 600, 16)
    fifths = {face: Joints((0.2, 0.4, 0.6, 0.8)) for face in BOX_FACES}
    constant, tapered = (
        split_plates(curved_members.member(segments, steep), fifths)[0]
        for segments in ([Segment(big)], [Segment(big), Segment(small, 9000.0, 2.5)])
    )
    return {
        "ellipsoid box 800": list(constant),
        "ellipsoid transitions": [plate for plate in tapered if plate.in_transition],
    }


def ring():
    """A ring of the torus 20/4 m that winds once round its tube, a member on a closed axis."""
    t = np.linspace(0.0, 2.0 * np.pi, 97)[:-1]
    reach = 20000.0 + 4000.0 * np.cos(t + 0.4)
    points = np.column_stack([reach * np.cos(t), reach * np.sin(t), 4000.0 * np.sin(t + 0.4)])
    torus = analytic_surface("torus", {"R": 20000.0, "r": 4000.0})
    axis = fit_axis("A1", points, torus, closed=True)
    section = curved_members.box("B600", "box1", 600, 600, 16)
    law = section_law("M1", [Segment(section)], axis.length)
    member = Member("M1", surface_frames(axis, torus), law)
    return member, split_plates(member, {face: Joints((), "auto") for face in BOX_FACES})[0]


def lanes():
    """A box 2600 wide on the ellipsoid, each face in two lanes of the stock of 2400."""
    wide = curved_members.member([Segment(curved_members.box("W", "box1", 2600, 2600, 30))], steep)
    auto = {face: Joints((), "auto") for face in BOX_FACES}
    seams = {face: Lanes((), "auto") for face in BOX_FACES}
    return wide, split_plates(wide, auto, lanes=seams)[0]


def measured(development, places, folds=()):
    """True and flat lengths of one patch: panels' edges, whole edges, lines, diagonals."""
    samples = panel_samples(development, places, folds)
    edges = [samples.edge(w) for w in (0.0, 1.0)]
    flat, true = (
        np.concatenate(
            [
                *(edge[k] for edge in edges),
                [edge[k].sum() for edge in edges],
                *(diagonal[k] for diagonal in samples.geodesics()),
            ]
        )
        for k in (0, 1)
    )
    ends = samples.ends
    lines = np.linalg.norm(ends.ruling, axis=1)
    across = np.linalg.norm(ends.flat(np.ones(len(lines))) - ends.flat(0.0 * lines), axis=1)
    return np.concatenate([flat, across]), np.concatenate([true, lines])


def bound(rails, places):
    """The floor of the largest error, from the panels' straight sizes and mid curvature."""
    corners = rails(places).reshape(-1, 2, 3)
    along = np.linalg.norm(np.diff(corners, axis=0), axis=2).mean(axis=1)
    across = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1)
    across = 0.5 * (across[1:] + across[:-1])
    diagonal = np.hypot(along, across)
    gauss = shape_of(rails, 0.5 * (places[1:] + places[:-1]), np.array([0.5])).gauss[:, 0]
    return float(
        (np.abs(gauss) * (along * across) ** 2 / (12.0 * (diagonal + across + along))).max()
    )


def stations(development):
    """Places of panels no longer than 500 on either edge."""
    start, end = development.plane.start, development.plane.end
    count = 1
    while True:
        places = np.linspace(start, end, count + 1)
        samples = panel_samples(development, places, ())
        if max(samples.edge(w)[1].max() for w in (0.0, 1.0)) <= 500.0 * (1 + 1e-9):
            return places
        count += 1


class Grid:
    """A flat map known at a grid of (s, w), as smooth as its own bicubic spline."""

    def __init__(self, s, w, flat):
        flat = flat.reshape(len(s), len(w), 2)
        self.maps = [RectBivariateSpline(s, w, flat[..., k]) for k in (0, 1)]

    def flat(self, s, w):
        return np.column_stack([one.ev(s, w) for one in self.maps])


def peer_error(grid, places, true):
    """Largest error of a peer's map on the same lengths, order as in measured()."""
    k = len(places) - 1
    fine = places[:-1, None] + np.diff(places)[:, None] * np.linspace(0.0, 1.0, 65)
    lengths = []
    for w in (0.0, 1.0):
        points = grid.flat(fine.ravel(), np.full(fine.size, w)).reshape(k, 65, 2)
        lengths.append(np.linalg.norm(np.diff(points, axis=1), axis=2).sum(axis=1))
    first, second = (grid.flat(places, np.full(k + 1, w)) for w in (0.0, 1.0))
    diagonals = (second[1:] - first[:-1], first[1:] - second[:-1])
    flat = np.concatenate(
        [
            *lengths,
            [edge.sum() for edge in lengths],
            *(np.linalg.norm(d, axis=1) for d in diagonals),
            np.linalg.norm(second - first, axis=1),
        ]
    )
    return float(np.abs(flat - true).max())


def mesh(development):
    """Even grid places, points (n, 3) and about 2000 triangles of the mid-surface."""
    start, end = development.plane.start, development.plane.end
    s, w = np.linspace(start, end, 101), np.linspace(0.0, 1.0, 11)
    points = development.point(np.repeat(s, len(w)), np.tile(w, len(s)))
    corner = (np.arange(len(s) - 1)[:, None] * len(w) + np.arange(len(w) - 1)).ravel()
    one = np.column_stack([corner, corner + len(w), corner + len(w) + 1])
    two = np.column_stack([corner, corner + len(w) + 1, corner + 1])
    return s, w, points, np.concatenate([one, two]).astype(np.int64)


def by_flatmesh(points, triangles):
    freecad_path.append()
    import flatmesh
    import FreeCAD  # noqa: F401

    unwrapper = flatmesh.FaceUnwrapper(points, triangles)
    unwrapper.findFlatNodes(5, 0.95)
    return np.array(unwrapper.ze_nodes)[:, :2]


def by_libigl(points, triangles):
    import igl

    ends = np.array([0, len(points) - 1])
    chord = np.linalg.norm(points[-1] - points[0])
    found = igl.lscm(points, triangles, ends, np.array([[0.0, 0.0], [chord, 0.0]]))
    flat = next(part for part in found if getattr(part, "shape", ())[1:] == (2,))
    return flat * np.sqrt(_area(points, triangles) / _area(flat, triangles))


def _area(points, triangles):
    one = points[triangles[:, 1]] - points[triangles[:, 0]]
    two = points[triangles[:, 2]] - points[triangles[:, 0]]
    square = (one**2).sum(axis=1) * (two**2).sum(axis=1) - (one * two).sum(axis=1) ** 2
    return 0.5 * np.sqrt(square).sum()


def _sent(pipe, method, points, triangles):
    try:
        start = time.process_time()
        flat = method(points, triangles)
        pipe.send((flat, time.process_time() - start))
    except ImportError:
        pipe.send(None)


def peer(method, development, places, true):
    """Error and seconds as text; time-bounded in a process of its own."""
    s, w, points, triangles = mesh(development)
    ours, theirs = multiprocessing.Pipe()
    process = multiprocessing.Process(target=_sent, args=(theirs, method, points, triangles))
    process.start()
    theirs.close()
    answer, text = None, f"over {SECONDS} s"
    if ours.poll(SECONDS):
        try:
            answer = ours.recv()
            text = "not installed"
        except EOFError:
            text = "crashed"
    process.kill()
    process.join()
    if answer is None:
        return text
    return f"{peer_error(Grid(s, w, answer[0]), places, true):.4f}"


def least(build, repeats=7):
    """Least CPU milliseconds of build()."""
    times = []
    for _ in range(repeats):
        start = time.process_time()
        build()
        times.append(1e3 * (time.process_time() - start))
    return min(times)


def row(name, errors, floor, elastic, peers):
    ratio = errors["edges"] / floor if floor > ROUNDING else 0.0
    fine = errors["edges"] <= max(2.5 * floor, ROUNDING)
    print(
        f"{name:<28}{errors['edges']:11.2e}{floor:11.2e}{ratio:7.2f}{'ok' if fine else 'OVER':>5}"
        f"{errors['energy']:9.4f}{errors['elastic']:9.4f}{elastic:11.5f}"
        + "".join(f"{text:>15}" for text in peers)
    )
    return fine and elastic <= 0.01


def reference_set():
    print(
        f"{'':<28}{'edges':>11}{'bound':>11}{'x':>7}{'':>5}{'energy':>9}{'elastic':>9}"
        f"{'to optimum':>11}{'flatmesh':>15}{'libigl LSCM':>15}   mm"
    )
    good = True
    for name, rails in patches():
        start = develop(rails, name, "energy")
        patterns = {"edges": develop(rails, name), "energy": start, "elastic": relaxed(start)}
        places = stations(patterns["edges"])
        lengths = {mode: measured(pattern, places) for mode, pattern in patterns.items()}
        errors = {mode: float(np.abs(flat - true).max()) for mode, (flat, true) in lengths.items()}
        off = distance(patterns["elastic"], relaxed(start, refinement=2, terms=8))
        true = lengths["edges"][1]
        peers = [peer(by, patterns["edges"], places, true) for by in (by_flatmesh, by_libigl)]
        good &= row(name, errors, bound(rails, places), off, peers)
    groups = {**ellipsoid_plates(), "closed ring": ring()[1], "lanes of 2600": lanes()[1]}
    for name, plates in groups.items():
        worst = {}
        for mode in ("edges", "energy", "elastic"):
            records = [develop_plate(plate, mode=mode) for plate in plates]
            worst[mode] = max(record.length_error_max for record in records)
            if mode == "edges":
                ratios = [
                    r.length_error_max / r.length_error_bound
                    for r in records
                    if r.length_error_max > ROUNDING
                ]
                floors = [r.length_error_bound for r in records]
        offs = []
        for plate in plates:
            start, folds = develop(plate.rails.mid, mode="energy"), plate.rails.mid_folds
            offs.append(distance(relaxed(start, folds), relaxed(start, folds, "", 2, 8)))
        plate, peers = plates[int(np.argmax(floors))], ["-", "-"]
        if not plate.folds:
            development = development_of(plate, "edges")
            places = np.array([line.s_mid for line in plate.lines])
            true = measured(development, places)[1]
            peers = [peer(by, development, places, true) for by in (by_flatmesh, by_libigl)]
        good &= row(f"{name} ({len(plates)})", worst, max(floors), max(offs), peers)
        good &= max(ratios) <= 2.5
        print(f"{'':<28}largest error over its own plate's bound: {max(ratios):.2f}")
    return good


def fresh(plate):
    """The plate with rails of its own, so that nothing they remember is had for free."""
    rails = {
        level: Piecewise(rail.breaks, rail.values)
        for level, rail in vars(plate.rails).items()
        if isinstance(rail, Piecewise)
    }
    return replace(plate, rails=replace(plate.rails, **rails))


def times(count):
    plates = [plate for group in ellipsoid_plates().values() for plate in group]
    print(f"\nms per pattern, one core, {len(plates)} plates of 4 to 6 m")
    for mode in ("edges", "energy", "elastic"):
        alone = least(lambda m=mode: [outline_of(p, m) for p in plates], 5) / len(plates)
        print(f"  {mode:<8} pattern and outline {alone:6.2f}")
    many = [fresh(plates[k % len(plates)]) for k in range(count)]
    start = time.process_time()
    for plate in many:
        develop_plate(plate)
    print(f"  {count} plates with all their data in `edges`: {time.process_time() - start:.2f} s")


def members(count):
    """Time of `count` plates as members: edges, seams and allowances with them."""
    built = []
    for segments in ([800], [800, 600]):
        sections = [curved_members.box(f"B{b}", "box1", b, b, 20) for b in segments]
        member = curved_members.member(
            [Segment(s, 9000.0 * k, 2.5) for k, s in enumerate(sections)], steep
        )
        fifths = {face: Joints((0.2, 0.4, 0.6, 0.8)) for face in BOX_FACES}
        built.append((member, split_plates(member, fifths)[0]))
    allowances = Allowances(0.6, 0.3, 1.5, 0.3, 50.0, 50.0)
    for name, given in (("net", PatternInput()), ("gross", PatternInput(allowances=allowances))):
        done, spent = 0, 0.0
        while done < count:
            for member, plates in built:
                own = [fresh(plate) for plate in plates]
                start = time.process_time()
                laid_flat(member, own, given)
                spent += time.process_time() - start
                done += len(plates)
        print(f"  {done} plates of members, {name}: {1000.0 * spent / done:.2f} s per 1,000")
    made = [plate for member, plates in built for plate in laid_flat(member, plates, given)]
    start = time.process_time()
    for plate in made:
        as_cut(plate)
    spent = 1e3 * (time.process_time() - start) / len(made)
    print(f"  gross record of a plate for its cut files: {spent:.2f} ms")
    print("  worst seam mismatch, mm, of these members by mode:")
    for mode in ("edges", "energy", "elastic"):
        worst = 0.0
        for member, plates in built:
            made = laid_flat(member, plates, PatternInput(mode))
            worst = max(worst, *(plate.errors.seam for plate in made))
        print(f"    {mode:<8} {worst:.1e}")


def main():
    good = reference_set()
    times(int(sys.argv[1]) if len(sys.argv) > 1 else 1000)
    members(int(sys.argv[2]) if len(sys.argv) > 2 else 500)
    print("\nall within limits" if good else "\nOVER A LIMIT")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
