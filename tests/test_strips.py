# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plates of a box against geometry recomputed by hand: corners, thickness, clear widths, mitres."""

import FreeCAD  # noqa: F401
import numpy as np
import pytest
from curved_members import ELLIPSOID, in_space, member, tapered
from test_build import APART, changed, schedule

from BendTorsionWB import project
from BendTorsionWB.core import memo
from BendTorsionWB.core.axes.axis import fit_axis
from BendTorsionWB.core.axes.frames import surface_frames
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.piecewise import Piecewise
from BendTorsionWB.core.geometry.surface import analytic_surface
from BendTorsionWB.core.members.member import Member
from BendTorsionWB.core.members.strips import strip_rails
from BendTorsionWB.core.members.thickness import ThicknessRules
from BendTorsionWB.core.members.volume import section_integrals, skin_volume
from BendTorsionWB.core.members.zones import Segment, section_law
from BendTorsionWB.core.plates.plates import split_plates
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.solids.solid_skins import plate_skin as _plate_skin
from BendTorsionWB.shapes import brep

FOLDED = {
    "box1": {},
    "box2": {"type": "box2"},
    "box1 top flush": {"align": "top", "align_to": "previous"},
    "box2 left-bottom flush": {
        "type": "box2",
        "align": "bottom-left",
        "align_to": "previous",
        "slope": 4.0,
    },
    "box1 shallow": {"slope": 6.0, "offset_y": 30.0},
}


def abrupt(*args, **given):
    """Tapered, all faces changing their thickness at the fold and without chamfers."""
    return tapered(*args, **given, rules=ThicknessRules(chamfer_slope=0.0), stagger="none")


def strips_of(built, start=3000.0, end=None):
    """Rails of all four strips from `start` to the thickness joint (or `end`)."""
    end = end or built.law.joints_of(0)[0]
    return [strip_rails(built, k, start, end) for k in range(4)]


def outer_point(built, cell, strip, s, w):
    """Points (n, 3) of a cell's outer face, ruled between its corners, also beyond its ends."""
    own = built.law.strips[strip]
    rate = (s - cell.start)[:, None, None] * cell.corner_rates
    ends = (cell.corners + rate)[:, [own.first, own.second]]
    return in_space(built, ELLIPSOID, s, ends[:, 0] + w[:, None] * (ends[:, 1] - ends[:, 0]))


def foot_on(face, points, s, w):
    """Distance (n,) of points to the surface face(s, w) and the feet s, w, by Gauss-Newton."""
    s, w = s.copy(), w.copy()
    for _ in range(6):
        gap = face(s, w) - points
        along = face(s + 0.5, w) - face(s - 0.5, w)
        across = (face(s, w + 1e-3) - face(s, w - 1e-3)) / 2e-3
        jacobian = np.stack([along, across], axis=2)
        step = np.linalg.solve(
            jacobian.transpose(0, 2, 1) @ jacobian,
            jacobian.transpose(0, 2, 1) @ gap[:, :, None],
        )[:, :, 0]
        s, w = s - step[:, 0], w - step[:, 1]
    return np.linalg.norm(face(s, w) - points, axis=1), s, w


def cells_between(built, start, end):
    return [c for c in built.law.cells if c.start < end and c.end > start]


def test_the_corners_of_the_skin_are_frame_plus_half_height_and_breadth():
    built = abrupt(align="top-left", align_to="previous", cut=9000.0)
    s = np.linspace(1.0, built.length - 1, 400)
    corners = built.corners(0.0, built.length)(s).reshape(-1, 4, 3)
    # 800 before the cut, 600 beyond the transition of 2.5 · 200, straight between.
    share = np.clip((s - 9000.0) / 500.0, 0, 1)
    for k, (y, z, y_end, z_end) in enumerate(
        [
            (400, 400, 400, 400),
            (-400, 400, -200, 400),
            (-400, -400, -200, -200),
            (400, -400, 400, -200),
        ]
    ):
        plane = np.column_stack([y + share * (y_end - y), z + share * (z_end - z)])
        by_hand = in_space(built, ELLIPSOID, s, plane)
        assert np.linalg.norm(corners[:, k] - by_hand, axis=1).max() < 1e-4


def test_corners_at_the_folds_are_exact():
    built = abrupt(align="top", align_to="previous")
    folds = np.array(built.law.folds)
    for side in ("earlier", "later"):
        corners = built.corners(0.0, built.length)(folds, side).reshape(-1, 4, 3)
        for i, cell in enumerate(built.law.cells[1:3]):
            for k, plane in enumerate(cell.corners):
                by_hand = in_space(built, ELLIPSOID, folds[i : i + 1], plane)
                assert np.linalg.norm(corners[i, k] - by_hand) < 1e-3


@pytest.mark.parametrize("case", FOLDED)
def test_thickness_is_normal_to_the_plate_everywhere(case):
    built = abrupt(**FOLDED[case])
    start, end = 3000.0, built.law.joints_of(0)[0]
    cells = cells_between(built, start, end)
    for strip, rails in enumerate(strips_of(built)):
        edges = [start, *rails.inner_folds, end]
        for cell, a, b in zip(cells, edges[:-1], edges[1:], strict=True):
            s = np.repeat(np.linspace(a + 1e-6, b - 1e-6, 60), 5)
            w = np.tile(np.linspace(0, 1, 5), 60)
            value = rails.inner(s)
            points = value[:, :3] + w[:, None] * (value[:, 3:] - value[:, :3])
            thickness, _, _ = foot_on(
                lambda s, w, c=cell, k=strip: outer_point(built, c, k, s, w), points, s, w
            )
            # The ruled inner face between the two mitred rails is true to 0.01 in the middle too.
            assert np.abs(thickness - 20.0).max() < 0.01, (case, built.law.strips[strip].face)


@pytest.mark.parametrize("case", FOLDED)
def test_the_mid_surface_is_half_way(case):
    built = abrupt(**FOLDED[case])
    start, end = 3000.0, built.law.joints_of(0)[0]
    for strip, rails in enumerate(strips_of(built)):
        edges = [start, *rails.mid_folds, end]
        for cell, a, b in zip(cells_between(built, start, end), edges[:-1], edges[1:]):
            s = np.linspace(a + 1e-6, b - 1e-6, 60)
            for half in (slice(0, 3), slice(3, 6)):
                depth, _, _ = foot_on(
                    lambda s, w, c=cell, k=strip: outer_point(built, c, k, s, w),
                    rails.mid(s)[:, half],
                    s,
                    np.full(60, 0.0 if half.start == 0 else 1.0),
                )
                assert np.abs(depth - 10.0).max() < 0.01


@pytest.mark.parametrize("case", FOLDED)
def test_rails_are_continuous_and_without_overshoot_at_the_folds(case):
    built = abrupt(**FOLDED[case])
    for rails in strips_of(built):
        for level, folds in (
            (rails.outer, rails.boundaries),
            (rails.mid, rails.mid_folds),
            (rails.inner, rails.inner_folds),
        ):
            folds = np.array(folds)
            jump = level(folds, "earlier") - level(folds, "later")
            assert np.abs(jump).max() < 1e-9
            # Monotone along the axis right up to the fold: no rail runs back on itself.
            s = np.linspace(folds[0] - 60, folds[0] + 60, 241)
            x = built.frames.at(s).x
            for half in (slice(0, 3), slice(3, 6)):
                forward = (level.derivative(s)[:, half] * x).sum(axis=1)
                assert forward.min() > 0.5


def clear_width(built, plate, edge, neighbour, s):
    """Signed distance (2, n) of the outer and inner rail of a plate's edge from the inner face of
    its neighbour, folded as it is; negative where they overlap."""
    [fold] = neighbour.inner_folds
    k = int(np.searchsorted(neighbour.inner.breaks, fold))
    pieces = [
        Piecewise(neighbour.inner.breaks[: k + 1], neighbour.inner.values[:k]),
        Piecewise(neighbour.inner.breaks[k:], neighbour.inner.values[k:]),
    ]
    origin = built.frames.at(s).origin
    half = slice(0, 3) if edge == 0 else slice(3, 6)
    widths = []
    for level in (plate.outer, plate.inner):
        points, nearest = level(s)[:, half], np.full(len(s), np.inf)
        for piece, side in zip(pieces, (-1, 1)):

            def face(place, w, piece=piece):
                value = piece(place)
                return value[:, :3] + w[:, None] * (value[:, 3:] - value[:, :3])

            near = np.flatnonzero(side * (s - fold) > -25.0)
            middle = np.full(len(near), 0.5)
            distance, foot, w = foot_on(face, points[near], s[near], middle)
            out = origin[near] - face(foot, middle)
            sign = np.sign(((points[near] - face(foot, w)) * out).sum(axis=1))
            own = side * (foot - fold) > -1e-3
            nearest[near] = np.where(own, np.minimum(nearest[near], sign * distance), nearest[near])
        widths.append(nearest)
    return np.array(widths)


@pytest.mark.parametrize("gap", [0.0, 3.0])
@pytest.mark.parametrize(
    "type, faces, neighbours",
    [
        ("box1", ("top", "bottom"), ("left", "right")),
        ("box2", ("left", "right"), ("top", "bottom")),
    ],
)
def test_root_gaps_are_kept_in_constant_zones_and_never_undercut_at_folds(
    type, faces, neighbours, gap
):
    built = abrupt(type, gap=gap)
    names = [strip.face for strip in built.law.strips]
    end = built.law.joints_of(0)[0]
    rails = strips_of(built)
    far = np.linspace(3001.0, 9000.0 - 510.0, 50)
    near = np.linspace(9000.0 - 490.0, end - 3.0, 400)
    # In the transition both plates tilt at 1 : 2.5: the true gap is that of the section plane,
    # times the cosine.
    least = np.where(near < 9000.0 - 6.0, 1.0, np.cos(np.arctan(1 / 2.5)))
    for face in faces:
        for edge, neighbour in enumerate(neighbours):
            wanted = gap + edge
            own, other = rails[names.index(face)], rails[names.index(neighbour)]
            kept = clear_width(built, own, edge, other, far)
            assert np.abs(kept - wanted).max() < 1e-3
            folded = clear_width(built, own, edge, other, near)
            assert (folded - wanted * least).min() > -0.02
            assert folded[np.isfinite(folded)].max() < wanted + 2.5


def test_box2_flanges_run_over_the_whole_breadth():
    built = abrupt("box2")
    s = np.linspace(3000.0, 8400.0, 50)
    rails = strips_of(built)[0]
    width = np.linalg.norm(rails.outer(s)[:, 3:] - rails.outer(s)[:, :3], axis=1)
    assert width == pytest.approx(800.0, abs=1e-8)
    web = strips_of(built)[2]
    height = np.linalg.norm(web.outer(s)[:, 3:] - web.outer(s)[:, :3], axis=1)
    assert height == pytest.approx(800 - 40 - 3 - 4, abs=1e-3)


def test_box1_flanges_fit_between_the_webs():
    built = abrupt("box1")
    s = np.linspace(3000.0, 8400.0, 50)
    top, _, left, _ = strips_of(built)
    width = np.linalg.norm(top.outer(s)[:, 3:] - top.outer(s)[:, :3], axis=1)
    # The webs' insets grow by what the twist tilts them.
    assert width == pytest.approx(800 - 40 - 3 - 4, abs=1e-3)
    height = np.linalg.norm(left.outer(s)[:, 3:] - left.outer(s)[:, :3], axis=1)
    assert height == pytest.approx(800.0, abs=1e-8)


@pytest.mark.parametrize("type", ["box1", "box2"])
def test_solids_of_neighbouring_plates_share_nothing(type):
    built = abrupt(type, gap=0.05, align="top", align_to="previous")
    plates, _ = split_plates(built, {})
    solids = {p.face: solid_of(p) for p in plates if p.start == 0.0}
    # gap1 on the left and at the top, gap2 a millimetre more on the other sides.
    for one, other, gap in (("top", "left", 0.05), ("bottom", "right", 1.05)):
        assert solids[one].common(solids[other]).Volume == 0.0
        assert 0.9 * gap < solids[one].distToShape(solids[other])[0] < gap + 0.01


def solid_of(plate):
    return brep.tube_solid([(p.knots, p.poles) for p in _plate_skin(plate)])


@pytest.mark.parametrize("case", FOLDED)
def test_volumes_of_strips_agree_with_the_skins_and_with_the_kernel(case):
    built = abrupt(**FOLDED[case])
    plates, _ = split_plates(built, {})
    for plate in plates:
        by_section = section_integrals(built, [plate.rails])[0, 0]
        assert plate.volume == pytest.approx(by_section, rel=1e-6)
        assert skin_volume(_plate_skin(plate)) == pytest.approx(plate.volume, rel=1e-6)
        solid = solid_of(plate)
        assert solid.isValid() and solid.isClosed()
        # The kernel's own quadrature is no better on folded plates.
        assert solid.Volume == pytest.approx(plate.volume, rel=5e-5)


def test_volume_of_a_straight_box_is_area_times_length():
    flat = member(
        [Segment(box("S", "box1", 500, 400, 20, 16, 12))], curve=straight, surface=PLANE, points=5
    )
    plates, _ = split_plates(flat, {})
    by_face = {p.face: p.volume for p in plates}
    clear = 400 - 2 * 12
    assert by_face == pytest.approx(
        {
            "top": clear * 20 * 6000,
            "bottom": clear * 16 * 6000,
            "left": 500 * 12 * 6000,
            "right": 500 * 12 * 6000,
        }
    )


def test_pappus_holds_on_a_bent_straight_box():
    """A square box round a circle of a cylinder: volume is area times the path of the centroid."""
    radius = 12000.0
    ring = member(
        [Segment(box("S", "box2", 600, 600, 20), align="top")],
        curve=lambda t: circle(radius, t),
        surface=CYLINDER,
        points=41,
    )
    plates, _ = split_plates(ring, {})
    angle = ring.length / radius
    for plate in plates:
        middle = {"top": 10.0, "bottom": 590.0}.get(plate.face, 300.0)
        area = 600 * 20 if plate.face in ("top", "bottom") else 560 * 20
        expected = area * angle * (radius - middle)
        assert plate.volume == pytest.approx(expected, rel=1e-6)
        total = section_integrals(ring, [plate.rails])[0, 1]
        assert total == pytest.approx(area * ring.length, rel=1e-9)


def test_a_bend_sharper_than_the_section_is_refused():
    small = analytic_surface("cylinder", {"r": 700.0})
    bent = member(
        [Segment(box("S", "box1", 800, 800, 20), align="top")],
        curve=lambda t: circle(700.0, t),
        surface=small,
        points=21,
    )
    with pytest.raises(BendTorsionError) as caught:
        bent.check_bend()
    [finding] = caught.value.findings
    assert finding.code == "bend-sharper-than-section" and "s = " in finding.position


def test_a_bend_far_shorter_than_its_cell_is_refused():
    """A kink of 300 mm radius in 40 m, between places evenly spaced by 600 mm."""
    plane = analytic_surface("plane", {})
    angle = np.linspace(-0.4, 0.4, 9)
    arc = 300.0 * np.column_stack([np.sin(angle), 1.0 - np.cos(angle)])
    leg = np.linspace(20000.0, 150.0, 40)[:, None] * [np.cos(0.4), np.sin(0.4)]
    legs = arc[0] + leg * [-1.0, 1.0], arc[-1] + 1.03 * leg[::-1]
    flat = np.concatenate([legs[0], arc, legs[1]])
    axis = fit_axis("A", np.column_stack([flat, 0.0 * flat[:, 0]]), plane)
    law = section_law("M", [Segment(box("S", "box1", 800, 800, 20))], axis.length)
    kinked = Member("M", surface_frames(axis, plane), law)
    even = kinked.frames.at(np.linspace(0.0, axis.length, 65))
    assert np.hypot(even.ky, even.kz).max() < 1.0 / 400.0
    with pytest.raises(BendTorsionError) as caught:
        kinked.check_bend()
    [finding] = caught.value.findings
    assert finding.code == "bend-sharper-than-section" and finding.value < 0.0


def straight(t):
    return np.column_stack([6000.0 * np.asarray(t), 0 * np.asarray(t), 0 * np.asarray(t)])


def circle(radius, t):
    angle = 0.6 * np.asarray(t)
    return radius * np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])


PLANE = analytic_surface("plane", {})
CYLINDER = analytic_surface("cylinder", {"r": 12000.0})


@pytest.mark.parametrize(
    "row, values", [(3, (520, 500, 12)), (3, (500, 500, 14)), (2, (600, 620, 16))]
)
def test_rails_that_were_kept_are_those_of_this_member(tmp_path, row, values):
    """Each section of a member alone changed, the one it ends with too."""
    given, jobs = project.read_jobs(schedule(tmp_path / "a.xlsx", APART))
    cells = {("Sections", row, column): value for column, value in zip(("h", "b", "t"), values)}
    other, changed_jobs = project.read_jobs(changed(tmp_path / "b.xlsx", APART, cells))
    memo.forget_all()
    fresh = rails_of(project.compute(other, changed_jobs)["M1"])
    memo.forget_all()
    before = rails_of(project.compute(given, jobs)["M1"])
    after = rails_of(project.compute(other, changed_jobs)["M1"])
    assert len(fresh) >= 8 and after == fresh
    assert sum(one != was for one, was in zip(after, before)) >= 4


def rails_of(detailed):
    """What tells the rails of each plate of a member from any others."""
    return [memo.content_hash(one.plate.rails) for one in detailed.plates.plates]
