# SPDX-License-Identifier: LGPL-2.1-or-later
"""Node drawings: what they show against closed forms and true faces, and that all of it fits."""

import math
import subprocess
from dataclasses import replace

import numpy as np
import pytest
from curved_members import ELLIPSOID, diagonal
from meeting_members import PLANE, counter
from sheet_checks import faults

from BendTorsionWB.core import detailing
from BendTorsionWB.core.axes.axis_input import AxisInput
from BendTorsionWB.core.axes.frames import FrameInput
from BendTorsionWB.core.drawings import sheet_node
from BendTorsionWB.core.drawings.sheet_node import has_nodes, node_sheets
from BendTorsionWB.core.drawings.sheet_node_view import clipped
from BendTorsionWB.core.drawings.sheet_style import SheetStyle, fixed
from BendTorsionWB.core.members.segment import Segment
from BendTorsionWB.core.nodes.node_ends import plate_ends
from BendTorsionWB.core.nodes.node_faces import outer_faces
from BendTorsionWB.core.nodes.node_input import NodeInput, NodeRules
from BendTorsionWB.core.nodes.node_jobs import jobs_with_nodes
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.site import SiteDatum
from BendTorsionWB.exchange.output_folder import OutputFolder, read_manifest
from BendTorsionWB.exchange.report import NODES, SHEET_SET, sheet_name
from BendTorsionWB.member_files import sheets_pdf
from BendTorsionWB.sheet_files import write_sheet_set

BIG, LOW, SMALL = (
    box("A", "box1", 600, 400, 16),
    box("B", "box1", 360, 300, 12),
    box("C", "box1", 300, 220, 10),
)
X = ("X", (-2500.0, 0.0, 0.0), (2500.0, 0.0, 0.0), BIG)


def at(degrees, length, x=0.0):
    turn = math.radians(degrees)
    return x + length * math.cos(turn), length * math.sin(turn), 0.0


def straight(name, start, end, section):
    return detailing.MemberJob(
        PLANE,
        AxisInput(f"A-{name}", np.array([start, end], float), fit="keep"),
        detailing.MemberInput(name, (Segment(section),), frame=FrameInput("fixed")),
        detailing.PlatesInput(),
    )


def details(jobs, rows=(), **rules):
    ranks = {name: k for k, name in enumerate(jobs)}
    made, found = jobs_with_nodes(jobs, ranks, rows, NodeRules(**rules))
    assert not [f for f in found.findings if f.severity == "error"]
    return [detailing.detail(job) for job in made.values()]


def records(members, rows=(), **rules):
    jobs = {member[0]: straight(*member) for member in members}
    return [one.record for one in details(jobs, rows, **rules)]


CROSSING = [X, ("Y", at(60, -2500), at(60, 2500), LOW)]
CASES = {
    "crossing": (CROSSING, (NodeInput("X", "Y", diaphragms="flanges and webs"),)),
    "T with a stub": (
        [X, ("Y", at(-90, 3000), (0, 0, 0), LOW)],
        (NodeInput("X", "Y", type="stub", stub_length=800.0),),
    ),
    "K": (
        [X, ("Y", at(-130, 2500, -60), (-60, 0, 0), SMALL)]
        + [("Z", at(-50, 2500, 60), (60, 0, 0), SMALL)],
        (),
    ),
    "corner": (
        [("X", (-2500, 0, 0), (400, 0, 0), BIG), ("Y", at(-90, 2500), (0, 0, 0), LOW)],
        (),
    ),
}


@pytest.fixture(scope="module")
def crossing():
    return records(*CASES["crossing"])


@pytest.fixture(scope="module", params=list(CASES))
def case(request):
    return records(*CASES[request.param])


def ends_of(found):
    return plate_ends(found[1].nodes[0], found[1])


def table(sheets, first):
    return [
        row
        for sheet in sheets
        for table in sheet.tables
        if table.header[0] == first
        for row in table.rows
    ]


def test_cuts_of_straight_members_have_their_closed_forms(crossing):
    """Flanges are cut askew and square to their face, webs square and with the angle's bevel."""
    ends = ends_of(crossing)
    assert [(end.plate.mark, end.way) for end in ends] == [
        (f"Y-{letter}{number}", way) for number, way in ((1, -1), (2, 1)) for letter in "TBLR"
    ]
    thirty = math.radians(30.0)
    for end in ends:
        flange = end.plate.face in ("top", "bottom")
        # The flanges lie between the webs.
        outer = np.linalg.norm(end.corners[1] - end.corners[0])
        assert outer == pytest.approx(276.0 / math.sin(math.radians(60)) if flange else 360.0)
        assert end.length == pytest.approx(outer)
        # Left of the branch, at -x before the node: the obtuse side there is the acute one behind.
        sharp = 1.0 if (end.plate.face == "left") == (end.way > 0) else -1.0
        assert end.bevel == pytest.approx([0.0, 0.0] if flange else [sharp * thirty] * 2, abs=1e-9)
        assert end.dihedral == pytest.approx(0.5 * math.pi - end.bevel)
        assert end.face == ("right" if end.way < 0 else "left")


def test_bevels_on_twisted_faces_are_those_of_the_true_normals():
    """Against the normal of the through member's face and of the branch's own ruled plate."""
    t = np.linspace(0.0, 1.0, 9)
    jobs = {
        name: detailing.MemberJob(
            ELLIPSOID,
            AxisInput(f"A-{name}", curve(t)),
            detailing.MemberInput(name, (Segment(section),)),
            detailing.PlatesInput(),
        )
        for name, curve, section in (
            ("M1", diagonal, box("P", "box1", 800, 800, 20)),
            ("M2", counter, box("Q", "box1", 600, 500, 16)),
        )
    }
    through, branch = details(jobs)
    (node,) = branch.record.nodes
    ends = plate_ends(node, branch.record)
    assert len(ends) == 8
    member = through.geometry.member
    faces = outer_faces(member, node.s_through - 2000.0, node.s_through + 2000.0)
    plates = {item.plate.mark: item.plate for item in branch.plates.plates}
    for end in ends:
        _, up = faces.distance(faces.names.index(end.face), end.corners)
        plate = plates[end.plate.mark]
        s = [p.s for p in end.plate.points if p.line == end.line and p.kind == "arris"]
        value, rate = plate.rails.outer(np.array(s)), plate.rails.outer.derivative(np.array(s))
        along = np.stack([rate[0, :3], rate[1, 3:]])
        normal = np.cross(along, value[:, 3:] - value[:, :3])
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        wanted = np.arcsin((normal * up).sum(axis=1))
        if abs(wanted - end.bevel).max() > abs(wanted + end.bevel).max():
            wanted = -wanted
        assert end.bevel == pytest.approx(wanted, abs=math.radians(0.05))
    # The acute side is the one whose outer face is the longer, on both sides of the node.
    webs = {(end.plate.face, end.way): end.bevel.mean() for end in ends}
    assert webs["left", -1] * webs["right", -1] < 0.0 < webs["left", -1] * webs["right", 1]


def test_a_field_joint_is_no_end_at_the_node_and_the_far_side_of_a_t_has_none():
    found = records(*CASES["T with a stub"])
    ends = ends_of(found)
    assert sorted(end.plate.mark for end in ends) == ["Y-B2", "Y-L2", "Y-R2", "Y-T2"]
    assert {end.way for end in ends} == {-1}
    sheets = node_sheets(found)
    welds = table(sheets, "weld")
    # The stub is welded on in the shop, its field joint in the field.
    assert [row[-1] for row in welds] == ["field"] * 4 + ["shop"] * 4 + ["shop"] * 4
    assert any("stub 800" in text.text for text in sheets[0].texts)


def test_views_are_to_scale(crossing):
    """The cuts, drawn wide, lie the root gap off the face, as long as they are."""
    sheet, *_ = node_sheets(crossing)
    (first, second, third) = sheet.views[:3]
    cuts = [np.array(line.points) for line in first.polylines if line.style == "wide"]
    assert len(cuts) == 8
    assert sorted({round(abs(y), 6) for cut in cuts for _, y in cut}) == [203.0]
    lengths = {round(float(np.hypot(*(cut[1] - cut[0]))), 6) for cut in cuts}
    assert lengths == {0.0, round(276.0 / math.sin(math.radians(60.0)), 6)}
    for view, wide, high in ((second, 203.0, 180.0), (third, None, 180.0)):
        cuts = np.array([line.points for line in view.polylines if line.style == "wide"])
        assert np.abs(cuts[..., 1]).max() == pytest.approx(high)
        assert wide is None or np.abs(np.abs(cuts[..., 0]) - wide).max() < 1e-6
    # Seen along the branch its webs are 300 apart, and through flanges are 600 apart.
    assert np.ptp(cuts[..., 0]) >= 300.0
    everything = np.array([point for line in third.polylines for point in line.points])
    assert np.ptp(everything[:, 1]) == pytest.approx(600.0)
    assert len({view.scale for view in sheet.views}) == 1 and first.scale <= 30


@pytest.mark.parametrize(
    "style",
    [
        SheetStyle("Hall"),
        SheetStyle("Hall", format="A4", language="zh"),
        SheetStyle("Hall", format="ARCH B", standard="AWS", unit="ft-in"),
    ],
    ids=lambda style: style.format,
)
def test_everything_is_shown_and_nothing_overlaps(case, style):
    sheets = node_sheets(case, style)
    assert [sheet.number for sheet in sheets] == list(range(1, len(sheets) + 1))
    for sheet in sheets:
        assert faults(sheet) == []
        # Its pages in a document have one scale each.
        assert len({view.scale for view in sheet.views}) <= 1
    through, *branches = case
    flats = [plate.mark for plate in through.plates if plate.face == "diaphragm"]
    names = [view.name for sheet in sheets for view in sheet.views]
    assert len(names) == 3 + len(flats) and set(flats) <= set(names)
    shown = {text.text for sheet in sheets for text in sheet.texts}
    rows = {row[0] for sheet in sheets for table in sheet.tables for row in table.rows}
    for record in branches:
        for end in plate_ends(record.nodes[0], record):
            assert end.plate.mark in shown and end.plate.mark in rows
        assert record.member in rows
    for plate in through.plates:
        if plate.face == "diaphragm":
            assert plate.mark in shown and plate.mark in rows


def test_the_first_page_of_a_node_is_filled(case):
    """What follows the views begins below them, and goes on on the next page when it must."""
    sheet, *_ = node_sheets(case, SheetStyle("Hall"))
    form = SheetStyle().page
    drawn = [point[1] for view in sheet.views for line in view.on_page() for point in line.points]
    drawn += [table.y - table.height for table in sheet.tables]
    assert min(drawn) < form.clear_bottom + 0.3 * (form.top - form.clear_bottom)


def test_diaphragms_tell_their_snipes_and_where_they_stand(crossing):
    """Against closed forms: a box of 600 x 400 x 16, a branch of 360 x 300 x 12 at 60 degrees."""
    sheets = node_sheets(crossing)
    cells = {
        row[0]: dict(zip(one.header, row, strict=True))
        for sheet in sheets
        for one in sheet.tables
        if "snipes" in one.header
        for row in one.rows
    }
    assert [cells[f"X-D{k}"]["snipes"] for k in (1, 2, 3, 4)] == ["–"] * 2 + ["4 × 30.0 × 30.0"] * 2
    (hole,) = next(plate.holes for plate in crossing[0].plates if plate.mark == "X-D3")
    assert [cells[f"X-D{k}"]["openings"] for k in (1, 3)] == ["–", hole.title]
    places = {}
    for sheet in sheets:
        for one in (t for t in sheet.tables if "weld length" in t.header):
            for mark, face, _, x, y, z, *_ in one.rows:
                places[mark, face] = [float(x), float(y), float(z)]
    # Flanges: mid-surface at half the height less half the thickness; wall to wall less 2 mm gap.
    away = 182.0 / math.tan(math.radians(60.0))
    for mark, up in (("X-D1", 174.0), ("X-D2", -174.0)):
        assert places[mark, "left"] == pytest.approx([away, 182.0, up], abs=0.06)
        assert places[mark, "right"] == pytest.approx([-away, -182.0, up], abs=0.06)
    assert places["X-D3", "top"][2] == pytest.approx(282.0)
    assert places["X-D3", "top"][0] == pytest.approx(
        -144.0 / math.sin(math.radians(60.0)), abs=0.06
    )


@pytest.mark.parametrize("standard", ["ISO", "AWS"])
def test_each_kind_of_weld_has_its_symbol_on_a_view_with_the_arrow_at_a_weld(crossing, standard):
    style = SheetStyle("Hall", standard=standard)
    sheet, *more = node_sheets(crossing, style)
    letters = {row[5] for row in table([sheet, *more], "weld")}
    tails = [text.text for text in sheet.texts]
    # Flanges at 60 degrees to the walls leave a gap at the square edge, the webs none: two kinds.
    assert sorted(letters) == ["A", "B", "C", "D"]
    kinds = (("A", "branch"), ("B", "branch"), ("C", "diaphragm"), ("D", "diaphragm"))
    for letter, name in kinds:
        assert f"{letter} {name}" in tails
    # Arrow heads, whose tip is the middle point, touch a cut or a side of a diaphragm.
    tips = [line.points[1] for line in sheet.lines if _is_head(line)]
    places = []
    for view in sheet.views[:3]:
        places += [np.array(line.points) for line in view.on_page() if line.style != "chain"]
    near = [tip for tip in tips if min(_distance(tip, line) for line in places) < 0.6]
    assert len(near) >= 3


def _is_head(line) -> bool:
    """A small arrow head: two wings of equal length that meet at a sharp angle."""
    if len(line.points) != 3:
        return False
    a, b, c = (np.array(point) for point in line.points)
    wings = np.hypot(*(a - b)), np.hypot(*(c - b))
    return 1.5 < wings[0] < 2.6 and abs(wings[0] - wings[1]) < 1e-6 and np.hypot(*(a - c)) < 1.5


def _distance(point, line) -> float:
    """Distance of a point from a polyline (n, 2)."""
    step = np.diff(line, axis=0)
    long = np.maximum((step * step).sum(axis=1), 1e-12)
    share = (((np.array(point) - line[:-1]) * step).sum(axis=1) / long).clip(0.0, 1.0)
    return float(np.hypot(*(line[:-1] + share[:, None] * step - np.array(point)).T).min())


def test_steps_are_held_against_the_rule():
    members = [X, ("Y", (0.0, -2500.0, 120.0), (0.0, 2500.0, 121.2), LOW)]
    rows = {}
    for limit in (2.0, 0.5):
        found = records(members, flange_step=limit)
        rows[limit] = table(node_sheets(found), "branch")
        steps = [row for row in rows[limit] if len(row) == 10]
        assert [float(row[5]) for row in steps] == pytest.approx(
            [step.step for step in found[1].nodes[0].steps], abs=0.006
        )
        ruled = [row[-1] for row in steps if row[2] == "top"]
        assert ruled == (["kept"] if limit == 2.0 else ["broken"]) * 4
        assert [row[6] for row in steps if row[2] == "top"] == [f"{limit:.2f}"] * 4
        assert {row[-1] for row in steps if row[2] == "bottom"} == {"not in line"}


def test_the_place_is_given_in_the_model_and_on_the_site(crossing):
    site = SiteDatum(1000.0, 2000.0, 10.0, math.pi / 2, "m")
    node = crossing[1].nodes[0]
    places = table(node_sheets(crossing, SheetStyle(site=site)), "system")
    assert places[0][1:] == tuple(fixed(value, 1) for value in (node.x, node.y, node.z))
    wanted = site.of(np.array([node.x, node.y, node.z]))
    assert [float(cell) for cell in places[1][1:]] == pytest.approx(wanted, abs=0.001)


def test_nodes_are_drawn_where_the_member_that_runs_through_is_there(crossing):
    through, branch = crossing
    assert has_nodes(crossing) and node_sheets(crossing)
    for only in ([through], [branch], []):
        assert not has_nodes(only) and node_sheets(only) == ()


def test_a_build_writes_the_nodes_puts_them_in_the_set_and_leaves_them(crossing, tmp_path):
    (tmp_path / "sheets").mkdir()
    style, folder = SheetStyle("Hall"), OutputFolder(tmp_path, {}, "Hall")
    for record in crossing:
        (tmp_path / sheet_name(record.member)).write_bytes(sheets_pdf((record, style)))
    write_sheet_set(folder, crossing, ["one", "other"], style)
    for name in (NODES, SHEET_SET):
        text = subprocess.run(
            ["pdftotext", "-raw", str(tmp_path / name), "-"],
            capture_output=True,
            encoding="utf-8",
            check=True,
        ).stdout
        for wanted in ("node N1", "Y-T1", "X-D1", "60.00", "30.0", "root gap 3.0"):
            assert wanted in text
    before = (tmp_path / NODES).stat().st_mtime_ns
    folder.close()
    again = OutputFolder(tmp_path, read_manifest(tmp_path), "Hall")
    write_sheet_set(again, crossing, ["one", "other"], style)
    again.close()
    assert (tmp_path / NODES).stat().st_mtime_ns == before
    # Without its branch there is no node to draw, and the drawing goes.
    last = OutputFolder(tmp_path, read_manifest(tmp_path), "Hall")
    write_sheet_set(last, crossing[:1], ["one"], style)
    last.close()
    assert not (tmp_path / NODES).exists() and (tmp_path / SHEET_SET).exists()


def test_a_line_is_clipped_between_two_planes():
    ring = np.array([(-5.0, 0, 0), (5, 0, 0), (5, 1, 0), (-5, 1, 0), (-5, 0, 0)])
    runs, breaks = clipped(ring, np.zeros(3), np.array([1.0, 0, 0]), 2.0)
    assert [run[:, 0].tolist() for run in runs] == [[-2.0, 2.0], [2.0, -2.0]]
    assert [cut[:, 0].tolist() for cut in breaks] == [[-2.0, -2.0], [2.0, 2.0]]
    runs, breaks = clipped(ring, np.zeros(3), np.array([1.0, 0, 0]), 9.0)
    assert len(runs) == 1 and not breaks and runs[0] == pytest.approx(ring)
    assert clipped(ring + (20.0, 0, 0), np.zeros(3), np.array([1.0, 0, 0]), 9.0) == ([], [])


def test_an_edit_lays_out_anew_the_nodes_it_changes_only(monkeypatch):
    members = [X, CROSSING[1], ("Z", (1500.0, -2500.0, 0.0), (1500.0, 2500.0, 0.0), SMALL)]
    found = records(members)
    laid = []
    real = sheet_node.node_pages
    monkeypatch.setattr(sheet_node, "node_pages", lambda *given: (laid.append(1), real(*given))[1])
    style = SheetStyle("An edit")
    before = node_sheets(found, style)
    assert len(laid) == 2
    changed = [*found[:2], replace(found[2])]
    assert node_sheets(changed, style) == before
    assert len(laid) == 3
