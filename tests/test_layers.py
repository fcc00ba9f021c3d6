# SPDX-License-Identifier: LGPL-2.1-or-later
"""The house stands in layers: imports point downwards, and every module imports on its own."""

import ast
import functools
import json
import os
import resource
import subprocess
import sys
from collections import deque
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = "BendTorsionWB"

# What each layer may import directly; what those may import is theirs to use as well.
BELOW = {
    "core": (),
    "shapes": ("core",),
    "exchange": ("core", "interrupts"),
    "sheets": ("core",),
    "objects": ("shapes", "sheets", "interrupts"),
    "make_plates": ("objects",),
    "make": ("make_plates",),
    "source_files": ("shapes", "exchange"),
    "document_settings": ("objects", "exchange"),
    "document_errors": ("document_objects",),
    "document_objects": ("objects", "exchange"),
    "document_pairs": ("document_objects",),
    "document_cycles": ("core",),
    "document_forms": ("document_objects",),
    "document": ("make", "source_files", "document_settings"),
    "document_difference": ("document_pairs",),
    "document_update": ("document", "document_difference", "interrupts"),
    "whole_model": ("document_update",),
    "document_rows": ("make", "exchange", "document_settings"),
    "interrupts": (),
    "standard_output": (),
    "step_fragments": ("interrupts", "shapes", "exchange"),
    "ifc_fragments": ("interrupts", "shapes", "exchange"),
    "model_progress": (),
    "solid_files": ("step_fragments", "ifc_fragments", "model_progress"),
    "model_files": ("document_update", "document_errors", "document_cycles", "solid_files"),
    "member_files": ("exchange", "sheets"),
    "member_fragments": ("member_files",),
    "combined_files": ("exchange",),
    "package_files": ("member_fragments", "combined_files"),
    "report_files": ("member_fragments",),
    "sheet_files": ("member_files",),
    "members_left_out": ("source_files",),
    "project": (
        "members_left_out",
        "document",
        "model_files",
        "package_files",
        "report_files",
        "sheet_files",
        "make",
        "exchange",
        "sheets",
    ),
    "round_trip": ("project", "document_rows", "document_forms", "whole_model"),
    "document_export": ("project", "document_nodes", "document_left_out"),
    "document_left_out": ("objects",),
    "document_nodes": ("objects",),
    "document_repair": ("model_files",),
    "document_templates": ("make", "exchange"),
    "make_files": ("round_trip", "document_export", "document_templates", "support"),
    "arguments": (),
    "console": ("core", "interrupts"),
    "gui": ("make_files",),
    "support": ("round_trip", "document_export"),
    "__main__": (
        "arguments",
        *("support", "round_trip", "document_export", "document_repair", "document_templates"),
        *("console", "interrupts", "standard_output"),
    ),
}
EVERYWHERE = ("", "freecad_path")  # the package itself holds the version only
# The rooms of core, each using those before it only.
ROOMS = (
    *("geometry", "flattening", "axes", "sections", "members", "joints", "plates", "solids"),
    *("welds", "patterns", "nodes", "beds", "drawings"),
)
FREECAD = {"FreeCAD", "Part", "Mesh", "MeshPart", "TechDraw", "Spreadsheet", "Import", "Draft"}
WINDOW = {"FreeCADGui", "TechDrawGui", "ImportGui", "PySide", "PySide2", "PySide6", "pivy"}
CORE_LIBRARIES = {"numpy", "scipy"}


def allowed(layer):
    """Every layer that `layer` may import, itself included."""
    layers = {layer}
    for lower in BELOW[layer]:
        layers |= allowed(lower)
    return layers


def module_name(path):
    """Dotted name of the module in `path`."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def layer_of(module):
    """The layer a dotted name inside the package belongs to."""
    return [*module.split("."), ""][1]


def holds(node):
    """Whether a node is a statement, or a part of one with statements in it."""
    return isinstance(node, ast.stmt | ast.excepthandler | ast.match_case)


def imports(tree, module, is_package):
    """(imported dotted name, line, lazy) of each import statement, relative ones resolved.

    lazy: inside a function, so not run when the module is imported.
    """
    waiting = deque([(tree, False)])
    while waiting:
        node, lazy = waiting.popleft()
        inner = lazy or isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        waiting += [(child, inner) for child in ast.iter_child_nodes(node) if holds(child)]
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield alias.name, node.lineno, lazy
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                parents = module.split(".")
                keep = len(parents) - node.level + (1 if is_package else 0)
                base = ".".join([*parents[:keep], *([base] if base else [])])
            for alias in node.names:
                yield f"{base}.{alias.name}", node.lineno, lazy


def faults(layer, name, lazy):
    """Why `layer` may not import `name`; empty when it may."""
    top = name.split(".")[0]
    if top == PACKAGE:
        target = layer_of(name)
        if target not in BELOW:
            known = target in EVERYWHERE or target == "__version__"
            return "" if known else f"{target} belongs to no layer"
        attaches_view = target == "gui" and lazy and layer in ("objects", "make", "project")
        if target in allowed(layer) or attaches_view:
            return ""
        return f"{layer} is not above {target}"
    if layer == "core" and top not in CORE_LIBRARIES | set(sys.stdlib_module_names):
        return "core uses numpy, scipy and the standard library only"
    if layer in ("core", "exchange") and top in FREECAD | WINDOW:
        return f"{layer} works without FreeCAD"
    if top in WINDOW and layer != "gui" and not lazy:
        return "the window is reached from below only inside functions"
    return ""


MODULES = sorted((ROOT / PACKAGE).rglob("*.py"))
OWN = {module_name(path) for path in MODULES}


@functools.cache
def parsed(path):
    """The syntax tree of a file; nobody changes it."""
    return ast.parse(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("path", MODULES, ids=module_name)
def test_imports_point_downwards(path):
    """No module imports a layer above its own, and core and exchange know no FreeCAD."""
    module = module_name(path)
    layer = layer_of(module)
    if layer in EVERYWHERE:
        layer = "core"
    assert layer in BELOW, f"{module} belongs to no layer"
    tree = parsed(path)
    found = [
        f"{path.name}:{line}: {name}: {fault}"
        for name, line, lazy in imports(tree, module, path.name == "__init__.py")
        if (fault := faults(layer, name, lazy))
    ]
    assert not found, "\n".join(found)


def run_imports(tree):
    """The tree without what is imported for type checkers only."""
    body = [
        node
        for node in tree.body
        if not (isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING")
    ]
    return ast.Module(body, [])


@pytest.mark.parametrize("path", sorted((ROOT / PACKAGE / "core").glob("*/*.py")), ids=module_name)
def test_rooms_of_core_stand_in_order(path):
    """A room of core uses those before it, never one after it."""
    module = module_name(path)
    after = ROOMS[ROOMS.index(path.parent.name) + 1 :]
    tree = run_imports(parsed(path))
    found = [
        f"{path.name}:{line}: {name}"
        for name, line, _ in imports(tree, module, path.name == "__init__.py")
        if name.split(".")[:2] == [PACKAGE, "core"] and name.split(".")[2] in after
    ]
    assert not found, "\n".join(found)


OUTSIDE = sorted(
    path
    for folder in ("benchmarks", "docs", "resources", "scripts")
    for path in (ROOT / folder).rglob("*.py")
)


@pytest.mark.parametrize("path", OUTSIDE, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_scripts_import_what_is_there(path):
    """Scripts nobody runs every day keep up with modules that move."""
    tree = parsed(path)
    named = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module]
    gone = [
        f"{node.module}.{alias.name}"
        for node in named
        if node.module.split(".")[0] == PACKAGE
        for alias in node.names
        if node.module not in OWN
        or (
            (ROOT / Path(*node.module.split("."))).is_dir()
            and f"{node.module}.{alias.name}" not in OWN
            and alias.name != "__version__"
        )
    ]
    assert not gone


def test_the_rules_catch_what_they_forbid():
    """Each forbidden direction is seen as one, and each allowed one is not."""
    assert faults("core", "BendTorsionWB.shapes.brep", False)
    assert faults("core", "FreeCAD", True)
    assert faults("core", "ezdxf", False)
    assert faults("exchange", "Part", False)
    assert faults("exchange", "BendTorsionWB.sheets.pdf", False)
    assert faults("objects", "BendTorsionWB.make", False)
    assert faults("objects", "BendTorsionWB.gui.view_member", False)
    assert faults("sheets", "PySide2", False)
    assert faults("sheets", "BendTorsionWB.objects.sheet", True)
    assert faults("exchange", "BendTorsionWB.make", False)
    assert not faults("objects", "BendTorsionWB.gui.view_member", True)
    assert not faults("sheets", "PySide2", True)
    assert not faults("project", "BendTorsionWB.core.finding", False)
    assert not faults("make", "BendTorsionWB.sheets.pdf", False)
    relative = ast.parse("from ...shapes import brep\ndef late():\n    import Part\n")
    assert list(imports(relative, "BendTorsionWB.core.axes.axis", False)) == [
        ("BendTorsionWB.shapes.brep", 1, False),
        ("Part", 3, True),
    ]


def always_loaded(path):
    """Own modules that a module loads before anything else of it runs; none where an import stands
    below other code."""
    module, is_package = module_name(path), path.name == "__init__.py"
    body = run_imports(parsed(path)).body
    end = int(bool(body) and isinstance(body[0], ast.Expr))
    while end < len(body) and isinstance(body[end], ast.Import | ast.ImportFrom):
        end += 1
    below = ast.Module(body[end:], [])
    if any(not lazy for _, _, lazy in imports(below, module, is_package)):
        return set()
    named = {name for name, _, _ in imports(ast.Module(body[:end], []), module, is_package)}
    return OWN & (named | {name.rpartition(".")[0] for name in named})


def reached(direct):
    """What each module loads, with what that loads: {name: names} of the same."""
    found = {}

    def walk(name, seen):
        for other in direct[name] - seen:
            seen.add(other)
            walk(other, seen)
        return seen

    for name in direct:
        found[name] = walk(name, set())
    return found


def tree_of_imports(direct):
    """Each module below one that it loads itself, as {name: branches}.

    Where a module comes right after one that it loads anyway, and that does not load it, there is
    nothing it would not have by itself. Of those it stands below the one that loads most.
    """
    found = reached(direct)
    branches = {name: {} for name in direct}
    tree = {}
    for name in direct:
        before = [other for other in found[name] if name not in found[other]]
        parent = max(before, key=lambda other: (len(found[other]), other), default=None)
        (tree if parent is None else branches[parent])[name] = branches[name]
    return tree


def only(wanted, tree):
    """The branches that lead to wanted modules."""
    cut = {name: only(wanted, branches) for name, branches in tree.items()}
    return {name: branches for name, branches in cut.items() if branches or name in wanted}


def test_a_module_stands_below_what_it_loads_itself_and_in_no_circle():
    direct = {"a": set(), "b": {"a"}, "c": {"b", "e"}, "d": {"e"}, "e": {"d"}}
    assert tree_of_imports(direct) == {"a": {"b": {}}, "d": {}, "e": {"c": {}}}
    assert only({"c", "d"}, tree_of_imports(direct)) == {"d": {}, "e": {"c": {}}}
    project, qt = (always_loaded(ROOT / PACKAGE / name) for name in ("project.py", "gui/qt.py"))
    assert f"{PACKAGE}.core.detailing" in project and qt == set()


# A process per module, forked from one that has imported nothing of the package but what the module
# imports anyway, and the libraries that take long to load; for modules of the window, which FreeCAD
# has loaded itself when they are, those of the window too.
EACH_ALONE = """
import importlib, json, os, sys, traceback
import numpy, ezdxf, openpyxl
import scipy.integrate, scipy.interpolate, scipy.linalg, scipy.optimize, scipy.sparse.linalg
import scipy.spatial
from BendTorsionWB import freecad_path
freecad_path.append()

def grow(tree, there):
    for name, branches in tree.items():
        child = os.fork()
        if child == 0:
            try:
                if name in sys.modules and name not in there:
                    raise ImportError(f"{name} was loaded before its turn")
                importlib.import_module(name)
                os.write(1, f"{name}\\n".encode())
                grow(branches, there)
            except BaseException:
                traceback.print_exc()
                sys.stderr.flush()
            finally:
                os._exit(0)
        os.waitpid(child, 0)

below, window = json.load(sys.stdin)
grow(below, set(sys.modules))
import FreeCAD, FreeCADGui, pivy.coin
from BendTorsionWB.gui import qt
grow(window, set(sys.modules))
"""


def test_each_module_imports_in_a_fresh_interpreter():
    """No module needs another to have been imported before it."""
    direct = {
        name: always_loaded(path)
        for path in MODULES
        if (name := module_name(path)) != f"{PACKAGE}.__main__"
    }
    tree = tree_of_imports(direct)
    window = {name for name in direct if layer_of(name) == "gui"}
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen", "PYTHONPATH": str(ROOT)}
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    run = subprocess.run(
        [sys.executable, "-c", EACH_ALONE],
        input=json.dumps([only(set(direct) - window, tree), only(window, tree)]),
        env=environment,
        capture_output=True,
        encoding="utf-8",
        timeout=300,
        check=False,
    )
    failed = sorted(set(direct) - set(run.stdout.splitlines()))
    assert not failed, f"{', '.join(failed)}\n{run.stderr}"
    # By the processor's clock: that of a busy machine tells nothing.
    assert resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before < 120.0
