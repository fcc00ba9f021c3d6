# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every groove of the catalogue in NC1 and DXF files: signs, depths and faces, on both faces."""

import io
import itertools
import math
from dataclasses import replace

import ezdxf
import pytest
from cut_members import job
from test_nc1 import contour, read

from BendTorsionWB.core.detailing import PlatesInput, detail
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.surface import Plane
from BendTorsionWB.core.patterns.laid_flat import PatternInput
from BendTorsionWB.core.plates.plates import Joints
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.welds.edge_rows import EdgeTreatment
from BendTorsionWB.core.welds.preps import TYPES, prep_of
from BendTorsionWB.exchange.dxf import plate_dxf
from BendTorsionWB.exchange.nc1 import plate_nc1

T, WIDTH, LENGTH = 20.0, 560.0, 6000.0
GROOVES = {
    "HV": ("bevel angle=40", 40.0, (20.0, 0.0)),
    "HY": ("bevel angle=40 land=6", 40.0, (14.0, 0.0)),
    "V": ("v angle=60", 30.0, (20.0, 0.0)),
    "Y": ("v angle=60 land=4", 30.0, (16.0, 0.0)),
    "K": ("double-bevel angle=45 land=2", 45.0, (9.0, 9.0)),
    "X": ("double-v angle=60", 30.0, (10.0, 10.0)),
    "I": ("square gap=2", 0.0, (0.0, 0.0)),
    "fillet": ("fillet leg=8", 0.0, (0.0, 0.0)),
}
BOTH = ("V", "Y", "X")
"""Grooves cut into both plates: at joints, not at the corners of a box."""
CASES = [
    (kind, side, face)
    for kind, side, face in itertools.product(GROOVES, ("outer", "inner"), ("inside", "outside"))
    # Outside the flush corner there is no ledge for a fillet.
    if kind not in BOTH and (kind, side) != ("fillet", "outer")
]


def plates(words, marking_face, contour_face, seam="TR"):
    """The plates of a straight box, its seam of this groove and its other seams square."""
    section = box("B", "box1", 800, 600, T)
    given = job([(0, 0, 0), (LENGTH, 0, 0)], Plane(), section=section)
    rows = [EdgeTreatment(name, prep=prep_of("square")) for name in ("TL", "TR", "BL", "BR")]
    rows += [EdgeTreatment("joints", prep=prep_of("square"))]
    rows += [EdgeTreatment(seam, prep=prep_of(words))]
    joints = {"top": Joints((2500.0,), "mm")}
    patterns = PatternInput(marking_face=marking_face, contour=contour_face)
    given = replace(given, plates=PlatesInput(joints, edges=tuple(rows)), patterns=patterns)
    return {plate.mark: plate for plate in detail(given).record.plates}


def nc1_of(words, marking_face, contour_face, seam="TR", mark="M1-T1"):
    return read(plate_nc1(plates(words, marking_face, contour_face, seam)[mark]))


def bevels(file):
    """The bevel fields of all lines of the contour that have any."""
    return [tuple(point[3:7]) for point in contour(dict(file["blocks"])["AK"]) if any(point[3:7])]


@pytest.mark.parametrize("kind, side, marking_face", CASES)
def test_the_face_that_is_cut_back_is_the_one_the_file_says(kind, side, marking_face):
    """Angles are positive on the face whose contour the groove makes narrower, by depth · tan."""
    words, angle, (own, opposite) = GROOVES[kind]
    words = f"{words} {side}"
    front_is_side = (marking_face == "outside") == (side == "outer")
    front, back = (own, opposite) if front_is_side else (opposite, own)
    found = bevels(nc1_of(words, marking_face, "mid"))
    if not own:
        assert found == []
        return
    ((angle1, depth1, angle2, depth2),) = found
    if front:
        assert (angle1, depth1) == pytest.approx((angle, front))
    else:
        assert (angle1, depth1) == pytest.approx((0.0, T - back))
    if back:
        assert (angle2, depth2) == pytest.approx((angle, back))
    else:
        assert (angle2, depth2) == pytest.approx((0.0, T - front))
    # The same groove by the widths of two files: of the marking face, and of the widest line.
    gap = prep_of(words).gap
    top, widest = (nc1_of(words, marking_face, face) for face in ("top", "widest"))
    widths = float(top["header"][9]), float(widest["header"][9])
    assert widths[1] == pytest.approx(WIDTH - gap, abs=0.02)
    assert widths[1] - widths[0] == pytest.approx(front * math.tan(math.radians(angle)), abs=0.02)
    assert top["header"][20] == "contour top" and widest["header"][20] == "contour widest"


@pytest.mark.parametrize("kind", BOTH)
def test_a_v_is_cut_into_both_plates_of_a_joint(kind):
    words, angle, depths = GROOVES[kind]
    for mark in ("M1-T1", "M1-T2"):
        file = nc1_of(words, "outside", "mid", "joints", mark)
        ((angle1, depth1, *_),) = bevels(file)
        assert (angle1, depth1) == pytest.approx((angle, depths[0]))
        (at,) = [p for p in contour(dict(file["blocks"])["AK"]) if any(p[3:7])]
        # Counter-clockwise: the end at the greater x runs up, the start runs down.
        end = float(file["header"][8]) if mark == "M1-T1" else 0.0
        assert at[0] == pytest.approx(end, abs=0.02)


@pytest.mark.parametrize("kind", GROOVES)
def test_the_text_of_the_dxf_says_the_same(kind):
    words, angle, (own, opposite) = GROOVES[kind]
    words = f"{words} inner" if kind == "fillet" else words
    plate = plates(words, "outside", "mid", "joints" if kind in BOTH else "TR")["M1-T1"]
    drawing = ezdxf.read(io.StringIO(plate_dxf(plate).decode("utf-8")))
    assert not drawing.audit().errors
    texts = [t.dxf.text for t in drawing.modelspace().query('TEXT[layer=="MARK_BEVEL"]')]
    if not own:
        assert texts == []
        return
    (text,) = texts
    land = T - own - opposite
    wanted = f"{angle:.1f}/{angle:.1f} deg up/down" if opposite else f"{angle:.1f} deg up"
    assert text.startswith(wanted)
    assert (f"land {land:g}" in text) == (land > 0.0)


def test_what_the_catalogue_has_not_is_refused_by_name():
    assert {prep_of(words).type for words, *_ in GROOVES.values()} | {"double-fillet"} == set(TYPES)
    for kind in ("u", "j", "double-u"):
        with pytest.raises(BendTorsionError) as caught:
            prep_of(f"{kind} angle=20")
        assert "square, bevel, v, double-bevel, double-v" in str(caught.value)
