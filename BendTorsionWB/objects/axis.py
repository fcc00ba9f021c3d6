# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object Axis: the line a member follows, and the frame that turns its sections."""

from __future__ import annotations

import math

import numpy as np
import Part

from BendTorsionWB.core import detailing
from BendTorsionWB.core.axes import axis as core_axis
from BendTorsionWB.core.axes import frames
from BendTorsionWB.core.axes.axis_ends import AxisEnd
from BendTorsionWB.core.axes.axis_fit import Refinement
from BendTorsionWB.core.axes.axis_input import AxisInput
from BendTorsionWB.core.axes.axis_iso import IsoCurve
from BendTorsionWB.core.axes.axis_places import crossings
from BendTorsionWB.core.axes.axis_preset import Preset
from BendTorsionWB.core.axes.axis_rule import Geodesic, PlaneSection
from BendTorsionWB.core.axes.frames_law import GivenDirection
from BendTorsionWB.core.axes.surface_check import surface_findings
from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.objects import surface as surface_object
from BendTorsionWB.objects.axis_properties import PROPERTIES
from BendTorsionWB.objects.proxy import Proxy, check_linked, linked, type_of
from BendTorsionWB.shapes import axis_source, curve_shape, frame_shape

TWIST_STATIONS = 401


class Axis(Proxy):
    """The line a member follows."""

    TYPE = "Axis"
    PROPERTIES = PROPERTIES

    def build(self, obj):
        given, surface = axis_input(obj), surface_value(obj)
        axis = detailing.axis_of(given, surface)
        frame = frame_value(obj)
        findings = (*axis.findings, *surface_findings(surface, axis, frame.kind == "surface"))
        framed = frames.frames_of(axis, surface, frame)
        obj.Shape = _shape(obj, axis, framed)
        obj.Length = axis.length
        obj.CrossingPlaces, obj.CrossingPoints = _crossings(obj, axis)
        obj.SurfaceDistanceRMS, obj.SurfaceDistanceMax = axis.distance_to(surface)
        obj.InSurfaceUncertainty = detailing.uncertainty_of(given, surface).largest
        radius = axis.least_radius[0]
        obj.MinimumRadius = radius if math.isfinite(radius) else 0.0
        twist = framed.at(np.linspace(0.0, axis.length, TWIST_STATIONS)).twist
        obj.MaximumTwist = float(np.degrees(np.abs(twist).max() * 1000.0))
        obj.TotalTorsion = float(np.degrees(frames.torsion_angle(framed)[1][-1]))
        obj.Windings = frames.winding_number(framed)
        obj.ControlPoints = [tuple(map(float, point)) for point in axis.control]
        obj.DesignControlPoints = [tuple(map(float, point)) for point in axis.control_design]
        return findings


def _crossings(obj, axis: core_axis.Axis) -> tuple[list[float], list[tuple]]:
    """Places and points of this axis where the axes in CrossingAxes cross it."""
    found = []
    for other in obj.CrossingAxes:
        if type_of(other) != "Axis":
            raise BendTorsionError(
                error(
                    "link-kind",
                    obj.Label,
                    f"{other.Label} is not an Axis",
                    "take it out of CrossingAxes",
                    position="property CrossingAxes",
                )
            )
        check_linked(other)
        found += crossings(axis, value(other))
    return [c.first for c in found], [tuple(map(float, c.first_point)) for c in found]


def value(obj) -> core_axis.Axis:
    """The core axis of an Axis object; raises BendTorsionError for what it cannot be."""
    return detailing.axis_of(axis_input(obj), surface_value(obj))


def surface_value(obj):
    """The core surface of the Surface an Axis object links to."""
    return surface_object.value(linked(obj, "Surface", "Surface"))


def axis_input(obj) -> AxisInput:
    """What the axis is made from; raises BendTorsionError for properties that do not fit."""
    made_from = _made_from(obj)
    return AxisInput(
        obj.Label,
        fit=obj.Fit,
        tolerance=obj.Tolerance.Value,
        max_spacing=obj.MaxSpacing.Value or None,
        order=obj.Order,
        closed=made_from.pop("closed", False) or obj.Closed,
        direction=obj.Direction,
        reversed=obj.Reversed,
        offset=None if obj.DistanceFromPoints or obj.Fit != "offset" else obj.Distance.Value,
        refinement=Refinement(
            chord_sag=obj.ChordSag.Value or None,
            tangent_turn=math.radians(obj.TangentTurn.Value) or None,
            twist_step=math.radians(obj.TwistStep.Value) or None,
        ),
        start=AxisEnd(
            obj.StartZ.Value if obj.UseStartZ else None, obj.StartDz.Value, obj.StartExtension.Value
        ),
        end=AxisEnd(
            obj.EndZ.Value if obj.UseEndZ else None, obj.EndDz.Value, obj.EndExtension.Value
        ),
        preset=_preset(obj),
        **made_from,
    )


def frame_value(obj) -> frames.FrameInput:
    """The frame of an Axis object; raises BendTorsionError for tables that do not fit."""
    given = ()
    if obj.Frame == "given":
        directions = [tuple(map(float, vector)) for vector in obj.GivenDirections]
        rows = directions or [math.radians(angle) for angle in obj.GivenAngles]
        given = _stations(obj, "Given", obj.GivenPlaces, rows, bool(directions))
    twist = _stations(
        obj, "Twist", obj.TwistPlaces, [math.radians(angle) for angle in obj.TwistAngles], False
    )
    return frames.FrameInput(
        obj.Frame, math.radians(obj.Roll.Value), tuple(map(float, obj.FixedDirection)), given, twist
    )


def _made_from(obj) -> dict:
    """The points, segments, curve or rule of an axis."""
    if obj.Rule != "none":
        return {"rule": _rule(obj)}
    picked = [obj.Source] if obj.Source is not None else []
    picked += list(obj.Sources)
    if not picked and not obj.Points:
        raise BendTorsionError(
            error(
                "link-missing",
                obj.Label,
                "the axis has no curve and no points",
                "undo what deleted its curve, choose another as Source, or give points",
                position="property Source",
            )
        )
    if not picked:
        return {"points": np.array([tuple(point) for point in obj.Points], float).reshape(-1, 3)}
    shapes = [surface_object.picked_shape(obj, source, "curve") for source in picked]
    shape = shapes[0] if len(shapes) == 1 else Part.Compound(shapes)
    return axis_source.source_fields(shape, obj.SourceUse, obj.Label)


def _rule(obj):
    start, end, origin, normal = (
        tuple(map(float, getattr(obj, name)))
        for name in ("RuleStart", "RuleEnd", "RuleOrigin", "RuleNormal")
    )
    if obj.Rule == "plane section":
        return PlaneSection(origin, normal, start, None if obj.Closed else end, obj.Closed)
    if obj.Rule == "iso-curve":
        return IsoCurve(obj.RuleHeld, obj.RuleAt, obj.RuleFirst, obj.RuleLast, obj.RulePatch)
    return Geodesic(start, end)


def _preset(obj) -> Preset | None:
    places, moves = list(obj.PresetPlaces), [tuple(move) for move in obj.PresetMoves]
    _same_count(obj, "Preset", places, moves)
    if not places:
        return None
    by = "ratio" if max(places) <= 1.0 else "length"
    return Preset(np.array(places, float), np.array(moves, float), by)


def _stations(obj, table: str, places, rows, directions: bool) -> tuple[GivenDirection, ...]:
    places = list(places)
    _same_count(obj, table, places, rows)
    is_ratio = bool(places) and max(places) <= 1.0
    return tuple(
        GivenDirection(
            float(place), None if directions else row, row if directions else None, is_ratio
        )
        for place, row in zip(places, rows, strict=True)
    )


def _same_count(obj, table: str, places, rows) -> None:
    if len(places) != len(rows):
        raise BendTorsionError(
            error(
                "table-length",
                obj.Label,
                f"{table}Places and its values differ in number",
                "give one value for each place",
                position=f"property {table}Places",
                value=len(places),
                limit=len(rows),
            )
        )


def _shape(obj, axis: core_axis.Axis, framed: frames.Frames) -> Part.Shape:
    wire = curve_shape.edge(axis.curve)
    if obj.Show == "control points":
        return Part.Compound([wire, *frame_shape.points(axis.control)])
    if obj.Show == "curvature comb":
        return Part.Compound([wire, *frame_shape.comb(axis, obj.ShowScale)])
    if obj.Show == "frame ribbon":
        return Part.Compound([wire, *frame_shape.ribbon(framed, obj.ShowScale)])
    return wire
