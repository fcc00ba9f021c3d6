# SPDX-License-Identifier: LGPL-2.1-or-later
"""The catalogue of sections: editable sizes by name, each with its source and status."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

from ..finding import BendTorsionError, error
from .section import STEEL, Material, Section
from .section_types import section_of

FILE = Path(__file__).resolve().parents[3] / "resources" / "catalogue" / "sections.json"
SIZES = ("h", "b", "b_bottom", "t", "t_top", "t_bottom", "t_web", "gap1", "gap2")


@dataclass(frozen=True)
class CatalogueEntry:
    """A section of the catalogue: its type and sizes in mm as a SectionSpec takes them."""

    name: str
    type: str
    sizes: dict[str, float]
    source: str
    status: str

    def section(self, material: Material = STEEL) -> Section:
        """The section; raises BendTorsionError for sizes that make none."""
        t = self.sizes.get("t")
        sizes = {"t_top": t, "t_bottom": t, "t_web": t} if t else {}
        sizes.update((key, value) for key, value in self.sizes.items() if key != "t")
        return section_of(self.name, self.type, material, **sizes)


def entries(file: Path = FILE) -> tuple[CatalogueEntry, ...]:
    """All sections in the file's order; raises BendTorsionError when it cannot be read."""
    try:
        rows = json.loads(file.read_text(encoding="utf-8"))["sections"]
        found = tuple(
            CatalogueEntry(
                row["name"],
                row["type"],
                {key: float(value) for key, value in row["sizes"].items()},
                row["source"],
                row["status"],
            )
            for row in rows
        )
        unknown = {key for entry in found for key in entry.sizes} - set(SIZES)
        if unknown:
            raise ValueError(f"unknown sizes {', '.join(sorted(unknown))}")
        return found
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as problem:
        raise BendTorsionError(
            error("catalogue", file.name, f"cannot read the catalogue: {problem}", "mend the file")
        ) from problem


def entry(name: str) -> CatalogueEntry:
    """One section by name; raises BendTorsionError when there is none."""
    found = {one.name: one for one in entries()}
    if name not in found:
        raise BendTorsionError(
            error(
                "catalogue-section",
                name,
                "the catalogue has no such section",
                f"use one of {', '.join(found)}",
                value=name,
            )
        )
    return found[name]
