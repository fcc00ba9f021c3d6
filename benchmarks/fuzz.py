# SPDX-License-Identifier: LGPL-2.1-or-later
"""Damaged and hostile files for a number of minutes: what became of each kind.

Run: python3 benchmarks/fuzz.py [minutes, 1 when left out] [first seed, 0 when left out]

Workbooks, CSV folders, DXF and STEP files are damaged by seed and read, schedules built, each in a
process of its own. Named are crashes, hangs (100 s), faults that are no findings, and files written
outside the output folder.
"""

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from BendTorsionWB import freecad_path  # noqa: E402

freecad_path.append()

import FreeCAD  # noqa: E402, F401  (Part needs it loaded first)
from fuzzed_input import KINDS, Seeds, tried  # noqa: E402


def main():
    minutes = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    end, cases = time.monotonic() + 60.0 * minutes, []
    with tempfile.TemporaryDirectory() as folder:
        seeds = Seeds(Path(folder))
        while time.monotonic() < end:
            for kind in KINDS:
                with tempfile.TemporaryDirectory() as own:
                    found = tried(kind, seed, seeds, Path(own))
                cases.append(found)
                if found.bad:
                    print(f"  {kind} seed {seed}: {found.end}: {found.text}", flush=True)
            seed += 1
    print(f"{'input':<12}{'cases':>7}{'read':>7}{'refused':>9}{'bad':>5}{'slowest s':>11}{'MB':>6}")
    for kind in KINDS:
        own = [case for case in cases if case.kind == kind]
        ends = Counter("bad" if c.bad else "read" if c.end == "read" else "refused" for c in own)
        slowest, largest = max(c.seconds for c in own), max(c.memory for c in own)
        print(
            f"{kind:<12}{len(own):>7}{ends['read']:>7}{ends['refused']:>9}{ends['bad']:>5}"
            f"{slowest:>11.1f}{largest / 1e6:>6.0f}"
        )
    codes = Counter(case.end for case in cases)
    print("findings: " + ", ".join(f"{code} {count}" for code, count in codes.most_common(25)))
    bad = sum(case.bad for case in cases)
    print(f"{len(cases)} cases in {minutes:g} minutes, {bad} bad; next seed {seed}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
