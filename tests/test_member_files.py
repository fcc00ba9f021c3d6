# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of members that workers make: those of one plate together, each with its own outcome."""

import os
import unicodedata
from concurrent.futures import Future

import pytest
from flat_plates import member as record_of
from flat_plates import rectangle

from BendTorsionWB import member_files as member_files_module
from BendTorsionWB.core.drawings.sheet_style import PLAIN_STYLE
from BendTorsionWB.core.finding import BendTorsionError, error
from BendTorsionWB.core.parallel import Workers
from BendTorsionWB.core.patterns import cut_contour
from BendTorsionWB.exchange.whole_file import in_temporary_folder
from BendTorsionWB.member_files import (
    FILES_AT_ONCE,
    MemberFile,
    member_files,
    record_key,
    start_all,
    written,
)


class Counting:
    """Runs what it is given at once, and counts the tasks."""

    def __init__(self):
        self.tasks = []

    def submit(self, function, files):
        self.tasks.append(files)
        done = Future()
        done.set_result(function(files))
        return done


def records(plates=3):
    marks = [f"T{k}" for k in range(1, plates + 1)]
    return {
        name: record_of(name, tuple(rectangle(mark=f"{name}-{mark}") for mark in marks))
        for name in ("M1", "M2")
    }


def files_of(found, sheets=False):
    return member_files(found, dict.fromkeys(found, ""), PLAIN_STYLE, sheets)


def test_a_plate_is_fitted_once_for_its_dxf_and_nc1_file(monkeypatch):
    fitted = []
    real = cut_contour.fit_runs

    def spy(outline, tolerance, mark):
        fitted.append(mark)
        return real(outline, tolerance, mark)

    monkeypatch.setattr(cut_contour, "fit_runs", spy)
    cut_contour.cut_arcs.cache_clear()
    files, executor = files_of(records()), Counting()
    made = start_all(files, executor)
    assert sorted(fitted) == sorted({file.plate for file in files if file.plate})
    assert len(executor.tasks) == len(records())
    for file in files:
        assert written(file, made[file.name]) == file.write(file.given)


def test_a_large_member_is_many_tasks_and_none_parts_a_plate():
    executor = Counting()
    made = start_all(files_of(records(FILES_AT_ONCE)), executor)
    assert len(executor.tasks) == 4 and max(map(len, executor.tasks)) <= FILES_AT_ONCE + 1
    for name, started in made.items():
        if name.endswith(".dxf"):
            other = made[name.replace("plates/", "nc1/").replace(".dxf", ".nc1")]
            assert other.task is started.task


def refused(given):
    raise BendTorsionError(error("nc1-contour", given, "is refused", "mend it"))


def test_a_file_that_cannot_be_made_is_told_alone():
    files = [
        MemberFile("a", "M1", "", str.encode, "text", "M1-T1"),
        MemberFile("b", "M1", "", refused, "M1-T1", "M1-T1"),
    ]
    made = start_all(files, Counting())
    assert written(files[0], made["a"]) == b"text"
    with pytest.raises(BendTorsionError, match="M1-T1.*is refused"):
        written(files[1], made["b"])


def ends(given):
    if os.getpid() != given:
        os._exit(1)
    return b"here"


def test_what_a_worker_died_at_is_made_here():
    files = [MemberFile("a", "M1", "", ends, os.getpid())]
    executor = Workers(1)
    try:
        made = start_all(files, executor)
        assert written(files[0], made["a"]) == b"here"
    finally:
        executor.shutdown()


def test_the_key_of_a_record_is_told_by_its_content_and_taken_once(monkeypatch):
    taken = []
    real = member_files_module.key_of
    monkeypatch.setattr(member_files_module, "key_of", lambda *a: taken.append(a) or real(*a))
    one, same = records()["M1"], records()["M1"]
    keys = [record_key(key, record) for record in (one, same) for key in ("a", "a", "b", "")]
    assert keys[:4] == keys[4:] and len(set(keys)) == 3 and keys[3] == ""
    assert len(taken) == 4


def test_what_the_temporary_folder_refuses_is_told_of_that_folder(tmp_path, monkeypatch):
    """The kernel says only that it cannot: it is asked inside the folder why, never beside it."""
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "gone"))
    with pytest.raises(BendTorsionError) as caught, in_temporary_folder():
        raise OSError("no reason")
    (found,) = caught.value.findings
    assert found.code == "file-not-written" and str(tmp_path / "gone") in found.object
    assert "No such file" in found.message and list(tmp_path.iterdir()) == []


def test_two_members_with_files_of_one_name_are_refused():
    one, other = (record_of(name, (rectangle(mark="M1-D1-D2"),)) for name in ("M1", "M1-D1"))
    with pytest.raises(BendTorsionError) as told:
        files_of({"M1": one, "M1-D1": other})
    assert {finding.code for finding in told.value.findings} == {"file-name-twice"}
    assert told.value.findings[0].objects == ("M1", "M1-D1")
    assert "plates/M1-D1-D2.dxf" in told.value.findings[0].message


@pytest.mark.parametrize("name", ["general_arrangement", "Set", "nodes"])
def test_a_member_with_the_name_of_sheets_of_the_project_is_refused(name):
    record = record_of(name, (rectangle(mark=f"{name}-T1"),))
    with pytest.raises(BendTorsionError) as told:
        files_of({name: record}, sheets=True)
    [found] = told.value.findings
    assert found.code == "file-name-twice" and found.object == name
    assert f"sheets/{name}.pdf" in found.message
    assert len(files_of({name: record})) == 2


def test_names_that_differ_by_the_code_of_letters_only_are_one_file():
    names = [unicodedata.normalize(form, "Mé") for form in ("NFC", "NFD")]
    with pytest.raises(BendTorsionError) as told:
        files_of({name: record_of(name, (rectangle(mark=f"{name}-T1"),)) for name in names})
    assert {finding.code for finding in told.value.findings} == {"file-name-twice"}
