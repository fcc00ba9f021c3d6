# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scripting API: functions that make the document objects, with or without a window.

Each returns the new object, not yet recomputed: call `document.recompute()`, then read `Status`.
Arguments that cannot be used raise BendTorsionError before anything is added to the document.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from BendTorsionWB.core.geometry import surface as core_surface
from BendTorsionWB.core.members.thickness import USUAL_RULES, ThicknessRules
from BendTorsionWB.core.sections import section_catalogue
from BendTorsionWB.make_plates import make_arrangement as make_arrangement
from BendTorsionWB.make_plates import make_bed as make_bed
from BendTorsionWB.make_plates import make_node as make_node
from BendTorsionWB.make_plates import make_node_sheets as make_node_sheets
from BendTorsionWB.make_plates import make_plates as make_plates
from BendTorsionWB.make_plates import make_sheets as make_sheets
from BendTorsionWB.make_plates import make_unfold as make_unfold
from BendTorsionWB.make_plates import place_beside as place_beside
from BendTorsionWB.make_plates import write_strain_map as write_strain_map
from BendTorsionWB.objects import axis as axis_object
from BendTorsionWB.objects import end_cuts, given
from BendTorsionWB.objects import member as member_object
from BendTorsionWB.objects import section_spec as section_object
from BendTorsionWB.objects import surface as surface_object
from BendTorsionWB.objects.common_colours import colour_by as colour_by
from BendTorsionWB.objects.given import Given
from BendTorsionWB.objects.new_object import new_object, scripted
from BendTorsionWB.objects.repair import repair as repair
from BendTorsionWB.objects.segment_edit import add_cut as add_cut
from BendTorsionWB.objects.segment_edit import remove_segment as remove_segment
from BendTorsionWB.objects.sub_elements import role_of as role_of
from BendTorsionWB.objects.sub_elements import roles_of as roles_of
from BendTorsionWB.objects.sub_elements import sub_elements as sub_elements


@scripted
def make_surface(
    document,
    name: str = "Surface",
    kind: str = "ellipsoid",
    *,
    face: tuple | None = None,
    origin: Sequence[float] = (0.0, 0.0, 0.0),
    offset: float = 0.0,
    flip: bool = False,
    **sizes: float,
):
    """A Surface: an analytic kind with its sizes (mm; cone `angle` in degrees), or
    face=(object, 'Face1'), face=(object, '') for all faces of an object."""
    values = [Given("Offset", "offset", offset), Given("Flip", "flip", flip)]
    at = given.read(name, "origin", origin, given.vector)
    values += [Given(axis, "origin", part) for axis, part in zip("xyz", at, strict=True)]
    if face is not None:
        given.refuse_unknown(name, sizes, (), "size of a face")
        values += [Given("Kind", "kind", "face"), Given("Source", "face", face)]
    else:
        known = core_surface.parameter_names(kind) if kind in core_surface.KINDS else sizes
        given.refuse_unknown(name, sizes, known, f"size of a {kind}")
        values.append(Given("Kind", "kind", kind))
        values += [Given(size, size, value) for size, value in sizes.items()]
    return new_object(document, "Part::FeaturePython", name, surface_object.Surface, values)


@scripted
def make_axis(
    document,
    name: str,
    surface,
    points: Sequence[Sequence[float]] = (),
    *,
    edge: tuple | None = None,
    sources: Sequence = (),
    source_use: str = "automatic",
    rule: Mapping | None = None,
    order: str = "given",
    closed: bool = False,
    direction: str = "given",
    reverse: bool = False,
    fit: str = "pull",
    distance: float | None = None,
    tolerance: float | None = None,
    max_spacing: float = 0.0,
    chord_sag: float = 0.0,
    tangent_turn: float = 0.0,
    twist_step: float = 0.0,
    start_z: float | None = None,
    end_z: float | None = None,
    start_dz: float = 0.0,
    end_dz: float = 0.0,
    start_extension: float = 0.0,
    end_extension: float = 0.0,
    frame: str = "surface",
    fixed_direction: Sequence[float] = (0.0, 0.0, 1.0),
    given_angles: Mapping[float, float] | None = None,
    given_directions: Mapping[float, Sequence[float]] | None = None,
    roll: float = 0.0,
    twist: Mapping[float, float] | None = None,
    preset: Mapping[float, Sequence[float]] | None = None,
    show: str = "wire",
):
    """An Axis through points (mm), along what is picked, or by rule.

    edge=(object, 'Edge1') one picked curve; sources: several objects, or (object, names) each.
    rule: {"kind": "plane section", "origin", "normal", "start", "end"}, {"kind": "geodesic",
    "start", "end"} or {"kind": "iso-curve", "held", "at", "first", "last", "patch"}. distance: of
    fit offset, None for the points' mean. Lengths in mm, angles in degrees. given_angles,
    given_directions, twist and preset map a place (all up to 1: ratios, else mm) to its value.
    """
    values = [
        Given("Surface", "surface", surface),
        Given(
            "Sources",
            "sources",
            [item if isinstance(item, tuple) else (item, "") for item in sources],
        ),
        Given("SourceUse", "source_use", source_use),
        Given("Points", "points", points),
        *_rule_values(name, {"kind": "none"} if rule is None else rule),
        Given("Order", "order", order),
        Given("Closed", "closed", closed),
        Given("Direction", "direction", direction),
        Given("Reversed", "reverse", reverse),
        Given("Fit", "fit", fit),
        Given("Distance", "distance", 0.0 if distance is None else distance),
        Given("DistanceFromPoints", "distance", distance is None),
        Given("MaxSpacing", "max_spacing", max_spacing),
        Given("ChordSag", "chord_sag", chord_sag),
        Given("TangentTurn", "tangent_turn", tangent_turn),
        Given("TwistStep", "twist_step", twist_step),
        Given("UseStartZ", "start_z", start_z is not None),
        Given("StartZ", "start_z", 0.0 if start_z is None else start_z),
        Given("StartDz", "start_dz", start_dz),
        Given("UseEndZ", "end_z", end_z is not None),
        Given("EndZ", "end_z", 0.0 if end_z is None else end_z),
        Given("EndDz", "end_dz", end_dz),
        Given("StartExtension", "start_extension", start_extension),
        Given("EndExtension", "end_extension", end_extension),
        Given("Frame", "frame", frame),
        Given("FixedDirection", "fixed_direction", fixed_direction),
        Given("Roll", "roll", roll),
        Given("Show", "show", show),
    ]
    if edge is not None:
        values.append(Given("Source", "edge", edge))
    if tolerance is not None:
        values.append(Given("Tolerance", "tolerance", tolerance))
    for argument, table, places, rows in (
        ("twist", twist, "TwistPlaces", "TwistAngles"),
        ("preset", preset, "PresetPlaces", "PresetMoves"),
        ("given_angles", given_angles, "GivenPlaces", "GivenAngles"),
        ("given_directions", given_directions, "GivenPlaces", "GivenDirections"),
    ):
        if table:
            table = given.read(name, argument, table, given.mapping)
            values += [
                Given(places, argument, list(table)),
                Given(rows, argument, list(table.values())),
            ]
    return new_object(document, "Part::FeaturePython", name, axis_object.Axis, values)


RULE_KEYS = {
    "none": (),
    "plane section": ("origin", "normal", "start", "end"),
    "geodesic": ("start", "end"),
    "iso-curve": ("held", "at", "first", "last", "patch"),
}
"""What a rule of each kind says."""


def _rule_values(name: str, rule: Mapping) -> list[Given]:
    rule = given.read(name, "rule", rule, given.mapping)
    kind = rule.get("kind")
    values = [Given("Rule", "rule", kind)]
    if kind in RULE_KEYS:
        given.refuse_unknown(name, rule, ("kind", *RULE_KEYS[kind]), f"word of a {kind}")
        values += [
            Given(f"Rule{key.capitalize()}", f"rule {key}", rule[key])
            for key in RULE_KEYS[kind]
            if rule.get(key) is not None
        ]
    return values


SECTION_SIZES = ("h", "b", "b_bottom", "t", "t_top", "t_bottom", "t_web", "gap1", "gap2")
SECTION_WORDS = ("corner_joint", "corners", "thicknesses", "strips")
SECTION_MATERIAL = ("Material", "Density", "E", "fy")


@scripted
def make_section(document, name: str = "Section", type: str = "box1", **sizes):
    """A SectionSpec of a type: box1, box2, i, tee, channel, trapezoid, polygon or strips.

    Sizes h, b, b_bottom, t, t_top, t_bottom, t_web, gap1, gap2 in mm; corner_joint; corners and
    thicknesses of a polygon, [(y, z), ...] and one per side; strips, a list of rows (face, letter,
    y1, z1, y2, z2, t, side, stop1, stop2); Material, Density (kg/m3), E and fy ('355 MPa').
    """
    known = (*SECTION_SIZES, *SECTION_WORDS, *SECTION_MATERIAL)
    given.refuse_unknown(name, sizes, known, "size of a section")
    properties = {
        **section_object.PROPERTY_OF_SIZE,
        "corner_joint": "CornerJoint",
        "corners": "PolygonCorners",
        "thicknesses": "PolygonThicknesses",
        "strips": "StripTable",
    }
    values = [Given("Type", "type", type)]
    for size, value in sizes.items():
        if size == "corners":
            value = given.read(name, size, value, _corners)
        if size == "strips":
            value = given.read(name, size, value, _strip_lines)
        values.append(Given(properties.get(size, size), size, value))
    return new_object(document, "Part::FeaturePython", name, section_object.SectionSpec, values)


def _corners(value: object) -> list[tuple]:
    pairs = [given.numbers(corner) for corner in given.rows(value)]
    if any(len(pair) != 2 for pair in pairs):
        raise ValueError("has a corner that is not (y, z)", "give two numbers for each corner")
    return [(0.0, *pair) for pair in pairs]


def _strip_lines(value: object) -> list[str]:
    return [", ".join(map(str, given.rows(row))) for row in given.rows(value)]


def catalogue_names() -> list[str]:
    """Names of the sections of the catalogue."""
    return [entry.name for entry in section_catalogue.entries()]


def make_catalogue_section(document, name: str):
    """A SectionSpec with the sizes of a catalogue section, such as 'HEB 300'."""
    entry = section_catalogue.entry(name)
    return make_section(document, entry.name, entry.type, **entry.sizes)


SEGMENT_PROPERTIES = {
    "cut": "Cut",
    "cut_ratio": "CutRatio",
    "cut_by": "CutBy",
    "cut_axis": "CutAxis",
    "cut_point": "CutPoint",
    "cut_offset": "CutOffset",
    "slope": "Slope",
    "transition": "Transition",
    "stagger": "Stagger",
    "align": "Align",
    "align_to": "AlignTo",
    "offset_y": "OffsetY",
    "offset_z": "OffsetZ",
}
"""By the name in a segment's mapping: its property, without the segment's number."""


@scripted
def make_member(
    document,
    name: str,
    axis,
    sections: Sequence,
    segments: Sequence[Mapping] = (),
    *,
    offset_y: float = 0.0,
    offset_z: float = 0.0,
    roll: float = 0.0,
    transition_length: str = "face",
    rank: int = 0,
    start_cut: str | Mapping = "square",
    end_cut: str | Mapping = "square",
    thickness: ThicknessRules = USUAL_RULES,
):
    """A Member along an axis with one section per segment.

    segments: one mapping per segment with any of cut (mm), cut_ratio, cut_by (`place`,
    `crossing`, `point`), cut_axis (an Axis), cut_point, cut_offset, slope, transition, stagger,
    align, align_to, offset_y, offset_z; segment 1 has a cut on closed axes only. roll in degrees.
    thickness: the rules of its thickness joints. start_cut, end_cut: `square`, `plumb`, `level`,
    or a mapping of kind (these, `plane`, `surface`), offset (mm outwards), normal and point (of a
    plane; without a point through the end of the axis), face (a Surface, or (object, 'Face1')).
    """
    sections = given.read(name, "sections", sections, given.some_rows)
    segments = given.read(name, "segments", segments, given.rows)
    most = member_object.MOST_SEGMENTS
    if len(sections) > most:
        given.refuse(name, "sections", len(sections), "are too many", f"give {most} at most")
    if len(segments) > len(sections):
        given.refuse(name, "segments", len(segments), "are more than sections", "give one each")
    if not isinstance(thickness, ThicknessRules):
        given.refuse(name, "thickness", thickness, "is none", "give ThicknessRules")
    values = [
        Given("Axis", "axis", axis),
        Given("Segments", "sections", len(sections)),
        Given("OffsetY", "offset_y", offset_y),
        Given("OffsetZ", "offset_z", offset_z),
        Given("Roll", "roll", roll),
        Given("TransitionLength", "transition_length", transition_length),
        Given("Rank", "rank", rank),
        *end_cuts.given_cut(name, "Start", "start_cut", start_cut),
        *end_cuts.given_cut(name, "End", "end_cut", end_cut),
        Given("JointStagger", "thickness", thickness.stagger),
        Given("FoldClearance", "thickness", thickness.fold_clearance),
        Given("ChamferSlope", "thickness", thickness.chamfer_slope),
    ]
    for k, section in enumerate(sections, start=1):
        values.append(Given(f"Section{k}", f"sections[{k - 1}]", section))
    for k, segment in enumerate(segments, start=1):
        segment = given.read(name, f"segments[{k - 1}]", segment, given.mapping)
        given.refuse_unknown(name, segment, SEGMENT_PROPERTIES, "word of a segment")
        values += [
            Given(f"{SEGMENT_PROPERTIES[key]}{k}", f"segments[{k - 1}] {key}", value)
            for key, value in segment.items()
        ]
    further = member_object.segment_properties(len(sections))
    member = member_object.Member
    return new_object(document, "Part::FeaturePython", name, member, values, further)
