# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands whose standard output is closed by its reader or lies on a full disk."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from schedule_books import GOOD, write

from BendTorsionWB import standard_output
from BendTorsionWB.__main__ import main
from BendTorsionWB.standard_output import CLOSED, OutputLost, watched

ROOT = Path(__file__).resolve().parent.parent
COMMANDS = {"names": ["new"], "help": ["--help"]}


def run(arguments, output):
    made = subprocess.run(
        [sys.executable, "-m", "BendTorsionWB", *arguments],
        cwd=ROOT,
        stdout=output,
        stderr=subprocess.PIPE,
        encoding="utf-8",
    )
    return made.returncode, made.stderr


@pytest.mark.parametrize("command", COMMANDS)
def test_a_closed_pipe_ends_a_command_quietly(command):
    reading, writing = os.pipe()
    os.close(reading)
    try:
        assert run(COMMANDS[command], writing) == (CLOSED, "")
    finally:
        os.close(writing)


@pytest.mark.parametrize("command", COMMANDS)
def test_a_full_disk_for_the_output_is_one_line(command):
    with open("/dev/full", "w", encoding="utf-8") as full:
        code, told = run(COMMANDS[command], full)
    [line] = told.splitlines()
    assert code == 1 and line.startswith("error: standard output cannot be written: No space left")
    assert "-->" not in line and " -> " in line and "--debug" not in line


class Lost:
    """A stream that takes nothing."""

    def __init__(self, problem):
        self.problem = problem

    def write(self, text):
        raise self.problem

    def flush(self):
        """It holds nothing."""


@pytest.mark.parametrize("name", ["stdout", "stderr"])
def test_no_fence_against_faults_takes_a_lost_stream_for_one(monkeypatch, name):
    monkeypatch.setattr(sys, name, Lost(BrokenPipeError(32, "Broken pipe")))
    former = sys.stdout, sys.stderr
    with pytest.raises(OutputLost) as lost, watched():
        try:
            print("told", file=getattr(sys, name))
        except Exception:  # noqa: BLE001 - as the fences of the program
            pytest.fail("taken for a fault")
    assert (sys.stdout, sys.stderr) == former
    assert lost.value.told() == CLOSED


def test_a_full_disk_for_the_messages_is_told_nowhere(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(sys, "stderr", Lost(OSError(28, "No space left on device")))
    assert main(["check", str(tmp_path / "none.xlsx")]) == standard_output.UNWRITTEN
    assert capsys.readouterr().out == ""


def test_a_broken_pipe_of_something_else_is_a_fault_still(monkeypatch, capsys):
    def command(options):
        raise BrokenPipeError(32, "Broken pipe")

    monkeypatch.setitem(sys.modules["BendTorsionWB.__main__"]._COMMANDS, "new", command)
    assert main(["new"]) == 1
    assert "unexpected BrokenPipeError" in capsys.readouterr().err


def test_messages_to_a_closed_stream_go_nowhere(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(sys, "stderr", None)
    assert main(["check", str(write(tmp_path / "hall.xlsx", GOOD)), "--jobs", "1"]) == 0
    assert sys.stderr is None and "unexpected" not in capsys.readouterr().out
