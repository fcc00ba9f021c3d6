# SPDX-License-Identifier: LGPL-2.1-or-later
"""A small document with every kind of object, its figures, and how well another program keeps them.

`python3 tests/carried_document.py save FOLDER` makes and saves it; `compare FOLDER` opens what
another release of FreeCAD saved and compares the figures, as they are in the file and computed
again; exit code 1 when they differ.
"""

import json
import math
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DOCUMENT, FIGURES = "document.FCStd", "figures.json"
RELATIVE = 1e-9
ABSOLUTE = 1e-8
"""Of lengths in mm near 0, such as the distances left after a fit."""
OF_CURVATURE = 1e-6
"""Relative, of what goes with second derivatives when it is computed anew: numpy and scipy of
different releases round differently, and two differences multiply that by a million."""
CURVED = (
    *("MinimumRadius", "BendingRadii", "ForcedStresses", "LockedInStresses", "Moments"),
    *("MiddleClamps", "CornerClamps", "Twists"),
)
POINTS = [(20000 * x, 0, 20000 * (1 - x * x) ** 0.5) for x in (0, 0.1, 0.22, 0.3, 0.41, 0.5)]


def make_document(name="Carried"):
    """The document: two members on a sphere that meet, with plates, patterns, a bed and sheets."""
    import FreeCAD

    from BendTorsionWB import make

    document = FreeCAD.newDocument(name, hidden=True)
    dome = make.make_surface(document, "Dome", "sphere", r=20000)
    big = make.make_section(document, "B600", type="box1", h=600, b=600, t=16)
    low = make.make_section(document, "B500", type="box1", h=500, b=600, t=20)
    small = make.make_section(document, "B300", type="box2", h=300, b=300, t=10)
    axis = make.make_axis(document, "A1", dome, POINTS)
    cut = [{}, {"cut": 5000, "slope": 8}]
    member = make.make_member(document, "M1", axis, [big, low], cut, roll=3)
    across = [(6000, y, math.sqrt(20000**2 - 6000**2 - y**2)) for y in (0, 1000, 2000, 3000, 4000)]
    other = make.make_member(
        document, "M2", make.make_axis(document, "A2", dome, across), sections=[small]
    )
    plates = make.make_plates(document, member, {"top": (0.4, 1)})
    branch = make.make_plates(document, other)
    make.make_node(document, member, other, "N1", plates=[plates, branch])
    unfold = make.make_unfold(document, plates)
    make.make_unfold(document, branch, mode="energy")
    bed = make.make_bed(document, plates)
    sheets = make.make_sheets(document, unfold, "Carried", bed=bed, plate_pages=False)
    make.make_arrangement(document, [sheets])
    document.recompute()
    return document


def figures(document) -> dict[str, dict[str, object]]:
    """By label, every number and text of the outputs of the document's objects."""
    found = {}
    for obj in document.Objects:
        if getattr(obj, "BT_Type", "") in ("", "PageOutlines", "PageSymbol"):
            continue
        outputs = [item.name for item in obj.Proxy.declared(obj) if item.output]
        found[obj.Label] = {name: _plain(getattr(obj, name)) for name in [*outputs, "Status"]}
    return found


def _plain(value):
    value = getattr(value, "Value", value)
    if isinstance(value, str | int | float):
        return value
    return [_plain(item) for item in value]


def differences(saved, now, place="", anew=False) -> list[str]:
    """Where two sets of figures differ by more than rounding; anew: computed by another release."""
    if isinstance(saved, dict):
        return [
            line
            for key in saved
            for line in differences(saved[key], now.get(key), f"{place}.{key}", anew)
        ]
    if isinstance(saved, list):
        if not isinstance(now, list) or len(saved) != len(now):
            return [f"{place}: {saved!r} became {now!r}"[:200]]
        return [
            line
            for k, pair in enumerate(zip(saved, now, strict=True))
            for line in differences(*pair, f"{place}[{k}]", anew)
        ]
    if isinstance(saved, float) and isinstance(now, int | float):
        curved = anew and place.split("[")[0].endswith(CURVED)
        relative = OF_CURVATURE if curved else RELATIVE
        near = math.isclose(saved, now, rel_tol=relative, abs_tol=1e-6 if curved else ABSOLUTE)
        return [] if near else [f"{place}: {saved!r} became {now!r}"]
    return [] if saved == now else [f"{place}: {saved!r} became {now!r}"]


def save(folder: Path) -> None:
    """Make the document in a folder, with its figures."""
    import FreeCAD

    folder.mkdir(parents=True, exist_ok=True)
    document = make_document()
    document.saveAs(str(folder / DOCUMENT))
    text = json.dumps(figures(document), indent=1) + "\n"
    (folder / FIGURES).write_text(text, encoding="utf-8")
    FreeCAD.closeDocument(document.Name)


def compare(document: Path, figures_of: Path) -> list[str]:
    """What differs from the figures in a document as it was saved, and computed again."""
    import FreeCAD

    from BendTorsionWB import make  # noqa: F401 - what computes the objects

    saved = json.loads(figures_of.read_text(encoding="utf-8"))
    opened = FreeCAD.openDocument(str(document), hidden=True)
    try:
        lines = [f"as saved{line}" for line in differences(saved, figures(opened))]
        for obj in opened.Objects:
            obj.touch()
        opened.recompute()
        now = figures(opened)
        return lines + [f"computed{line}" for line in differences(saved, now, anew=True)]
    finally:
        FreeCAD.closeDocument(opened.Name)


def main() -> int:
    sys.path.insert(0, str(ROOT))
    from BendTorsionWB import freecad_path

    freecad_path.append()
    command, folder = sys.argv[1], Path(sys.argv[2])
    if command == "save":
        save(folder)
        return 0
    lines = compare(folder / DOCUMENT, folder / FIGURES)
    count = len(json.loads((folder / FIGURES).read_text(encoding="utf-8")))
    print("\n".join([*lines, f"{folder.name}: {count} objects compared, {len(lines)} differ"]))
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
