# SPDX-License-Identifier: LGPL-2.1-or-later
"""Entities of an IFC file that are written before their numbers are known: parts of files, each
made and kept for itself, are numbered where they are joined.

Text of the STEP physical file (ISO 10303-21); every GlobalId follows from project and mark.
"""

from __future__ import annotations

import re
import uuid
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

_DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$"
_SPACE = uuid.uuid5(uuid.NAMESPACE_URL, "bendtorsion")
_HERE, _APART = "\x01", "\x02"
"""On both sides of a reference's place while entities are written, later instead of it; and between
stretches. No text of a file has these letters."""


@dataclass(frozen=True)
class Entities:
    """Entities in their order, as stretches: counts (n,) of those in each, 0 for a single one that
    a file has once only; text: all stretches; references: the entities it names in turn, by their
    place, those given from outside first."""

    counts: tuple[int, ...]
    text: str
    references: tuple[int, ...]


class Written:
    """Entities as they are written. outside: how many are given from outside, places 0, 1, …"""

    def __init__(self, project: str, outside: int = 0):
        self.project = project
        self._next = outside
        self._stretches: list[list[str]] = [[]]
        self._once: dict[str, str] = {}
        self._counts = [0]

    def done(self) -> Entities:
        """What was written."""
        text = _APART.join(map("".join, self._stretches))
        parts = text.split(_HERE)
        return Entities(tuple(self._counts), _HERE.join(parts[::2]), tuple(map(int, parts[1::2])))

    def add(self, entity: str) -> str:
        """An entity; the reference to it."""
        own = reference(self._next)
        self._next += 1
        self._stretch(1).append(f"{own}={entity};\n")
        return own

    def add_all(self, entities: Sequence[str]) -> list[str]:
        """Entities; the references to them."""
        last = self._next + len(entities)
        own = list(map(reference, range(self._next, last)))
        self._next = last
        self._stretch(len(own)).extend(map("%s=%s;\n".__mod__, zip(own, entities, strict=True)))
        return own

    def _stretch(self, more: int) -> list[str]:
        """The lines of the last stretch, which grows by some."""
        if not self._counts[-1] and self._stretches[-1]:
            self._stretches.append([])
            self._counts.append(0)
        self._counts[-1] += more
        return self._stretches[-1]

    def once(self, entity: str) -> str:
        """An entity that a file has once only; the reference to it."""
        if entity not in self._once:
            self._once[entity] = reference(self._next)
            self._next += 1
            if not self._stretches[-1]:
                self._stretches[-1].append(entity)
            else:
                self._stretches.append([entity])
                self._counts.append(0)
        return self._once[entity]

    def identity(self, *names: str) -> str:
        """The GlobalId of what bears these names."""
        return f"'{global_id(self.project, *names)}'"

    def points(self, xyz) -> list[str]:
        """Points (n, 3), rounded at once: single ones took most of the time of a file."""
        texts = reals(rounded(xyz, 9).ravel().tolist())
        triples = zip(texts[::3], texts[1::3], texts[2::3], strict=True)
        return self.add_all(list(map("IFCCARTESIANPOINT((%s,%s,%s))".__mod__, triples)))

    def point(self, xyz) -> str:
        """A point."""
        return self.points([xyz])[0]

    def direction(self, xyz) -> str:
        """A unit vector."""
        values = ",".join(reals(rounded(xyz, 12).tolist()))
        return self.once(f"IFCDIRECTION(({values}))")

    def placement(self, origin, axis=(0.0, 0.0, 1.0), x=(1.0, 0.0, 0.0)) -> str:
        """A frame by its z and x axes."""
        return self.add(
            f"IFCAXIS2PLACEMENT3D({self.point(origin)},{self.direction(axis)},{self.direction(x)})"
        )

    def aggregate(self, name: str, whole: str, parts: Sequence[str]) -> None:
        """That a whole is made of parts."""
        if parts:
            self.add(
                f"IFCRELAGGREGATES({self.identity('aggregates', name)},$,$,$,{whole},"
                f"{listed(parts)})"
            )


class Numbered:
    """The entities of one file, numbered as they come."""

    def __init__(self):
        self.count = 0
        self._once: dict[str, str] = {}

    def append(self, own: Entities, outside: Sequence[str] = ()) -> tuple[str, list[str]]:
        """The lines of these entities, and the references to all by their place; outside: to those
        given from outside."""
        names, lines, at = list(outside), [], 0
        for count, text in zip(own.counts, own.text.split(_APART), strict=True):
            names += [f"#{number}" for number in range(self.count + 1, self.count + count + 1)]
            self.count += count
            parts = text.split(_HERE)
            until = at + len(parts) - 1
            whole = [""] * (2 * len(parts) - 1)
            whole[::2] = parts
            whole[1::2] = map(names.__getitem__, own.references[at:until])
            at = until
            if count:
                lines += whole
                continue
            entity = "".join(whole)
            # Nothing was written after the last stretch began.
            if not entity:
                continue
            if entity not in self._once:
                self.count += 1
                self._once[entity] = f"#{self.count}"
                lines.append(f"#{self.count}={entity};\n")
            names.append(self._once[entity])
        return "".join(lines), names


def reference(place: int) -> str:
    """A reference while entities are written."""
    return f"{_HERE}{place}{_HERE}"


def place_of(written: str) -> int:
    """The place a reference leads to."""
    return int(written[1:-1])


def global_id(project: str, *names: str) -> str:
    """An IFC GlobalId (22 characters) that follows from the names alone (RFC 4122, version 5)."""
    number = uuid.uuid5(_SPACE, "\x1f".join((project, *names))).int
    digits = []
    for _ in range(22):
        number, digit = divmod(number, 64)
        digits.append(_DIGITS[digit])
    return "".join(reversed(digits))


_PLAIN = re.compile(r"[ -~]*")


def quoted(value: str) -> str:
    """A string in the file's encoding: characters beyond ASCII as \\X2\\ runs."""
    if _PLAIN.fullmatch(value):
        return "'" + value.replace("\\", "\\\\").replace("'", "''") + "'"
    out, run = [], []

    def close():
        if run:
            out.append("\\X2\\" + "".join(run) + "\\X0\\")
            run.clear()

    for letter in value:
        code = ord(letter)
        if 32 <= code < 127:
            close()
            out.append({"'": "''", "\\": "\\\\"}.get(letter, letter))
        else:
            run.append(letter.encode("utf-16-be").hex().upper())
    close()
    return "'" + "".join(out) + "'"


def real(value: float) -> str:
    """A number."""
    return reals([float(value)])[0]


def reals(values: Iterable[float]) -> list[str]:
    """Python floats as numbers of the file."""
    return [
        _with_exponent(text) if "e" in text else text[:-1] if text[-2:] == ".0" else text
        for text in map(repr, values)
    ]


def _with_exponent(text: str) -> str:
    head, power = text.split("e")
    return (head if "." in head else head + ".") + "E" + power


def rounded(values, decimals: int) -> np.ndarray:
    """Without last digits, which differ between kernels, and without negative zeros."""
    # As np.round, whose wrapping took longer than its work.
    tens = 10.0**decimals
    return np.rint(np.asarray(values, float) * tens) / tens + 0.0


def listed(items: Iterable) -> str:
    """A list of what is written."""
    return "(" + ",".join(map(str, items)) + ")"
