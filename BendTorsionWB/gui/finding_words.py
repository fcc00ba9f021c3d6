# SPDX-License-Identifier: LGPL-2.1-or-later
"""Findings in the language of the window; what documents and files hold of them stays English."""

from __future__ import annotations

import html
import json
import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace

import FreeCAD
import FreeCADGui

from BendTorsionWB.core import finding_language
from BendTorsionWB.core.finding import BendTorsionError, Finding

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
CHINESE = "zh-CN"
SIZES = {
    "t_top": QT_TRANSLATE_NOOP("BendTorsion", "top plate thickness"),
    "t_bottom": QT_TRANSLATE_NOOP("BendTorsion", "bottom plate thickness"),
    "t_web": QT_TRANSLATE_NOOP("BendTorsion", "web thickness"),
    "b_bottom": QT_TRANSLATE_NOOP("BendTorsion", "breadth at the bottom"),
}
"""Columns of the schedule that findings name, in the words of the panels."""
SIZE = re.compile(rf"(?<![\w.-])(?:{'|'.join(SIZES)})(?![\w.-])", re.ASCII)
FIGURE = re.compile(r"[-+]?\d[\d.,]*")

COUNTED = {
    "error": QT_TRANSLATE_NOOP("BendTorsion", "Errors: {count}"),
    "warning": QT_TRANSLATE_NOOP("BendTorsion", "Warnings: {count}"),
    "note": QT_TRANSLATE_NOOP("BendTorsion", "Notes: {count}"),
}


def is_chinese() -> bool:
    """Whether FreeCAD has a window, and it is in Simplified Chinese."""
    if not FreeCAD.GuiUp:
        return False
    return FreeCADGui.supportedLocales().get(FreeCADGui.getLocale()) == CHINESE


def of_text(text: str) -> Finding:
    """A finding from a text of property Findings."""
    return Finding(**json.loads(text))


def line(finding: Finding) -> str:
    """The whole finding as one line."""
    return finding_language.chinese_line(finding) if is_chinese() else finding.line()


def _sizes_named(text: str) -> str:
    """A text with the sizes of a section as a panel calls them."""
    return SIZE.sub(lambda found: translate("BendTorsion", SIZES[found[0]]), text)


def counts(severities: Iterable[str]) -> str:
    """How many there are of each severity, as a heading; empty when there are none."""
    found = Counter(severities)
    told = [
        translate("BendTorsion", text).format(count=found[severity])
        for severity, text in COUNTED.items()
        if found[severity]
    ]
    return ("，" if is_chinese() else ", ").join(told)


def told(problem: BendTorsionError) -> str:
    """An error as the window says it, a sentence for each finding: what is wrong, and its mend.
    What is selected wrongly is no fault of an object, and none is named."""
    return "\n".join(map(_sentence, problem.findings))


def _sentence(finding: Finding) -> str:
    if finding.code == "selection":
        own = _told(finding)
        between = "：" if is_chinese() else ": "
        text = between.join(part for part in (own.message, own.mend) if part)
    elif is_chinese():
        # What the system says of a file stays English; the severity before it does not.
        return finding_language.chinese_line(finding)
    else:
        text = finding.line().removeprefix(f"{finding.severity}: ").replace(" -> ", ": ")
    return f"{text[:1].upper()}{text[1:]}{'。' if is_chinese() else '.'}"


def first_error(obj) -> str:
    """The first error of an object as one line; empty when there is none."""
    found = map(of_text, obj.Findings)
    return next((line(finding) for finding in found if finding.severity == "error"), "")


def reason(finding: Finding) -> str:
    """What is wrong, by how much, and what mends it, told where the place is seen: at a field or a
    cell."""
    own = _told(finding)
    figures = finding_language.chinese_figures(own) if is_chinese() else own.figures()
    told = (f"{own.message}{figures}", own.mend)
    return ("。" if is_chinese() else ". ").join(part for part in told if part)


def short_line(finding: Finding) -> str:
    """Object, place, message, value against limit and mend, as HTML; properties are marked."""
    own = _told(finding)
    position = "" if finding.position.startswith("property ") else own.position
    place = ("，" if is_chinese() else ", ").join(part for part in (own.object, position) if part)
    text = html.escape(f"{place}: {own.message}", quote=False)
    if isinstance(own.value, float) and isinstance(own.limit, float):
        text += f" ({own.value:.5g} / {own.limit:.5g} {own.unit})"
    return f"{text} &rarr; {html.escape(own.mend, quote=False)}" if own.mend else text


def cells(finding: Finding, names: Sequence[str]) -> list[str]:
    """What a table shows of some fields of a finding."""
    own = _told(finding)
    told = []
    for name in names:
        value = getattr(own, name)
        if name == "severity" and is_chinese():
            value = finding_language.SEVERITIES_CHINESE[value]
        elif isinstance(value, float):
            value = f"{value:.6g} {own.unit}".strip()
        told.append("" if value is None else str(value))
    return told


def _told(finding: Finding) -> Finding:
    found = finding_language.chinese_finding(finding) if is_chinese() else finding
    message, mend = _sizes_named(found.message), _sizes_named(found.mend)
    return replace(found, message=message, mend=mend)


def in_window_words(finding: Finding, document) -> Finding:
    """A finding about a property of an object, with what the window calls it in place of its name,
    which is told once."""
    from BendTorsionWB.gui.property_words import label_of

    name = finding.position.removeprefix("property ")
    owners = document.getObjectsByLabel(finding.object)
    kinds = [obj.BT_Type for obj in owners if {name, "BT_Type"} <= {*obj.PropertiesList}]
    if not kinds or name == finding.position:
        return finding
    start, between, rest = finding.message.partition(": ")
    told = re.sub(rf"\b{name}\b", lambda _: label_of(kinds[0], name), rest, count=1)
    return replace(finding, message=f"{start}{between}{told}", position="")


def errors_of(objects) -> Counter:
    """How often each error is told of objects, whatever figures it names; each finding counts once,
    though objects downstream repeat it."""
    return Counter(map(_kind, _errors(_texts(objects))))


def further_errors(objects, before: Counter, elsewhere) -> list[str]:
    """The errors of objects that are more than those before (`errors_of`), as lines; without those
    that nodes among `elsewhere` tell of members that are right by themselves: the other member may
    be mended next."""
    members = [obj for obj in objects if getattr(obj, "BT_Type", "") == "Member"]
    nodes = [obj for obj in elsewhere if getattr(obj, "BT_Type", "") == "Node"]
    found = _errors(_texts(objects) - (_texts(nodes) - _texts(members)))
    more = Counter(map(_kind, found)) - before
    return [line(one) for one in found if _kind(one) in more]


def _texts(objects) -> set[str]:
    return {text for obj in objects for text in getattr(obj, "Findings", ())}


def _errors(texts) -> list[Finding]:
    return [one for one in map(of_text, sorted(texts)) if one.severity == "error"]


def _kind(finding: Finding) -> tuple[str, str, str]:
    return finding.object, finding.code, FIGURE.sub("", finding.message)
