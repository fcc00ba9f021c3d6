# SPDX-License-Identifier: LGPL-2.1-or-later
"""results.xlsx, read back by openpyxl."""

import math
import time
import zipfile
from xml.etree import ElementTree

import openpyxl
import pytest
from flat_plates import annular_sector, member, rectangle, wavy

from BendTorsionWB.core.finding import BendTorsionError, error, note, warning
from BendTorsionWB.exchange.results_workbook import write_results

COLUMNS = {
    "Zones": "member zone group start end length slope d_top d_bottom d_left d_right",
    "Pieces": "member piece start end start_end end_end green_start green_end gap parts mass "
    "centre_x centre_y centre_z",
    "Plates": "member plate part face piece thickness length width net_area net_mass material "
    "length_error_max strain_max forming bending_radius_min dxf nc1 sheet "
    "centre_x centre_y centre_z painted_area gross_length gross_width gross_area gross_mass "
    "scale_u scale_v green_start green_end edge_error line_error diagonal_error "
    "centre_line_error area_error seam_mismatch length_error_bound locked_in_stress",
    "Points": "plate point line edge kind s x y z local_x local_y local_z flat_u flat_v",
    "Lines": "plate line from to length_3d length_flat difference",
    "Panels": "plate panel what flat arc chord_outer",
    "Edges": "plate edge line s neighbour dihedral bevel offset_outer offset_inner widest",
    "Nodes": "node kind through other s_through s_other x y z angle axis_distance type gap "
    "stub_length lands_on step_max step_angle_max diaphragms manhole status",
    "NodeSteps": "node other side face edge through_face step angle in_line",
    "Joints": "member joint face s plate_1 plate_2 thickness_1 thickness_2 length place weld",
    "Welds": "member weld piece kind seam plate_1 plate_2 from to length thickness_1 thickness_2 "
    "dihedral prep type angle land gap depth leg side backing place ndt",
    "Bevels": "plate side edge from to angle_outer depth_outer angle_inner depth_inner land "
    "natural chamfer_slope chamfer_length chamfer_depth chamfer_face angle_opening opening_face "
    "prep weld",
    "Bars": "member bar piece section width thickness length material mass weld",
    "Cutting": "part thickness material quantity length width net_area net_mass gross_area "
    "gross_mass rolling_direction opposite_hand marks dxf stock_length stock_width",
    "CuttingTotals": "thickness material parts plates net_area net_mass gross_area gross_mass",
    "Forming": "plate forming rule value limit unit advice bending_radius_min twist_per_metre "
    "flat_deviation flat_tolerance may_stay_flat strain_max strain_u strain_v locked_in_stress "
    "stress_max stress_u stress_v moment torque corner_force clamp_middle clamp_corner",
    "FormingLines": "plate line kind s u_first v_first u_second v_second radius_first "
    "radius_middle radius_second skew angle direction",
    "Bed": "piece face saddle s left_x left_y left_height right_x right_y right_height slope stop "
    "stop_x stop_y stop_height",
    "Pins": "piece column row x y height tilt",
    "BedFrames": "piece frame x_x x_y x_z x_shift y_x y_y y_z y_shift z_x z_y z_z z_shift",
    "Control": "piece line corner s x y z site_x site_y site_z bed_x bed_y bed_z fabrication_x "
    "fabrication_y fabrication_z normal_x normal_y normal_z measured_x measured_y measured_z",
    "Checks": "severity code object position value limit unit message mend",
}
CLASH = error(
    "clash", "M3", "meets M1", "move one", position="s=100 mm", value=12.5, limit=0.0, unit="mm"
)
RECORDS = (
    member("M1", (rectangle(), annular_sector(bending_radius_min=math.inf))),
    member("M2", (wavy(member="M2", strain_max=math.nan),), findings=(note("n", "M2", "seen"),)),
    member("M3", length=None, mass=None, axis_to_surface_rms=None, findings=(CLASH,)),
)
FINDINGS = (warning("thin", "M1-T1", "is thin"), CLASH)


@pytest.fixture(scope="module")
def book(tmp_path_factory):
    path = tmp_path_factory.mktemp("out") / "results.xlsx"
    write_results(RECORDS, FINDINGS, path, "Hall & <Sons>")
    return openpyxl.load_workbook(path)


def rows(sheet, name="plate"):
    header = [cell.value for cell in sheet[1]]
    return [dict(zip(header, values)) for values in sheet.iter_rows(min_row=2, values_only=True)]


def test_sheets_and_columns_are_those_of_the_contract(book):
    assert book.sheetnames == ["Summary", *COLUMNS]
    for name, columns in COLUMNS.items():
        assert [cell.value for cell in book[name][1]] == columns.split()


def test_every_number_comes_back_equal(book):
    plates = [plate for record in RECORDS for plate in record.plates]
    for row, plate in zip(rows(book["Plates"]), plates, strict=True):
        assert (row["member"], row["plate"], row["piece"]) == (plate.member, plate.mark, 1)
        assert (row["length"], row["width"]) == (plate.length, plate.width)
        assert (row["net_area"], row["net_mass"]) == (plate.area, plate.mass)
        assert row["dxf"] == f"plates/{plate.mark}.dxf"
        assert row["sheet"] == f"sheets/{plate.member}.pdf"
        assert row["nc1"].startswith("nc1/") and row["forming"] is None
    points = [(plate, point) for plate in plates for point in plate.points]
    for row, (plate, point) in zip(rows(book["Points"]), points, strict=True):
        values = list(row.values())
        assert values[:5] == [plate.mark, point.label, point.line, point.edge, point.kind]
        assert values[5:] == [point.s, *point.xyz, *point.local, *point.flat]
    lines = [(plate, line) for plate in plates for line in plate.lines]
    for n, (row, (plate, line)) in enumerate(zip(rows(book["Lines"]), lines, strict=True)):
        assert list(row.values())[:2] == [plate.mark, line.label]
        assert (row["length_3d"], row["length_flat"]) == (line.length_3d, line.length_flat)
        assert row["difference"] == line.length_flat - line.length_3d
        on_line = {p.label for p in plate.points if p.line == line.label and p.kind == "arris"}
        assert {row["from"], row["to"]} == on_line
        if n < 2:
            assert (row["from"], row["to"]) == (f"P-{2 * n + 1}", f"P-{2 * n + 2}")
    panels = [(plate, panel) for plate in plates for panel in plate.panels]
    for row, (plate, panel) in zip(rows(book["Panels"]), panels, strict=True):
        assert list(row.values()) == [
            plate.mark, panel.panel, panel.what, panel.flat, panel.arc, panel.chord_outer
        ]  # fmt: skip


def test_what_is_not_a_number_is_an_empty_cell(book):
    plates = rows(book["Plates"])
    assert plates[1]["bending_radius_min"] is None
    assert plates[2]["strain_max"] is None
    assert plates[0]["strain_max"] == 2.5e-5


def test_checks_hold_every_finding_once(book):
    checks = rows(book["Checks"])
    assert [row["object"] for row in checks] == ["M1-T1", "M3", "M2"]
    assert checks[1] == CLASH.as_dict()


def test_summary_counts_and_totals(book):
    summary = rows(book["Summary"])
    assert [row["member"] for row in summary[:3]] == ["M1", "M2", "M3"]
    assert [row["plates"] for row in summary[:3]] == [2, 1, 0]
    counts = [(row["errors"], row["warnings"], row["notes"]) for row in summary[:3]]
    assert counts == [(0, 1, 0), (0, 0, 1), (1, 0, 0)]
    assert summary[0]["total_torsion"] == math.degrees(0.25)
    total = next(row for row in summary if row["member"] == "total")
    assert (total["plates"], total["errors"]) == (3, 1)
    assert total["length"] == pytest.approx(2 * RECORDS[0].length, rel=1e-15)
    project = next(row for row in summary if row["member"] == "project")
    assert project["sections"] == book.properties.title == "Hall & <Sons>"


def test_sheets_are_ready_to_read_filter_and_print(book):
    for sheet in book:
        assert sheet.freeze_panes == "A2"
        assert sheet.print_title_rows == "$1:$1"
        wide = sum(sheet.column_dimensions[cell.column_letter].width for cell in sheet[1])
        upright = sheet.page_setup.orientation == "portrait"
        assert upright == (wide <= 100) and (upright or sheet.page_setup.orientation == "landscape")
        # All of it, notes below the table included, with who made what on every page.
        area = f"$A$1:${sheet[1][-1].column_letter}${sheet.max_row}"
        # openpyxl 3.1 names the sheet before it, 3.0 gives a list.
        assert "".join(sheet.print_area).rpartition("!")[2] == area
        footer = sheet.oddFooter
        assert footer.left.text == "Hall && <Sons>: &A" and footer.center.text.startswith("revis")
        assert footer.right.text in ("&P / &N", "&[Page] / &N")
        assert sheet.sheet_properties.pageSetUpPr.fitToPage
        assert (sheet.page_setup.fitToWidth, sheet.page_setup.fitToHeight) == (1, 0)
        assert sheet["A1"].font.bold
    assert book["Points"].auto_filter.ref == f"A1:N{book['Points'].max_row}"
    assert book["Summary"].auto_filter.ref == "A1:R4"
    assert book["Points"]["F2"].number_format == "0.0"
    assert book["Lines"]["G2"].number_format == "0.0000"


def test_a_footer_is_no_longer_than_spreadsheets_take(tmp_path):
    """Excel mends away what has more than 255 characters, codes and doubled signs included."""
    write_results([], [], tmp_path / "r.xlsx", "&" * 300)
    with zipfile.ZipFile(tmp_path / "r.xlsx") as archive:
        sheet = ElementTree.fromstring(archive.read("xl/worksheets/sheet1.xml"))
    (footer,) = (part.text for part in sheet.iter() if part.tag.endswith("oddFooter"))
    assert "&" * 160 in footer and len(footer) <= 255


def test_headings_hold_names_and_show_units(book):
    """The names stay what programs look for; the unit is the cells' number format."""
    shown = {
        ("Plates", "length"): "mm",
        ("Plates", "net_area"): "mm²",
        ("Plates", "net_mass"): "kg",
        ("Plates", "locked_in_stress"): "MPa",
        ("Summary", "total_torsion"): "°",
        ("Forming", "corner_force"): "kN",
        ("Forming", "twist_per_metre"): "°/m",
        ("Bevels", "angle_outer"): "°",
        ("Bed", "slope"): "°",
        ("Control", "site_x"): "mm",
    }
    for (sheet, name), unit in shown.items():
        [cell] = [cell for cell in book[sheet][1] if cell.value == name]
        assert cell.number_format == f'@" ({unit})"' and cell.font.bold
    for sheet, name in (("Zones", "slope"), ("Plates", "strain_max"), ("Checks", "value")):
        [cell] = [cell for cell in book[sheet][1] if cell.value == name]
        assert cell.number_format == "General"


def test_text_is_never_a_formula(tmp_path):
    nasty = ("=1+1", "@SUM(A1)", "-2+3", "+x", "a\x00b", "<&>\"'", "  钢 ")
    plates = tuple(rectangle(mark) for mark in nasty)
    write_results([member("=cmd|' /C calc'!A0", plates)], (), tmp_path / "r.xlsx", "=now()")
    book = openpyxl.load_workbook(tmp_path / "r.xlsx")
    for sheet in book:
        for cells in sheet.iter_rows():
            assert all(cell.data_type != "f" for cell in cells)
    marks = [cell.value for cell in book["Plates"]["B"][1:]]
    assert marks == [mark.replace("\x00", " ") for mark in nasty]
    assert book["Plates"]["B2"].quotePrefix and not book["Plates"]["B6"].quotePrefix
    assert book["Summary"]["A2"].value == "=cmd|' /C calc'!A0"


def test_same_input_same_bytes_without_time(tmp_path):
    for name in ("a.xlsx", "b.xlsx"):
        write_results(RECORDS, FINDINGS, tmp_path / name)
    assert (tmp_path / "a.xlsx").read_bytes() == (tmp_path / "b.xlsx").read_bytes()
    with zipfile.ZipFile(tmp_path / "a.xlsx") as archive:
        assert archive.testzip() is None
        assert {item.date_time for item in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
        assert b"dcterms" not in archive.read("docProps/core.xml")


def test_no_members_give_a_workbook_with_headers(tmp_path):
    write_results([], [], tmp_path / "r.xlsx")
    book = openpyxl.load_workbook(tmp_path / "r.xlsx")
    assert book["Points"].max_row == 1


def test_a_building_is_written_in_seconds(tmp_path):
    plate = wavy()
    records = [member(f"M{n}", (plate,) * 14) for n in range(25)]
    started = time.process_time()
    write_results(records, (), tmp_path / "r.xlsx")
    assert time.process_time() - started < 6.0


def test_a_folder_in_the_way_is_one_line_with_the_mend(tmp_path):
    (tmp_path / "results.xlsx").mkdir()
    with pytest.raises(BendTorsionError, match="results.xlsx.*cannot be written.*->"):
        write_results(RECORDS, (), tmp_path / "results.xlsx")
    assert [item.name for item in tmp_path.iterdir()] == ["results.xlsx"]
