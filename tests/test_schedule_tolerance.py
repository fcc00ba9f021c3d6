# SPDX-License-Identifier: LGPL-2.1-or-later
"""What people's spreadsheets bring along: titles, commas, text, Chinese headings, CSV, empty rows,
and what must be refused: entities and archives that burst."""

import copy
import errno
import io
import re
import time
import zipfile

import openpyxl
import pytest
from openpyxl.styles import Font
from schedule_books import GOOD, one, write
from test_round_trip import book

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.csv_folder import write_folder
from BendTorsionWB.exchange.schedule import read_schedule
from BendTorsionWB.exchange.schedule_cells import BadCell, Number
from BendTorsionWB.exchange.schedule_columns import SHEETS
from BendTorsionWB.exchange.schedule_headings import COLUMN_ALIASES, SHEET_ALIASES, heading_name
from BendTorsionWB.exchange.whole_file import not_written

CHINESE_SHEETS = {
    "Settings": "设置",
    "Materials": "材料",
    "Surfaces": "曲面",
    "Points": "控制点",
    "Axes": "轴线",
    "Sections": "截面",
    "Members": "构件",
    "Splits": "分段",
}
CHINESE_COLUMNS = {
    "Settings": ["项目", "值"],
    "Materials": ["材料", "密度", "弹性模量", "屈服强度(MPa)"],
    "Surfaces": ["曲面", "类型", "参数"],
    "Points": ["轴线", "序号", "x", "y", "z"],
    "Axes": ["轴线", "曲面"],
    "Sections": [
        *("截面", "类型", "高度（mm）", "宽度（mm）", "板厚", "间隙1", "间隙2"),
        *("顶板厚", "腹板厚", "材质"),
    ],
    "Members": ["构件号", "段", "轴线", "截面", "变截面起点", "坡度", "对齐", "对齐基准", "转角"],
    "Splits": ["构件", "板面", "拼缝"],
}


@pytest.fixture
def good(tmp_path):
    return read_schedule(write(tmp_path / "good.xlsx", GOOD))


def same(schedule, good):
    """Equal but for the file's name; places are no part of a row's value."""
    return {**vars(schedule), "file": "", "folder": ""} == {**vars(good), "file": "", "folder": ""}


def test_merged_titles_above_the_headings_are_passed_over(tmp_path, good):
    path = write(tmp_path / "titled.xlsx", GOOD)
    book = openpyxl.load_workbook(path)
    for sheet in book:
        sheet.insert_rows(1, 3)
        sheet["A1"] = f"Concert hall, table of {sheet.title}"
        sheet["A2"] = "rev"
        sheet["B2"] = "B"
        sheet.merge_cells("A1:C1")
    book.save(path)
    assert same(read_schedule(path), good)
    book["Members"]["D6"] = "S9"
    book.save(path)
    assert one(read_schedule, path).position == "sheet Members, row 6, column section"


def test_numbers_as_text_and_decimal_commas_are_numbers(tmp_path, good):
    sheets = copy.deepcopy(GOOD)
    for rows in sheets.values():
        for row in rows[1:]:
            row[:] = [str(c) if isinstance(c, (int, float)) else c for c in row]
    sheets["Points"][2][2:] = ["0,0", "20000,0", " 0 "]
    sheets["Members"][3][4] = "75,0%"
    sheets["Splits"][1][2] = "0,2 0,4 1"
    sheets["Sections"][2][2] = "６００"
    assert same(read_schedule(write(tmp_path / "text.xlsx", sheets)), good)


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("12,5", 12.5),
        ("-0,125", -0.125),
        ("1.234,5", 1234.5),
        ("1,234.5", 1234.5),
        ("1.234.567,25", 1234567.25),
        ("12，5", 12.5),
        ("1234,567", 1234.567),
        ("2,5e3", 2500.0),
    ],
)
def test_commas_that_can_mean_one_thing_only(text, number):
    assert Number()(text) == number


@pytest.mark.parametrize("text", ["12,500", "1,234,567", "1,2,3", "1,23.4", "1.23,4.5", ",", "a,5"])
def test_commas_that_can_mean_two_things_or_none_are_refused(text):
    with pytest.raises(BadCell) as bad:
        Number()(text)
    assert bad.value.code == "not-a-number" and bad.value.mend


def points(tmp_path, *rows, splits="0,2 0,4 1", **sheets):
    """The good schedule with these x, y, z as its points."""
    given = copy.deepcopy(GOOD) | sheets
    given["Points"][1:] = [["A1", k, *row] for k, row in enumerate(rows, start=1)]
    given["Splits"][1][2] = splits
    return write(tmp_path / "survey.xlsx", given)


SURVEY = (["-18552,096", "320,101", "0,000"], ["0,000", "19999,500", "12,500"])
NEXT = ["18552,096", "320,101", "-12,500"]


def test_three_decimals_are_read_as_the_plain_numbers_of_the_file_are(tmp_path):
    axis = read_schedule(points(tmp_path, *SURVEY, NEXT)).axes[0]
    assert [(p.x, p.y, p.z) for p in axis.points] == [
        (-18552.096, 320.101, 0.0),
        (0.0, 19999.5, 12.5),
        (18552.096, 320.101, -12.5),
    ]


def test_a_sheet_shows_the_mark_to_all_others_and_lists_within_cells_follow(tmp_path):
    given = {
        "Surfaces": [["surface", "kind", "parameters"], ["Hall", "sphere", "r=20000 x=1,250"]],
        "Settings": [["key", "value"], ["station_spacing", "400,125"], ["default_slope", "3,5"]],
    }
    rows = [20000, 0, 0], [0, 20000, 0], [-20000, 0, 0]
    path = points(tmp_path, *rows, splits="900,125 5000,5", **given)
    schedule = read_schedule(path)
    assert schedule.surfaces[0].centre[0] == 1.25
    assert schedule.settings.station_spacing == 400.125
    assert schedule.splits[0].joints.values == (900.125, 5000.5)


def test_both_marks_in_a_file_or_none_are_refused(tmp_path):
    for splits, rows, said in (
        (
            "0.2 0.4 1",
            (*SURVEY, NEXT),
            "both decimal marks: sheet Points, row 2: -18552,096; sheet Splits, row 2: 0.2",
        ),
        ("auto", ([20000, "320,101", 0], [0, 20000, 0], [-20000, 0, 0]), "part thousands"),
    ):
        with pytest.raises(BendTorsionError) as raised:
            read_schedule(points(tmp_path, *rows, splits=splits))
        found = raised.value.findings[0]
        assert (found.code, found.value) == ("not-a-number", "320,101")
        assert found.position == "sheet Points, row 2, column y" and said in found.message
        assert found.mend == "write 320,1010 or 320101, or a number cell instead of text"
    # What the mend says helps.
    rows = [20000, "320,1010", 0], [0, 20000, 0], [-20000, 0, 0]
    assert read_schedule(points(tmp_path, *rows, splits="auto")).axes[0].points[0].y == 320.101


def test_points_between_three_digits_are_thousands_only_where_the_file_parts_them(tmp_path):
    def x(first, other):
        path = points(tmp_path, [first, 0, 0], [0, other, 0], [-20000, 0, 0], splits="auto")
        return read_schedule(path).axes[0].points[0].x

    assert x("12.500", "20000") == 12.5
    assert x("12.500", "19.999,5") == 12500.0
    assert x("12,500", "19,999.5") == 12500.0
    with pytest.raises(BendTorsionError):
        x("12.500", "19999,5")
    with pytest.raises(BendTorsionError):
        x("12,500", "19999.5")


def test_names_that_look_like_numbers_show_nothing_and_stay(tmp_path):
    given = copy.deepcopy(GOOD)
    given["Surfaces"][1][0] = given["Axes"][1][1] = "1,5"
    given["Members"][1][0] = "1.500"
    given["Members"][2][0] = given["Members"][3][0] = "1.500"
    given["Splits"] = given["Splits"][:1] + [["1.500", "top", "auto"]]
    given["Points"][1][2] = "12.500"
    schedule = read_schedule(write(tmp_path / "names.xlsx", given))
    assert schedule.members[0].name == "1.500" and schedule.surfaces[0].name == "1,5"
    assert schedule.axes[0].points[0].x == 12.5
    given["Points"][1][2] = "12,500"
    assert one(read_schedule, write(tmp_path / "names.xlsx", given)).value == "12,500"


def test_semicolons_between_csv_cells_show_decimal_commas(tmp_path):
    folder = tmp_path / "hall"
    sheets = copy.deepcopy(GOOD)
    sheets["Splits"][1][2] = "auto"
    write_folder(folder, sheets)
    rows = "axis;no;x;y;z\nA1;1;20000;320,101;0\nA1;2;0;20000;0\nA1;3;-20000;0;0\n"
    (folder / "Points.csv").write_text(rows, encoding="utf-8")
    assert read_schedule(folder).axes[0].points[0].y == 320.101
    (folder / "Points.csv").write_text(rows.replace(";0\nA1;2", ";0.5\nA1;2"), encoding="utf-8")
    assert one(read_schedule, folder).message.endswith("mark: sheet Points, row 2: 0.5")


def test_headings_and_sheets_are_read_whatever_their_case(tmp_path, good):
    shouted = {
        title.upper(): [[heading.upper() for heading in rows[0]], *rows[1:]]
        for title, rows in GOOD.items()
    }
    assert same(read_schedule(write(tmp_path / "capitals.xlsx", shouted)), good)
    write_folder(tmp_path / "hall", GOOD)
    for path in sorted((tmp_path / "hall").glob("*.csv")):
        heading, _, rest = path.read_text(encoding="utf-8-sig").partition("\n")
        path.write_text(f"{heading.title()}\n{rest}", encoding="utf-8")
    assert same(read_schedule(tmp_path / "hall"), good)
    for title, columns in SHEETS.items():
        names = [column.name for column in columns]
        assert len({name.lower() for name in names}) == len(names), title


def test_chinese_sheets_and_headings(tmp_path, good):
    sheets = {
        CHINESE_SHEETS[title]: [CHINESE_COLUMNS[title], *rows[1:]] for title, rows in GOOD.items()
    }
    assert all(len(CHINESE_COLUMNS[t]) == len(rows[0]) for t, rows in GOOD.items())
    path = write(tmp_path / "chinese.xlsx", sheets)
    assert same(read_schedule(path), good)


def test_every_sheet_and_column_has_a_heading_in_chinese(tmp_path):
    """Coordinates and numbers of directions apart, which are the same letters in both."""
    letters = {"x", "y", "z", "dx", "dy", "dz"}
    sheets = {}
    for title, columns in SHEETS.items():
        assert title in SHEET_ALIASES.values(), title
        for name in {column.name for column in columns} - letters:
            found = [a for a, names in COLUMN_ALIASES.items() if name in names]
            found = [a for a in found if heading_name(a, [c.name for c in columns]) == name]
            assert found, (title, name)
    # One schedule in both languages, with a row on most sheets.
    given = book(0)
    for title, (heading, *rows) in given.items():
        columns = [column.name for column in SHEETS[title]]
        by_name = {heading_name(alias, columns): alias for alias in COLUMN_ALIASES}
        used = [by_name.get(name, name) for name in heading]
        [chinese, *_] = [a for a, name in SHEET_ALIASES.items() if name == title]
        sheets[chinese] = [used, *rows]
    one_of = read_schedule(write(tmp_path / "english.xlsx", given))
    assert same(read_schedule(write(tmp_path / "chinese.xlsx", sheets)), one_of)


@pytest.mark.parametrize(
    ("separator", "encoding"),
    [(",", "utf-8-sig"), (";", "utf-8"), ("\t", "utf-16"), (",", "gb18030")],
)
def test_a_folder_of_csv_reads_as_the_workbook_does(tmp_path, good, separator, encoding):
    folder = tmp_path / "hall"
    write_folder(folder, GOOD)
    (folder / "notes.txt").write_text("not a sheet", encoding="utf-8")
    for path in folder.glob("*.csv"):
        text = path.read_bytes().decode("utf-8-sig").replace(",", separator)
        path.write_bytes(text.encode(encoding))
    assert same(read_schedule(folder), good)


def test_faults_in_a_csv_folder_have_their_place(tmp_path):
    folder = tmp_path / "hall"
    sheets = copy.deepcopy(GOOD)
    sheets["Members"][2][3] = "S9"
    write_folder(folder, sheets)
    finding = one(read_schedule, folder)
    assert finding.position == "sheet Members, row 3, column section" and finding.object == "hall"
    (folder / "Members.csv").write_bytes(b'member,segment\n"M1,1\n')
    assert one(read_schedule, folder).code == "file-unreadable"
    (tmp_path / "empty").mkdir()
    assert one(read_schedule, tmp_path / "empty").code == "file-missing"


@pytest.mark.parametrize("separator", [",", ";", "\t"])
@pytest.mark.parametrize("title", ["Hall", "Hall, roof, 2026", "Hall; roof; east; west; all of it"])
def test_titles_above_the_headings_of_csv_files_are_passed_over(tmp_path, good, separator, title):
    folder = tmp_path / "hall"
    write_folder(folder, GOOD)
    for path in folder.glob("*.csv"):
        text = path.read_bytes().decode("utf-8-sig").replace(",", separator)
        path.write_bytes(f"{title}\r\n\r\n{text}".encode())
    assert same(read_schedule(folder), good)


def test_decimal_commas_and_a_title_with_commas_in_a_csv_folder(tmp_path, good):
    folder = tmp_path / "hall"
    write_folder(folder, GOOD)
    rows = "axis;no;x;y;z\nA1;1;20000,0;0,0;0,0\nA1;2;0,0;20000,0;0,0\nA1;3;-20000,0;0,0;0,0\n"
    (folder / "Points.csv").write_text(f"Points, roof, east, all\n{rows}", encoding="utf-8")
    assert same(read_schedule(folder), good)


def test_a_csv_folder_that_does_not_fit_is_told_by_its_own_name(tmp_path, monkeypatch):
    def full(path, content):
        raise BendTorsionError(not_written(path, OSError(errno.ENOSPC, "No space left")))

    monkeypatch.setattr("BendTorsionWB.exchange.csv_folder.write_whole", full)
    assert one(write_folder, tmp_path / "hall", GOOD).object == str(tmp_path / "hall")
    assert not (tmp_path / "hall").exists()


def test_files_of_other_systems_in_a_csv_folder(tmp_path, good):
    folder = tmp_path / "hall"
    write_folder(folder, GOOD)
    # A Mac's hidden twin of a file, and an ending in capitals as Windows is content with.
    (folder / "._Points.csv").write_bytes(b"\0\5\x16\7\0\2\0\0Mac OS X")
    (folder / "Points.csv").rename(folder / "Points.CSV")
    assert same(read_schedule(folder), good)
    (folder / "Members [old].csv").write_text("member\nM1\n", encoding="utf-8")
    finding = one(read_schedule, folder)
    assert (finding.code, finding.object) == ("sheet-unknown", "Members [old].csv")


@pytest.mark.parametrize("between", ["", "\n  "])
def test_a_hundred_thousand_empty_rows_take_no_time(tmp_path, good, between):
    path = write(tmp_path / "long.xlsx", GOOD)
    book = openpyxl.load_workbook(path)
    for column in range(1, 13):
        book["Members"].cell(10, column).font = Font(bold=True)
    book.save(path)

    def longer(name, content):
        if found := re.search(rb'<row r="10"><c r="A10".*?</row>', content):
            cells = found[0].replace(b"></c>", b"/>").replace(b"<c", between.encode() + b"<c")
            rows = [cells.replace(b"10", b"%d" % row) for row in range(10, 100_010)]
            content = content.replace(found[0], b"".join(rows))
        return content

    with zipfile.ZipFile(repacked(path, longer)) as long:
        assert any(b'<c r="L100009"' in long.read(name) for name in long.namelist())
    start = time.process_time()
    assert same(read_schedule(path), good)
    assert time.process_time() - start < 4.0


def test_rows_without_numbers_stay_where_they_are(tmp_path, good):
    """As this program itself writes workbooks: a row stands after the one before."""

    def bare(name, content):
        return re.sub(rb'<row r="[0-9]+"', b"<row", content)

    sheets = copy.deepcopy(GOOD)
    sheets["Members"].insert(2, [])
    sheets["Members"][4][3] = "S9"
    path = write(tmp_path / "bare.xlsx", sheets)
    assert one(read_schedule, path).position == "sheet Members, row 5, column section"
    book = openpyxl.load_workbook(path)
    book["Members"].cell(3, 1).font = Font(bold=True)
    book.save(path)
    assert one(read_schedule, repacked(path, bare)).position == (
        "sheet Members, row 5, column section"
    )


def repacked(path, change):
    content = io.BytesIO()
    with zipfile.ZipFile(path) as source, zipfile.ZipFile(content, "w") as target:
        for name in source.namelist():
            target.writestr(name, change(name, source.read(name)))
    path.write_bytes(content.getvalue())
    return path


@pytest.mark.parametrize("coding", ["utf-8", "utf-16"])
@pytest.mark.parametrize("part", ["xl/workbook.xml", "xl/worksheets/sheet2.xml"])
def test_an_external_entity_is_refused_and_not_read(tmp_path, part, coding):
    secret = tmp_path / "secret.txt"
    secret.write_text("not for the schedule", encoding="utf-8")

    def change(name, data):
        if name != part:
            return data
        head, _, rest = (
            data.decode().partition("?>") if data.startswith(b"<?") else ("", "", data.decode())
        )
        declared = f'<!DOCTYPE x [<!ENTITY e SYSTEM "file://{secret}">]>'
        return (f'<?xml version="1.0" encoding="{coding}"?>{declared}{rest}').encode(coding)

    path = repacked(write(tmp_path / "trap.xlsx", GOOD), change)
    finding = one(read_schedule, path)
    assert finding.code == "file-unsafe" and "secret" not in finding.line()


def test_a_zip_bomb_is_refused_before_it_bursts(tmp_path):
    path = write(tmp_path / "bomb.xlsx", GOOD)
    with zipfile.ZipFile(path, "a", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("xl/media/one.bin", bytes(210_000_000))
    assert path.stat().st_size < 1e6
    start = time.process_time()
    assert one(read_schedule, path).code == "file-too-large"
    assert time.process_time() - start < 1.0


def test_a_half_saved_workbook_is_one_line(tmp_path):
    path = write(tmp_path / "half.xlsx", GOOD)
    content = path.read_bytes()
    for kept in (0, 10, len(content) // 2, len(content) - 30):
        path.write_bytes(content[:kept])
        found = one(read_schedule, path)
        assert found.code in ("not-xlsx", "file-unreadable")
        assert kept == 0 or "cut short" in found.message, "it is a workbook, and not whole"
