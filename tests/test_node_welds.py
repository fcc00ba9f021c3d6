# SPDX-License-Identifier: LGPL-2.1-or-later
"""Welds at nodes: grooves by the angle between the plates, bevels along cuts, diaphragms."""

import math

import ezdxf
import numpy as np
import pytest
from test_sheet_node import BIG, LOW, PLANE, X, at, details, straight

from BendTorsionWB.core import detailing
from BendTorsionWB.core.axes.axis_input import AxisInput
from BendTorsionWB.core.axes.frames import FrameInput
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.members.end_cut import EndCut
from BendTorsionWB.core.members.segment import Segment
from BendTorsionWB.core.nodes.node_input import NodeInput
from BendTorsionWB.core.patterns.cut_contour import cut_contour
from BendTorsionWB.core.patterns.laid_flat import PatternInput
from BendTorsionWB.core.welds.edge_rows import EdgeTreatment
from BendTorsionWB.core.welds.preps import prep_of, prep_text
from BendTorsionWB.exchange.dxf import write_plate_dxf
from BendTorsionWB.exchange.html_report import html_report
from BendTorsionWB.exchange.report import report_json
from BendTorsionWB.exchange.weld_tables import weld_tables


def crossing(degrees, rows=(), edges=(), contour="mid"):
    """A low box that crosses a straight one at an angle; both records."""
    jobs = {m[0]: straight(*m) for m in (X, ("Y", at(degrees, -2500), at(degrees, 2500), LOW))}
    own = jobs["Y"]
    jobs["Y"] = detailing.MemberJob(
        own.surface,
        own.axis,
        own.member,
        detailing.PlatesInput(edges=edges),
        patterns=PatternInput(contour=contour),
    )
    return [one.record for one in details(jobs, rows)]


def welds(record, kind="node"):
    return {weld.mark: weld for weld in record.welds if weld.kind == kind}


@pytest.mark.parametrize(
    ("degrees", "acute", "obtuse"), [(90.0, 45.0, 45.0), (60.0, 30.0, 45.0), (40.0, 20.0, 50.0)]
)
def test_grooves_follow_the_outer_angle(degrees, acute, obtuse):
    """Square flanges take the rule's 45 degrees; a web that stands sharp to the face half of its
    outer angle, one that leans over by more than the groove is cut square."""
    found = welds(crossing(degrees)[1])
    assert len(found) == 8
    for mark, weld in found.items():
        face = mark.split("-")[-1][0]
        inside = math.degrees(weld.dihedral)
        assert inside == pytest.approx(
            90.0 if face in "TB" else min((degrees, 180.0 - degrees), key=lambda a: abs(a - inside))
        )
        wanted = 45.0 if face in "TB" else acute if inside > 90.0 + 1e-6 else obtuse
        assert math.degrees(weld.prep.angle) == pytest.approx(wanted)
        assert (weld.prep.gap, weld.place, weld.thickness) == (3.0, "field", (12.0, 16.0))
        length = 276.0 / math.sin(math.radians(degrees)) if face in "TB" else 360.0
        assert weld.length == pytest.approx(length, abs=1e-6)


@pytest.mark.parametrize("off", [0.0, 1e-9, -1e-9, 0.02, -0.02])
def test_a_symmetric_pair_of_struts_has_the_same_grooves(off):
    """Struts at 60 degrees, one of them off by what a survey or a slight twist leaves."""
    jobs = {
        name: straight(name, at(angle, 2500, x), (x, 0, 0), LOW)
        for name, angle, x in (("Y", -120.0, -250.0), ("Z", -60.0 + off, 250.0))
    }
    _, one, two = (own.record for own in details({"X": straight(*X), **jobs}))
    angles = [sorted(math.degrees(w.prep.angle) for w in welds(r).values()) for r in (one, two)]
    assert angles[0] == pytest.approx(angles[1], abs=1e-9)
    assert angles[0] == pytest.approx([30.0, 45.0, 45.0, 45.0])


def test_bevels_leave_the_groove_between_plate_and_face():
    """Angle of the edge against square, plus its lean over the face, is the groove's angle."""
    record = crossing(60.0)[1]
    for plate in record.plates:
        (bevel,) = [b for b in plate.bevels if b.side in ("start", "end")]
        weld = next(w for w in record.welds if w.mark == bevel.weld)
        assert bevel.outer[0] + bevel.natural == pytest.approx(weld.prep.angle, abs=2e-3)
        assert bevel.outer[1] == pytest.approx(12.0 - 2.0) and bevel.inner == (0.0, 0.0)
        assert (bevel.start, bevel.end) == pytest.approx((0.0, weld.length))
        natural = 0.0 if plate.face in ("top", "bottom") else 30.0
        assert abs(math.degrees(bevel.natural)) == pytest.approx(natural, abs=0.05)


def test_the_cut_contour_of_a_face_reaches_it_at_the_node():
    """A web that stands sharp to the face outside ends with its inner edge, half its thickness
    times tan 30 beyond the mid-surface; one that leans over with its land, 10 mm below its outer
    face, from where the groove is cut back."""
    size = {}
    for contour in ("mid", "widest"):
        record = crossing(60.0, contour=contour)[1]
        size[contour] = {plate.mark: cut_contour(plate).plate.length for plate in record.plates}
    webs = [mark for mark in size["mid"] if mark[2] in "LR"]
    grown = sorted(size["widest"][mark] - size["mid"][mark] for mark in webs)
    slope = math.tan(math.radians(30.0))
    assert grown == pytest.approx([(6.0 - 10.0) * slope] * 2 + [6.0 * slope] * 2, abs=0.02)


def test_rows_of_edges_name_nodes():
    prep = prep_of("double-bevel angle=50 land=1")
    rows = (EdgeTreatment("nodes", prep=prep, place="shop", ndt="UT 100"),)
    record = crossing(90.0, edges=rows)[1]
    assert not [f for f in record.findings if f.code == "edge-row-unused"]
    for weld in welds(record).values():
        assert (weld.place, weld.ndt, weld.prep.gap) == ("shop", "UT 100", 3.0)
        assert weld.prep.type == "double-bevel"
    named = crossing(90.0, edges=(EdgeTreatment("N1", place="shop"),))[1]
    assert {weld.place for weld in welds(named).values()} == {"shop"}


@pytest.mark.parametrize("degrees", [60.0, 40.0])
def test_seams_beside_a_node_tell_their_dihedral(degrees):
    """A plate that reaches farther than its neighbour at the cut meets its face continued."""
    record = crossing(degrees)[1]
    for plate in record.plates:
        for edge in plate.edges:
            np.testing.assert_allclose(edge.dihedral, 0.5 * math.pi, atol=1e-6)
    seams = welds(record, "seam")
    assert len(seams) == 8
    assert all(w.dihedral == pytest.approx(0.5 * math.pi) for w in seams.values())


def test_a_gap_of_a_row_that_the_node_does_not_keep_is_told():
    def told(gap):
        rows = (EdgeTreatment("N1", prep=prep_of(f"bevel angle=50 land=1{gap}")),)
        return [f for f in crossing(90.0, edges=rows)[1].findings if f.code == "node-root-gap"]

    (found,) = told(" gap=2")
    assert (found.object, found.position, found.value, found.limit) == ("Y", "edge 1", 2.0, 3.0)
    assert found.severity == "warning" and "sheet Nodes" in found.mend
    assert told("") == told(" gap=3") == []


def test_all_walls_welded_from_inside_a_small_box_on_site_are_refused():
    """276 by 336 mm clear: nobody gets in to weld; from outside, and in the shop, it can be."""
    inner = prep_of("bevel angle=40 land=2 inner backing=30x6")
    with pytest.raises(BendTorsionError) as caught:
        crossing(90.0, edges=(EdgeTreatment("N1", prep=inner),))
    (found,) = caught.value.findings
    assert (found.code, found.object, found.position) == ("weld-access", "Y", "edge 1")
    assert (found.value, found.limit) == (pytest.approx(276.0), 400.0)
    assert "N1" in found.message and "276 x 336 mm clear" in found.message
    with pytest.raises(BendTorsionError):
        crossing(90.0, edges=(EdgeTreatment("N1", prep=prep_of("double-bevel angle=50 land=2")),))
    shop = crossing(90.0, edges=(EdgeTreatment("N1", prep=inner, place="shop"),))[1]
    assert [f.severity for f in shop.findings if f.code == "weld-access"] == ["warning"]
    outer = prep_of("bevel angle=40 land=2 backing=30x6")
    from_outside = crossing(90.0, edges=(EdgeTreatment("N1", prep=outer),))[1]
    assert not [f for f in from_outside.findings if f.code == "weld-access"]


def test_diaphragms_have_fillets_along_the_walls():
    through, _ = crossing(90.0, rows=(NodeInput("X", "Y", diaphragms="flanges and webs"),))
    found = welds(through, "diaphragm")
    # Two flanges against two walls and both webs, and two webs against four walls each.
    assert len(found) == 2 * 4 + 2 * 4
    on = {weld.plates[1] for weld in found.values()}
    assert on == {"X-T1", "X-B1", "X-L1", "X-R1", "X-D3", "X-D4"}
    stops = {mark: found[mark] for mark in ("X-D1/D3", "X-D1/D4", "X-D2/D3", "X-D2/D4")}
    # From wall to wall, 400 less two of 16 and two gaps of 2.
    assert {round(weld.length, 6) for weld in stops.values()} == {364.0}
    for weld in found.values():
        assert (weld.prep.type, weld.prep.leg, weld.place) == ("double-fillet", 9.0, "shop")
    plates = {plate.mark: plate for plate in through.plates}
    for mark, plate in plates.items():
        if plate.face == "diaphragm":
            sides = sum(w.length for w in found.values() if w.plates[0] == mark)
            outline = np.concatenate(plate.outline)
            ring = np.concatenate([outline, outline[:1]])
            around = float(np.hypot(*np.diff(ring, axis=0).T).sum())
            # Flanges are welded all round, webs but for their snipes.
            snipes = 0.0 if mark in ("X-D1", "X-D2") else 4 * math.hypot(30.0, 30.0)
            assert sides == pytest.approx(around - snipes)


def test_the_workbook_and_the_cut_files_tell_them(tmp_path):
    through, branch = crossing(60.0)
    _, table = weld_tables([through, branch])
    header = [column.name for column in table.columns]
    rows = [dict(zip(header, row, strict=True)) for row in table.rows]
    node = next(row for row in rows if row["weld"] == "Y-N1-L1")
    assert (node["kind"], node["plate_2"], node["angle"]) == ("node", "X right", pytest.approx(30))
    legs = {row["leg"] for row in rows if row["kind"] == "diaphragm"}
    assert legs == {9.0} and node["leg"] is None
    plate = next(p for p in branch.plates if p.mark == "Y-L1")
    path = tmp_path / "Y-L1.dxf"
    write_plate_dxf(plate, path)
    texts = [e.dxf.text for e in ezdxf.readfile(path).modelspace() if e.dxftype() == "TEXT"]
    assert any(text.startswith("60.0 deg") and "land 2" in text for text in texts)


def test_ends_cut_by_a_plane_have_their_bevel():
    """An end cut at 20 degrees to the upright: flanges lean by as much, webs are square."""
    turn = math.radians(20.0)
    cut = EndCut("plane", normal=(math.cos(turn), 0.0, math.sin(turn)))
    job = detailing.MemberJob(
        PLANE,
        AxisInput("A", np.array([[0.0, 0, 0], [3000.0, 0, 0]]), fit="keep"),
        detailing.MemberInput("M", (Segment(BIG),), frame=FrameInput("fixed"), end_cut=cut),
        detailing.PlatesInput(),
    )
    for plate in detailing.detail(job).record.plates:
        own = [b for b in plate.bevels if b.side == "end"]
        if plate.face in ("left", "right"):
            assert own == []
            continue
        (bevel,) = own
        assert abs(math.degrees(bevel.natural)) == pytest.approx(20.0, abs=0.05)
        # The cut leans back upwards: the top's inner face is the longer, the bottom's outer one.
        assert (bevel.natural > 0.0) == (plate.face == "bottom")
        assert bevel.weld == ""


def test_words_of_fillets():
    prep = prep_of("double-fillet leg=8")
    assert prep.leg == 8.0 and not prep.is_cut and prep.depth(20.0) == 0.0
    assert prep_of(prep_text(prep)) == prep


def test_the_reports_list_the_nodes_and_their_welds():
    records = crossing(60.0)
    page = html_report(records, (), "Hall", "0.1.0")
    assert "<h2>Nodes</h2>" in page and "60.00" in page
    assert "<h2>Nodes</h2>" not in html_report(records[:1], (), "Hall", "0.1.0")
    through, branch = report_json(records, (), "0.1.0")["members"]
    assert {w["kind"] for w in through["welds"]} == {"seam", "diaphragm"}
    node = next(w for w in branch["welds"] if w["weld"] == "Y-N1-L1")
    assert node["plates"] == ["Y-L1", "X right"] and node["place"] == "field"
    assert node["prep"] == "branch: bevel angle=30 land=2.0 gap=3.0"
    assert node["dihedral_deg"] == pytest.approx(120.0)
