# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is killed at its writes: commands on a small project, each from the same folder.

A process that forks must not have used Open CASCADE's threads: they are not in its children, which
wait for them (7.8). So even what comes before is done in children, and as a script,
`kill_scenarios.py FOLDER PLACES NAME...`, this tries scenarios in a process of its own.
"""

import json
import os
import shutil
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
    from BendTorsionWB import freecad_path

    freecad_path.append()

import killed_writes
import openpyxl
from test_build import schedule

from BendTorsionWB import document_export, project, round_trip
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange import known_hashes
from BendTorsionWB.exchange.csv_folder import read_folder
from BendTorsionWB.model_files import Wanted
from BendTorsionWB.sheets.pdf import start_qt

POINTS = [[x, 0, 20000 * (1 - (x / 40000) ** 2) ** 0.5] for x in (0, 1000, 2000, 3000)]


LOADED = ("out/model.", "out/.bendtorsion.json")
"""Of a document that was updated before the kill the shapes are loaded, not made: rounded to the
digits of a file."""


@dataclass(frozen=True)
class Scenario:
    """action: on the folder `work`, made of `before` each time; points: how many writes it takes;
    old, new: {name: bytes} before and after it; once: whether it refuses to be done twice;
    swept: whether unfinished files of the killed run go with the next; sheets: a schedule
    written back, as read before and after."""

    name: str
    action: Callable
    work: Path
    before: Path
    points: int
    old: dict
    new: dict
    once: bool
    swept: bool
    sheets: tuple


def scenarios(folder, names=()):
    """All scenarios, or those whose names begin so; their undisturbed runs made."""
    start_qt()
    # How many files are old enough to have their hashes kept would depend on how busy the machine
    # is, and with it the number of writes.
    known_hashes.SETTLED = -1_000_000_000
    first, second = (folder / f"{name}.xlsx" for name in ("first", "second"))
    for path, size in ((first, 500), (second, 480)):
        schedule(path, [POINTS])
        book = openpyxl.load_workbook(path)
        book["Sections"]["C3"] = size
        if path == second:
            # A plate and a joint less: files of the first build go.
            del book["Splits"]
        page = book.create_sheet("Settings")
        for row in (("key", "value"), ("project", "Hall")):
            page.append(row)
        book.save(path)
    work = folder / "work"
    out = work / "out"
    made = []

    def scenario(name, prepare, action, once=False, swept=True):
        if names and not name.startswith(tuple(names)):
            return
        before = folder / f"before {len(made)}"
        before.mkdir()
        reset(work, before)
        begun = killed_writes.run(prepare)
        assert not begun.failure, (name, begun.failure)
        shutil.rmtree(before)
        shutil.copytree(work, before, symlinks=True)
        old, sheets = killed_writes.content(work), [_read_back(work)]
        done = killed_writes.run(action)
        assert not done.failure, (name, done.failure)
        assert not killed_writes.leftovers(work), name
        new = killed_writes.content(work)
        sheets.append(_read_back(work))
        made.append(
            Scenario(name, action, work, before, done.points, old, new, once, swept, tuple(sheets))
        )

    def nothing():
        """Nothing to begin with."""

    def built():
        project.build(first, out, workers=1)

    def issued():
        built()
        project.issue_folder(out, "A")
        project.build(second, out, workers=1)

    def by_hand():
        built()
        with open(out / "model.FCStd", "ab") as stream:
            stream.write(b"by hand")

    update = Wanted(update=True, removing=True)
    scenario("build", nothing, built)
    scenario("build of a change", built, lambda: project.build(second, out, workers=1))
    scenario("build over work by hand", by_hand, built)
    scenario(
        "build in groups",
        built,
        lambda: project.build(first, out, workers=1, wanted=Wanted(split=1, sheets=False)),
    )
    scenario("update", built, lambda: project.build(second, out, workers=1, wanted=update))
    scenario(
        "export",
        built,
        lambda: document_export.export_document(out / "model.FCStd", work / "export", workers=1),
    )
    scenario(
        "export as workbook",
        built,
        lambda: round_trip.write_document_back(out / "model.FCStd", work / "back.xlsx"),
        swept=False,
    )

    def back_before():
        built()
        round_trip.write_document_back(out / "model.FCStd", work / "back")
        project.build(second, out, workers=1)

    scenario(
        "export as CSV over another",
        back_before,
        lambda: round_trip.write_document_back(out / "model.FCStd", work / "back"),
    )
    scenario("issue", built, lambda: project.issue_folder(out, "A", "first"), once=True)
    scenario("second issue", issued, lambda: project.issue_folder(out, "B"), once=True)
    scenario("build after an issue", issued, lambda: project.build(first, out, workers=1))
    figures = document_export.source_records(first, workers=1)
    for kind in ("xlsx", "json"):
        target = work / f"figures.{kind}"

        def write(target=target):
            document_export.write_figures(figures, target)

        scenario(f"report as {kind}", nothing, write, swept=False)
    return made


def reset(work, before):
    """Make `work` as it was before."""
    for path in [work] if work.exists() else []:
        for inner in path.rglob("*"):
            if inner.is_dir():
                os.chmod(inner, 0o755)
        shutil.rmtree(path)
    shutil.copytree(before, work, symlinks=True)


def tried(one, place):
    """The scenario killed at one point: what was lost, and what stops the next run; empty texts
    when all is well."""
    reset(one.work, one.before)
    ended = killed_writes.run(one.action, place)
    where = f"{one.name}, point {place}: "
    if not ended.killed:
        return f"{where}was not reached", ""
    now = killed_writes.content(one.work)
    lost = _with_folder(one, now)
    again = killed_writes.run(one.action)
    done = one.once and "is issued already" in again.failure
    stuck = "" if done else again.failure
    if not stuck:
        now = killed_writes.content(one.work)
        wrong = [
            name
            for name in sorted({*one.new, *now})
            if one.new.get(name) != now.get(name)
            and not name.endswith("timing.json")
            and ".former" not in name
            and not (one.name == "update" and name.startswith(LOADED))
        ]
        # Beside a file named by hand another program may be at work: there nothing is swept up.
        left = killed_writes.leftovers(one.work) if one.swept else []
        stuck = "; ".join([*wrong[:4], *left[:3]])
    return (where + "; ".join(lost[:4]) if lost else "", where + stuck if stuck else "")


def _read_back(work):
    """The sheets of the schedule written back as CSV, as they are read; None without one."""
    if not (work / "back").is_dir():
        return None
    try:
        book = read_folder(work / "back")
    except BendTorsionError:
        return None
    return {page.title: list(page.iter_rows(values_only=True)) for page in book.worksheets}


def _with_folder(one, now):
    """Faults of every file; the files of a folder of CSV must be of one schedule, too."""
    mixed = _read_back(one.work) not in one.sheets
    found = killed_writes.faults(one.old, one.new, now)
    return [*["sheets of two schedules in one folder"] * mixed, *found]


def main(folder, places, *names):
    """Print of each scenario its name, and what was lost and stuck, at so many places along it."""
    for one in scenarios(Path(folder), names):
        step = one.points / int(places)
        ends = [tried(one, max(1, round((k + 0.7) * step))) for k in range(int(places))]
        print(json.dumps([one.name, *([e for e in side if e] for side in zip(*ends))]))


if __name__ == "__main__":
    main(*sys.argv[1:])
