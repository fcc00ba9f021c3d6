# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every text that a finding can say, as a template, and which of them have no Chinese yet.

`python3 scripts/findings_texts.py` lists those by file. A text comes from the call that makes the
finding, or reaches it through a parameter, a variable, a constant or a raised ValueError.
"""

from __future__ import annotations

import ast
import json
import re
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "scripts")]
from findings_table import AT_CELL, CALLED, RECORD, SEVERITIES, calls, passed_on, words  # noqa: E402

from BendTorsionWB.core.finding_language import in_chinese  # noqa: E402

TABLE = ROOT / "resources" / "translations" / "findings_zh-CN.json"
SOURCES = ROOT / "BendTorsionWB"
# The window has its own translations.
LEFT_OUT = "gui/"
# A ValueError of these is a fault of the program, not of input.
UNHEARD = ("sheets/", "shapes/brep.py", "core/finding", "core/patterns/forming_record.py")
SAID = ("message", "mend")
CODE = re.compile("[a-z0-9]+(-[a-z0-9]+)+")
WORDS = re.compile("[a-z]{2,}.* .*[a-z]{2,}")
WORD = re.compile(r"(?<![\w-])[a-z]{2,}(?![\w-])")


class Function:
    """A function of the sources; said: its parameters that reach the text of a finding."""

    def __init__(self, node: ast.FunctionDef, module: Module, name: str = ""):
        self.node, self.module = node, module
        self.name = name or node.name
        given = [argument.arg for argument in (*node.args.posonlyargs, *node.args.args)]
        self.parameters = given[1:] if given[:1] in (["self"], ["cls"]) else given
        self.all_parameters = {*given, *(argument.arg for argument in node.args.kwonlyargs)}
        # What makes an error that is a class of its own.
        self.said = set(SAID) if name and "code" in given else set()
        within = list(ast.walk(node))
        self.names = assigned(within)
        self.calls = [one for one in within if isinstance(one, ast.Call | ast.Raise)]
        self.returns = [one.value for one in within if isinstance(one, ast.Return) and one.value]


class Module:
    """A file of the sources: the values of its names, its functions and what it imports."""

    def __init__(self, path: str, tree: ast.Module):
        self.path = path
        within = list(ast.walk(tree))
        self.names = assigned(tree.body)
        self.body = tree.body
        self.functions = [
            Function(node, self) for node in within if isinstance(node, ast.FunctionDef)
        ]
        self.functions += [
            Function(made, self, node.name)
            for node in within
            if isinstance(node, ast.ClassDef)
            for made in node.body
            if isinstance(made, ast.FunctionDef) and made.name == "__init__"
        ]
        self.calls = [node for node in within if isinstance(node, ast.Call | ast.Raise)]
        given = (node for node in within if isinstance(node, ast.ImportFrom))
        self.imports = {one.name for node in given for one in node.names}


class Texts:
    """The texts of all sources: {template: file}."""

    def __init__(self):
        self.found: dict[str, str] = {}
        self.functions: dict[str, list[Function]] = defaultdict(list)
        self.modules = []
        for path in sorted(SOURCES.rglob("*.py")):
            if path.relative_to(SOURCES).as_posix().startswith(LEFT_OUT):
                continue
            tree = ast.parse(path.read_text(encoding="utf-8"))
            module = Module(path.relative_to(ROOT).as_posix(), tree)
            self.modules.append(module)
            for own in module.functions:
                self.functions[own.name].append(own)
        self.done: set[tuple] = set()
        changed = True
        while changed:
            before = sum(len(own.said) for given in self.functions.values() for own in given)
            self.done.clear()
            for module in self.modules:
                self.read(module)
            after = sum(len(own.said) for given in self.functions.values() for own in given)
            changed = after > before

    def read(self, module: Module) -> None:
        """All that a file says."""
        for own in module.functions:
            for node in own.calls:
                self.call(node, own, own.names, module)
        for node in module.calls:
            self.call(node, None, {}, module)

    def call(self, node, own, names, module) -> None:
        """What a call or a raised error says."""
        if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
            place = module.path.removeprefix("BendTorsionWB/")
            if getattr(node.exc.func, "id", "") == "ValueError" and not place.startswith(UNHEARD):
                for given in node.exc.args:
                    self.say(given, own, names, module)
        if not isinstance(node, ast.Call):
            return
        method = isinstance(node.func, ast.Attribute)
        name = node.func.attr if method else getattr(node.func, "id", "")
        if name == "Finding" or name in SEVERITIES:
            order = RECORD if name == "Finding" else AT_CELL if method else CALLED
            said = set(SAID)
            self.arguments(node, order, said, own, names, module)
        for given in behind_code(node):
            self.say(given, own, names, module)
        for function in self.functions.get(name, ()):
            if function.said and (function.module is module or name in module.imports or method):
                self.arguments(node, function.parameters, function.said, own, names, module)

    def arguments(self, node, order, said, own, names, module) -> None:
        fields = dict(zip(order, node.args, strict=False))
        fields |= {word.arg: word.value for word in node.keywords if word.arg}
        for name in said & set(fields):
            self.say(fields[name], own, names, module)

    def say(self, node, own, names, module, inside: bool = False) -> None:
        """The texts of an expression; inside: it is a value of another text."""
        if isinstance(node, ast.Starred):
            node = node.value
        key = (id(node), id(own), inside)
        if key in self.done:
            return
        self.done.add(key)
        added = isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add)
        if added or isinstance(node, ast.Constant | ast.JoinedStr):
            for text in words(node, {}):
                self.keep(text, module)
            for value in values(node):
                self.say(value, own, names, module, True)
        elif isinstance(node, ast.IfExp):
            for value in (node.body, node.orelse):
                self.say(value, own, names, module, inside)
                if inside and isinstance(value, ast.Constant):
                    self.one_word(str(value.value), module)
        elif isinstance(node, ast.BoolOp):
            for value in node.values:
                self.say(value, own, names, module, inside)
        elif isinstance(node, ast.Tuple | ast.List | ast.Dict):
            for value in node.values if isinstance(node, ast.Dict) else node.elts:
                self.say(value, own, names, module, inside)
        elif isinstance(node, ast.DictComp):
            self.say(node.value, own, names, module, inside)
        elif isinstance(node, ast.ListComp | ast.GeneratorExp):
            self.say(node.elt, own, names, module, inside)
        elif isinstance(node, ast.Subscript) and isinstance(node.value, ast.Name):
            self.say(node.value, own, names, module, inside)
        elif isinstance(node, ast.Name):
            if own is not None and node.id in own.all_parameters:
                own.said.add(node.id)
            for value in names.get(node.id) or module.names.get(node.id, ()):
                self.say(value, own, names, module, inside)
        elif isinstance(node, ast.Call):
            self.returned(node, own, names, module, inside)

    def returned(self, node, own, names, module, inside) -> None:
        """What a called function of the same file returns; the texts joined by `join`."""
        name = getattr(node.func, "id", getattr(node.func, "attr", ""))
        for given in node.args if name == "join" else ():
            self.say(given, own, names, module, True)
        # `{…}.get(code)`, `f"…".rstrip()`.
        if name in ("get", "strip", "rstrip", "format"):
            self.say(node.func.value, own, names, module, inside)
        for function in self.functions.get(name, ()):
            # What is imported is no method.
            own_file, outermost = function.module is module, function.node in function.module.body
            if own_file or (name in module.imports and outermost):
                for value in function.returns:
                    self.say(value, function, function.names, function.module, inside)

    def keep(self, text: str, module: Module) -> None:
        """Take note of a text; what has one word only is a name."""
        text = re.sub(r"\s+", " ", text).strip()
        fixed = re.sub(r"\*[^*]+\*", "", text)
        if " " in fixed and set(WORD.findall(fixed)) - {"mm"}:
            self.found.setdefault(text, module.path)

    def one_word(self, text: str, module: Module) -> None:
        """Take note of a word that is chosen inside a text; words of places are known."""
        text = text.strip()
        if re.fullmatch("[a-z]{2,}", text) and in_chinese(text) == text:
            self.found.setdefault(text, module.path)


def behind_code(node: ast.Call) -> list:
    """What stands behind the code of a finding where the call is none that is known, as that of a
    severity that is chosen or of an error of a cell: an object or none, message and mend."""
    given = node.args
    at = next((k for k, one in enumerate(given) if CODE.fullmatch(str(text_of(one)))), None)
    if at is None:
        return []
    first = given[at + 1 : at + 2]
    if not first or WORDS.search(text_of(first[0])) or getattr(first[0], "id", "") == "message":
        return given[at + 1 : at + 3]
    return given[at + 2 : at + 4]


def text_of(node) -> str:
    """A text that is written there; empty for none."""
    if isinstance(node, ast.Constant | ast.JoinedStr):
        return words(node, {})[0]
    return ""


def values(node) -> list:
    """The expressions of a text that are no part of its template."""
    if isinstance(node, ast.JoinedStr):
        return [part.value for part in node.values if isinstance(part, ast.FormattedValue)]
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return [*values(node.left), *values(node.right)]
    if isinstance(node, ast.IfExp):
        return [*values(node.body), *values(node.orelse)]
    return [] if isinstance(node, ast.Constant) else [node]


def assigned(nodes) -> dict[str, list]:
    """{name: expressions} of what names are given by assignments and loops; of several names at
    once each gets what stands at its place."""
    found = defaultdict(list)
    for node in nodes:
        if isinstance(node, ast.Assign):
            for target in node.targets:
                give(found, target, node.value)
        elif isinstance(node, ast.AnnAssign | ast.AugAssign) and node.value is not None:
            give(found, node.target, node.value)
        elif isinstance(node, ast.For | ast.comprehension):
            for value in rows(node.iter):
                give(found, node.target, value)
    return found


def rows(node) -> list:
    """What a loop goes over, where it is written there."""
    if isinstance(node, ast.Tuple | ast.List):
        return node.elts
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
        return [node.func.value]
    return [node]


def give(found, target, value) -> None:
    if isinstance(target, ast.Name):
        found[target.id].append(value)
    elif isinstance(target, ast.Tuple):
        whole = isinstance(value, ast.Tuple) and len(value.elts) == len(target.elts)
        for k, own in enumerate(target.elts):
            give(found, own, value.elts[k] if whole else value)


def texts() -> dict[str, str]:
    """{template: file} of every text."""
    found = Texts().found
    for path in sorted(SOURCES.rglob("*.py")):
        for _, fields, names in calls(ast.parse(path.read_text(encoding="utf-8"))):
            for said in SAID:
                for text in words(fields[said], names) if said in fields else ():
                    text = re.sub(r"\s+", " ", text).strip()
                    if text and not passed_on(text):
                        found.setdefault(text, path.relative_to(ROOT).as_posix())
    return found


def main() -> int:
    """List the texts without Chinese; 1 when there are any."""
    known = json.loads(TABLE.read_text(encoding="utf-8"))
    missing = {text: path for text, path in texts().items() if text not in known}
    for text, path in sorted(missing.items(), key=lambda pair: pair[::-1]):
        print(f"{TABLE.name}: {path}: {text}")
    print(f"{len(missing)} texts of findings without Chinese")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
