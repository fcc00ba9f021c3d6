# SPDX-License-Identifier: LGPL-2.1-or-later
"""The schedule: read back as written, and every bad cell named with its place, value and mend."""

import copy
import dataclasses
import math
import pickle
import re
import unicodedata
from pathlib import Path

import openpyxl
import pytest
from schedule_books import GOOD, findings, one, write

from BendTorsionWB.exchange import schedule_columns as columns
from BendTorsionWB.exchange.schedule import read_schedule
from BendTorsionWB.exchange.schedule_jobs import job_of
from BendTorsionWB.exchange.schedule_rows import Settings

ROOT = Path(__file__).resolve().parent.parent
HALL = ROOT / "resources" / "examples" / "concert_hall"


def test_good_schedule_in_core_units_with_defaults(read):
    schedule = read()
    assert schedule.settings.station_spacing == 400.0
    assert schedule.settings.axis_tolerance == 0.005
    assert schedule.settings.transition_length == "face"
    first, second, third = schedule.member("M1").segments
    assert schedule.member("M1").roll == pytest.approx(math.pi / 2)
    assert (first.cut, first.slope, first.align, first.align_to) == (None, 4.0, "centre", "axis")
    assert (second.cut.at(10000.0), second.slope, second.align) == (4000.0, 0.0, "top-left")
    assert third.cut.is_ratio and third.cut.at(10000.0) == 7500.0
    assert schedule.section("S1").material == "S355"
    assert schedule.material("S355").density == pytest.approx(7.85e-6)
    section = schedule.section("S2")
    assert (section.t_top, section.t_bottom, section.t_web) == (18.0, 16.0, 16.0)
    assert (section.gap1, section.gap2, section.material) == (2.0, 3.0, "Q355")
    splits = schedule.splits_of("M1")
    assert splits["top"].joints.at(1000.0) == pytest.approx((200.0, 400.0))
    assert (splits["left"].joints.kind, splits["left"].joints.values) == ("mm", (900.0, 5000.0))
    assert schedule.surface("Hall").sizes == (("r", 20000.0),)
    axis = schedule.axis("A1")
    assert (axis.frame, axis.fit, axis.max_spacing) == ("surface", "pull", None)
    assert third.where("cut") == "hall.xlsx, sheet Members, row 4, column cut"
    finding = third.error("cut", "cut-beyond-axis", "beyond", "shorten")
    assert finding.line().startswith("error: hall.xlsx, sheet Members, row 4, column cut: beyond")


def test_layout_of_the_sheets_is_free(read):
    def shuffle(sheets):
        for title, rows in sheets.items():
            width = len(rows[0])
            sheets[title] = [row[::-1] for row in rows]
            sheets[title].insert(2, [None] * width)
            sheets[title] += [[" "] * width, [None] * width]
        sheets["Points"][1:] = sheets["Points"][:0:-1]
        sheets["Axes"][1] = [f"  {cell} " for cell in sheets["Axes"][1]]
        sheets["Sections"][1] = [f" {c}" if c else c for c in sheets["Sections"][1]]

    assert read(edit=shuffle) == read()


def test_values_are_immutable_picklable_and_independent_of_their_place(read):
    plain = read()
    with pytest.raises(dataclasses.FrozenInstanceError):
        plain.members[0].roll = 0.0
    assert pickle.loads(pickle.dumps(plain)) == plain
    assert read(edit=lambda sheets: sheets["Members"].insert(1, [])) == plain
    assert read({("Members", 3, "cut"): 4001}) != plain


def test_a_cell_formatted_in_per_cent_is_a_ratio(tmp_path):
    path = write(tmp_path / "hall.xlsx", GOOD)
    book = openpyxl.load_workbook(path)
    book["Members"]["E3"] = 0.35
    book["Members"]["E3"].number_format = "0.0%"
    book.save(path)
    cut = read_schedule(path).member("M1").segments[1].cut
    assert cut.is_ratio and cut.value == pytest.approx(0.35)


KINDS = "ellipsoid, sphere, cylinder, cone, torus, plane, file"
FACES = "top, bottom, left, right"
ALIGNMENTS = f"centre, {FACES}, top-left, top-right, bottom-left, bottom-right"
# sheet, row, column, bad value, code, limit, a word of the mend
TYPES = "box1, box2, i, tee, channel, trapezoid, polygon, strips"
BAD_CELLS = [
    ("Points", 3, "x", "abc", "not-a-number", None, "write a number"),
    ("Points", 3, "x", "12,500", "not-a-number", None, "write 12,5000 or 12500"),
    ("Points", 3, "x", True, "not-a-number", None, "number"),
    ("Points", 3, "x", None, "value-missing", None, "fill in x"),
    ("Points", 3, "y", "nan", "not-finite", None, "write a number"),
    ("Points", 3, "y", "-inf", "not-finite", None, "write a number"),
    ("Points", 3, "y", "#NUM!", "cell-error", None, "formula"),
    ("Points", 3, "z", 1e11, "out-of-range", "within +/- 1e+10", "write a number"),
    ("Points", 3, "no", 1.5, "not-whole", None, "whole"),
    ("Points", 3, "no", 1, "duplicate", None, "delete or rename"),
    ("Points", 3, "axis", "A9", "unknown-name", None, "sheet Axes"),
    ("Axes", 2, "surface", "hal", "unknown-name", None, "did you mean Hall"),
    ("Axes", 3, "axis", "A1", "duplicate", None, "delete or rename"),
    ("Axes", 2, "frame", "given", "frame-table-empty", None, "sheet Frames"),
    (
        "Axes",
        2,
        "frame",
        "sruface",
        "unknown-value",
        "surface, minimal, fixed, given",
        "did you mean surface",
    ),
    ("Axes", 2, "fit", "shove", "unknown-value", "pull, keep, offset", "use one of pull"),
    ("Axes", 2, "closed", "perhaps", "unknown-value", "yes, no", "yes or no"),
    ("Axes", 2, "source", "hall.step#A1", "source-and-points", None, "sheet Points"),
    (
        "Axes",
        2,
        "source",
        "hall.pdf#A1",
        "file-kind",
        ".dxf, .step, .stp, .iges, .igs, .brep, .brp, .3dm",
        "ending in .dxf",
    ),
    ("Axes", 2, "start_z", "high", "not-a-number", None, "write a number"),
    ("Axes", 2, "end_extension", "nan", "not-finite", None, "write a number"),
    ("Axes", 2, "max_spacing", 0, "out-of-range", "above 0", "above 0"),
    ("Surfaces", 2, "kind", "spere", "unknown-value", KINDS, "did you mean sphere"),
    ("Surfaces", 2, "file", "hall.step", "file-not-used", None, "kind file"),
    (
        "Surfaces",
        2,
        "file",
        "hall.txt",
        "file-kind",
        ".step, .stp, .iges, .igs, .brep, .brp, .3dm",
        "ending in .step",
    ),
    ("Surfaces", 2, "parameters", "r=-1", "out-of-range", "above 0", "sphere takes r="),
    ("Surfaces", 2, "parameters", "r=1 q=2", "bad-parameters", None, "sphere takes r="),
    ("Surfaces", 2, "parameters", "x=1", "bad-parameters", None, "sphere takes r="),
    ("Surfaces", 2, "parameters", "20000", "bad-parameters", None, "key=number"),
    ("Surfaces", 2, "parameters", "r=big", "not-a-number", None, "key=number"),
    ("Surfaces", 2, "parameters", "r=1 r=2", "duplicate", None, "key=number"),
    ("Materials", 2, "density", 7.85, "out-of-range", "at least 1000", "kg/m3"),
    ("Materials", 2, "fy", -355, "out-of-range", "above 0", "MPa"),
    ("Sections", 2, "type", "box3", "unknown-value", TYPES, "did you mean box"),
    ("Sections", 2, "type", "pipe", "unknown-value", TYPES, TYPES),
    ("Sections", 2, "type", None, "value-missing", None, "or catalogue"),
    ("Sections", 2, "h", None, "value-missing", None, "fill in h"),
    ("Sections", 2, "b_bottom", 300, "size-not-used", None, "box1 takes h, b"),
    ("Sections", 2, "catalogue", "BOX 800x800x2", "catalogue-section", None, "BOX 800x800x20"),
    ("Sections", 2, "corners", "0 0; 5", "bad-corners", None, "semicolons"),
    ("Sections", 2, "thicknesses", "16 -2", "out-of-range", "above 0", "per side"),
    ("Members", 3, "transition", "abrupt", "unknown-value", "linear, smooth", "linear"),
    ("Sections", 2, "h", -800, "out-of-range", "above 0", "above 0 mm"),
    ("Sections", 2, "b", 0, "out-of-range", "above 0", "above 0 mm"),
    ("Sections", 2, "t", None, "value-missing", None, "fill in t"),
    ("Sections", 2, "t", 400, "too-thick", 400.0, "less than 400"),
    ("Sections", 2, "t_top", 410, "too-thick", 400.0, "less than 400"),
    ("Sections", 2, "t_web", 400, "too-thick", 400.0, "less than 400"),
    ("Sections", 2, "gap2", 760, "gap-too-wide", 760.0, "below 760"),
    ("Sections", 4, "gap1", 568, "gap-too-wide", 568.0, "below 568"),
    ("Sections", 2, "gap1", -1, "out-of-range", "at least 0", "at least 0 mm"),
    ("Sections", 4, "section", "S1", "duplicate", None, "delete or rename"),
    ("Sections", 2, "material", "Q420", "unknown-name", None, "sheet Materials"),
    ("Members", 2, "axis", "A7", "unknown-name", None, "sheet Axes"),
    ("Members", 2, "axis", None, "value-missing", None, "segment 1"),
    ("Members", 3, "axis", "A2", "axis-differs", "A1", "write A1"),
    ("Members", 3, "section", "S9", "unknown-name", None, "sheet Sections"),
    ("Members", 3, "section", "S3", "type-change", None, "type box1"),
    ("Members", 3, "segment", 1, "duplicate", None, "1, 2, 3"),
    ("Members", 3, "segment", 4, "segment-order", 2, "write 2"),
    ("Members", 2, "cut", 100, "cut-on-first-segment", None, "segment 2"),
    ("Members", 3, "cut", None, "value-missing", None, "35%"),
    ("Members", 3, "cut", "76%", "cut-not-rising", "above 76%", "row 3"),
    ("Members", 3, "cut", "135%", "out-of-range", "above 0%, below 100%", "35%"),
    ("Members", 3, "cut", -5, "out-of-range", "at least 1", "35%"),
    ("Members", 3, "cut", 0.35, "out-of-range", "at least 1", "35%"),
    ("Members", 3, "cut", "half", "not-a-number", None, "write a number"),
    ("Members", 3, "slope", -1, "out-of-range", "at least 0", "at least 0"),
    ("Members", 3, "align", "center", "unknown-value", ALIGNMENTS, "did you mean centre"),
    ("Members", 3, "align_to", "next", "unknown-value", "axis, previous, surface", "axis"),
    ("Members", 4, "align_to", "surface", "alignment", None, "top or bottom"),
    ("Members", 2, "align_to", "previous", "nothing-previous", None, "write axis"),
    ("Members", 3, "roll", 5, "first-segment-only", None, "segment 1"),
    ("Members", 3, "member_offset_z", 5, "first-segment-only", None, "segment 1"),
    ("Members", 2, "roll", 400, "out-of-range", "at most 360", "degrees"),
    ("Splits", 2, "member", "M7", "unknown-name", None, "sheet Members"),
    ("Splits", 2, "face", "front", "unknown-value", FACES, FACES),
    ("Splits", 3, "face", "top", "duplicate", None, "delete or rename"),
    ("Splits", 2, "joints", "0.4 0.2 1", "joints-not-rising", "each above the one before", "0.2"),
    ("Splits", 2, "joints", "0.4 0.8 1.2", "joints-mixed", "at most 1", "ratios up to 1"),
    ("Splits", 2, "joints", "0.4 x", "not-a-number", None, "rising ratios"),
    ("Splits", 2, "joints", "0 0.5", "out-of-range", "above 0", "rising ratios"),
    ("Splits", 2, "joints", None, "value-missing", None, "fill in joints"),
    ("Settings", 2, "key", "station_spacin", "unknown-name", None, "did you mean station_spacing"),
    ("Settings", 3, "key", "station_spacing", "duplicate", None, "delete or rename"),
    ("Settings", 2, "value", "wide", "not-a-number", None, "write a number"),
    ("Settings", 2, "value", -500, "out-of-range", "at least 10", "at least 10 mm"),
    ("Settings", 2, "value", 1e-7, "out-of-range", "at least 10", "at least 10 mm"),
]


@pytest.mark.parametrize(
    "sheet, row, column, value, code, limit, mend",
    BAD_CELLS,
    ids=[f"{case[0]}-{case[2]}-{case[3]}" for case in BAD_CELLS],
)
def test_a_bad_cell_is_one_finding_with_place_value_and_mend(
    read, sheet, row, column, value, code, limit, mend
):
    changes = {(sheet, row, column): value}
    if (sheet, row) == ("Axes", 3):
        changes[sheet, row, "surface"] = "Hall"
    if value == "station_spacing":
        changes[sheet, row, "value"] = 500
    if value == "76%":
        row += 1
        value = "75%"
    finding = one(read, changes)
    assert finding.object == "hall.xlsx"
    assert finding.position == f"sheet {sheet}, row {row}, column {column}"
    assert (finding.code, finding.limit) == (code, limit)
    assert mend in finding.mend
    if column == "parameters" and code == "out-of-range":
        assert finding.value == "r=-1"
    elif value is not None:
        assert finding.value == (str(value) if isinstance(value, bool) else value)


def test_later_cut_must_rise_in_mm_too(read):
    finding = one(read, {("Members", 4, "cut"): 4000})
    assert finding.position == "sheet Members, row 4, column cut"
    assert (finding.code, finding.limit) == ("cut-not-rising", "above 4000")


def test_another_axis_on_a_later_segment(read):
    def second_axis(sheets):
        sheets["Axes"].append(["A2", "Hall"])
        sheets["Points"] += [["A2", 1, 0, 0, 20000], ["A2", 2, 0, 20000, 0]]
        sheets["Members"][2][2] = "A2"

    finding = one(read, {}, second_axis)
    assert (finding.code, finding.limit) == ("axis-differs", "A1")


def test_too_few_and_coincident_points(read):
    def only_one(sheets):
        del sheets["Points"][2:]

    finding = one(read, {}, only_one)
    assert (finding.position, finding.value) == ("sheet Axes, row 2, column axis", 1)
    same = {("Points", 4, "x"): 20000.0004, ("Points", 4, "y"): 0}
    finding = one(read, same)
    assert (finding.code, finding.position) == (
        "coincident-points",
        "sheet Points, row 4, column x",
    )


@pytest.mark.parametrize("sheet", [name for name in GOOD if name not in columns.OPTIONAL_SHEETS])
def test_a_missing_or_empty_sheet_is_one_finding(read, sheet):
    finding = one(read, {}, lambda sheets: sheets.pop(sheet))
    assert (finding.code, finding.position) == ("sheet-missing", f"sheet {sheet}")
    assert sheet in finding.mend
    found = findings(read, {}, lambda sheets: sheets.update({sheet: sheets[sheet][:1]}))
    assert found[0].code in ("sheet-empty", "unknown-name", "too-few-points")
    assert {"sheet-empty", "too-few-points"} & {finding.code for finding in found}
    finding = one(read, {}, lambda sheets: sheets.update({sheet: []}))
    assert (finding.code, finding.position) == ("heading-missing", f"sheet {sheet}, row 1")


FRAMES = [["axis", "s", "angle", "x", "y", "z"], ["A1", "0%", 5], ["A1", "60%", 30]]
PRESETS = [["axis", "s", "dx", "dz"], ["A1", 0, None, 10], ["A1", 9000, 5, 40]]


def test_frames_presets_and_sources_are_read(read):
    def more(sheets):
        sheets["Frames"], sheets["Presets"] = FRAMES, PRESETS
        sheets["Axes"] = [
            ["axis", "surface", "frame", "closed", "end_z"],
            ["A1", "Hall", "given", "yes", 7000],
            ["A2", "Roof", None, None, None],
        ]
        sheets["Axes"][0].append("source")
        sheets["Axes"][2].append("lines/axes.dxf # ridge")
        sheets["Surfaces"][0].append("file")
        sheets["Surfaces"].append(["Roof", "file", None, "roof.step"])

    schedule = read({}, more)
    first, second = schedule.axis("A1"), schedule.axis("A2")
    assert (first.frame, first.closed, first.end_z, first.start_z) == ("given", True, 7000, None)
    assert [(row.s.value, row.angle) for row in first.frames] == [
        (0.0, pytest.approx(math.radians(5))),
        (0.6, pytest.approx(math.radians(30))),
    ]
    assert [(row.s.value, row.move) for row in first.presets] == [
        (0, (0, 0, 10)),
        (9000, (5, 0, 40)),
    ]
    assert (second.source.file, second.source.part) == ("lines/axes.dxf", "ridge")
    assert second.coordinates().shape == (0, 3)
    assert schedule.surface("Roof").file.file == "roof.step"
    assert Path(schedule.folder).is_dir()


@pytest.mark.parametrize(
    ("sheet", "row", "cells", "code", "column"),
    [
        ("Frames", 3, ["A1", 900, 30], "places-mixed", "s"),
        ("Frames", 3, ["A1", "0%", 30], "places-not-rising", "s"),
        ("Frames", 3, ["A1", "120%", 30], "out-of-range", "s"),
        ("Frames", 3, ["A1", "60%"], "frame-row", "angle"),
        ("Frames", 3, ["A1", "60%", 5, 0, 0, 1], "frame-row", "angle"),
        ("Frames", 3, ["A1", "60%", None, 0, 1], "frame-row", "x"),
        ("Frames", 3, ["A1", "60%", None, 0, 0, 1], "frame-row", "x"),
        ("Frames", 3, ["A7", "60%", 30], "unknown-name", "axis"),
        ("Presets", 3, ["A1", -5, 30], "out-of-range", "s"),
        ("Presets", 3, ["A1", 0, 30], "places-not-rising", "s"),
        ("Presets", 3, ["A1", 100, "up"], "not-a-number", "dx"),
    ],
)
def test_a_bad_row_of_frames_or_presets_is_one_finding(read, sheet, row, cells, code, column):
    def more(sheets):
        sheets["Frames"], sheets["Presets"] = copy.deepcopy(FRAMES), copy.deepcopy(PRESETS)
        sheets[sheet][row - 1] = cells

    finding = one(read, {}, more)
    assert (finding.code, finding.position) == (code, f"sheet {sheet}, row {row}, column {column}")


def test_optional_sheets_may_be_missing(read):
    def bare(sheets):
        for name in columns.OPTIONAL_SHEETS:
            sheets.pop(name, None)

    schedule = read({("Sections", 3, "material"): None}, bare)
    assert schedule.settings.default_slope == 2.5
    assert schedule.splits_of("M1") == {}


@pytest.mark.parametrize(
    "sheet, column",
    [(name, column.name) for name in GOOD for column in columns.SHEETS[name] if column.required],
)
def test_a_missing_column_is_one_finding(read, sheet, column):
    def without(sheets):
        index = sheets[sheet][0].index(column)
        for row in sheets[sheet]:
            del row[index]

    finding = one(read, {}, without)
    assert finding.code == "column-missing"
    assert finding.position == f"sheet {sheet}, row 1, column {column}"


def test_unknown_sheets_and_columns_are_answered_with_the_nearest(read):
    finding = one(read, {}, lambda sheets: sheets.update(membres=sheets.pop("Members")))
    assert (finding.code, finding.value) == ("sheet-unknown", "membres")
    assert "did you mean Members" in finding.mend
    finding = one(read, {}, lambda sheets: sheets["Members"][0].__setitem__(3, "Sektion"))
    assert (finding.code, finding.value) == ("column-unknown", "Sektion")
    assert finding.position == "sheet Members, row 1, column Sektion"
    assert "did you mean section" in finding.mend
    finding = one(read, {("Points", 1, "x"): "x"}, lambda sheets: sheets["Points"][0].append("x"))
    assert finding.code == "duplicate"
    finding = one(read, {}, lambda sheets: sheets["Points"][1].append(7))
    assert (finding.code, finding.position, finding.value) == (
        "column-unnamed",
        "sheet Points, row 2, column F",
        7,
    )


def test_all_errors_are_found_at_once_in_reading_order(read):
    bad = {
        ("Splits", 2, "joints"): "0.4 0.2",
        ("Points", 2, "x"): "abc",
        ("Sections", 2, "h"): -1,
        ("Members", 3, "slope"): "steep",
        ("Points", 4, "z"): None,
    }
    found = findings(read, bad)
    assert [finding.position for finding in found] == [
        "sheet Points, row 2, column x",
        "sheet Points, row 4, column z",
        "sheet Sections, row 2, column h",
        "sheet Members, row 3, column slope",
        "sheet Splits, row 2, column joints",
    ]


@pytest.mark.parametrize("name", ["M/1", "..", "M1,M2", "a\\b", "M1.", "x" * 65])
def test_a_member_name_must_be_fit_for_files(read, name):
    changes = {("Members", row, "member"): name for row in (2, 3, 4)}
    changes |= {("Splits", row, "member"): "M1" for row in (2, 3)}
    found = findings(read, changes)
    assert {finding.position for finding in found if "column member" in finding.position} >= {
        "sheet Members, row 2, column member"
    }
    assert not any("sheet Splits" in finding.position for finding in found)


def test_members_that_differ_by_capitals_only_would_share_files(read):
    more = {("Members", 5, "member"): "m1", ("Members", 5, "segment"): 1}
    more |= {("Members", 5, "axis"): "A1", ("Members", 5, "section"): "S1"}
    assert one(read, more).position == "sheet Members, row 5, column member"
    for row, form in ((2, "NFC"), (5, "NFD")):
        more[("Members", row, "member")] = unicodedata.normalize(form, "Mé")
    more |= {("Members", row, "member"): more["Members", 2, "member"] for row in (3, 4)}
    more |= {("Splits", row, "member"): more["Members", 2, "member"] for row in (2, 3)}
    assert one(read, more).position == "sheet Members, row 5, column member"


def test_the_documentation_names_every_sheet_column_and_setting():
    document = (ROOT / "docs" / "schedule.md").read_text(encoding="utf-8")
    sections = dict(re.findall(r"^## (\w+)\n(.*?)(?=^## |\Z)", document, re.M | re.S))
    for sheet, row in columns.SHEETS.items():
        for column in row:
            assert f"`{column.name}`" in sections[sheet], (sheet, column.name)
    for key, setting in columns.SETTINGS.items():
        line = re.search(rf"^\| `{key}` \|[^|]*\| ([^|]*) \|", sections["Settings"], re.M)
        default = line.group(1).strip("`").replace("empty", "")
        kind = str if setting.default is None else type(setting.default)
        assert kind(default) == ("" if setting.default is None else setting.default)
    fields = [field.name for field in dataclasses.fields(Settings)]
    assert sorted(fields) == sorted(["place", *columns.SETTINGS])


def test_only_a_ring_has_a_cut_on_its_first_row_and_faces_their_own_stagger(read):
    def ring(sheets):
        sheets["Axes"] = [["axis", "surface", "closed"], ["A1", "Hall", "yes"]]
        sheets["Points"].append(["A1", 4, 0, -20000, 0])
        sheets["Members"][0] += ["stagger"]
        sheets["Members"][2] += ["top = 0  left=200"]
        sheets["Members"][3] += ["NONE"]

    schedule = read({("Members", 2, "cut"): "90%"}, ring)
    first, second, third = schedule.members[0].segments
    assert (first.cut.value, first.cut.is_ratio) == (0.9, True)
    assert (first.stagger, second.stagger, third.stagger) == ("auto", "top=0 left=200", "none")
    segments = job_of(schedule, schedule.members[0]).member.segments
    assert (segments[0].cut, segments[0].cut_is_ratio, segments[1].stagger) == (
        0.9,
        True,
        "top=0 left=200",
    )
