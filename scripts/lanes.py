# SPDX-License-Identifier: LGPL-2.1-or-later
"""The test suite under other releases of FreeCAD and other libraries, each in a lane of its own.

`/usr/bin/python3 scripts/lanes.py` runs every lane in turn, each with as many workers as `make
test`, while the next ones are made; names choose some, and what stands after `--` goes to pytest
instead of the workers. A lane of FreeCAD is a Debian suite in build/lanes/<suite>, made by
debootstrap with the packages scripts/install-debian.sh asks for; it needs root. On a machine that
is such a suite itself `make test` is that lane, and its tests are not run twice. Mirrors, proxies
and checks are those of this machine's own apt. A lane of libraries is a venv without FreeCAD, for
the tests that need none. docs/versions.md says what runs where.

What fails beside other tests is run again one after another: sessions in FreeCAD's window have
limits by the clock. A lane that cannot be made here, or is not done in --minutes for all, is named
as not run. Exit code: 1 when a test failed in a lane, and failed again.
"""

from __future__ import annotations

import argparse
import fcntl
import math
import os
import platform
import shlex
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LANES = ROOT / "build" / "lanes"
INSTALL = ROOT / "scripts" / "install-debian.sh"
CHECKOUT = "checkout"
TESTS_FAILED = 1
"""Exit code of pytest; others tell that it could not run."""
AGAIN = ["--last-failed", "--last-failed-no-failures", "none"]
"""What failed, and nothing where pytest could not write down what."""
QUIET = {"stdin": subprocess.DEVNULL}
WORKERS = ["-n", str((os.cpu_count() or 1) + 2), "--dist", "loadfile"]
"""As `make test` has them: sessions in FreeCAD's window wait for it to settle."""
NEWEST_SCRIPT = Path("/usr/share/debootstrap/scripts/sid")


class NotHere(Exception):
    """Why a lane cannot be run on this machine."""


class OutOfTime(Exception):
    """The time for all lanes is over."""


@dataclass(frozen=True)
class Suite:
    """A release of Debian: its FreeCAD and its Python."""

    name: str
    freecad: str


@dataclass(frozen=True)
class Libraries:
    """A venv: the Python it needs, and what pip installs into it beside scipy."""

    name: str
    python: str
    packages: tuple[str, ...]


SUITES = (Suite("bookworm", "0.20"), Suite("trixie", "1.0"), Suite("forky", "1.1"))
"""Oldest first: what one saves the next ones open."""

VENVS = (
    Libraries("python3.11", "3.11", ("numpy>=2", "ezdxf>=1.4", "openpyxl>=3.1")),
    Libraries("python3.12", "3.12", ("numpy==1.26.*", "ezdxf==1.1.*", "openpyxl==3.0.*")),
)
"""Between and beyond what the suites of Debian bring together."""


@dataclass(frozen=True)
class Place:
    """Where a lane runs: its root, its checkout seen from outside, and from inside."""

    root: Path
    folder: Path
    inside: Path


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
            lambda given: _inside(
                place, f"/usr/bin/python3 -m pytest -q {shlex.join(given)}", until
            ),
            arguments,
        )
    command = f"/usr/bin/python3 tests/carried_document.py save build/carried/{suite.name}"
    return _inside(place, command, until) or code, told


def _tested(run: Callable[[list[str]], int], arguments: list[str]) -> tuple[int, str]:
    """Exit code of pytest, `run` with what it is given, and whether some passed only alone."""
    code = run(arguments or WORKERS)
    if code != TESTS_FAILED or arguments:
        return code, ""
    print("== what failed, again one after another", flush=True)
    try:
        return run(AGAIN), ", some tests only when run again alone"
    except OutOfTime:
        return code, ", without the time to run again what failed"


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
        place = _place(suite)
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
            codes.append(_inside(place, f"{command} build/carried/{former.name}", until))
        older.append(own)
    return codes


def _place(suite: Suite) -> Place:
    if _host_suite() == suite.name:
        return Place(Path("/"), ROOT, ROOT)
    root = LANES / suite.name
    return Place(root, root / CHECKOUT, Path("/") / CHECKOUT)


def make_suite(suite: Suite, until: float) -> Place:
    """The place of a lane, with what the checkout asks for. Raises NotHere and OutOfTime."""
    place = _place(suite)
    if place.root == Path("/"):
        if last := _logged(suite.name, ["sh", str(INSTALL)], until):
            raise NotHere(f"its packages could not be installed: {last}")
    else:
        make_chroot(suite, until)
    return place


def make_chroot(suite: Suite, until: float) -> None:
    """Bring build/lanes/<suite> up to what the checkout asks for. Raises NotHere and OutOfTime."""
    if os.geteuid() != 0:
        raise NotHere("needs root")
    root = LANES / suite.name
    done = root / ".made"
    wanted = INSTALL.read_text(encoding="utf-8")
    if done.exists() and done.read_text(encoding="utf-8") == wanted:
        return
    if not done.exists():
        _debootstrap(suite, root, until)
    shutil.copy("/etc/resolv.conf", root / "etc" / "resolv.conf")
    _write_apt(root)
    shutil.copy(INSTALL, root / "tmp" / "install-debian.sh")
    need = "apt-get update -q && sh /tmp/install-debian.sh"
    # What the tests call themselves.
    need += " && apt-get install -y -q --no-install-recommends make git"
    if last := _logged(suite.name, _enter(Place(root, root, Path("/")), need), until):
        raise NotHere(f"its packages could not be installed: {last}")
    done.write_text(wanted, encoding="utf-8")


def _debootstrap(suite: Suite, root: Path, until: float) -> None:
    """The base system of a suite, whole or not at all. Raises NotHere and OutOfTime."""
    if shutil.which("apt-get") is None:
        raise NotHere("needs Debian's apt and debootstrap")
    if shutil.which("debootstrap") is None:
        install = "apt-get update -q; apt-get install -y -q --no-install-recommends debootstrap"
        if last := _logged(suite.name, ["sh", "-c", install], until):
            raise NotHere(f"debootstrap could not be installed: {last}")
    mirror = _mirror()
    shutil.rmtree(root, ignore_errors=True)
    root.mkdir(parents=True)
    command = ["debootstrap", "--variant=minbase", "--include=ca-certificates"]
    # A debootstrap older than the suite does not know its name; they are all made alike.
    command += [suite.name, str(root), mirror, str(NEWEST_SCRIPT)]
    if last := _logged(suite.name, command, until):
        shutil.rmtree(root, ignore_errors=True)
        raise NotHere(f"debootstrap failed: {last}")


def _logged(name: str, command: list[str], until: float) -> str:
    """Run a command that makes a lane, with what it says in build/lanes/<name>.log; the last line
    of that when it failed, else nothing. Raises OutOfTime."""
    log = LANES / f"{name}.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    with open(log, "w", encoding="utf-8") as stream:
        made = _run(command, until, stdout=stream, stderr=subprocess.STDOUT)
    if not made.returncode:
        return ""
    last = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()[-1:]
    return last[0] if last else f"exit code {made.returncode}"


def _mirror() -> str:
    """Debian's mirror as this machine's apt has it."""
    rows = _output("apt-get", "indextargets", "--format", "$(RELEASE) $(COMPONENT) $(REPO_URI)")
    for row in rows.splitlines():
        release, component, address = row.split(" ", 2)
        if release == _host_suite() and component == "main":
            return address
    raise NotHere("this machine's apt names no mirror of Debian")


def _write_apt(root: Path) -> None:
    """Give the lane this machine's settings for fetching (proxies, dates), and no waiting for the
    disk at each package: the lane can be made again."""
    settings = _output("apt-config", "dump", "Acquire")
    settings += 'DPkg::Options:: "--force-unsafe-io";\n'
    (root / "etc" / "apt" / "apt.conf.d" / "90machine").write_text(settings, encoding="utf-8")
    (root / "usr" / "sbin" / "policy-rc.d").write_text("#!/bin/sh\nexit 101\n", encoding="utf-8")
    (root / "usr" / "sbin" / "policy-rc.d").chmod(0o755)


def copy_checkout(folder: Path) -> None:
    """Copy what git would: tracked files as they are now, and new ones that are not ignored."""
    listed = _output("git", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard", "-z")
    shutil.rmtree(folder, ignore_errors=True)
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    # What a release holds is what git knows.
    for command in (["init", "-q"], ["add", "-A"]):
        subprocess.run(["git", *command], cwd=folder, check=True, **QUIET)


def _inside(place: Place, command: str, until: float) -> int:
    """Exit code of a shell command in the checkout of a lane. Raises OutOfTime."""
    if place.root == Path("/"):
        return _run(["sh", "-c", command], until, cwd=place.folder).returncode
    return _run(_enter(place, command), until).returncode


def _enter(place: Place, command: str) -> list[str]:
    """What runs a shell command in a chroot. Its mounts and processes live in namespaces of their
    own and end with the command, so that nothing stays mounted under build/."""
    root = shlex.quote(str(place.root))
    mounts = (
        f"mount -t proc proc {root}/proc && mount --rbind /dev {root}/dev && "
        f"mount -t tmpfs tmpfs {root}/run && "
    )
    environment = "HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive PATH=/usr/sbin:/usr/bin"
    within = f"cd {place.inside} && {command}"
    enter = f"exec env -i {_proxies()} {environment} chroot {root} sh -c {shlex.quote(within)}"
    apart = ["unshare", "--mount", "--pid", "--fork", "--kill-child"]
    return [*apart, "sh", "-c", mounts + enter]


def _run(command: list[str], until: float, **given) -> subprocess.CompletedProcess:
    """A command that is stopped at a moment of the monotonic clock. Raises OutOfTime."""
    left = None if until == math.inf else max(until - time.monotonic(), 0.0)
    try:
        return subprocess.run(command, timeout=left, **QUIET, **given)
    except subprocess.TimeoutExpired:
        raise OutOfTime from None


def _proxies() -> str:
    names = [name for name in os.environ if name.lower().endswith("_proxy")]
    return " ".join(f"{name}={shlex.quote(os.environ[name])}" for name in names)


def make_libraries(lane: Libraries, until: float) -> Path:
    """The Python of a venv with what the lane asks for. Raises NotHere and OutOfTime."""
    python = _python(lane.python)
    folder = LANES / lane.name
    stamp = folder / ".made"
    wanted = " ".join(("scipy", "pytest", "pytest-xdist", *lane.packages))
    if not stamp.exists() or stamp.read_text(encoding="utf-8") != wanted:
        shutil.rmtree(folder, ignore_errors=True)
        install = [str(folder / "bin" / "pip"), "install", "-q", *shlex.split(wanted)]
        for command in ([python, "-m", "venv", str(folder)], install):
            if last := _logged(lane.name, command, until):
                raise NotHere(f"its packages could not be installed: {last}")
        stamp.write_text(wanted, encoding="utf-8")
    return folder / "bin" / "python"


def run_libraries(python: Path, arguments: list[str], until: float) -> tuple[int, str]:
    """Run the tests that need no FreeCAD with other libraries; 0 when all is well, and what is to
    be told. Raises OutOfTime."""
    environment = os.environ | {"BENDTORSION_WITHOUT_FREECAD": "1"}
    # What failed in other lanes, or in this checkout's own tests, is not run again here.
    cache = python.parent.parent / "cache"
    shutil.rmtree(cache, ignore_errors=True)
    command = [str(python), "-m", "pytest", "-q", "-o", f"cache_dir={cache}"]
    return _tested(
        lambda given: _run([*command, *given], until, cwd=ROOT, env=environment).returncode,
        arguments,
    )


def _python(release: str) -> str:
    """A Python of a release that can make a venv. Raises NotHere."""
    kept = Path(os.environ.get("PYENV_ROOT") or Path.home() / ".pyenv") / "versions"
    found = [shutil.which(f"python{release}", path="/usr/bin:/usr/local/bin")]
    found += sorted(str(path) for path in kept.glob(f"{release}.*/bin/python{release}"))
    for python in filter(None, found):
        if subprocess.run([python, "-c", "import ensurepip"], capture_output=True).returncode == 0:
            return python
    raise NotHere(f"no Python {release} with venv on this machine")


def _host_suite() -> str:
    try:
        return platform.freedesktop_os_release().get("VERSION_CODENAME", "")
    except OSError:
        return ""


def _output(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True, encoding="utf-8").stdout


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
