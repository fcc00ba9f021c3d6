# SPDX-License-Identifier: LGPL-2.1-or-later
"""What sessions with commands share: findings of a panel, recorded lines, documents."""

import FreeCAD
import FreeCADGui
from hands import field, named, press, run, select, window
from PySide import QtGui


def panel_text():
    """What the task panel says was found."""
    return field("findings", QtGui.QLabel).text()


def ok_enabled():
    """Whether the task panel allows OK."""
    boxes = [box for box in window().findChildren(QtGui.QDialogButtonBox) if box.isVisible()]
    return boxes[0].button(QtGui.QDialogButtonBox.Ok).isEnabled()


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
    return _seen_whole(document)


def _seen_whole(document):
    """The document computed, without undo steps, seen whole in its view."""
    document.recompute()
    document.clearUndos()
    FreeCADGui.ActiveDocument.ActiveView.viewIsometric()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    return document


def whole_document(name):
    """Two members on a plane, the second ending on the first, with all that follows plates."""
    from BendTorsionWB import make

    document = FreeCAD.newDocument(name)
    ground = make.make_surface(document, "Ground", "plane")
    lines = {"M1": ((0, 0, 0), (9000, 0, 0)), "M2": ((4000, 0, 0), (4000, 5000, 0))}
    section = make.make_section(document, "B", h=500, b=400, t=12)
    plates = {}
    for mark, ends in lines.items():
        axis = make.make_axis(document, f"{mark}-axis", ground, ends)
        member = make.make_member(document, mark, axis, [section])
        joints = {"top": [3000, 6000], "left": [2500]} if mark == "M1" else {}
        plates[mark] = make.make_plates(document, member, joints)
        member.ViewObject.Visibility = False
    unfold = make.make_unfold(document, plates["M1"])
    make.make_sheets(document, unfold, plate_pages=False)
    make.make_bed(document, plates["M1"])
    make.make_node(document, named("M1"), named("M2"), plates=list(plates.values()))
    return _seen_whole(document)


def long_members(name, count=3):
    """Members 31 m long side by side, of one section, with plates."""
    from BendTorsionWB import make

    document = FreeCAD.newDocument(name)
    hall = make.make_surface(document, "Hall", "ellipsoid", a=40000, b=30000, c=20000)
    section = make.make_section(document, "B", h=600, b=600, t=16)
    joints = [5000, 10000, 15000, 20000, 25000]
    for k in range(count):
        y = 3000.0 * (k - 1)
        xs = (-15000.0, -8000.0, 0.0, 8000.0, 15000.0)
        points = [(x, y, 20000 * (1 - (x / 40000) ** 2 - (y / 30000) ** 2) ** 0.5) for x in xs]
        axis = make.make_axis(document, f"A{k + 1}", hall, points)
        member = make.make_member(document, f"M{k + 1}", axis, [section])
        make.make_plates(document, member, dict.fromkeys(("top", "left"), joints))
        member.ViewObject.Visibility = False
    return _seen_whole(document)


def part_tables():
    """(command, table) of each panel with a table of parts, opened on M1 and cancelled after."""
    for name in ("Pieces", "Diaphragms", "Openings", "FaceMarks", "Welds"):
        select(named("M1"))
        run(name)
        yield name, field("rows", QtGui.QTableWidget)
        press("Cancel")
