# SPDX-License-Identifier: LGPL-2.1-or-later
"""PDF files painted by Qt joined to one, page after page, without painting them again."""

from __future__ import annotations

import re
from collections.abc import Sequence

_REFERENCE = re.compile(rb"\b(\d+) 0 R\b")


def joined_pdf(parts: Sequence[bytes]) -> bytes:
    """One PDF of the pages of all parts, in order; the same parts give the same bytes. ValueError
    for a file that has no plain cross-reference table or no pages."""
    objects: list[bytes] = [b"", b"", b""]  # catalogue, pages, information
    kids: list[int] = []
    for part in parts:
        own = _objects(part)
        shift = len(objects)
        numbers = {old: shift + k for k, old in enumerate(sorted(own), start=1)}
        for old in sorted(own):
            body = _renumbered(own[old], numbers)
            head = body.partition(b"stream\n")[0]
            if re.search(rb"/Type\s*/Page\b(?!s)", head):
                body = re.sub(rb"/Parent\s+\d+ 0 R", b"/Parent 2 0 R", body, count=1)
                body = _with_inherited(body, own, numbers)
            objects.append(body)
        kids += [numbers[old] for old in _page_order(own)]
    if not kids:
        raise ValueError("no pages to join")
    objects[0] = b"<<\n/Type /Catalog\n/Pages 2 0 R\n>>"
    objects[1] = b"<<\n/Type /Pages\n/Kids [%s]\n/Count %d\n>>" % (
        b" ".join(b"%d 0 R" % kid for kid in kids),
        len(kids),
    )
    objects[2] = b"<<\n/Creator (BendTorsion)\n/CreationDate (D:20000101000000Z)\n>>"
    out = [b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n"]
    offsets, length = [], len(out[0])
    for number, body in enumerate(objects, start=1):
        offsets.append(length)
        out.append(b"%d 0 obj\n%s\nendobj\n" % (number, body))
        length += len(out[-1])
    out.append(b"xref\n0 %d\n0000000000 65535 f \n" % (len(objects) + 1))
    out += [b"%010d 00000 n \n" % offset for offset in offsets]
    out.append(
        b"trailer\n<<\n/Size %d\n/Root 1 0 R\n/Info 3 0 R\n>>\nstartxref\n%d\n%%%%EOF\n"
        % (len(objects) + 1, length)
    )
    return b"".join(out)


def _objects(data: bytes) -> dict[int, bytes]:
    """The bodies of the objects in use by their number, from the cross-reference table."""
    start = int(re.search(rb"startxref\s+(\d+)", data[data.rindex(b"startxref") :])[1])
    head = re.match(rb"xref\s+0 (\d+)\s*\n", data[start:])
    if head is None:
        raise ValueError("the PDF has no plain cross-reference table")
    entries = re.findall(rb"(\d{10}) (\d{5}) ([nf])", data[start + head.end() :])[: int(head[1])]
    places = {k: int(at) for k, (at, _, used) in enumerate(entries) if used == b"n"}
    ends = dict(zip(order := sorted(places.values()), [*order[1:], start], strict=True))
    bodies = {}
    for number, place in places.items():
        text = data[place : ends[place]]
        first = re.match(rb"\d+ 0 obj\s*", text)
        bodies[number] = text[first.end() : text.rindex(b"endobj")].rstrip(b"\n")
    return bodies


def _renumbered(body: bytes, numbers: dict[int, int]) -> bytes:
    """An object with its references put right; what is in its stream is left alone."""
    head, stream, rest = body.partition(b"stream\n")
    head = _REFERENCE.sub(lambda found: b"%d 0 R" % numbers[int(found[1])], head)
    return head + stream + rest


def _pages(own: dict[int, bytes]) -> bytes:
    (pages,) = [body for body in own.values() if re.search(rb"/Type\s*/Pages\b", body)]
    return pages


def _page_order(own: dict[int, bytes]) -> list[int]:
    kids = re.search(rb"/Kids\s*\[(.*?)\]", _pages(own), re.DOTALL)[1]
    return [int(number) for number in _REFERENCE.findall(kids)]


def _with_inherited(body: bytes, own: dict[int, bytes], numbers: dict[int, int]) -> bytes:
    """A page with the resources and the size it had from its parent."""
    pages = _renumbered(_pages(own), numbers)
    for key in (b"/Resources", b"/MediaBox"):
        found = re.search(re.escape(key) + rb"\s*(\d+ 0 R|\[[^\]]*\])", pages)
        if found and key not in body:
            body = body.rstrip()[: -len(b">>")] + found[0] + b"\n>>"
    return body
