# SPDX-License-Identifier: LGPL-2.1-or-later
"""The members of a document as rows of text, a row per segment, and texts as edits of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import FreeCAD

from BendTorsionWB.core.members.segment import ALIGN_TO, ALIGNMENTS, TRANSITIONS
from BendTorsionWB.gui import finding_words
from BendTorsionWB.gui.joint_words import joints_text, parse_joints
from BendTorsionWB.gui.typed_quantity import number_of
from BendTorsionWB.objects.member import segment_count

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
FACES = ("top", "bottom", "left", "right")
EDITED = (
    *("section", "cut", "slope", "transition", "align", "align_to", "offset_y", "offset_z"),
    *FACES,
)
"""As on the sheets Members and Splits of a schedule."""
LENGTH = QT_TRANSLATE_NOOP("BendTorsion", "length")
COLUMNS = ("member", "segment", *EDITED, LENGTH)
"""What is read only at the end stands behind what blocks of a spreadsheet are pasted into."""
_CHOICES = {
    "align": ("Align", ALIGNMENTS),
    "align_to": ("AlignTo", ALIGN_TO),
    "transition": ("Transition", TRANSITIONS),
}
_LENGTHS = {"offset_y": "OffsetY", "offset_z": "OffsetZ"}
_PROPERTIES = {
    **{column: (name,) for column, (name, _) in _CHOICES.items()},
    **{column: (name,) for column, name in _LENGTHS.items()},
    **{"section": ("Section",), "slope": ("Slope",), "cut": ("Cut", "CutRatio")},
}
"""Of a segment, by column."""
_SIZES = {"polygon": ("Thickness",), "strips": ()}
"""Of a section by type, what it is told by; the others by h × b × t."""
_THICKNESSES = ("Thickness", "ThicknessTop", "ThicknessBottom", "ThicknessWeb")
MOST_NAMED = 8


@dataclass(frozen=True)
class Row:
    """One segment of a member; plates: the PlateSet of the member, on segment 1."""

    member: object
    segment: int
    plates: object | None

    def text(self, column: str) -> str:
        """The cell of a column."""
        member, k = self.member, self.segment
        if column == "member":
            return member.Label
        if column == "segment":
            return str(k)
        if column == "section":
            section = getattr(member, f"Section{k}")
            return section.Label if section is not None else ""
        if column == "cut":
            return self._cut()
        if column == "slope":
            return _number_text(getattr(member, f"Slope{k}")) if self._has_cut() else ""
        if column in _CHOICES:
            if column == "transition" and not self._has_cut():
                return ""
            return getattr(member, f"{_CHOICES[column][0]}{k}")
        if column in _LENGTHS:
            return _number_text(getattr(member, f"{_LENGTHS[column]}{k}").Value)
        if column == LENGTH:
            known = k == 1 and member.Length.Value > 0.0
            return f"{member.Length.Value:.1f}" if known else ""
        return joints_text(self.plates, column) if self.plates is not None else ""

    def note(self, column: str) -> str:
        """What is told beside the text of a cell and is no part of it: the sizes of a section."""
        section = getattr(self.member, f"Section{self.segment}") if column == "section" else None
        return sizes_text(section) if section is not None else ""

    def is_locked(self, column: str) -> bool:
        """Whether the cell has no meaning in this row."""
        return bool(self.lock_reason(column))

    def lock_reason(self, column: str) -> str:
        """Why the cell has no meaning in this row; empty when it has one."""
        if column in ("member", "segment"):
            return translate("BendTorsion", "names and numbers are those of the model")
        if column == LENGTH:
            return length_words()
        if column in ("cut", "slope", "transition") and not self._has_cut():
            return translate("BendTorsion", "the first segment starts with the axis")
        if column in FACES and self.segment > 1:
            return translate("BendTorsion", "joints stand with the first segment")
        if column in FACES and self.plates is None:
            return translate("BendTorsion", "the member has no plates")
        wanted = [f"{name}{self.segment}" for name in _PROPERTIES.get(column, ())]
        for path, text in self.member.ExpressionEngine:
            if path.lstrip(".") in wanted:
                return translate("BendTorsion", "it follows = {text}").format(text=text)
        return ""

    def choices(self, column: str) -> list[str]:
        """The texts the cell can have, where they can be counted."""
        if column == "section":
            return [section.Label for section in self._sections()]
        return list(_CHOICES[column][1]) if column in _CHOICES else []

    def choice_notes(self, column: str) -> list[str]:
        """What is told beside each of the choices."""
        if column == "section":
            return [sizes_text(section) for section in self._sections()]
        return [""] * len(self.choices(column))

    def edits(self, column: str, text: str) -> list[tuple]:
        """What a text means, as (object, property, value); raises ValueError with the reason."""
        k, text = self.segment, text.strip()
        if column == "section":
            return [(self.member, f"Section{k}", self._section(text))]
        if column == "cut":
            return [(self.member, f"{name}{k}", value) for name, value in _cut_of(text).items()]
        if column == "slope":
            slope = number_of(text, "")
            if slope < 0.0:
                words = translate("BendTorsion", "{text} is too little: {limit} or more")
                raise ValueError(words.format(text=text, limit=0))
            return [(self.member, f"Slope{k}", slope)]
        if column in _CHOICES:
            name, choices = _CHOICES[column]
            word = matching(text, choices)
            if word is None:
                words = translate("BendTorsion", "{text!r} is none of {choices}")
                raise ValueError(words.format(text=text, choices=", ".join(choices)))
            return [(self.member, f"{name}{k}", word)]
        if column in _LENGTHS:
            return [(self.member, f"{_LENGTHS[column]}{k}", number_of(text or "0", "mm"))]
        values = parse_joints(text)
        auto = [face for face in self.plates.AutoJoints if face != column]
        return [
            (self.plates, "AutoJoints", [*auto, column] if values == "auto" else auto),
            (self.plates, f"Joints{column.capitalize()}", [] if values == "auto" else values),
        ]

    def _has_cut(self) -> bool:
        axis = self.member.Axis
        return self.segment > 1 or (axis is not None and axis.Closed)

    def _cut(self) -> str:
        if not self._has_cut():
            return ""
        k = self.segment
        if getattr(self.member, f"CutBy{k}") != "place":
            return getattr(self.member, f"CutBy{k}")
        ratio = getattr(self.member, f"CutRatio{k}")
        if ratio:
            return f"{100.0 * ratio:.10g}%"
        return _number_text(getattr(self.member, f"Cut{k}").Value)

    def _sections(self) -> list:
        objects = self.member.Document.Objects
        return [obj for obj in objects if getattr(obj, "BT_Type", "") == "SectionSpec"]

    def _section(self, label: str):
        there = self.choices("section")
        found = matching(label, there)
        if found is None:
            words = translate("BendTorsion", "there is no section {name!r}; there are {names}")
            names = [*there[:MOST_NAMED], *("…" for _ in there[MOST_NAMED : MOST_NAMED + 1])]
            raise ValueError(words.format(name=label, names=", ".join(names)))
        return next(section for section in self._sections() if section.Label == found)


def length_words() -> str:
    """What the column of lengths is."""
    return translate("BendTorsion", "the length is that of the axis, in mm")


def sizes_text(section) -> str:
    """Height, breadth and thickness of a section, mm, `600 × 500 × 16`; thicknesses of flanges and
    webs that are others beside it, `16/20`. Empty for one that has no such sizes."""
    names = _SIZES.get(section.Type, ("Height", "Breadth", "Thickness"))
    if not names:
        return ""
    given = [getattr(section, name).Value for name in _THICKNESSES]
    thickness = "/".join(_number_text(t) for t in dict.fromkeys(given) if t or t == given[0])
    sizes = [_number_text(getattr(section, name).Value) for name in names[:-1]]
    return " × ".join([*sizes, thickness])


def matching(text: str, words: Sequence[str]) -> str | None:
    """The one of some words a text is, whatever its capital letters; None for none, and for several
    that differ in these only."""
    if text in words:
        return text
    alike = {word for word in words if word.casefold() == text.casefold()}
    return alike.pop() if len(alike) == 1 else None


def rows_of(document) -> list[Row]:
    """The rows of all members, in the order of the tree."""
    rows = []
    for member in document.Objects if document is not None else ():
        if getattr(member, "BT_Type", "") != "Member":
            continue
        plates = [user for user in member.InList if getattr(user, "BT_Type", "") == "PlateSet"]
        for k in range(1, segment_count(member) + 1):
            rows.append(Row(member, k, plates[0] if plates and k == 1 else None))
    return rows


def faults(rows) -> dict[tuple[int, int], str]:
    """The cells that errors of the members name, by segment and column, with the reason."""
    found = {}
    for r, row in enumerate(rows):
        for finding in map(finding_words.of_text, row.member.Findings):
            words = f"{finding.position} {finding.message}".replace(",", " ").split()
            if finding.severity != "error" or words[:2] != ["segment", str(row.segment)]:
                continue
            column = next((word for word in words[2:] if word in EDITED), "")
            if column:
                found.setdefault((r, COLUMNS.index(column)), finding_words.reason(finding))
    return found


def edits_of(rows, cells: Mapping[tuple[int, int], str]) -> tuple[list[tuple], dict]:
    """The edits cells mean, (object, property, value), and the reason of each that means none."""
    edits, reasons = {}, {}
    for (r, c), text in cells.items():
        try:
            for obj, name, value in rows[r].edits(COLUMNS[c], text):
                if name == "AutoJoints":
                    # Several faces of one row: each adds to or takes from what the others left.
                    value = _joined(edits.get((obj.Name, name)), obj, COLUMNS[c], value)
                edits[obj.Name, name] = (obj, name, value)
        except ValueError as problem:
            reasons[r, c] = str(problem)
    return list(edits.values()), reasons


def _joined(former, obj, face: str, value: list[str]) -> list[str]:
    if former is None:
        return value
    others = [name for name in former[2] if name != face]
    return [*others, face] if face in value else others


def _cut_of(text: str) -> dict[str, object]:
    if text.endswith("%"):
        ratio = number_of(text[:-1], "") / 100.0
        if not 0.0 < ratio < 1.0:
            words = translate("BendTorsion", "{text} does not lie between 0% and 100%")
            raise ValueError(words.format(text=text))
        return {"CutBy": "place", "CutRatio": ratio}
    place = number_of(text, "mm")
    if place <= 0.0:
        words = translate("BendTorsion", "{text} does not lie behind the start of the axis, 0 mm")
        raise ValueError(words.format(text=text))
    return {"CutBy": "place", "CutRatio": 0.0, "Cut": place}


def _number_text(value: float) -> str:
    return f"{value:.10g}"
