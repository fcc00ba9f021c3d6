# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rigid motions (and mirrors) as 4×4 matrices."""

from __future__ import annotations

import numpy as np


def moved(frame: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Points (n, 3) by a matrix (4, 4)."""
    points = np.atleast_2d(np.asarray(points, float))
    # Not by BLAS: the same input must give the same bytes.
    return (points[:, None, :] * frame[None, :3, :3]).sum(axis=2) + frame[:3, 3]


def inverse(frame: np.ndarray) -> np.ndarray:
    """The matrix back of a rotation or mirror with a shift (4, 4)."""
    back = np.eye(4)
    back[:3, :3] = frame[:3, :3].T
    back[:3, 3] = -(back[:3, :3] * frame[:3, 3]).sum(axis=1)
    return back
