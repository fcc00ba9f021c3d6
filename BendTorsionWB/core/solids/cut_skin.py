# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is seen from outside of a member whose ends are cut."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ..geometry.piecewise import Piecewise
from ..joints.lanes import WHOLE
from ..members.contour import fibre_cuts
from ..members.contour_measure import area_beyond, trimmed_figures
from ..members.member import Member, MemberEnd, MemberGap
from ..members.skin import SkinPiece
from ..plates.bodies import bodies
from .mass import painted_areas, skin_area


def cut_skin_area(member: Member, tubes: Sequence[Sequence[SkinPiece]]) -> float:
    """Area, mm2, as `mass.skin_area`, of a member with cut ends; tubes: its skin, which reaches
    beyond them."""
    section = member.law.sections[0]
    if section.closed:
        taken = sum(_taken(member, gap) for gap in member.gaps)
        return skin_area(member.law, tubes) - sum(_beyond(member, k) for k in (0, 1)) - taken
    spans = [
        (k, a, b)
        for k in range(len(member.law.strips))
        for a, b in pairwise([0.0, *member.law.joints_of(k), member.length])
        if all((a, b) != (gap.start, gap.end) for gap in member.gaps)
    ]
    made = bodies(member, spans, {k: WHOLE for k, *_ in spans})
    figures = [trimmed_figures(body.uncut or body.rails, body.cuts) for body in made]
    return sum(painted_areas(section, [k for k, *_ in spans], figures))


def _taken(member: Member, gap: MemberGap) -> float:
    """Area, mm2, of the outer skin a node takes."""
    middle = 0.5 * (gap.start + gap.end)
    area = 0.0
    for which, end in ((1, gap.before), (0, gap.behind)):
        if end is not None:
            both = gap.before is not None and gap.behind is not None
            far = middle if both else (0.0, member.length)[which]
            area += _area_beyond(member, end, which, far)
    return area


def _beyond(member: Member, which: int) -> float:
    """Area, mm2, of the outer skin beyond the start (0) or the end (1)."""
    end = member.ends[which]
    if end is None:
        return 0.0
    return _area_beyond(member, end, which, member.reach[which])


def _area_beyond(member: Member, end: MemberEnd, which: int, far: float) -> float:
    """Area, mm2, of the outer skin from an end's cut to a place beyond it."""
    lines = member.corners(*sorted((far, end.reach[1 - which])))
    corners = np.moveaxis(lines.values.reshape(*lines.values.shape[:2], -1, 3), 2, 0)
    sides = np.concatenate([corners, np.roll(corners, -1, axis=0)], axis=3)
    return sum(area_beyond(Piecewise(lines.breaks, side), end.surface, which) for side in sides)


def cut_corner_lines(member: Member, corners: Piecewise, s: np.ndarray) -> np.ndarray:
    """Points (n, m, 3) of the corner lines at arc lengths s (n,), as far as the cut ends; corners:
    the lines, which reach beyond them. Steps of the section are taken at their later side."""
    lines = corners.values.reshape(*corners.values.shape[:2], -1, 3)
    points = []
    for own in np.moveaxis(lines, 2, 0):
        line = Piecewise(corners.breaks, np.concatenate([own, own], axis=2))
        first, last = 0.0, member.length
        for k, end in enumerate(member.ends):
            if end is not None:
                low, high = sorted((member.reach[k], end.reach[1 - k]))
                place = fibre_cuts(
                    line, end.surface, np.zeros(1), np.array([low]), np.array([high])
                )
                first, last = (place[0], last) if k == 0 else (first, place[0])
        # The ends of the cut lines take the place of the member's own.
        at = s.clip(first, last)
        at = np.where(s == s[0], first, np.where(s == s[-1], last, at))
        points.append(line(at)[:, :3])
    return np.stack(points, axis=1)
