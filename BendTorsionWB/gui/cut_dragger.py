# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cuts of a member dragged along its axis in the 3D view, with the transition and its place."""

from __future__ import annotations

import time
from dataclasses import dataclass

import FreeCAD
import numpy as np
from pivy import coin

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.members.member import to_space
from BendTorsionWB.gui.label_layer import Label, node_of
from BendTorsionWB.gui.view_mouse import ViewMouse

translate = FreeCAD.Qt.translate
REACH = 14.0
"""Pixels: how near the mouse takes a cut."""
SAMPLES = 801
EVERY = 0.15
"""Seconds between two recomputes while a cut is dragged."""
COLOUR, HELD = (0.84, 0.37, 0.0), (0.85, 0.1, 0.1)
TEXT_COLOURS = ("1 1 1", "0.25 0.12 0")
NAMES = ("CutBy", "CutRatio", "CutOffset", "Cut")


@dataclass(frozen=True, eq=False)
class Handle:
    """A cut: number of the segment behind it, place s (mm), length of its transition (mm), and the
    section's corners (m, 2) in (y, z) before and behind it."""

    segment: int
    s: float
    length: float
    before: np.ndarray
    behind: np.ndarray


class CutDragger:
    """Shows the cuts of the member of a MemberPanel in the 3D view and moves the one dragged."""

    def __init__(self, panel):
        self.panel = panel
        self.handles: list[Handle] = []
        self.held: Handle | None = None
        self.frames = None
        self.told = 0.0
        self.mouse = ViewMouse(panel.preview.document, self)
        self.node = coin.SoSeparator()
        if self.mouse.scene is not None:
            self.mouse.scene.addChild(self.node)
        self.refresh()

    def stop(self) -> None:
        """Take everything out of the view."""
        self.mouse.stop()
        scene = self.mouse.scene
        if scene is not None and scene.findChild(self.node) >= 0:
            scene.removeChild(self.node)
        self.handles, self.frames = [], None

    def refresh(self) -> None:
        """Show the cuts as the member now has them; none of a member in error but the one held."""
        from BendTorsionWB.objects import member as member_object

        try:
            geometry = member_object.value(self.panel.member)
        except BendTorsionError:
            self.handles = [self.held] if self.held else []
        else:
            self.frames = geometry.member.frames
            self.s = np.linspace(0.0, self.frames.axis.length, SAMPLES)
            self.places = self.frames.axis.position(self.s)
            self.handles = handles_of(geometry.member)
        self._draw()

    def press(self, at) -> bool:
        """Take hold of the cut under the mouse."""
        self.held = self._under(at)
        if self.held is None:
            return False
        member, k = self.panel.member, self.held.segment
        if not self.panel.show_segment(k):
            self.held = None
            return True
        self.former = [(f"{name}{k}", getattr(member, f"{name}{k}")) for name in NAMES]
        self._draw()
        return True

    def move(self, at, button: bool) -> bool:
        """Move the cut held to the place of the axis under the mouse."""
        if self.held is None:
            self.mouse.point_at(self._under(at) is not None)
            return False
        if not button:
            return self.release(at)
        s = float(np.clip(round(self.place_under(at)), 1.0, self.frames.axis.length - 1.0))
        old = self.held
        self.held = Handle(old.segment, s, old.length, old.before, old.behind)
        self.panel.cut_at(s)
        if time.monotonic() - self.told > EVERY:
            self.panel.update()
            self.told = time.monotonic()
        self._draw()
        return True

    def release(self, at) -> bool:
        """Leave the cut where it is."""
        if self.held is None:
            return False
        self.held = None
        self.panel.update()
        self.refresh()
        return True

    def escape(self) -> bool:
        """Put the cut held back to where it was."""
        if self.held is None:
            return False
        for name, value in self.former:
            setattr(self.panel.member, name, value)
        self.panel.segment_fields.read((f"Cut{self.held.segment}",))
        self.held = None
        self.panel.update()
        self.refresh()
        return True

    def place_under(self, at) -> float:
        """Arc length of the place of the axis nearest to the mouse on the screen."""
        pixels, scale = self.mouse.pixels(self.places)
        start, step = pixels[:-1], np.diff(pixels, axis=0)
        length = np.maximum(np.sum(step * step, axis=1), 1e-12)
        along = np.clip(np.sum((at - start) * step, axis=1) / length, 0.0, 1.0)
        away = np.linalg.norm(start + along[:, None] * step - at, axis=1)
        away[(scale[:-1] <= 0.0) | (scale[1:] <= 0.0)] = np.inf
        k = int(np.argmin(away))
        return float(self.s[k] + along[k] * (self.s[k + 1] - self.s[k]))

    def _under(self, at) -> Handle | None:
        if not self.handles or self.frames is None:
            return None
        places = self.frames.axis.position(np.array([handle.s for handle in self.handles]))
        pixels, scale = self.mouse.pixels(places)
        away = np.where(scale > 0.0, np.linalg.norm(pixels - at, axis=1), np.inf)
        k = int(np.argmin(away))
        return self.handles[k] if away[k] <= REACH else None

    def _draw(self) -> None:
        self.node.removeAllChildren()
        if self.frames is None:
            return
        style, front = coin.SoPickStyle(), coin.SoDepthBuffer()
        style.style = coin.SoPickStyle.UNPICKABLE
        front.test = False
        self.node.addChild(style)
        self.node.addChild(front)
        for handle in self.handles:
            is_held = self.held is not None and self.held.segment == handle.segment
            self.node.addChild(_picture(self.frames, self.held if is_held else handle, is_held))


def handles_of(member) -> list[Handle]:
    """The cuts of a core Member: where its transitions start, or segments without one."""
    from BendTorsionWB.core.members.zone_table import zone_records

    zones = {}
    for zone in zone_records(member.law):
        zones.setdefault(zone.label, zone)
    found = []
    segments = sum(label.startswith("d-") for label in zones)
    for segment in range(2, segments + 1):
        zone = zones.get(f"b-{segment - 1}")
        start = zone.start if zone else zones[f"d-{segment}"].start
        end = zone.end if zone else start
        before, behind = _outline(member, start, 0), _outline(member, end, -1)
        found.append(Handle(segment, start, end - start, before, behind))
    return found


def _outline(member, s: float, side: int) -> np.ndarray:
    """The rectangle (4, 2) around the section at s, in (y, z); side: 0 just before s, -1 behind."""
    cells = [cell for cell in member.law.cells if cell.start <= s <= cell.end]
    cell = cells[side] if cells else member.law.cells[-1]
    corners = cell.corners_at(np.array([s]))[0]
    low, high = corners.min(axis=0), corners.max(axis=0)
    return np.array([low, (high[0], low[1]), high, (low[0], high[1])])


def read_out(handle: Handle, number: int) -> str:
    """What is said of a cut beside it."""
    text = translate("BendTorsion", "Cut {number}: s = {s:.0f} mm").format(
        number=number, s=handle.s
    )
    if handle.length:
        more = translate("BendTorsion", "transition {length:.0f} mm").format(length=handle.length)
        text = f"{text}, {more}"
    return text


def _picture(frames, handle: Handle, is_held: bool) -> coin.SoSeparator:
    """A knob on the axis, the sections before and behind the transition, what is said of it."""
    group, colour, light = coin.SoSeparator(), coin.SoBaseColor(), coin.SoLightModel()
    light.model = coin.SoLightModel.BASE_COLOR
    colour.rgb.setValue(*(HELD if is_held else COLOUR))
    style = coin.SoDrawStyle()
    style.lineWidth = 3 if is_held else 2
    ends = np.clip([handle.s, handle.s + handle.length], 0.0, frames.axis.length)
    at = frames.at(ends)
    rings = to_space(at, np.stack([handle.before, handle.behind]))
    lines = [[*ring, ring[0]] for ring in rings]
    if handle.length:
        lines += [[rings[0, k], rings[1, k]] for k in range(4)]
    coordinates, line_set = coin.SoCoordinate3(), coin.SoLineSet()
    points = [tuple(map(float, point)) for line in lines for point in line]
    coordinates.point.setValues(0, len(points), points)
    line_set.numVertices.setValues(0, len(lines), [len(line) for line in lines])
    knob_at, knob = coin.SoCoordinate3(), coin.SoMarkerSet()
    knob_at.point.setValue(*map(float, at.origin[0]))
    knob.markerIndex = coin.SoMarkerSet.CIRCLE_FILLED_9_9
    for node in (light, colour, style, coordinates, line_set, knob_at, knob):
        group.addChild(node)
    top = at.origin[0] + (handle.before[:, 1].max() * 1.3) * at.z[0]
    text = read_out(handle, handle.segment)
    group.addChild(node_of(Label(text, top, TEXT_COLOURS, 11 if is_held else 9, 0.0)))
    return group
