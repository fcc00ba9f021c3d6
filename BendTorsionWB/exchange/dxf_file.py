# SPDX-License-Identifier: LGPL-2.1-or-later
"""DXF files: the frame of a file by ezdxf, once for all files, and our entities written into it.

The few kinds of entities are plain text; through ezdxf's objects they take five times as long.
"""

from __future__ import annotations

import io
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

_DECIMALS = 6  # of coordinates, mm
_DASHED = [18.0, 12.0, -6.0]  # mm: pattern length, dash, gap

# Numbers that stand in the frame for the extents, the middle and the height of the view.
_LOW, _HIGH, _MIDDLE = (-71111.25, -72222.25), (73333.25, 74444.25), (75555.25, 76666.25)
_VIEW_HEIGHT = 77777.25
_PLACES = re.compile(r"  0\nPOINT\n  5\n([0-9A-F]+)\n330\n([0-9A-F]+)\n.*?\n 30\n0\.0\n", re.S)
_SEED = re.compile(r"(\$HANDSEED\n  5\n)([0-9A-F]+)")
_ENTITIES, _SECTION_END = "\n  2\nENTITIES\n", "  0\nENDSEC\n"
_ENTITY = re.compile(r"  0\n([A-Z]+)\n  5\n[0-9A-F]+\n330\n[0-9A-F]+\n100\nAcDbEntity\n  8\n")
_FAR_CORNER = re.compile(r"\$EXTMAX\n 10\n(.*)\n 20\n(.*)\n")


@dataclass(frozen=True)
class Layer:
    """A layer: its name in the file, AutoCAD colour index, line type, and what is on it."""

    name: str
    colour: int
    linetype: str
    description: str


@dataclass
class Space:
    """Entities of the model or of a block, as (kind, layer, text of what is special to it)."""

    entities: list[tuple[str, str, str]] = field(default_factory=list)

    def add_line(self, start, end, layer: str) -> None:
        """A line between two points (2,)."""
        body = f"100\nAcDbLine\n{_xyz(start)}{_xyz(end, 1)}"
        self.entities.append(("LINE", layer, body))

    def add_point(self, at, layer: str) -> None:
        """A point at (2,)."""
        self.entities.append(("POINT", layer, f"100\nAcDbPoint\n{_xyz(at)}"))

    def add_polyline(self, vertices: np.ndarray, layer: str, close: bool = True) -> None:
        """An LWPOLYLINE through vertices (m, 3): x, y, bulge."""
        rows = [f"100\nAcDbPolyline\n 90\n{len(vertices)}\n 70\n{int(close)}\n"]
        for x, y, bulge in np.asarray(vertices, float).tolist():
            rows.append(f" 10\n{figure(x)}\n 20\n{figure(y)}\n")
            # Rounding keeps last-bit differences between machines out of the file.
            bulge = round(bulge, 12)
            if bulge:
                rows.append(f" 42\n{bulge}\n")
        self.entities.append(("LWPOLYLINE", layer, "".join(rows)))

    def add_text(self, text: str, corner, reading, height: float, layer: str) -> None:
        """A line of text from its lower left corner along `reading`, a unit vector."""
        printable = "".join(letter if letter.isprintable() else " " for letter in text)
        angle = round(math.degrees(math.atan2(reading[1], reading[0])), _DECIMALS) + 0.0
        turn = f" 50\n{angle}\n" if angle else ""
        body = (
            f"100\nAcDbText\n{_xyz(corner)} 40\n{height}\n  1\n{printable}\n{turn}100\nAcDbText\n"
        )
        self.entities.append(("TEXT", layer, body))

    def add_block(self, name: str, at) -> None:
        """A block at scale 1 at a place (2,)."""
        body = f"100\nAcDbBlockReference\n  2\n{name}\n{_xyz(at)}"
        self.entities.append(("INSERT", "0", body))


def dxf_bytes(
    layers: Sequence[Layer],
    corners: np.ndarray,
    model: Space,
    blocks: Mapping[str, Space] | None = None,
    frame: Frame | None = None,
) -> bytes:
    """The file: DXF R2010, mm, without time stamps and unique identifiers.

    layers: of the file; corners (n, 2): of what is drawn, the view shows them all; frame: of these
    layers and blocks, where it was made before.
    """
    blocks = blocks or {}
    names = tuple(blocks)
    if frame is None:
        frame = new_frame(tuple(layers), names) if names else _frame(tuple(layers), ())
    text, handle = _with_entities(frame, [model, *blocks.values()])
    for stand_in, value in _view(np.asarray(corners, float)):
        text = text.replace(f"\n{stand_in}\n", f"\n{value}\n")
    text = _SEED.sub(rf"\g<1>{handle:X}", text, count=1)
    return text.encode("utf-8", "replace")


def read_model(content: bytes) -> tuple[Space, tuple[float, float]]:
    """What `dxf_bytes` drew in the model of a file of ours, and the far corner of its extents: to
    be drawn again elsewhere. Reads no other DXF."""
    text = content.decode("utf-8")
    start = text.index(_ENTITIES) + len(_ENTITIES)
    _, *found = _ENTITY.split(text[start : text.index(_SECTION_END, start)])
    entities = [
        (kind, *rest.split("\n", 1)) for kind, rest in zip(found[::2], found[1::2], strict=True)
    ]
    x, y = _FAR_CORNER.search(text).groups()
    return Space(entities), (float(x), float(y))


def place(flat) -> tuple[float, float]:
    """A point as written."""
    return figure(flat[0]), figure(flat[1])


def figure(value: float) -> float:
    """A coordinate as written; adding zero turns -0.0 into 0.0."""
    return round(float(value), _DECIMALS) + 0.0


def _xyz(at, which: int = 0) -> str:
    return f" 1{which}\n{figure(at[0])}\n 2{which}\n{figure(at[1])}\n 3{which}\n0.0\n"


def _view(corners: np.ndarray) -> Iterable[tuple[float, float]]:
    low, high = corners.min(axis=0), corners.max(axis=0)
    yield from zip(_LOW, place(low), strict=True)
    yield from zip(_HIGH, place(high), strict=True)
    yield from zip(_MIDDLE, place(0.5 * (low + high)), strict=True)
    size = high - low
    yield _VIEW_HEIGHT, figure(1.1 * max(float(size[1]), float(size[0]) / 2.0, 1.0))


@dataclass(frozen=True)
class Frame:
    """The text of a file in parts, entities belong between them; owners: of each gap, the handle
    of its block; order: number of the space of each gap; free: the first handle not in use."""

    parts: tuple[str, ...]
    owners: tuple[str, ...]
    order: tuple[int, ...]
    free: int


def _with_entities(frame: Frame, spaces: Sequence[Space]) -> tuple[str, int]:
    text, handle = [frame.parts[0]], frame.free
    for part, owner, number in zip(frame.parts[1:], frame.owners, frame.order, strict=True):
        for kind, layer, body in spaces[number].entities:
            text.append(
                f"  0\n{kind}\n  5\n{handle:X}\n330\n{owner}\n100\nAcDbEntity\n  8\n{layer}\n{body}"
            )
            handle += 1
        text.append(part)
    return "".join(text), handle


@lru_cache(maxsize=8)
def _frame(layers: tuple[Layer, ...], names: tuple[str, ...]) -> Frame:
    return new_frame(layers, names)


def new_frame(layers: tuple[Layer, ...], names: tuple[str, ...]) -> Frame:
    """The frame of a file with these layers and blocks: written by ezdxf with a point in the model
    and in every block where entities belong."""
    # It takes a sixth of the time this program takes to start, and workers write these files.
    import ezdxf

    document = ezdxf.new("R2010")
    header = document.header
    header["$INSUNITS"] = 4
    header["$MEASUREMENT"] = 1
    header["$LUNITS"] = 2
    header["$PDMODE"] = 2
    header["$PDSIZE"] = 10.0
    document.linetypes.add("DASHED", pattern=_DASHED, description="Dashed __ __ __ __")
    for own in layers:
        made = document.layers.add(own.name, color=own.colour, linetype=own.linetype)
        made.description = own.description
    space = document.modelspace()
    space.dxf.extmin, space.dxf.extmax = (*_LOW, 0.0), (*_HIGH, 0.0)
    space.dxf.limmin, space.dxf.limmax = _LOW, _HIGH
    document.set_modelspace_vport(_VIEW_HEIGHT, _MIDDLE)
    spaces = [space, *map(document.blocks.new, names)]
    numbers = {own.add_point((0.0, 0.0)).dxf.handle: k for k, own in enumerate(spaces)}
    text = _text(document)
    found = list(_PLACES.finditer(text))
    ends = [0, *(match.end() for match in found)]
    starts = [*(match.start() for match in found), len(text)]
    return Frame(
        tuple(text[a:b] for a, b in zip(ends, starts, strict=True)),
        tuple(match[2] for match in found),
        tuple(numbers[match[1]] for match in found),
        int(_SEED.search(text)[2], 16),
    )


def _text(document) -> str:
    import ezdxf

    document.ezdxf_metadata()["CREATED_BY_EZDXF"] = ezdxf.__version__
    # ezdxf declares the types in use in the order of a set, another one in every process.
    for name in sorted(document.entitydb.dxf_types_in_use()):
        document.classes.add_class(name)
    stream = io.StringIO()
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        document.write(stream)
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before
    return stream.getvalue()
