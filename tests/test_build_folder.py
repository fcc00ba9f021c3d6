# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a build does to the folder it writes into, and what it says before it starts."""

from pathlib import Path

import openpyxl
import pytest

from BendTorsionWB import project
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.shapes import brep

HALL = Path(__file__).parent.parent / "resources/examples/concert_hall/concert_hall.xlsx"


def cut_files(out: Path, member: str) -> list[str]:
    return sorted(
        str(path.relative_to(out)) for path in out.rglob(f"{member}*") if path.suffix != ".xlsx"
    )


def only_member(target: Path, name: str) -> Path:
    """The hall's workbook with one member left."""
    book = openpyxl.load_workbook(HALL)
    for sheet in ("Members", "Splits"):
        rows = book[sheet]
        for row in range(rows.max_row, 1, -1):
            if rows.cell(row, 1).value != name:
                rows.delete_rows(row)
    book.save(target)
    return target


def test_files_of_a_member_go_with_it_even_after_a_partial_build(tmp_path):
    out = tmp_path / "out"
    project.build(HALL, out, ["M1", "M7"])
    mine, other = cut_files(out, "M1"), cut_files(out, "M7")
    (out / "plates" / "M7-notes.txt").write_text("not ours", encoding="utf-8")
    # A PDF, a DXF and an NC1 file per plate, and templates at the ends and between.
    assert len(mine) > 51 and len(other) > 9
    for member, found in (("M1", mine), ("M7", other)):
        assert {f"templates/{member}-E1.dxf", f"templates/{member}-E2.dxf"} <= set(found)
    project.build(HALL, out, ["M1"])
    assert cut_files(out, "M1") == mine and set(other) < set(cut_files(out, "M7"))
    project.build(only_member(tmp_path / "one.xlsx", "M1"), out)
    assert cut_files(out, "M1") == mine
    assert cut_files(out, "M7") == ["plates/M7-notes.txt"]


def test_a_folder_that_cannot_be_is_refused_before_anything_is_computed(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("", encoding="utf-8")
    monkeypatch.setattr(project, "detail_members", lambda *_: pytest.fail("computed"))
    for out in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(BendTorsionError) as problem:
            project.build(HALL, out, ["M7"])
        assert [f.code for f in problem.value.findings] == ["folder-is-file"]


def test_a_point_out_of_place_is_named_before_what_it_breaks(tmp_path):
    book = openpyxl.load_workbook(HALL)
    points = book["Points"]
    header = [cell.value for cell in points[1]]
    row = next(r for r in points.iter_rows(min_row=2) if r[0].value == "A1" and r[1].value == 4)
    row[header.index("z")].value += 900.0
    book.save(tmp_path / "typo.xlsx")
    schedule, jobs = project.read_jobs(tmp_path / "typo.xlsx", ["M1"])
    try:
        findings = project.compute(schedule, jobs)["M1"].record.findings
    except BendTorsionError as problem:
        findings = problem.findings
    assert findings[0].code.startswith("axis-point")
    assert "point" in findings[0].position or f"row {row[0].row}" in findings[0].position


def test_plates_beside_a_joint_on_a_fold_keep_clear():
    """M10: left face jointed at 0.6, where the cut at 60 % folds the top face."""
    schedule, jobs = project.read_jobs(HALL, ["M10"])
    plates = project.compute(schedule, jobs)["M10"].plates.plates
    made = {item.plate.mark: item for item in plates}
    assert made["M10-L3"].plate.end == made["M10-T4"].plate.rails.boundaries[0]
    top, before, behind = (
        brep.tube_solid([(p.knots, p.poles) for p in made[mark].skin])
        for mark in ("M10-T4", "M10-L3", "M10-L4")
    )
    assert top.common(before).Volume < 1e-3
    assert top.common(behind).Volume < 1e-3
