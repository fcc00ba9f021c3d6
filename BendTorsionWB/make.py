# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scripting API: functions that make the document objects, with or without a window.

Each returns the new object, not yet recomputed: call `document.recompute()`, then read `Status`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import FreeCAD

from BendTorsionWB.objects import axis as axis_object
from BendTorsionWB.objects import member as member_object
from BendTorsionWB.objects import plate_set as plates_object
from BendTorsionWB.objects import section_spec as section_object
from BendTorsionWB.objects import sheet as sheet_object
from BendTorsionWB.objects import surface as surface_object
from BendTorsionWB.objects import unfold as unfold_object


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
    face=(object, 'Face1')."""
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
    fit: str = "pull",
    tolerance: float | None = None,
    max_spacing: float = 0.0,
):
    """An Axis through ordered points (mm), or along edge=(object, 'Edge1') as it is."""
    obj = _new(document, "Part::FeaturePython", name, axis_object.Axis)
    obj.Surface = surface
    if edge is not None:
        obj.Source = _sub(edge)
    obj.Points = [FreeCAD.Vector(*point) for point in points]
    obj.Fit, obj.MaxSpacing = fit, max_spacing
    if tolerance is not None:
        obj.Tolerance = tolerance
    return obj


def make_section(document, name: str = "Section", type: str = "box1", **sizes):
    """A SectionSpec; sizes h, b, t, t_top, t_bottom, t_web, gap1, gap2 in mm, and Material,
    Density (kg/m3), E and fy ('355 MPa')."""
    obj = _new(document, "Part::FeaturePython", name, section_object.SectionSpec)
    obj.Type = type
    for size, value in sizes.items():
        setattr(obj, size, value)
    return obj


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
):
    """A Member along an axis with one section per segment.

    segments: one mapping per segment with any of cut (mm), cut_ratio, slope, align, align_to,
    offset_y, offset_z. roll in degrees.
    """
    obj = _new(document, "Part::FeaturePython", name, member_object.Member)
    obj.Axis, obj.Segments = axis, len(sections)
    obj.OffsetY, obj.OffsetZ, obj.Roll = offset_y, offset_z, roll
    obj.TransitionLength, obj.Rank = transition_length, rank
    names = {
        "cut": "Cut", "cut_ratio": "CutRatio", "slope": "Slope", "align": "Align",
        "align_to": "AlignTo", "offset_y": "OffsetY", "offset_z": "OffsetZ",
    }
    for k, section in enumerate(sections, start=1):
        setattr(obj, f"Section{k}", section)
        for key, value in (segments[k - 1] if k <= len(segments) else {}).items():
            setattr(obj, f"{names[key]}{k}", value)
    return obj


def make_plates(
    document,
    member,
    joints: Mapping[str, Sequence[float]] | None = None,
    *,
    station_spacing: float = 500.0,
    rule_pack: str = "CN",
):
    """The PlateSet of a member; joints: face -> cumulative ratios (up to 1) or mm."""
    obj = _new(document, "Part::FeaturePython", f"{member.Label} plates", plates_object.PlateSet)
    obj.Member = member
    for face, values in (joints or {}).items():
        setattr(obj, f"Joints{face.capitalize()}", [float(value) for value in values])
    obj.StationSpacing, obj.RulePack = station_spacing, rule_pack
    return obj


def make_unfold(document, plates):
    """The Unfold of a PlateSet: its flat patterns."""
    name = f"{plates.Member.Label} patterns" if plates.Member else "Patterns"
    obj = _new(document, "Part::FeaturePython", name, unfold_object.Unfold)
    obj.Plates = plates
    return obj


def make_sheets(document, unfold, project: str = ""):
    """The drawing sheets of a member; their pages are made and kept by recompute."""
    name = unfold.Label.replace("patterns", "sheets")
    obj = _new(document, "App::FeaturePython", name, sheet_object.SheetSet)
    obj.Unfold, obj.Project = unfold, project
    return obj


def _new(document, kind: str, label: str, proxy):
    obj = document.addObject(kind, proxy.TYPE)
    obj.Label = label
    proxy(obj)
    return obj


def _sub(picked: tuple) -> tuple:
    target, names = picked
    return target, [names] if isinstance(names, str) else list(names)
