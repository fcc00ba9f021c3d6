# SPDX-License-Identifier: LGPL-2.1-or-later
"""The badge of a finding in the tree is where it comes from, and the list has it once."""

import FreeCAD
import Part
import pytest

from BendTorsionWB import make
from BendTorsionWB.gui import tree
from BendTorsionWB.objects.proxy import findings_of

OFF = 5.7


@pytest.fixture
def made(document):
    """A member with plates along an arc that lies off its sphere."""
    dome = make.make_surface(document, "Dome", "sphere", r=20000)
    arc = document.addObject("Part::Feature", "Arc")
    middle, across = FreeCAD.Vector(), FreeCAD.Vector(0, 1, 0)
    arc.Shape = Part.makeCircle(20000 + OFF, middle, across, 60, 80)
    axis = make.make_axis(document, "A1", dome, edge=(arc, "Edge1"))
    section = make.make_section(document, "B", h=600, b=400, t=16)
    member = make.make_member(document, "M1", axis, [section])
    plates = make.make_plates(document, member)
    patterns = make.make_unfold(document, plates)
    document.recompute()
    return axis, member, plates, patterns


def test_a_warning_has_its_badge_where_it_comes_from(made):
    """On the axis, and on the member it is folded below; plates and patterns only repeat it."""
    axis, member, plates, patterns = made
    assert all("axis-far-from-surface" in {f.code for f in findings_of(obj)} for obj in made)
    assert [tree.worst(obj) for obj in made] == ["warning", "warning", "", ""]
    assert {obj.Status for obj in made} == {"ok"}


def test_what_an_object_finds_itself_has_its_badge_there(made):
    axis, member, plates, patterns = made
    plates.JointsTop, plates.JointsLeft = [3000.0], [3010.0]
    plates.Document.recompute()
    assert "joint" in "".join(f.code for f in findings_of(plates))
    assert [tree.worst(obj) for obj in made] == ["warning", "warning", "warning", ""]


def test_an_error_is_on_everything_it_stops(made):
    axis, member, plates, patterns = made
    member.Section1 = None
    member.Document.recompute()
    assert [tree.worst(obj) for obj in (member, plates, patterns)] == ["error"] * 3


def test_a_curve_off_its_surface_is_kept_and_says_so(made):
    """The axis is the curve; what the finding says is what is so, and what can be done."""
    axis = made[0]
    [found] = findings_of(axis)
    assert axis.SurfaceDistanceMax.Value == pytest.approx(OFF) == found.value
    assert axis.Length.Value == pytest.approx(axis.Source[0].Shape.Length)
    assert "keeps to the curve" in found.message and found.mend.startswith("leave it where")
