# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scripting API of what follows a member: its plates and nodes, patterns, beds and sheets."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.patterns.layer_names import layer_names
from BendTorsionWB.core.patterns.strain_map import strain_map
from BendTorsionWB.core.sections.section import BOX_FACES
from BendTorsionWB.objects import arrangement as arrangement_object
from BendTorsionWB.objects import assembly_bed as bed_object
from BendTorsionWB.objects import given, pattern_place, plate_parts
from BendTorsionWB.objects import node as node_object
from BendTorsionWB.objects import node_sheets as node_sheets_object
from BendTorsionWB.objects import plate_set as plates_object
from BendTorsionWB.objects import section_spec as section_object
from BendTorsionWB.objects import sheet as sheet_object
from BendTorsionWB.objects import unfold as unfold_object
from BendTorsionWB.objects.given import Given
from BendTorsionWB.objects.member import segment_count
from BendTorsionWB.objects.new_object import new_object, scripted
from BendTorsionWB.objects.proxy import type_of
from BendTorsionWB.sheets.strain_picture import write_strain_picture


@scripted
def make_plates(
    document,
    member,
    joints: Mapping[str, Sequence[float] | str] | None = None,
    *,
    lanes: Mapping[str, Sequence[float] | str] | None = None,
    nodes: Sequence[float] = (),
    station_spacing: float = 500.0,
    rule_pack: str = "CN",
    stock: str = "",
    diaphragms: Sequence[Mapping] = (),
    openings: Sequence[Mapping] = (),
    marks: Sequence[Mapping] = (),
    pieces: Sequence[Mapping] = (),
    edges: Sequence[Mapping] = (),
):
    """The PlateSet of a member; joints: face -> cumulative ratios (up to 1) or mm, or `auto`.

    lanes: face -> seams that divide it along, ratios or mm of its width, or `auto`. nodes: places
    on the axis joints keep clear of, mm. stock: sheets there are, such as `12000x2500; 16
    10000x2000`; empty for the rule pack's.
    diaphragms, openings, marks, pieces, edges: rows as on the schedule's sheets, column -> value,
    such as {"s": 3000, "t": 16, "gap": 2, "manhole": "d=400"}; a material is `name, density, E,
    fy`.
    """
    label = f"{getattr(member, 'Label', 'Member')} plates"
    values = [
        Given("Member", "member", member),
        Given("NodePlaces", "nodes", nodes),
        Given("StationSpacing", "station_spacing", station_spacing),
        Given("RulePack", "rule_pack", rule_pack),
        Given("Stock", "stock", stock),
    ]
    tables = {"Diaphragms": diaphragms, "Openings": openings, "Marks": marks}
    for table, rows in {**tables, "Pieces": pieces, "Edges": edges}.items():
        values += plate_parts.lists_of_rows(label, table, rows)
    known, further = _faces_of(member), []
    for argument, by_face in (("joints", joints), ("lanes", lanes)):
        by_face = given.read(label, argument, by_face or {}, given.mapping)
        given.refuse_unknown(label, by_face, known, f"face of {argument}")
        kind = argument.capitalize()
        auto = [face for face, places in by_face.items() if _is_auto(places)]
        values.append(Given(f"Auto{kind}", argument, auto))
        for face, places in by_face.items():
            further += plates_object.properties_of(face)
            if face not in auto:
                values.append(Given(f"{kind}{face.capitalize()}", f"{argument} {face}", places))
    return new_object(
        document, "Part::FeaturePython", label, plates_object.PlateSet, values, further
    )


def _is_auto(places: object) -> bool:
    return isinstance(places, str) and places == "auto"


def _faces_of(member) -> list[str]:
    """The faces of a Member's sections; those of a box while they cannot be told."""
    faces = list(BOX_FACES)
    for k in range(1, segment_count(member) + 1 if type_of(member) == "Member" else 1):
        try:
            section = section_object.value(getattr(member, f"Section{k}"))
        except (BendTorsionError, AttributeError):
            continue
        faces += [strip.face for strip in section.strips]
    return list(dict.fromkeys(faces))


@scripted
def make_node(
    document,
    through,
    other,
    name: str = "N1",
    *,
    type: str = "direct",
    gap: float = 3.0,
    stub_length: float = 0.0,
    diaphragms: str = "flanges",
    blend: bool = False,
    place: float = 0.0,
    by_rank: bool = False,
    rule_pack: str = "CN",
    plates: Sequence = (),
    beside: Sequence = (),
    ends_on: Sequence = (),
    label: str = "",
):
    """A Node where the Member `other` ends on `through`; by_rank: on the one of lower rank.

    place: about where on `through`, mm, needed where they meet twice. plates: the PlateSets of the
    two members, which then end at the node and keep their joints clear of it. beside: other Members
    that end at the node; where two overlap, the one of higher rank ends on the other. ends_on:
    those that `other` ends on, whatever the ranks.
    label: of the object, where several branches share the node's name.
    """
    plates = given.read(label or name, "plates", plates, given.rows)
    for item in plates:
        if type_of(item) != "PlateSet":
            given.refuse(label or name, "plates", item, "are no PlateSets", "give PlateSets")
    beside = given.read(label or name, "beside", beside, given.rows)
    ends_on = given.read(label or name, "ends_on", ends_on, given.rows)
    if other is through:
        given.refuse(name, "other", other, "is the member that runs through", "give another")
    values = [
        Given("Through", "through", through),
        Given("Other", "other", other),
        Given("Node", "name", name),
        Given("ThroughBy", "by_rank", "rank" if by_rank else "link"),
        Given("Type", "type", type),
        Given("Gap", "gap", gap),
        Given("StubLength", "stub_length", stub_length),
        Given("Place", "place", place),
        Given("Diaphragms", "diaphragms", diaphragms),
        Given("Blend", "blend", blend),
        Given("RulePack", "rule_pack", rule_pack),
        Given("Beside", "beside", list(beside)),
        Given("EndsOn", "ends_on", list(ends_on)),
    ]
    kind = node_object.Node
    obj = new_object(document, "Part::FeaturePython", label or name, kind, values)
    for item in plates:
        item.Nodes = [*item.Nodes, obj]
    return obj


ALLOWANCE_PROPERTIES = {
    "shrinkage_along": "ShrinkageAlong",
    "shrinkage_across": "ShrinkageAcross",
    "joint": "JointAllowance",
    "diaphragm": "DiaphragmAllowance",
    "green_start": "GreenStart",
    "green_end": "GreenEnd",
    "splice": "Splice",
}
"""The fields of core.patterns.gross.Allowances as properties of an Unfold."""


@scripted
def make_unfold(
    document,
    plates,
    mode: str = "edges",
    *,
    flattened_surface: str = "mid",
    marking_face: str = "inside",
    contour: str = "mid",
    layers: Mapping[str, str] | None = None,
    place: Sequence[float] = (0.0, 0.0, 0.0),
    **allowances: float | str,
):
    """The Unfold of a PlateSet: its flat patterns; mode `edges`, `energy` or `elastic`.

    flattened_surface: `mid`, `outer` or `inner`; marking_face: `inside` or `outside`;
    contour: face that cut files draw, `mid`, `top`, `root` or `widest`. allowances:
    any of shrinkage_along, shrinkage_across, joint, diaphragm, green_start, green_end and splice,
    as of core.patterns.gross.Allowances. layers: other names for layers of cut files, by those of
    the contract, such as {"CUT_OUTER": "10"}. place: (x, y, z) where the first pattern starts, mm;
    `place_beside` tells where nothing else is.
    """
    label = _label_of(plates, "patterns")
    base = given.read(label, "place", place, given.vector)
    given.refuse_unknown(label, allowances, ALLOWANCE_PROPERTIES, "allowance")
    layers = given.read(label, "layers", layers or {}, given.mapping)
    names = [f"{layer}={name}" for layer, name in layers.items()]
    layer_names(names, label)
    values = [
        Given("Plates", "plates", plates),
        Given("Mode", "mode", mode),
        Given("FlattenedSurface", "flattened_surface", flattened_surface),
        Given("MarkingFace", "marking_face", marking_face),
        Given("Contour", "contour", contour),
        Given("LayerNames", "layers", names),
        *(Given(ALLOWANCE_PROPERTIES[key], key, value) for key, value in allowances.items()),
    ]
    obj = new_object(document, "Part::FeaturePython", label, unfold_object.Unfold, values)
    obj.Placement.Base = base
    return obj


@scripted
def place_beside(document, plates) -> tuple[float, float, float]:
    """Where the patterns of a PlateSet lie clear of everything there is, for make_unfold, mm."""
    return pattern_place.free_place(document, plates)


BED_PROPERTIES = {
    "face": "Face",
    "plane": "Plane",
    "normal": "Normal",
    "spacing": "SaddleSpacing",
    "height": "SeatHeight",
    "pin_pitch": "PinPitch",
    "lowest_pin": "LowestPin",
    "template_pitch": "TemplatePitch",
    "template_lines": "TemplateLines",
    "clearance": "Clearance",
}
"""The fields of core.beds.bed_face.BedInput as properties of an AssemblyBed."""


@scripted
def make_bed(document, plates, **sizes):
    """The AssemblyBed of a PlateSet: what its pieces lie on while they are put together.

    sizes: any of face, plane, normal, spacing, height, pin_pitch, lowest_pin, template_pitch,
    template_lines and clearance, as of core.beds.bed_face.BedInput; mm.
    """
    label = _label_of(plates, "bed")
    given.refuse_unknown(label, sizes, BED_PROPERTIES, "size of a bed")
    values = [
        Given("Plates", "plates", plates),
        *(Given(BED_PROPERTIES[key], key, value) for key, value in sizes.items()),
    ]
    return new_object(document, "Part::FeaturePython", label, bed_object.AssemblyBed, values)


def _label_of(plates, what: str) -> str:
    """The label of what is made of a PlateSet, after its member."""
    member = getattr(plates, "Member", None)
    return f"{member.Label} {what}" if member else what.capitalize()


def write_strain_map(unfold, mark: str, path) -> None:
    """Write the strain map of one plate of an Unfold as a picture, PNG or SVG by the file's name.

    Raises BendTorsionError for a plate that is not there, and for what cannot be built.
    """
    plates = plates_object.value(unfold.Plates).plates
    by_mark = {item.plate.mark: item.plate for item in plates}
    given.refuse_unknown(unfold.Label, [mark], by_mark, "mark")
    laid = unfold_object.pattern_input(unfold)
    field = strain_map(by_mark[mark], laid.mode, laid.marking_face, laid.surface)
    write_strain_picture(field, path)


@scripted
def make_sheets(
    document,
    unfold,
    project: str = "",
    author: str = "",
    bed=None,
    format: str = "A3",
    standard: str = "ISO",
    language: str = "en",
    unit: str = "mm",
    plate_pages: bool = True,
):
    """The drawing sheets of a member, with those of its AssemblyBed when there is one; their pages
    are made and kept by recompute. format: `A4` ... `A1`, `ARCH A` ... `ARCH D`; standard: `ISO`,
    `AWS`; language: `en`, `zh`; unit: `mm`, `ft-in`; plate_pages: False leaves the plates out."""
    label = getattr(unfold, "Label", "patterns").replace("patterns", "sheets")
    values = [
        Given("Unfold", "unfold", unfold),
        Given("Project", "project", project),
        Given("Author", "author", author),
        Given("Bed", "bed", bed),
        Given("SheetFormat", "format", format),
        Given("SheetStandard", "standard", standard),
        Given("SheetLanguage", "language", language),
        Given("SheetUnit", "unit", unit),
        Given("PlatePages", "plate_pages", plate_pages),
    ]
    return new_object(document, "App::FeaturePython", label, sheet_object.SheetSet, values)


@scripted
def make_arrangement(document, sheets, label: str = "general arrangement"):
    """The general arrangement of the members of some sheet sets, drawn in the style of the first;
    its pages are made and kept by recompute. Raises BendTorsionError for an empty list."""
    values = [Given("Sheets", "sheets", given.read(label, "sheets", sheets, given.some_rows))]
    kind = arrangement_object.ArrangementSet
    return new_object(document, "App::FeaturePython", label, kind, values)


@scripted
def make_node_sheets(document, sheets, label: str = "nodes"):
    """The drawings of the nodes of the members of some sheet sets, drawn in the style of the first;
    their pages are made and kept by recompute. Raises BendTorsionError for an empty list."""
    values = [Given("Sheets", "sheets", given.read(label, "sheets", sheets, given.some_rows))]
    kind = node_sheets_object.NodeSheets
    return new_object(document, "App::FeaturePython", label, kind, values)
