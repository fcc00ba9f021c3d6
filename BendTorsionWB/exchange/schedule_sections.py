# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rows of Sections and Strips: what each type takes, and the core section they make."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Mapping, Sequence

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.sections import section_catalogue
from BendTorsionWB.core.sections.section import BOX_TYPES, STEEL, Material, Section
from BendTorsionWB.core.sections.section_strips import StripRow
from BendTorsionWB.core.sections.section_types import section_of
from BendTorsionWB.exchange.schedule_cells import did_you_mean

THICKNESSES = ("t_top", "t_bottom", "t_web")
_BOX = ("h", "b", "t", *THICKNESSES, "gap1", "gap2")
TAKEN: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(BOX_TYPES, _BOX),
    "i": (*_BOX, "b_bottom"),
    "tee": ("h", "b", "t", "t_top", "t_web", "gap1"),
    "channel": _BOX,
    "trapezoid": (*_BOX, "b_bottom", "corner_joint"),
    "polygon": ("corners", "t", "thicknesses", "gap1", "corner_joint"),
    "strips": (),
}
"""Size columns each type takes."""
NEEDED: dict[str, tuple[str, ...]] = {
    **dict.fromkeys((*BOX_TYPES, "i", "tee", "channel"), ("h", "b")),
    "trapezoid": ("h", "b", "b_bottom"),
    "polygon": ("corners",),
    "strips": (),
}
SIZES = tuple(dict.fromkeys(size for sizes in TAKEN.values() for size in sizes))
_COLUMN_OF_CODE = {
    "section-corners": "corners",
    "section-joint": "corner_joint",
    "gap-too-wide": "gap1",
}
USUAL_JOINT = {"trapezoid": "flanges", "polygon": "mitre"}


def strips_of(rows) -> dict[str, list]:
    """The records of sheet Strips by section, in their order."""
    found = defaultdict(list)
    for row in rows:
        found[row["section"]].append(row)
    return found


def section_values(record, strips: Sequence) -> dict:
    """Type and sizes of a Sections row with those of its catalogue section, thicknesses resolved
    from t, and the rows of its strips; mm."""
    entry = section_catalogue.entry(record["catalogue"]) if record["catalogue"] else None
    given = {**dict.fromkeys(SIZES), **entry.sizes} if entry else record
    t = given["t"]
    kind = entry.type if entry else record["type"]
    return {
        "type": kind,
        "h": given["h"],
        "b": given["b"],
        **{name: t if given[name] is None else given[name] for name in THICKNESSES},
        "gap1": given["gap1"] or 0.0,
        "gap2": given["gap2"] or 0.0,
        "b_bottom": given["b_bottom"],
        "corner_joint": given["corner_joint"] or USUAL_JOINT.get(kind, ""),
        "corners": given["corners"] or (),
        "thicknesses": given["thicknesses"] or (),
        "strips": tuple(
            StripRow(*(row[key] for key in StripRow.__dataclass_fields__)) for row in strips
        ),
    }


def core_section(name: str, values: Mapping, material: Material = STEEL) -> Section:
    """The core section of `section_values`; raises BendTorsionError for sizes that make none."""
    kind = values["type"]
    if kind == "strips":
        return section_of(name, kind, material, rows=values["strips"])
    sizes = {key: values[key] for key in ("h", "b", "b_bottom", *THICKNESSES, "gap1", "gap2")}
    if values["corner_joint"]:
        sizes["joint"] = values["corner_joint"]
    if kind == "polygon":
        sizes |= {
            "corners": values["corners"],
            "thickness": values["thicknesses"] or values["t_top"],
            "gap": values["gap1"],
        }
    return section_of(name, kind, material, **{k: v for k, v in sizes.items() if v is not None})


def check_sections(sections, strips, faults: list) -> dict[str, Section | str]:
    """Appends (place, finding) of every section that cannot be made; by name the core section of
    the others, or their type where only that is known."""
    rows_of = strips_of(strips)
    found: dict[str, Section | str] = {}
    for record in sections:
        rows = rows_of.get(record["section"], [])
        kind = _kind(record, faults)
        if kind is None:
            continue
        found.setdefault(record["section"], kind)
        bad = record.bad & {*SIZES, "catalogue"}
        if bad or any(row.bad for row in rows) or not _complete(record, kind, rows, faults):
            continue
        if kind in BOX_TYPES and not _box(record, kind, section_values(record, ()), faults):
            continue
        try:
            made = core_section(record["section"] or "", section_values(record, rows))
        except BendTorsionError as problem:
            for finding in problem.findings:
                _at_its_cell(record, rows, finding, faults)
            continue
        if found[record["section"]] == kind:
            found[record["section"]] = made
    _unused_strips(sections, rows_of, found, faults)
    return found


def _kind(record, faults) -> str | None:
    """The type of a row, its own or that of its catalogue section."""
    if record.bad & {"type", "catalogue"}:
        return None
    if record["catalogue"] is None:
        if record["type"] is None:
            mend = f"fill in type ({', '.join(TAKEN)}), or catalogue"
            _report(faults, record, "type", "value-missing", "the cell is empty", mend)
        return record["type"]
    known = {entry.name: entry for entry in section_catalogue.entries()}
    if record["catalogue"] not in known:
        near = did_you_mean(record["catalogue"], known)
        mend = f"did you mean {near}?" if near else f"use one of {', '.join(known)}"
        message = "the catalogue has no such section"
        _report(faults, record, "catalogue", "catalogue-section", message, mend)
        return None
    entry = known[record["catalogue"]]
    if record["type"] not in (None, entry.type):
        message = f"{entry.name} is of type {entry.type}"
        fields = {"limit": entry.type}
        _report(faults, record, "type", "catalogue-type", message, "empty the cell", **fields)
        return None
    return entry.type


def _complete(record, kind: str, rows, faults) -> bool:
    """Whether a row has what its type needs and nothing else."""
    before = len(faults)
    if record["catalogue"] is not None:
        for column in (c for c in SIZES if c in record.given):
            message = f"sizes of {record['catalogue']} are the catalogue's"
            mend = "empty the cell, or write type and sizes without catalogue"
            _report(faults, record, column, "size-not-used", message, mend)
        return len(faults) == before
    for column in (c for c in SIZES if c in record.given and c not in TAKEN[kind]):
        message = f"type {kind} has no {column}"
        mend = f"empty the cell; {kind} takes {', '.join(TAKEN[kind]) or 'rows of sheet Strips'}"
        _report(faults, record, column, "size-not-used", message, mend)
    for column in (c for c in NEEDED[kind] if record[c] is None):
        _report(faults, record, column, "value-missing", "the cell is empty", f"fill in {column}")
    # Rows of strips that cannot be read are told at their cells.
    unread = any(place.sheet == "Strips" for place, _ in faults)
    if kind == "strips" and not rows and not unread:
        message = f"section {record['section']} has no strips"
        _report(faults, record, "type", "strips-missing", message, "add its plates to sheet Strips")
    found = kind != "strips" or bool(rows)
    return found and len(faults) == before and _thick(record, kind, faults)


def _thick(record, kind: str, faults) -> bool:
    """Whether every thickness is given, by its own column or t."""
    own = [c for c in (*THICKNESSES, "thicknesses") if c in TAKEN[kind]]
    empty = [column for column in own if record[column] is None]
    if not own or not empty or record["t"] is not None:
        return True
    message = f"no thickness: t and {', '.join(empty)} are empty"
    mend = f"fill in t, or all of {', '.join(own[:-1])} and {own[-1]}".replace("all of  and ", "")
    _report(faults, record, "t", "value-missing", message, mend)
    return False


def _box(record, kind: str, values: Mapping, faults) -> bool:
    """Whether the plates and gaps of a box leave room, said at the cells that give them."""
    if record["catalogue"] is not None:
        return True
    source = {name: name if record[name] is not None else "t" for name in THICKNESSES}
    reported = set()
    for name, size in (("t_top", "h"), ("t_bottom", "h"), ("t_web", "b")):
        column, limit = source[name], values[size] / 2.0
        if values[name] >= limit and column not in reported:
            reported.add(column)
            message = f"the plate is not thinner than half of {size} = {values[size]:g} mm"
            mend = f"write less than {limit:g}, or a larger {size}"
            fields = {"limit": limit, "unit": "mm"}
            _report(faults, record, column, "too-thick", message, mend, **fields)
    if reported:
        return False
    if kind == "box1":
        room, plates = values["b"] - 2.0 * values["t_web"], "top and bottom"
    else:
        room, plates = values["h"] - values["t_top"] - values["t_bottom"], "webs"
    gaps = values["gap1"] + values["gap2"]
    if gaps < room:
        return True
    column = "gap1" if values["gap1"] >= values["gap2"] else "gap2"
    message = f"the gaps leave no width for {plates}"
    fields = {"value": gaps, "limit": room, "unit": "mm"}
    mend = f"keep gap1 + gap2 below {room:g}"
    _report(faults, record, column, "gap-too-wide", message, mend, **fields)
    return False


def _at_its_cell(record, rows, finding, faults) -> None:
    """A finding of the core at the cell it speaks of."""
    strip = re.match(r"strip (\d+)", finding.position)
    row, column = record, finding.message.split()[0].rstrip(":")
    if strip and int(strip.group(1)) <= len(rows):
        row = rows[int(strip.group(1)) - 1]
        columns = {"strip-stop": ("stop1", "stop2"), "strip-name": ("face",)}
        near = [c for c in columns.get(finding.code, ("side",)) if row[c] == finding.value]
        column = (near or columns.get(finding.code, ("side",)))[0]
    elif column not in SIZES or column not in record.given:
        column = "t" if column in THICKNESSES else "type"
        for code, name in _COLUMN_OF_CODE.items():
            column = name if finding.code == code and name in record.given else column
    place = "" if strip or not finding.position else f" at {finding.position}"
    fields = {"value": finding.value, "limit": finding.limit, "unit": finding.unit}
    message = finding.message + place
    _report(faults, row, column, finding.code, message, finding.mend, **fields)


def _unused_strips(sections, rows_of, found, faults) -> None:
    """Strips of sections that are of another type."""
    kinds = {record["section"]: found.get(record["section"]) for record in sections}
    for name, rows in rows_of.items():
        kind = kinds.get(name)
        kind = kind.type if isinstance(kind, Section) else kind
        if kind not in (None, "strips"):
            message = f"section {name} is of type {kind} and takes no strips"
            mend = "write type strips on sheet Sections, or delete the rows"
            _report(faults, rows[0], "section", "strips-not-used", message, mend)


def check_faces(rows, members, sections: Mapping[str, Section | str], faults) -> None:
    """Rows with member and face: the face must be one of the member's section."""
    first = {}
    for record in members:
        first.setdefault(record["member"], sections.get(record["section"]))
    for record in rows:
        section = first.get(record["member"])
        face = record["face"]
        if not isinstance(section, Section) or face is None:
            continue
        known = [strip.face for strip in section.strips]
        if face not in known:
            words = ", ".join(known)
            near = did_you_mean(face, known)
            mend = f"did you mean {near}? known: {words}" if near else f"use one of {words}"
            message = f"the section of {record['member']} has no such face"
            _report(faults, record, "face", "unknown-value", message, mend, limit=words)


def _report(faults, record, column, code, message, mend, **fields):
    faults.append((record.place, record.error(column, code, message, mend, **fields)))
