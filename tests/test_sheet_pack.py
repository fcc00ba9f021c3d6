# SPDX-License-Identifier: LGPL-2.1-or-later
"""Blocks filled in on a page stand clear of one another, within the width, as high as they go."""

import numpy as np
import pytest

from BendTorsionWB.core.drawings.sheet_pack import GAP, Block, filled, packed, shelf_height


def boxes(sizes, width):
    places, high = filled(sizes, width)
    return [(x, y, x + w, y + h) for (x, y), (w, h) in zip(places, sizes, strict=True)], high


@pytest.mark.parametrize("seed", range(20))
def test_filled_blocks_are_clear_of_one_another_and_within_the_width(seed):
    random = np.random.default_rng(seed)
    sizes = [tuple(pair) for pair in random.uniform(5.0, 120.0, (30, 2)).tolist()]
    found, high = boxes(sizes, 200.0)
    assert high == max(box[3] for box in found)
    for k, (left, top, right, bottom) in enumerate(found):
        assert left >= 0.0 and top >= 0.0 and right <= 200.0 + 1e-6
        for other in found[:k]:
            apart = max(left - other[2], other[0] - right, top - other[3], other[1] - bottom)
            assert apart >= GAP - 1e-9
        # It could stand no higher where it is.
        above = [o[3] for o in found[:k] if o[0] < right + GAP and o[2] + GAP > left]
        assert top == 0.0 or any(abs(top - GAP - low) < 1e-9 for low in above)


def test_low_blocks_fill_what_rows_leave_free():
    sizes = [(100.0, 60.0), (95.0, 20.0), (95.0, 20.0), (100.0, 30.0), (95.0, 45.0)]
    found, high = boxes(sizes, 200.0)
    assert found[2][:2] == (105.0, 25.0)
    assert high == 95.0 < shelf_height(sizes, 200.0)


def test_one_too_wide_still_has_a_place():
    assert filled([(300.0, 10.0), (20.0, 10.0)], 200.0) == ([(0.0, 0.0), (0.0, 15.0)], 25.0)


def test_a_group_begins_a_page_when_the_rest_of_one_cannot_hold_it():
    low, high = (Block("", (), (), (), (0.0, 0.0, 90.0, h)) for h in (60.0, 50.0))
    pages = packed([[low], [high, high]], (10.0, 10.0, 210.0, 110.0))
    assert [[block.box for block in page] for page in pages] == [
        [(10.0, 50.0, 100.0, 110.0)],
        [(10.0, 60.0, 100.0, 110.0), (105.0, 60.0, 195.0, 110.0)],
    ]
