# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD's real window: opening the workbench, an edit shown, the concert hall opened and turned;
the first members from a STEP file.

Run: python3 benchmarks/window.py [model.FCStd]

Seconds, wall and processor, of a FreeCAD on a virtual screen (software rendering). The edit is the
height of a section of a member with 20 plates, from the new value to the redrawn view; the model
is build/concert_hall/model.FCStd when left out (`make demo` makes it).
"""

import json
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from freecad_window import run_in_window  # noqa: E402

SCRIPT = ROOT / "tests" / "window" / "speed_session.py"
LIMITS = {
    "activation": 0.3,
    "edit": 0.5,
    "first_minute": 60.0,
    "open_model": 10.0,
    "first_marks": 1.0,
    "turn": 0.2,
    "turn_labelled": 0.2,
    "open_page": 10.0,
}


def main():
    """Print each figure beside its limit."""
    model = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build/concert_hall/model.FCStd"
    if not model.is_file():
        raise SystemExit(f"{model} is not there: name a model, or make one by `make demo`")
    with tempfile.TemporaryDirectory() as folder:
        seen = run_in_window(SCRIPT, Path(folder), time_limit=600, model=model.resolve())
    print(f"{'':34}{'wall s':>9}{'cpu s':>9}{'limit':>9}")
    for name, text in (
        ("activation", "workbench opened"),
        ("edit", "height edited, 20 plates redrawn"),
        ("first_minute", "members from a STEP file"),
        ("open_model", f"{model.name} opened"),
        ("first_marks", "its marks shown for the first time"),
        ("turn", "view turned once"),
        ("turn_labelled", "the same with labels and ribbons"),
        ("open_page", "its first drawing page opened"),
    ):
        found = seen[name]
        if "failed" in found:
            print(f"{text:34}{found['failed']}")
            continue
        print(f"{text:34}{found['wall']:9.3f}{found['cpu']:9.3f}{LIMITS[name]:9.1f}")
        for part, spent in found.get("parts", {}).items():
            print(f"  {part:32}{'':9}{spent:9.3f}")
        if found.get("note"):
            print(f"  {json.dumps(found['note'])}")


if __name__ == "__main__":
    main()
