# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs inside FreeCAD's window: how objects of a document saved without a window show."""

import os
import sys
import time

import FreeCAD
import FreeCADGui
from PySide import QtGui

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import steps


def ours(kind):
    """The objects of a kind in the active document."""
    document = FreeCAD.ActiveDocument
    return [item for item in document.Objects if getattr(item, "BT_Type", "") == kind]


def by_label(label):
    """The object with this label."""
    return FreeCAD.ActiveDocument.getObjectsByLabel(label)[0]


def texts(obj):
    """The texts beside the shape of an object, those left out for want of room included."""
    layer = getattr(obj.ViewObject.Proxy, "labels", None)
    return [] if layer is None else [label.text for label in layer.labels]


def labels_seen(obj):
    """What the scene draws of them: text, pixels from the lower left, width and height."""
    from pivy import coin

    search = coin.SoSearchAction()
    search.setType(coin.SoType.fromName("SoFrameLabel"))
    search.setInterest(coin.SoSearchAction.ALL)
    search.apply(obj.ViewObject.RootNode)
    found = []
    view = FreeCADGui.ActiveDocument.ActiveView
    for path in search.getPaths():
        text = path.getTail().getField("string").get().getString().strip('"')
        layer = obj.ViewObject.Proxy.labels
        box = next(label.pixels for label in layer.labels if label.text == text)
        above = path.getNodeFromTail(1)
        place = above.getChild(0).translation.getValue().getValue()
        x, y = view.getPointOnScreen(*place)
        across, up = (
            path.getTail().getField(name).get().getString()
            for name in ("horAlignment", "vertAlignment")
        )
        low = x - box[0] * (across == "RIGHT"), y - box[1] * (up == "TOP")
        found.append([text, *low, *box])
    return found


def shapes_beside(obj, kind):
    """How many nodes of a kind the view of an object has."""
    from pivy import coin

    search = coin.SoSearchAction()
    search.setType(coin.SoType.fromName(kind))
    search.setInterest(coin.SoSearchAction.ALL)
    search.apply(obj.ViewObject.RootNode)
    return search.getPaths().getLength()


def has_legend():
    """Breadth and height of the legend's picture in the view; none when there is no legend."""
    from pivy import coin

    steps.settle()
    scene = FreeCADGui.ActiveDocument.ActiveView.getSceneGraph()
    found = [c for c in scene.getChildren() if c.getName().getString() == "BendTorsionLegend"]
    search = coin.SoSearchAction()
    search.setType(coin.SoImage.getClassTypeId())
    sizes = []
    for node in found:
        search.apply(node)
        written = search.getPath().getTail().image.get().getString()
        sizes.append([int(number) for number in written[:40].split()[:2]])
    return sizes


def colour_of(view):
    """Of its faces, of an axis of its line; none of what is not seen in the 3D view."""
    is_line = view.Object.BT_Type == "Axis"
    return list(getattr(view, "LineColor" if is_line else "ShapeColor", ()))[:3]


def icon_key(obj):
    """The picture of an object's icon as the tree shows it."""
    icon = obj.ViewObject.Proxy.getIcon()
    return icon.pixmap(32, 32).toImage().cacheKey(), icon.cacheKey()


def saved_without_window():
    """Open the document: what is shown, what is folded under what, the legend."""
    FreeCAD.openDocument(os.environ["BENDTORSION_WINDOW_DOCUMENT"])
    steps.settle()
    FreeCADGui.ActiveDocument.ActiveView.viewIsometric()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    items = FreeCAD.ActiveDocument.Objects
    mine = [item for item in items if hasattr(item, "BT_Type") and item.BT_Type != "PageSymbol"]
    result = {
        "providers": sorted({type(item.ViewObject.Proxy).__name__ for item in mine}),
        "visible": {item.Label: item.ViewObject.Visibility for item in mine},
        "tree": steps.tree_items(),
        "legend": has_legend(),
        "bounds": list(ours("PlateSet")[0].ViewObject.getBoundingBox().Center),
    }
    steps.picture("view_colours")
    return result


def labels():
    """Marks and points of one member, switched on and off, hidden with the plates."""
    plates = by_label("M1 plates")
    plates.ColourBy = "none"
    FreeCAD.ActiveDocument.recompute()
    view = plates.ViewObject
    result = {"before": texts(plates), "wanted": list(plates.Marks)}
    view.ShowMarks = True
    result["marks"] = texts(plates)
    steps.picture("view_marks")
    view.ShowPoints = True
    result["points"] = texts(plates)
    FreeCADGui.Selection.clearSelection()
    FreeCADGui.ActiveDocument.ActiveView.viewIsometric()
    FreeCADGui.Selection.addSelection(FreeCAD.ActiveDocument.Name, plates.Name, "Face1")
    FreeCADGui.SendMsgToActiveView("ViewSelection")
    FreeCADGui.Selection.clearSelection()
    steps.picture("view_points")
    view.Visibility = False
    result["hidden"] = texts(plates)
    view.Visibility = True
    view.ShowMarks = view.ShowPoints = False
    result["after"] = texts(plates)
    return result


def colours():
    """By kind, of objects without colours of strain: those are the first face's in FreeCAD 1.0."""
    mine = [item for item in FreeCAD.ActiveDocument.Objects if hasattr(item, "BT_Type")]
    plain = [item for item in mine if getattr(item, "ColourBy", "none") == "none"]
    return {item.BT_Type: colour_of(item.ViewObject) for item in plain}


def thinning():
    """Labels of a member seen from near and from afar, from far away none."""
    plates = by_label("M1 plates")
    view = FreeCADGui.ActiveDocument.ActiveView
    plates.ViewObject.ShowMarks = plates.ViewObject.ShowPoints = True
    view.viewIsometric()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    camera = view.getCameraNode()
    result = {"all": len(texts(plates)), "seen": []}
    height = camera.height.getValue()
    middle = FreeCAD.Vector(plates.Shape.BoundBox.Center)
    eye = middle - view.getViewDirection() * camera.focalDistance.getValue()
    camera.position.setValue(eye.x, eye.y, eye.z)
    for zoom in (1.0, 4.0, 16.0, 0.1):
        camera.height = height / zoom
        view.redraw()
        steps.settle()
        result["seen"].append(labels_seen(plates))
        steps.picture(f"view_labels_{zoom:g}")
    plates.ViewObject.ShowMarks = plates.ViewObject.ShowPoints = False
    FreeCADGui.SendMsgToActiveView("ViewFit")
    return result


def frames():
    """The ribbon of an axis that bends, and its height by the property."""
    axis = by_label("A1")
    result = {"shown_before": axis.ViewObject.Visibility}
    axis.ViewObject.Visibility = True
    result["before"] = shapes_beside(axis, "TriangleStripSet")
    axis.ViewObject.ShowFrames = True
    result["ribbons"] = shapes_beside(axis, "TriangleStripSet")
    FreeCADGui.SendMsgToActiveView("ViewFit")
    steps.picture("view_frames")
    axis.ViewObject.ShowFrames = False
    result["after"] = shapes_beside(axis, "TriangleStripSet")
    return result


def modes():
    """Plates, skin and axis of both members in turn."""
    from BendTorsionWB.gui import member_display

    members = ours("Member")
    result = {}
    for mode in member_display.MODES:
        member_display.show_as(members, mode)
        steps.settle()
        result[mode] = [
            {
                "mode": member_display.mode_of(member),
                "member": member.ViewObject.Visibility,
                "axis": member.Axis.ViewObject.Visibility,
                "plates": [
                    user.ViewObject.Visibility
                    for user in member.InList
                    if getattr(user, "BT_Type", "") == "PlateSet"
                ],
            }
            for member in members
        ]
    member_display.show_as(members, "plates")
    return result


def fitted():
    """FreeCAD's own fit, and the members' by command: all, then one that is selected. How much of
    the view each plate set takes, and what is selected then."""
    view, surface = FreeCADGui.ActiveDocument.ActiveView, by_label("Dome")
    surface.ViewObject.Visibility = True
    view.viewIsometric()
    steps.still(view)

    def taken():
        steps.still(view)
        room, found = view.getSize(), []
        for plates in ours("PlateSet"):
            at = [view.getPointOnScreen(v.Point) for v in plates.Shape.Vertexes]
            across, up = ([p[k] / room[k] for p in at] for k in (0, 1))
            found.append([min(across), max(across), min(up), max(up)])
        return found

    FreeCADGui.Selection.clearSelection()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    result = {"room": list(view.getSize()), "everything": taken()}
    FreeCADGui.runCommand("BendTorsion_FitMembers")
    result["members"] = taken()
    steps.picture("view_fit")
    FreeCADGui.Selection.addSelection(by_label("M2"))
    FreeCADGui.runCommand("BendTorsion_FitMembers")
    result["one"] = taken()
    result["selected"] = [item.Label for item in FreeCADGui.Selection.getSelection()]
    result["surface"] = surface.ViewObject.Visibility, steps.drawn(surface)
    FreeCADGui.Selection.clearSelection()
    return result


def errors():
    """A section that cannot be, then mended: icons, visibility, status bar, report view."""
    from BendTorsionWB.gui import tree

    section, plates, member = by_label("B"), by_label("M1 plates"), by_label("M1")
    before = steps.report_view()
    result = {
        "icons_before": [icon_key(item)[1] for item in (section, plates, member)],
        "worst_before": [tree.worst(item) for item in (section, plates, member)],
    }
    section.Thickness = 400.0
    FreeCAD.ActiveDocument.recompute()
    steps.settle()
    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection(FreeCAD.ActiveDocument.Name, plates.Name)
    result["status_bar"] = FreeCADGui.getMainWindow().statusBar().currentMessage()
    FreeCADGui.Selection.clearSelection()
    result["status"] = plates.Status
    result["worst"] = [tree.worst(item) for item in (section, plates, member)]
    result["icons"] = [icon_key(item)[1] for item in (section, plates, member)]
    result["visible"] = plates.ViewObject.Visibility, steps.drawn(plates)
    FreeCADGui.runCommand("Std_TreeExpand")
    steps.picture("view_error")
    section.Thickness = 16.0
    FreeCAD.ActiveDocument.recompute()
    steps.settle()
    result["icons_after"] = [icon_key(item)[1] for item in (section, plates, member)]
    result["visible_after"] = plates.ViewObject.Visibility, steps.drawn(plates)
    result["said"] = steps.report_view()[len(before) :]
    return result


def hidden_in_error():
    """Skins and plates while a section is in error: who hides or shows them then has them so after
    it is mended, whatever was shown before."""
    from BendTorsionWB.gui import member_display

    section, member, plates = by_label("B"), by_label("M1"), by_label("M1 plates")
    document = FreeCAD.ActiveDocument
    result = {}

    def seen():
        return {
            item.Label: [item.ViewObject.Visibility, steps.drawn(item), item.Visibility]
            for item in (member, plates)
        }

    def mended(meanwhile):
        section.Thickness = 400.0
        document.recompute()
        steps.settle()
        meanwhile()
        steps.settle()
        during = seen()
        section.Thickness = 16.0
        document.recompute()
        steps.settle()
        return [during, seen()]

    member_display.show_as([member], "plates")
    result["hidden skin"] = mended(lambda: None)
    member_display.show_as([member], "skin")
    result["skin, plates wanted"] = mended(lambda: member_display.show_as([member], "plates"))
    result["plates, skin wanted"] = mended(lambda: member_display.show_as([member], "skin"))
    result["hidden by hand"] = mended(lambda: setattr(member.ViewObject, "Visibility", False))
    member_display.show_as([member], "plates")
    result["shown by hand"] = mended(lambda: setattr(member.ViewObject, "Visibility", True))
    member_display.show_as([member], "plates")
    return result


def warnings():
    """A joint too close to another is a warning: the badge is on the plates and on the member."""
    from BendTorsionWB.gui import tree

    plates, member = by_label("M2 plates"), by_label("M2")
    plates.JointsTop, plates.JointsLeft = [0.5], [0.5]
    FreeCAD.ActiveDocument.recompute()
    steps.settle()
    steps.picture("view_warning")
    return {"worst": [tree.worst(plates), tree.worst(member)], "status": plates.Status}


def speed():
    """Seconds of processor time to show and orbit everything with all labels on."""
    for plates in ours("PlateSet"):
        plates.ViewObject.ShowMarks = plates.ViewObject.ShowPoints = True
    steps.settle()
    view = FreeCADGui.ActiveDocument.ActiveView
    start = time.process_time()
    for turn in range(10):
        view.viewIsometric() if turn % 2 else view.viewTop()
        view.redraw()
        QtGui.QApplication.processEvents()
    spent = (time.process_time() - start) / 10
    return {"labels": sum(len(texts(item)) for item in ours("PlateSet")), "frame": spent}


steps.run(
    saved_without_window,
    labels,
    colours,
    thinning,
    frames,
    modes,
    fitted,
    errors,
    hidden_in_error,
    warnings,
    speed,
)
