# SPDX-License-Identifier: LGPL-2.1-or-later
"""The properties of an Axis object."""

from __future__ import annotations

from BendTorsionWB.core import tolerances
from BendTorsionWB.core.axes import frames
from BendTorsionWB.core.axes.axis import FITS
from BendTorsionWB.core.axes.axis_input import DIRECTIONS, ORDERS
from BendTorsionWB.objects.proxy import Property
from BendTorsionWB.shapes import axis_source

RULES = ("none", "plane section", "iso-curve", "geodesic")
SHOWN = ("wire", "control points", "curvature comb", "frame ribbon")
_LENGTH = "App::PropertyLength"
_DISTANCE = "App::PropertyDistance"
_ANGLE = "App::PropertyAngle"
_BOOL = "App::PropertyBool"
_NUMBERS = "App::PropertyFloatList"
_CHOICE = "App::PropertyEnumeration"
_VECTOR = "App::PropertyVector"

PROPERTIES = (
    Property("App::PropertyLink", "Surface", "Axis", "The surface that turns the sections"),
    Property(
        "App::PropertyVectorList",
        "Points",
        "Axis",
        "Points, mm; used when nothing is picked and no rule is set",
    ),
    Property("App::PropertyLinkSub", "Source", "Axis", "A picked curve, wire or shape"),
    Property(
        "App::PropertyLinkSubList",
        "Sources",
        "Axis",
        "Several picked edges, wires, sketches or points, in any order",
    ),
    Property(
        _CHOICE,
        "SourceUse",
        "Axis",
        "What is picked is an exact curve, which the axis keeps to, or points to fit through; "
        "automatic: polylines are points",
        "automatic",
        axis_source.USES,
    ),
    Property(
        _CHOICE,
        "Order",
        "Axis",
        "Points in the order given, or chained from neighbour to neighbour",
        "given",
        ORDERS,
    ),
    Property(_BOOL, "Closed", "Axis", "Points form a ring", False),
    Property(
        _CHOICE,
        "Direction",
        "Axis",
        "Direction as given, or by rule: low end to high, else along +x",
        "given",
        DIRECTIONS,
    ),
    Property(_BOOL, "Reversed", "Axis", "Turn the direction; points keep their numbers", False),
    Property(_CHOICE, "Rule", "Rule", "A curve of the surface instead of points", "none", RULES),
    Property(_VECTOR, "RuleStart", "Rule", "Near the start (plane section, geodesic), mm"),
    Property(_VECTOR, "RuleEnd", "Rule", "Near the end (plane section, geodesic), mm"),
    Property(_VECTOR, "RuleOrigin", "Rule", "A point of the plane (plane section), mm"),
    Property(_VECTOR, "RuleNormal", "Rule", "The plane's normal (plane section)", (0.0, 1.0, 0.0)),
    Property(_CHOICE, "RuleHeld", "Rule", "The parameter held (iso-curve)", "u", ("u", "v")),
    Property(
        "App::PropertyFloat",
        "RuleAt",
        "Rule",
        "Where it is held, as a part of its range (iso-curve)",
        0.5,
    ),
    Property(
        "App::PropertyFloat",
        "RuleFirst",
        "Rule",
        "Where the curve starts, as a part of the other range (iso-curve)",
        0.0,
    ),
    Property(
        "App::PropertyFloat",
        "RuleLast",
        "Rule",
        "Where the curve ends, as a part of the other range (iso-curve)",
        1.0,
    ),
    Property(
        "App::PropertyInteger",
        "RulePatch",
        "Rule",
        "Face of the surface, counted from 0 (iso-curve)",
        0,
    ),
    Property(
        _CHOICE,
        "Fit",
        "Fit",
        "Of points: pull brings the axis onto the surface, keep leaves it on them, offset holds it "
        "at a distance; an axis from a curve keeps to the curve",
        "pull",
        FITS,
    ),
    Property(_DISTANCE, "Distance", "Fit", "Distance from the surface, for fit offset", 0.0),
    Property(
        _BOOL,
        "DistanceFromPoints",
        "Fit",
        "Take the distance as the points' mean distance, for fit offset",
        False,
    ),
    Property(
        _LENGTH,
        "Tolerance",
        "Fit",
        "A pulled axis leaves the surface by no more than this",
        tolerances.AXIS_ON_SURFACE,
    ),
    Property(_LENGTH, "MaxSpacing", "Fit", "Largest distance of control points; 0: no limit", 0.0),
    Property(
        _LENGTH,
        "ChordSag",
        "Fit",
        "Largest distance of the curve from the chord of control points; 0: no limit",
        0.0,
    ),
    Property(
        _ANGLE,
        "TangentTurn",
        "Fit",
        "Largest turn of the tangent between control points; 0: no limit",
        0.0,
    ),
    Property(
        _ANGLE,
        "TwistStep",
        "Fit",
        "Largest turn of the normal about the axis between control points; 0: no limit",
        0.0,
    ),
    Property(_BOOL, "UseStartZ", "Ends", "Bring the start to the height StartZ", False),
    Property(_DISTANCE, "StartZ", "Ends", "Height of the start", 0.0),
    Property(_DISTANCE, "StartDz", "Ends", "Raise the start by this, along the axis", 0.0),
    Property(
        _DISTANCE,
        "StartExtension",
        "Ends",
        "Run the start on along the axis; negative trims it",
        0.0,
    ),
    Property(_BOOL, "UseEndZ", "Ends", "Bring the end to the height EndZ", False),
    Property(_DISTANCE, "EndZ", "Ends", "Height of the end", 0.0),
    Property(_DISTANCE, "EndDz", "Ends", "Raise the end by this, along the axis", 0.0),
    Property(
        _DISTANCE,
        "EndExtension",
        "Ends",
        "Run the end on along the axis; negative trims it",
        0.0,
    ),
    Property(
        _CHOICE,
        "Frame",
        "Frame",
        "Where the section's height points: surface, its normal; minimal, never turning "
        "about the axis; fixed, one direction; given, by the table",
        "surface",
        frames.FRAMES,
    ),
    Property(
        _VECTOR,
        "FixedDirection",
        "Frame",
        "Direction of the height, for frame fixed",
        (0.0, 0.0, 1.0),
    ),
    Property(
        _NUMBERS,
        "GivenPlaces",
        "Frame",
        "Frame given: places along the axis, ratios up to 1 or mm",
    ),
    Property(
        _NUMBERS,
        "GivenAngles",
        "Frame",
        "Frame given: angle in degrees against the minimal frame, one per place",
    ),
    Property(
        "App::PropertyVectorList",
        "GivenDirections",
        "Frame",
        "Frame given: direction of the height, one per place, instead of angles",
    ),
    Property(_ANGLE, "Roll", "Frame", "Turn of the frame about the axis", 0.0),
    Property(
        _NUMBERS,
        "TwistPlaces",
        "Frame",
        "Extra twist: places along the axis, ratios up to 1 or mm",
    ),
    Property(
        _NUMBERS,
        "TwistAngles",
        "Frame",
        "Extra twist: angle in degrees, one per place, smooth between",
    ),
    Property(
        _NUMBERS,
        "PresetPlaces",
        "Preset",
        "Camber or erection preset: places, ratios up to 1 or mm",
    ),
    Property(
        "App::PropertyVectorList",
        "PresetMoves",
        "Preset",
        "Camber or erection preset: displacement in x, y, z, mm, one per place",
    ),
    Property(
        "App::PropertyLinkList",
        "CrossingAxes",
        "Axis",
        "Axes whose crossings with this one are wanted as control points",
    ),
    Property(_CHOICE, "Show", "Display", "What the axis shows beside its line", "wire", SHOWN),
    Property(
        "App::PropertyFloat",
        "ShowScale",
        "Display",
        "Scale of the comb (mm2) or height of the ribbon (mm); 0: to suit",
        0.0,
    ),
    Property(_LENGTH, "Length", "Result", "Length of the axis", output=True),
    Property(
        _NUMBERS,
        "CrossingPlaces",
        "Result",
        "Where CrossingAxes cross, in their order: mm from the start",
        output=True,
    ),
    Property(
        "App::PropertyVectorList",
        "CrossingPoints",
        "Result",
        "The points of this axis at CrossingPlaces",
        output=True,
    ),
    Property(
        _LENGTH,
        "SurfaceDistanceRMS",
        "Result",
        "Root mean square distance of the axis to its surface",
        output=True,
    ),
    Property(
        _LENGTH,
        "SurfaceDistanceMax",
        "Result",
        "Largest distance of the axis to its surface",
        output=True,
    ),
    Property(
        _LENGTH,
        "InSurfaceUncertainty",
        "Result",
        "What the points leave open: largest distance of a point from the axis without it",
        output=True,
    ),
    Property(
        _LENGTH,
        "MinimumRadius",
        "Result",
        "Smallest radius of curvature; 0 for a straight axis",
        output=True,
    ),
    Property(
        "App::PropertyFloat",
        "MaximumTwist",
        "Result",
        "Largest twist of the frame, degrees per metre",
        output=True,
    ),
    Property(_ANGLE, "TotalTorsion", "Result", "Torsion angle from start to end", output=True),
    Property(
        "App::PropertyInteger",
        "Windings",
        "Result",
        "Whole turns of the frame once round a closed axis",
        output=True,
    ),
    Property(
        "App::PropertyVectorList",
        "ControlPoints",
        "Result",
        "Points the axis runs through",
        output=True,
    ),
    Property(
        "App::PropertyVectorList",
        "DesignControlPoints",
        "Result",
        "The same points before the preset",
        output=True,
    ),
)
