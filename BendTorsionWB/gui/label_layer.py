# SPDX-License-Identifier: LGPL-2.1-or-later
"""Labels in the 3D view that thin out: what is near enough to be told apart is named, no two names
lie on each other.

Each label says how much room it names (mm). Before each picture a label is left out when that room
is smaller on the screen than its text, or when labels before it stand at every corner of its place
that it may stand at. All layers of a view share the room, the first drawn first.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from pivy import coin

PER_LETTER, PER_LINE = 0.86, 1.5
"""Width of a letter and height of a line as parts of the size of a text."""
FRAME = 10.0
"""Pixels of the frame around a text, both sides."""
CELL = 16.0
"""Pixels: the screen is shared out in cells this wide and high, to find what stands near."""
CORNERS = np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)])
"""Widths a label stands to the left of its place, heights below it: in the order they are tried."""
LEFT_OUT = -1
"""In place of the number of a corner."""
ALIGNED = tuple(
    f"horAlignment {('LEFT', 'RIGHT')[int(left)]} vertAlignment {('BOTTOM', 'TOP')[int(below)]}"
    for left, below in CORNERS
)
"""What Coin calls them."""


@dataclass(frozen=True, eq=False)
class Label:
    """A text at a place (3,); room: mm of the model it names; rank: the lower the earlier; normal:
    (3,) of the face it is on, seen from that side only; corners: how many of CORNERS it may stand
    at."""

    text: str
    place: np.ndarray
    colours: tuple[str, str]
    size: int
    room: float
    rank: int = 0
    normal: np.ndarray | None = None
    corners: int = 1

    @property
    def pixels(self) -> tuple[float, float]:
        """Width and height on the screen."""
        return PER_LETTER * self.size * len(self.text) + FRAME, PER_LINE * self.size + FRAME


class LabelLayer:
    """The labels of one object as a node; `node` goes into the scene."""

    def __init__(self, labels: Sequence[Label]):
        self.labels = sorted(labels, key=lambda label: label.rank)
        self.places = np.array([label.place for label in self.labels]).reshape(-1, 3)
        self.pixels = np.array([label.pixels for label in self.labels]).reshape(-1, 2)
        self.room = np.array([label.room for label in self.labels])
        nothing = np.zeros(3)
        self.normals = np.array(
            [nothing if label.normal is None else label.normal for label in self.labels]
        ).reshape(-1, 3)
        self.corners = np.array([label.corners for label in self.labels], int)
        self.shown = np.full(len(self.labels), LEFT_OUT)
        self.node, self.group = coin.SoSeparator(), coin.SoGroup()
        self.node.renderCaching = coin.SoSeparator.OFF
        before = coin.SoCallback()
        before.setCallback(_thin_out, self)
        # Names of faces turned away are left out; those that are shown are shown whole.
        front = coin.SoDepthBuffer()
        front.test = False
        self.node.addChild(before)
        self.node.addChild(front)
        self.node.addChild(self.group)
        # A building has ten thousand labels, of which a few hundred are ever seen.
        self.nodes: dict[int, coin.SoSeparator] = {}

    def show(self, wanted: np.ndarray) -> None:
        """Show labels at these corners, (n,), or leave them out; the picture under way is the one
        to have them, so no other is asked for."""
        self.group.enableNotify(False)
        for k in np.nonzero(wanted != self.shown)[0].tolist():
            if k not in self.nodes:
                self.nodes[k] = node_of(self.labels[k])
            if self.shown[k] != LEFT_OUT:
                self.group.removeChild(self.nodes[k])
            if wanted[k] != LEFT_OUT:
                self.nodes[k].getChild(1).set(ALIGNED[wanted[k]])
                self.group.addChild(self.nodes[k])
        self.group.enableNotify(True)
        self.shown = wanted


def node_of(label: Label) -> coin.SoSeparator:
    """Text at its place, always facing the viewer, on a ground of its own."""
    made = coin.SoSeparator()
    move = coin.SoTranslation()
    move.translation.setValue(*map(float, label.place))
    made.addChild(move)
    frame = coin.SoType.fromName("SoFrameLabel").createInstance()
    frame.set(f'string "{label.text}" textColor {label.colours[0]}')
    # Without a frame it has no ground either, and is not read on plates of every colour.
    frame.set(f"backgroundColor {label.colours[1]} size {label.size} frame TRUE")
    made.addChild(frame)
    return made


def on_screen(places: np.ndarray, matrix: np.ndarray, size) -> tuple[np.ndarray, np.ndarray]:
    """Pixels (n, 2) of places (n, 3) from the lower left, and the pixels a millimetre takes there
    (n,), 0 behind the eye. matrix: (4, 4) of the camera, rows as Coin has them; size: of the view.
    """
    size = np.asarray(size, float)
    clip = np.concatenate([places, np.ones((len(places), 1))], axis=1) @ matrix
    depth = clip[:, 3]
    before = depth > 1e-9
    safe = np.where(before, depth, 1.0)
    pixels = (0.5 * clip[:, :2] / safe[:, None] + 0.5) * size
    # A millimetre across the line of sight: the longest of the columns that make the screen's y.
    scale = 0.5 * size[1] * np.linalg.norm(matrix[:3, 1]) / safe
    return pixels, np.where(before, scale, 0.0)


def facing(places: np.ndarray, normals: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """Which places (n, 3) are on faces turned to the eye (n,) bool; normals: (n, 3), 0 for none."""
    depths = []
    for points in (places, places + normals):
        clip = np.concatenate([points, np.ones((len(points), 1))], axis=1) @ matrix
        depths.append(clip[:, 2] / np.where(np.abs(clip[:, 3]) > 1e-9, clip[:, 3], 1.0))
    return (depths[1] <= depths[0]) | ~normals.any(axis=1)


def thinned(pixels, scale, boxes, room, corners, size, taken: dict) -> np.ndarray:
    """The corner each label stands at (n,), or LEFT_OUT. pixels: their places; scale: pixels per
    millimetre; boxes: (n, 2) their widths and heights; room: mm; corners: (n,) how many of CORNERS
    are tried; taken: by cell of the view, the boxes that reach into it, added to."""
    inside = np.all((pixels > -boxes) & (pixels < np.asarray(size)), axis=1)
    wanted = inside & (scale > 0.0) & (room * scale >= boxes.min(axis=1))
    # Far away, where a pixel is beyond every screen, it is not looked at; within sight these are
    # small whole numbers.
    low = np.clip(pixels, -1e6, 1e6)[:, None] - CORNERS * boxes[:, None]
    sides = np.concatenate([low, low + boxes[:, None]], axis=2)
    reach = np.floor(sides / CELL).astype(int)
    shown = np.full(len(pixels), LEFT_OUT)
    for k in np.nonzero(wanted)[0].tolist():
        for corner in range(corners[k]):
            x0, y0, x1, y1 = reach[k, corner].tolist()
            cells = [(x, y) for x in range(x0, x1 + 1) for y in range(y0, y1 + 1)]
            box = sides[k, corner].tolist()
            if not any(_overlap(box, one) for cell in cells for one in taken.get(cell, ())):
                for cell in cells:
                    taken.setdefault(cell, []).append(box)
                shown[k] = corner
                break
    return shown


def _overlap(one: Sequence[float], other: Sequence[float]) -> bool:
    """Whether two boxes (left, lower, right, upper) have more than a side in common."""
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


class _Picture:
    """The picture under way: the camera it is seen by, the layers drawn, the boxes in its cells."""

    key: bytes = b""
    layers: set = set()
    taken: dict = {}


def _thin_out(layer: LabelLayer, action) -> None:
    """Called by Coin before it draws a layer."""
    if not action.isOfType(coin.SoGLRenderAction.getClassTypeId()) or not layer.labels:
        return
    state = action.getState()
    # What follows depends on the camera, whatever separators above would keep.
    coin.SoCacheElement.invalidate(state)
    model = np.array(coin.SoModelMatrixElement.get(state).getValue())
    pixels_of = coin.SoViewportRegionElement.get(state).getViewportSizePixels()
    region = (pixels_of[0], pixels_of[1])  # getValue() of newer pivy is a bare address
    camera = np.array(coin.SoViewVolumeElement.get(state).getMatrix().getValue())
    key = camera.tobytes() + repr(region).encode()
    matrix = model @ camera
    if key != _Picture.key or id(layer) in _Picture.layers:
        _Picture.key, _Picture.layers, _Picture.taken = key, set(), {}
    _Picture.layers.add(id(layer))
    size = (float(region[0]), float(region[1]))
    pixels, scale = on_screen(layer.places, matrix, size)
    scale = np.where(facing(layer.places, layer.normals, matrix), scale, 0.0)
    given = pixels, scale, layer.pixels, layer.room, layer.corners
    layer.show(thinned(*given, size, _Picture.taken))
