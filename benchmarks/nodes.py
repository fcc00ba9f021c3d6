# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nodes of the concert hall: cuts on the true face, solids against the kernel, overlaps, time.

Run: python3 benchmarks/nodes.py [--build] [--steps] [SCHEDULE]. Prints each figure beside its
limit; ends with 1 when one is missed. --build also builds the whole schedule and times it; --steps
prints step and angle of every corner beside those measured on the solids.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from BendTorsionWB import freecad_path  # noqa: E402

freecad_path.append()

import FreeCAD  # noqa: E402, F401
import numpy as np  # noqa: E402
from node_steps import corners  # noqa: E402

from BendTorsionWB import project  # noqa: E402
from BendTorsionWB.core import detailing  # noqa: E402
from BendTorsionWB.core.members.contour import end_curves  # noqa: E402
from BendTorsionWB.core.nodes.node_faces import outer_faces  # noqa: E402
from BendTorsionWB.shapes import brep, cut_solid  # noqa: E402
from BendTorsionWB.shapes.flat_solid import flat_solid  # noqa: E402
from BendTorsionWB.sheets.pdf import start_qt  # noqa: E402

SCHEDULE = ROOT / "resources/examples/concert_hall/concert_hall_nodes.xlsx"
W = np.linspace(0.0, 1.0, 41)
NODES_CHECKED = 6
"""Nodes, evenly among all, whose solids are intersected by the kernel, all pairs of each."""
SOLIDS_CHECKED = 8
"""Branch ends whose solids are compared with the kernel's boolean, which takes a second each."""

_missed = []


def told(what: str, value: float, limit: float, unit: str, least: bool = False) -> None:
    good = value >= limit if least else value <= limit
    print(
        f"{what:58} {value:12.3g} {'≥' if least else '≤'} {limit:g} {unit}{'' if good else '  !'}"
    )
    if not good:
        _missed.append(what)


def ends_of(plates, node):
    """Plate, end (0 or 1) and cut of all ends at a node."""
    for item in plates:
        for end, cut in enumerate(item.plate.cuts):
            if cut is not None and getattr(cut.surface, "node", "") == node:
                yield item, end, cut


def off_face(faces, through_gap, item, cut) -> float:
    """Largest distance, mm, of the cut on all three surfaces from the true face less the gap."""
    worst = 0.0
    for level in ("outer", "mid", "inner"):
        value = getattr(item.plate.uncut, level)(cut.at(level, W))
        points = value[:, :3] + W[:, None] * (value[:, 3:] - value[:, :3])
        away = np.max([faces.distance(k, points)[0] for k in cut.surface.landing], axis=0)
        worst = max(worst, float(np.abs(away - through_gap).max()))
    return worst


def pairs_of(items, solids):
    """Plate and solid of each."""
    return [(item.plate, solid) for item, (solid, _) in zip(items, solids, strict=True)]


def main(arguments: list[str]) -> int:
    build = "--build" in arguments
    paths = [a for a in arguments if not a.startswith("--")]
    path = Path(paths[0]) if paths else SCHEDULE
    start = time.process_time()
    schedule, jobs, found = project.read_project(path)
    told("reading, axes and nodes", time.process_time() - start, 15.0, "s CPU")
    told("nodes", len(found.nodes), 30, "", least=True)
    geometry, plates = {}, {}
    for name, job in jobs.items():
        geometry[name] = detailing.member_of(
            job.member, detailing.axis_of(job.axis, job.surface), job.surface
        )
        plates[name] = detailing.plates_of(detailing.noded(geometry[name], job.nodes), job.plates)

    worst, count, seconds = 0.0, 0, 0.0
    for node in found.nodes:
        member = geometry[node.through].member
        for branch in node.branches:
            low, high = branch.seat
            faces = outer_faces(member, low - 1000.0, high + 1000.0)
            for item, end, cut in ends_of(plates[branch.member].plates, node.name):
                worst = max(worst, off_face(faces, branch.gap, item, cut))
                start = time.process_time()
                end_curves(item.plate.mark, item.plate.uncut, cut.surface, end)
                seconds += time.process_time() - start
            count += len(branch.sides)
    told("cut contours off the true face less the gap", worst, 0.02, "mm")
    told("time of the cut contours per branch end", 1000.0 * seconds / count, 50.0, "ms CPU")

    start = time.process_time()
    solids = {name: cut_solid.plate_solids(own.plates) for name, own in plates.items()}
    spent = time.process_time() - start
    told("time of all solids", spent, 30.0, "s CPU")
    told(
        "solids that are not sound", sum(not ok for own in solids.values() for _, ok in own), 0, ""
    )
    volume = max(
        abs(solid.Volume / item.plate.net_volume - 1.0)
        for name, own in plates.items()
        for item, (solid, _) in zip(own.plates, solids[name], strict=True)
        if item.plate.is_cut
    )
    told("volume of cut solids, kernel against quadrature", volume, 1e-5, "")
    checked = [
        (item, solid)
        for name, own in plates.items()
        for item, (solid, _) in zip(own.plates, solids[name], strict=True)
        if item.plate.is_cut
    ][:: max(1, sum(len(n.branches) for n in found.nodes) * 8 // SOLIDS_CHECKED)]
    worst = 0.0
    for item, solid in checked:
        raw = brep.tube_solids([[(p.knots, p.poles) for p in item.skin]])[0]
        other = cut_solid.cut_plate(raw, item.plate)
        worst = max(worst, abs(solid.Volume / other.Volume - 1.0))
    told(f"volume against the kernel's boolean, {len(checked)} plates", worst, 1e-5, "")

    measured = []
    for node in found.nodes:
        through = pairs_of(plates[node.through].plates, solids[node.through])
        for branch in node.branches:
            own = plates[branch.member].plates
            ended = [(item, end) for item, end, _ in ends_of(own, node.name)]
            here = [(item.plate, solids[branch.member][own.index(item)][0]) for item, _ in ended]
            measured += corners(node, branch, through, here, [end for _, end in ended])
    if "--steps" in arguments:
        for corner in measured:
            print(corner.line())
    told("corners of flanges in line", len(measured), 1, "", least=True)
    off = [abs(c.told[0] - c.measured[0]) for c in measured]
    turned = [abs(c.told[1] - c.measured[1]) for c in measured]
    told("steps, program against solids", max(off), 0.01, "mm")
    # The kernel has the flange's normal at the flange's edge, a web's thickness from the corner.
    told("angles, program against solids", float(np.degrees(max(turned))), 0.02, "deg")
    told("largest step measured", max(abs(c.measured[0]) for c in measured), 2.7, "mm")

    worst, pairs = 0.0, 0
    for node in found.nodes[:: max(1, len(found.nodes) // NODES_CHECKED)]:
        flats = [flat_solid(f) for f in plates[node.through].flat]
        through = [*(s for s, _ in solids[node.through]), *flats]
        for branch in node.branches:
            own = plates[branch.member].plates
            for item, _, _ in ends_of(own, node.name):
                end = solids[branch.member][own.index(item)][0]
                for other in through:
                    if end.BoundBox.intersect(other.BoundBox):
                        pairs += 1
                        worst = max(worst, end.common(other).Volume)
    told(f"largest overlap of solids, {pairs} pairs", worst, 1e-3, "mm3")
    if build:
        start_qt()
        with tempfile.TemporaryDirectory() as folder:
            start = time.perf_counter()
            result = project.build(path, folder, workers=2)
            told("whole hall built on 2 workers", time.perf_counter() - start, 120.0, "s")
            told("members in error", sum(not r.plates for r in result.records), 0, "")
    return 1 if _missed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
