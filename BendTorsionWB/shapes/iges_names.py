# SPDX-License-Identifier: LGPL-2.1-or-later
"""Names of the curves and surfaces of an IGES file, in the order in which it holds them: entity
labels, name properties, levels and colours (IGES 5.3, 2.2.4.4, 4.68, 4.98 and 4.102)."""

from __future__ import annotations

import re
from dataclasses import dataclass

_CURVES = {100, 102, 104, 106, 110, 112, 126, 130}
_SURFACES = {108, 114, 118, 120, 122, 128, 140, 143, 144, 186, 190, 192, 194, 196, 198, 514}
_GROUPS = {1, 7, 14, 15}
"""Forms of the associativity 402 that are groups."""
_COLOURS = ("", "black", "red", "green", "blue", "yellow", "magenta", "cyan", "white")
"""By the numbers that stand for themselves; 0 is none."""
_INTEGERS = re.compile(r"[+-]?\d+")


@dataclass(frozen=True)
class IgesEntity:
    """A curve or surface that is part of no other. kind: `curve` or `surface`; names: what it is
    called, its levels as `level3`, its colour as `colour-red` or `colour-ff8000`."""

    kind: str
    names: tuple[str, ...]


@dataclass(frozen=True)
class _Entry:
    type: int
    form: int
    level: int
    colour: int
    dependent: bool
    label: str
    first: int
    count: int


def named_entities(text: str) -> tuple[IgesEntity, ...]:
    """The curves and surfaces of a file that are part of no other; those of a group in its order.
    None at all when the directory cannot be read."""
    lines = [line.rstrip("\r").ljust(80) for line in text.split("\n")]
    directory = [line for line in lines if line[72] == "D"]
    parameters = [line[:64] for line in lines if line[72] == "P"]
    try:
        entries = {
            2 * k + 1: _entry(one, other)
            for k, (one, other) in enumerate(zip(directory[::2], directory[1::2]))
        }
    except ValueError:
        return ()
    tokens = {ref: _tokens(parameters, entry) for ref, entry in entries.items()}
    called = {
        ref: found[1][: int(found[0])]
        for ref, entry in entries.items()
        if (entry.type, entry.form) == (406, 15)
        and (found := re.fullmatch(r"(\d+)H(.*)", tokens[ref][-1].strip(), re.DOTALL))
        and (found := found.groups())
    }
    levels = {
        ref: [int(token) for token in tokens[ref][2:] if _INTEGERS.fullmatch(token.strip())]
        for ref, entry in entries.items()
        if (entry.type, entry.form) == (406, 1)
    }
    colours = {ref: _colour(tokens[ref]) for ref, entry in entries.items() if entry.type == 314}
    members = {
        ref: _group(tokens[ref])
        for ref, entry in entries.items()
        if entry.type == 402 and entry.form in _GROUPS
    }
    grouped = {one for group in members.values() for one in group}
    found: list[IgesEntity] = []

    def walk(ref: int, above: frozenset) -> None:
        entry = entries.get(ref)
        if entry is None or ref in above:
            return
        if ref in members:
            for one in members[ref]:
                walk(one, above | {ref})
        elif entry.type in _CURVES | _SURFACES:
            names = [called[p] for p in _trailing(tokens[ref]) if p in called]
            names += [entry.label] if entry.label else []
            # Negative where a list of levels, or a colour of its own, stands elsewhere.
            on = levels.get(-entry.level, ()) if entry.level < 0 else (entry.level,)
            names += [f"level{level}" for level in on if level > 0]
            if entry.colour < 0:
                colour = colours.get(-entry.colour, "")
            else:
                colour = _COLOURS[entry.colour] if entry.colour < len(_COLOURS) else ""
            names += [f"colour-{colour}"] if colour else []
            kind = "curve" if entry.type in _CURVES else "surface"
            found.append(IgesEntity(kind, tuple(dict.fromkeys(names))))

    for ref, entry in entries.items():
        if ref not in grouped and not entry.dependent:
            walk(ref, frozenset())
    return tuple(found)


def _entry(one: str, other: str) -> _Entry:
    def number(line: str, field: int) -> int:
        return int(line[8 * field - 8 : 8 * field].strip() or 0)

    status = one[64:72].replace(" ", "0")
    label = other[56:64].strip()
    subscript = other[64:72].strip()
    if label and subscript not in ("", "0"):
        label += subscript
    return _Entry(
        number(one, 1),
        number(other, 5),
        number(one, 5),
        number(other, 3),
        # Physically dependent: part of another entity. 02 is a member of a group alone.
        status[2:4] in ("01", "03") or status[4:6] == "05",
        label,
        number(one, 2),
        number(other, 4),
    )


def _tokens(parameters: list[str], entry: _Entry) -> list[str]:
    """The parameters of an entity as text, its type first."""
    text = "".join(parameters[entry.first - 1 : entry.first - 1 + entry.count])
    # Text in which commas may stand is only in names, which are last.
    head, hollerith, rest = text.partition("H")
    if hollerith:
        *before, count = head.split(",")
        length = int(count) if count.strip().isdigit() else 0
        return [*before, f"{count.strip()}H{rest[:length]}"]
    return text.split(";")[0].split(",")


def _colour(tokens: list[str]) -> str:
    """Red, green and blue, per cent each, as six digits; nothing where they cannot be read."""
    try:
        shares = [float(token.upper().replace("D", "E") or 0) for token in tokens[1:4]]
    except ValueError:
        return ""
    if len(shares) < 3 or not all(0.0 <= share <= 100.0 for share in shares):
        return ""
    return "".join(f"{round(2.55 * share):02x}" for share in shares)


def _group(tokens: list[str]) -> tuple[int, ...]:
    wanted = [token.strip() for token in tokens[2:]]
    count = int(tokens[1]) if len(tokens) > 1 and tokens[1].strip().isdigit() else 0
    return tuple(int(token) for token in wanted[:count] if _INTEGERS.fullmatch(token))


def _trailing(tokens: list[str]) -> list[int]:
    """The integers at the end of an entity's parameters: pointers to its properties are there."""
    found: list[int] = []
    for token in reversed(tokens):
        if not _INTEGERS.fullmatch(token.strip()):
            break
        found.append(int(token))
    return found
