# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes the pictures of docs/plates.md: docs/images/strain_map.png, pattern_page.svg, bed_plan.svg.

Run: python3 docs/make_plate_pictures.py (no window needed)
"""

import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from BendTorsionWB.core import detailing  # noqa: E402
from BendTorsionWB.core.axes.axis_input import AxisInput  # noqa: E402
from BendTorsionWB.core.beds.bed_face import BedInput  # noqa: E402
from BendTorsionWB.core.detailing import MemberInput, MemberJob, PlatesInput  # noqa: E402
from BendTorsionWB.core.drawings.sheet_layout import member_sheets  # noqa: E402
from BendTorsionWB.core.drawings.sheet_style import SheetStyle  # noqa: E402
from BendTorsionWB.core.geometry.surface import analytic_surface  # noqa: E402
from BendTorsionWB.core.members.zones import Segment  # noqa: E402
from BendTorsionWB.core.patterns.strain_map import strain_map  # noqa: E402
from BendTorsionWB.core.plates.plates import Joints  # noqa: E402
from BendTorsionWB.core.sections.section import box  # noqa: E402
from BendTorsionWB.sheets.strain_picture import write_strain_picture  # noqa: E402
from BendTorsionWB.sheets.svg import write_svg  # noqa: E402

IMAGES = ROOT / "docs" / "images"


def job() -> MemberJob:
    """A box 800 tapering to 600 along 14 m of an ellipsoid."""
    half = np.array([40000.0, 30000.0, 20000.0])
    t = np.linspace(0.0, 1.0, 7)
    u, v = 0.35 + 0.37 * t, 0.2 + 0.29 * t
    unit = np.column_stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)])
    big, small = box("B800", "box1", 800, 800, 20), box("B600", "box1", 600, 600, 20)
    joints = {"top": (0.5,), "bottom": (0.45,), "left": (0.55,), "right": (0.4,)}
    return MemberJob(
        analytic_surface("ellipsoid", dict(zip("abc", half, strict=True))),
        AxisInput("A1", unit * half),
        MemberInput("M1", (Segment(big), Segment(small, 9000.0, 2.5))),
        PlatesInput({face: Joints(ratios) for face, ratios in joints.items()}),
        BedInput(face="bottom", spacing=1800.0),
    )


def main() -> None:
    detailed = detailing.detail(job())
    plate = max((item.plate for item in detailed.plates.plates), key=lambda p: p.end - p.start)
    write_strain_picture(strain_map(plate), IMAGES / "strain_map.png")
    sheets = member_sheets(detailed.record, SheetStyle("Example"))
    for content, name in (("flat patterns", "pattern_page"), ("bed plan", "bed_plan")):
        sheet = next(s for s in sheets if s.title.startswith(f"M1 {content}"))
        write_svg(sheet, IMAGES / f"{name}.svg")


if __name__ == "__main__":
    main()
