# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nothing is written into a folder that is issued, nor below it."""

import shutil
from pathlib import Path

import pytest
from test_build import APART, schedule

from BendTorsionWB import document_export, project
from BendTorsionWB.__main__ import main
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.issued_folder import is_issued
from BendTorsionWB.project import Wanted

PLAIN = Wanted(model=False, sheets=False)


@pytest.fixture(scope="module")
def issued(tmp_path_factory):
    """A schedule, and the folder of its build with issue A."""
    folder = tmp_path_factory.mktemp("issued")
    path = schedule(folder / "two.xlsx", APART)
    project.build(path, folder / "out", workers=1, wanted=PLAIN)
    project.issue_folder(folder / "out", "A")
    return path, folder / "out"


def state(folder):
    return {p: p.read_bytes() for p in Path(folder).rglob("*") if p.is_file()}


PLACES = ["issued/A", "issued/A/plates", "issued/A/new/deep", "issued", "issued/B"]


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("command", ["build", "update", "export"])
def test_no_command_writes_a_package_into_an_issue(issued, capsys, command, place):
    path, out = issued
    before = state(out)
    assert main([command, str(path), "--out", str(out / place)]) == 2
    told = capsys.readouterr().err
    assert "belongs to an issue" in told and "outside the folder of issues" in told
    assert state(out) == before


@pytest.mark.parametrize(
    "words",
    [
        ["report", "{path}", "--report", "{out}/issued/A/figures.xlsx"],
        ["diff", "{path}", "{path}", "--report", "{out}/issued/A/changes.csv"],
        ["export", "{path}", "--out", "{out}/issued/A/back.xlsx"],
        ["support", "{path}", "--out", "{out}/issued/A/bundle.zip"],
        ["new", "--template", "member", "--out", "{out}/issued/A/new.FCStd"],
    ],
)
def test_no_command_writes_a_file_into_an_issue(issued, capsys, words):
    path, out = issued
    before = state(out)
    assert main([word.format(path=path, out=out) for word in words]) == 2
    assert "belongs to an issue" in capsys.readouterr().err
    assert state(out) == before


def test_scripts_are_refused_as_well(issued):
    path, out = issued
    for act in (
        lambda: project.build(path, out / "issued/A", workers=1, wanted=PLAIN),
        lambda: document_export.export_document(out / "model.FCStd", out / "issued/A"),
        lambda: document_export.write_figures(None, out / "issued/A/figures.xlsx"),
    ):
        with pytest.raises(BendTorsionError) as caught:
            act()
        assert [finding.code for finding in caught.value.findings] == ["folder-issued"]


def test_an_issued_file_is_told_as_such(issued):
    """Not by the advice to allow writing to it, which a file of somebody's own still gets."""
    from BendTorsionWB.exchange.whole_file import write_whole

    _, out = issued
    file = out / "issued/A/results_A.xlsx"
    before = file.read_bytes()
    own = out.parent / "own.txt"
    own.write_text("mine", encoding="utf-8")
    own.chmod(0o444)
    told = {}
    for path in (file, own):
        with pytest.raises(BendTorsionError) as caught:
            write_whole(path, b"new")
        [told[path]] = caught.value.findings
    assert told[file].code == told[own].code == "file-not-written"
    assert "allow writing" not in told[file].mend and "issues" in told[file].mend
    assert "allow writing" in told[own].mend
    assert file.read_bytes() == before


def test_links_and_copies_of_an_issue_are_one_too_and_other_folders_are_not(issued, tmp_path):
    path, out = issued
    (tmp_path / "link").symlink_to(out / "issued" / "A")
    shutil.copytree(out / "issued" / "A", tmp_path / "delivered")
    assert is_issued(tmp_path / "link" / "x") and is_issued(tmp_path / "delivered")
    (tmp_path / "issued").mkdir()
    for free in (out, out.parent, tmp_path / "issued" / "out", out / "plates", out / "issued.txt"):
        assert not is_issued(free)
    project.build(path, out, workers=1, wanted=PLAIN)
    project.issue_folder(out, "B")
    assert is_issued(out / "issued" / "B")
