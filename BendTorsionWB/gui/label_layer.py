# SPDX-License-Identifier: LGPL-2.1-or-later
"""Labels in the 3D view that thin out: what is near enough to be told apart is named, no two names
lie on each other.

Each label says how much room it names (mm). Before each picture a label is left out when that room
is smaller on the screen than its text, or when a label before it stands there. All layers of a view
share the room, the first drawn first.
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
CELL = 8.0
"""Pixels: the screen is shared out in cells this wide and high."""


@dataclass(frozen=True, eq=False)
class Label:
    """A text at a place (3,); room: mm of the model it names; rank: the lower the earlier; normal:
    (3,) of the face it is on, seen from that side only."""

    text: str
    place: np.ndarray
    colours: tuple[str, str]
    size: int
    room: float
    rank: int = 0
    normal: np.ndarray | None = None

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
        self.shown = np.zeros(len(self.labels), bool)
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
        """Show these labels, (n,) bool; the picture under way is the one to have them, so no other
        is asked for."""
        self.group.enableNotify(False)
        for k in np.nonzero(wanted != self.shown)[0].tolist():
            if k not in self.nodes:
                self.nodes[k] = node_of(self.labels[k])
            if wanted[k]:
                self.group.addChild(self.nodes[k])
            else:
                self.group.removeChild(self.nodes[k])
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


def thinned(pixels, scale, boxes, room, size, taken: set) -> np.ndarray:
    """Which labels are shown (n,) bool. pixels: their places; scale: pixels per millimetre; boxes:
    (n, 2) their widths and heights; room: mm; taken: cells of the view in use, added to."""
    inside = np.all((pixels > -boxes) & (pixels < np.asarray(size)), axis=1)
    wanted = inside & (scale > 0.0) & (room * scale >= boxes.min(axis=1))
    # A label stands to the right of its place and above it. Far away, where a pixel is beyond
    # every screen, it is not looked at; within sight these are small whole numbers.
    reach = np.clip(pixels, -1e6, 1e6)
    low = np.floor(reach / CELL).astype(int)
    high = np.floor((reach + boxes) / CELL).astype(int)
    shown = np.zeros(len(pixels), bool)
    for k in np.nonzero(wanted)[0].tolist():
        (x0, y0), (x1, y1) = low[k].tolist(), high[k].tolist()
        cells = {(x, y) for x in range(x0, x1 + 1) for y in range(y0, y1 + 1)}
        if taken.isdisjoint(cells):
            taken |= cells
            shown[k] = True
    return shown


class _Picture:
    """The picture under way: the camera it is seen by, the layers drawn, the cells in use."""

    key: bytes = b""
    layers: set = set()
    taken: set = set()


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
        _Picture.key, _Picture.layers, _Picture.taken = key, set(), set()
    _Picture.layers.add(id(layer))
    size = (float(region[0]), float(region[1]))
    pixels, scale = on_screen(layer.places, matrix, size)
    scale = np.where(facing(layer.places, layer.normals, matrix), scale, 0.0)
    layer.show(thinned(pixels, scale, layer.pixels, layer.room, size, _Picture.taken))
