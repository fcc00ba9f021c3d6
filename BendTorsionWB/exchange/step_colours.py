# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colours in STEP files: without a window FreeCAD writes none, so they are added to its text.

Each solid gets its product's name and a styled item; the presentation follows ISO 10303-46 as
CAD programs write it in AP214.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from ..core.colour_scale import Colour

_PRODUCT = re.compile(r"PRODUCT\(\s*'((?:[^']|'')*)'")
_SHAPE = re.compile(r"ADVANCED_BREP_SHAPE_REPRESENTATION\('',\s*\(([^)]*)\),\s*(#\d+)\)")
_SOLID = re.compile(r"(#\d+) = MANIFOLD_SOLID_BREP\(''")


def coloured_step(content: bytes, colours: Mapping[str, Colour]) -> bytes:
    """The file with the solid of each product in `colours` named as it is and painted (red, green,
    blue, 0 to 1); other products stay as they are. A product's shape follows it in the file."""
    text = content.decode("latin-1")
    written = {name: _encoded(name) for name in colours}
    by_name = {code: name for name, code in written.items()}
    number = max(map(int, re.findall(r"^#(\d+) =", text, re.MULTILINE)), default=0)
    pieces, added, styles, end = [], [], {}, 0
    for product in _PRODUCT.finditer(text):
        name = by_name.get(product.group(1))
        shape = _SHAPE.search(text, product.end()) if name is not None else None
        solid = _SOLID.search(text, shape.end()) if shape else None
        if solid is None or solid.group(1) not in shape.group(1):
            continue
        pieces += [text[end : solid.end() - 2], f"'{written[name]}'"]
        end = solid.end()
        colour = colours[name]
        if colour not in styles:
            number += 7
            added += _style(number - 6, colour)
            styles[colour] = number
        item = number = number + 1
        number += 1
        added.append(f"#{item} = STYLED_ITEM('colour',(#{styles[colour]}),{solid.group(1)});")
        added.append(
            f"#{number} = MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(#{item}),"
            f"{shape.group(2)});"
        )
    data, mark, rest = text[end:].rpartition("ENDSEC;")
    pieces += [data, *(f"{line}\n" for line in added), mark, rest]
    return "".join(pieces).encode("latin-1")


def _style(first: int, colour: Colour) -> list[str]:
    """The seven records of a surface colour; the last is what items refer to."""
    red, green, blue = (f"{part:.6f}" for part in colour)
    bodies = (
        f"COLOUR_RGB('',{red},{green},{blue})",
        f"FILL_AREA_STYLE_COLOUR('',#{first})",
        f"FILL_AREA_STYLE('',(#{first + 1}))",
        f"SURFACE_STYLE_FILL_AREA(#{first + 2})",
        f"SURFACE_SIDE_STYLE('',(#{first + 3}))",
        f"SURFACE_STYLE_USAGE(.BOTH.,#{first + 4})",
        f"PRESENTATION_STYLE_ASSIGNMENT((#{first + 5}))",
    )
    return [f"#{first + k} = {body};" for k, body in enumerate(bodies)]


def _encoded(name: str) -> str:
    """A name as the kernel writes it: quotes doubled, UTF-8 bytes as they are."""
    return name.replace("'", "''").encode().decode("latin-1")
