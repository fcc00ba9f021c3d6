# SPDX-License-Identifier: LGPL-2.1-or-later
"""Objects that no longer compute, because their document was saved without the workbench: FreeCAD
keeps their properties and shapes then, and drops what computes them."""

from __future__ import annotations

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.objects.arrangement import ArrangementSet
from BendTorsionWB.objects.assembly_bed import AssemblyBed
from BendTorsionWB.objects.axis import Axis
from BendTorsionWB.objects.member import Member
from BendTorsionWB.objects.node import Node
from BendTorsionWB.objects.node_sheets import NodeSheets
from BendTorsionWB.objects.plate_set import PlateSet
from BendTorsionWB.objects.proxy import bare_finding, is_bare, write_findings
from BendTorsionWB.objects.section_spec import SectionSpec
from BendTorsionWB.objects.sheet import PageOutlines, PageSymbol, SheetSet
from BendTorsionWB.objects.surface import Surface
from BendTorsionWB.objects.unfold import Unfold

KINDS = {
    kind.TYPE: kind
    for kind in (
        *(Surface, Axis, SectionSpec, Member, Node, PlateSet, Unfold, AssemblyBed),
        *(SheetSet, ArrangementSet, NodeSheets, PageOutlines, PageSymbol),
    )
}
"""By BT_Type: what computes the objects of that kind."""


def bare_objects(document) -> list:
    """The objects of ours that FreeCAD cannot compute."""
    return [obj for obj in document.Objects if is_bare(obj)]


def refuse_bare(objects) -> None:
    """Raises BendTorsionError for those of some objects that FreeCAD cannot compute."""
    findings = [bare_finding(obj) for obj in objects if is_bare(obj)]
    if findings:
        raise BendTorsionError(findings)


def tell_bare(obj) -> None:
    """Empty an object that FreeCAD took for computed and nothing computes, and put it in error."""
    if obj.BT_Type in KINDS:
        object.__new__(KINDS[obj.BT_Type]).clear(obj)
    if "Findings" in obj.PropertiesList:
        write_findings(obj, (bare_finding(obj),))


def repair(document) -> list:
    """Give bare objects what computes them, and mark them to be recomputed; returns them. Raises
    BendTorsionError, with nothing changed, for objects of kinds this release does not have."""
    bare = bare_objects(document)
    unknown = [obj for obj in bare if obj.BT_Type not in KINDS]
    if unknown:
        raise BendTorsionError(
            error(
                "kind-unknown",
                obj.Label,
                "is of a kind this BendTorsion does not have",
                "use the release that saved the document, or delete the object",
                value=obj.BT_Type,
            )
            for obj in unknown
        )
    for obj in bare:
        # Not made anew, which would lay the defaults over what the document has.
        obj.Proxy = object.__new__(KINDS[obj.BT_Type])
    for obj in bare:
        obj.Proxy.onDocumentRestored(obj)
        obj.touch()
    return bare
