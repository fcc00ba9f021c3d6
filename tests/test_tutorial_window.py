# SPDX-License-Identifier: LGPL-2.1-or-later
"""The tutorial of docs/guide.md in FreeCAD's window, from a STEP file to plate drawings.

Its pictures go to build/pictures/tutorial, those in a dark window to `dark` below it; `make
tutorial` copies them into docs.
"""

import math
import re

import pytest
from freecad_window import DARK, LIGHT, ROOT, run_in_window

SCRIPT = ROOT / "tests" / "window" / "tutorial_session.py"
GUIDE = ROOT / "docs" / "guide.md"
PICTURES = ROOT / "build" / "pictures" / "tutorial"
STEPS = ("open_step_file", "members_from_selection", "edit_section", "member_table")
STEPS += ("joints", "marks", "development", "sheets", "check", "export")

pytestmark = pytest.mark.slow


def height(x, y):
    """A roof, doubly curved: mm above the plan."""
    return 6000.0 - x**2 / 40000.0 - y**2 / 60000.0 + x * y / 90000.0


def write_step(path):
    """The roof as one face and three curves on it, as an architect sends them."""
    import FreeCAD
    import Part

    document = FreeCAD.newDocument("Roof")
    xs = [-9000.0 + 1500.0 * k for k in range(13)]
    ys = [-6000.0 + 1500.0 * k for k in range(9)]
    surface = Part.BSplineSurface()
    surface.interpolate([[FreeCAD.Vector(x, y, height(x, y)) for y in ys] for x in xs])
    shapes = [("Roof", surface.toShape())]
    for name, v in (("Rib 1", 0.2), ("Rib 2", 0.5), ("Rib 3", 0.8)):
        shapes.append((name, surface.vIso(v).toShape()))
    objects = []
    for name, shape in shapes:
        feature = document.addObject("Part::Feature", name.replace(" ", ""))
        feature.Label, feature.Shape = name, shape
        objects.append(feature)
    document.recompute()
    Part.export(objects, str(path))
    FreeCAD.closeDocument(document.Name)
    return path


@pytest.fixture(scope="module", params=["light", "dark"])
def tutorial(tmp_path_factory, request):
    """What each step saw, in FreeCAD's own look and in a dark one."""
    folder = tmp_path_factory.mktemp(request.param)
    found = run_in_window(
        SCRIPT,
        folder,
        LIGHT if request.param == "light" else DARK,
        time_limit=400,
        pictures=PICTURES / ("" if request.param == "light" else "dark"),
        step=write_step(folder / "roof.step"),
    )
    for step in STEPS:
        assert "failed" not in found[step], found[step]["failed"]
        if step != "open_step_file":
            assert found[step].get("shown", []) == []
    return found


def test_the_step_file_gives_a_face_and_three_curves(tutorial):
    """Four edges of the face and three curves."""
    assert list(tutorial["open_step_file"].values()) == [[1, 4 + 3]]


def test_each_curve_becomes_a_member_with_plates_in_one_undo_step(tutorial):
    found = tutorial["members_from_selection"]
    assert found["ok"] and found["curves"] == 3
    assert found["members"] == ["M1", "M2", "M3"]
    assert found["plates"] == [4, 4, 4]
    assert found["undo_after"] - found["undo_before"] == 1


def test_the_members_follow_an_edit_of_their_section(tutorial):
    """14 mm of 100 mm less on two webs, at 7850 kg/m³, along each rib; seen within half a second
    (of processor time, display included, for three members at once)."""
    found = tutorial["edit_section"]
    assert found["height"] == 600.0
    for before, after in zip(found["before"], found["after"], strict=True):
        area_before = 700 * 500 - 672 * 472
        area_after = 600 * 500 - 572 * 472
        assert after / before == pytest.approx(area_after / area_before, rel=2e-3)
    assert found["seconds"] < 1.5


def test_the_table_gives_all_members_another_alignment(tutorial):
    """The cell typed and the ones filled down from it are an undo step each."""
    found = tutorial["member_table"]
    assert found["aligned"] == ["top"] * 3 and found["statuses"] == ["ok"] * 3
    assert found["undo"] == 2


def test_the_place_of_a_joint_is_seen_from_its_first_figure_on(tutorial):
    """In the dark window it stood scrolled, 9350 mm as 350."""
    assert tutorial["joints"]["first_figure_seen"] == 0


def test_joints_are_found_by_the_rules(tutorial):
    """Ribs of 18.6 m from plates of 12 m at most: two per face, no warnings; moved by 150 mm, the
    joint is held against each rule."""
    found = tutorial["joints"]
    assert found["plates"] == [8, 8, 8]
    assert found["status"] == "ok" and found["warnings"] == []
    assert found["verdict"].count("mm</b>") >= 3


def test_the_plates_are_laid_flat_and_drawn(tutorial):
    found = tutorial["development"]
    assert found["patterns"] == [8, 8, 8]
    assert found["statuses"] == ["ok"] * 3
    assert all(0.0 < error < 0.05 and math.isfinite(error) for error in found["errors"])
    assert all(pages >= 3 for pages in tutorial["sheets"]["pages"])


def test_what_is_made_later_is_folded_under_its_member_at_once(tutorial):
    tree = tutorial["sheets"]["tree"]
    depths = {text: depth for depth, text in tree}
    start = depths["M2"]
    for deeper, text in enumerate(("M2 plates", "M2 patterns", "M2 sheets"), start=1):
        assert depths[text] == start + deeper


def test_nothing_is_in_error_and_the_package_is_complete(tutorial):
    assert tutorial["check"]["errors"] == []
    assert tutorial["check"]["found"] == ["joints of faces top and left are too close"]
    found = tutorial["export"]
    assert found["cut"] == [f"{mark}.dxf" for mark in found["marks"]]
    assert {"M1.pdf", "M2.pdf", "M3.pdf"} <= set(found["sheets"])
    assert {"model.step", "nc1", "results.xlsx", "report.json"} <= set(found["files"])


def test_no_exception_in_the_report_view(tutorial):
    """From the first step to the last."""
    assert "Traceback" not in tutorial["report_view"]
    assert "Error" not in tutorial["report_view"]


def test_every_picture_of_the_guide_is_taken_by_the_tutorial(tutorial):
    """And none is taken that the guide does not show; `make tutorial` refreshes those of docs."""
    shown = re.findall(r"images/tutorial/([\w/-]+\.png)", GUIDE.read_text(encoding="utf-8"))
    taken = {str(picture.relative_to(PICTURES)) for picture in PICTURES.glob("*.png")}
    assert set(shown) == taken | {f"dark/{name}" for name in taken}
    for name in shown:
        assert (GUIDE.parent / "images" / "tutorial" / name).exists()
