# SPDX-License-Identifier: LGPL-2.1-or-later
"""The test suite under other releases of FreeCAD and other libraries, each in a lane of its own.

`/usr/bin/python3 scripts/lanes.py` runs every lane in turn, each with as many workers as `make
test`, while the next ones are made; names choose some, and what stands after `--` goes to pytest
instead of the workers. A lane is a release of Debian with its FreeCAD, which needs root, or other
libraries without FreeCAD, for the tests that need none (lane_places.py). On a machine that is such
a release itself `make test` is that lane, and its tests are not run twice. docs/versions.md says
what runs where.

What the tests of a lane say goes to build/lanes/<lane>-tests.log. What fails beside other tests is
run again one after another, and told: sessions in FreeCAD's window have limits by the clock. A
lane that cannot be made here, or is not done in --minutes for all, is named as not run. Exit code:
1 when a test failed in a lane, and failed again.
"""

from __future__ import annotations

import argparse
import fcntl
import math
import os
import shlex
import shutil
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from lane_places import (
    LANES,
    ROOT,
    Libraries,
    NotHere,
    OutOfTime,
    Place,
    Suite,
    copy_checkout,
    inside,
    make_libraries,
    make_suite,
    place_of,
    run,
)

TESTS_FAILED = 1
"""Exit code of pytest; others tell that it could not run."""
AGAIN = ["--last-failed", "--last-failed-no-failures", "none"]
"""What failed, and nothing where pytest could not write down what."""
WORKERS = ["-n", str((os.cpu_count() or 1) + 2), "--dist", "loadfile"]
"""As `make test` has them: sessions in FreeCAD's window wait for it to settle."""
LAST = 60
"""Lines told of tests that could not be run."""
SUITES = (Suite("bookworm", "0.20"), Suite("trixie", "1.0"), Suite("forky", "1.1"))
"""Oldest first: what one saves the next ones open."""
VENVS = (
    Libraries("python3.11", "3.11", ("numpy>=2", "ezdxf>=1.4", "openpyxl>=3.1")),
    Libraries("python3.12", "3.12", ("numpy==1.26.*", "ezdxf==1.1.*", "openpyxl==3.0.*")),
)
"""Between and beyond what the suites of Debian bring together."""


def run_suite(suite: Suite, place: Place, arguments: list[str], until: float) -> tuple[int, str]:
    """Run the suite's tests and save a document there; 0 when all is well, and what is to be told.
    Raises OutOfTime."""
    with _alone(suite.name):
        return _run_suite(suite, place, arguments, until)


def _run_suite(suite: Suite, place: Place, arguments: list[str], until: float) -> tuple[int, str]:
    if place.root != Path("/"):
        copy_checkout(place.folder)
    code, told = 0, ""
    if arguments or place.root != Path("/"):
        # On the machine itself `make test` has run the suite.
        code, told = _tested(
            suite.name,
            lambda given, stream: inside(
                place, f"/usr/bin/python3 -m pytest -q {shlex.join(given)}", until, stream
            ),
            arguments,
        )
    command = f"/usr/bin/python3 tests/carried_document.py save build/carried/{suite.name}"
    return inside(place, command, until) or code, told


def _tested(
    name: str, pytest: Callable[[list[str], IO | None], int], arguments: list[str]
) -> tuple[int, str]:
    """Exit code of pytest, called with what it is given and where it says what it does, and whether
    some tests passed only alone."""
    if arguments:
        return pytest(arguments, None), ""
    log = LANES / f"{name}-tests.log"
    with open(log, "w", encoding="utf-8") as stream:
        code = pytest(WORKERS, stream)
    if code != TESTS_FAILED:
        said = log.read_text(encoding="utf-8", errors="replace").splitlines()
        print("\n".join(said[-LAST if code else -1 :]), flush=True)
        return code, ""
    print("== what failed, again one after another", flush=True)
    seen = f": build/lanes/{log.name}"
    try:
        code = pytest(AGAIN, None)
    except OutOfTime:
        return code, f", without the time to run again what failed{seen}"
    return code, seen if code else f", some tests only when run again alone{seen}"


@contextmanager
def _alone(name: str):
    """Hold a lane: a second run would take the checkout away from below the first."""
    LANES.mkdir(parents=True, exist_ok=True)
    with open(LANES / f"{name}.lock", "w", encoding="utf-8") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        yield


def compare_carried(suites: Sequence[Suite], until: float) -> list[int]:
    """Open in each lane what the older ones saved, and compare the figures: exit codes. Raises
    OutOfTime."""
    codes, older = [], []
    for suite in (item for item in SUITES if item in suites):
        place = place_of(suite)
        own = place.folder / "build" / "carried" / suite.name
        if not own.is_dir():
            # It was not run whole.
            continue
        for former in older:
            target = own.with_name(former.name)
            if target != former:
                shutil.rmtree(target, ignore_errors=True)
                shutil.copytree(former, target)
            print(f"== {former.name} opened in {suite.name}", flush=True)
            command = "/usr/bin/python3 tests/carried_document.py compare"
            codes.append(inside(place, f"{command} build/carried/{former.name}", until))
        older.append(own)
    return codes


def run_libraries(python: Path, arguments: list[str], until: float) -> tuple[int, str]:
    """Run the tests that need no FreeCAD with other libraries; 0 when all is well, and what is to
    be told. Raises OutOfTime."""
    environment = os.environ | {"BENDTORSION_WITHOUT_FREECAD": "1"}
    # What failed in other lanes, or in this checkout's own tests, is not run again here.
    cache = python.parent.parent / "cache"
    shutil.rmtree(cache, ignore_errors=True)
    command = [str(python), "-m", "pytest", "-q", "-o", f"cache_dir={cache}"]
    return _tested(
        python.parent.parent.name,
        lambda given, stream: (
            run(
                [*command, *given], until, cwd=ROOT, env=environment, stdout=stream, stderr=stream
            ).returncode
        ),
        arguments,
    )


def main() -> int:
    names = {lane.name: lane for lane in (*SUITES, *VENVS)}
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("lanes", nargs="*", metavar="LANE", help=", ".join(names))
    parser.add_argument("--make", action="store_true", help="make the chroots, run nothing")
    given = sys.argv[1:]
    arguments = given[given.index("--") + 1 :] if "--" in given else []
    parser.add_argument(
        "--minutes", type=float, default=math.inf, help="for all lanes; none: no end"
    )
    chosen = parser.parse_args(given[: given.index("--")] if "--" in given else given)
    unknown = [name for name in chosen.lanes if name not in names]
    if unknown:
        parser.error(f"no such lane: {', '.join(unknown)}; there are {', '.join(names)}")
    lanes = [names[name] for name in chosen.lanes or names]
    # Those of libraries are made in seconds: while they run, the suites are.
    lanes.sort(key=lambda lane: isinstance(lane, Suite))
    start = time.monotonic()
    until = start + chosen.minutes * 60
    with ThreadPoolExecutor(1) as maker:
        made = [maker.submit(make, lane, until) for lane in lanes]
        results = [
            run_lane(lane, one, arguments, chosen.make, until)
            for lane, one in zip(lanes, made, strict=True)
        ]
    codes = [code for code, _ in results]
    if not chosen.make:
        there = [lane for lane, one in zip(lanes, made, strict=True) if not one.exception()]
        try:
            codes += compare_carried([lane for lane in there if isinstance(lane, Suite)], until)
        except OutOfTime:
            results.append((0, "saved documents: not all opened: the time for all was over"))
    used = os.times()
    processor = (used.children_user + used.children_system) / 60
    total = f"all, made and run: {_minutes_since(start)}, {processor:.1f} min of processor"
    print("\n".join(["== lanes", *(line for _, line in results), total]), flush=True)
    return 1 if any(codes) else 0


def make(lane: Suite | Libraries, until: float) -> Place | Path:
    """Where a lane runs. Raises NotHere and OutOfTime."""
    return make_suite(lane, until) if isinstance(lane, Suite) else make_libraries(lane, until)


def run_lane(
    lane: Suite | Libraries, made: Future, arguments: list[str], only_make: bool, until: float
) -> tuple[int, str]:
    """Run a lane once it is made; its exit code, and a line on how it went."""
    try:
        place = made.result()
        if only_make:
            return 0, f"{lane.name}: made"
        print(f"== {lane.name}", flush=True)
        start = time.monotonic()
        if isinstance(lane, Suite):
            code, told = run_suite(lane, place, arguments, until)
        else:
            code, told = run_libraries(place, arguments, until)
    except NotHere as reason:
        return 0, f"{lane.name}: not run: {reason}"
    except OutOfTime:
        return 0, f"{lane.name}: not run whole: the time for all lanes was over"
    return code, f"{lane.name}: {'FAILED' if code else 'passed'} in {_minutes_since(start)}{told}"


def _minutes_since(start: float) -> str:
    return f"{(time.monotonic() - start) / 60:.1f} min"


if __name__ == "__main__":
    sys.exit(main())
