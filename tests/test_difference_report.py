# SPDX-License-Identifier: LGPL-2.1-or-later
"""The report of a difference says values as the console does."""

import csv
import json

import pytest

from BendTorsionWB.exchange.difference import Change, change_rows, write_changes

CHANGES = (
    Change("changed", "sections", "S1", "h", 600.0, 590.5, "M1"),
    Change("changed", "sections", "S1", "b", 500, 1e6, "M1"),
    Change("changed", "axes", "A1", "closed", False, True, "M1"),
    Change("changed", "members", "M1", "rank", None, -2.0, "M1"),
)


def test_whole_numbers_have_no_decimals_and_yes_is_yes(tmp_path):
    write_changes(CHANGES, tmp_path / "d.csv")
    with (tmp_path / "d.csv").open(encoding="utf-8-sig", newline="") as file:
        rows = [row[5:] for row in csv.reader(file)][1:]
    assert rows == [["600", "590.5"], ["500", "1000000"], ["no", "yes"], ["", "-2"]]
    for change, row in zip(CHANGES[:1], rows):
        assert change.line().endswith(f"h {row[0]} -> {row[1]} (members M1)")


def test_every_kind_of_report_says_the_same(tmp_path):
    write_changes(CHANGES, tmp_path / "d.json")
    told = json.loads((tmp_path / "d.json").read_text(encoding="utf-8"))
    assert [(c["before"], c["after"]) for c in told] == [row[5:] for row in change_rows(CHANGES)]
    assert change_rows(CHANGES)[0][6] == pytest.approx(590.5)
