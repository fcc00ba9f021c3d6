# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which labels of a crowd are shown in the 3D view, without a window."""

import numpy as np
import pytest

from BendTorsionWB.gui.label_layer import CORNERS, LEFT_OUT, facing, on_screen, thinned

SIZE = (1000.0, 800.0)


def orthographic(height, aspect=SIZE[0] / SIZE[1], near=1.0, far=1000.0):
    """Rows of the matrix of a camera that looks down −z and sees `height` mm."""
    matrix = np.diag([2.0 / (height * aspect), 2.0 / height, -2.0 / (far - near), 1.0])
    matrix[3, 2] = -(far + near) / (far - near)
    return matrix


def perspective(near=1.0, far=1e5):
    """The same with an angle of 90° upwards."""
    matrix = np.zeros((4, 4))
    matrix[0, 0], matrix[1, 1] = SIZE[1] / SIZE[0], 1.0
    matrix[2, 2], matrix[2, 3] = -(far + near) / (far - near), -1.0
    matrix[3, 2] = -2.0 * far * near / (far - near)
    return matrix


def test_the_middle_and_a_millimetre_of_an_orthographic_view():
    places = np.array([[0.0, 0.0, -10.0], [50.0, 40.0, -500.0]])
    pixels, scale = on_screen(places, orthographic(height=100.0), SIZE)
    assert pixels[0] == pytest.approx((500.0, 400.0))
    assert pixels[1] == pytest.approx((500.0 + 8.0 * 50.0, 400.0 + 8.0 * 40.0))
    assert scale == pytest.approx([8.0, 8.0])


def test_what_is_farther_is_smaller_in_perspective_and_nothing_is_behind_the_eye():
    places = np.array([[0.0, 10.0, -100.0], [0.0, 10.0, -200.0], [0.0, 10.0, 100.0]])
    pixels, scale = on_screen(places, perspective(), SIZE)
    # At 100 mm the 800 pixels are 200 mm high.
    assert scale == pytest.approx([4.0, 2.0, 0.0])
    assert pixels[0, 1] == pytest.approx(440.0) and pixels[1, 1] == pytest.approx(420.0)


@pytest.mark.parametrize("matrix", [orthographic(100.0), perspective()])
def test_faces_turned_away_are_not_named(matrix):
    places = np.full((3, 3), -50.0)
    normals = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.0, 0.0, 0.0]])
    assert facing(places, normals, matrix).tolist() == [True, False, True]


ONE = np.ones(2000, int)
"""Labels that stand at the first corner or nowhere."""


def test_of_two_in_one_place_the_first_is_shown_and_of_none_outside():
    pixels = np.array([[100.0, 100.0], [110.0, 105.0], [300.0, 100.0], [2000.0, 100.0]])
    boxes = np.full((4, 2), (40.0, 16.0))
    shown = thinned(pixels, np.ones(4), boxes, np.full(4, 100.0), ONE, SIZE, {})
    assert shown.tolist() == [0, LEFT_OUT, 0, LEFT_OUT]


def test_labels_of_one_place_stand_around_it_before_any_is_left_out():
    """Right above it, left above, right below, left below; there is no room for a fifth."""
    pixels, boxes = np.full((5, 2), 100.0), np.full((5, 2), (40.0, 16.0))
    given = pixels, np.ones(5), boxes, np.full(5, 100.0)
    assert thinned(*given, np.full(5, 4), SIZE, {}).tolist() == [0, 1, 2, 3, LEFT_OUT]
    assert thinned(*given, ONE, SIZE, {}).tolist() == [0] + [LEFT_OUT] * 4


def test_what_is_too_small_to_be_told_apart_is_not_named():
    boxes = np.full((2, 2), (40.0, 16.0))
    pixels = np.array([[100.0, 100.0], [300.0, 300.0]])
    scale, room = np.array([0.1, 0.1]), np.array([159.0, 161.0])
    shown = thinned(pixels, scale, boxes, room, np.full(2, 4), SIZE, {})
    assert shown.tolist() == [LEFT_OUT, 0]


def test_layers_share_the_room():
    taken = {}
    one = [np.array([[100.0, 100.0]]), np.ones(1), np.array([[40.0, 16.0]]), np.array([99.0]), ONE]
    assert thinned(*one, SIZE, taken).tolist() == [0]
    assert thinned(*one, SIZE, taken).tolist() == [LEFT_OUT]


def test_no_two_of_a_random_crowd_lie_on_each_other():
    numbers = np.random.default_rng(7)
    pixels = numbers.uniform((0.0, 0.0), SIZE, (2000, 2))
    boxes = numbers.uniform(10.0, 60.0, (2000, 2))
    corners = numbers.integers(1, 5, 2000)
    at = thinned(pixels, np.ones(2000), boxes, np.full(2000, 1e3), corners, SIZE, {})
    assert (at < corners).all() and set(at.tolist()) == {LEFT_OUT, 0, 1, 2, 3}
    shown = at != LEFT_OUT
    low = (pixels - CORNERS[at] * boxes)[shown]
    high = low + boxes[shown]
    apart = (high[:, None] <= low[None]) | (low[:, None] >= high[None])
    clear = apart.any(axis=2) | np.eye(len(low), dtype=bool)
    assert clear.all() and shown.sum() > 100
