# SPDX-License-Identifier: LGPL-2.1-or-later
"""Python's garbage collector held off where many small objects are made and kept, and from those
that stay."""

from __future__ import annotations

import gc
from contextlib import contextmanager


@contextmanager
def without_collection():
    """The collector would walk ten thousand small objects again and again while they are made."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


def leave_to_the_end() -> None:
    """The process ends next: what is left goes with it, without the collector's walk through all of
    it (two seconds after two hundred members)."""
    gc.freeze()


@contextmanager
def collection_of_new():
    """The collector walks what is made from here on alone: the results of hundreds of members stay,
    and it would walk them each time a quarter as much was made besides."""
    gc.freeze()
    try:
        yield
    finally:
        gc.unfreeze()
