# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes docs/images/project.png: a split model opened whole in the window, on a virtual screen.

Run: python3 benchmarks/project.py --keep build/projects 1000
     python3 docs/make_project_picture.py build/projects/1000/model.FCStd [PICTURE]

Prints the wall seconds of opening it and of turning the view once (software rendering).
"""

import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from freecad_window import run_in_window  # noqa: E402

PICTURE = ROOT / "docs" / "images" / "project.png"
TIME_LIMIT = 1200


def main(model: Path, picture: Path) -> None:
    """Take the picture and print what was measured."""
    with tempfile.TemporaryDirectory() as folder:
        seen = run_in_window(
            ROOT / "tests" / "window" / "project_session.py",
            Path(folder),
            time_limit=TIME_LIMIT,
            model=model.resolve(),
            picture=picture.resolve(),
        )["open_project"]
    if "failed" in seen:
        raise SystemExit(seen["failed"])
    print(f"{seen['members']} members in {seen['documents']} documents: {seen['opened']:.1f} s")
    print(f"view turned once: {seen['turned']:.2f} s; picture {picture}")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]) if len(sys.argv) > 2 else PICTURE)
