# SPDX-License-Identifier: LGPL-2.1-or-later
"""A member's part of a STEP file, made by itself: text whose numbers are filled in where it takes
its place in a file."""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..core.colour_scale import Colour
from ..core.finding import BendTorsionError, error
from .step_tree import SHARED, Product, Records, string

TIME = "1980-01-01T00:00:00"
ROOT = "assemblies"
"""The assembly of all members, where there are several."""
_LEVEL = 1
_COMMENT = re.compile(rb"('[^']*')|/\*.*?\*/", re.DOTALL)
_REST = rb"(?:[^';]+|'[^']*')*;\s*"
# Of the kernel's records those that change: its solids get names, its own product goes, and so do
# the contexts of curves on surfaces, of which it writes one for each, but for the first.
_CHANGED = re.compile(
    rb"^#(\d+)\s*=\s*(?:"
    rb"(?P<solid>(?:MANIFOLD_SOLID_BREP|BREP_WITH_VOIDS)\(\s*'(?='))"
    rb"|(?P<product>(?:APPLICATION_|PRODUCT|SHAPE_(?:DEFINITION_)?REPRESENTATION\b"
    rb"|ADVANCED_BREP_SHAPE_REPRESENTATION\b)" + _REST + rb")"
    rb"|(?P<plane>\(\s*GEOMETRIC_REPRESENTATION_CONTEXT\(2\)" + _REST + rb")"
    rb"|(?P<space>\(\s*GEOMETRIC_REPRESENTATION_CONTEXT\(3\)))",
    re.MULTILINE,
)


@dataclass(frozen=True)
class SolidName:
    """What a solid is called: its mark, its assembly within the member (empty for none), and its
    colour (red, green, blue, 0 to 1)."""

    mark: str
    assembly: str
    colour: Colour


@dataclass(frozen=True)
class StepFragment:
    """Deflated: template, the text with a place for each number, and numbers, as differences of one
    to the next. count: how many records; occurrences: parts of assemblies; definition, shape,
    placement, context: numbers that an assembly of members refers to."""

    name: str
    template: bytes
    numbers: bytes
    count: int
    occurrences: int
    definition: int
    shape: int
    placement: int
    context: int

    def text(self, taken: int, occurred: int) -> bytes:
        """The text in a file where so many numbers are taken by others, besides those shared, and
        so many occurrences."""
        differences = np.frombuffer(zlib.decompress(self.numbers), np.int32)
        numbers = np.cumsum(differences, dtype=np.int64)
        return filled(zlib.decompress(self.template), numbers, taken, occurred)


def filled(template: bytes, numbers: np.ndarray, taken: int, occurred: int) -> bytes:
    """A template with its numbers: those shared as they are, occurrences counted on."""
    moved = np.where(numbers > len(SHARED), numbers + taken, numbers)
    return template % tuple(np.where(numbers < 0, occurred - numbers, moved).tolist())


def template_of(text: bytes) -> tuple[bytes, np.ndarray]:
    """Records as a template, `#%d` for each number outside of strings, and the numbers in their
    order. Comments are left out."""
    if b"/*" in text:
        text = _COMMENT.sub(lambda found: found.group(1) or b"", text)
    # A doubled quote ends a string and begins another: what is within stays within.
    parts = text.replace(b"%", b"%%").split(b"'")
    parts[1::2] = [part.replace(b"#", b"\0") for part in parts[1::2]]
    text = b"'".join(parts)
    numbers = np.array(re.findall(rb"#(\d+)", text), dtype=bytes).astype(np.int64)
    return re.sub(rb"#\d+", b"#%d", text).replace(b"\0", b"#"), numbers


def fragment_of_solids(written: bytes, member: str, names: Sequence[SolidName]) -> StepFragment:
    """The fragment of a member. written: the file of its solids alone as the kernel writes it, in
    the order of `names`. Raises BendTorsionError where the kernel leaves out any."""
    found: dict[str, list[int]] = {"solid": [], "product": [], "plane": [], "space": []}

    def changed(record: re.Match) -> bytes:
        kind, own = record.lastgroup, found[record.lastgroup]
        own.append(int(record.group(1)))
        if kind == "solid" and len(own) <= len(names):
            return record.group() + _within(names[len(own) - 1].mark)
        return b"" if kind == "product" or (kind == "plane" and len(own) > 1) else record.group()

    text = _CHANGED.sub(changed, written.partition(b"DATA;")[2].rpartition(b"ENDSEC;")[0].lstrip())
    count = len(found["solid"])
    # An assembly of the kernel's could hold parts that are not where they stand.
    if count != len(names) or len(found["space"]) != 1 or b"NEXT_ASSEMBLY_USAGE" in written:
        raise BendTorsionError(
            error(
                "step-solids",
                member,
                "its plates cannot be written as STEP: the kernel does not take them for solids",
                "report this with the document",
                value=count,
                limit=len(names),
            )
        )
    template, numbers = template_of(text)
    if found["plane"]:
        numbers[np.isin(numbers, found["plane"])] = found["plane"][0]
    # Counted anew, in their order, without those of records that are gone.
    former, numbers = np.unique(numbers, return_inverse=True)
    first = len(SHARED) + 1
    solids = (np.searchsorted(former, found["solid"]) + first).tolist()
    context = int(np.searchsorted(former, found["space"][0])) + first
    numbers = numbers + first
    records = Records(len(SHARED) + len(former))
    placement = records.placement()
    whole = _member(records, member, names, solids, placement, context)
    numbers = np.concatenate([np.array(records.numbers, np.int64), numbers])
    return StepFragment(
        member,
        zlib.compress("".join(records.lines).encode() + template, _LEVEL),
        zlib.compress(np.diff(numbers, prepend=0).astype(np.int32).tobytes(), _LEVEL),
        records.last - len(SHARED),
        records.occurrences,
        whole.definition,
        whole.shape,
        placement,
        context,
    )


def _within(text: str) -> bytes:
    """What stands between the quotes of a string."""
    return (string(text)[1:-1] % ()).encode()


def _member(
    records: Records,
    name: str,
    names: Sequence[SolidName],
    solids: Sequence[int],
    placement: int,
    context: int,
) -> Product:
    """The assembly of a member, and in it those of its pieces."""
    whole = records.product(name, [placement], context)
    pieces: dict[str, list[tuple[int, SolidName]]] = {}
    for solid, one in zip(solids, names, strict=True):
        pieces.setdefault(one.assembly, []).append((solid, one))
    styles: dict[Colour, int] = {}
    for assembly, own in pieces.items():
        group = whole
        if assembly:
            group = records.product(assembly, [placement], context)
            records.put(group, assembly, whole, (placement, placement))
        for solid, one in own:
            part = records.product(one.mark, [placement, solid], context)
            records.put(part, one.mark, group, (placement, placement))
            if one.colour not in styles:
                styles[one.colour] = records.style(one.colour)
            records.paint(solid, styles[one.colour], context)
    return whole


def step_file(name: str, software: str, fragments: Iterable[StepFragment]) -> Iterator[bytes]:
    """The text of a file, piece by piece: a member by itself, several in an assembly. name: of the
    file; fragments: asked for one after the other."""
    yield (
        (
            "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('FreeCAD Model'),'2;1');\n"
            f"FILE_NAME({string(name)},'{TIME}',(''),(''),{string(software)},'FreeCAD','');\n"
            "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n"
            + "".join(f"#{number} = {body};\n" for number, body in enumerate(SHARED, 1))
        )
        .replace("%%", "%")
        .encode()
    )
    taken, occurred, members = 0, 0, []
    for own in fragments:
        yield own.text(taken, occurred)
        product = Product(own.definition + taken, own.shape + taken)
        members.append((own.name, product, own.placement + taken, own.context + taken))
        taken += own.count
        occurred += own.occurrences
    if len(members) > 1:
        records = Records(len(SHARED) + taken)
        placement = records.placement()
        whole = records.product(ROOT, [placement], members[0][3])
        for name, product, place, _ in members:
            records.put(product, name, whole, (place, placement))
        yield filled("".join(records.lines).encode(), np.array(records.numbers), 0, occurred)
    yield b"ENDSEC;\nEND-ISO-10303-21;\n"
