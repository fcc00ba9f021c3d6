# SPDX-License-Identifier: LGPL-2.1-or-later
"""A Ctrl-C held back until a call into FreeCAD is over."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def to_the_end() -> Iterator[None]:
    """Hold a Ctrl-C back until FreeCAD's call is over: raised inside it, the interrupt would be
    taken for the fault of an object, and the build would go on without that."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    held = []
    former = signal.signal(signal.SIGINT, lambda *_: held.append(True))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, former)
    if held:
        raise KeyboardInterrupt
