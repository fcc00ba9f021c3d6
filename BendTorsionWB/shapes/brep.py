# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tubes (plates, box skins, bars) as exact Part solids, written as B-rep text and parsed.

A *tube* is a ring of m >= 3 rails that run together over one or more smooth pieces:

    [(knots, poles), ...]    knots (n + 4,) flat, cubic, clamped; poles (m, n, 3) in mm

The rails of a piece share its knots; a piece starts on the end poles of the one before (the
fold). Between rail j and rail j + 1 the face is ruled: degree 3 along, 1 across. The first and
last ring are the section planes of the ends. A plate has m = 4: outer first, outer second, inner
second, inner first edge. Either sense of the ring will do; faces always look outwards.

Faces of a solid come in this order: piece by piece, in each rail by rail (face j between rails j
and j + 1), then the start cap, then the end cap: m * pieces + 2 in all. Edges, vertices and poles
are shared. Tubes closed along s are not made here.

Nothing is fitted, sewn or paired by the kernel, so that what was computed is what is built.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import FreeCAD
import numpy as np
import Part

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.shapes.brep_text import TOLERANCE, BrepText

PLANE_TOLERANCE = 1e-8
"""mm: corners of an end this near to their mean plane make a plane cap."""

_SHELL = "Sh\n\n0101100\n%s*\n"
_SOLID = "So\n\n1100000\n+%d 0 *\n"

_YZX, _ZXY = (1, 2, 0), (2, 0, 1)

Piece = tuple[np.ndarray, np.ndarray]
Cuts = tuple
"""Per end the `cut_ring.CutRing` it is cut at, or None."""


def tube_text(pieces: Sequence[Piece]) -> str:
    """The tube's solid as B-rep text. Raises as `tube_solid`."""
    text = _Text(_shape_count(pieces))
    text.tube(pieces, "tube")
    return text.whole()


def tube_solid(pieces: Sequence[Piece]) -> Part.Solid:
    """The tube's solid, faces in the order the module names.

    pieces: [(knots (n + 4,), poles (m, n, 3)), ...]. ValueError when the arrays do not have this
    form, BendTorsionError when rails meet, pieces part, the tube has no volume, or a cap that is
    not a quadrilateral is not plane.
    """
    text = _Text(_shape_count(pieces))
    text.tube(pieces, "tube")
    return text.parsed().Solids[0]


def tube_solids(
    tubes: Sequence[Sequence[Piece]], cuts: Sequence[Cuts] | None = None
) -> list[Part.Solid]:
    """The solids of many tubes, parsed as one text; cuts: per tube the rings of its ends that are
    cut. Errors as `tube_solid`, naming `tube k`."""
    if not tubes:
        return []
    text = _Text(sum(map(_shape_count, tubes)) + 1)
    both = zip(tubes, cuts or [(None, None)] * len(tubes), strict=True)
    solids = [text.tube(pieces, f"tube {k}", cut) for k, (pieces, cut) in enumerate(both, 1)]
    text.compound(solids)
    return text.parsed().Solids


def compound(shapes: Iterable[Part.Shape]) -> Part.Compound:
    """The shapes, in their order, as one compound."""
    return Part.Compound(list(shapes))


def as_built(shape: Part.Shape) -> Part.Shape:
    """The shape of an object that was built in document coordinates, wherever its Placement says
    that it is."""
    if shape.Placement.isIdentity():
        return shape
    shape = shape.copy(False)
    shape.Placement = FreeCAD.Placement()
    return shape


def empty() -> Part.Compound:
    """A compound of nothing: what an object in error shows (a null shape leaves views stale)."""
    return Part.Compound([])


def _shape_count(pieces: Sequence[Piece]) -> int:
    """Vertices, edges, wires, faces, shell and solid of a tube."""
    rails, spans = len(pieces[0][1]), len(pieces)
    return 2 * rails * (spans + 1) + 3 * rails * spans + 6


class _Text(BrepText):
    """The text of tubes."""

    def tube(self, pieces: Sequence[Piece], name: str, cuts: Cuts = (None, None)) -> int:
        """Append one tube; its solid's number. cuts: the rings of ends that are cut."""
        pieces = _checked(pieces, name)
        rings = np.stack([pieces[0][1][:, 0]] + [poles[:, -1] for _, poles in pieces])
        cut = {k: own for k, own in zip((0, len(pieces)), cuts, strict=True) if own is not None}
        for k, own in cut.items():
            rings[k] = own.points
        outwards = _handedness(pieces, name) < 0
        count = rings.shape[1]
        following = [*range(1, count), 0]
        steps = rings[:, following] - rings
        lengths = np.sqrt(np.einsum("kjx,kjx->kj", steps, steps))
        if lengths.min() <= TOLERANCE:
            k, j = np.argwhere(lengths <= TOLERANCE)[0]
            raise BendTorsionError(
                error(
                    "solid-rails-meet",
                    name,
                    "two neighbouring edges of the solid meet",
                    "give the plate a breadth and a thickness there",
                    position=f"ring {k + 1}, rails {j + 1} and {following[j] + 1}",
                    value=float(lengths[k, j]),
                    limit=TOLERANCE,
                    unit="mm",
                )
            )
        directions = steps / lengths[..., None]

        # Surfaces come first: edges name those they bound.
        built = [self.piece(knots, poles, following) for knots, poles in pieces]
        rails, faces = zip(*built, strict=True)
        spans = [(float(knots[0]), float(knots[-1])) for knots, _ in pieces]
        ends = [k for k in (0, len(pieces)) if k not in cut]
        caps = self.caps(rings[ends], lengths[ends], directions[ends], name) if ends else ()
        caps = dict(zip(ends, caps, strict=True))
        caps |= {k: (self.surface(own.surface), ()) for k, own in cut.items()}

        texts = [[" ".join(map(repr, point)) for point in ring] for ring in rings.tolist()]
        vertices = [[self.vertex(point) for point in ring] for ring in texts]
        across = []
        for k, ring in enumerate(vertices):
            row = []
            for j, (curve, on_face, on_cap) in enumerate(cut[k].sides if k in cut else ()):
                traces = [(on_face, faces[0 if k == 0 else -1][j]), (on_cap, caps[k][0])]
                row.append(self.edge(curve, "0 1", traces, ring[j], ring[following[j]]))
            for j, length in enumerate(() if k in cut else lengths[k].tolist()):
                traces = []
                if k > 0:
                    u = spans[k - 1][1]
                    traces.append((trace(u, 0, u, 1, length), faces[k - 1][j]))
                if k < len(pieces):
                    u = spans[k][0]
                    traces.append((trace(u, 0, u, 1, length), faces[k][j]))
                if k in caps:
                    traces.append((caps[k][1][j], caps[k][0]))
                line = f"1 {texts[k][j]} {' '.join(map(repr, directions[k, j].tolist()))}\n"
                row.append(self.edge(line, f"0 {length!r}", traces, ring[j], ring[following[j]]))
            across.append(row)

        def limits(k: int, j: int) -> str:
            u0 = float(cut[0].places[j]) if k == 0 and 0 in cut else spans[k][0]
            last = k + 1 == len(pieces) and k + 1 in cut
            return f"{u0!r} {float(cut[k + 1].places[j]) if last else spans[k][1]!r}"

        along = [
            [
                self.edge(
                    rails[k][j],
                    limits(k, j),
                    [("1 0 0 1 0\n", faces[k][j]), ("1 0 1 1 0\n", faces[k][j - 1])],
                    vertices[k][j],
                    vertices[k + 1][j],
                )
                for j in range(count)
            ]
            for k in range(len(pieces))
        ]
        sides = [
            self.side(
                faces[k][j],
                f"+{along[k][j]} 0 +{across[k + 1][j]} 0 "
                f"-{along[k][following[j]]} 0 -{across[k][j]} 0 ",
            )
            for k in range(len(pieces))
            for j in range(count)
        ]
        start, end = [
            self.side(caps[k][0], "".join(f"+{edge} 0 " for edge in across[k]))
            for k in sorted(caps)
        ]
        side, other = ("+", "-") if outwards else ("-", "+")
        shell = "".join(f"{side}{face} 0 " for face in (*sides, start)) + f"{other}{end} 0 "
        return self.shape(_SOLID % self.shape(_SHELL % shell))

    def side(self, surface: int, edges: str) -> int:
        """A face of one wire."""
        return self.face(surface, f"+{self.wire(edges)} 0 ")

    def piece(self, knots, poles, following) -> tuple[list[str], list[int]]:
        """A piece's rail curve texts and surface numbers."""
        values, counts = np.unique(knots, return_counts=True)
        pairs = zip(values.tolist(), counts.tolist(), strict=True)
        table = "".join(map("%r %d\n".__mod__, pairs))
        count, n, _ = poles.shape
        points = list(map("%.17g %.17g %.17g ".__mod__, map(tuple, poles.reshape(-1, 3).tolist())))
        lines = [points[j * n : (j + 1) * n] for j in range(count)]
        curve = f"7 0 0 3 {n} {len(values)} %s\n{table}"
        surface = f"9 0 0 0 0 3 1 {n} 2 {len(values)} 2 %s\n{table}0 2\n1 2\n"
        return [curve % "".join(line) for line in lines], [
            self.surface(surface % "".join(map(str.__add__, line, lines[following[j]])))
            for j, line in enumerate(lines)
        ]

    def caps(self, rings, lengths, directions, name) -> list[tuple[int, list[str]]]:
        """Of both ends: the surface's number, and the pcurve texts of its edges, all round."""
        origins = rings.mean(1)
        centred = rings - origins[:, None]
        normals = _area_vector(centred)
        areas = np.sqrt(np.einsum("kx,kx->k", normals, normals))
        if (areas <= TOLERANCE * lengths.sum(1)).any():
            raise BendTorsionError(
                error(
                    "solid-end-without-area",
                    name,
                    "an end of the solid has no area",
                    "give the plate a breadth and a thickness there",
                    value=float(areas.min()),
                    unit="mm²",
                )
            )
        normals = normals / areas[:, None]
        heights = np.einsum("kjx,kx->kj", centred, normals)
        # The projections of the corners on the mean plane: x towards the second one.
        x = directions[:, 0] - np.einsum("kx,kx->k", directions[:, 0], normals)[:, None] * normals
        x = x / np.sqrt(np.einsum("kx,kx->k", x, x))[:, None]
        y = (normals[:, _YZX] * x[:, _ZXY]) - (normals[:, _ZXY] * x[:, _YZX])
        axes = np.stack([x, y], axis=2)
        frames = np.concatenate([origins, normals, x, y], axis=1).tolist()
        lines = np.concatenate([centred @ axes, directions @ axes], axis=2).tolist()
        out = []
        for ring, frame, line, sides, height in zip(
            rings.tolist(),
            frames,
            lines,
            lengths.tolist(),
            np.abs(heights).max(1).tolist(),
            strict=True,
        ):
            if height <= PLANE_TOLERANCE:
                surface = f"1 {' '.join(map(repr, frame))}\n"
                traces = [f"1 {' '.join(map(repr, values))}\n" for values in line]
            elif len(ring) == 4:
                a, b, c, d = (" ".join(map(repr, point)) for point in ring)
                surface = f"9 0 0 0 0 1 1 2 2 2 2 {a} {d} {b} {c}\n0 2\n1 2\n0 2\n1 2\n"
                turns = ((0, 0, 1, 0), (1, 0, 1, 1), (1, 1, 0, 1), (0, 1, 0, 0))
                traces = [trace(*turn, side) for turn, side in zip(turns, sides, strict=True)]
            else:
                raise BendTorsionError(
                    error(
                        "solid-end-not-plane",
                        name,
                        "the corners of an end do not lie in one plane",
                        "end the rails in one plane",
                        value=height,
                        limit=PLANE_TOLERANCE,
                        unit="mm",
                    )
                )
            out.append((self.surface(surface), traces))
        return out


def trace(u0: float, v0: float, u1: float, v1: float, length: float) -> str:
    """The straight pcurve from (u0, v0) to (u1, v1), run through by lengths 0 … length."""
    return f"7 0 0 1 2 2 {u0!r} {v0!r} {u1!r} {v1!r}\n0 2\n{length!r} 2\n"


def _checked(pieces: Sequence[Piece], name: str) -> list[Piece]:
    """The pieces as float arrays, each started on the end of the one before."""
    out = []
    for k, (knots, poles) in enumerate(pieces, 1):
        knots, poles = np.asarray(knots, float), np.asarray(poles, float)
        if poles.ndim != 3 or poles.shape[0] < 3 or poles.shape[1] < 4 or poles.shape[2] != 3:
            raise ValueError(f"{name}, piece {k}: poles {poles.shape} are not (>= 3, >= 4, 3)")
        if knots.shape != (poles.shape[1] + 4,):
            raise ValueError(f"{name}, piece {k}: knots {knots.shape} do not fit {poles.shape}")
        if not (np.isfinite(knots).all() and np.isfinite(poles).all()):
            raise ValueError(f"{name}, piece {k}: knots or poles are not finite")
        if (
            (np.diff(knots) < 0).any()
            or knots[0] != knots[3]
            or knots[-1] != knots[-4]
            or (knots[4:-2] == knots[2:-4]).any()
        ):
            raise ValueError(f"{name}, piece {k}: knots are not cubic, clamped and smooth inside")
        if out:
            last = out[-1][1]
            if len(last) != len(poles):
                raise ValueError(f"{name}, piece {k}: {len(poles)} rails after {len(last)}")
            gap = float(np.abs(last[:, -1] - poles[:, 0]).max())
            if gap > TOLERANCE:
                raise BendTorsionError(
                    error(
                        "solid-pieces-apart",
                        name,
                        "a piece does not start where the last one ends",
                        "build neighbouring pieces on the same end points",
                        position=f"piece {k}",
                        value=gap,
                        limit=TOLERANCE,
                        unit="mm",
                    )
                )
            if gap:
                poles = poles.copy()
                poles[:, 0] = last[:, -1]
        out.append((knots, poles))
    return out


def _area_vector(rings: np.ndarray) -> np.ndarray:
    """½ Σ p_j × p_(j+1) over rings (..., m, 3): area times the normal the ring turns about."""
    products = rings.swapaxes(-1, -2) @ np.concatenate([rings[..., 1:, :], rings[..., :1, :]], -2)
    return 0.5 * (products - products.swapaxes(-1, -2))[..., _YZX, _ZXY]


def _handedness(pieces: Sequence[Piece], name: str) -> float:
    """∫ A · dc along the rings of poles: about the volume, > 0 when they turn about +s."""
    rings = np.concatenate([poles for _, poles in pieces], axis=1).swapaxes(0, 1)
    centres = rings.mean(1)
    areas = _area_vector(rings - centres[:, None])
    steps = centres[1:] - centres[:-1]
    volume = float(0.5 * np.einsum("ix,ix->", areas[1:] + areas[:-1], steps))
    limit = TOLERANCE * float(np.ptp(centres, axis=0).max() * np.ptp(rings[0], axis=0).max())
    if abs(volume) <= limit:
        raise BendTorsionError(
            error(
                "solid-without-volume",
                name,
                "the solid has no volume",
                "check breadth and thickness",
                value=volume,
                limit=limit,
                unit="mm³",
            )
        )
    return volume
