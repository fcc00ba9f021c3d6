# SPDX-License-Identifier: LGPL-2.1-or-later
"""Python's garbage collector kept from what stays."""

import gc

import pytest

from BendTorsionWB.core.collection import collection_of_new


class Ring:
    """An object that only the collector can free."""

    freed = 0

    def __init__(self):
        self.own = self

    def __del__(self):
        Ring.freed += 1


def test_what_there_was_is_left_alone_inside_and_collected_after():
    gc.collect()
    before = Ring.freed
    Ring()
    with pytest.raises(ValueError), collection_of_new():
        Ring()
        gc.collect()
        assert Ring.freed == before + 1, "only what is new"
        raise ValueError
    gc.collect()
    assert Ring.freed == before + 2 and gc.isenabled()
