# SPDX-License-Identifier: LGPL-2.1-or-later
"""Members without flat patterns are left out of a package, and every one who gets it is told."""

import json

import FreeCAD
import openpyxl
import pytest
from package_build import rows

from BendTorsionWB import make
from BendTorsionWB.__main__ import main
from BendTorsionWB.document_export import records_of
from BendTorsionWB.exchange.folder_guide import left_out

TOLD = "member-without-patterns"


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """A document of four members: whole, without plates, with plates, with one of two laid flat."""
    document = FreeCAD.newDocument("LeftOut", hidden=True)
    ground = make.make_surface(document, "Ground", "plane")
    section = make.make_section(document, "B", h=500, b=400, t=12)
    for k in range(1, 5):
        ends = [(0, 3000 * k, 0), (2500, 3000 * k, 0)]
        axis = make.make_axis(document, f"A{k}", ground, ends)
        member = make.make_member(document, f"M{k}", axis, [section])
        plates = [make.make_plates(document, member) for _ in range({1: 1, 2: 0, 3: 1, 4: 2}[k])]
        if k in (1, 4):
            make.make_unfold(document, plates[0])
    document.recompute()
    path = tmp_path_factory.mktemp("left_out") / "four.FCStd"
    document.saveAs(str(path))
    FreeCAD.closeDocument(document.Name)
    return path


@pytest.fixture
def document(path):
    """The document, open."""
    document = FreeCAD.openDocument(str(path), hidden=True)
    yield document
    FreeCAD.closeDocument(document.Name)


def test_each_is_told_of_with_what_it_lacks(document):
    given = records_of(document)
    assert set(given.records) == {"M1", "M4"}
    found = [f for f in given.findings if f.code in (TOLD, "plates-without-patterns")]
    assert {f.severity for f in found} == {"warning"}
    assert [f.object for f in found if f.code == TOLD] == ["M2", "M3"]
    bare, unlaid, second = found
    assert "no plates" in bare.message and "Plates" in bare.mend
    assert "laid flat" in unlaid.message and "Development" in unlaid.mend
    assert second.object.startswith("M4 plates") and "M4" in second.message


def test_of_members_that_were_not_asked_for_nothing_is_told(document):
    assert records_of(document, ["M1"]).findings == ()


def test_a_document_with_all_its_patterns_leaves_nobody_out(document):
    for obj in list(document.Objects):
        if getattr(obj, "BT_Type", "") in ("Member", "PlateSet") and obj.Label[:2] in ("M2", "M3"):
            document.removeObject(obj.Name)
    document.removeObject(document.getObjectsByLabel("M4 plates001")[0].Name)
    given = records_of(document)
    assert given.findings == () and left_out(given.records.values(), given.findings) == []


def test_console_report_workbook_and_readme_of_a_package_name_them(path, tmp_path, capsys):
    out = tmp_path / "out"
    given = ["export", str(path), "--out", str(out), "--no-sheets", "--jobs", "1"]
    assert main(given) == 0
    told = capsys.readouterr().err
    assert "warning: M2: has no plates" in told and "warning: M3: its plates" in told
    found = json.loads((out / "report.json").read_text(encoding="utf-8"))["findings"]
    assert [f["object"] for f in found if f["code"] == TOLD] == ["M2", "M3"]
    assert "has no plates, so that it is in no file" in (out / "report.html").read_text(
        encoding="utf-8"
    )
    book = openpyxl.load_workbook(out / "results.xlsx", data_only=True)
    assert {row["object"] for row in rows(book["Checks"]) if row["code"] == TOLD} == {"M2", "M3"}
    readme = (out / "README.txt").read_text(encoding="utf-8")
    head = readme.partition("report.html")[0]
    assert "NOT in this package:" in head and "M2: has no plates" in head and "M3: its" in head
    assert max(map(len, readme.splitlines())) <= 110
    assert main(["report", str(path), "--jobs", "1"]) == 0
    assert "warning: M2: has no plates" in capsys.readouterr().err
