# SPDX-License-Identifier: LGPL-2.1-or-later
"""Damaged and hostile files, by seed, and what became of reading them in a process of its own."""

import io
import os
import random
import resource
import signal
import time
import zipfile
from dataclasses import dataclass

import ezdxf
import openpyxl
import Part
from kill_scenarios import POINTS
from test_build import schedule

from BendTorsionWB import project
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.csv_folder import write_folder
from BendTorsionWB.exchange.curve_files import dxf_axes
from BendTorsionWB.shapes.surface_files import faces_from_file

SECONDS, MEMORY = 100, 3 << 30
KINDS = ("xlsx cells", "xlsx bytes", "csv cells", "csv bytes", "dxf", "step")
HOSTILE = (
    "../../out of it", "/etc/passwd", "C:\\x", "..\\..\\x", "CON", "nul.dxf", "a\0b", "x" * 40000,
    "=1+1", '=HYPERLINK("http://x")', "+1+cmd|'/C calc'!A0", "@SUM(1)", "{{7*7}}", "${x}",
    "__import__('os')", "'; DROP", "nan", "inf", "-1e308", "1e-320", "9" * 400, "0", "-1", "",
    " ", "\u202e", "\ud800", "１２", "1,000", "100%", "auto", "1 2 3 4 5", "roof.step", "a.dxf#",
    "../secret.step", "/dev/zero.step", "file:///etc/passwd.step", None, True, 1e300, -0.0, 2**70,
)  # fmt: skip


@dataclass(frozen=True)
class Case:
    """What became of a case. kind: of its input; end: `read`, the first code, or `crash`, `hang`,
    `fault`, `wrote`; seconds, memory (bytes) it took; text: what went wrong."""

    kind: str
    seed: int
    end: str
    seconds: float
    memory: int
    text: str = ""

    @property
    def bad(self):
        return self.end in ("crash", "hang", "fault", "wrote")


class Seeds:
    """Good files of every kind, made once in a folder."""

    def __init__(self, folder):
        self.book = schedule(folder / "good.xlsx", [POINTS])
        self.csv = folder / "good"
        book = openpyxl.load_workbook(self.book)
        self.sheets = {s.title: [list(r) for r in s.iter_rows(values_only=True)] for s in book}
        write_folder(self.csv, self.sheets)
        drawing = ezdxf.new("R2010")
        space = drawing.modelspace()
        space.add_spline([(0, 0, 0), (1000, 200, 0), (2000, 0, 0), (3000, 100, 0)])
        space.add_lwpolyline([(0, 0, 0, 0, 0.3), (1000, 0), (2000, 500)], dxfattribs={"layer": "P"})
        space.add_arc((0, 0), 500, 10, 90, dxfattribs={"layer": "A"})
        stream = io.StringIO()
        drawing.write(stream)
        self.dxf = stream.getvalue().encode()
        path = folder / "good.step"
        Part.makeCylinder(500, 1000).exportStep(str(path))
        self.step = path.read_bytes()


def damaged(content, draw):
    """Bytes with a few of them changed, cut out, doubled or replaced by numbers out of bounds."""
    content = bytearray(content)
    for _ in range(draw.choice([1, 1, 2, 5, 30])):
        at, what = draw.randrange(len(content) + 1), draw.randrange(6)
        size = draw.choice([1, 2, 8, 100])
        if what == 0:
            content[at : at + size] = bytes(draw.randrange(256) for _ in range(size))
        elif what == 1:
            del content[at : at + size * 10]
        elif what == 2:
            content[at:at] = content[at : at + size * 20]
        elif what == 3:
            content[at : at + size] = draw.choice([b"-1", b"1e999", b"0", b"NAN", b"#9", b"''"])
        elif what == 4:
            content = content[: max(1, at)]
        else:
            content[at : at + 1] = draw.choice([b"\0", b"\xff", b"(", b"\n", b"*", b"$"])
        content = content or bytearray(b" ")
    return bytes(content)


def _with_cells(sheets, draw):
    """Sheets with some cells, headings and names hostile, rows doubled or gone."""
    sheets = {name: [list(row) for row in rows] for name, rows in sheets.items()}
    sheets["Settings"] = [["key", "value"], ["project", draw.choice(HOSTILE)]]
    for _ in range(draw.choice([1, 1, 2, 6])):
        rows = sheets[draw.choice(list(sheets))]
        row = draw.choice(rows)
        what = draw.randrange(8)
        if what == 0 and len(rows) > 1:
            rows.remove(row)
        elif what == 1:
            rows.extend(list(row) for _ in range(draw.choice([1, 50])))
        elif what == 2:
            row.append(draw.choice(HOSTILE))
        else:
            row[draw.randrange(len(row))] = draw.choice(HOSTILE)
    if draw.random() < 0.2:
        file = draw.choice(["../secret.step", "/dev/zero", "/proc/self/mem.step", "x/../../y.iges"])
        sheets["Surfaces"] = [["surface", "kind", "file"], ["Hall", "file", file]]
    return sheets


def prepared(kind, seed, seeds, folder):
    """Write the input of a case into a folder; what reads it, without arguments."""
    draw = random.Random(f"{kind} {seed}")
    out = folder / "out"
    if kind == "xlsx cells":
        path = folder / "s.xlsx"
        book = openpyxl.Workbook()
        book.remove(book.active)
        for name, rows in _with_cells(seeds.sheets, draw).items():
            page = book.create_sheet(name)
            for row in rows:
                page.append([_fit_for_xlsx(cell) for cell in row])
        book.save(path)
    elif kind == "xlsx bytes":
        path = folder / "s.xlsx"
        path.write_bytes(_damaged_book(seeds.book.read_bytes(), draw))
    elif kind == "csv cells":
        path = folder / "s"
        path.mkdir()
        for name, rows in _with_cells(seeds.sheets, draw).items():
            quoted = [[_quoted(cell) for cell in row] for row in rows]
            text = "\r\n".join(",".join(row) for row in quoted)
            (path / f"{name}.csv").write_bytes(text.encode("utf-8", "surrogatepass"))
    elif kind == "csv bytes":
        path = folder / "s"
        path.mkdir()
        for file in seeds.csv.iterdir():
            content = file.read_bytes()
            content = damaged(content, draw) if draw.random() < 0.3 else content
            (path / file.name).write_bytes(content)
    elif kind == "dxf":
        path = folder / "a.dxf"
        path.write_bytes(damaged(seeds.dxf, draw))
        return lambda: [source.findings for source in dxf_axes(path).values()]
    else:
        path = folder / "a.step"
        path.write_bytes(damaged(seeds.step, draw))
        return lambda: faces_from_file(path, "", "roof")
    return lambda: _built(path, out)


def _built(path, out):
    """Build; a fault of the program within a member is raised, not told."""
    found = project.build(path, out, workers=1, wanted=project.Wanted(False, False)).findings
    faults = [finding.message for finding in found if finding.code == "worker-failed"]
    if faults:
        raise RuntimeError(faults[0])


def _fit_for_xlsx(cell):
    if not isinstance(cell, str):
        return float(cell) if isinstance(cell, int) and abs(cell) > 2**60 else cell
    return "".join(sign for sign in cell if sign >= " " and not "\ud800" <= sign < "\ue000")[:32000]


def _quoted(cell):
    text = "" if cell is None else str(cell)
    return '"' + text.replace('"', '""') + '"' if set(text) & set(',"\r\n') else text


def _damaged_book(content, draw):
    """A workbook damaged as a whole, or one of its parts, packed again."""
    if draw.random() < 0.3:
        return damaged(content, draw)
    stream = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as source, zipfile.ZipFile(stream, "w") as target:
        chosen = draw.choice(source.namelist())
        for name in source.namelist():
            part = source.read(name)
            target.writestr(name, damaged(part, draw) if name == chosen else part)
    return stream.getvalue()


def tried(kind, seed, seeds, folder):
    """Read the input of a case in a child; folder: empty, of its own."""
    inner = folder / "inner" / "project"
    inner.mkdir(parents=True)
    (folder / "inner" / "secret.step").write_bytes(seeds.step)
    action = prepared(kind, seed, seeds, inner)
    before = _listing(folder, inner)
    read, write = os.pipe()
    start = time.monotonic()
    child = os.fork()
    if child == 0:
        try:
            os.close(read)
            _run(action, write)
        finally:
            os._exit(0)
    os.close(write)
    with open(read, "rb") as stream:
        told = stream.read().decode("utf-8", "replace")
    _, status, usage = os.wait4(child, 0)
    seconds, memory = time.monotonic() - start, usage.ru_maxrss * 1024
    end, _, text = told.partition("\n")
    if os.WIFSIGNALED(status):
        end = "hang" if os.WTERMSIG(status) == signal.SIGALRM else "crash"
        text = signal.Signals(os.WTERMSIG(status)).name
    elif _listing(folder, inner) != before:
        end, text = "wrote", str(set(_listing(folder, inner)) ^ set(before))
    return Case(kind, seed, end or "crash", seconds, memory, text[:300])


def _listing(folder, inner):
    """Everything in a folder but what lies in its inner one."""
    return sorted(
        str(path) for path in folder.rglob("*") if path != inner and inner not in path.parents
    )


def _run(action, write):
    nothing = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    os.dup2(nothing, 2)
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    signal.alarm(SECONDS)
    with open("/proc/self/statm", encoding="utf-8") as stream:
        taken = int(stream.read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (taken + MEMORY, taken + MEMORY))
    try:
        action()
        told = "read\n"
    except BendTorsionError as problem:
        found = [finding.code for finding in problem.findings]
        told = f"{found[0]}\n" if found else "fault\nrefused without a reason"
    except BaseException as problem:  # noqa: BLE001 - this is what is looked for
        told = f"fault\n{type(problem).__name__}: {problem}"
    os.write(write, told.encode("utf-8", "replace")[:4000])
