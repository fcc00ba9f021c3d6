# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a schedule's Settings say of title blocks and site, kept in a document: its sheet sets have
it as properties; for a document without any it is kept among the document's own metadata."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from dataclasses import asdict

from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.site import SiteDatum
from BendTorsionWB.exchange.kept_rows import KEY as KEPT_ROWS
from BendTorsionWB.objects.proxy import type_of
from BendTorsionWB.objects.sheet_content import style_of

KEY = "BendTorsion sheets"
"""Of the entry in the metadata, a SheetStyle as JSON."""


def keep_style(document, style: SheetStyle) -> None:
    """Keep it among the document's metadata."""
    document.Meta = {**document.Meta, KEY: json.dumps(asdict(style))}


def keep_rows(document, text: str) -> None:
    """Keep rows that no member needs among the document's metadata, as `kept_rows` has them."""
    document.Meta = {**document.Meta, KEPT_ROWS: text}


def rows_in(document) -> str:
    """Those rows, empty where none were kept."""
    return document.Meta.get(KEPT_ROWS, "")


def style_in(document) -> SheetStyle:
    """That of the first sheet set, else what was kept; the default where that is damaged."""
    for obj in document.Objects:
        if type_of(obj) == "SheetSet":
            return style_of(obj)
    try:
        kept = json.loads(document.Meta.get(KEY, "{}"))
        site = SiteDatum(**kept.pop("site", {}))
        return SheetStyle(**kept, site=site)
    except (ValueError, TypeError, AttributeError):
        return SheetStyle()


def style_settings(style: SheetStyle) -> Iterable[tuple[str, object]]:
    """It as keys and values of Settings."""
    yield from (("project", style.project), ("author", style.author))
    for name in ("format", "standard", "language", "unit"):
        yield f"sheet_{name}", getattr(style, name)
    for name in ("x", "y", "z", "unit"):
        yield f"site_{name}", getattr(style.site, name)
    yield "site_rotation", round(math.degrees(style.site.rotation), 12)
