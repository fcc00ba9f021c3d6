# SPDX-License-Identifier: LGPL-2.1-or-later
"""A plain reader of STEP files (ISO 10303-21), letter by letter, to check what was written."""

import re


def records(content: bytes) -> dict[int, str]:
    """The records of the data section by number, strings with their quotes. No number twice."""
    text = content.decode()
    data = text[text.index("DATA;") + 5 :]
    found, current, inside = {}, [], False
    for letter in data:
        if letter == "'":
            inside = not inside
        if letter == ";" and not inside:
            record = "".join(current).strip()
            current = []
            if record == "ENDSEC":
                return found
            number, _, body = record.partition("=")
            key = int(number.strip()[1:])
            assert number.startswith("#") and key not in found
            found[key] = body.strip()
            continue
        current.append(letter)
    raise AssertionError("the data section does not end")


def references(body: str) -> list[int]:
    """Numbers a record refers to: those outside of its strings."""
    return [int(number) for number in re.findall(r"#(\d+)", "".join(body.split("'")[::2]))]


def strings(body: str) -> list[str]:
    """The strings of a record."""
    found = re.findall(r"'((?:[^']|'')*)'", body)
    return [text.replace("''", "'").replace("\\\\", "\\") for text in found]


class Tree:
    """Products of a file, what they are made of, and the colours of solids."""

    def __init__(self, content: bytes):
        self.records = found = records(content)
        missing = {n for body in found.values() for n in references(body)} - found.keys()
        assert not missing
        self.names = {n: strings(found[self._of(n, 2)])[0] for n in self.all("PRODUCT_DEFINITION")}
        self.parts = {}
        self.uses = []
        for number in self.all("NEXT_ASSEMBLY_USAGE_OCCURRENCE"):
            whole, part = references(found[number])
            self.parts.setdefault(whole, []).append(part)
            self.uses.append(strings(found[number])[0])

    def all(self, kind):
        """Numbers of the records of a kind."""
        return [n for n, body in self.records.items() if body.startswith(f"{kind}(")]

    def _of(self, number, depth):
        for _ in range(depth):
            number = references(self.records[number])[0]
        return number

    def root(self):
        """(name, [parts]), parts alike, of the one product that is part of no other."""
        parts = {part for own in self.parts.values() for part in own}
        (root,) = self.names.keys() - parts
        return self._branch(root)

    def _branch(self, number):
        return self.names[number], [self._branch(part) for part in self.parts.get(number, ())]

    def colours(self):
        """(red, green, blue) of each solid by its name."""
        found = {}
        for number in self.all("STYLED_ITEM"):
            style, solid = references(self.records[number])
            colour = self._of(style, 6)
            values = self.records[colour].partition(",")[2].rstrip(")").split(",")
            found[strings(self.records[solid])[0]] = tuple(map(float, values))
        return found
