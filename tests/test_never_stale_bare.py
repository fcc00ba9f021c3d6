# SPDX-License-Identifier: LGPL-2.1-or-later
"""An object that lost what computes it leaves nothing stale behind it, and takes no page along."""

import json
import os
import subprocess
import sys
from pathlib import Path

import FreeCAD
import Part  # noqa: F401
import pytest
from test_never_stale import (  # noqa: F401  (fixtures)
    KINDS,
    PAGES,
    SHEETS,
    check_nothing_stale,
    figures,
    in_error,
    model,
    new_document,
    of_kind,
    ours,
    with_sheets,
)

from BendTorsionWB.objects.proxy import findings_of
from BendTorsionWB.objects.repair import repair

ROOT = Path(__file__).resolve().parent.parent
SCRIPT = """
import json, sys
sys.path.append(sys.argv[2])
import FreeCAD
{first}
document = FreeCAD.openDocument(sys.argv[1])
ours = [one for one in document.Objects if hasattr(one, "BT_Type")]
dead = [one.Label for one in ours if one.Proxy is None]
objects = [one.Name for one in document.Objects]
section = next(one for one in ours if one.BT_Type == "SectionSpec")
section.Height = section.Height.Value + 1
document.recompute()
print("\\n" + json.dumps({{
    "dead": dead,
    "kept": objects == [one.Name for one in document.Objects],
    "status": {{one.BT_Type: one.Status for one in ours}},
    "empty": [not one.Shape.SubShapes for one in ours if one.BT_Type == "PlateSet"],
}}))
"""


def pages(document):
    return [obj.Name for obj in document.Objects if obj.isDerivedFrom("TechDraw::DrawPage")]


@pytest.mark.parametrize("kind", (*KINDS, *SHEETS, *PAGES))
def test_what_nothing_computes_is_in_error_by_name_and_keeps_every_page(model, kind):  # noqa: F811
    before, there = figures(model), pages(model)
    assert len(there) > 2
    dead = of_kind(model, kind)
    dead.Proxy = None
    dead.touch()
    model.recompute()
    assert pages(model) == there
    assert [found.code for found in findings_of(dead)] == ["object-bare"]
    check_nothing_stale(model, f"{kind} that nothing computes")
    if kind not in PAGES:
        behind = [obj for obj in ours(model) if dead in obj.OutListRecursive]
        for obj in behind:
            if obj.BT_Type not in PAGES:
                assert in_error(obj) and dead.Label in obj.Status, obj.Label
        texts = [obj for obj in behind if obj.BT_Type == "PageSymbol"]
        # The arrangement draws what members are, whether their own sheets can be drawn or not.
        texts = [obj for obj in texts if kind != "SheetSet" or obj.Set == dead]
        assert texts and all(obj.Symbol != before[obj.Name] for obj in texts)
    assert repair(model) == [dead]
    model.recompute()
    assert pages(model) == there
    assert figures(model) == before


@pytest.mark.parametrize("first", ["", "import BendTorsionWB.make"])
def test_a_script_that_only_has_the_package_on_its_path(tmp_path, first):
    """FreeCAD may refuse modules that are none of its add-ons' when they are not imported yet."""
    document = new_document(tmp_path, True)
    path = tmp_path / "model.FCStd"
    document.saveAs(str(path))
    FreeCAD.closeDocument(document.Name)
    script = tmp_path / "change.py"
    script.write_text(SCRIPT.format(first=first), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, script, path, Path(FreeCAD.__file__).parent],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        encoding="utf-8",
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout.splitlines()[-1])
    assert told["kept"]
    if first:
        assert not told["dead"]
    failed = {kind: status for kind, status in told["status"].items() if status != "ok"}
    if told["dead"]:
        assert {"Member", "PlateSet", "Unfold", "SheetSet", "ArrangementSet"} <= set(failed)
        assert all(told["dead"][0] in status for status in failed.values())
    else:
        assert not failed
    assert told["empty"] == [bool(told["dead"])]
