# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far the model of a project is, in steps: twenty for each of its members."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

ASSEMBLED, COMPUTED, STEP, IFC, SAVED = 1, 14, 1, 2, 2
"""Steps of a member that are done when its objects are in the document, computed, and in the files:
about as long as each takes."""
STEPS = ASSEMBLED + COMPUTED + STEP + IFC + SAVED


class ModelProgress:
    """Tells `progress` (a `project.Progress`) how many steps of a number of members are done."""

    def __init__(self, progress: Callable[[str, int, int], None], members: int):
        self._progress, self.done, self.count = progress, 0, STEPS * members
        self._tell()

    def keep(self, members: int) -> None:
        """The files of these members are there: the pace is that of the others."""
        self.count -= STEPS * members

    def add(self, steps: int) -> None:
        """So many steps more are done."""
        self.done += steps
        self._tell()

    @contextmanager
    def part(self, members: int) -> Iterator[None]:
        """All steps of these members are done after the block, those with an error too."""
        end = self.done + STEPS * members
        yield
        self.done = end
        self._tell()

    @contextmanager
    def computing(self, document, members: int) -> Iterator[None]:
        """The objects of a document with these members are computed in the block, each of which is
        told. What the telling raises comes at the end: FreeCAD would swallow it."""
        import FreeCAD

        observer = _Computed(self, document, COMPUTED * members)
        FreeCAD.addDocumentObserver(observer)
        try:
            yield
        finally:
            FreeCAD.removeDocumentObserver(observer)
        if observer.raised:
            raise observer.raised
        self.done = observer.end
        self._tell()

    def finish(self) -> None:
        """All is done, or was there."""
        self.done = self.count = max(self.count, 1)
        self._tell()

    def _tell(self) -> None:
        self._progress("model", self.done, self.count)


class _Computed:
    """Document observer that adds the steps of each object computed."""

    def __init__(self, steps: ModelProgress, document, own: int):
        self._steps, self._name, self._own = steps, document.Name, own
        self._begin, self.end = steps.done, steps.done + own
        self._seen: set[str] = set()
        self.raised: BaseException | None = None

    def slotRecomputedObject(self, obj) -> None:
        """Called by FreeCAD."""
        document = obj.Document
        if self.raised or document.Name != self._name:
            return
        self._seen.add(obj.Name)
        # Objects may make others, as sheets their pages: there is no way back for that.
        done = self._begin + self._own * len(self._seen) // max(len(document.Objects), 1)
        if done <= self._steps.done:
            return
        try:
            self._steps.add(min(done, self.end) - self._steps.done)
        except BaseException as failure:  # noqa: BLE001 - raised when FreeCAD is through
            self.raised = failure
