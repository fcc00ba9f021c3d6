# SPDX-License-Identifier: LGPL-2.1-or-later
"""Net and gross: allowances lengthen what is cut, and nothing else."""

import io
from dataclasses import replace

import ezdxf
import numpy as np
import pytest
from curved_members import member, tapered
from flat_plates import rectangle

from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.joints.lanes import Lanes
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.patterns.gross import (
    Allowances,
    as_cut,
    gross_pattern,
    polygon_area,
    with_gross,
)
from BendTorsionWB.core.patterns.laid_flat import PatternInput, laid_flat
from BendTorsionWB.core.plates.plates import Joints, split_plates
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.exchange.dxf import plate_dxf
from BendTorsionWB.exchange.nc1 import plate_nc1


@pytest.fixture(scope="module")
def taper():
    return tapered()


@pytest.fixture(scope="module")
def plates(taper):
    return split_plates(taper, {"top": Joints((0.3, 0.7)), "right": Joints((0.5,))})[0]


@pytest.fixture(scope="module")
def net(taper, plates):
    return laid_flat(taper, plates)


def allowed(taper, plates, **allowances):
    return laid_flat(taper, plates, PatternInput(allowances=Allowances(**allowances)))


def test_without_allowances_gross_is_net_and_files_are_the_same(net):
    assert all(plate.gross is None for plate in net)
    assert all(as_cut(plate) is plate for plate in net)


def test_a_rectangle_by_hand():
    plate = rectangle(length=2400.0, width=800.0)
    gross = gross_pattern(plate, 1.001, 1.0005, 30.0, 20.0)
    assert gross.length == pytest.approx(2400.0 * 1.001 + 50.0)
    assert gross.width == pytest.approx(800.4)
    assert gross.area == pytest.approx(plate.area / (2400 * 800) * gross.length * gross.width)
    assert gross.mass / plate.mass == pytest.approx(gross.area / plate.area)
    np.testing.assert_allclose(gross.map(np.zeros(2)), [30.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(gross.map(np.array([2400.0, 800.0])), [2432.4, 800.4], atol=1e-9)


def test_shrinkage_stretches_lengths_along_and_across(taper, plates, net):
    made = allowed(taper, plates, shrinkage_along=0.8, shrinkage_across=0.5)
    for plate, before in zip(made, net, strict=True):
        assert plate.length_error_max == before.length_error_max
        assert plate.gross.length == pytest.approx(1.0008 * before.length)
        assert plate.gross.width == pytest.approx(1.0005 * before.width)
        cut = as_cut(plate)
        corners = np.concatenate(cut.outline)
        assert corners.min(axis=0) == pytest.approx([0.0, 0.0], abs=1e-9)
        assert polygon_area(corners) == pytest.approx(cut.area, rel=2e-6)
        # Shrunk again, every line, point and mark is at its net place.
        for after, own in zip(cut.points, before.points, strict=True):
            np.testing.assert_allclose(after.flat / [1.0008, 1.0005], own.flat, atol=1e-9)
        for after, own in zip(cut.lines, before.lines, strict=True):
            np.testing.assert_allclose(after.flat / [1.0008, 1.0005], own.flat, atol=1e-9)
        rolls = cut.forming_data.roll_lines, before.forming_data.roll_lines
        for after, own in zip(*rolls, strict=True):
            np.testing.assert_allclose(after.flat / [1.0008, 1.0005], own.flat, atol=1e-9)


def test_joints_spliced_flat_lengthen_the_ends_that_meet(taper, plates, net):
    made = allowed(taper, plates, joint=2.0, splice="before forming")
    tops = [p for p in made if p.face == "top"]
    assert len(tops) == 4  # two given joints and the change of thickness
    ends = [(p.gross.green_start, p.gross.green_end) for p in tops]
    assert ends == [(0.0, 1.0), (1.0, 1.0), (1.0, 1.0), (1.0, 0.0)]
    assert all(p.gross.scale_u == p.gross.scale_v == 1.0 for p in tops)
    before = {p.mark: p for p in net}
    for plate in tops:
        added = plate.gross.green_start + plate.gross.green_end
        assert plate.gross.length == pytest.approx(before[plate.mark].length + added, abs=0.01)
        ends = plate.lines[0].length_flat, plate.lines[-1].length_flat
        added = plate.gross.green_start * ends[0] + plate.gross.green_end * ends[1]
        assert plate.gross.area - plate.area == pytest.approx(added, rel=1e-3)


def test_joints_spliced_in_the_box_are_spread_over_the_plate(taper, plates, net):
    made = allowed(taper, plates, joint=2.0, diaphragm=0.3, splice="after forming")
    before = {p.mark: p for p in net}
    for plate in made:
        joints = (plate.s_start > 0.0) + (plate.s_end < taper.length - 1e-6)
        assert plate.gross.length - before[plate.mark].length == pytest.approx(1.0 * joints)
        assert (plate.gross.green_start, plate.gross.green_end) == (0.0, 0.0)


def test_each_diaphragm_within_a_plate_counts(net):
    made = with_gross(net, Allowances(diaphragm=0.3), diaphragms=(1000.0, 2500.0, 1e6))
    first = next(p for p in made if p.mark == "M1-T1")
    assert first.gross.length - first.length == pytest.approx(0.6)
    assert next(p for p in made if p.mark == "M1-T4").gross is None


def test_a_ring_has_joints_at_both_ends(net):
    made = with_gross(net, Allowances(joint=2.0, splice="before forming"), closed=True)
    first = next(p for p in made if p.mark == "M1-T1")
    assert (first.gross.green_start, first.gross.green_end) == (1.0, 1.0)


def test_seams_between_lanes_shrink_across(taper):
    plates, _ = split_plates(taper, {}, lanes={"bottom": Lanes((0.3, 0.6))})
    made = [p for p in allowed(taper, plates, joint=2.0) if p.mark in ("M1-B1a", "M1-B1b")]
    for plate, wanted in zip(made, (1.0, 2.0), strict=True):
        net, cut = (
            np.array([np.linalg.norm(np.diff(ends, axis=0)) for ends in lines])
            for lines in (
                [line.flat for line in plate.lines],
                [plate.gross.map(line.flat) for line in plate.lines],
            )
        )
        # On the mean of the lines; those of a strip with a bow are not all square to its pattern.
        assert (cut - net).mean() == pytest.approx(wanted, rel=0.01)


def test_green_runs_on_along_the_edges(taper, plates, net):
    made = allowed(taper, plates, green_start=60.0, green_end=25.0)
    by_mark = {p.mark: p for p in made}
    assert by_mark["M1-T2"].gross is None
    first, last = by_mark["M1-T1"], by_mark["M1-T4"]
    assert (first.gross.green_start, first.gross.green_end) == (60.0, 0.0)
    assert (last.gross.green_start, last.gross.green_end) == (0.0, 25.0)
    cut = as_cut(first)
    # The end line stays on the plate, square 60 mm inside the contour.
    middle = cut.lines[0].flat.mean(axis=0)
    assert min(distance(middle, run) for run in cut.outline) == pytest.approx(60.0, abs=0.01)
    assert "E-1" in texts(first) and "E-2" not in texts(first)
    plain = next(p for p in net if p.mark == "M1-T1")
    assert "E-1" not in texts(plain)
    assert plate_nc1(first).count(b"\r\nPU") == plate_nc1(plain).count(b"\r\nPU") + 1


def distance(point, run):
    """Least distance of a point from the chords of a run."""
    along = np.diff(run, axis=0)
    part = ((point - run[:-1]) * along).sum(axis=1) / (along * along).sum(axis=1)
    nearest = run[:-1] + part.clip(0.0, 1.0)[:, None] * along
    return np.hypot(*(point - nearest).T).min()


def texts(plate):
    document = ezdxf.read(io.StringIO(plate_dxf(plate).decode()))
    return {t.dxf.text for t in document.modelspace().query("TEXT")}


def test_cut_files_are_gross(taper, plates):
    plate = allowed(taper, plates, shrinkage_along=1.0, green_start=40.0)[0]
    document = ezdxf.read(io.StringIO(plate_dxf(plate).decode()))
    (contour,) = document.modelspace().query('LWPOLYLINE[layer=="CUT_OUTER"]')
    across = np.array(contour.get_points("xy"))
    assert np.ptp(across[:, 0]) == pytest.approx(plate.gross.length, abs=0.05)
    header = plate_nc1(plate).decode().split("\r\n")[9]
    assert float(header) == pytest.approx(plate.gross.length, abs=0.01)


def test_holes_keep_their_size_and_move():
    from BendTorsionWB.core.lofting import FlatHole

    turn = np.linspace(0.0, 2.0 * np.pi, 65)
    run = np.array([1200.0, 400.0]) + 60.0 * np.column_stack([np.cos(turn), np.sin(turn)])
    area = np.pi * 3600.0
    hole = FlatHole("O-1", "d=120", (run,), (1200.0, 400.0, 120.0), area)
    plate = rectangle(length=2400.0, width=800.0)
    plate = replace(plate, holes=(hole,), area=plate.area - area)
    plate = replace(plate, gross=gross_pattern(plate, 1.001, 1.0))
    (moved,) = as_cut(plate).holes
    assert moved.circle == pytest.approx((1201.2, 400.0, 120.0))
    np.testing.assert_allclose(moved.runs[0] - run, np.tile([1.2, 0.0], (65, 1)), atol=1e-9)
    assert plate.gross.area == pytest.approx((plate.area + area) * 1.001 - area)


@pytest.mark.parametrize(
    ("changed", "position"),
    [
        ({"shrinkage_along": -0.1}, "shrinkage_along"),
        ({"shrinkage_across": 21.0}, "shrinkage_across"),
        ({"joint": float("nan")}, "joint"),
        ({"green_end": 5000.0}, "green_end"),
        ({"splice": "later"}, "splice"),
    ],
)
def test_allowances_out_of_range_are_refused(taper, plates, changed, position):
    with pytest.raises(BendTorsionError) as caught:
        allowed(taper, plates, **changed)
    (finding,) = caught.value.findings
    assert (finding.code, finding.object, finding.position) == ("allowance", "M1", position)
    assert finding.mend


def test_mirrored_patterns_are_lengthened_the_same():
    straight = member([Segment(box("B", "box1", 800, 600, 20))])
    plates, _ = split_plates(straight, {})
    sizes = []
    for face in ("inside", "outside"):
        given = PatternInput(marking_face=face, allowances=Allowances(green_start=30, green_end=50))
        made = laid_flat(straight, plates, given)
        assert all(polygon_area(np.concatenate(p.gross.outline)) > 0.0 for p in made)
        sizes.append([(p.gross.length, p.gross.width, p.gross.area) for p in made])
    np.testing.assert_allclose(*sizes, rtol=1e-9)
