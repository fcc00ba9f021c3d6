# SPDX-License-Identifier: LGPL-2.1-or-later
"""One number, one value: workbook, report.json, lists, cut files and sheets, each read back."""

import csv
import io
import json
import re
import subprocess
from collections import Counter

import ezdxf
import openpyxl
import pytest
from package_build import rows

# Fields of report.json and columns of sheet Plates that say the same.
PLATE = {
    "part": "part",
    "face": "face",
    "piece": "piece",
    "thickness_mm": "thickness",
    "material": "material",
    "area_mm2": "net_area",
    "mass_kg": "net_mass",
    "length_mm": "length",
    "width_mm": "width",
    "gross_length_mm": "gross_length",
    "gross_width_mm": "gross_width",
    "gross_area_mm2": "gross_area",
    "gross_mass_kg": "gross_mass",
    "length_error_max_mm": "length_error_max",
    "length_error_bound_mm": "length_error_bound",
    "edge_error_mm": "edge_error",
    "line_error_mm": "line_error",
    "diagonal_error_mm": "diagonal_error",
    "centre_line_error_mm": "centre_line_error",
    "area_error_mm2": "area_error",
    "seam_mismatch_mm": "seam_mismatch",
    "locked_in_stress_mpa": "locked_in_stress",
    "strain_max": "strain_max",
    "forming": "forming",
    "painted_area_mm2": "painted_area",
    "dxf": "dxf",
    "nc1": "nc1",
}
MEMBER = {
    "length_mm": "length",
    "mass_kg": "mass",
    "axis_to_surface_rms_mm": "axis_to_surface_rms",
    "axis_to_surface_max_mm": "axis_to_surface_max",
    "torsion_error_max_deg": "torsion_error_max",
    "total_torsion_deg": "total_torsion",
    "painted_area_mm2": "painted_area",
}


@pytest.fixture(scope="module")
def read_back(built):
    """The folder, report.json, and the rows of every sheet of the workbook."""
    _, out, _ = built
    book = openpyxl.load_workbook(out / "results.xlsx", data_only=True)
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    return out, report, {sheet.title: rows(sheet) for sheet in book}


def plates(report):
    return {plate["mark"]: plate for member in report["members"] for plate in member["plates"]}


def test_report_and_workbook_hold_the_same_figures(read_back):
    _, report, sheets = read_back
    by_mark = {row["plate"]: row for row in sheets["Plates"]}
    known = plates(report)
    assert set(by_mark) == set(known)
    for mark, plate in known.items():
        assert {f: plate[f] for f in PLATE} == {f: by_mark[mark][c] for f, c in PLATE.items()}
        centre = [by_mark[mark][f"centre_{axis}"] for axis in "xyz"]
        assert plate["centre_of_gravity_mm"] == centre
    by_name = {row["member"]: row for row in sheets["Summary"]}
    for member in report["members"]:
        row = by_name[member["member"]]
        assert {f: member[f] for f in MEMBER} == {f: row[c] for f, c in MEMBER.items()}
        assert row["plates"] == len(member["plates"])
    checks = [{k: v or None for k, v in row.items()} for row in sheets["Checks"]]
    assert checks == [{k: v or None for k, v in f.items()} for f in report["findings"]]


def test_lists_agree_with_the_plates_they_count(read_back):
    out, report, sheets = read_back
    known = plates(report)
    cutting = {row["part"]: row for row in sheets["Cutting"]}
    quantities = Counter(plate["part"] for plate in known.values())
    assert {part: row["quantity"] for part, row in cutting.items()} == quantities
    text = (out / "nesting.csv").read_bytes().decode("utf-8-sig")
    for row in csv.DictReader(io.StringIO(text)):
        own = cutting[row["part"]]
        assert int(row["quantity"]) == own["quantity"] and row["marks"] == own["marks"]
        assert row["marks"].split()[0] == row["part"] and row["dxf"] == own["dxf"]
        assert float(row["length"]) == pytest.approx(own["length"], abs=0.051)
        assert float(row["mass"]) == pytest.approx(own["gross_mass"], abs=0.0051)
        assert row["material"] == own["material"]
    for kind, field in (("net", "mass_kg"), ("gross", "gross_mass_kg")):
        total = sum(row[f"{kind}_mass"] for row in sheets["CuttingTotals"])
        assert total == pytest.approx(sum(plate[field] for plate in known.values()), rel=1e-12)


def test_cut_files_are_as_large_as_the_lists_say_and_points_are_those_of_the_table(read_back):
    out, report, sheets = read_back
    points = {}
    for row in sheets["Points"]:
        if row["kind"] == "arris":
            points.setdefault(row["plate"], []).append((row["flat_u"], row["flat_v"]))
    scales = {row["plate"]: row for row in sheets["Plates"]}
    for mark, plate in plates(report).items():
        header = (out / plate["nc1"]).read_bytes().decode("ascii").split("\r\n")[1:25]
        assert header[3].strip() == mark and header[0].strip() == "Hall"
        drawing = ezdxf.readfile(out / plate["dxf"])
        high = drawing.header["$EXTMAX"][:2]
        for size, text, name in zip(high, header[8:10], ("length", "width"), strict=True):
            assert float(text) == pytest.approx(size, abs=0.0051)
            assert size == pytest.approx(plate[f"gross_{name}_mm"], abs=0.02)
        places = [p.dxf.location for p in drawing.modelspace().query('POINT[layer=="REF"]')]
        # The table has net coordinates, the file the gross pattern's: scaled, and moved alike.
        row = scales[mark]
        moves = [
            (at.x - u * row["scale_u"], at.y - v * row["scale_v"])
            for at, (u, v) in zip(places, points.get(mark, ()), strict=True)
        ]
        spread = [max(m[k] for m in moves) - min(m[k] for m in moves) for k in (0, 1) if moves]
        assert all(value <= 0.002 for value in spread), mark


@pytest.mark.external("pdftotext")
def test_plate_drawings_print_the_sizes_and_masses_of_the_table(read_back):
    out, report, _ = read_back
    size = re.compile(r"(net|gross) (\d+\.\d) × (\d+\.\d) mm, (\d+\.\d) kg")
    for member in report["members"]:
        path = out / "sheets" / f"{member['member']}.pdf"
        command = ["pdftotext", "-layout", path, "-"]
        text = subprocess.run(command, capture_output=True, encoding="utf-8", timeout=120).stdout
        printed = Counter(size.findall(text))
        for plate in member["plates"]:
            net = [plate[name] for name in ("length_mm", "width_mm", "mass_kg")]
            gross = [plate[f"gross_{name}"] for name in ("length_mm", "width_mm", "mass_kg")]
            for kind, values in (("net", net), ("gross", gross)):
                assert printed[(kind, *(f"{value:.1f}" for value in values))], plate["mark"]
