# SPDX-License-Identifier: LGPL-2.1-or-later
"""Members against truth and against FreeCAD's own lofts and sweeps.

Run: python3 benchmarks/members.py; random members are in random_members.py.

Truth: corners from positions of the axis, normals of the ellipsoid and the section alone. Errors
are distances of true corners from the long edges of the solid, everywhere between the stations.
Times are CPU times on one core, best run. The table at the end is that of docs/members.md.
"""

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from BendTorsionWB import freecad_path  # noqa: E402

freecad_path.append()

import FreeCAD  # noqa: E402
import Part  # noqa: E402
from curved_members import ELLIPSOID, diagonal, in_space, irregular, member  # noqa: E402
from exact_axes import curves  # noqa: E402

from BendTorsionWB import make  # noqa: E402
from BendTorsionWB.core import detailing, memo  # noqa: E402
from BendTorsionWB.core.axes.axis import fit_axis  # noqa: E402
from BendTorsionWB.core.axes.frames import surface_frames  # noqa: E402
from BendTorsionWB.core.members.member import Member  # noqa: E402
from BendTorsionWB.core.members.skin import skin  # noqa: E402
from BendTorsionWB.core.members.zones import Segment, section_law  # noqa: E402
from BendTorsionWB.core.plates.plates import split_plates  # noqa: E402
from BendTorsionWB.core.sections.section import box  # noqa: E402
from BendTorsionWB.core.solids import solid_skins  # noqa: E402
from BendTorsionWB.objects import plate_set  # noqa: E402
from BendTorsionWB.shapes import brep, kept_solids  # noqa: E402

LENGTH = 24000.0
RING = np.array([(400.0, 400.0), (-400.0, 400.0), (-400.0, -400.0), (400.0, -400.0)])


def vectors(points):
    return [FreeCAD.Vector(*point) for point in points.tolist()]


def best(build, repeats=7):
    """Least CPU milliseconds of build(), and its last result."""
    times = []
    for _ in range(repeats):
        start = time.process_time()
        result = build()
        times.append(1e3 * (time.process_time() - start))
    return min(times), result


def truth(built, s, cells=None):
    """True corners (n, 4, 3) at s (n,)."""
    plane = np.broadcast_to(RING, (len(s), 4, 2)) if cells is None else cells(s)
    return np.stack([in_space(built, ELLIPSOID, s, plane[:, k]) for k in range(4)], axis=1)


def edge_error(solid, points):
    """Largest distance, mm, of corner points (n, 4, 3) from the long edges of a solid."""
    edges = Part.Compound([e for e in solid.Edges if e.Length > 3 * 800 or len(solid.Edges) > 60])
    return max(
        edges.distToShape(Part.Vertex(*point))[0] for point in points.reshape(-1, 3).tolist()
    )


def lofted(rings, ruled):
    wires = [Part.makePolygon(vectors(np.concatenate([ring, ring[:1]]))) for ring in rings]
    return Part.makeLoft(wires, True, ruled)


def piped(built):
    """Spine and auxiliary spine interpolated through 193 points, the section kept in its plane."""
    s = np.linspace(0.0, LENGTH, 193)
    at = built.frames.at(s)
    spines = []
    for line in (at.origin, at.origin + 1000.0 * at.z):
        curve = Part.BSplineCurve()
        curve.interpolate(vectors(line))
        spines.append(Part.Wire(curve.toShape()))
    pipe = Part.BRepOffsetAPI.MakePipeShell(spines[0])
    pipe.setAuxiliarySpine(spines[1], False, 0)
    ring = truth(built, s[:1])[0]
    pipe.add(Part.makePolygon(vectors(np.concatenate([ring, ring[:1]]))), False, False)
    pipe.build()
    pipe.makeSolid()
    return pipe.shape()


def corners():
    print(f"\nCorners, 800 x 800 box, {LENGTH / 1000:.0f} m of a diagonal, 25 even stations")
    axis = curves()["E-diag"].axis()
    segment = Segment(box("S", "box1", 800, 800, 20))
    built = Member("M1", surface_frames(axis, ELLIPSOID), section_law("M1", [segment], axis.length))
    stations = np.linspace(0.0, LENGTH, 25)
    at = truth(built, stations)
    dense = np.linspace(0.0, LENGTH, 24 * 8 + 1)[1:-1]
    exact = truth(built, dense)

    def ours():
        pieces = skin((built.corners(0.0, LENGTH),), tolerance=np.inf)
        return brep.tube_solid([(p.knots, p.poles) for p in pieces])

    rows = (
        ("ours", ours),
        ("makeLoft smooth", lambda: lofted(at, False)),
        ("makeLoft ruled", lambda: lofted(at, True)),
        ("pipe, auxiliary spine", lambda: piped(built)),
    )
    misses, times = {}, {}
    for name, build in rows:
        times[name], solid = best(build, 3)
        misses[name] = edge_error(solid, exact)
        print(
            f"  {name:<24}{misses[name]:10.1e} mm{times[name]:9.1f} ms"
            f"{len(solid.Faces):5d} faces  valid {solid.isValid()}"
        )
    # No cubic spline on these knots errs by less than about |d4C/ds4|h⁴/768 (half of what one
    # through the stations does).
    rate = built.corners(0.0, LENGTH)
    for _ in range(4):
        rate = rate.derivative
    bend = np.linalg.norm(rate(dense).reshape(len(dense), 4, 3), axis=2).max()
    floor = bend * (LENGTH / 24) ** 4 / 768
    print(f"  floor of cubics on 25 even stations {floor:.1e} mm")
    for tolerance in (1e-3, 1e-6, 1e-8):
        pieces = skin((built.corners(0.0, LENGTH),), tolerance=tolerance)
        miss = np.linalg.norm(pieces[0].at(dense) - exact, axis=2).max()
        print(f"  ours to {tolerance:g} mm: {len(pieces[0].knots) - 7} intervals, {miss:.1e} mm")
    peers = [f"{name} {misses[name]:.1e}" for name, _ in rows[1:]]
    row("corners, 24 m diagonal, 25 even stations, mm", "5e-4", misses["ours"], peers, floor)
    peers = [f"{name} {times[name]:.0f}" for name, _ in rows[1:]]
    row("time of that solid, ms", "", times["ours"], peers)


def transitions():
    worst, peers = {}, {}
    print("\nCorners over transitions 800 -> 600, top-left flush (limit 1e-3 mm)")
    for slope in (2.5, 4.0):
        for kind in ("linear", "smooth"):
            segments = [
                Segment(box("A", "box1", 800, 800, 20)),
                Segment(
                    box("B", "box1", 600, 600, 20),
                    9000.0,
                    slope,
                    "top-left",
                    "previous",
                    transition=kind,
                ),
            ]
            built = member(segments)
            reach = slope * 200.0
            s = np.linspace(8000.0, 10000.0 + reach, 1201)

            def plane(s, reach=reach, kind=kind):
                x = np.clip((s - 9000.0) / reach, 0, 1)
                x = x if kind == "linear" else 3 * x**2 - 2 * x**3
                return RING + x[:, None, None] * (
                    np.array([(400, 400), (-200, 400), (-200, -200), (400, -200)]) - RING
                )

            exact = truth(built, s, plane)
            tube = solid_skins.corner_tubes(built)[0]
            miss = 0.0
            for piece in tube:
                mine = (s >= piece.knots[0]) & (s <= piece.knots[-1])
                miss = max(miss, np.linalg.norm(piece.at(s[mine]) - exact[mine], axis=2).max())
            folds = np.array([9000.0, 9000.0 + reach])
            own = np.linspace(0, built.length, 97)
            clear = np.abs(own[:, None] - folds).min(axis=1) > 150.0
            own = np.union1d(own[clear], folds)
            loft = lofted(truth(built, own, plane), False)
            peer = edge_error(loft, exact[::20])
            print(
                f"  p = {slope:g}, {kind:<7} ours {miss:.1e} mm, makeLoft smooth with stations "
                f"at the folds {peer:.1e} mm"
            )
            worst[slope, kind], peers[slope, kind] = miss, peer
    for slope in (2.5, 4.0):
        name = f"corners over transitions, p = {slope:g}, mm"
        ours = max(worst[slope, kind] for kind in ("linear", "smooth"))
        peer = f"smooth loft with stations at the folds {peers[slope, 'linear']:.1e} (linear)"
        row(name, "1e-3", ours, [peer, f"{peers[slope, 'smooth']:.1e} (smooth)"])


def thickness():
    print("\nTrue plate thickness of the solids, 20 mm, folded members (limit 0.01 mm)")
    worst = 0.0
    for type in ("box1", "box2"):
        built = member(
            [
                Segment(box("A", type, 800, 800, 20)),
                Segment(box("B", type, 600, 600, 20), 9000.0, 2.5, "top-left", "previous"),
            ]
        )
        for plate in split_plates(built, {})[0]:
            for piece in solid_skins.plate_skin(plate):
                s = np.repeat(np.linspace(piece.knots[0], piece.knots[-1], 60)[1:-1], 3)
                w = np.tile([0.1, 0.5, 0.9], 58)[:, None]
                rails = piece.at(s)
                inner = rails[:, 3] + w * (rails[:, 2] - rails[:, 3])
                worst = max(worst, np.abs(distances(piece, inner, s, w) - 20.0).max())
    print(f"  worst difference {worst:.1e} mm")
    row("true thickness of 20 mm plates, folded members, mm", "0.01", worst, [])


def distances(piece, points, s, w):
    """Distance (n,) of points from the outer face, by Gauss-Newton from (s, w)."""

    def outer(s, w):
        rails = piece.at(s)
        return rails[:, 0] + w * (rails[:, 1] - rails[:, 0])

    for _ in range(5):
        gap = outer(s, w) - points
        along = outer(s + 0.5, w) - outer(s - 0.5, w)
        across = (outer(s, w + 1e-3) - outer(s, w - 1e-3)) / 2e-3
        jacobian = np.stack([along, across], axis=2)
        normal = jacobian.transpose(0, 2, 1) @ jacobian
        step = np.linalg.solve(normal, jacobian.transpose(0, 2, 1) @ gap[:, :, None])[:, :, 0]
        s, w = s - step[:, 0], w - step[:, 1:]
    return np.linalg.norm(outer(s, w) - points, axis=1)


def recompute():
    print("\nA member of five segments and its 20 plates, after an edit of a cut (limit 60 ms)")
    document = FreeCAD.newDocument("benchmark")
    surface = make.make_surface(document, "S", "ellipsoid", a=40000, b=30000, c=20000)
    axis = make.make_axis(document, "A1", surface, irregular(diagonal, 9).tolist())
    sections = [
        make.make_section(
            document, f"B{k}", "box1", h=800 - 40 * (k % 2), b=800 - 40 * (k % 2), t=20
        )
        for k in range(5)
    ]
    built = make.make_member(
        document, "M1", axis, sections, [{}, *({"cut": 5000.0 * k} for k in range(1, 5))]
    )
    plates = make.make_plates(
        document,
        built,
        {
            face: [0.2 + shift, 0.4 + shift, 0.6 + shift, 0.8 + shift, 1.0]
            for face, shift in zip(("top", "bottom", "left", "right"), (0.0, 0.02, 0.04, 0.06))
        },
    )
    document.recompute()
    print(f"  {plates.PlateCount} plates, {plates.Status}")
    for what, edit, name in (
        ("a cut (most plates stay)", lambda k: setattr(built, "Cut2", 5000.0 + k), "a cut edited"),
        (
            "the roll (every plate changes)",
            lambda k: setattr(built, "Roll", 0.01 * k),
            "all edited",
        ),
    ):
        walls, own = [], []
        for k in range(1, 13):
            edit(k)
            start, cpu = time.perf_counter(), time.process_time()
            document.recompute()
            walls.append(1e3 * (time.perf_counter() - start))
            own.append(1e3 * (time.process_time() - cpu))
        print(
            f"  after an edit of {what}: {min(walls):.0f} ms wall (median {np.median(walls):.0f}), "
            f"{min(own):.0f} ms CPU (median {np.median(own):.0f})"
        )
        row(f"five segments and 20 plates, {name}, ms", "60", min(own), [])
    value = plate_set.value(plates)
    geometry, given = value.geometry, value.given

    def anew(arrow):
        memo.forget_all()
        return arrow()

    arrows = {
        "plates and skins": lambda: anew(lambda: detailing.plates_of(geometry, given)),
        "outer skin": lambda: anew(lambda: detailing.member_skins(geometry)),
        "20 solids": lambda: brep.tube_solids(
            [[(p.knots, p.poles) for p in item.skin] for item in value.plates]
        ),
        "20 solids, checked": lambda: anew(
            lambda: kept_solids.solids_of([item.skin for item in value.plates])
        ),
    }
    for name, run in arrows.items():
        milliseconds, result = best(run)
        print(f"  {name:<20}{milliseconds:7.1f} ms")
        if name == "20 solids":
            print(f"  {milliseconds / len(result):.2f} ms per plate solid (limit 1)")
            lofts = [best(lambda k=k: lofted_plate(value.plates[k], False), 2)[0] for k in (0, 7)]
            ruled = [best(lambda k=k: lofted_plate(value.plates[k], True), 2)[0] for k in (0, 7)]
            peers = [f"makeLoft smooth {max(lofts):.0f}", f"ruled {max(ruled):.0f}"]
            row("one plate solid, ms", "1", milliseconds / len(result), peers)
    FreeCAD.closeDocument("benchmark")


def lofted_plate(item, ruled):
    """The loft of a plate's rings at stations about 1000 apart."""
    rails = item.plate.rails
    s = np.linspace(item.plate.start, item.plate.end, 6)
    outer, inner = (group(s).reshape(-1, 2, 3) for group in (rails.outer, rails.inner))
    return lofted(np.concatenate([outer, inner[:, ::-1]], axis=1), ruled)


def ring():
    print("\nA closed ring, 800 -> 600 and back through the seam, thickness changes on the way")
    t = np.linspace(0.0, 2 * np.pi, 17)[:-1]
    points = np.column_stack([32000 * np.cos(t), 24000 * np.sin(t), np.full(16, 12000.0)])
    axis = fit_axis("A1", points, ELLIPSOID, closed=True)
    segments = [
        Segment(box("A", "box1", 800, 800, 20), axis.length - 100.0),
        Segment(box("B", "box1", 600, 600, 16), 0.4 * axis.length),
    ]
    law = section_law("M1", segments, axis.length, closed=True)
    built = Member("M1", surface_frames(axis, ELLIPSOID), law)
    plates, _ = split_plates(built, {})
    solids = [
        brep.tube_solid([(p.knots, p.poles) for p in one])
        for one in solid_skins.plate_skins(plates)
    ]
    gap = 0.0
    for face in {plate.face for plate in plates}:
        own = [plate for plate in plates if plate.face == face]
        for level in ("outer", "inner"):
            first, last = getattr(own[0].rails, level), getattr(own[-1].rails, level)
            gap = max(gap, np.abs(first(0.0) - last(built.length)).max())
    valid = all(solid.isValid() and solid.isClosed() for solid in solids)
    print(f"  {len(solids)} plates, valid {valid}, ends meet to {gap:.1e} mm")
    row("closed ring: plates valid, ends meet to, mm", "valid", gap, [], note=f"valid {valid}")


TABLE = []


def row(what, limit, ours, peers, floor=None, note=""):
    """A row of the table of figures; the distance from the floor is told where there is one."""
    figure = str(ours) if isinstance(ours, int) else f"{ours:.2g}"
    figure += f", {note}" if note else ""
    distance = "" if floor is None else f"{floor:.1e}"
    TABLE.append(f"| {what} | {limit} | {figure} | {'; '.join(peers)} | {distance} |")


def print_table():
    print("\n| figure | limit | ours | peers | floor |\n|---|---|---|---|---|")
    print("\n".join(TABLE))


def main():
    print(f"FreeCAD {'.'.join(FreeCAD.Version()[:3])}, OCCT {Part.OCC_VERSION}")
    corners()
    transitions()
    thickness()
    ring()
    recompute()
    print_table()


if __name__ == "__main__":
    main()
