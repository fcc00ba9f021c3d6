# SPDX-License-Identifier: LGPL-2.1-or-later
"""A Ctrl-C, or a SIGTERM, remembered and raised where it is safe: never inside a call into FreeCAD,
and always before anything that may be half computed is put in its place.

FreeCAD calls Python while it opens, changes and computes documents. An interrupt raised there is
taken for the fault of an object, or swallowed, and the program would go on without that object.
"""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass


@dataclass
class _State:
    """asked: whether an interrupt came; held: calls under way that it waits for; process: whose
    they are."""

    asked: bool = False
    held: int = 0
    process: int = 0


_state = _State()
_DEFAULTS = {signal.SIGINT: signal.default_int_handler, signal.SIGTERM: signal.SIG_DFL}
"""What stops the program, and what Python does then unless told otherwise."""


def _ask(number: int, _) -> None:
    if os.getpid() != _state.process:
        # A fork that is just starting leaves interrupts to its parent, which may end it.
        if number == signal.SIGTERM:
            os._exit(1)
        return
    # Remembered also where it is raised at once: what it is raised in may swallow it. A second one
    # would end what the first one has tidied up.
    first, _state.asked = not _state.asked, True
    if first and not _state.held:
        raise KeyboardInterrupt


def asked() -> bool:
    """Whether the program was told to stop: nothing more need be computed."""
    return _state.asked


def stop_if_asked() -> None:
    """A safe point: raises KeyboardInterrupt when one came before, held back or swallowed."""
    if _state.asked and _in_main_thread():
        raise KeyboardInterrupt


@contextmanager
def heard() -> Iterator[None]:
    """Remember an interrupt, or a request to end (SIGTERM), during a command; where the program is
    to ignore one of them, as Ctrl-C in the background of a script, it does."""
    ours = {}
    if _in_main_thread():
        ours = {
            one: default for one, default in _DEFAULTS.items() if signal.getsignal(one) == default
        }
    if ours:
        _state.asked, _state.process = False, os.getpid()
        for one in ours:
            signal.signal(one, _ask)
    try:
        yield
    finally:
        for one, default in ours.items():
            signal.signal(one, default)
        if ours:
            _state.asked = False


def hear_no_more() -> None:
    """The program ends next."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if signal.getsignal(signal.SIGTERM) == _ask:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)


def _in_main_thread() -> bool:
    return threading.current_thread() is threading.main_thread()


@contextmanager
def to_the_end() -> Iterator[None]:
    """Hold a Ctrl-C back to the end of the block, or to the next safe point in it."""
    if not _in_main_thread():
        yield
        return
    former = signal.getsignal(signal.SIGINT)
    # Of a script without a command, whose own handler is back afterwards.
    alone = former is not _ask and callable(former)
    if alone:
        _state.asked, _state.process = False, os.getpid()
        signal.signal(signal.SIGINT, _ask)
    _state.held += 1
    try:
        yield
    finally:
        _state.held -= 1
        came = _state.asked
        if alone:
            _state.asked = False
            signal.signal(signal.SIGINT, former)
    if came:
        raise KeyboardInterrupt
