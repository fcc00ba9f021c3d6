# SPDX-License-Identifier: LGPL-2.1-or-later
"""One edit, from the new height of a section to new solids, patterns and sheets, stage by stage.

Run: python3 benchmarks/edit_trace.py [edits, 7 when left out]

A member of five segments on the 24 m diagonal of the 40/30/20 ellipsoid. CPU milliseconds on one
core, the median of edits to heights never seen before; stages in the order they run.
"""

import os
import statistics
import sys
import time
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from BendTorsionWB import freecad_path  # noqa: E402

freecad_path.append()

import FreeCAD  # noqa: E402
from curved_members import diagonal, irregular  # noqa: E402
from PySide2 import QtWidgets  # noqa: E402

from BendTorsionWB import make  # noqa: E402
from BendTorsionWB.core import detailing  # noqa: E402
from BendTorsionWB.core.drawings import sheet_layout  # noqa: E402
from BendTorsionWB.objects import axis, member, plate_set, section_spec, sheet, unfold  # noqa: E402
from BendTorsionWB.shapes import brep  # noqa: E402

OBJECTS = (
    ("SectionSpec", section_spec.SectionSpec),
    ("Axis", axis.Axis),
    ("Member", member.Member),
    ("PlateSet", plate_set.PlateSet),
    ("Unfold", unfold.Unfold),
    ("SheetSet", sheet.SheetSet),
    ("outlines of pages", sheet.PageOutlines),
    ("symbols of pages", sheet.PageSymbol),
)
STAGES = (
    (detailing, "member_of", "frames, section law, bend check"),
    (detailing, "member_skins", "outer skin"),
    (detailing, "plates_of", "plates, joints, skins"),
    (brep, "tube_solids", "B-rep of solids"),
    (detailing, "record_of", "flat patterns, lofting record"),
    (sheet_layout, "member_sheets", "sheet model"),
)


class Trace:
    """CPU time of functions while they run, without what they call among the traced."""

    def __init__(self):
        self.stack, self.spent = [], defaultdict(float)

    def wrap(self, function, name):
        def traced(*arguments, **named):
            start, self.stack = time.process_time(), [*self.stack, 0.0]
            try:
                return function(*arguments, **named)
            finally:
                whole, inner = time.process_time() - start, self.stack[-1]
                self.stack = self.stack[:-1]
                self.spent[name] += whole - inner
                if self.stack:
                    self.stack[-1] += whole

        return traced


def model():
    """The document, the section to edit, and its last object."""
    document = FreeCAD.newDocument("edit", hidden=True)
    surface = make.make_surface(document, "Hall", "ellipsoid", a=40000, b=30000, c=20000)
    along = make.make_axis(document, "A1", surface, irregular(diagonal))
    big = make.make_section(document, "B800", "box1", h=800, b=800, t=20)
    small = make.make_section(document, "B600", "box1", h=600, b=600, t=20)
    cuts = [{}, *({"cut": cut} for cut in (5000.0, 10000.0, 15000.0, 20000.0))]
    built = make.make_member(document, "M1", along, [big, small, big, small, big], cuts)
    plates = make.make_plates(
        document, built, {face: [0.2, 0.4, 0.6, 0.8] for face in ("top", "bottom", "left", "right")}
    )
    make.make_sheets(document, make.make_unfold(document, plates), "Hall", "")
    document.recompute()
    return document, big, plates


def main() -> None:
    edits = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    application = QtWidgets.QApplication([])  # TechDraw asks it for fonts
    document, section, plates = model()
    trace = Trace()
    for name, kind in OBJECTS:
        kind.build = trace.wrap(kind.build, f"{name}, what is left")
    for module, function, name in STAGES:
        setattr(module, function, trace.wrap(getattr(module, function), name))
    if hasattr(sheet, "member_sheets"):
        sheet.member_sheets = sheet_layout.member_sheets
    runs, wholes = [], []
    for edit in range(edits):
        trace.spent.clear()
        start = time.process_time()
        section.Height = 801 + edit
        document.recompute()
        wholes.append(1e3 * (time.process_time() - start))
        runs.append(dict(trace.spent))
    bad = [o.Label for o in document.Objects if getattr(o, "Status", "ok") != "ok"]
    heights = f"Height 800 -> 801 ... {800 + edits} mm"
    print(f"{heights}, {plates.PlateCount} plates; in error: {', '.join(bad) or 'none'}")
    print(f"{'stage':36} {'ms':>8}")
    for name in dict.fromkeys(name for run in runs for name in run):
        print(f"{name:36} {1e3 * statistics.median(run.get(name, 0.0) for run in runs):8.1f}")
    told = [1e3 * sum(run.values()) for run in runs]
    rest = statistics.median(whole - own for whole, own in zip(wholes, told, strict=True))
    print(f"{'FreeCAD: views of pages, graph':36} {rest:8.1f}")
    print(f"{'edit to result':36} {statistics.median(wholes):8.1f}")
    del application
    os._exit(0)


if __name__ == "__main__":
    main()
