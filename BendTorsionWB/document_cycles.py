# SPDX-License-Identifier: LGPL-2.1-or-later
"""Objects of a document that depend on each other in a circle: nothing of them can be computed."""

from __future__ import annotations

from BendTorsionWB.core.finding import BendTorsionError, error


def refuse_cycle(document) -> None:
    """Raises BendTorsionError, an error for each object of a circle: FreeCAD computes none of them,
    and leaves them up to date by their looks."""
    cycle = _cycle(document)
    if cycle:
        raise BendTorsionError(
            error(
                "link-cycle",
                obj.Label,
                "depends on itself, in a cycle of "
                + " -> ".join(other.Label for other in (*cycle, cycle[0])),
                "cut one of these links",
            )
            for obj in cycle
        )


def _cycle(document) -> list:
    """Objects that depend on each other in a circle, in its order; none when there is no circle."""
    uses = {
        obj.Name: {used.Name for used in obj.OutList if used.Document == document}
        for obj in document.Objects
    }
    done: set[str] = set()
    for first in uses:
        path, waiting = [], [first]
        while waiting:
            name = waiting[-1]
            if path and path[-1] == name:
                done.add(path.pop())
                waiting.pop()
                continue
            if name in path:
                return [document.getObject(other) for other in path[path.index(name) :]]
            if name in done:
                waiting.pop()
                continue
            path.append(name)
            waiting += uses[name] - done
    return []
