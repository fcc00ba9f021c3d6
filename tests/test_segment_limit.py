# SPDX-License-Identifier: LGPL-2.1-or-later
"""A number of segments that no member has is refused by name, and adds no properties for ever."""

import FreeCAD  # noqa: F401
import Part  # noqa: F401
import pytest

from BendTorsionWB import make
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.objects import member as member_object
from BendTorsionWB.objects import segment_edit
from BendTorsionWB.objects.proxy import findings_of


@pytest.fixture
def member(document, monkeypatch):
    monkeypatch.setattr(member_object, "MOST_SEGMENTS", 3)
    plane = make.make_surface(document, "Ground", "plane")
    axis = make.make_axis(document, "A", plane, [(0, 0, 0), (5000, 0, 0)])
    section = make.make_section(document, "B", h=500, b=400, t=12)
    made = make.make_member(document, "M1", axis, [section])
    document.recompute()
    assert made.Status == "ok"
    return made


@pytest.mark.parametrize("count", [4, 10**6, 2**31 - 1])
def test_too_many_segments_are_refused_and_taken_back(document, member, count):
    member.Segments = count
    document.recompute()
    (finding,) = findings_of(member)
    assert (finding.code, finding.value, finding.limit) == ("segments", count, 3)
    assert not member.Shape.SubShapes and "Section3" in member.PropertiesList
    assert "Section4" not in member.PropertiesList
    member.Segments = 1
    document.recompute()
    assert member.Status == "ok"


def test_no_segment_is_inserted_beyond_the_limit(document, member):
    for place in (1000.0, 2000.0):
        segment_edit.add_cut(member, place)
    with pytest.raises(BendTorsionError, match="more segments"):
        segment_edit.add_cut(member, 3000.0)
    assert member.Segments == 3
    with pytest.raises(BendTorsionError, match="too many"):
        make.make_member(document, "M2", member.Axis, [member.Section1] * 4)


def test_every_whole_number_that_is_an_input_is_known_here(document):
    """Of all, Segments alone creates what it counts."""
    from BendTorsionWB.objects.repair import KINDS

    found = {
        item.name
        for kind in KINDS.values()
        for item in kind.PROPERTIES
        if item.type == "App::PropertyInteger" and not item.output
    }
    assert found == {"Segments", "Rank", "RulePatch", "Index"}
