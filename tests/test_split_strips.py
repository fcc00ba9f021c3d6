# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the split editor draws: developed strips of faces, and rules at a joint."""

import numpy as np
import pytest

from BendTorsionWB.core.joints.joint_margins import joint_margins
from BendTorsionWB.core.joints.joint_solver import JointRules
from BendTorsionWB.core.patterns.face_strip import face_strip

RADIUS = 20000.0


@pytest.fixture(scope="module")
def arch():
    """Developed plates by face of a box on an arc of 20 m radius in the plane x-z."""
    import FreeCAD

    from BendTorsionWB import make
    from BendTorsionWB.objects import unfold

    document = FreeCAD.newDocument("arch", hidden=True)
    angles = np.radians(np.linspace(-15.0, 15.0, 9))
    points = [(RADIUS * np.sin(a), 0.0, RADIUS * np.cos(a)) for a in angles]
    ground = make.make_surface(document, "Sphere", "sphere", r=RADIUS)
    axis = make.make_axis(document, "A", ground, points)
    section = make.make_section(document, "S", h=800, b=600, t=16)
    member = make.make_member(document, "M", axis, [section])
    plates = make.make_plates(document, member, {"left": [3000, 7000], "top": [4000]})
    laid = make.make_unfold(document, plates)
    document.recompute()
    record = unfold.member_record_of(laid)
    found = {}
    for plate in record.plates:
        found.setdefault(plate.face, []).append(plate)
    yield found
    FreeCAD.closeDocument(document.Name)


def test_a_web_of_an_arch_is_an_arc_of_its_radius(arch):
    """The web lies in the plane of the arch: laid flat it is a piece of a ring."""
    strip = face_strip(arch["left"])
    for edge, radius in ((strip.first, RADIUS + 400.0), (strip.second, RADIUS - 400.0)):
        # A circle through three points of the edge holds the others.
        a, b, c = edge[0], edge[len(edge) // 2], edge[-1]
        rows = np.array([2 * (b - a), 2 * (c - a)])
        centre = np.linalg.solve(rows, [b @ b - a @ a, c @ c - a @ a])
        assert np.hypot(*(edge - centre).T) == pytest.approx(radius, rel=2e-4)


def test_a_flange_of_an_arch_is_straight(arch):
    """As long as the arc it lies on, of constant width."""
    strip = face_strip(arch["top"])
    mid = RADIUS + 400.0 - 8.0
    assert np.ptp(strip.first[:, 1]) < 0.1
    assert np.hypot(*(strip.first - strip.second).T) == pytest.approx(568.0, abs=1e-3)
    assert strip.first[-1, 0] - strip.first[0, 0] == pytest.approx(np.radians(30) * mid, rel=1e-4)


def test_plates_meet_at_their_joints(arch):
    """The end line of a plate is the start line of the next: the strip has no gaps or steps."""
    strip = face_strip(reversed(arch["left"]))
    assert (np.diff(strip.s) >= 0.0).all()
    at = np.flatnonzero(np.diff(strip.s) < 1e-9)
    assert len(at) == 2
    assert np.abs(strip.first[at] - strip.first[at + 1]).max() < 0.02


def test_places_are_found_on_the_strip_again(arch):
    strip = face_strip(arch["left"])
    for s in (0.0, 1234.5, 3000.0, 9000.0):
        assert strip.place_at(strip.across(s).mean(axis=0)) == pytest.approx(s, abs=1e-3)


def test_lanes_of_a_face_are_strips_of_their_own_below_each_other():
    """A flange in two lanes: two strips of half the width, as long as each other, no plate left
    out; the rows of one face stand closer than those of two."""
    import FreeCAD

    from BendTorsionWB import make
    from BendTorsionWB.gui.split_scene import by_lane, rows_of
    from BendTorsionWB.objects import plate_set, unfold

    document = FreeCAD.newDocument("lanes", hidden=True)
    ground = make.make_surface(document, "Ground", "plane")
    axis = make.make_axis(document, "A", ground, [(0, 0, 0), (9000, 0, 0)])
    section = make.make_section(document, "S", h=800, b=3000, t=16)
    member = make.make_member(document, "M", axis, [section])
    lanes = {"top": [0.5]}
    plates = make.make_plates(document, member, {"top": [3000, 6000]}, lanes=lanes)
    laid = make.make_unfold(document, plates)
    document.recompute()
    record = unfold.member_record_of(laid)
    made = plate_set.value(plates)
    FreeCAD.closeDocument(document.Name)
    own = {
        face: [plate for plate in record.plates if plate.face == face] for face in ("top", "left")
    }
    letters = {item.plate.mark: item.plate.lane.letter for item in made.plates}
    found = by_lane(own, letters)
    assert list(found) == [("top", "a"), ("top", "b"), ("left", "")]
    assert [len(plates) for plates in found.values()] == [3, 3, 1]
    strips = {lane: face_strip(plates) for lane, plates in found.items()}
    for letter in "ab":
        strip = strips["top", letter]
        assert np.hypot(*(strip.first - strip.second).T) == pytest.approx(0.5 * 2968.0, abs=20.0)
        assert strip.first[-1, 0] - strip.first[0, 0] == pytest.approx(9000.0, abs=1e-3)
    rows, _ = rows_of(strips)
    bottom = [row.line(0.0).p2().y() for row in rows.values()]
    top = [row.line(0.0).p1().y() for row in rows.values()]
    spaces = [min(top[k + 1], bottom[k + 1]) - max(top[k], bottom[k]) for k in range(len(rows) - 1)]
    assert 0.0 < spaces[0] < 0.5 * spaces[1]


def margins(**changes):
    cuts = {"top": [0.0, 4000.0, 12000.0], "left": [0.0, 4150.0, 12000.0], "bottom": [0.0, 12000.0]}
    adjacent = {"top": ("left",), "left": ("top", "bottom"), "bottom": ("left",)}
    given = {"folds": (3950.0, 8000.0), "keep_outs": {"diaphragm": (5000.0,), "node": ()}} | changes
    return {m.rule: m for m in joint_margins("top", 0, cuts, JointRules(), adjacent, **given)}


def test_the_rules_at_a_joint():
    """Plates of 4 and 8 m, the web's joint 150 mm away, a fold at 50, a diaphragm at 1000."""
    found = margins()
    figures = {name: (m.figure, m.kept) for name, m in found.items()}
    assert figures == {
        "shortest_piece": (4000.0, True),
        "longest_piece": (8000.0, True),
        "stagger": (150.0, False),
        "fold_clearance": (50.0, False),
        "diaphragm_clearance": (1000.0, True),
    }
    assert found["stagger"].about == "left"
    assert found["stagger"].limit == 200.0


def test_rules_without_anything_to_measure_are_left_out():
    found = margins(folds=(), keep_outs={})
    assert set(found) == {"shortest_piece", "longest_piece", "stagger"}
    alone = joint_margins("bottom", 0, {"bottom": [0.0, 500.0, 14000.0]}, JointRules(), {})
    assert [(m.rule, m.kept) for m in alone] == [
        ("shortest_piece", False),
        ("longest_piece", False),
    ]
