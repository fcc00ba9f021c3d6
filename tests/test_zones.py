# SPDX-License-Identifier: LGPL-2.1-or-later
"""The section law: flush faces, linear transitions, their length, steps, thickness changes."""

import numpy as np
import pytest

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.members.segment import ALIGNMENTS, Segment
from BendTorsionWB.core.members.zones import section_law
from BendTorsionWB.core.sections.section import box

LENGTH = 20000.0
BIG = box("B800", "box1", 800, 700, 20)
SMALL = box("B600", "box1", 600, 560, 16)


def faces(corners):
    """Positions of the faces of a box from its corners TL, TR, BR, BL."""
    (left, top), (right, bottom) = corners[0], corners[2]
    assert np.array_equal(corners, [(left, top), (right, top), (right, bottom), (left, bottom)])
    return {"top": top, "bottom": bottom, "left": left, "right": right}


def span(law, label):
    """Start and end of a zone, whatever thickness changes and chamfers cut it into."""
    cells = [cell for cell in law.cells if cell.label == label]
    return cells[0].start, cells[-1].end


def zone(law, label):
    return next(cell for cell in law.cells if cell.label == label)


def at_end(cell):
    return cell.corners + (cell.end - cell.start) * cell.corner_rates


@pytest.mark.parametrize("align", ALIGNMENTS)
def test_alignment_to_the_axis_puts_the_named_faces_on_it(align):
    law = section_law("M1", [Segment(SMALL, align=align, offset_y=7.0, offset_z=-11.0)], LENGTH)
    [cell] = law.cells
    place = faces(cell.corners - [7.0, -11.0])
    for low, high, size in (("bottom", "top", 600), ("right", "left", 560)):
        named = [name for name in (low, high) if name in align]
        expected = (
            {low: 0.0, high: size}
            if low in named
            else ({high: 0.0, low: -size} if named else {low: -size / 2, high: size / 2})
        )
        assert {key: place[key] for key in expected} == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("first", ["centre", "top-left", "bottom"])
@pytest.mark.parametrize("align", ALIGNMENTS)
def test_alignment_to_the_previous_makes_the_named_faces_flush(align, first):
    segments = [
        Segment(BIG, align=first, offset_y=40.0),
        Segment(SMALL, 8000.0, align=align, align_to="previous"),
    ]
    law = section_law("M1", segments, LENGTH, offset_z=-100.0)
    before, after = (faces(zone(law, label).corners) for label in ("d-1", "d-2"))
    step = {name: after[name] - before[name] for name in before}
    for low, high, change in (("bottom", "top", -200), ("right", "left", -140)):
        if low in align:
            expected = {low: 0, high: change}
        elif high in align:
            expected = {high: 0, low: -change}
        else:
            expected = {high: change / 2, low: -change / 2}
        assert {key: step[key] for key in expected} == pytest.approx(expected, abs=1e-9)
    assert vars(law.face_steps[0]) == pytest.approx(step)


def test_offsets_of_the_later_segment_count_in_its_face_steps():
    segments = [
        Segment(BIG),
        Segment(SMALL, 8000.0, align="top", align_to="previous", offset_y=25.0, offset_z=-5.0),
    ]
    [step] = section_law("M1", segments, LENGTH).face_steps
    assert vars(step) == pytest.approx({"top": -5, "bottom": 195, "left": -45, "right": 95})
    assert step.largest == 195


def test_the_transition_is_linear_and_as_long_as_its_slope_says():
    law = section_law("M1", [Segment(BIG), Segment(SMALL, 8000.0, 2.5)], LENGTH)
    b = zone(law, "b-1")
    # Largest face-to-face step of a centred 800 -> 600: 100.
    assert span(law, "b-1") == (8000.0, 8250.0)
    assert law.folds == (8000.0, 8250.0)
    assert np.array_equal(b.corners, BIG.corners)
    middle = b.corners + 125.0 * b.corner_rates
    assert middle == pytest.approx((np.array(BIG.corners) + SMALL.corners) / 2)
    last = [cell for cell in law.cells if cell.label == "b-1"][-1]
    assert at_end(last) == pytest.approx(np.array(SMALL.corners))
    assert list(dict.fromkeys(c.label for c in law.cells)) == ["d-1", "b-1", "d-2"]
    assert law.length == LENGTH


@pytest.mark.parametrize(
    "align_to, align, rule, expected",
    [
        ("axis", "centre", "face", 100),
        ("previous", "top", "face", 200),
        ("previous", "left", "face", 140),
        ("axis", "centre", "total", 200),
        ("previous", "top-left", "total", 200),
    ],
)
def test_transition_length_per_face_and_in_total(align_to, align, rule, expected):
    segments = [Segment(BIG), Segment(SMALL, 8000.0, 4.0, align=align, align_to=align_to)]
    law = section_law("M1", segments, LENGTH, transition_length=rule)
    start, end = span(law, "b-1")
    assert end - start == pytest.approx(4.0 * expected)


def test_a_cut_by_ratio_is_a_part_of_the_length():
    law = section_law("M1", [Segment(BIG), Segment(SMALL, 0.35, cut_is_ratio=True)], LENGTH)
    assert zone(law, "b-1").start == pytest.approx(7000.0)


def test_slope_zero_is_a_step_where_every_face_is_cut():
    law = section_law("M1", [Segment(BIG), Segment(SMALL, 8000.0, 0.0)], LENGTH)
    assert [(c.label, c.start, c.end) for c in law.cells] == [
        ("d-1", 0, 8000),
        ("d-2", 8000, LENGTH),
    ]
    assert law.joints == (8000.0,) and law.folds == ()


def test_flush_segments_have_no_transition_and_no_fold():
    same = box("B800b", "box1", 800, 700, 20)
    law = section_law("M1", [Segment(BIG), Segment(same, 8000.0)], LENGTH)
    assert law.joints == () and law.folds == ()
    assert {c.label for c in law.cells} == {"d-1", "d-2"}
    # A step of the gaps alone still cuts the plates.
    gapped = box("B800g", "box1", 800, 700, 20, gap1=3)
    assert section_law("M1", [Segment(BIG), Segment(gapped, 8000.0)], LENGTH).joints == (8000.0,)


def test_gaps_vary_linearly_through_the_transition():
    wide, narrow = (
        box("g", "box1", 600 + d, 600 + d, 16, gap1=g, gap2=2 * g) for d, g in ((200, 10), (0, 2))
    )
    b = zone(section_law("M1", [Segment(wide), Segment(narrow, 5000.0)], LENGTH), "b-1")
    top = b.gaps[0] + 0.5 * (b.end - b.start) * b.gap_rates[0]
    assert top == pytest.approx([6, 12])


def test_three_segments_each_with_its_own_slope():
    segments = [Segment(BIG), Segment(SMALL, 6000.0, 3.0), Segment(BIG, 12000.0, 5.0)]
    law = section_law("M1", segments, LENGTH)
    spans = [(label, *span(law, label)) for label in dict.fromkeys(c.label for c in law.cells)]
    assert spans == [
        ("d-1", 0, 6000),
        ("b-1", 6000, 6300),
        ("d-2", 6300, 12000),
        ("b-2", 12000, 12500),
        ("d-3", 12500, 20000),
    ]
    for one, two in zip(law.cells, law.cells[1:]):
        assert at_end(one) == pytest.approx(two.corners)


@pytest.mark.parametrize(
    "segments, code, position, value, limit",
    [
        ([Segment(BIG), Segment(SMALL, 25000.0)], "cut-beyond-axis", "segment 2", 25000, 20000),
        ([Segment(BIG), Segment(SMALL, 20000.0)], "cut-beyond-axis", "segment 2", 20000, 20000),
        ([Segment(BIG), Segment(SMALL, 0.0)], "cut-order", "segment 2", 0, 0),
        (
            [Segment(BIG), Segment(SMALL, 9000.0), Segment(BIG, 7000.0)],
            "cut-order",
            "segment 3",
            7000,
            9000,
        ),
        ([Segment(BIG), Segment(SMALL, 19900.0)], "transition-past-end", "segment 2", 20150, 20000),
        (
            [Segment(BIG), Segment(SMALL, 9000.0), Segment(BIG, 9200.0)],
            "transitions-overlap",
            "segment 2",
            9250,
            9200,
        ),
        ([Segment(BIG), Segment(SMALL, 9000.0, -1.0)], "slope", "segment 2", -1, 0),
        ([Segment(BIG), Segment(SMALL, 9000.0, np.nan)], "slope", "segment 2", None, 0),
        (
            [Segment(BIG), Segment(box("w", "box2", 600, 600, 16), 9000.0)],
            "type-change",
            "segment 2",
            "box2",
            "box1",
        ),
        ([Segment(BIG, align="above")], "alignment", "segment 1", None, None),
        ([Segment(BIG, align_to="next")], "alignment", "segment 1", None, None),
    ],
)
def test_what_cannot_be_is_refused_with_place_and_size(segments, code, position, value, limit):
    with pytest.raises(BendTorsionError) as caught:
        section_law("M1", segments, LENGTH)
    [finding] = caught.value.findings
    assert (finding.severity, finding.code, finding.object, finding.position) == (
        "error",
        code,
        "M1",
        position,
    )
    assert finding.mend
    if value is not None:
        assert finding.value == value
    assert finding.limit == limit


def test_a_transition_shorter_than_its_plates_is_warned_of():
    near = box("B790", "box1", 790, 700, 20)
    law = section_law("M1", [Segment(BIG), Segment(near, 9000.0)], LENGTH)
    [finding] = law.findings
    assert (finding.severity, finding.code, finding.position) == (
        "warning",
        "transition-short",
        "segment 2",
    )
    assert (finding.value, finding.limit, finding.unit) == (12.5, 40.0, "mm") and finding.mend
    assert section_law("M1", [Segment(BIG), Segment(near, 9000.0, 10.0)], LENGTH).findings == ()


def test_all_faults_are_told_at_once():
    segments = [Segment(BIG), Segment(SMALL, 25000.0, -1.0), Segment(BIG, 3000.0)]
    with pytest.raises(BendTorsionError) as caught:
        section_law("M1", segments, LENGTH)
    assert {f.code for f in caught.value.findings} == {"cut-beyond-axis", "slope", "cut-order"}


@pytest.mark.parametrize(
    "sizes, code",
    [
        ({"h": 0}, "section-size"),
        ({"b": -800}, "section-size"),
        ({"h": np.nan}, "section-size"),
        ({"t_top": 1e-320}, "section-size"),
        ({"t_web": 0.02}, "section-size"),
        ({"h": 1e6}, "section-size"),
        ({"b": 50_000.1}, "section-size"),
        ({"t_top": 400}, "plate-too-thick"),
        ({"t_web": 401}, "plate-too-thick"),
        ({"gap1": -1}, "section-gap"),
        ({"gap1": 400, "gap2": 400}, "gap-too-wide"),
        ({"gap1": 380, "gap2": 375}, "strip-too-narrow"),
        ({"type": "tee"}, "section-type"),
    ],
)
def test_sizes_that_make_no_box_are_refused(sizes, code):
    with pytest.raises(BendTorsionError) as caught:
        box(**{"name": "S1", "type": "box1", "h": 800, "b": 800, "t_top": 20, **sizes})
    assert code in {f.code for f in caught.value.findings}
    assert all(f.object == "S1" and f.mend for f in caught.value.findings)
