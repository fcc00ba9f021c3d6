# SPDX-License-Identifier: LGPL-2.1-or-later
"""The same design in other words is no difference of two documents; another design is, however
little."""

import FreeCAD
import pytest
from test_write_back import AXES, SECTIONS, SPHERE, member

from BendTorsionWB import make, project
from BendTorsionWB.document import build_document
from BendTorsionWB.document_difference import document_changes
from BendTorsionWB.document_forms import without_other_forms
from BendTorsionWB.round_trip import difference, write_back

RULE = {"kind": "geodesic", "start": SPHERE[0], "end": SPHERE[-1]}


@pytest.fixture
def document():
    made = FreeCAD.newDocument("forms", hidden=True)
    yield made
    FreeCAD.closeDocument(made.Name)


def sphere(document, points=(), **given):
    surface = make.make_surface(document, "Hall", "sphere", r=20000)
    return surface, make.make_axis(document, "A1", surface, points, **given)


def told(document, path):
    """The lines of the difference from the document to the schedule, and those back."""
    saved = str(path.with_suffix(".FCStd"))
    document.saveCopy(saved)
    return [c.line() for c in difference(saved, path)], [c.line() for c in difference(path, saved)]


@pytest.mark.parametrize("case", ["geodesic", "turned", "by rule turned", "loose", "points"])
def test_an_axis_in_another_form_is_no_difference(document, tmp_path, case):
    surface, axis = sphere(document, () if case == "geodesic" else SPHERE, **AXES[case])
    member(document, surface, axis)
    document.recompute()
    path = tmp_path / "back.xlsx"
    assert write_back(document, path) == ()
    assert told(document, path) == ([], [])


def test_another_rule_is_told_and_so_are_points_that_moved(document, tmp_path):
    surface, axis = sphere(document, rule=RULE)
    member(document, surface, axis)
    document.recompute()
    path = tmp_path / "back.xlsx"
    write_back(document, path)
    x, y, z = SPHERE[-1]
    axis.RuleEnd = FreeCAD.Vector(x, y + 5.0, z)
    document.recompute()
    forth, back = told(document, path)
    assert any("RuleEnd" in line for line in forth) and any("RuleEnd" in line for line in back)
    assert any(line.startswith("added: File") for line in forth)


def test_points_are_compared_as_they_are(document):
    surface, axis = sphere(document, SPHERE)
    other = FreeCAD.newDocument("other", hidden=True)
    try:
        moved = [*SPHERE[:-1], tuple(value + 1e-7 for value in SPHERE[-1])]
        sphere(other, moved)
        changes = without_other_forms(document_changes(document, other), document, other)
        assert [(c.name, c.property) for c in changes] == [("A1", "Points")]
    finally:
        FreeCAD.closeDocument(other.Name)


@pytest.mark.parametrize("kind", ["box1", "box2", "polygon"])
def test_thicknesses_in_another_form_are_no_difference_and_others_are(document, tmp_path, kind):
    surface, axis = sphere(document, SPHERE)
    section = make.make_section(document, "S1", kind, **SECTIONS[kind])
    made = make.make_member(document, "M1", axis, [section])
    make.make_unfold(document, make.make_plates(document, made))
    document.recompute()
    path = tmp_path / "back.xlsx"
    assert write_back(document, path) == ()
    assert told(document, path) == ([], [])
    if kind == "polygon":
        section.PolygonThicknesses = [12.0, 10.0, 15.0]
    else:
        section.ThicknessTop = 22.0
    for lines in told(document, path):
        assert any("Thickness" in line for line in lines)
        assert all(line.startswith("SectionSpec S1: ") for line in lines)


def test_a_cut_at_a_point_is_the_cut_at_its_place(document, tmp_path):
    surface, axis = sphere(document, SPHERE)
    sections = [make.make_section(document, f"B{h}", h=h, b=400, t=12) for h in (500, 450)]
    made = make.make_member(document, "M1", axis, sections, [{}, {"cut": 4000.0, "slope": 4.0}])
    made.CutBy2, made.CutPoint2 = "point", FreeCAD.Vector(*SPHERE[3])
    make.make_unfold(document, make.make_plates(document, made))
    document.recompute()
    path = tmp_path / "back.xlsx"
    write_back(document, path)
    assert told(document, path) == ([], [])
    made.CutPoint2 = FreeCAD.Vector(*SPHERE[2])
    forth, back = told(document, path)
    assert any("CutPoint2" in line for line in forth) and any("Cut2" in line for line in back)


def test_beds_a_schedule_brings_are_told_where_some_were_made_before(document, tmp_path):
    """A document without any was made without; one of a schedule without one has lost it."""
    surface, axis = sphere(document, SPHERE)
    member(document, surface, axis)
    document.recompute()
    path = tmp_path / "back.xlsx"
    write_back(document, path)
    assert told(document, path) == ([], [])
    built = build_document(*project.read_jobs(path), sheets=False)
    try:
        [bed] = [o for o in built.Objects if getattr(o, "BT_Type", "") == "AssemblyBed"]
        built.removeObject(bed.Name)
        lost = told(built, path)
        assert lost == (
            ["added: AssemblyBed M1 bed (members M1)"],
            ["removed: AssemblyBed M1 bed (members M1)"],
        )
    finally:
        FreeCAD.closeDocument(built.Name)
