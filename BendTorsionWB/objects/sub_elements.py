# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sub-elements of members and plate sets (`Face12`, `Edge3`) by mark and role, and back.

A PlateSet knows its plates by their marks. A Member of closed section is one skin per stretch
without a step, marked `skin 1`, `skin 2`, … whose faces are named by the section's (`top`, `left`,
…, `end start`) and edges by its corners (`arris TL`); of an open section its strips, marked by
their face. Roles are those of `shapes.roles`; a role without its count means all of that name.
"""

from __future__ import annotations

from BendTorsionWB.core import detailing
from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.objects import member as member_object
from BendTorsionWB.objects import plate_set as plates_object
from BendTorsionWB.shapes import roles
from BendTorsionWB.shapes.brep import as_built


def roles_of(obj) -> dict[str, tuple[str, str]]:
    """Every face and edge of a PlateSet's or Member's shape, `FaceN` and `EdgeN`, with its (mark,
    role). Raises BendTorsionError for an object that is in error or out of date."""
    named = _plates(obj) if obj.BT_Type == "PlateSet" else _member(obj)
    solids = as_built(obj.Shape).Solids
    if not solids or len(solids) != len(named):
        raise BendTorsionError(
            error(
                "roles",
                obj.Label,
                "the shape is not the one its parameters give",
                "recompute the document, and mend what is in error",
                value=len(solids),
                limit=len(named),
            )
        )
    table, faces_before, edges_before = {}, 0, 0
    for solid, (mark, body) in zip(solids, named, strict=True):
        if isinstance(body, roles.Body):
            faces = roles.face_roles(solid, body)
            edges = roles.edge_roles(solid, faces, body)
        else:
            faces = roles.flat_face_roles(solid, body)
            edges = roles.edge_roles(solid, faces)
        table |= {f"Face{faces_before + k}": (mark, role) for k, role in enumerate(faces, 1)}
        table |= {f"Edge{edges_before + k}": (mark, role) for k, role in enumerate(edges, 1)}
        faces_before, edges_before = faces_before + len(faces), edges_before + len(edges)
    return table


def sub_elements(obj, mark: str, role: str) -> list[str]:
    """The names of the faces or edges of a mark with a role, along the member; `outer` gives
    `outer 1`, `outer 2`, … too. Raises BendTorsionError when there are none."""
    table = roles_of(obj)
    found = [
        (own, name)
        for name, (of, own) in table.items()
        if of == mark and role in (own, roles.base(own))
    ]
    if not found:
        known = dict.fromkeys(own for of, own in table.values() if of == mark)
        marks = dict.fromkeys(of for of, _ in table.values())
        raise BendTorsionError(
            error(
                "role-unknown",
                obj.Label,
                f"{mark} has no {role!r}" if known else f"there is no {mark!r}",
                f"use one of {', '.join(known or marks)}",
                value=role if known else mark,
            )
        )
    return [name for _, name in sorted(found, key=lambda item: _count(item[0]))]


def role_of(obj, name: str) -> tuple[str, str]:
    """The (mark, role) of `FaceN` or `EdgeN`; KeyError when the shape has no such part."""
    return roles_of(obj)[name]


def _count(role: str) -> int:
    tail = role.rpartition(" ")[2]
    return int(tail) if role != roles.base(role) and tail.isdigit() else 0


def _pieces(skin) -> list:
    return [(piece.knots, piece.poles) for piece in skin]


def _plates(obj) -> list[tuple]:
    plates = plates_object.value(obj)
    return [
        (item.plate.mark, roles.plate_body(_pieces(item.skin), item.plate.edges))
        for item in plates.plates
    ] + [(flat.mark, flat) for flat in plates.flat]


def _member(obj) -> list[tuple]:
    geometry = member_object.value(obj)
    law = geometry.member.law
    section, tubes = law.sections[0], detailing.member_skins(geometry).tubes
    if section.closed:
        count = len(section.corners)
        between = {frozenset((strip.first, strip.second)): strip.face for strip in law.strips}
        sides = tuple(between[frozenset((j, (j + 1) % count))] for j in range(count))
        return [
            (f"skin {k}", roles.Body(_pieces(tube), sides, section.corner_names))
            for k, tube in enumerate(tubes, start=1)
        ]
    named, k = [], 0
    for index, strip in enumerate(law.strips):
        for number in range(1, len(law.joints_of(index)) + 2):
            mark = strip.face if not law.joints_of(index) else f"{strip.face} {number}"
            named.append((mark, roles.plate_body(_pieces(tubes[k]), strip.edges)))
            k += 1
    return named
