# SPDX-License-Identifier: LGPL-2.1-or-later
"""A document exported is the package of its schedule, preparations and site too."""

import FreeCAD
import openpyxl
import pytest
from package_build import SITE, rows

from BendTorsionWB.document_export import (
    export_document,
    records_of,
    source_records,
    write_figures,
)


@pytest.fixture(scope="module")
def exported(built, tmp_path_factory):
    """The folder of a build and that of the export of its document."""
    _, out, _ = built
    target = tmp_path_factory.mktemp("exported")
    result = export_document(out / "model.FCStd", target, workers=1)
    assert not result.failed
    return out, target


def names(folder):
    return {
        str(path.relative_to(folder))
        for path in folder.rglob("*")
        if path.is_file() and ".cache" not in path.parts and not path.name.startswith(".")
    }


def test_every_file_of_the_build_is_there_and_the_same_to_the_byte(exported):
    out, target = exported
    of_schedule = {"model.FCStd", "timing.json"}
    assert names(out) - names(target) <= of_schedule and not names(target) - names(out)
    common = names(target) - {"report.html", "README.txt"}
    assert {"model.step", "model.ifc", "results.xlsx", "report.json", "nesting.csv"} <= common
    differing = [n for n in sorted(common) if (out / n).read_bytes() != (target / n).read_bytes()]
    assert differing == []
    # Both name the files of their folder; the export holds no FreeCAD document.
    for name in ("report.html", "README.txt"):
        one, other = (
            (folder / name).read_text(encoding="utf-8").splitlines() for folder in exported
        )
        assert [line for line in one if "model.FCStd" not in line] == other


def test_preparations_and_site_of_a_document_reach_its_tables(exported, tmp_path):
    out, target = exported
    # The same table without a folder, as the command report writes it.
    alone = tmp_path / "figures.xlsx"
    write_figures(source_records(out / "model.FCStd"), alone)
    for path in (target / "results.xlsx", alone):
        book = openpyxl.load_workbook(path, data_only=True)
        backed = [row for row in rows(book["Welds"]) if row["backing"]]
        assert {(row["angle"], row["land"], row["gap"]) for row in backed} == {(40.0, 4.0, 4.0)}
        row = rows(book["Control"])[0]
        assert row["site_z"] == pytest.approx(row["z"] + SITE["site_z"])
        turned = row["x"] * 3**0.5 / 2 - row["y"] / 2 + SITE["site_x"]
        assert row["site_x"] == pytest.approx(turned)


def test_members_of_a_document_that_run_through_each_other_are_refused_by_name(tmp_path):
    from test_build import short

    from BendTorsionWB import make

    document = FreeCAD.newDocument("crossing", hidden=True)
    try:
        surface = make.make_surface(document, "Hall", a=40000, b=30000, c=20000)
        section = make.make_section(document, "S", h=400, b=400, t=12)
        for name, shift in (("M1", 0.0), ("M2", 100.0)):
            axis = make.make_axis(document, f"A{name}", surface, short(0.02, 0.1, shift))
            plates = make.make_plates(document, make.make_member(document, name, axis, [section]))
            make.make_unfold(document, plates)
        document.recompute()
        found = records_of(document)
        told = [(f.code, f.objects) for f in found.findings if f.severity == "error"]
        assert told == [("node-unresolved", ("M1", "M2"))]
        assert not any(record.plates for record in found.records.values())
        assert [(node.through, node.other, node.status) for node in found.nodes] == [
            ("M1", "M2", "node-unresolved")
        ]
        alone = records_of(document, ["M1"])
        assert alone.records["M1"].plates and not alone.findings
    finally:
        FreeCAD.closeDocument(document.Name)
