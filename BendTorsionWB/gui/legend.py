# SPDX-License-Identifier: LGPL-2.1-or-later
"""The colour legend in the corner of the 3D view: what colours of plates and patterns mean."""

from __future__ import annotations

import FreeCAD
import FreeCADGui
from pivy import coin

from BendTorsionWB.core.colour_scale import CLASS_COLOURS
from BendTorsionWB.gui.qt import QtCore, QtGui

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

NODE = "BendTorsionLegend"
TITLES = {
    "strain": QT_TRANSLATE_NOOP("BendTorsion", "Strain of laying flat"),
    "length error": QT_TRANSLATE_NOOP("BendTorsion", "Length error"),
    "forming": QT_TRANSLATE_NOOP("BendTorsion", "Forming class"),
    "thickness": QT_TRANSLATE_NOOP("BendTorsion", "Thickness"),
    "deviation": QT_TRANSLATE_NOOP("BendTorsion", "Deviation from a plane"),
    "curvature": QT_TRANSLATE_NOOP("BendTorsion", "Curvature"),
    "twist": QT_TRANSLATE_NOOP("BendTorsion", "Twist"),
}
ROW, SWATCH, MARGIN = 20, 26, 10
MOST_NAMES = 3
STEPPED = {
    "thickness": lambda line: float(line.split()[1]),
    "forming": lambda line: list(CLASS_COLOURS).index(line.split(" ", 1)[1]),
}
"""Legends of single values, and what orders their lines; others are scales."""
_waiting: set[str] = set()
_drawn: set[str] = set()
"""Names of documents whose legend is to be drawn anew, and of those that have one."""


def schedule(document) -> None:
    """Draw the legend of a document anew, once, when the window is idle."""
    if document.Name not in _waiting:
        _waiting.add(document.Name)
        QtCore.QTimer.singleShot(0, lambda name=document.Name: _update(name))


def entries(document) -> dict[tuple, list[str]]:
    """What is coloured and shown in a document: (ColourBy, Legend lines) -> labels of objects."""
    found: dict[tuple, list[str]] = {}
    for obj in document.Objects:
        if getattr(obj, "ColourBy", "none") != "none" and obj.Legend and obj.ViewObject.Visibility:
            found.setdefault((obj.ColourBy, tuple(obj.Legend)), []).append(obj.Label)
    return _joined(found)


def _joined(found: dict[tuple, list[str]]) -> dict[tuple, list[str]]:
    """Legends of thicknesses or classes as one, where no colour means two things."""
    joined: dict[tuple, list[str]] = {}
    for by in dict.fromkeys(by for by, _ in found):
        own = {lines: labels for (of, lines), labels in found.items() if of == by}
        steps = list(dict.fromkeys(line for lines in own for line in lines))
        colours, texts = (set(part) for part in zip(*(s.split(" ", 1) for s in steps), strict=True))
        if by in STEPPED and len(colours) == len(texts) == len(steps):
            steps.sort(key=STEPPED[by])
            joined[by, tuple(steps)] = [label for labels in own.values() for label in labels]
        else:
            joined |= {(by, lines): labels for lines, labels in own.items()}
    return joined


def _update(name: str) -> None:
    _waiting.discard(name)
    if name not in FreeCAD.listDocuments():
        return
    found = entries(FreeCAD.getDocument(name))
    # Looking through the scene of a large document takes a while.
    if not found and name not in _drawn:
        return
    _drawn.add(name)
    picture = paint(found) if found else None
    for view in FreeCADGui.getDocument(name).mdiViewsOfType("Gui::View3DInventor"):
        scene = view.getSceneGraph()
        for child in list(scene.getChildren()):
            if child.getName().getString() == NODE:
                scene.removeChild(child)
        if picture is not None:
            scene.addChild(_corner(picture))


def paint(found: dict[tuple, list[str]]):
    """The legends of `entries` beside each other as a picture (QImage)."""
    font = QtGui.QFont()
    font.setPixelSize(13)
    measure = QtGui.QFontMetrics(font)
    columns = []
    for (by, lines), labels in found.items():
        names = ", ".join(labels[:MOST_NAMES]) + (" …" if len(labels) > MOST_NAMES else "")
        title = translate("BendTorsion", TITLES[by]) if by in TITLES else by
        rows = [line.split(" ", 1) for line in lines]
        rows = [(colour, translate("BendTorsion", text)) for colour, text in rows]
        texts = [title, names, *(text for _, text in rows)]
        width = SWATCH + MARGIN + max(measure.boundingRect(text).width() for text in texts)
        columns.append((title, names, rows, width))
    tallest = max(len(rows) for _, _, rows, _ in columns)
    size = (
        sum(width for *_, width in columns) + 2 * MARGIN * len(columns),
        ROW * (tallest + 2) + 2 * MARGIN,
    )
    picture = QtGui.QImage(*size, QtGui.QImage.Format_RGBA8888)
    picture.fill(QtGui.QColor(255, 255, 255, 225))
    painter = QtGui.QPainter(picture)
    painter.setFont(font)
    left = MARGIN
    for title, names, rows, width in columns:
        _column(painter, left, title, names, rows)
        left += width + 2 * MARGIN
    painter.end()
    return picture


def _column(painter, left: int, title: str, names: str, rows) -> None:
    painter.setPen(QtGui.QColor("black"))
    painter.drawText(left, MARGIN + 14, title)
    painter.setPen(QtGui.QColor("#555555"))
    painter.drawText(left, MARGIN + ROW + 14, names)
    for k, (colour, text) in enumerate(reversed(rows), start=2):
        top = MARGIN + k * ROW
        painter.fillRect(left, top, SWATCH, ROW, QtGui.QColor(colour))
        painter.setPen(QtGui.QColor("black"))
        painter.drawText(left + SWATCH + MARGIN, top + 14, text)


def _corner(picture) -> coin.SoNode:
    """A node that draws a picture in the lower left corner, whatever the camera; no part of the
    scene's bounds, not to be picked."""
    outside = coin.SoType.fromName("SoSkipBoundingGroup").createInstance()
    outside.setName(NODE)
    group = coin.SoSeparator()
    style, camera = coin.SoPickStyle(), coin.SoOrthographicCamera()
    style.style = coin.SoPickStyle.UNPICKABLE
    camera.viewportMapping = coin.SoCamera.LEAVE_ALONE
    camera.aspectRatio = 1.0
    camera.position.setValue(0.0, 0.0, 1.0)
    camera.nearDistance, camera.farDistance, camera.height = 0.5, 1.5, 2.0
    front, move, light = coin.SoDepthBuffer(), coin.SoTranslation(), coin.SoLightModel()
    front.test = False
    move.translation.setValue(-0.985, -0.97, 0.0)
    light.model = coin.SoLightModel.BASE_COLOR
    image = coin.SoImage()
    flipped = picture.mirrored(False, True)
    data = bytes(flipped.constBits())[: 4 * picture.width() * picture.height()]
    image.image.setValue(coin.SbVec2s(picture.width(), picture.height()), 4, data)
    image.vertAlignment = coin.SoImage.BOTTOM
    for node in (style, camera, front, light, move, image):
        group.addChild(node)
    outside.addChild(group)
    return outside
