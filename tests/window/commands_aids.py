# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the steps of commands_session share: findings of a panel, recorded lines, a document."""

import FreeCAD
import FreeCADGui
from hands import field, window
from PySide import QtGui


def panel_text():
    """What the task panel says was found."""
    return field("findings", QtGui.QLabel).text()


def recorded():
    """The lines in the Python console, as a recorded macro has them."""
    console = window().findChild(QtGui.QPlainTextEdit, "Python console")
    lines = console.toPlainText().splitlines()[:-1]
    return [line[4:] for line in lines if line.startswith((">>> ", "... "))]


def member_document(name):
    """A document with two members of three segments on an ellipsoid, with plates."""
    from BendTorsionWB import make

    document = FreeCAD.newDocument(name)
    hall = make.make_surface(document, "Hall", "ellipsoid", a=40000, b=30000, c=20000)
    sections = [make.make_section(document, f"B{h}", h=h, b=600, t=16) for h in (600, 800)]
    for k, y in enumerate((-3000.0, 3000.0), start=1):
        xs = (-9000.0, -4000.0, 1000.0, 5000.0, 9000.0)
        points = [(x, y, 20000 * (1 - (x / 40000) ** 2 - (y / 30000) ** 2) ** 0.5) for x in xs]
        axis = make.make_axis(document, f"A{k}", hall, points)
        segments = [{}, {"cut": 5000}, {"cut": 11000}]
        used = [sections[0], sections[1], sections[0]]
        member = make.make_member(document, f"M{k}", axis, used, segments)
        make.make_plates(document, member, {"top": [6500, 12500], "bottom": [4000, 9000]})
        member.ViewObject.Visibility = False
    document.recompute()
    document.clearUndos()
    FreeCADGui.ActiveDocument.ActiveView.viewIsometric()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    return document
