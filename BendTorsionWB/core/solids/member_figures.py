# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is reported of a member beside its plates: torsion error, wireframe, plates beyond stock."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..axes.frames import wanted_z
from ..axes.frames_minimal import turned
from ..finding import Finding, warning
from ..joints.stock import StockSheet, longest, sheets_for, smallest_for
from ..lofting import DevelopedPlate
from ..members.member import Member
from ..plates.plates import JointRules
from ..stages import MemberGeometry
from .cut_skin import cut_corner_lines
from .solid_skins import corner_tubes


def beyond_stock(plate: DevelopedPlate, rules: JointRules | None) -> list[Finding]:
    """Warnings for a pattern longer or wider than the stock: as cut, than every sheet the schedule
    gives; without one, than the stock of the rules."""
    if rules is None:
        return []
    size, limits = plate, StockSheet(rules.longest_piece, rules.widest_piece)
    sheets = sheets_for(rules.stock, plate.thickness, plate.material)
    if sheets:
        size = plate.gross or plate
        if smallest_for(sheets, size.length, size.width):
            return []
        limits = longest([s for s in sheets if size.width <= s.width] or sheets)
        if size.length <= limits.length:
            limits = max(sheets, key=lambda sheet: sheet.width)
    return [
        warning(
            "beyond-stock",
            plate.mark,
            f"the pattern is {what} than the stock",
            mend,
            value=own,
            limit=limit,
            unit="mm",
        )
        for what, own, limit, mend in (
            ("longer", size.length, limits.length, "give it a joint, or order longer stock"),
            ("wider", size.width, limits.width, "give it a joint, or order wider stock"),
        )
        if own > limit
    ]


def with_stock(plate: DevelopedPlate, rules: JointRules | None) -> DevelopedPlate:
    """The plate with the smallest sheet of the schedule's stock it can be cut from."""
    sheets = sheets_for(rules.stock, plate.thickness, plate.material) if rules else ()
    size = plate.gross or plate
    sheet = smallest_for(sheets, size.length, size.width)
    return plate if sheet is None else replace(plate, stock=(sheet.length, sheet.width))


def torsion_error(geometry: MemberGeometry) -> float:
    """Largest angle, rad, between the section as built and as the surface normal asks for.

    Built: the direction between the two outermost corners, read off the skin's splines at four
    times the stations. Asked: the z axis of the frame wanted (the surface normal at the axis minus
    its tangent part, turned by the roll), worked out afresh.
    """
    member = geometry.member
    worst = 0.0
    for tube in corner_tubes(member):
        for piece in tube:
            start, end = piece.knots[0], piece.knots[-1]
            s = np.linspace(start, end, 4 * (piece.poles.shape[1] - 3) + 1)
            built = piece.at(s)
            i, j = _farthest(built[0])
            direction = built[:, j] - built[:, i]
            direction /= np.linalg.norm(direction, axis=1, keepdims=True)
            x = member.frames.axis.tangent(s)
            z = wanted_z(member.frames.axis, geometry.surface, geometry.frame, s)
            if member.rolled is not None:
                z = turned(z, x, member.rolled(s)[:, 0])
            y = np.cross(z, x)
            cell = next(c for c in member.law.cells if c.start <= start < c.end)
            plane = cell.corners_at(s)
            asked = plane[:, j] - plane[:, i]
            asked /= np.linalg.norm(asked, axis=1, keepdims=True)
            asked = asked[:, :1] * y + asked[:, 1:] * z
            angle = 2.0 * np.arcsin(0.5 * np.linalg.norm(direction - asked, axis=1).clip(0, 2))
            worst = max(worst, float(angle.max()))
    return worst


def _farthest(corners: np.ndarray) -> tuple[int, int]:
    distance = np.linalg.norm(corners[:, None] - corners[None, :], axis=2)
    i, j = np.unravel_index(int(np.argmax(distance)), distance.shape)
    return int(i), int(j)


def wireframe(member: Member, spacing: float = 250.0) -> dict[str, np.ndarray]:
    """Polylines for overview drawings: axis, corner lines by name."""
    count = max(8, int(np.ceil(member.length / spacing)))
    s = np.unique(
        np.concatenate(
            [np.linspace(0.0, member.length, count + 1), [cell.start for cell in member.law.cells]]
        )
    )
    corners = member.corners(*member.reach)
    both = np.concatenate([corners(s, "earlier")[:, None], corners(s)[:, None]], axis=1)
    both[0, 0] = both[0, 1]
    lines = both.reshape(2 * len(s), -1, 3)
    if member.ends != (None, None):
        lines = cut_corner_lines(member, corners, np.repeat(s, 2))
    names = member.law.sections[0].corner_names
    frame = {name: lines[:, k] for k, name in enumerate(names)}
    frame["axis"] = member.frames.axis.position(s)
    return frame
