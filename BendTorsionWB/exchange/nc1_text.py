# SPDX-License-Identifier: LGPL-2.1-or-later
"""Texts of NC1 files, which are ASCII: what stands for a text that is not, and the note of it."""

from __future__ import annotations

import hashlib
import re
import unicodedata
from collections.abc import Iterable, Iterator

from ..core.finding import Finding, note
from ..core.lofting import MemberRecord

LONGEST_TEXT = 80
_FOREIGN = re.compile(r"[^\x20-\x7e]+")
_SPELLED = str.maketrans(
    {"ß": "ss", "Ø": "O", "ø": "o", "Æ": "AE", "æ": "ae", "Ł": "L", "ł": "l", "Đ": "D", "đ": "d"}
    | {"×": "x", "–": "-", "—": "-", "°": " deg"}
)


def ascii_text(text: str) -> str:
    """A text in ASCII, as long as a line takes: letters without their accents; every run of
    characters that have no such letter as `U` and six digits of its hash, the same in every text,
    so that names that differ stay apart."""
    plain = unicodedata.normalize("NFKD", text.translate(_SPELLED))
    plain = "".join(c for c in plain if not unicodedata.combining(c))
    return _FOREIGN.sub(_code, plain)[:LONGEST_TEXT]


def _code(run: re.Match) -> str:
    digits = hashlib.sha256(run[0].encode("utf-8", "replace")).hexdigest()[:6].upper()
    end = run.string[run.end() : run.end() + 1]
    return f"U{digits}" + ("_" if end.isalnum() else "")


def text_findings(records: Iterable[MemberRecord], project: str) -> tuple[Finding, ...]:
    """A note for each text of the NC1 files of these members that is not what it is called
    elsewhere: order, member, grade, texts of sheet Marks."""
    found = dict(_replaced("order", project, project))
    for record in records:
        for what, text in _texts(record):
            for key, finding in _replaced(what, text, record.member):
                found.setdefault(key, finding)
    return tuple(found.values())


def _texts(record: MemberRecord) -> Iterator[tuple[str, str]]:
    yield "member", record.member
    for plate in record.plates:
        yield "plate", plate.mark.removeprefix(record.member)
        yield "grade", plate.material
        for mark in plate.marks:
            if mark.text and not mark.text.startswith(record.member):
                yield "text", mark.text


def _replaced(what: str, text: str, owner: str) -> Iterator[tuple[str, Finding]]:
    written = ascii_text(text)
    if written != text:
        yield (
            text,
            note(
                "nc1-text",
                owner,
                f"NC1 files are ASCII: the {what} {text!r} is written {written!r} in them",
                "give it a name in ASCII where the machine is to show it",
                position=what,
                value=written,
            ),
        )
