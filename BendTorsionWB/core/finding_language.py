# SPDX-License-Identifier: LGPL-2.1-or-later
"""Findings in Chinese: messages and mends by a table of their templates, places by their words."""

from __future__ import annotations

import json
import re
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property, lru_cache
from itertools import product
from pathlib import Path

from .finding import Finding, figure_text

TABLE = Path(__file__).resolve().parents[2] / "resources/translations/findings_zh-CN.json"
SEVERITIES_CHINESE = {"error": "错误", "warning": "警告", "note": "提示"}
VALUE = re.compile(r"\*([^*]+)\*")
"""Where a value comes into a template."""
# Of these mends the reader types the value: it is a word of the schedule or of a property.
_TYPED = re.compile(r"use |write |give |did you mean |known |fill in |add ")
# Values that are names of objects, files, columns: "M1 plates" is a label.
_COLUMNS = {"name", "key", "keys", "column", "property", "known"}
_NAMES = _COLUMNS | {
    *("Label", "label", "owner", "member", "other", "others", "added", "through", "one"),
    *("mark", "axis", "section", "record", "project", "file"),
}
# Letters of a name beside figures are no words.
_WORD = re.compile(r"(?<![\w-])[a-z]{2,}(?![\w-])", re.ASCII)
_FACES = {"top", "bottom", "left", "right", "web"}
_NUMBERED = re.compile(r"[a-z]+ [\w-]*\d")
"""Such as `diaphragm 1`."""
_BRACKETS = re.compile(r" ?\(([a-z][^()]*)\)")
_SMALL = {"at", "in", "of", "on", "or", "to", "mm"}
_UNIT_WORDS = {"mm", "deg", "kg"}
_KINDS = {
    "Surface": "曲面",
    "Axis": "轴线",
    "SectionSpec": "截面",
    "Member": "构件",
    "PlateSet": "板件",
    "Unfold": "展开",
    "Node": "节点",
    "AssemblyBed": "胎架",
    "SheetSet": "图纸",
    "surface": "曲面",
    "axis": "轴线",
    "section": "截面",
    "member": "构件",
    "plate set": "板件",
    "development": "展开",
    "assembly bed": "胎架",
    "node": "节点",
    "sheets": "图纸",
    "shape": "形体",
}
_WORDS = {
    "face": "面",
    "faces": "面",
    "and": "与",
    "edge": "边",
    "saddle": "托架",
    "segment": "段",
    "row": "行",
    "column": "列",
    "point": "点",
    "station": "测站",
    "preset": "预拱",
    "line": "线",
    "lane": "分条",
    "piece": "单元",
    "diaphragm": "隔板",
    "opening": "开孔",
    "weld": "焊缝",
    "seam": "棱缝",
    "top": "上",
    "bottom": "下",
    "left": "左",
    "right": "右",
    "start": "始端",
    "end": "终端",
    "first": "首边",
    "second": "次边",
    "last": "末",
    "at": "在",
    "near": "约",
    "web": "腹板",
    "fold": "折线",
    "node": "节点",
    "section": "截面",
    "surface": "曲面",
    "axis": "轴线",
    "member": "构件",
    "plate": "板件",
    "sheet": "表",
    "property": "属性",
    "argument": "参数",
    "joint": "拼接缝",
    "strip": "板条",
    "transition": "过渡段",
    "ring": "环",
    "rails": "棱线",
    "run": "段",
    "outer": "外",
    "inner": "内",
}
_PHRASES = (
    (r"(\S+) to (\S+) mm along it\b", r"沿边 \1 至 \2 mm"),
    (r"(\S+) to (\S+) mm on the axis\b", r"沿轴线 \1 至 \2 mm"),
    (r"(\S+) to (\S+)", r"\1 至 \2"),
    (r"([^, ]+) on ([^, ]+)(?=,|$)", r"\1 止于 \2"),
    (r" in the plane\b", "（平面内）"),
    (r"([^, ][^,]*?) of ([^,]+)", r"\2 的 \1"),
)
"""What places say in more than a word."""
_OBJECTS = {"selection": "选择"}
"""Objects of findings that are no names."""
_CHINESE_END = re.compile(r"[\u3000-\u303f\u4e00-\u9fff\uff00-\uffef] ?$")
_CHINESE_START = re.compile(r" ?[\u3000-\u303f\u4e00-\u9fff\uff00-\uffef]")
_BLANK = re.compile(r"(?<=[\u4e00-\uffef]) (?=[\u4e00-\uffef])")
_UNITS = {"deg": "°", "degrees": "°", "of the width": "板宽"}
# What names a column, a property or an argument is no word either.
_PLACE_WORD = re.compile(
    r"(?<![\w-])(?<!column )(?<!property )(?<!argument )[a-z]+(?![\w-])",
    re.ASCII,
)
_BOUNDS = {"at least": "至少", "at most": "至多", "above": "大于", "below": "小于"} | {
    "within +/-": "±",
    "to": "至",
}
_BOUND = re.compile(r"\b(?:at least|at most|above|below|(?<=% )to(?= \d))\b|within \+/-")
"""What limits say beside figures."""


@dataclass(frozen=True)
class Template:
    """An English text with places for values, and its Chinese. fixed: what stands before, between
    and behind the values; names: of the values, in their order; chinese: Chinese texts and, between
    them, the number of a value, from 0."""

    english: str
    fixed: tuple[str, ...]
    names: tuple[str, ...]
    chinese: tuple[str | int, ...]

    def values(self, text: str, pattern: re.Pattern) -> tuple[str, ...] | None:
        """The values of a text of this template by one of its patterns; None for another text."""
        # A find costs a tenth of a match, and nearly all templates end here.
        if self.longest not in text or not text.startswith(self.fixed[0]):
            return None
        found = pattern.fullmatch(text)
        return found.groups() if found else None

    @cached_property
    def longest(self) -> str:
        """The longest text between values."""
        return max(self.fixed, key=len)

    @cached_property
    def rank(self) -> tuple[int, str]:
        """Its place among all: the most letters of its own first."""
        return -sum(map(len, self.fixed)), self.english

    @cached_property
    def whole_words(self) -> set[str]:
        """What stands between blanks in every text of this template."""
        return {word for word in VALUE.sub("*", self.english).split(" ") if "*" not in word}

    @cached_property
    def words(self) -> int:
        """How many words it has of its own, but for those that names have too."""
        return len([word for word in _WORD.findall(" ".join(self.fixed)) if word not in _SMALL])

    @cached_property
    def patterns(self) -> tuple[re.Pattern, ...]:
        """Match texts of this template, a group for each value: as short as can be, then longer
        ones, as values with a blank between them can be parted in several ways."""
        count = len(self.names)
        ways = (
            product(("(.*?)", "(.*)"), repeat=count - 1) if count < 4 else ((), ("(.*)",) * count)
        )
        return tuple(map(self._pattern, ways))

    def _pattern(self, ways: Sequence[str]) -> re.Pattern:
        groups = [*ways, *["(.*?)"] * (len(self.names) - len(ways)), ""]
        pairs = zip(map(re.escape, self.fixed), groups)
        return re.compile("".join(part for pair in pairs for part in pair))

    def filled(self, values: Sequence[str]) -> str:
        """The Chinese text with these values."""
        text = ""
        for part in self.chinese:
            text = _beside(text, part if isinstance(part, str) else values[part])
        return text


def template(english: str, told: str) -> Template:
    """A template of the table; the k-th value of a name in the Chinese is the k-th of that name in
    the English. Raises ValueError for a value that the English does not have."""
    names = VALUE.findall(english)
    left = {name: [at for at, own in enumerate(names) if own == name] for name in names}
    chinese: list[str | int] = []
    for k, part in enumerate(VALUE.split(told)):
        if k % 2 and not left.get(part):
            raise ValueError(f"{english}: there is no further value *{part}*")
        chinese.append(left[part].pop(0) if k % 2 else part)
    return Template(english, tuple(VALUE.split(english)[::2]), tuple(names), tuple(chinese))


@dataclass(frozen=True)
class _Table:
    """whole: texts without values. templates: with values, by a word that their texts have, those
    of none by an empty one. joints: two values with no word between them, such as `*name*:
    *message*`."""

    whole: dict[str, str]
    templates: dict[str, list[Template]]
    joints: tuple[Template, ...]

    def candidates(self, text: str) -> list[Template]:
        """The templates a text may be of, those with the most words of their own first."""
        words = {"", *text.split(" ")}
        found = [own for word in words for own in self.templates.get(word, ())]
        return sorted(found, key=lambda own: own.rank)


@cache
def _table(path: Path) -> _Table:
    """The table of a file; one that cannot be read is empty, and findings are told in English."""
    try:
        given = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        given = {}
    whole = {english: told for english, told in given.items() if not VALUE.search(english)}
    made = [template(english, told) for english, told in given.items() if english not in whole]
    made.sort(key=lambda own: own.rank)
    joints = [own for own in made if len(own.names) == 2 and not _WORD.search(" ".join(own.fixed))]
    count = Counter(word for own in made for word in own.whole_words)
    templates = defaultdict(list)
    for own in made:
        if own.words:
            templates[min(own.whole_words, key=count.get, default="")].append(own)
    return _Table(whole, templates, tuple(joints))


def chinese(text: str, path: Path = TABLE) -> str:
    """A message or a mend in Chinese; as it is where the table has no template for it."""
    return _chinese(" ".join(text.split()), path)


@lru_cache(maxsize=8192)
def _chinese(text: str, path: Path) -> str:
    """Of what a text can be taken for, the one that leaves the fewest English words; of several,
    the template with the most words of its own."""
    best, left = text, len(_WORD.findall(text)) + 1
    for told in _readings(text, path):
        english = len(_WORD.findall(told))
        if english < left:
            best, left = told, english
        if left == 0:
            break
    return best


def _readings(text: str, path: Path) -> Iterator[str]:
    """A text in Chinese by each way to take it for a text of the table."""
    table = _table(path)
    if text in table.whole:
        yield table.whole[text]
        return
    # Several texts one after another, a name before a text, a place behind it.
    yield from _listed(text, "; ", "；", 1, path)
    for own in table.candidates(text):
        yield from _filled(own, text, path)
    if told := _known(text, path):
        yield told
    yield from _listed(text, ", or ", "，或", 2, path)
    yield from _listed(text, ", ", "", 2, path)
    for own in table.joints:
        for at in _places(text, own.fixed[1]):
            head, tail = text[:at], text[at + len(own.fixed[1]) :]
            if " " in tail and _known(tail, path):
                yield own.filled([_known(head, path) or head, _known(tail, path)])


def _listed(text: str, between: str, told: str, words: int, path: Path) -> Iterator[str]:
    """Two texts of the table in Chinese, the second with what stands between them, or without it;
    told: the Chinese of that."""
    for at in _places(text, between):
        head, rest = _known(text[:at], path, words), text[at:]
        tail = _known(rest, path)
        if told and not tail:
            tail = _known(rest.removeprefix(between), path, words)
            tail = tail and told + tail
        if head and tail:
            yield head + tail


def _places(text: str, between: str) -> list[int]:
    """Where a text can be parted."""
    return [found.start() for found in re.finditer(re.escape(between), text) if found.start() > 0]


@lru_cache(maxsize=8192)
def _known(text: str, path: Path, words: int = 2, place: bool = True) -> str:
    """A text of the table, or of a template of so many words, in Chinese, with a place behind it
    where there is one; empty for another text. One word can be that of a name."""
    table = _table(path)
    if text in table.whole:
        return table.whole[text]
    for own in table.candidates(text):
        if own.words >= words:
            for told in _filled(own, text, path):
                return told
    for at in _places(text, " at ") if place else ():
        if told := _known(text[:at], path, words, False):
            return f"{told}（{in_chinese(text[at + 4 :])}）"
    return ""


def _filled(own: Template, text: str, path: Path) -> Iterator[str]:
    """A text of a template in Chinese, by each way to part its values."""
    tried = set()
    for pattern in own.patterns:
        values = own.values(text, pattern)
        if values is None:
            return
        if values not in tried:
            tried.add(values)
            yield own.filled([_value(own, *pair, path) for pair in zip(own.names, values)])


def _value(own: Template, name: str, value: str, path: Path) -> str:
    """A value: a text of the table itself, words of a place or a kind of object; else as it is."""
    if name in _NAMES:
        told = _known(value, path) if " " in value else ""
        place = _NUMBERED.fullmatch(value) or (value in _FACES and name not in _COLUMNS)
        return in_chinese(value) if place else told or value
    typed = _TYPED.match(own.english)
    if typed and " " not in value and name != "…":
        return value
    told = _chinese(value, path)
    if told != value or typed:
        return _bounded(told)
    inner = _BRACKETS.sub(lambda found: f"（{_known(found[1], path) or found[1]}）", value)
    told = _KINDS.get(value.removeprefix("a ").removeprefix("an ")) or in_chinese(inner)
    if told == value or set(_WORD.findall(told)) - _UNIT_WORDS:
        return value
    return _BLANK.sub("", told)


def _bounded(limit: str) -> str:
    """A limit with its words in Chinese."""
    return _BOUND.sub(lambda found: _BOUNDS[found[0]], limit)


def in_chinese(place: str) -> str:
    """Where a finding is, in Chinese; names and figures as they are."""
    for phrase, told in _PHRASES:
        place = re.sub(phrase, told, place)
    return _PLACE_WORD.sub(lambda word: _WORDS.get(word[0], word[0]), place)


def chinese_finding(finding: Finding) -> Finding:
    """The finding with its place, its texts, limit and unit in Chinese."""
    told = {
        name: _bounded(value) if isinstance(value, str) else value
        for name, value in (("value", finding.value), ("limit", finding.limit))
    }
    return replace(
        finding,
        object=_OBJECTS.get(finding.object, finding.object),
        position=in_chinese(finding.position),
        message=chinese(finding.message),
        mend=chinese(finding.mend),
        unit=_UNITS.get(finding.unit, finding.unit),
        **told,
    )


def chinese_line(finding: Finding, length: Callable[[float], str] | None = None) -> str:
    """The finding as one line in Chinese, with its severity; length: as of `Finding.line`."""
    parts = (SEVERITIES_CHINESE[finding.severity], chinese_text(finding, length))
    return "：".join(part for part in parts if part)


def chinese_text(finding: Finding, length: Callable[[float], str] | None = None) -> str:
    """Place, message, figures and mend of a finding in Chinese; length: as of `Finding.line`."""
    own = chinese_finding(finding)
    place = "，".join(part for part in (own.object, own.position) if part)
    text = "：".join(part for part in (place, own.message) if part)
    text += chinese_figures(own, length)
    return " ".join((f"{text}。{own.mend}" if own.mend else text).split())


def chinese_figures(own: Finding, length: Callable[[float], str] | None = None) -> str:
    """Value and limit of a finding that is in Chinese, as they stand behind its message; length: as
    of `Finding.line`."""
    figures = [
        _beside(f"{name} ", figure_text(value, own.unit, length))
        for name, value in (("实际", own.value), ("限值", own.limit))
        if value not in (None, "")
    ]
    return f"（{'，'.join(figures)}）" if figures else ""


def _beside(one: str, other: str) -> str:
    """Two texts, without the blank between them where both are Chinese there."""
    if _CHINESE_END.search(one) and _CHINESE_START.match(other):
        return one.removesuffix(" ") + other.removeprefix(" ")
    return one + other
