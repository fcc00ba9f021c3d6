# SPDX-License-Identifier: LGPL-2.1-or-later
"""The support bundle: complete, readable, and without names of users, machines and folders."""

import getpass
import json
import socket
import zipfile
from pathlib import Path

import openpyxl
import pytest
from schedule_books import GOOD, write

from BendTorsionWB import support
from BendTorsionWB.__main__ import main


@pytest.fixture(scope="module")
def bundle(tmp_path_factory):
    """{name: text} of the bundle of a schedule that has a path of a user in a cell."""
    folder = tmp_path_factory.mktemp("someone private")
    book = openpyxl.load_workbook(write(folder / "schedule.xlsx", GOOD))
    book.properties.creator = "A. Person"
    book["Settings"].append(["drawing", "/home/somebody private/hall/site plan.dxf"])
    book["Settings"].append(["author", "Jane Q. Doe"])
    book["Settings"].append(["note of Jane Q. Doe", "ask j.doe+steel@firm.example, please"])
    book.save(folder / "schedule.xlsx")
    out = folder / "support.zip"
    assert main(["support", str(folder / "schedule.xlsx"), "--out", str(out)]) == 0
    with zipfile.ZipFile(out) as archive:
        return {name: archive.read(name).decode("utf-8") for name in archive.namelist()}


def test_it_holds_versions_preferences_findings_and_tables(bundle):
    """Everything a report needs is there."""
    versions = json.loads(bundle["versions.json"])
    assert {"BendTorsion", "FreeCAD", "Open CASCADE", "numpy", "system"} <= set(versions)
    assert isinstance(json.loads(bundle["preferences.json"]), dict)
    assert "Settings" in bundle["findings.txt"]
    assert bundle["schedule/Members.csv"].count("\n") >= 2


def test_nothing_in_it_names_a_place_or_a_person(bundle):
    """Neither folders nor authors, and the file's own name stays."""
    whole = "\n".join(bundle.values())
    gone = ("somebody", "private", "A. Person", "Jane", "firm.example", "doe")
    for private in (*gone, str(Path.home()) + "/"):
        assert private not in whole
    assert "site plan.dxf" in bundle["schedule/Settings.csv"]
    assert "author,author" in bundle["schedule/Settings.csv"]


@pytest.mark.parametrize(
    ("text", "left"),
    [
        ("read /home/ann/a b/roof.step: bad", "read roof.step: bad"),
        (r"C:\Users\Ann\roof.step", "roof.step"),
        (r"\\server\share\roof.step,1", "roof.step,1"),
        ("file:///home/ann/roof.step", "roof.step"),
        ("~/steel/roof.step", "roof.step"),
        ("4 m/s, 3/4 of M1/T, 12.5 mm", "4 m/s, 3/4 of M1/T, 12.5 mm"),
        ("shapes/roof.step", "shapes/roof.step"),
    ],
)
def test_paths_are_cut_to_their_last_part(text, left):
    """Absolute paths of any system lose their folders; fractions and relative paths stay."""
    assert support.without_places(text) == left


def test_user_and_machine_are_not_named():
    """Their names are replaced where they stand as words."""
    for name in (getpass.getuser(), socket.gethostname()):
        if len(name) >= 3:
            assert name not in support.without_places(f"by {name}.").split(" ", 1)[1]


def test_a_source_that_cannot_be_read_is_told_in_the_bundle(tmp_path):
    """The bundle is written all the same."""
    (tmp_path / "no.xlsx").write_bytes(b"no workbook")
    names = support.write_bundle(tmp_path / "support.zip", tmp_path / "no.xlsx")
    with zipfile.ZipFile(tmp_path / "support.zip") as archive:
        assert "not an Excel workbook" in archive.read("findings.txt").decode()
        assert set(archive.namelist()) == set(names)


def test_whoever_drew_it_is_named_in_no_table_and_no_preference(tmp_path, monkeypatch):
    """Names of two letters, too; the letter of a face stays."""
    monkeypatch.setattr(support, "preferences", lambda: {"Author": "John Roe"})
    names = support.write_bundle(tmp_path / "support.zip")
    with zipfile.ZipFile(tmp_path / "support.zip") as archive:
        whole = "".join(archive.read(name).decode() for name in names)
    assert "Roe" not in whole and '"Author": "author"' in whole
    assert support.without_persons("李明, M1-T3, T", ["李明", "T"]) == "author, M1-T3, T"
