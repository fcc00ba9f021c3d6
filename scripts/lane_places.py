# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the lanes of scripts/lanes.py run: a Debian suite in a chroot, a venv of other libraries.

A suite is made by debootstrap in build/lanes/<suite>, with the packages scripts/install-debian.sh
asks for, and needs root. A machine that is such a suite itself is the place of that lane. Mirrors,
proxies and checks are those of this machine's own apt.
"""

from __future__ import annotations

import math
import os
import platform
import shlex
import shutil
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path
from typing import IO

ROOT = Path(__file__).resolve().parent.parent
LANES = ROOT / "build" / "lanes"
INSTALL = ROOT / "scripts" / "install-debian.sh"
CHECKOUT = "checkout"
QUIET = {"stdin": subprocess.DEVNULL}
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


@dataclass(frozen=True)
class Place:
    """Where a lane runs: its root, its checkout seen from outside, and from inside."""

    root: Path
    folder: Path
    inside: Path


def place_of(suite: Suite) -> Place:
    """Where a suite's lane runs, made or not."""
    if _host_suite() == suite.name:
        return Place(Path("/"), ROOT, ROOT)
    root = LANES / suite.name
    return Place(root, root / CHECKOUT, Path("/") / CHECKOUT)


def make_suite(suite: Suite, until: float) -> Place:
    """The place of a lane, with what the checkout asks for. Raises NotHere and OutOfTime."""
    place = place_of(suite)
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
        made = run(command, until, stdout=stream, stderr=subprocess.STDOUT)
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


def inside(place: Place, command: str, until: float, stream: IO | None = None) -> int:
    """Exit code of a shell command in the checkout of a lane, with what it says in a stream if one
    is given. Raises OutOfTime."""
    given = {"stdout": stream, "stderr": stream}
    if place.root == Path("/"):
        return run(["sh", "-c", command], until, cwd=place.folder, **given).returncode
    return run(_enter(place, command), until, **given).returncode


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


def run(command: list[str], until: float, **given) -> subprocess.CompletedProcess:
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
