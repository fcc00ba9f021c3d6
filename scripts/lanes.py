# SPDX-License-Identifier: LGPL-2.1-or-later
"""The test suite under other releases of FreeCAD and other libraries, each in a lane of its own.

`/usr/bin/python3 scripts/lanes.py` runs every lane in turn; names choose some, and what stands
after `--` goes to pytest. A lane of FreeCAD is a Debian suite in build/lanes/<suite>, made by
debootstrap with the packages scripts/install-debian.sh asks for; it needs root. Mirrors, proxies
and checks are those of this machine's own apt. A lane of libraries is a venv without FreeCAD, for
the tests that need none. docs/versions.md says what runs where.

A lane that cannot be made here is named as not run. Exit code: 1 when a test failed in a lane.
"""

from __future__ import annotations

import argparse
import os
import platform
import shlex
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from threading import Lock

ROOT = Path(__file__).resolve().parent.parent
LANES = ROOT / "build" / "lanes"
CHECKOUT = "checkout"
QUIET = {"stdin": subprocess.DEVNULL}
_making, _printing = Lock(), Lock()
NEWEST_SCRIPT = Path("/usr/share/debootstrap/scripts/sid")


class NotHere(Exception):
    """Why a lane cannot be run on this machine."""


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


def run_suite(suite: Suite, arguments: list[str]) -> int:
    """Run the suite's tests and save a document there; 0 when all is well. Raises NotHere."""
    place = _made(suite)
    if place.root != Path("/"):
        copy_checkout(place.folder)
    code = 0
    if arguments or place.root != Path("/"):
        # On the machine itself `make test` has run the suite.
        command = f"/usr/bin/python3 -m pytest -q {shlex.join(arguments)}"
        code = _reported(suite.name, _inside, place, command)
    command = f"/usr/bin/python3 tests/carried_document.py save build/carried/{suite.name}"
    return _inside(place, command) or code


def compare_carried(suites: Sequence[Suite]) -> list[int]:
    """Open in each lane what the older ones saved, and compare the figures: exit codes."""
    codes, older = [], []
    for suite in (item for item in SUITES if item in suites):
        place = _place(suite)
        own = place.folder / "build" / "carried" / suite.name
        for former in older:
            target = own.with_name(former.name)
            if target != former:
                shutil.rmtree(target, ignore_errors=True)
                shutil.copytree(former, target)
            print(f"== {former.name} opened in {suite.name}", flush=True)
            command = "/usr/bin/python3 tests/carried_document.py compare"
            codes.append(_inside(place, f"{command} build/carried/{former.name}"))
        if own.is_dir():
            older.append(own)
    return codes


def _place(suite: Suite) -> Place:
    if _host_suite() == suite.name:
        return Place(Path("/"), ROOT, ROOT)
    root = LANES / suite.name
    return Place(root, root / CHECKOUT, Path("/") / CHECKOUT)


def _made(suite: Suite) -> Place:
    """The place of a lane, with what the checkout asks for. Raises NotHere."""
    place = _place(suite)
    if place.root == Path("/"):
        subprocess.run(["sh", "scripts/install-debian.sh"], cwd=ROOT, check=True, **QUIET)
    else:
        with _making:
            make_chroot(suite)
    return place


def _reported(name: str, run: Callable[..., int], *arguments) -> int:
    """Run something that takes a stream for what it prints, and print that in one piece."""
    LANES.mkdir(parents=True, exist_ok=True)
    log = LANES / f"{name}.txt"
    with open(log, "w", encoding="utf-8") as stream:
        code = run(*arguments, stream=stream)
    with _printing:
        print(f"== {name}", log.read_text(encoding="utf-8", errors="replace"), sep="\n", flush=True)
    return code


def make_chroot(suite: Suite) -> None:
    """Bring build/lanes/<suite> up to what the checkout asks for. Raises NotHere."""
    if os.geteuid() != 0:
        raise NotHere("needs root")
    root = LANES / suite.name
    done = root / ".made"
    wanted = (ROOT / "scripts" / "install-debian.sh").read_text(encoding="utf-8")
    if done.exists() and done.read_text(encoding="utf-8") == wanted:
        return
    if not done.exists():
        _debootstrap(suite, root)
    shutil.copy("/etc/resolv.conf", root / "etc" / "resolv.conf")
    _write_apt(root)
    shutil.copy(ROOT / "scripts" / "install-debian.sh", root / "tmp" / "install-debian.sh")
    need = "apt-get update -q >/dev/null && sh /tmp/install-debian.sh >/dev/null"
    # What the tests call themselves.
    need += " && apt-get install -y -q --no-install-recommends make git >/dev/null"
    if _inside(Place(root, root, Path("/")), need):
        raise NotHere("its packages could not be installed")
    done.write_text(wanted, encoding="utf-8")


def _debootstrap(suite: Suite, root: Path) -> None:
    """The base system of a suite, whole or not at all."""
    if shutil.which("debootstrap") is None:
        if shutil.which("apt-get") is None:
            raise NotHere("needs debootstrap")
        install = "apt-get update -q; apt-get install -y -q --no-install-recommends debootstrap"
        subprocess.run(["sh", "-c", install], stdout=subprocess.DEVNULL, **QUIET)
        if shutil.which("debootstrap") is None:
            raise NotHere("debootstrap could not be installed")
    mirror = _mirror()
    shutil.rmtree(root, ignore_errors=True)
    root.mkdir(parents=True)
    command = ["debootstrap", "--variant=minbase", "--include=ca-certificates"]
    # A debootstrap older than the suite does not know its name; they are all made alike.
    command += [suite.name, str(root), mirror, str(NEWEST_SCRIPT)]
    log = LANES / f"{suite.name}.log"
    with open(log, "w", encoding="utf-8") as stream:
        made = subprocess.run(command, stdout=stream, stderr=subprocess.STDOUT, **QUIET)
    if made.returncode:
        shutil.rmtree(root, ignore_errors=True)
        last = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()[-1:]
        raise NotHere(f"debootstrap failed: {' '.join(last)}")


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


def _inside(place: Place, command: str, stream=None) -> int:
    """Exit code of a shell command in the checkout of a lane; stream: a file for what it prints.

    The lane's mounts and processes live in namespaces of their own and end with the command, so
    that nothing stays mounted under build/.
    """
    told = {**QUIET, "stdout": stream, "stderr": subprocess.STDOUT if stream else None}
    root = place.root
    if root == Path("/"):
        return subprocess.run(["sh", "-c", command], cwd=place.folder, **told).returncode
    mounts = (
        f"mount -t proc proc {root}/proc && mount --rbind /dev {root}/dev && "
        f"mount -t tmpfs tmpfs {root}/run && "
    )
    environment = "HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive PATH=/usr/sbin:/usr/bin"
    within = f"cd {place.inside} && {command}"
    enter = f"exec env -i {_proxies()} {environment} chroot {root} sh -c {shlex.quote(within)}"
    apart = ["unshare", "--mount", "--pid", "--fork", "--kill-child"]
    return subprocess.run([*apart, "sh", "-c", mounts + enter], **told).returncode


def _proxies() -> str:
    names = [name for name in os.environ if name.lower().endswith("_proxy")]
    return " ".join(f"{name}={shlex.quote(os.environ[name])}" for name in names)


def run_libraries(lane: Libraries, arguments: list[str]) -> int:
    """Run the tests that need no FreeCAD with other libraries."""
    python = _python(lane.python)
    folder = LANES / lane.name
    folder.parent.mkdir(parents=True, exist_ok=True)
    stamp = folder / ".made"
    wanted = " ".join(("scipy", "pytest", "pytest-xdist", *lane.packages))
    if not stamp.exists() or stamp.read_text(encoding="utf-8") != wanted:
        shutil.rmtree(folder, ignore_errors=True)
        made = subprocess.run([python, "-m", "venv", str(folder)], **QUIET).returncode == 0
        install = [str(folder / "bin" / "pip"), "install", "-q", *shlex.split(wanted)]
        if not made or subprocess.run(install, **QUIET).returncode:
            raise NotHere("its packages could not be installed")
        stamp.write_text(wanted, encoding="utf-8")
    environment = os.environ | {"BENDTORSION_WITHOUT_FREECAD": "1"}
    command = [str(folder / "bin" / "python"), "-m", "pytest", "-q", *arguments]
    return _reported(lane.name, _run, command, environment)


def _run(command: list[str], environment: dict[str, str], stream) -> int:
    told = {**QUIET, "stdout": stream, "stderr": subprocess.STDOUT}
    return subprocess.run(command, cwd=ROOT, env=environment, **told).returncode


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
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def main() -> int:
    names = {lane.name: lane for lane in (*SUITES, *VENVS)}
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("lanes", nargs="*", metavar="LANE", help=", ".join(names))
    parser.add_argument("--make", action="store_true", help="make the chroots, run nothing")
    given = sys.argv[1:]
    arguments = given[given.index("--") + 1 :] if "--" in given else []
    chosen = parser.parse_args(given[: given.index("--")] if "--" in given else given)
    unknown = [name for name in chosen.lanes if name not in names]
    if unknown:
        parser.error(f"no such lane: {', '.join(unknown)}; there are {', '.join(names)}")
    lanes = [names[name] for name in chosen.lanes or names]
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        ends = [pool.submit(run_lane, lane, arguments, chosen.make) for lane in lanes]
        results = [end.result() for end in ends]
    codes = [code for code, _ in results]
    if not chosen.make:
        codes += compare_carried([lane for lane in lanes if isinstance(lane, Suite)])
    print("\n".join(["== lanes", *(line for _, line in results)]), flush=True)
    return 1 if any(codes) else 0


def run_lane(lane: Suite | Libraries, arguments: list[str], only_make: bool) -> tuple[int, str]:
    """Make and run a lane; its exit code, and a line on how it went."""
    start = time.monotonic()
    try:
        if isinstance(lane, Libraries):
            code = run_libraries(lane, arguments)
        elif only_make:
            _made(lane)
            code = 0
        else:
            code = run_suite(lane, arguments)
    except NotHere as reason:
        return 0, f"{lane.name}: not run: {reason}"
    minutes = (time.monotonic() - start) / 60
    return code, f"{lane.name}: {'FAILED' if code else 'passed'} in {minutes:.1f} min"


if __name__ == "__main__":
    sys.exit(main())
