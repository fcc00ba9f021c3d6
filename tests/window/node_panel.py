# SPDX-License-Identifier: LGPL-2.1-or-later
"""Steps of a session in FreeCAD's window: the panel of a node, its ranks and its fields."""

import FreeCAD
import steps
from commands_aids import ok_enabled, panel_text
from hands import field, named, press, retype, run, select, window
from PySide import QtGui


def ranks_of_a_node():
    """Which member runs through, as the panel of a node says it, and the ranks it shows."""
    select(named("N1"))
    run("Node")
    by = field("ThroughBy", QtGui.QComboBox)
    result = {"choices": [[by.itemData(k), by.itemText(k)] for k in range(by.count())]}
    by.setCurrentIndex(by.findData("rank"))
    steps.settle(6)
    shown = [label.text() for label in window().findChildren(QtGui.QLabel) if label.isVisible()]
    result["ranks"] = [text.splitlines()[0] for text in shown if text.startswith("Ranks")]
    press("Cancel")
    return result


def node_fields():
    """The panel of a node: gaps, a stub and names that can be and that cannot."""
    document, node = FreeCAD.ActiveDocument, named("N1")
    select(node)
    run("Node")

    def state(name):
        shown = field(name)
        member = named("M2 plates").Mass > 0.0 and bool(named("M2 plates").Shape.Solids)
        return [getattr(node, name), node.Status, member, ok_enabled(), shown.toolTip()]

    def typed(name, text):
        retype(field(name), text)
        steps.settle(8)
        found = state(name)
        return [getattr(found[0], "Value", found[0]), *found[1:]]

    seen = {text: typed("Gap", text) for text in ("500 mm", "4 mm")}
    kind = field("Type")
    kind.setCurrentIndex(kind.findData("stub"))
    steps.settle(8)
    seen["stub"] = [node.StubLength.Value, node.Status, ok_enabled(), panel_text()]
    seen["stub"] += [named("M2 plates").Status, field("StubLength").text()]
    seen |= {text: typed("StubLength", text) for text in ("10 mm", "0 mm", "600 mm")}
    steps.picture("stub")
    seen |= {f"name {text}": typed("Node", text) for text in ("M1", " ", "K7")}
    field("Gap").setFocus()
    steps.settle(8)
    seen["left"] = [node.Node, node.Status, ok_enabled()]
    press("Cancel")
    seen["cancelled"] = [node.Gap.Value, node.Type, node.Node, node.Status]
    document.clearUndos()
    return seen
