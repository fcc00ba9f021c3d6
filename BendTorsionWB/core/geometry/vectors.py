# SPDX-License-Identifier: LGPL-2.1-or-later
"""Products and lengths of many vectors, faster on small arrays than numpy's own."""

from __future__ import annotations

import numpy as np


def crossed(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """a × b (..., 3)."""
    a0, a1, a2, b0, b1, b2 = (v[..., k] for v in (a, b) for k in range(3))
    found = np.empty(np.broadcast(a, b).shape)
    found[..., 0] = a1 * b2 - a2 * b1
    found[..., 1] = a2 * b0 - a0 * b2
    found[..., 2] = a0 * b1 - a1 * b0
    return found


def lengths(vectors: np.ndarray) -> np.ndarray:
    """Lengths (...) of vectors (..., d)."""
    first = vectors[..., 0]
    squares = first * first
    for k in range(1, vectors.shape[-1]):
        component = vectors[..., k]
        squares += component * component
    return np.sqrt(squares)


def dots(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """a · b (...) of vectors (..., d)."""
    total = a[..., 0] * b[..., 0]
    for k in range(1, a.shape[-1]):
        total = total + a[..., k] * b[..., k]
    return total
