# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sections of every type through the pipeline: plates, solids, patterns, sheets, transitions."""

import ezdxf
import FreeCAD
import numpy as np
import openpyxl
import pytest
from curved_members import ELLIPSOID, diagonal, in_space, irregular, member

from BendTorsionWB import make
from BendTorsionWB.core import detailing, tolerances
from BendTorsionWB.core.axes.axis import fit_axis
from BendTorsionWB.core.drawings.sheet_layout import member_sheets
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.members.volume import skin_volumes
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.patterns.pattern import develop_plate
from BendTorsionWB.core.plates.plates import Joints, split_plates
from BendTorsionWB.core.sections.section_checks import overlap
from BendTorsionWB.core.sections.section_properties import section_properties
from BendTorsionWB.core.sections.section_strips import StripRow, strip_list
from BendTorsionWB.core.sections.section_types import (
    TYPES,
    channel,
    i_section,
    polygon,
    ring_of_sides,
    section_of,
    t_section,
    trapezoid,
)
from BendTorsionWB.core.sections.strip_lines import section_polygons
from BendTorsionWB.core.solids import solid_skins
from BendTorsionWB.exchange.dxf import write_plate_dxf
from BendTorsionWB.exchange.results_workbook import write_results
from BendTorsionWB.shapes import brep

PLANE = analytic_surface("plane", {})
RIBBED = (
    ("top", "T", 200, 0, -200, 0, "left"),
    ("web", "W", 0, 0, 0, -400, "middle", "top 2"),
    ("rib", "R", 0, -200, 150, -200, "middle", "web"),
)


def ribbed(f, t):
    return strip_list(
        "S",
        [
            StripRow(
                face, letter, y1 * f, z1 * f, y2 * f, z2 * f, t if face == "top" else t - 6, *rest
            )
            for face, letter, y1, z1, y2, z2, *rest in RIBBED
        ],
    )


KINDS = {
    "i": lambda f, t: i_section("H", 500 * f, 300 * f, t, t_web=t - 8),
    "tee": lambda f, t: t_section("T", 400 * f, 300 * f, t, t - 8),
    "channel": lambda f, t: channel("C", 500 * f, 250 * f, t, t_web=t - 4, gap1=2),
    "flanges": lambda f, t: trapezoid("Z", 800 * f, 900 * f, 600 * f, t, t - 2, t - 4),
    "webs": lambda f, t: trapezoid("Z", 800 * f, 900 * f, 600 * f, t, t - 2, t - 4, joint="webs"),
    "mitre": lambda f, t: trapezoid("Z", 800 * f, 900 * f, 600 * f, t, joint="mitre"),
    "hexagon": lambda f, t: polygon("P", ring_of_sides([450 * f] * 5, [2 * np.pi / 3] * 4), t),
    "triangle": lambda f, t: polygon("P", [(0, 0), (600 * f, 0), (300 * f, 500 * f)], t, "ring"),
    "strips": ribbed,
}


def built(kind, transition="linear", **placing):
    make_one = KINDS[kind]
    return member(
        [
            Segment(make_one(1.0, 20)),
            Segment(make_one(0.75, 16), 9000.0, transition=transition, **placing),
        ]
    )


def cross_sections(m, plates, s):
    """Polygons (4, 2) of the plates there at s, in the section plane."""
    at = m.frames.at(np.array([s]))
    found = []
    for plate in plates:
        if plate.start <= s <= plate.end:
            outer, inner = (
                group(at.s).reshape(2, 3) - at.origin
                for group in (plate.rails.outer, plate.rails.inner)
            )
            ring = np.concatenate([outer, inner[::-1]])
            found.append(np.column_stack([ring @ at.y[0], ring @ at.z[0]]))
    return found


@pytest.mark.parametrize("transition", ["linear", "smooth"])
@pytest.mark.parametrize("kind", KINDS)
def test_plates_are_valid_solids_of_exact_volume_that_keep_clear_of_each_other(kind, transition):
    m = built(kind, transition, align="top-left", align_to="previous")
    plates, _ = split_plates(m, {})
    skins = [solid_skins.plate_skin(plate) for plate in plates]
    solids = brep.tube_solids([[(p.knots, p.poles) for p in skin] for skin in skins])
    for plate, solid, volume in zip(plates, solids, skin_volumes(skins), strict=True):
        assert solid.isValid() and solid.isClosed() and solid.ShapeType == "Solid"
        assert volume == pytest.approx(plate.volume, rel=tolerances.VOLUME_RELATIVE)
    places = np.concatenate(
        [np.linspace(1.0, m.length - 1, 40), [f + d for f in m.law.folds for d in (-2.0, 0.5, 2.0)]]
    )
    for s in places:
        rings = cross_sections(m, plates, s)
        deepest = max(overlap(a, b) for i, a in enumerate(rings) for b in rings[:i])
        # Within millimetres of a fold the mitres lie off the section plane.
        near = np.abs(s - np.array(m.law.folds or [-1e9])).min() < 5.0
        assert deepest < (0.06 if near else 1e-3)


@pytest.mark.parametrize("kind", KINDS)
def test_patterns_of_every_type_keep_their_edges_and_lines(kind):
    plates, _ = split_plates(built(kind), {})
    for plate in plates:
        pattern = develop_plate(plate)
        assert pattern.length_error_max < 2.5 * pattern.length_error_bound + 1e-6
        for panel in pattern.panels:
            if panel.what.startswith("edge"):
                assert panel.flat == pytest.approx(panel.arc, abs=tolerances.SEAM_LENGTH)
        for line in pattern.lines:
            assert line.length_flat == pytest.approx(line.length_3d, abs=1e-6)


@pytest.mark.parametrize("kind", KINDS)
def test_cross_sections_are_those_of_the_section(kind):
    m = built(kind)
    plates, _ = split_plates(m, {})
    section = KINDS[kind](1.0, 20)
    # A strip tilts a little where the frame turns: its inset is true to the plate, not the plane.
    for wanted, found in zip(section_polygons(section), cross_sections(m, plates, 3000.0)):
        assert np.abs(wanted - found).max() < 0.02


def test_the_web_of_an_i_stands_in_the_middle_whatever_its_thickness():
    plates, _ = split_plates(built("i"), {})
    for s in (3000.0, 9100.0, 15000.0):
        web = cross_sections(built("i"), [p for p in plates if p.face == "web"], s)[0]
        assert web[:, 0].max() == pytest.approx(-web[:, 0].min(), abs=1e-3)


def test_mass_of_a_straight_i_is_its_mass_per_length():
    section = KINDS["i"](1.0, 20)
    straight = member(
        [Segment(section)],
        lambda t: np.column_stack([6000 * np.asarray(t), 0 * np.asarray(t), 0 * np.asarray(t)]),
        PLANE,
        points=5,
    )
    plates, _ = split_plates(straight, {})
    total = sum(plate.volume for plate in plates)
    assert total == pytest.approx(section_properties(section).area * 6000, rel=1e-12)


def test_a_smooth_transition_has_no_folds_and_eased_corners():
    m = built("i", "smooth")
    assert m.law.folds == ()
    b = next(cell for cell in m.law.cells if cell.is_transition)
    x = np.linspace(0, 1, 60)
    s = b.start + x * (b.end - b.start)
    ease = (3 * x**2 - 2 * x**3)[:, None, None]
    big, small = (np.array(one.corners) for one in m.law.sections)
    expected = big + ease * (small - big)
    assert b.corners_at(s) == pytest.approx(expected, abs=1e-9)
    inside = s[1:-1]
    corners = m.corners(0.0, m.length)(inside).reshape(len(inside), -1, 3)
    for k in range(corners.shape[1]):
        by_hand = in_space(m, ELLIPSOID, inside, expected[1:-1, k])
        assert np.linalg.norm(corners[:, k] - by_hand, axis=1).max() < 1e-3
    [steeper] = [f for f in m.law.findings if f.code == "smooth-transition-steeper"]
    assert steeper.severity == "note" and "3.75" in steeper.mend


def test_joints_are_given_by_the_names_of_the_faces():
    m = built("i")
    plates, _ = split_plates(m, {"web": Joints((0.25, 1.0))})
    webs = [p for p in plates if p.face == "web"]
    assert [p.mark for p in webs] == [f"M1-W{k + 1}" for k in range(len(webs))]
    assert webs[0].end == pytest.approx(0.25 * m.length)


@pytest.mark.parametrize(
    "make_one, code",
    [
        (lambda: i_section("S", 0, 300, 20), "section-size"),
        (lambda: i_section("S", 40, 300, 20), "plate-too-thick"),
        (lambda: i_section("S", 400, 300, 20, gap1=200, gap2=200), "gap-too-wide"),
        (lambda: t_section("S", 300, 200, 16, gap1=-1), "section-gap"),
        (lambda: channel("S", 400, 200, 16, gap1=300, gap2=300), "gap-too-wide"),
        (lambda: trapezoid("S", 800, 900, 600, 20, joint="glue"), "section-joint"),
        (lambda: polygon("S", [(0, 0), (1, 1)], 5), "section-corners"),
        (lambda: polygon("S", [(0, 0), (300, 0), (150, 250)], 120), "gap-too-wide"),
        (lambda: strip_list("S", []), "section-strips"),
        (lambda: strip_list("S", [StripRow("a", "A", 0, 0, 9, 0, 1, "up")]), "section-side"),
        (lambda: strip_list("S", [StripRow("a", "A", 0, 0, 9, 0, 1, stop1="b")]), "strip-stop"),
        (
            lambda: strip_list(
                "S", [StripRow("a", "A", 0, 0, 90, 0, 9), StripRow("b", "B", 45, 0, 45, 90, 9)]
            ),
            "plates-overlap",
        ),
        (lambda: strip_list("S", [StripRow("a", "A", 0, 0, 90, 0, 9)] * 2), "strip-name"),
        (lambda: section_of("S", "sigma"), "section-type"),
    ],
)
def test_sizes_that_make_no_section_are_refused(make_one, code):
    with pytest.raises(BendTorsionError) as caught:
        make_one()
    assert code in {f.code for f in caught.value.findings}
    assert all(f.object == "S" and f.mend for f in caught.value.findings)


def test_strips_that_change_along_a_member_are_refused():
    ring = [
        polygon("P", ring_of_sides([450] * (n - 1), [np.pi - 2 * np.pi / n] * (n - 2)), 12)
        for n in (5, 6)
    ]
    with pytest.raises(BendTorsionError) as caught:
        member([Segment(ring[0]), Segment(ring[1], 9000.0)])
    [finding] = caught.value.findings
    assert (finding.code, finding.position) == ("strips-change", "segment 2")


SIZES = {
    "i": {"h": 500, "b": 300, "t": 20, "t_web": 12},
    "channel": {"h": 500, "b": 250, "t": 16},
    "trapezoid": {"h": 800, "b": 900, "b_bottom": 600, "t": 20, "corner_joint": "webs"},
    "polygon": {"corners": [(0, 0), (600, 0), (300, 500)], "t": 12},
    "strips": {
        "strips": [
            ("top", "T", 200, 0, -200, 0, 20, "left"),
            ("web", "W", 0, 0, 0, -400, 12, "middle", "top 2"),
        ]
    },
}


@pytest.mark.parametrize("type", SIZES)
def test_document_objects_take_every_type(type):
    document = FreeCAD.newDocument()
    try:
        surface = make.make_surface(document, "S", "ellipsoid", a=40000, b=30000, c=20000)
        axis = make.make_axis(document, "A1", surface, irregular(diagonal, 9).tolist())
        section = make.make_section(document, "S1", type, **SIZES[type])
        built_member = make.make_member(document, "M1", axis, [section])
        face = {"polygon": "side2", "trapezoid": "left"}.get(type, "web")
        plates = make.make_plates(document, built_member, {face: [0.4, 1.0]})
        unfold = make.make_unfold(document, plates)
        sheets = make.make_sheets(document, unfold)
        document.recompute()
        assert [o.Status for o in (section, built_member, plates, unfold, sheets)] == ["ok"] * 5
        assert built_member.Shape.isValid() and built_member.Shape.Solids
        assert plates.PlateCount == len(plates.Shape.Solids)
        assert plates.Shape.Volume == pytest.approx(plates.Volume.Value, rel=1e-5)
        assert section.MassPerMetre == pytest.approx(section.Area.Value * 7.85e-3)
        # An edit of the joints of a face of its own name goes through.
        before = plates.PlateCount
        setattr(plates, f"Joints{face.capitalize()}", [0.3, 0.6, 1.0])
        document.recompute()
        assert plates.PlateCount == before + 1 and plates.Status == "ok"
    finally:
        FreeCAD.closeDocument(document.Name)


def test_a_section_saved_with_fewer_types_keeps_its_own_and_gets_the_new_ones():
    assert TYPES[:2] == ("box1", "box2")
    document = FreeCAD.newDocument()
    try:
        section = make.make_section(document, "S1", "box2", h=500, b=400, t=12)
        section.Type = ["box1", "box2"]
        section.Type = "box2"
        section.Proxy.onDocumentRestored(section)
        assert section.Type == "box2"
        assert section.getEnumerationsOfProperty("Type") == list(TYPES)
    finally:
        FreeCAD.closeDocument(document.Name)


def test_a_catalogue_section_becomes_an_object():
    document = FreeCAD.newDocument()
    try:
        section = make.make_catalogue_section(document, "HEB 300")
        document.recompute()
        assert (section.Type, section.Height.Value, section.Status) == ("i", 300.0, "ok")
        assert section.Area.Value == pytest.approx(2 * 300 * 19 + 262 * 11)
        assert section.Slenderness[-1].startswith("web internal 262.0/11 = 23.8")
        section.ThicknessWeb = 320
        document.recompute()
        assert section.Status.startswith("error") and section.Area.Value == 0.0
    finally:
        FreeCAD.closeDocument(document.Name)


@pytest.mark.parametrize("type", ["i", "channel", "trapezoid"])
def test_files_and_sheets_take_every_type(type, tmp_path):
    kind = {"trapezoid": "flanges"}.get(type, type)
    segments = (Segment(KINDS[kind](1.0, 20)), Segment(KINDS[kind](0.75, 16), 9000.0))
    axis = fit_axis("A1", irregular(diagonal, 9), ELLIPSOID)
    geometry = detailing.member_of(detailing.MemberInput("M1", segments), axis, ELLIPSOID)
    record = detailing.record_of(detailing.plates_of(geometry, detailing.PlatesInput()))
    assert record.section_type == type
    assert len(record.plates) == 2 * len(segments[0].section.strips)
    write_results([record], record.findings, tmp_path / "results.xlsx")
    rows = list(openpyxl.load_workbook(tmp_path / "results.xlsx")["Plates"].values)
    faces = [row[rows[0].index("face")] for row in rows[1:]]
    assert set(faces) == {strip.face for strip in segments[0].section.strips}
    for plate in record.plates:
        write_plate_dxf(plate, tmp_path / f"{plate.mark}.dxf")
        drawn = ezdxf.readfile(tmp_path / f"{plate.mark}.dxf").modelspace()
        assert len(drawn.query('LWPOLYLINE[layer=="CUT_OUTER"]')) == 1
    texts = [text.text for sheet in member_sheets(record) for text in sheet.texts]
    assert any("1:" in text for text in texts) and all(
        any(plate.mark in text for text in texts) for plate in record.plates
    )
