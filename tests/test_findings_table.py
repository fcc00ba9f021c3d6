# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every finding is documented, and every error says what mends it."""

import importlib.util
from functools import cache
from pathlib import Path

SCRIPT = Path(__file__).resolve().parent.parent / "scripts" / "findings_table.py"


@cache
def script():
    """The script as a module, which reads the sources once."""
    spec = importlib.util.spec_from_file_location("findings_table", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.findings = cache(module.findings)
    return module


def test_the_page_is_what_the_sources_say():
    """docs/findings.md is the page `make findings` writes."""
    made = script()
    assert made.TABLE.read_text(encoding="utf-8") == made.table(), "run make findings"


def test_every_error_has_a_mend():
    """No error leaves its reader without what to do."""
    bare = [
        (code, message)
        for code, rows in script().findings().items()
        for severity, message, mend in rows
        if severity == "error" and not mend.strip()
    ]
    assert not bare


def test_known_findings_are_found():
    """The reader of the sources sees calls of each kind: by name, at a cell, as a record."""
    found = script().findings()
    assert {"axis-off-surface", "members-intersect", "duplicate"} <= set(found)
    assert len(found) > 200
