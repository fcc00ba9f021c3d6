# SPDX-License-Identifier: LGPL-2.1-or-later
"""Who is told how far work is that lasts within one object, as the pages of a SheetSet are made."""

from __future__ import annotations

from collections.abc import Callable
from contextvars import ContextVar


def _nobody(what: str, done: int, count: int) -> None:
    """Nobody is told."""


PROGRESS: ContextVar[Callable[[str, int, int], None]] = ContextVar("progress", default=_nobody)
"""What is told how far the work is; it may raise to stop it, and does so again when told next:
what an object raises while it computes is a finding of that object."""
