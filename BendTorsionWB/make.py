# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scripting API: functions that make the document objects, with or without a window.

Each returns the new object, not yet recomputed: call `document.recompute()`, then read `Status`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import FreeCAD

from BendTorsionWB.core import section_catalogue
from BendTorsionWB.core.bed_face import BedInput
from BendTorsionWB.core.gross import Allowances
from BendTorsionWB.core.strain_map import strain_map
from BendTorsionWB.core.thickness import USUAL_RULES, ThicknessRules
from BendTorsionWB.objects import assembly_bed as bed_object
from BendTorsionWB.objects import axis as axis_object
from BendTorsionWB.objects import end_cuts, plate_parts
from BendTorsionWB.objects import member as member_object
from BendTorsionWB.objects import node as node_object
from BendTorsionWB.objects import plate_set as plates_object
from BendTorsionWB.objects import section_spec as section_object
from BendTorsionWB.objects import sheet as sheet_object
from BendTorsionWB.objects import surface as surface_object
from BendTorsionWB.objects import unfold as unfold_object
from BendTorsionWB.objects.segment_edit import add_cut as add_cut
from BendTorsionWB.objects.segment_edit import remove_segment as remove_segment
from BendTorsionWB.objects.sub_elements import role_of as role_of
from BendTorsionWB.objects.sub_elements import roles_of as roles_of
from BendTorsionWB.objects.sub_elements import sub_elements as sub_elements
from BendTorsionWB.sheets.strain_picture import write_strain_picture


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
    obj = _new(document, "Part::FeaturePython", name, surface_object.Surface)
    if face is not None:
        obj.Kind, obj.Source = "face", _sub(face)
    else:
        obj.Kind = kind
        for size, value in sizes.items():
            setattr(obj, size, value)
    obj.x, obj.y, obj.z = origin
    obj.Offset, obj.Flip = offset, flip
    return obj


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
    obj = _new(document, "Part::FeaturePython", name, axis_object.Axis)
    obj.Surface = surface
    if edge is not None:
        obj.Source = _sub(edge)
    obj.Sources = [_sub(item if isinstance(item, tuple) else (item, "")) for item in sources]
    obj.SourceUse = source_use
    obj.Points = [FreeCAD.Vector(*point) for point in points]
    _set_rule(obj, rule or {"kind": "none"})
    obj.Order, obj.Closed, obj.Direction, obj.Reversed = order, closed, direction, reverse
    obj.Fit, obj.Distance, obj.DistanceFromPoints = fit, distance or 0.0, distance is None
    if tolerance is not None:
        obj.Tolerance = tolerance
    obj.MaxSpacing, obj.ChordSag = max_spacing, chord_sag
    obj.TangentTurn, obj.TwistStep = tangent_turn, twist_step
    obj.UseStartZ, obj.StartZ, obj.StartDz = start_z is not None, start_z or 0.0, start_dz
    obj.UseEndZ, obj.EndZ, obj.EndDz = end_z is not None, end_z or 0.0, end_dz
    obj.StartExtension, obj.EndExtension = start_extension, end_extension
    obj.Frame, obj.FixedDirection = frame, FreeCAD.Vector(*fixed_direction)
    table = given_directions or given_angles or {}
    obj.GivenPlaces = [float(place) for place in table]
    if given_directions:
        obj.GivenDirections = [FreeCAD.Vector(*vector) for vector in given_directions.values()]
    else:
        obj.GivenAngles = [float(angle) for angle in table.values()]
    obj.Roll = roll
    obj.TwistPlaces = [float(place) for place in twist or {}]
    obj.TwistAngles = [float(angle) for angle in (twist or {}).values()]
    obj.PresetPlaces = [float(place) for place in preset or {}]
    obj.PresetMoves = [FreeCAD.Vector(*move) for move in (preset or {}).values()]
    obj.Show = show
    return obj


def _set_rule(obj, rule: Mapping) -> None:
    obj.Rule = rule["kind"]
    for key in ("origin", "normal", "start", "end"):
        if rule.get(key) is not None:
            setattr(obj, f"Rule{key.capitalize()}", FreeCAD.Vector(*rule[key]))
    for key in ("held", "at", "first", "last", "patch"):
        if key in rule:
            setattr(obj, f"Rule{key.capitalize()}", rule[key])


def make_section(document, name: str = "Section", type: str = "box1", **sizes):
    """A SectionSpec of a type: box1, box2, i, tee, channel, trapezoid, polygon or strips.

    Sizes h, b, b_bottom, t, t_top, t_bottom, t_web, gap1, gap2 in mm; corner_joint; corners and
    thicknesses of a polygon, [(y, z), ...] and one per side; strips, a list of rows (face, letter,
    y1, z1, y2, z2, t, side, stop1, stop2); Material, Density (kg/m3), E and fy ('355 MPa').
    """
    obj = _new(document, "Part::FeaturePython", name, section_object.SectionSpec)
    obj.Type = type
    if "corners" in sizes:
        obj.PolygonCorners = [FreeCAD.Vector(0.0, y, z) for y, z in sizes.pop("corners")]
    if "thicknesses" in sizes:
        obj.PolygonThicknesses = [float(t) for t in sizes.pop("thicknesses")]
    if "strips" in sizes:
        obj.StripTable = [", ".join(map(str, row)) for row in sizes.pop("strips")]
    if "corner_joint" in sizes:
        obj.CornerJoint = sizes.pop("corner_joint")
    for size, value in sizes.items():
        setattr(obj, section_object.PROPERTY_OF_SIZE.get(size, size), value)
    return obj


def catalogue_names() -> list[str]:
    """Names of the sections of the catalogue."""
    return [entry.name for entry in section_catalogue.entries()]


def make_catalogue_section(document, name: str):
    """A SectionSpec with the sizes of a catalogue section, such as 'HEB 300'."""
    entry = section_catalogue.entry(name)
    return make_section(document, entry.name, entry.type, **entry.sizes)


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
    obj = _new(document, "Part::FeaturePython", name, member_object.Member)
    obj.Axis, obj.Segments = axis, len(sections)
    obj.OffsetY, obj.OffsetZ, obj.Roll = offset_y, offset_z, roll
    obj.TransitionLength, obj.Rank = transition_length, rank
    end_cuts.set_cut(obj, "Start", start_cut)
    end_cuts.set_cut(obj, "End", end_cut)
    obj.JointStagger, obj.FoldClearance = thickness.stagger, thickness.fold_clearance
    obj.ChamferSlope = thickness.chamfer_slope
    names = {
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
    for k, section in enumerate(sections, start=1):
        setattr(obj, f"Section{k}", section)
        for key, value in (segments[k - 1] if k <= len(segments) else {}).items():
            setattr(obj, f"{names[key]}{k}", value)
    return obj


def make_plates(
    document,
    member,
    joints: Mapping[str, Sequence[float] | str] | None = None,
    *,
    lanes: Mapping[str, Sequence[float] | str] | None = None,
    nodes: Sequence[float] = (),
    station_spacing: float = 500.0,
    rule_pack: str = "CN",
    diaphragms: Sequence[Mapping] = (),
    openings: Sequence[Mapping] = (),
    marks: Sequence[Mapping] = (),
    pieces: Sequence[Mapping] = (),
    edges: Sequence[Mapping] = (),
):
    """The PlateSet of a member; joints: face -> cumulative ratios (up to 1) or mm, or `auto`.

    lanes: face -> seams that divide it along, ratios or mm of its width, or `auto`. nodes: places
    on the axis joints keep clear of, mm.
    diaphragms, openings, marks, pieces, edges: rows as on the schedule's sheets, column -> value,
    such as {"s": 3000, "t": 16, "gap": 2, "manhole": "d=400"}; a material is `name, density, E,
    fy`.
    """
    obj = _new(document, "Part::FeaturePython", f"{member.Label} plates", plates_object.PlateSet)
    obj.Member = member
    for name, given in (("Joints", joints or {}), ("Lanes", lanes or {})):
        setattr(obj, f"Auto{name}", [face for face, values in given.items() if values == "auto"])
        for face, values in given.items():
            plates_object.add_joints(obj, face)
            if values != "auto":
                setattr(obj, f"{name}{face.capitalize()}", [float(value) for value in values])
    obj.NodePlaces = [float(place) for place in nodes]
    obj.StationSpacing, obj.RulePack = station_spacing, rule_pack
    plate_parts.set_parts(obj, "Diaphragms", diaphragms)
    plate_parts.set_parts(obj, "Openings", openings)
    plate_parts.set_parts(obj, "Marks", marks)
    plate_parts.set_parts(obj, "Pieces", pieces)
    plate_parts.set_parts(obj, "Edges", edges)
    return obj


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
    label: str = "",
):
    """A Node where the Member `other` ends on `through`; by_rank: on the one of lower rank.

    place: about where on `through`, mm, needed where they meet twice. plates: the PlateSets of the
    two members, which then end at the node and keep their joints clear of it.
    label: of the object, where several branches share the node's name.
    """
    obj = _new(document, "Part::FeaturePython", label or name, node_object.Node)
    obj.Through, obj.Other, obj.Node = through, other, name
    obj.ThroughBy = "rank" if by_rank else "link"
    obj.Type, obj.Gap, obj.StubLength, obj.Place = type, gap, stub_length, place
    obj.Diaphragms, obj.Blend, obj.RulePack = diaphragms, blend, rule_pack
    for item in plates:
        item.Nodes = [*item.Nodes, obj]
    return obj


def make_unfold(
    document,
    plates,
    mode: str = "edges",
    *,
    flattened_surface: str = "mid",
    marking_face: str = "inside",
    contour: str = "mid",
    **allowances: float | str,
):
    """The Unfold of a PlateSet: its flat patterns; mode `edges`, `energy` or `elastic`.

    flattened_surface: `mid`, `outer` or `inner`; marking_face: `inside` or `outside`;
    contour: face that cut files draw, `mid`, `top`, `root` or `widest`. allowances:
    any of shrinkage_along, shrinkage_across, joint, diaphragm, green_start, green_end and splice,
    as of core.gross.Allowances.
    """
    given = Allowances(**allowances)
    name = f"{plates.Member.Label} patterns" if plates.Member else "Patterns"
    obj = _new(document, "Part::FeaturePython", name, unfold_object.Unfold)
    obj.Plates, obj.Mode = plates, mode
    obj.FlattenedSurface, obj.MarkingFace = flattened_surface, marking_face
    obj.Contour = contour
    obj.ShrinkageAlong, obj.ShrinkageAcross = given.shrinkage_along, given.shrinkage_across
    obj.JointAllowance, obj.DiaphragmAllowance = given.joint, given.diaphragm
    obj.GreenStart, obj.GreenEnd, obj.Splice = given.green_start, given.green_end, given.splice
    return obj


def make_bed(document, plates, **sizes):
    """The AssemblyBed of a PlateSet: what its pieces lie on while they are put together.

    sizes: any of face, plane, normal, spacing, height, pin_pitch, lowest_pin, template_pitch,
    template_lines and clearance, as of core.bed_face.BedInput; mm.
    """
    given = BedInput(**sizes)
    name = f"{plates.Member.Label} bed" if plates.Member else "Bed"
    obj = _new(document, "Part::FeaturePython", name, bed_object.AssemblyBed)
    obj.Plates, obj.Face, obj.Plane = plates, given.face, given.plane
    obj.Normal = FreeCAD.Vector(*given.normal)
    obj.SaddleSpacing, obj.SeatHeight = given.spacing, given.height
    obj.PinPitch, obj.LowestPin = given.pin_pitch, given.lowest_pin
    obj.TemplatePitch, obj.Clearance = given.template_pitch, given.clearance
    obj.TemplateLines = list(given.template_lines)
    return obj


def write_strain_map(unfold, mark: str, path) -> None:
    """Write the strain map of one plate of an Unfold as a picture, PNG or SVG by the file's name.

    KeyError when there is no such plate to be laid flat; BendTorsionError for what cannot be built.
    """
    plates = plates_object.value(unfold.Plates).plates
    plate = {item.plate.mark: item.plate for item in plates}[mark]
    given = unfold_object.pattern_input(unfold)
    field = strain_map(plate, given.mode, given.marking_face, given.surface)
    write_strain_picture(field, path)


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
    name = unfold.Label.replace("patterns", "sheets")
    obj = _new(document, "App::FeaturePython", name, sheet_object.SheetSet)
    obj.Unfold, obj.Project, obj.Author, obj.Bed = unfold, project, author, bed
    obj.SheetFormat, obj.SheetStandard = format, standard
    obj.SheetLanguage, obj.SheetUnit = language, unit
    obj.PlatePages = plate_pages
    return obj


def _new(document, kind: str, label: str, proxy):
    obj = document.addObject(kind, proxy.TYPE)
    obj.Label = label
    proxy(obj)
    return obj


def _sub(picked: tuple) -> tuple:
    target, names = picked
    return target, [names] if isinstance(names, str) else list(names)
