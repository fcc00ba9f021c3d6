# SPDX-License-Identifier: LGPL-2.1-or-later
"""How objects show in FreeCAD's window: tree, labels, legends, ribbons, errors."""

import math
from pathlib import Path

import pytest
from freecad_window import DARK, LIGHT, ROOT, run_in_window
from test_colours import lightness

SCRIPT = ROOT / "tests" / "window" / "view_session.py"
PICTURES = ROOT / "build" / "pictures" / "view"

pytestmark = pytest.mark.slow


def on_dome(x, y):
    """A point of the ellipsoid 40 × 30 × 20 m above (x, y)."""
    return x, y, 20000.0 * math.sqrt(1.0 - (x / 40000.0) ** 2 - (y / 30000.0) ** 2)


def save_document(path: Path) -> Path:
    """Two members on an ellipsoid, with plates, patterns and sheets, saved by plain Python."""
    import FreeCAD

    from BendTorsionWB import make

    document = FreeCAD.newDocument("Shown")
    surface = make.make_surface(document, "Dome", "ellipsoid", a=40000, b=30000, c=20000)
    section = make.make_section(document, "B", "box1", h=600, b=500, t=16)
    for number, y in enumerate((-6000.0, 2000.0), start=1):
        points = [on_dome(x, y + 0.3 * x) for x in (-8000.0, -4000.0, 0.0, 4000.0, 8000.0)]
        axis = make.make_axis(document, f"A{number}", surface, points)
        member = make.make_member(document, f"M{number}", axis, [section])
        plates = make.make_plates(document, member, {"top": [0.4], "bottom": [0.6]})
        plates.ColourBy = "strain"
        unfold = make.make_unfold(document, plates)
    make.make_sheets(document, unfold, "Hall", "")
    document.recompute()
    document.saveAs(str(path))
    FreeCAD.closeDocument(document.Name)
    return path


@pytest.fixture(scope="module", params=["light", "dark"])
def window(tmp_path_factory, request):
    """What one session saw, in FreeCAD's own look and in a dark one."""
    folder = tmp_path_factory.mktemp(request.param)
    return run_in_window(
        SCRIPT,
        folder,
        LIGHT if request.param == "light" else DARK,
        time_limit=400,
        pictures=PICTURES / request.param,
        document=save_document(folder / "headless.FCStd"),
    )


def seen(window, step):
    """What a step saw; fails with its traceback when it raised."""
    assert "failed" not in window[step], window[step]["failed"]
    return window[step]


def below(tree, name):
    """The texts directly below an item of the tree."""
    depth, start = next((d, k) for k, (d, text) in enumerate(tree) if text == name)
    found = []
    for d, text in tree[start + 1 :]:
        if d <= depth:
            break
        if d == depth + 1:
            found.append(text)
    return found


def test_a_document_saved_without_a_window_comes_up_complete(window):
    """Plates are shown and not the skin; everything of a member is folded under it."""
    found = seen(window, "saved_without_window")
    assert found["providers"] == ["ViewProvider"]
    assert found["visible"]["M1 plates"] and found["visible"]["Dome"]
    assert not found["visible"]["M1"] and not found["visible"]["M1 patterns"]
    document = next(text for depth, text in found["tree"] if depth == 1)
    assert below(found["tree"], document) == ["Dome", "B", "M1", "M2"]
    assert below(found["tree"], "M1") == ["A1", "M1 plates"]
    assert below(found["tree"], "M2 patterns") == ["M2 sheets"]
    assert "M2 sheets 1" in below(found["tree"], "M2 sheets")


@pytest.mark.parametrize("kind", ["Surface", "Axis", "PlateSet", "Member", "Unfold"])
def test_new_objects_stand_out_on_light_and_dark_views(window, kind):
    """At 3:1 or more (WCAG 2), on white and on the ground of the dark theme."""
    shown = lightness(seen(window, "colours")[kind])
    for ground in ((1.0, 1.0, 1.0), (0x21 / 255, 0x25 / 255, 0x2B / 255)):
        dark, light = sorted((shown, lightness(ground)))
        assert (light + 0.05) / (dark + 0.05) >= 3.0


def test_the_legend_stands_in_the_view_and_is_no_part_of_its_bounds(window):
    """One picture for both members' plates, each with its own numbers; plates stay in place."""
    found = seen(window, "saved_without_window")
    ((breadth, height),) = found["legend"]
    assert breadth > 200 and height > 5 * 20
    assert abs(found["bounds"][0]) < 200.0


def test_marks_and_points_are_shown_on_demand_and_hidden_with_the_plates(window):
    found = seen(window, "labels")
    assert found["before"] == found["hidden"] == found["after"] == []
    assert found["marks"] == found["wanted"] and len(found["wanted"]) == 6
    points = found["points"][len(found["wanted"]) :]
    # Each plate has its own P-1 and its two ends; a line has two points on the outer face.
    assert points.count("P-1") == points.count("E-1") == points.count("E-2") == 6
    lines = [text for text in points if text[0] in "LE"]
    assert len(points) - len(lines) == 2 * len(lines)


def test_labels_thin_out_as_one_goes_away(window):
    """Near by most have room, from afar none has; no two ever lie on each other."""
    found = seen(window, "thinning")
    assert found["all"] > 100
    near, nearer, nearest, far = found["seen"]
    assert len(near) < found["all"] / 2
    # Closer there is room for more of the few that are in sight: points beside lines and marks.
    assert not any(text.startswith("P-") for text, *_ in near)
    assert any(text.startswith("P-") for text, *_ in nearest)
    assert any(text.startswith("M1-") for text, *_ in nearer)
    assert len(far) <= 1
    for labels in found["seen"]:
        for k, (_, x, y, wide, high) in enumerate(labels):
            for _, left, low, w, h in labels[k + 1 :]:
                apart = x + wide <= left + 1 or left + w <= x + 1
                assert apart or y + high <= low + 1 or low + h <= y + 1


def test_what_was_hidden_stays_hidden_when_an_error_is_mended(window):
    """Nothing is seen of a member in error; after it is mended, what was asked for last."""
    found = seen(window, "hidden_in_error")
    hidden, shown = [False] * 3, [True] * 3
    wanted = {
        "hidden skin": (hidden, shown),
        "skin, plates wanted": (hidden, shown),
        "plates, skin wanted": (shown, hidden),
        "hidden by hand": (hidden, hidden),
        "shown by hand": (hidden, shown),
    }
    for case, (member, plates) in wanted.items():
        during, after = found[case]
        assert during == {"M1": hidden, "M1 plates": hidden}, case
        assert after == {"M1": member, "M1 plates": plates}, case


def test_frames_of_an_axis_are_a_ribbon(window):
    found = seen(window, "frames")
    assert (found["before"], found["ribbons"], found["after"]) == (0, 1, 0)


def test_members_show_as_plates_skin_or_axis(window):
    found = seen(window, "modes")
    for mode, members in found.items():
        for member in members:
            assert member == {
                "mode": mode,
                "member": mode == "skin",
                "axis": mode == "axis",
                "plates": [mode == "plates"],
            }


def test_errors_are_seen_in_the_tree_and_leave_nothing_stale(window):
    """The badge is on the section at fault, on the plates and on the member above them; the plates
    are gone from the view until the section is mended, and FreeCAD has no fault to report."""
    found = seen(window, "errors")
    assert found["worst"] == ["error"] * 3
    for before, during, after in zip(
        found["icons_before"], found["icons"], found["icons_after"], strict=True
    ):
        assert before == after != during
    assert "t_top" in found["status"] and found["status"] in found["status_bar"]
    assert found["visible"] == [False, False]
    assert found["visible_after"] == [True, True]
    assert found["said"] == ""


def test_a_warning_of_the_plates_is_seen_on_the_member(window):
    found = seen(window, "warnings")
    assert found == {"worst": ["warning", "warning"], "status": "ok"}


def test_hundreds_of_labels_do_not_stall_the_view(window):
    """The software renderer of the test needs under half a second for a view with all labels."""
    found = seen(window, "speed")
    assert found["labels"] > 500
    assert found["frame"] < 0.5


def test_the_report_view_has_no_exception(window):
    assert "Traceback" not in window["report_view"]
    assert "Bnd_Box" not in window["report_view"]


def test_members_are_fitted_without_the_surface_they_lie_on(window):
    """All, or the one that is selected, as large as there is room; surface and selection stay."""
    found = seen(window, "fitted")
    # Views are wider in FreeCAD 1.0, without the dock at their side; a ball fills the shorter side.
    wide, tall = (side / min(found["room"]) for side in found["room"])

    def size(boxes):
        low, high = (pick(box[k] for box in boxes) for k, pick in ((0, min), (1, max)))
        bottom, top = (pick(box[k] for box in boxes) for k, pick in ((2, min), (3, max)))
        assert min(low, bottom) >= 0.0 and max(high, top) <= 1.0
        return max(wide * (high - low), tall * (top - bottom))

    assert size(found["everything"]) < 0.5 and size(found["members"]) > 0.8
    assert size(found["one"][1:]) > 0.8 and size(found["one"][1:]) > size(found["members"][1:])
    assert found["selected"] == ["M2"] and found["surface"] == [True, True]
