# SPDX-License-Identifier: LGPL-2.1-or-later
"""Killed while it writes: old files intact or new ones whole, and the next run works."""

import pytest
from kill_scenarios import scenarios, tried

pytestmark = pytest.mark.slow
PLACES = 6


@pytest.fixture(scope="module")
def every(tmp_path_factory):
    names = ("build of a change", "export as CSV", "issue", "report as json")
    return scenarios(tmp_path_factory.mktemp("kill"), names)


@pytest.mark.parametrize("which", range(4))
def test_a_kill_at_any_write_loses_nothing_and_the_next_run_works(every, which):
    one = every[which]
    step = one.points / PLACES
    for k in range(PLACES):
        lost, stuck = tried(one, max(1, round((k + 0.7) * step)))
        assert not lost and not stuck
