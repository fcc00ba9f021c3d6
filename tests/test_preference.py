# SPDX-License-Identifier: LGPL-2.1-or-later
"""Preferences of FreeCAD set for a while, and TechDraw views computed without their faces."""

import FreeCAD
import Part
import pytest
import TechDraw  # noqa: F401

from BendTorsionWB.model_files import checked_recompute
from BendTorsionWB.objects.preference import preference, without_faces
from BendTorsionWB.sheets.pdf import start_qt
from BendTorsionWB.sheets.qt import settle_threads

GROUP, NAME = "Mod/TechDraw/General", "HandleFaces"
SETTINGS = FreeCAD.ParamGet(f"User parameter:BaseApp/Preferences/{GROUP}")


@pytest.fixture(params=[None, True, False])
def preferred(request):
    """The preference as somebody left it, or not set."""
    SETTINGS.RemBool(NAME)
    if request.param is not None:
        SETTINGS.SetBool(NAME, request.param)
    yield request.param
    SETTINGS.RemBool(NAME)


def now():
    return SETTINGS.GetBool(NAME, True) if NAME in SETTINGS.GetBools() else None


def test_a_preference_holds_inside_the_block_and_is_as_it_was_after_it(preferred):
    for value in (True, False):
        with preference(GROUP, NAME, value):
            assert now() is value
        assert now() is preferred


def test_a_preference_is_as_it_was_after_an_error(preferred):
    with pytest.raises(ValueError), preference(GROUP, NAME, False):
        raise ValueError
    assert now() is preferred


class Looking:
    """Notes the preference when it is computed."""

    def __init__(self):
        self.seen = []

    def execute(self, obj):
        self.seen.append(now())


def test_a_checked_recompute_leaves_faces_of_views_out_and_the_preference_alone(preferred):
    document = FreeCAD.newDocument("looking")
    try:
        obj = document.addObject("App::FeaturePython", "Object")
        obj.Proxy = proxy = Looking()
        assert checked_recompute(document) == ()
    finally:
        FreeCAD.closeDocument(document.Name)
    assert proxy.seen == [False] and now() is preferred


def test_a_view_has_the_same_lines_without_its_faces():
    start_qt()
    document = FreeCAD.newDocument("faces")
    try:
        shape = document.addObject("Part::Feature", "Lines")
        rows = [
            (0, 0, 100, 0),
            (100, 0, 100, 80),
            (100, 80, 0, 80),
            (0, 80, 0, 0),
            (0, 30, 100, 60),
        ]
        shape.Shape = Part.Compound(
            [Part.makeLine((x0, y0, 0.0), (x1, y1, 0.0)) for x0, y0, x1, y1 in rows]
        )
        page = document.addObject("TechDraw::DrawPage", "Page")
        view = document.addObject("TechDraw::DrawViewPart", "View")
        page.Views = [view]
        view.Source, view.Direction, view.XDirection = [shape], (0, 0, 1), (1, 0, 0)

        def ends():
            view.touch()
            document.recompute()
            settle_threads()
            return [
                sorted((round(v.X, 6), round(v.Y, 6)) for v in edge.Vertexes)
                for edge in view.getVisibleEdges()
            ]

        whole = ends()
        with without_faces():
            assert ends() == whole and len(whole) == len(rows)
    finally:
        FreeCAD.closeDocument(document.Name)
