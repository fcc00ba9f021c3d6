# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes the example of a revision in docs/projects.md: the concert hall issued, changed, built and
issued again by the command line, and what that told.

Run: /usr/bin/python3 docs/make_revision_example.py [FOLDER] [BUILD OPTIONS]
where the options may be such as --no-model --no-sheets

FOLDER (build/revision when left out) is made anew. Prints the text and puts it between its marks
in docs/projects.md.
"""

import csv
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import openpyxl

ROOT = Path(__file__).resolve().parent.parent
HALL = ROOT / "resources" / "examples" / "concert_hall" / "concert_hall.xlsx"
PAGE = ROOT / "docs" / "projects.md"
SHELL = "$ /usr/bin/python3 -m BendTorsionWB"
START, END = "<!-- by docs/make_revision_example.py -->", "<!-- end -->"
CHANGES = (
    ("Sections", {"section": "B600-2"}, "h", 620),
    ("Members", {"member": "M1", "segment": 2}, "cut", 7200),
    ("Splits", {"member": "M16", "face": "left"}, "joints", "4000"),
)
CUT = ("M1-B3", "M2-L5", "M3-T1")
AGREED = {"M1-B3": "trim", "M2-L5": "scrap"}
PLATES = ("M1-T1", "M1-B3", "M1-B4", "M2-L5", "M3-T1", "M16-L3", "M16-L4")
FILES = ("model.step", "sheets/M1.pdf", "plates/M1-B3.dxf", "plates/M3-B1.dxf", "plates/M16-L4.dxf")


def run(folder: Path, *words: str, good: bool = True) -> list[str]:
    """A command of BendTorsion in the folder: the lines it prints, those of errors first."""
    command = [sys.executable, "-m", "BendTorsionWB", *words]
    done = subprocess.run(
        command,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
    )
    if good == bool(done.returncode):
        raise SystemExit(f"{' '.join(words)}: {done.returncode}\n{done.stderr}")
    return [*done.stderr.splitlines(), *done.stdout.splitlines()]


def changed(target: Path) -> None:
    """The hall's schedule with the changes of revision B."""
    book = openpyxl.load_workbook(HALL)
    for name, where, column, value in CHANGES:
        heading, *rows = book[name].iter_rows()
        index = {cell.value: cell.column - 1 for cell in heading}
        [row] = [r for r in rows if all(r[index[key]].value == own for key, own in where.items())]
        row[index[column]].value = value
    book.save(target)


def status(folder: Path, agreed: dict[str, str]) -> None:
    """The shop's list: plates that are cut, and what has been agreed to of them."""
    with open(folder / "cut.csv", "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(["plate", "status"])
        writer.writerows((plate, agreed.get(plate, "cut")) for plate in CUT)


def table(rows: list[dict], columns: tuple[str, ...]) -> list[str]:
    """Rows as a table of Markdown; figures to a tenth of a millimetre."""

    def cell(value) -> str:
        if isinstance(value, (int, float)):
            # A rounded -0.04 is no less than nothing.
            return f"{round(value, 1) + 0.0:.1f}"
        return "" if value is None else str(value)

    lines = [f"| {' | '.join(columns)} |", "|---" * len(columns) + "|"]
    lines += [f"| {' | '.join(cell(row[column]) for column in columns)} |" for row in rows]
    return lines


def rows_of(workbook: Path) -> dict[str, dict]:
    """The rows of the first sheet by their first column."""
    sheet = openpyxl.load_workbook(workbook, data_only=True).worksheets[0]
    heading, *rows = sheet.iter_rows(values_only=True)
    return {row[0]: dict(zip(heading, row, strict=True)) for row in rows}


def plates_told(out: Path) -> list[str]:
    """What became of plates, as the build of revision B tells it."""
    found = rows_of(out / "revision.xlsx")
    columns = ("plate", "what", "deviation", "length_change", "width_change")
    return table([found[mark] for mark in PLATES], (*columns, "note", "status", "verdict"))


def files_told(out: Path) -> list[str]:
    """Lines of the transmittal of revision B."""
    found = rows_of(out / "issued" / "B" / "transmittal.xlsx")
    columns = ("file", "issued_as", "revision", "what", "plate", "deviation")
    return table([found[name] for name in FILES if name in found], columns)


def text(folder: Path, options: list[str]) -> list[str]:
    """Issue A, the change, what the build says of plates that are cut, and issue B."""
    out = folder / "out"
    shutil.copyfile(HALL, folder / "hall.xlsx")
    changed(folder / "hall-B.xlsx")
    run(folder, "build", "hall.xlsx", "--out", "out", "--quiet", *options)
    issue = ["issue", "out", "--rev", "A", "--note", "for fabrication"]
    lines = ["```", f"{SHELL} {' '.join(issue[:4])}", *run(folder, *issue)]
    diff = ("diff", "hall.xlsx", "hall-B.xlsx")
    lines += [f"{SHELL} {' '.join(diff)}", *run(folder, *diff), "```", ""]
    again = ("build", "hall-B.xlsx", "--out", "out", "--status", "cut.csv")
    status(folder, {})
    told = run(folder, *again, *options, good=False)
    lines += [
        f"Of {', '.join(CUT[:-1])} and {CUT[-1]}, which are `cut`, the last does not change:",
        "",
        "```",
        f"{SHELL} {' '.join([*again, *options])}",
        *(line for line in told if line.startswith("error")),
        "```",
        "",
    ]
    status(folder, AGREED)
    run(folder, *again, "--quiet", *options)
    content = json.loads((out / "revision.json").read_text(encoding="utf-8"))
    whats = [row["what"] for row in content["plates"]]
    counts = ", ".join(f"{whats.count(what)} {what}" for what in ("same", "changed", "new", "void"))
    lines += [
        f"With `trim` and `scrap` agreed to in `cut.csv`, `revision.xlsx` tells {counts}:",
        "",
    ]
    lines += [*plates_told(out), ""]
    issue = ["issue", "out", "--rev", "B", "--note", "B600-2 620 high"]
    lines += ["```", f"{SHELL} {' '.join(issue[:4])}", *run(folder, *issue)]
    lines += ["```", "", "`issued/B/transmittal.xlsx`, without the hashes:", ""]
    lines += files_told(out)
    return lines


def main(folder: Path, options: list[str]) -> None:
    """Make the text, and put it into the page."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    lines = text(folder.resolve(), options)
    print("\n".join(lines))
    page = PAGE.read_text(encoding="utf-8")
    before, _, rest = page.partition(START)
    _, found, after = rest.partition(END)
    if not found:
        raise SystemExit(f"{PAGE.name} has no place for the example")
    PAGE.write_text("\n".join([f"{before}{START}", "", *lines, "", END]) + after, encoding="utf-8")


if __name__ == "__main__":
    given = sys.argv[1:]
    named = given and not given[0].startswith("-")
    main(Path(given[0]) if named else ROOT / "build" / "revision", given[1 if named else 0 :])
