# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a script gives for the properties of a new object, judged before the object is made."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from numbers import Real

import FreeCAD

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.objects.proxy import LARGEST_NUMBER, Property, type_of

LINKED = {
    "Surface": "Surface",
    "Axis": "Axis",
    "CutAxis": "Axis",
    "Section": "SectionSpec",
    "Member": "Member",
    "Through": "Member",
    "Other": "Member",
    "Beside": "Member",
    "EndsOn": "Member",
    "Plates": "PlateSet",
    "Unfold": "Unfold",
    "Bed": "AssemblyBed",
    "Sheets": "SheetSet",
}
"""By property, without its number: the kind of object it links to."""
OPTIONAL = ("Surface", "CutAxis", "Bed")
"""Of these, links that may be empty."""
_UNITS = {
    "App::PropertyLength": (FreeCAD.Units.Length, "mm", "a length, a number of mm or '2 m'"),
    "App::PropertyDistance": (FreeCAD.Units.Length, "mm", "a distance, a number of mm or '2 m'"),
    "App::PropertyAngle": (FreeCAD.Units.Angle, "deg", "an angle, a number of degrees or '5 deg'"),
    "App::PropertyPressure": (FreeCAD.Units.Pressure, "", "a stress with its unit: '355 MPa'"),
}


@dataclass(frozen=True)
class Given:
    """A value for a property, by the name of the argument it came with."""

    property: str
    argument: str
    value: object


def judged(
    document, label: str, declared: Iterable[Property], given: Sequence[Given]
) -> dict[str, object]:
    """Property -> value as FreeCAD takes it. Raises BendTorsionError with everything that does not
    fit the property: wrong type or unit, no number, negative length, none of the choices, an object
    of another kind or another document."""
    by_name = {item.name: item for item in declared}
    fit, faults = {}, []
    for item in given:
        try:
            fit[item.property] = _fitting(document, by_name[item.property], item.value)
        except ValueError as problem:
            faults.append(fault(label, item.argument, item.value, *problem.args))
    if faults:
        raise BendTorsionError(faults)
    return fit


def fault(label: str, argument: str, value: object, message: str, mend: str = ""):
    """The finding about an argument that is no use."""
    shown = getattr(value, "Label", value)
    return error(
        "argument",
        label,
        f"{argument} {message}",
        mend,
        position=f"argument {argument}",
        value=shown if isinstance(shown, float) else str(shown)[:80],
    )


def refuse_unknown(label: str, names: Iterable[str], known: Iterable[str], what: str) -> None:
    """Raises BendTorsionError for names that are none of the known ones, with the nearest."""
    known = list(known)
    faults = []
    for name in names:
        if name not in known:
            near = get_close_matches(str(name), known, 1)
            mend = f"write {near[0]}" if near else f"use one of {', '.join(known)}"
            faults.append(fault(label, what, name, f"{name!r} is unknown", mend))
    if faults:
        raise BendTorsionError(faults)


def refuse(label: str, argument: str, value: object, message: str, mend: str) -> None:
    """Raises BendTorsionError about one argument."""
    raise BendTorsionError(fault(label, argument, value, message, mend))


def read(label: str, argument: str, value: object, reader: Callable[[object], object]):
    """What a reader makes of an argument; ValueError (message, mend) becomes BendTorsionError."""
    try:
        return reader(value)
    except ValueError as problem:
        raise BendTorsionError(fault(label, argument, value, *problem.args)) from None


def rows(value: object) -> list:
    """A list; raises ValueError (message, mend) for a text, a mapping or what is no list."""
    if isinstance(value, str | Mapping) or not hasattr(value, "__iter__"):
        raise ValueError("is not a list", "give a list, such as [...]")
    return list(value)


def some_rows(value: object) -> list:
    """A list that is not empty; raises ValueError (message, mend)."""
    found = rows(value)
    if not found:
        raise ValueError("is empty", "give one or more")
    return found


def numbers(values: object) -> list[float]:
    """A list of finite numbers; raises ValueError (message, mend) for anything else."""
    if isinstance(values, str) or not hasattr(values, "__iter__"):
        raise ValueError("is not a list of numbers", "give numbers, such as [4000, 8000]")
    return [_number(value) for value in values]


def vector(value: object) -> FreeCAD.Vector:
    """Three finite numbers; raises ValueError (message, mend) for anything else."""
    if isinstance(value, str) or not hasattr(value, "__iter__"):
        raise ValueError("is not (x, y, z)", "give three numbers")
    found = [_number(item) for item in value]
    if len(found) != 3:
        raise ValueError("is not (x, y, z)", "give three numbers")
    return FreeCAD.Vector(*found)


def mapping(value: object) -> Mapping:
    """A mapping; raises ValueError (message, mend) for anything else."""
    if not isinstance(value, Mapping):
        raise ValueError("is not a mapping", "give {name: value}")
    return value


def sub_elements(document, value: object) -> tuple:
    """(object, names) of a picked shape; raises ValueError (message, mend) when it is no such, or
    the shape has no such element."""
    if not isinstance(value, tuple) or len(value) != 2:
        raise ValueError("is not (object, 'Face1')", "give an object and a name")
    target, names = value
    _own(document, target)
    names = [names] if isinstance(names, str) else list(names)
    shape = getattr(target, "Shape", None)
    # A shape that is still to be computed shows later what it has.
    if shape is not None and not shape.isNull() and "Touched" not in target.State:
        for name in filter(None, names):
            kind = str(name).rstrip("0123456789")
            count = len(getattr(shape, {"Vertex": "Vertexes"}.get(kind, f"{kind}s"), ()))
            number = str(name)[len(kind) :]
            if not number or not 1 <= int(number) <= count:
                raise ValueError(
                    f"names {name}, which {target.Label} has not",
                    f"use one of its {count} {kind}s" if count else "use Face, Edge or Vertex",
                )
    return target, names


def _fitting(document, declared: Property, value: object) -> object:
    """A value as FreeCAD takes it for a property; ValueError (message, mend)."""
    kind = declared.type
    if kind in _UNITS:
        return _quantity(kind, value)
    if kind == "App::PropertyEnumeration":
        if value not in declared.choices:
            near = get_close_matches(str(value), declared.choices, 1)
            listed = ", ".join(choice for choice in declared.choices if choice)
            mend = f"write {near[0]}, or another of {listed}" if near else f"use one of {listed}"
            raise ValueError("is none of the choices", mend)
        return value
    if kind == "App::PropertyLink":
        return _linked(document, declared.name, value)
    if kind == "App::PropertyLinkList":
        return [_linked(document, declared.name, item) for item in value]
    if kind == "App::PropertyLinkSub":
        return sub_elements(document, value)
    if kind == "App::PropertyLinkSubList":
        return [sub_elements(document, item) for item in value]
    reader = _READERS.get(kind)
    if reader is None:
        raise LookupError(f"no reader for {kind}")
    return reader(value)


def _number(value: object) -> float:
    number = getattr(value, "Value", value)
    if isinstance(number, bool) or not isinstance(number, Real) or not _usable(number):
        raise ValueError("is not a number of use", "give a number")
    return float(number)


def _usable(number: Real) -> bool:
    return math.isfinite(number) and abs(number) <= LARGEST_NUMBER


def _quantity(kind: str, value: object) -> object:
    unit, plain, wanted = _UNITS[kind]
    quantity = value
    if isinstance(value, str):
        try:
            quantity = FreeCAD.Units.Quantity(value)
        except (ValueError, ArithmeticError):
            raise ValueError("cannot be read", f"give {wanted}") from None
    if isinstance(quantity, FreeCAD.Units.Quantity):
        if quantity.Unit != unit and not (plain and quantity.Unit == FreeCAD.Units.Unit()):
            raise ValueError("has another unit", f"give {wanted}")
        number = quantity.Value
    elif not plain:
        raise ValueError("has no unit", f"give {wanted}")
    else:
        number = _number(quantity)
    if not _usable(number):
        raise ValueError("is not a number of use", f"give {wanted}")
    if kind == "App::PropertyLength" and number < 0.0:
        raise ValueError("is negative", "give 0 or more")
    # As given: the number of a text in other units loses its last digits on the way.
    return value if isinstance(value, str) else number


def _integer(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, Real) or int(value) != value:
        raise ValueError("is not a whole number", "give a whole number")
    return int(value)


def _boolean(value: object) -> bool:
    if value not in (True, False):
        raise ValueError("is neither True nor False", "give True or False")
    return bool(value)


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise ValueError("is not a text", "give a text in quotes")
    return value


def _texts(value: object) -> list[str]:
    if isinstance(value, str) or not hasattr(value, "__iter__"):
        raise ValueError("is not a list of texts", "give a list")
    return [_text(item) for item in value]


def _vectors(value: object) -> list:
    if isinstance(value, str) or not hasattr(value, "__iter__"):
        raise ValueError("is not a list of points", "give [(x, y, z), ...]")
    return [vector(item) for item in value]


def _linked(document, name: str, value: object):
    name = name.rstrip("0123456789")
    kind = LINKED[name]
    if value is None:
        if name not in OPTIONAL:
            raise ValueError("is missing", f"give one of kind {kind}")
        return None
    _own(document, value)
    if type_of(value) != kind:
        raise ValueError(f"is no {kind}", f"give one of kind {kind}")
    return value


def _own(document, value: object) -> None:
    """ValueError unless the value is an object of the document."""
    if not hasattr(value, "TypeId") or not hasattr(value, "Document"):
        raise ValueError("is not an object of the document", "give the object itself")
    if value.Document != document:
        raise ValueError("is of another document", "give an object of the same document")


_READERS = {
    "App::PropertyFloat": _number,
    "App::PropertyFloatList": numbers,
    "App::PropertyInteger": _integer,
    "App::PropertyBool": _boolean,
    "App::PropertyString": _text,
    "App::PropertyStringList": _texts,
    "App::PropertyVector": vector,
    "App::PropertyVectorList": _vectors,
}
