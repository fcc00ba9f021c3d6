# SPDX-License-Identifier: LGPL-2.1-or-later
"""New document objects for scripts: made whole from values that were judged, or not at all."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Sequence
from functools import wraps

import FreeCAD

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.objects.given import Given, judged
from BendTorsionWB.objects.proxy import Property, add_property

UNSEEN = "(new)"
"""The label of an object that has no view yet."""


def scripted(function: Callable) -> Callable:
    """A function for scripts whose first argument is a document: arguments it does not have, lacks
    or cannot use raise BendTorsionError, and the document is as it was before."""
    signature = inspect.signature(function)

    @wraps(function)
    def called(*arguments, **named):
        try:
            signature.bind(*arguments, **named)
        except TypeError as problem:
            known = ", ".join(name for name in signature.parameters)
            raise BendTorsionError(
                error("argument", function.__name__, str(problem), f"its arguments are {known}")
            ) from None
        document = arguments[0] if arguments else named["document"]
        if not isinstance(document, FreeCAD.Document):
            raise BendTorsionError(
                error(
                    "argument",
                    function.__name__,
                    "the first argument is not a document",
                    "give FreeCAD.ActiveDocument or another open document",
                    value=type(document).__name__,
                )
            )
        return function(*arguments, **named)

    return called


def new_object(
    document,
    kind: str,
    label: str,
    proxy,
    given: Sequence[Given],
    further: Iterable[Property] = (),
):
    """An object of FreeCAD's type `kind` with a proxy class and its values.

    further: properties the object has besides those its class declares. Raises BendTorsionError,
    and adds nothing, when the label is none or a value does not fit (`given.judged`).
    """
    if not isinstance(label, str) or not label.strip():
        raise BendTorsionError(
            error(
                "argument",
                proxy.TYPE,
                "the name is no text",
                "give a name",
                position="argument name",
                value=str(label),
            )
        )
    further = tuple(further)
    values = judged(document, label, (*proxy.PROPERTIES, *further), given)
    obj = document.addObject(kind, proxy.TYPE)
    # FreeCAD 1.1 keeps a label an object has before its view for itself when this is undone, and
    # the first one is the object's name, which is a label users give.
    obj.Label = UNSEEN
    proxy(obj)
    obj.Label = label
    for declared in further:
        add_property(obj, declared)
    for name, value in values.items():
        setattr(obj, name, value)
    return obj
