# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object NodeSheets: the pages of the nodes of a document's members."""

from __future__ import annotations

from functools import lru_cache

from BendTorsionWB.core.drawings.sheet import Sheet
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_node import node_sheets
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.finding import error
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.core.welds.landed_marks import with_landed_marks
from BendTorsionWB.objects.arrangement import ArrangementSet
from BendTorsionWB.objects.sheet_content import faulty


class NodeSheets(ArrangementSet):
    """The drawing of each node of the members of some SheetSets (App::FeaturePython)."""

    TYPE = "NodeSheets"
    OUTLINED = False

    def laid_out(
        self, records: tuple[MemberRecord, ...], style: SheetStyle, name: str
    ) -> tuple[Sheet, ...]:
        """The drawings of the nodes; without one that can be drawn a page that says so."""
        return _laid_out(records, style, name)


@lru_cache(maxsize=2)
def _laid_out(records: tuple[MemberRecord, ...], style: SheetStyle, name: str) -> tuple[Sheet, ...]:
    # Every page asks for the same sheets in one recompute; records are kept by the memo.
    sheets = node_sheets(with_landed_marks(records), style)
    if sheets:
        return sheets
    empty = error(
        "nodes-empty",
        name,
        "no node can be drawn",
        "put the members that meet in error right, or delete these sheets",
    )
    return member_sheets(faulty(name, (empty,)), style)
