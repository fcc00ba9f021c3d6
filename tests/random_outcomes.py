# SPDX-License-Identifier: LGPL-2.1-or-later
"""What becomes of members drawn far beyond what is built: valid solids, or a named finding."""

import signal
import warnings
from dataclasses import dataclass

import numpy as np

from BendTorsionWB.core.axes.axis import fit_axis
from BendTorsionWB.core.axes.frames import surface_frames
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.members.member import Member
from BendTorsionWB.core.members.segment import ALIGN_TO, ALIGNMENTS, TRANSITIONS, Segment
from BendTorsionWB.core.members.volume import skin_volumes
from BendTorsionWB.core.members.zones import section_law
from BendTorsionWB.core.patterns.pattern import develop_plate
from BendTorsionWB.core.plates.plates import Joints, split_plates
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.sections.section_types import channel, i_section, trapezoid
from BendTorsionWB.core.solids import solid_skins
from BendTorsionWB.objects.plate_set import accepted
from BendTorsionWB.shapes import brep

LONGEST = 60
"""Seconds of a processor a member may take."""


@dataclass(frozen=True)
class Outcome:
    """What became of a member. kind: `valid`, the code of the finding that refused it, or
    `unexplained`; plates: how many were made; text: what went wrong."""

    seed: int
    kind: str
    plates: int = 0
    text: str = ""

    @property
    def unexplained(self):
        return self.kind == "unexplained"


def outcome(seed):
    """Make the member of a seed with its plates, solids and one pattern, and judge them."""
    signal.signal(signal.SIGPROF, _too_long)
    signal.setitimer(signal.ITIMER_PROF, LONGEST)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            return _judged(seed)
    except BendTorsionError as problem:
        codes = [finding.code for finding in problem.findings if finding.severity == "error"]
        if not codes or "internal-error" in codes:
            return Outcome(seed, "unexplained", 0, f"refused without a reason: {problem}")
        return Outcome(seed, codes[0], 0, str(problem)[:200])
    except Exception as problem:  # noqa: BLE001 - this is what is looked for
        return Outcome(seed, "unexplained", 0, f"{type(problem).__name__}: {problem}"[:300])
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)


def _too_long(*_):
    raise TimeoutError(f"longer than {LONGEST} s")


def _judged(seed):
    member, joints = drawn_member(seed)
    member.check_bend()
    plates, _ = split_plates(member, joints)
    skins = solid_skins.plate_skins(plates)
    solids = brep.tube_solids([[(p.knots, p.poles) for p in one] for one in skins])
    wrong = []
    for plate, volume, solid in zip(plates, skin_volumes(skins), solids, strict=True):
        refused = accepted(plate, solid.isClosed(), volume)
        if refused:
            wrong.append(refused[0].line())
        elif plate.volume <= 0:
            wrong.append(f"{plate.mark} has a volume of {plate.volume:.6g}")
        elif not solid.isValid():
            wrong.append(f"{plate.mark} is invalid to the kernel")
        elif not solid.isClosed() or len(solid.Solids) != 1:
            wrong.append(f"{plate.mark} is no closed solid")
    flat = develop_plate(plates[seed % len(plates)])
    if not np.isfinite([flat.length, flat.width, flat.area, flat.strain_max]).all():
        wrong.append(f"{flat.mark} has a pattern of no size")
    if wrong:
        return Outcome(seed, "unexplained", len(plates), "; ".join(wrong[:3]))
    return Outcome(seed, "valid", len(plates))


def drawn_member(seed):
    """A member and its joints: surfaces and curves from gentle to tight, sections from slender to
    stout, transitions from steps to long ones. Raises BendTorsionError where a part refuses it."""
    draw = np.random.default_rng([seed, 8])
    kind = str(draw.choice(["ellipsoid", "sphere", "cylinder", "torus", "cone", "plane"]))
    size = float(np.exp(draw.uniform(np.log(3000.0), np.log(60000.0))))
    values = {
        "ellipsoid": {"a": size, "b": 0.75 * size, "c": 0.5 * size},
        "sphere": {"r": size},
        "cylinder": {"r": size},
        "torus": {"R": size, "r": 0.3 * size},
        "cone": {"r": size, "angle": 0.4},
        "plane": {},
    }[kind]
    surface = analytic_surface(kind, values)
    length = float(np.exp(draw.uniform(np.log(1500.0), np.log(30000.0))))
    points = _curve(draw, kind, values, size, length)
    axis = fit_axis("A", points, surface)
    frames = surface_frames(axis, surface, float(draw.choice([0.0, draw.uniform(-3, 3)])))
    count = int(draw.integers(1, 4))
    section = str(draw.choice(["box1", "box2", "i", "channel", "trapezoid"]))
    scale = float(np.exp(draw.uniform(np.log(60.0), np.log(1500.0))))
    cuts = np.sort(draw.uniform(0.0, 1.0, count)) * axis.length
    segments = []
    for k in range(count):
        h, b = scale * draw.uniform(0.5, 1.5, 2)
        t = float(np.exp(draw.uniform(np.log(3.0), np.log(60.0))))
        segments.append(
            Segment(
                _section(section, h, b, t, draw),
                float(cuts[k]) if k else 0.0,
                float(draw.choice([0.0, 0.5, 1.5, 2.5, 10.0])),
                str(draw.choice(ALIGNMENTS)),
                str(draw.choice(ALIGN_TO[:2])) if k else "axis",
                transition=str(draw.choice(TRANSITIONS)),
                stagger=str(draw.choice(["auto", "none"])),
            )
        )
    member = Member(f"R{seed}", frames, section_law(f"R{seed}", segments, axis.length))
    joints = {}
    if draw.uniform() < 0.5:
        face = member.law.strips[int(draw.integers(len(member.law.strips)))].face
        joints[face] = Joints(tuple(np.sort(draw.uniform(0.0, 1.0, 2)).tolist()))
    return member, joints


def _curve(draw, kind, values, size, length):
    """Points (k, 3) near the surface."""
    t = np.linspace(0.0, 1.0, int(draw.integers(3, 12)))
    heading, wave = draw.uniform(-1.4, 1.4), draw.uniform(-0.15, 0.15) * length
    along = length * t
    across = wave * np.sin(np.pi * t * draw.uniform(0.5, 2.0))
    x = along * np.cos(heading) - across * np.sin(heading)
    y = along * np.sin(heading) + across * np.cos(heading)
    if kind == "plane":
        return np.column_stack([x, y, 0 * t])
    if kind in ("cylinder", "cone"):
        radius = size - y * np.tan(values.get("angle", 0.0)) if kind == "cone" else size + 0 * t
        return np.column_stack([radius * np.cos(x / size), radius * np.sin(x / size), y])
    if kind == "torus":
        tube = values["r"]
        reach = size + tube * np.cos(y / tube + 0.7)
        return np.column_stack(
            [reach * np.cos(x / size), reach * np.sin(x / size), tube * np.sin(y / tube + 0.7)]
        )
    half = np.array([values.get(k, size) for k in "abc"])
    u, v = x / size, np.clip(y / size + 0.3, -1.4, 1.4)
    return half * np.column_stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)])


def _section(kind, h, b, t, draw):
    if kind in ("box1", "box2"):
        gap = float(draw.choice([0.0, 2.0]))
        return box("S", kind, h, b, t, 0.8 * t, 1.2 * t, gap1=gap)
    if kind == "trapezoid":
        return trapezoid("S", h, b, float(draw.uniform(0.3, 1.0)) * b, t)
    return {"i": i_section, "channel": channel}[kind]("S", h, b, t)
