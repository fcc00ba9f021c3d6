# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes the pictures of docs/members.md in docs/images: sections and alignments.

Run with plain Python, /usr/bin/python3 docs/make_member_pictures.py. Plates are drawn from their
skins with a depth buffer, so that nothing but numpy and Qt's painter is needed.
"""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from PySide2 import QtCore, QtGui  # noqa: E402

from BendTorsionWB.core import detailing  # noqa: E402
from BendTorsionWB.core.axes.axis_input import AxisInput  # noqa: E402
from BendTorsionWB.core.geometry.surface import analytic_surface  # noqa: E402
from BendTorsionWB.core.members.segment import Segment  # noqa: E402
from BendTorsionWB.core.sections.section import box  # noqa: E402
from BendTorsionWB.core.sections.section_strips import StripRow, strip_list  # noqa: E402
from BendTorsionWB.core.sections.section_types import (  # noqa: E402
    channel,
    i_section,
    polygon,
    t_section,
    trapezoid,
)

IMAGES = ROOT / "docs" / "images"
CELL = (300, 210)
OVER = 3
"""Each pixel is the mean of OVER x OVER."""
COLOURS = ((232, 150, 70), (150, 100, 60), (95, 145, 195), (70, 110, 150), (120, 160, 110))
AXIS, LINE, SURFACE = (200, 30, 30), (40, 40, 40), (40, 90, 200)
VIEW = np.array([0.78, -0.5, 0.42])
"""From where it is seen, for a member along +x."""


@dataclass
class Scene:
    """Triangles (n, 3, 3) with colours (n, 3), lines on them, and lines seen through all."""

    triangles: list
    colours: list
    lines: list
    over: list

    def member(self, plates: detailing.MemberPlates) -> None:
        strips = list(dict.fromkeys(item.plate.strip for item in plates.plates))
        for item in plates.plates:
            colour = COLOURS[strips.index(item.plate.strip) % len(COLOURS)]
            for piece in item.skin:
                s = np.linspace(piece.knots[0], piece.knots[-1], 25)
                rails = piece.at(s)
                for j in range(4):
                    self.quads(rails[:, j], rails[:, (j + 1) % 4], colour)
                    self.lines.append((rails[:, j], LINE))
            for ring in (item.skin[0].poles[:, 0], item.skin[-1].poles[:, -1]):
                self.triangles += [ring[[0, 1, 2]], ring[[0, 2, 3]]]
                self.colours += [colour] * 2
                self.lines.append((ring[[0, 1, 2, 3, 0]], LINE))
        axis = plates.geometry.member.frames.axis
        s = np.linspace(-0.06 * axis.length, 1.06 * axis.length, 60)
        self.over.append((axis.position(s), AXIS))

    def quads(self, one, other, colour) -> None:
        for k in range(len(one) - 1):
            self.triangles += [
                np.array([one[k], one[k + 1], other[k + 1]]),
                np.array([one[k], other[k + 1], other[k]]),
            ]
            self.colours += [colour] * 2


def drawn(scene: Scene, view=VIEW, up=(0.0, 0.0, 1.0), size=CELL) -> np.ndarray:
    """The scene as (height, width, 3) bytes, seen from direction `view`, filling the size."""
    view = np.asarray(view, float) / np.linalg.norm(view)
    right = np.cross(np.asarray(up, float), view)
    right /= np.linalg.norm(right)
    frame = np.array([right, np.cross(view, right), view])
    triangles = np.array(scene.triangles) @ frame.T
    lines = [(points @ frame.T, colour) for points, colour in scene.lines]
    over = [(points @ frame.T, colour) for points, colour in scene.over]
    everything = np.concatenate([triangles.reshape(-1, 3), *(p for p, _ in over + lines)])
    low, high = everything[:, :2].min(axis=0), everything[:, :2].max(axis=0)
    width, height = size[0] * OVER, size[1] * OVER
    scale = 0.94 * min(width / (high[0] - low[0]), height / (high[1] - low[1]))
    middle = 0.5 * (low + high)

    def pixels(points):
        flat = (points[..., :2] - middle) * [scale, -scale] + [width / 2, height / 2]
        return np.concatenate([flat, points[..., 2:]], axis=-1)

    image = np.full((height, width, 3), 255.0)
    depth = np.full((height, width), -np.inf)
    light = frame @ (np.array([0.5, -0.2, 0.85]) / 1.006)
    for corners, own, colour in zip(pixels(triangles), triangles, scene.colours, strict=True):
        normal = np.cross(own[1] - own[0], own[2] - own[0])
        length = np.linalg.norm(normal)
        if length > 0:
            shade = 0.55 + 0.45 * abs(float(normal @ light)) / length
            _fill(image, depth, corners, np.array(colour) * shade)
    bias = 6.0
    for points, colour in lines:
        _stroke(image, depth, pixels(points), colour, 1, bias)
    for points, colour in over:
        _stroke(image, depth, pixels(points), colour, 3, np.inf)
    image = image.reshape(size[1], OVER, size[0], OVER, 3).mean(axis=(1, 3))
    return image.round().astype(np.uint8)


def _fill(image, depth, corners, colour) -> None:
    low = np.floor(corners[:, :2].min(axis=0)).astype(int).clip(0)
    high = np.ceil(corners[:, :2].max(axis=0)).astype(int) + 1
    x, y = np.meshgrid(
        np.arange(low[0], min(high[0], image.shape[1])),
        np.arange(low[1], min(high[1], image.shape[0])),
    )
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    if abs(area) < 1e-9 or not x.size:
        return
    u = ((bx - x) * (cy - y) - (by - y) * (cx - x)) / area
    v = ((cx - x) * (ay - y) - (cy - y) * (ax - x)) / area
    inside = (u >= 0) & (v >= 0) & (u + v <= 1)
    z = u * az + v * bz + (1 - u - v) * cz
    part = (slice(y[0, 0], y[-1, 0] + 1), slice(x[0, 0], x[0, -1] + 1))
    seen = inside & (z > depth[part])
    depth[part][seen] = z[seen]
    image[part][seen] = colour


def _stroke(image, depth, points, colour, half, bias) -> None:
    steps = np.linalg.norm(np.diff(points[:, :2], axis=0), axis=1)
    for a, b, step in zip(points[:-1], points[1:], steps, strict=True):
        t = np.linspace(0.0, 1.0, int(step) + 2)[:, None]
        place = a + t * (b - a)
        for dx in range(-half + 1, half):
            for dy in range(-half + 1, half):
                x = np.round(place[:, 0] + dx).astype(int).clip(0, image.shape[1] - 1)
                y = np.round(place[:, 1] + dy).astype(int).clip(0, image.shape[0] - 1)
                seen = place[:, 2] + bias > depth[y, x]
                image[y[seen], x[seen]] = colour


def sheet(cells: list[tuple[str, np.ndarray]], columns: int, name: str) -> None:
    """The cells with their captions in a grid, written as a PNG."""
    wide, high = cells[0][1].shape[1], cells[0][1].shape[0] + 22
    rows = -(-len(cells) // columns)
    page = QtGui.QImage(wide * columns, high * rows, QtGui.QImage.Format_RGB32)
    page.fill(QtCore.Qt.white)
    painter = QtGui.QPainter(page)
    font = QtGui.QFont("DejaVu Sans")
    font.setPixelSize(13)
    painter.setFont(font)
    for k, (caption, image) in enumerate(cells):
        x, y = wide * (k % columns), high * (k // columns)
        own = np.ascontiguousarray(image)
        picture = QtGui.QImage(
            own.data, own.shape[1], own.shape[0], 3 * own.shape[1], QtGui.QImage.Format_RGB888
        )
        painter.drawImage(x, y, picture)
        painter.drawText(
            QtCore.QRect(x, y + own.shape[0], wide, 22), int(QtCore.Qt.AlignCenter), caption
        )
    painter.end()
    page.save(str(IMAGES / name), "PNG", 0)


def made(segments, surface, points, fit="pull", name="M") -> detailing.MemberPlates:
    axis = detailing.axis_of(AxisInput("A", np.asarray(points, float), fit=fit), surface)
    given = detailing.MemberInput(name, tuple(segments))
    return detailing.plates_of(detailing.member_of(given, axis, surface), detailing.PlatesInput())


def straight(segments) -> Scene:
    scene = Scene([], [], [], [])
    plane = analytic_surface("plane", {})
    scene.member(made(segments, plane, [(0, 0, 0), (2600, 0, 0)]))
    return scene


def sections() -> None:
    kinds = {
        "box1": box("S", "box1", 600, 500, 24),
        "box2": box("S", "box2", 600, 500, 24),
        "i": i_section("S", 600, 400, 28, t_web=20, b_bottom=300),
        "tee": t_section("S", 500, 400, 28, t_web=20),
        "channel": channel("S", 600, 300, 28, t_web=20),
        "trapezoid": trapezoid("S", 500, 700, 350, 24),
        "polygon": polygon("S", [(0, 0), (500, 0), (650, 350), (300, 600), (-50, 400)], 24),
        "strips": strip_list(
            "S",
            [
                StripRow("deck", "D", 350, 0, -350, 0, 24, "left"),
                StripRow("rib1", "R", 180, 0, 120, -450, 20, "middle", "deck", "foot"),
                StripRow("rib2", "S", -180, 0, -120, -450, 20, "middle", "deck", "foot"),
                StripRow("foot", "F", 250, -450, -250, -450, 20, "left"),
            ],
        ),
    }
    cells = []
    for name, section in kinds.items():
        scene = straight([Segment(section)])
        scene.over.clear()
        cells.append((name, drawn(scene)))
    sheet(cells, 4, "sections.png")


def alignments() -> None:
    big, small = box("B", "box1", 640, 640, 24), box("S", "box1", 400, 360, 24)
    order = (
        "top-left", "top", "top-right", "left", "centre", "right", "bottom-left", "bottom",
        "bottom-right",
    )  # fmt: skip

    for to in ("axis", "previous"):
        cells = []
        for align in order:
            first = align if to == "axis" else "centre"
            segments = [Segment(big, align=first), Segment(small, 1000.0, align=align, align_to=to)]
            cells.append((f"{align} to {to}", drawn(straight(segments), -VIEW * [1, -1, -1])))
        sheet(cells, 3, f"alignments_{to}.png")


def surface_alignment() -> None:
    radius = 9000.0
    cylinder = analytic_surface("cylinder", {"r": radius})
    points = [(radius + 260, -3000, 0), (radius - 420, 2800, 900)]
    section = box("S", "box1", 500, 400, 20)
    cells = []
    for to in ("axis", "surface"):
        scene = Scene([], [], [], [])
        segment = Segment(section, align="top", align_to=to)
        scene.member(made([segment], cylinder, points, fit="keep"))
        angle = np.linspace(-0.36, 0.36, 37)
        for z in np.linspace(-900, 1800, 10):
            ring = radius * np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
            scene.lines.append((ring + [0, 0, z], SURFACE))
        for one in angle[::3]:
            ends = np.array([[np.cos(one) * radius, np.sin(one) * radius, z] for z in (-900, 1800)])
            scene.lines.append((np.linspace(ends[0], ends[1], 40), SURFACE))
        view = np.array([0.25, 0.12, 0.96])
        cells.append((f"top to {to}", drawn(scene, view, up=(1.0, 0.0, 0.0), size=(600, 300))))
    sheet(cells, 1, "alignment_surface.png")


def main() -> None:
    QtGui.QGuiApplication([])
    sections()
    alignments()
    surface_alignment()


if __name__ == "__main__":
    main()
