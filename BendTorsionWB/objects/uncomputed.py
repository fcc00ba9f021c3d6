# SPDX-License-Identifier: LGPL-2.1-or-later
"""What FreeCAD could not compute, and what depends on it, emptied and told.

FreeCAD computes no object with an expression that fails or a cell that is none, nor what depends on
it, and leaves all of these as they were, up to date by their looks.
"""

from __future__ import annotations

import re

import FreeCAD

from BendTorsionWB.core.finding import error

_DOCUMENT = re.compile(r"(?:<<(.*?)>>|(\w+))#")
"""What an expression calls another document: its label or its name."""


class AfterRecompute:
    """Document observer that looks after each recompute for what was left as it was."""

    def __init__(self):
        self.registered = False

    def register(self) -> None:
        """Be told of recomputes from now on."""
        if not self.registered:
            FreeCAD.addDocumentObserver(self)
            self.registered = True

    def slotBeforeRecomputeDocument(self, document) -> None:
        """Called by FreeCAD before a recompute; by 1.1 when something is to be computed only."""
        touch_what_follows_nothing(document)

    def slotRecomputedObject(self, obj) -> None:
        """Put in error what FreeCAD passed over, before what depends on it is computed."""
        from BendTorsionWB.objects.proxy import is_bare

        if is_bare(obj):
            from BendTorsionWB.objects.repair import tell_bare

            tell_bare(obj)

    def slotRecomputedDocument(self, document) -> None:
        """Put in error what FreeCAD did not compute."""
        left = [obj for obj in document.Objects if not obj.isValid()]
        if left:
            empty_dependants(document, left)


after_recompute = AfterRecompute()


def touch_what_follows_nothing(document) -> None:
    """Have FreeCAD compute what follows a document that is not there: it leaves it with the last
    value, and tells nothing."""
    for obj in document.Objects:
        if follows_nothing(obj):
            obj.touch()


def empty_dependants(document, left) -> None:
    """Put in error the objects FreeCAD could not compute, and have those that depend on them see
    it, the nearest first."""
    from BendTorsionWB.objects.proxy import is_bare, type_of, write_findings
    from BendTorsionWB.objects.repair import tell_bare

    behind = {user.Name for obj in left for user in obj.InListRecursive}
    names = {obj.Name for obj in left}
    below = {obj.Name: len(obj.OutListRecursive) for obj in document.Objects}
    for obj in sorted(document.Objects, key=lambda obj: below[obj.Name]):
        if not type_of(obj) or obj.Name not in behind | names:
            continue
        causes = [
            cause
            for cause in (obj, *obj.OutList)
            if cause.Name in names and not (cause is not obj and type_of(cause))
        ]
        if is_bare(obj):
            tell_bare(obj)
        elif causes:
            obj.Proxy.clear(obj)
            write_findings(obj, [_finding(cause) for cause in causes])
        else:
            obj.Proxy.execute(obj)
        if obj.isValid():
            obj.purgeTouched()


def follows_nothing(obj) -> bool:
    """Whether an expression of an object asks a document that is not there."""
    words = [text for _, text in obj.ExpressionEngine if "#" in text]
    if not words:
        return False
    there = {name for used in obj.OutList for name in (used.Document.Name, used.Document.Label)}
    return not {label or name for text in words for label, name in _DOCUMENT.findall(text)} <= there


def _finding(obj):
    return error(
        "object-invalid",
        obj.Label,
        f"FreeCAD cannot compute it: {obj.getStatusString()}",
        "mend its expressions and the cells and objects it uses",
    )
