# SPDX-License-Identifier: LGPL-2.1-or-later
"""Preparations and welds from the schedule: read, resolved, in the workbook, refused at a cell."""

import math

import openpyxl
import pytest
from schedule_books import one

from BendTorsionWB.core.detailing import detail
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.results_workbook import write_results
from BendTorsionWB.exchange.schedule_jobs import at_rows, job_of, located

PREPS = [
    ["prep", "type", "angle", "land", "gap", "side", "backing"],
    ["B6", "bevel", 35, None, 2, "outer", "30x6"],
    ["X", "double-v", 60, 2, 3, None, None],
]


def with_welds(*rows, preps=PREPS):
    def edit(sheets):
        sheets["Preps"] = preps
        sheets["Edges"] = [["member", "seam", "from", "to", "prep", "place", "ndt"], *rows]

    return edit


def test_rows_reach_the_welds_of_the_workbook(read, tmp_path):
    schedule = read(
        {},
        with_welds(
            ["M1", "TL", "10%", 9000, "B6", "field", "UT"],
            ["M1", "joints", None, None, "v angle=50 land=1", None, None],
        ),
    )
    record = detail(job_of(schedule, schedule.member("M1"))).record
    length = record.length
    own = [weld for weld in record.welds if weld.name == "TL" and weld.prep.name == "B6"]
    assert min(w.start for w in own) == pytest.approx(0.1 * length)
    assert max(w.end for w in own) == pytest.approx(9000.0)
    assert {(w.place, w.ndt, w.prep.backing) for w in own} == {("field", "UT", (30.0, 6.0))}
    write_results([record], (), tmp_path / "r.xlsx")
    book = openpyxl.load_workbook(tmp_path / "r.xlsx", data_only=True)
    head, *rows = book["Welds"].iter_rows(values_only=True)
    table = [dict(zip(head, row, strict=True)) for row in rows]
    assert len(table) == len(record.welds)
    fields = [row for row in table if row["place"] == "field"]
    assert all(row["angle"] == pytest.approx(35.0) and row["backing"] == "30x6" for row in fields)
    joints = [row for row in table if row["kind"] == "joint"]
    assert joints and all(row["angle"] == pytest.approx(50.0) for row in joints)
    assert len(joints) == book["Joints"].max_row - 1


def test_default_preparations_are_the_rule_packs(read):
    schedule = read()
    record = detail(job_of(schedule, schedule.member("M1"))).record
    seams = [weld for weld in record.welds if weld.kind == "seam"]
    assert {(w.prep.type, round(math.degrees(w.prep.angle))) for w in seams} == {("bevel", 45)}


@pytest.mark.parametrize(
    "row, code, place",
    [
        (["M1", "TL", None, None, "B7", None, None], "unknown-name", "column prep"),
        (["M1", "TL", None, None, "v angle", None, None], "unknown-name", "column prep"),
        (["M1", "TL", None, None, None, "yard", None], "unknown-value", "column place"),
        (["M9", "TL", None, None, None, None, None], "unknown-name", "column member"),
        (["M1", "TL", "120%", None, None, None, None], None, "column from"),
    ],
)
def test_bad_cells_are_refused_at_their_place(read, row, code, place):
    finding = one(read, {}, with_welds(row))
    assert finding.position == f"sheet Edges, row 2, {place}"
    assert code in (None, finding.code)


def test_a_groove_that_does_not_fit_is_refused_at_its_row(read):
    thick = [PREPS[0], ["L", "bevel", 60, 20, 0, None, None]]
    schedule = read({}, with_welds(["M1", "TL", None, None, "L", None, None], preps=thick))
    row = schedule.member("M1")
    with pytest.raises(BendTorsionError) as caught:
        detail(job_of(schedule, row))
    finding = located(schedule, row, caught.value.findings[-1])
    assert (finding.code, finding.position) == ("prep-land", "sheet Edges, row 2, column prep")


def test_a_row_that_matches_nothing_is_an_error_at_its_cell(read):
    schedule = read(
        {}, with_welds(["M1", "TL", None, None, None, None, None], ["M1", "XY", *[None] * 5])
    )
    row = schedule.member("M1")
    with pytest.raises(BendTorsionError) as caught:
        detail(job_of(schedule, row))
    (finding,) = (located(schedule, row, own) for own in caught.value.findings)
    assert (finding.severity, finding.code) == ("error", "edge-row-unused")
    assert finding.position == "sheet Edges, row 3, column seam"


@pytest.mark.parametrize(
    "row, code, column",
    [
        (["M1", "TL", None, None, "v angle=60", None, None], "prep-corner", "prep"),
        (["M1", "TL", None, None, "fillet leg=8", None, None], "fillet-ledge", "prep"),
        (["M1", "TL", 3000, 1000, "bevel angle=45", None, None], "edge-row-order", "from"),
        (["M1", "TL", None, None, "bevel angle=80", None, None], "bevel-steep", "prep"),
    ],
)
def test_welds_that_cannot_be_made_are_refused_at_their_row(read, row, code, column):
    schedule = read({}, with_welds(["M1", "TR", *[None] * 5], row))
    member = schedule.member("M1")
    with pytest.raises(BendTorsionError) as caught:
        detail(job_of(schedule, member))
    told = (located(schedule, member, own) for own in caught.value.findings)
    found = {(finding.code, finding.position) for finding in told}
    assert found == {(code, f"sheet Edges, row 3, column {column}")}


def test_warnings_of_rows_tell_sheet_and_row(read):
    rows = ["M1", "TR", *[None] * 5], ["M1", "TL", 0, 1000, "B6", None, None]
    schedule = read({}, with_welds(*rows))
    findings = detail(job_of(schedule, schedule.member("M1"))).record.findings
    assert "edge 2" in {f.position for f in findings if f.code == "root-gap-whole-seam"}
    (told,) = (f for f in at_rows(schedule, findings) if f.code == "root-gap-whole-seam")
    assert (told.object, told.position) == ("M1", "sheet Edges, row 3, column prep")


def test_all_that_is_wrong_with_preparations_is_told_at_once(read):
    preps = [
        PREPS[0],
        ["A", "bevel", None, 2, 0, None, None],  # no angle, used by no row
        ["B", "double-v", 60, 2, 0, None, "30x6"],  # a bar where both sides are welded
        ["C", "v", None, 2, 0, None, "30x6"],
        ["D", "v", "steep", 2, 0, None, None],
    ]
    edit = with_welds(["M1", "TL", None, None, "bevel land=2", None, None], preps=preps)
    with pytest.raises(BendTorsionError) as caught:
        read({}, edit)
    found = [(f.code, f.position) for f in caught.value.findings]
    assert found == [
        ("prep-angle", "sheet Preps, row 2, column angle"),
        ("prep-backing", "sheet Preps, row 3, column backing"),
        ("prep-angle", "sheet Preps, row 4, column angle"),
        ("not-a-number", "sheet Preps, row 5, column angle"),
        ("prep-angle", "sheet Edges, row 2, column prep"),
    ]
