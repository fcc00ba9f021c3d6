# SPDX-License-Identifier: LGPL-2.1-or-later
"""The plate solids of a document as STEP and IFC files: named by mark, coloured, by piece."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from BendTorsionWB import __version__
from BendTorsionWB.core.colour_scale import Colour, face_colour
from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.core.site import SiteDatum
from BendTorsionWB.exchange.ifc import Assembly, PlateSolid, ifc_bytes
from BendTorsionWB.exchange.step_colours import coloured_step
from BendTorsionWB.exchange.timeless import timeless_step
from BendTorsionWB.exchange.whole_file import whole_file, write_whole
from BendTorsionWB.interrupts import to_the_end


@dataclass(frozen=True)
class NamedSolid:
    """A plate's solid with its position mark, delivery piece and colour."""

    mark: str
    piece: int
    colour: Colour
    solid: object


def plate_sets(document) -> list:
    """The PlateSets of a document that belong to a member."""
    # Links pass on the properties of what they show.
    return [
        obj
        for obj in document.Objects
        if getattr(obj, "BT_Type", "") == "PlateSet" and obj.Member is not None
        if not obj.TypeId.startswith("App::Link")
    ]


def write_step(document, members: Sequence[str], path: Path) -> None:
    """STEP of the members' plates: an assembly per member, in it one per piece where it has
    several, in that a named and coloured solid per plate. Raises BendTorsionError naming a member
    in error."""
    sets = _healthy_sets(document, members)
    software = f"BendTorsion {__version__}"
    with whole_file(path) as part, _assemblies(sets) as items, to_the_end():
        import Import

        Import.export(items, str(part))
        colours = {one.mark: one.colour for obj in sets for one in named_solids(obj)}
        written = part.read_bytes()
        # FreeCAD does not tell when the disk is full.
        if not written.rstrip().endswith(b"END-ISO-10303-21;"):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        content = timeless_step(written, path.name, software)
        part.write_bytes(coloured_step(content, colours))


def write_ifc(
    document,
    members: Sequence[str],
    records: Mapping[str, MemberRecord],
    site: SiteDatum,
    project: str,
    path: Path,
) -> None:
    """IFC4 of the members' plates, an assembly per delivery piece; records: of the members.
    Raises BendTorsionError naming a member in error, or a plate whose solid is not one shell."""
    from BendTorsionWB.shapes.boundary_of import boundary_of

    assemblies = []
    for obj in _healthy_sets(document, members):
        name = obj.Member.Label
        plates = {plate.mark: plate for plate in records[name].plates}
        for piece, own in _by_piece(named_solids(obj)).items():
            solids = tuple(
                PlateSolid(plates[one.mark], boundary_of(one.solid, one.mark), one.colour)
                for one in own
                if one.mark in plates
            )
            mark = name if len(obj.Pieces) < 2 else f"{name}-P{piece}"
            assemblies.append(Assembly(mark, name, solids))
    write_whole(path, ifc_bytes(project, assemblies, site, __version__))


def named_solids(plates) -> list[NamedSolid]:
    """The solids of a PlateSet, coloured as in its view, else by face."""
    marks = list(plates.Marks)
    colours = [tuple(colour[:3]) for colour in plates.Colours]
    if len(colours) != len(marks):
        colours = [face_colour(_letter(mark)) for mark in marks]
    return [
        NamedSolid(*given)
        for given in zip(marks, plates.MarkPieces, colours, plates.Shape.Solids, strict=True)
    ]


def _letter(mark: str) -> str:
    """`T` of `M12-T3`."""
    return mark.rsplit("-", 1)[-1].rstrip("0123456789")


def _healthy_sets(document, members: Sequence[str]) -> list:
    wanted = set(members)
    sets = [obj for obj in plate_sets(document) if obj.Member.Label in wanted]
    refused = [obj for obj in sets if obj.Status != "ok"]
    if refused:
        raise BendTorsionError(
            error("export-refused", obj.Label, "is in error and is not exported", "mend it first")
            for obj in refused
        )
    return sets


def _by_piece(solids: Sequence[NamedSolid]) -> dict[int, list[NamedSolid]]:
    pieces: dict[int, list[NamedSolid]] = {}
    for one in solids:
        pieces.setdefault(one.piece, []).append(one)
    return pieces


@contextmanager
def _assemblies(sets: Sequence) -> Iterator[list]:
    """The PlateSets as assemblies for export, in a document of their own."""
    import FreeCAD

    document = FreeCAD.newDocument("assemblies", hidden=True)
    document.Label = "Model"

    def part(label: str):
        made = document.addObject("App::Part", "Assembly")
        made.Label = label
        return made

    try:
        items = []
        for obj in sets:
            whole = part(obj.Member.Label)
            for piece, own in _by_piece(named_solids(obj)).items():
                group = whole
                if len(obj.Pieces) > 1:
                    group = part(f"{obj.Member.Label}-P{piece}")
                    whole.addObject(group)
                for one in own:
                    plate = document.addObject("Part::Feature", "Plate")
                    plate.Label, plate.Shape = one.mark, one.solid
                    group.addObject(plate)
            items.append(whole)
        document.recompute()
        yield items
    finally:
        FreeCAD.closeDocument(document.Name)
