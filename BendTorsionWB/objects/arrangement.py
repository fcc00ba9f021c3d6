# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object ArrangementSet: the pages of the general arrangement of a document's members."""

from __future__ import annotations

from functools import lru_cache

from BendTorsionWB.core.drawings.sheet import Sheet
from BendTorsionWB.core.drawings.sheet_arrangement import arrangement_sheets
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_style import PLAIN_STYLE, SheetStyle
from BendTorsionWB.core.finding import Finding, error
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.objects.proxy import (
    Property,
    Proxy,
    bare_finding,
    findings_of,
    is_bare,
    type_of,
)
from BendTorsionWB.objects.sheet import keep_pages
from BendTorsionWB.objects.sheet_content import faulty, kept_record, style_of


class ArrangementSet(Proxy):
    """All members of some SheetSets in elevation and plan, with their list (App::FeaturePython)."""

    TYPE = "ArrangementSet"
    OUTLINED = True
    PROPERTIES = (
        Property(
            "App::PropertyLinkList",
            "Sheets",
            "Sheets",
            "The sheet sets of the members shown; drawn in the style of the first",
        ),
        Property("App::PropertyInteger", "PageCount", "Result", "Number of pages", output=True),
    )

    def sheets(self, obj) -> tuple[Sheet, ...]:
        """What its pages show: members in error in the list only, and when no member can be drawn
        one page that says so."""
        sets = _sheet_sets(obj)
        style = style_of(sets[0]) if sets else PLAIN_STYLE
        return self.laid_out(tuple(kept_record(one) for one in sets), style, obj.Label)

    def laid_out(
        self, records: tuple[MemberRecord, ...], style: SheetStyle, name: str
    ) -> tuple[Sheet, ...]:
        """The sheets of these records."""
        return _laid_out(records, style, name)

    def build(self, obj):
        """The pages as they are now; in error when one of the members is, which they tell."""
        sets = _sheet_sets(obj)
        told = [_no_sheets(obj, one) for one in obj.Sheets if one not in sets]
        told += [bare_finding(one) for one in sets if is_bare(one)]
        told += [found for one in sets for found in findings_of(one) if found.severity == "error"]
        keep_pages(obj, told)
        return tuple(dict.fromkeys(told))

    def clear(self, obj):
        """Nothing: pages are as new as their members, and tell which of them are in error."""


def _sheet_sets(obj) -> list:
    """The sheet sets that are left of those linked to."""
    return [one for one in obj.Sheets if type_of(one) == "SheetSet"]


def _no_sheets(obj, other) -> Finding:
    return error(
        "link-kind",
        obj.Label,
        "Sheets links to what is no sheet set",
        "link to sheet sets only",
        position="property Sheets",
        value=other.Label,
    )


@lru_cache(maxsize=8)
def _laid_out(records: tuple[MemberRecord, ...], style: SheetStyle, name: str) -> tuple[Sheet, ...]:
    sheets = arrangement_sheets(records, style)
    if sheets:
        return sheets
    empty = error(
        "arrangement-empty",
        name,
        "no member can be drawn",
        "put the members in error right, or add sheets of members to the arrangement",
    )
    return member_sheets(faulty(name, (empty,)), style)
