# SPDX-License-Identifier: LGPL-2.1-or-later
"""The arrows of the pipeline, each a memoised pure function of frozen values.

surface, points -> axis -> member -> plates -> lofting record. Document objects and the command
line call these and nothing below them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from . import tolerances
from .axes.axis import Axis
from .axes.axis_input import AxisInput, AxisUncertainty, axis_from, axis_uncertainty
from .axes.frames import FrameInput, Frames, frames_of, torsion_angle
from .axes.surface_check import size_findings, surface_findings
from .beds.bed import bed_of, steep_findings
from .beds.bed_face import BedInput
from .beds.bed_record import Bed
from .beds.control_sections import control_sections
from .finding import BendTorsionError, Finding, has_error, warning
from .geometry.surface import Surface
from .joints.pieces import PieceInput, with_pieces
from .lofting import MemberRecord
from .members.end_cut import with_end_cuts
from .members.member import Member
from .members.piece_record import PieceFigures, piece_figures
from .members.skin import skins
from .members.strips import rails_between
from .members.surface_alignment import surface_lifts
from .members.zone_table import zone_records
from .members.zones import section_law
from .memo import memoised, remember
from .nodes.node_input import NodeInput, NodeRules
from .nodes.node_members import MemberNodes, numbered, with_nodes
from .nodes.nodes import Found, Node, find_nodes
from .patterns.laid_flat import PLAIN, PatternInput, laid_flat
from .plates.flat_plate import developed_flat
from .plates.piece_ends import corner_ends, whole_faces
from .plates.plate_parts import with_parts
from .plates.plates import JointRules, split_plates
from .plates.true_thickness import thickness_findings
from .solids.cut_skin import cut_skin_area
from .solids.mass import PlateFigures, net_figures, plate_figures, skin_area
from .solids.member_figures import beyond_stock, torsion_error, wireframe, with_stock
from .solids.solid_skins import corner_tubes, in_ring_order, skins_and_volumes
from .stages import MemberGeometry, MemberInput, MemberPlates, PlateGeometry, PlatesInput, Skins
from .welds.backing_clash import backing_clashes, node_backing_clashes
from .welds.bevel_limit import bevels_beyond
from .welds.bevels import with_bevels
from .welds.edge_rows import EdgeTreatment
from .welds.root_gaps import joint_gaps, seam_gaps, with_root_gaps
from .welds.seam_corners import seam_corners
from .welds.weld_access import access_findings
from .welds.welds import welds_of


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
        frames = _frames(axis, surface, frame)
        return _geometry(given, axis, surface, frame, frames, found)
    except BendTorsionError as problem:
        raise BendTorsionError((*found, *problem.findings)) from problem


@memoised
def _frames(axis: Axis, surface: Surface, frame: FrameInput) -> Frames:
    return frames_of(axis, surface, frame)


def _geometry(given, axis, surface, frame, frames, found) -> MemberGeometry:
    lifts, aligned = surface_lifts(
        given.name, given.segments, frames, surface, given.offset_y, given.offset_z
    )
    law = section_law(
        given.name,
        given.segments,
        axis.length,
        given.offset_y,
        given.offset_z,
        given.transition_length,
        lifts,
        axis.closed,
        given.thickness,
    )
    member = Member(given.name, frames, law)
    member.check_bend()
    member = with_end_cuts(member, (given.start_cut, given.end_cut))
    return MemberGeometry(member, surface, frame, (*axis.findings, *found, *aligned, *law.findings))


@memoised
def meeting_of(
    members: tuple[MemberGeometry, ...],
    ranks: dict[str, int | None],
    given: tuple[NodeInput, ...],
    rules: NodeRules,
) -> Found:
    """The nodes of a few members, or the errors that say why there are none."""
    return find_nodes({g.member.name: g.member for g in members}, ranks, given, rules)


def noded(geometry: MemberGeometry, nodes: MemberNodes) -> MemberGeometry:
    """A member with what its nodes take of it."""
    return _noded(geometry, nodes) if nodes.gaps or nodes.diaphragms else geometry


@memoised
def _noded(geometry: MemberGeometry, nodes: MemberNodes) -> MemberGeometry:
    return replace(geometry, member=with_nodes(geometry.member, nodes))


@memoised
def plates_of(geometry: MemberGeometry, given: PlatesInput) -> MemberPlates:
    """Plates with the skins of their solids; raises BendTorsionError for joints that cannot be."""
    rules = given.rules and given.rules.within_stock(geometry.member.law.plate_kinds)
    geometry = rooted(in_pieces(geometry, given), given.edges)
    plates, findings = split_plates(
        geometry.member,
        given.joints,
        given.station_spacing,
        rules,
        given.lanes,
        given.keep_outs(
            geometry.member.length, [piece.end for piece in geometry.member.pieces[:-1]]
        ),
        joint_gaps(given.edges),
    )
    plates, flat = with_parts(
        geometry.member, plates, given.diaphragms, given.openings, given.marks
    )
    flat = (*flat, *numbered(geometry.member, flat))
    return MemberPlates(
        geometry,
        tuple(map(PlateGeometry, plates, *skins_and_volumes(plates))),
        (*geometry.findings, *findings, *thickness_findings(plates)),
        given,
        tuple(replace(part, piece=geometry.member.piece_at(part.face, part.s)) for part in flat),
    )


def in_pieces(geometry: MemberGeometry, given: PlatesInput) -> MemberGeometry:
    """A member cut into its delivery pieces; raises BendTorsionError as `with_pieces`."""
    asked = given.pieces or geometry.member.gaps
    return _in_pieces(geometry, given.pieces, given.rules) if asked else geometry


@memoised
def _in_pieces(
    geometry: MemberGeometry, pieces: tuple[PieceInput, ...], rules: JointRules | None
) -> MemberGeometry:
    member, findings = with_pieces(geometry.member, pieces, rules)
    return replace(geometry, member=member, findings=(*geometry.findings, *findings))


def rooted(geometry: MemberGeometry, rows: tuple[EdgeTreatment, ...]) -> MemberGeometry:
    """A member with the root gaps of its rows of edges; raises BendTorsionError for `edge k`."""
    return _rooted(geometry, rows) if any(row.prep and row.prep.gap for row in rows) else geometry


@memoised
def _rooted(geometry: MemberGeometry, rows: tuple[EdgeTreatment, ...]) -> MemberGeometry:
    member, findings = with_root_gaps(geometry.member, rows)
    return replace(geometry, member=member, findings=(*geometry.findings, *findings))


@memoised
def member_skins(geometry: MemberGeometry) -> Skins:
    """The outer skin of a member: of a closed section one tube per stretch without a step, of an
    open one its strips between the joints the section asks for."""
    member = geometry.member
    reach = member.reach
    if member.law.sections[0].closed:
        return Skins(corner_tubes(member, reach))
    edges = {
        k: [reach[0], *member.law.joints_of(k), reach[1]] for k in range(len(member.law.strips))
    }
    rails = rails_between(
        member,
        [(k, a, b) for k, own in edges.items() for a, b in zip(own[:-1], own[1:], strict=True)],
    )
    return Skins(
        tuple(
            in_ring_order(
                skins([((r.outer, r.inner), (r.outer_folds, r.inner_folds)) for r in rails])
            )
        )
    )


@memoised
def record_of(plates: MemberPlates, given: PatternInput = PLAIN) -> MemberRecord:
    """The lofting record of a member: flat patterns and the figures reported, recomputed."""
    geometry = plates.geometry
    member = geometry.member
    developed = laid_flat(
        member,
        [item.plate for item in plates.plates],
        given,
        plates.given.forming,
        plates.given.keep_outs(member.length)["diaphragm"],
    )
    figures = figures_of(plates)
    developed = tuple(
        replace(plate, centre_of_gravity=own.centre, painted_area=area)
        for plate, own, area in zip(developed, figures.solids, figures.painted, strict=True)
    ) + tuple(map(developed_flat, plates.flat))
    rms, largest = member.frames.axis.distance_to(geometry.surface)
    findings = list(plates.findings)
    most_strain = tolerances.LOCKED_IN_TWIST_WIDTH**2 / 8.0
    for plate in developed:
        if given.mode == "edges" and plate.strain_max > most_strain:
            findings.append(
                warning(
                    "locked-in-stress",
                    plate.mark,
                    "laying the plate flat locks in a membrane stress that the shop will feel",
                    "lay it flat with mode energy, narrow the plate, or form it hot",
                    value=float(plate.locked_in_stress),
                    limit=float(plate.locked_in_stress * most_strain / plate.strain_max),
                    unit="MPa",
                )
            )
        findings += beyond_stock(plate, plates.given.rules)
    developed = tuple(with_stock(plate, plates.given.rules) for plate in developed)
    welds, weld_findings = welds_of(
        member.name,
        developed,
        member.law.strips,
        [row.on(member.length) for row in plates.given.edges],
        plates.given.welds,
        {node.node for node in member.node_records if node.type == "stub"},
        seam_gaps(member.law),
        seam_corners(member.law),
    )
    developed = with_bevels(developed, welds, plates.given.welds.bevel_step, given.contour)
    faces = {plate.mark: plate.face for plate in developed}
    clashes = backing_clashes(member.name, member.length, welds, faces, plates.given.diaphragms)
    at_nodes = node_backing_clashes(developed, welds)
    inside = access_findings(
        member.name,
        member.law,
        welds,
        faces,
        {row.closing.face for row in plates.given.diaphragms if row.closing},
        bool(plates.given.openings),
        plates.given.welds.access,
    )
    beyond = bevels_beyond(developed, plates.given.welds.largest_bevel)
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
        wireframe=wireframe(member) | {f.mark: f.ring for f in plates.flat},
        findings=(*findings, *weld_findings, *clashes, *at_nodes, *inside, *beyond),
        zones=zone_records(member.law),
        centre_of_gravity=figures.centre_of_gravity,
        painted_area=painted_area(geometry),
        pieces=pieces_of(plates),
        nodes=member.node_records,
        welds=welds,
        controls=control_sections(member, plates.pieces, [item.plate for item in plates.plates]),
    )


@memoised
def figures_of(plates: MemberPlates) -> PlateFigures:
    """Centres of gravity and painted areas of the plates, from the faces of their solids."""
    own = [item.plate for item in plates.plates]
    whole = plate_figures(
        plates.geometry.member.law.sections[0], own, [item.skin for item in plates.plates]
    )
    return net_figures(whole, own, plates.flat)


def pieces_of(plates: MemberPlates) -> tuple[PieceFigures, ...]:
    """The delivery pieces with what they hold, its mass and centre of gravity."""
    solids = figures_of(plates).solids
    parts = [
        (
            item.plate.mark,
            item.plate.piece,
            item.plate.net_volume * item.plate.material.density,
            own.centre,
        )
        for item, own in zip(plates.plates, solids, strict=True)
    ]
    parts += [(f.mark, f.piece, f.mass, f.centre_of_gravity) for f in plates.flat]
    return piece_figures(plates.pieces, parts)


def painted_area(geometry: MemberGeometry) -> float:
    """Area, mm2, of a member seen from outside, ends apart (`mass.skin_area`)."""
    tubes = member_skins(geometry).tubes
    if geometry.member.ends != (None, None) or geometry.member.gaps:
        return cut_skin_area(geometry.member, tubes)
    return skin_area(geometry.member.law, tubes)


@dataclass(frozen=True, eq=False)
class MemberBeds:
    """The assembly beds of a member's pieces, in order, and what was found about them."""

    beds: tuple[Bed, ...]
    findings: tuple[Finding, ...]


@memoised
def beds_of(plates: MemberPlates, given: BedInput) -> MemberBeds:
    """The bed of each delivery piece, with saddles at its diaphragms; raises BendTorsionError for
    what cannot be bedded as given."""
    member = plates.geometry.member
    diaphragms = [part.s for part in plates.flat if part.face == "diaphragm"]
    spacing = plates.given.station_spacing
    pieces = member.pieces
    beds = tuple(
        bed_of(
            member,
            given,
            spacing,
            piece.number if len(pieces) > 1 else 0,
            piece.start,
            piece.end,
            [s for s in diaphragms if piece.start <= s <= piece.end],
            whole_faces(own := [p.plate for p in plates.plates if p.plate.piece == piece.number]),
            corner_ends(member, own),
        )
        for piece in plates.pieces
    )
    return MemberBeds(beds, tuple(found for bed in beds for found in steep_findings(bed)))


@memoised
def with_beds(record: MemberRecord, beds: MemberBeds) -> MemberRecord:
    """The record with its beds and what was found about them."""
    return replace(record, beds=beds.beds, findings=(*record.findings, *beds.findings))


@dataclass(frozen=True, eq=False)
class MemberJob:
    """Everything one member is computed from; meets: the nodes it takes part in, for the record."""

    surface: Surface
    axis: AxisInput
    member: MemberInput
    plates: PlatesInput
    bed: BedInput = BedInput()
    patterns: PatternInput = PLAIN
    nodes: MemberNodes = MemberNodes()
    meets: tuple[Node, ...] = ()


@dataclass(frozen=True, eq=False)
class DetailedMember:
    """All results of one member, for the memo of another process; patterns: the record without
    the beds."""

    axis: Axis
    geometry: MemberGeometry
    skins: Skins
    plates: MemberPlates
    record: MemberRecord
    patterns: MemberRecord
    beds: MemberBeds


def detail(job: MemberJob) -> DetailedMember:
    """Run the whole pipeline for one member; raises BendTorsionError for what cannot be built."""
    axis = axis_of(job.axis, job.surface)
    try:
        geometry = member_of(job.member, axis, job.surface)
        plates = plates_of(noded(geometry, job.nodes), job.plates)
        patterns, beds = record_of(plates, job.patterns), beds_of(plates, job.bed)
    except BendTorsionError as problem:
        # A point out of place often is the cause: what was found on the axis comes first.
        raise BendTorsionError(dict.fromkeys((*axis.findings, *problem.findings))) from problem
    record = with_beds(patterns, beds)
    return DetailedMember(axis, geometry, member_skins(geometry), plates, record, patterns, beds)


def adopt(results: DetailedMember) -> None:
    """Take results computed in another process into this one's memo."""
    for result in vars(results).values():
        remember(result)
