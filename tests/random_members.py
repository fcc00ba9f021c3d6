# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random members for tests and benchmarks: curves, sections, transitions and alignments by seed."""

from functools import lru_cache

import numpy as np
from curved_members import ELLIPSOID, diagonal, irregular, oblique, on_torus

from BendTorsionWB.core.axes.axis import fit_axis
from BendTorsionWB.core.axes.frames import surface_frames
from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.members.member import Member
from BendTorsionWB.core.members.segment import ALIGNMENTS, TRANSITIONS, Segment
from BendTorsionWB.core.members.zones import section_law
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.sections.section_types import channel, i_section, trapezoid

TORUS = analytic_surface("torus", {"R": 30000.0, "r": 8000.0})
CURVES = ((diagonal, ELLIPSOID), (oblique, ELLIPSOID), (on_torus, TORUS))


@lru_cache
def frames(curve, points):
    """Frames along one of CURVES through a number of points."""
    made, surface = CURVES[curve]
    return surface_frames(fit_axis("A1", irregular(made, points), surface), surface)


def random_member(seed, changes=False):
    """A member of one to three segments; with changes of thickness per face, of two or three."""
    draw = np.random.default_rng(seed)
    own = frames(int(draw.integers(len(CURVES))), int(draw.integers(7, 14)))
    kind = ["box1", "box2", "i", "channel", "trapezoid"][draw.integers(5)]
    count = int(draw.integers(2, 4) if changes else draw.integers(1, 4))
    length = own.axis.length
    cuts = length * (np.arange(count) + draw.uniform(0, 0.4, count)) / count
    segments = []
    for k in range(count):
        h, b = draw.uniform(300, 900, 2).round()
        t = float(draw.integers(8, 33))
        segments.append(
            Segment(
                _section(kind, h, b, t, draw if changes else None),
                float(cuts[k]) if k else 0.0,
                float(draw.choice([1.5, 2.5, 4.0])),
                str(draw.choice(ALIGNMENTS)),
                str(draw.choice(["axis", "previous"])) if k else "axis",
                transition=str(draw.choice(TRANSITIONS)),
            )
        )
    return Member(f"R{seed}", own, section_law(f"R{seed}", segments, length))


def _section(kind, h, b, t, draw=None):
    if draw is not None:
        t_bottom, t_web = (float(draw.integers(8, 33)) for _ in range(2))
        if kind in ("box1", "box2"):
            return box("S", kind, h, b, t, t_bottom, t_web, gap1=2.0)
        if kind in ("i", "channel"):
            return (i_section if kind == "i" else channel)("S", h, b, t, t_bottom, t_web)
    if kind in ("box1", "box2"):
        return box("S", kind, h, b, t, gap1=2.0)
    if kind == "trapezoid":
        return trapezoid("S", h, b, 0.7 * b, t)
    return (i_section if kind == "i" else channel)("S", h, b, t)
