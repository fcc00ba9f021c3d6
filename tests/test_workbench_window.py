# SPDX-License-Identifier: LGPL-2.1-or-later
"""The workbench in FreeCAD's real window, on a virtual screen with a fresh user profile."""

import pytest
from freecad_window import ROOT, run_in_window

BOX = {"h": 800.0, "b": 600.0, "t": 16.0}


def save_without_window(path):
    """A member with plates on a plane, saved by plain Python."""
    import FreeCAD

    from BendTorsionWB import make

    document = FreeCAD.newDocument("Headless")
    surface = make.make_surface(document, "Ground", "plane")
    axis = make.make_axis(document, "A1", surface, [(0, 0, 0), (5000, 0, 0)])
    section = make.make_section(document, "Box", "box1", **BOX)
    plates = make.make_plates(document, make.make_member(document, "M1", axis, [section]))
    plates.ColourBy = "forming"
    document.recompute()
    document.saveAs(str(path))
    FreeCAD.closeDocument(document.Name)
    return path


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one FreeCAD session saw, step by step (tests/window/session.py)."""
    folder = tmp_path_factory.mktemp("window")
    document = save_without_window(folder / "headless.FCStd")
    return run_in_window(ROOT / "tests" / "window" / "session.py", folder, document=document)


def section_area():
    """Steel area of the box, mm²."""
    return BOX["h"] * BOX["b"] - (BOX["h"] - 2 * BOX["t"]) * (BOX["b"] - 2 * BOX["t"])


def test_the_workbench_is_listed_and_opens(window):
    """A link in Mod is enough; nothing heavy is loaded before the workbench is opened."""
    seen = window["workbench"]
    assert "failed" not in seen, seen["failed"]
    assert seen["listed"]
    assert seen["active"] == "BendTorsionWorkbench"
    assert seen["icon_exists"]
    assert seen["registered"]
    first = ["BendTorsion_ImportShapes", "BendTorsion_MembersFromSelection", "BendTorsion_Surface"]
    assert seen["toolbar"][:3] == first
    assert seen["loaded_early"] == []


def test_the_command_says_what_to_select(window):
    """With nothing selected it makes nothing and says, in one line, what it needs."""
    seen = window["empty_selection"]
    assert "failed" not in seen, seen["failed"]
    assert seen["objects"] == 0
    assert len(seen["shown"]) == 1
    assert "select one face, then one or more curves on it" in seen["shown"][0]
    assert "Traceback" not in seen["shown"][0]


def test_members_with_plates_from_a_face_and_two_curves(window):
    """Two numbered members with four plates each, in one undo step."""
    seen = window["members"]
    assert "failed" not in seen, seen["failed"]
    assert len(seen["dialogs"]) == 1
    assert [label for label in seen["labels"] if label in ("M1", "M2", "M3")] == ["M1", "M2"]
    for wanted, count in (("Surface", 1), ("SectionSpec", 1), ("Axis", 2), ("Member", 2)):
        assert seen["types"].count(wanted) == count
    assert len(seen["solids"]) == 2
    # Box 800×600×16 whose envelope is on the great circle: the section's centroid is on the axis
    # (align `centre`), so by Pappus the plates together have area × arc length.
    area = section_area()
    for volumes, arc in zip(seen["solids"].values(), seen["arcs"], strict=True):
        assert len(volumes) == 4
        assert sum(volumes) == pytest.approx(area * arc, rel=1e-5)
    assert seen["after_undo"] == []
    assert seen["after_redo"] == seen["labels"]


def test_a_document_saved_without_a_window_shows_and_recomputes(window):
    """Views are rebuilt: plates are shown, the member they cover is not, numbers stay."""
    seen = window["saved_without_window"]
    assert "failed" not in seen, seen["failed"]
    assert seen["visible"]["PlateSet"] and seen["visible"]["Surface"]
    assert not seen["visible"]["Member"]
    assert seen["icons"] and all(seen["icons"])
    assert seen["volume"] == pytest.approx(section_area() * 5000, rel=1e-9)
    assert set(seen["statuses"]) == {"ok"}
    assert seen["volume_again"] == seen["volume"]


def test_colours_saved_without_a_window_are_painted_and_taken_off_again(window):
    """Each face of a plate has the plate's colour; without colours the view has its own."""
    seen = window["saved_without_window"]["colours"]
    assert len(seen["saved"]) == 4
    wanted = [
        colour
        for colour, count in zip(seen["saved"], seen["faces"], strict=True)
        for _ in range(count)
    ]
    for painted, colour in zip(seen["painted"], wanted, strict=True):
        assert painted == pytest.approx(colour, abs=1 / 255)
    assert seen["after"] == [seen["own"]]
