# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an edit of one section computes again in the document of a project, counted by kind.

Run: python3 benchmarks/recompute_counts.py [members, 6 when left out]

Ribs of the concert hall take turns with two pairs of sections; one section's height is changed.
Prints how many objects of each kind there are, how many depend on that section by their links, and
how many were computed; the last two are to be equal.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "benchmarks")]

from project import write_building  # noqa: E402

from BendTorsionWB.document import build_document  # noqa: E402
from BendTorsionWB.objects import proxy  # noqa: E402
from BendTorsionWB.project import read_jobs  # noqa: E402


def counted(action) -> Counter:
    """Objects computed by an action, by kind."""
    ran = Counter()
    plain = {kind: kind.build for kind in proxy.Proxy.__subclasses__()}

    def counting(build):
        def counted_build(self, obj):
            ran[proxy.type_of(obj)] += 1
            return build(self, obj)

        return counted_build

    for kind, build in plain.items():
        kind.build = counting(build)
    try:
        action()
    finally:
        for kind, build in plain.items():
            kind.build = build
    return ran


def main(count: int) -> None:
    """Print the table."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "building.xlsx"
        write_building(path, count)
        schedule, jobs = read_jobs(path)
        document = build_document(schedule, jobs, sheets=False)
    document.recompute()
    [section] = [obj for obj in document.Objects if obj.Label == "B600-1"]

    def edit():
        section.Height = 620
        document.recompute()

    depends = Counter(proxy.type_of(obj) for obj in (section, *section.InListRecursive))
    ran = counted(edit)
    present = Counter(proxy.type_of(obj) for obj in document.Objects)
    print(f"{'kind':<16}{'objects':>9}{'depend':>9}{'computed':>9}")
    for kind in present:
        if kind:
            same = "ok" if ran[kind] == depends[kind] else "OTHER"
            print(f"{kind:<16}{present[kind]:>9}{depends[kind]:>9}{ran[kind]:>9} {same}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 6)
