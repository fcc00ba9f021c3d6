# SPDX-License-Identifier: LGPL-2.1-or-later
"""The arrows of the pipeline: computed once per content, the same in every process, and reported
figures recomputed."""

import dataclasses
import pickle
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from curved_members import ELLIPSOID, HALF_AXES, diagonal, irregular

from BendTorsionWB.core import detailing, memo
from BendTorsionWB.core.axes.frames import FrameInput
from BendTorsionWB.core.axes.frames_law import GivenDirection
from BendTorsionWB.core.detailing import AxisInput, MemberInput, MemberJob, PlatesInput
from BendTorsionWB.core.finding import BendTorsionError, Finding
from BendTorsionWB.core.geometry.surface import Plane, analytic_surface
from BendTorsionWB.core.lofting import failed_record
from BendTorsionWB.core.members.zones import Segment
from BendTorsionWB.core.plates.plates import Joints
from BendTorsionWB.core.sections.section import Material, box

ROOT = Path(__file__).resolve().parent.parent


def job(h=800.0, seed=0, name="M1", **member):
    big, small = box("B", "box1", h, 800, 20), box("S", "box1", 600, 600, 16)
    segments = (Segment(big), Segment(small, 9000.0, 4.0))
    return MemberJob(
        ELLIPSOID,
        AxisInput("A1", irregular(diagonal, 9, seed)),
        MemberInput(name, segments, **member),
        PlatesInput({"top": Joints((0.3, 0.7, 1.0))}),
    )


@pytest.fixture(autouse=True)
def empty_memo():
    memo.forget_all()
    yield
    memo.forget_all()


@pytest.fixture
def calls(monkeypatch):
    """Names of the steps run, in order."""
    seen = []
    for name in ("fit_axis", "section_law", "split_plates", "laid_flat", "torsion_error"):
        real = getattr(detailing, name, None)
        if real is not None:

            def spy(*args, _name=name, _real=real, **more):
                seen.append(_name)
                return _real(*args, **more)

            monkeypatch.setattr(detailing, name, spy)
    return seen


def test_the_same_content_is_computed_once(calls):
    first = detailing.detail(job())
    count = len(calls)
    assert count >= 4
    again = detailing.detail(job())
    assert len(calls) == count
    assert again.record is first.record and again.plates is first.plates


def test_an_edit_repeats_only_what_depends_on_it(calls):
    detailing.detail(job())
    calls.clear()
    detailing.detail(job(h=780.0))
    assert "split_plates" in calls and "laid_flat" in calls and "fit_axis" not in calls
    calls.clear()
    detailing.detail(job())
    assert calls == []


def test_results_of_other_processes_are_taken_over(calls):
    with ProcessPoolExecutor(1) as pool:
        found = pool.submit(detailing.detail, job()).result()
    detailing.adopt(found)
    calls.clear()
    mine = detailing.detail(job())
    assert calls == []
    assert mine.record.mass == found.record.mass
    assert pickle.loads(pickle.dumps(found)).record.length == found.record.length


def test_content_hashes_are_the_same_in_every_process():
    program = (
        "import sys; sys.path[:0] = sys.argv[1:]\n"
        "from test_detailing import job\n"
        "from BendTorsionWB.core.memo import content_hash\n"
        "print(content_hash(job()))"
    )
    found = {
        subprocess.run(
            [sys.executable, "-c", program, str(ROOT), str(ROOT / "tests")],
            capture_output=True,
            encoding="utf-8",
            check=True,
            env={"PYTHONHASHSEED": seed},
        ).stdout.strip()
        for seed in ("1", "2")
    }
    assert found == {memo.content_hash(job())}


@pytest.mark.parametrize(
    "one, two",
    [
        (1, 1.0),
        (1, True),
        ("1", 1),
        (None, "None"),
        ((), []),
        (np.zeros(2), np.zeros((2, 1))),
        (0.0, -0.0),
        ((1, (2, 3)), (1, 2, 3)),
        ({"a": 1}, {"a": 2}),
        (("ab", "c"), ("a", "bc")),
        (np.zeros(2), np.zeros(2, np.float32)),
    ],
)
def test_different_content_has_different_hashes(one, two):
    if isinstance(one, tuple) and one == () and two == []:
        # Order and length are content; the kind of sequence is not.
        assert memo.content_hash(one) == memo.content_hash(two)
    else:
        assert memo.content_hash(one) != memo.content_hash(two)


def test_what_has_no_content_is_no_key():
    with pytest.raises(TypeError, match="object"):
        memo.content_hash(object())


def test_old_results_make_room(monkeypatch):
    monkeypatch.setattr(memo, "KEPT", 3)
    seen = []

    class Value:
        pass

    @memo.memoised
    def arrow(x):
        seen.append(x)
        return Value()

    for x in (1, 2, 3, 1, 4, 1, 2):
        arrow(x)
    assert seen == [1, 2, 3, 4, 2]


def test_a_refusal_is_not_remembered_as_a_result():
    bad = dataclasses.replace(job(), axis=AxisInput("A1", np.zeros((1, 3))))
    for _ in range(2):
        with pytest.raises(BendTorsionError):
            detailing.detail(bad)
    assert detailing.detail(job()).record.plates


def test_the_figures_of_a_record_are_within_the_limits():
    record = detailing.detail(job()).record
    assert record.axis_to_surface_rms <= 0.003
    assert np.degrees(record.torsion_error_max) <= 0.001
    for plate in record.plates:
        assert plate.length_error_max <= (0.02 if plate.in_transition else 0.012)
    assert record.mass == pytest.approx(sum(p.mass for p in record.plates))
    assert [p.mark for p in record.plates if p.face == "top"] == [f"M1-T{k}" for k in (1, 2, 3, 4)]


def test_the_torsion_error_sees_an_error():
    """Against a surface turned by a known angle the reported error is that angle."""
    found = detailing.detail(job())
    assert np.degrees(detailing.torsion_error(found.geometry)) < 0.001
    turned = dataclasses.replace(found.geometry.frame, roll=np.radians(0.25))
    off = dataclasses.replace(found.geometry, frame=turned)
    assert np.degrees(detailing.torsion_error(off)) == pytest.approx(0.25, abs=0.002)


def test_roll_is_wanted_and_no_error():
    rolled = detailing.detail(job(roll=0.2)).record
    assert np.degrees(rolled.torsion_error_max) <= 0.001


def test_a_failed_member_has_no_plates_and_says_why():
    finding = Finding("error", "cut-order", "M1")
    record = failed_record("M1", (finding,))
    assert record.plates == () and record.findings == (finding,) and record.mass is None
    assert failed_record("M1", ()).findings[0].severity == "error"


def test_equal_surfaces_are_equal_content():
    other = analytic_surface("ellipsoid", dict(zip("abc", HALF_AXES)))
    assert memo.content_hash(other) == memo.content_hash(ELLIPSOID)
    third = analytic_surface("ellipsoid", {**dict(zip("abc", HALF_AXES)), "a": 40001.0})
    assert memo.content_hash(third) != memo.content_hash(ELLIPSOID)


@pytest.mark.parametrize("modulus", [70000.0, 206000.0, 210000.0])
def test_the_stress_locked_in_and_its_limit_are_of_the_grade_of_the_plate(modulus):
    """Both are strains times the modulus of its own grade."""
    grade = Material("made", 7.85e-6, modulus, 355.0)
    twist = (GivenDirection(0.0, 0.0), GivenDirection(6000.0, 0.6))
    given = MemberInput(
        "M1",
        (Segment(box("B", "box1", 800, 600, 20, material=grade)),),
        frame=FrameInput("fixed", twist=twist),
    )
    axis = AxisInput("A1", np.array([(0.0, 0.0, 0.0), (6000.0, 0.0, 0.0)]))
    record = detailing.detail(MemberJob(Plane(), axis, given, PlatesInput())).record
    plates = {plate.mark: plate for plate in record.plates}
    found = [f for f in record.findings if f.code == "locked-in-stress"]
    assert found
    for finding in found:
        strain = plates[finding.object].strain_max
        assert finding.value == pytest.approx(modulus * strain, rel=1e-9)
        assert finding.limit == pytest.approx(modulus * 0.037**2 / 8.0, rel=1e-9)
        assert finding.value > finding.limit
