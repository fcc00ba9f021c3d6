# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lofting data of plates and members: the frozen records every file and sheet is written from.

Pattern coordinates (u, v) are those of the pattern frame: seen from the marking face, u along the
chord between the midpoints of the end lines, the corner of the bounding box at (0, 0).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from .beds.bed_record import Bed
from .beds.control_record import ControlSection
from .finding import Finding, error
from .members.piece_record import PieceFigures
from .members.thickness import Chamfer
from .nodes.node_record import NodeRecord
from .patterns.forming_record import FormingRecord
from .welds.bevel_record import EdgeBevel
from .welds.weld_record import Weld


@dataclass(frozen=True, eq=False)
class StationLine:
    """A measuring line across a plate: `E-1` and `E-2` at its ends, `L-k` at member stations.

    s: arc length on the axis, mm. flat: (2, 2) its ends on the first and second edge.
    length_3d, length_flat: mm, on the flattened surface.
    """

    label: str
    s: float
    flat: np.ndarray
    length_3d: float
    length_flat: float


@dataclass(frozen=True, eq=False)
class FoldLine:
    """A ruling the plate is folded along. angle: rad, positive where the outer face is convex."""

    label: str
    s: float
    angle: float
    flat: np.ndarray


@dataclass(frozen=True, eq=False)
class LoftingPoint:
    """A numbered point of a plate.

    label: `P-1`…; line: label of its line; edge: `left` `right` `top` `bottom`; kind: `arris` (on
    the outer face's corner line) or `witness` (on the marking face, 50 mm inside the edge).
    xyz: (3,) model; local: (3,) placing frame; flat: (2,) pattern frame; mm.
    """

    label: str
    line: str
    edge: str
    kind: str
    s: float
    xyz: np.ndarray
    local: np.ndarray
    flat: np.ndarray


@dataclass(frozen=True, eq=False)
class FlatHole:
    """An opening in a pattern: runs (k, 2) head to tail, counter-clockwise; title as written in
    tables, `d=120`; circle: u, v and diameter when it is one to 0.01 mm; area mm2."""

    label: str
    title: str
    runs: tuple[np.ndarray, ...]
    circle: tuple[float, float, float] | None
    area: float


@dataclass(frozen=True, eq=False)
class FlatMark:
    """A mark on a pattern. kind: `line`, flat (k, 2) along it, and text when it has one; `punch`,
    flat (1, 2); `text`, flat (2, 2): the middle of the text and a point where it reads to."""

    kind: str
    text: str
    flat: np.ndarray


@dataclass(frozen=True)
class PanelMeasure:
    """One length of a panel (`panel` = `E-1/L-3`). what: `edge left`, `diagonal 1`, …

    flat: mm on the pattern; arc: mm along the flattened surface (edges along the curve, diagonals
    geodesic); chord_outer: straight mm between the arris points on the formed outer face.
    """

    panel: str
    what: str
    flat: float
    arc: float
    chord_outer: float


@dataclass(frozen=True, eq=False)
class PlateEdge:
    """One long edge of a plate at its measuring lines `lines`: how its outer and its inner face
    end there.

    neighbour: face of the plate it meets, empty for a free edge. s: arc lengths (n,). bevel (n,):
    angle of the edge's surface against square, rad, positive where the outer face is the wider;
    dihedral (n,): angle between the two plates on the inner side, rad (pi in one plane), NaN for a
    free edge. offset_outer, offset_inner (n,): how far the edges of the two faces lie outside that
    of the flattened surface when the plate is flat, mm; flat_outer, flat_inner (n, 2): where.
    """

    edge: str
    neighbour: str
    lines: tuple[str, ...]
    s: np.ndarray
    bevel: np.ndarray
    dihedral: np.ndarray
    offset_outer: np.ndarray
    offset_inner: np.ndarray
    flat_outer: np.ndarray
    flat_inner: np.ndarray

    def widest(self, line: int) -> str:
        """The face that reaches farthest there: `outer`, `inner`, or `both` of a square edge."""
        step = self.offset_outer[line] - self.offset_inner[line]
        if abs(step) < SQUARE_EDGE:
            return "both"
        return "outer" if step > 0.0 else "inner"


SQUARE_EDGE = 0.01
"""mm; faces of an edge that end closer together than this are cut square."""


@dataclass(frozen=True, eq=False)
class EndPart:
    """A stretch of a cut end of a plate, from the first edge towards the second, on one surface.

    node, member, face: of what it ends on, its thickness and the root gap in mm; empty and 0 where
    no member is met. along (n,): mm from the first edge along the end of the mid-surface; s (n,):
    arc lengths there. bevel (n,): rad, of the cut against square, positive where the outer face is
    the longer. corners (2, 3): its ends in the model.
    """

    node: str
    member: str
    face: str
    thickness: float
    gap: float
    along: np.ndarray
    s: np.ndarray
    bevel: np.ndarray
    corners: np.ndarray

    @property
    def dihedral(self) -> np.ndarray:
        """Angles (n,), rad, between the plate and what it ends on, on the inner side."""
        return 0.5 * np.pi - self.bevel

    @property
    def length(self) -> float:
        """mm along the mid-surface."""
        return float(self.along[-1] - self.along[0])


@dataclass(frozen=True, eq=False)
class WeldedSide:
    """A side of a flat part that is welded to the wall of a face: length mm, middle (3,). how:
    `walls`, from both sides; `slot`, through slots in the wall; `end`, round the end of the
    section, with `room` mm beside the wall; `open`, not at all, too far from it. gap: mm to the
    wall, where the edge is cut square along its wider face. slot: length and breadth, mm, of each
    of its slots. dihedral: rad, the smaller of the two angles between part and wall, where it is
    least. edge: corners it is between, `P-1/P-2`, where they are known. opens: the face along which
    the edge, cut square, stands farther from the wall: `up`, the one it is marked on, or `down`."""

    face: str
    length: float
    middle: np.ndarray
    how: str = "walls"
    gap: float = 0.0
    room: float = 0.0
    slot: tuple[float, float] | None = None
    dihedral: float = 0.5 * math.pi
    edge: str = ""
    opens: str = ""


@dataclass(frozen=True, eq=False)
class FlatteningErrors:
    """What laying a plate flat costs, by kind, flat minus true, mm: largest of the long edges
    (between lines and whole), of the lines and of the geodesic diagonals; the centre line and the
    area, mm2, as a whole; seam: the largest by which its stations miss those of a plate beside it
    along their common edge (0 without one)."""

    edge: float
    line: float
    diagonal: float
    centre_line: float
    area: float
    seam: float = 0.0


@dataclass(frozen=True, eq=False)
class GrossPattern:
    """A flat pattern with all allowances, as it is cut, in a pattern frame of its own.

    outline: runs as DevelopedPlate's. length, width mm; area mm2; mass kg. scale_u, scale_v: gross
    over net; shift (2,): mm, gross = (scale_u · u, scale_v · v) + shift. green_start, green_end:
    mm added beyond the end lines.
    """

    outline: tuple[np.ndarray, ...]
    length: float
    width: float
    area: float
    mass: float
    scale_u: float
    scale_v: float
    shift: np.ndarray
    green_start: float
    green_end: float

    def map(self, flat: np.ndarray) -> np.ndarray:
        """Net pattern points (..., 2) in the gross pattern."""
        return flat * np.array([self.scale_u, self.scale_v]) + self.shift


@dataclass(frozen=True, eq=False)
class DevelopedPlate:
    """One plate with its flat pattern and lofting data.

    outline: smooth runs (k, 2), head to tail, counter-clockwise, chord sagitta <= 0.001 mm; runs
    meet at corners and folds. placing: (4, 4) model -> placing frame (X from the first point of
    the start line to its second, Z outward). flat_to_placing: (4, 4) (u, v, 0, 1) -> placing
    frame. Lengths mm, area mm2, mass kg; length_error_* compare flat with formed lengths of
    edges, lines and geodesic diagonals on the flattened surface; length_error_bound is the proven
    lower bound of length_error_max for any flat pattern. strain_max is the largest principal
    strain of flattening. locked_in_stress: MPa. bending_radius_min: mm. in_transition: the plate
    lies, in part or whole, in a transition zone. forming_data: what the forming shop is told.
    edges: first and second. gross: as cut; None without allowances, gross is net then. errors: by
    kind. centre_of_gravity: (3,) model, of the plate as formed; painted_area: of what is seen from
    outside (`mass.painted_areas`); None where they do not exist. area, mass and volume are without
    the holes. quantity: plates of the same part; opposite_hand: the part that is its mirror image.
    chamfers: at the start and the end, machined after cutting; the pattern knows nothing of them.
    Flat parts have no lines, panels and errors. bevels: of its sides; contour: the face that cut
    files draw (`bevels.CONTOURS`). ends: the stretches of its cut ends at the start and the end;
    welded: sides of a flat part that are welded to walls. stock: length and width, mm, of the sheet
    it is cut from, where the schedule gives any.
    """

    member: str
    mark: str
    part: str
    face: str
    letter: str
    piece: int
    thickness: float
    material: str
    outline: tuple[np.ndarray, ...]
    lines: tuple[StationLine, ...]
    folds: tuple[FoldLine, ...]
    points: Sequence[LoftingPoint]
    panels: Sequence[PanelMeasure]
    length: float
    width: float
    area: float
    mass: float
    volume: float
    s_start: float
    s_end: float
    length_error_max: float
    length_error_rms: float
    length_error_bound: float
    strain_max: float
    locked_in_stress: float
    bending_radius_min: float
    forming: str | None
    marking_face: str
    placing: np.ndarray
    flat_to_placing: np.ndarray
    in_transition: bool = False
    forming_data: FormingRecord | None = None
    edges: tuple[PlateEdge, ...] = ()
    gross: GrossPattern | None = None
    errors: FlatteningErrors | None = None
    centre_of_gravity: np.ndarray | None = None
    painted_area: float | None = None
    holes: tuple[FlatHole, ...] = ()
    marks: tuple[FlatMark, ...] = ()
    quantity: int = 1
    opposite_hand: str = ""
    chamfers: tuple[Chamfer | None, Chamfer | None] = (None, None)
    bevels: tuple[EdgeBevel, ...] = ()
    contour: str = "mid"
    flattened_surface: str = "mid"
    stock: tuple[float, float] | None = None

    def side_ends(self, edge: str) -> np.ndarray:
        """The corners (2, 2) on the pattern of a side `P-1/P-2` of a flat part."""
        flat = {point.label: point.flat for point in self.points}
        return np.array([flat[label] for label in edge.split("/")])

    @property
    def contour_face(self) -> str:
        """The face the contour of cut files is of: `top` (the marking face), `root`, `widest`, else
        the surface laid flat, `mid`, `inner` or `outer`."""
        return self.flattened_surface if self.contour == "mid" else self.contour

    ends: tuple[tuple[EndPart, ...], tuple[EndPart, ...]] = ((), ())
    welded: tuple[WeldedSide, ...] = ()


@dataclass(frozen=True)
class ZoneRecord:
    """A zone of a member: `d-k`, where segment k is constant, or `b-k`, the transition behind it.

    group: the paper's, B1 = {d-1} or A_k = {b-k, d-(k+1)}. start, end: mm on the axis. slope: a
    transition's length over the largest step of a face, None elsewhere. steps: (top, bottom, left,
    right) mm, how far the later segment's faces lie from the earlier's, at the start of the
    transition, or of the zone when it begins with a step; None where nothing changes.
    """

    label: str
    group: str
    start: float
    end: float
    slope: float | None = None
    steps: tuple[float, float, float, float] | None = None

    @property
    def length(self) -> float:
        return self.end - self.start


@dataclass(frozen=True, eq=False)
class MemberRecord:
    """One member with its developed plates and the figures reported for it.

    wireframe: named (n, 3) model polylines for overview drawings: `axis`, the corner lines
    `TL` `TR` `BR` `BL`, end outlines and joints. sections: text of the sections in order, such
    as `800x800x20 / 600x600x16`. Angles in radians, lengths mm, mass kg. An object in error has
    no plates and at least one error finding. zones: along the axis, in order.
    centre_of_gravity: (3,) model, of all plates; painted_area: mm2, the outer skin of a closed
    section, all plates' painted areas of an open one. beds: of its delivery pieces. pieces: it is
    delivered in. nodes: it ends on others at, along +s. controls: control sections of its pieces.
    """

    member: str
    sections: str
    section_type: str
    length: float | None = None
    mass: float | None = None
    axis_to_surface_rms: float | None = None
    axis_to_surface_max: float | None = None
    torsion_error_max: float | None = None
    total_torsion: float | None = None
    plates: tuple[DevelopedPlate, ...] = ()
    wireframe: dict[str, np.ndarray] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()
    zones: tuple[ZoneRecord, ...] = ()
    centre_of_gravity: np.ndarray | None = None
    painted_area: float | None = None
    beds: tuple[Bed, ...] = ()
    pieces: tuple[PieceFigures, ...] = ()
    welds: tuple[Weld, ...] = ()
    nodes: tuple[NodeRecord, ...] = ()
    controls: tuple[ControlSection, ...] = ()


def plate_identity(plate) -> dict[str, object]:
    """The fields of a DevelopedPlate that say which plate it is and what of; plate: a `Plate` or a
    `FlatPlate`. A plate is a part of its own until all are numbered."""
    return {
        "member": plate.member,
        "mark": plate.mark,
        "part": plate.mark,
        "face": plate.face,
        "letter": plate.letter,
        "piece": plate.piece,
        "thickness": plate.thickness,
        "material": plate.material.name,
    }


def failed_record(name: str, findings: tuple[Finding, ...]) -> MemberRecord:
    """The record of a member in error: no plates, no figures."""
    if not any(f.severity == "error" for f in findings):
        findings = (
            *findings,
            error(
                "member-failed",
                name,
                "the member could not be built",
                "mend what is said of its rows, its surface and its nodes",
            ),
        )
    return MemberRecord(member=name, sections="", section_type="", findings=findings)
