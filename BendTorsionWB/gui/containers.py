# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tree nodes that hold the shapes of others, as the part a STEP file came as, and compounds."""

from __future__ import annotations

from collections.abc import Sequence


def contents(obj) -> list:
    """What a part or a group holds, or a compound is made of; empty for anything else. A body,
    which is a shape by itself, is none."""
    if obj.isDerivedFrom("Part::Compound"):
        return list(obj.Links)
    if obj.isDerivedFrom("Part::Feature") or not obj.hasExtension("App::GroupExtension"):
        return []
    return list(obj.Group)


def opened(picks: Sequence[tuple]) -> list[tuple]:
    """Picked (object, names) without the nodes of which something inside is picked, too: they are
    picked with it. Parts and groups picked alone as the shapes they hold; empty ones stay."""
    objects = {obj.Name for obj, _ in picks}
    found = []
    for obj, names in picks:
        inside = _inside(obj)
        if not names and any(one.Name in objects for one in inside):
            continue
        # A compound is a shape by itself.
        leaves = _shapes(inside) if not _is_shape(obj) else []
        found += [(one, names) for one in leaves] or [(obj, names)]
    return found


def free_edges(shape) -> list[str]:
    """Names of the edges of a shape that bound none of its faces."""
    bounds: dict[int, list] = {}
    for face in shape.Faces:
        for edge in face.Edges:
            bounds.setdefault(edge.hashCode(), []).append(edge)
    return [
        f"Edge{k}"
        for k, edge in enumerate(shape.Edges, start=1)
        if not any(edge.isSame(other) for other in bounds.get(edge.hashCode(), ()))
    ]


def _inside(obj) -> list:
    """All that is in a node, at any depth."""
    found = {}
    waiting = contents(obj)
    while waiting:
        one = waiting.pop(0)
        if one.Name not in found:
            found[one.Name] = one
            waiting += contents(one)
    return list(found.values())


def _shapes(objects: Sequence) -> list:
    """Those that are shapes, without what compounds among them are made of."""
    shapes = [obj for obj in objects if _is_shape(obj)]
    parts = {one.Name for obj in shapes for one in _inside(obj)}
    return [obj for obj in shapes if obj.Name not in parts]


def _is_shape(obj) -> bool:
    """Whether it is a shape of its own, and none of the workbench."""
    return obj.isDerivedFrom("Part::Feature") and not hasattr(obj, "BT_Type")
