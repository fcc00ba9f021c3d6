# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random members by the hundred: nothing overlaps, is mis-paired, refused, or loses volume.

Run: python3 benchmarks/members_at_random.py [members, 300 when left out] [file to go on from]

Then members drawn far beyond what is built, as many as asked for: valid solids, or a finding that
names what is wrong. Their outcomes are kept in the file, if one is named, so that a run that was
stopped goes on where it was. More than 300: only these.

The peer is FreeCAD's loft through the same corners. The table goes on that of members.py.
"""

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import json
import multiprocessing
import sys
import tempfile
import time
from collections import Counter
from dataclasses import asdict
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from BendTorsionWB import freecad_path  # noqa: E402

freecad_path.append()

import FreeCAD  # noqa: E402, F401  (Part needs it loaded first)
import Part  # noqa: E402
from members import lofted, print_table, row  # noqa: E402
from random_members import random_member  # noqa: E402
from random_outcomes import Outcome, outcome  # noqa: E402
from section_cuts import penetration, sections_at  # noqa: E402

from BendTorsionWB.core.members.volume import skin_volumes  # noqa: E402
from BendTorsionWB.core.plates.plates import split_plates  # noqa: E402
from BendTorsionWB.core.solids import solid_skins  # noqa: E402
from BendTorsionWB.shapes import brep  # noqa: E402


def thickness_changes(count):
    print(f"\n{count} random members with thickness changes per face: plates kept apart")
    deepest, flush, told = -np.inf, 0.0, 0
    for seed in range(count):
        built = random_member(seed, changes=True)
        if any(finding.code == "transition-short" for finding in built.law.findings):
            told += 1
            continue
        plates, _ = split_plates(built, {})
        law = built.law
        places = {p for c in law.changes for p in (c.place, *c.chamfer)} | set(law.folds)
        offsets = (-30.0, -10.0, -3.0, -0.5, 0.5, 3.0, 10.0, 30.0)
        s = np.array(sorted(p + d for p in places for d in offsets))
        s = s[(s > 0.0) & (s < built.length)]
        deepest = max([deepest, *map(penetration, sections_at(built, plates, s))])
        for one, two in zip(plates[:-1], plates[1:], strict=True):
            if one.face == two.face and (one.chamfers[1] or two.chamfers[0]):
                meets = one.rails.inner(one.end) - two.rails.inner(two.start)
                flush = max(flush, np.abs(meets).max())
    print(f"  overlap at most {max(0.0, deepest):.1e} mm; inner faces meet to {flush:.1e} mm")
    print(f"  left out, warned of a transition shorter than twice its plates: {told}")
    row(
        f"overlap of plates, {count} members with thickness changes, mm", "0", max(0.0, deepest), []
    )
    row("inner faces flush at thickness joints, mm", "flush", flush, [])


def random_members(count):
    print(f"\n{count} random members: boxes, I, channels, trapezoids; linear and smooth")
    worst, mispaired, refused, plates_built, invalid, lofts, lofts_wrong = 0.0, 0, 0, 0, 0, 0, 0
    worst_step = 0.0
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "plates.step")
        for seed in range(count):
            built = random_member(seed)
            for tube in solid_skins.corner_tubes(built):
                for piece in tube:
                    s = np.linspace(piece.knots[0], piece.knots[-1], 17)[1:-1]
                    exact = built.corners(0.0, built.length)(s).reshape(len(s), -1, 3)
                    mispaired += np.linalg.norm(piece.at(s) - exact, axis=2).max() > 1.0
            plates, _ = split_plates(built, {})
            skins = solid_skins.plate_skins(plates)
            solids = brep.tube_solids([[(p.knots, p.poles) for p in one] for one in skins])
            for plate, volume, solid in zip(plates, skin_volumes(skins), solids, strict=True):
                plates_built += 1
                miss = abs(volume / plate.volume - 1)
                worst = max(worst, miss)
                refused += miss > 1e-6 or not solid.isValid() or not solid.isClosed()
            if seed % 10 == 0:
                Part.Compound(solids).exportStep(path)
                back = Part.Shape()
                back.read(path)
                invalid += len(back.Solids) != len(solids) or not all(
                    solid.isValid() for solid in back.Solids
                )
                worst_step = max(worst_step, abs(back.Volume / Part.Compound(solids).Volume - 1))
            draw = np.random.default_rng(seed)
            stations = np.linspace(plates[0].start, plates[0].end, int(draw.integers(5, 26)))
            rails = [
                group(stations).reshape(-1, 2, 3)
                for group in (plates[0].rails.outer, plates[0].rails.inner)
            ]
            rings = np.concatenate([rails[0], rails[1][:, ::-1]], axis=1)
            corner_rings = built.corners(0.0, built.length)(stations).reshape(len(stations), -1, 3)
            for ring in (rings, corner_rings) if corner_rings.shape[1] == 4 else (rings,):
                lofts += 1
                loft = lofted(ring, False)
                exact = sum(_prism(ring[k], ring[k + 1]) for k in range(len(ring) - 1))
                lofts_wrong += abs(loft.Volume / exact - 1) > 0.05
    print(
        f"  ours: {mispaired} mis-paired corners; {plates_built} plates, {refused} refused, "
        f"volume to {worst:.1e}; after STEP {invalid} invalid, volume to {worst_step:.1e}"
    )
    print(f"  makeLoft smooth of the same corners: {lofts_wrong} of {lofts} wrong by more than 5 %")
    peer = f"makeLoft smooth wrong in {lofts_wrong} of {lofts}"
    row(f"mis-paired corners, {count} random members", "0", mispaired, [peer])
    row(f"volume of {plates_built} plates against ∫, relative", "1e-6", worst, [], 1e-16)
    row("plates refused, or invalid after STEP", "0", refused + invalid, [])


def _prism(one, other):
    """Volume between two rings (m, 3), near enough to tell a wrong pairing."""
    middle = 0.5 * (one + other)
    area = 0.5 * np.cross(middle, np.roll(middle, -1, axis=0)).sum(axis=0)
    return abs(area @ (other.mean(axis=0) - one.mean(axis=0)))


def outcomes(count, kept=None):
    """Print the table of what became of `count` members; how many nobody can explain."""
    known = {}
    if kept is not None and kept.exists():
        lines = kept.read_text(encoding="utf-8").split("\n")[:-1]
        known = {found["seed"]: Outcome(**found) for found in map(json.loads, lines)}
    seeds = [seed for seed in range(count) if seed not in known]
    start = time.time()
    workers = min(2, os.cpu_count() or 1)
    with multiprocessing.get_context("fork").Pool(workers, maxtasksperchild=500) as pool:
        for found in pool.imap_unordered(outcome, seeds, chunksize=20):
            known[found.seed] = found
            if kept is not None:
                with open(kept, "a", encoding="utf-8") as stream:
                    stream.write(json.dumps(asdict(found)) + "\n")
    all_found = [known[seed] for seed in range(count)]
    kinds = Counter(found.kind for found in all_found)
    print(f"\n{count} members far beyond what is built, {time.time() - start:.0f} s")
    for kind, number in kinds.most_common():
        print(f"  {kind:<32}{number:>7}{100.0 * number / count:>8.2f} %")
    print(f"  plates made: {sum(found.plates for found in all_found)}")
    unexplained = [found for found in all_found if found.unexplained]
    for found in unexplained[:50]:
        print(f"  seed {found.seed}: {found.text}")
    row(f"outcomes without an explanation, {count} members", "0", len(unexplained), [])
    return len(unexplained)


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 300
    kept = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    if count <= 300:
        thickness_changes(count // 5)
        random_members(count)
    outcomes(count, kept)
    print_table()


if __name__ == "__main__":
    main()
