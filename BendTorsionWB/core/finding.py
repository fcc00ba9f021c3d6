# SPDX-License-Identifier: LGPL-2.1-or-later
"""The check record: what was found, where, how far from the limit, and the mend."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass

SEVERITIES = ("error", "warning", "note")

BETWEEN = ", "
"""Stands between the names of a finding about several objects."""


@dataclass(frozen=True)
class Finding:
    """One check result, the same on objects, sheets, workbook, report and console.

    severity: `error`, `warning` or `note`. code: short name, kebab-case. object: the member,
    plate, axis or file concerned; several, such as members that meet, with a comma and a space
    between. position: where (arc length, row and column). value and limit
    are in `unit` (empty when the finding is not a measurement). mend: what puts it right.
    """

    severity: str
    code: str
    object: str
    position: str = ""
    value: float | str | None = None
    limit: float | str | None = None
    unit: str = ""
    message: str = ""
    mend: str = ""

    def __post_init__(self):
        if self.severity not in SEVERITIES:
            raise ValueError(f"severity {self.severity!r} is not one of {SEVERITIES}")

    @property
    def objects(self) -> tuple[str, ...]:
        """The names of all objects concerned."""
        return tuple(self.object.split(BETWEEN))

    def line(self, length: Callable[[float], str] | None = None) -> str:
        """The finding as one line for a console or a status bar. length: writes a length, mm, in
        the unit of the sheets; mm stand beside it then."""
        place = ", ".join(part for part in (self.object, self.position) if part)
        text = ": ".join(part for part in (self.severity, place, self.message) if part)
        text += self.figures(length)
        if self.mend:
            text += f" -> {self.mend}"
        return _seen(" ".join(text.split()))

    def figures(self, length: Callable[[float], str] | None = None) -> str:
        """Value and limit as they stand behind the message; empty where there are none. length: as
        of `line`."""
        figures = [
            f"{name} {figure_text(value, self.unit, length)}"
            for name, value in (("value", self.value), ("limit", self.limit))
            if value not in (None, "")
        ]
        return f" ({', '.join(figures)})" if figures else ""

    def as_dict(self) -> dict:
        """The record as plain JSON data, fields in their declared order."""
        return asdict(self)


def unseen(text: str) -> str:
    """The characters of a text that are not seen themselves: control and format characters, of
    which some turn the order of all that follow."""
    if text.isprintable():
        return ""
    return "".join(char for char in text if unicodedata.category(char) in ("Cc", "Cf"))


def _seen(text: str) -> str:
    """A text with the codes of characters that are not seen."""
    return text.translate({ord(char): f"U+{ord(char):04X}" for char in unseen(text)})


def figure_text(value: float | str, unit: str, length: Callable[[float], str] | None = None) -> str:
    """A value or a limit with its unit; length: as of `Finding.line`."""
    text = f"{value:.6g}" if isinstance(value, float) else str(value)
    text = f"{text} {unit}".rstrip()
    if length is None or unit != "mm" or isinstance(value, str):
        return text
    return f"{length(float(value))} ({text})"


def error(code: str, object: str, message: str, mend: str = "", **fields) -> Finding:
    """A finding that stops output of its object."""
    return Finding("error", code, object, message=message, mend=mend, **fields)


def warning(code: str, object: str, message: str, mend: str = "", **fields) -> Finding:
    """A finding the user must weigh; output goes on."""
    return Finding("warning", code, object, message=message, mend=mend, **fields)


def note(code: str, object: str, message: str, mend: str = "", **fields) -> Finding:
    """A finding for information."""
    return Finding("note", code, object, message=message, mend=mend, **fields)


class BendTorsionError(Exception):
    """Input or geometry that cannot be built; carries the findings that say why.

    Raised by core, shapes and exchange; caught by the objects, the command line and the GUI.
    """

    def __init__(self, findings: Finding | Iterable[Finding]):
        self.findings = (findings,) if isinstance(findings, Finding) else tuple(findings)
        super().__init__("\n".join(finding.line() for finding in self.findings))

    def __reduce__(self):
        # Exceptions are made anew from their arguments when a worker process hands them over.
        return type(self), (self.findings,)


def has_error(findings: Iterable[Finding]) -> bool:
    """True when any finding is an error."""
    return any(finding.severity == "error" for finding in findings)
