# SPDX-License-Identifier: LGPL-2.1-or-later
"""A macro file as FreeCAD's recorder saves it runs in a new FreeCAD, with a window and without."""

import json
import os
import subprocess
import sys

import FreeCAD
import Part
import pytest
from freecad_window import ROOT, run_in_window, step

sys.path.insert(0, str(ROOT / "tests" / "window"))
import macro_base

SCRIPT = ROOT / "tests" / "window" / "macro_file_session.py"
# What a console makes of the file, told by the figures of the window's own script.
AFTER = """
import json, sys
import FreeCAD
sys.path.insert(0, {scripts!r})
import macro_base
with open({result!r}, "w") as stream:
    json.dump(macro_base.figures(FreeCAD.ActiveDocument), stream)
"""


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """What the session saw that recorded the macro, and the file."""
    folder = tmp_path_factory.mktemp("macro_file")
    base = macro_base.base("Arcs")
    shapes = [base.getObject(name).Shape for name in ("Ball", "Arc1", "Arc2")]
    Part.Compound(shapes).exportStep(str(folder / "arcs.step"))
    FreeCAD.closeDocument("Arcs")
    macro, arcs = folder / "members.FCMacro", folder / "arcs.step"
    window = run_in_window(SCRIPT, folder / "home", macro=macro, arcs=arcs)
    return step(window, "recorded"), macro


def same(found, wanted):
    """The same objects of the same kinds, in order, and as large."""
    assert found.keys() == wanted.keys()
    for label, (kind, status, size) in wanted.items():
        assert found[label][:2] == [kind, status]
        assert found[label][2] == pytest.approx(size, rel=1e-7)


def test_what_is_recorded_is_our_lines(recorded):
    """The recorder has the name of the file that adds a command imported: it can be."""
    seen, macro = recorded
    assert seen["shown"] == [] and seen["free"] == 2
    assert {"M1 plates", "M2 plates", "Section 2", "M1 patterns"} <= set(seen["figures"])
    assert "Section 3" not in seen["figures"]
    lines = macro.read_text(encoding="utf-8").splitlines()
    assert {line for line in lines if line.startswith("import ")} == {
        "import FreeCAD",
        "import BendTorsionWB",
    }


def test_what_was_refused_or_cancelled_leaves_a_comment(recorded):
    """Five commands were; the lines are those of what was done, each once."""
    seen, macro = recorded
    assert len(seen["refused"]) == 4
    lines = macro.read_text(encoding="utf-8").splitlines()
    assert not any("runCommand('BendTorsion_" in line for line in lines)
    for words in ("# Members from selection", "# Section", "# Report", "# Export package"):
        assert words in lines
    made = [line.partition("make.")[2].partition("(")[0] for line in lines if "= make." in line]
    wanted = ["make_surface", "make_section"]
    wanted += 2 * ["make_axis", "make_member", "make_plates"]
    assert made == [*wanted, "make_section", "make_unfold"]
    files = [line for line in lines if "make_files." in line]
    assert len(files) == 1 and "import_shapes" in files[0]


def test_the_file_runs_in_a_new_window(recorded, tmp_path):
    """And ends as the session did: the same is shown, seen from the same place."""
    seen, macro = recorded
    window = run_in_window(SCRIPT, tmp_path / "home", macro=macro, arcs="")
    again = step(window, "run_again")
    same(again["figures"], seen["figures"])
    assert "Error" not in window["report_view"]
    assert again["shown_ones"] == seen["shown_ones"]
    assert "Surface" not in seen["shown_ones"] and "M1 patterns" in seen["shown_ones"]
    assert again["camera"] == seen["camera"]


def test_the_file_runs_in_freecads_console(recorded, tmp_path):
    seen, macro = recorded
    result, after = tmp_path / "result.json", tmp_path / "after.py"
    after.write_text(
        AFTER.format(scripts=str(ROOT / "tests" / "window"), result=str(result)), encoding="utf-8"
    )
    environment = os.environ | {
        "HOME": str(tmp_path),
        "FREECAD_USER_HOME": str(tmp_path / "freecad"),
    }
    subprocess.run(["make", "-s", "install"], cwd=ROOT, env=environment, check=True)
    done = subprocess.run(
        ["freecadcmd", str(macro), str(after)],
        env=environment,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=120,
    )
    assert result.exists(), done.stdout[-2000:] + done.stderr[-2000:]
    same(json.loads(result.read_text(encoding="utf-8")), seen["figures"])
