# SPDX-License-Identifier: LGPL-2.1-or-later
"""The schedule's declared sheets, columns and settings."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from BendTorsionWB.exchange.schedule_cells import (
    Choice,
    FileCell,
    Name,
    Number,
    along,
    cut,
    joints,
    parameters,
    text,
    yes_no,
)

FACES = ("top", "bottom", "left", "right")
ALIGNMENTS = (
    "centre",
    "top",
    "bottom",
    "left",
    "right",
    "top-left",
    "top-right",
    "bottom-left",
    "bottom-right",
)
SURFACE_PARAMETERS = {
    "ellipsoid": ("a", "b", "c"),
    "sphere": ("r",),
    "cylinder": ("r",),
    "cone": ("r", "angle"),
    "torus": ("R", "r"),
    "plane": (),
}
CENTRE_PARAMETERS = ("x", "y", "z")
SURFACE_FILES = (".step", ".stp", ".iges", ".igs", ".brep", ".brp")


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
DEGREES = Number(unit="degrees", least=-360.0, most=360.0, scale=math.pi / 180.0)
COUNT = Number(unit="", least=1, whole=True)

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
        Column("type", Choice(("box1", "box2"), open_ended=True), True),
        Column("h", SIZE, True),
        Column("b", SIZE, True),
        Column("t", SIZE),
        Column("t_top", SIZE),
        Column("t_bottom", SIZE),
        Column("t_web", SIZE),
        Column("gap1", NOT_NEGATIVE, default=0.0),
        Column("gap2", NOT_NEGATIVE, default=0.0),
        Column("material", Name()),
    ),
    "Members": (
        Column("member", Name(names_files=True), True),
        Column("segment", COUNT, True),
        Column("axis", Name()),
        Column("section", Name(), True),
        Column("cut", cut),
        Column("slope", Number("", least=0.0)),
        Column("align", Choice(ALIGNMENTS), default="centre"),
        Column("align_to", Choice(("axis", "previous")), default="axis"),
        Column("offset_y", LENGTH, default=0.0),
        Column("offset_z", LENGTH, default=0.0),
        Column("member_offset_y", LENGTH, default=0.0),
        Column("member_offset_z", LENGTH, default=0.0),
        Column("roll", DEGREES, default=0.0),
        Column("rank", Number("", whole=True)),
    ),
    "Splits": (
        Column("member", Name(), True),
        Column("face", Choice(FACES), True),
        Column("joints", joints, True),
    ),
}
OPTIONAL_SHEETS = ("Settings", "Materials", "Frames", "Presets", "Splits")
LATER_SHEETS = ("Pieces", "Preps", "Edges", "Diaphragms", "Nodes", "Openings", "Marks")
FIRST_SEGMENT_COLUMNS = ("member_offset_y", "member_offset_z", "roll", "rank")

SETTINGS = {
    setting.name: setting
    for setting in (
        Column("project", text, default=""),
        Column("author", text, default=""),
        Column("station_spacing", SIZE, default=500.0),
        Column("default_slope", Number("", least=0.0), default=2.5),
        Column("transition_length", Choice(("face", "total")), default="face"),
        Column("axis_tolerance", SIZE, default=0.005),
        Column("default_material", Name(), default="S355"),
        Column("rule_pack", Choice(("CN", "EU", "US")), default="CN"),
    )
}
