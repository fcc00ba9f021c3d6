# SPDX-License-Identifier: LGPL-2.1-or-later
"""A split model opened whole in FreeCAD's window: every member is there, and seen."""

from pathlib import Path

from freecad_window import run_in_window
from test_build import APART, schedule

from BendTorsionWB import project
from BendTorsionWB.model_files import Wanted
from BendTorsionWB.sheets.qt import qt_modules

SESSION = Path(__file__).parent / "window" / "project_session.py"


def test_a_split_model_is_seen_whole_when_it_is_opened(tmp_path):
    book, out = schedule(tmp_path / "two.xlsx", APART), tmp_path / "out"
    result = project.build(book, out, workers=1, wanted=Wanted(sheets=False, split=1))
    picture = tmp_path / "picture.png"
    seen = run_in_window(SESSION, tmp_path / "home", model=out / "model.FCStd", picture=picture)[
        "open_project"
    ]
    assert "failed" not in seen, seen
    assert seen["members"] == len(result.records) == 2
    assert seen["documents"] == 3
    image = qt_modules()[1].QImage(str(picture))
    drawn = [
        (x, y)
        for x in range(0, image.width(), 2)
        for y in range(0, image.height(), 2)
        if image.pixelColor(x, y).lightness() < 240
    ]
    assert len(drawn) > 1000
