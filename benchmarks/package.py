# SPDX-License-Identifier: LGPL-2.1-or-later
"""The whole fabrication package of the concert hall: time on two cores, time per plate, points.

Run: python3 benchmarks/package.py. Limits: 90 s beyond the model build; 20 ms per plate for DXF and
NC1 together; a tenth of the points that chords of equal accuracy need.
"""

import json
import os
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]
os.environ.setdefault("QT_HASH_SEED", "0")

from BendTorsionWB import freecad_path  # noqa: E402

freecad_path.append()

import numpy as np  # noqa: E402

from BendTorsionWB import project  # noqa: E402
from BendTorsionWB.core.drawings.sheet_pattern import simplified  # noqa: E402
from BendTorsionWB.core.geometry.arc_fit import FIT_TOLERANCE, deviation, fit_outline  # noqa: E402
from BendTorsionWB.exchange.dxf import plate_dxf  # noqa: E402
from BendTorsionWB.exchange.nc1 import plate_nc1  # noqa: E402
from BendTorsionWB.sheets.pdf import start_qt  # noqa: E402

HALL = ROOT / "resources" / "examples" / "concert_hall" / "concert_hall.xlsx"
MODEL_STAGES = {"read", "members", "clashes", "document", "save"}
"""What a build takes without any of the files."""


def row(what, measured, limit, unit):
    mark = "ok" if measured <= limit else "OVER"
    print(f"{what:<52}{measured:>10.3g} {unit:<4} limit {limit:g} {mark}", flush=True)
    return measured <= limit


def chords(outline, tolerance):
    """Points of the fewest-chord polyline within a tolerance, run by run."""
    return sum(len(simplified(run, tolerance)) - 1 for run in outline)


def main():
    start_qt()
    good = True
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder)
        result = project.build(HALL, out, workers=2)
        stages = json.loads((out / "timing.json").read_text(encoding="utf-8"))
        beyond = sum(s for name, s in stages.items() if name not in MODEL_STAGES | {"total"})
        print(", ".join(f"{name} {spent:.1f}" for name, spent in stages.items()))
        good &= row("files beyond the model build, 2 workers", beyond, 90.0, "s")
    plates = [plate for record in result.records for plate in record.plates]
    start = time.process_time()
    for plate in plates:
        plate_dxf(plate)
        plate_nc1(plate)
    spent = 1e3 * (time.process_time() - start) / len(plates)
    good &= row(f"DXF and NC1 of a plate, mean of {len(plates)}", spent, 20.0, "ms")
    fitted = chorded = 0
    worst = 0.0
    for plate in plates:
        arcs = fit_outline(plate.outline)
        fitted += len(arcs)
        ring = np.concatenate([arcs, arcs[:1]])
        own = max(float(deviation(ring, run).max()) for run in plate.outline)
        worst = max(worst, own)
        # Chords that would be as near to the pattern as these arcs are.
        chorded += chords(plate.outline, max(own, 1e-4))
    good &= row("distance of the contours from the patterns", worst, FIT_TOLERANCE, "mm")
    good &= row("points of arcs over points of equal chords", fitted / chorded, 0.1, "")
    print(f"{fitted} points, {chorded} with chords")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
