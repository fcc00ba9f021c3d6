# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sheets of a whole project: general arrangement, one set of all, and each sheet as SVG."""

from __future__ import annotations

from collections.abc import Sequence

from BendTorsionWB.core.drawings.sheet_arrangement import arrangement_sheets
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_node import has_nodes, node_sheets
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.exchange.output_folder import OutputFolder
from BendTorsionWB.exchange.report import ARRANGEMENT, NODES, SHEET_SET, sheet_name
from BendTorsionWB.exchange.result_cache import key_of
from BendTorsionWB.member_files import pdf_bytes, record_key
from BendTorsionWB.sheets.pdf_join import joined_pdf
from BendTorsionWB.sheets.svg import svg_text


def write_sheet_set(
    folder: OutputFolder,
    records: Sequence[MemberRecord],
    keys: Sequence[str],
    style: SheetStyle,
    svg: bool = False,
) -> None:
    """Write the general arrangement, the drawings of nodes if there are any, and the set of all
    sheets unless they are there, after the sheets of the members; with `svg` every sheet as SVG
    too. Nothing without a healthy member. keys: of what the records come from. Raises
    BendTorsionError."""
    healthy = [record for record in records if record.plates]
    if not healthy:
        return
    own = [record_key(key, record) for key, record in zip(keys, records, strict=True)]
    key = key_of(own, [record.member for record in healthy], style) if all(own) else ""
    names = [ARRANGEMENT, *([NODES] if has_nodes(healthy) else []), SHEET_SET]
    if all(folder.has(name, key) for name in names):
        for name in names:
            folder.keep(name)
    else:
        first = [pdf_bytes(arrangement_sheets(records, style))]
        if NODES in names:
            first.append(pdf_bytes(node_sheets(healthy, style)))
        for name, content in zip(names[:-1], first, strict=True):
            folder.write(name, content, key)
        parts = [(folder.out / sheet_name(record.member)).read_bytes() for record in healthy]
        folder.write(SHEET_SET, joined_pdf([*first, *parts]), key)
    if svg:
        _write_svg(folder, records, healthy, style)


def _write_svg(folder: OutputFolder, records, healthy, style: SheetStyle) -> None:
    sets = [
        (ARRANGEMENT, "", arrangement_sheets(records, style)),
        (NODES, "", node_sheets(healthy, style)),
    ]
    sets += [
        (sheet_name(record.member), record.member, member_sheets(record, style))
        for record in healthy
    ]
    for name, member, sheets in sets:
        for sheet in sheets:
            file = f"{name.removesuffix('.pdf')}-{sheet.number:02d}.svg"
            folder.write(file, svg_text(sheet).encode("utf-8"), "", member)
