# SPDX-License-Identifier: LGPL-2.1-or-later
"""Members that pass through each other: near pairs from the axes, then OCC's common volume."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np
from scipy.spatial import cKDTree

from BendTorsionWB.core import tolerances
from BendTorsionWB.core.detailing import MemberGeometry
from BendTorsionWB.core.finding import BETWEEN, Finding, error
from BendTorsionWB.core.nodes.nodes import unresolved
from BendTorsionWB.shapes import brep
from BendTorsionWB.shapes.cut_solid import member_solids

SAMPLE = 200.0
"""Distance of samples on the axes, mm."""


def clashes(
    members: Mapping[str, MemberGeometry], met: Collection[frozenset[str]] = ()
) -> tuple[Finding, ...]:
    """One error for each pair of members whose solids share more than SOLIDS_OVERLAP_VOLUME:
    `node-unresolved` at each place where they cross.

    met: pairs of members that meet at nodes, or were found not to; they are passed over.
    """
    names = list(members)
    axes = {name: _samples(members[name]) for name in names}
    reach = {name: _reach(members[name]) for name in names}
    low = np.array([axes[name].min(axis=0) - reach[name] for name in names]).reshape(-1, 3)
    high = np.array([axes[name].max(axis=0) + reach[name] for name in names]).reshape(-1, 3)
    skins: dict[str, object] = {}
    findings = []
    for i, one in enumerate(names):
        # Most pairs of a building are far apart: boxes tell that for all of them at once.
        near = ((low <= high[i] + SAMPLE) & (high >= low[i] - SAMPLE)).all(axis=1)
        beside = [names[j] for j in np.flatnonzero(near) if j > i]
        tree = cKDTree(axes[one]) if beside else None
        for other in beside:
            if frozenset((one, other)) in met:
                continue
            distance, _ = tree.query(axes[other])
            if distance.min() > reach[one] + reach[other] + SAMPLE:
                continue
            for name in (one, other):
                if name not in skins:
                    skins[name] = _skin(members[name])
            common = skins[one].common(skins[other])
            if common.Volume > tolerances.SOLIDS_OVERLAP_VOLUME:
                crossing = unresolved({name: members[name].member for name in (one, other)})
                findings += crossing.findings or (_pair(one, other, common),)
    return tuple(findings)


def _pair(one: str, other: str, common) -> Finding:
    centre = common.CenterOfMass if hasattr(common, "CenterOfMass") else common.BoundBox.Center
    place = f"x = {centre.x:.0f}, y = {centre.y:.0f}, z = {centre.z:.0f} mm"
    return error(
        "members-intersect",
        BETWEEN.join((one, other)),
        f"the solids of {one} and {other} intersect",
        "give them different ranks or a row of sheet Nodes, or move one of them",
        position=place,
        value=float(common.Volume),
        limit=tolerances.SOLIDS_OVERLAP_VOLUME,
        unit="mm3",
    )


def _samples(geometry: MemberGeometry) -> np.ndarray:
    axis = geometry.member.frames.axis
    return axis.position(np.linspace(0.0, axis.length, int(axis.length / SAMPLE) + 2))


def _reach(geometry: MemberGeometry) -> float:
    """Largest distance of a corner from the axis."""
    corners = [
        corners
        for cell in geometry.member.law.cells
        for corners in cell.corners_at(np.linspace(cell.start, cell.end, 33))
    ]
    return float(np.linalg.norm(np.concatenate(corners), axis=1).max())


def _skin(geometry: MemberGeometry):
    solids = member_solids(geometry)
    return solids[0] if len(solids) == 1 else brep.compound(solids)
