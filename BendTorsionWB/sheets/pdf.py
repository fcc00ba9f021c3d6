# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sheets as one vector PDF with searchable text, painted by Qt without FreeCAD's window."""

from __future__ import annotations

import errno
import locale
import os
import re
import tempfile
from collections.abc import Sequence
from pathlib import Path

from ..core.drawings.sheet import (
    CAP_HEIGHT,
    CJK_FAMILIES,
    FONT_FAMILY,
    LINE_STYLES,
    Polyline,
    Sheet,
    Text,
)
from ..core.finding import BendTorsionError, error
from .qt import qt_major, qt_modules

RESOLUTION = 1200  # dots per inch; page coordinates are mapped to these dots
DOTS_PER_MM = RESOLUTION / 25.4
FAMILIES = (FONT_FAMILY, "Liberation Sans")
XMP = b"""<?xpacket begin='' id='W5M0MpCehiHzreSzNTczkc9d'?>
<x:xmpmeta xmlns:x="adobe:ns:meta/"/>
<?xpacket end='w'?>"""

_application = None


def write_pdf(sheets: Sequence[Sheet], path: str | Path) -> None:
    """Write the sheets as pages of one PDF, 1:1 in mm; the same sheets give the same bytes.

    The file appears whole or not at all. BendTorsionError when Qt for Python or a font is
    missing; OSError when the file cannot be written.
    """
    path = Path(path)
    if not sheets:
        raise ValueError("a PDF needs at least one sheet")
    qt_core, qt_gui = start_qt()
    handle, temporary = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    os.close(handle)
    try:
        _paint(qt_core, qt_gui, sheets, temporary)
        data = Path(temporary).read_bytes()
        # Qt does not tell when the disk is full.
        if not data.rstrip().endswith(b"%%EOF"):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))
        Path(temporary).write_bytes(_without_time(data))
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def start_qt():
    """QtCore and QtGui of PySide2 or PySide6, with a running QGuiApplication.

    Called before TechDraw pages are made, it also keeps FreeCAD without a window from remarking on
    the missing application for every page. BendTorsionError as for write_pdf.
    """
    global _application
    QtCore, QtGui = qt_modules()
    running = QtCore.QCoreApplication.instance()
    if running is None:
        # A named platform plug-in: no display is needed, and none is looked for. Qt's remarks on
        # a missing session directory are kept from the console.
        previous = QtCore.qInstallMessageHandler(lambda *_: None)
        # The application also sets the C library's locale, which the caller's text files go by.
        characters = locale.setlocale(locale.LC_CTYPE)
        _application = QtGui.QGuiApplication(["BendTorsion", "-platform", "offscreen"])
        locale.setlocale(locale.LC_CTYPE, characters)
        QtCore.qInstallMessageHandler(previous)
    elif not isinstance(running, QtGui.QGuiApplication):
        raise BendTorsionError(
            error(
                "qt-console-application",
                "sheets",
                "this process runs a Qt application without fonts, so PDF cannot be painted",
                "write the PDF from the command line: python3 -m BendTorsionWB build",
            )
        )
    return QtCore, QtGui


def _paint(qt_core, qt_gui, sheets: Sequence[Sheet], path: str) -> None:
    texts = [sheet.all_texts() for sheet in sheets]
    families = _families(qt_gui, texts)
    writer = qt_gui.QPdfWriter(path)
    writer.setResolution(RESOLUTION)
    writer.setTitle(sheets[0].title)
    writer.setCreator("BendTorsion")
    if hasattr(writer, "setDocumentId"):
        # Qt 6 draws an id at random, and tells the time of writing a second time as XMP.
        writer.setDocumentId(qt_core.QUuid.createUuidV5(qt_core.QUuid(), sheets[0].title.encode()))
        writer.setDocumentXmpMetadata(XMP)
    painter = qt_gui.QPainter()
    try:
        pens = {style: _pen(qt_core, qt_gui, style) for style in LINE_STYLES}
        fonts = {}
        for sheet, own in zip(sheets, texts, strict=True):
            writer.setPageLayout(_page_layout(qt_core, qt_gui, sheet))
            if painter.isActive():
                writer.newPage()
            elif not painter.begin(writer):
                raise OSError(f"Qt cannot write {path}")
            for view in sheet.views:
                for line in view.on_page():
                    _draw_line(qt_core, qt_gui, painter, sheet, line, pens)
            for line in sheet.all_lines():
                _draw_line(qt_core, qt_gui, painter, sheet, line, pens)
            painter.setPen(qt_gui.QPen(qt_core.Qt.black))
            for text in own:
                if text.text.strip():
                    size = round(text.height / CAP_HEIGHT * DOTS_PER_MM)
                    if size not in fonts:
                        fonts[size] = _font(qt_gui, size, families, writer)
                    _draw_text(qt_core, painter, sheet, text, *fonts[size])
    finally:
        # A painter that outlives its device crashes the process.
        painter.end()


def _page_layout(qt_core, qt_gui, sheet: Sheet):
    size = qt_gui.QPageSize(
        qt_core.QSizeF(sheet.width, sheet.height),
        qt_gui.QPageSize.Millimeter,
        "",
        qt_gui.QPageSize.ExactMatch,
    )
    return qt_gui.QPageLayout(
        size, qt_gui.QPageLayout.Portrait, qt_core.QMarginsF(0.0, 0.0, 0.0, 0.0)
    )


def _families(qt_gui, texts: Sequence[Sequence[Text]]) -> list[str]:
    """The font, and after it the one for Chinese when the texts of sheets have any."""
    # An object in Qt 5; in Qt 6 the class itself.
    database = qt_gui.QFontDatabase if qt_major() >= 6 else qt_gui.QFontDatabase()
    known = set(database.families())
    family = next((name for name in FAMILIES if name in known), None)
    if family is None:
        raise BendTorsionError(
            error(
                "font-missing",
                "sheets",
                f"none of the fonts {', '.join(FAMILIES)} is installed",
                "on Debian run 'apt-get install fonts-dejavu-core'",
            )
        )
    if not any(_is_chinese(text.text) for own in texts for text in own):
        return [family]
    chinese = next((name for name in CJK_FAMILIES if name in known), None)
    if chinese is None:
        raise BendTorsionError(
            error(
                "font-missing",
                "sheets",
                f"none of the Chinese fonts {', '.join(CJK_FAMILIES)} is installed",
                "on Debian run 'apt-get install fonts-wqy-microhei', or set sheet_language to en",
            )
        )
    return [family, chinese]


def _is_chinese(text: str) -> bool:
    return not text.isascii() and any("\u2e80" <= character <= "\uffef" for character in text)


def _pen(qt_core, qt_gui, style: str):
    width, dashes = LINE_STYLES[style]
    pen = qt_gui.QPen(qt_core.Qt.black)
    pen.setWidthF(width * DOTS_PER_MM)
    pen.setCapStyle(qt_core.Qt.FlatCap if dashes else qt_core.Qt.RoundCap)
    pen.setJoinStyle(qt_core.Qt.RoundJoin)
    if dashes:
        pen.setDashPattern([dash / width for dash in dashes])
    return pen


def _draw_line(qt_core, qt_gui, painter, sheet: Sheet, line: Polyline, pens) -> None:
    painter.setPen(pens[line.style])
    points = [
        qt_core.QPointF(x * DOTS_PER_MM, (sheet.height - y) * DOTS_PER_MM) for x, y in line.points
    ]
    painter.drawPolyline(qt_gui.QPolygonF(points))


def _font(qt_gui, size: int, families, device) -> tuple:
    """The font of a size in dots, and what measures its texts."""
    font = qt_gui.QFont(families[0])
    font.setFamilies(families)
    font.setPixelSize(size)
    font.setHintingPreference(qt_gui.QFont.PreferNoHinting)
    # Any letter spacing turns ligatures off, which would not be found by a search.
    font.setLetterSpacing(qt_gui.QFont.AbsoluteSpacing, 0.04)
    return font, qt_gui.QFontMetricsF(font, device)


def _draw_text(qt_core, painter, sheet: Sheet, text: Text, font, metrics) -> None:
    painter.setFont(font)
    width = metrics.horizontalAdvance(text.text)
    left = -width * {"start": 0.0, "middle": 0.5, "end": 1.0}[text.anchor]
    painter.save()
    painter.translate(text.x * DOTS_PER_MM, (sheet.height - text.y) * DOTS_PER_MM)
    painter.rotate(-text.angle)
    painter.drawText(qt_core.QPointF(left, 0.0), text.text)
    painter.restore()


def _without_time(data: bytes) -> bytes:
    """The PDF with constant times."""
    for key in (b"CreationDate", b"ModDate"):  # the second one is Qt 6's
        found = re.search(rb"/%s \(D:[^)]*\)" % key, data)
        if found:
            data = _exchanged(data, found, b"/%s (D:20000101000000Z)" % key)
    return data


def _exchanged(data: bytes, found: re.Match, constant: bytes) -> bytes:
    """A PDF with a constant in the place of what was found, its cross-reference table put right.

    Qt writes local time, whose text is longer with a time zone than in UTC.
    """
    table = data.rindex(b"\nxref\n")
    shift = len(constant) - len(found[0])

    def moved(entry: re.Match) -> bytes:
        offset = int(entry[1])
        return b"%010d" % (offset + shift if offset > found.start() else offset) + entry[2]

    tail = re.sub(rb"(\d{10})( \d{5} n)", moved, data[table:])
    tail = re.sub(
        rb"startxref\n(\d+)", lambda start: b"startxref\n%d" % (int(start[1]) + shift), tail
    )
    return data[: found.start()] + constant + data[found.end() : table] + tail
