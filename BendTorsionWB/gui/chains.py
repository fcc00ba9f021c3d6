# SPDX-License-Identifier: LGPL-2.1-or-later
"""The edges of a shape sorted into chains: each is a curve a member can follow."""

from __future__ import annotations


def chains(shape) -> list:
    """Names of the edges of each connected chain of a shape; '' when all are one chain."""
    names = [f"Edge{k}" for k in range(1, len(shape.Edges) + 1)]
    groups: list[tuple[set, list]] = []
    for name, edge in zip(names, shape.Edges, strict=True):
        ends = {tuple(round(x, 3) for x in vertex.Point) for vertex in edge.Vertexes}
        joined = [group for group in groups if group[0] & ends]
        groups = [group for group in groups if group not in joined]
        groups.append(
            (ends.union(*(group[0] for group in joined)), sum((g[1] for g in joined), []) + [name])
        )
    if len(groups) == 1:
        return [""]
    found = [sorted(own, key=names.index) for _, own in groups]
    found.sort(key=lambda own: names.index(own[0]))
    return [own[0] if len(own) == 1 else own for own in found]
