# SPDX-License-Identifier: LGPL-2.1-or-later
"""Names of the layers of cut files: one setting of the schedule, one property of the patterns."""

import ezdxf
import FreeCAD
import openpyxl
import pytest
from test_build import APART, schedule

from BendTorsionWB import project
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.patterns.layer_names import lines_of
from BendTorsionWB.document import build_document
from BendTorsionWB.exchange.schedule import read_schedule
from BendTorsionWB.model_files import Wanted
from BendTorsionWB.round_trip import write_back

NAMES = "CUT_OUTER=10 MARK_TEXT=text of plates"


def book(path, value):
    """A schedule of one member whose Settings name layers."""
    schedule(path, APART[:1])
    made = openpyxl.load_workbook(path)
    page = made.create_sheet("Settings")
    for row in (("key", "value"), ("layer_names", value)):
        page.append(row)
    made.save(path)
    return path


def test_the_names_are_in_files_in_the_document_and_in_the_schedule_written_of_it(tmp_path):
    """Given in the Settings, they come back from the document as they were."""
    path = book(tmp_path / "one.xlsx", NAMES)
    project.build(path, tmp_path / "out", workers=1, wanted=Wanted(sheets=False, model=False))
    for file in (tmp_path / "out" / "plates").glob("M1-*.dxf"):
        used = {entity.dxf.layer for entity in ezdxf.readfile(file).modelspace()}
        assert {"10", "text of plates"} <= used and not {"CUT_OUTER", "MARK_TEXT"} & used
    document = build_document(*project.read_jobs(path), sheets=False)
    try:
        patterns = next(o for o in document.Objects if getattr(o, "BT_Type", "") == "Unfold")
        assert list(patterns.LayerNames) == ["CUT_OUTER=10", "MARK_TEXT=text of plates"]
        document.recompute()
        told = write_back(document, tmp_path / "back.xlsx")
    finally:
        FreeCAD.closeDocument(document.Name)
    assert not [finding for finding in told if "LayerNames" in finding.position]
    assert read_schedule(tmp_path / "back.xlsx").settings.layer_names == NAMES


@pytest.mark.parametrize("value", ["CUT_OUT=10", "PUNCH=a/b", "PUNCH=REF", "PUNCH"])
def test_names_that_cannot_be_are_refused_at_their_cell(tmp_path, value):
    with pytest.raises(BendTorsionError) as refused:
        read_schedule(book(tmp_path / "bad.xlsx", value))
    (finding,) = refused.value.findings
    assert finding.code == "layer-name" and "Settings" in finding.position and finding.mend


def test_names_may_have_blanks():
    assert lines_of(" CUT_OUTER = 10 ; MARK_TEXT=text of plates\nREF=r") == [
        "CUT_OUTER = 10",
        "MARK_TEXT=text of plates",
        "REF=r",
    ]
