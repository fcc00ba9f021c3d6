# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pickled results unpacked: of a member a thousand arrays, which take most of the time."""

from __future__ import annotations

import io
import pickle

import numpy as np

from .collection import without_collection

ARRAY = "_frombuffer"
"""What numpy makes arrays by."""


def array_of(content, kind: np.dtype, shape: tuple[int, ...], order: str) -> np.ndarray:
    """As numpy's own does it, in one step. Raises UnpicklingError for arrays of objects."""
    if kind.hasobject:
        raise pickle.UnpicklingError("objects have no place in an array")
    return np.ndarray(shape, kind, content, 0, None, order)


def unpacked(packed: bytes) -> object:
    """What a process of ours pickled, unpacked without the collector's walk through it."""
    with without_collection():
        return _Unpickler(io.BytesIO(packed)).load()


class _Unpickler(pickle.Unpickler):
    def find_class(self, module: str, name: str):
        return array_of if name == ARRAY else super().find_class(module, name)
