# SPDX-License-Identifier: LGPL-2.1-or-later
"""References from one sheet to another: by what they refer to, in the end by its number."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from .sheet_page import Page

PLATE_LIST = "plate list"
"""What `reference` takes for the list of a member's plates."""
_REFERENCE = re.compile("\u27e8(.+?)\u27e9")


def reference(to: str) -> str:
    """What stands for the numbers of the sheets with the tables and details of a plate, by its
    mark, or with the PLATE_LIST, until they are known."""
    return f"\u27e8{to}\u27e9"


def with_numbers(pages: Sequence[Page], first: int = 1) -> list[Page]:
    """The pages with the numbers of those referred to, the first one being sheet `first`."""
    told: list[Page] = []
    for page in pages:
        if not any(_REFERENCE.search(text.text) for text in page.texts):
            told.append(page)
            continue
        texts = tuple(
            replace(text, text=_REFERENCE.sub(lambda to: _numbers(to[1], pages, first), text.text))
            for text in page.texts
        )
        told.append(replace(page, texts=texts))
    return told


def _numbers(to: str, pages: Sequence[Page], first: int) -> str:
    """The numbers of the sheets that show something, runs of them as `5–7`."""
    shows = _lists_plates if to == PLATE_LIST else lambda page: _tells_of(page, to)
    found = [number for number, page in enumerate(pages, start=first) if shows(page)]
    runs: list[list[int]] = []
    for number in found:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    words = (f"{run[0]}–{run[-1]}" if len(run) > 1 else str(run[0]) for run in runs)
    return ", ".join(words) or "–"


def _tells_of(page: Page, mark: str) -> bool:
    """Whether a page has tables or details of a plate."""
    return any(text.text.startswith(f"{mark}:") for text in page.texts) or any(
        view.name.startswith(f"{mark} ") for view in page.views
    )


def _lists_plates(page: Page) -> bool:
    return page.lists_plates
