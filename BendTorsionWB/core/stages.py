# SPDX-License-Identifier: LGPL-2.1-or-later
"""The frozen values between the arrows of the pipeline, and what each arrow is given."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from .axes.frames import FrameInput
from .finding import Finding
from .geometry.surface import Surface
from .joints.lanes import Lanes
from .joints.pieces import PieceInput
from .members.end_cut import SQUARE, EndCut
from .members.member import Member
from .members.piece_record import Piece
from .members.skin import SkinPiece
from .members.thickness import ThicknessRules
from .members.zones import Segment
from .patterns.forming import FormingRules
from .plates.diaphragm_input import Diaphragm
from .plates.face_marks import FaceMark
from .plates.flat_plate import FlatPlate
from .plates.openings import Opening
from .plates.plates import JointRules, Joints, Plate
from .welds.edge_rows import EdgeTreatment, WeldDefaults


@dataclass(frozen=True)
class MemberInput:
    """What a member is made from, its axis and surface apart. roll in radians, added to that of
    the frame. thickness: rules of its thickness joints. start_cut, end_cut: what its ends are
    cut by."""

    name: str
    segments: tuple[Segment, ...]
    offset_y: float = 0.0
    offset_z: float = 0.0
    roll: float = 0.0
    transition_length: str = "face"
    frame: FrameInput = FrameInput()
    thickness: ThicknessRules = ThicknessRules()
    start_cut: EndCut = SQUARE
    end_cut: EndCut = SQUARE


@dataclass(frozen=True)
class PlatesInput:
    """Joints and lanes per face, spacing of measuring lines and the rules joints are checked by
    and plates formed by; diaphragms and end plates, openings and marks; nodes: places on the axis
    joints keep clear of, mm; pieces: it is delivered in, none for one."""

    joints: dict[str, Joints] = field(default_factory=dict)
    station_spacing: float = 500.0
    rules: JointRules | None = None
    forming: FormingRules = FormingRules()
    diaphragms: tuple[Diaphragm, ...] = ()
    openings: tuple[Opening, ...] = ()
    marks: tuple[FaceMark, ...] = ()
    lanes: dict[str, Lanes] = field(default_factory=dict)
    nodes: tuple[float, ...] = ()
    pieces: tuple[PieceInput, ...] = ()
    edges: tuple[EdgeTreatment, ...] = ()
    welds: WeldDefaults = WeldDefaults()

    def keep_outs(self, length: float, piece_ends: Sequence[float] = ()) -> dict[str, list[float]]:
        """Places joints keep clear of, by their kind, on an axis of this length."""
        return {
            "diaphragm": [
                item.s * length if item.s_is_ratio else item.s
                for item in self.diaphragms
                if not item.end
            ],
            "node": list(self.nodes),
            "piece_end": list(piece_ends),
        }


@dataclass(frozen=True, eq=False)
class MemberGeometry:
    """A member with the surface and frame it came from and what was found on the way."""

    member: Member
    surface: Surface
    frame: FrameInput
    findings: tuple[Finding, ...]


@dataclass(frozen=True, eq=False)
class PlateGeometry:
    """A plate and the skin its solid is written from, before its ends are cut, with the volume
    inside the skin, mm3."""

    plate: Plate
    skin: tuple[SkinPiece, ...]
    skin_volume: float


@dataclass(frozen=True, eq=False)
class MemberPlates:
    """All plates of a member and what they were cut by; flat: its diaphragms and end plates."""

    geometry: MemberGeometry
    plates: tuple[PlateGeometry, ...]
    findings: tuple[Finding, ...]
    given: PlatesInput
    flat: tuple[FlatPlate, ...] = ()

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """The delivery pieces; without rows the member is one, number 1."""
        member = self.geometry.member
        return member.pieces or (Piece(1, 0.0, member.length),)


@dataclass(frozen=True, eq=False)
class Skins:
    """Tubes of a member's outer skin, each a tuple of pieces."""

    tubes: tuple[tuple[SkinPiece, ...], ...]
