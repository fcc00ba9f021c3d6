# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD's own Copy, Paste and Duplicate of members, by menu."""

import pytest
from freecad_window import session, step

pytestmark = pytest.mark.slow
LEAVE, AS_WELL = "Leave them", "Copy them as well"


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """What one session saw."""
    return session("copying", tmp_path_factory)


def test_what_stays_behind_is_told_and_may_stay(window):
    seen = step(window, "across")[LEAVE]
    (asked,) = seen["asked"]
    for label in ("M1 plates", "M1 patterns", "M1 bed", "M1 sheets"):
        assert label in asked
    assert "depends on" in asked and "N1" not in asked
    assert set(seen["pasted"]) == {"M1", "M1-axis", "B", "Ground"}


def test_it_comes_along_when_asked_for(window):
    """Computed, with the pages of its sheets and what plates depend on, in one undo step."""
    whole = step(window, "across")
    seen = whole[AS_WELL]
    assert len(seen["asked"]) == 1 and seen["undo"] == ["Paste"]
    expected = {label: found for label, found in whole["before"].items() if label != "M2 plates"}
    assert seen["pasted"] == expected and expected["M1 plates"][1]
    assert seen["pages"] == whole["pages"] > 0


def test_a_copy_that_is_cancelled_asks_for_nothing(window):
    """FreeCAD's own question answered with Cancel."""
    seen = step(window, "across")["cancel"]
    assert seen["asked"] == [] and seen["pasted"] == {}


def test_a_copy_beside_what_was_copied_has_marks_of_its_own(window):
    """FreeCAD gives members another name; plates and all that names them follow it."""
    seen, before = step(window, "within"), step(window, "across")["before"]
    assert "N1" in seen["asked"][0]
    came = {label: found for label, found in seen["pasted"].items() if label not in before}
    assert {found[0] for found in seen["pasted"].values()} == {"ok"}
    assert not any(found[2] for found in seen["pasted"].values())
    assert len([label for label in came if label.endswith(" plates")]) == 2
    marks = [mark for label, found in came.items() if "plates" in label for mark in found[1]]
    old = [mark for found in before.values() for mark in found[1]]
    assert marks and not set(marks) & set(old)
    for label, found in came.items():
        assert all(mark.startswith(label.split()[0]) for mark in found[1]), label
    assert {label: found for label, found in seen["pasted"].items() if label in before} == before
    assert seen["undone"] == before


def test_of_a_whole_document_nothing_is_asked_for(window):
    assert step(window, "all_of_it") == []


def test_a_duplicate_is_asked_for_too(window):
    seen, before = step(window, "duplicated"), step(window, "across")["before"]
    for way, kinds in ((LEAVE, 0), (AS_WELL, 1)):
        assert len(seen[way]["asked"]) == 1 and "M2 plates" in seen[way]["asked"][0]
        came = [label for label in seen[way]["made"] if label not in before]
        assert sum(label.endswith(" plates") for label in came) == kinds
        assert seen[way]["undo"] == ["Duplicate"]
        assert {found[0] for found in seen[way]["made"].values()} == {"ok"}


def test_no_exception_in_the_report_view(window):
    assert "Traceback" not in window["report_view"] and "<class" not in window["report_view"]
