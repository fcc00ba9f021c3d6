# SPDX-License-Identifier: LGPL-2.1-or-later
"""No failing edit leaves an old shape behind it, and correcting it brings everything back.

Every input of every object is edited, as its class declares them: a new property is covered, or its
type is unknown here and the test fails.
"""

import FreeCAD
import Part  # noqa: F401
import pytest
import Spreadsheet  # noqa: F401  (registers Spreadsheet::Sheet)
from kill_scenarios import POINTS
from test_build import schedule

from BendTorsionWB import project
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.document import build_document
from BendTorsionWB.document_export import records_of
from BendTorsionWB.objects.proxy import findings_of, type_of
from BendTorsionWB.sheets.pdf import start_qt
from BendTorsionWB.solid_files import write_step

NAN = float("nan")
KINDS = ("Surface", "Axis", "SectionSpec", "Member", "PlateSet", "Unfold", "AssemblyBed")
SHEETS = ("SheetSet", "ArrangementSet")
PAGES = ("PageOutlines", "PageSymbol")
"""Of a sheet: they always show its pages, the page that names its errors as well."""


def new_document(folder, sheets):
    start_qt()
    given, jobs = project.read_jobs(schedule(folder / "s.xlsx", [POINTS]))
    document = build_document(given, jobs, sheets)
    document.UndoMode = 1
    document.recompute()
    assert not project.has_error(f for obj in ours(document) for f in findings_of(obj))
    return document


@pytest.fixture(scope="module")
def document(tmp_path_factory):
    document = new_document(tmp_path_factory.mktemp("stale"), False)
    yield document
    FreeCAD.closeDocument(document.Name)


@pytest.fixture(scope="module")
def with_sheets(tmp_path_factory):
    document = new_document(tmp_path_factory.mktemp("sheets"), True)
    yield document
    FreeCAD.closeDocument(document.Name)


def ours(document):
    return [obj for obj in document.Objects if type_of(obj)]


def of_kind(document, kind):
    return next(obj for obj in ours(document) if obj.BT_Type == kind)


def figures(document):
    """Everything the objects show: outputs, status, shapes, the pictures of pages."""
    found = {}
    for obj in ours(document):
        outputs = [d.name for d in obj.Proxy.declared(obj) if d.output and d.name != "Findings"]
        shape = getattr(obj, "Shape", None)
        found[obj.Name] = (
            obj.Status,
            obj.Label,
            [rounded(getattr(obj, name)) for name in outputs],
            shape and [tuple(round(x, 6) for x in v.Point) for v in shape.Vertexes],
        )
    views = [obj for obj in document.Objects if hasattr(obj, "Symbol")]
    return found | {view.Name: view.Symbol for view in views}


def rounded(value):
    """A value as text with nine digits of its numbers: a file keeps fewer than a memory does."""
    number = getattr(value, "Value", value)
    if isinstance(number, float):
        return f"{number:.9g}"
    if isinstance(number, (list, tuple)):
        return [rounded(item) for item in number]
    return str(number)


def in_error(obj):
    return obj.Status.startswith("error")


def check_nothing_stale(document, edited):
    """What depends on an object in error is in error, is empty, and tells no fault of ours."""
    for obj in ours(document):
        if obj.BT_Type in PAGES:
            continue
        above = [up for up in obj.OutListRecursive if getattr(up, "BT_Type", "") and in_error(up)]
        assert in_error(obj) or not above, f"{edited}: {obj.Label} is ok, {above[0].Label} not"
        if in_error(obj):
            shape = getattr(obj, "Shape", None)
            assert shape is None or not shape.SubShapes, f"{edited}: {obj.Label} keeps its shape"
            told = [finding.code for finding in findings_of(obj)]
            assert "internal-error" not in told, f"{edited}: {obj.Status}"


def bad_values(obj, declared):
    """Values to try for an input, those most likely to be refused first."""
    value, kind = getattr(obj, declared.name), declared.type.removeprefix("App::Property")
    if kind == "Enumeration":
        return [one for one in obj.getEnumerationsOfProperty(declared.name) if one != value][:2]
    others = [one for one in ours(obj.Document) if obj not in one.OutListRecursive and one != obj]
    return {
        "Length": [NAN],
        "Distance": [NAN],
        "Angle": [NAN],
        "Pressure": [NAN],
        "Float": [NAN],
        "Integer": [-3, 5000, 2],
        "Bool": [value is False],
        "String": ["nonsense", "?"],
        "Vector": [FreeCAD.Vector(NAN, 0, 0), FreeCAD.Vector(1, 2, 3)],
        "FloatList": [[NAN], [0.5], [-1.0]],
        "StringList": [["nonsense"], ["0.5"]],
        "VectorList": [[FreeCAD.Vector(NAN, 0, 0)] * 3, []],
        "Link": [None, others[0]],
        "LinkSub": [(others[0], ["Face7"])],
        "LinkList": [others[:1], []],
        "LinkSubList": [[(others[0], ("Edge7",))]],
    }[kind]


def edited_and_back(document, kind):
    """Edit every input of the first object of a kind; names of those of which none was refused."""
    before = figures(document)
    obj = of_kind(document, kind)
    never_refused = set()
    for declared in list(obj.Proxy.declared(obj)):
        if declared.output:
            continue
        name, kept, refused = declared.name, getattr(obj, declared.name), False
        for value in bad_values(obj, declared):
            setattr(obj, name, value)
            document.recompute()
            check_nothing_stale(document, f"{kind}.{name} = {value}")
            refused = any(map(in_error, ours(document)))
            if refused:
                break
        if not refused:
            never_refused.add(name)
            edited = figures(document)
            for each in (obj, *obj.InListRecursive):
                each.touch()
            document.recompute()
            assert figures(document) == edited, f"{kind}.{name} left something as it was"
        setattr(obj, name, kept)
        document.recompute()
        after = figures(document)
        differ = [key for key in before if before[key] != after.get(key)]
        assert not differ, f"{kind}.{name} set back: {differ[0]} is not as before"
    return never_refused


@pytest.mark.parametrize("kind", KINDS)
def test_every_input_that_fails_empties_what_depends_on_it_and_heals(document, kind):
    obj = of_kind(document, kind)
    singles = ("Length", "Distance", "Angle", "Pressure", "Float", "Link")
    never = edited_and_back(document, kind)
    numbers = {
        d.name
        for d in obj.Proxy.declared(obj)
        if not d.output and d.type.removeprefix("App::Property") in singles
    }
    # A number that is none is refused whether it is used now or not.
    assert not {name for name in never & numbers if not name.startswith("CutAxis")}


def test_every_kind_of_object_is_in_the_table(with_sheets):
    assert {obj.BT_Type for obj in ours(with_sheets)} == {*KINDS, *SHEETS, *PAGES}


@pytest.mark.parametrize("kind", SHEETS)
def test_every_input_of_sheets_fails_and_heals(with_sheets, kind):
    edited_and_back(with_sheets, kind)


FAILING = {
    "Surface": ("a", -1.0),
    "Axis": ("Points", []),
    "SectionSpec": ("Height", 1.0),
    "Member": ("Segments", 0),
    "PlateSet": ("JointsTop", [0.7, 0.3]),
    "Unfold": ("Plates", None),
}


@pytest.fixture
def model(with_sheets):
    """The document with its figures, which a test must leave as they were."""
    before = figures(with_sheets)
    yield with_sheets
    for obj in ours(with_sheets):
        obj.touch()
    with_sheets.recompute()
    after = figures(with_sheets)
    assert [key for key in before if before[key] != after.get(key)] == []


@pytest.mark.parametrize("kind", ["Surface", "SectionSpec", "PlateSet"])
def test_undo_and_redo_of_a_failing_edit(model, kind):
    obj, (name, value) = of_kind(model, kind), FAILING[kind]
    before = figures(model)
    model.openTransaction("edit")
    setattr(obj, name, value)
    model.recompute()
    model.commitTransaction()
    failed = figures(model)
    assert in_error(of_kind(model, "SheetSet"))
    model.undo()
    model.recompute()
    assert figures(model) == before
    model.redo()
    model.recompute()
    assert figures(model) == failed
    check_nothing_stale(model, kind)
    model.undo()


def test_a_spreadsheet_that_fails_and_is_mended(model, tmp_path):
    sheet = model.addObject("Spreadsheet::Sheet", "Sizes")
    sheet.set("B5", "=600 mm")
    model.recompute()
    section = of_kind(model, "SectionSpec")
    section.setExpression("Height", "Sizes.B5")
    model.recompute()
    before = figures(model)
    for content in ("=1 mm", "=3 kg", "=0 / 0", "", "words", "=Sizes.B5"):
        sheet.set("B5", content)
        model.recompute()
        below = [obj for obj in ours(model) if section in obj.OutListRecursive]
        assert len(below) > 5 and in_error(section)
        assert all(map(in_error, below_members(below))), content
        check_nothing_stale(model, content)
        with pytest.raises(BendTorsionError):
            export(model, tmp_path)
        sheet.set("B5", "=600 mm")
        model.recompute()
        assert figures(model) == before, content
    section.setExpression("Height", None)
    section.Height = 600
    model.removeObject(sheet.Name)


def below_members(objects):
    return [obj for obj in objects if obj.BT_Type in (*KINDS, "SheetSet")]


def export(document, folder):
    """An export of the document, in the way of the command line."""
    given = records_of(document)
    failed = [f for f in given.findings if f.severity == "error"]
    if failed or not all(record.plates for record in given.records.values()):
        raise BendTorsionError(failed or [])
    write_step(document, list(given.records), folder / "x.step")


@pytest.mark.parametrize("kind", FAILING)
def test_nothing_in_error_is_exported(model, tmp_path, kind):
    obj, (name, value) = of_kind(model, kind), FAILING[kind]
    kept = getattr(obj, name)
    setattr(obj, name, value)
    with pytest.raises(BendTorsionError):
        export(model, tmp_path)
    assert not (tmp_path / "x.step").exists()
    setattr(obj, name, kept)


def test_a_copy_in_another_document_follows_its_own_values(model):
    other = FreeCAD.newDocument("other", hidden=True)
    try:
        wanted = [obj for obj in ours(model) if obj.BT_Type in KINDS]
        copied = other.copyObject(wanted, False)
        other.recompute()
        chain = {obj.BT_Type: obj for obj in copied}
        assert not any(map(in_error, copied))
        here = of_kind(model, "PlateSet").Volume.Value
        assert chain["PlateSet"].Volume.Value == pytest.approx(here, rel=1e-12)
        chain["SectionSpec"].Height = 1.0
        other.recompute()
        check_nothing_stale(other, "copy")
        assert in_error(chain["Unfold"]) and not in_error(of_kind(model, "Unfold"))
    finally:
        FreeCAD.closeDocument(other.Name)


def test_a_new_label_is_told_everywhere_and_taken_back(model):
    member, plates = of_kind(model, "Member"), of_kind(model, "PlateSet")
    before = figures(model)
    model.openTransaction("rename")
    member.Label = "N 7"
    model.commitTransaction()
    model.recompute()
    assert plates.Label == "N 7 plates" and plates.Marks[0].startswith("N 7-")
    assert of_kind(model, "Unfold").Label == "N 7 patterns"
    assert of_kind(model, "Unfold").Marks == plates.Marks
    symbols = "".join(obj.Symbol for obj in model.Objects if hasattr(obj, "Symbol"))
    assert "N 7-" in symbols and "M1-" not in symbols
    model.undo()
    model.recompute()
    assert figures(model) == before


def test_saved_under_another_name_in_error_it_is_opened_in_error_and_heals(tmp_path):
    document = new_document(tmp_path, False)
    try:
        before = figures(document)
        of_kind(document, "SectionSpec").Height = 1.0
        document.recompute()
        document.saveAs(str(tmp_path / "one.FCStd"))
        document.saveAs(str(tmp_path / "two.FCStd"))
    finally:
        FreeCAD.closeDocument(document.Name)
    document = FreeCAD.openDocument(str(tmp_path / "two.FCStd"), hidden=True)
    try:
        check_nothing_stale(document, "opened")
        assert in_error(of_kind(document, "Unfold"))
        of_kind(document, "SectionSpec").Height = 600
        document.recompute()
        assert figures(document) == before
    finally:
        FreeCAD.closeDocument(document.Name)


def test_in_parts_and_groups_and_through_links(model):
    """A container moves what is in it; a link shows what there is, and nothing of an error."""
    before = figures(model)
    part, group = model.addObject("App::Part", "P"), model.addObject("App::DocumentObjectGroup")
    plates, member = of_kind(model, "PlateSet"), of_kind(model, "Member")
    part.addObject(plates)
    group.addObject(member)
    link = model.addObject("App::Link", "L")
    link.LinkedObject = plates
    part.Placement.Base = FreeCAD.Vector(0, 0, 1000)
    model.recompute()
    assert figures(model) == before
    assert len(link.Shape.Solids) == plates.PlateCount
    section = of_kind(model, "SectionSpec")
    section.Height = 1.0
    model.recompute()
    check_nothing_stale(model, "in containers")
    assert not link.Shape.SubShapes
    section.Height = 600
    model.recompute()
    assert figures(model) == before and len(link.Shape.Solids) == plates.PlateCount
    for obj in (link, group):
        model.removeObject(obj.Name)
    part.removeObject(plates)
    model.removeObject(part.Name)


def test_a_deleted_object_is_missed_by_name_and_undo_brings_it_back(model):
    before = figures(model)
    model.openTransaction("delete")
    model.removeObject(of_kind(model, "Axis").Name)
    model.commitTransaction()
    model.recompute()
    check_nothing_stale(model, "axis deleted")
    assert "Axis is not set" in of_kind(model, "Member").Status
    assert in_error(of_kind(model, "Unfold"))
    model.undo()
    model.recompute()
    assert figures(model) == before
