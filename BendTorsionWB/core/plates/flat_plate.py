# SPDX-License-Identifier: LGPL-2.1-or-later
"""Flat parts: plane plates with an exact contour in a frame of their own, such as diaphragms."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..geometry import arc_contour
from ..lofting import DevelopedPlate, FlatHole, LoftingPoint, WeldedSide, plate_identity
from ..sections.section import Material
from .openings import fitted_circle

MARKING_FACE = "+s"
"""The side a flat part is marked on and its pattern is seen from: towards the member's end."""


@dataclass(frozen=True, eq=False)
class FlatPlate:
    """A plane plate of a member.

    face and letter: `diaphragm` D, `end` E. frame (4, 4): plane -> model, x along the section's
    breadth, y along its height, z along +s, the origin on the axis and in the middle of the
    thickness. outline and holes: contours (m, 3) in that plane (x, y, bulge); hole_titles say
    what the holes are. s: on the axis. welded: (face, k) of sides of the outline, from vertex k
    to the next, that are welded to the wall of a face, or to another flat part, told by its role
    until that has a mark; fits: (k, gap, dihedral, opens) of those that are not square or have a
    gap, as of a `WeldedSide`; sides: those of which more is known. role: tells a part of a node
    apart from the member's others.
    """

    member: str
    mark: str
    face: str
    letter: str
    piece: int
    thickness: float
    material: Material
    frame: np.ndarray
    outline: np.ndarray
    s: float
    holes: tuple[np.ndarray, ...] = ()
    hole_titles: tuple[str, ...] = ()
    welded: tuple[tuple[str, int], ...] = ()
    fits: tuple[tuple[int, float, float, str], ...] = ()
    sides: tuple[WeldedSide, ...] = ()
    role: str = ""

    @property
    def area(self) -> float:
        """Net area, mm2, exact."""
        return arc_contour.area(self.outline) - sum(map(arc_contour.area, self.holes))

    @property
    def volume(self) -> float:
        return self.area * self.thickness

    @property
    def mass(self) -> float:
        return self.volume * self.material.density

    @property
    def centre_of_gravity(self) -> np.ndarray:
        """(3,) in the model, exact."""
        moment = arc_contour.first_moments(self.outline)
        for hole in self.holes:
            moment = moment - arc_contour.first_moments(hole)
        return self.in_model(moment[None] / self.area)[0]

    @property
    def ring(self) -> np.ndarray:
        """The outline in the model as a closed polyline (n, 3)."""
        points = np.concatenate([run[:-1] for run in arc_contour.runs(self.outline, 0.1)])
        return self.in_model(points[[*range(len(points)), 0]])

    def in_model(self, plane: np.ndarray, z: float = 0.0) -> np.ndarray:
        """Points (n, 3) in the model of points (n, 2) of the plane, z mm along +s from it."""
        frame = self.frame
        return (
            frame[:3, 3]
            + plane[:, :1] * frame[:3, 0]
            + plane[:, 1:] * frame[:3, 1]
            + z * frame[:3, 2]
        )


def developed_flat(flat: FlatPlate) -> DevelopedPlate:
    """The part as a plate's lofting record: seen from its +s side, u along the breadth, v along
    the height; its points `P-n` are the contour's corners on that side."""
    dense = arc_contour.runs(flat.outline)
    everything = np.concatenate(dense)
    low, high = everything.min(axis=0), everything.max(axis=0)
    corners = flat.outline[:, :2]
    along = corners[1] - corners[0]
    along = along / np.hypot(*along)
    turn = np.array([along, [-along[1], along[0]]])
    placing = np.eye(4)
    placing[:3, :3] = _rows(turn, flat.frame[:3, :3].T)
    first = flat.in_model(corners[:1], 0.5 * flat.thickness)[0]
    placing[:3, 3] = -(placing[:3, :3] * first).sum(axis=1)
    flat_to_placing = np.eye(4)
    flat_to_placing[:2, :2] = turn
    flat_to_placing[:2, 3] = -(turn * (corners[0] - low)).sum(axis=1)
    space = flat.in_model(corners, 0.5 * flat.thickness)
    points = tuple(
        LoftingPoint(
            f"P-{k + 1}",
            "",
            "",
            "arris",
            flat.s,
            space[k],
            (placing[:3, :3] * space[k]).sum(axis=1) + placing[:3, 3],
            corners[k] - low,
        )
        for k in range(len(corners))
    )
    return DevelopedPlate(
        **plate_identity(flat),
        outline=tuple(run - low for run in dense),
        lines=(),
        folds=(),
        points=points,
        panels=(),
        length=float(high[0] - low[0]),
        width=float(high[1] - low[1]),
        area=flat.area,
        mass=flat.mass,
        volume=flat.volume,
        s_start=flat.s - 0.5 * flat.thickness,
        s_end=flat.s + 0.5 * flat.thickness,
        length_error_max=0.0,
        length_error_rms=0.0,
        length_error_bound=0.0,
        strain_max=0.0,
        locked_in_stress=0.0,
        bending_radius_min=np.inf,
        forming="flat",
        marking_face=MARKING_FACE,
        placing=placing,
        flat_to_placing=flat_to_placing,
        centre_of_gravity=flat.centre_of_gravity,
        painted_area=flat.area if flat.face == "end" else 0.0,
        welded=(*(_welded(flat, face, k) for face, k in flat.welded), *flat.sides),
        holes=tuple(
            _hole(f"O-{k}", title, arc_contour.moved(hole, shift=-low))
            for k, (hole, title) in enumerate(
                zip(flat.holes, flat.hole_titles, strict=True), start=1
            )
        ),
    )


def _welded(flat: FlatPlate, face: str, k: int) -> WeldedSide:
    ends = flat.outline[[k, (k + 1) % len(flat.outline)], :2]
    length = float(np.hypot(*(ends[1] - ends[0])))
    fits = {vertex: fit for vertex, *fit in flat.fits}
    gap, dihedral, opens = fits.get(k, (0.0, 0.5 * np.pi, ""))
    middle = flat.in_model(ends.mean(axis=0)[None])[0]
    edge = f"P-{k + 1}/P-{(k + 1) % len(flat.outline) + 1}"
    return WeldedSide(face, length, middle, gap=gap, dihedral=dihedral, edge=edge, opens=opens)


def _hole(label: str, title: str, contour: np.ndarray) -> FlatHole:
    dense = arc_contour.runs(contour)
    ring = np.concatenate([run[:-1] for run in dense])
    return FlatHole(label, title, dense, fitted_circle(ring), arc_contour.area(contour))


def _rows(turn: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """The rows of `axes` (3, 3) with the first two turned by (2, 2)."""
    return np.array(
        [
            turn[0, 0] * axes[0] + turn[0, 1] * axes[1],
            turn[1, 0] * axes[0] + turn[1, 1] * axes[1],
            axes[2],
        ]
    )
