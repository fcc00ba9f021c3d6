# SPDX-License-Identifier: LGPL-2.1-or-later
"""Keys typed in FreeCAD's window while previews run: none is lost, none is taken for another."""

import pytest
from freecad_window import session, step

FLAWED, UNSHOWN = "solid #c62828", "dashed"

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw; its keys are typed by a process of its own."""
    return session("typing", tmp_path_factory)


@pytest.mark.parametrize(
    ("typed", "height"),
    [
        ("734 0.15", 734.0),
        ("734 0.5", 734.0),
        ("734 mm 0.25", 734.0),
        ("2 * 325 mm 0.2", 650.0),
        ("50 cm 0.1", 500.0),
        ("0.5 m 0.1", 500.0),
        ("1 m - 35 mm 0.1", 965.0),
        ("600 mm + 50 mm 0.1", 650.0),
        ("2 * (300 mm + 1 cm) 0.1", 620.0),
        ("0,7 m 0.1", 700.0),
    ],
)
def test_every_key_arrives_whatever_is_computed_meanwhile(window, typed, height):
    """A field reached by Tab is typed over, unit and all; mass of a box follows its height."""
    text, value, ok, shown, mass = step(window, "typed")[typed]
    assert text == typed.rsplit(" ", 1)[0] and value == pytest.approx(height) and ok
    assert shown == f"{height:.2f} mm"
    # A step of height adds two webs of 16 mm on 31 m or so of steel.
    other = step(window, "typed")["734 0.15"][4]
    assert mass - other == pytest.approx(2 * 16 * (height - 734.0) * 31.6e3 * 7.85e-6, abs=120.0)


def test_a_unit_before_the_one_that_stood_there_counts(window):
    assert step(window, "typed")["leftover"] == ["50 cm mm", 500.0]


def test_cancel_takes_back_what_was_typed(window):
    assert step(window, "typed")["height"] == 600.0


def test_what_cannot_be_read_stays_and_is_marked(window):
    """Also when its field is left."""
    seen = step(window, "refused")
    assert seen["now"] == seen["left"] == ["bf", True, False] and seen["value"] == 600.0
    assert "Height h: bf cannot be read" in seen["told"]


def test_the_dialog_marks_its_fields_as_panels_do(window):
    tips, marked, mended = step(window, "refused")["dialog"]
    assert all(tips) and len(set(tips)) == 3
    assert marked == ["bf", True, False, "Height h: bf cannot be read"]
    assert mended == ["500.00 mm", True, 500.0]


def test_a_preview_that_takes_long_waits_until_the_field_is_left(window):
    """The field says so; keys that come while it runs arrive in the next field."""
    seen = step(window, "shown_when_left")
    same, style = seen["typed"]
    assert same and UNSHOWN in style and "Not shown yet" in seen["told"]
    assert seen["left"] == [True, ""] and seen["both"] == [900.0, 734.0]


def test_enter_takes_what_is_written_and_esc_ends_at_once(window):
    seen = step(window, "shown_when_left")
    assert seen["entered"] == [False, 910.0, True]
    assert seen["escaped"] == [False, 600.0] and seen["mass"]


@pytest.mark.parametrize("when", ["computing", "waiting"])
def test_the_window_told_to_close_asks_when_nothing_is_computed(window, when):
    """FreeCAD's question can be answered at once; Cancel leads back into the panel, and what was
    typed is there for OK."""
    height = {"computing": 905.0, "waiting": 915.0}[when]
    assert step(window, "told_to_close")[when] == [True, False, True, height, False]


def test_errors_downstream_keep_from_ok(window):
    """The button says why; Enter does not pass it."""
    text, ok, tip = step(window, "errors")["folded"]
    assert "#c62828" in text and not ok and tip
    assert step(window, "errors")["open"]


def test_one_of_two_errors_can_be_mended(window):
    """The plates fit again while another member has no section."""
    seen = step(window, "errors")
    assert all(status.startswith("error") for status in seen["before"])
    assert seen["mended"][1]
    thickness, still, mended = seen["kept"]
    assert thickness == 16.0 and still.startswith("error") and mended == "ok"


def test_lengths_show_their_millimetres(window):
    """FreeCAD would show 14.63 m."""
    assert step(window, "long_lengths")["shown"] == "14630.40 mm"


def test_keys_of_the_split_editor_arrive_while_it_computes(window):
    """Del, another joint, Ins twice: one more each time."""
    seen = step(window, "split_keys")
    assert seen["counts"] == [10, 11, 12] and seen["stale"] is False


def test_a_cell_typed_while_the_table_computes_is_whole(window):
    assert step(window, "table_keys")["cells"] == ["9000", "10000 20000"]


def test_no_exception_in_the_report_view(window):
    assert "Traceback" not in window["report_view"] and "<class" not in window["report_view"]
