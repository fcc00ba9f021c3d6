# SPDX-License-Identifier: LGPL-2.1-or-later
"""Words of the core that the window shows translated: choices of properties, faces, templates."""

from __future__ import annotations

import FreeCAD

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

WORDS = (
    QT_TRANSLATE_NOOP("BendTorsion", "ellipsoid"),
    QT_TRANSLATE_NOOP("BendTorsion", "sphere"),
    QT_TRANSLATE_NOOP("BendTorsion", "cylinder"),
    QT_TRANSLATE_NOOP("BendTorsion", "cone"),
    QT_TRANSLATE_NOOP("BendTorsion", "torus"),
    QT_TRANSLATE_NOOP("BendTorsion", "plane"),
    QT_TRANSLATE_NOOP("BendTorsion", "face"),
    QT_TRANSLATE_NOOP("BendTorsion", "automatic"),
    QT_TRANSLATE_NOOP("BendTorsion", "curve"),
    QT_TRANSLATE_NOOP("BendTorsion", "points"),
    QT_TRANSLATE_NOOP("BendTorsion", "given"),
    QT_TRANSLATE_NOOP("BendTorsion", "nearest"),
    QT_TRANSLATE_NOOP("BendTorsion", "rule"),
    QT_TRANSLATE_NOOP("BendTorsion", "none"),
    QT_TRANSLATE_NOOP("BendTorsion", "plane section"),
    QT_TRANSLATE_NOOP("BendTorsion", "iso-curve"),
    QT_TRANSLATE_NOOP("BendTorsion", "geodesic"),
    QT_TRANSLATE_NOOP("BendTorsion", "u"),
    QT_TRANSLATE_NOOP("BendTorsion", "v"),
    QT_TRANSLATE_NOOP("BendTorsion", "pull"),
    QT_TRANSLATE_NOOP("BendTorsion", "keep"),
    QT_TRANSLATE_NOOP("BendTorsion", "offset"),
    QT_TRANSLATE_NOOP("BendTorsion", "surface"),
    QT_TRANSLATE_NOOP("BendTorsion", "minimal"),
    QT_TRANSLATE_NOOP("BendTorsion", "fixed"),
    QT_TRANSLATE_NOOP("BendTorsion", "wire"),
    QT_TRANSLATE_NOOP("BendTorsion", "control points"),
    QT_TRANSLATE_NOOP("BendTorsion", "curvature comb"),
    QT_TRANSLATE_NOOP("BendTorsion", "frame ribbon"),
    QT_TRANSLATE_NOOP("BendTorsion", "box1"),
    QT_TRANSLATE_NOOP("BendTorsion", "box2"),
    QT_TRANSLATE_NOOP("BendTorsion", "i"),
    QT_TRANSLATE_NOOP("BendTorsion", "tee"),
    QT_TRANSLATE_NOOP("BendTorsion", "channel"),
    QT_TRANSLATE_NOOP("BendTorsion", "trapezoid"),
    QT_TRANSLATE_NOOP("BendTorsion", "polygon"),
    QT_TRANSLATE_NOOP("BendTorsion", "strips"),
    QT_TRANSLATE_NOOP("BendTorsion", "mitre"),
    QT_TRANSLATE_NOOP("BendTorsion", "flanges"),
    QT_TRANSLATE_NOOP("BendTorsion", "webs"),
    QT_TRANSLATE_NOOP("BendTorsion", "ring"),
    QT_TRANSLATE_NOOP("BendTorsion", "total"),
    QT_TRANSLATE_NOOP("BendTorsion", "square"),
    QT_TRANSLATE_NOOP("BendTorsion", "plumb"),
    QT_TRANSLATE_NOOP("BendTorsion", "level"),
    QT_TRANSLATE_NOOP("BendTorsion", "place"),
    QT_TRANSLATE_NOOP("BendTorsion", "crossing"),
    QT_TRANSLATE_NOOP("BendTorsion", "point"),
    QT_TRANSLATE_NOOP("BendTorsion", "linear"),
    QT_TRANSLATE_NOOP("BendTorsion", "smooth"),
    QT_TRANSLATE_NOOP("BendTorsion", "centre"),
    QT_TRANSLATE_NOOP("BendTorsion", "top"),
    QT_TRANSLATE_NOOP("BendTorsion", "bottom"),
    QT_TRANSLATE_NOOP("BendTorsion", "left"),
    QT_TRANSLATE_NOOP("BendTorsion", "right"),
    QT_TRANSLATE_NOOP("BendTorsion", "top-left"),
    QT_TRANSLATE_NOOP("BendTorsion", "top-right"),
    QT_TRANSLATE_NOOP("BendTorsion", "bottom-left"),
    QT_TRANSLATE_NOOP("BendTorsion", "bottom-right"),
    QT_TRANSLATE_NOOP("BendTorsion", "axis"),
    QT_TRANSLATE_NOOP("BendTorsion", "previous"),
    QT_TRANSLATE_NOOP("BendTorsion", "CN"),
    QT_TRANSLATE_NOOP("BendTorsion", "EU"),
    QT_TRANSLATE_NOOP("BendTorsion", "US"),
    QT_TRANSLATE_NOOP("BendTorsion", "strain"),
    QT_TRANSLATE_NOOP("BendTorsion", "length error"),
    QT_TRANSLATE_NOOP("BendTorsion", "forming"),
    QT_TRANSLATE_NOOP("BendTorsion", "flat"),
    QT_TRANSLATE_NOOP("BendTorsion", "cold"),
    QT_TRANSLATE_NOOP("BendTorsion", "hot"),
    QT_TRANSLATE_NOOP("BendTorsion", "auto"),
    QT_TRANSLATE_NOOP("BendTorsion", "thickness"),
    QT_TRANSLATE_NOOP("BendTorsion", "deviation"),
    QT_TRANSLATE_NOOP("BendTorsion", "curvature"),
    QT_TRANSLATE_NOOP("BendTorsion", "twist"),
    QT_TRANSLATE_NOOP("BendTorsion", "edges"),
    QT_TRANSLATE_NOOP("BendTorsion", "energy"),
    QT_TRANSLATE_NOOP("BendTorsion", "elastic"),
    QT_TRANSLATE_NOOP("BendTorsion", "mid"),
    QT_TRANSLATE_NOOP("BendTorsion", "outer"),
    QT_TRANSLATE_NOOP("BendTorsion", "inner"),
    QT_TRANSLATE_NOOP("BendTorsion", "inside"),
    QT_TRANSLATE_NOOP("BendTorsion", "outside"),
    QT_TRANSLATE_NOOP("BendTorsion", "root"),
    QT_TRANSLATE_NOOP("BendTorsion", "widest"),
    QT_TRANSLATE_NOOP("BendTorsion", "before forming"),
    QT_TRANSLATE_NOOP("BendTorsion", "after forming"),
    QT_TRANSLATE_NOOP("BendTorsion", "link"),
    QT_TRANSLATE_NOOP("BendTorsion", "rank"),
    QT_TRANSLATE_NOOP("BendTorsion", "direct"),
    QT_TRANSLATE_NOOP("BendTorsion", "stub"),
    QT_TRANSLATE_NOOP("BendTorsion", "flanges and webs"),
    QT_TRANSLATE_NOOP("BendTorsion", "fit"),
    QT_TRANSLATE_NOOP("BendTorsion", "middle"),
    QT_TRANSLATE_NOOP("BendTorsion", "normal"),
    QT_TRANSLATE_NOOP("BendTorsion", "T"),
    QT_TRANSLATE_NOOP("BendTorsion", "Y"),
    QT_TRANSLATE_NOOP("BendTorsion", "K"),
    QT_TRANSLATE_NOOP("BendTorsion", "corner"),
    QT_TRANSLATE_NOOP("BendTorsion", "en"),
    QT_TRANSLATE_NOOP("BendTorsion", "zh"),
    QT_TRANSLATE_NOOP("BendTorsion", "ISO"),
    QT_TRANSLATE_NOOP("BendTorsion", "AWS"),
    QT_TRANSLATE_NOOP("BendTorsion", "ft-in"),
    QT_TRANSLATE_NOOP("BendTorsion", "one member on a dome, with a section change"),
    QT_TRANSLATE_NOOP("BendTorsion", "three members on one surface, by planes that cut it"),
    QT_TRANSLATE_NOOP("BendTorsion", "three members on one surface, with drawing sheets"),
    QT_TRANSLATE_NOOP("BendTorsion", "member"),
    QT_TRANSLATE_NOOP("BendTorsion", "segment"),
    QT_TRANSLATE_NOOP("BendTorsion", "section"),
    QT_TRANSLATE_NOOP("BendTorsion", "cut"),
    QT_TRANSLATE_NOOP("BendTorsion", "slope"),
    QT_TRANSLATE_NOOP("BendTorsion", "transition"),
    QT_TRANSLATE_NOOP("BendTorsion", "align"),
    QT_TRANSLATE_NOOP("BendTorsion", "align_to"),
    QT_TRANSLATE_NOOP("BendTorsion", "offset_y"),
    QT_TRANSLATE_NOOP("BendTorsion", "offset_z"),
    QT_TRANSLATE_NOOP("BendTorsion", "severity"),
    QT_TRANSLATE_NOOP("BendTorsion", "object"),
    QT_TRANSLATE_NOOP("BendTorsion", "position"),
    QT_TRANSLATE_NOOP("BendTorsion", "message"),
    QT_TRANSLATE_NOOP("BendTorsion", "value"),
    QT_TRANSLATE_NOOP("BendTorsion", "limit"),
    QT_TRANSLATE_NOOP("BendTorsion", "mend"),
)

SECTION_TYPES = {
    "box1": QT_TRANSLATE_NOOP("BendTorsion", "Webs full height"),
    "box2": QT_TRANSLATE_NOOP("BendTorsion", "Flanges full breadth"),
    "i": QT_TRANSLATE_NOOP("BendTorsion", "I section"),
    "tee": QT_TRANSLATE_NOOP("BendTorsion", "T section"),
    "channel": QT_TRANSLATE_NOOP("BendTorsion", "Channel section"),
    "trapezoid": QT_TRANSLATE_NOOP("BendTorsion", "Box with inclined webs"),
    "polygon": QT_TRANSLATE_NOOP("BendTorsion", "Box of many walls"),
    "strips": QT_TRANSLATE_NOOP("BendTorsion", "Free list of plates"),
}
"""What the codes of section types mean."""


THROUGH_BY = {
    "link": QT_TRANSLATE_NOOP("BendTorsion", "the member chosen above"),
    "rank": QT_TRANSLATE_NOOP("BendTorsion", "the member of lower rank"),
}
"""What decides which member runs through at a node."""


def choice_text(kind: str, name: str, choice: str) -> str:
    """A choice of a property of a kind of object as a field shows it; a code with its meaning."""
    if (kind, name) == ("Node", "ThroughBy"):
        return translate("BendTorsion", THROUGH_BY[choice])
    if (kind, name) == ("SectionSpec", "Type"):
        return f"{choice}: {translate('BendTorsion', SECTION_TYPES[choice])}"
    return translate("BendTorsion", choice)


MENUS = (
    QT_TRANSLATE_NOOP("Workbench", "BendTorsion Model"),
    QT_TRANSLATE_NOOP("Workbench", "BendTorsion Plates"),
    QT_TRANSLATE_NOOP("Workbench", "BendTorsion View"),
    QT_TRANSLATE_NOOP("Workbench", "BendTorsion Output"),
    QT_TRANSLATE_NOOP("Workbench", "&BendTorsion"),
    QT_TRANSLATE_NOOP("Workbench", "Model"),
    QT_TRANSLATE_NOOP("Workbench", "Plates"),
    QT_TRANSLATE_NOOP("Workbench", "View"),
    QT_TRANSLATE_NOOP("Workbench", "Output"),
    QT_TRANSLATE_NOOP("Workbench", "Schedule"),
)
"""Names of toolbars and menus, which FreeCAD looks up by itself."""
