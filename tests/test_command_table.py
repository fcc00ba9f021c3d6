# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands a detailer is promised are there: words, keys, icons for light and dark windows."""

import ast
import os
import re
import xml.etree.ElementTree as tree
from importlib import import_module
from pathlib import Path

import pytest

from BendTorsionWB.sheets.qt import qt_modules

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

ROOT = Path(__file__).resolve().parent.parent
ICONS = ROOT / "resources" / "icons"
PROMISED = {
    "ImportShapes": ("Import shapes", set()),
    "MembersFromSelection": ("Members from selection", {"Face", "Edge"}),
    "Surface": ("Surface", {"Face"}),
    "Axis": ("Axis from selection", {"Face", "Edge", "Vertex", "Surface"}),
    "Section": ("Section", {"SectionSpec"}),
    "Member": ("Member", {"Axis", "Member"}),
    "CutPoint": ("Cut point", {"Member", "PlateSet"}),
    "Alignment": ("Alignment", {"Member", "PlateSet"}),
    "MemberTable": ("Member table", {"Member"}),
    "Plates": ("Plates", {"Member", "PlateSet"}),
    "Splits": ("Split editor", {"PlateSet"}),
    "Pieces": ("Delivery pieces", {"Member", "PlateSet"}),
    "Diaphragms": ("Diaphragms", {"Member", "PlateSet"}),
    "Openings": ("Openings", {"Member", "PlateSet"}),
    "FaceMarks": ("Marks on faces", {"Member", "PlateSet"}),
    "Welds": ("Welds", {"Member", "PlateSet"}),
    "Node": ("Node", {"Member", "Node"}),
    "Development": ("Development", {"Member", "PlateSet", "Unfold"}),
    "AssemblyBed": ("Assembly bed", {"Member", "PlateSet", "AssemblyBed"}),
    "FitMembers": ("Fit members", {"Member", "PlateSet"}),
    "ShowAs": ("Plates, skin or axis", {"Member"}),
    "ShowFrames": ("Show frames", {"Axis", "Member"}),
    "ShowMarks": ("Show marks", {"PlateSet"}),
    "ShowPoints": ("Show points", {"PlateSet"}),
    "ColourBy": ("Colour by", {"Member", "PlateSet"}),
    "Check": ("Check", set()),
    "Findings": ("Findings", set()),
    "Sheets": ("Sheets", {"Member", "PlateSet", "Unfold"}),
    "ExportPackage": ("Export package", set()),
    "Report": ("Report", set()),
    "ImportSchedule": ("Import schedule", set()),
    "WriteSchedule": ("Write schedule", set()),
    "Example": ("Example project", set()),
    "Repair": ("Repair document", set()),
    "SupportBundle": ("Support bundle", set()),
    "Preferences": ("Preferences", set()),
}
"""By name: the words of the menu, and kinds of objects whose context menu has it."""
COLOURED_BY = {"strain", "length error", "deviation", "curvature", "twist", "forming", "thickness"}


def declared():
    """Every Command of gui/commands_*.py: name -> (text, tooltip, keys, kinds)."""
    found = {}
    for path in sorted((ROOT / "BendTorsionWB" / "gui").glob("commands_*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Command":
                name, text, tooltip, keys, _, *suits = node.args
                kinds = {item.value for item in suits[0].elts} if suits else set()
                words = (text.args[1].value, tooltip.args[1].value, keys.value)
                found[name.value] = (*words, kinds)
    return found


COMMANDS = declared()


def test_there_is_nothing_else():
    assert set(COMMANDS) == set(PROMISED)


@pytest.mark.parametrize("name", PROMISED)
def test_words_keys_and_context_menu(name):
    """The trade's words in the menu, a sentence in the tooltip, two keys, the kinds it suits."""
    words, kinds = PROMISED[name]
    text, tooltip, keys, suits = COMMANDS[name]
    assert text == words
    assert len(tooltip) > 20 and tooltip[0].isupper() and not tooltip.endswith(".")
    assert re.fullmatch(r"B, [A-Z0-9]", keys)
    assert kinds <= suits


def test_colours_by_every_figure():
    from BendTorsionWB.core.patterns import strain_map  # noqa: F401 - FreeCAD's path is set
    from BendTorsionWB.objects import colours

    choices = next(item.choices for item in colours.PROPERTIES if item.name == "ColourBy")
    assert COLOURED_BY <= set(choices)


@pytest.fixture(scope="module")
def application():
    """Qt without a window."""
    from BendTorsionWB.gui.qt import QtWidgets

    return QtWidgets.QApplication.instance() or QtWidgets.QApplication([])


@pytest.mark.parametrize("name", PROMISED)
def test_the_icon_can_be_seen_on_light_and_on_dark(application, name):
    """An SVG of its own; at 24 pixels a tenth of it stands out from either background."""
    core, gui = qt_modules()
    svg = import_module(f"{core.__name__.split('.')[0]}.QtSvg")
    path = ICONS / f"BendTorsion_{name}.svg"
    assert path.stat().st_size < 10_000
    assert tree.parse(path).getroot().findtext("{http://www.w3.org/2000/svg}title")
    renderer = svg.QSvgRenderer(str(path))
    assert renderer.isValid()
    for background in ("#f2f2f2", "#26282c"):
        picture = gui.QImage(24, 24, gui.QImage.Format_RGB32)
        picture.fill(gui.QColor(background))
        painter = gui.QPainter(picture)
        renderer.render(painter, core.QRectF(0.0, 0.0, 24.0, 24.0))
        painter.end()
        ground = gui.QColor(background).lightnessF()
        pixels = [picture.pixelColor(x, y) for x in range(24) for y in range(24)]
        seen = [pixel for pixel in pixels if abs(pixel.lightnessF() - ground) > 0.18]
        assert len(seen) > 0.1 * len(pixels), background


def test_icons_are_unlike_each_other():
    drawings = [
        (ICONS / f"BendTorsion_{name}.svg").read_text(encoding="utf-8") for name in PROMISED
    ]
    assert len(set(drawings)) == len(drawings)
