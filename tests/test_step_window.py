# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD itself reads the STEP files of members: tree, names, colours, solids where they are."""

import pytest
from freecad_window import ROOT, run_in_window
from test_step_fragment import BLUE, HARD, RED, given, written

from BendTorsionWB.step_fragments import made_fragment

SCRIPT = ROOT / "tests" / "window" / "step_session.py"


def test_freecad_reads_tree_names_and_colours(tmp_path):
    # An assembly of one part it takes for the part, so each has two.
    one = given(HARD, ["T1", "T2", "钢's #1", "B2"], 0.0, lambda k: f"P{k // 2 + 1}")
    two = given("M2", ["M2-T1", "M2-T2"], 50.0)
    path = tmp_path / "m.step"
    path.write_bytes(written(map(made_fragment, (one, two))))
    seen = run_in_window(SCRIPT, tmp_path / "home", step=path)
    assert "failed" not in seen, seen["failed"]
    parents = {own["label"]: own["parents"] for own in seen["objects"]}
    assert parents == {
        **{"assemblies": [], HARD: ["assemblies"], "P1": [HARD], "P2": [HARD]},
        **{"T1": ["P1"], "T2": ["P1"], "钢's #1": ["P2"], "B2": ["P2"]},
        **{"M2": ["assemblies"], "M2-T1": ["M2"], "M2-T2": ["M2"]},
    }
    solids = {own["label"]: own for own in seen["objects"] if "solids" in own}
    for mark, volume, x, colour in (
        ("T1", 500.0, 0.0, RED),
        ("T2", 600.0, 0.0, BLUE),
        ("钢's #1", 700.0, 0.0, RED),
        ("B2", 800.0, 0.0, BLUE),
        ("M2-T1", 500.0, 50.0, RED),
        ("M2-T2", 600.0, 50.0, BLUE),
    ):
        own = solids.pop(mark)
        assert own["solids"] == 1 and own["valid"]
        assert own["volume"] == pytest.approx(volume, rel=1e-9)
        assert own["x"] == pytest.approx(x, abs=1e-6)
        assert own["colour"] == pytest.approx(colour, abs=1e-6)
    assert not solids
