# SPDX-License-Identifier: LGPL-2.1-or-later
"""Modes of flattening against closed forms, and the flat pattern mapped back."""

import curved_members
import FreeCAD
import numpy as np
import pytest
import ruled_patches

from BendTorsionWB import make
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.flattening.development import develop, flat_area, principal_strains, strain
from BendTorsionWB.core.flattening.elastic import relaxed
from BendTorsionWB.core.flattening.locate import locate
from BendTorsionWB.core.patterns.pattern import MODES, develop_plate
from BendTorsionWB.core.plates.plates import Joints, split_plates

ACROSS = np.linspace(0.0, 1.0, 7)


def wavy():
    return ruled_patches.bent_in_plane(lambda s: 700.0 + 200.0 * np.sin(np.pi * s / 1500.0))


def laid(rails, mode):
    if mode == "elastic":
        return relaxed(develop(rails, mode="energy"))
    return develop(rails, mode=mode)


@pytest.fixture(scope="module")
def plates():
    member = curved_members.tapered()
    faces = {face: Joints((0.3, 0.6)) for face in ("top", "left")}
    return {plate.mark: plate for plate in split_plates(member, faces)[0]}


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("patch", [ruled_patches.cylinder, ruled_patches.cone])
def test_developable_plates_are_exact_in_every_mode(patch, mode):
    rails = patch()
    development = laid(rails, mode)
    s = np.linspace(rails.start, rails.end, 97)
    assert np.abs(strain(development, s, ACROSS)).max() < 2e-10
    ends = np.array([rails.start, rails.end])
    one, two = np.array([0.1, 0.9]), np.array([0.9, 0.1])
    # Diagonals of the unrolled cylinder or cone are the same whatever the mode.
    edges = develop(rails)
    assert np.linalg.norm(np.diff(development.flat(ends, one), axis=0)) == pytest.approx(
        np.linalg.norm(np.diff(edges.flat(ends, one), axis=0)), abs=1e-6
    )
    assert np.linalg.norm(np.diff(development.flat(ends, two), axis=0)) == pytest.approx(
        np.linalg.norm(np.diff(edges.flat(ends, two), axis=0)), abs=1e-6
    )


@pytest.mark.parametrize("twist", [0.01, 0.06, 0.1])
def test_least_strain_of_a_helicoid_is_the_harmonic_mean_of_its_fibres(twist):
    width, length = 800.0, 6000.0
    rails = ruled_patches.helicoid(twist, width, length)
    development = develop(rails, mode="energy")
    half = 0.5e-3 * twist * width
    ends = development.flat(np.array([0.0, length, 0.0, length]), np.array([0.0, 0.0, 1.0, 1.0]))
    flat = length * half / np.arcsinh(half)
    assert np.linalg.norm(ends[1] - ends[0]) == pytest.approx(flat, abs=1e-7)
    assert np.linalg.norm(ends[3] - ends[2]) == pytest.approx(flat, abs=1e-7)
    true = length * np.sqrt(1.0 + half**2)
    # Edges come out short by b/12 of the total curvature, to first order.
    short = width**2 / 12.0 * (1e-3 * twist) ** 2 * length
    assert true - flat == pytest.approx(short, rel=0.01)


def test_least_strain_has_no_mean_and_no_first_moment():
    development = develop(wavy(), mode="energy")
    nodes, weights = np.polynomial.legendre.leggauss(12)
    w = 0.5 * (nodes + 1.0)
    e = strain(development, np.linspace(10.0, 5990.0, 41), w)
    assert np.abs(e).max() > 1e-3
    assert np.abs((e * weights).sum(axis=1)).max() < 1e-9
    assert np.abs((e * weights * w).sum(axis=1)).max() < 1e-9


@pytest.mark.parametrize("mode", ["edges", "energy"])
def test_every_ruling_keeps_its_length(mode):
    rails = wavy()
    development = develop(rails, mode=mode)
    s = np.linspace(0.0, 6000.0, 51)
    flat = development.flat(s, np.ones(51)) - development.flat(s, np.zeros(51))
    true = development.point(s, np.ones(51)) - development.point(s, np.zeros(51))
    lengths = np.linalg.norm(flat, axis=1), np.linalg.norm(true, axis=1)
    np.testing.assert_allclose(*lengths, rtol=0, atol=1e-9)


@pytest.mark.parametrize("mode", MODES)
def test_flat_points_find_their_place_on_the_plate(mode):
    development = laid(wavy(), mode)
    random = np.random.default_rng(5)
    s, w = random.uniform(0.0, 6000.0, 200), random.uniform(0.0, 1.0, 200)
    flat = development.flat(s, w)
    found = locate(development, flat)
    back = development.point(*found)
    assert np.linalg.norm(back - development.point(s, w), axis=1).max() < 1e-6
    with pytest.raises(BendTorsionError) as caught:
        locate(development, flat[:1] + np.array([0.0, 3000.0]))
    assert caught.value.findings[0].code == "point-off-pattern"


def test_a_point_of_a_pattern_that_is_nearly_a_ring_is_found_on_its_own_side():
    """A flat plate on 5.2 of the 6.28 rad of a circle, its own pattern: the place of a point is
    its angle and its distance from the middle."""
    radius, width, length = 1200.0, 700.0, 5.2 * 1200.0
    rails = ruled_patches.bent_in_plane(lambda s: width + 0.0 * s, radius, 0.0, length)
    random = np.random.default_rng(3)
    s, w = random.uniform(0.0, length, 300), random.uniform(0.0, 1.0, 300)
    development = develop(rails)
    place = development.point(s, w) - np.array([0.0, radius, 0.0])
    angle = np.mod(np.arctan2(place[:, 0], -place[:, 1]), 2.0 * np.pi)
    across = 0.5 + (radius - np.linalg.norm(place[:, :2], axis=1)) / width
    found = locate(development, development.flat(s, w))
    assert found[0] == pytest.approx(radius * angle, abs=1e-4)
    assert found[1] == pytest.approx(across, abs=1e-7)


@pytest.mark.parametrize("mode", MODES)
def test_the_rates_of_the_flat_map_are_those_of_its_points(mode):
    development = laid(wavy(), mode)
    s, w, step = np.linspace(100.0, 5900.0, 30), np.linspace(0.1, 0.9, 30), 1e-3
    by_s, by_w = development.jacobian(s, w)
    along = (development.flat(s + step, w) - development.flat(s - step, w)) / (2 * step)
    across = (development.flat(s, w + step) - development.flat(s, w - step)) / (2 * step)
    np.testing.assert_allclose(by_s, along, atol=1e-6)
    np.testing.assert_allclose(by_w, across, atol=2e-3)


def test_a_corrected_ruling_crosses_the_line_where_it_says():
    development = laid(wavy(), "elastic")
    s = np.linspace(1000.0, 1500.0, 21)
    ends = development.flat(np.array([1000.0, 1500.0]), np.array([0.0, 1.0]))
    a, b = np.repeat(ends[:1], 21, axis=0), np.repeat(ends[1:], 21, axis=0)
    w = development.ruling_crossing(s, a, b)
    gap, along = development.flat(s, w) - a, (b - a) / np.linalg.norm(b[0] - a[0])
    assert np.abs(gap[:, 0] * along[:, 1] - gap[:, 1] * along[:, 0]).max() < 1e-8
    assert w[0] == pytest.approx(0.0, abs=1e-9)
    assert w[-1] == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("mode", ["edges", "energy"])
def test_principal_strains_of_a_ruling_development_are_its_own_and_none(mode):
    development = develop(wavy(), mode=mode)
    s = np.linspace(5.0, 5995.0, 40)
    larger, smaller = principal_strains(development, s, ACROSS)
    own = strain(development, s, ACROSS)
    np.testing.assert_allclose(np.maximum(own, 0.0), larger, atol=1e-9)
    np.testing.assert_allclose(np.minimum(own, 0.0), smaller, atol=1e-9)


@pytest.mark.parametrize("mode", MODES)
def test_the_area_of_a_pattern_is_that_inside_its_outline(plates, mode):
    for mark in ("M1-T1", "M1-T2", "M1-L1"):
        record = develop_plate(plates[mark], mode=mode)
        ring = np.concatenate([run[:-1] for run in record.outline])
        x, y = ring.T
        shoelace = 0.5 * float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())
        # Chords cut off slivers: a third of the sagitta, 0.0005 mm, along the outline.
        assert record.area == pytest.approx(shoelace, abs=0.0005 * 2 * record.length)


def test_modes_trade_edge_length_for_strain(plates):
    records = {mode: develop_plate(plates["M1-T1"], mode=mode) for mode in MODES}
    edges, energy, elastic = (records[mode] for mode in MODES)
    assert edges.strain_max > 1.3 * energy.strain_max > 1.3 * 0.9 * elastic.strain_max
    assert energy.length_error_max > elastic.length_error_max > 10 * edges.length_error_max
    for record in records.values():
        assert record.length_error_max >= record.length_error_bound


@pytest.mark.parametrize("mode", ["edges", "energy"])
def test_a_plate_that_folds_over_itself_is_refused_with_its_place(mode):
    rails = ruled_patches.bent_in_plane(lambda s: 600.0 + 2.0 * s, radius=5000.0, twist=0.0)
    with pytest.raises(BendTorsionError) as caught:
        develop(rails, "M1-T1", mode)
    finding = caught.value.findings[0]
    assert (finding.code, finding.object) == ("plate-folds-over", "M1-T1")
    # The inner edge reaches the centre of curvature at half width 5000: s = 4700.
    assert finding.value <= 0.0
    assert float(finding.position.removeprefix("s = ").removesuffix(" mm")) > 4600.0


def test_area_of_the_plane_taper():
    rails = ruled_patches.plane(800.0, 6000.0)
    for mode in MODES:
        assert flat_area(laid(rails, mode)) == pytest.approx(600.0 * 6000.0, rel=1e-12)


def test_the_document_chooses_mode_and_solved_joints():
    document = FreeCAD.newDocument("modes", hidden=True)
    try:
        sizes = dict(zip("abc", curved_members.HALF_AXES))
        surface = make.make_surface(document, "Hall", **sizes)
        points = curved_members.irregular(curved_members.diagonal)
        axis = make.make_axis(document, "A1", surface, points)
        section = make.make_section(document, "B800", h=800, b=800, t=20)
        member = make.make_member(document, "M1", axis, [section], [{}])
        plates = make.make_plates(document, member, {"top": "auto", "left": [0.5]})
        unfold = make.make_unfold(document, plates)
        document.recompute()
        assert [obj.Status for obj in (plates, unfold)] == ["ok", "ok"]
        # 27 m from sheets of 12 m: two joints on top, one on the left, none elsewhere.
        assert [sum(f"M1-{letter}" in m for m in plates.Marks) for letter in "TBLR"] == [3, 1, 2, 1]
        assert unfold.Mode == "edges"
        assert len(unfold.Forming) == len(unfold.Marks)
        assert set(unfold.Forming) <= {"elastic", "cold"}
        error, strain = unfold.LengthErrorMax, unfold.StrainMax
        unfold.Mode = "energy"
        document.recompute()
        assert unfold.Status == "ok"
        assert unfold.LengthErrorMax > 5 * error and unfold.StrainMax < 0.7 * strain
        unfold.Mode = "edges"
        document.recompute()
        assert (unfold.LengthErrorMax, unfold.StrainMax) == (error, strain)
    finally:
        FreeCAD.closeDocument(document.Name)


def test_the_record_names_how_each_plate_is_formed(plates):
    # 20 mm at radii of 20 to 40 m and little twist: elastic or cold; no plate of it is flat or hot.
    kinds = {develop_plate(plate).forming for plate in plates.values()}
    assert kinds == {"elastic", "cold"}
