# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values that cannot be, typed in FreeCAD's window: marked, not shown, mended."""

import pytest
from freecad_window import session, step

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw; its keys are typed by a process of its own."""
    return session("mending", tmp_path_factory)


@pytest.mark.parametrize(
    ("typed", "why"),
    [
        ("50 cm 600.00 mm", "no sign between two values"),
        ("--5", "two signs side by side"),
        ("1,200", "1,200 can mean 1200 or 1.2"),
        ("1 km", "1 km is too much: 50000 mm or less"),
        ("0.05", "0.05 is too little: 0.1 mm or more"),
        ("700 mm + ", "cannot be read"),
        ("= 5 kg", "another unit"),
        ("= 1 km", "too much: 50000 mm"),
        ("650 mm bf", "cannot be read"),
    ],
)
def test_nothing_of_a_field_in_error_is_shown(window, typed, why):
    """What its beginning would mean neither: the model is as it was before the field was typed
    into, and the field says why."""
    text, height, bound, mass, ok, tip, told = step(window, "nothing_shown")[typed]
    assert text == typed and why in tip and tip in told and not ok
    assert height == 600.0 and bound == []
    assert mass == step(window, "nothing_shown")["mass"]


def test_a_field_of_several_goes_back_to_the_values_of_each(window):
    """One offset typed for three members, and a text that is none."""
    seen = step(window, "several")
    assert seen["typed"] == [30.0, 30.0, 30.0]
    assert seen["refused"] == seen["cancelled"] == [0.0, 5.0, 0.0]
    assert seen["mended"] == [30.0, 30.0, 30.0]


def test_enter_right_after_mending_is_taken(window):
    """Of a text that cannot be read, of a size the checks refuse, and where previews wait."""
    seen = step(window, "mended")
    assert seen["text"] == [False, 700.0] and seen["size"] == [False, 20.0]
    assert seen["heavy"] == [False, 24.0]
    # A value that is still refused keeps the panel open.
    assert seen["still"] == [True, 390.0, False]


def test_a_mark_leaves_the_arrows_of_a_field_alone(window):
    """Waiting, or in error: their places and the room of the text are those without a mark."""
    seen = step(window, "arrows")
    assert seen["plain"] == seen["flawed"] == seen["unshown"]
    assert all(width > 8 for width in seen["widths"])
    assert seen["colours"] == [[False, False], [True, False], [False, True]]


def test_an_expression_in_the_dialog_is_bound_to_the_section(window):
    """As in panels; one that cannot be is refused; in one undo step, and in the macro."""
    seen = step(window, "bound_in_dialog")
    assert seen["refused"] == [False, True] and "another unit" in seen["told"]
    assert seen["taken"] == [True, [["Height", "2 * Ball.Radius / 50"]], 800.0]
    assert seen["made"] == [800.0, ["Height"]] and seen["followed"] == 840.0
    assert any("setExpression('Height'" in line for line in seen["lines"])
    assert len(seen["undo"]) == 1


@pytest.mark.parametrize(
    ("typed", "example"),
    [
        ("= Radius / 50", "Ball.Radius"),
        ("= Placement.Base.z + 5 m", "Ball.Placement.Base.z"),
        ("= .Radius / 50", "Ball.Radius"),
        ("= Height / 2", "Spreadsheet.Height"),
    ],
)
def test_a_name_without_its_object_is_refused_in_the_dialog(window, typed, example):
    """The section that is bound to it has none of that name."""
    ok, marked, told = step(window, "bound_in_dialog")["alone"][typed]
    assert not ok and marked and f"write the object before it, as in {example}" in told


def test_labels_units_and_constants_are_no_names_without_an_object(window):
    seen = step(window, "bound_in_dialog")["alone"]
    assert seen["= 2 * <<Ball>>.Radius / 50"] == [True]
    assert seen["= Ball.Radius / (20 * pi) + 5 cm + 1e1 mm"] == [True]


def test_a_dialog_that_was_answered_is_gone(window):
    """Names of its buttons that were to come meet none."""
    seen = step(window, "answered_dialog")
    assert seen == {"left": 0, "others": True}


def test_a_field_that_follows_an_expression_shows_its_value(window):
    """And the expression beside it; keys change nothing and are told what would."""
    seen = step(window, "ruled")
    shown = "600.00 mm   (= Sheet.A1)"
    assert seen["opened"][0] == shown
    text, height, told, ok, bound = seen["typed into"]
    assert text == shown and height == 600.0 and ok and bound == 1
    for words in (told, seen["opened"][1]):
        assert "it follows = Sheet.A1" in words and "property editor" in words
    assert seen["followed"] == "650.00 mm   (= Sheet.A1)"


def test_an_expression_that_was_typed_shows_its_value_when_the_field_is_left(window):
    """It is followed from then on, until a number is typed over it."""
    seen = step(window, "ruled")
    assert seen["being typed"] == "=Height / 2"
    assert seen["left"] == "325.00 mm   (= Height / 2)"
    assert seen["bound"] == ["325.00 mm   (= Height / 2)", 325.0]
    assert seen["follows"] == ["350.00 mm   (= Height / 2)", 350.0]
    assert seen["typed over"] == ["250.00 mm", 250.0, ["Height"]]
    assert "800 mm" in step(window, "bound_in_dialog")["value"]


def test_no_exception_in_the_report_view(window):
    assert "Traceback" not in window["report_view"] and "<class" not in window["report_view"]
