# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solids that reach beyond an end, cut there by the kernel, and whether the cut is where it was
computed."""

from __future__ import annotations

from collections.abc import Sequence

import FreeCAD
import numpy as np
import Part

from BendTorsionWB.core.detailing import MemberGeometry, PlateGeometry, member_skins
from BendTorsionWB.core.finding import BendTorsionError, Finding, error
from BendTorsionWB.core.members.contour import FIBRES, EndCurves, bracketed_roots
from BendTorsionWB.core.members.end_cut import PlaneEnd
from BendTorsionWB.core.members.member import EndSurface
from BendTorsionWB.core.plates.plates import Plate
from BendTorsionWB.shapes.cut_ring import CutRing, cut_ring
from BendTorsionWB.shapes.kept_solids import solids_of

ON_CURVE = 0.01
"""mm: the edges of a cut are no farther than this from the curves computed."""
VOLUME_OF_KERNEL = 1e-4
"""Relative: the kernel's volume of faces with many knots is no better than this."""
VOLUME_AT_CUT = 1.0
"""mm: and that of long faces with a curved cut is off by this times the plate's section."""
_GRID = 17
_LOOKED_AT = 129
_CHECKED = np.linspace(0.0, 1.0, 5)
_MARGIN = 0.15


def cut_plate(solid: Part.Shape, plate: Plate, ends: Sequence[int] = (0, 1)) -> Part.Shape:
    """The solid of what a plate is cut from, cut by the kernel at its ends (start 0, end 1).

    Raises BendTorsionError where the kernel leaves no single closed solid, or one that differs
    from the plate in volume or at its cut edges.
    """
    for k, cut in enumerate(plate.cuts):
        if cut is None or k not in ends:
            continue
        rails = plate.uncut.outer, plate.uncut.inner
        a = (rails[0].start, cut.range[0])[k]
        b = (cut.range[1], rails[0].end)[k]
        points = np.concatenate([group(np.linspace(a, b, 9)).reshape(-1, 3) for group in rails])
        for surface in _cuts(plate, cut):
            solid = cut_end(solid, surface, points, _outwards(plate.uncut.mid, k), plate.mark)
        _check_edges(solid, plate, cut)
    if not (solid.isValid() and solid.isClosed()):
        raise _refused(plate.mark, "is not closed")
    mid = plate.rails.mid.values
    width = float(np.sqrt(((mid[..., 3:] - mid[..., :3]) ** 2).sum(axis=2)).max())
    allowed = VOLUME_OF_KERNEL * plate.volume + VOLUME_AT_CUT * plate.thickness * width
    if abs(solid.Volume - plate.volume) > allowed:
        raise _refused(
            plate.mark,
            "has not the volume of the plate",
            value=solid.Volume,
            limit=plate.volume,
            unit="mm3",
        )
    return solid


def plate_solids(plates: Sequence[PlateGeometry]) -> list[tuple[Part.Shape, bool]]:
    """The solids of plates, cut at their ends, and whether each is sound. Raises as
    `cut_plate`, naming every plate."""
    findings: list[Finding] = []
    rings = []
    for item in plates:
        rings.append((None, None))
        try:
            rings[-1] = _rings(item)
        except BendTorsionError as problem:
            findings += problem.findings
    if findings:
        raise BendTorsionError(findings)
    solids = solids_of([item.skin for item in plates], rings)
    for k, item in enumerate(plates):
        ends = [e for e, cut in enumerate(item.plate.cuts) if cut and rings[k][e] is None]
        if not ends:
            continue
        try:
            solids[k] = cut_plate(solids[k][0], item.plate, ends), True
        except BendTorsionError as problem:
            findings += problem.findings
    if findings:
        raise BendTorsionError(findings)
    return solids


def _rings(item: PlateGeometry) -> tuple[CutRing | None, CutRing | None]:
    """The rings of a plate's ends that are cut by one smooth surface; the kernel cuts the others.
    Raises BendTorsionError for a ring that is not where the plate's end was computed."""
    plate = item.plate
    rings: list[CutRing | None] = [None, None]
    for k, cut in enumerate(plate.cuts):
        if cut is None:
            continue
        surfaces = _surfaces(plate, cut)
        if len(surfaces) > 1:
            continue
        piece = item.skin[(0, -1)[k]]
        rings[k] = cut_ring(piece, surfaces[0], sum(cut.range) / 2.0, plate.mark)
        off = float(np.abs(rings[k].places[:2] - cut.corners("outer")).max())
        if off > ON_CURVE:
            raise _refused(
                plate.mark, "is not cut where it was computed", value=off, limit=ON_CURVE, unit="mm"
            )
    return tuple(rings)


def _surfaces(plate: Plate, cut: EndCurves) -> Sequence[EndSurface]:
    """The parts of an end surface a plate ends on: one, or more with corners between them."""
    parts = getattr(cut.surface, "parts", (cut.surface,))
    if len(parts) == 1:
        return parts
    points = []
    for level in ("outer", "inner"):
        value = getattr(plate.uncut, level)(cut.at(level, FIBRES))
        points.append(value[:, :3] + FIBRES[:, None] * (value[:, 3:] - value[:, :3]))
    return [parts[k] for k in np.unique(cut.surface.part_at(np.concatenate(points)))]


def _cuts(plate: Plate, cut: EndCurves) -> Sequence[EndSurface]:
    """The surfaces a plate is cut by one after the other: those of several members that it ends
    on at one node."""
    cuts = getattr(cut.surface, "cuts", (cut.surface,))
    if len(cuts) == 1:
        return cuts
    met = {id(part.faces) for part in _surfaces(plate, cut)}
    return [one for one in cuts if id(one.faces) in met]


def member_solids(geometry: MemberGeometry) -> list[Part.Shape]:
    """The solids of a member's outer skin (of open sections its strips), cut at its ends."""
    tubes, member = member_skins(geometry).tubes, geometry.member
    solids = [solid for solid, _ in solids_of(tubes)]
    for k, end in enumerate(member.ends):
        if end is None:
            continue
        for number, tube in enumerate(tubes):
            piece = tube[(0, -1)[k]]
            if piece.knots[(0, -1)[k]] != member.reach[k]:
                continue
            limits = sorted((member.reach[k], (end.greatest, end.least)[k]))
            points = piece.at(np.linspace(*limits, 9)).reshape(-1, 3)
            rate = member.frames.at(np.array([(0.0, member.length)[k]])).x[0] * (-1.0, 1.0)[k]
            solids[number] = cut_end(solids[number], end.surface, points, rate, member.name)
    return solids


def cut_end(
    solid: Part.Shape, surface: EndSurface, points: np.ndarray, outwards: np.ndarray, name: str
) -> Part.Shape:
    """A solid without what lies beyond an end surface.

    points (n, 3): of the solid from its end to the cut; outwards (3,): unit, along the solid.
    A plane is cut exactly, another surface by a spline through even points of it, each of its
    parts by its own.
    """
    tools = []
    for part in getattr(surface, "parts", (surface,)):
        face, depth = _face(part, points, outwards, name)
        tools.append(face.extrude(FreeCAD.Vector(*(depth * outwards))))
    # What is taken lies beyond every part.
    tool = tools[0] if len(tools) == 1 else tools[0].common(tools[1])
    left = solid.cut(tool).Solids
    if len(left) != 1:
        raise _refused(
            name, "does not come apart at the cut in one piece", value=len(left), limit=1
        )
    return left[0]


def _face(surface, points, outwards, name) -> tuple[Part.Face, float]:
    """A face of the end surface well beyond the points, and how far outwards they reach."""
    across = np.eye(3)[int(np.argmin(np.abs(outwards)))]
    x = np.cross(outwards, across)
    x /= np.linalg.norm(x)
    y = np.cross(outwards, x)
    middle = points.mean(axis=0)
    frame = np.array([x, y, outwards])
    local = (points - middle) @ frame.T
    low, high = local.min(axis=0), local.max(axis=0)
    size = high - low
    low, high = low - _MARGIN * size - 5.0, high + _MARGIN * size + 5.0
    count = 2 if isinstance(surface, PlaneEnd) else _GRID
    u, v = (np.linspace(low[k], high[k], count) for k in (0, 1))
    grid = np.stack([np.repeat(u, count), np.tile(v, count)], axis=1)
    base = middle + grid @ frame[:2]

    def step(h: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        value, gradient = surface.value_and_gradient(base + h[:, None] * outwards)
        return value, gradient @ outwards

    far = 4.0 * float(size.sum()) + 1000.0
    places = np.linspace(low[2] - far, high[2] + far, _LOOKED_AT)
    stays = np.stack([step(np.full(len(base), h))[0] >= 0.0 for h in places])
    leaves = stays[:-1] & ~stays[1:]
    if not leaves.any(axis=0).all():
        raise _refused(name, "is not crossed by the cut all round")
    # The crossing by the points: a round surface may have another, farther out or behind.
    away = np.where(leaves, np.abs(places[:-1] + places[1:])[:, None], np.inf)
    last = np.argmin(away, axis=0)
    height = bracketed_roots(step, places[last], places[last + 1])
    corners = (base + height[:, None] * outwards).reshape(count, count, 3)
    if count == 2:
        ring = [corners[i, j] for i, j in ((0, 0), (1, 0), (1, 1), (0, 1), (0, 0))]
        face = Part.Face(Part.makePolygon([FreeCAD.Vector(*point) for point in ring]))
    else:
        spline = Part.BSplineSurface()
        spline.interpolate([[FreeCAD.Vector(*point) for point in row] for row in corners])
        face = spline.toShape()
    return face, float(high[2] - height.min()) + float(size.sum()) + 100.0


def _outwards(rails, end: int) -> np.ndarray:
    """The direction (3,) in which rails leave their start (0) or their end (1)."""
    place = np.array([(rails.start, rails.end)[end]])
    rate = rails.derivative(place)[0]
    along = (rate[:3] + rate[3:]) * (-1.0, 1.0)[end]
    return along / np.linalg.norm(along)


def _check_edges(solid: Part.Shape, plate: Plate, cut: EndCurves) -> None:
    """Points of the curves must lie on edges of the solid."""
    edges = Part.Compound(solid.Edges)
    worst = 0.0
    for level in ("outer", "inner"):
        value = getattr(plate.uncut, level)(cut.at(level, _CHECKED))
        points = value[:, :3] + _CHECKED[:, None] * (value[:, 3:] - value[:, :3])
        for point in points:
            worst = max(worst, Part.Vertex(FreeCAD.Vector(*point)).distToShape(edges)[0])
    if worst > ON_CURVE:
        raise _refused(
            plate.mark, "is not cut where it was computed", value=worst, limit=ON_CURVE, unit="mm"
        )


def _refused(name: str, what: str, **fields) -> BendTorsionError:
    return BendTorsionError(
        error("solid-refused", name, f"the solid {what}", "report this with the document", **fields)
    )
