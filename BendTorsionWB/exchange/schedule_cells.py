# SPDX-License-Identifier: LGPL-2.1-or-later
"""The reading of one cell of a schedule: numbers, names, choices, cuts, joints, files."""

from __future__ import annotations

import difflib
import math
import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass

from ..core.finding import BendTorsionError, unseen
from ..core.members.thickness import STAGGER_WORDS, stagger_offsets
from ..core.patterns.layer_names import named_layers
from .file_name import is_device

# Beyond any site grid in mm; larger figures are slips that would only overflow later.
LARGEST_NUMBER = 1e10
# A cut closer to the start than this is a ratio written without its per cent sign.
SHORTEST_CUT = 1.0
LONGEST_NAME = 64

_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
_GROUPS = re.compile(r"[+-]?[1-9]\d{0,2}(,\d{3})+")
_NOT_IN_A_FILE_NAME = re.compile(r'[<>:"/\\|?*,;]')


class Percent(float):
    """A number from a cell formatted in per cent: 0.35 that the spreadsheet shows as 35%."""


class BadCell(ValueError):
    """A cell value that cannot be used: code, message, mend, limit and unit of its finding."""

    def __init__(self, code: str, message: str, mend: str, limit=None, unit: str = ""):
        super().__init__(message)
        self.code, self.message, self.mend = code, message, mend
        self.limit, self.unit = limit, unit


@dataclass(frozen=True)
class Cut:
    """Where a transition starts: mm of arc length from the trimmed start, or a ratio in 0..1."""

    value: float
    is_ratio: bool

    def at(self, length: float) -> float:
        """Arc length in mm on a member of this length in mm."""
        return self.value * length if self.is_ratio else self.value


@dataclass(frozen=True)
class Joints:
    """Rising joint positions inside a member: ratios of its length (< 1), or mm."""

    values: tuple[float, ...]
    kind: str

    def at(self, length: float) -> tuple[float, ...]:
        """Arc lengths in mm on a member of this length in mm."""
        factor = length if self.kind == "ratio" else 1.0
        return tuple(value * factor for value in self.values)


def did_you_mean(word: str, known: Iterable[str]) -> str | None:
    """The known word closest to this one, whatever its case, or None."""
    by_lower = {name.lower(): name for name in known}
    near = difflib.get_close_matches(str(word).strip().lower(), list(by_lower), n=1, cutoff=0.6)
    return by_lower[near[0]] if near else None


@dataclass(frozen=True)
class Number:
    """Reads a finite number: above/least and below/most bound it, scale brings it to its unit."""

    unit: str = "mm"
    above: float | None = None
    least: float | None = None
    below: float | None = None
    most: float | None = None
    scale: float = 1.0
    whole: bool = False

    def __call__(self, value):
        number = _finite(value)
        for broken, sign, bound in (
            (self.above is not None and number <= self.above, "above", self.above),
            (self.least is not None and number < self.least, "at least", self.least),
            (self.below is not None and number >= self.below, "below", self.below),
            (self.most is not None and number > self.most, "at most", self.most),
            (abs(number) > LARGEST_NUMBER, "within +/-", LARGEST_NUMBER),
        ):
            if broken:
                limit = f"{sign} {bound:g}"
                mend = f"write a number {limit} {self.unit}".rstrip()
                message = "the number is out of range"
                raise BadCell("out-of-range", message, mend, limit, self.unit)
        if self.whole:
            if number != round(number):
                raise BadCell("not-whole", "not a whole number", "write a whole number: 1, 2, 3")
            return int(number)
        return number * self.scale


def _with_decimal_point(text: str) -> str:
    """A number with commas in it, its decimal mark a point; refused where a comma may as well be
    between thousands."""
    if _GROUPS.fullmatch(text):
        message = "the comma may be a decimal mark or part thousands"
        raise BadCell("not-a-number", message, two_ways(text))
    if "." not in text:
        return text.replace(",", ".", 1)
    marks = (",", ".") if text.rindex(",") < text.rindex(".") else (".", ",")
    if not re.fullmatch(rf"[+-]?\d{{1,3}}([{marks[0]}]\d{{3}})+[{marks[1]}]\d*", text):
        return text
    return text.replace(marks[0], "").replace(marks[1], ".")


def two_ways(numeral: str) -> str:
    """The mend of a number whose marks can mean two things: how to write it in every country."""
    whole, decimal = re.sub("[.,]", "", numeral), re.sub("[.,]", ",", numeral)
    if decimal.count(",") > 1:
        return f"write {whole}, or a number cell instead of text"
    return f"write {decimal}0 or {whole}, or a number cell instead of text"


def _finite(value) -> float:
    if isinstance(value, str):
        text = unicodedata.normalize("NFKC", value).strip()
        if text.lower().lstrip("+-") in ("nan", "inf", "infinity"):
            raise BadCell("not-finite", "not a finite number", "write a number")
        if "," in text:
            text = _with_decimal_point(text)
        if not _NUMBER.fullmatch(text):
            raise BadCell("not-a-number", "text where a number belongs", "write a number")
        number = float(text)
    elif isinstance(value, bool) or not isinstance(value, (int, float)):
        kind = "yes/no" if isinstance(value, bool) else "a date"
        mend = "write a number and format the cell as a number"
        raise BadCell("not-a-number", f"{kind} where a number belongs", mend)
    else:
        number = float(value) if abs(value) < 1e300 or value != value else math.inf
    if not math.isfinite(number):
        raise BadCell("not-finite", "not a finite number", "write a number")
    return number


def text(value) -> str:
    """Text of one line as written; a whole number loses its '.0'."""
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    return " ".join(str(value).split())


@dataclass(frozen=True)
class Name:
    """Reads a name, all of whose characters are seen; one that also names files has no sign a file
    system would refuse."""

    names_files: bool = False

    def __call__(self, value) -> str:
        name = text(value)
        if len(name) > LONGEST_NAME:
            mend = f"shorten it to {LONGEST_NAME} characters"
            raise BadCell("name-too-long", "the name is too long", mend, LONGEST_NAME)
        hidden = unseen(name)
        if hidden:
            codes = ", ".join(f"U+{ord(char):04X}" for char in dict.fromkeys(hidden))
            message = f"the name holds characters that are not seen: {codes}"
            raise BadCell("bad-name", message, "type the name anew")
        unfit = _NOT_IN_A_FILE_NAME.search(name) or name.startswith(".") or name.endswith(".")
        unfit = unfit or is_device(name)
        if self.names_files and unfit:
            mend = "use letters, digits, blanks, '-', '_' and inner points only"
            raise BadCell("bad-name", "this name cannot name a file", mend)
        return name


@dataclass(frozen=True)
class Choice:
    """Reads one of the known words; words of later stages are refused as not supported yet.

    open_ended: every other word may be one of a later stage.
    """

    known: tuple[str, ...]
    later: tuple[str, ...] = ()
    open_ended: bool = False

    def __call__(self, value) -> str:
        word = text(value)
        if word in self.known:
            return word
        words = ", ".join(self.known)
        near = did_you_mean(word, self.known)
        if word in self.later or self.open_ended:
            message = f"{word} is not supported yet"
            raise BadCell("not-supported-yet", message, f"use {words}", words)
        mend = f"did you mean {near}? known: {words}" if near else f"use one of {words}"
        raise BadCell("unknown-value", "unknown value", mend, words)


def yes_no(value) -> bool:
    """yes, true or 1; no, false or 0."""
    word = str(text(value)).lower()
    if word in ("yes", "true", "1"):
        return True
    if word in ("no", "false", "0"):
        return False
    raise BadCell("unknown-value", "neither yes nor no", "write yes or no", "yes, no")


@dataclass(frozen=True)
class FilePart:
    """A file, relative to the schedule, and the name of one part of it (empty: all of it)."""

    file: str
    part: str


@dataclass(frozen=True)
class FileCell:
    """Reads `file` or `file#name`, with one of the endings."""

    endings: tuple[str, ...]

    def __call__(self, value) -> FilePart:
        file, _, part = text(value).partition("#")
        file, part = file.strip().replace("\\", "/"), part.strip()
        known = ", ".join(self.endings)
        if not file.lower().endswith(self.endings):
            mend = f"write a file, or file#name, ending in {known}"
            raise BadCell("file-kind", "this kind of file is not read", mend, known)
        return FilePart(file, part)


def along(value) -> Cut:
    """A place of an axis, ends included: mm from its trimmed start, or 0% to 100%."""
    is_ratio = isinstance(value, Percent)
    if isinstance(value, str) and value.strip().endswith("%"):
        is_ratio, value = True, _finite(value.strip()[:-1]) / 100.0
    number = Number()(value)
    if number < 0.0 or (is_ratio and number > 1.0):
        mend, limit = "write mm from the start of the axis, or 0% to 100%", "0% to 100%"
        raise BadCell("out-of-range", "the place is not on the axis", mend, limit)
    return Cut(number, is_ratio)


def cut(value) -> Cut:
    """mm from the trimmed start, or a ratio as 35% (typed, or a cell formatted in per cent)."""
    is_ratio = isinstance(value, Percent)
    if isinstance(value, str) and value.strip().endswith("%"):
        is_ratio, value = True, _finite(value.strip()[:-1]) / 100.0
    number = _finite(value)
    if is_ratio and not 0.0 < number < 1.0:
        mend, limit = "write a ratio inside the member, such as 35%", "above 0%, below 100%"
        raise BadCell("out-of-range", "the cut is not inside the member", mend, limit)
    if not is_ratio and number < SHORTEST_CUT:
        mend = f"write mm from the member's start, or {number * 100:g}% for a ratio"
        if number <= 0.0:
            mend = "write mm from the member's start, or a ratio such as 35%"
        limit = f"at least {SHORTEST_CUT:g}"
        raise BadCell("out-of-range", "the cut is too short", mend, limit, "mm")
    return Cut(Number()(number), is_ratio)


def stagger(value) -> str:
    """`auto`, `none`, or offsets of faces in mm as top=0 left=200."""
    text = " ".join(re.sub(r"\s*=\s*", "=", str(value)).split())
    text = text.lower() if text.lower() in STAGGER_WORDS else text
    try:
        stagger_offsets(text)
    except ValueError as problem:
        mend = "write auto, none, or offsets in mm such as top=0 left=200"
        raise BadCell("bad-stagger", f"stagger: {problem}", mend) from None
    return text


def joints(value) -> Joints:
    """Rising positions parted by blanks: all <= 1 are ratios, otherwise all are mm; or `auto`."""
    return _places(value, "joints")


def lanes(value) -> Joints:
    """Seams across a face, as joints along it."""
    return _places(value, "lanes")


def _places(value, what: str) -> Joints:
    words = str(value).split()
    if [word.lower() for word in words] == ["auto"]:
        return Joints((), "auto")
    mend = "write rising ratios such as 0.2 0.4 1, or rising mm, parted by blanks, or auto"
    try:
        numbers = [Number(above=0.0)(word) for word in words]
    except BadCell as bad:
        raise BadCell(bad.code, f"{what}: {bad.message}", mend, bad.limit) from None
    if any(after <= before for before, after in zip(numbers, numbers[1:])):
        limit = "each above the one before"
        raise BadCell(f"{what}-not-rising", f"{what} do not rise", mend, limit)
    if numbers[0] > 1.0:
        return Joints(tuple(numbers), "mm")
    if numbers[-1] > 1.0:
        mend = "write ratios up to 1 only, or mm only"
        raise BadCell(f"{what}-mixed", "ratios up to 1 and mm are mixed", mend, "at most 1")
    # The ratio 1 is the member's end, where no joint is.
    return Joints(tuple(number for number in numbers if number < 1.0), "ratio")


def parameters(value) -> dict[str, float]:
    """`a=40000 b=30000 c=20000` as a dict of numbers as written; which keys is checked by kind."""
    mend = "write key=number parted by blanks, such as a=40000 b=30000 c=20000"
    found: dict[str, float] = {}
    for item in re.sub(r"\s*=\s*", "=", str(value).strip()).split():
        key, equals, figure = item.partition("=")
        if not equals or not key:
            raise BadCell("bad-parameters", f"cannot read the parameter '{item}'", mend)
        if key in found:
            raise BadCell("duplicate", f"parameter {key} is given twice", mend)
        try:
            found[key] = Number()(figure)
        except BadCell as bad:
            raise BadCell(bad.code, f"parameter {key}: {bad.message}", mend, bad.limit) from None
    return found


def layer_lines(value) -> str:
    """Names for layers of cut files as one text, `CUT_OUTER=10 MARK_TEXT=T`, parted by blanks."""
    try:
        names = named_layers(str(value))
    except BendTorsionError as problem:
        bad = problem.findings[0]
        raise BadCell(bad.code, bad.message, bad.mend) from None
    return " ".join(f"{layer}={name}" for layer, name in names.items())


def corners(value) -> tuple[tuple[float, float], ...]:
    """Corners y z of a polygon in turn, parted by semicolons: `0 0; 500 0; 600 400`."""
    mend = "write y z of each corner, parted by semicolons, such as 0 0; 500 0; 600 400"
    try:
        found = [tuple(map(Number(), pair.split())) for pair in str(value).split(";")]
    except BadCell as bad:
        raise BadCell(bad.code, f"corners: {bad.message}", mend, bad.limit) from None
    if any(len(pair) != 2 for pair in found):
        raise BadCell("bad-corners", "a corner is not two numbers", mend)
    return tuple(found)


def thicknesses(value) -> tuple[float, ...]:
    """Thicknesses of sides, mm, parted by blanks: `16 16 20`."""
    mend = "write a thickness in mm per side, parted by blanks, such as 16 16 20"
    try:
        return tuple(map(Number(above=0.0), str(value).split()))
    except BadCell as bad:
        raise BadCell(bad.code, f"thicknesses: {bad.message}", mend, bad.limit) from None
