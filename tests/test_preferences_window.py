# SPDX-License-Identifier: LGPL-2.1-or-later
"""Preferences give new objects their first values and change no result of an existing document."""

import pytest
from freecad_window import ROOT, run_in_window
from test_view_window import save_document

PICTURES = ROOT / "build" / "pictures" / "preferences"


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """One session: objects made, preferences changed in FreeCAD's dialog, objects made again."""
    folder = tmp_path_factory.mktemp("preferences")
    found = run_in_window(
        ROOT / "tests" / "window" / "preferences_session.py",
        folder,
        time_limit=400,
        pictures=PICTURES,
        document=save_document(folder / "existing.FCStd"),
    )
    for step in ("before", "changed", "after", "layers", "sizes", "language"):
        assert "failed" not in found[step], found[step]["failed"]
    return found


def test_a_fresh_profile_makes_what_the_scripting_interface_makes(window):
    """The defaults are those of make.make_…, but for the size of a section, which has none."""
    new = window["before"]["new"]["figures"]
    assert new["S.Height"] == 600.0
    assert new["M1 plates.StationSpacing"] == 500.0
    assert new["M1 plates.RulePack"] == "CN"
    assert new["A1.Tolerance"] == 0.005
    assert new["M1.Slope2"] == 2.5 and new["M1 patterns.LayerNames"] == []
    # 4 m of a box 600 x 600 x 16.
    assert new["M1 plates.Volume"] == pytest.approx((600**2 - 568**2) * 4000.0)


def test_new_objects_start_with_what_is_preferred(window):
    assert window["changed"]["shown"] == [600.0, 500.0, 0.005]
    new = window["after"]["new"]["figures"]
    assert new["S.Height"] == 750.0
    assert new["M1 plates.StationSpacing"] == 250.0
    assert new["M1 plates.RulePack"] == "EU"
    assert new["A1.Tolerance"] == 0.001
    assert new["M1 sheets.Author"] == "A. Detailer"
    assert new["M1 sheets.SheetFormat"] == "A1"
    assert new["M1.Slope2"] == 4.0
    assert new["M1 patterns.LayerNames"] == ["CUT_OUTER=10"]
    assert new["M1 plates.Volume"] == pytest.approx((750 * 600 - 718 * 568) * 4000.0)


def test_a_macro_has_the_values_and_not_the_preference(window):
    """The recorded lines give the same objects to someone with other preferences."""
    lines = "\n".join(window["after"]["new"]["lines"])
    for text in ("h=750.0", "station_spacing=250.0", "rule_pack='EU'", "tolerance=0.001"):
        assert text in lines
    assert "slope=4.0" in "\n".join(window["after"]["new"]["all"])
    assert "layers={'CUT_OUTER': '10'}" in lines and "format='A1'" in lines


def test_names_of_layers_that_cannot_be_are_not_kept(window):
    """One with a slash, two of one name: marked at their fields, told, the former ones stay."""
    seen = window["layers"]
    assert seen["marked"] == [True, True, False]
    assert len(seen["told"]) == 1 and "cannot be a layer name" in seen["told"][0]
    assert "two layers have one name" in seen["told"][0]
    assert seen["kept"]["LayerPUNCH"] == "PUNCH" and seen["kept"]["LayerREF"] == "REF"
    assert seen["kept"]["LayerCUT_OUTER"] == "10"


def test_sizes_that_cannot_be_are_told_and_not_kept(window):
    """By the name of their field; those that can be are kept."""
    seen = window["sizes"]
    assert seen["marked"] == [True, True, True, False]
    (told,) = seen["told"]
    assert "Height h: bf cannot be read" in told and "Breadth b: 1 km is too much" in told
    assert "Station spacing: 5 mm is too little: 10 mm or more" in told
    names = ("Height", "Breadth", "StationSpacing", "Slope")
    assert [seen["kept"][name] for name in names] == [750.0, 600.0, 250.0, 3.0]


def test_the_window_s_language_is_a_preference(window):
    """English or Chinese, at once and when FreeCAD starts again."""
    assert {"English", "简体中文"} <= set(window["changed"]["languages"])
    seen = window["language"]
    assert {name: seen[name] for name in ("now", "kept", "word")} == {
        "now": "zh-CN",
        "kept": "zh-CN",
        "word": "高度 h",
    }


def test_a_language_of_none_is_shown_as_english_and_left_alone(window):
    text, count, same = window["language"]["of C"]
    assert (text, same) == ("English", True) and count == 2


def test_layers_say_what_is_on_them(window):
    labels = window["language"]["layers"]
    assert len(labels) == 9 and "CUT_OUTER: outer contour, to be cut" in labels
    assert all(len(text.partition(": ")[2]) > 5 for text in labels)


def test_an_existing_document_keeps_every_number(window):
    """Recomputed whole with other preferences, to the last bit."""
    existing = window["before"]["existing"]
    assert len(existing) > 10
    assert window["after"]["existing"] == existing


def test_the_report_view_has_no_exception(window):
    assert "Traceback" not in window["report_view"]
