# SPDX-License-Identifier: LGPL-2.1-or-later
"""report.json and the console table."""

import json
import math
from dataclasses import replace

import pytest
from flat_plates import annular_sector, member, rectangle

from BendTorsionWB.core.finding import Finding, error, note
from BendTorsionWB.exchange.report import (
    findings_by_member,
    member_line,
    of_members,
    report_json,
    summary_lines,
    write_report,
)

MEMBER_KEYS = (
    "member length_mm mass_kg axis_to_surface_rms_mm axis_to_surface_max_mm "
    "torsion_error_max_deg total_torsion_deg plates centre_of_gravity_mm painted_area_mm2 zones "
    "pieces nodes welds"
)
PLATE_KEYS = (
    "mark part face piece thickness_mm area_mm2 mass_kg length_mm width_mm length_error_max_mm "
    "length_error_rms_mm length_error_bound_mm strain_max forming dxf nc1 "
    "centre_of_gravity_mm painted_area_mm2 material chamfers gross_length_mm gross_width_mm "
    "gross_area_mm2 gross_mass_kg edge_error_mm line_error_mm diagonal_error_mm "
    "centre_line_error_mm area_error_mm2 seam_mismatch_mm locked_in_stress_mpa"
)
FAILED = member(
    "M2",
    length=None,
    mass=None,
    axis_to_surface_rms=None,
    axis_to_surface_max=None,
    torsion_error_max=None,
    total_torsion=None,
    findings=(error("plate-too-thick", "M2", "thicker than half its section", value=math.nan),),
)


def read_strictly(path):
    def refuse(word):
        raise AssertionError(f"{word} is not JSON")

    return json.loads(path.read_bytes(), parse_constant=refuse)


def test_report_has_exactly_the_keys_of_the_contract(tmp_path):
    plates = (rectangle(), annular_sector(strain_max=math.inf))
    records = [member("M1", plates), FAILED]
    write_report(records, [note("n", "x", "é")], "0.1.0", tmp_path / "r.json")
    report = read_strictly(tmp_path / "r.json")
    assert list(report) == ["version", "members", "nodes", "findings"]
    first, second = report["members"]
    assert list(first) == MEMBER_KEYS.split()
    assert list(first["plates"][0]) == PLATE_KEYS.split()
    assert first["torsion_error_max_deg"] == math.degrees(1e-6)
    assert first["total_torsion_deg"] == math.degrees(0.25)
    assert first["plates"][0]["area_mm2"] == plates[0].area
    assert first["plates"][0]["dxf"] == "plates/M1-T1.dxf"
    assert first["plates"][0]["nc1"].startswith("nc1/") and first["plates"][0]["forming"] is None
    assert first["plates"][1]["strain_max"] is None
    empty = {"member": "M2", "plates": [], "zones": [], "pieces": [], "nodes": [], "welds": []}
    assert second == {**dict.fromkeys(MEMBER_KEYS.split()), **empty}
    assert list(report["findings"][0]) == list(Finding.__dataclass_fields__)
    assert [finding["object"] for finding in report["findings"]] == ["x", "M2"]
    assert report["findings"][1]["value"] is None


def test_same_records_same_bytes(tmp_path):
    for name in "ab":
        write_report([member("M1", (rectangle(),))], (), "0.1.0", tmp_path / name)
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_members_stay_in_their_order():
    report = report_json([member("M9"), member("M10"), member("M1")], (), "0")
    assert [item["member"] for item in report["members"]] == ["M9", "M10", "M1"]


@pytest.mark.parametrize(
    ("changes", "plate_changes", "passed"),
    [
        ({}, {}, True),
        ({"axis_to_surface_rms": 0.0031}, {}, "noted"),
        ({"torsion_error_max": math.radians(0.00101)}, {}, False),
        ({"axis_to_surface_rms": None}, {}, True),
        ({}, {"length_error_max": 0.0125, "length_error_bound": 0.01}, False),
        ({}, {"length_error_max": 0.0125, "length_error_bound": 0.01, "in_transition": True}, True),
        ({}, {"length_error_max": 0.021, "length_error_bound": 0.01, "in_transition": True}, False),
        ({}, {"length_error_max": 0.004, "length_error_bound": 0.0015}, "noted"),
        ({}, {"length_error_max": 9e-7, "length_error_bound": 0.0}, True),
        ({}, {"length_error_max": 2e-6, "length_error_bound": 0.0}, "noted"),
        ({}, {"length_error_max": math.nan}, False),
        ({"findings": (error("clash", "M1", "meets M2"),)}, {}, False),
    ],
)
def test_the_table_judges_each_figure_against_its_limit(changes, plate_changes, passed):
    """A figure beyond which there is a note only is told and marked, and is no limit."""
    noted, passed = passed == "noted", bool(passed)
    record = member("M1", (rectangle(), rectangle("M1-T2", **plate_changes)), **changes)
    lines = summary_lines([record], ())
    row = next(line for line in lines if line.startswith("M1"))
    assert row.endswith("ok") == passed
    assert passed or row.endswith("FAIL" if "findings" in changes else "over")
    # What the table marks is among the checks, at the plate or the member.
    beyond = [f for f in report_json([record], (), "0")["findings"] if f["code"] != "clash"]
    assert bool(beyond) == (noted or (not passed and "findings" not in changes))
    assert noted == ({f["severity"] for f in beyond} == {"note"})
    assert ("*" in row) == any("no limit" in line for line in lines) >= noted
    assert {f["object"] for f in beyond} <= {"M1", "M1-T2"}
    assert all(f["limit"] and f["message"] and f["mend"] for f in beyond)
    assert lines[-1].startswith(f"{int(passed)} of 1 members within the limits")
    if "findings" not in changes:
        assert ("!" in row) != passed


def test_an_error_that_names_a_plate_fails_its_member_only():
    records = [member("M1", (rectangle(),)), member("M2", (rectangle("M2-T1"),)), FAILED]
    records[2] = replace(FAILED, member="M3", findings=())
    lines = summary_lines(records, [error("x", "M2-T1", "bad")])
    verdicts = {line.split()[0]: line.split()[-1] for line in lines if line[0] == "M"}
    assert verdicts == {"M1": "ok", "M2": "FAIL", "M3": "FAIL"}
    assert "1 error," in lines[-1]
    assert all(len(line) <= 140 for line in lines)


def test_nothing_built_is_no_success():
    assert summary_lines([], [])[-1].startswith("0 of 0")
    assert not any(line.endswith("ok") for line in summary_lines([], []))


def test_findings_are_told_of_their_members_in_their_order():
    """As looking at each finding for each member tells."""
    own = note("own", "elsewhere", "of its record")
    records = [
        member("M1", (rectangle(mark="M1-T1"),), findings=(own,)),
        member("M1-D1", (rectangle(mark="M1-D1-T1"),)),
        member("M2", (rectangle(mark="M2-T1"),), findings=(own,)),
    ]
    objects = ("M2-T1", "M1", "M1-D1", "M1-D1-T1, M2", "hall.xlsx", "M1-T1", "M1-D1-B9", "M", "")
    known = [*(note(f"n{k}", name, "found") for k, name in enumerate(objects)), own]
    told = findings_by_member(records, known)
    for record in records:
        names = {record.member, *(plate.mark for plate in record.plates)}
        expected = [f for f in known if f in record.findings or names & set(f.objects)]
        assert told[record.member] == expected and expected
    by_name = of_members([record.member for record in records], known)
    for name, found in by_name.items():
        expected = [
            f for f in known if any(o == name or o.startswith(f"{name}-") for o in f.objects)
        ]
        assert list(found) == expected and expected


def test_lines_made_before_give_the_same_file(tmp_path):
    records = [member("M1", (annular_sector(),)), member("M2")]
    write_report(records, (), "1.0", tmp_path / "at once.json")
    lines = [member_line(record) for record in records]
    write_report(records, (), "1.0", tmp_path / "lines.json", None, lines)
    assert (tmp_path / "lines.json").read_bytes() == (tmp_path / "at once.json").read_bytes()
