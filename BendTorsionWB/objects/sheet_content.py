# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the sheets of a SheetSet show, and how they are drawn: its record and its style."""

from __future__ import annotations

import math
from functools import lru_cache

from BendTorsionWB.core.detailing import with_beds
from BendTorsionWB.core.drawings.sheet import Sheet
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.finding import BendTorsionError, has_error
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.core.site import SiteDatum
from BendTorsionWB.objects.assembly_bed import value as beds_of_object
from BendTorsionWB.objects.proxy import findings_of, linked


def style_of(sheet_set) -> SheetStyle:
    """How a SheetSet's sheets are drawn."""
    return SheetStyle(
        sheet_set.Project,
        sheet_set.Author,
        sheet_set.SheetFormat,
        sheet_set.SheetStandard,
        sheet_set.SheetLanguage,
        sheet_set.SheetUnit,
        SiteDatum(
            sheet_set.SiteX.Value,
            sheet_set.SiteY.Value,
            sheet_set.SiteZ.Value,
            math.radians(sheet_set.SiteRotation.Value),
            sheet_set.SiteUnit,
        ),
    )


def set_style(sheet_set, style: SheetStyle) -> None:
    """Have a SheetSet's sheets drawn so."""
    sheet_set.Project, sheet_set.Author = style.project, style.author
    sheet_set.SheetFormat, sheet_set.SheetStandard = style.format, style.standard
    sheet_set.SheetLanguage, sheet_set.SheetUnit = style.language, style.unit
    site = style.site
    sheet_set.SiteX, sheet_set.SiteY, sheet_set.SiteZ = site.x, site.y, site.z
    sheet_set.SiteRotation, sheet_set.SiteUnit = round(math.degrees(site.rotation), 12), site.unit


@lru_cache(maxsize=64)
def laid_out(record: MemberRecord, style: SheetStyle, plates: bool) -> tuple[Sheet, ...]:
    """The sheets of a member; plates: those of its plates, too."""
    # Every page of a set asks for the same sheets in one recompute; records are kept by the memo.
    return member_sheets(record, style, plates)


def record_of(sheet_set) -> MemberRecord:
    """What a SheetSet shows; a record in error that names the fault when that is nothing."""
    from BendTorsionWB.objects.unfold import member_record_of

    try:
        unfold = linked(sheet_set, "Unfold", "Unfold")
        found = findings_of(unfold)
        if has_error(found):
            return faulty(sheet_set.Label, found)
        record = member_record_of(unfold)
        if sheet_set.Bed is None:
            return record
        bed = linked(sheet_set, "Bed", "AssemblyBed")
        found = findings_of(bed)
        if has_error(found):
            return faulty(sheet_set.Label, found)
        return with_beds(record, beds_of_object(bed))
    except BendTorsionError as problem:
        return faulty(sheet_set.Label, problem.findings)


_kept: dict[str, dict[str, MemberRecord]] = {}


def keep_record(sheet_set) -> MemberRecord:
    """What a SheetSet shows, kept for what is made of many of them: asking each for its record
    takes 3 ms. Called by every recompute of the SheetSet."""
    record = record_of(sheet_set)
    _kept.setdefault(sheet_set.Document.Name, {})[sheet_set.Name] = record
    return record


def kept_record(sheet_set) -> MemberRecord:
    """The record of the last recompute of a SheetSet."""
    record = _kept.get(sheet_set.Document.Name, {}).get(sheet_set.Name)
    return keep_record(sheet_set) if record is None else record


def forget_records(document) -> None:
    """Nothing is kept of a document that is closed."""
    _kept.pop(document.Name, None)


def faulty(name: str, findings) -> MemberRecord:
    """A record that says what is wrong."""
    return MemberRecord(name, "", "", findings=tuple(findings))
