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
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LANES = ROOT / "build" / "lanes"
CARRIED = LANES / "carried"
CHECKOUT = "checkout"
QUIET = {"stdin": subprocess.DEVNULL}
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


def run_suite(suite: Suite, arguments: list[str]) -> int:
    """Run the suite's tests, save a document there and open those of the lanes before it."""
    if _host_suite() == suite.name:
        root, folder, inside = Path("/"), ROOT, ROOT
        subprocess.run(["sh", "scripts/install-debian.sh"], cwd=ROOT, check=True, **QUIET)
    else:
        root = LANES / suite.name
        make_chroot(suite)
        folder, inside = root / CHECKOUT, Path("/") / CHECKOUT
        copy_checkout(folder)
    code = 0
    if arguments or root != Path("/"):
        # On the machine itself `make test` has run the suite.
        code = _inside(root, inside, f"/usr/bin/python3 -m pytest -q {shlex.join(arguments)}")
    return code or carry(suite, root, folder, inside)


def carry(suite: Suite, root: Path, folder: Path, inside: Path) -> int:
    """Save a document in this lane, and compare those the older lanes saved: 0 when all agree."""
    command = "/usr/bin/python3 tests/carried_document.py"
    target = CARRIED / suite.name
    saved = folder / "build" / "carried"
    shutil.rmtree(saved, ignore_errors=True)
    code = _inside(root, inside, f"{command} save build/carried/{suite.name}")
    if code == 0:
        shutil.rmtree(target, ignore_errors=True)
        shutil.copytree(saved / suite.name, target)
    for older in SUITES[: SUITES.index(suite)]:
        if (CARRIED / older.name).is_dir():
            shutil.copytree(CARRIED / older.name, saved / older.name)
            code = _inside(root, inside, f"{command} compare build/carried/{older.name}") or code
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
    # `make` is what the tests of the window install the workbench with; git is not needed.
    need += " && apt-get install -y -q --no-install-recommends make >/dev/null"
    if _inside(root, Path("/"), need):
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


def _inside(root: Path, folder: Path, command: str) -> int:
    """Exit code of a shell command in a folder of the lane.

    The lane's mounts and processes live in namespaces of their own and end with the command, so
    that nothing stays mounted under build/.
    """
    if root == Path("/"):
        return subprocess.run(["sh", "-c", command], cwd=folder, **QUIET).returncode
    mounts = (
        f"mount -t proc proc {root}/proc && mount --rbind /dev {root}/dev && "
        f"mount -t tmpfs tmpfs {root}/run && "
    )
    environment = "HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive PATH=/usr/sbin:/usr/bin"
    within = f"cd {folder} && {command}"
    enter = f"exec env -i {_proxies()} {environment} chroot {root} sh -c {shlex.quote(within)}"
    apart = ["unshare", "--mount", "--pid", "--fork", "--kill-child"]
    return subprocess.run([*apart, "sh", "-c", mounts + enter], **QUIET).returncode


def _proxies() -> str:
    names = [name for name in os.environ if name.lower().endswith("_proxy")]
    return " ".join(f"{name}={shlex.quote(os.environ[name])}" for name in names)


def run_libraries(lane: Libraries, arguments: list[str]) -> int:
    """Run the tests that need no FreeCAD with other libraries."""
    python = _python(lane.python)
    folder = LANES / lane.name
    stamp = folder / ".made"
    wanted = " ".join(("scipy", "pytest", *lane.packages))
    if not stamp.exists() or stamp.read_text(encoding="utf-8") != wanted:
        shutil.rmtree(folder, ignore_errors=True)
        made = subprocess.run([python, "-m", "venv", str(folder)], **QUIET).returncode == 0
        install = [str(folder / "bin" / "pip"), "install", "-q", *shlex.split(wanted)]
        if not made or subprocess.run(install, **QUIET).returncode:
            raise NotHere("its packages could not be installed")
        stamp.write_text(wanted, encoding="utf-8")
    environment = os.environ | {"BENDTORSION_WITHOUT_FREECAD": "1"}
    command = [str(folder / "bin" / "python"), "-m", "pytest", "-q", *arguments]
    return subprocess.run(command, cwd=ROOT, env=environment, **QUIET).returncode


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
    told, failed = [], False
    for name in chosen.lanes or names:
        lane, start = names[name], time.monotonic()
        print(f"== {name}", flush=True)
        try:
            if chosen.make:
                if isinstance(lane, Suite) and name != _host_suite():
                    make_chroot(lane)
                code = 0
            elif isinstance(lane, Suite):
                code = run_suite(lane, arguments)
            else:
                code = run_libraries(lane, arguments)
        except NotHere as reason:
            told.append(f"{name}: not run: {reason}")
            continue
        failed = failed or code != 0
        minutes = (time.monotonic() - start) / 60
        told.append(f"{name}: {'FAILED' if code else 'passed'} in {minutes:.1f} min")
    print("\n".join(["== lanes", *told]), flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
