# SPDX-License-Identifier: LGPL-2.1-or-later
"""Welds of diaphragms and end plates: sides, lengths and legs in the weld list of their member."""

import json
import math
from dataclasses import replace

import openpyxl
import pytest
from cut_members import job

from BendTorsionWB.core.detailing import PlatesInput, detail
from BendTorsionWB.core.drawings.sheet_style import PLAIN_STYLE
from BendTorsionWB.core.drawings.sheet_weld import kind_letters
from BendTorsionWB.core.drawings.sheet_weld_map import weld_map_blocks
from BendTorsionWB.core.drawings.sheet_weld_symbol import weld_symbol
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.surface import Plane
from BendTorsionWB.core.plates.diaphragm_input import Diaphragm, closing_of
from BendTorsionWB.core.sections.section import box
from BendTorsionWB.core.welds.edge_rows import EdgeTreatment
from BendTorsionWB.core.welds.preps import Prep, prep_of
from BendTorsionWB.exchange import report, results_workbook

SECTION = box("B", "box1", 800, 600, 20)


def made(*diaphragms, rows=()):
    """A straight member, 6 m along x, h 800, b 600, t 20, with these diaphragms."""
    given = job([(0, 0, 0), (6000, 0, 0)], Plane(), section=SECTION)
    plates = PlatesInput(diaphragms=tuple(diaphragms), edges=tuple(rows))
    return detail(replace(given, plates=plates)).record


def of(record, mark):
    return {w.plates[1].split("-")[1]: w for w in record.welds if w.plates[0] == f"M1-{mark}"}


def test_a_diaphragm_is_welded_to_its_four_walls_between_the_snipes():
    welds = of(made(Diaphragm(3000.0, 12.0, gap=2.0, snipe=30.0)), "D1")
    assert set(welds) == {"T1", "B1", "L1", "R1"}
    for wall, clear in (("T1", 560.0), ("B1", 560.0), ("L1", 760.0), ("R1", 760.0)):
        weld = welds[wall]
        assert weld.length == pytest.approx(clear - 2 * 2.0 - 2 * 30.0, abs=1e-6)
        # Both sides, 0.7 of the thinner plate, 12, in whole mm.
        assert (weld.prep.type, weld.prep.leg, weld.prep.gap) == ("double-fillet", 9.0, 2.0)
        assert (weld.kind, weld.name, weld.place) == ("diaphragm", "D1", "shop")
        assert weld.thickness == (12.0, 20.0)
    assert len({w.mark for w in welds.values()}) == 4


def test_a_face_closed_last_is_welded_through_its_slots_or_not_at_all():
    slotted = made(Diaphragm(3000.0, 12.0, closing=closing_of("top slot 100x30 @ 250")))
    (top,) = (w for w in slotted.welds if w.plates == ("M1-D1", "M1-T1"))
    slots = [hole for p in slotted.plates if p.mark == "M1-T1" for hole in p.holes]
    assert len(slots) == 2 and top.length == pytest.approx(200.0)
    # 12 mm of edge in slots of 30: no fillets reach both, they are filled.
    assert (top.prep.type, top.prep.name, top.prep.leg) == ("slot", "slot 100x30", 0.0)
    row = [EdgeTreatment("diaphragms", prep=prep_of("double-fillet leg=6"))]
    filled = made(Diaphragm(3000.0, 12.0, closing=closing_of("top slot")), rows=row)
    own = of(filled, "D1")
    assert (own["T1"].prep.name, own["L1"].prep.leg) == ("slot 100x28", 6.0)
    three = of(made(Diaphragm(3000.0, 12.0, closing=closing_of("top weld 10"))), "D1")
    assert set(three) == {"B1", "L1", "R1"}


def test_a_gap_too_wide_for_a_weld_has_none_and_a_warning():
    loose = made(Diaphragm(3000.0, 12.0, gap=20.0))
    assert not of(loose, "D1")
    (finding,) = loose.findings
    assert (finding.code, finding.object, finding.value) == ("diaphragm-not-welded", "M1-D1", 20.0)


def test_an_end_plate_is_welded_round_the_section_where_there_is_room():
    both = made(
        Diaphragm(0.0, 20.0, gap=-20.0, end="start"), Diaphragm(0.0, 20.0, gap=0.0, end="end")
    )
    welds = of(both, "E1")
    assert {wall: round(w.length, 6) for wall, w in welds.items()} == {
        "T1": 600.0,
        "B1": 600.0,
        "L1": 800.0,
        "R1": 800.0,
    }
    assert {(w.kind, w.prep.type, w.prep.leg) for w in welds.values()} == {("end", "fillet", 14.0)}
    assert {w.prep.type for w in of(both, "E2").values()} == {"square"}
    (finding,) = both.findings
    assert (finding.code, finding.object) == ("end-plate-weld", "M1-E2")


def test_rows_of_edges_prepare_them_and_grooves_are_refused():
    rows = (
        EdgeTreatment("diaphragms", prep=prep_of("fillet leg=6"), ndt="MT"),
        EdgeTreatment("D2", prep=prep_of("double-fillet")),
    )
    record = made(Diaphragm(2000.0, 12.0), Diaphragm(4000.0, 10.0), rows=rows)
    one, two = of(record, "D1")["L1"], of(record, "D2")["L1"]
    assert (one.prep.type, one.prep.leg, one.ndt) == ("fillet", 6.0, "MT")
    # A leg that no row tells is the rule pack's: 0.7 of 10.
    assert (two.prep.type, two.prep.leg) == ("double-fillet", 7.0)
    with pytest.raises(BendTorsionError) as caught:
        made(Diaphragm(2000.0, 12.0), rows=[EdgeTreatment("D1", prep=prep_of("v angle=60"))])
    (finding,) = caught.value.findings
    assert (finding.code, finding.position) == ("prep-flat", "edge 1")


def test_they_stand_in_every_list(tmp_path):
    record = made(Diaphragm(3000.0, 12.0), Diaphragm(0.0, 20.0, gap=-20.0, end="end"))
    own = {w.mark for w in record.welds if w.kind in ("diaphragm", "end")}
    assert len(own) == 8
    results_workbook.write_results([record], (), tmp_path / "r.xlsx")
    book = openpyxl.load_workbook(tmp_path / "r.xlsx", data_only=True)
    head, *rows = book["Welds"].iter_rows(values_only=True)
    table = {row[head.index("weld")]: dict(zip(head, row, strict=True)) for row in rows}
    assert own <= set(table)
    assert table["M1-D1/T1"]["leg"] == 9.0 and table["M1-D1/T1"]["type"] == "double-fillet"
    data = json.loads(json.dumps(report.report_json([record], (), "0")))
    told = {w["weld"]: w for w in data["members"][0]["welds"]}
    assert own <= set(told) and told["M1-E1/L1"]["prep"] == "end plate: fillet leg=14.0"
    assert told["M1-D1/L1"]["length_mm"] == pytest.approx(760.0)
    blocks = weld_map_blocks(record, kind_letters(record.welds), (380.0, 250.0), PLAIN_STYLE)
    words = " ".join(text.text for block in blocks for text in block.texts)
    assert "D1/T1" in words and "E1/L1" in words


def test_a_fillet_without_a_leg_takes_the_rule_packs():
    rows = [EdgeTreatment("TL", prep=prep_of("fillet inner"))]
    record = made(rows=rows)
    legs = {w.prep.leg for w in record.welds if w.name == "TL"}
    assert legs == {math.ceil(0.7 * 20)}


def test_a_slot_weld_is_drawn_and_named_by_its_size():
    prep = Prep("slot 100x28", "slot", gap=2.0)
    for language, word in (("en", "slot"), ("zh", "槽焊")):
        style = replace(PLAIN_STYLE, language=language)
        lines, texts = weld_symbol(prep, 20.0, "shop", "", (0.0, 0.0), style)
        assert f"{word} 100x28" in " ".join(text.text for text in texts)
        # Besides the reference line the open rectangle of ISO 2553, and no root gap.
        assert any(len(line.points) == 4 for line in lines)
        assert "2" not in [text.text for text in texts]
