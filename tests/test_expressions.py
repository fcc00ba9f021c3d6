# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every number of sections and members follows a spreadsheet cell, and the results follow it."""

import FreeCAD
import numpy as np
import pytest
import Spreadsheet  # noqa: F401  (registers Spreadsheet::Sheet)

from BendTorsionWB import make, make_files
from BendTorsionWB.core.sections import section_catalogue
from BendTorsionWB.core.sections.section_properties import section_properties
from BendTorsionWB.objects import section_spec

NUMBERS = (
    "App::PropertyLength",
    "App::PropertyDistance",
    "App::PropertyAngle",
    "App::PropertyPressure",
    "App::PropertyFloat",
    "App::PropertyInteger",
)
CELLS = {
    "Length": ("mm", 7.0),
    "Distance": ("mm", 13.0),
    "Angle": ("deg", 3.0),
    "Pressure": ("MPa", 30.0),
    "Float": ("", 0.25),
    "Integer": ("", 1.0),
}


@pytest.fixture(scope="module")
def model():
    document = FreeCAD.newDocument("expressions", hidden=True)
    surface = make.make_surface(document, "Hall", "sphere", r=20000)
    angle = np.linspace(0.0, 0.5, 4)
    axis = make.make_axis(
        document, "A1", surface,
        20000 * np.column_stack([np.cos(angle), np.sin(angle), 0 * angle]),
    )  # fmt: skip
    big = make.make_section(
        document, "S8", "trapezoid", h=800, b=700, b_bottom=500, t=20, t_top=20, t_bottom=20,
        t_web=20,
    )  # fmt: skip
    small = make.make_section(document, "S6", "trapezoid", h=600, b=500, b_bottom=400, t=20)
    member = make.make_member(
        document, "M1", axis, [big, small], [{}, {"cut": 4000.0, "align": "top"}]
    )
    sheet = document.addObject("Spreadsheet::Sheet", "Inputs")
    document.recompute()
    assert member.Status == "ok", member.Status
    yield document, sheet, {"section": big, "member": member}
    FreeCAD.closeDocument(document.Name)


def numbers(obj):
    """Names of the single numbers among an object's inputs."""
    declared = [item for item in obj.Proxy.declared(obj) if not item.output]
    return [item.name for item in declared if item.type in NUMBERS]


def figures(obj):
    """Everything the object shows as its result."""
    outputs = [item.name for item in obj.Proxy.declared(obj) if item.output]
    values = [str(getattr(obj, name)) for name in outputs]
    return values, [tuple(v.Point) for v in obj.Shape.Vertexes]


NO_EFFECT = {
    "Thickness",
    "YoungsModulus",
    "Rank",
    "JointStagger",
    "FoldClearance",
    "ChamferSlope",
}
"""Of no effect here: every plate has a thickness of its own, the same one all along."""
OTHERWISE = {"Segments", "Cut1", "CutRatio1", "CutOffset1", "Slope1"}
"""Need more: another section, a closed axis."""


def everything():
    document = FreeCAD.newDocument("names", hidden=True)
    section = make.make_section(document, "S")
    axis = make.make_axis(document, "A", make.make_surface(document))
    member = make.make_member(document, "M", axis, [section, section])
    found = [("section", name) for name in numbers(section)]
    found += [("member", name) for name in numbers(member)]
    FreeCAD.closeDocument(document.Name)
    return [item for item in found if item[1] not in OTHERWISE]


@pytest.mark.parametrize("which, name", everything())
def test_a_cell_drives_the_property_and_the_result(model, which, name):
    document, sheet, objects = model
    obj = objects[which]
    kind = obj.getTypeIdOfProperty(name).removeprefix("App::Property")
    unit, change = CELLS[kind]
    assert obj.getDocumentationOfProperty(name) and obj.getGroupOfProperty(name)
    kept = getattr(obj, name)
    number = getattr(kept, "getValueAs", lambda unit: kept)(unit) if unit else kept
    before = figures(obj)
    try:
        for step in (0.0, change):
            value = getattr(number, "Value", number) + step
            sheet.set("A1", f"={value!r} {unit}" if unit else f"={value!r}")
            sheet.setAlias("A1", "given")
            obj.setExpression(name, "Inputs.given")
            document.recompute()
            now = getattr(obj, name)
            now = now.getValueAs(unit).Value if unit else now
            assert now == pytest.approx(value)
            assert obj.Status == "ok", obj.Status
            assert (figures(obj) == before) == (step == 0.0 or name in NO_EFFECT), name
    finally:
        obj.setExpression(name, None)
        setattr(obj, name, kept)
        sheet.clear("A1")
        document.recompute()
    assert figures(obj) == before


def test_the_cut_can_be_a_ratio_with_an_offset_from_a_sheet(model):
    document, sheet, objects = model
    member = objects["member"]
    before = figures(member)
    sheet.set("B1", "=0.25")
    sheet.set("B2", "=100 mm")
    member.setExpression("CutRatio2", "Inputs.B1")
    member.setExpression("CutOffset2", "Inputs.B2")
    document.recompute()
    assert float(member.Zones[0].split()[2]) == pytest.approx(0.25 * member.Length.Value + 100.0)
    for name in ("CutRatio2", "CutOffset2"):
        member.setExpression(name, None)
        setattr(member, name, 0.0)
    document.recompute()
    assert figures(member) == before


def test_one_expression_can_bind_sections_to_each_other(model):
    document, _, objects = model
    section, member = objects["section"], objects["member"]
    section.setExpression("BreadthBottom", f"0.5 * {section.Name}.Breadth")
    document.recompute()
    assert section.BreadthBottom.Value == 350.0 and member.Status == "ok"
    section.setExpression("BreadthBottom", None)
    section.BreadthBottom = 500.0
    document.recompute()


def test_the_section_shows_the_core_s_properties(model):
    section = model[2]["section"]
    found = section_properties(section_spec.value(section))
    assert section.Area.Value == pytest.approx(found.area)
    assert (section.Iy, section.Iz) == pytest.approx((found.iy, found.iz))
    assert section.TorsionConstant == pytest.approx(found.j)
    assert section.CentroidZ.Value == pytest.approx(found.centroid[1])
    assert section.MassPerMetre == pytest.approx(found.mass_per_length * 1e3)
    assert len(section.Slenderness) == 4 and "EU class" in section.Slenderness[0]


def test_every_catalogue_section_can_be_made():
    document = FreeCAD.newDocument("catalogue", hidden=True)
    try:
        made = [make.make_catalogue_section(document, name) for name in make.catalogue_names()]
        document.recompute()
        assert len(made) == len(section_catalogue.entries()) >= 20
        for entry, section in zip(section_catalogue.entries(), made, strict=True):
            assert section.Status == "ok", section.Status
            assert section_spec.value(section).corners == entry.section().corners
    finally:
        FreeCAD.closeDocument(document.Name)


def test_what_follows_another_document_is_in_error_while_that_is_not_there(tmp_path):
    values = FreeCAD.newDocument("Values")
    sheet = values.addObject("Spreadsheet::Sheet", "Sheet")
    sheet.set("A1", "=650 mm")
    sheet.setAlias("A1", "hh")
    values.recompute()
    values.saveAs(str(tmp_path / "Values.FCStd"))
    document = FreeCAD.newDocument("Follows")
    surface = make.make_surface(document, "Hall", "sphere", r=20000)
    points = [(20000 * np.cos(a), 20000 * np.sin(a), 0) for a in (0, 0.1, 0.2, 0.3)]
    axis = make.make_axis(document, "A1", surface, points)
    section = make.make_section(document, "S6", "box1", h=600, b=500, t=20)
    plates = make.make_plates(document, make.make_member(document, "M1", axis, [section]))
    make.make_unfold(document, plates)
    document.recompute()
    document.saveAs(str(tmp_path / "Follows.FCStd"))
    section.setExpression("Height", "Values#Sheet.hh")
    document.recompute()
    document.save()
    assert section.Height.Value == 650.0 and plates.Status == "ok"
    volume = plates.Shape.Volume
    for name in ("Follows", "Values"):
        FreeCAD.closeDocument(name)
    (tmp_path / "Values.FCStd").rename(tmp_path / "aside.FCStd")
    document = FreeCAD.openDocument(str(tmp_path / "Follows.FCStd"))
    try:
        [finding] = make_files.check(document)
        assert (finding.code, finding.object) == ("object-invalid", "S6")
        assert "'Values' not found" in finding.message
        for name in ("SectionSpec", "Member", "PlateSet", "Unfold"):
            obj = document.getObject(name)
            assert obj.Status.startswith("error") and not obj.Shape.SubShapes, name
        written = make_files.write_package(document, tmp_path / "package")
        assert "object-invalid" in [finding.code for finding in written.findings]
        assert not (tmp_path / "package" / "model.step").exists()
        (tmp_path / "aside.FCStd").rename(tmp_path / "Values.FCStd")
        FreeCAD.openDocument(str(tmp_path / "Values.FCStd"))
        assert make_files.check(document) == ()
        assert document.PlateSet.Shape.Volume == pytest.approx(volume)
    finally:
        for name in FreeCAD.listDocuments():
            if name in ("Follows", "Values"):
                FreeCAD.closeDocument(name)
