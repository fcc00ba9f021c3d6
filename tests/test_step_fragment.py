# SPDX-License-Identifier: LGPL-2.1-or-later
"""STEP files put together of members: numbers, names, tree, colours; kept and made anew."""

import os
from concurrent.futures import BrokenExecutor, Future, ThreadPoolExecutor

import FreeCAD
import numpy as np
import openpyxl
import Part
import pytest
from step_reader import Tree, records, references, strings
from test_build import APART, schedule
from test_node_objects import schedule as crossing

from BendTorsionWB import project, step_fragments
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.parallel import Workers
from BendTorsionWB.exchange.result_cache import ResultCache
from BendTorsionWB.exchange.step_fragment import (
    SolidName,
    filled,
    fragment_of_solids,
    step_file,
    template_of,
)
from BendTorsionWB.model_files import Wanted
from BendTorsionWB.shapes.step_text import kernel, settled, solids_as_bytes, step_text
from BendTorsionWB.step_fragments import StepFragments, made_fragment, member_solids

PLAIN = Wanted(sheets=False)
RED, BLUE = (0.75, 0.25, 0.125), (0.0, 0.5, 1.0)
HARD = "梁 #12's 100% \\x"

BY_HAND = b"""#7 = A('it''s #7, ''#8''',#8,'%d',
  (#9,#10));
#8 = B('a line
break; #9 = C(#7)',#7 , $);
/* it's #99; 'no #98' */ #9=( C('') D(#10,'#11','''#12') );
#10 = E(#7,#8
,#9,'100%');
"""


def test_numbers_move_and_what_is_in_strings_stays():
    template, numbers = template_of(BY_HAND)
    assert numbers.tolist() == [7, 8, 9, 10, 8, 7, 9, 10, 10, 7, 8, 9]
    moved = filled(template, numbers, 993, 0)
    before, after = (records(b"DATA;" + text + b"ENDSEC;") for text in (BARE, moved))
    assert list(after) == [1000, 1001, 1002, 1003]
    for (number, old), (new, body) in zip(before.items(), after.items(), strict=True):
        assert new == number + 993
        assert references(body) == [own + 993 for own in references(old)]
        assert strings(body) == strings(old) and "".join(body.split("#")[0]) == old.split("#")[0]
    assert filled(template, numbers, 0, 0) == BARE


BARE = BY_HAND.replace(b"/* it's #99; 'no #98' */", b"")


def test_numbers_that_all_share_stay_and_occurrences_count_on():
    template, numbers = b"#%d = A(#%d,'%d',#%d);", np.array([5, 2, -3, 4])
    assert filled(template, numbers, 100, 20) == b"#105 = A(#2,'23',#4);"


def boxes(count, start=0.0):
    return [
        Part.makeBox(10.0, 10.0, 5.0 + k, FreeCAD.Vector(start, 20.0 * k, 0.0)).Solids[0]
        for k in range(count)
    ]


def given(member, marks, start=0.0, assembly=lambda k: ""):
    names = [SolidName(mark, assembly(k), (RED, BLUE)[k % 2]) for k, mark in enumerate(marks)]
    return member_solids(member, names, boxes(len(marks), start))


def written(fragments):
    return b"".join(step_file("m.step", "program", fragments))


@pytest.mark.parametrize(
    "mark", [HARD, "it's", "''", "a\\b", "%d%%", "#1,#2", "é ü", "T;1", "(NEXT_ASSEMBLY_USAGE"]
)
def test_any_name_comes_back(mark, tmp_path):
    one = made_fragment(given(mark, [f"{mark}-T1", "B"], 0.0))
    two = made_fragment(given("M2", ["M2-T1"], 50.0))
    content = written([one, two])
    tree = Tree(content)
    assert tree.root() == (
        "assemblies",
        [(mark, [(f"{mark}-T1", []), ("B", [])]), ("M2", [("M2-T1", [])])],
    )
    assert tree.colours() == {f"{mark}-T1": RED, "B": BLUE, "M2-T1": RED}
    (tmp_path / "m.step").write_bytes(content)
    solids = Part.read(str(tmp_path / "m.step")).Solids
    assert [s.Volume for s in solids] == pytest.approx([500.0, 600.0, 500.0], rel=1e-9)
    assert [s.BoundBox.XMin for s in solids] == pytest.approx([0.0, 0.0, 50.0], abs=1e-6)


def test_a_member_alone_is_the_root_and_its_pieces_are_assemblies():
    made = made_fragment(given("M1", "abcd", 0.0, lambda k: f"M1-P{k % 2 + 1}"))
    tree = Tree(written([made]))
    of = {name: [(mark, []) for mark in marks] for name, marks in (("P1", "ac"), ("P2", "bd"))}
    assert tree.root() == ("M1", [(f"M1-{name}", own) for name, own in of.items()])


def test_every_number_is_taken_once_and_what_can_be_shared_is():
    fragments = [made_fragment(given(f"M{k}", ["T1", "T2"], 30.0 * k)) for k in (1, 2)]
    tree = Tree(written(fragments))
    assert sorted(tree.records) == list(range(1, len(tree.records) + 1))
    assert tree.uses == [str(k) for k in range(1, 7)]
    # A member has one context of units, and one of curves on surfaces where the kernel writes them.
    contexts = [b for b in tree.records.values() if "GEOMETRIC_REPRESENTATION_CONTEXT" in b]
    units = [b for b in contexts if "GLOBAL_UNIT_ASSIGNED_CONTEXT" in b]
    assert len(units) == 2 and len(contexts) - len(units) == 2 * bool(tree.all("PCURVE"))
    assert len(tree.all("PRODUCT_CONTEXT")) == 1


def test_a_solid_the_kernel_does_not_write_is_an_error_by_name():
    solids = step_text(solids_as_bytes([*boxes(1), Part.makePlane(1.0, 1.0)]))
    names = [SolidName("T1", "", RED), SolidName("T2", "", RED)]
    with pytest.raises(BendTorsionError) as raised:
        fragment_of_solids(solids, "M1", names)
    (finding,) = raised.value.findings
    assert (finding.code, finding.object, finding.value, finding.limit) == (
        "step-solids",
        "M1",
        1,
        2,
    )


def others_tell(told, path):
    """Whether a STEP file FreeCAD writes by itself holds a text, or cannot be written: FreeCAD 1.0
    as Debian has it ends at any solid in AP203."""
    child = os.fork()
    if not child:
        Part.makeBox(1.0, 1.0, 1.0).exportStep(str(path))
        os._exit(2 if told in path.read_bytes() else 3)
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    ends = (told, FreeCAD.Version()[0]) == (b"CONFIG_CONTROL_DESIGN", "1")
    return status == 2 or (ends and status in (1, -6, -11))


@pytest.mark.parametrize(
    "key, value, static, told",
    [
        ("Scheme", "AP203", ("write.step.schema", "AP203", "AP214IS"), b"CONFIG_CONTROL_DESIGN"),
        ("Unit", 2, ("write.step.unit", "INCH", "MM"), b"'INCH'"),
        ("Unit", 1, ("write.step.unit", "M", "MM"), b"SI_UNIT($,.METRE.)"),
    ],
)
def test_a_preference_changes_no_file_and_stays(key, value, static, told, tmp_path):
    """Also one that is set while members of a build before are kept."""
    group = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Part/STEP")
    name, own, usual = static
    kept = ResultCache(tmp_path / "kept")
    plain = written(StepFragments([given("M1", ["T1", "T2"]), given("M2", ["T1"], 9.0)], kept))
    put = group.SetString if isinstance(value, str) else group.SetInt
    drop = group.RemString if isinstance(value, str) else group.RemInt
    try:
        put(key, value)
        Part.setStaticValue(name, own)
        changed = [given("M1", ["T1", "T2"], 1.0), given("M2", ["T1"], 9.0)]
        assert written(StepFragments(changed, kept)) == written(StepFragments(changed))
        back = [given("M1", ["T1", "T2"]), given("M2", ["T1"], 9.0)]
        assert written(StepFragments(back, kept)) == plain
        assert told not in plain and others_tell(told, tmp_path / "other.step")
    finally:
        drop(key)
        Part.setStaticValue(name, usual)


def test_another_way_to_write_curves_is_told_apart():
    """Which FreeCAD's preference says, that may change within a program."""
    group = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Part/General")
    before = kernel()
    try:
        group.SetInt("WriteSurfaceCurveMode", 0)
        assert kernel() != before
    finally:
        group.RemInt("WriteSurfaceCurveMode")
    assert kernel() == before


def test_without_a_cache_nothing_is_hashed(monkeypatch):
    monkeypatch.setattr(step_fragments, "_made_from", lambda own: pytest.fail("hashed"))
    assert written(StepFragments(three()))


@pytest.fixture
def made(monkeypatch):
    """Members whose fragments are made in this process."""
    names = []

    def spy(content, member, own):
        names.append(member)
        return fragment_of_solids(content, member, own)

    monkeypatch.setattr(step_fragments, "fragment_of_solids", spy)
    return names


def three(turned=0):
    return [given(f"M{k}", ["T1", "T2"], 50.0 * k + (k == turned)) for k in (1, 2, 3)]


def test_kept_fragments_give_the_bytes_of_new_ones(made, tmp_path):
    cache = ResultCache(tmp_path)
    first = written(StepFragments(three(), cache))
    assert made == ["M1", "M2", "M3"]
    made.clear()
    assert written(StepFragments(three(), cache)) == first and made == []
    turned = written(StepFragments(three(2), cache))
    assert made == ["M2"] and turned != first
    assert turned == written(StepFragments(three(2)))
    made.clear()
    for path in tmp_path.glob("*.fragment"):
        path.write_bytes(path.read_bytes()[:-1])
    assert written(StepFragments(three(2), cache)) == turned
    assert made == ["M1", "M2", "M3"], "what is damaged is as good as absent"
    made.clear()
    renamed = [given("M1", ["T1", "T3"], 50.0), *three(2)[1:]]
    assert b"'T3'" in written(StepFragments(renamed, cache)) and made == ["M1"]


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_workers_give_the_same_bytes(made, method):
    here = written(StepFragments(three()))
    made.clear()
    workers = Workers(2, method)
    try:
        there = StepFragments(three(), None, workers)
        assert written(there) == here and made == []
        assert there.are_there()
    finally:
        workers.shutdown()


class Lost(Workers):
    """Workers that die at all they are given."""

    def submit(self, function, /, *arguments, **named):
        future = Future()
        future.set_exception(self.failure)
        return future


@pytest.mark.parametrize("failure", [BrokenExecutor(), ImportError("no FreeCAD")])
def test_what_a_lost_worker_does_not_make_is_made_here(made, failure):
    lost = Lost(2)
    lost.failure = failure
    assert written(StepFragments(three(), None, lost)) == written(StepFragments(three()))
    assert made == 2 * ["M1", "M2", "M3"]


def test_other_executors_are_not_asked_for_freecad(made):
    with ThreadPoolExecutor(1) as other:
        written(StepFragments(three(), None, other))
    assert made == ["M1", "M2", "M3"]


def contents(out):
    return (out / "model.step").read_bytes()


def test_a_build_again_makes_the_changed_member_alone(tmp_path, made):
    book, out = schedule(tmp_path / "two.xlsx", APART), tmp_path / "out"
    project.build(book, out, workers=1, wanted=PLAIN)
    assert made == ["M1", "M2"]
    first = Tree(contents(out))
    made.clear()
    sheets = openpyxl.load_workbook(book)
    heads = [cell.value for cell in sheets["Sections"][1]]
    sheets["Sections"].cell(3, heads.index("h") + 1).value = 520
    sheets.save(book)
    project.build(book, out, workers=1, wanted=PLAIN)
    assert made == ["M1"]
    second = Tree(contents(out))
    assert second.root()[0] == "assemblies" and second.root() == first.root()
    project.build(book, tmp_path / "anew", workers=2, wanted=PLAIN)
    assert contents(tmp_path / "anew") == contents(out)
    # The member left out is swept away by no build, its fragment stays for the next.
    made.clear()
    split = Wanted(sheets=False, split=1)
    project.build(book, out, workers=1, wanted=split)
    assert made == []
    for k, (name, parts) in enumerate(second.root()[1], start=1):
        own = (out / "model" / f"{k:03d}.step").read_bytes()
        assert Tree(own).root() == (name, parts)


def test_a_project_with_a_node_is_written_with_all_its_plates(tmp_path):
    row = ["K1", "M1", "M2", None, "stub", 4, 1200, "flanges"]
    path, out = crossing(tmp_path / "s.xlsx", [row]), tmp_path / "out"
    result = project.build(path, out, workers=2, wanted=PLAIN)
    assert not result.failed
    (root, members) = Tree(contents(out)).root()
    assert root == "assemblies" and [name for name, _ in members] == ["M1", "M2"]
    solids = Part.read(str(out / "model.step")).Solids
    plates = {p.mark: p for record in result.records for p in record.plates}
    # The branch comes in pieces: its stubs, and what is between.
    one, two = (dict(parts) for _, parts in members)
    assert list(two) == [f"M2-P{k}" for k in range(1, 5)]
    marks = [*one, *(mark for own in two.values() for mark, _ in own)]
    assert sorted(marks) == sorted(plates) and "M1-D1" in one
    assert len(solids) == len(plates) and all(solid.isValid() for solid in solids)
    document = FreeCAD.openDocument(str(out / "model.FCStd"), hidden=True)
    try:
        sets = [o for o in document.Objects if getattr(o, "BT_Type", "") == "PlateSet"]
        # Newer kernels write no curves on surfaces and weigh by those they make on reading.
        kernel = tmp_path / "kernel.step"
        Part.Compound([solid for o in sets for solid in o.Shape.Solids]).exportStep(str(kernel))
        own = [solid.Volume for solid in Part.read(str(kernel)).Solids]
        assert sorted(s.Volume for s in solids) == pytest.approx(sorted(own), rel=1e-9)
    finally:
        FreeCAD.closeDocument(document.Name)


def test_solids_that_were_saved_and_read_however_often_are_written_alike(built, tmp_path):
    """The kernel changes the last bits of directions each time it reads them."""
    document = FreeCAD.openDocument(str(built[1] / "model.FCStd"), hidden=True)
    try:
        sets = [obj for obj in document.Objects if getattr(obj, "BT_Type", "") == "PlateSet"]
        shapes = {obj.Label: obj.Shape.copy() for obj in sets}
    finally:
        FreeCAD.closeDocument(document.Name)
    contents, written = set(), {}
    for label, shape in shapes.items():
        for _ in range(4):
            names = [SolidName(f"P{k}", "", RED) for k in range(len(shape.Solids))]
            given = member_solids("M1", names, shape.Solids)
            contents.add(given.content)
            same = settled(given.solids, tmp_path / "settled.bin")
            written.setdefault(label, set()).add((same, made_fragment(given)))
            shape.exportBinary(str(tmp_path / "saved.bin"))
            shape = Part.Shape()
            shape.importBinary(str(tmp_path / "saved.bin"))
    assert len(contents) > len(shapes) > 1, "nothing changed by reading"
    assert {label: len(own) for label, own in written.items()} == dict.fromkeys(shapes, 1)
