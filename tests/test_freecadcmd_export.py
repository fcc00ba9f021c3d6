# SPDX-License-Identifier: LGPL-2.1-or-later
"""A script for FreeCAD's console program that changes a section of a built model and exports it
again: the one of docs/projects.md."""

import json
import os
import re
import subprocess
from pathlib import Path

from test_build import APART, schedule

from BendTorsionWB import project
from BendTorsionWB.project import Wanted

ROOT = Path(__file__).parent.parent


def documented_script():
    """The script printed in the documentation."""
    text = (ROOT / "docs" / "projects.md").read_text(encoding="utf-8")
    [script] = re.findall(r"```python\n(import os\n.*?)```", text, re.S)
    return script


def test_the_documented_script_changes_a_section_and_exports_again(tmp_path):
    path = schedule(tmp_path / "two.xlsx", APART)
    out = tmp_path / "out"
    project.build(path, out, workers=1, wanted=Wanted(sheets=False))
    (tmp_path / "home").mkdir()
    script = tmp_path / "change.py"
    script.write_text(documented_script(), encoding="utf-8")
    environment = os.environ | {
        "HOME": str(tmp_path / "home"),
        "FREECAD_USER_HOME": str(tmp_path / "home"),
        "MODEL": str(out / "model.FCStd"),
        "SECTION": "B500",
        "HEIGHT": "520",
        "OUT": str(tmp_path / "again"),
    }
    # Newer releases do not look at PYTHONPATH, all look into Mod.
    subprocess.run(["make", "-s", "install"], cwd=ROOT, env=environment, check=True)
    done = subprocess.run(
        ["freecadcmd", str(script)],
        env=environment,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        encoding="utf-8",
        timeout=180,
    )
    assert (tmp_path / "again" / "report.json").exists(), done.stdout[-2000:] + done.stderr[-2000:]
    before, after = (
        {
            m["member"]: m["mass_kg"]
            for m in json.loads((o / "report.json").read_text(encoding="utf-8"))["members"]
        }
        for o in (out, tmp_path / "again")
    )
    assert after["M1"] > before["M1"] and after["M2"] == before["M2"]
    assert (tmp_path / "again" / "model.step").exists()
    assert re.search(r"M1.*\d", done.stdout)
