# SPDX-License-Identifier: LGPL-2.1-or-later
"""What clicks and drags on a member in the 3D view mean, without a window."""

import FreeCAD
import Part  # noqa: F401 - after FreeCAD, before the objects
import pytest

from BendTorsionWB import make
from BendTorsionWB.gui.cut_dragger import handles_of, read_out
from BendTorsionWB.gui.face_pick import position_at
from BendTorsionWB.objects import member as member_object


@pytest.fixture
def member():
    """A member along x: a transition of 500 mm, a step, a change of nothing but the number."""
    document = FreeCAD.newDocument("Picked")
    ground = make.make_surface(document, "Ground", "plane")
    axis = make.make_axis(document, "A1", ground, [(0, 0, 0), (12000, 0, 0)])
    low, high = (make.make_section(document, f"B{h}", h=h, b=500, t=12) for h in (400, 800))
    segments = [{}, {"cut": 3000}, {"cut": 6000, "slope": 0}, {"cut": 9000, "slope": 0}]
    made = make.make_member(document, "M1", axis, [low, high, low, low], segments)
    document.recompute()
    assert made.Status == "ok"
    yield made
    FreeCAD.closeDocument(document.Name)


def test_every_cut_has_a_handle_with_its_transition(member):
    """Slope 2.5 times a step of 200 mm at either face; a slope of 0 has no transition."""
    handles = handles_of(member_object.value(member).member)
    assert [handle.segment for handle in handles] == [2, 3, 4]
    assert [handle.s for handle in handles] == pytest.approx([3000.0, 6000.0, 9000.0])
    assert [handle.length for handle in handles] == pytest.approx([500.0, 0.0, 0.0])
    heights = [
        [float(outline[:, 1].max() - outline[:, 1].min()) for outline in (h.before, h.behind)]
        for h in handles
    ]
    assert heights == [pytest.approx(pair) for pair in ((400, 800), (800, 400), (400, 400))]
    assert read_out(handles[0], 2) == "Cut 2: s = 3000 mm, transition 500 mm"
    assert read_out(handles[1], 3) == "Cut 3: s = 6000 mm"


@pytest.mark.parametrize(
    ("point", "wanted"),
    [
        ((1000, 0, 200), "top"),
        ((1000, 240, 200), "top-left"),
        ((1000, -240, 200), "top-right"),
        ((1000, 250, 0), "left"),
        ((1000, -250, 30), "right"),
        ((1000, 0, -200), "bottom"),
        ((1000, 250, -190), "bottom-left"),
        # Behind the cut the section is twice as high, and its corners lie elsewhere.
        ((4500, 250, 190), "top-left"),
        ((4500, 250, 100), "left"),
    ],
)
def test_the_position_under_a_click(member, point, wanted):
    """Thirds of the breadth and of the height of the section that is there; y is to the left."""
    assert position_at(member, point) == wanted


def test_a_click_far_away_or_on_a_member_in_error_means_nothing(member):
    assert position_at(member, (1000, 0, 9000)) == ""
    member.Cut2 = 99000.0
    member.Document.recompute()
    assert position_at(member, (1000, 0, 200)) == ""
