# SPDX-License-Identifier: LGPL-2.1-or-later
"""What every document object shares: properties, findings, an execute that cannot raise.

An object that raises in `execute` stops its dependants, and FreeCAD leaves them "Up-to-date" with
stale shapes. So errors become findings and an empty shape, and dependants run and see them.
"""

from __future__ import annotations

import json
import traceback
from abc import ABC, abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass

import FreeCAD
import Part

from BendTorsionWB.core.finding import BendTorsionError, Finding, error, has_error
from BendTorsionWB.interrupts import asked
from BendTorsionWB.objects import schema
from BendTorsionWB.objects.containers import in_document, outer_placement, places_used
from BendTorsionWB.objects.uncomputed import after_recompute, follows_nothing

READ_ONLY = 1
HIDDEN = 4
OUTPUT = 8
LARGEST_NUMBER = 1e12
_UNITS = {
    "App::PropertyLength": FreeCAD.Units.Length,
    "App::PropertyDistance": FreeCAD.Units.Length,
    "App::PropertyAngle": FreeCAD.Units.Angle,
    "App::PropertyPressure": FreeCAD.Units.Pressure,
}

KIND_WORDS = {
    "Surface": "surface",
    "Axis": "axis",
    "SectionSpec": "section",
    "Member": "member",
    "PlateSet": "plate set",
    "Unfold": "development",
    "AssemblyBed": "assembly bed",
}
"""What the kinds of objects that others link to are called, by BT_Type."""


@dataclass(frozen=True)
class Property:
    """A declared property. default: value set when it is created; choices: of an enumeration."""

    type: str
    name: str
    group: str
    tooltip: str
    default: object = None
    choices: tuple[str, ...] = ()
    output: bool = False
    hidden: bool = False


BASE_PROPERTIES = (
    Property(
        "App::PropertyString",
        "Status",
        "Result",
        "ok while there is no error, else the first; Findings have warnings, too",
        "",
        output=True,
    ),
    Property(
        "App::PropertyStringList",
        "Findings",
        "Result",
        "Everything the last recompute found, one record (JSON) per line",
        output=True,
    ),
    Property(
        "App::PropertyString",
        "PlacesUsed",
        "Result",
        "Where the containers stood at the last recompute that it and what it uses are in",
        output=True,
        hidden=True,
    ),
)


class Proxy(ABC):
    """Base of the FeaturePython proxies; holds no state and no object.

    Subclasses name their TYPE and PROPERTIES, and implement `build(obj) -> findings`, which sets
    the outputs and may raise BendTorsionError, and `clear(obj)`, which empties them.
    """

    TYPE = ""
    PROPERTIES: tuple[Property, ...] = ()
    LAID_APART = False
    """Whether Placement, or a container, may move it, as what is drawn beside the model. All else
    is where it is built, and what depends on it too."""

    def __init__(self, obj):
        obj.Proxy = self
        self.set_up(obj)
        attach_view(obj)

    def set_up(self, obj) -> None:
        """Add what is missing; safe to run on new and on restored objects."""
        after_recompute.register()
        present = set(obj.PropertiesList)
        if "BT_Type" not in present:
            obj.addProperty(
                "App::PropertyString",
                "BT_Type",
                "Base",
                "Kind of BendTorsion object",
                READ_ONLY | HIDDEN,
            )
            obj.BT_Type = self.TYPE
            obj.addProperty(
                "App::PropertyInteger",
                "SchemaVersion",
                "Base",
                "Version of the saved properties",
                READ_ONLY | HIDDEN,
            )
            obj.SchemaVersion = schema.SCHEMA_VERSION
        changes = schema.changes_of(obj)
        for declared in (*self.declared(obj), *BASE_PROPERTIES):
            add_property(obj, declared)
        schema.apply(obj, changes)

    def declared(self, obj) -> Iterable[Property]:
        """The properties the object has now; more than PROPERTIES where their number varies."""
        return self.PROPERTIES

    def execute(self, obj) -> None:
        """Recompute; never raises."""
        try:
            _check_asked(obj)
            schema.check(obj)
            check_numbers(obj, self.declared(obj))
            self._put_back(obj)
            findings = tuple(self.build(obj))
        except BendTorsionError as problem:
            findings = problem.findings
        except Exception as problem:  # noqa: BLE001 - the last fence before FreeCAD's recompute
            FreeCAD.Console.PrintLog(traceback.format_exc())
            findings = (
                error(
                    "internal-error",
                    obj.Label,
                    f"unexpected {type(problem).__name__}: {problem}",
                    "report this with the document",
                ),
            )
        if has_error(findings):
            self.clear(obj)
        write_findings(obj, findings)
        obj.PlacesUsed = places_used(obj)

    def mustExecute(self, obj) -> bool:
        """Whether a container was moved since, something dragged into one or out of it, or a
        document that it follows is not there: FreeCAD asks in every recompute, and touches nothing
        itself."""
        if not in_document(obj):
            # FreeCAD's window asks those an undo took away as well.
            return False
        if "PlacesUsed" in obj.PropertiesList and obj.PlacesUsed != places_used(obj):
            return True
        return follows_nothing(obj)

    @abstractmethod
    def build(self, obj) -> Iterable[Finding]:
        """Set the outputs from the inputs; may raise BendTorsionError."""

    def clear(self, obj) -> None:
        """Empty every output, so that nothing stale is left to see or to export."""
        clear_outputs(obj, self.declared(obj))

    def onDocumentRestored(self, obj):
        """Complete the properties of a file saved by an earlier version; bring the view back."""
        self.set_up(obj)
        attach_view(obj)

    def onBeforeChange(self, obj, name):
        """Know the label there was; it is of no use later, and not saved."""
        if name == "Label":
            self._former_label = obj.Label

    def onChanged(self, obj, name):
        """Compute again what tells an object's label, in marks, sheets and findings, and bring
        labels that begin with it along; by itself FreeCAD does neither."""
        former = self.__dict__.pop("_former_label", "") if name == "Label" else ""
        if not former or former == obj.Label or obj.Document.Restoring:
            return
        obj.touch()
        for user in obj.InListRecursive:
            if hasattr(user, "BT_Type") and user.Label.startswith(f"{former} "):
                user.Label = obj.Label + user.Label[len(former) :]

    def _put_back(self, obj) -> None:
        """Undo what moved an object away from what it is built on, the containers it is in among
        it; its new shape has a place of its own, which may be a Placement as well."""
        if not self.LAID_APART and "Placement" in obj.PropertiesList:
            outer = outer_placement(obj)
            obj.Placement = outer if outer.isIdentity() else outer.inverse()

    def dumps(self):
        return None

    def loads(self, state):
        return None

    __getstate__ = dumps
    __setstate__ = loads


def _check_asked(obj) -> None:
    """Raises BendTorsionError when the program was told to stop: FreeCAD goes through the objects
    that are left, and none of them need be computed."""
    if asked():
        mend = "build again, or mark it to recompute"
        raise BendTorsionError(error("stopped", obj.Label, "was not computed: stopped", mend))


def add_property(obj, declared: Property) -> None:
    """Add a declared property unless the object has it; an enumeration saved when there were
    fewer choices gets the new ones."""
    if declared.name in obj.PropertiesList:
        if declared.choices:
            _complete_choices(obj, declared)
        return
    attributes = READ_ONLY | OUTPUT if declared.output else 0
    attributes |= HIDDEN if declared.hidden else 0
    obj.addProperty(declared.type, declared.name, declared.group, declared.tooltip, attributes)
    if declared.choices:
        setattr(obj, declared.name, list(declared.choices))
    if declared.default is not None:
        setattr(obj, declared.name, declared.default)


def _complete_choices(obj, declared: Property) -> None:
    choices = list(declared.choices)
    if obj.getEnumerationsOfProperty(declared.name) != choices:
        chosen = getattr(obj, declared.name)
        setattr(obj, declared.name, choices)
        if chosen in choices:
            setattr(obj, declared.name, chosen)


def check_numbers(obj, declared: Iterable[Property]) -> None:
    """Raises BendTorsionError for a single number that is none or out of all bounds (FreeCAD holds
    infinite lengths as the largest double); lists are the core's."""
    for item in declared:
        value = None if item.output else getattr(obj, item.name, None)
        number = getattr(value, "Value", value)
        wanted = _UNITS.get(item.type)
        if wanted is not None and value is not None and value.Unit != wanted:
            # An expression may bring a quantity of any kind, and FreeCAD takes it.
            raise BendTorsionError(
                error(
                    "not-a-number",
                    obj.Label,
                    f"{item.name} is of another kind: {value.UserString}",
                    "give it in its own unit",
                    position=f"property {item.name}",
                )
            )
        if isinstance(number, float) and not abs(number) <= LARGEST_NUMBER:
            raise BendTorsionError(
                error(
                    "not-a-number",
                    obj.Label,
                    f"{item.name} is not a number of use",
                    "give a number",
                    position=f"property {item.name}",
                )
            )


def clear_outputs(obj, declared: Iterable[Property]) -> None:
    """Outputs to nothing and, where there is a shape, an empty compound (a null shape would leave
    drawings of it stale)."""
    for item in declared:
        if item.output:
            if item.type.endswith("List"):
                setattr(obj, item.name, [])
            elif item.type == "App::PropertyString":
                setattr(obj, item.name, "")
            elif item.type == "App::PropertyInteger":
                setattr(obj, item.name, 0)
            elif item.type == "App::PropertyVector":
                setattr(obj, item.name, FreeCAD.Vector())
            else:
                setattr(obj, item.name, 0.0)
    if hasattr(obj, "Shape"):
        obj.Shape = Part.Compound([])


def write_findings(obj, findings: Iterable[Finding]) -> None:
    """Keep the findings on the object, and its status."""
    findings = tuple(findings)
    obj.Findings = [json.dumps(f.as_dict(), sort_keys=True) for f in findings]
    errors = [f for f in findings if f.severity == "error"]
    obj.Status = errors[0].line() if errors else "ok"


def findings_of(obj) -> tuple[Finding, ...]:
    """The findings of an object's last recompute."""
    return tuple(Finding(**json.loads(text)) for text in obj.Findings)


def type_of(obj) -> str:
    """The kind of an object of ours, empty for others; links pass on the properties of what they
    show, and are no objects of ours."""
    is_link = getattr(obj, "TypeId", "").startswith("App::Link")
    return "" if is_link else getattr(obj, "BT_Type", "")


def linked(obj, name: str, kind: str):
    """The object a link property points to; raises BendTorsionError when it is gone, of another
    kind (a deleted target silently becomes None), or is in error itself."""
    target = getattr(obj, name, None)
    word = KIND_WORDS[kind]
    if target is None:
        raise BendTorsionError(
            error(
                "link-missing",
                obj.Label,
                _missing(name),
                f"choose {_a(word)}",
                position=f"property {name}",
            )
        )
    check_kind(obj, name, target, kind)
    check_linked(target)
    return target


def check_kind(obj, name: str, target, kind: str) -> None:
    """Raises BendTorsionError unless what a property links to is an object of ours of this kind."""
    word = KIND_WORDS[kind]
    if type_of(target) != kind:
        # FreeCAD's links pass on properties, and not what computes them.
        by_link = type_of(target.getLinkedObject()) == kind
        raise BendTorsionError(
            error(
                "link-kind",
                obj.Label,
                f"{name} links to what is no {word}",
                f"choose {_a(word)}, not a link to it" if by_link else f"choose {_a(word)}",
                position=f"property {name}",
                value=target.Label,
            )
        )


def _missing(name: str) -> str:
    """What is said of a link that is empty; members have a section for each segment."""
    segment = name.removeprefix("Section")
    if segment.isdigit():
        return f"the section of segment {segment} is not set"
    return f"{name} is not set"


def _a(kind: str) -> str:
    """A kind of object with its article."""
    return f"an {kind}" if kind[0] in "aeiou" else f"a {kind}"


def check_linked(target) -> None:
    """Raises BendTorsionError when an object of ours that another one uses is in error, whether the
    other would need what is wrong or not, or nothing computes it."""
    if is_bare(target):
        raise BendTorsionError(bare_finding(target))
    if target.Status.startswith("error") and not _is_waiting(target):
        raise BendTorsionError(f for f in findings_of(target) if f.severity == "error")
    check_numbers(target, target.Proxy.declared(target))


def is_bare(obj) -> bool:
    """Whether an object of ours lost what computes it: FreeCAD keeps its properties and shape, and
    takes it for computed."""
    return bool(type_of(obj)) and not hasattr(obj.Proxy, "execute")


def bare_finding(obj) -> Finding:
    """The error of an object that nothing computes."""
    return error(
        "object-bare",
        obj.Label,
        "does not follow its input: nothing computes it, because the document was saved without "
        "BendTorsion, or opened by a script that had not imported it",
        "import BendTorsionWB.make before the document is opened; when it was saved without, run "
        "Repair document in the window, or 'python3 -m BendTorsionWB repair FILE'",
    )


def _is_waiting(obj) -> bool:
    """Whether an object was changed since it was computed, and FreeCAD may yet compute it."""
    return "Touched" in obj.State and obj.isValid()


def attach_view(obj) -> None:
    """Give the object its view provider when there is a window."""
    if FreeCAD.GuiUp:
        from BendTorsionWB.gui import view_providers

        view_providers.attach(obj)
