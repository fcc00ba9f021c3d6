# SPDX-License-Identifier: LGPL-2.1-or-later
"""How the sides of a diaphragm at a node stand to what they are welded to: dihedral and gap.

Edges of diaphragms are cut square. Where a wall stands askew to the plane, the edge is nearest to
it along the face on the sharp side, and opens along the other by the thickness over the tangent of
the dihedral.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from .node_diaphragm_shape import SAMPLES, Outline, Plane
from .node_faces import OuterFaces

_LEAST = 1e-9


def side_fits(
    plane: Plane,
    faces: OuterFaces,
    outline: Outline,
    thickness: float,
    wall_gap: float,
    others: Mapping[str, Plane],
) -> list[tuple[float, float, str] | None]:
    """Per side of an outline gap, dihedral and open face, None of one that is not welded: the gap,
    mm, in the plane of the diaphragm along its wider face at most; the smaller of the two angles
    between the planes, rad, at least; the face the gap opens to, `up` along the normal of the plane
    or `down`. thickness: mm; wall_gap: mm kept by the nearer face (beside another
    diaphragm by the middle); others: planes of diaphragms by role."""
    fits: list[tuple[float, float, str] | None] = []
    for k, side in enumerate(outline.sides):
        if side is None:
            fits.append(None)
            continue
        if isinstance(side, int):
            a, b = outline.corners[k], outline.corners[(k + 1) % len(outline.corners)]
            _, normals = faces.distance(side, plane.at(a + SAMPLES[:, None] * (b - a)))
        else:
            normals = others[side].normal[None]
        leaning = (normals * plane.normal).sum(axis=1)
        steepest = float(leaning[int(np.argmax(np.abs(leaning)))])
        cosine = abs(steepest)
        dihedral = math.acos(min(cosine, 1.0))
        sine = max(math.sin(dihedral), _LEAST)
        opened = thickness if isinstance(side, int) else 0.5 * thickness
        gap = wall_gap / sine + opened * cosine / sine
        if not isinstance(side, int):
            # The normal of a diaphragm is turned outwards, as those of walls are.
            a, b = outline.corners[k], outline.corners[(k + 1) % len(outline.corners)]
            outwards = (b - a)[1] * plane.x - (b - a)[0] * plane.y
            steepest *= float(np.sign((normals[0] * outwards).sum()))
        fits.append((round(gap, 1), dihedral, "down" if steepest > 0.0 else "up"))
    return fits
