# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object Node: where two members meet, and how the one ends on the other."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

from BendTorsionWB.core import detailing, rules
from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.core.nodes.node_blend import with_blends
from BendTorsionWB.core.nodes.node_branch import widest_gap
from BendTorsionWB.core.nodes.node_input import DIAPHRAGMS, TYPES, NodeInput
from BendTorsionWB.core.nodes.node_meetings import meetings_of, place_of
from BendTorsionWB.core.nodes.node_reach import stub_limits
from BendTorsionWB.core.nodes.nodes import Node as CoreNode
from BendTorsionWB.objects import member as member_object
from BendTorsionWB.objects.proxy import Property, Proxy, check_linked, linked, type_of
from BendTorsionWB.shapes import node_shape

THROUGH_BY = ("link", "rank")


class Node(Proxy):
    """A node; its shape is the root lines of the branch on the member that runs through."""

    TYPE = "Node"
    PROPERTIES = (
        Property("App::PropertyLink", "Through", "Node", "The member that runs through"),
        Property("App::PropertyLink", "Other", "Node", "The member that ends on it"),
        Property(
            "App::PropertyEnumeration",
            "ThroughBy",
            "Node",
            "link: Through runs through; rank: of the two members the one of lower Rank does",
            "link",
            THROUGH_BY,
        ),
        Property(
            "App::PropertyLinkList",
            "Beside",
            "Node",
            "Members that end at this node as well: of two that overlap, the one of lower Rank is "
            "ended on by the other",
        ),
        Property(
            "App::PropertyLinkList",
            "EndsOn",
            "Node",
            "Members that end at this node as well, which Other ends on where they overlap, "
            "whatever the ranks",
        ),
        Property(
            "App::PropertyString",
            "Node",
            "Node",
            "Name of the node; branches of one node share it",
        ),
        Property(
            "App::PropertyDistance",
            "Place",
            "Node",
            "About where on the member that runs through; matters where the two meet twice",
            0.0,
        ),
        Property(
            "App::PropertyEnumeration",
            "Type",
            "Node",
            "direct: the branch is welded to the outer faces; stub: a stub of it, with a field "
            "joint at StubLength",
            "direct",
            TYPES,
        ),
        Property("App::PropertyLength", "Gap", "Node", "Root gap to the outer faces", 3.0),
        Property(
            "App::PropertyLength",
            "StubLength",
            "Node",
            "From the axis of the member that runs through, along the branch, to the field joint "
            "behind a stub",
            0.0,
        ),
        Property(
            "App::PropertyEnumeration",
            "Diaphragms",
            "Node",
            "What of the branch goes on inside the member that runs through",
            "flanges",
            DIAPHRAGMS,
        ),
        Property(
            "App::PropertyBool",
            "Blend",
            "Node",
            "Make the branch flush with the member that runs through",
            False,
        ),
        Property(
            "App::PropertyEnumeration",
            "RulePack",
            "Node",
            "The rules the node is checked by",
            "CN",
            rules.PACKS,
        ),
        Property(
            "App::PropertyString",
            "Kind",
            "Result",
            "crossing, T, Y, K or corner",
            output=True,
        ),
        Property(
            "App::PropertyDistance",
            "PlaceThrough",
            "Result",
            "Place on the member that runs through",
            output=True,
        ),
        Property(
            "App::PropertyDistance", "PlaceOther", "Result", "Place on the branch", output=True
        ),
        Property(
            "App::PropertyAngle", "CrossingAngle", "Result", "Angle between the axes", output=True
        ),
        Property(
            "App::PropertyLength",
            "AxisDistance",
            "Result",
            "Distance between the axes",
            output=True,
        ),
        Property(
            "App::PropertyStringList",
            "LandsOn",
            "Result",
            "Faces each end of the branch lands on",
            output=True,
        ),
    )

    def build(self, obj):
        found = value(obj)
        (branch,) = found.branches
        obj.Kind = found.kind
        obj.PlaceThrough, obj.PlaceOther = branch.s_through, branch.s
        obj.CrossingAngle = math.degrees(branch.angle)
        obj.AxisDistance = branch.distance
        obj.LandsOn = [" and ".join(side.faces) for side in branch.sides]
        _, other = members_of(obj)
        member = with_blends(member_object.value(other).member, branch.blends)
        obj.Shape = node_shape.root_lines(member, branch)
        return ()


def members_of(obj) -> tuple:
    """The Member object that runs through, and the one that ends on it."""
    one, other = linked(obj, "Through", "Member"), linked(obj, "Other", "Member")
    if obj.ThroughBy == "rank":
        if one.Rank == other.Rank:
            raise BendTorsionError(
                error(
                    "node-unresolved",
                    obj.Label,
                    f"{one.Label} and {other.Label} have the same rank",
                    "give them different ranks, or set ThroughBy to link",
                    value=one.Rank,
                )
            )
        # No rank (0) ends on any.
        if (other.Rank or math.inf) < (one.Rank or math.inf):
            one, other = other, one
    return one, other


def value(obj, known: dict[str, detailing.MemberGeometry] | None = None, **asked) -> CoreNode:
    """The core node; raises BendTorsionError for what cannot be built. known: geometry of members
    by object name, completed, so that many nodes ask a member once. asked: fields of its NodeInput
    in place of the object's."""
    known = {} if known is None else known
    through, other = members_of(obj)
    given = NodeInput(
        through.Label,
        other.Label,
        obj.Node,
        obj.Place.Value,
        obj.Type,
        obj.Gap.Value,
        obj.StubLength.Value,
        obj.Diaphragms,
        obj.Blend,
    )
    given = replace(given, **asked)
    beside = _linked_members(obj, "Beside")
    first = _linked_members(obj, "EndsOn")
    members = list({m.Name: m for m in (through, other, *beside, *first)}.values())
    for member in members:
        if member.Name not in known:
            known[member.Name] = member_object.value(member)
    more = [NodeInput(through.Label, m.Label) for m in (*beside, *first)]
    more += [NodeInput(m.Label, other.Label) for m in first]
    # Where the two meet a second time, that is another object's node.
    ranks = {m.Label: m.Rank or None for m in members} | {through.Label: 0}
    found = detailing.meeting_of(
        tuple(known[member.Name] for member in members),
        ranks,
        (given, *dict.fromkeys(more)),
        rules.node_rules(obj.RulePack),
    )
    own = [
        (abs(branch.s_through - given.s), node, branch)
        for node in found.nodes
        for branch in node.branches
        if branch.member == other.Label and node.through == through.Label
    ]
    errors = [f for f in found.findings if f.severity == "error"]
    if not own or any({through.Label, other.Label} & set(f.objects) for f in errors):
        raise BendTorsionError(_of_document(f, obj, through) for f in dict.fromkeys(found.findings))
    _, node, branch = min(own, key=lambda item: item[0])
    return replace(node, name=obj.Node or node.name, branches=(branch.at_node(obj.Node),))


def limits(obj) -> dict[str, tuple[float, float]]:
    """The least and the most that Gap and StubLength of a node can be, mm, where they are right
    otherwise; nothing of one that cannot be built with any. Its members' other nodes do not count.
    """
    plain = {"type": "direct", "stub_length": 0.0}
    try:
        (branch,) = value(obj, gap=0.0, **plain).branches
        members = [member_object.value(item).member for item in members_of(obj)]
        node_rules = rules.node_rules(obj.RulePack)
        widest, _ = widest_gap(*members, branch.s_through, branch.s, node_rules)
        (branch,) = value(obj, gap=min(obj.Gap.Value, widest), **plain).branches
    except BendTorsionError:
        return {}
    return {"Gap": (0.0, widest), "StubLength": stub_limits(branch, members[1].length)}


def _of_document(finding, obj, through):
    """What is found of two members that do not meet, without what only a schedule has: the row,
    and a place nobody gave."""
    if finding.code != "node-not-found":
        return finding
    message = finding.message
    if not obj.Place.Value:
        message = message.removesuffix(f" near s = 0 mm of {through.Label}")
    return replace(finding, position="", message=message)


def free_place(through, other, there: Sequence) -> float | None:
    """Place on the Member `through`, mm, of the first meeting with `other` that none of the Nodes
    `there`, which are theirs, is at; None when each has its node, and 0 when the two do not meet
    or one is in error while there is no node."""
    try:
        solids = {item.Label: member_object.value(item).member for item in (through, other)}
        meetings, _ = meetings_of(solids, rules.node_rules("CN"))
    except BendTorsionError:
        meetings = []
    places = [place_of(meeting, through.Label) for meeting in meetings]
    for node in there:
        own = [abs(place - _place_on(node, through)) for place in places]
        if own:
            del places[own.index(min(own))]
    if places:
        return places[0]
    return None if there else 0.0


def _place_on(node, member) -> float:
    """Where a node is on one of its members; as given when it could not be computed."""
    if node.Status.startswith("error"):
        return node.Place.Value
    return (node.PlaceThrough if members_of(node)[0] is member else node.PlaceOther).Value


def _linked_members(obj, name: str) -> list:
    """The Member objects of a list of links; raises BendTorsionError for others and for those of
    the node itself."""
    found = getattr(obj, name)
    for item in found:
        if type_of(item) != "Member" or item in (obj.Through, obj.Other):
            raise BendTorsionError(
                error(
                    "link-kind",
                    obj.Label,
                    f"{name} links to what is no other member of the node",
                    "link to members that end at the node, besides Other",
                    value=item.Label,
                )
            )
        check_linked(item)
    return found


def nodes_of(objects: Iterable) -> tuple[CoreNode, ...]:
    """The core nodes of Node objects; raises BendTorsionError for one in error or of another
    kind."""
    nodes = []
    known: dict[str, detailing.MemberGeometry] = {}
    for obj in objects:
        if type_of(obj) != "Node":
            raise BendTorsionError(
                error(
                    "link-kind",
                    obj.Label,
                    "Nodes links to what is no node",
                    "link to nodes only",
                    value=getattr(obj, "BT_Type", ""),
                )
            )
        check_linked(obj)
        nodes.append(value(obj, known))
    return tuple(nodes)
