# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes the pictures of docs/sheets.md: one sheet of each kind, of the concert hall.

Run: python3 docs/make_sheet_pictures.py (no window needed; takes pdftoppm)
"""

import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from BendTorsionWB import freecad_path  # noqa: E402

freecad_path.append()

from BendTorsionWB.core import detailing  # noqa: E402
from BendTorsionWB.core.drawings.sheet_arrangement import arrangement_sheets  # noqa: E402
from BendTorsionWB.core.drawings.sheet_layout import member_sheets  # noqa: E402
from BendTorsionWB.project import read_project  # noqa: E402
from BendTorsionWB.sheets.pdf import write_pdf  # noqa: E402

IMAGES = ROOT / "docs" / "images"
SCHEDULE = ROOT / "resources" / "examples" / "concert_hall" / "concert_hall.xlsx"
RESOLUTION = 60  # dots per inch
SHOWN = "M4"


def main() -> None:
    schedule, jobs, _ = read_project(SCHEDULE)
    records = [detailing.detail(job).record for job in jobs.values()]
    style = replace(schedule.settings.sheet_style, project="Concert hall")
    own = member_sheets(next(r for r in records if r.member == SHOWN), style)
    shown = {"sheet_arrangement": arrangement_sheets(records, style)[0]}
    for content, name in (
        ("assembly", "sheet_assembly"),
        ("sections and welds", "sheet_sections"),
        ("flat patterns", "sheet_plate"),
    ):
        shown[name] = next(s for s in own if s.title == f"{SHOWN} {content}")
    shown["sheet_weld_map"] = next(
        s for s in own if any(text.text == "Weld map" for text in s.all_texts())
    )
    with tempfile.TemporaryDirectory() as folder:
        for name, sheet in shown.items():
            pdf = Path(folder) / f"{name}.pdf"
            write_pdf([sheet], pdf)
            subprocess.run(
                ["pdftoppm", "-r", str(RESOLUTION), "-gray", "-png", "-singlefile"]
                + [str(pdf), str(IMAGES / name)],
                check=True,
            )


if __name__ == "__main__":
    main()
