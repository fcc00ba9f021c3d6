# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes the pictures of docs/nodes.md: docs/images/nodes.png, node_pattern.svg and
node_sheet.png (with pdftoppm).

Run with plain Python, /usr/bin/python3 docs/make_node_pictures.py.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

import make_member_pictures as pictures
import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from PySide2 import QtGui  # noqa: E402

from BendTorsionWB import freecad_path  # noqa: E402

freecad_path.append()

import FreeCAD  # noqa: E402, F401

from BendTorsionWB.core import detailing  # noqa: E402
from BendTorsionWB.core.axes.axis_input import AxisInput  # noqa: E402
from BendTorsionWB.core.axes.frames import FrameInput  # noqa: E402
from BendTorsionWB.core.drawings.sheet_node import node_sheets  # noqa: E402
from BendTorsionWB.core.drawings.sheet_style import SheetStyle  # noqa: E402
from BendTorsionWB.core.geometry.surface import analytic_surface  # noqa: E402
from BendTorsionWB.core.members.segment import Segment  # noqa: E402
from BendTorsionWB.core.nodes.node_input import NodeInput, NodeRules  # noqa: E402
from BendTorsionWB.core.nodes.node_jobs import jobs_with_nodes  # noqa: E402
from BendTorsionWB.core.patterns.pattern import develop_plate  # noqa: E402
from BendTorsionWB.core.sections.section import box  # noqa: E402
from BendTorsionWB.core.welds.landed_marks import with_landed_marks  # noqa: E402
from BendTorsionWB.shapes import cut_solid  # noqa: E402
from BendTorsionWB.shapes.flat_solid import flat_solid  # noqa: E402
from BendTorsionWB.sheets.pdf import write_pdf  # noqa: E402

PLANE = analytic_surface("plane", {})
BIG, LOW, SMALL = (
    box("A", "box1", 600, 400, 16),
    box("B", "box1", 360, 300, 12),
    box("C", "box1", 300, 220, 10),
)
FACES = ("top", "bottom", "left", "right")
COLOURS = dict(zip(FACES, pictures.COLOURS))
DIAPHRAGM = (200, 60, 60)
EXAGGERATED = 100
SHORT = NodeRules(shortest_branch=100.0)


def job(name, start, end, section) -> detailing.MemberJob:
    return detailing.MemberJob(
        PLANE,
        AxisInput(f"A-{name}", np.array([start, end], float), fit="keep"),
        detailing.MemberInput(name, (Segment(section),), frame=FrameInput("fixed")),
        detailing.PlatesInput(),
    )


def plates_of(jobs, rows) -> dict[str, detailing.MemberPlates]:
    ranks = {name: k for k, name in enumerate(jobs)}
    made, found = jobs_with_nodes({j.member.name: j for j in jobs.values()}, ranks, rows, SHORT)
    for finding in found.findings:
        print(finding.line())
    done = {}
    for name, own in made.items():
        geometry = detailing.member_of(
            own.member, detailing.axis_of(own.axis, own.surface), own.surface
        )
        done[name] = detailing.plates_of(detailing.noded(geometry, own.nodes), own.plates)
    return done


def scene(members, rows=(), hidden=()) -> pictures.Scene:
    """The plates of members (name, start, end, section), without those of `hidden` marks."""
    found = pictures.Scene([], [], [], [])
    done = plates_of({item[0]: job(*item) for item in members}, rows)
    for plates in done.values():
        for item, (solid, _) in zip(
            plates.plates, cut_solid.plate_solids(plates.plates), strict=True
        ):
            if item.plate.mark not in hidden:
                add(found, solid, COLOURS[item.plate.face])
        for flat in plates.flat:
            add(found, flat_solid(flat), DIAPHRAGM)
    return found


def add(found: pictures.Scene, solid, colour) -> None:
    points, faces = solid.tessellate(0.5)
    points = np.array([tuple(point) for point in points])
    found.triangles += [points[list(face)] for face in faces]
    found.colours += [colour] * len(faces)
    for edge in solid.Edges:
        line = np.array([tuple(point) for point in edge.discretize(12)])
        found.lines.append((line, pictures.LINE))


def at(degrees, length, x=0.0):
    turn = np.radians(degrees)
    return (x + length * np.cos(turn), length * np.sin(turn), 0.0)


def nodes() -> None:
    x = ("X", (-1300, 0, 0), (1300, 0, 0), BIG)
    webs = NodeInput("X", "Y", diaphragms="flanges and webs")
    stub = NodeInput("X", "Y", type="stub", stub_length=700.0)
    cells = [
        (
            "crossing, flanges go on inside",
            [x, ("Y", at(60, -1300), at(60, 1300), LOW)],
            (),
            ("X-T1",),
        ),
        ("webs too", [x, ("Y", at(90, -1300), at(90, 1300), LOW)], (webs,), ("X-T1",)),
        ("T, direct", [x, ("Y", at(-90, 1700), (0, 0, 0), LOW)], (), ()),
        ("stub, T", [x, ("Y", at(-90, 1700), (0, 0, 0), LOW)], (stub,), ()),
        (
            "K",
            [
                x,
                ("Y", at(-130, 1500, -160.0), (-160, 0, 0), SMALL),
                ("Z", at(-50, 1500, 160.0), (160, 0, 0), SMALL),
            ],
            (),
            (),
        ),
        (
            "K, one ends on the other",
            [
                x,
                ("Y", at(-125, 1500), (0, 0, 0), SMALL),
                ("Z", at(-55, 1500), (0, 0, 0), box("D", "box1", 240, 200, 10)),
            ],
            (),
            (),
        ),
        (
            "corner",
            [("X", (-1500, 0, 0), (400, 0, 0), BIG), ("Y", at(-90, 1500), (0, 0, 0), LOW)],
            (),
            (),
        ),
        (
            "on an arris, a web of the box left out",
            [x, ("Y", (300, -1300, 1400), (0, 0, 0), SMALL)],
            (webs,),
            ("X-R1",),
        ),
    ]
    pictures.sheet(
        [
            (caption, pictures.drawn(scene(members, rows, hidden), view=(0.45, -0.75, 0.62)))
            for caption, members, rows, hidden in cells
        ],
        4,
        "nodes.png",
    )


def pattern() -> None:
    """A web between two nodes, with the bow of its ends exaggerated."""
    half = np.array([40000.0, 30000.0, 20000.0])
    surface = analytic_surface("ellipsoid", dict(zip("abc", half)))

    def member(name, u, v, section):
        unit = np.column_stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)])
        return detailing.MemberJob(
            surface,
            AxisInput(f"A-{name}", unit * half),
            detailing.MemberInput(name, (Segment(section, align="top"),)),
            detailing.PlatesInput(),
        )

    t = np.linspace(0.0, 1.0, 7)
    ribs = {
        f"M{k}": member(
            f"M{k}", 0.6 + 0.09 * k + 0.3 * t, 0.1 + 0.5 * t, box("R", "box1", 800, 800, 20)
        )
        for k in (1, 2)
    }
    ribs["P1"] = member("P1", 0.55 + 0.45 * t, 0.32 + 0.0 * t, box("P", "box1", 600, 400, 14))
    plates = plates_of(ribs, ())["P1"]
    plate = next(i.plate for i in plates.plates if i.plate.face == "left" and all(i.plate.cuts))
    flat = develop_plate(plate)
    runs = [np.asarray(run) for run in flat.outline]
    outline = np.concatenate(runs)
    size = outline.max(axis=0)
    text = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-60 -60 {size[0] + 120:.0f} '
        f'{size[1] + 200:.0f}" width="900">',
        '<rect x="-60" y="-60" width="100%" height="100%" fill="white"/>',
        _line(outline, size, 'stroke="#203040" stroke-width="5"'),
    ]
    for line in flat.lines:
        text.append(_line(line.flat, size, 'stroke="#8899aa" stroke-width="3"'))
    depth = 0.0
    for end in (min, max):
        upright = [run for run in runs if np.ptp(run[:, 1]) > 0.8 * size[1]]
        run = end(upright, key=lambda run: run[:, 0].mean())
        chord = run[0] + np.linspace(0, 1, len(run))[:, None] * (run[-1] - run[0])
        depth = max(depth, float(np.abs(run - chord).max()))
        deep = chord + EXAGGERATED * (run - chord)
        text.append(_line(deep, size, 'stroke="#c03030" stroke-width="4" stroke-dasharray="20 12"'))
    font = 'font-family="DejaVu Sans" font-size="38" fill="#203040"'
    caption = (
        f"{plate.mark}: {flat.length:.1f} x {flat.width:.1f} mm. Dashed: the bow of its ends, "
        f"{depth:.2f} mm, {EXAGGERATED} times as deep"
    )
    text.append(f'<text x="0" y="{size[1] + 90:.0f}" {font}>{caption}</text>')
    (pictures.IMAGES / "node_pattern.svg").write_text("\n".join([*text, "</svg>", ""]))


def sheet() -> None:
    """The drawing of a T with a stub."""
    members = (
        ("X", (-2600, 0, 0), (2600, 0, 0), BIG),
        ("Y", at(-65, 2600), (0, 0, 0), LOW),
    )
    jobs = {item[0]: job(*item) for item in members}
    row = NodeInput("X", "Y", type="stub", stub_length=900.0)
    made, _ = jobs_with_nodes(jobs, {"X": 1, "Y": 2}, (row,), SHORT)
    records = with_landed_marks([detailing.detail(one).record for one in made.values()])
    with tempfile.TemporaryDirectory() as folder:
        write_pdf(node_sheets(records, SheetStyle("Two beams")), Path(folder) / "nodes.pdf")
        pdf, picture = f"{folder}/nodes.pdf", pictures.IMAGES / "node_sheet"
        looks = ["-r", "88", "-png", "-gray", "-singlefile"]
        subprocess.run(["pdftoppm", *looks, pdf, picture], check=True)


def _line(points, size, style) -> str:
    shown = " ".join(f"{x:.2f},{size[1] - y:.2f}" for x, y in points)
    return f'<polyline points="{shown}" fill="none" {style}/>'


if __name__ == "__main__":
    application = QtGui.QGuiApplication([])
    nodes()
    pattern()
    sheet()
