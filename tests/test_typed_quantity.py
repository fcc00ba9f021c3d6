# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a text typed for a quantity means, against arithmetic by hand; what can mean two things."""

import FreeCAD
import pytest

from BendTorsionWB.gui.joint_words import parse_joints
from BendTorsionWB.gui.member_rows import matching
from BendTorsionWB.gui.typed_quantity import expression_value, number_of


@pytest.mark.parametrize(
    ("text", "mm"),
    [
        ("600", 600.0),
        ("-35.5", -35.5),
        ("+5", 5.0),
        ("0.5 m", 500.0),
        ("1e3 mm", 1000.0),
        ("300 mm + 50 mm", 350.0),
        ("1 m + 35 mm", 1035.0),
        ("1 m - 35 mm", 965.0),
        ("1 m-35mm+2cm", 985.0),
        ("2 * (300 mm)", 600.0),
        ("2 * (300 mm + 5 cm) - 1 mm", 699.0),
        ("2 * 325 mm", 650.0),
        ("300 mm * 2", 600.0),
        ("6 m / 4", 1500.0),
        ("2 * -3 mm", -6.0),
        # The unit of the field stands for the number beside it, and behind brackets.
        ("600.00 mm + 50", 650.0),
        ("600.00+50 mm", 650.0),
        ("(300 + 50) mm", 350.0),
        ("300 + 50", 350.0),
        # What was typed before the unit that stood there.
        ("50 cm mm", 500.0),
        ("1,2", 1.2),
        ("0,125", 0.125),
        ("1200,5", 1200.5),
        ("1,200.5", 1200.5),
        ("1.200,5", 1200.5),
        ("1,200,300", 1200300.0),
        ("1/2 in", 12.7),
        ("600/2 mm", 300.0),
        ("3 1/2 in", 88.9),
        ("5 ft 3 in", 63 * 25.4),
        ("12'-3 1/2\"", 147.5 * 25.4),
        ("-1' 11+5/8\"", -23.625 * 25.4),
        ("1' - 6 in", 6 * 25.4),
        ("5 \u03bcm", 0.005),
        ("\uff15\uff10\uff10\uff4d\uff4d", 500.0),
        ("2 \u00d7 300 mm \u2212 1 mm", 599.0),
    ],
)
def test_sums_units_and_fractions(text, mm):
    assert number_of(text, "mm") == pytest.approx(mm, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("", "missing"),
        ("  ", "missing"),
        ("bf", "cannot be read"),
        ("5 k", "cannot be read"),
        ("nan", "cannot be read"),
        ("inf mm", "cannot be read"),
        ("1e999", "cannot be read"),
        ("1e300 * 1e300", "cannot be read"),
        ("1/0", "cannot be read"),
        ("300 mm +", "cannot be read"),
        ("2 * (300 mm", "cannot be read"),
        ("(" * 150, "cannot be read"),
        ("mm", "cannot be read"),
        ("1,2,3", "cannot be read"),
        ("1.2.3", "cannot be read"),
        ("50 cm 600.00 mm", "no sign between two values"),
        ("1 200 mm", "no sign between two values"),
        ("--5", "two signs side by side"),
        ("5 - -3", "two signs side by side"),
        ("1,200", "1,200 can mean 1200 or 1.2: write one"),
        ("12,500 mm", "12,500 can mean 12500 or 12.5: write one"),
        ("2 * 1,200 mm", "1,200 can mean"),
        ("5 kg", "another unit than mm"),
        ("3 m * 2 mm", "another unit than mm"),
        ("600 mm / 2 mm", "another unit than mm"),
        ("300 mm + 5 kg", "different units"),
        ("1 m + 35", "35 has no unit"),
        ("3-1/2 in", "3 has no unit"),
        ("= 5 kg", "for the panel of the object"),
    ],
)
def test_what_means_nothing_or_two_things_is_refused_with_the_reason(text, why):
    with pytest.raises(ValueError, match=why):
        number_of(text, "mm")


def test_numbers_without_a_unit_are_of_the_field():
    """As FreeCAD shows it: in inches a plain number is inches, and stands beside no other."""
    assert number_of("2", "mm", 25.4) == pytest.approx(50.8)
    assert number_of("1 + 1", "mm", 25.4) == pytest.approx(50.8)
    with pytest.raises(ValueError, match="has no unit"):
        number_of("2 mm + 1", "mm", 25.4)


def test_the_decimal_mark_of_the_window_counts():
    """Where it is a comma, the point may part thousands; one of its own is no doubt."""
    assert number_of("1,200", "mm", 1.0, ",") == 1.2
    assert number_of("1.5", "mm", 1.0, ",") == 1.5
    with pytest.raises(ValueError, match="1.200 can mean 1200 or 1,2"):
        number_of("1.200", "mm", 1.0, ",")


def test_other_quantities():
    """Angles in degrees, minutes and seconds, pressures by their dimension, plain numbers."""
    assert number_of("12\u00b030\u203215\u2033", "deg") == pytest.approx(12 + 30 / 60 + 15 / 3600)
    assert number_of("0.1 rad", "deg") == pytest.approx(5.729577951308232)
    for text in ("355", "355 N/mm^2", "355 N/mm\u00b2", "355 MPa", "0.355 GPa"):
        assert number_of(text, "MPa") == pytest.approx(355.0)
    assert number_of("1/4", "") == 0.25 and number_of("2,5", "") == 2.5
    with pytest.raises(ValueError, match="number alone"):
        number_of("2.5 mm", "")


def test_what_freecad_shows_in_feet_and_inches_is_read():
    """To half of the eighth of an inch or the hundredth it shows."""
    former = FreeCAD.Units.getSchema()
    try:
        for schema in (2, 3, 5, 7):
            FreeCAD.Units.setSchema(schema)
            for mm in (600.0, -600.0, 330.2, 3746.5, 12.7):
                quantity = FreeCAD.Units.Quantity(f"{mm} mm")
                shown, step = quantity.UserString, float(quantity.getUserPreferred()[1])
                read = number_of(shown, "mm", step)
                assert read == pytest.approx(mm, abs=max(0.005 * step, 25.4 / 16)), shown
    finally:
        FreeCAD.Units.setSchema(former)


def test_an_expression_has_a_value_of_the_unit_or_a_reason():
    document = FreeCAD.newDocument("Expressions")
    try:
        box = document.addObject("Part::Box", "Box")
        box.Length = 300
        assert expression_value(box, "2 * Length", "mm") == 600.0
        assert expression_value(box, "2 * Box.Length + 1 cm", "mm") == 610.0
        assert expression_value(box, "600", "mm") == 600.0
        for text in ("5 kg", "Nothing.here", "", "<<text>>", "5 kg +", "1 mm * 1 mm"):
            with pytest.raises(ValueError, match="the expression cannot be read"):
                expression_value(box, text, "mm")
    finally:
        FreeCAD.closeDocument(document.Name)


@pytest.mark.parametrize(
    ("text", "joints"),
    [
        ("4000 8000", [4000.0, 8000.0]),
        ("4 m 8 m", [4000.0, 8000.0]),
        ("4 m; 8 m", [4000.0, 8000.0]),
        ("4 m + 35 mm; 2 * 4 m", [4035.0, 8000.0]),
        ("4 m + 35 mm 8 m", [4035.0, 8000.0]),
        ("1/4 1/2 1", [0.25, 0.5, 1.0]),
        ("Auto", "auto"),
        ("", []),
    ],
)
def test_joints_take_units_sums_and_fractions(text, joints):
    assert parse_joints(text) == joints


@pytest.mark.parametrize("text", ["4,000 8,000", "4000,8000", "4000, 8000", "0.5 mm", "4 m 8 kg"])
def test_joints_that_can_mean_two_things_are_refused(text):
    with pytest.raises(ValueError, match="write auto, or numbers"):
        parse_joints(text)


def test_capital_letters_make_no_other_word():
    """Unless there are two words that differ in these only."""
    assert matching("TOP-Left", ("top", "top-left")) == "top-left"
    assert matching("BOX1", ("Box1",)) == "Box1"
    assert matching("b1", ("B1", "b1")) == "b1"
    assert matching("bX", ("BX", "Bx")) is None and matching("top", ()) is None
