# SPDX-License-Identifier: LGPL-2.1-or-later
"""Our files as programs we did not write read them; scripts/install-checkers.sh installs these.

Where one is not installed its tests are left out, and named at the end.
"""

import csv
import json
import subprocess

import numpy as np
import openpyxl
import pytest
from checkers import ask
from package_build import SITE, plates_of

from BendTorsionWB.core.colour_scale import FACE_COLOURS
from BendTorsionWB.exchange.dxf_bevels import edge_texts

QUANTITIES = (
    ("Width", "thickness_mm", 1.0),
    ("NetArea", "area_mm2", 1e-6),
    ("GrossArea", "gross_area_mm2", 1e-6),
    ("NetWeight", "mass_kg", 1.0),
    ("GrossWeight", "gross_mass_kg", 1.0),
)
"""Quantity of IFC, field of report.json, and its unit in that of IFC."""


@pytest.mark.external("ifcopenshell")
def test_ifc_is_valid_by_its_schema_and_rules_and_holds_every_plate(built):
    _, out, result = built
    found = ask("read_ifc", out / "model.ifc")
    assert found["schema"] == "IFC4" and found["faults"] == []
    plates = {plate.mark: plate for plate in plates_of(result)}
    assert set(found["plates"]) == set(plates)
    assert found["assemblies"] == len(result.records)
    assert found["site"] == pytest.approx([SITE["site_x"], SITE["site_y"], SITE["site_z"]])
    assert len({own["id"] for own in found["plates"].values()}) == len(plates)
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    told = {own["mark"]: own for member in report["members"] for own in member["plates"]}
    for mark, own in found["plates"].items():
        quantities = own["quantities"]
        for name, field, factor in QUANTITIES:
            assert quantities[name] == pytest.approx(told[mark][field] * factor, rel=1e-12)
        texts = own["properties"]["EdgePreparations"]
        assert texts == edge_texts(plates[mark]) and (" deg " in texts) == bool(plates[mark].bevels)
        assert own["properties"]["MarkingFace"] == "inside"
    volumes = ask("read_ifc_volumes", out / "model.ifc")
    for mark, own in found["plates"].items():
        assert own["assembly"] == plates[mark].member and own["material"] == "S355"
        assert own["weight"] == pytest.approx(plates[mark].mass)
        # Their kernel measures volumes of curved plates on facets.
        assert volumes[mark] == pytest.approx(plates[mark].volume * 1e-9, rel=2e-3)


@pytest.mark.external("OCP")
def test_step_is_read_by_another_kernel_with_names_colours_and_volumes(built):
    _, out, result = built
    found = ask("read_step", out / "model.step")
    plates = {plate.mark: plate for plate in plates_of(result)}
    assert {own["name"] for own in found["solids"]} == set(plates)
    assert set(found["assemblies"]) >= {"M1", "M2"}
    for own in found["solids"]:
        plate = plates[own["name"]]
        assert own["solids"] == 1 and own["valid"]
        assert own["volume"] == pytest.approx(plate.volume, rel=1e-5)
        linear = [((c + 0.055) / 1.055) ** 2.4 for c in FACE_COLOURS[plate.letter]]
        assert own["colour"] == pytest.approx(linear, abs=2e-3)


@pytest.mark.external("librecad", "pdftotext")
def test_librecad_draws_the_cut_files(built, tmp_path):
    _, out, result = built
    plate = plates_of(result)[0]
    for path in (out / "plates" / f"{plate.mark}.dxf", out / "plates/all/16mm S355.dxf"):
        local = tmp_path / path.name.replace(" ", "_")
        local.write_bytes(path.read_bytes())
        command = ["librecad", "dxf2pdf", "-a", "-m", "-p", "420x297", local.name]
        run_quietly(command, tmp_path)
        picture = tmp_path / "page"
        subprocess.run(
            ["pdftoppm", "-r", "60", "-gray", "-singlefile", local.with_suffix(".pdf"), picture],
            check=True,
            timeout=120,
        )
        # A portable graymap: three lines of text, then a byte per pixel.
        shade = np.frombuffer(picture.with_suffix(".pgm").read_bytes().split(b"\n", 3)[3], np.uint8)
        assert (shade < 128).mean() > 0.002


def run_quietly(command, folder):
    """Run a Qt program without a screen, with a home of its own."""
    environment = {"PATH": "/usr/bin:/bin", "HOME": str(folder), "QT_QPA_PLATFORM": "offscreen"}
    process = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, encoding="utf-8", timeout=300
    )
    assert process.returncode == 0, process.stderr[-2000:]


@pytest.mark.external("soffice")
def test_libreoffice_opens_the_workbook_with_equal_numbers(built, tmp_path):
    _, out, _ = built
    # All sheets, unformatted, comma separated, UTF-8.
    form = "csv:Text - txt - csv (StarCalc):44,34,76,1,,0,false,false,false,false,false,-1"
    command = ["soffice", "--headless", "--convert-to", form, "--outdir", str(tmp_path)]
    run_quietly([*command, str(out / "results.xlsx")], tmp_path)
    book = openpyxl.load_workbook(out / "results.xlsx", data_only=True)
    for sheet in book:
        path = tmp_path / f"results-{sheet.title}.csv"
        read = list(csv.reader(path.read_text(encoding="utf-8").splitlines()))
        for given, own in zip(sheet.iter_rows(values_only=True), read, strict=False):
            for value, text in zip(given, own, strict=False):
                if isinstance(value, int | float):
                    assert float(text) == pytest.approx(value, rel=1e-12)
                else:
                    assert text == (value or "")


@pytest.mark.external("pdftotext")
def test_sheets_are_searchable_by_every_mark(built):
    _, out, result = built
    for record in result.records:
        path = out / "sheets" / f"{record.member}.pdf"
        text = subprocess.run(
            ["pdftotext", path, "-"], capture_output=True, encoding="utf-8", timeout=120
        ).stdout
        assert all(plate.mark in text for plate in record.plates)
