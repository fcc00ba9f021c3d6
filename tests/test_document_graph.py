# SPDX-License-Identifier: LGPL-2.1-or-later
"""The document objects: what an edit reaches, undo, saving, errors that empty and heal."""

import json

import FreeCAD
import Part  # noqa: F401
import pytest
from curved_members import HALF_AXES, diagonal, irregular, oblique

from BendTorsionWB import make
from BendTorsionWB.core import detailing, memo
from BendTorsionWB.objects.proxy import findings_of

JOINTS = {"top": [0.3, 0.7, 1.0], "left": [4000.0, 9000.0]}


class Model:
    """Two members that share a surface; M1 uses B800 and B600, M2 uses B500 only."""

    def __init__(self, document):
        self.document = document
        self.surface = make.make_surface(document, "Hall", **dict(zip("abc", HALF_AXES)))
        self.sections = {
            size: make.make_section(document, f"B{size}", h=size, b=size, t=t)
            for size, t in ((800, 20), (600, 16), (500, 12))
        }
        self.chains = {
            "M1": self._chain("M1", diagonal, (800, 600), [{}, {"cut": 9000.0}]),
            "M2": self._chain("M2", oblique, (500,), [{}]),
        }
        document.recompute()

    def _chain(self, name, curve, sizes, segments):
        document = self.document
        axis = make.make_axis(document, f"A-{name}", self.surface, irregular(curve))
        member = make.make_member(document, name, axis, [self.sections[s] for s in sizes], segments)
        plates = make.make_plates(document, member, JOINTS)
        return axis, member, plates, make.make_unfold(document, plates)

    def figures(self, name="M1"):
        axis, member, plates, unfold = self.chains[name]
        return [
            axis.Length.Value,
            member.TotalTorsion.Value,
            plates.Volume.Value,
            plates.Mass,
            unfold.LengthErrorMax,
            unfold.StrainMax,
            *unfold.Areas,
            *(v for solid in plates.Shape.Solids for v in solid.BoundBox.Center),
        ]

    def shapes(self, name):
        """Hashes of the shapes' own memory: they change when an object builds its shape anew."""
        return [obj.Shape.hashCode() for obj in self.chains[name]]

    def statuses(self, name="M1"):
        return [obj.Status for obj in self.chains[name]]


@pytest.fixture
def model():
    document = FreeCAD.newDocument("graph", hidden=True)
    document.UndoMode = 1
    model = Model(document)
    yield model
    FreeCAD.closeDocument(model.document.Name)


def empty(obj):
    shape = obj.Shape
    return not shape.isNull() and shape.ShapeType == "Compound" and not shape.SubShapes


def test_everything_is_built_and_good(model):
    for name in model.chains:
        assert model.statuses(name) == ["ok"] * 4
    _, member, plates, unfold = model.chains["M1"]
    assert len(plates.Shape.Solids) == plates.PlateCount == len(plates.Marks) == len(unfold.Areas)
    assert plates.Shape.isValid() and all(s.isClosed() for s in plates.Shape.Solids)
    volume = sum(solid.Volume for solid in plates.Shape.Solids)
    assert volume == pytest.approx(plates.Volume.Value, rel=5e-5)
    assert unfold.Marks == plates.Marks
    assert len(unfold.Shape.Wires) >= plates.PlateCount
    assert [z.split()[0] for z in member.Zones] == ["d-1", "b-1", "d-2"]


def test_an_edit_of_h_reaches_the_members_that_use_it_and_no_others(model):
    before = {name: (model.figures(name), model.shapes(name)) for name in model.chains}
    model.sections[800].Height = 780
    model.document.recompute()
    assert model.figures("M2") == before["M2"][0]
    assert model.shapes("M2") == before["M2"][1]
    axis, *rest = model.shapes("M1")
    assert axis == before["M1"][1][0]
    assert all(new != old for new, old in zip(rest, before["M1"][1][1:]))
    assert model.figures("M1")[2] < before["M1"][0][2]
    assert model.statuses("M1") == ["ok"] * 4


def test_an_edit_calls_execute_of_what_depends_on_it_only(model, monkeypatch):
    ran = []
    for kind in {type(obj.Proxy) for obj in model.document.Objects}:

        def spy(self, obj, real=kind.build):
            ran.append(obj.Label)
            return real(self, obj)

        monkeypatch.setattr(kind, "build", spy)
    model.sections[500].Thickness = 14
    model.document.recompute()
    assert sorted(ran) == sorted(["B500", "M2", "M2 plates", "M2 patterns"])
    ran.clear()
    model.document.recompute()
    assert ran == []


def test_undo_and_redo_bring_back_numbers_and_shapes(model):
    before = model.figures()
    model.document.openTransaction("edit")
    model.sections[800].Height = 700
    model.document.recompute()
    model.document.commitTransaction()
    edited = model.figures()
    assert edited != before
    model.document.undo()
    model.document.recompute()
    assert model.figures() == before
    model.document.redo()
    model.document.recompute()
    assert model.figures() == edited


def test_saved_closed_opened_and_recomputed_the_numbers_are_the_same(model, tmp_path):
    before = {name: model.figures(name) for name in model.chains}
    path = str(tmp_path / "model.FCStd")
    model.document.saveAs(path)
    name = model.document.Name
    FreeCAD.closeDocument(name)
    memo.forget_all()
    opened = FreeCAD.openDocument(path)
    try:
        for touched in (False, True):
            if touched:
                for obj in opened.Objects:
                    obj.touch()
                opened.recompute()
            for member, figures in before.items():
                chain = [
                    opened.getObjectsByLabel(label)[0]
                    for label in (f"A-{member}", member, f"{member} plates", f"{member} patterns")
                ]
                model.chains[member] = chain
                assert model.figures(member) == pytest.approx(figures, rel=1e-9, abs=1e-9)
                assert all(obj.Proxy.TYPE == obj.BT_Type for obj in chain)
        opened.getObjectsByLabel("B800")[0].Height = 780
        opened.recompute()
        assert model.figures("M1") != pytest.approx(before["M1"], rel=1e-6)
    finally:
        FreeCAD.closeDocument(opened.Name)
        model.document = FreeCAD.newDocument("graph", hidden=True)


@pytest.mark.parametrize("bad", [30.0, 0.0])
def test_an_impossible_h_empties_everything_downstream_and_correcting_it_restores(model, bad):
    before, other = model.figures(), model.shapes("M2")
    model.sections[800].Height = bad
    model.document.recompute()
    axis, member, plates, unfold = model.chains["M1"]
    assert axis.Status == "ok"
    for obj in (model.sections[800], member, plates, unfold):
        assert empty(obj), obj.Label
        assert obj.Status.startswith("error") and obj.isValid()
        assert any(f.severity == "error" and f.object == "B800" for f in findings_of(obj))
    assert (plates.PlateCount, plates.Marks, plates.Mass, unfold.Areas) == (0, [], 0.0, [])
    assert member.Zones == [] and plates.Volume.Value == 0
    assert model.shapes("M2") == other
    model.sections[800].Height = 800
    model.document.recompute()
    assert model.figures() == before
    assert model.statuses() == ["ok"] * 4


@pytest.mark.parametrize("which", ["section", "axis", "surface", "member", "plates"])
def test_a_deleted_target_is_an_error_by_name_and_not_a_stale_shape(model, which):
    axis, member, plates, unfold = model.chains["M1"]
    target = {
        "section": model.sections[600],
        "axis": axis,
        "surface": model.surface,
        "member": member,
        "plates": plates,
    }[which]
    first = {
        "section": member,
        "axis": member,
        "surface": axis,
        "member": plates,
        "plates": unfold,
    }[which]
    model.document.removeObject(target.Name)
    model.document.recompute()
    assert empty(first) and "is not set" in first.Status and first.Label in first.Status
    assert empty(unfold) and unfold.Status != "ok"


def test_a_link_to_the_wrong_kind_is_refused(model):
    member = model.chains["M1"][1]
    member.Section1 = model.surface
    model.document.recompute()
    told = "Section1 links to what is no section (value Hall) -> choose a section"
    assert member.Status == f"error: M1, property Section1: {told}"
    assert empty(member)


@pytest.mark.parametrize(
    ("size", "first", "second"),
    [("Height", 790, 740), ("Breadth", 760, 740), ("Thickness", 22, 19)],
)
def test_an_expression_from_a_spreadsheet_drives_a_section(model, size, first, second):
    sheet = model.document.addObject("Spreadsheet::Sheet", "Sizes")
    sheet.set("A1", f"={first} mm")
    sheet.setAlias("A1", "wanted")
    model.document.recompute()
    section = model.sections[800]
    section.setExpression(size, "Sizes.wanted")
    model.document.recompute()
    by_expression, other = model.figures(), model.shapes("M2")
    assert getattr(section, size).Value == first
    sheet.set("A1", f"={second} mm")
    model.document.recompute()
    assert getattr(section, size).Value == second
    assert model.figures()[2] < by_expression[2]
    assert model.shapes("M2") == other
    section.setExpression(size, None)
    setattr(section, size, first)
    model.document.recompute()
    assert model.figures() == by_expression


@pytest.mark.parametrize("step", ["member_of", "plates_of", "record_of", "axis_of"])
def test_execute_never_raises_and_nothing_stale_remains(model, monkeypatch, step):
    before = model.figures()

    def broken(*_):
        raise RuntimeError("something unheard of")

    with monkeypatch.context() as patch:
        patch.setattr(detailing, step, broken)
        for obj in model.chains["M1"]:
            obj.touch()
        model.document.recompute()
        first = {"axis_of": 0, "member_of": 1, "plates_of": 2, "record_of": 3}[step]
        for obj in model.chains["M1"][first:]:
            assert empty(obj) and obj.isValid()
            [finding] = findings_of(obj)
            assert finding.code == "internal-error"
            assert "something unheard of" in finding.message and "RuntimeError" in finding.message
        assert model.statuses()[:first] == ["ok"] * first
    for obj in model.chains["M1"]:
        obj.touch()
    model.document.recompute()
    assert model.figures() == before


def test_two_documents_do_not_know_of_each_other(model):
    other = FreeCAD.newDocument("other", hidden=True)
    try:
        second = Model(other)
        assert second.figures() == model.figures()
        second.sections[800].Height = 700
        other.recompute()
        assert second.figures() != model.figures()
        before = model.shapes("M1")
        model.document.recompute()
        assert model.shapes("M1") == before
    finally:
        FreeCAD.closeDocument(other.Name)


def test_findings_are_plain_records_on_the_object(model):
    member, plates = model.chains["M1"][1:3]
    member.Stagger2 = "none"
    model.document.recompute()
    records = [json.loads(text) for text in plates.Findings]
    assert {r["code"] for r in records} >= {"thickness-joints-not-staggered"}
    assert all(r["severity"] in ("warning", "note") for r in records)
    assert plates.Status == "ok"


def test_outputs_cannot_be_edited_by_hand_and_inputs_can(model):
    _, member, plates, unfold = model.chains["M1"]
    for obj, name in (
        (member, "Length"),
        (plates, "Mass"),
        (plates, "Marks"),
        (unfold, "Areas"),
        (plates, "Status"),
    ):
        assert "ReadOnly" in obj.getEditorMode(name)
    for obj, name in ((member, "Cut2"), (plates, "JointsTop"), (model.sections[800], "Height")):
        assert "ReadOnly" not in obj.getEditorMode(name)


def test_segments_are_added_and_used(model):
    member, plates = model.chains["M1"][1:3]
    member.Segments = 3
    member.Section3, member.Cut3, member.Slope3 = model.sections[800], 18000.0, 5.0
    model.document.recompute()
    assert member.Status == "ok"
    assert [z.split()[0] for z in member.Zones] == ["d-1", "b-1", "d-2", "b-2", "d-3"]
    assert plates.Status == "ok"


def test_a_bad_joint_is_named_on_the_plates_and_leaves_the_member_alone(model):
    _, member, plates, unfold = model.chains["M1"]
    plates.JointsTop = [0.7, 0.3, 1.0]
    model.document.recompute()
    assert member.Status == "ok" and not empty(member)
    assert "face top" in plates.Status and empty(plates) and empty(unfold)


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_a_number_that_is_none_is_an_error_by_name_and_recovers(model, value):
    _, member, plates, unfold = model.chains["M1"]
    before = model.figures()
    for obj, name in ((member, "OffsetZ"), (member, "Slope2"), (model.sections[800], "Gap1")):
        kept = getattr(obj, name)
        setattr(obj, name, value)
        model.document.recompute()
        assert obj.Status.startswith("error") and name in obj.Status
        assert "internal" not in plates.Status + unfold.Status and empty(plates)
        setattr(obj, name, kept)
        model.document.recompute()
    assert model.figures() == before


def test_measuring_lines_without_end_are_refused(model):
    """A slip of the unit would ask for millions of them."""
    plates = model.document.getObjectsByLabel("M1 plates")[0]
    plates.StationSpacing = 1e-7
    model.document.recompute()
    assert "station-spacing" in plates.Findings[0] and '"limit": 10.0' in plates.Findings[0]
    assert empty(plates)
    plates.StationSpacing = 10
    model.document.recompute()
    assert plates.Status == "ok"
