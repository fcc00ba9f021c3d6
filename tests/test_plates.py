# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plates: joints by ratio and mm, forced joints, marks, stations, and what the rules say."""

import numpy as np
import pytest
from curved_members import ELLIPSOID, in_space, member, tapered

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.piecewise import Piecewise
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.plates.plates import JointRules, Joints, split_plates
from BendTorsionWB.core.sections.section import box

PAPER = {
    "left": Joints((0.2, 0.4, 0.6, 0.8, 1.0)),
    "right": Joints((0.15, 0.35, 0.45, 0.75, 1.0)),
    "top": Joints((0.1, 0.3, 0.55, 0.7, 0.85, 1.0)),
    "bottom": Joints((0.25, 0.5, 0.65, 0.9, 1.0)),
}
S800 = box("B800", "box1", 800, 800, 20)


@pytest.fixture(scope="module")
def plain():
    return member([Segment(S800)])


@pytest.fixture(scope="module")
def taper():
    return tapered(cut=9000.0)


def ends(plates, face):
    return [p.start for p in plates if p.face == face] + [plates[-1].end]


def codes(call, *arguments):
    with pytest.raises(BendTorsionError) as caught:
        call(*arguments)
    return {f.code for f in caught.value.findings}, caught.value.findings


def test_the_papers_ratios_cut_each_face_at_its_parts_of_the_length(plain):
    plates, _ = split_plates(plain, PAPER)
    for face, joints in PAPER.items():
        assert ends(plates, face) == pytest.approx([0, *(v * plain.length for v in joints.values)])
    assert [p.mark for p in plates if p.face == "right"] == [f"M1-R{k}" for k in range(1, 6)]
    assert [p.face for p in plates] == sorted(
        (p.face for p in plates), key=["top", "bottom", "left", "right"].index
    )


def test_joints_in_mm_and_the_end_of_the_axis_is_no_joint(plain):
    length = plain.length
    plates, _ = split_plates(plain, {"top": Joints((5000.0, 12000.0, length), "mm")})
    assert ends(plates, "top") == pytest.approx([0, 5000, 12000, length])
    assert ends(plates, "left") == pytest.approx([0, length])
    same, _ = split_plates(plain, {"top": Joints((5000.0, 12000.0), "mm")})
    assert ends(same, "top") == ends(plates, "top")


def test_a_joint_given_at_a_thickness_joint_is_that_joint(taper):
    [forced] = taper.law.joints_of(0)
    assert taper.law.joints_of(1) == (forced,)
    assert taper.law.joints_of(2) == taper.law.joints_of(3) == (forced + 200.0,)
    assert forced == taper.law.folds[1] + 100.0
    plates, _ = split_plates(taper, {"top": Joints((4000.0, forced), "mm")})
    assert ends(plates, "top") == pytest.approx([0, 4000, forced, taper.length])
    assert [p.thickness for p in plates if p.face == "top"] == [20, 20, 16]
    assert ends(plates, "bottom") == pytest.approx([0, forced, taper.length])
    assert ends(plates, "left") == pytest.approx([0, forced + 200.0, taper.length])


def test_the_parts_make_up_the_whole(taper):
    whole, _ = split_plates(taper, {})
    parts, _ = split_plates(taper, PAPER)
    for face in PAPER:
        volume = [sum(p.volume for p in plates if p.face == face) for plates in (whole, parts)]
        # Ends are plane sections of one strip; only the relief beside a fold knows of the joints.
        assert volume[1] == pytest.approx(volume[0], rel=5e-6)
    for plate in parts:
        assert plate.volume > 0 and plate.rails.outer.start == plate.start


@pytest.mark.parametrize("spacing", [500.0, 333.0])
def test_stations_are_even_and_the_fewest_that_keep_the_spacing_on_every_corner_line(
    plain, taper, spacing
):
    for built in (plain, taper):
        stations = built.stations(spacing)
        count = len(stations) - 1
        assert np.abs(np.diff(stations) - built.length / count).max() < 1e-8
        assert widest_interval(built, count) <= spacing + 1e-3
        fewest = int(np.ceil(built.corner_lengths.max() / spacing))
        for fewer in range(fewest, count):
            assert widest_interval(built, fewer) > spacing


def widest_interval(built, count):
    """Largest length of a corner line between neighbours of count + 1 even stations, by hand."""
    s = np.linspace(0.0, built.length, 40 * count + 1)
    lines = np.stack([corner_line(built, s, k) for k in range(4)])
    chords = np.linalg.norm(np.diff(lines, axis=1), axis=2)
    return chords.reshape(4, count, 40).sum(axis=2).max()


def corner_line(built, s, k):
    """Points of one corner line by hand."""
    planes = np.empty((len(s), 2))
    for cell in built.law.cells:
        here = (s >= cell.start) & (s <= cell.end)
        planes[here] = cell.corners[k] + (s[here] - cell.start)[:, None] * cell.corner_rates[k]
    return in_space(built, ELLIPSOID, s, planes)


def test_lines_of_a_plate_are_its_ends_stations_and_folds(taper):
    plates, _ = split_plates(taper, PAPER, 500.0)
    stations = taper.stations(500.0)
    for plate in plates:
        labels = [line.label for line in plate.lines]
        places = np.array([line.s for line in plate.lines])
        assert labels[0] == "E-1" and labels[-1] == "E-2"
        assert (places[0], places[-1]) == (plate.start, plate.end)
        assert (np.diff(places) > 0).all() and len(set(labels)) == len(labels)
        for line in plate.lines:
            if line.label.startswith("L-"):
                assert line.s == stations[int(line.label[2:])] and line.s_mid == line.s
        folds = [line.s for line in plate.lines if line.label.startswith("F-")]
        assert folds == [f for f in taper.law.folds if plate.start < f < plate.end]
        inside = [
            s
            for s in stations
            if plate.start + 1 < s < plate.end - 1 and all(abs(s - f) > 10 for f in folds)
        ]
        assert len(inside) == len(labels) - 2 - len(folds)


def test_measuring_panels_stay_within_the_spacing(taper):
    for plate in split_plates(taper, PAPER, 500.0)[0]:
        places = np.array([line.s for line in plate.lines])
        rate = plate.rails.outer.derivative
        speed = np.linalg.norm(rate.values.reshape(*rate.values.shape[:2], 2, 3), axis=3)
        along = Piecewise(rate.breaks, speed).antiderivative()(places)
        assert np.diff(along, axis=0).max() <= 500.0 + 15.0


@pytest.mark.parametrize(
    "joints, word",
    [
        (Joints((0.4, 0.2, 1.0)), "rise"),
        (Joints((0.4, 0.4, 1.0)), "rise"),
        (Joints((0.2, float("nan"))), "rise"),
        (Joints((0.0, 0.5)), "after the start"),
        (Joints((-0.1, 0.5)), "after the start"),
        (Joints((0.5, 1.2)), "beyond"),
        (Joints((5000.0, 99000.0), "mm"), "beyond"),
    ],
)
def test_joints_out_of_order_or_beyond_are_refused(plain, joints, word):
    found, findings = codes(split_plates, plain, {"left": joints})
    assert found == {"joints"}
    assert word in findings[0].message and findings[0].position == "face left"
    assert findings[0].object == "M1" and findings[0].mend


def test_a_joint_beside_a_fold_or_another_joint_is_refused(taper, plain):
    fold = taper.law.folds[0]
    found, [finding] = codes(split_plates, taper, {"top": Joints((fold - 4.0,), "mm")})
    assert found == {"plate-too-short"} and "fold" in finding.message
    assert finding.value == pytest.approx(4.0) and "face top" in finding.position
    found, [finding] = codes(split_plates, plain, {"top": Joints((5000.0, 5003.0), "mm")})
    assert found == {"plate-too-short"} and "sliver" in finding.message
    # At the limit, but for the last digits of the sum.
    assert split_plates(taper, {"top": Joints((fold - 10.0 + 5e-7,), "mm")})[0]
    on_fold, _ = split_plates(taper, {"top": Joints((fold,), "mm")})
    assert fold in ends(on_fold, "top")


def test_the_rules_warn_and_move_nothing(plain):
    joints = {
        "top": Joints((5000.0,), "mm"),
        "left": Joints((5150.0,), "mm"),
        "bottom": Joints((500.0, 5000.0), "mm"),
    }
    plates, findings = split_plates(plain, joints, rules=JointRules(200.0, 600.0))
    assert ends(plates, "left") == pytest.approx([0, 5150, plain.length])
    close = [f for f in findings if f.code == "joints-not-staggered"]
    # top and bottom share no edge; left meets both.
    assert sorted((f.message, f.value) for f in close) == [
        ("joints of faces bottom and left are too close", pytest.approx(150)),
        ("joints of faces top and left are too close", pytest.approx(150)),
    ]
    [short] = [f for f in findings if f.code == "piece-too-short"]
    assert short.value == pytest.approx(500) and "bottom" in short.position
    assert {f.severity for f in findings} == {"warning"}
    assert split_plates(plain, joints)[1] == ()


def test_a_step_cuts_every_face(plain):
    small = box("B600", "box1", 600, 600, 20)
    stepped = member([Segment(S800), Segment(small, 9000.0, 0.0)])
    plates, _ = split_plates(stepped, {})
    assert all(ends(plates, face)[1] == 9000.0 for face in PAPER)
    assert not any(p.folds for p in plates)
