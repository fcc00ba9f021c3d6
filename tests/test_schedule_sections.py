# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sections of every type from a schedule: read, refused by name, built end to end."""

import json

import FreeCAD
import numpy as np
import openpyxl
import pytest
from schedule_books import findings, one, read_schedule, write

from BendTorsionWB.__main__ import main
from BendTorsionWB.core.sections.section_types import section_of
from BendTorsionWB.document import build_document
from BendTorsionWB.exchange.schedule_jobs import job_of
from BendTorsionWB.exchange.schedule_jobs import section_of as core_section_of
from BendTorsionWB.objects import section_spec
from BendTorsionWB.round_trip import write_back

R = 15000.0
RING = ((0, 0), (500, 0), (600, 400), (100, 500))
SECTIONS = [
    "section type catalogue h b b_bottom t t_top t_bottom t_web gap1 gap2 corner_joint corners "
    "thicknesses".split(),
    ["SB", "box1", None, 400, 300, None, 12, None, None, 10, 2],
    ["SI", "i", None, 400, 300, 200, 16, None, 20, 10],
    ["ST", "tee", None, 300, 200, None, 12, None, None, 8],
    ["SC", "channel", None, 400, 150, None, 12, None, None, 10, None, 3],
    ["SZ", "trapezoid", None, 400, 500, 300, 12] + [None] * 5 + ["webs"],
    ["SP", "polygon"] + [None] * 10 + ["mitre", "0 0; 500 0; 600 400; 100 500", "12 12 14 12"],
    ["SF", "strips"],
    ["SH", None, "HEB 300"],
]
STRIPS = [
    "section face letter y1 z1 y2 z2 t side stop1 stop2".split(),
    ["SF", "deck", "D", 200, 0, -200, 0, 12, "left", None, None],
    ["SF", "rib", "R", 50, 0, 50, -200, 10, None, "deck 2", None],
]
NAMES = [row[0] for row in SECTIONS[1:]]
BOOK = {
    "Surfaces": [["surface", "kind", "parameters"], ["Hall", "cylinder", "r=15000"]],
    "Points": [["axis", "no", "x", "y", "z"]]
    + [
        [f"A{name}", k + 1, *np.round([R * np.cos(a), R * np.sin(a), 6e3 * a + up], 3).tolist()]
        for up, name in zip(range(0, 8000, 1000), NAMES, strict=True)
        for k, a in enumerate(np.linspace(0.0, 0.15, 4))
    ],
    "Axes": [["axis", "surface"], *([f"A{name}", "Hall"] for name in NAMES)],
    "Sections": SECTIONS,
    "Strips": STRIPS,
    "Members": [["member", "segment", "axis", "section", "align", "align_to"]]
    + [[f"M{name}", 1, f"A{name}", name, "top", "surface"] for name in NAMES],
    "Splits": [
        ["member", "face", "joints"],
        ["MSI", "web", "0.6"],
        ["MSP", "side2", "0.4"],
        ["MSF", "rib", "auto"],
    ],
}
PLATES = {"SB": 4, "SI": 4, "ST": 2, "SC": 3, "SZ": 4, "SP": 5, "SF": 2, "SH": 3}


def book(tmp_path, **changed):
    return write(tmp_path / "types.xlsx", {**BOOK, **changed})


def test_every_type_is_read_as_the_core_makes_it(tmp_path):
    schedule = read_schedule(book(tmp_path))
    assert core_section_of(schedule, "SI") == section_of(
        "SI", "i", h=400.0, b=300.0, b_bottom=200.0, t_top=16.0, t_bottom=20.0, t_web=10.0
    )
    assert core_section_of(schedule, "SZ") == section_of(
        "SZ", "trapezoid", h=400.0, b=500.0, b_bottom=300.0, t_top=12.0, joint="webs"
    )
    assert core_section_of(schedule, "SP") == section_of(
        "SP", "polygon", corners=RING, thickness=(12.0, 12.0, 14.0, 12.0), joint="mitre"
    )
    heb = core_section_of(schedule, "SH")
    assert (heb.type, heb.h, heb.b) == ("i", 300.0, 300.0)
    assert [strip.thickness for strip in heb.strips] == [19.0, 19.0, 11.0]
    free = core_section_of(schedule, "SF")
    assert [(s.face, s.letter, s.thickness) for s in free.strips] == [
        ("deck", "D", 12.0),
        ("rib", "R", 10.0),
    ]
    assert free.strips[1].stops_at_first == ("deck", 2.0, "inner")


def test_the_document_has_the_same_sections_and_builds_them_all(tmp_path):
    schedule = read_schedule(book(tmp_path))
    jobs = {row.name: job_of(schedule, row) for row in schedule.members}
    document = build_document(schedule, jobs, sheets=False)
    try:
        document.recompute()
        of = {(o.BT_Type, o.Label): o for o in document.Objects if hasattr(o, "BT_Type")}
        for name in NAMES:
            assert section_spec.value(of["SectionSpec", name]) == core_section_of(schedule, name)
            plates = of["PlateSet", f"M{name} plates"]
            assert plates.Status == "ok", plates.Status
            assert plates.PlateCount == PLATES[name]
            assert all(solid.isValid() for solid in plates.Shape.Solids)
        # Written back, the schedule says the same sections, alignments and joints.
        assert write_back(document, tmp_path / "back.xlsx") == ()
        again = read_schedule(tmp_path / "back.xlsx")
        for name in NAMES:
            assert core_section_of(again, name) == core_section_of(schedule, name)
            assert again.member(f"M{name}").segments[0].align_to == "surface"
    finally:
        FreeCAD.closeDocument(document.Name)


def test_a_schedule_with_every_type_builds_from_the_command_line(tmp_path):
    out = tmp_path / "out"
    assert main(["build", str(book(tmp_path)), "--out", str(out)]) == 0
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    counts = {member["member"]: len(member["plates"]) for member in report["members"]}
    assert counts == {f"M{name}": count for name, count in PLATES.items()}
    for member in report["members"]:
        for plate in member["plates"]:
            assert (out / plate["dxf"]).exists() and plate["length_error_max_mm"] < 0.012
    summary = openpyxl.load_workbook(out / "results.xlsx")["Summary"]
    types = {row[0]: row[2] for row in summary.iter_rows(2, len(NAMES) + 1, values_only=True)}
    assert types["MSF"] == "strips" and types["MSH"] == "i"


def changed(rows, row, column, value):
    rows = [list(line) for line in rows]
    index = rows[0].index(column)
    rows[row - 1] += [None] * (index + 1 - len(rows[row - 1]))
    rows[row - 1][index] = value
    return rows


@pytest.mark.parametrize(
    "sheet, row, column, value, code, position, mend",
    [
        ("Sections", 3, "t_web", 200, "plate-too-thick", "Sections, row 3, column t_web", "t_web"),
        ("Sections", 4, "b_bottom", 90, "size-not-used", "Sections, row 4, column b_bottom", "tee"),
        ("Sections", 4, "t", None, "value-missing", "Sections, row 4, column t", "t_top and t_web"),
        ("Sections", 6, "b_bottom", None, "value-missing", "Sections, row 6, column b_bottom", ""),
        ("Sections", 6, "corner_joint", "ring", None, "Sections, row 6, column corner_joint", ""),
        ("Sections", 7, "corners", "0 0; 5 5", "section-corners", "Sections, row 7, column c", ""),
        ("Sections", 7, "corners", None, "value-missing", "Sections, row 7, column corners", ""),
        ("Sections", 9, "h", 310, "size-not-used", "Sections, row 9, column h", "empty the cell"),
        ("Sections", 9, "type", "box1", "catalogue-type", "Sections, row 9, column type", "empty"),
        ("Strips", 3, "stop1", "roof 2", "strip-stop", "Strips, row 3, column stop1", "face of"),
        ("Strips", 3, "face", "deck", "strip-name", "Strips, row 2, column face", "its own"),
        ("Strips", 3, "t", 0, "out-of-range", "Strips, row 3, column t", "above 0"),
        ("Strips", 3, "section", "S9", "unknown-name", "Strips, row 3, column section", "Sections"),
        ("Splits", 2, "face", "left", "unknown-value", "Splits, row 2, column face", "top, bottom"),
    ],
)
def test_what_makes_no_section_is_named_at_its_cell(
    tmp_path, sheet, row, column, value, code, position, mend
):
    wrong = {sheet: changed(BOOK[sheet], row, column, value)}
    if (sheet, column) in (("Strips", "section"), ("Strips", "face")):
        wrong["Splits"] = BOOK["Splits"][:-1]
    found = findings(read_schedule, book(tmp_path, **wrong))
    assert found[0].position.startswith(f"sheet {position}")
    assert code in (None, found[0].code) and mend in found[0].mend


def test_strips_of_a_section_of_another_type_are_refused(tmp_path):
    wrong = book(tmp_path, Strips=[*STRIPS, ["SB", "a", "A", 0, 0, 100, 0, 10]])
    finding = one(read_schedule, wrong)
    assert finding.code == "strips-not-used" and "row 4" in finding.position


def test_a_section_of_strips_without_rows_is_refused(tmp_path):
    wrong = book(tmp_path, Strips=STRIPS[:1], Splits=BOOK["Splits"][:-1])
    finding = one(read_schedule, wrong)
    assert finding.code == "strips-missing" and "row 8" in finding.position
