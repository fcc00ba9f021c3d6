# SPDX-License-Identifier: LGPL-2.1-or-later
"""The plate solids of a document as STEP and IFC files: named by mark, coloured, by piece."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from pathlib import Path

from BendTorsionWB import __version__
from BendTorsionWB.core.colour_scale import face_colour
from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.core.site import SiteDatum
from BendTorsionWB.exchange.ifc import ifc_file
from BendTorsionWB.exchange.ifc_fragment import IfcFragment
from BendTorsionWB.exchange.output_folder import OutputFolder
from BendTorsionWB.exchange.result_cache import ResultCache, key_of
from BendTorsionWB.exchange.step_fragment import SolidName, step_file
from BendTorsionWB.exchange.whole_file import whole_file
from BendTorsionWB.ifc_fragments import NamedSolid, member_fragment
from BendTorsionWB.model_progress import IFC, STEP
from BendTorsionWB.shapes.brep import as_built
from BendTorsionWB.step_fragments import MemberSolids, StepFragments, member_solids


def _nobody(steps: int) -> None:
    """Nobody is told how far it is."""


def plate_sets(document) -> list:
    """The PlateSets of a document that belong to a member."""
    # Links pass on the properties of what they show.
    return [
        obj
        for obj in document.Objects
        if getattr(obj, "BT_Type", "") == "PlateSet" and obj.Member is not None
        if not obj.TypeId.startswith("App::Link")
    ]


def write_step(
    document, members: Sequence[str], path: Path, executor: Executor | None = None
) -> None:
    """STEP of the members' plates: an assembly per member, in it one per piece where it has
    several, in that a named and coloured solid per plate. Raises BendTorsionError naming a member
    in error."""
    _write_fragments(StepFragments(_solids_of(document, members), None, executor), path)


class StepFiles:
    """STEP files of a folder. Their members are made by the executor, if it can, while other work
    goes on, and kept in the cache, where there is one."""

    def __init__(self, folder: OutputFolder, cache: ResultCache | None, executor: Executor | None):
        self._folder, self.cache, self._executor = folder, cache, executor
        self._under_way: list[tuple[str, str, StepFragments]] = []

    def start(
        self,
        document,
        members: Sequence[str],
        name: str,
        made_from: str,
        done: Callable[[int], None] = _nobody,
    ) -> dict[str, str]:
        """Begin a file of these members as they are in a document now; hashes of their solids and
        marks, by member. done: told the steps of each. Raises as `write_step`."""
        contents: dict[str, str] = {}

        def given() -> Iterator[MemberSolids]:
            for solids in _solids_of(document, members):
                if self.cache:
                    marks = [own.mark for own in solids.names]
                    contents[solids.member] = key_of(solids.content, marks)
                yield solids
                done(STEP)

        fragments = StepFragments(given(), self.cache, self._executor)
        self._under_way.append((name, made_from, fragments))
        return contents

    def write(self, wait: bool = False) -> None:
        """Write what was begun, in that order; without waiting what is ready only."""
        while self._under_way and (wait or self._under_way[0][2].are_there()):
            name, made_from, fragments = self._under_way.pop(0)
            self._folder.begin(name)
            _write_fragments(fragments, self._folder.out / name)
            self._folder.wrote(name, made_from)


def _write_fragments(fragments: StepFragments, path: Path) -> None:
    with whole_file(path) as part, open(part, "wb") as stream:
        for text in step_file(path.name, f"BendTorsion {__version__}", fragments):
            stream.write(text)


def _solids_of(document, members: Sequence[str]) -> Iterator[MemberSolids]:
    for obj in _healthy_sets(document, members):
        own, member = named_solids(obj), obj.Member.Label
        several = len(obj.Pieces) > 1
        names = [
            SolidName(one.mark, f"{member}-P{one.piece}" if several else "", one.colour)
            for one in own
        ]
        yield member_solids(member, names, [one.solid for one in own])


def write_ifc(
    document,
    members: Sequence[str],
    records: Mapping[str, MemberRecord],
    site: SiteDatum,
    project: str,
    path: Path,
    cache: ResultCache | None = None,
    contents: Mapping[str, str] | None = None,
    done: Callable[[int], None] = _nobody,
) -> None:
    """IFC4 of the members' plates, an assembly per delivery piece; records: of the members; cache:
    where what they give to the file is kept; contents and done: as of `StepFiles.start`.
    Raises BendTorsionError naming a member in error, or a plate whose solid is not one shell."""
    sets = _healthy_sets(document, members)

    def fragments() -> Iterator[IfcFragment]:
        for obj in sets:
            name = obj.Member.Label
            solids = {
                name if len(obj.Pieces) < 2 else f"{name}-P{piece}": own
                for piece, own in _by_piece(named_solids(obj)).items()
            }
            plates = {plate.mark: plate for plate in records[name].plates}
            content = (contents or {}).get(name, "")
            yield member_fragment(project, name, solids, plates, cache, content)
            done(IFC)

    with whole_file(path) as part, open(part, "wb") as stream:
        for text in ifc_file(project, fragments(), site, __version__):
            stream.write(text)


def named_solids(plates) -> list[NamedSolid]:
    """The solids of a PlateSet, coloured as in its view, else by face."""
    marks = list(plates.Marks)
    colours = [tuple(colour[:3]) for colour in plates.Colours]
    if len(colours) != len(marks):
        colours = [face_colour(_letter(mark)) for mark in marks]
    solids = as_built(plates.Shape).Solids
    return [
        NamedSolid(*given) for given in zip(marks, plates.MarkPieces, colours, solids, strict=True)
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
