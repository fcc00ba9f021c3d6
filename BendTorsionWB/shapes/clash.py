# SPDX-License-Identifier: LGPL-2.1-or-later
"""Members that pass through each other: near pairs from the axes, then OCC's common volume."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy.spatial import cKDTree

from BendTorsionWB.core import tolerances
from BendTorsionWB.core.detailing import MemberGeometry, member_skins
from BendTorsionWB.core.finding import Finding, error
from BendTorsionWB.shapes import brep

SAMPLE = 200.0
"""Distance of samples on the axes, mm."""


def clashes(members: Mapping[str, MemberGeometry]) -> tuple[Finding, ...]:
    """One error per member of each pair whose solids share more than SOLIDS_OVERLAP_VOLUME."""
    names = list(members)
    axes = {name: _samples(members[name]) for name in names}
    reach = {name: _reach(members[name]) for name in names}
    skins: dict[str, object] = {}
    findings = []
    for i, one in enumerate(names):
        tree = cKDTree(axes[one])
        for other in names[i + 1 :]:
            distance, _ = tree.query(axes[other])
            if distance.min() > reach[one] + reach[other] + SAMPLE:
                continue
            for name in (one, other):
                if name not in skins:
                    skins[name] = _skin(members[name])
            common = skins[one].common(skins[other])
            if common.Volume > tolerances.SOLIDS_OVERLAP_VOLUME:
                findings += _pair(one, other, common)
    return tuple(findings)


def _pair(one: str, other: str, common) -> list[Finding]:
    centre = common.CenterOfMass if hasattr(common, "CenterOfMass") else common.BoundBox.Center
    place = f"x = {centre.x:.0f}, y = {centre.y:.0f}, z = {centre.z:.0f} mm"
    return [
        error(
            "members-intersect",
            name,
            f"the solids of {name} and {with_} intersect",
            "move one of them; cut members at their nodes is not supported yet",
            position=place,
            value=float(common.Volume),
            limit=tolerances.SOLIDS_OVERLAP_VOLUME,
            unit="mm3",
        )
        for name, with_ in ((one, other), (other, one))
    ]


def _samples(geometry: MemberGeometry) -> np.ndarray:
    axis = geometry.member.frames.axis
    return axis.position(np.linspace(0.0, axis.length, int(axis.length / SAMPLE) + 2))


def _reach(geometry: MemberGeometry) -> float:
    """Largest distance of a corner from the axis."""
    corners = [
        corners
        for cell in geometry.member.law.cells
        for corners in cell.corners_at(np.array([cell.start, cell.end]))
    ]
    return float(np.linalg.norm(np.concatenate(corners), axis=1).max())


def _skin(geometry: MemberGeometry):
    tubes = [[(p.knots, p.poles) for p in tube] for tube in member_skins(geometry).tubes]
    solids = brep.tube_solids(tubes)
    return solids[0] if len(solids) == 1 else brep.compound(solids)
