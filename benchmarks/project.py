# SPDX-License-Identifier: LGPL-2.1-or-later
"""A building of many members: the concert hall's ribs again and again on one ellipsoid.

Run: python3 benchmarks/project.py [--keep FOLDER] [COUNT …] (10 50 without; 200 and 1000 on a quiet
machine). --keep: leaves the split model of each count in FOLDER/COUNT, to be opened.
Prints for each count what takes the time, the peak memory and the sizes of files, then the figures
beside their limits: everything but drawing sheets on two workers, core time per member and core,
two workers against one, growth with the count, and the second build, of a split model, with one
member changed.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("QT_HASH_SEED", "0")

import math
import multiprocessing
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "resources" / "examples" / "concert_hall")]

from BendTorsionWB import freecad_path  # noqa: E402

freecad_path.append()

import FreeCAD  # noqa: E402
import make_concert_hall as hall  # noqa: E402
import numpy as np  # noqa: E402
import openpyxl  # noqa: E402

from BendTorsionWB import project  # noqa: E402
from BendTorsionWB.core import memo  # noqa: E402
from BendTorsionWB.core.collection import leave_to_the_end  # noqa: E402
from BendTorsionWB.core.worker_processes import Workers  # noqa: E402
from BendTorsionWB.exchange.schedule_writer import write_schedule  # noqa: E402
from BendTorsionWB.project import Wanted  # noqa: E402

SPLIT = 10
ROUNDS = 5
"""Of one process and two in turn, of which the medians count: processors change their speed."""
PLATES_PER_MEMBER = 20
JOINTS = {"left": "0.2 0.4 0.6 0.8 1", "right": "0.15 0.35 0.45 0.75 1"}
JOINTS |= {"top": "0.1 0.3 0.55 0.85 1", "bottom": "0.25 0.5 0.65 0.9 1"}


def rib(number: int, count: int) -> np.ndarray:
    """(9, 3) mm: points of a rib on an ellipsoid that grows with the count, so that ribs keep their
    distance: sections by planes that turn and lean along a spiral of places."""
    columns = max(1, round(math.sqrt(count / 4.0)))
    row, column = divmod(number, columns)
    scale = np.array(hall.HALF_AXES) * max(1.0, math.sqrt(count / 16.0))
    # Places on the sphere: azimuth by column, height by row; each rib climbs a tenth of a quarter.
    rows = math.ceil(count / columns)
    azimuth = np.linspace(0.0, 0.12, 9) + 2.0 * math.pi * (row + 0.5) / max(rows, 1)
    low = 0.15 + 1.15 * column / columns
    height = low + np.linspace(0.0, 0.8 * 1.15 / columns, 9) ** 1.02
    sphere = np.column_stack(
        [np.cos(height) * np.cos(azimuth), np.cos(height) * np.sin(azimuth), np.sin(height)]
    )
    points = sphere * scale
    # Each rib as long as one of the hall's.
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    wanted = min(hall.SHAPES[number % len(hall.SHAPES)][0], 0.95 * arc[-1])
    places = np.linspace(0.0, wanted, 9)
    fine = np.array([np.interp(places, arc, axis) for axis in points.T]).T
    unit = fine / scale
    return np.round(unit / np.linalg.norm(unit, axis=1, keepdims=True) * scale, 3)


def write_building(path: Path, count: int) -> None:
    """The schedule of so many ribs."""
    scale = max(1.0, math.sqrt(count / 16.0))
    a, b, c = (f"{half * scale!r}" for half in hall.HALF_AXES)
    rows = {"Points": [], "Axes": [], "Members": [], "Splits": []}
    for number in range(count):
        name, axis = f"M{number + 1}", f"A{number + 1}"
        points = rib(number, count).tolist()
        rows["Points"] += [[axis, n, *point] for n, point in enumerate(points, start=1)]
        rows["Axes"].append([axis, "Hall"])
        kind = "12"[number % 2]
        rows["Members"].append([name, 1, axis, f"B800-{kind}", None, None])
        rows["Members"].append([name, 2, None, f"B600-{kind}", "45%", 4])
        rows["Splits"] += [[name, face, text] for face, text in JOINTS.items()]
    write_schedule(
        {
            "Settings": [["key", "value"], ["project", f"{count} ribs"]],
            "Surfaces": [
                ["surface", "kind", "parameters"],
                ["Hall", "ellipsoid", f"a={a} b={b} c={c}"],
            ],
            "Points": [["axis", "no", "x", "y", "z"], *rows["Points"]],
            "Axes": [["axis", "surface"], *rows["Axes"]],
            "Sections": [
                ["section", "type", "h", "b", "t"],
                *([f"B{h}-{k}", f"box{k}", h, h, 16] for h in (800, 600) for k in (1, 2)),
            ],
            "Members": [["member", "segment", "axis", "section", "cut", "slope"], *rows["Members"]],
            "Splits": [["member", "face", "joints"], *rows["Splits"]],
        },
        path,
    )


def measured(*arguments) -> dict:
    """What a process of its own tells: `--build`, of seconds, stages, peak memory of it and its
    workers; `--core`."""
    start = time.perf_counter()
    done = subprocess.run(
        [sys.executable, __file__, *map(str, arguments)],
        capture_output=True,
        encoding="utf-8",
        cwd=ROOT,
    )
    if done.returncode:
        raise SystemExit(done.stdout[-3000:] + done.stderr[-3000:])
    found = dict(line.split(" ", 1) for line in done.stdout.splitlines() if line.startswith("@"))
    return {name[1:]: float(value) for name, value in found.items()} | {
        "wall": time.perf_counter() - start
    }


def build(path: str, out: str, split: str) -> None:
    """What the measured process does."""
    result = project.build(path, out, workers=2, wanted=Wanted(sheets=False, split=int(split)))
    for stage, seconds in result.timing.items():
        print(f"@{stage} {seconds}")
    own, others = (
        resource.getrusage(who).ru_maxrss
        for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )
    # Two workers at most; each counts with the largest any of them had.
    print(f"@memory {(own + 2 * others) / 1e6}")
    print(f"@plates {sum(len(record.plates) for record in result.records)}")
    print(f"@failed {sum(not record.plates for record in result.records)}")
    # As the command line does.
    leave_to_the_end()


def size(out: Path, pattern: str) -> float:
    """MB of files."""
    return sum(path.stat().st_size for path in out.rglob(pattern)) / 1e6


def core(path: str, count: str) -> None:
    """What the measured process does: CPU seconds per member of 20 plates, and wall seconds of this
    process alone, of one worker and of two."""
    count = int(count)
    schedule, jobs = project.read_jobs(path, [f"M{n + 1}" for n in range(min(count, 48))])
    cpu, runs = [], {"alone": [], "one": [], "two": [], "apart": []}
    for _ in range(ROUNDS):
        memo.forget_all()
        used, start = time.process_time(), time.perf_counter()
        detailed = project.compute(schedule, jobs)
        runs["alone"].append(time.perf_counter() - start)
        cpu.append(time.process_time() - used)
        plates = sum(len(item.record.plates) for item in detailed.values())
        for name, count in (("one", 1), ("two", 2)):
            memo.forget_all()
            with Workers(count) as executor:
                # Started before the clock: a building starts them once.
                list(executor.map(abs, range(8)))
                start = time.perf_counter()
                project.compute(schedule, jobs, executor)
                runs[name].append(time.perf_counter() - start)
        memo.forget_all()
        runs["apart"].append(_apart(schedule, jobs))
    print(f"@each {statistics.median(cpu) / plates * PLATES_PER_MEMBER}")
    for name, seconds in runs.items():
        print(f"@{name} {statistics.median(seconds)}")


def _apart(schedule, jobs) -> float:
    """Seconds until two processes are done that compute half of the members each and share nothing,
    results neither: what two processors of this machine can do at best."""
    context = multiprocessing.get_context("fork")
    ready = context.Barrier(3)
    items = list(jobs.items())
    processes = [
        context.Process(target=_half, args=(schedule, dict(items[k::2]), ready)) for k in range(2)
    ]
    for process in processes:
        process.start()
    ready.wait()
    start = time.perf_counter()
    for process in processes:
        process.join()
    return time.perf_counter() - start


def _half(schedule, jobs, ready) -> None:
    ready.wait()
    project.compute(schedule, jobs)
    # Without the interpreter's own end.
    os._exit(0)


def row(what: str, value: float, limit: float | None = None, least: bool = False) -> None:
    """A figure beside its limit."""
    if limit is None:
        print(f"{what:<60}{value:>10.3g}")
        return
    good = value >= limit if least else value <= limit
    print(f"{what:<60}{value:>10.3g}{limit:>10g} {'ok' if good else 'OVER'}")


def main(counts: list[int], kept: Path | None = None) -> None:
    """Print the table of every count, then the figures. kept: where split models are left."""
    times = {}
    for count in counts:
        with tempfile.TemporaryDirectory() as folder:
            path, out = Path(folder) / "building.xlsx", Path(folder) / "out"
            write_building(path, count)
            print(f"== {count} members")
            first = measured("--build", path, out, 0)
            times[count] = first["wall"]
            stages = sorted(
                (k for k in first if k not in ("wall", "memory", "plates", "failed")),
                key=first.get,
                reverse=True,
            )
            print("   " + ", ".join(f"{name} {first[name]:.1f} s" for name in stages))
            row("plates", first["plates"])
            row("members that failed", first["failed"], 0)
            fits = 200 if count >= 200 else None
            row("everything but sheets, s", first["wall"], 120 if count == fits else None)
            row("peak memory, GB", first["memory"], 3 if count == fits else None)
            row("document, MB", size(out, "*.FCStd"))
            row("STEP, MB", size(out, "*.step"))
            row("cut files, MB", size(out, "*.dxf") + size(out, "*.nc1"))
            row("cache, MB", size(out / ".cache", "*"))
            apart = Path(folder) / "split" if kept is None else kept / str(count)
            row(f"split by {SPLIT}, s", measured("--build", path, apart, SPLIT)["wall"])
            changed = [[*line] for line in _sheet(path, "Members")]
            changed[2][4] = "48%"
            sheets = {name: _sheet(path, name) for name in _names(path)} | {"Members": changed}
            write_schedule(sheets, path)
            again = measured("--build", path, apart, SPLIT)
            row("split, one member changed, s", again["wall"], 10 if count == fits else None)
            opened = time.perf_counter()
            document = FreeCAD.openDocument(str(apart / "model.FCStd"), hidden=True)
            row("split model opened whole, s", time.perf_counter() - opened)
            row(
                "objects in all its documents",
                sum(len(d.Objects) for d in FreeCAD.listDocuments().values()),
            )
            del document
            for name in list(FreeCAD.listDocuments()):
                FreeCAD.closeDocument(name)
            if count == max(counts):
                alone = measured("--core", path, count)
                row("core, s per member of 20 plates and core", alone["each"], 0.12)
                row("two workers against one worker, times", alone["one"] / alone["two"], 1.7, True)
                row("two workers against no worker, times", alone["alone"] / alone["two"])
                row("two processes that share nothing, times", alone["alone"] / alone["apart"])
    if len(times) > 1:
        low, high = min(times), max(times)
        row("growth, exponent", math.log(times[high] / times[low]) / math.log(high / low), 1.1)


def _names(path: Path) -> list[str]:
    return openpyxl.load_workbook(path, read_only=True).sheetnames


def _sheet(path: Path, name: str) -> list[list]:
    return [list(row) for row in openpyxl.load_workbook(path)[name].values]


if __name__ == "__main__":
    if sys.argv[1:2] == ["--build"]:
        build(*sys.argv[2:])
    elif sys.argv[1:2] == ["--core"]:
        core(*sys.argv[2:])
    else:
        given = sys.argv[1:]
        folder = Path(given[1]) if given[:1] == ["--keep"] else None
        main([int(text) for text in given[2 if folder else 0 :]] or [10, 50], folder)
