# SPDX-License-Identifier: LGPL-2.1-or-later
"""A document written back as a workbook computes the same members, whatever its rows say."""

from dataclasses import replace

import FreeCAD
import numpy as np
import pytest
from schedule_books import write

from BendTorsionWB import project
from BendTorsionWB.core import detailing
from BendTorsionWB.core.memo import content_hash
from BendTorsionWB.document import build_document
from BendTorsionWB.round_trip import difference, write_back


def book(seed):
    """A schedule with rows on every sheet: a girder in pieces, one that ends on it, one with
    diaphragms and openings, and a wide one in lanes, preset, whose frame is given; places, sizes
    and words by chance."""
    random = np.random.default_rng(seed)

    def one(*words):
        return words[int(random.integers(len(words)))]

    def number(low, high, step=1.0):
        return float(np.round(random.uniform(low, high) / step) * step)

    def rows(heading, *given):
        return [heading.split(), *given]

    return {
        "Settings": rows(
            "key value",
            ["station_spacing", number(380, 620, 0.5)],
            ["bed_face", one("auto", "bottom")],
            ["bed_height", number(500, 900)],
            ["template_pitch", number(2000, 4000)],
            ["contour", one("mid", "top", "widest")],
            ["stock", "12000x2500; 16 S355 10000x2000"],
            ["project", "Stadium North"],
            ["site_x", number(-9000, 9000, 0.5)],
            ["site_rotation", number(-60, 60)],
            ["pin_pitch", number(700, 1200)],
            ["layer_names", "CUT_OUTER=10 MARK_TEXT=T"],
            ["shrinkage_along", number(0.1, 0.4, 0.1)],
        ),
        "Materials": rows("material density E fy", ["Q355", 7850, 206000, 355]),
        "Surfaces": rows(
            "surface kind parameters offset",
            ["Hall", "plane", None, None],
            ["Drum", "cylinder", "r=15000", number(-20, 20, 0.25)],
            ["Ball", "sphere", "r=20000 y=60000", None],
        ),
        "Points": rows(
            "axis no x y z",
            ["A1", 1, 0, 0, 0],
            ["A1", 2, 12000, 0, 0],
            ["A2", 1, 4000, 0, 0],
            ["A2", 2, 4000 + number(-500, 500), 6000, 0],
            *(
                ["A3", n + 1, *np.round([15000 * np.cos(a), 15000 * np.sin(a), 400.0 * n], 3)]
                for n, a in enumerate(np.linspace(3.0, 3.6, 6).tolist())
            ),
            *(
                ["A4", n + 1, *np.round([20000 * np.sin(a), 60000, 20000 * np.cos(a)], 3).tolist()]
                for n, a in enumerate(np.linspace(0.1, 0.5, 6).tolist())
            ),
        ),
        "Axes": rows(
            "axis surface frame",
            ["A1", "Hall", None],
            ["A2", "Hall", None],
            ["A3", "Drum", one("surface", "minimal")],
            ["A4", "Ball", "given"],
        ),
        "Frames": rows("axis s angle", ["A4", "0%", 0], ["A4", "100%", number(5, 20, 0.5)]),
        "Presets": rows(
            "axis s dx dy dz",
            ["A4", "0%", 0, 0, 0],
            ["A4", f"{number(40, 60)}%", 0, 0, number(10, 40)],
            ["A4", "100%", 0, 0, 0],
        ),
        "Sections": rows(
            "section type h b t gap1 gap2 material",
            ["S1", "box1", 800, 600, 20, 2, 3, None],
            ["S2", "box2", 500, 400, 16, None, None, "Q355"],
            ["S3", "box2", number(550, 650), 500, 12, None, None, None],
            ["W1", "box1", 1200, 2800, 20, None, None, "Q355"],
            ["W2", "box1", 1100, 2800, 14, None, None, "Q355"],
        ),
        "Members": rows(
            "member segment axis section cut slope rank roll end_cut mode green_start stagger align"
            " align_to member_offset_z joint_allowance",
            ["M1", 1, "A1", "S1", None, None, 1, None, "plane nx=1 ny=0.2", None, None],
            ["M2", 1, "A2", "S2", None, None, 2, None, None, None, number(5, 40)],
            ["M3", 1, "A3", "S2", None, None, None, number(-8, 8, 0.5), None, "energy", None],
            ["M3", 2, None, "S3", f"{number(55, 65)}%", number(3, 6, 0.5), None, *[None] * 4],
            ["M4", 1, "A4", "W1", *[None] * 5, "elastic", None, None, "top", None, -30, 2],
            ["M4", 2, None, "W2", "40%", 4, *[None] * 5, one("auto", "none"), "top", "previous"],
            ["M4", 3, None, "W1", "75%", 0, *[None] * 6, "top", "previous"],
        ),
        "Nodes": rows(
            "node through other type gap diaphragms",
            ["K1", "M1", "M2", "direct", number(3, 8, 0.5), one("flanges", "none")],
        ),
        "Splits": rows(
            "member face joints lanes",
            ["M1", "top", "0.3 0.7"],
            ["M3", "left", f"{number(3800, 4200)}"],
            ["M3", "bottom", "auto"],
            ["M4", "top", "auto", "auto"],
            ["M4", "bottom", None, f"{number(0.4, 0.6, 0.05)}"],
        ),
        "Diaphragms": rows(
            "member s t gap snipe manhole closing_face",
            ["M3", number(1200, 1600), 12, 1, 25, None, None],
            ["M3", "80%", 10, None, None, None, "top weld"],
            ["M3", "end", 25, 30, None, None, None],
        ),
        "Openings": rows(
            "member face s offset shape rotation",
            ["M3", "top", number(2200, 2500), number(-30, 30), "d=120", None],
            ["M3", "right", "50%", None, "150x100 r=20", number(0, 45)],
        ),
        "Marks": rows(
            "member face s offset text",
            ["M3", "left", number(900, 1000), 40, "punch"],
            ["M3", "top", "30%", None, "line 100 45deg"],
            ["M1", "left", 2500, None, "SITE"],
        ),
        "Pieces": rows(
            "member piece to end_end green_start gap",
            ["M1", 1, number(7600, 8200), "stepped top=120 bottom=-120", None, 4],
            ["M1", 2, None, None, 15, None],
        ),
        "Preps": rows(
            "prep type angle land gap side backing leg",
            ["B6", "bevel", number(30, 40), None, 2, "outer", "30x6", None],
            ["F7", "fillet", None, None, None, "inner", None, 7],
        ),
        "Edges": rows(
            "member seam from to prep place ndt",
            ["M1", "TL", "10%", number(5000, 7000), "B6", "field", "UT"],
            ["M3", "joints", None, None, "v angle=50 land=1", None, None],
            ["M3", "BR", None, "40%", one("F7", "B6"), "shop", None],
        ),
        "Status": rows("plate status", ["M3-T1", "cut"]),
    }


@pytest.mark.parametrize("seed", range(4))
def test_a_document_written_back_computes_the_same_members(tmp_path, seed):
    path, back = write(tmp_path / "given.xlsx", book(seed)), tmp_path / "back.xlsx"
    schedule, jobs = project.read_jobs(path)
    document = build_document(schedule, jobs, sheets=False)
    try:
        told = write_back(document, back)
    finally:
        FreeCAD.closeDocument(document.Name)
    assert told == ()
    _, jobs_again = project.read_jobs(back)
    assert list(jobs_again) == list(jobs)
    for name, job in jobs.items():
        # The place of a node is written even where the row left it to be found.
        one, other = (replace(given[name], meets=()) for given in (jobs, jobs_again))
        assert content_hash(other) == content_hash(one), name
        assert [n.kind for n in job.meets] == [n.kind for n in jobs_again[name].meets]
    told = difference(path, back)
    assert {(c.kind, c.name) for c in told} <= {("nodes", "K1")}
    assert all(c.property == "s" for c in told if c.kind == "nodes")
    if seed:
        return
    one, other = (detailing.detail(given["M3"]).record for given in (jobs, jobs_again))
    assert [plate.mark for plate in one.plates] == [plate.mark for plate in other.plates]
    assert {"diaphragm", "end"} <= {plate.face for plate in one.plates}
    assert sum(len(plate.holes) for plate in one.plates) >= 2
    assert [w.prep for w in one.welds] == [w.prep for w in other.welds]
