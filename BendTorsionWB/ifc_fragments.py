# SPDX-License-Identifier: LGPL-2.1-or-later
"""What each member gives to the IFC file of its model, kept, so that a change of one member does
not make those of all others again."""

from __future__ import annotations

import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256

from BendTorsionWB.core.colour_scale import Colour
from BendTorsionWB.core.lofting import DevelopedPlate
from BendTorsionWB.exchange.ifc import project_name
from BendTorsionWB.exchange.ifc_entities import Entities
from BendTorsionWB.exchange.ifc_fragment import (
    Assembly,
    IfcFragment,
    PlateSolid,
    ifc_fragment,
    plate_facts,
)
from BendTorsionWB.exchange.result_cache import ResultCache, key_of
from BendTorsionWB.exchange.whole_file import in_temporary_folder
from BendTorsionWB.interrupts import to_the_end


@dataclass(frozen=True)
class NamedSolid:
    """A plate's solid with its position mark, delivery piece and colour."""

    mark: str
    piece: int
    colour: Colour
    solid: object


def kept_key(member: str) -> str:
    """The key of the one fragment of a member that is kept, with a hash of what it is of."""
    return key_of("ifc", member)


def member_fragment(
    project: str,
    member: str,
    solids: Mapping[str, Sequence[NamedSolid]],
    plates: Mapping[str, DevelopedPlate],
    cache: ResultCache | None = None,
    content: str = "",
) -> IfcFragment:
    """The fragment of a member. solids: by the mark of their assembly; plates: its, by mark;
    content: hash of the solids to the bit and whose they are, where it was taken before. Raises
    BendTorsionError naming a plate whose solid is not one shell, and where the disk is full."""
    project = project_name(project)
    solids = {mark: [o for o in own if o.mark in plates] for mark, own in solids.items()}
    if cache is None:
        return _made(project, member, solids, plates)
    made_from = _made_from(project, member, solids, plates, content)
    kept = cache.find_plain(kept_key(member))
    if kept is not None and kept[0] == made_from:
        return _read(*kept[1:])
    made = _made(project, member, solids, plates)
    cache.keep_plain(kept_key(member), (made_from, *_plain(made)))
    return made


def _made(project, member, solids, plates) -> IfcFragment:
    from BendTorsionWB.shapes.boundary_of import boundary_of

    return ifc_fragment(
        project,
        [
            Assembly(
                mark,
                member,
                tuple(
                    PlateSolid(plates[one.mark], boundary_of(one.solid, one.mark), one.colour)
                    for one in own
                ),
            )
            for mark, own in solids.items()
        ],
    )


def _made_from(project, member, solids, plates, content) -> str:
    """A hash of all that a fragment tells."""
    from BendTorsionWB.shapes.step_text import kernel, solids_as_bytes

    every = [(mark, one) for mark, own in solids.items() for one in own]
    with in_temporary_folder(), to_the_end():
        if not content:
            content = sha256(solids_as_bytes([one.solid for _, one in every])).hexdigest()
        made_by = kernel()
    told = [
        (mark, one.mark, one.colour, plates[one.mark].material, plate_facts(plates[one.mark]))
        for mark, one in every
    ]
    return key_of(made_by, project, member, list(solids), told, content)


def _plain(made: IfcFragment) -> tuple:
    own = made.entities
    text = zlib.compress(own.text.encode("ascii"), 1)
    return own.counts, text, own.references, made.assemblies, made.plates


def _read(counts, text, references, assemblies, plates) -> IfcFragment:
    entities = Entities(counts, zlib.decompress(text).decode("ascii"), references)
    return IfcFragment(entities, assemblies, plates)
