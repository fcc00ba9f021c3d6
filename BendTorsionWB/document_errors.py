# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors of a document's objects, told where they come from and of the members they stop."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from BendTorsionWB.core.finding import BETWEEN, Finding
from BendTorsionWB.document_objects import owner_of
from BendTorsionWB.objects.proxy import findings_of, type_of


def told_of_members(document, findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """The findings of a recomputed document, in their order. An error of an object that members
    depend on names these too, the section, axis or surface first, and the expressions that lead
    its properties: a schedule may say otherwise."""
    holders: dict[Finding, list] = {}
    for obj in document.Objects:
        if "Findings" in obj.PropertiesList:
            for finding in findings_of(obj):
                if finding.severity == "error":
                    holders.setdefault(finding, []).append(obj)
    return tuple(_told(finding, holders.get(finding, [])) for finding in findings)


def _told(finding: Finding, holders: list) -> Finding:
    stopped = dict.fromkeys(filter(None, map(_member, holders)))
    others = [name for name in stopped if name not in finding.objects and not _is_of(finding, name)]
    if not others:
        return finding
    own = set(holders)
    source = next((obj for obj in holders if not set(obj.OutList) & own), holders[0])
    led = [f"{path} is {words!r}" for path, words in source.ExpressionEngine]
    where, mend = "in the document", finding.mend
    if led:
        where += f", where {', '.join(led)}"
        mend += ", or delete the expression to follow the schedule again"
    names = BETWEEN.join((*finding.objects, *others))
    return replace(finding, object=names, message=f"{where}: {finding.message}", mend=mend)


def _is_of(finding: Finding, member: str) -> bool:
    """Whether it is about a plate of the member."""
    return any(name.startswith(f"{member}-") for name in finding.objects)


def _member(obj) -> str:
    """Label of the member an object is or is made of; empty for all others."""
    owner = owner_of(obj)
    # Pages stop no files of a member.
    return owner.Label if type_of(owner) == "Member" and type_of(obj) != "SheetSet" else ""
