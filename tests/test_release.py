# SPDX-License-Identifier: LGPL-2.1-or-later
"""The release archive: complete, the same every time, and it works where it is installed."""

import json
import subprocess
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def test_the_archive_installs_and_works_in_a_clean_user_folder(tmp_path):
    """Unpacked into Mod: plates, files and commands come from there."""
    command = [sys.executable, str(ROOT / "scripts" / "release.py"), "--uncommitted", "--out"]
    done = subprocess.run(
        [*command, str(tmp_path / "one")], capture_output=True, encoding="utf-8", check=False
    )
    assert done.returncode == 0, done.stderr
    seen = json.loads(done.stdout.splitlines()[0])
    assert seen["headless"]["plates"] >= 4
    assert seen["headless"]["files"] > seen["headless"]["plates"]
    assert seen["window"]["commands"] > 20
    (archive,) = (tmp_path / "one").glob("BendTorsion-*.zip")
    with zipfile.ZipFile(archive) as opened:
        names = opened.namelist()
        assert opened.testzip() is None
    assert {"BendTorsion/InitGui.py", "BendTorsion/package.xml", "BendTorsion/LICENSE"} <= set(
        names
    )
    assert all(name.startswith("BendTorsion/") and ".." not in name for name in names)
    assert not [name for name in names if "/tests/" in name or "__pycache__" in name]
