# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which tests need no FreeCAD: those of numbers, schedules and files, to try other libraries."""

import ast
from functools import cache
from pathlib import Path

HERE = Path(__file__).resolve().parent
FREECAD = {"FreeCAD", "FreeCADGui", "Part", "PySide", "PySide2", "PySide6", "freecad_window"}
PURE = {"core", "exchange", "__version__"}
"""What of the package does without FreeCAD."""
PROGRAMS = {"test_release.py"}
"""Tests of programs that start FreeCAD."""
FIXTURES = {"built", "document", "qt_program"}
"""Fixtures that build a project with its model or make a document, and programs that use Qt."""


@cache
def needs_freecad(path: Path) -> bool:
    """Whether a test module imports FreeCAD, or what does, anywhere in it."""
    return path.name in PROGRAMS or any(map(_is_freecad, _imported(path)))


def _is_freecad(name: str) -> bool:
    top, *rest = name.split(".")
    if top == "BendTorsionWB":
        return rest[:1] != [] and rest[0] not in PURE
    local = HERE / f"{top}.py"
    return top in FREECAD or (local.exists() and needs_freecad(local))


def _imported(path: Path):
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            # Programs run in another interpreter.
            if any(f"import {name}" in node.value for name in FREECAD):
                yield "FreeCAD"
            elif "-m BendTorsionWB" in node.value or node.value == "BendTorsionWB":
                yield "FreeCAD"
