# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures computed to be written into a schedule: plain without the last bits computing leaves, and
what is built of them is the same."""

import math
import pickle
import random

import FreeCAD
import pytest
from test_node_objects import schedule as crossing

from BendTorsionWB import project
from BendTorsionWB.core import detailing
from BendTorsionWB.core.written_number import CLOSE_TO, per_cent, plain
from BendTorsionWB.document import build_document
from BendTorsionWB.exchange.part_cells import place
from BendTorsionWB.exchange.schedule_cells import along
from BendTorsionWB.round_trip import write_back


def test_plain_figures_lose_their_last_bits_and_all_others_keep_every_digit():
    assert repr(plain(3999.9999999999986)) == "4000.0"
    assert repr(plain(-0.30000000000000004)) == "-0.3" and plain(0.0) == 0.0
    # Found, not given: a ten-thousandth of a nanometre beside a plain figure is kept.
    assert plain(4000.0000000001) == 4000.0000000001
    draw = random.Random(7)
    for _ in range(2000):
        value = draw.uniform(-1, 1) * 10 ** draw.randint(-6, 7)
        assert math.isclose(plain(value), value, rel_tol=CLOSE_TO, abs_tol=0.0)
        typed = float(f"{value:.{draw.randint(1, 12)}g}")
        for noisy in (typed, math.nextafter(typed, 9e9), math.nextafter(typed, -9e9)):
            assert plain(noisy) == typed


def test_per_cents_are_as_near_to_the_ratio_as_per_cents_are():
    assert per_cent(0.57) == "57.0%" and repr(0.57 * 100) == "56.99999999999999"
    draw = random.Random(11)
    for ratio in (draw.random() for _ in range(2000)):
        assert math.isclose(along(per_cent(ratio)).value, ratio, rel_tol=2.3e-16, abs_tol=0.0)


def test_per_cents_come_back_as_they_were_typed():
    for tenth in range(1, 1000):
        typed = f"{tenth / 10!r}%"
        assert place(typed) == typed and along(place(typed)).value == along(typed).value


@pytest.mark.parametrize("name", ["back.xlsx", "back"])
def test_the_place_of_a_node_is_written_plainly_and_builds_the_same(tmp_path, name):
    path = crossing(tmp_path / "s.xlsx", [["K1", "M1", "M2", None, "direct", 4, None, None]])
    given, jobs = project.read_jobs(path)
    document = build_document(given, jobs, sheets=False)
    try:
        [node] = [o for o in document.Objects if getattr(o, "BT_Type", "") == "Node"]
        found = node.Place.Value
        assert write_back(document, tmp_path / name) == ()
        _, again = project.read_jobs(tmp_path / name)
        # The very same plates are built, whether it was found or given.
        for own in jobs:
            one, other = (detailing.detail(of[own]).record for of in (jobs, again))
            assert one.plates and pickle.dumps(one.plates) == pickle.dumps(other.plates)
    finally:
        FreeCAD.closeDocument(document.Name)
    (row,) = project.read_jobs(tmp_path / name)[0].nodes
    written = row.s.value
    assert written == pytest.approx(found, rel=1e-9) and len(repr(written)) <= 11 < len(repr(found))
