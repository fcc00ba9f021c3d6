# SPDX-License-Identifier: LGPL-2.1-or-later
"""Many small records of one kind kept as columns, and made when they are looked at."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Columns(Sequence):
    """Records of a kind of dataclass: per field, in its order, an array (n, …) or a tuple (n).

    A few arrays are made, sent between processes and kept in the cache of results in place of
    several per record. Numbers come out as Python's.
    """

    kind: type
    columns: tuple[np.ndarray | tuple, ...]

    def __len__(self) -> int:
        return len(self.columns[0])

    def __iter__(self) -> Iterator:
        return map(self.kind, *self._plain(slice(None)))

    def __getitem__(self, at):
        if isinstance(at, slice):
            return tuple(map(self.kind, *self._plain(at)))
        return self.kind(*(column[0] for column in self._plain(slice(at, at + 1 or None))))

    def _plain(self, at: slice) -> list:
        return [
            column[at].tolist() if getattr(column, "ndim", 0) == 1 else column[at]
            for column in self.columns
        ]
