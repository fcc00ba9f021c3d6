# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far the model is, told step by step, and the time it still takes."""

import io

import FreeCAD
import pytest
from test_build import APART, schedule

from BendTorsionWB import project
from BendTorsionWB.console import Progress
from BendTorsionWB.document_export import export_document
from BendTorsionWB.model_progress import (
    ASSEMBLED,
    COMPUTED,
    IFC,
    SAVED,
    STEP,
    STEPS,
    ModelProgress,
)

PLAIN = project.Wanted(sheets=False, split=1)


class Told(list):
    """What a progress was told of the model."""

    def __call__(self, what, done, count):
        if what == "model":
            self.append((done, count))


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """Two members in documents of their own: schedule, folder, and what was told of the build."""
    folder, told = tmp_path_factory.mktemp("progress"), Told()
    path = schedule(folder / "two.xlsx", APART)
    project.build(path, folder / "out", workers=1, wanted=PLAIN, progress=told)
    return path, folder / "out", told


def test_the_model_is_told_in_steps_of_each_member(built):
    told = built[-1]
    done = [own for own, _ in told]
    assert {count for _, count in told} == {2 * STEPS}
    assert done == sorted(done) and done[0] == 0 and done[-1] == 2 * STEPS
    # Objects are told one by one, and so is what follows.
    assert {ASSEMBLED, ASSEMBLED + COMPUTED, ASSEMBLED + COMPUTED + STEP} <= set(done)
    assert {STEPS - SAVED - IFC, STEPS - SAVED, STEPS, STEPS + ASSEMBLED} <= set(done)
    assert sum(ASSEMBLED < own <= ASSEMBLED + COMPUTED for own in set(done)) >= COMPUTED / 2


def test_the_documents_that_are_there_are_no_steps(built, tmp_path):
    path, out, _ = built
    told = Told()
    project.build(path, out, workers=1, wanted=PLAIN, progress=told)
    assert told == [(0, 2 * STEPS), (1, 1)]
    (out / "model" / "002.step").unlink()
    told = Told()
    project.build(path, out, workers=1, wanted=PLAIN, progress=told)
    assert told[0] == (0, 2 * STEPS) and told[-1] == (STEPS, STEPS)
    assert {count for _, count in told[1:]} == {STEPS}


def test_what_the_telling_raises_stops_the_computing_of_objects(built, tmp_path):
    class Stop(Exception):
        pass

    told = []

    def stop(what, done, count):
        if what == "model":
            told.append(done)
            if done > ASSEMBLED:
                raise Stop

    with pytest.raises(Stop):
        project.build(built[0], tmp_path / "out", workers=1, wanted=PLAIN, progress=stop)
    assert ASSEMBLED < told[-1] < ASSEMBLED + COMPUTED
    assert not list((tmp_path / "out").rglob("*.FCStd")) and not FreeCAD.listDocuments()


def test_members_in_error_count_as_done():
    told = Told()
    steps = ModelProgress(told, 3)
    with steps.part(2):
        steps.add(ASSEMBLED)
    steps.keep(1)
    steps.finish()
    assert told == [(0, 60), (ASSEMBLED, 60), (2 * STEPS, 60), (2 * STEPS, 2 * STEPS)]


class Terminal(io.StringIO):
    """What is written to a terminal."""

    def isatty(self):
        return True


def test_the_line_shows_the_time_left_from_the_first_step_on(monkeypatch):
    now, terminal = [0.0], Terminal()
    monkeypatch.setattr("sys.stderr", terminal)
    shown = Progress(clock=lambda: now[0])
    steps = ModelProgress(shown, 4)
    now[0] = 0.25
    steps.add(4)
    now[0] = 9.0
    steps.add(68)
    now[0] = 9.5
    steps.finish()
    shown.end()
    lines = [line.rstrip() for line in terminal.getvalue().split("\r") if line.strip()]
    assert lines == ["model 0/80", "model 4/80, 0:05 left", "model 72/80", "model 80/80"]


def test_a_stage_of_four_shows_the_time_left_after_the_first():
    now = [0.0]
    progress = Progress(quiet=True, clock=lambda: now[0])
    now[0] = 0.9
    assert progress.remaining(1, 4) == ", 0:03 left"


class Every(list):
    """All that a progress was told."""

    def __call__(self, *told):
        self.append(told)


def test_what_comes_after_the_members_is_told_too(built, tmp_path):
    """Package and results by member, where a large project waits for minutes; combined DXF by
    file. All are at their end at the end, whether anything is to do or not."""
    path, _, _ = built
    document = tmp_path / "out" / "model.FCStd"
    for again in (
        lambda told: project.build(
            path, tmp_path / "out", workers=1, wanted=project.Wanted(sheets=False), progress=told
        ),
        lambda told: export_document(
            document, tmp_path / "exported", workers=1, sheets=False, progress=told
        ),
    ):
        for first in (True, False):
            told, steps = Every(), {}
            again(told)
            for what, done, count in told:
                steps.setdefault(what, []).append((done, count))
            for what in ("package", "results"):
                done = [own for own, _ in steps[what]]
                assert len({count for _, count in steps[what]}) == 1
                assert done == sorted(done) and done[0] == 0
                assert done[-1] == steps[what][0][1]
                if first:
                    assert len(set(done)) >= 4
            if first:
                assert steps["combined DXF"][-1][0] == steps["combined DXF"][-1][1] >= 1
            order = list(steps)
            assert order.index("package") < order.index("results")


def test_a_stop_in_the_package_leaves_whole_files(built, tmp_path):
    class Stop(Exception):
        pass

    def stop(what, done, count):
        if (what, done) == ("package", 2):
            raise Stop

    path, _, _ = built
    out = tmp_path / "out"
    wanted = project.Wanted(model=False, sheets=False)
    with pytest.raises(Stop):
        project.build(path, out, workers=1, wanted=wanted, progress=stop)
    assert (out / "nesting.csv").exists() and not (out / "report.html").exists()
    assert not list(out.rglob("*.part"))
    project.build(path, out, workers=1, wanted=wanted)
    assert (out / "report.html").exists() and (out / "results.xlsx").exists()
