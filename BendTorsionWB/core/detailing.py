# SPDX-License-Identifier: LGPL-2.1-or-later
"""The arrows of the pipeline, each a memoised pure function of frozen values.

surface, points -> axis -> member -> plates -> lofting record. Document objects and the command
line call these and nothing below them.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from . import tolerances
from .axis import Axis, axis_from_curve, fit_axis
from .curve import Curve
from .finding import Finding, error, warning
from .frames import surface_frames, torsion_angle
from .lofting import MemberRecord
from .member import Member
from .memo import memoised, remember
from .pattern import develop_plate
from .plates import JointRules, Joints, Plate, split_plates
from .skin import SkinPiece, skin
from .surface import Surface
from .zones import Segment, section_law


@dataclass(frozen=True, eq=False)
class AxisInput:
    """What an axis is made from: ordered points (k, 3), or an exact curve used as it is."""

    name: str
    points: np.ndarray | None = None
    curve: Curve | None = None
    fit: str = "pull"
    tolerance: float = tolerances.AXIS_ON_SURFACE
    max_spacing: float | None = None


@dataclass(frozen=True)
class MemberInput:
    """What a member is made from, its axis and surface apart. roll in radians."""

    name: str
    segments: tuple[Segment, ...]
    offset_y: float = 0.0
    offset_z: float = 0.0
    roll: float = 0.0
    transition_length: str = "face"


@dataclass(frozen=True)
class PlatesInput:
    """Joints per face, spacing of measuring lines and the rules joints are checked by."""

    joints: dict[str, Joints] = field(default_factory=dict)
    station_spacing: float = 500.0
    rules: JointRules | None = None


@dataclass(frozen=True, eq=False)
class MemberGeometry:
    """A member with the surface it came from and what was found on the way."""

    member: Member
    surface: Surface
    roll: float
    findings: tuple[Finding, ...]


@dataclass(frozen=True, eq=False)
class PlateGeometry:
    """A plate and the skin its solid is written from."""

    plate: Plate
    skin: tuple[SkinPiece, ...]


@dataclass(frozen=True, eq=False)
class MemberPlates:
    """All plates of a member."""

    geometry: MemberGeometry
    plates: tuple[PlateGeometry, ...]
    findings: tuple[Finding, ...]


@dataclass(frozen=True, eq=False)
class Skins:
    """Tubes of a member's outer skin, each a tuple of pieces."""

    tubes: tuple[tuple[SkinPiece, ...], ...]


@memoised
def axis_of(given: AxisInput, surface: Surface | None) -> Axis:
    """The axis; raises BendTorsionError as fit_axis does."""
    if given.curve is not None:
        return axis_from_curve(given.name, given.curve)
    return fit_axis(
        given.name, given.points, surface, given.fit, given.tolerance, given.max_spacing
    )


@memoised
def member_of(given: MemberInput, axis: Axis, surface: Surface) -> MemberGeometry:
    """Frames and section law; raises BendTorsionError for what cannot be built."""
    frames = surface_frames(axis, surface, given.roll)
    law = section_law(
        given.name,
        given.segments,
        axis.length,
        given.offset_y,
        given.offset_z,
        given.transition_length,
    )
    member = Member(given.name, frames, law)
    member.check_bend()
    return MemberGeometry(member, surface, given.roll, (*axis.findings, *law.findings))


@memoised
def plates_of(geometry: MemberGeometry, given: PlatesInput) -> MemberPlates:
    """Plates with the skins of their solids; raises BendTorsionError for joints that cannot be."""
    plates, findings = split_plates(
        geometry.member, given.joints, given.station_spacing, given.rules
    )
    return MemberPlates(
        geometry,
        tuple(PlateGeometry(plate, _plate_skin(plate)) for plate in plates),
        (*geometry.findings, *findings),
    )


def _plate_skin(plate: Plate) -> tuple[SkinPiece, ...]:
    """The skin in ring order: outer first, outer second, inner second, inner first."""
    rails = plate.rails
    pieces = skin((rails.outer, rails.inner), (rails.boundaries, rails.inner_folds))
    return tuple(SkinPiece(piece.knots, piece.poles[[0, 1, 3, 2]]) for piece in pieces)


@memoised
def member_skins(geometry: MemberGeometry) -> Skins:
    """The outer skin of a member, one tube per stretch without a step."""
    member = geometry.member
    edges = [0.0, *_steps(member), member.length]
    folds = member.law.folds
    return Skins(
        tuple(
            skin((member.corners(a, b),), (tuple(f for f in folds if a < f < b),))
            for a, b in zip(edges[:-1], edges[1:], strict=True)
        )
    )


@memoised
def record_of(plates: MemberPlates) -> MemberRecord:
    """The lofting record of a member: flat patterns and the figures reported, recomputed."""
    geometry = plates.geometry
    member = geometry.member
    developed = tuple(develop_plate(item.plate) for item in plates.plates)
    rms, largest = member.frames.axis.distance_to(geometry.surface)
    findings = list(plates.findings)
    for plate in developed:
        twist_width = np.sqrt(8.0 * plate.strain_max)
        if twist_width > tolerances.LOCKED_IN_TWIST_WIDTH:
            findings.append(
                warning(
                    "locked-in-stress",
                    plate.mark,
                    "laying the plate flat locks in a membrane stress that the shop will feel",
                    "shorten or narrow the plate, or form it hot",
                    value=float(plate.locked_in_stress),
                    limit=float(tolerances.LOCKED_IN_TWIST_WIDTH**2 / 8 * 206000.0),
                    unit="MPa",
                )
            )
    sections = []
    for section in member.law.sections:
        if not sections or sections[-1] != section.title:
            sections.append(section.title)
    _, theta = torsion_angle(member.frames)
    return MemberRecord(
        member=member.name,
        sections=" / ".join(sections),
        section_type=member.law.sections[0].type,
        length=member.length,
        mass=sum(plate.mass for plate in developed),
        axis_to_surface_rms=rms,
        axis_to_surface_max=largest,
        torsion_error_max=torsion_error(geometry),
        total_torsion=float(theta[-1]),
        plates=developed,
        wireframe=_wireframe(member),
        findings=tuple(findings),
    )


def torsion_error(geometry: MemberGeometry) -> float:
    """Largest angle, rad, between the section as built and as the surface normal asks for.

    Built: the direction between the two outermost corners, read off the skin's splines at four
    times the stations. Asked: the surface normal at the axis minus its tangent part, turned by
    the roll, projected afresh.
    """
    member = geometry.member
    worst = 0.0
    for tube in member_skins(geometry).tubes:
        for piece in tube:
            start, end = piece.knots[0], piece.knots[-1]
            s = np.linspace(start, end, 4 * (piece.poles.shape[1] - 3) + 1)
            built = piece.at(s)
            i, j = _farthest(built[0])
            direction = built[:, j] - built[:, i]
            direction /= np.linalg.norm(direction, axis=1, keepdims=True)
            x = member.frames.axis.tangent(s)
            normal = geometry.surface.closest(member.frames.axis.position(s)).normals
            z = normal - (normal * x).sum(axis=1, keepdims=True) * x
            z /= np.linalg.norm(z, axis=1, keepdims=True)
            y = np.cross(z, x)
            y, z = (
                np.cos(geometry.roll) * y + np.sin(geometry.roll) * z,
                np.cos(geometry.roll) * z - np.sin(geometry.roll) * y,
            )
            cell = next(c for c in member.law.cells if c.start <= start < c.end)
            plane = cell.corners + (s - cell.start)[:, None, None] * cell.corner_rates
            asked = plane[:, j] - plane[:, i]
            asked /= np.linalg.norm(asked, axis=1, keepdims=True)
            asked = asked[:, :1] * y + asked[:, 1:] * z
            angle = 2.0 * np.arcsin(0.5 * np.linalg.norm(direction - asked, axis=1).clip(0, 2))
            worst = max(worst, float(angle.max()))
    return worst


@dataclass(frozen=True, eq=False)
class MemberJob:
    """Everything one member is computed from."""

    surface: Surface
    axis: AxisInput
    member: MemberInput
    plates: PlatesInput


@dataclass(frozen=True, eq=False)
class DetailedMember:
    """All results of one member, for the memo of another process."""

    axis: Axis
    geometry: MemberGeometry
    skins: Skins
    plates: MemberPlates
    record: MemberRecord


def detail(job: MemberJob) -> DetailedMember:
    """Run the whole pipeline for one member; raises BendTorsionError for what cannot be built."""
    axis = axis_of(job.axis, job.surface)
    geometry = member_of(job.member, axis, job.surface)
    plates = plates_of(geometry, job.plates)
    return DetailedMember(axis, geometry, member_skins(geometry), plates, record_of(plates))


def adopt(results: DetailedMember) -> None:
    """Take results computed in another process into this one's memo."""
    for result in vars(results).values():
        remember(result)


def failed_record(name: str, findings: tuple[Finding, ...]) -> MemberRecord:
    """The record of a member in error: no plates, no figures."""
    if not any(f.severity == "error" for f in findings):
        findings = (*findings, error("member-failed", name, "the member could not be built"))
    return MemberRecord(member=name, sections="", section_type="", findings=findings)


def _farthest(corners: np.ndarray) -> tuple[int, int]:
    distance = np.linalg.norm(corners[:, None] - corners[None, :], axis=2)
    i, j = np.unravel_index(int(np.argmax(distance)), distance.shape)
    return int(i), int(j)


def _steps(member: Member) -> list[float]:
    """Places where the outer skin itself jumps."""
    steps = []
    for before, after in zip(member.law.cells[:-1], member.law.cells[1:], strict=True):
        at_end = before.corners + (before.end - before.start) * before.corner_rates
        if np.abs(after.corners - at_end).max() > tolerances.FACES_FLUSH:
            steps.append(after.start)
    return steps


def _wireframe(member: Member, spacing: float = 250.0) -> dict[str, np.ndarray]:
    """Polylines for overview drawings: axis, corner lines by name."""
    count = max(8, int(np.ceil(member.length / spacing)))
    s = np.unique(
        np.concatenate(
            [np.linspace(0.0, member.length, count + 1), [cell.start for cell in member.law.cells]]
        )
    )
    corners = member.corners(0.0, member.length)
    both = np.concatenate([corners(s, "earlier")[:, None], corners(s)[:, None]], axis=1)
    both[0, 0] = both[0, 1]
    lines = both.reshape(2 * len(s), -1, 3)
    names = member.law.sections[0].corner_names
    frame = {name: lines[:, k] for k, name in enumerate(names)}
    frame["axis"] = member.frames.axis.position(s)
    return frame
