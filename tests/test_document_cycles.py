# SPDX-License-Identifier: LGPL-2.1-or-later
"""A document whose objects depend on each other in a circle, or lost what computes them, says so to
whoever asks for more."""

import FreeCAD
import pytest
from test_build import schedule, short

from BendTorsionWB import project
from BendTorsionWB.__main__ import main
from BendTorsionWB.document import build_document
from BendTorsionWB.round_trip import write_back


@pytest.fixture
def place(tmp_path):
    """A schedule, and its document with a member and an object by hand in a circle."""
    path = schedule(tmp_path / "one.xlsx", (short(0.1, 0.3),))
    document = build_document(*project.read_jobs(path), sheets=False)
    [member] = [o for o in document.Objects if getattr(o, "BT_Type", "") == "Member"]
    link = document.addObject("App::FeaturePython", "Stay")
    link.addProperty("App::PropertyLink", "To").To = member
    member.addProperty("App::PropertyLink", "ByHand").ByHand = link
    document.saveCopy(str(tmp_path / "one.FCStd"))
    FreeCAD.closeDocument(document.Name)
    return path, tmp_path / "one.FCStd", tmp_path / "back.xlsx"


def test_export_to_a_workbook_diff_report_and_update_name_the_circle(place, capsys):
    path, document, back = place
    for words in (
        ["export", document, "--out", back],
        ["diff", path, document],
        ["diff", document, path],
        ["report", document],
        ["export", document, "--out", back.with_suffix("")],
    ):
        code = main([str(word) for word in words])
        error = capsys.readouterr().err
        assert code == 2 and "M1 -> Stay -> M1" in error and "cut one of these links" in error
    assert not back.exists() and not list(back.parent.glob("back files"))


def test_cut_it_is_written_back(place):
    _, path, back = place
    document = FreeCAD.openDocument(str(path), hidden=True)
    try:
        document.getObject("Stay").To = None
        assert write_back(document, back) == () and back.exists()
    finally:
        FreeCAD.closeDocument(document.Name)


def test_objects_that_lost_what_computes_them_are_named_by_diff_and_export(place, capsys):
    path, saved, back = place
    document = FreeCAD.openDocument(str(saved), hidden=True)
    [member] = [o for o in document.Objects if getattr(o, "BT_Type", "") == "Member"]
    member.Proxy = None
    document.saveCopy(str(saved.with_name("bare.FCStd")))
    FreeCAD.closeDocument(document.Name)
    bare = str(saved.with_name("bare.FCStd"))
    for words in (["diff", str(path), bare], ["export", bare, "--out", str(back)]):
        code = main(words)
        error = capsys.readouterr().err
        assert code == 2 and "error: M1: " in error and "repair" in error
    assert not back.exists()
