# SPDX-License-Identifier: LGPL-2.1-or-later
"""The edges of a shape sorted into chains: each is a curve a member can follow."""

from __future__ import annotations

from collections.abc import Sequence


def chains(shape, own: Sequence[str] = ()) -> list:
    """Names of the edges of each connected chain of a shape; '' when all are one chain. own: of
    these edges only, which have their names then."""
    names = list(own) or [f"Edge{k}" for k in range(1, len(shape.Edges) + 1)]
    edges = [shape.getElement(name) for name in own] or shape.Edges
    groups: list[tuple[set, list]] = []
    for name, edge in zip(names, edges, strict=True):
        ends = {tuple(round(x, 3) for x in vertex.Point) for vertex in edge.Vertexes}
        joined = [group for group in groups if group[0] & ends]
        groups = [group for group in groups if group not in joined]
        groups.append(
            (ends.union(*(group[0] for group in joined)), sum((g[1] for g in joined), []) + [name])
        )
    if len(groups) == 1 and not own:
        return [""]
    found = [sorted(chain, key=names.index) for _, chain in groups]
    found.sort(key=lambda chain: names.index(chain[0]))
    return [chain[0] if len(chain) == 1 else chain for chain in found]
