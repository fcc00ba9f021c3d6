# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scripts for FreeCAD's own console program: build from nothing, change, save, open again."""

import json
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent

SCRIPT = """
import json, os
import FreeCAD
from BendTorsionWB import make

out = os.environ["RESULT_FOLDER"]
document = FreeCAD.newDocument("Rib")
dome = make.make_surface(document, "Dome", "sphere", r=20000)
points = [(20000 * x, 0, 20000 * (1 - x * x) ** 0.5) for x in (0, 0.1, 0.22, 0.3, 0.41, 0.5)]
axis = make.make_axis(document, "A1", dome, points)
section = make.make_section(document, "B600", type="box1", h=600, b=600, t=16)
member = make.make_member(document, "M1", axis, sections=[section])
plates = make.make_plates(document, member, {"top": (0.4, 1)})
unfold = make.make_unfold(document, plates)
make.make_sheets(document, unfold, "Rib")
document.recompute()
first = plates.Mass
section.Height = 500
document.recompute()
second = plates.Mass
document.saveAs(os.path.join(out, "rib.FCStd"))
name = document.Name
FreeCAD.closeDocument(name)
again = FreeCAD.openDocument(os.path.join(out, "rib.FCStd"))
for item in again.Objects:
    item.touch()
again.recompute()
(same,) = again.getObjectsByLabel("M1 plates")
with open(os.path.join(out, "result.json"), "w") as stream:
    json.dump({"first": first, "second": second, "again": same.Mass, "status": same.Status,
               "pages": len(again.findObjects("TechDraw::DrawPage"))}, stream)
"""


def test_a_script_builds_changes_saves_and_reopens(tmp_path):
    script = tmp_path / "rib.py"
    script.write_text(SCRIPT, encoding="utf-8")
    environment = os.environ | {
        "HOME": str(tmp_path),
        "FREECAD_USER_HOME": str(tmp_path / "freecad"),
        "RESULT_FOLDER": str(tmp_path),
    }
    # Newer releases do not look at PYTHONPATH, all look into Mod.
    subprocess.run(["make", "-s", "install"], cwd=ROOT, env=environment, check=True)
    done = subprocess.run(
        ["freecadcmd", str(script)],
        env=environment,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=120,
    )
    assert (tmp_path / "result.json").exists(), done.stdout[-2000:] + done.stderr[-2000:]
    result = json.loads((tmp_path / "result.json").read_text(encoding="utf-8"))
    assert result["status"] == "ok" and result["pages"] >= 2
    assert result["first"] > result["second"] > 0
    assert result["again"] == pytest.approx(result["second"], rel=1e-9)
