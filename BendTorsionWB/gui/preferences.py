# SPDX-License-Identifier: LGPL-2.1-or-later
"""What new objects start with, as the user prefers. Objects that are there are never changed by
it: the values are written into each object when a command makes it, and into its macro line."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import FreeCAD

from BendTorsionWB.core import tolerances
from BendTorsionWB.core.patterns.layer_names import LAYERS as LAYER_KEYS

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
SEGMENTS = 4
"""Which argument of make_member its segments are."""
GROUP = "User parameter:BaseApp/Preferences/Mod/BendTorsion"


@dataclass(frozen=True)
class Preference:
    """A value new objects start with: argument `argument` of `make.function`.

    default: what it is until the user says otherwise, a float being a length in mm unless `unit` is
    empty; listed: choices of a text that is one of some.
    """

    name: str
    label: str
    default: float | str
    function: str
    argument: str
    listed: tuple[str, ...] | Callable[[], tuple[str, ...]] = ()
    unit: str = "mm"

    @property
    def choices(self) -> tuple[str, ...]:
        """What a text may be; empty for any."""
        return self.listed() if callable(self.listed) else self.listed

    @property
    def value(self) -> float | str:
        """As the user prefers; the default for what is none of the choices or no length."""
        stored = FreeCAD.ParamGet(GROUP)
        if isinstance(self.default, float):
            value = stored.GetFloat(self.name, self.default)
            usable = math.isfinite(value) and (value > 0.0 if self.unit else value >= 0.0)
            return value if usable else self.default
        value = stored.GetString(self.name, self.default)
        return value if not self.choices or value in self.choices else self.default

    def keep(self, value: float | str) -> None:
        """Remember what the user prefers."""
        stored = FreeCAD.ParamGet(GROUP)
        if isinstance(self.default, float):
            stored.SetFloat(self.name, value)
        else:
            stored.SetString(self.name, value)


# Asked for when they are needed: the workbench opens without loading scipy.
def _rule_packs() -> tuple[str, ...]:
    from BendTorsionWB.core import rules

    return rules.PACKS


def _modes() -> tuple[str, ...]:
    from BendTorsionWB.core.patterns.pattern import MODES

    return MODES


def _sheet_formats() -> tuple[str, ...]:
    from BendTorsionWB.core.drawings.sheet_style import FORMATS

    return tuple(FORMATS)


SECTIONS = (
    Preference(
        "SectionType",
        QT_TRANSLATE_NOOP("BendTorsion", "Type"),
        "box1",
        "make_section",
        "type",
        ("box1", "box2"),
    ),
    Preference("Height", QT_TRANSLATE_NOOP("BendTorsion", "Height h"), 600.0, "make_section", "h"),
    Preference(
        "Breadth", QT_TRANSLATE_NOOP("BendTorsion", "Breadth b"), 600.0, "make_section", "b"
    ),
    Preference(
        "Thickness", QT_TRANSLATE_NOOP("BendTorsion", "Thickness t"), 16.0, "make_section", "t"
    ),
)
OTHERS = (
    Preference(
        "AxisTolerance",
        QT_TRANSLATE_NOOP("BendTorsion", "Axis within, of its surface"),
        tolerances.AXIS_ON_SURFACE,
        "make_axis",
        "tolerance",
    ),
    Preference(
        "StationSpacing",
        QT_TRANSLATE_NOOP("BendTorsion", "Station spacing"),
        500.0,
        "make_plates",
        "station_spacing",
    ),
    Preference(
        "RulePack",
        QT_TRANSLATE_NOOP("BendTorsion", "Rule pack"),
        "CN",
        "make_plates",
        "rule_pack",
        _rule_packs,
    ),
    Preference(
        "FlatteningMode",
        QT_TRANSLATE_NOOP("BendTorsion", "Laying flat by"),
        "edges",
        "make_unfold",
        "mode",
        _modes,
    ),
    Preference(
        "Slope",
        QT_TRANSLATE_NOOP("BendTorsion", "Slope of transitions 1 :"),
        2.5,
        "make_member",
        "slope",
        unit="",
    ),
)
SHEETS = (
    Preference(
        "Project", QT_TRANSLATE_NOOP("BendTorsion", "Project"), "", "make_sheets", "project"
    ),
    Preference("Author", QT_TRANSLATE_NOOP("BendTorsion", "Drawn by"), "", "make_sheets", "author"),
    Preference(
        "SheetFormat",
        QT_TRANSLATE_NOOP("BendTorsion", "Format"),
        "A3",
        "make_sheets",
        "format",
        _sheet_formats,
    ),
    Preference(
        "SheetStandard",
        QT_TRANSLATE_NOOP("BendTorsion", "Standard"),
        "ISO",
        "make_sheets",
        "standard",
        ("ISO", "AWS"),
    ),
    Preference(
        "SheetLanguage",
        QT_TRANSLATE_NOOP("BendTorsion", "Language"),
        "en",
        "make_sheets",
        "language",
        ("en", "zh"),
    ),
    Preference(
        "SheetUnit",
        QT_TRANSLATE_NOOP("BendTorsion", "Unit"),
        "mm",
        "make_sheets",
        "unit",
        ("mm", "ft-in"),
    ),
)
LAYERS = tuple(
    Preference(f"Layer{name}", name, name, "make_unfold", "layers") for name in LAYER_KEYS
)
"""Names of the layers of cut files."""
LAYER_WORDS = {
    "CUT_OUTER": QT_TRANSLATE_NOOP("BendTorsion", "outer contour, to be cut"),
    "CUT_INNER": QT_TRANSLATE_NOOP("BendTorsion", "openings and slots, to be cut"),
    "MARK_LINE": QT_TRANSLATE_NOOP("BendTorsion", "station lines and other lines, to be marked"),
    "MARK_ROLL": QT_TRANSLATE_NOOP("BendTorsion", "lines the plate is rolled or pressed along"),
    "MARK_FOLD": QT_TRANSLATE_NOOP("BendTorsion", "fold lines"),
    "MARK_BEVEL": QT_TRANSLATE_NOOP("BendTorsion", "bevels of the edges, as text"),
    "MARK_TEXT": QT_TRANSLATE_NOOP("BendTorsion", "texts, to be marked"),
    "PUNCH": QT_TRANSLATE_NOOP("BendTorsion", "punch marks"),
    "REF": QT_TRANSLATE_NOOP("BendTorsion", "for reference, neither cut nor marked"),
}
"""What is on each of them."""
PREFERENCES = (*SECTIONS, *OTHERS, *SHEETS, *LAYERS)


def preferred(name: str) -> float | str:
    """The value of one of PREFERENCES."""
    return next(item for item in PREFERENCES if item.name == name).value


def with_preferences(
    function: str, arguments: Sequence, named: dict
) -> tuple[list[object], dict[str, object]]:
    """Arguments of `make.function`, completed by what the user prefers and by nothing that is the
    default anyway. A section that is given any size keeps all of its own."""
    arguments = list(arguments)
    if function == "make_section" and named:
        return arguments, named
    own = {
        item.argument: item.value
        for item in PREFERENCES
        if item.function == function
        and (item in SECTIONS or item.value != item.default)
        and item.argument not in (*named, "slope", "layers")
    }
    renamed = {item.default: item.value for item in LAYERS if item.value not in ("", item.default)}
    if function == "make_unfold" and renamed and "layers" not in named:
        own["layers"] = renamed
    slope = next(item for item in OTHERS if item.argument == "slope")
    if slope.value != slope.default:
        if function == "add_cut" and "slope" not in named:
            own["slope"] = slope.value
        if function == "make_member" and len(arguments) > SEGMENTS:
            first, *others = arguments[SEGMENTS]
            arguments[SEGMENTS] = [first, *({"slope": slope.value, **one} for one in others)]
    return arguments, {**named, **own}
