# SPDX-License-Identifier: LGPL-2.1-or-later
"""The properties of a Member that say how its ends are cut."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.core.members.end_cut import KINDS, SQUARE, EndCut
from BendTorsionWB.objects import given
from BendTorsionWB.objects import surface as surface_object
from BendTorsionWB.objects.given import Given
from BendTorsionWB.objects.proxy import Property, check_kind, check_linked, type_of
from BendTorsionWB.shapes import from_part

ENDS = ("Start", "End")


def _of_end(end: str) -> tuple[Property, ...]:
    group = "Ends"
    return (
        Property(
            "App::PropertyEnumeration",
            f"{end}Cut",
            group,
            "square to the axis; plumb, upright across it; level; plane, by its normal; surface, "
            "at a face",
            "square",
            KINDS,
        ),
        Property(
            "App::PropertyDistance",
            f"{end}CutOffset",
            group,
            "Moves the cut outwards, along the axis or off the face",
            0.0,
        ),
        Property("App::PropertyVector", f"{end}CutNormal", group, "Normal of a cut by plane"),
        Property(
            "App::PropertyBool",
            f"{end}CutAtPoint",
            group,
            "Cut by a plane through the point, instead of the end of the axis",
            False,
        ),
        Property("App::PropertyVector", f"{end}CutPoint", group, "A point of the plane, mm"),
        Property(
            "App::PropertyLinkSub",
            f"{end}CutFace",
            group,
            "A Surface, or a face of any object, for cut by surface",
        ),
    )


PROPERTIES = tuple(declared for end in ENDS for declared in _of_end(end))


def end_cuts(obj) -> tuple[EndCut, EndCut]:
    """The cuts at start and end of a Member; raises BendTorsionError for faces that are gone."""
    return tuple(_end_cut(obj, end) for end in ENDS)


CUT_WORDS = ("kind", "offset", "normal", "point", "face", "surface")


def given_cut(label: str, end: str, argument: str, cut: str | Mapping) -> list[Given]:
    """The properties of `Start` or `End` for a cut, a kind or a mapping with kind and any of
    offset, normal, point and face. Raises BendTorsionError for what is neither, and other words."""
    if not isinstance(cut, str | Mapping):
        given.refuse(label, argument, cut, "is no cut", "write square, or {'kind': ...}")
    cut = {"kind": cut} if isinstance(cut, str) else cut
    given.refuse_unknown(label, cut, CUT_WORDS, f"word of {argument}")
    nowhere = (0.0, 0.0, 0.0)
    values = [
        Given(f"{end}Cut", f"{argument} kind", cut.get("kind", "square")),
        Given(f"{end}CutOffset", f"{argument} offset", cut.get("offset") or 0.0),
        Given(f"{end}CutNormal", f"{argument} normal", cut.get("normal") or nowhere),
        Given(f"{end}CutAtPoint", f"{argument} point", cut.get("point") is not None),
        Given(f"{end}CutPoint", f"{argument} point", cut.get("point") or nowhere),
    ]
    face = cut.get("face")
    if face is not None:
        picked = face if isinstance(face, tuple) else (face, "")
        values.append(Given(f"{end}CutFace", f"{argument} face", picked))
    return values


def cut_words(obj, end: str) -> str | None:
    """A cut as the schedule writes it; None when square."""
    kind = getattr(obj, f"{end}Cut")
    offset = getattr(obj, f"{end}CutOffset").Value
    words = [kind]
    if kind == "plane":
        words += _numbered(("nx", "ny", "nz"), getattr(obj, f"{end}CutNormal"))
        if getattr(obj, f"{end}CutAtPoint"):
            words += _numbered(("x", "y", "z"), getattr(obj, f"{end}CutPoint"))
    if kind == "surface":
        face = getattr(obj, f"{end}CutFace")
        words.append(face[0].Label if face else "")
    if offset:
        words.append(f"offset={offset!r}")
    return None if words == ["square"] else " ".join(words)


def _numbered(names: Sequence[str], vector) -> list[str]:
    return [f"{name}={value!r}" for name, value in zip(names, vector, strict=True)]


def _surface(obj, end: str):
    """The Surface an end is cut at; raises BendTorsionError for one in error, and for a link, as
    its shape is without offset and no larger than it is shown."""
    target = getattr(obj, f"{end}CutFace")[0]
    check_kind(obj, f"{end}CutFace", target, "Surface")
    check_linked(target)
    return target


def _end_cut(obj, end: str) -> EndCut:
    kind = getattr(obj, f"{end}Cut")
    offset = getattr(obj, f"{end}CutOffset").Value
    if kind == "square" and not offset:
        return SQUARE
    if kind == "plane":
        point = getattr(obj, f"{end}CutPoint") if getattr(obj, f"{end}CutAtPoint") else None
        return EndCut(
            kind,
            offset,
            tuple(getattr(obj, f"{end}CutNormal")),
            None if point is None else tuple(point),
        )
    if kind != "surface":
        return EndCut(kind, offset)
    source = getattr(obj, f"{end}CutFace")
    if source is None:
        raise BendTorsionError(
            error(
                "link-missing",
                obj.Label,
                "the face to cut at is not set",
                "choose a face, or another kind of cut",
                position=f"property {end}CutFace",
            )
        )
    if type_of(source[0].getLinkedObject()) == "Surface":
        return EndCut(kind, offset, surface=surface_object.value(_surface(obj, end)))
    shape = surface_object.picked_shape(obj, source, "face")
    if len(shape.Faces) == 1 and shape.Faces[0].Surface.TypeId == "Part::GeomPlane":
        plane = shape.Faces[0].Surface
        return EndCut("plane", offset, tuple(plane.Axis), tuple(plane.Position))
    return EndCut(kind, offset, surface=from_part.surface_from_part(shape, obj.Label))
