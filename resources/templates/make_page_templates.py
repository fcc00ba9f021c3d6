# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes the TechDraw page templates, one for each page format, into the folder techdraw."""

from __future__ import annotations

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent))

from BendTorsionWB.core.drawings.sheet_style import FORMATS  # noqa: E402
from BendTorsionWB.sheets.techdraw import template_svg  # noqa: E402


def write(folder: Path) -> None:
    """Write every template into a folder."""
    folder.mkdir(exist_ok=True)
    for form in FORMATS.values():
        path = folder / f"{form.name.replace(' ', '_')}.svg"
        path.write_text(template_svg(form), encoding="utf-8")


if __name__ == "__main__":
    write(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "techdraw")
