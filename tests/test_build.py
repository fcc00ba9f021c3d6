# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line from a schedule to files: what is written, exit codes, failures, reruns."""

import json
import locale
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import ezdxf
import ezdxf.bbox
import FreeCAD
import openpyxl
import Part
import pytest
from curved_members import diagonal, irregular

from BendTorsionWB import __version__
from BendTorsionWB.__main__ import main

ROOT = Path(__file__).resolve().parent.parent
PLATE_KEYS = {
    "mark",
    "part",
    "face",
    "piece",
    "thickness_mm",
    "area_mm2",
    "mass_kg",
    "length_mm",
    "width_mm",
    "length_error_max_mm",
    "length_error_rms_mm",
    "length_error_bound_mm",
    "strain_max",
    "forming",
    "dxf",
    "nc1",
}
MEMBER_KEYS = {
    "member",
    "length_mm",
    "mass_kg",
    "axis_to_surface_rms_mm",
    "axis_to_surface_max_mm",
    "torsion_error_max_deg",
    "total_torsion_deg",
    "plates",
}
FINDING_KEYS = {
    "severity",
    "code",
    "object",
    "position",
    "value",
    "limit",
    "unit",
    "message",
    "mend",
}


def short(start, end, shift=0.0):
    """Points of a part of the ellipsoid's diagonal, moved along z."""
    points = irregular(lambda t: diagonal(start + (end - start) * t), 8)
    return [[x, y, z + shift] for x, y, z in points]


def schedule(path, axes):
    """A schedule with one member per axis: M1 changes its section, the others do not."""
    sheets = {
        "Surfaces": [
            ["surface", "kind", "parameters"],
            ["Hall", "ellipsoid", "a=40000 b=30000 c=20000"],
        ],
        "Axes": [["axis", "surface"]],
        "Points": [["axis", "no", "x", "y", "z"]],
        "Sections": [
            ["section", "type", "h", "b", "t"],
            ["B600", "box1", 600, 600, 16],
            ["B500", "box1", 500, 500, 12],
        ],
        "Members": [["member", "segment", "axis", "section", "cut", "align"]],
        "Splits": [
            ["member", "face", "joints"],
            ["M1", "top", "0.3 0.6 1"],
            ["M1", "left", "1000"],
        ],
    }
    for k, points in enumerate(axes, start=1):
        sheets["Axes"].append([f"A{k}", "Hall"])
        sheets["Points"] += [[f"A{k}", n, *point] for n, point in enumerate(points, start=1)]
        sheets["Members"].append([f"M{k}", 1, f"A{k}", "B600", None, "top"])
        if k == 1:
            sheets["Members"].append([f"M{k}", 2, f"A{k}", "B500", "45%", "top"])
    book = openpyxl.Workbook()
    book.remove(book.active)
    for title, rows in sheets.items():
        page = book.create_sheet(title)
        for row in rows:
            page.append(row)
    book.save(path)
    return path


def changed(path, axes, cells):
    """The schedule with single cells {(sheet, row, column): value} changed."""
    schedule(path, axes)
    book = openpyxl.load_workbook(path)
    for (sheet, row, column), value in cells.items():
        titles = [cell.value for cell in book[sheet][1]]
        book[sheet].cell(row, titles.index(column) + 1, value)
    book.save(path)
    return path


def run(*arguments, hash_seed="1"):
    """The command line in a process of its own; hash_seed settles the order of sets."""
    return subprocess.run(
        [sys.executable, "-m", "BendTorsionWB", *map(str, arguments)],
        cwd=ROOT,
        capture_output=True,
        encoding="utf-8",
        timeout=300,
        env={**os.environ, "PYTHONHASHSEED": hash_seed},
    )


@pytest.fixture
def tell(capsys):
    """The command line in this process: exit code, what it printed, and its error lines."""
    before = locale.setlocale(locale.LC_CTYPE)

    def call(*arguments):
        code = main([str(a) for a in arguments])
        printed = capsys.readouterr()
        return (
            code,
            printed.out,
            [line for line in printed.err.splitlines() if line.startswith("error")],
        )

    yield call
    # Qt's application resets it, and other tests talk to their processes by it.
    locale.setlocale(locale.LC_CTYPE, before)


def files(folder):
    """By name; the cache of results, which may be deleted at any time, apart."""
    found = {str(path.relative_to(folder)): path for path in folder.rglob("*") if path.is_file()}
    return {name: path for name, path in found.items() if not name.startswith(".cache")}


def report(out):
    return json.loads((out / "report.json").read_text(encoding="utf-8"))


APART = (short(0.0, 0.2), short(0.75, 0.95))


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A good build of two members: schedule, folder and the finished process."""
    folder = tmp_path_factory.mktemp("build")
    path = schedule(folder / "two.xlsx", APART)
    return path, folder / "out", run("build", path, "--out", folder / "out", "--jobs", 2)


def test_a_good_build_ends_with_0_and_a_table(built):
    _, _, process = built
    assert process.returncode == 0, process.stderr
    assert "Traceback" not in process.stderr
    assert "M1" in process.stdout and "M2" in process.stdout and "limits" in process.stdout


def test_the_report_has_the_keys_promised_and_names_the_files_that_are_there(built):
    _, out, _ = built
    content = report(out)
    assert set(content) == {"version", "members", "nodes", "findings"}
    assert [m["member"] for m in content["members"]] == ["M1", "M2"]
    named = set()
    for member in content["members"]:
        assert set(member) >= MEMBER_KEYS
        assert member["plates"] and member["mass_kg"] > 0
        assert member["axis_to_surface_rms_mm"] <= 0.003
        assert member["torsion_error_max_deg"] <= 0.001
        named.add(f"sheets/{member['member']}.pdf")
        for plate in member["plates"]:
            assert set(plate) >= PLATE_KEYS
            assert plate["length_error_max_mm"] <= 0.02
            assert plate["mass_kg"] == pytest.approx(
                plate["area_mm2"] * plate["thickness_mm"] * 7.85e-6, rel=0.02
            )
            named |= {plate[key] for key in ("dxf", "nc1") if plate[key]}
    for finding in content["findings"]:
        assert set(finding) == FINDING_KEYS and finding["severity"] != "error"
    whole = {"model.FCStd", "model.step", "model.ifc", "results.xlsx", "report.json"}
    whole |= {"report.html", "nesting.csv", "timing.json", ".bendtorsion.json", "README.txt"}
    whole |= {".bendtorsion-parts.json", ".bendtorsion-outlines.npz"}
    whole |= {"plates/all/16mm S355.dxf", "plates/all/12mm S355.dxf"}
    whole |= {"sheets/general_arrangement.pdf", "sheets/set.pdf"}
    boards = {name for name in files(out) if name.startswith("templates/")}
    for member in ("M1", "M2"):
        assert {f"templates/{member}-E1.dxf", f"templates/{member}-E2.dxf"} <= boards
    assert set(files(out)) - boards == named | whole


def test_cut_files_hold_the_plates_of_the_report(built):
    _, out, _ = built
    plates = {p["mark"]: p for m in report(out)["members"] for p in m["plates"]}
    assert {path.stem for path in (out / "plates").glob("*.dxf")} == set(plates)
    for mark, plate in plates.items():
        drawing = ezdxf.readfile(out / "plates" / f"{mark}.dxf")
        assert not drawing.audit().errors
        [outer] = drawing.modelspace().query('LWPOLYLINE[layer=="CUT_OUTER"]')
        assert outer.closed
        box = ezdxf.bbox.extents([outer])
        assert tuple(box.size)[:2] == pytest.approx(
            (plate["length_mm"], plate["width_mm"]), abs=0.1
        )


def test_the_step_file_holds_the_solids_with_their_mass(built):
    _, out, _ = built
    shape = Part.Shape()
    shape.read(str(out / "model.step"))
    members = report(out)["members"]
    assert len(shape.Solids) == sum(len(m["plates"]) for m in members)
    mass = sum(solid.Volume for solid in shape.Solids) * 7.85e-6
    assert mass == pytest.approx(sum(m["mass_kg"] for m in members), rel=1e-4)


def test_the_model_opens_and_a_recompute_changes_nothing(built, tmp_path):
    _, out, _ = built
    copy = shutil.copy(out / "model.FCStd", tmp_path / "model.FCStd")
    document = FreeCAD.openDocument(str(copy), hidden=True)
    try:
        sets = [o for o in document.Objects if getattr(o, "BT_Type", "") == "PlateSet"]
        masses = {o.Member.Label: o.Mass for o in sets}
        for obj in document.Objects:
            obj.touch()
        document.recompute()
        for member in report(out)["members"]:
            assert masses[member["member"]] == pytest.approx(member["mass_kg"], rel=1e-12)
        assert all(o.Status == "ok" for o in sets)
        assert masses == {o.Member.Label: pytest.approx(o.Mass, rel=1e-9) for o in sets}
    finally:
        FreeCAD.closeDocument(document.Name)


def test_the_same_schedule_gives_the_same_bytes(built, tmp_path):
    path, out, _ = built
    again = tmp_path / "again"
    assert run("build", path, "--out", again, "--jobs", 1, hash_seed="2").returncode == 0
    first, second = files(out), files(again)
    assert set(first) == set(second)
    for name in set(first) - {"timing.json"}:
        assert first[name].read_bytes() == second[name].read_bytes(), name
    assert zipfile.ZipFile(first["model.FCStd"]).testzip() is None


def test_a_rerun_replaces_its_own_files_only_and_removes_what_went(built, tmp_path):
    path, out, _ = built
    here = tmp_path / "out"
    shutil.copytree(out, here)
    (here / "plates" / "mine.dxf").write_text("mine", encoding="utf-8")
    (here / "notes.txt").write_text("mine", encoding="utf-8")
    book = openpyxl.load_workbook(path)
    book["Splits"].delete_rows(2, 2)
    fewer = tmp_path / "fewer.xlsx"
    book.save(fewer)
    process = run("build", fewer, "--out", here, "--only", "M1")
    assert process.returncode == 0, process.stderr
    assert (here / "plates" / "mine.dxf").read_text(encoding="utf-8") == "mine"
    assert (here / "notes.txt").read_text(encoding="utf-8") == "mine"
    before = {p["mark"] for p in report(out)["members"][0]["plates"]}
    after = {p["mark"] for m in report(here)["members"] for p in m["plates"] if m["member"] == "M1"}
    assert after < before
    on_disk = {p.stem for p in (here / "plates").glob("M1-*.dxf")}
    assert on_disk == after
    # Files of members not built now stay.
    assert {p.name for p in (here / "plates").glob("M2-*.dxf")} == {
        p.name for p in (out / "plates").glob("M2-*.dxf")
    }


def test_members_that_intersect_fail_and_the_others_are_whole(built, tmp_path):
    _, out, _ = built
    crossing = [*APART, short(0.02, 0.22, 60.0)]
    path = schedule(tmp_path / "three.xlsx", crossing)
    here = tmp_path / "out"
    shutil.copytree(out, here)
    process = run("build", path, "--out", here)
    assert process.returncode == 1
    assert "Traceback" not in process.stderr
    members = {m["member"]: m for m in report(here)["members"]}
    assert list(members) == ["M1", "M2", "M3"]
    assert members["M1"]["plates"] == [] and members["M3"]["plates"] == []
    assert members["M2"]["plates"]
    assert not list(here.glob("*/M1*")) and not list(here.glob("*/M3*"))
    assert {p.stem for p in (here / "plates").glob("*.dxf")} == {
        p["mark"] for p in members["M2"]["plates"]
    }
    errors = [f for f in report(here)["findings"] if f["severity"] == "error"]
    assert {f["object"] for f in errors} == {"M1, M3"}
    assert all("M1 meets M3" in f["message"] and f["position"] for f in errors)
    assert "error: M1, M3" in process.stderr
    shape = Part.Shape()
    shape.read(str(here / "model.step"))
    assert len(shape.Solids) == len(members["M2"]["plates"])


def test_without_a_healthy_member_the_report_says_so_and_no_solids_stay(built, tmp_path):
    _, out, _ = built
    path = schedule(tmp_path / "both.xlsx", [APART[0], short(0.02, 0.22, 60.0)])
    here = tmp_path / "out"
    shutil.copytree(out, here)
    process = run("build", path, "--out", here)
    assert process.returncode == 1 and "Traceback" not in process.stderr
    assert [m["plates"] for m in report(here)["members"]] == [[], []]
    assert not (here / "model.step").exists() and (here / "model.FCStd").exists()
    assert not (here / "model.ifc").exists() and not (here / "nesting.csv").exists()
    assert not [p for p in files(here).values() if p.suffix in (".dxf", ".nc1", ".pdf")]


BAD = {
    "unknown section": ({("Members", 2, "section"): "B900"}, ("Members", "B900")),
    "text for a number": ({("Sections", 2, "h"): "tall"}, ("Sections", "tall")),
    "cut beyond the axis": ({("Members", 3, "cut"): 99000}, ("Members", "99000")),
    "plate too thick": ({("Sections", 2, "t"): 300}, ("Sections", "300")),
    "falling ratios": ({("Splits", 2, "joints"): "0.6 0.3 1"}, ("Splits", "0.6")),
    "joint beyond the axis": ({("Splits", 3, "joints"): "50000"}, ("Splits", "50000")),
    "transition past the end": ({("Members", 3, "cut"): "99.9%"}, ("Members", "cut")),
    "section larger than the bend": (
        {
            ("Sections", 2, "h"): 49000,
            ("Sections", 2, "b"): 49000,
            ("Sections", 3, "h"): 49000,
            ("Sections", 3, "b"): 49000,
        },
        ("Members",),
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_a_bad_schedule_ends_with_2_one_line_each_and_nothing_written(case, tmp_path, tell):
    cells, words = BAD[case]
    path = changed(tmp_path / "bad.xlsx", APART, cells)
    out = tmp_path / "out"
    code, _, lines = tell("build", path, "--out", out, "--jobs", 1)
    assert code == 2 and not out.exists() and lines
    assert all("bad.xlsx" in line and "->" in line for line in lines)
    for word in words:
        assert any(word in line for line in lines), lines


def test_a_file_that_is_no_workbook_ends_with_2(tmp_path, tell):
    path = tmp_path / "notes.xlsx"
    path.write_text("not a workbook", encoding="utf-8")
    for name in (path, tmp_path / "missing.xlsx"):
        code, _, [line] = tell("build", name, "--out", tmp_path / "out")
        assert code == 2 and not (tmp_path / "out").exists() and name.name in line


def test_bad_input_shows_no_traceback(tmp_path):
    process = run("build", tmp_path / "missing.xlsx", "--out", tmp_path / "out")
    assert process.returncode == 2 and len(process.stderr.splitlines()) == 1
    assert process.stdout == "" and not (tmp_path / "out").exists()


def test_only_an_unknown_member_is_refused(tmp_path, tell):
    path = schedule(tmp_path / "two.xlsx", APART)
    code, _, [line] = tell("build", path, "--out", tmp_path / "out", "--only", "M1,M9")
    assert code == 2 and "M9" in line and not (tmp_path / "out").exists()


def test_check_writes_nothing_and_tells(tmp_path, tell):
    path = schedule(tmp_path / "two.xlsx", APART)
    before = files(tmp_path)
    code, printed, lines = tell("check", path, "--jobs", 1)
    assert (code, lines) == (0, []) and "2 members" in printed and "good" in printed
    assert files(tmp_path) == before
    crossing = schedule(tmp_path / "x.xlsx", [APART[0], short(0.02, 0.22, 60.0)])
    code, printed, _ = tell("check", crossing, "--jobs", 1)
    assert code == 1 and "M1 meets M2" in printed


def test_check_tells_lengths_in_the_unit_of_the_sheets(tmp_path, tell):
    path = schedule(tmp_path / "two.xlsx", APART)
    book = openpyxl.load_workbook(path)
    page = book.create_sheet("Settings")
    rows = (("key", "value"), ("sheet_unit", "ft-in"), ("site_unit", "m"), ("site_x", 609.6))
    for row in rows:
        page.append(row)
    book.save(path)
    code, printed, _ = tell("check", path, "--jobs", 1)
    assert code == 0 and "value 2'-0\" (609.6 mm)" in printed


def test_a_folder_that_cannot_be_written_is_one_line(tmp_path, tell):
    path = schedule(tmp_path / "two.xlsx", APART)
    (tmp_path / "file").write_text("in the way", encoding="utf-8")
    out = tmp_path / "file" / "out"
    code, _, [line] = tell("build", path, "--out", out, "--only", "M2", "--jobs", 1)
    assert code == 2 and "file" in line and "->" in line


def test_the_version_is_that_of_the_package():
    process = run("--version")
    assert process.returncode == 0 and __version__ in process.stdout
