# SPDX-License-Identifier: LGPL-2.1-or-later
"""A document brought up to a changed schedule: the same objects, what people added kept.

A new document is made of the schedule and compared with the one there is, object by object and
property by property; only what differs is written, so that a recompute reaches only that.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import FreeCAD

from BendTorsionWB.core.detailing import MemberJob
from BendTorsionWB.core.finding import BendTorsionError, Finding, error, warning
from BendTorsionWB.document import build_document, equal_labels, mark_from_schedule
from BendTorsionWB.document_difference import members_of, renamed_objects
from BendTorsionWB.document_objects import (
    follows,
    inputs_of,
    key_of,
    kind_of,
    objects_of,
    owner_of,
    same,
    value_of,
)
from BendTorsionWB.document_pairs import counterparts
from BendTorsionWB.document_settings import keep_rows, keep_style, rows_in, style_in
from BendTorsionWB.exchange.difference import Change
from BendTorsionWB.exchange.file_kind import DOCUMENT, check_ending
from BendTorsionWB.exchange.linked_documents import linked_documents, refuse_linked
from BendTorsionWB.exchange.renames import Key
from BendTorsionWB.exchange.schedule_rows import Schedule
from BendTorsionWB.interrupts import stop_if_asked, to_the_end
from BendTorsionWB.objects import sheet as sheet_object
from BendTorsionWB.objects.preference import without_faces
from BendTorsionWB.objects.proxy import add_property

DRAWN = ("SheetSet", "ArrangementSet", "NodeSheets")
"""Objects with drawing pages."""


@dataclass
class Update:
    """Brings documents up to schedules. removing: whether objects of rows that are gone go too;
    partial: whether members are left out, so that it is not known which these are.
    changes and findings: what was done and what was left, in all documents so far."""

    removing: bool = False
    partial: bool = False
    changes: list[Change] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)

    def document_of(self, schedule: Schedule, jobs: dict[str, MemberJob], sheets: bool, path: Path):
        """The document at path, opened and brought up to the schedule, and what was left in it; a
        new one when there is none, or only that of a split model. Raises BendTorsionError for a
        file that cannot be opened."""
        if not path.exists() or linked_documents(path):
            return build_document(schedule, jobs, sheets), ()
        before = len(self.findings)
        document = open_document(path)
        template = build_document(schedule, jobs, sheets)
        try:
            if any(obj.ExpressionEngine for obj in document.Objects):
                # Saved before it was computed, a property is not yet what its expression says.
                with to_the_end(), without_faces():
                    document.recompute()
            self.bring(document, template, sheets)
        except BaseException:
            FreeCAD.closeDocument(document.Name)
            raise
        finally:
            FreeCAD.closeDocument(template.Name)
        return document, tuple(self.findings[before:])

    def bring(self, document, template, sheets: bool = True) -> None:
        """Make the objects of a document those of the template, and no others of ours. sheets:
        whether the template has drawing sheets; those of the document stay in any case."""
        keep_style(document, style_in(template))
        keep_rows(document, rows_in(template))
        wanted, present = objects_of(template), objects_of(document)
        paired = counterparts(present, wanted)
        with equal_labels():
            self._follow(wanted, present, paired, sheets)
        new = [key for key in wanted if key not in present]
        gone = {
            key: obj
            for key, obj in present.items()
            if key not in wanted
            and not self.partial
            and getattr(obj, "FromSchedule", "")
            and (sheets or key[0] not in DRAWN or _is_idle(obj, wanted))
        }
        known = {was: key[1] for key, was in paired.items()}
        renamed = renamed_objects(gone, {key: wanted[key] for key in new}, known)
        told = {obj.Label for obj in (*gone.values(), *(wanted[key] for key in new))}
        with equal_labels():
            for key in new:
                present[key] = _created(document, wanted[key])
                self.changes.append(Change("added", *key, member=members_of([wanted[key]])))
            for key, model in wanted.items():
                stop_if_asked()
                self._copy(model, present[key], present, key in new, told)
        for (kind, was), name in renamed.items():
            members = members_of([present[kind, name]])
            self.changes.append(Change("renamed", kind, name, "", was, name, members))
        self._remove(document, list(gone.values()), renamed)

    def _follow(self, wanted, present, paired: Mapping[Key, Key], sheets: bool) -> None:
        """Give objects with other labels by hand the rows of these, and what is named after one its
        name: the sheets of a member, too, where the template has none."""
        following = {key: was for key, was in paired.items() if key != was}
        drawn = {} if sheets else _sheets_of(following, present)
        # Taken out before any is put in: two may have each other's names.
        moved = {key: present.pop(was) for key, was in (following | drawn).items()}
        present.update(moved)
        for key, was in following.items():
            obj = moved[key]
            _rename(obj, key[1], wanted[key].Label)
            if owner_of(obj) == obj and kind_of(obj) not in ("File", "Node"):
                members = members_of([obj])
                self.changes.append(Change("renamed", *key, "Label", was[1], key[1], members))
        for key in drawn:
            _rename(moved[key], key[1], key[1])

    def _copy(self, model, obj, present, is_new: bool, told: Collection[str]) -> None:
        if kind_of(model) != "File":
            for declared in model.Proxy.declared(model):
                add_property(obj, declared)
        bound = {path.split(".")[0] for path, _ in obj.ExpressionEngine}
        for name in inputs_of(model):
            before, after = value_of(obj, name), value_of(model, name)
            if same(before, after):
                continue
            if name in bound:
                self.findings.append(
                    warning(
                        "bound-by-hand",
                        obj.Label,
                        f"{name} follows an expression and not the schedule: document, STEP and "
                        "IFC are not what drawings and cut files are of",
                        "delete the expression to follow the schedule again",
                        position=f"property {name}",
                        value=_text(before),
                        limit=_text(after),
                    )
                )
                continue
            setattr(obj, name, _own(getattr(model, name), present))
            if not (is_new or follows(obj, name, before, after, told)):
                self.changes.append(
                    Change(
                        "changed", kind_of(obj), obj.Label, name, before, after, members_of([obj])
                    )
                )

    def _remove(self, document, gone: Sequence, renamed: Mapping[Key, str]) -> None:
        # Of a meeting, not of a row: members that stay and have no node leave it nothing to be at.
        nodes = [
            obj
            for obj in gone
            if kind_of(obj) == "Node" and obj.Through not in gone and obj.Other not in gone
        ]
        going = list(gone) if self.removing else []
        left: dict = {}
        for obj in gone:
            if self.removing or (obj in nodes and not _added_by_hand(obj, gone)):
                members = members_of([obj])
                self.changes.append(Change("removed", kind_of(obj), obj.Label, member=members))
                going += [] if obj in going else [obj]
            else:
                owner = owner_of(obj)
                left.setdefault(owner if owner in gone else obj, []).append(obj)
        for owner, objects in left.items():
            others = [obj.Label for obj in objects if obj != owner]
            added = dict.fromkeys(name for obj in objects for name in _added_by_hand(obj, gone))
            with_them = f", with {', '.join(others)}" if others else ""
            used = f"; {', '.join(added)} made by hand use it" if added else ""
            now = renamed.get(key_of(owner))
            used += f"; {now} has the same content, as when it is renamed" if now else ""
            self.findings.append(
                warning(
                    "row-removed",
                    owner.Label,
                    f"{kind_of(owner)} {owner.Label} is in the document and no longer in the "
                    f"schedule{with_them}{used}",
                    "run update with --remove to remove it",
                )
            )
        # What uses an object goes before it.
        for obj in sorted(going, key=lambda obj: len(obj.OutListRecursive), reverse=True):
            if kind_of(obj) in DRAWN:
                sheet_object.remove_pages(obj)
            document.removeObject(obj.Name)


def _sheets_of(following: Mapping[Key, Key], present: Mapping[Key, object]) -> dict[Key, Key]:
    """By the key they get: those of the sheets of members that follow another row."""
    names = {was: key[1] for key, was in following.items()}
    owners = {key: key_of(owner_of(obj)) for key, obj in present.items() if key[0] == "SheetSet"}
    return {
        (key[0], names[own] + key[1].removeprefix(own[1])): key
        for key, own in owners.items()
        if own in names
    }


def _rename(obj, row: str, label: str) -> None:
    """Let an object follow a row of this name."""
    obj.Label = label
    if getattr(obj, "FromSchedule", ""):
        obj.FromSchedule = row


def _is_idle(obj, wanted: Mapping[Key, object]) -> bool:
    """Whether there is nothing to draw on pages, whether or not any are wanted: sheets of a member,
    and those of nodes."""
    if kind_of(obj) == "NodeSheets":
        return not any(kind == "Node" for kind, _ in wanted)
    return kind_of(obj) == "SheetSet" and key_of(owner_of(obj)) not in wanted


def open_document(path: Path):
    """A saved document, hidden; raises BendTorsionError for one that cannot be opened."""
    # FreeCAD would open what is no document too, such as a workbook, as a new one.
    check_ending(path, DOCUMENT)
    refuse_linked(path)
    stop_if_asked()
    try:
        with to_the_end(), without_faces():
            return FreeCAD.openDocument(str(path), hidden=True)
    except Exception as problem:
        raise BendTorsionError(
            error(
                "document-unreadable",
                path.name,
                f"FreeCAD cannot open it: {problem}",
                "restore it, or build the schedule anew",
                value=str(path),
            )
        ) from problem


def _created(document, model):
    """A new object of the kind of another, without its values."""
    obj = document.addObject(model.TypeId, model.Name.rstrip("0123456789"))
    obj.Label = model.Label
    if kind_of(model) != "File":
        type(model.Proxy)(obj)
    mark_from_schedule([obj])
    return obj


def _own(value, present):
    """A property's value with links to objects of the same kind and label."""
    if hasattr(value, "Label"):
        return present[kind_of(value), value.Label]
    if isinstance(value, (tuple, list)):
        return type(value)(_own(item, present) for item in value)
    return value.copy() if hasattr(value, "exportBrepToString") else value


def _added_by_hand(obj, gone: Iterable) -> list[str]:
    names = {other.Name for other in gone}
    return [
        user.Label
        for user in obj.InListRecursive
        if user.Name not in names
        and not getattr(user, "FromSchedule", False)
        and not user.isDerivedFrom("TechDraw::DrawPage")
        and getattr(user, "BT_Type", "") not in ("PageOutlines", "PageSymbol")
        and not user.isDerivedFrom("TechDraw::DrawView")
        and user.TypeId != "App::LinkGroup"
    ]


def _text(value) -> str | float | None:
    return value if value is None or isinstance(value, (int, float, str)) else str(value)
