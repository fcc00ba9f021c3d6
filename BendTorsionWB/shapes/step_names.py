# SPDX-License-Identifier: LGPL-2.1-or-later
"""One named part of a STEP file: the same text without the other parts (ISO 10303-21)."""

from __future__ import annotations

import re

_RECORD = re.compile(r"\s*#(\d+)\s*=\s*(.*)\Z", re.DOTALL)
_STRING = re.compile(r"'((?:[^']|'')*)'")
_NUMBER = re.compile(r"#(\d+)")
_SETS = (
    "GEOMETRIC_CURVE_SET",
    "GEOMETRIC_SET",
    "SHELL_BASED_SURFACE_MODEL",
    "SHELL_BASED_WIREFRAME_MODEL",
    "EDGE_BASED_WIREFRAME_MODEL",
)


def names_in(text: str) -> tuple[str, ...]:
    """Names of the products, and of the items of representations, in the order of the file."""
    records = _records(text)
    found = [_name(body) for body in records.values() if _type(body) == "PRODUCT"]
    for body in records.values():
        if _holds_items(body):
            items = (records.get(ref, "") for ref in _items(body))
            found += [_name(item) for item in items if _type(item) != "AXIS2_PLACEMENT_3D"]
    return tuple(dict.fromkeys(name for name in found if name))


def only_named(text: str, name: str) -> str | None:
    """The file with the product or item of this name alone, where it stands; None without one."""
    records = _records(text)
    products = {
        ref
        for ref, body in records.items()
        if _type(body) == "PRODUCT" and name in _strings(body)[:2]
    }
    if products:
        return _written(text, records, _without_products(records, products))
    wanted = {
        ref for ref, body in records.items() if _type(body) != "PRODUCT" and _name(body) == name
    }
    kept = {ref for ref in records if ref in wanted or _reaches(records, ref, wanted)}
    changed = {}
    hit = False
    for ref, body in records.items():
        if not _holds_items(body):
            continue
        items = _items(body)
        keep = [
            item
            for item in items
            if item in kept or _type(records.get(item, "")) == "AXIS2_PLACEMENT_3D"
        ]
        hit |= any(item in wanted for item in items)
        if ref not in wanted and len(keep) < len(items):
            changed[ref] = re.sub(
                r"\((\s*#\d+\s*(?:,\s*#\d+\s*)*)\)",
                "(" + ",".join(f"#{item}" for item in keep) + ")",
                body,
                count=1,
            )
    return _written(text, records, changed) if hit else None


def _without_products(records: dict[int, str], products: set[int]) -> dict[int, str]:
    """Records to empty so that only these products, and what they are made of, have shape."""
    of_type: dict[str, list[int]] = {}
    for ref, body in records.items():
        of_type.setdefault(_type(body), []).append(ref)
    definitions = {}
    for ref in of_type.get("PRODUCT_DEFINITION", []):
        formation = next(
            (
                r
                for r in _refs(records[ref])
                if _type(records.get(r, "")).startswith("PRODUCT_DEFINITION_FORM")
            ),
            0,
        )
        owner = next(
            (
                r
                for r in _refs(records.get(formation, ""))
                if _type(records.get(r, "")) == "PRODUCT"
            ),
            0,
        )
        definitions[ref] = owner
    uses = {
        ref: _refs(records[ref])[:2] for ref in of_type.get("NEXT_ASSEMBLY_USAGE_OCCURRENCE", [])
    }
    kept = {ref for ref, owner in definitions.items() if owner in products}
    while True:
        more = {part for whole, part in uses.values() if whole in kept} - kept
        if not more:
            break
        kept |= more
    above = set(kept)
    while True:
        more = {whole for whole, part in uses.values() if part in above} - above
        if not more:
            break
        above |= more
    gone = {}
    lost = {use for use, (whole, part) in uses.items() if part not in above}
    gone.update(dict.fromkeys(lost, ""))
    placed = {
        ref
        for ref in of_type.get("PRODUCT_DEFINITION_SHAPE", [])
        if lost & set(_refs(records[ref]))
    }
    gone.update(dict.fromkeys(placed, ""))
    for ref in of_type.get("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION", []):
        if placed & set(_refs(records[ref])):
            gone[ref] = ""
    wholes = {whole for whole, _ in uses.values()}
    for ref in of_type.get("SHAPE_DEFINITION_REPRESENTATION", []):
        shape = _refs(records[ref])[0]
        owner = next((r for r in _refs(records.get(shape, "")) if r in definitions), 0)
        bare = owner not in kept and not (owner in above and owner in wholes)
        if bare:
            gone[ref] = ""
    return gone


def _records(text: str) -> dict[int, str]:
    """The instances of the data section, by number."""
    start = re.search(r"\bDATA\s*;", text)
    data = text[start.end() :] if start else ""
    parts, begin, quoted = [], 0, False
    for mark in re.finditer(r"[';]", data):
        if mark.group() == "'":
            quoted = not quoted
        elif not quoted:
            parts.append(data[begin : mark.start()])
            begin = mark.end()
    found = (_RECORD.match(part) for part in parts)
    return {int(match.group(1)): match.group(2).strip() for match in found if match}


def _written(text: str, records: dict[int, str], changed: dict[int, str]) -> str:
    start = re.search(r"\bDATA\s*;", text).end()
    bodies = ((ref, changed.get(ref, body)) for ref, body in records.items())
    lines = [f"#{ref}={body};" for ref, body in bodies if body]
    return text[:start] + "\n" + "\n".join(lines) + "\nENDSEC;\nEND-ISO-10303-21;\n"


def _type(body: str) -> str:
    return re.match(r"\s*([A-Z0-9_]*)", body).group(1)


def _holds_items(body: str) -> bool:
    kind = _type(body)
    return kind in _SETS or (
        kind.endswith("_REPRESENTATION")
        and kind
        not in ("SHAPE_DEFINITION_REPRESENTATION", "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION")
    )


def _items(body: str) -> list[int]:
    """The first list of references of a record."""
    found = re.search(r"\((\s*#\d+\s*(?:,\s*#\d+\s*)*)\)", body)
    return [int(ref) for ref in _NUMBER.findall(found.group(1))] if found else []


def _strings(body: str) -> list[str]:
    return [found.replace("''", "'") for found in _STRING.findall(body)]


def _name(body: str) -> str:
    strings = _strings(body)
    plain = re.match(r"\s*[A-Z0-9_]+\s*\(\s*'", body)
    return strings[0] if plain and strings else ""


def _refs(body: str) -> list[int]:
    return [int(ref) for ref in _NUMBER.findall(_STRING.sub("''", body))]


def _reaches(records: dict[int, str], ref: int, wanted: set[int]) -> bool:
    """Whether a set holds a wanted item, itself or by a set in it."""
    if _type(records.get(ref, "")) not in _SETS:
        return False
    return any(item in wanted or _reaches(records, item, wanted) for item in _items(records[ref]))
