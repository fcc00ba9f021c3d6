# SPDX-License-Identifier: LGPL-2.1-or-later
"""The revision written into a file that is issued: in the box of a sheet's title block, and where
a cut file has comments. What is drawn, and what is cut, stays as it was built.

A PDF gets a further part at its end (ISO 32000-1, 7.5.6, incremental update).
"""

from __future__ import annotations

import re
from pathlib import PurePosixPath

from BendTorsionWB.core.drawings.sheet_page import SIGNED_CELLS
from BendTorsionWB.core.drawings.sheet_style import TITLE_WIDTH
from BendTorsionWB.core.finding import BendTorsionError, error

SHEETS = "sheets"
"""The folder whose PDF have a title block."""
POINT = 72.0 / 25.4
CAPITAL = 2.5
"""mm; height of the letters, of which Helvetica has 0.718 of its size."""
INSET, ABOVE = 1.2, 1.5
"""mm from the left and the lower edge of the box, as other values of the block stand."""
MARGIN = 10.0
"""mm from the page's edge to the frame, right and below."""
_PAGE = re.compile(
    rb"(\d+) 0 obj\n<<\n/Type /Page\n(?:(?!endobj).)*?/Contents (\d+) 0 R"
    rb"(?:(?!endobj).)*?/Resources (\d+) 0 R(?:(?!endobj).)*?endobj\n",
    re.DOTALL,
)
_WIDTH = re.compile(rb"/MediaBox \[0 0 ([\d.]+) [\d.]+\]")
_SIZE = re.compile(rb"trailer\n<<\n/Size (\d+).*?startxref\n(\d+)", re.DOTALL)


def stamped(name: str, content: bytes, revision: str) -> bytes:
    """The content of a built file (name: its path in the folder) with the revision, ASCII, in it;
    as it was for files that have no place for it. Raises BendTorsionError for a PDF of sheets that
    is none of ours."""
    path = PurePosixPath(name)
    if path.suffix == ".dxf":
        return f"999\nrevision {revision}\n".encode() + content
    if path.suffix == ".nc1":
        first, _, rest = content.partition(b"\n")
        end = b"\r\n" if first.endswith(b"\r") else b"\n"
        return first + b"\n** revision " + revision.encode() + end + rest
    if path.suffix == ".pdf" and path.parts[0] == SHEETS:
        return _pdf(name, content, revision)
    return content


def _foreign(name: str) -> BendTorsionError:
    mend = "build it again with this release, and leave it as it is"
    return BendTorsionError(
        error("sheet-foreign", name, "is no PDF of sheets of this program", mend)
    )


def _pdf(name: str, content: bytes, revision: str) -> bytes:
    """A PDF of sheets with the revision in the box of each page."""
    pages = list(_PAGE.finditer(content))
    sizes = list(_SIZE.finditer(content))
    if not pages or not sizes:
        raise _foreign(name)
    free, before = int(sizes[-1][1]), int(sizes[-1][2])
    width = float(_WIDTH.search(pages[0][0])[1])
    font, opening, closing = free, free + 1, free + 2
    objects = {
        font: b"<<\n/Type /Font\n/Subtype /Type1\n/BaseFont /Helvetica\n>>",
        # What Qt paints moves the page's axes, and does not move them back.
        opening: _stream(b"q"),
        closing: _stream(_text(revision, width)),
    }
    for page in pages:
        contents = b"/Contents [%d 0 R %s 0 R %d 0 R]" % (opening, page[2], closing)
        body = page[0].split(b"obj\n", 1)[1].removesuffix(b"\nendobj\n")
        objects[int(page[1])] = body.replace(b"/Contents %s 0 R" % page[2], contents)
        own = content.index(b"\n%s 0 obj\n" % page[3]) + 1
        body = content[content.index(b"obj\n", own) + 4 : content.index(b"\nendobj", own)]
        named = b"/Font <<\n/Revision %d 0 R\n" % font
        if body.count(b"/Font <<\n") != 1:
            raise _foreign(name)
        objects[int(page[3])] = body.replace(b"/Font <<\n", named)
    out, places = bytearray(content), {}
    for number, body in sorted(objects.items()):
        places[number] = len(out)
        out += b"%d 0 obj\n%s\nendobj\n" % (number, body)
    start = len(out)
    out += b"xref\n"
    for number, place in sorted(places.items()):
        out += b"%d 1\n%010d 00000 n \n" % (number, place)
    trailer = content[sizes[-1].start() : content.index(b">>", sizes[-1].start())]
    trailer = trailer.replace(b"/Size %d" % free, b"/Size %d\n/Prev %d" % (free + 3, before))
    return bytes(out) + trailer + b">>\nstartxref\n%d\n%%%%EOF\n" % start


def _stream(content: bytes) -> bytes:
    return b"<<\n/Length %d\n>>\nstream\n%s\nendstream" % (len(content), content)


def _text(revision: str, width: float) -> bytes:
    """What paints the revision into its box; width: of the page, points."""
    cell = SIGNED_CELLS.index("revision") * TITLE_WIDTH / len(SIGNED_CELLS)
    x = width - POINT * (MARGIN + TITLE_WIDTH - cell - INSET)
    y = POINT * (MARGIN + ABOVE)
    size = POINT * CAPITAL / 0.718
    return b"Q\nq\nBT\n/Revision %.3f Tf\n0 g\n%.3f %.3f Td\n(%s) Tj\nET\nQ" % (
        size,
        x,
        y,
        revision.encode("ascii"),
    )
