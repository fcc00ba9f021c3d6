# SPDX-License-Identifier: LGPL-2.1-or-later
"""Test set-up: the checkout on the path, FreeCAD importable as a module, no network."""

import gc
import ipaddress
import os
import signal
import socket
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from BendTorsionWB import freecad_path

# What needs an optional package is collected where that is installed.
OPTIONAL = {"test_rhino_files.py": "rhino3dm", "test_dask_cluster.py": "distributed"}
collect_ignore = [name for name, package in OPTIONAL.items() if find_spec(package) is None]

from without_freecad import FIXTURES, needs_freecad  # noqa: E402

# A lane of libraries (docs/versions.md): the tests of numbers, schedules and files alone.
WITHOUT_FREECAD = bool(os.environ.get("BENDTORSION_WITHOUT_FREECAD"))
if WITHOUT_FREECAD:
    here = Path(__file__).resolve().parent
    collect_ignore += [path.name for path in here.glob("test_*.py") if needs_freecad(path)]
else:
    freecad_path.append()

from checkers import INSTALL, missing  # noqa: E402

# Shells have jobs in the background ignore it, and so would all that tests start.
signal.signal(signal.SIGINT, signal.default_int_handler)

LEFT_OUT = []
_connect = socket.socket.connect


def _connect_here(self, address):
    """Tests reach this machine only."""
    if self.family in (socket.AF_INET, socket.AF_INET6):
        if not ipaddress.ip_address(address[0].replace("localhost", "127.0.0.1")).is_loopback:
            raise OSError(f"tests use no network: {address}")
    return _connect(self, address)


socket.socket.connect = _connect_here


@pytest.fixture
def document():
    """An empty document without a window, closed after the test."""
    import FreeCAD

    made = FreeCAD.newDocument("tested", hidden=True)
    yield made
    FreeCAD.closeDocument(made.Name)


@pytest.fixture(scope="session")
def built(tmp_path_factory):
    """A whole project, built once: the schedule, the folder, and what the build found."""
    from package_build import build_package

    return build_package(tmp_path_factory.mktemp("package"))


def pytest_collection_modifyitems(config, items):
    """Leave out tests whose program is not installed; the summary names them."""
    kept = []
    for item in items:
        marker = item.get_closest_marker("external")
        absent = [tool for tool in marker.args if missing(tool)] if marker else []
        if WITHOUT_FREECAD and FIXTURES & set(item.fixturenames):
            absent.append("FreeCAD")
        if absent:
            LEFT_OUT.append(f"{item.nodeid} needs {', '.join(absent)}")
        else:
            kept.append(item)
    if LEFT_OUT:
        config.hook.pytest_deselected(items=[item for item in items if item not in kept])
        items[:] = kept
    if hasattr(config, "workerinput"):
        turns = _turns(kept)
        items.sort(key=lambda item: turns[item.path])


def _turns(items):
    """{path: when a worker takes this file}, from 0 to 1.

    Sessions in FreeCAD's window wait much of their time: they are spread among files that compute,
    so that processors have something to do meanwhile. Long files come early, so that none ends
    alone."""
    slow = {item.path for item in items if item.get_closest_marker("slow")}
    groups = {"window": [], "slow": [], "quick": []}
    for path in dict.fromkeys(item.path for item in items):
        kind = "window" if "window" in path.stem else "slow" if path in slow else "quick"
        groups[kind].append(path)
    return {
        path: number / len(paths) * (1.0 if kind == "quick" else 0.6)
        for kind, paths in groups.items()
        for number, path in enumerate(paths)
    }


def pytest_collection_finish():
    """What thousands of tests stand on is no garbage: the collector need not go through it."""
    gc.freeze()


def pytest_sessionfinish(session):
    """A worker tells the one that started it what was left out."""
    if hasattr(session.config, "workeroutput"):
        session.config.workeroutput["left_out"] = LEFT_OUT


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node):
    """Every worker collects all tests: what it left out is told once."""
    told = getattr(node, "workeroutput", {}).get("left_out", [])
    LEFT_OUT.extend(line for line in told if line not in LEFT_OUT)


def pytest_terminal_summary(terminalreporter):
    """Name every test that was left out."""
    if LEFT_OUT:
        terminalreporter.section(f"not run, to be run after: {INSTALL}")
        for line in LEFT_OUT:
            terminalreporter.line(line)


@pytest.fixture
def made(path):
    """The document of the schedule that a module has as its fixture `path`, recomputed."""
    import FreeCAD

    from BendTorsionWB import project
    from BendTorsionWB.document import build_document

    given, jobs = project.read_jobs(path)
    document = build_document(given, jobs, sheets=False)
    document.recompute()
    yield document
    FreeCAD.closeDocument(document.Name)


# Fixtures for all tests.
from cut_members import sine, tilted, twisted, twisted_plates  # noqa: E402, F401
from piece_members import delivered  # noqa: E402, F401
from schedule_books import read  # noqa: E402, F401
