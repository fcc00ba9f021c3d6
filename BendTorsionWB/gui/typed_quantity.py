# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a text typed for a quantity means: numbers, units, fractions, sums; nothing that can mean
two things.

FreeCAD's own reader refuses `300 mm + 50 mm`, adds up `50 cm 600 mm` and reads 5 for `--5`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection
from typing import NamedTuple

import FreeCAD

translate = FreeCAD.Qt.translate
SIGNS = {"deg": "°"}
"""Units that are shown by a sign."""
LONGEST = 200
"""Characters of a text that is read at all."""
_ALIKE = str.maketrans(
    {
        **{chr(0xFEE0 + code): chr(code) for code in range(0x21, 0x7F)},
        **dict.fromkeys("\u00a0\u2007\u2009\u202f\u3000", " "),
        **{"\u2212": "-", "\u2013": "-", "\u00d7": "*", "\u00b7": "*", "\u00f7": "/"},
        **{"\u00b2": "^2", "\u00b3": "^3", "\u03bc": "\u00b5", "\u2019": "'", "\u201d": '"'},
    }
)
"""Signs of other keyboards, and those that look alike."""
_TOKEN = re.compile(
    r"""\s*(?:(?P<number>(?:\d[\d.,]*|[.,]\d[\d.,]*)(?:[eE][+-]?\d+)?)
    |(?P<unit>['"°′″]|[A-Za-z\u00b5]+(?:\^\d)?)
    |(?P<sign>[-+*/()]))""",
    re.VERBOSE,
)
_GROUP = re.compile(r"[1-9]\d{0,2}[.,]\d{3}")
_GROUPS = re.compile(r"\d{1,3}([.,])\d{3}(?:\1\d{3})*(?:(?!\1)[.,]\d*)?")
_FEET_AND_INCHES = re.compile(
    r"""\s*(?P<sign>[+-])?\s*(?:(?P<feet>\d+)\s*(?:'|ft)(?:-(?=\d)|\s*))?
    (?:(?P<inches>\d+)(?:\s+|\+))?(?:(?P<top>\d+)/(?P<bottom>[1-9]\d*)|(?P<more>\d+))
    \s*(?:"|in)\s*""",
    re.VERBOSE,
)
"""As drawings and FreeCAD write them: 12'-3 1/2", 12' 3+1/2"."""
_NAME = re.compile(
    r"""<<.*?>>(?:\s*[.\#]\s*\w+)*|\d[\d.]*(?:[eE][+-]?\d+)?
    |(?P<name>\.?[^\W\d]\w*(?:\s*[.\#]\s*(?:<<.*?>>|[^\W\d]\w*))*)(?P<call>\s*\()?""",
    re.VERBOSE,
)
"""In an expression: what has a label, numbers, names with all that is parted by points."""
_CONSTANTS = ("pi", "e", "True", "False")
_SMALLER = {
    **dict.fromkeys(("'", "ft"), ('"', "in")),
    **dict.fromkeys(("°", "deg"), ("′",)),
    "′": ("″",),
}
"""Units that follow a greater one without a sign between them."""


class _Value(NamedTuple):
    """A quantity read so far; number: that before its unit, where it is no more than the two;
    plain: it has no unit."""

    quantity: object
    plain: bool = False
    number: float | None = None


def number_of(text: str, unit: str, plain: float = 1.0, point: str = ".") -> float:
    """The number of `unit` (empty for none) a text means, `0.5 m`, `300 mm + 50 mm` or `600`.

    plain: what a number without a unit is multiplied by. point: the decimal mark; the other of
    point and comma is one, too, unless it can part thousands. Raises ValueError, saying why, for
    what is none or can mean two things.
    """
    given = text.translate(_ALIKE).strip()
    if not given:
        raise ValueError(translate("BendTorsion", "a value is missing"))
    if given.startswith("="):
        words = translate("BendTorsion", "expressions (= …) are for the panel of the object")
        raise ValueError(words)
    try:
        return _number_of(given, text.strip(), unit, plain, point)
    except ValueError:
        # What was typed before the unit that stood there, with a unit of its own.
        sign = next((one for one in (unit, SIGNS.get(unit)) if one and given.endswith(one)), None)
        rest = given[: -len(sign)].rstrip() if sign else ""
        if not rest or not _has_unit_at_end(rest):
            raise
        try:
            return _number_of(rest, text.strip(), unit, plain, point)
        except ValueError:
            pass
        raise


def expression_value(obj, text: str, unit: str) -> float:
    """The number of `unit` an expression has at an object; raises ValueError, saying why, for one
    that cannot be or has another unit."""
    try:
        # An expression that means nothing is taken by FreeCAD and fails at every recompute.
        value = obj.evalExpression(text)
    except Exception as problem:
        # FreeCAD raises many kinds for expressions.
        raise _not_an_expression(words_of(problem)) from problem
    if isinstance(value, int | float) and not isinstance(value, bool):
        number = float(value)
    elif isinstance(value, FreeCAD.Units.Quantity) and value.Unit == _unit_of(unit):
        number = _in_unit(value, unit)
    elif isinstance(value, FreeCAD.Units.Quantity) and value.Unit == FreeCAD.Units.Unit():
        number = float(value.Value)
    else:
        raise _not_an_expression(translate("BendTorsion", "it has another unit"))
    if not math.isfinite(number):
        raise _not_an_expression(str(number))
    return number


def name_without_object(obj, text: str) -> str:
    """The first name in an expression that is a property of `obj` itself, or could be one, and
    means another one, or none, at another object; empty when there is none."""
    for found in _NAME.finditer(text):
        name = found["name"] or ""
        first, _, rest = name.replace("#", ".#").partition(".")
        if not name or rest.startswith("#") or obj.Document.getObject(first.strip()):
            continue
        alone = not rest and not found["call"] and name not in _CONSTANTS and _one(name) is None
        if alone or name.startswith(".") or (rest and first.strip() in obj.PropertiesList):
            return name
    return ""


def words_of(problem: Exception) -> str:
    """What an exception of FreeCAD says; some carry a record instead of a text."""
    given = problem.args[0] if problem.args else ""
    return str(given.get("sErrMsg", given)) if isinstance(given, dict) else str(given)


def _not_an_expression(reason: str) -> ValueError:
    words = translate("BendTorsion", "the expression cannot be read: {reason}")
    return ValueError(words.format(reason=reason))


def _unreadable(text: str) -> ValueError:
    return ValueError(translate("BendTorsion", "{text} cannot be read").format(text=text))


def _another_unit(text: str, unit: str) -> ValueError:
    if not unit:
        words = translate("BendTorsion", "{text} has a unit, a number alone is wanted")
        return ValueError(words.format(text=text))
    words = translate("BendTorsion", "{text} has another unit than {unit}")
    return ValueError(words.format(text=text, unit=unit))


def _number_of(given: str, text: str, unit: str, plain: float, point: str) -> float:
    reading = _Reading(given, text, {unit, SIGNS.get(unit, unit)} if plain == 1.0 else (), point)
    try:
        inches = _inches(given)
        read = _Value(FreeCAD.Units.Quantity(inches, _unit_of("in"))) if inches else reading.whole()
        if read.plain:
            number = float(read.quantity.Value) * plain
        elif read.quantity.Unit != _unit_of(unit) or not unit:
            raise _another_unit(text, unit)
        else:
            number = _in_unit(read.quantity, unit)
    except (ArithmeticError, RecursionError) as problem:
        raise _unreadable(text) from problem
    if not math.isfinite(number):
        raise _unreadable(text)
    return number


def _inches(given: str) -> float | None:
    """Feet and inches as drawings write them, in mm; None for anything else."""
    found = _FEET_AND_INCHES.fullmatch(given)
    if found is None or (found["inches"] and not found["top"]):
        return None
    whole = 12.0 * float(found["feet"] or 0) + float(found["inches"] or 0)
    part = float(found["top"]) / float(found["bottom"]) if found["top"] else float(found["more"])
    return math.copysign(25.4 * (whole + part), -1.0 if found["sign"] == "-" else 1.0)


def _has_unit_at_end(given: str) -> bool:
    tokens = _tokens(given)
    return bool(tokens) and tokens[-1][0] == "unit"


def _tokens(given: str) -> list[tuple[str, str]] | None:
    """(kind, text) of what a text is made of; None when there is something else in it."""
    found, at = [], 0
    while at < len(given):
        token = _TOKEN.match(given, at)
        if token is None:
            return None
        found.append((token.lastgroup, token[token.lastgroup]))
        at = token.end()
    return found


def _decimal(digits: str, point: str) -> float:
    """A number with points and commas in it; raises ValueError where one can be a decimal mark or
    part thousands."""
    mantissa, letter, exponent = digits.replace("E", "e").partition("e")
    marks = [mark for mark in mantissa if mark in ".,"]
    if len(marks) == 1 and marks[0] != point and _GROUP.fullmatch(mantissa):
        words = translate("BendTorsion", "{text} can mean {whole} or {decimal}: write one of them")
        whole, decimal = mantissa.replace(marks[0], ""), mantissa.replace(marks[0], point)
        decimal = decimal.rstrip("0" + point)
        raise ValueError(words.format(text=digits, whole=whole, decimal=decimal))
    if len(marks) > 1:
        groups = _GROUPS.fullmatch(mantissa)
        if groups is None:
            raise _unreadable(digits)
        mantissa = mantissa.replace(groups[1], "")
    number = float(mantissa.replace(",", ".") + letter + exponent)
    if not math.isfinite(number):
        raise _unreadable(digits)
    return number


def _unit_of(unit: str):
    return FreeCAD.Units.Quantity(f"1 {unit}").Unit if unit else FreeCAD.Units.Unit()


def _in_unit(quantity, unit: str) -> float:
    return float(quantity.getValueAs(unit).Value) if unit else float(quantity.Value)


def _one(unit: str):
    """One of a unit FreeCAD knows; None when it knows none of that name."""
    try:
        one = FreeCAD.Units.Quantity(f"1 {unit}")
    except ValueError:
        return None
    return one if one.Unit != FreeCAD.Units.Unit() else None


class _Reading:
    """Reads the tokens of a text in turn: sums of products of numbers with units and brackets.

    own: the units a number without one may stand beside in a sum. text: what is named in errors.
    """

    def __init__(self, given: str, text: str, own: Collection[str], point: str):
        tokens = _tokens(given) if len(given) <= LONGEST else None
        if tokens is None:
            raise _unreadable(text)
        self.text, self.point, self.tokens, self.at = text, point, tokens, 0
        units = [token for kind, token in tokens if kind == "unit"]
        self.lent = _one(units[0]) if units and set(units) <= set(own) else None

    def whole(self) -> _Value:
        """What the text means; raises ValueError."""
        value = self._sum()
        if self._next("number"):
            words = translate("BendTorsion", "{text}: there is no sign between two values")
            raise ValueError(words.format(text=self.text))
        if self.at < len(self.tokens):
            raise _unreadable(self.text)
        return value

    def _next(self, kind: str) -> str:
        """The next token when it is of that kind, else nothing."""
        if self.at < len(self.tokens) and self.tokens[self.at][0] == kind:
            return self.tokens[self.at][1]
        return ""

    def _take(self, signs: str) -> str:
        """Go beyond the next token when it is one of these signs."""
        sign = self._next("sign")
        if not sign or sign not in signs:
            return ""
        self.at += 1
        return sign

    def _sum(self) -> _Value:
        total = self._product(signed=True)
        while sign := self._take("+-"):
            term = self._product(signed=False)
            total = self._added(total, term, -1.0 if sign == "-" else 1.0)
        return total

    def _added(self, one: _Value, other: _Value, sign: float) -> _Value:
        if one.plain != other.plain:
            if self.lent is None:
                number = (one if one.plain else other).quantity.Value
                words = translate("BendTorsion", "{text}: {number} has no unit, another value has")
                raise ValueError(words.format(text=self.text, number=f"{number:.10g}"))
            one, other = (
                _Value(item.quantity * self.lent) if item.plain else item for item in (one, other)
            )
        if one.quantity.Unit != other.quantity.Unit:
            words = translate("BendTorsion", "{text} adds what has different units")
            raise ValueError(words.format(text=self.text))
        return _Value(one.quantity + _scaled(other.quantity, sign), one.plain)

    def _product(self, signed: bool) -> _Value:
        value = self._factor(signed)
        while sign := self._take("*/"):
            factor = self._factor(signed=True, bare=True)
            if sign == "*":
                value = _Value(value.quantity * factor.quantity, value.plain and factor.plain)
            elif value.plain and factor.number is not None:
                # `1/2 in` is half an inch.
                scale = value.quantity.Value / factor.number**2
                value = _Value(_scaled(factor.quantity, scale))
            else:
                value = _Value(value.quantity / factor.quantity, value.plain and factor.plain)
        return value

    def _factor(self, signed: bool, bare: bool = False) -> _Value:
        """A value with its sign where it may have one; bare: it may be a unit alone."""
        sign = self._take("+-")
        if sign and not signed:
            words = translate("BendTorsion", "{text}: there are two signs side by side")
            raise ValueError(words.format(text=self.text))
        if sign:
            value = self._factor(signed=False)
            return _Value(_scaled(value.quantity, -1.0 if sign == "-" else 1.0), value.plain)
        if self._take("("):
            value = self._sum()
            if not self._take(")"):
                raise _unreadable(self.text)
            return self._with_unit(value) if value.plain else value
        if bare and self._next("unit"):
            return self._with_unit(_Value(FreeCAD.Units.Quantity(1.0), plain=True))
        return self._literal()

    def _with_unit(self, value: _Value) -> _Value:
        """A plain value times the unit that follows it, when there is one."""
        unit = self._next("unit")
        if not unit:
            return value
        one = _one(unit)
        if one is None:
            raise _unreadable(self.text)
        self.at += 1
        return _Value(value.quantity * one)

    def _literal(self) -> _Value:
        """A number with its unit, and those of smaller units behind it: 5 ft 3 in."""
        digits = self._next("number")
        if not digits:
            raise _unreadable(self.text)
        self.at += 1
        number = _decimal(digits, self.point)
        unit = self._next("unit")
        value = self._with_unit(_Value(FreeCAD.Units.Quantity(number), plain=True))
        if value.plain:
            return value
        if self._smaller_follows(unit):
            return _Value(value.quantity + self._literal().quantity)
        return value._replace(number=number)

    def _smaller_follows(self, unit: str) -> bool:
        kinds = [kind for kind, _ in self.tokens[self.at : self.at + 2]]
        return kinds == ["number", "unit"] and self.tokens[self.at + 1][1] in _SMALLER.get(unit, ())


def _scaled(quantity, factor: float):
    return quantity * FreeCAD.Units.Quantity(factor)
