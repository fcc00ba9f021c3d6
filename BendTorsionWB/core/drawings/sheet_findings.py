# SPDX-License-Identifier: LGPL-2.1-or-later
"""Findings as sheets tell them: a line without its severity, in the language of the sheet."""

from __future__ import annotations

from ..finding import Finding
from ..finding_language import chinese_text
from .sheet_style import SheetStyle


def finding_text(finding: Finding, style: SheetStyle) -> str:
    """A finding as one line in the style's language, its lengths in the style's unit."""
    if style.language == "zh":
        return chinese_text(finding, style.told_length)
    return finding.line(style.told_length).removeprefix(f"{finding.severity}: ")
