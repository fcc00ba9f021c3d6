# SPDX-License-Identifier: LGPL-2.1-or-later
"""The schedule's declared sheets, columns and settings."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from BendTorsionWB.core.drawings.sheet_style import (
    FORMATS,
    LANGUAGES,
    LENGTH_UNITS,
    PLAIN_STYLE,
    STANDARDS,
)
from BendTorsionWB.core.members.segment import ALIGNMENTS
from BendTorsionWB.core.nodes.node_input import DIAPHRAGMS, TYPES
from BendTorsionWB.core.patterns.flattened_surface import SURFACES
from BendTorsionWB.core.patterns.gross import (
    LARGEST_ALLOWANCE,
    LARGEST_GREEN,
    LARGEST_SHRINKAGE,
    SPLICES,
)
from BendTorsionWB.core.patterns.laid_flat import MARKING_FACES
from BendTorsionWB.core.patterns.pattern import MODES
from BendTorsionWB.core.site import UNITS
from BendTorsionWB.core.tolerances import NEAREST_STATIONS
from BendTorsionWB.core.welds import preps
from BendTorsionWB.core.welds.bevels import CONTOURS
from BendTorsionWB.exchange import part_cells
from BendTorsionWB.exchange.schedule_cells import (
    Choice,
    FileCell,
    Name,
    Number,
    along,
    corners,
    cut,
    joints,
    lanes,
    layer_lines,
    parameters,
    stagger,
    text,
    thicknesses,
    yes_no,
)
from BendTorsionWB.exchange.schedule_end_cuts import CUT_COLUMNS, end_cut

SECTION_TYPES = ("box1", "box2", "i", "tee", "channel", "trapezoid", "polygon", "strips")
CORNER_JOINTS = ("flanges", "webs", "mitre", "ring")
SURFACE_PARAMETERS = {
    "ellipsoid": ("a", "b", "c"),
    "sphere": ("r",),
    "cylinder": ("r",),
    "cone": ("r", "angle"),
    "torus": ("R", "r"),
    "plane": (),
}
CENTRE_PARAMETERS = ("x", "y", "z")
SURFACE_FILES = (".step", ".stp", ".iges", ".igs", ".brep", ".brp", ".3dm")


@dataclass(frozen=True)
class Column:
    """One declared column (or setting): how a cell is read, and what an empty one means."""

    name: str
    parse: Callable
    required: bool = False
    default: object = None


LENGTH = Number()
SIZE = Number(above=0.0)
NOT_NEGATIVE = Number(least=0.0)
PITCH = Number(least=100.0)
DEGREES = Number(unit="degrees", least=-360.0, most=360.0, scale=math.pi / 180.0)
COUNT = Number(unit="", least=1, whole=True)

SHRINKAGE = Number("mm/m", least=0.0, most=LARGEST_SHRINKAGE)
ALLOWANCE = Number(least=0.0, most=LARGEST_ALLOWANCE)
GREEN = Number(least=0.0, most=LARGEST_GREEN)

PATTERN_COLUMNS = (
    Column("mode", Choice(MODES)),
    Column("flattened_surface", Choice(SURFACES)),
    Column("marking_face", Choice(MARKING_FACES)),
    Column("shrinkage_along", SHRINKAGE),
    Column("shrinkage_across", SHRINKAGE),
    Column("joint_allowance", ALLOWANCE),
    Column("diaphragm_allowance", ALLOWANCE),
    Column("green_start", GREEN),
    Column("green_end", GREEN),
    Column("splice", Choice(SPLICES)),
    Column("contour", Choice(CONTOURS)),
)
"""How plates are laid flat and cut larger: of a member, or of all that leave the cell empty."""

PATTERN_DEFAULTS = ("edges", "mid", "inside", 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, "after forming", "mid")

SHEETS: dict[str, tuple[Column, ...]] = {
    "Settings": (Column("key", Name(), True), Column("value", lambda value: value)),
    "Materials": (
        Column("material", Name(), True),
        Column("density", Number("kg/m3", least=1000.0, most=25000.0), default=7850.0),
        Column("E", Number("MPa", above=0.0), default=206000.0),
        Column("fy", Number("MPa", above=0.0), True),
    ),
    "Surfaces": (
        Column("surface", Name(), True),
        Column("kind", Choice((*SURFACE_PARAMETERS, "file")), True),
        Column("file", FileCell(SURFACE_FILES)),
        Column("parameters", parameters, default={}),
        Column("offset", LENGTH, default=0.0),
        Column("flip", yes_no, default=False),
    ),
    "Points": (
        Column("axis", Name(), True),
        Column("no", COUNT, True),
        Column("x", LENGTH, True),
        Column("y", LENGTH, True),
        Column("z", LENGTH, True),
    ),
    "Axes": (
        Column("axis", Name(), True),
        Column("surface", Name(), True),
        Column("frame", Choice(("surface", "minimal", "fixed", "given")), default="surface"),
        Column("fit", Choice(("pull", "keep", "offset")), default="pull"),
        Column("source", FileCell((".dxf", *SURFACE_FILES))),
        Column("max_spacing", SIZE),
        Column("closed", yes_no, default=False),
        Column("start_z", LENGTH),
        Column("end_z", LENGTH),
        Column("start_dz", LENGTH, default=0.0),
        Column("end_dz", LENGTH, default=0.0),
        Column("start_extension", LENGTH, default=0.0),
        Column("end_extension", LENGTH, default=0.0),
    ),
    "Frames": (
        Column("axis", Name(), True),
        Column("s", along, True),
        Column("angle", DEGREES),
        Column("x", LENGTH),
        Column("y", LENGTH),
        Column("z", LENGTH),
    ),
    "Presets": (
        Column("axis", Name(), True),
        Column("s", along, True),
        Column("dx", LENGTH, default=0.0),
        Column("dy", LENGTH, default=0.0),
        Column("dz", LENGTH, default=0.0),
    ),
    "Sections": (
        Column("section", Name(), True),
        Column("type", Choice(SECTION_TYPES)),
        Column("catalogue", Name()),
        Column("h", SIZE),
        Column("b", SIZE),
        Column("b_bottom", SIZE),
        Column("t", SIZE),
        Column("t_top", SIZE),
        Column("t_bottom", SIZE),
        Column("t_web", SIZE),
        Column("gap1", NOT_NEGATIVE),
        Column("gap2", NOT_NEGATIVE),
        Column("corner_joint", Choice(CORNER_JOINTS)),
        Column("corners", corners),
        Column("thicknesses", thicknesses),
        Column("material", Name()),
    ),
    "Strips": (
        Column("section", Name(), True),
        Column("face", Name(), True),
        Column("letter", Name(names_files=True), True),
        Column("y1", LENGTH, True),
        Column("z1", LENGTH, True),
        Column("y2", LENGTH, True),
        Column("z2", LENGTH, True),
        Column("t", SIZE, True),
        Column("side", Choice(("left", "right", "middle")), default="middle"),
        Column("stop1", text, default=""),
        Column("stop2", text, default=""),
    ),
    "Members": (
        Column("member", Name(names_files=True), True),
        Column("segment", COUNT, True),
        Column("axis", Name()),
        Column("section", Name(), True),
        Column("cut", cut),
        Column("slope", Number("", least=0.0)),
        Column("transition", Choice(("linear", "smooth")), default="linear"),
        Column("stagger", stagger, default="auto"),
        Column("align", Choice(ALIGNMENTS), default="centre"),
        Column("align_to", Choice(("axis", "previous", "surface")), default="axis"),
        Column("offset_y", LENGTH, default=0.0),
        Column("offset_z", LENGTH, default=0.0),
        Column("member_offset_y", LENGTH, default=0.0),
        Column("member_offset_z", LENGTH, default=0.0),
        Column("roll", DEGREES, default=0.0),
        Column("rank", Number("", whole=True)),
        Column("start_cut", end_cut),
        Column("end_cut", end_cut),
        *PATTERN_COLUMNS,
    ),
    "Nodes": (
        Column("node", Name()),
        Column("through", Name(), True),
        Column("other", Name(), True),
        Column("s", along),
        Column("type", Choice(TYPES), default="direct"),
        Column("gap", NOT_NEGATIVE),
        Column("stub_length", NOT_NEGATIVE, default=0.0),
        Column("diaphragms", Choice(DIAPHRAGMS), default="flanges"),
        Column("blend", yes_no, default=False),
    ),
    "Splits": (
        Column("member", Name(), True),
        Column("face", Name(), True),
        Column("joints", joints),
        Column("lanes", lanes),
    ),
    "Diaphragms": (
        Column("member", Name(), True),
        Column("s", part_cells.place_or_end, True),
        Column("t", SIZE, True),
        Column("gap", LENGTH, default=0.0),
        Column("snipe", NOT_NEGATIVE, default=0.0),
        Column("manhole", part_cells.manhole),
        Column("closing_face", part_cells.closing),
        Column("material", Name()),
    ),
    "Openings": (
        Column("member", Name(), True),
        Column("face", Name(), True),
        Column("s", part_cells.place, True),
        Column("offset", LENGTH, default=0.0),
        Column("shape", part_cells.shape, True),
        Column("rotation", Number("degrees", least=-360.0, most=360.0), default=0.0),
    ),
    "Marks": (
        Column("member", Name(), True),
        Column("face", Name(), True),
        Column("s", part_cells.place, True),
        Column("offset", LENGTH, default=0.0),
        Column("text", part_cells.mark, True),
    ),
    "Pieces": (
        Column("member", Name(), True),
        Column("piece", COUNT, True),
        Column("from", part_cells.place),
        Column("to", part_cells.place),
        Column("start_end", part_cells.piece_end),
        Column("end_end", part_cells.piece_end),
        Column("green_start", NOT_NEGATIVE, default=0.0),
        Column("green_end", NOT_NEGATIVE, default=0.0),
        Column("gap", NOT_NEGATIVE, default=0.0),
    ),
    "Preps": (
        Column("prep", Name(), True),
        Column("type", Choice(preps.TYPES), True),
        Column("angle", Number("degrees", least=0.0, most=150.0), default=0.0),
        Column("land", NOT_NEGATIVE, default=0.0),
        Column("gap", NOT_NEGATIVE, default=0.0),
        Column("side", Choice(preps.SIDES), default="outer"),
        Column("backing", part_cells.backing),
        Column("leg", NOT_NEGATIVE, default=0.0),
    ),
    "Edges": (
        Column("member", Name(), True),
        Column("seam", Name(), True),
        Column("from", part_cells.place),
        Column("to", part_cells.place),
        Column("prep", text),
        Column("place", Choice(preps.PLACES)),
        Column("ndt", text),
    ),
    "Status": (
        Column("plate", Name(), True),
        Column("status", Choice(("cut", "trim", "scrap")), True),
    ),
}
PART_SHEETS = ("Diaphragms", "Openings", "Marks", "Pieces", "Edges")
OPTIONAL_SHEETS = (
    *("Settings", "Materials", "Frames", "Presets", "Strips", "Splits", "Nodes", "Status"),
    "Preps",
    *PART_SHEETS,
)
FIRST_SEGMENT_COLUMNS = (
    "member_offset_y",
    "member_offset_z",
    "roll",
    "rank",
    *CUT_COLUMNS,
    *(column.name for column in PATTERN_COLUMNS),
)


def _with_default(column: Column, default: object) -> Column:
    return replace(column, default=default)


_OF_NUMBERS = (
    *(along, corners, cut, end_cut, joints, lanes, parameters, thicknesses),
    *(part_cells.place, part_cells.place_or_end),
)


def reads_numbers(column: Column) -> bool:
    """Whether the cells of a column or setting are numbers, or hold some."""
    return isinstance(column.parse, Number) or column.parse in _OF_NUMBERS


SETTINGS = {
    setting.name: setting
    for setting in (
        *map(_with_default, PATTERN_COLUMNS, PATTERN_DEFAULTS),
        Column("project", text, default=""),
        Column("author", text, default=""),
        Column("station_spacing", Number(least=NEAREST_STATIONS), default=500.0),
        Column("default_slope", Number("", least=0.0), default=2.5),
        Column("transition_length", Choice(("face", "total")), default="face"),
        Column("axis_tolerance", SIZE, default=0.005),
        Column("default_material", Name(), default="S355"),
        Column("bed_face", text, default="auto"),
        Column("bed_plane", Choice(("fit", "middle")), default="fit"),
        Column("bed_spacing", PITCH, default=2000.0),
        Column("bed_height", NOT_NEGATIVE, default=700.0),
        Column("pin_pitch", PITCH),
        Column("lowest_pin", NOT_NEGATIVE, default=250.0),
        Column("template_pitch", PITCH, default=3500.0),
        Column("template_clearance", LENGTH, default=0.0),
        Column("site_x", LENGTH, default=0.0),
        Column("site_y", LENGTH, default=0.0),
        Column("site_z", LENGTH, default=0.0),
        Column("site_rotation", DEGREES, default=0.0),
        Column("site_unit", Choice(tuple(UNITS)), default="mm"),
        Column("sheet_format", Choice(tuple(FORMATS)), default=PLAIN_STYLE.format),
        Column("sheet_standard", Choice(STANDARDS), default=PLAIN_STYLE.standard),
        Column("sheet_language", Choice(LANGUAGES), default=PLAIN_STYLE.language),
        Column("sheet_unit", Choice(LENGTH_UNITS), default=PLAIN_STYLE.unit),
        Column("stock", part_cells.stock, default=""),
        Column("layer_names", layer_lines, default=""),
        Column("rule_pack", Choice(("CN", "EU", "US")), default="CN"),
    )
}
