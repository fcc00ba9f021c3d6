# SPDX-License-Identifier: LGPL-2.1-or-later
"""The arrows of the pipeline, each a memoised pure function of frozen values.

surface, points -> axis -> member -> plates -> lofting record. Document objects and the command
line call these and nothing below them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from . import tolerances
from .axis import Axis
from .axis_input import AxisInput, AxisUncertainty, axis_from, axis_uncertainty
from .finding import BendTorsionError, Finding, error, has_error, warning
from .forming import FormingRules
from .frames import FrameInput, frames_of, torsion_angle, wanted_z
from .lofting import DevelopedPlate, MemberRecord
from .member import Member
from .memo import memoised, remember
from .pattern import develop_plate
from .plates import JointRules, Joints, Plate, split_plates
from .skin import SkinPiece, skin, skins
from .strips import rails_between
from .surface import Surface
from .surface_check import size_findings, surface_findings
from .volume import skin_volumes
from .zones import Segment, section_law


@dataclass(frozen=True)
class MemberInput:
    """What a member is made from, its axis and surface apart. roll in radians, added to that of
    the frame."""

    name: str
    segments: tuple[Segment, ...]
    offset_y: float = 0.0
    offset_z: float = 0.0
    roll: float = 0.0
    transition_length: str = "face"
    frame: FrameInput = FrameInput()


@dataclass(frozen=True)
class PlatesInput:
    """Joints per face, spacing of measuring lines and the rules joints are checked by and plates
    formed by."""

    joints: dict[str, Joints] = field(default_factory=dict)
    station_spacing: float = 500.0
    rules: JointRules | None = None
    forming: FormingRules = FormingRules()


@dataclass(frozen=True, eq=False)
class MemberGeometry:
    """A member with the surface and frame it came from and what was found on the way."""

    member: Member
    surface: Surface
    frame: FrameInput
    findings: tuple[Finding, ...]


@dataclass(frozen=True, eq=False)
class PlateGeometry:
    """A plate and the skin its solid is written from."""

    plate: Plate
    skin: tuple[SkinPiece, ...]


@dataclass(frozen=True, eq=False)
class MemberPlates:
    """All plates of a member and what they were cut by."""

    geometry: MemberGeometry
    plates: tuple[PlateGeometry, ...]
    findings: tuple[Finding, ...]
    given: PlatesInput


@dataclass(frozen=True, eq=False)
class Skins:
    """Tubes of a member's outer skin, each a tuple of pieces."""

    tubes: tuple[tuple[SkinPiece, ...], ...]


@memoised
def axis_of(given: AxisInput, surface: Surface | None) -> Axis:
    """The axis; raises BendTorsionError as axis_from does."""
    return axis_from(given, surface)


@memoised
def uncertainty_of(given: AxisInput, surface: Surface | None) -> AxisUncertainty:
    """What the axis's points leave open."""
    return axis_uncertainty(given, surface)


@memoised
def member_of(given: MemberInput, axis: Axis, surface: Surface) -> MemberGeometry:
    """Frames and section law; raises BendTorsionError for what cannot be built, with what was
    found about the surface when that may be why."""
    frame = replace(given.frame, roll=given.frame.roll + given.roll)
    found = [
        *size_findings(surface, given.name),
        *surface_findings(surface, axis, frame.kind == "surface"),
    ]
    if has_error(found):
        raise BendTorsionError(found)
    try:
        frames = frames_of(axis, surface, frame)
        return _geometry(given, axis, surface, frame, frames, found)
    except BendTorsionError as problem:
        raise BendTorsionError((*found, *problem.findings)) from problem


def _geometry(given, axis, surface, frame, frames, found) -> MemberGeometry:
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
    return MemberGeometry(member, surface, frame, (*axis.findings, *found, *law.findings))


@memoised
def plates_of(geometry: MemberGeometry, given: PlatesInput) -> MemberPlates:
    """Plates with the skins of their solids; raises BendTorsionError for joints that cannot be."""
    plates, findings = split_plates(
        geometry.member, given.joints, given.station_spacing, given.rules
    )
    return MemberPlates(
        geometry,
        tuple(map(PlateGeometry, plates, _plate_skins(plates))),
        (*geometry.findings, *findings),
        given,
    )


def _plate_skin(plate: Plate) -> tuple[SkinPiece, ...]:
    """The skin in ring order: outer first, outer second, inner second, inner first."""
    return _plate_skins([plate])[0]


def _plate_skins(plates: Sequence[Plate]) -> list[tuple[SkinPiece, ...]]:
    """Skins refined until each holds its plate's volume well within VOLUME_RELATIVE."""
    done: dict[int, tuple[SkinPiece, ...]] = {}
    pending, tolerance = list(range(len(plates))), tolerances.SKIN_CORNER
    while pending:
        groups = [plates[i].rails for i in pending]
        made = _in_ring_order(
            skins(
                [((r.outer, r.inner), (r.outer_folds, r.inner_folds)) for r in groups],
                tolerance=tolerance,
            )
        )
        done.update(zip(pending, made, strict=True))
        tolerance /= 16.0
        pending = [
            i
            for i, volume in zip(pending, skin_volumes(made), strict=True)
            if abs(volume / plates[i].volume - 1.0) > 0.25 * tolerances.VOLUME_RELATIVE
            and tolerance > tolerances.INTERPOLATION_RELATIVE * 1e6
        ]
    return [done[i] for i in range(len(plates))]


def _in_ring_order(made: Sequence[tuple[SkinPiece, ...]]) -> list[tuple[SkinPiece, ...]]:
    return [
        tuple(SkinPiece(piece.knots, piece.poles[[0, 1, 3, 2]]) for piece in pieces)
        for pieces in made
    ]


@memoised
def member_skins(geometry: MemberGeometry) -> Skins:
    """The outer skin of a member: of a closed section one tube per stretch without a step, of an
    open one its strips between the joints the section asks for."""
    member = geometry.member
    if member.law.sections[0].closed:
        return Skins(_corner_tubes(member))
    edges = [0.0, *member.law.joints, member.length]
    rails = rails_between(
        member,
        [
            (k, a, b)
            for k in range(len(member.law.strips))
            for a, b in zip(edges[:-1], edges[1:], strict=True)
        ],
    )
    return Skins(
        tuple(
            _in_ring_order(
                skins([((r.outer, r.inner), (r.outer_folds, r.inner_folds)) for r in rails])
            )
        )
    )


def _corner_tubes(member: Member) -> tuple[tuple[SkinPiece, ...], ...]:
    """The corner lines: a tube between steps, a piece of it between folds and ends of smooth
    transitions."""
    edges = [0.0, *_steps(member), member.length]
    cells = member.law.cells
    # Smooth transitions have no folds, but their curvature begins and ends abruptly.
    folds = sorted(
        {
            *member.law.folds,
            *(
                after.start
                for before, after in zip(cells, cells[1:], strict=False)
                if before.corner_bends is not None or after.corner_bends is not None
            ),
        }
    )
    return tuple(
        skin((member.corners(a, b),), (tuple(f for f in folds if a < f < b),))
        for a, b in zip(edges[:-1], edges[1:], strict=True)
    )


@memoised
def record_of(plates: MemberPlates, mode: str = "edges") -> MemberRecord:
    """The lofting record of a member: flat patterns and the figures reported, recomputed.

    mode: how plates are laid flat, one of pattern.MODES.
    """
    geometry = plates.geometry
    member = geometry.member
    developed = tuple(
        develop_plate(item.plate, mode=mode, rules=plates.given.forming) for item in plates.plates
    )
    rms, largest = member.frames.axis.distance_to(geometry.surface)
    findings = list(plates.findings)
    for plate in developed:
        twist_width = np.sqrt(8.0 * plate.strain_max)
        if mode == "edges" and twist_width > tolerances.LOCKED_IN_TWIST_WIDTH:
            findings.append(
                warning(
                    "locked-in-stress",
                    plate.mark,
                    "laying the plate flat locks in a membrane stress that the shop will feel",
                    "lay it flat with mode energy, narrow the plate, or form it hot",
                    value=float(plate.locked_in_stress),
                    limit=float(tolerances.LOCKED_IN_TWIST_WIDTH**2 / 8 * 206000.0),
                    unit="MPa",
                )
            )
        findings += _beyond_stock(plate, plates.given.rules)
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


def _beyond_stock(plate: DevelopedPlate, rules: JointRules | None) -> list[Finding]:
    """Warnings for a pattern longer or wider than the stock of the rules."""
    if rules is None:
        return []
    return [
        warning(
            "beyond-stock",
            plate.mark,
            f"the pattern is {what} than the stock",
            mend,
            value=size,
            limit=limit,
            unit="mm",
        )
        for what, size, limit, mend in (
            ("longer", plate.length, rules.longest_piece, "give it a joint, or order longer stock"),
            ("wider", plate.width, rules.widest_piece, "give it a joint, or order wider stock"),
        )
        if size > limit
    ]


def torsion_error(geometry: MemberGeometry) -> float:
    """Largest angle, rad, between the section as built and as the surface normal asks for.

    Built: the direction between the two outermost corners, read off the skin's splines at four
    times the stations. Asked: the z axis of the frame wanted (the surface normal at the axis minus
    its tangent part, turned by the roll), worked out afresh.
    """
    member = geometry.member
    worst = 0.0
    for tube in _corner_tubes(member):
        for piece in tube:
            start, end = piece.knots[0], piece.knots[-1]
            s = np.linspace(start, end, 4 * (piece.poles.shape[1] - 3) + 1)
            built = piece.at(s)
            i, j = _farthest(built[0])
            direction = built[:, j] - built[:, i]
            direction /= np.linalg.norm(direction, axis=1, keepdims=True)
            x = member.frames.axis.tangent(s)
            z = wanted_z(member.frames.axis, geometry.surface, geometry.frame, s)
            y = np.cross(z, x)
            cell = next(c for c in member.law.cells if c.start <= start < c.end)
            plane = cell.corners_at(s)
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
    try:
        geometry = member_of(job.member, axis, job.surface)
        plates = plates_of(geometry, job.plates)
        record = record_of(plates, "edges")
    except BendTorsionError as problem:
        # A point out of place often is the cause: what was found on the axis comes first.
        raise BendTorsionError(dict.fromkeys((*axis.findings, *problem.findings))) from problem
    return DetailedMember(axis, geometry, member_skins(geometry), plates, record)


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
        at_end = before.corners_at(np.array([before.end]))[0]
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
