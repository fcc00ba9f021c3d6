# SPDX-License-Identifier: LGPL-2.1-or-later
"""Texts of flat patterns: each where it can be read, found by a search for room."""

import io
from dataclasses import replace

import ezdxf
import ezdxf.path
import numpy as np
import pytest
from flat_plates import rectangle
from test_nc1 import square_edges

from BendTorsionWB.core.welds.bevel_record import EdgeBevel
from BendTorsionWB.exchange.dxf import plate_dxf
from BendTorsionWB.exchange.dxf_labels import Boxes, Room, along, blocks

LINE = np.array([[0.0, 0.0], [0.0, 800.0]])
CENTRE = np.array([500.0, 400.0])


def box(boxes, k):
    corner, reading, up = boxes.corners[k], boxes.reading[k], boxes.up[k]
    across, rise = boxes.widths[k] * reading, boxes.heights[k] * up
    return np.array([corner, corner + across, corner + across + rise, corner + rise])


def apart(one, other):
    """Whether two convex polygons, or a polygon and a line, have no point in common."""
    for polygon in (one, other):
        for edge in np.diff(np.vstack([polygon, polygon[:1]]), axis=0):
            normal = np.array([-edge[1], edge[0]])
            a, b = one @ normal, other @ normal
            if a.max() <= b.min() or b.max() <= a.min():
                return True
    return False


def test_a_text_stands_where_it_is_wanted_when_that_is_free():
    places = along("L-4", LINE[0], LINE[1], CENTRE, 25.0, 0.2)
    assert Room().clear(places) == 0
    first = box(places, 0)
    # Beside the line on the side of the centre, from a fifth of it on, reading upwards.
    assert first[0] == pytest.approx([25.0 * 1.4, 160.0])
    assert places.text[0] == 25.0 and places.reading[0].tolist() == [0.0, 1.0]


def test_a_text_gives_way_to_lines_and_to_other_texts():
    room = Room()
    crossing = np.array([[[-500.0, 200.0], [500.0, 200.0]], [[-500.0, 210.0], [500.0, 210.0]]])
    room.add_lines(crossing)
    taken = []
    for _ in range(6):
        places = along("R-3 R 26.4 m", LINE[0], LINE[1], CENTRE, 12.0, 0.2)
        own = box(places, room.clear(places))
        assert all(apart(own, line) for line in crossing)
        assert all(apart(own, other) for other in taken)
        assert 0.0 <= own[:, 1].min() and own[:, 1].max() <= 800.0
        taken.append(own)


def test_without_room_a_text_stands_where_it_crosses_least():
    room = Room()
    x = np.arange(-200.0, 200.0, 4.0)
    grid = np.array([[[at, -10.0], [at, 810.0]] for at in x])
    room.add_lines(grid)
    places = along("R-3 R 26.4 m", LINE[0], LINE[1], CENTRE, 12.0, 0.2)
    k = room.clear(places)
    crossed = [
        sum(not apart(box(places, i), line) for line in grid) for i in range(len(places.text))
    ]
    assert crossed[k] <= min(crossed) + 1


def test_a_block_finds_the_field_that_is_free():
    field = (np.array([[0.0, 0.0], [0.0, 800.0]]), np.array([[450.0, 0.0], [450.0, 800.0]]))
    room = Room()
    room.add_lines(np.array([[[225.0, 0.0], [225.0, 800.0]], *field]))
    places = blocks(19.0, 11.2, 14.0, np.array([1.0, 0.0]), [field])
    own = box(places, room.clear(places))
    assert apart(own, np.array([[225.0, 0.0], [225.0, 800.0]]))
    assert own.min() >= 0.0 and (own.max(axis=0) <= [450.0, 800.0]).all()


def test_arcs_are_kept_clear_of_not_their_chords():
    room = Room()
    room.add_contour(np.array([[0.0, 0.0, 1.0], [1000.0, 0.0, 0.0]]), close=False)
    sizes = np.array([20.0, 20.0])
    # On the arc below, and on its chord.
    places = Boxes(
        np.array([[490.0, -510.0], [490.0, -10.0]]),
        np.array([[1.0, 0.0], [1.0, 0.0]]),
        sizes,
        sizes,
        sizes,
    )
    assert room.clear(places) == 1


def test_texts_of_real_plates_cross_no_line_no_contour_and_no_other_text(built):
    _, out, _ = built
    crossed, count = [], 0
    for path in sorted((out / "plates").glob("*.dxf")):
        space = ezdxf.readfile(path).modelspace()
        texts = [(text.dxf.text, box_of(text)) for text in space.query("TEXT")]
        lines = [
            np.array([line.dxf.start.xyz, line.dxf.end.xyz])[:, :2]
            for line in space.query('LINE[layer!="MARK_TEXT"]')
        ]
        for contour in space.query("LWPOLYLINE"):
            points = np.array([p.xyz for p in ezdxf.path.make_path(contour).flattening(0.05)])[
                :, :2
            ]
            lines += list(np.stack([points[:-1], points[1:]], axis=1))
        count += len(texts)
        for k, (text, own) in enumerate(texts):
            others = [other for _, other in texts[:k]]
            if not all(apart(own, other) for other in (*lines, *others)):
                crossed.append((path.name, text))
    assert count > 200
    # A plate shorter than its own text may leave no room.
    assert len(crossed) <= 0.005 * count, crossed


def box_of(text):
    """The rectangle a text fills, letters as wide as 0.85 of their height."""
    a = np.radians(text.dxf.rotation)
    reading, up = np.array([np.cos(a), np.sin(a)]), np.array([-np.sin(a), np.cos(a)])
    corner, height = np.array(tuple(text.dxf.insert))[:2], text.dxf.height
    wide = 0.85 * height * len(text.dxf.text)
    return np.array(
        [corner, corner + wide * reading, corner + wide * reading + height * up]
        + [corner + height * up]
    )


def test_bevels_of_a_plate_with_end_lines_only_are_told_inside_it():
    ends = [
        EdgeBevel(side, line, "", "", 0.0, 800.0, 0.0, (np.radians(30.0), 14.0))
        for side, line in (("start", "E-1"), ("end", "E-2"))
    ]
    plate = rectangle("M1-R4", length=150.0, width=800.0)
    plate = replace(plate, bevels=tuple(ends), edges=square_edges(150.0))
    space = ezdxf.read(io.StringIO(plate_dxf(plate).decode())).modelspace()
    boxes = [box_of(text) for text in space.query('TEXT[layer=="MARK_BEVEL"]')]
    assert len(boxes) == 2
    for own in boxes:
        assert (own >= 0.0).all() and (own <= [150.0, 800.0]).all()
