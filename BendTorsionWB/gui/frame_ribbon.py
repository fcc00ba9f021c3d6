# SPDX-License-Identifier: LGPL-2.1-or-later
"""The ribbon an axis's z directions sweep, with its rungs, in the 3D view."""

from __future__ import annotations

import numpy as np
from pivy import coin

from BendTorsionWB.core.axes.frames import Frames

STATIONS = 121
RUNG_EVERY = 6
COLOUR = (0.84, 0.37, 0.0)


def ribbon(frames: Frames, height: float) -> coin.SoSeparator:
    """A see-through band of the given height, mm, from the axis along z, and a rung every few
    stations."""
    at = frames.at(np.linspace(0.0, frames.axis.length, STATIONS))
    pairs = np.stack([at.origin, at.origin + height * at.z], axis=1)
    group, band = coin.SoSeparator(), coin.SoSeparator()
    light, colour = coin.SoLightModel(), coin.SoMaterial()
    light.model = coin.SoLightModel.BASE_COLOR
    colour.diffuseColor.setValue(*COLOUR)
    colour.transparency.setValue(0.55)
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, 2 * STATIONS, pairs.reshape(-1, 3).tolist())
    strip = coin.SoTriangleStripSet()
    strip.numVertices.setValue(2 * STATIONS)
    for node in (light, colour, coordinates, strip):
        band.addChild(node)
    group.addChild(band)
    group.addChild(_rungs(pairs))
    return group


def _rungs(pairs: np.ndarray) -> coin.SoSeparator:
    group = coin.SoSeparator()
    light, colour, style = coin.SoLightModel(), coin.SoMaterial(), coin.SoDrawStyle()
    light.model = coin.SoLightModel.BASE_COLOR
    colour.diffuseColor.setValue(*COLOUR)
    style.lineWidth = 2
    points = np.concatenate([pairs[::RUNG_EVERY].reshape(-1, 3), pairs[:, 1]])
    count = len(pairs[::RUNG_EVERY])
    coordinates, lines = coin.SoCoordinate3(), coin.SoLineSet()
    coordinates.point.setValues(0, len(points), points.tolist())
    lines.numVertices.setValues(0, count + 1, [2] * count + [len(pairs)])
    for node in (light, colour, style, coordinates, lines):
        group.addChild(node)
    return group
