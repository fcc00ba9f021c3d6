# SPDX-License-Identifier: LGPL-2.1-or-later
"""The user guide names every command of the window, with its keys."""

import ast
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def commands():
    """(menu text, keys) of every Command declared in gui/commands_*.py."""
    found = []
    for path in sorted((ROOT / "BendTorsionWB" / "gui").glob("commands_*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Command":
                found.append((node.args[1].args[1].value, node.args[3].value))
    return found


def test_the_table_of_commands_is_complete():
    guide = (ROOT / "docs" / "guide.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ([^|]+) \| (B, \w) \|", guide, re.MULTILINE)
    assert len(commands()) > 20
    assert sorted(rows) == sorted(commands())


def test_keys_are_given_once():
    keys = [keys for _, keys in commands()]
    assert len(set(keys)) == len(keys)


def test_links_lead_somewhere():
    guide = ROOT / "docs" / "guide.md"
    for target in re.findall(r"\]\(([^)#]+)\)", guide.read_text(encoding="utf-8")):
        assert (guide.parent / target).exists(), target
