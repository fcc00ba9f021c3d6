# SPDX-License-Identifier: LGPL-2.1-or-later
"""Builds whose workers are killed, as a script: `killed_workers.py FOLDER STAGE:DELAY:COUNT...`.

Each build is a child of its own, and so is the one undisturbed that it is compared with: a process
that forks must not have used Open CASCADE's threads. Of each build one line of JSON: how it ended,
and which files are not those of the undisturbed one.
"""

import json
import os
import shutil
import signal
import sys
import threading
import time
from contextlib import contextmanager
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
    from BendTorsionWB import freecad_path

    freecad_path.append()

from test_build import APART, schedule

from BendTorsionWB import project
from BendTorsionWB.core import parallel
from BendTorsionWB.sheets.pdf import start_qt

LIMIT = 90
"""Seconds; undisturbed it takes 5."""
TOLD = ("timing.json", ".cache/", ".bendtorsion.json")
"""Not the same in any two builds, or of them."""


def build(path, out, stage="", delay=0.0, count=0):
    """Build; when a stage begins, and a delay later, as many workers are killed at once."""
    pools, killed = [], []

    class Watched(parallel.Workers):
        """Known to the test."""

        def __init__(self, *given):
            super().__init__(*given)
            pools.append(self)

    def kill():
        time.sleep(delay)
        for pid in pools[0].processes[:count]:
            os.kill(pid, signal.SIGKILL)
            killed.append(pid)

    @contextmanager
    def at_stage(timing, name, plain=project.Timing.stage, left=[stage]):  # noqa: B006
        if name in left and pools:
            left.remove(name)
            threading.Thread(target=kill).start()
        with plain(timing, name):
            yield

    parallel.Workers, project.Timing.stage = Watched, at_stage
    result = project.build(path, out, workers=2)
    if len(killed) != count:
        raise LookupError(f"{len(killed)} workers were killed, not {count}")
    return result


def in_child(work, *given) -> str:
    """How a child that does some work ended: "", its error, or "hangs"."""
    pid = os.fork()
    if pid == 0:
        code = 1
        try:
            code = int(work(*given).failed)
        except BaseException as failure:  # noqa: BLE001 - told by its code
            print(repr(failure), file=sys.stderr)
        finally:
            os._exit(code)
    end = time.monotonic() + LIMIT
    while time.monotonic() < end:
        done, status = os.waitpid(pid, os.WNOHANG)
        if done:
            return f"ended with {status}" if status else ""
        time.sleep(0.05)
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    return "hangs"


def contents(out):
    """{name: bytes} of the files of a folder."""
    names = {str(p.relative_to(out)): p for p in out.rglob("*") if p.is_file()}
    return {n: p.read_bytes() for n, p in names.items() if not n.startswith(TOLD)}


def main(folder, *kills):
    """Print a line for each kill."""
    start_qt()
    folder = Path(folder)
    path = schedule(folder / "two.xlsx", APART)
    plain, issued = folder / "plain", folder / "issued"
    print(json.dumps(["", in_child(build, path, plain), []]), flush=True)
    shutil.copytree(plain, issued)
    project.issue_folder(issued, "A")
    in_child(build, path, issued)
    for kill in kills:
        stage, delay, count = kill.split(":")
        like, out = (issued if stage == "revision" else plain), folder / kill.replace(":", "_")
        if like is issued:
            shutil.copytree(issued, out)
        ended = in_child(build, path, out, stage, float(delay), int(count))
        own, other = contents(out), contents(like)
        changed = [n for n in {**own, **other} if own.get(n) != other.get(n)]
        print(json.dumps([kill, ended, changed]), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
