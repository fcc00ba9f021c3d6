# SPDX-License-Identifier: LGPL-2.1-or-later
"""Damaged and hostile files: refused by name or read, in time, nothing written elsewhere."""

import csv
import io
import os
import signal

import FreeCAD
import pytest
from fuzzed_input import KINDS, Seeds, tried
from kill_scenarios import POINTS
from test_build import schedule

from BendTorsionWB import project
from BendTorsionWB.__main__ import main
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.csv_folder import csv_bytes, read_csv
from BendTorsionWB.exchange.outside_files import file_of, outside_allowed
from BendTorsionWB.exchange.xlsx_file import Column, Table, xlsx_bytes
from BendTorsionWB.shapes import trial_program, trial_reading
from BendTorsionWB.shapes.trial_reading import failure_of


@pytest.fixture(scope="module")
def seeds(tmp_path_factory):
    return Seeds(tmp_path_factory.mktemp("seeds"))


FOUND = {"xlsx cells": (2271,)}
"""Seeds whose damage was a fault once, by kind: a plate 1e-320 mm thick."""


@pytest.mark.parametrize("kind", KINDS)
def test_no_input_crashes_hangs_or_writes_elsewhere(seeds, tmp_path, kind):
    for seed in (*range(12), *FOUND.get(kind, ())):
        (tmp_path / str(seed)).mkdir()
        found = tried(kind, seed, seeds, tmp_path / str(seed))
        assert not found.bad, found


FORMULAS = ("=1+1", "+cmd|'/C calc'!A0", "-2+3", "@SUM(A1)", '=HYPERLINK("x")')


def test_no_text_is_a_formula_in_csv_and_it_is_read_back_as_it_was(tmp_path):
    path = tmp_path / "x.csv"
    path.write_bytes(csv_bytes([["name"], *([text] for text in FORMULAS), [-3.5], ["-3.5"]]))
    rows = list(csv.reader(io.StringIO(path.read_text(encoding="utf-8-sig"), newline="")))
    assert all(row[0][0] == "'" for row in rows[1:-2]) and rows[-2:] == [["-3.5"], ["-3.5"]]
    assert [row[0] for row in read_csv(path)][1:-2] == list(FORMULAS)


def test_no_text_is_a_formula_in_a_workbook(tmp_path):
    path = tmp_path / "x.xlsx"
    path.write_bytes(xlsx_bytes([Table("T", (Column("a", "@"),), [[text] for text in FORMULAS])]))
    import openpyxl

    page = openpyxl.load_workbook(path)["T"]
    for (cell,), text in zip(page.iter_rows(min_row=2, max_row=1 + len(FORMULAS)), FORMULAS):
        assert cell.value == text and cell.data_type == "s" and cell.quotePrefix


@pytest.mark.parametrize(
    "name", ["../roof.step", "x/../../roof.step", "link.step", "folder link/roof.step"]
)
def test_a_file_outside_the_schedules_folder_is_read_only_when_allowed(tmp_path, seeds, name):
    inner = tmp_path / "project"
    inner.mkdir()
    (tmp_path / "roof.step").write_bytes(seeds.step)
    (inner / "link.step").symlink_to(tmp_path / "roof.step")
    (inner / "folder link").symlink_to(tmp_path)
    with pytest.raises(BendTorsionError) as problem:
        file_of(inner, name, "Roof")
    assert problem.value.findings[0].code == "file-outside"
    with outside_allowed():
        file_of(inner, name, "Roof")
    (inner / "roof.step").write_bytes(seeds.step)
    assert file_of(inner, "roof.step", "Roof").is_file()


def test_an_absolute_path_and_a_device_are_refused_by_cell(tmp_path, capsys):
    import openpyxl

    path = schedule(tmp_path / "s.xlsx", [POINTS])
    book = openpyxl.load_workbook(path)
    page = book["Surfaces"]
    page.delete_rows(1, 5)
    for row in (["surface", "kind", "file"], ["Hall", "file", "/dev/zero/../zero.step"]):
        page.append(row)
    book.save(path)
    with pytest.raises(BendTorsionError) as problem:
        project.read_jobs(path)
    assert "file-outside" in [finding.code for finding in problem.value.findings]
    assert main(["check", str(path), "--outside-files"]) == 2
    assert "no such file" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("read", "told"),
    [
        (lambda: os.kill(os.getpid(), signal.SIGSEGV), "crashed (SIGSEGV)"),
        (os.abort, "crashed (SIGABRT)"),
        (lambda: signal.pause(), "longer"),
        (lambda: bytearray(1 << 30), "GB"),
        (lambda: None, ""),
        (lambda: 1 / 0, ""),
    ],
)
def test_what_becomes_of_a_reader_is_told(monkeypatch, read, told):
    monkeypatch.setattr(trial_reading, "SHORTEST_TRIAL", 20.0 if told != "longer" else 0.3)
    monkeypatch.setattr(trial_reading, "MEMORY", 1 << 28)
    found = failure_of(read, 0)
    assert told in found and bool(told) == bool(found)
    assert FreeCAD.Version()


@pytest.mark.parametrize(
    ("does", "told"),
    [
        ("printf begun > $BENDTORSION_TRIAL_ANSWER; kill -SEGV $$", "crashed"),
        ("printf begun > $BENDTORSION_TRIAL_ANSWER; exec sleep 60", "longer"),
        ("exit 1", ""),
    ],
)
def test_what_becomes_of_a_reader_with_a_program_of_its_own_is_told(
    monkeypatch, tmp_path, does, told
):
    """A program that does not come to the file says nothing about it."""
    program = tmp_path / "reader"
    program.write_text(f"#!/bin/sh\n{does}\n", encoding="ascii")
    program.chmod(0o755)
    monkeypatch.setattr(trial_program, "program", lambda: str(program))
    found = trial_program.failure_in_program(program, 0.5, tmp_path)
    assert told in found and bool(told) == bool(found)


def test_without_a_fork_a_file_is_tried_by_freecads_own_program(monkeypatch, tmp_path, seeds):
    """As in the window and on Windows."""
    path = tmp_path / "good.step"
    path.write_bytes(seeds.step)
    answer = tmp_path / "answer.txt"
    assert trial_program.failure_in_program(path, 60.0, tmp_path) == ""
    assert answer.read_text(encoding="utf-8") == trial_program.READ
    monkeypatch.setattr(trial_reading, "can_fork", lambda: False)
    tried = []
    monkeypatch.setattr(trial_reading, "failure_in_program", lambda *given: tried.append(given))
    trial_reading.failure_of_file(path, lambda: pytest.fail("read here"))
    assert tried[0][0] == path


def test_a_file_too_large_is_not_tried():
    assert "larger" in failure_of(lambda: None, trial_reading.LARGEST_FILE + 1)
