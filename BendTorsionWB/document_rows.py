# SPDX-License-Identifier: LGPL-2.1-or-later
"""The objects of a document as rows of a schedule: cells by sheet, column by column.

A column is filled from the property of its name in FreeCAD's spelling (`align_to` of segment 2:
`AlignTo2`), looked for on the member, its plates, patterns and bed; the few that differ are named
here. A cell that says no more than its default stays empty.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from BendTorsionWB.core import detailing
from BendTorsionWB.core.axes.axis_ends import AxisEnd
from BendTorsionWB.core.axes.axis_input import AxisInput, ordered_points
from BendTorsionWB.core.axes.axis_order import rule_turns
from BendTorsionWB.core.axes.axis_rule import curve_by_rule
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.geometry.curve_edit import turned
from BendTorsionWB.core.rules import node_rules
from BendTorsionWB.core.written_number import per_cent, plain
from BendTorsionWB.document_settings import rows_in, style_in, style_settings
from BendTorsionWB.exchange.file_name import file_name
from BendTorsionWB.exchange.kept_rows import add_kept, kept_settings
from BendTorsionWB.exchange.schedule_columns import FIRST_SEGMENT_COLUMNS, SETTINGS, SHEETS
from BendTorsionWB.exchange.schedule_end_cuts import CUT_COLUMNS
from BendTorsionWB.exchange.schedule_sections import TAKEN
from BendTorsionWB.exchange.whole_file import whole_file
from BendTorsionWB.objects import axis as axis_object
from BendTorsionWB.objects import end_cuts, plate_parts
from BendTorsionWB.objects import surface as surface_object
from BendTorsionWB.objects.member import cut_of, segment_count
from BendTorsionWB.objects.node import members_of
from BendTorsionWB.objects.proxy import linked, type_of
from BendTorsionWB.objects.section_spec import PROPERTY_OF_SIZE
from BendTorsionWB.shapes import curve_shape

SETTING_PROPERTIES = {
    "axis_tolerance": ("Axis", "Tolerance"),
    "bed_face": ("AssemblyBed", "Face"),
    "bed_plane": ("AssemblyBed", "Plane"),
    "bed_spacing": ("AssemblyBed", "SaddleSpacing"),
    "bed_height": ("AssemblyBed", "SeatHeight"),
    "template_clearance": ("AssemblyBed", "Clearance"),
}
"""Where a setting is found when its property is not named after it."""
COLUMN_PROPERTIES = {"member_offset_y": "OffsetY", "member_offset_z": "OffsetZ"}
_OF_A_MEMBER = ("Member", "PlateSet", "Unfold", "AssemblyBed")
_FOR_NOTHING = {("Members", "rank"): 0, ("Settings", "pin_pitch"): 0.0}


def rows_of(document, files: Path) -> dict[str, list[list]]:
    """Every sheet that has rows, its headings first. Shapes an axis or surface is made from and
    curves by rule go as BREP files into `files`, which the cells name relative to its parent.

    Raises BendTorsionError for objects that cannot be computed.
    """
    kinds: dict[str, list] = {}
    for obj in document.Objects:
        kinds.setdefault(type_of(obj), []).append(obj)
    settings = kept_settings(rows_in(document)) | _settings(kinds, style_in(document))
    materials: dict[str, tuple] = {}
    cells: dict[str, list[dict]] = {
        "Settings": [{"key": key, "value": value} for key, value in settings.items()],
        "Surfaces": [_surface(obj, files) for obj in kinds.get("Surface", ())],
        "Axes": [],
        "Points": [],
        "Frames": [],
        "Presets": [],
        "Sections": [],
        "Strips": [],
        "Members": [],
        "Splits": [],
    }
    for obj in kinds.get("Axis", ()):
        _axis(obj, files, cells)
    for obj in kinds.get("SectionSpec", ()):
        cells["Sections"].append(_section(obj, materials))
        if obj.Type == "strips":
            cells["Strips"] += _strips(obj)
    for obj in kinds.get("Member", ()):
        _member(obj, kinds, cells, settings)
    rows = map(_node, kinds.get("Node", ()))
    cells["Nodes"] = [row for row in rows if row is not None]
    for obj in kinds.get("Node", ()):
        names = ((first.Label, members_of(obj)[1].Label) for first in obj.EndsOn)
        cells["Nodes"] += [{"through": one, "other": other} for one, other in names]
    cells["Materials"] = [
        {"material": name, "density": density, "E": e, "fy": fy}
        for name, (density, e, fy) in materials.items()
    ]
    relabelled = {
        obj.FromSchedule: obj.Label
        for obj in kinds.get("Member", ())
        if getattr(obj, "FromSchedule", "") not in ("", obj.Label)
    }
    add_kept(cells, rows_in(document), relabelled)
    return {
        sheet: _table(sheet, cells.get(sheet, ()))
        for sheet in SHEETS
        if cells.get(sheet) or sheet == "Points"
    }


def _table(sheet: str, rows: Iterable[dict]) -> list[list]:
    """Rows under the declared headings, those without a value in any row left out."""
    rows = list(rows)
    used = [
        column
        for column in SHEETS[sheet]
        if column.required or any(row.get(column.name) is not None for row in rows)
    ]
    return [
        [column.name for column in used],
        *([row.get(column.name) for column in used] for row in rows),
    ]


def _camel(column: str) -> str:
    return "".join(word[:1].upper() + word[1:] for word in column.split("_"))


def _cell(value):
    """A property's value as a cell."""
    if isinstance(value, bool):
        return "yes" if value else None
    if hasattr(value, "UserString"):
        value = value.Value
    if isinstance(value, (tuple, list)):
        return " ".join(repr(item) if isinstance(item, float) else str(item) for item in value)
    return None if value == "" else value


def _unless_default(sheet: str, column, value):
    cell = _cell(value)
    default = 0.0 if column.default is None else column.default
    if (sheet, column.name) in _FOR_NOTHING:
        default = _FOR_NOTHING[sheet, column.name]
    return None if cell == default and type(cell) is not bool else cell


def _settings(kinds, style: SheetStyle) -> dict[str, object]:
    """The settings that are not their default, as the first object has them; style: of the
    sheets."""
    found = {key: value for key, value in style_settings(style) if value != SETTINGS[key].default}
    for key, setting in SETTINGS.items():
        kind, name = SETTING_PROPERTIES.get(key, ("", _camel(key)))
        candidates = [o for k in ((kind,) if kind else _OF_A_MEMBER) for o in kinds.get(k, ())]
        obj = next((o for o in candidates if name in o.PropertiesList), None)
        value = None if obj is None else _unless_default("Settings", setting, getattr(obj, name))
        if value is not None:
            found[key] = value
    return found


def _surface(obj, files: Path) -> dict:
    row = {
        "surface": obj.Label,
        "kind": obj.Kind,
        "offset": obj.Offset.Value or None,
        "flip": "yes" if obj.Flip else None,
    }
    if obj.Kind == "face":
        return {**row, "kind": "file", "file": _brep(obj, surface_object.source_shape(obj), files)}
    sizes = [
        f"{name}={getattr(obj, name).Value!r}"
        for name in surface_object.core_surface.parameter_names(obj.Kind)
    ]
    sizes += [f"{name}={getattr(obj, name).Value!r}" for name in "xyz" if getattr(obj, name).Value]
    return {**row, "parameters": " ".join(sizes) or None}


def _axis(obj, files: Path, cells: dict[str, list[dict]]) -> None:
    given = axis_object.axis_input(obj)
    surface = axis_object.surface_value(obj)
    reverse = _is_turned(given, surface)
    row = {
        "axis": obj.Label,
        "surface": linked(obj, "Surface", "Surface").Label,
        "frame": obj.Frame if obj.Frame != "surface" else None,
        "fit": obj.Fit if obj.Fit != "pull" else None,
        "max_spacing": obj.MaxSpacing.Value or None,
        "start_z": obj.StartZ.Value if obj.UseStartZ else None,
        "end_z": obj.EndZ.Value if obj.UseEndZ else None,
        **{
            f"{end}_{what}": getattr(obj, f"{end.capitalize()}{_camel(what)}").Value or None
            for end in ("start", "end")
            for what in ("dz", "extension")
        },
    }
    points = ordered_points(given)
    if points is None:
        curve = given.curve
        if curve is None:
            curve, *_ = curve_by_rule(given.name, given.rule, surface)
        curve = turned(curve) if reverse else curve
        row["source"] = _brep(obj, curve_shape.edge(curve), files)
    else:
        row["closed"] = "yes" if points.closed else None
        places = points.points[::-1] if reverse else points.points
        cells["Points"] += [
            {"axis": obj.Label, "no": number, "x": x, "y": y, "z": z}
            for number, (x, y, z) in enumerate(places.tolist(), start=1)
        ]
    cells["Axes"].append(row)
    table = "Given" if obj.Frame == "given" else "Twist"
    places = list(getattr(obj, f"{table}Places"))
    angles = list(getattr(obj, f"{table}Angles"))
    directions = list(obj.GivenDirections) if table == "Given" else []
    for number, place in enumerate(_places(places)):
        at = {"axis": obj.Label, "s": place}
        if directions:
            at |= dict(zip("xyz", directions[number]))
        else:
            at["angle"] = angles[number]
        cells["Frames"].append(at)
    for place, move in zip(_places(list(obj.PresetPlaces)), obj.PresetMoves):
        named = dict(zip(("dx", "dy", "dz"), move))
        cells["Presets"].append({"axis": obj.Label, "s": place, **named})


def _is_turned(given: AxisInput, surface) -> bool:
    """Whether an axis runs against its points or curve; the schedule has them in its direction."""
    if given.direction == "given":
        return given.reversed
    plain = replace(
        given,
        direction="given",
        reversed=False,
        start=AxisEnd(),
        end=AxisEnd(),
        preset=None,
    )
    return rule_turns(detailing.axis_of(plain, surface)) != given.reversed


def _places(places: list[float]) -> list:
    """Places of a table as cells: ratios, when none is above 1, in per cent."""
    is_ratio = bool(places) and max(places) <= 1.0
    return [per_cent(place) if is_ratio else place for place in places]


def _brep(obj, shape, files: Path) -> str:
    # A surface and an axis may have the same label.
    name = f"{file_name(obj.Label)} {obj.BT_Type.lower()}.brep"
    with whole_file(files / name) as part:
        shape.exportBrep(str(part))
    return f"{files.name}/{name}"


def _section(obj, materials: dict[str, tuple]) -> dict:
    grade = (
        obj.Density,
        obj.YoungsModulus.getValueAs("MPa").Value,
        obj.YieldStrength.getValueAs("MPa").Value,
    )
    name = obj.Material
    if any(abs(a - b) > 1e-9 * abs(b) for a, b in zip(materials.setdefault(name, grade), grade)):
        number = 2
        while materials.setdefault(f"{name}-{number}", grade) != grade:
            number += 1
        name = f"{name}-{number}"
    row = {"section": obj.Label, "type": obj.Type, "material": name}
    for column in SHEETS["Sections"]:
        size = PROPERTY_OF_SIZE.get(column.name)
        if size and column.name not in row and column.name in TAKEN[obj.Type]:
            row[column.name] = getattr(obj, size).Value or None
    if obj.Type == "trapezoid":
        row["b_bottom"] = row["b_bottom"] or row["b"]
    if obj.Type == "polygon":
        row["corners"] = "; ".join(f"{p.y!r} {p.z!r}" for p in obj.PolygonCorners)
        row["thicknesses"] = _cell(list(obj.PolygonThicknesses)) or None
        row["t"], row["gap1"] = obj.Thickness.Value or None, obj.Gap1.Value or None
    if obj.CornerJoint != "automatic" and obj.Type in ("trapezoid", "polygon"):
        row["corner_joint"] = obj.CornerJoint
    return row


def _strips(obj) -> list[dict]:
    names = [column.name for column in SHEETS["Strips"][1:]]
    rows = []
    for line in obj.StripTable:
        texts = [text.strip() for text in line.split(",")]
        rows.append({"section": obj.Label, **{n: t or None for n, t in zip(names, texts)}})
    return rows


def _member(obj, kinds, cells: dict[str, list[dict]], settings: Mapping) -> None:
    plates = next((p for p in kinds.get("PlateSet", ()) if p.Member == obj), None)
    chain = [obj, *([plates] if plates else ())]
    chain += [
        user
        for kind in _OF_A_MEMBER[2:]
        for user in kinds.get(kind, ())
        if plates is not None and plates in user.OutListRecursive
    ]
    default_slope = settings.get("default_slope", SETTINGS["default_slope"].default)
    for k in range(1, segment_count(obj) + 1):
        section = linked(obj, f"Section{k}", "SectionSpec")
        row = {"member": obj.Label, "segment": k, "section": section.Label}
        if k == 1:
            row["axis"] = linked(obj, "Axis", "Axis").Label
        if f"Cut{k}" in obj.PropertiesList and (k > 1 or _has_cut(obj, k)):
            row["cut"] = _cut(obj, k)
        slope = f"Slope{k}"
        if k > 1 or (slope in obj.PropertiesList and getattr(obj, slope) != default_slope):
            row["slope"] = getattr(obj, slope)
        for column in SHEETS["Members"]:
            if column.name in ("member", "segment", "section", "axis", "cut", "slope"):
                continue
            usual = column
            if column.name in SETTINGS:
                default = settings.get(column.name, SETTINGS[column.name].default)
                usual = replace(column, default=default)
            if column.name in CUT_COLUMNS:
                end = column.name.removesuffix("_cut").capitalize()
                row[column.name] = end_cuts.cut_words(obj, end) if k == 1 else None
                continue
            value = _found(obj, chain, column.name, k)
            row[column.name] = _unless_default("Members", usual, value)
        cells["Members"].append(row)
    if plates is not None:
        cells["Splits"] += _splits(obj, plates)
        for table in plate_parts.PART_COLUMNS:
            for part in plate_parts.rows_of(plates, table):
                cells.setdefault(table, []).append({"member": obj.Label, **part})


def _node(obj) -> dict | None:
    """The row of a Node, or None for one the ranks of its members make."""
    through, other = members_of(obj)
    found = {
        column.name: _unless_default("Nodes", column, getattr(obj, _camel(column.name)))
        for column in SHEETS["Nodes"]
        if column.name in ("type", "stub_length", "diaphragms", "blend")
    }
    found["gap"] = obj.Gap.Value
    usual = node_rules(obj.RulePack).gap
    if obj.ThroughBy == "rank" and found.pop("gap") == usual and not any(found.values()):
        return None
    names = {"node": obj.Node or None, "through": through.Label, "other": other.Label}
    # Where the two were found to meet; the row only says which of several meetings it is.
    place = float(f"{obj.Place.Value:.10g}") or None
    return {**names, "s": place, **found, "gap": obj.Gap.Value}


def _found(obj, chain, column: str, k: int):
    """The value of a column: of the segment, or on segment 1 of the whole member."""
    name = _camel(column)
    if column not in FIRST_SEGMENT_COLUMNS and f"{name}{k}" in obj.PropertiesList:
        return getattr(obj, f"{name}{k}")
    name = COLUMN_PROPERTIES.get(column, name)
    for one in chain if k == 1 else ():
        if name in one.PropertiesList and column in FIRST_SEGMENT_COLUMNS:
            return getattr(one, name)
    return None


def _has_cut(obj, k: int) -> bool:
    return bool(getattr(obj, f"Cut{k}").Value or getattr(obj, f"CutRatio{k}"))


def _cut(obj, k: int):
    """The cut of a segment as a cell: a ratio as it is, anything else in mm."""
    ratio, offset = getattr(obj, f"CutRatio{k}"), getattr(obj, f"CutOffset{k}").Value
    by = getattr(obj, f"CutBy{k}")
    if by == "place" and ratio and not offset:
        return per_cent(ratio)
    if by == "place" and not offset:
        return getattr(obj, f"Cut{k}").Value
    place, is_ratio = cut_of(obj, k, axis_object.value(obj.Axis))
    return per_cent(place) if is_ratio else plain(place)


def _splits(obj, plates) -> list[dict]:
    rows = []
    faces = [
        name.removeprefix("Joints").lower()
        for name in plates.PropertiesList
        if name.startswith("Joints") and name != "Joints"
    ]
    for face in faces:
        row = {"member": obj.Label, "face": face}
        for column, automatic in (("joints", "AutoJoints"), ("lanes", "AutoLanes")):
            values = getattr(plates, f"{column.capitalize()}{face.capitalize()}", ())
            if face in getattr(plates, automatic, ()):
                row[column] = "auto"
            elif values:
                row[column] = _cell([float(value) for value in values])
        if len(row) > 2:
            rows.append(row)
    return rows
