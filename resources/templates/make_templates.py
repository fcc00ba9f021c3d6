# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes the document templates: member.FCStd, surface.FCStd, project.FCStd.

Run `python3 make_templates.py [FOLDER]`. Each document has a spreadsheet `Sizes` whose cells drive
the surface, the sections and where the members lie. The same program writes the same bytes.
"""

from __future__ import annotations

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent))

from BendTorsionWB import freecad_path  # noqa: E402

freecad_path.append()

import FreeCAD  # noqa: E402

from BendTorsionWB import make  # noqa: E402
from BendTorsionWB.model_files import checked_recompute, save  # noqa: E402
from BendTorsionWB.sheets.pdf import start_qt  # noqa: E402

SIZES = (
    ("radius", "30000 mm", "radius of the dome"),
    ("height", "600 mm", "height of the section"),
    ("breadth", "500 mm", "breadth of the section"),
    ("plate", "16 mm", "thickness of its plates"),
    ("end_height", "450 mm", "height of the section at the thinner end"),
    ("spacing", "3000 mm", "distance of the members"),
    ("camber", "0 mm", "moves the members off the surface, outwards"),
)


def sizes_sheet(document):
    """The spreadsheet: what, value under an alias, meaning."""
    sheet = document.addObject("Spreadsheet::Sheet", "Sizes")
    for row, (alias, value, meaning) in enumerate(SIZES, start=1):
        sheet.set(f"A{row}", alias)
        sheet.set(f"B{row}", f"={value}")
        sheet.setAlias(f"B{row}", alias)
        sheet.set(f"C{row}", meaning)
    document.recompute()
    return sheet


def dome(document):
    """The surface, its radius from the spreadsheet."""
    surface = make.make_surface(document, "Dome", "sphere", r=30000)
    surface.setExpression("r", "Sizes.radius")
    return surface


def section(document, name: str, height: str):
    """A box section whose sizes follow the spreadsheet."""
    made = make.make_section(document, name, h=600, b=500, t=16)
    for size, alias in (("Height", height), ("Breadth", "breadth"), ("Thickness", "plate")):
        made.setExpression(size, f"Sizes.{alias}")
    return made


def rib(document, name: str, surface, sections, place: int):
    """A member where a plane cuts the dome at x = place × spacing, askew to it, so that the member
    twists: from 15 m before the crown to 3 m behind it."""
    axis = make.make_axis(
        document,
        f"A-{name}",
        surface,
        rule={"kind": "plane section", "origin": (0, 0, 0), "normal": (1, 0.1, 0)}
        | {"start": (0, -15000, 0), "end": (0, 3000, 0)},
    )
    axis.setExpression("RuleOrigin.x", f"Sizes.spacing * {place}")
    for point, y in (("RuleStart", -15000), ("RuleEnd", 3000)):
        # FreeCAD 0.20 saves (15 mm)^2 as 15 mm^2, so the square is taken here.
        x = f"(Sizes.spacing * {place} + {-0.1 * y} mm)"
        axis.setExpression(f"{point}.x", x)
        axis.setExpression(f"{point}.z", f"sqrt(Sizes.radius^2 - {y * y} mm^2 - {x}^2)")
    segments = [{"align": "top"}, {"cut_ratio": 0.6, "slope": 4.0, "align": "top"}]
    member = make.make_member(document, name, axis, sections, segments[: len(sections)])
    member.setExpression("OffsetZ", "Sizes.camber")
    # Plates no longer than the stock, joints of neighbouring faces apart.
    joints = {"top": [0.5], "bottom": [0.5], "left": [0.45], "right": [0.45]}
    plates = make.make_plates(document, member, joints)
    return make.make_unfold(document, plates)


def member_template(document) -> None:
    """One member with a change of section."""
    sizes_sheet(document)
    sections = [section(document, "Base", "height"), section(document, "Tip", "end_height")]
    rib(document, "M1", dome(document), sections, 0)


def surface_template(document) -> None:
    """Three members on one dome."""
    sizes_sheet(document)
    surface, base = dome(document), section(document, "Base", "height")
    for number, place in enumerate(range(-1, 2), start=1):
        rib(document, f"M{number}", surface, [base], place)


def project_template(document) -> None:
    """Three members with their drawing sheets and the general arrangement; pages of plates come
    when `PlatePages` of a sheet set is set."""
    sizes_sheet(document)
    surface = dome(document)
    sections = [section(document, "Base", "height"), section(document, "Tip", "end_height")]
    sets = []
    for number, place in enumerate(range(-1, 2), start=1):
        unfold = rib(document, f"M{number}", surface, sections[: 1 + number % 2], place)
        title = {"project": "Project name", "author": "Drawn by"}
        sets.append(make.make_sheets(document, unfold, **title, plate_pages=False))
    make.make_arrangement(document, sets)


TEMPLATES = {"member": member_template, "surface": surface_template, "project": project_template}


def write(folder: Path) -> None:
    """Write every template into a folder; stops at the first that is not free of errors."""
    start_qt()
    for name, fill in TEMPLATES.items():
        document = FreeCAD.newDocument(name, hidden=True)
        try:
            fill(document)
            found = checked_recompute(document)
            if found:
                raise SystemExit("\n".join(finding.line() for finding in found))
            save(document, folder / f"{name}.FCStd")
        finally:
            FreeCAD.closeDocument(document.Name)


if __name__ == "__main__":
    write(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE)
