# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the user picked, sorted into surfaces, curves, points and BendTorsion objects."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import FreeCAD
import FreeCADGui

from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.gui.chains import chains
from BendTorsionWB.gui.containers import free_edges, opened
from BendTorsionWB.gui.tree import LINKED_ABOVE, sheets_of

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
FACE_AND_CURVES = QT_TRANSLATE_NOOP("BendTorsion", "select one face, then one or more curves on it")
_CHAIN = {
    "Member": {"Member", "PlateSet", "Unfold", "SheetSet", "AssemblyBed"},
    "PlateSet": {"PlateSet", "Member", "Unfold", "SheetSet", "AssemblyBed"},
    "Unfold": {"Unfold", "SheetSet", "PlateSet", "Member", "AssemblyBed"},
}
"""Kinds that stand for another kind of the same member."""


@dataclass(frozen=True)
class Picked:
    """A selection: faces and curves as (object, names), one entry per surface and per chain of
    curves; points; BendTorsion objects in the order picked; objects with nothing of these; inside:
    curves of whole shapes that have faces, too."""

    faces: tuple[tuple, ...] = ()
    curves: tuple[tuple, ...] = ()
    points: tuple[tuple[float, float, float], ...] = ()
    ours: tuple = ()
    others: tuple = ()
    inside: tuple[tuple, ...] = ()

    def of_kind(self, kind: str) -> list:
        """BendTorsion objects of a kind."""
        return [item for item in self.ours if item.BT_Type == kind]


def picked() -> Picked:
    """The selection in the active document."""
    return sort(FreeCADGui.Selection.getSelectionEx())


def sort(items) -> Picked:
    """Sort FreeCAD selection objects (`Object`, `SubElementNames`) in the order picked.

    A whole shape with faces is one surface, one without is a curve for each chain of its edges. A
    part or a group is what it holds, and nothing where any of that is picked with it. A drawing
    page is its set of sheets.
    """
    faces, curves, points, ours, others, inside = [], [], [], [], [], []
    picks = [(item.Object, [name for name in item.SubElementNames if name]) for item in items]
    for obj, names in opened(picks):
        if (own := own_of(obj)) is not None:
            ours.append(own)
            continue
        shape = getattr(obj, "Shape", None)
        if shape is None or shape.isNull():
            others.append(obj)
            continue
        if not names:
            if shape.Faces:
                faces.append((obj, ""))
                if free := free_edges(shape):
                    inside += [(obj, chain) for chain in chains(shape, free)]
            elif shape.Edges:
                curves += [(obj, chain) for chain in chains(shape)]
            elif shape.Vertexes:
                points += [tuple(vertex.Point) for vertex in shape.Vertexes]
            else:
                others.append(obj)
            continue
        own = [name for name in names if name.startswith("Face")]
        if own:
            faces.append((obj, own[0] if len(own) == 1 else own))
        curves += [(obj, name) for name in names if name.startswith("Edge")]
        points += [
            tuple(shape.getElement(name).Point) for name in names if name.startswith("Vertex")
        ]
    return Picked(*map(tuple, (faces, curves, points, ours, others, inside)))


def own_of(obj):
    """The object of ours that a picked one is, or is a drawing page of; None for others."""
    return obj if hasattr(obj, "BT_Type") else sheets_of(obj)


def surface_and_curves(given: Picked):
    """One surface, a Surface object or (object, names), and its curves, each (object, names): those
    picked, else those of the shape the surface is the faces of.

    Raises BendTorsionError (`selection`) that says what is missing or too much, and what of the
    selection is neither.
    """
    surfaces = [*given.of_kind("Surface"), *given.faces]
    curves = given.curves or given.inside
    neither = ", ".join(obj.Label for obj in given.others)
    if len(surfaces) != 1:
        words = translate("BendTorsion", "{count} faces are selected, one is needed")
        told = words.format(count=len(surfaces))
        names = ", ".join(map(_name, surfaces)) or neither
    elif not curves:
        told = translate("BendTorsion", "no curve is selected")
        names = ", ".join([_name(surfaces[0]), *filter(None, [neither])])
    else:
        return surfaces[0], curves
    if names:
        told = translate("BendTorsion", "{told} (selected: {names})").format(told=told, names=names)
    raise refusal(told, FACE_AND_CURVES)


def _name(surface) -> str:
    """A Surface, or picked faces, as the tree and the status bar name them."""
    if not isinstance(surface, tuple):
        return surface.Label
    obj, names = surface
    own = [names] if isinstance(names, str) else names
    return ", ".join(f"{obj.Label}.{name}" if name else obj.Label for name in own)


def surface_of(face: tuple):
    """The Surface that stands for picked faces, (object, names), at no offset; None for none.

    One whose outward side was turned counts: it is turned for the face, not for a member.
    """
    wanted = _face_names(*face)
    for obj in face[0].Document.Objects:
        if getattr(obj, "BT_Type", "") != "Surface" or obj.Kind != "face" or obj.Source is None:
            continue
        source, names = obj.Source
        if source == face[0] and not obj.Offset.Value and _face_names(source, names) == wanted:
            return obj
    return None


def _face_names(obj, names) -> set[str]:
    """The names of some faces of an object; of all when none is named."""
    found = {name for name in ([names] if isinstance(names, str) else names) if name}
    return found or {f"Face{k}" for k in range(1, len(obj.Shape.Faces) + 1)}


def stood_for(given: Picked, kind: str) -> list:
    """The Members, PlateSets or Unfolds the selection stands for; a plate stands for its member
    and a member for its plates."""
    found = []
    for item in given.ours:
        if item.BT_Type in _CHAIN[kind]:
            found += [obj for obj in _along(item) if obj.BT_Type == kind]
    return list(dict.fromkeys(found))


def is_one(given: Picked, kind: str = "Member") -> bool:
    """Whether the selection stands for one member, or one's plates or patterns."""
    return len(stood_for(given, kind)) == 1


def of_member(given: Picked, kind: str, mend: str) -> list:
    """What `stood_for` finds; raises BendTorsionError (`selection`) when there is none."""
    found = stood_for(given, kind)
    if not found:
        raise refusal(_NONE[kind], mend)
    return found


_NONE = {
    "Member": QT_TRANSLATE_NOOP("BendTorsion", "no member is selected"),
    "PlateSet": QT_TRANSLATE_NOOP("BendTorsion", "no member with plates is selected"),
    "Unfold": QT_TRANSLATE_NOOP("BendTorsion", "no member with patterns is selected"),
}


def _along(obj) -> list:
    """An object and the others of the same member, up and down the links."""
    chain = [obj]
    while chain[-1].BT_Type in LINKED_ABOVE:
        source = getattr(chain[-1], LINKED_ABOVE[chain[-1].BT_Type])
        if source is None:
            break
        chain.append(source)
    pending = [obj, *(item for item in chain[1:] if item.BT_Type == "PlateSet")]
    while pending:
        users = [
            user
            for user in pending.pop().InList
            if LINKED_ABOVE.get(getattr(user, "BT_Type", "")) and user not in chain
        ]
        chain += users
        pending += users
    return chain


def standing_for(obj, kind: str):
    """The object of a kind a picked one stands for, as a member for its axis; None for none."""
    chain = _along(obj) if hasattr(obj, "BT_Type") else []
    members = [item for item in chain if item.BT_Type == "Member"]
    if kind == "Axis":
        chain += [item.Axis for item in members if item.Axis is not None]
    return next((item for item in chain if item.BT_Type == kind), None)


def only(items: list, words: str, mend: str):
    """The one of some selected objects; raises BendTorsionError (`selection`) for several, of which
    none is meant more than the others."""
    if len(items) > 1:
        told = translate("BendTorsion", "{count} {things} are selected, one is needed")
        things = translate("BendTorsion", words)
        raise refusal(told.format(count=len(items), things=things), mend)
    return items[0]


def refuse_split(document) -> None:
    """Raises BendTorsionError, naming the documents to open, for the one of a split model."""
    from BendTorsionWB.exchange.linked_documents import refuse_linked

    if document.FileName:
        refuse_linked(Path(document.FileName))


def refusal(message: str, mend: str) -> BendTorsionError:
    """What to select instead; in the language of the window."""
    message, mend = (translate("BendTorsion", text) for text in (message, mend))
    return BendTorsionError([error("selection", "selection", message, mend=mend)])
