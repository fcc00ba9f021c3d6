# SPDX-License-Identifier: LGPL-2.1-or-later
"""Standard output and error that cannot be written: a closed pipe ends a command quietly, as usual
tools end; a full disk is told in one line."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress

CLOSED = 141
"""The exit code of a program whose reader closed the pipe: 128 and SIGPIPE."""
UNWRITTEN = 1


class OutputLost(BaseException):
    """A standard stream takes no more. As an interrupt, no fence against faults catches it: what
    the command does is over, and is no fault of a file or an object it was at."""

    def __init__(self, stream, problem: OSError):
        super().__init__(str(problem))
        self.stream, self.problem = stream, problem

    def told(self) -> int:
        """Tell what is to be told, on standard error; the exit code."""
        _discard(self.stream)
        if isinstance(self.problem, BrokenPipeError):
            return CLOSED
        if self.stream is not sys.stderr:
            why = self.problem.strerror or str(self.problem)
            with suppress(OSError):
                print(
                    f"error: standard output cannot be written: {why} -> make room there, or send "
                    "it elsewhere",
                    file=sys.stderr,
                )
                sys.stderr.flush()
        return UNWRITTEN


class _Watched:
    """A stream whose faults are told apart from those of files."""

    def __init__(self, stream):
        self._stream = stream

    def write(self, text: str) -> int:
        try:
            return self._stream.write(text)
        except OSError as problem:
            raise OutputLost(self._stream, problem) from problem

    def flush(self) -> None:
        try:
            self._stream.flush()
        except OSError as problem:
            raise OutputLost(self._stream, problem) from problem

    def __getattr__(self, name: str):
        return getattr(self._stream, name)


@contextmanager
def watched() -> Iterator[None]:
    """Raises OutputLost where standard output or error cannot be written, at the end of the block
    at the latest. What is told to one that was closed before is told nowhere."""
    former = sys.stdout, sys.stderr
    with ExitStack() as nowhere:
        # A program without a console has neither. What is opened takes the number of the closed
        # stream, so that no file that is written gets what libraries print there.
        sys.stdout, sys.stderr = (
            _Watched(stream or nowhere.enter_context(open(os.devnull, "w", encoding="utf-8")))
            for stream in former
        )
        try:
            try:
                yield
            finally:
                for stream in (sys.stdout, sys.stderr):
                    stream.flush()
        finally:
            sys.stdout, sys.stderr = former


def _discard(stream) -> None:
    """What the stream still holds would be a fault again when Python ends."""
    with suppress(OSError, ValueError, AttributeError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)
