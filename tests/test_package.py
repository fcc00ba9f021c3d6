# SPDX-License-Identifier: LGPL-2.1-or-later
"""The checkout as a package: FreeCAD's manifest, icons, licence headers and the install script."""

import ast
import os
import re
import socket
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

import BendTorsionWB

ROOT = Path(__file__).resolve().parent.parent
NAMES = {"p": "https://wiki.freecad.org/Package_Metadata"}
ICON_LIMIT = 10 * 1024
PYTHON_FILES = sorted(
    path
    for top in ROOT.iterdir()
    if top.name not in ("build", ".git")
    for path in ([top] if top.is_file() else top.rglob("*"))
    if path.suffix == ".py" and "build" not in path.relative_to(ROOT).parts
)
BY_FREECAD = {
    *("FreeCAD", "FreeCADGui", "Part", "TechDraw", "TechDrawGui", "Import", "PySide", "PySide2"),
    *("Mesh", "MeshPart", "Spreadsheet", "PySide6", "shiboken2", "shiboken6", "pivy"),
}
OPTIONAL = {"rhino3dm"}
"""Imported where they are used, with one line that says how to install them."""


@pytest.fixture(scope="module")
def manifest():
    """package.xml, parsed."""
    return ElementTree.parse(ROOT / "package.xml").getroot()


def values(element, path):
    """Texts of the manifest elements at `path`."""
    return [found.text for found in element.findall(path, NAMES)]


def test_one_version_everywhere(manifest):
    """Package, manifest and the newest entry of the change log name the same version."""
    newest = re.search(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.M)
    assert values(manifest, "p:version") == [BendTorsionWB.__version__]
    assert newest.group(1) == BendTorsionWB.__version__


def test_the_manifest_is_complete(manifest):
    """Everything FreeCAD's addon index asks for is there, and the files it names exist."""
    for name in ("name", "description", "date", "maintainer", "author", "freecadmin", "pythonmin"):
        assert all(values(manifest, f"p:{name}")) and values(manifest, f"p:{name}"), name
    assert values(manifest, "p:license") == ["LGPL-2.1-or-later"]
    assert (ROOT / manifest.find("p:license", NAMES).get("file")).exists()
    urls = {url.get("type") for url in manifest.findall("p:url", NAMES)}
    assert urls >= {"repository", "bugtracker", "readme", "documentation"}
    workbench = manifest.find("p:content/p:workbench", NAMES)
    for icon in values(manifest, "p:icon") + values(workbench, "p:icon"):
        assert (ROOT / icon).exists()
    assert 3 <= len(values(workbench, "p:tag")) <= 7
    script = ast.parse((ROOT / "InitGui.py").read_text(encoding="utf-8"))
    classes = [node.name for node in script.body if isinstance(node, ast.ClassDef)]
    assert values(workbench, "p:classname") == classes


def test_freecad_reads_the_manifest():
    """FreeCAD's own reader finds the same name, version and workbench class."""
    import FreeCAD

    metadata = FreeCAD.Metadata(str(ROOT / "package.xml"))
    assert metadata.Name == "BendTorsion"
    assert metadata.Version == BendTorsionWB.__version__
    (workbench,) = metadata.Content["workbench"]
    assert workbench.Classname == "BendTorsionWorkbench"
    assert workbench.supportsCurrentFreeCAD()


def test_every_library_used_is_declared_and_installed(manifest):
    """What the package imports from outside is in the manifest and in the install script."""
    used = set()
    for path in (ROOT / "BendTorsionWB").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                used |= {alias.name.split(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and not node.level:
                used.add(node.module.split(".")[0])
    outside = used - set(sys.stdlib_module_names) - BY_FREECAD - OPTIONAL - {"BendTorsionWB"}
    assert outside <= set(values(manifest, "p:depend"))
    script = (ROOT / "scripts" / "install-debian.sh").read_text(encoding="utf-8")
    for library in values(manifest, "p:depend"):
        assert f"python3-{library}" in script


@pytest.mark.parametrize("path", sorted((ROOT / "resources" / "icons").glob("*.svg")), ids=str)
def test_icons_are_small_svg_drawings(path):
    """Each icon is an SVG with a view box, no larger than the addon index allows."""
    root = ElementTree.parse(path).getroot()
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert root.get("viewBox") == "0 0 64 64"
    assert path.stat().st_size <= ICON_LIMIT


def test_every_source_file_names_its_licence():
    """The first line of each Python file is the licence, and a docstring says what it owns."""
    for path in PYTHON_FILES:
        text = path.read_text(encoding="utf-8")
        assert text.startswith("# SPDX-License-Identifier: LGPL-2.1-or-later\n"), path
        if path.name != "__init__.py":
            assert ast.get_docstring(ast.parse(text)), f"{path} has no docstring"


@pytest.fixture
def machine(tmp_path):
    """Runs the install script against stand-ins for dpkg-query, apt-get, id and sudo.

    Returns run(installed, user, sudo, debian) -> (process, the apt-get calls it made).
    """

    def stand_in(name, body):
        path = tmp_path / "bin" / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"#!/bin/sh\n{body}\n", encoding="utf-8")
        path.chmod(0o755)

    def run(installed=(), user=0, sudo=False, debian=True, apt_fails=False):
        log = tmp_path / "apt.log"
        cases = "".join(f"    {name}) echo installed ;;\n" for name in installed)
        if debian:
            stand_in("dpkg-query", f'case "$4" in\n{cases}    *) exit 1 ;;\nesac')
        stand_in("apt-get", f'echo "$@" >> {log}\nexit {int(apt_fails)}')
        stand_in("id", f"echo {user}")
        if sudo:
            stand_in("sudo", '"$@"')
        stand_in("env", 'shift\n"$@"')
        process = subprocess.run(
            ["/bin/sh", str(ROOT / "scripts" / "install-debian.sh")],
            env={"PATH": str(tmp_path / "bin")},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            encoding="utf-8",
            timeout=30,
            check=False,
        )
        return process, log.read_text(encoding="utf-8").splitlines() if log.exists() else []

    return run


def wanted_packages():
    """The package names in the install script."""
    script = (ROOT / "scripts" / "install-debian.sh").read_text(encoding="utf-8")
    return re.search(r'packages="([^"]*)"', script).group(1).split()


def test_nothing_missing_installs_nothing_and_says_nothing(machine):
    process, calls = machine(installed=wanted_packages())
    assert (process.returncode, process.stdout, process.stderr, calls) == (0, "", "", [])


def test_only_what_is_missing_is_installed(machine):
    missing = {"xvfb", "python3-ezdxf"}
    process, calls = machine(installed=set(wanted_packages()) - missing)
    assert process.returncode == 0
    assert calls[0].startswith("update")
    assert calls[1].startswith("install -y --no-install-recommends")
    assert set(calls[1].split()) & set(wanted_packages()) == missing


def test_a_user_with_sudo_installs_through_it(machine):
    process, calls = machine(user=1000, sudo=True)
    assert process.returncode == 0
    assert len(calls) == 2


def test_a_missing_privilege_is_named_in_one_line(machine):
    process, calls = machine(installed=set(wanted_packages()) - {"xvfb"}, user=1000)
    assert process.returncode != 0
    assert calls == []
    (line,) = process.stderr.splitlines()
    assert "root" in line
    assert "apt-get install -y --no-install-recommends xvfb" in line


def test_a_failed_installation_is_named_in_one_line(machine):
    process, _ = machine(installed=set(wanted_packages()) - {"xvfb"}, apt_fails=True)
    assert process.returncode != 0
    (line,) = process.stderr.splitlines()
    assert "xvfb" in line


def test_another_system_is_told_what_it_needs(machine):
    process, calls = machine(debian=False)
    assert process.returncode == 0
    assert calls == []
    (line,) = process.stderr.splitlines()
    assert set(wanted_packages()) <= set(line.split())


def test_install_links_the_checkout_into_freecad(tmp_path):
    """`make install` links, links again without harm, and never replaces a real folder."""
    environment = {**os.environ, "FREECAD_USER_HOME": str(tmp_path)}
    command = ["make", "-s", "-C", str(ROOT), "install"]
    link = tmp_path / "Mod" / "BendTorsion"
    for _ in range(2):
        subprocess.run(command, env=environment, check=True, capture_output=True)
        assert link.is_symlink() and link.resolve() == ROOT
    link.unlink()
    link.mkdir()
    refused = subprocess.run(
        command, env=environment, check=False, capture_output=True, encoding="utf-8"
    )
    assert refused.returncode != 0
    assert "not a link" in refused.stderr
    assert link.is_dir() and not link.is_symlink()


def test_tests_use_no_network():
    """What a test connects to is this machine; anything else is refused before it is tried."""
    with socket.socket() as plug, pytest.raises(OSError, match="no network"):
        plug.connect(("192.0.2.1", 80))
