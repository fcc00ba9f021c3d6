# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the user picked, sorted into one face and the curves that lie on it."""

from __future__ import annotations

from dataclasses import dataclass

from BendTorsionWB.core.finding import BendTorsionError, error

MEND = "select one face, then one or more curves on it"


@dataclass(frozen=True)
class FaceAndCurves:
    """One face and its curves, each as (document object, sub-element name)."""

    face: tuple
    edges: tuple[tuple, ...]


def face_and_curves(picked) -> FaceAndCurves:
    """Sort FreeCAD selection objects (`Object`, `SubElementNames`) in the order picked.

    A whole object stands for its only face when it has one, for its only edge when it has no face.
    Raises BendTorsionError (`selection`) that says what is missing or too much.
    """
    faces, edges = [], []
    for item in picked:
        for name in item.SubElementNames or (_only_element(item.Object),):
            kind = faces if name.startswith("Face") else edges if name.startswith("Edge") else None
            if kind is None:
                raise _refusal(item.Object.Label, f"{name or 'it'} is neither a face nor a curve")
            kind.append((item.Object, name))
    if len(faces) != 1:
        raise _refusal("selection", f"{len(faces)} faces are selected, one is needed")
    if not edges:
        raise _refusal("selection", "no curve is selected")
    return FaceAndCurves(faces[0], tuple(edges))


def _only_element(document_object) -> str:
    shape = getattr(document_object, "Shape", None)
    if shape is None:
        return ""
    if shape.Faces:
        return "Face1" if len(shape.Faces) == 1 else ""
    return "Edge1" if len(shape.Edges) == 1 else ""


def _refusal(place: str, message: str) -> BendTorsionError:
    return BendTorsionError([error("selection", place, message, mend=MEND)])
