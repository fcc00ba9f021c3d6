# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the command line shows while it works, and the findings it ends with."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable

from BendTorsionWB.core.finding import Finding
from BendTorsionWB.interrupts import stop_if_asked

SHOWN_WARNINGS = 8
TOLD_NOTES = ("file-read", "split-kept")
"""Codes of notes that are printed; others are in the reports alone."""
LEAST_TOLD = 2.0
"""Seconds of remaining time below which none is shown."""


class Progress:
    """One line on stderr that is written over on a terminal, with the time the stage still takes;
    one line per stage elsewhere; nothing when quiet."""

    def __init__(self, quiet: bool = False, clock=time.monotonic):
        self.quiet, self.clock = quiet, clock
        self.what, self.width, self.began, self.from_ = "", 0, 0.0, 0

    def __call__(self, what: str, done: int, count: int) -> None:
        """Show that `done` of `count` things are done in a stage, and stop here when asked to."""
        stop_if_asked()
        if self.quiet:
            return
        new = what != self.what
        if new:
            self.what, self.began, self.from_ = what, self.clock(), done
        if sys.stderr.isatty():
            text = f"{what} {done}/{count}{self.remaining(done, count)}"
            print(f"\r{text:<{self.width}}", end="", file=sys.stderr, flush=True)
            self.width = len(text)
        elif new:
            print(f"{what} …", file=sys.stderr, flush=True)

    def remaining(self, done: int, count: int) -> str:
        """`, 2:05 left` by the pace of the stage so far; empty when that cannot be told."""
        counted = done - self.from_
        if counted < 1 or done >= count:
            return ""
        seconds = (self.clock() - self.began) / counted * (count - done)
        if seconds < LEAST_TOLD:
            return ""
        minutes, rest = divmod(round(seconds), 60)
        return f", {minutes}:{rest:02d} left"

    def end(self) -> None:
        """Clear the line."""
        if self.width and sys.stderr.isatty():
            print(f"\r{'':<{self.width}}\r", end="", file=sys.stderr, flush=True)
        self.width, self.what = 0, ""


def print_findings(
    findings: Iterable[Finding],
    quiet: bool = False,
    length: Callable[[float], str] | None = None,
) -> None:
    """Errors, the unit and size of each file read and a split kept, then the first warnings, those
    about files, axes and surfaces before the others; length: as of `Finding.line`."""
    findings = list(findings)
    for finding in findings:
        if finding.severity == "error":
            print(finding.line(length), file=sys.stderr)
    if quiet:
        return
    for finding in findings:
        if finding.code in TOLD_NOTES:
            print(finding.line(length), file=sys.stderr)
    warnings = sorted(
        (f for f in findings if f.severity == "warning"),
        key=lambda f: not f.code.startswith(("file", "axis", "surface")),
    )
    for finding in warnings[:SHOWN_WARNINGS]:
        print(finding.line(length), file=sys.stderr)
    if len(warnings) > SHOWN_WARNINGS:
        more = len(warnings) - SHOWN_WARNINGS
        print(
            f"and {more} more warning{'' if more == 1 else 's'}: see results.xlsx, sheet Checks",
            file=sys.stderr,
        )
