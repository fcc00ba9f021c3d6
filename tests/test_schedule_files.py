# SPDX-License-Identifier: LGPL-2.1-or-later
"""Schedule files that are damaged, locked, too large or no workbooks: one line each."""

import copy
import io
import math
import os
import re
import zipfile

import openpyxl
import pytest
from schedule_books import GOOD, one, write

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange import csv_folder
from BendTorsionWB.exchange.csv_folder import parted_folder, read_csv, write_folder
from BendTorsionWB.exchange.file_name import file_name
from BendTorsionWB.exchange.linked_documents import linked_documents
from BendTorsionWB.exchange.outside_files import file_of, outside_allowed
from BendTorsionWB.exchange.schedule import read_schedule


def patched(path, sheet_number, pattern, replacement):
    content = io.BytesIO()
    with zipfile.ZipFile(path) as source, zipfile.ZipFile(content, "w") as target:
        for name in source.namelist():
            data = source.read(name)
            if name == f"xl/worksheets/sheet{sheet_number}.xml":
                data, count = re.subn(pattern, replacement, data)
                assert count == 1
            target.writestr(name, data)
    path.write_bytes(content.getvalue())
    return path


def test_nan_and_formulas_without_result_are_no_empty_cells(tmp_path, read):
    finding = one(read, {("Axes", 2, "max_spacing"): math.nan})
    assert (finding.code, finding.value) == ("not-finite", "NaN")
    assert finding.position == "sheet Axes, row 2, column max_spacing"
    finding = one(read, {("Members", 3, "slope"): "=1+1"})
    assert finding.code == "formula-without-value"
    assert finding.position == "sheet Members, row 3, column slope"
    path = write(tmp_path / "nan.xlsx", GOOD)
    finding = one(read_schedule, patched(path, 4, b"<v>-20000</v>", b"<v>nan</v>"))
    assert (finding.code, finding.value) == ("not-finite", "nan")
    assert finding.position == "sheet Points, row 4, column C"
    path = write(tmp_path / "calculated.xlsx", GOOD)
    patched(path, 4, b"<v>-20000</v>", b"<f>-2*10000</f><v>-20000</v>")
    assert read_schedule(path).axis("A1").points[2].x == -20000.0


def encrypted_zip(path):
    data = bytearray(write(path, GOOD).read_bytes())
    for magic, offset in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        for match in re.finditer(re.escape(magic), bytes(data)):
            data[match.start() + offset] |= 1
    return bytes(data)


def ole(mark):
    return bytes.fromhex("D0CF11E0A1B11AE1") + bytes(504) + mark.encode("utf-16-le")


def zipped(name, data, method=zipfile.ZIP_STORED):
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", method) as archive:
        archive.writestr(name, data)
    return content.getvalue()


UNREADABLE = {
    "text": (b"member,segment\nM1,1\n", "not-xlsx"),
    "empty": (b"", "not-xlsx"),
    "old": (ole("Workbook"), "not-xlsx"),
    "password": (ole("EncryptedPackage"), "file-encrypted"),
    "other-zip": (zipped("content.xml", b"<x/>"), "not-xlsx"),
    "broken-xml": (zipped("xl/workbook.xml", b"<x"), "file-unreadable"),
    "bomb": (zipped("xl/workbook.xml", bytes(201_000_000), zipfile.ZIP_DEFLATED), "file-too-large"),
}


@pytest.mark.parametrize("name", UNREADABLE)
def test_an_unreadable_file_is_one_line(tmp_path, name):
    content, code = UNREADABLE[name]
    path = tmp_path / "hall.xlsx"
    path.write_bytes(content)
    finding = one(read_schedule, path)
    assert (finding.object, finding.code) == ("hall.xlsx", code)


def test_missing_file_folder_and_damaged_files(tmp_path):
    assert one(read_schedule, tmp_path / "none.xlsx").code == "file-missing"
    assert one(read_schedule, tmp_path).code == "file-missing"
    path = tmp_path / "hall.xlsx"
    path.write_bytes(encrypted_zip(path))
    assert one(read_schedule, path).code == "file-encrypted"
    whole = write(path, GOOD).read_bytes()
    for length in (100, len(whole) // 2, len(whole) - 10):
        path.write_bytes(whole[:length])
        assert one(read_schedule, path).code in ("not-xlsx", "file-unreadable")


def test_a_sheet_that_reaches_to_the_end_of_the_world(tmp_path):
    path = write(tmp_path / "hall.xlsx", GOOD)
    book = openpyxl.load_workbook(path)
    book["Points"]["XFD1048576"] = " "
    book.save(path)
    assert one(read_schedule, path).code == "sheet-too-large"


def test_a_link_that_leads_to_itself_is_told_as_such(tmp_path):
    """Not by the words of the system, and not as a file outside."""
    sheets = tmp_path / "sheets"
    write_folder(sheets, rows_of_book(write(tmp_path / "good.xlsx", GOOD)))
    (sheets / "Members.csv").unlink()
    (sheets / "Members.csv").symlink_to("Members.csv")
    finding = one(read_schedule, sheets)
    assert (finding.code, finding.object) == ("file-unreadable", "Members.csv")
    assert "leads back to itself" in finding.message and "Errno" not in finding.line()
    (tmp_path / "a.dxf").symlink_to("b.dxf")
    (tmp_path / "b.dxf").symlink_to("a.dxf")
    for allowed in (False, True):
        with outside_allowed(allowed), pytest.raises(BendTorsionError) as problem:
            file_of(tmp_path, "a.dxf", "A1")
        [finding] = problem.value.findings
        assert (finding.code, finding.object) == ("file-unreadable", "A1")
        assert "a.dxf" in finding.message and "outside" not in finding.line()
        assert str(tmp_path) not in finding.line()


def test_a_path_of_windows_lies_outside_everywhere_and_is_told_whole(tmp_path):
    for name in ("C:/Windows/x.step", "//server/share/x.step"):
        with pytest.raises(BendTorsionError) as problem:
            file_of(tmp_path, name, "A1")
        [finding] = problem.value.findings
        assert (finding.code, finding.value) == ("file-outside", name)


@pytest.mark.parametrize(
    "sheets, kind",
    [
        (["Summary", "Plates", "Nodes", "Checks"], "a results file"),
        (["Transmittal"], "the transmittal of a revision"),
        (["Changes"], "a list of changes"),
        (["Plates"], "the plates since the last issue"),
    ],
)
def test_a_workbook_of_results_is_no_schedule_and_one_line(tmp_path, sheets, kind):
    book = openpyxl.Workbook()
    book.remove(book.active)
    for name in sheets:
        book.create_sheet(name).append(["member", "plate"])
    book.save(tmp_path / "results.xlsx")
    finding = one(read_schedule, tmp_path / "results.xlsx")
    assert finding.code == "schedule-is-results" and kind in finding.message
    # With the sheet every schedule has, it is one with sheets that do not belong there.
    book.create_sheet("Members").append(["member"])
    book.save(tmp_path / "results.xlsx")
    with pytest.raises(BendTorsionError) as problem:
        read_schedule(tmp_path / "results.xlsx")
    assert "sheet-unknown" in [f.code for f in problem.value.findings]


def test_a_document_a_folder_of_a_build_and_a_single_csv_file_are_no_schedules(tmp_path):
    (tmp_path / "model.FCStd").write_bytes(b"PK")
    finding = one(read_schedule, tmp_path / "model.FCStd")
    assert "a FreeCAD document" in finding.message and "--out model.xlsx" in finding.mend
    (tmp_path / "Members.csv").write_text("member,segment\n", encoding="utf-8")
    assert "holds a .csv file for each sheet" in one(read_schedule, tmp_path / "Members.csv").mend
    (tmp_path / "out").mkdir()
    for name in (".bendtorsion.json", "nesting.csv"):
        (tmp_path / "out" / name).write_text("{}", encoding="utf-8")
    finding = one(read_schedule, tmp_path / "out")
    assert finding.code == "schedule-is-results" and "the folder of a build" in finding.message
    # One that is not there is told as that.
    assert one(read_schedule, tmp_path / "other.csv").code == "file-missing"


def rows_of_book(path):
    return {
        sheet.title: [list(row) for row in sheet.values]
        for sheet in openpyxl.load_workbook(path).worksheets
    }


@pytest.mark.parametrize("name", ["general_arrangement", "Nodes", "set"])
def test_a_member_with_the_name_of_sheets_of_the_project_would_lose_its_own(read, name):
    changes = {("Members", row, "member"): name for row in (2, 3, 4)}
    found = one(read, changes | {("Splits", row, "member"): name for row in (2, 3)})
    assert found.code == "file-name-twice" and found.value == name
    assert found.position == "sheet Members, row 2, column member"


@pytest.fixture
def sheets(tmp_path):
    """A good schedule as a folder of CSV files."""
    folder = tmp_path / "sheets"
    write_folder(folder, rows_of_book(write(tmp_path / "good.xlsx", GOOD)))
    return folder


def test_a_link_in_a_folder_of_csv_files_stays_within_it_unless_allowed(tmp_path, sheets):
    secret = tmp_path / "secret.csv"
    (sheets / "Members.csv").rename(secret)
    (sheets / "Members.csv").symlink_to(secret)
    finding = one(read_schedule, sheets)
    assert (finding.code, finding.value) == ("file-outside", "Members.csv")
    with outside_allowed():
        assert read_schedule(sheets).members
    (sheets / "Members.csv").unlink()
    secret.rename(sheets / "kept.txt")
    (sheets / "Members.csv").symlink_to("kept.txt")
    assert read_schedule(sheets).members


def test_what_counts_for_a_folder_cut_short_stays_within_it_too(tmp_path, sheets):
    sheets.rename(tmp_path / "elsewhere")
    sheets.mkdir()
    (sheets / ".whole").symlink_to(tmp_path / "elsewhere", target_is_directory=True)
    with pytest.raises(BendTorsionError) as problem:
        read_schedule(sheets)
    assert {finding.code for finding in problem.value.findings} == {"file-outside"}


@pytest.mark.parametrize("name", ["p.xlsx", "p.FCStd", "sheets/Members.csv", "p.dxf"])
def test_a_pipe_or_a_device_is_no_file(tmp_path, sheets, name):
    """A pipe is waited for, and a device may never end."""
    path = tmp_path / name
    path.unlink(missing_ok=True)
    for make in (os.mkfifo, lambda path: path.symlink_to(os.devnull)):
        make(path)
        if path.suffix == ".dxf":
            finding = one(file_of, tmp_path, name, "A1")
        elif path.suffix == ".FCStd":
            finding = one(linked_documents, path)
        else:
            finding = one(read_schedule, sheets if path.suffix == ".csv" else path)
        assert finding.code == "file-unreadable" and "not a file" in finding.message
        path.unlink()


def test_a_name_too_long_for_the_system_is_told(tmp_path):
    name = f"{'n' * 300}.step"
    assert one(read_schedule, tmp_path / name).code == "file-unreadable"
    finding = one(file_of, tmp_path, name, "A1")
    assert (finding.code, finding.object) == ("file-unreadable", "A1")
    assert name in finding.message


@pytest.mark.parametrize(
    "text, unit",
    [("member" + "," * 20_000, "columns"), ("member\n" + (",,,,,," * 100 + "\n") * 4000, "cells")],
)
def test_a_csv_file_has_the_limits_of_a_sheet(sheets, text, unit):
    (sheets / "Members.csv").write_text(text, encoding="utf-8")
    finding = one(read_schedule, sheets)
    assert (finding.code, finding.object, finding.unit) == ("sheet-too-large", "Members.csv", unit)
    assert finding.value > finding.limit


def test_rows_of_commas_alone_are_no_cells(sheets):
    text = (sheets / "Members.csv").read_text(encoding="utf-8")
    lines = [f"{line}{',' * 16_000}" for line in text.splitlines()]
    (sheets / "Members.csv").write_text("\n".join(lines), encoding="utf-8")
    book, _ = parted_folder(sheets)
    assert len(book["Members"]._cells) < 50 and read_schedule(sheets).members


@pytest.mark.parametrize("char", "\u202e\u2066\u200b\ufeff\x7f")
def test_names_with_characters_that_are_not_seen_are_refused(tmp_path, char):
    for sheet in ("Members", "Materials"):
        sheets = copy.deepcopy(GOOD)
        sheets[sheet][-1][0] = f"gpj.{char}1M"
        with pytest.raises(BendTorsionError) as problem:
            read_schedule(write(tmp_path / "hall.xlsx", sheets))
        told = [finding for finding in problem.value.findings if finding.code == "bad-name"]
        assert len(told) == 1 and f"U+{ord(char):04X}" in told[0].message
        assert char not in told[0].line()
    assert file_name(f"gpj.{char}1M").startswith("gpj._1M-")


@pytest.mark.parametrize("sign", "=+-@＝＋－＠")
def test_text_that_may_be_a_formula_comes_back_as_it_was(tmp_path, sign):
    texts = [f"{marks}{sign}M1" for marks in ("", "'", "''")] + ["'M1", f"{sign}1"]
    write_folder(tmp_path, {"Members": [texts]})
    written = (tmp_path / "Members.csv").read_text(encoding="utf-8-sig").strip().split(",")
    assert [cell[:1] for cell in written[:4]] == ["'"] * 4
    assert read_csv(tmp_path / "Members.csv") == [texts]


def test_a_folder_nothing_could_be_written_into_is_not_left(tmp_path, monkeypatch):
    def full(path, content):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(csv_folder, "write_whole", full)
    (tmp_path / "own").mkdir()
    for name, stays in (("new", False), ("own", True)):
        with pytest.raises(BendTorsionError):
            write_folder(tmp_path / name, {"Members": [["member"]]})
        assert (tmp_path / name).exists() == stays
