# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes docs/findings.md: every code a finding can carry, what it says and what mends it, read off
the calls in the sources."""

import ast
import itertools
import re
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TABLE = ROOT / "docs" / "findings.md"
SEVERITIES = ("error", "warning", "note")
# Parameters of error(), warning(), note() and of Finding(), in their order.
CALLED = ("code", "object", "message", "mend")
AT_CELL = ("column", "code", "message", "mend")  # a row's own method
RECORD = ("severity", "code", "object", "position", "value", "limit", "unit", "message", "mend")

HEAD = """# Findings

Whatever BendTorsion has to say about its input is one record: on an object in the document, on
the console, in sheet `Checks` of the workbook and in `report.json` it has the same code. An
**error** gives no shape and no files; a **warning** or **note** does. The tables are made from the
program's own calls by `make findings`; words in *italics* stand for names and values. Sheet and
column names of a schedule are codes as well: the cell that cannot be read is its place
([schedule.md](schedule.md)).

A fault of the program itself is one line too, `unexpected …`; `--debug` prints where it arose, and
`python3 -m BendTorsionWB support` collects what a report of it needs.
"""


def words(node, names):
    """The texts an expression can be, with `*name*` where a value comes in."""
    if isinstance(node, ast.Constant):
        return [str(node.value)]
    if isinstance(node, ast.JoinedStr):
        parts = [
            words(part, names) if isinstance(part, ast.Constant) else [f"*{spoken(part.value)}*"]
            for part in node.values
        ]
        return ["".join(choice) for choice in itertools.islice(itertools.product(*parts), 4)]
    if isinstance(node, ast.IfExp):
        return words(node.body, names) + words(node.orelse, names)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        both = itertools.product(words(node.left, names), words(node.right, names))
        return ["".join(pair) for pair in itertools.islice(both, 4)]
    if isinstance(node, ast.Name) and node.id in names:
        return names[node.id]
    return [f"*{spoken(node)}*"]


def spoken(node):
    """An expression in a word or two."""
    if isinstance(node, ast.Call):
        inner = node.args[0] if node.args else node.func
        return spoken(inner)
    if isinstance(node, ast.Attribute):
        return node.attr.strip("_").replace("_", " ")
    if isinstance(node, ast.Name):
        return node.id.strip("_").replace("_", " ")
    if isinstance(node, ast.Subscript):
        return spoken(node.value)
    if isinstance(node, ast.BinOp):
        return spoken(node.left)
    return "…"


def constants(tree):
    """Names given one text each at the top of a module."""
    return {
        target.id: words(node.value, {})
        for node in tree.body
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant | ast.JoinedStr)
        for target in node.targets
        if isinstance(target, ast.Name)
    }


def local_texts(function, names):
    """Names a function gives texts to, each with all its texts."""
    found = defaultdict(list)
    for node in ast.walk(function):
        if isinstance(node, ast.Assign) and len(node.targets) == 1:
            target, value = node.targets[0], node.value
            if isinstance(target, ast.Name) and isinstance(
                value, ast.Constant | ast.JoinedStr | ast.IfExp
            ):
                found[target.id] += words(value, names)
    return {**names, **found}


def own_calls(tree):
    """{function: its parameters} of a module's own functions that make a finding."""
    found = {}
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            given = [argument.arg for argument in node.args.args]
            if {"code", "message"} <= set(given):
                found[node.name] = given
    return found


def calls(tree):
    """(severity, {field: node}, names) of each call that makes a finding."""
    top, own = constants(tree), own_calls(tree)
    scopes = [(tree, top)]
    scopes += [
        (node, local_texts(node, top))
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    ]
    seen = set()
    for scope, names in reversed(scopes):
        for node in ast.walk(scope):
            if not isinstance(node, ast.Call) or id(node) in seen:
                continue
            method = isinstance(node.func, ast.Attribute)
            name = node.func.attr if method else getattr(node.func, "id", "")
            order = RECORD if name == "Finding" else own.get(name, ())
            if name in SEVERITIES:
                order = AT_CELL if method else CALLED
            fields = dict(zip(order, node.args, strict=False))
            fields |= {word.arg: word.value for word in node.keywords if word.arg}
            if "code" not in fields or "message" not in fields:
                continue
            seen.add(id(node))
            severity = name if name in SEVERITIES else "error"
            if name == "Finding":
                severity = "/".join(words(fields.get("severity", ast.Constant("error")), names))
            yield severity, fields, names


def findings():
    """{code: {(severity, message, mend)}} over the package; column names left out."""
    found = defaultdict(set)
    for path in sorted((ROOT / "BendTorsionWB").rglob("*.py")):
        for severity, fields, names in calls(ast.parse(path.read_text(encoding="utf-8"))):
            mend = fields.get("mend", ast.Constant(""))
            for code in words(fields["code"], names):
                if code.startswith("*") or not code.islower():
                    continue
                for message in words(fields["message"], names)[:3]:
                    for cure in words(mend, names)[:3]:
                        found[code].add((severity, message, cure))
    for code, rows in found.items():
        found[code] = {row for row in rows if not passed_on(row[1])} or rows
    return {
        code: rows
        for code, rows in found.items()
        if any(mend or not passed_on(message) for _, message, mend in rows)
    }


def passed_on(message):
    """Whether a message is a value only, put together elsewhere."""
    return message.startswith("*") and message.endswith("*") and message.count("*") == 2


def cell(text):
    """A text inside a table."""
    return re.sub(r"\s+", " ", text).replace("|", "\\|").strip()


def table():
    """The page's whole text."""
    lines = [HEAD]
    found = findings()
    for initial, codes in itertools.groupby(sorted(found), key=lambda code: code.split("-")[0]):
        lines += [f"\n## {initial}\n", "| code | | says | mend |", "|---|---|---|---|"]
        for code in codes:
            for severity, message, mend in sorted(found[code]):
                lines.append(f"| `{code}` | {severity} | {cell(message)} | {cell(mend)} |")
    return "\n".join(lines) + "\n"


def main():
    """Write the page; with --check only say whether it is the one that would be written."""
    text = table()
    if "--check" in sys.argv:
        return 0 if TABLE.is_file() and TABLE.read_text(encoding="utf-8") == text else 1
    TABLE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
