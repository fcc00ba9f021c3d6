# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes the add-on archive of a release and tries it, installed in a clean FreeCAD user folder.

`make release` writes build/release/BendTorsion-VERSION.zip, to be unpacked into FreeCAD's Mod
folder, and refuses when the checkout has changes that are not committed or its versions differ.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
import textwrap
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PRODUCT = (
    *("Init.py", "InitGui.py", "BendTorsionWB", "resources", "docs", "package.xml"),
    *("README.md", "CHANGELOG.md", "LICENSE"),
)
TIME_LIMIT = 300

HEADLESS = """
import json, os
from pathlib import Path
import FreeCAD
import BendTorsionWB
from BendTorsionWB import document_export, document_templates
from BendTorsionWB.sheets.pdf import start_qt

start_qt()
out = Path(os.environ["RELEASE_RESULT"]).parent
document_templates.new_document("member", out / "member.FCStd")
result = document_export.export_document(out / "member.FCStd", out / "files")
Path(os.environ["RELEASE_RESULT"]).write_text(json.dumps({
    "from": BendTorsionWB.__file__,
    "version": BendTorsionWB.__version__,
    "failed": bool(result.failed),
    "plates": sum(len(record.plates) for record in result.records),
    "files": sum(path.is_file() for path in (out / "files").rglob("*")),
}))
"""

WINDOW = """
import json, os
from pathlib import Path
import FreeCADGui
import BendTorsionWB

FreeCADGui.activateWorkbench("BendTorsionWorkbench")
Path(os.environ["RELEASE_RESULT"]).write_text(json.dumps({
    "from": BendTorsionWB.__file__,
    "active": FreeCADGui.activeWorkbench().name(),
    "commands": sum(name.startswith("BendTorsion_") for name in FreeCADGui.listCommands()),
}))
os._exit(0)
"""

# The start page is a web view: slow, and no part of what is tried.
SETTINGS = """<?xml version="1.0" encoding="UTF-8" standalone="no" ?>
<FCParameters><FCParamGroup Name="Root"><FCParamGroup Name="BaseApp">
<FCParamGroup Name="Preferences">
<FCParamGroup Name="General"><FCText Name="AutoloadModule">PartWorkbench</FCText></FCParamGroup>
</FCParamGroup></FCParamGroup></FCParamGroup></FCParameters>
"""


def version():
    """The version, the same in the package, the manifest and the change log, or SystemExit."""
    package = (ROOT / "BendTorsionWB" / "__init__.py").read_text(encoding="utf-8")
    manifest = ElementTree.parse(ROOT / "package.xml").getroot()
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    found = {
        "BendTorsionWB/__init__.py": re.search(r'__version__ = "([^"]+)"', package).group(1),
        "package.xml": manifest.findtext("{https://wiki.freecad.org/Package_Metadata}version"),
        "CHANGELOG.md": re.search(r"^## (\S+)", changes, re.M).group(1),
    }
    if len(set(found.values())) > 1:
        sys.exit(f"versions differ: {found}")
    return found["package.xml"]


def product_files():
    """The files of the archive: those of the product that git keeps or would, in order."""
    listed = subprocess.run(
        ["git", "ls-files", "-co", "--exclude-standard", "-z", "--", *PRODUCT],
        cwd=ROOT,
        capture_output=True,
        check=True,
    ).stdout.decode("utf-8")
    return sorted(name for name in listed.split("\0") if name and (ROOT / name).is_file())


def make_archive(path):
    """Write the archive; same files, same bytes."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(path, "w") as archive:
        for name in product_files():
            entry = zipfile.ZipInfo(f"BendTorsion/{name}")
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, (ROOT / name).read_bytes())


def run(home, command, script):
    """What a script of the installed add-on writes, run with a user folder of its own."""
    result, source = home / "result.json", home / "try.py"
    result.unlink(missing_ok=True)
    # FreeCAD runs a script that failed a second time: the first fault is the one to see.
    source.write_text(
        "try:\n"
        + textwrap.indent(script, "    ")
        + "except Exception:\n"
        + "    import os, traceback\n"
        + "    traceback.print_exc()\n"
        + "    os._exit(1)\n",
        encoding="utf-8",
    )
    environment = {
        **os.environ,
        "HOME": str(home),
        "XDG_DATA_HOME": str(home / "share"),
        "XDG_CONFIG_HOME": str(home / "config"),
        "XDG_RUNTIME_DIR": str(home),
        "FREECAD_USER_HOME": str(home / "freecad"),
        "PYTHONPATH": "",
        "QTWEBENGINE_DISABLE_SANDBOX": "1",
        "RELEASE_RESULT": str(result),
    }
    environment.pop("QT_QPA_PLATFORM", None)
    done = subprocess.run(
        [*command, str(source)],
        env=environment,
        cwd=home,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=TIME_LIMIT,
        encoding="utf-8",
        errors="replace",
        check=False,
    )
    if not result.is_file():
        sys.exit(f"{' '.join(command)} wrote no result:\n{done.stdout[-4000:]}")
    return json.loads(result.read_text(encoding="utf-8"))


def try_archive(path, expected):
    """Install the archive as a user does and use it, without and with a window; what was seen."""
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        home.chmod(0o700)
        mod = home / "freecad" / "Mod"
        mod.mkdir(parents=True)
        (home / "freecad" / "user.cfg").write_text(SETTINGS, encoding="utf-8")
        with zipfile.ZipFile(path) as archive:
            archive.extractall(mod)
        seen = {
            "headless": run(home, ["freecadcmd"], HEADLESS),
            "window": run(
                home, ["xvfb-run", "-a", "-s", "-screen 0 1280x800x24", "freecad"], WINDOW
            ),
        }
        for how, what in seen.items():
            if not Path(what.pop("from")).is_relative_to(mod):
                sys.exit(f"{how}: another installation of BendTorsion was used")
    headless, window = seen["headless"], seen["window"]
    if headless["version"] != expected or headless["failed"] or not headless["plates"]:
        sys.exit(f"the installed add-on does not work headless: {headless}")
    if window["active"] != "BendTorsionWorkbench" or not window["commands"]:
        sys.exit(f"the installed add-on does not work in the window: {window}")
    return seen


def main():
    """Make the archive and try it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "release")
    parser.add_argument(
        "--uncommitted", action="store_true", help="take the files as they lie, committed or not"
    )
    options = parser.parse_args()
    changed = subprocess.run(
        ["git", "status", "--porcelain"], cwd=ROOT, capture_output=True, check=True
    ).stdout
    if changed and not options.uncommitted:
        sys.exit("there are changes that are not committed: commit them first")
    name = version()
    path = options.out / f"BendTorsion-{name}.zip"
    make_archive(path)
    seen = try_archive(path, name)
    print(json.dumps(seen))
    print(f"{path}: {len(product_files())} files, {path.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
