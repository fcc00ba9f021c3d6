# SPDX-License-Identifier: LGPL-2.1-or-later
"""What lies in the output folder, for those who receive it: README.txt and a list in the report."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from textwrap import wrap

from ..core.finding import Finding
from ..core.lofting import MemberRecord

README = "README.txt"
LEFT_OUT = (
    *("member-without-patterns", "plates-without-patterns"),
    *("member-outdated", "members-not-built"),
)
"""Codes of findings that tell of members no file of the package holds."""
_WIDTH = 96

_ALWAYS = ("report.html", "results.xlsx", "report.json")

GUIDE = (
    ("report.html", "start here: pictures, figures against limits, findings, list of plates"),
    ("sheets/set.pdf", "all drawings in one file"),
    ("sheets/general_arrangement.pdf", "all members in plan and elevation, and their list"),
    ("sheets/nodes.pdf", "a drawing of each node"),
    ("sheets/<member>.pdf", "drawings of one member: assembly, welds, bed, plates"),
    ("plates/<mark>.dxf", "flat pattern of one plate, 1:1, mm: contour to cut, lines to mark"),
    ("nc1/<mark>.nc1", "the same plate for machines that read DSTV"),
    ("plates/all/<thickness> <grade>.dxf", "all plates of one thickness and grade side by side"),
    ("nesting.csv", "parts with quantity, size, grade, DXF file and rolling direction"),
    ("templates/<member>-<line>.dxf", "outline of the section at a line, for a board to check it"),
    ("results.xlsx", "bill of materials, points, lines, welds, beds, control points, checks"),
    ("report.json", "figures and findings for other programs"),
    ("model.ifc", "solids of all plates with quantities, placed on the site"),
    ("model.step", "solids of all plates, named and coloured, in model coordinates"),
    ("model/<number>.ifc", "the same for a group of members"),
    ("model/<number>.step", "the same for a group of members"),
    ("model.FCStd", "the FreeCAD document"),
    ("revision.xlsx", "every plate against the last issue"),
)
"""Files by name, what stands in <> varies, and what is in them."""

_WORDS = """
Lengths are mm, areas mm2, masses kg, angles degrees.

Marks: M12-T3 is the third plate along member M12 on its top face (T top, B bottom, L left,
R right, seen along the member with its surface above). Every plate has a mark of its own;
plates that are equal, and marked with the same lines along the same +s, share a part mark;
mirror images never do, nor, diaphragms apart, plates that fit turned end for end.

Patterns are seen from the marking face that is written on them. They are gross: with the
allowances for shrinkage and fit-up of the schedule. "contour" on the pattern says which line of
an edge is drawn: mid (in the middle of the thickness, of the edge before any groove is cut into
it), inner or outer (of that face, likewise before), top (of the marked face, grooves cut), root
(where groove and land meet), widest (the outermost of the edge, grooves cut). Root gaps are
taken off the plates, but for the rule pack's of butt joints, by which joints shrink.

Grooves are told by the texts on layer MARK_BEVEL, by the bevel fields of NC1
and by sheet Bevels; the solids of STEP and IFC are without them. "land 2, chamfer 1:4 16x4 up"
at a joint with a thinner plate: after cutting the marked face ("down": the other one) is machined
off over 16 mm, 4 mm deep at the edge, and leaves a land of 2 mm; the solids have the chamfer.
"square, open 50.0 deg up" at a side of a diaphragm: cut square, not bevelled; what it is welded
to stands askew, and leaves a groove of 50 degrees open at the marked face.

Layers of the DXF files: CUT_OUTER, CUT_INNER to cut; MARK_LINE, MARK_FOLD, MARK_ROLL,
MARK_TEXT, MARK_BEVEL to mark; PUNCH to punch; REF for information only.
"""


def rows(names: Collection[str]) -> Iterator[tuple[str, str]]:
    """The rows of GUIDE that files with these names, relative to the folder, belong to."""
    known = {*names, *_ALWAYS}
    taken: set[str] = set()
    for name, what in GUIDE:
        parts = re.split("<[^>]+>", name)
        pattern = re.compile("[^/]+".join(map(re.escape, parts)))
        begun = (own for own in known if own.startswith(parts[0]))
        found = {own for own in begun if pattern.fullmatch(own)} - taken
        taken |= found
        if found:
            yield name, what


def left_out(records: Iterable[MemberRecord], findings: Iterable[Finding]) -> list[str]:
    """What the package is without, a line each: members in error, and what LEFT_OUT tells of."""
    lines = [
        f"{record.member}: in error, see report.html" for record in records if not record.plates
    ]
    lines += [f"{f.object}: {f.message}" for f in findings if f.code in LEFT_OUT]
    return list(dict.fromkeys(lines))


def readme(
    project: str,
    version: str,
    listed: Sequence[tuple[str, str]],
    missing: Sequence[str] = (),
) -> str:
    """The text of README.txt; project: its title, version: of the program; listed: as `rows`;
    missing: as `left_out`."""
    wide = max(len(name) for name, _ in listed)
    title = f"Fabrication package {project}".rstrip()
    lines = [title, "=" * len(title), f"Written by BendTorsion {version}.", ""]
    if missing:
        lines.append("NOT in this package:")
        for told in missing:
            lines += wrap(told, _WIDTH, initial_indent="  ", subsequent_indent="    ")
        lines.append("")
    lines += [f"{name:{wide}}  {what}" for name, what in listed]
    return "\n".join(lines) + "\n" + _WORDS
