# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bring the translations up to the sources: every text of the window into each .ts, then .qm.

`python3 scripts/translations.py` lists what has no translation yet, by file; `--check` writes
nothing and fails when something is missing or out of date. A .ts file holds what people write; a
.qm is made of it by Qt's lrelease (Debian: qttools5-dev-tools), named by LRELEASE or found.
"""

from __future__ import annotations

import ast
import os
import shutil
import subprocess
import sys
import xml.etree.ElementTree as tree
from functools import cache
from importlib import import_module
from pathlib import Path
from xml.sax.saxutils import escape

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / "resources" / "translations"
SOURCES = (ROOT / "BendTorsionWB" / "gui", ROOT / "InitGui.py")
FUNCTIONS = ("translate", "QT_TRANSLATE_NOOP")
PROPERTIES = "App::Property"
"""The context in which FreeCAD looks up groups and tooltips of properties."""
SEGMENTS = 12
"""Segments of a member whose groups of properties have their name translated."""


def source_texts() -> dict[tuple[str, str], str]:
    """(context, text) of every literal given to translate or QT_TRANSLATE_NOOP, and its file."""
    files = [path for source in SOURCES for path in (sorted(source.rglob("*.py")) or [source])]
    found = {}
    for path in files:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and _name(node.func) in FUNCTIONS and len(node.args) >= 2:
                given = [item.value for item in node.args[:2] if isinstance(item, ast.Constant)]
                if len(given) == 2 and given[1]:
                    found.setdefault(tuple(given), str(path.relative_to(ROOT)))
    return found | property_texts()


@cache
def property_texts() -> dict[tuple[str, str], str]:
    """(context, text) of the groups and tooltips of the properties of every kind of object, and
    its file."""
    sys.path.insert(0, str(ROOT))
    from BendTorsionWB import freecad_path

    freecad_path.append()
    import FreeCAD  # noqa: F401 - before the objects, which need it

    from BendTorsionWB.objects import member, proxy

    folder = ROOT / "BendTorsionWB" / "objects"
    modules = [
        import_module(f"BendTorsionWB.objects.{p.stem}") for p in sorted(folder.glob("*.py"))
    ]
    kinds = {item for module in modules for item in vars(module).values() if _is_kind(item)}
    declared = [("proxy", proxy.BASE_PROPERTIES), ("member", member.segment_properties(SEGMENTS))]
    declared += [(kind.__module__.rpartition(".")[2], kind.PROPERTIES) for kind in kinds]
    return {
        (PROPERTIES, text): f"BendTorsionWB/objects/{module}.py"
        for module, properties in declared
        for item in properties
        for text in (item.group, item.tooltip)
    }


def _is_kind(item) -> bool:
    return isinstance(item, type) and hasattr(item, "PROPERTIES")


def _name(function) -> str:
    return getattr(function, "attr", getattr(function, "id", ""))


def translations(path: Path) -> dict[tuple[str, str], str]:
    """(context, text) -> translation of a .ts file; empty for those not translated."""
    return {
        (context.findtext("name"), message.findtext("source")): message.findtext("translation")
        for context in tree.parse(path).iterfind("context")
        for message in context.iterfind("message")
    }


def ts_text(language: str, texts, known: dict[tuple[str, str], str]) -> str:
    """The content of a .ts file: contexts and texts in alphabetical order."""
    lines = ['<?xml version="1.0" encoding="utf-8"?>', "<!DOCTYPE TS>"]
    lines.append(f'<TS version="2.1" language="{language}" sourcelanguage="en">')
    for context in sorted({context for context, _ in texts}):
        lines += ["<context>", f"    <name>{escape(context)}</name>"]
        for text in sorted(text for own, text in texts if own == context):
            translated = known.get((context, text)) or ""
            kind = "" if translated else ' type="unfinished"'
            lines += [
                "    <message>",
                f"        <source>{escape(text)}</source>",
                f"        <translation{kind}>{escape(translated)}</translation>",
                "    </message>",
            ]
        lines.append("</context>")
    return "\n".join([*lines, "</TS>", ""])


def missing(path: Path) -> list[tuple[str, str, str]]:
    """(file, context, text) of every text of the sources without a translation in a .ts file."""
    known = translations(path)
    return [(file, *pair) for pair, file in sorted(source_texts().items()) if not known.get(pair)]


def write(path: Path) -> None:
    """Bring a .ts file up to the sources and make its .qm."""
    texts, known = source_texts(), translations(path)
    language = path.stem.split("_", 1)[1].replace("-", "_")
    path.write_text(ts_text(language, texts, known), encoding="utf-8")
    maker = os.environ.get("LRELEASE") or shutil.which("lrelease") or "/usr/lib/qt5/bin/lrelease"
    if not Path(maker).exists():
        raise SystemExit("lrelease is missing: apt-get install qttools5-dev-tools, or set LRELEASE")
    made = path.with_suffix(".qm")
    subprocess.run([maker, "-silent", str(path), "-qm", str(made)], check=True)


def main() -> int:
    """Write, or with `--check` only tell; 1 when a text has no translation."""
    count = 0
    for path in sorted(FOLDER.glob("*.ts")):
        if "--check" not in sys.argv:
            write(path)
        for file, context, text in missing(path):
            count += 1
            print(f"{path.name}: {file}: {context}: {text}")
    print(f"{count} texts without a translation")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
