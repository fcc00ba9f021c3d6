# SPDX-License-Identifier: LGPL-2.1-or-later
"""Section properties against published values and closed forms."""

import numpy as np
import pytest

from BendTorsionWB.core import rules
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.sections.section_catalogue import entries, entry
from BendTorsionWB.core.sections.section_properties import (
    FlatPart,
    flat_parts,
    section_properties,
    slenderness_class,
)
from BendTorsionWB.core.sections.section_strips import StripRow, strip_list
from BendTorsionWB.core.sections.section_types import (
    channel,
    i_section,
    polygon,
    ring_of_sides,
    t_section,
    trapezoid,
)


@pytest.mark.parametrize("type", ["box1", "box2"])
@pytest.mark.parametrize(
    "size, t, inertia, torsion, mass",
    [(800, 20, 6.332e9, 9.491e9, 489.8), (600, 16, 2.126e9, 3.187e9, 293.4)],
)
def test_square_boxes_of_the_case_study(type, size, t, inertia, torsion, mass):
    found = section_properties(box("S", type, size, size, t))
    assert (found.iy, found.iz) == pytest.approx((inertia, inertia), rel=2e-4)
    assert found.j == pytest.approx(torsion, rel=2e-4)
    assert found.mass_per_length * 1e3 == pytest.approx(mass, rel=2e-4)
    assert found.iy == pytest.approx((size**4 - (size - 2 * t) ** 4) / 12, rel=1e-12)
    assert found.painted_area == pytest.approx(4 * size)
    assert found.centroid == pytest.approx((0, 0), abs=1e-9)


# Published sizes, cm2, cm4 (EN 10365 tables); the root fillets are the tables', not ours.
@pytest.mark.parametrize(
    "name, radius, area, iy, iz",
    [
        ("HEB 300", 27, 149.1, 25170, 8563),
        ("IPE 500", 21, 115.5, 48200, 2142),
        ("HEA 300", 27, 112.5, 18260, 6310),
    ],
)
def test_rolled_sections_with_their_fillets_added_meet_the_tables(name, radius, area, iy, iz):
    section = entry(name).section()
    found = section_properties(section)
    t_web, t_flange = section.strips[2].thickness, section.strips[0].thickness
    fillet = (1 - np.pi / 4) * radius**2
    # The centroid of a fillet lies 0.2234 r from both faces.
    z = section.h / 2 - t_flange - 0.2234 * radius
    y = t_web / 2 + 0.2234 * radius
    assert found.area + 4 * fillet == pytest.approx(area * 100, rel=2e-3)
    assert found.iy + 4 * fillet * z**2 == pytest.approx(iy * 1e4, rel=2e-3)
    assert found.iz + 4 * fillet * y**2 == pytest.approx(iz * 1e4, rel=4e-3)


def test_an_unequal_i_by_the_parallel_axis_theorem():
    section = i_section("I", 900, 400, 25, 32, 14, b_bottom=300)
    parts = [(400, 25, 450 - 12.5), (300, 32, -450 + 16), (14, 900 - 57, (25 - 32) / -2)]
    area = sum(b * h for b, h, _ in parts)
    z = sum(b * h * z for b, h, z in parts) / area
    found = section_properties(section)
    assert found.area == pytest.approx(area)
    assert found.centroid == pytest.approx((0, z), abs=1e-9)
    assert found.iy == pytest.approx(sum(b * h**3 / 12 + b * h * (c - z) ** 2 for b, h, c in parts))
    assert found.iz == pytest.approx(sum(h * b**3 / 12 for b, h, _ in parts))
    assert found.j == pytest.approx((400 * 25**3 + 300 * 32**3 + (900 - 57) * 14**3) / 3)
    assert found.painted_area == pytest.approx(2 * 400 + 2 * 300 + 2 * 900 - 2 * 14)


def test_tee_and_channel_by_hand():
    tee = section_properties(t_section("T", 300, 200, 16, 10))
    area = 200 * 16 + 284 * 10
    z = (200 * 16 * 142 + 284 * 10 * (-8)) / area
    assert tee.centroid == pytest.approx((0, z), abs=1e-9)
    assert tee.iy == pytest.approx(
        200 * 16**3 / 12 + 3200 * (142 - z) ** 2 + 10 * 284**3 / 12 + 2840 * (-8 - z) ** 2
    )
    u = section_properties(channel("C", 400, 200, 16, t_web=12))
    area = 2 * 200 * 16 + 368 * 12
    assert u.centroid == pytest.approx((368 * 12 * 94 / area, 0), abs=1e-9)
    assert u.iy == pytest.approx(200 * 400**3 / 12 - 188 * 368**3 / 12)


def test_an_angle_has_the_principal_axes_of_an_angle():
    rows = [
        StripRow("leg", "L", 50, -50, 50, 50, 10, "left"),
        StripRow("foot", "F", 50, -50, -50, -50, 10, "right", "leg"),
    ]
    found = section_properties(strip_list("A", rows))
    assert found.area == 100 * 10 + 90 * 10
    # Of equal legs the axes lie at 45 degrees, and I1 + I2 = Iy + Iz.
    assert abs(found.angle) == pytest.approx(np.pi / 4)
    assert found.iy == pytest.approx(found.iz)
    assert found.i1 - found.i2 == pytest.approx(2 * abs(found.iyz))
    # Axis 1 has the larger moment: it lies across the bisector, the axis of symmetry along it.
    direction = np.array([np.cos(found.angle), np.sin(found.angle)])
    toward_heel = np.array([1.0, -1.0]) / np.sqrt(2)
    assert abs(direction @ toward_heel) == pytest.approx(1.0 if found.i1 > 0 else 0.0, abs=1e-9)


@pytest.mark.parametrize("joint", ["mitre", "flanges", "webs"])
def test_a_trapezoid_is_the_difference_of_two_trapezoids(joint):
    h, b, d, t = 800.0, 1000.0, 600.0, 20.0
    found = section_properties(trapezoid("Z", h, b, d, t, joint=joint))
    slope = (b - d) / 2 / h
    inset = t * np.hypot(1.0, slope)

    def moments(top, bottom, height, middle):
        area = (top + bottom) / 2 * height
        z = height / 6 * (top - bottom) / (top + bottom)
        own = height**3 * (top**2 + 4 * top * bottom + bottom**2) / (36 * (top + bottom))
        return area, middle + z, own + area * (middle + z) ** 2

    inner_top, inner_bottom = b - 2 * (slope * t + inset), d + 2 * (slope * t - inset)
    outer, inner = moments(b, d, h, 0.0), moments(inner_top, inner_bottom, h - 2 * t, 0.0)
    area = outer[0] - inner[0]
    z = (outer[0] * outer[1] - inner[0] * inner[1]) / area
    assert found.area == pytest.approx(area, rel=1e-12)
    assert found.centroid == pytest.approx((0, z), abs=1e-9)
    assert found.iy == pytest.approx(outer[2] - inner[2] - area * z**2, rel=1e-12)


@pytest.mark.parametrize("joint", ["mitre", "ring"])
def test_a_regular_polygon_has_bredts_constant_of_its_middle_line(joint):
    n, side, t = 6, 500.0, 12.0
    found = section_properties(
        polygon("P", ring_of_sides([side] * 5, [2 * np.pi / 3] * 4), t, joint)
    )
    apothem = side / 2 / np.tan(np.pi / n)
    middle = side * (apothem - t / 2) / apothem
    area = n * middle * (apothem - t / 2) / 2
    assert found.j == pytest.approx(4 * area**2 / (n * middle / t))
    assert found.area == pytest.approx(n * middle * t)
    assert found.iy == pytest.approx(found.iz)


def test_gaps_take_their_plate_away():
    whole, gapped = (
        section_properties(box("B", "box1", 500, 400, 16, gap1=g, gap2=2 * g)) for g in (0.0, 4.0)
    )
    assert whole.area - gapped.area == pytest.approx(2 * 12 * 16)


def test_flat_parts_and_their_classes():
    eps = np.sqrt(235 / 355)
    [top, *_] = flat_parts(box("B", "box1", 800, 800, 20))
    assert top == FlatPart("top", "internal", 760.0, 20)
    # 38.0 > 45 eps = 36.6: beyond S4.
    assert top.slenderness > 45 * eps
    assert slenderness_class(top, rules.load("CN"), 355, 206000) == 5
    parts = flat_parts(i_section("H", 300, 300, 19, t_web=11))
    assert [(p.face, p.kind, p.width) for p in parts] == [
        ("top", "outstand", 144.5),
        ("top", "outstand", 144.5),
        ("bottom", "outstand", 144.5),
        ("bottom", "outstand", 144.5),
        ("web", "internal", 262.0),
    ]
    assert slenderness_class(parts[0], rules.load("EU"), 235, 210000) == 1
    assert slenderness_class(parts[0], {}, 235, 210000) is None
    limit = float(rules.load("EU")["slenderness_outstand_1"]["value"])
    edge = FlatPart("top", "outstand", limit * 10, 10)
    assert slenderness_class(edge, rules.load("EU"), 235, 210000) == 1
    assert slenderness_class(edge, rules.load("EU"), 236, 210000) == 2


def test_every_catalogue_section_builds_and_names_its_source(tmp_path):
    found = entries()
    assert len({e.name for e in found}) == len(found) > 10
    for each in found:
        assert each.source and each.status
        assert section_properties(each.section()).area > 0
    broken = tmp_path / "sections.json"
    broken.write_text('{"sections": [{"name": "X"}]}', encoding="utf-8")
    with pytest.raises(BendTorsionError) as caught:
        entries(broken)
    assert caught.value.findings[0].code == "catalogue"
    with pytest.raises(BendTorsionError):
        entry("HEB 1")
