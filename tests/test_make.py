# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scripting API judges its arguments: what is no use is told, and nothing is made."""

import inspect
import math
from dataclasses import fields

import FreeCAD
import pytest

from BendTorsionWB import make, make_plates
from BendTorsionWB.core.beds.bed_face import BedInput
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.patterns.gross import Allowances
from BendTorsionWB.objects import given


@pytest.fixture(scope="module")
def scene():
    """A document with one object of each kind, and a plain box."""
    document = FreeCAD.newDocument("scene", hidden=True)
    box = document.addObject("Part::Box", "Box")
    ground = make.make_surface(document, "Ground", "plane")
    axis = make.make_axis(document, "A1", ground, [(0, 0, 0), (4000, 0, 0)])
    section = make.make_section(document, "S", h=400, b=300, t=12)
    member = make.make_member(document, "M1", axis, [section])
    other = make.make_member(document, "M2", axis, [section])
    plates = make.make_plates(document, member)
    unfold = make.make_unfold(document, plates)
    document.recompute()
    foreign = FreeCAD.newDocument("foreign", hidden=True)
    yield {
        **{"document": document, "box": box, "surface": ground, "axis": axis, "section": section},
        **{"member": member, "other": other, "plates": plates, "unfold": unfold},
        "stranger": make.make_section(foreign, "X"),
    }
    for one in (document, foreign):
        FreeCAD.closeDocument(one.Name)


def points():
    return [(0, 0, 0), (4000, 0, 0)]


REFUSED = [
    # Names of arguments and of sizes.
    ("make_surface", lambda s: ((), {"kind": "sphere", "radius": 5}), "'radius' is unknown"),
    ("make_surface", lambda s: ((), {"kind": "spere"}), "write sphere"),
    ("make_surface", lambda s: ((), {"kind": "sphere", "r": -5}), "r is negative"),
    ("make_surface", lambda s: ((), {"kind": "sphere", "r": "5 kg"}), "r has another unit"),
    ("make_surface", lambda s: ((), {"kind": "sphere", "r": "5 furlong"}), "r cannot be read"),
    ("make_surface", lambda s: ((), {"origin": (1, 2)}), "origin is not (x, y, z)"),
    ("make_surface", lambda s: ((), {"face": s["box"]}), "face is not (object, 'Face1')"),
    ("make_surface", lambda s: ((), {"face": (s["box"], "Face9")}), "Face9, which Box has not"),
    ("make_surface", lambda s: ((), {"face": (s["stranger"], "")}), "is of another document"),
    ("make_surface", lambda s: ((), {"flip": "yes"}), "flip is neither True nor False"),
    ("make_axis", lambda s: (("A", s["surface"]), {"pionts": []}), "'pionts'"),
    ("make_axis", lambda s: (("A",), {}), "missing a required argument"),
    ("make_axis", lambda s: (("A", s["axis"], points()), {}), "surface is no Surface"),
    ("make_axis", lambda s: (("A", None, [(0, 0), (1, 1)]), {}), "points is not (x, y, z)"),
    ("make_axis", lambda s: (("A", None, [(0, 0, 0), (1, 1, "up")]), {}), "not a number of use"),
    ("make_axis", lambda s: (("A", None, points()), {"fit": "push"}), "use one of pull"),
    ("make_axis", lambda s: (("A", None, points()), {"roll": "5 mm"}), "roll has another unit"),
    ("make_axis", lambda s: (("A", None, points()), {"twist": [1, 2]}), "twist is not a mapping"),
    ("make_axis", lambda s: (("A", None), {"rule": {"kind": "circle"}}), "none of the choices"),
    ("make_axis", lambda s: (("A", None), {"rule": {"kind": "geodesic", "to": 1}}), "'to' is unk"),
    ("make_axis", lambda s: (("A", None), {"edge": (s["box"], "Edge13")}), "one of its 12 Edges"),
    ("make_axis", lambda s: ((" ", None, points()), {}), "the name is no text"),
    ("make_section", lambda s: ((), {"height": 5}), "'height' is unknown"),
    ("make_section", lambda s: ((), {"h": math.nan}), "h is not a number of use"),
    ("make_section", lambda s: ((), {"h": None}), "h is not a number of use"),
    ("make_section", lambda s: ((), {"fy": 355}), "fy has no unit"),
    ("make_section", lambda s: (("S", "boxx"), {}), "or another of box1"),
    ("make_section", lambda s: (("S", "polygon"), {"corners": [(1, 2, 3)]}), "is not (y, z)"),
    ("make_section", lambda s: (("S", "strips"), {"strips": "top"}), "strips is not a list"),
    ("make_catalogue_section", lambda s: (("HEB 301",), {}), "the catalogue has no such section"),
    ("make_member", lambda s: (("M", s["axis"], []), {}), "sections is empty"),
    ("make_member", lambda s: (("M", None, [s["section"]]), {}), "axis is missing"),
    ("make_member", lambda s: (("M", s["section"], [s["section"]]), {}), "axis is no Axis"),
    ("make_member", lambda s: (("M", s["axis"], [s["stranger"]]), {}), "is of another document"),
    (
        "make_member",
        lambda s: (("M", s["axis"], [s["section"]], [{"aling": 1}]), {}),
        "write align",
    ),
    (
        "make_member",
        lambda s: (("M", s["axis"], [s["section"]], [{}, {}]), {}),
        "more than sections",
    ),
    (
        "make_member",
        lambda s: (("M", s["axis"], [s["section"]]), {"start_cut": "round"}),
        "choices",
    ),
    ("make_member", lambda s: (("M", s["axis"], [s["section"]]), {"end_cut": 5}), "is no cut"),
    ("make_member", lambda s: (("M", s["axis"], [s["section"]]), {"rank": 1.5}), "whole number"),
    ("make_member", lambda s: (("M", s["axis"], [s["section"]]), {"thickness": 3}), "give Thick"),
    ("make_plates", lambda s: ((s["axis"],), {}), "member is no Member"),
    ("make_plates", lambda s: ((s["member"], {"topp": [0.5]}), {}), "write top"),
    ("make_plates", lambda s: ((s["member"], {"top": "sometimes"}), {}), "not a list of numbers"),
    ("make_plates", lambda s: ((s["member"], {"top": [1000, "x"]}), {}), "not a number of use"),
    ("make_plates", lambda s: ((s["member"],), {"rule_pack": "JP"}), "use one of CN, EU, US"),
    ("make_plates", lambda s: ((s["member"],), {"diaphragms": [{"s": 1000}]}), "row 1: a number"),
    ("make_plates", lambda s: ((s["member"],), {"diaphragms": [{"at": 1}]}), "'at' is unknown"),
    ("make_plates", lambda s: ((s["member"],), {"openings": [{"face": "top", "s": "?"}]}), "row 1"),
    ("make_plates", lambda s: ((s["member"],), {"pieces": {"piece": 1}}), "pieces is not a list"),
    ("make_node", lambda s: ((s["member"], s["member"]), {}), "is the member that runs through"),
    ("make_node", lambda s: ((s["member"], s["other"]), {"gap": -1}), "gap is negative"),
    ("make_node", lambda s: ((s["member"], s["other"]), {"plates": [None]}), "are no PlateSets"),
    ("make_unfold", lambda s: ((s["member"],), {}), "plates is no PlateSet"),
    ("make_unfold", lambda s: ((s["plates"],), {"shrinkage": 1}), "write shrinkage_a"),
    ("make_unfold", lambda s: ((s["plates"], "flat"), {}), "use one of edges, energy, elastic"),
    ("make_bed", lambda s: ((s["plates"],), {"spcaing": 1}), "write spacing"),
    ("make_bed", lambda s: ((s["plates"],), {"spacing": -1}), "spacing is negative"),
    ("make_bed", lambda s: ((s["plates"],), {"template_lines": "L-3"}), "not a list of texts"),
    ("make_sheets", lambda s: ((s["plates"],), {}), "unfold is no Unfold"),
    ("make_sheets", lambda s: ((s["unfold"],), {"format": "A9"}), "none of the choices"),
    ("make_sheets", lambda s: ((s["unfold"],), {"bed": s["plates"]}), "bed is no AssemblyBed"),
]


@pytest.mark.parametrize(
    "function, arguments, words", REFUSED, ids=[f"{f}-{w}" for f, _, w in REFUSED]
)
def test_what_cannot_be_used_is_told_and_leaves_nothing(scene, function, arguments, words):
    """The error names what is wrong with it; the document has the objects it had, unchanged."""
    document = scene["document"]
    names = [item.Name for item in document.Objects]
    touched = [item.Name for item in document.Objects if "Touched" in item.State]
    positional, named = arguments(scene)
    with pytest.raises(BendTorsionError) as caught:
        getattr(make, function)(document, *positional, **named)
    assert words in str(caught.value)
    assert all(finding.message and finding.mend for finding in caught.value.findings)
    assert [item.Name for item in document.Objects] == names
    assert [item.Name for item in document.Objects if "Touched" in item.State] == touched


def test_everything_wrong_is_told_at_once(scene):
    with pytest.raises(BendTorsionError) as caught:
        make.make_section(scene["document"], "S", "boxx", h=-1, t="thick")
    assert [finding.position for finding in caught.value.findings] == [
        "argument type",
        "argument h",
        "argument t",
    ]


def test_the_first_argument_is_a_document():
    for function in ("make_surface", "make_section", "make_plates"):
        with pytest.raises(BendTorsionError, match="not a document"):
            getattr(make, function)("scene", None)


def test_the_next_name_is_not_used_up(scene):
    """FreeCAD numbers names; a refused object takes none."""
    document = scene["document"]
    first = make.make_section(document, "S2")
    number = int(first.Name.removeprefix("SectionSpec"))
    with pytest.raises(BendTorsionError):
        make.make_section(document, "S3", h=-1)
    second = make.make_section(document, "S3")
    assert int(second.Name.removeprefix("SectionSpec")) == number + 1
    for item in (first, second):
        document.removeObject(item.Name)


def test_lengths_and_angles_come_with_or_without_a_unit(scene):
    document = scene["document"]
    section = make.make_section(document, "S", h="0.5 m", b=FreeCAD.Units.Quantity("40 cm"), t=12)
    axis = make.make_axis(document, "A", None, points(), roll="0.1 rad", start_dz="10 cm")
    assert [section.Height.Value, section.Breadth.Value, section.Thickness.Value] == [500, 400, 12]
    assert axis.Roll.Value == pytest.approx(math.degrees(0.1))
    assert axis.StartDz.Value == 100.0
    for item in (section, axis):
        document.removeObject(item.Name)


def test_every_function_that_makes_objects_judges_its_arguments(scene):
    """Each refuses a name it does not have with BendTorsionError; none forgets to."""
    makers = [
        name for name in dir(make) if name.startswith("make_") and callable(getattr(make, name))
    ]
    assert len(makers) >= 10
    for name in makers:
        function = getattr(make, name)
        needed = [
            p
            for p in list(inspect.signature(function).parameters.values())[1:]
            if p.default is p.empty and p.kind is p.POSITIONAL_OR_KEYWORD
        ]
        if name != "make_catalogue_section":
            with pytest.raises(BendTorsionError):
                function(scene["document"], *("?" for _ in needed), no_such_argument=1)


def test_sizes_of_beds_and_allowances_are_those_of_the_core():
    assert set(make_plates.BED_PROPERTIES) == {field.name for field in fields(BedInput)}
    assert set(make_plates.ALLOWANCE_PROPERTIES) == {field.name for field in fields(Allowances)}


def test_a_face_of_a_shape_that_is_not_computed_yet_is_taken(scene):
    """A script may pick before it recomputes."""
    document = scene["document"]
    fresh = document.addObject("Part::Box", "Fresh")
    surface = make.make_surface(document, "Of fresh", face=(fresh, "Face6"))
    document.recompute()
    assert surface.Status == "ok"
    for item in (surface, fresh):
        document.removeObject(item.Name)


def test_readers_know_every_type_a_property_has():
    """No property of an object of ours is of a type `given` cannot judge."""
    from BendTorsionWB.objects import (
        assembly_bed,
        axis,
        member,
        node,
        plate_set,
        section_spec,
        sheet,
        surface,
        unfold,
    )

    kinds = (surface.Surface, axis.Axis, section_spec.SectionSpec, member.Member, node.Node)
    kinds += (plate_set.PlateSet, unfold.Unfold, assembly_bed.AssemblyBed, sheet.SheetSet)
    types = {item.type for kind in kinds for item in kind.PROPERTIES if not item.output}
    known = {*given._UNITS, *given._READERS, "App::PropertyEnumeration"}
    links = {name for name in types if "Link" in name}
    assert types - known == links
