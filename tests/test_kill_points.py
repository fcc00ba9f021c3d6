# SPDX-License-Identifier: LGPL-2.1-or-later
"""Killed while it writes: old files intact or new ones whole, and the next run works."""

import json
import subprocess
import sys

import kill_scenarios
import pytest

pytestmark = pytest.mark.slow
PLACES = 6
NAMES = ("build of a change", "export as CSV over another", "issue", "report as json")


@pytest.fixture(scope="module")
def every(tmp_path_factory):
    """Of each scenario what was lost and what stopped the next run, as a process of its own saw."""
    folder = tmp_path_factory.mktemp("kill")
    command = [sys.executable, kill_scenarios.__file__, str(folder), str(PLACES), *NAMES]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8")
    assert done.returncode == 0, done.stderr[-4000:]
    return {name: rest for name, *rest in map(json.loads, done.stdout.splitlines())}


@pytest.mark.parametrize("name", NAMES)
def test_a_kill_at_any_write_loses_nothing_and_the_next_run_works(every, name):
    lost, stuck = every[name]
    assert not lost and not stuck
