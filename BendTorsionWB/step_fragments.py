# SPDX-License-Identifier: LGPL-2.1-or-later
"""What each member gives to the STEP file of its model: made by workers, and kept, so that a change
of one member does not make those of all others again."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from concurrent.futures import Executor, Future
from dataclasses import astuple, dataclass
from functools import cached_property, partial
from hashlib import sha256

from BendTorsionWB import freecad_path
from BendTorsionWB.core.parallel import Workers, done_or
from BendTorsionWB.exchange.result_cache import ResultCache, key_of
from BendTorsionWB.exchange.step_fragment import SolidName, StepFragment, fragment_of_solids
from BendTorsionWB.exchange.whole_file import in_temporary_folder
from BendTorsionWB.interrupts import to_the_end


@dataclass(frozen=True)
class MemberSolids:
    """A member's solids, as `solids_as_bytes` gives them, and what they are called."""

    member: str
    names: tuple[SolidName, ...]
    solids: bytes

    @cached_property
    def content(self) -> str:
        """Hash of the solids to the bit."""
        return sha256(self.solids).hexdigest()


def member_solids(member: str, names: Iterable[SolidName], solids: Iterable) -> MemberSolids:
    """Of Part solids, in the order of `names`. Raises BendTorsionError where the disk is full."""
    from BendTorsionWB.shapes.step_text import solids_as_bytes

    with in_temporary_folder(), to_the_end():
        return MemberSolids(member, tuple(names), solids_as_bytes(list(solids)))


def made_fragment(given: MemberSolids) -> StepFragment:
    """Make the fragment of a member. Raises BendTorsionError where the disk is full, and as
    `fragment_of_solids`."""
    # A worker that was not forked has yet to find FreeCAD.
    freecad_path.append()
    from BendTorsionWB.shapes.step_text import step_text

    with in_temporary_folder(), to_the_end():
        written = step_text(given.solids)
    return fragment_of_solids(written, given.member, given.names)


def kept_key(member: str) -> str:
    """The key of the one fragment of a member that is kept, with a hash of what it is of."""
    return key_of("step", member)


@dataclass(frozen=True)
class _UnderWay:
    """A fragment that a worker makes."""

    given: MemberSolids
    made_from: str
    future: Future


class StepFragments:
    """Fragments of members, in their order: kept, made here, or being made by workers. members:
    gone through once. Raises as `made_fragment`."""

    def __init__(
        self,
        members: Iterable[MemberSolids],
        cache: ResultCache | None = None,
        executor: Executor | None = None,
    ):
        self._cache = cache
        # Processes of others may have no FreeCAD, or another kernel.
        self._workers = executor if isinstance(executor, Workers) and not _in_window() else None
        self._all = [self._started(given) for given in members]

    def are_there(self) -> bool:
        """Whether none has to be waited for."""
        return all(own.future.done() for own in self._all if isinstance(own, _UnderWay))

    def __iter__(self) -> Iterator[StepFragment]:
        for own in self._all:
            yield self._done(own) if isinstance(own, _UnderWay) else own

    def _started(self, given: MemberSolids) -> StepFragment | _UnderWay:
        made_from = ""
        if self._cache:
            made_from = _made_from(given)
            kept = self._cache.find_plain(kept_key(given.member))
            if kept is not None and kept[0] == made_from:
                return StepFragment(*kept[1:])
        if self._workers is None:
            return self._keep(made_from, made_fragment(given))
        return _UnderWay(given, made_from, self._workers.submit(made_fragment, given))

    def _done(self, own: _UnderWay) -> StepFragment:
        made = done_or(own.future, partial(made_fragment, own.given))
        return self._keep(own.made_from, made)

    def _keep(self, made_from: str, made: StepFragment) -> StepFragment:
        if self._cache:
            self._cache.keep_plain(kept_key(made.name), (made_from, *astuple(made)))
        return made


def _made_from(given: MemberSolids) -> str:
    from BendTorsionWB.shapes.step_text import kernel

    with in_temporary_folder(), to_the_end():
        return key_of(kernel(), given.member, given.names, given.content)


def _in_window() -> bool:
    """Whether this is FreeCAD's window, whose process is not to be forked."""
    import FreeCAD

    return bool(FreeCAD.GuiUp)
