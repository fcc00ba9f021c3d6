# SPDX-License-Identifier: LGPL-2.1-or-later
"""What two documents say in other words and is the same: axes by rule or by the curve of it, cuts
by a crossing or by its place, thicknesses of all plates or of each."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.memo import content_hash
from BendTorsionWB.document_objects import kind_of, objects_of
from BendTorsionWB.exchange.difference import Change
from BendTorsionWB.objects import axis as axis_object
from BendTorsionWB.objects import section_spec
from BendTorsionWB.objects.member import cut_of

AXIS_FORMS = ("Rule", "Source", "Points", "Order", "Direction", "Reversed", "Closed")
"""How properties begin that say what curve an axis is."""
CUT_FORMS = ("Cut", "CutBy", "CutAxis", "CutPoint", "CutOffset", "CutRatio")
"""Properties that say where a segment begins, but for its number."""
SECTION_FORMS = ("Thickness", "PolygonThicknesses", "CornerJoint")
"""How properties begin that say how thick plates are and how they meet."""
STATIONS = 101
BROUGHT = ("AssemblyBed", "SheetSet", "ArrangementSet", "NodeSheets")
"""Kinds of objects that a schedule brings for every member, and for all together."""
SAME_PLACE = 1e-6
"""mm, within which two curves or places are the same."""


def without_other_forms(changes: Sequence[Change], before, after) -> tuple[Change, ...]:
    """The changes from one document to another but for those that only say the same in another
    form, shapes that are there for such an axis alone, and beds and sheets that a schedule brings
    to what was made without any and without a schedule."""
    objects = [_by_name(document) for document in (before, after)]
    forms: dict[tuple[str, str, str], set[str]] = {}
    for change in changes:
        form = _form_of(change)
        if form is not None:
            forms.setdefault(form, set()).add(change.property)
    equal = {
        form
        for form, properties in forms.items()
        if _equal(form, properties, *(own.get(form[:2]) for own in objects))
    }
    axes = {name for kind, name, _ in equal if kind == "Axis"}
    brought = {kind for own in objects for kind in _brought(own)}
    return tuple(
        change
        for change in changes
        if _form_of(change) not in equal
        and not _serves(change, axes, objects)
        and not (change.kind in brought and change.what in ("added", "removed"))
        and not ("AssemblyBed" in brought and _shows_bed(change))
    )


def equal_sections(one, other) -> set[str]:
    """Labels of the sections that are the same though their properties may not be: thicknesses of
    all plates or of each, joints automatic or named."""
    sections = [
        {
            obj.Label: content_hash(section_spec.value(obj))
            for (kind, _), obj in objects_of(document).items()
            if kind == "SectionSpec"
        }
        for document in (one, other)
    ]
    return {name for name, value in sections[0].items() if sections[1].get(name) == value}


def _by_name(document) -> dict[tuple[str, str], object]:
    """Our objects by kind and label, and by kind and row."""
    found = objects_of(document)
    return {(kind_of(obj), obj.Label): obj for obj in found.values()} | found


def _form_of(change: Change) -> tuple[str, str, str] | None:
    """Kind and name of what a change may say in another form, and the segment of a cut; None of
    all other changes."""
    if change.what != "changed":
        return None
    if change.kind == "Axis" and change.property.startswith(AXIS_FORMS):
        return change.kind, change.name, ""
    plain = change.property.rstrip("0123456789")
    if change.kind == "Member" and plain in CUT_FORMS:
        return change.kind, change.name, change.property.removeprefix(plain)
    if change.kind == "SectionSpec" and change.property.startswith(SECTION_FORMS):
        return change.kind, change.name, ""
    return None


def _equal(form: tuple[str, str, str], properties: set[str], one, other) -> bool:
    """Whether two objects are the same in this; what cannot be computed is not."""
    # Points that moved are a change, however little.
    if one is None or other is None or properties == {"Points"}:
        return False
    compare: Mapping[str, Callable] = {
        "Axis": _same_curve,
        "Member": lambda one, other: _same_cut(one, other, int(form[2])),
        "SectionSpec": lambda *own: len({content_hash(section_spec.value(o)) for o in own}) == 1,
    }
    try:
        return compare[form[0]](one, other)
    except BendTorsionError:
        return False


def _same_curve(one, other) -> bool:
    axes = [axis_object.value(obj) for obj in (one, other)]
    ratios = np.linspace(0.0, 1.0, STATIONS)
    apart = np.subtract(*(axis.position(ratios * axis.length) for axis in axes))
    return (
        axes[0].closed == axes[1].closed
        and abs(axes[0].length - axes[1].length) <= SAME_PLACE
        and float(np.abs(apart).max()) <= SAME_PLACE
    )


def _same_cut(one, other, segment: int) -> bool:
    places = [cut_of(obj, segment, axis_object.value(obj.Axis)) for obj in (one, other)]
    # A share of the length and a place in mm are the same on this axis only.
    return places[0][1] == places[1][1] and abs(places[0][0] - places[1][0]) <= SAME_PLACE


def _serves(change: Change, axes: set[str], objects: Sequence[Mapping]) -> bool:
    """Whether a change is a shape that came or went for these axes alone."""
    if change.kind != "File" or change.what not in ("added", "removed"):
        return False
    obj = objects[change.what == "added"].get(("File", change.name))
    users = {user.Label for user in obj.InList} if obj is not None else set()
    return bool(users) and users <= axes


def _brought(objects: Mapping[tuple[str, str], object]) -> set[str]:
    """What there is none of in a document that no schedule made."""
    if any(getattr(obj, "FromSchedule", "") for obj in objects.values()):
        return set()
    return {*BROUGHT} - {kind for kind, _ in objects}


def _shows_bed(change: Change) -> bool:
    return (change.kind, change.property) == ("SheetSet", "Bed")
