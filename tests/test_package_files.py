# SPDX-License-Identifier: LGPL-2.1-or-later
"""The files of a whole project, made by a build and read back by other programs."""

import csv
import errno
import io
import json
import math
import shutil
from pathlib import Path

import ezdxf
import ezdxf.bbox
import FreeCAD
import numpy as np
import openpyxl
import Part
import pytest
from package_build import SITE, plates_of, rows
from test_build import APART, changed, schedule, short

from BendTorsionWB import project
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.arc_fit import enclosed_area
from BendTorsionWB.core.site import SiteDatum
from BendTorsionWB.exchange import known_hashes
from BendTorsionWB.exchange.dxf import plate_dxf
from BendTorsionWB.exchange.dxf_nest import GAP, groups_of, nest_dxf, shelves
from BendTorsionWB.exchange.issue import KEPT_OUTLINES
from BendTorsionWB.exchange.part_marks import FILE
from BendTorsionWB.exchange.plate_outlines import read_outlines
from BendTorsionWB.model_files import Wanted


def test_the_package_is_whole_and_ours(built):
    _, out, result = built
    ours = json.loads((out / ".bendtorsion.json").read_text(encoding="utf-8"))["files"]
    grades = {f"plates/all/{t}mm S355.dxf" for t in (16, 12)}
    wanted = {"model.FCStd", "model.step", "model.ifc", "report.html", "nesting.csv", *grades}
    assert wanted <= set(ours)
    assert all((out / name).stat().st_size for name in ours)


def test_without_a_model_there_is_neither_step_nor_ifc(built, tmp_path):
    path, _, _ = built
    project.build(path, tmp_path / "out", workers=1, wanted=Wanted(False, False))
    names = {p.name for p in (tmp_path / "out").iterdir()}
    assert not {name for name in names if name.startswith("model")}
    assert {"nesting.csv", "report.html", "plates", "results.xlsx"} <= names


def test_a_build_without_changes_writes_nothing_and_a_lost_file_comes_back(built, tmp_path):
    path, out, _ = built

    def state():
        return {
            str(p.relative_to(out)): p.stat().st_mtime_ns
            for p in out.rglob("*")
            if p.is_file() and p.name != "timing.json" and p.suffix not in (".member", ".pdf")
        }

    before = state()
    contents = {name: (out / name).read_bytes() for name in ("model.ifc", "report.html")}
    grade = "plates/all/16mm S355.dxf"
    (out / grade).unlink()
    project.build(path, out, workers=1)
    again = state()
    touched = {name for name in before if before[name] != again.get(name)}
    assert grade in again
    assert touched <= {grade, ".bendtorsion.json", FILE, known_hashes.FILE}
    assert contents == {name: (out / name).read_bytes() for name in contents}


def test_the_nesting_list_names_every_part_once_with_its_file(built):
    _, out, result = built
    text = (out / "nesting.csv").read_bytes().decode("utf-8-sig")
    listed = list(csv.DictReader(io.StringIO(text)))
    plates = plates_of(result)
    assert {row["part"] for row in listed} == {plate.part for plate in plates}
    assert sum(int(row["quantity"]) for row in listed) == len(plates)
    assert all((out / row["dxf"]).exists() for row in listed)


def test_combined_files_hold_every_plate_once_and_apart(built):
    _, out, result = built
    boxes, marks = [], []
    for path in sorted((out / "plates" / "all").iterdir()):
        drawing = ezdxf.readfile(path)
        assert not drawing.audit().errors and drawing.header["$INSUNITS"] == 4
        own = []
        for insert in drawing.modelspace():
            assert insert.dxftype() == "INSERT" and insert.dxf.xscale == 1.0
            block = drawing.blocks[insert.dxf.name]
            [contour] = block.query('LWPOLYLINE[layer=="CUT_OUTER"]')
            single = ezdxf.readfile(out / "plates" / f"{insert.dxf.name}.dxf")
            [alone] = single.modelspace().query('LWPOLYLINE[layer=="CUT_OUTER"]')
            assert list(contour.get_points()) == list(alone.get_points())
            assert len(block) == len(single.modelspace())
            box = ezdxf.bbox.extents([contour])
            place = np.array(insert.dxf.insert)[:2]
            own.append((place + np.array(box.extmin)[:2], place + np.array(box.extmax)[:2]))
            marks.append(insert.dxf.name)
        boxes.append(own)
    assert sorted(marks) == sorted(plate.mark for plate in plates_of(result))
    for own in boxes:
        for k, (low, high) in enumerate(own):
            for other_low, other_high in own[:k]:
                gap = np.maximum(other_low - high, low - other_high).max()
                assert gap >= GAP - 0.1


def test_shelves_hold_rectangles_apart_and_about_square():
    sizes = np.column_stack([np.linspace(500.0, 9000.0, 40), np.linspace(900.0, 300.0, 40)])
    places = shelves(sizes)
    whole = (places + sizes).max(axis=0)
    assert 0.5 < whole[0] / whole[1] < 2.5
    assert shelves(sizes[:1]).tolist() == [[0.0, 0.0]]


def test_grades_that_would_share_a_name_are_files_of_their_own(built):
    from dataclasses import replace

    _, _, result = built
    [record] = [replace(r, plates=r.plates[:3]) for r in result.records[:1]]
    named = ("S355/J2", "S355:J2", "s355:j2")
    plates = tuple(replace(p, material=m) for p, m in zip(record.plates, named, strict=True))
    groups = groups_of([replace(record, plates=plates)])
    assert {tuple(p.material for p in own) for own in groups.values()} == {(m,) for m in named}
    assert len({name.casefold() for name in groups}) == 3
    assert not any("/J2" in name or ":" in name for name in groups)
    assert groups_of([replace(record, plates=plates[::-1])]).keys() == groups.keys()
    files = [(plate.mark, plate_dxf(plate)) for plate in plates]
    drawing = ezdxf.read(io.StringIO(nest_dxf(files).decode()))
    assert len(drawing.modelspace()) == 3


def test_step_names_every_plate_and_reads_back_whole(built):
    _, out, result = built
    text = (out / "model.step").read_text(encoding="utf-8")
    plates = plates_of(result)
    for plate in plates:
        assert text.count(f"PRODUCT('{plate.mark}'") == 1
        assert text.count(f"MANIFOLD_SOLID_BREP('{plate.mark}'") == 1
    assert text.count("STYLED_ITEM(") == len(plates)
    shape = Part.Shape()
    shape.read(str(out / "model.step"))
    mass = {round(s.Volume) for s in shape.Solids}
    assert len(shape.Solids) == len(plates)
    assert all(any(abs(p.volume - v) < 1e-5 * v for v in mass) for p in plates)


def test_the_report_shows_model_strain_and_pattern_and_the_axis_uncertainty(built):
    _, out, result = built
    page = (out / "report.html").read_text(encoding="utf-8")
    worst = max((p for p in plates_of(result) if p.lines), key=lambda p: p.strain_max)
    assert page.count("<svg") == 3 + len(result.records) and "<?xml" not in page
    assert f"Strain of laying {worst.mark} flat" in page
    assert "axis between the given points" in page
    assert "http://" not in page.replace('xmlns="http://www.w3.org/2000/svg"', "")


def test_control_points_agree_in_model_site_and_bed_and_leave_room_to_measure(built):
    _, out, result = built
    book = openpyxl.load_workbook(out / "results.xlsx", data_only=True)
    control = rows(book["Control"])
    turn = math.radians(SITE["site_rotation"])
    for row in control:
        x, y, z = (row[axis] for axis in "xyz")
        site = [
            math.cos(turn) * x - math.sin(turn) * y + SITE["site_x"],
            math.sin(turn) * x + math.cos(turn) * y + SITE["site_y"],
            z + SITE["site_z"],
        ]
        assert [row[f"site_{axis}"] for axis in "xyz"] == pytest.approx(site, abs=1e-6)
        assert row["measured_x"] is None
    for record in result.records:
        own = [row for row in control if row["piece"] == record.member]
        assert {row["line"] for row in own if row["corner"] == "face"} == {"E-1", "E-2"}
        ends = {
            (row["line"], row["corner"]): np.array([row[f"{f}_{a}"] for a in "xyz"])
            for f in ("fabrication",)
            for row in own
        }
        design = {
            (row["line"], row["corner"]): np.array([row[f"bed_{a}"] for a in "xyz"]) for row in own
        }
        # Before welding the piece is longer by the shrinkage along, the section by that across.
        for given, key in ((0.6e-3, "face"),):
            grown = np.linalg.norm(ends["E-2", key] - ends["E-1", key])
            before = np.linalg.norm(design["E-2", key] - design["E-1", key])
            assert grown / before - 1.0 == pytest.approx(given, rel=1e-3)
        wide = np.linalg.norm(ends["E-1", "TL"] - ends["E-1", "TR"])
        assert wide / np.linalg.norm(design["E-1", "TL"] - design["E-1", "TR"]) - 1.0 == (
            pytest.approx(0.4e-3, rel=1e-3)
        )
        for row in own:
            if row["corner"] == "face":
                normal = np.array([row[f"normal_{a}"] for a in "xyz"])
                line = record.wireframe["axis"]
                way = line[1] - line[0] if row["line"] == "E-1" else line[-1] - line[-2]
                sign = -1.0 if row["line"] == "E-1" else 1.0
                assert np.linalg.norm(normal) == pytest.approx(1.0)
                assert normal @ way / np.linalg.norm(way) * sign > 0.99


def test_workbook_and_report_hold_the_same_numbers(built):
    _, out, _ = built
    book = openpyxl.load_workbook(out / "results.xlsx", data_only=True)
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    told = {p["mark"]: p for m in report["members"] for p in m["plates"]}
    pairs = {"length": "length_mm", "width": "width_mm", "net_area": "area_mm2"}
    pairs |= {"net_mass": "mass_kg", "thickness": "thickness_mm", "part": "part"}
    plates = rows(book["Plates"])
    assert {row["plate"] for row in plates} == set(told)
    for row in plates:
        for column, key in pairs.items():
            assert row[column] == told[row["plate"]][key]
    cutting = rows(book["Cutting"])
    assert sum(r["gross_mass"] * r["quantity"] for r in cutting) == pytest.approx(
        sum(r["gross_mass"] for r in plates), rel=1e-3
    )


def test_a_backing_bar_is_listed_with_section_and_length(built):
    _, out, _ = built
    book = openpyxl.load_workbook(out / "results.xlsx", data_only=True)
    bars = rows(book["Bars"])
    welds = {row["weld"]: row for row in rows(book["Welds"])}
    assert bars and bars[0]["bar"] == "M1-K1"
    for bar in bars:
        assert bar["section"] == "30x6" and bar["length"] == welds[bar["weld"]]["length"]
        assert bar["mass"] == pytest.approx(30 * 6 * bar["length"] * 7.85e-6, rel=1e-6)
    assert {row["backing"] for row in welds.values()} == {"30x6", None}


def test_cut_files_tell_the_bevels_of_the_workbook(built):
    _, out, result = built
    book = openpyxl.load_workbook(out / "results.xlsx", data_only=True)
    bevels = rows(book["Bevels"])
    told = {}
    for row in bevels:
        told.setdefault(row["plate"], []).append(row)
    assert {"left", "right"} <= {row["edge"] for row in bevels}
    for mark, own in told.items():
        drawing = ezdxf.readfile(out / "plates" / f"{mark}.dxf")
        texts = [t.dxf.text for t in drawing.modelspace().query('TEXT[layer=="MARK_BEVEL"]')]
        assert len(texts) == len(own)
        [contour] = drawing.modelspace().query('LWPOLYLINE[layer=="CUT_OUTER"]')
        assert enclosed_area(np.array(list(contour.get_points("xyb")))) > 0.0


def test_part_marks_of_a_partial_build_are_those_of_the_whole_one(tmp_path):
    # Two members on the same axis but for their place: the plates of the second are those of the
    # first, moved along z by less than they could meet.
    path = schedule(tmp_path / "two.xlsx", APART)
    out = tmp_path / "out"
    plain = Wanted(False, False)
    whole = project.build(path, out, workers=1, wanted=plain)
    parts = {p.mark: (p.part, p.quantity) for p in plates_of(whole)}
    kept = json.loads((out / FILE).read_text(encoding="utf-8"))
    kept["M2"][1] = ["M1-T1", 2, "M1-L1"]
    (out / FILE).write_text(json.dumps(kept), encoding="utf-8")
    other = changed(tmp_path / "other.xlsx", APART, {("Members", 3, "cut"): "50%"})
    part = project.build(other, out, only=["M2"], workers=1, wanted=plain)
    assert [record.member for record in part.records] == ["M2"]
    first, *others = part.records[0].plates
    assert (first.part, first.quantity, first.opposite_hand) == ("M1-T1", 2, "M1-L1")
    assert all((p.part, p.quantity) == parts[p.mark] for p in others)
    assert not [f for f in part.findings if f.code == "part-marks-partial"]
    # A member that changed since has no place among the others until all are built.
    other = changed(tmp_path / "other.xlsx", APART, {("Sections", 2, "t"): 14})
    part = project.build(other, out, only=["M2"], workers=1, wanted=plain)
    assert [f.object for f in part.findings if f.code == "part-marks-partial"] == ["M2"]


def named(path, name):
    book = openpyxl.load_workbook(path)
    page = book["Settings"] if "Settings" in book.sheetnames else book.create_sheet("Settings")
    page.delete_rows(1, page.max_row)
    for row in (("key", "value"), ("project", name)):
        page.append(row)
    target = path.with_name(f"{name}.xlsx")
    book.save(target)
    return target


def test_the_folder_of_another_project_is_left_alone_unless_forced(built, tmp_path, monkeypatch):
    plain = Wanted(False, False)
    book = schedule(tmp_path / "two.xlsx", APART[:1])
    out = tmp_path / "out"
    project.build(named(book, "Hall"), out, workers=1, wanted=plain)
    before = {p: p.read_bytes() for p in out.rglob("*") if p.is_file()}
    with monkeypatch.context() as patch:
        patch.setattr(project, "detail_members", lambda *_: pytest.fail("computed"))
        with pytest.raises(BendTorsionError, match="Hall.*Dome.*--force"):
            project.build(named(book, "Dome"), out, workers=1, wanted=plain)
    assert before == {p: p.read_bytes() for p in out.rglob("*") if p.is_file()}
    result = project.build(named(book, "Dome"), out, workers=1, wanted=plain, force=True)
    assert not result.failed
    assert json.loads((out / ".bendtorsion.json").read_text(encoding="utf-8"))["project"] == "Dome"


def test_a_full_disk_leaves_former_files_whole_and_says_so(built, tmp_path, monkeypatch):
    plain = Wanted(False, False)
    out = tmp_path / "out"
    first = project.build(schedule(tmp_path / "two.xlsx", APART[:1]), out, workers=1, wanted=plain)
    before = {p: p.read_bytes() for p in out.rglob("*") if p.is_file()}
    other = changed(tmp_path / "other.xlsx", APART[:1], {("Sections", 2, "t"): 14})
    real, written = Path.write_bytes, []

    def full(path, content):
        if path.suffix in (".dxf", ".nc1", ".csv", ".html"):
            if len(written) > 3:
                real(path, content[: len(content) // 2])
                raise OSError(errno.ENOSPC, "No space left on device")
            written.append(path.name)
        return real(path, content)

    with monkeypatch.context() as patch:
        patch.setattr(Path, "write_bytes", full)
        with pytest.raises(BendTorsionError, match="free space"):
            project.build(other, out, workers=1, wanted=plain)
    names = {p.name for p in out.rglob("*") if p.is_file()}
    assert not [name for name in names if ".part" in name]
    for path, content in before.items():
        now = path.read_bytes()
        # Old or new, never half: cut files end as they must.
        assert now == content or now.rstrip().endswith((b"EOF", b"EN", b"}", b"</html>"))
    again = project.build(other, out, workers=1, wanted=plain)
    assert not again.failed
    fresh = tmp_path / "fresh"
    project.build(other, fresh, workers=1, wanted=plain)
    for path in fresh.rglob("*.*"):
        if path.suffix in (".dxf", ".nc1", ".csv", ".html"):
            assert (out / path.relative_to(fresh)).read_bytes() == path.read_bytes()
    assert {p.mark for p in plates_of(first)} == {p.mark for p in plates_of(again)}


def test_an_object_in_error_and_a_label_no_file_can_have_are_refused_by_name(tmp_path):
    from BendTorsionWB import make
    from BendTorsionWB.document_export import export_document
    from BendTorsionWB.solid_files import write_ifc, write_step

    document = FreeCAD.newDocument("bad", hidden=True)
    try:
        surface = make.make_surface(document, "Hall", a=40000, b=30000, c=20000)
        section = make.make_section(document, "S", h=400, b=400, t=12)
        axis = make.make_axis(document, "A1", surface, short(0.02, 0.1))
        member = make.make_member(document, "M/1", axis, [section])
        plates = make.make_plates(document, member)
        make.make_unfold(document, plates)
        document.recompute()
        document.saveCopy(str(tmp_path / "bad.FCStd"))
        with pytest.raises(BendTorsionError, match="M/1.*cannot name a file"):
            export_document(tmp_path / "bad.FCStd", tmp_path / "out", workers=1)
        assert not (tmp_path / "out").exists()
        section.Thickness = 300
        document.recompute()
        for write in (
            lambda: write_step(document, ["M/1"], tmp_path / "x.step"),
            lambda: write_ifc(document, ["M/1"], {}, SiteDatum(), "", tmp_path / "x.ifc"),
        ):
            with pytest.raises(BendTorsionError, match="in error and is not exported"):
                write()
        assert not list(tmp_path.glob("x.*"))
    finally:
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)


def test_marks_and_outlines_outlive_the_cache(tmp_path):
    path, out = schedule(tmp_path / "two.xlsx", APART), tmp_path / "out"
    plain = Wanted(False, False)
    whole = project.build(path, out, workers=1, wanted=plain)
    shutil.rmtree(out / ".cache")
    part = project.build(path, out, only=["M2"], workers=1, wanted=plain)
    shared = {p.mark: (p.part, p.quantity, p.opposite_hand) for p in plates_of(whole)}
    assert all((p.part, p.quantity, p.opposite_hand) == shared[p.mark] for p in plates_of(part))
    assert not [f for f in part.findings if f.code == "part-marks-partial"]
    assert set(read_outlines(out / KEPT_OUTLINES)) == set(shared)
