# SPDX-License-Identifier: LGPL-2.1-or-later
"""The face a piece lies down on, the plane of its bed and the bed frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..finding import BendTorsionError, Finding, error
from ..geometry.piecewise import Piecewise
from ..geometry.vectors import crossed
from ..members.member import Member, to_space
from ..members.strips import rails_between
from .templates import on_corners, section_outline

PLANES = ("fit", "middle", "normal")
FLATTER_BY = 1.0
"""mm by which another face must lie flatter to be chosen before one named earlier."""
LEVEL_ENOUGH = 0.2
"""Cosine a face's inward normal must have to the bed's up direction at mid-length."""
STEP = 250.0
"""Distance of samples along the piece, mm."""


@dataclass(frozen=True)
class BedInput:
    """How pieces are bedded. mm.

    face: the one that lies down, or `auto`, the one that lies flattest. plane: `fit`, the best
    plane (least squares) of the face's edges; `middle`, the face's tangent plane at mid-length;
    `normal`, square to `normal`, which points up. spacing: of saddles, at most. height: of the
    lowest seat. pin_pitch: of the pin grid, 0 for none; lowest_pin: its height. template_pitch:
    of templates, at most; template_lines: stations that have one besides; clearance: of the
    templates.
    """

    face: str = "auto"
    plane: str = "fit"
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)
    spacing: float = 2000.0
    height: float = 700.0
    pin_pitch: float = 0.0
    lowest_pin: float = 250.0
    template_pitch: float = 3500.0
    template_lines: tuple[str, ...] = ()
    clearance: float = 0.0


@dataclass(frozen=True, eq=False)
class DownFace:
    """A face that may lie down: its strip, and rails s -> (6,) of its edges over the piece."""

    strip: int
    name: str
    edges: tuple[str, str]
    rails: Piecewise

    def at(self, s: np.ndarray) -> np.ndarray:
        """Both edges (n, 2, 3)."""
        return self.rails(s).reshape(-1, 2, 3)

    def dense(self) -> np.ndarray:
        """Both edges at even places (n, 2, 3)."""
        start, end = self.rails.start, self.rails.end
        return self.at(np.linspace(start, end, max(9, int(np.ceil((end - start) / STEP)) + 1)))


def face_and_up(
    member: Member, given: BedInput, start: float, end: float
) -> tuple[DownFace, np.ndarray]:
    """The face that lies down and the bed's upward direction (3,)."""
    strips = member.law.strips
    order = {name: k for k, name in enumerate(("bottom", "top", "left", "right"))}
    names = [given.face] if given.face != "auto" else [strip.face for strip in strips]
    candidates = []
    for k in sorted(range(len(strips)), key=lambda k: order.get(strips[k].face, 4)):
        if strips[k].face in names:
            face = _face(member, k, start, end)
            up = _up(member, face, given, start, end)
            facing = _facing_down(member, face, up, 0.5 * (start + end))
            candidates.append((facing, face, up))
    facing = max(item[0] for item in candidates)
    # A ring may have no face that lies down; left to choose, take what comes nearest.
    enough = LEVEL_ENOUGH if facing > LEVEL_ENOUGH else facing
    if given.face != "auto" and facing <= LEVEL_ENOUGH:
        raise BendTorsionError(
            bed_fault(
                "bed-face-up",
                member,
                f"face {given.face} does not face down on this bed",
                "choose another face, or another normal",
            )
        )
    chosen, least = None, np.inf
    for face, up in (item[1:] for item in candidates if item[0] >= enough):
        band = float(np.ptp((face.dense() * up).sum(axis=2)))
        if band < least - FLATTER_BY:
            chosen, least = (face, up), band
    return chosen


def _face(member: Member, strip: int, start: float, end: float) -> DownFace:
    own = member.law.strips[strip]
    if on_corners(member):
        corners = member.corners(start, end)
        columns = [3 * corner + k for corner in (own.first, own.second) for k in range(3)]
        return DownFace(
            strip, own.face, own.edges, Piecewise(corners.breaks, corners.values[..., columns])
        )
    edges = [start, *(s for s in member.law.joints_of(strip) if start < s < end), end]
    rails = rails_between(
        member, [(strip, a, b) for a, b in zip(edges[:-1], edges[1:], strict=True)]
    )
    breaks = np.concatenate([[start], *(one.outer.breaks[1:] for one in rails)])
    values = np.concatenate([one.outer.values for one in rails])
    return DownFace(strip, own.face, own.edges, Piecewise(breaks, values))


def _up(member: Member, face: DownFace, given: BedInput, start: float, end: float) -> np.ndarray:
    if given.plane == "normal":
        up = np.asarray(given.normal, float)
        return up / np.sqrt((up * up).sum())
    middle = np.array([0.5 * (start + end)])
    if given.plane == "fit":
        up = least_direction(face.dense().reshape(-1, 3))
    else:
        edges = face.at(middle)[0]
        tangent = face.rails.derivative(middle)[0].reshape(2, 3).mean(axis=0)
        up = crossed(tangent, edges[1] - edges[0])
        up = up / np.sqrt((up * up).sum())
    inwards = _outline(member, middle[0]).mean(axis=0) - face.at(middle)[0].mean(axis=0)
    return up if (inwards * up).sum() > 0.0 else -up


def _outline(member: Member, s: float) -> np.ndarray:
    """The section's outline (n, 3) in space."""
    at = member.frames.at(np.array([s]))
    return to_space(at, section_outline(member, s)[None])[0]


def _facing_down(member: Member, face: DownFace, up: np.ndarray, s: float) -> float:
    """The cosine of the face's inward normal at s to `up`; −1 when the section is not all on one
    side of it."""
    edges, outline = face.at(np.array([s]))[0], _outline(member, s)
    at = member.frames.at(np.array([s]))
    inwards = crossed(at.x[0], edges[1] - edges[0])
    inwards = inwards / np.sqrt((inwards * inwards).sum())
    depth = ((outline - edges[0]) * inwards).sum(axis=1)
    inwards = inwards if depth.mean() > 0.0 else -inwards
    same_side = (depth.mean() * depth).min() > -abs(depth.mean()) * 1e-3
    return float((inwards * up).sum()) if same_side else -1.0


def least_direction(points: np.ndarray) -> np.ndarray:
    """The unit normal (3,) of the plane that fits points (n, 3) best: total least squares, the
    least eigenvector of their scatter, by Jacobi's rotations."""
    off = points - points.mean(axis=0)
    matrix = [[float((off[:, i] * off[:, j]).sum()) for j in range(3)] for i in range(3)]
    matrix, vectors = np.array(matrix), np.eye(3)
    for _ in range(30):
        for i, j in ((0, 1), (0, 2), (1, 2)):
            if abs(matrix[i, j]) <= 1e-18 * matrix.trace():
                continue
            angle = 0.5 * np.arctan2(2.0 * matrix[i, j], matrix[j, j] - matrix[i, i])
            turn = np.eye(3)
            turn[i, i] = turn[j, j] = np.cos(angle)
            turn[i, j], turn[j, i] = np.sin(angle), -np.sin(angle)
            matrix = _times(_times(turn.T, matrix), turn)
            vectors = _times(vectors, turn)
    return vectors[:, int(np.argmin(matrix.diagonal()))]


def _times(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The product of two small matrices, not by BLAS."""
    return (a[:, :, None] * b[None]).sum(axis=1)


def bed_frame(face: DownFace, up: np.ndarray, start: float, end: float) -> np.ndarray:
    """Model -> bed (4, 4): the origin below the middle of the first end, x towards the last."""
    middle = face.at(np.array([start, end])).mean(axis=1)
    along = middle[1] - middle[0]
    along = along - (along * up).sum() * up
    if np.sqrt((along * along).sum()) < 1e-3 * (end - start):
        # A ring: along its first stretch.
        along = face.rails.derivative(np.array([start]))[0].reshape(2, 3).mean(axis=0)
        along = along - (along * up).sum() * up
    x = along / np.sqrt((along * along).sum())
    frame = np.eye(4)
    frame[:3, :3] = np.array([x, crossed(up, x), up])
    frame[:3, 3] = -(frame[:3, :3] * middle[0]).sum(axis=1)
    return frame


def bed_fault(
    code: str, member: Member, message: str, mend: str, value=None, limit=None
) -> Finding:
    unit = "" if value is None else "mm"
    value = None if value is None else float(value)
    return error(code, member.name, message, mend, value=value, limit=limit, unit=unit)
