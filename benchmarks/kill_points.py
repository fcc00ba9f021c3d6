# SPDX-License-Identifier: LGPL-2.1-or-later
"""The program killed at its writes, one by one: what is there afterwards, and whether it goes on.

Run: python3 benchmarks/kill_points.py [points, 500 when left out] [file to go on from]

A small project is built, built again after a change, updated, exported, written back as a schedule,
issued and reported in child processes that die at their n-th write, rename, removal or change of
mode, before it or in the middle. After each every file must be as it was before or as it would be
after, to the byte, and the same command run again must give the folder of an undisturbed run. What
was found is kept in the file, if one is named, so that a run that was stopped goes on where it was,
unless the program has changed since.
"""

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import json
import shutil
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from BendTorsionWB import freecad_path  # noqa: E402

freecad_path.append()

from kill_scenarios import scenarios, tried  # noqa: E402

from BendTorsionWB.exchange.result_cache import program_key  # noqa: E402


def found_at(one, place, known, kept):
    """What `tried` says of a scenario killed at a place, or said in an earlier run of this one."""
    key = (program_key(), one.name, one.points, place)
    if key not in known:
        known[key] = tried(one, place)
        if kept is not None:
            with open(kept, "a", encoding="utf-8") as stream:
                stream.write(json.dumps([*key, *known[key]]) + "\n")
    return known[key]


def main():
    wanted = int(sys.argv[1]) if len(sys.argv) > 1 else 500
    kept = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    lines = (
        kept.read_text(encoding="utf-8").splitlines() if kept is not None and kept.exists() else []
    )
    known = {tuple(key): (lost, stuck) for *key, lost, stuck in map(json.loads, lines)}
    start = time.time()
    # Known before the first fork: sources edited meanwhile would be another program's cache.
    program_key()
    with tempfile.TemporaryDirectory() as folder:
        every = scenarios(Path(folder))
        total = sum(one.points for one in every)
        print(f"{'scenario':<34}{'writes':>8}{'killed':>8}{'lost':>6}{'stuck':>7}")
        killed = lost = stuck = 0
        for one in every:
            share = min(one.points, max(6, round(wanted * one.points / total)))
            places = sorted({round(k * one.points / share) for k in range(1, share + 1)})
            found = [found_at(one, place, known, kept) for place in places]
            bad = [text for text, _ in found if text]
            halted = [text for _, text in found if text]
            print(
                f"{one.name:<34}{one.points:>8}{len(places):>8}{len(bad):>6}{len(halted):>7}",
                flush=True,
            )
            for text in bad + halted:
                print(f"    {text}")
            killed, lost, stuck = killed + len(places), lost + len(bad), stuck + len(halted)
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder, exist_ok=True)
    print(f"{killed} kill points: {lost} with a loss, {stuck} after which the next run fails")
    print(f"{time.time() - start:.0f} s")
    return 1 if lost or stuck else 0


if __name__ == "__main__":
    sys.exit(main())
