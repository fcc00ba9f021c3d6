# SPDX-License-Identifier: LGPL-2.1-or-later
"""Members of a document that nothing is written of, because their plates are not laid flat."""

from __future__ import annotations

from collections.abc import Container

from BendTorsionWB.core.finding import Finding, warning
from BendTorsionWB.objects.proxy import type_of


def without_patterns(document, only: Container[str] = ()) -> tuple[Finding, ...]:
    """A warning for each Member without an Unfold, and for each PlateSet without one whose member
    has another. only: members to be told of, where there are any."""
    kinds: dict[str, list] = {"Member": [], "PlateSet": [], "Unfold": []}
    for obj in document.Objects:
        kinds.get(type_of(obj), []).append(obj)
    laid = {unfold.Plates.Name for unfold in kinds["Unfold"] if unfold.Plates}
    found = []
    for member in kinds["Member"]:
        if only and member.Label not in only:
            continue
        own = [item for item in kinds["PlateSet"] if item.Member == member]
        bare = [item for item in own if item.Name not in laid]
        if not own:
            found.append(
                warning(
                    "member-without-patterns",
                    member.Label,
                    "has no plates, so that it is in no file",
                    "make its plates and lay them flat (Plates, Development), or delete it",
                )
            )
        elif len(bare) == len(own):
            found.append(
                warning(
                    "member-without-patterns",
                    member.Label,
                    "its plates are not laid flat, so that it is in no file",
                    "lay them flat (Development), or delete it",
                )
            )
        else:
            found += [
                warning(
                    "plates-without-patterns",
                    item.Label,
                    f"of {member.Label}, are not laid flat, so that they are in no file",
                    "lay them flat (Development), or delete them",
                )
                for item in bare
            ]
    return tuple(found)
