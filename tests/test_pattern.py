# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pattern of a plate: its frame, outline, lines, folds, points, panels, and placing frame."""

import numpy as np
import pytest
from curved_members import ELLIPSOID, in_space, member, tapered
from geodesic import box_mid_rails, path_length

from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.patterns.pattern import develop_plate
from BendTorsionWB.core.plates.plates import Joints, split_plates
from BendTorsionWB.core.sections.section import box

JOINTS = {face: Joints((0.2, 0.45, 0.8, 1.0)) for face in ("top", "bottom", "left", "right")}
TAPERS = {
    "box1": {},
    "box2 top flush": {"type": "box2", "align": "top", "align_to": "previous"},
}


def plates_of(built):
    return split_plates(built, JOINTS)[0]


@pytest.fixture(scope="module", params=TAPERS)
def pairs(request):
    """Plates of a tapered member with their patterns."""
    return [(p, develop_plate(p)) for p in plates_of(tapered(**TAPERS[request.param]))]


def closed(outline):
    return np.concatenate([run[:-1] for run in outline])


def shoelace(points):
    x, y = points.T
    return 0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)


def test_u_runs_along_the_chord_and_the_corner_is_at_the_origin(pairs):
    for _, pattern in pairs:
        first, last = (line.flat.mean(axis=0) for line in (pattern.lines[0], pattern.lines[-1]))
        chord = last - first
        assert chord[0] > 0 and abs(chord[1]) < 1e-8 * chord[0]
        points = closed(pattern.outline)
        assert np.abs(points.min(axis=0)).max() < 1e-9
        assert points.max(axis=0) == pytest.approx([pattern.length, pattern.width], abs=1e-9)


def test_the_outline_is_closed_counter_clockwise_and_encloses_the_area(pairs):
    for _, pattern in pairs:
        runs = pattern.outline
        for one, two in zip(runs, (*runs[1:], runs[0])):
            assert np.abs(one[-1] - two[0]).max() < 1e-9
        assert shoelace(closed(runs)) == pytest.approx(pattern.area, rel=2e-6)
        assert pattern.area > 0
        # No sides cross: every turn of the polygon adds up to one full turn.
        sides = np.diff(closed(runs), axis=0, append=closed(runs)[:1])
        angle = np.arctan2(sides[:, 1], sides[:, 0])
        turns = (np.diff(angle, append=angle[:1]) + np.pi) % (2 * np.pi) - np.pi
        assert turns.sum() == pytest.approx(2 * np.pi)
        assert np.abs(turns).max() < 2.0


def test_flat_area_is_the_area_of_the_curved_mid_surface_to_the_strain(pairs):
    for plate, pattern in pairs:
        edges = [plate.start, *plate.rails.mid_folds, plate.end]
        area = 0.0
        for a, b in zip(edges, edges[1:]):
            value = plate.rails.mid(np.linspace(a + 1e-9, b - 1e-9, 801)).reshape(-1, 2, 3)
            mid = value.mean(axis=1)
            across = value[:, 1] - value[:, 0]
            steps = np.cross(np.diff(mid, axis=0), 0.5 * (across[1:] + across[:-1]))
            area += np.linalg.norm(steps, axis=1).sum()
        assert pattern.area == pytest.approx(area, rel=max(1e-4, 3 * pattern.strain_max))


def test_seen_from_the_other_face_the_pattern_is_its_mirror_image(pairs):
    for plate, inside in pairs:
        outside = develop_plate(plate, "outside")
        assert outside.marking_face == "outside"
        mirrored = closed(inside.outline) * [1, -1] + [0, inside.width]
        there = closed(outside.outline)
        nearest = np.abs(there[:, None] - mirrored[None]).max(axis=2).min(axis=1)
        assert nearest.max() < 1e-8
        for one, two in zip(inside.lines, outside.lines):
            assert two.flat == pytest.approx(one.flat * [1, -1] + [0, inside.width], abs=1e-8)
        assert shoelace(there) > 0 and outside.area == inside.area


def test_the_view_from_inside_is_the_view_from_inside(pairs):
    """The first edge lies on the side where an eye inside the box sees it, +s to the right."""
    for plate, pattern in pairs:
        s = np.array([0.5 * (plate.start + plate.end)])
        value = plate.rails.mid(s).reshape(2, 3)
        along = plate.rails.mid.derivative(s).reshape(2, 3).mean(axis=0)
        depth = (plate.rails.outer(s) - plate.rails.inner(s)).reshape(2, 3).mean(axis=0)
        up = np.cross(depth, along) * -1  # eye inside looks along depth: right = along, up = r × d
        first_above = (value[0] - value[1]) @ up > 0
        flat_above = pattern.lines[0].flat[0, 1] > pattern.lines[0].flat[1, 1]
        assert first_above == flat_above


def test_lines_and_edges_have_their_true_length(pairs):
    for plate, pattern in pairs:
        for line in pattern.lines:
            assert line.length_flat == pytest.approx(line.length_3d, abs=1e-7)
            assert np.linalg.norm(line.flat[1] - line.flat[0]) == pytest.approx(
                line.length_flat, abs=1e-7
            )
        for panel in pattern.panels:
            if panel.what.startswith("edge"):
                assert panel.flat == pytest.approx(panel.arc, abs=1e-6)
                # The outer face folds up to t/2 · tan of half the fold beside the mid-surface.
                assert panel.chord_outer < panel.arc * 1.001 + 0.12 * plate.thickness
        kinds = {panel.what for panel in pattern.panels}
        assert kinds == {
            f"edge {plate.edges[0]}",
            f"edge {plate.edges[1]}",
            "diagonal 1",
            "diagonal 2",
        }
        assert len(pattern.panels) == 4 * (len(pattern.lines) - 1)


def test_worst_length_error_is_that_of_its_measures_and_near_its_bound(pairs):
    for plate, pattern in pairs:
        errors = [abs(p.flat - p.arc) for p in pattern.panels]
        assert pattern.length_error_max >= max(errors) - 1e-9
        assert pattern.length_error_max <= max(2.5 * pattern.length_error_bound, 1e-6)
        assert pattern.length_error_max <= (0.02 if plate.in_transition else 0.012)
        assert pattern.length_error_rms <= pattern.length_error_max


CONSTANT = box("B", "box2", 800, 800, 20, gap1=2, gap2=3), box("A", "box1", 800, 700, 20, 16, 18)


@pytest.mark.parametrize("section", CONSTANT, ids=lambda s: s.type)
def test_diagonals_agree_with_an_independent_geodesic(section):
    built = member([Segment(section, align="top-left")])
    law = built.law
    gaps = (2.0, 3.0) if section.type == "box2" else (0.0, 0.0)
    thickness = {strip.face: strip.thickness for strip in section.strips}
    worst, relative = 0.0, 0.0
    for plate in plates_of(built):
        rails = box_mid_rails(
            built.frames.axis.position,
            lambda p: ELLIPSOID.closest(p).normals,
            law.cells[0].corners,
            plate.face,
            section.type,
            thickness,
            gaps,
        )
        pattern = develop_plate(plate)
        diagonals = {(p.panel, p.what): p for p in pattern.panels if "diagonal" in p.what}
        lines = pattern.lines
        for one, two in list(zip(lines, lines[1:]))[1:-1:5]:
            for k, (a, b) in enumerate([(0.0, 1.0), (1.0, 0.0)], start=1):
                true = path_length(rails, (one.s, a), (two.s, b))
                found = diagonals[f"{one.label}/{two.label}", f"diagonal {k}"].arc
                worst = max(worst, abs(found - true))
                relative = max(relative, abs(found / true - 1))
    assert worst < 1e-5, worst
    assert relative < 1e-8


def test_the_fold_of_a_transition_turns_by_the_angle_of_its_slope():
    for align, faces in (
        ("centre", {"top": 1, "bottom": 1, "left": 1, "right": 1}),
        ("top", {"top": 0, "bottom": 2, "left": 1, "right": 1}),
    ):
        built = tapered("box2", slope=2.5, align=align, align_to="previous")
        d = built.law.face_steps[0].largest
        for plate in plates_of(built):
            if not plate.folds:
                continue
            folds = {f.s: f.angle for f in develop_plate(plate).folds}
            step = 100.0 * faces[plate.face]
            # The flange sinks towards the axis by `step` over 2.5 d: convex outside at its start.
            expected = np.arctan(step / (2.5 * d))
            assert folds[9000.0] == pytest.approx(expected, abs=0.02 * expected + 1e-6)


def test_a_widening_transition_folds_the_outer_face_concave_first():
    small, big = (box("S", "box2", n, n, 20) for n in (600, 800))
    built = member([Segment(small), Segment(big, 9000.0)])
    for plate in plates_of(built):
        angles = [fold.angle for fold in develop_plate(plate).folds]
        if len(angles) == 2:
            assert angles[0] < -0.3 and angles[1] > 0.3


def test_fold_lines_cross_the_whole_pattern(pairs):
    seen = 0
    for plate, pattern in pairs:
        assert [fold.s for fold in pattern.folds] == list(plate.folds)
        for fold in pattern.folds:
            [line] = [line for line in pattern.lines if line.label == fold.label]
            assert fold.flat == pytest.approx(line.flat, abs=1e-9)
            seen += 1
    assert seen >= 4


def test_points_lie_on_corner_lines_and_on_the_marking_face(pairs):
    for plate, pattern in pairs:
        arris = [p for p in pattern.points if p.kind == "arris"]
        witness = [p for p in pattern.points if p.kind == "witness"]
        assert [p.label for p in arris] == [f"P-{k + 1}" for k in range(2 * len(pattern.lines))]
        assert [p.edge for p in arris] == list(plate.edges) * len(pattern.lines)
        for point, mate in zip(arris, witness, strict=True):
            assert point.line == mate.line and point.edge == mate.edge
            inset = np.linalg.norm(mate.flat - point.flat)
            assert inset == pytest.approx(50.0, abs=0.5)


def test_arris_points_of_a_box2_flange_are_corners_of_the_section():
    built = tapered("box2")
    plate = next(p for p in plates_of(built) if p.face == "top")
    for point in develop_plate(plate).points:
        if point.kind == "arris" and 1.0 < point.s:
            side = 400.0 if point.edge == "left" else -400.0
            by_hand = in_space(built, ELLIPSOID, np.array([point.s]), (side, 400.0))[0]
            assert np.linalg.norm(point.xyz - by_hand) < 1e-4


def test_the_placing_frame_is_that_of_the_three_points_with_z_outward(pairs):
    for plate, pattern in pairs:
        matrix = pattern.placing
        assert matrix[:3, :3] @ matrix[:3, :3].T == pytest.approx(np.eye(3), abs=1e-12)
        assert np.linalg.det(matrix[:3, :3]) == pytest.approx(1.0)
        ends = np.array([plate.start, plate.end])
        outer = plate.rails.outer(ends).reshape(2, 2, 3)
        inner = plate.rails.inner(ends).reshape(2, 2, 3)
        lengths = np.linalg.norm(outer[:, 1] - outer[:, 0], axis=1)
        order = outer[::-1] if lengths[1] < lengths[0] - 0.01 else outer
        local = np.array(
            [
                matrix[:3, :3] @ p + matrix[:3, 3]
                for p in (order[0, 0], order[0, 1], order[1].mean(axis=0))
            ]
        )
        assert local[0] == pytest.approx([0, 0, 0], abs=1e-8)
        assert local[1, 0] > 0 and local[1, 1:] == pytest.approx([0, 0], abs=1e-8)
        assert local[2, 2] == pytest.approx(0, abs=1e-8)
        outward = matrix[2, :3] @ (outer - inner).mean(axis=(0, 1))
        assert outward > 0
        for point in pattern.points:
            assert point.local == pytest.approx(
                matrix[:3, :3] @ point.xyz + matrix[:3, 3], abs=1e-8
            )


def test_the_flat_placing_puts_the_same_three_points_where_the_model_has_them(pairs):
    for _, pattern in pairs:
        matrix = pattern.flat_to_placing
        assert np.linalg.det(matrix[:3, :3]) == pytest.approx(1.0)
        arris = [p for p in pattern.points if p.kind == "arris"]
        first = next(p for p in arris if np.linalg.norm(p.local) < 1e-6)
        flat = {p.label: matrix @ [*p.flat, 0, 1] for p in arris}
        mate = next(p for p in arris if p.line == first.line and p is not first)
        other = [p for p in arris if p.line != first.line and p.line in ("E-1", "E-2")]
        assert flat[first.label][:3] == pytest.approx([0, 0, 0], abs=1e-8)
        assert flat[mate.label][:3] == pytest.approx([mate.local[0], 0, 0], abs=0.5)
        far_flat = np.mean([flat[p.label][:3] for p in other], axis=0)
        far = np.mean([p.local for p in other], axis=0)
        assert far_flat[1] * far[1] > 0
        # Formed and flat differ by the plate's curvature only.
        assert np.linalg.norm(far_flat - far) < 0.02 * np.linalg.norm(far)


def test_mass_is_volume_times_density(pairs):
    for plate, pattern in pairs:
        assert pattern.mass == pytest.approx(plate.volume * 7.85e-6)
        assert pattern.volume == pytest.approx(pattern.area * plate.thickness, rel=0.01)
        assert pattern.thickness in (16.0, 20.0)
