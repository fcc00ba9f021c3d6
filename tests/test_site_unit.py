# SPDX-License-Identifier: LGPL-2.1-or-later
"""A site datum is in mm; one that looks like metres beside `site_unit` m is warned of."""

import numpy as np
import pytest

from BendTorsionWB.core.site import SiteDatum, datum_findings


def warned(*place, unit="m"):
    return [finding.position for finding in datum_findings(SiteDatum(*place, unit=unit))]


def test_values_that_look_like_metres_are_named_with_what_to_write():
    site = SiteDatum(512345.678, 3456789.012, 12.5, unit="m")
    found = datum_findings(site)
    assert [f.position for f in found] == ["site_x", "site_y", "site_z"]
    assert {(f.severity, f.code) for f in found} == {("warning", "site-unit")}
    # What the message says is what lists show, and what it asks for would show the value written.
    assert f"{site.of(np.zeros(3))[0]:.6f} m" in found[0].message
    assert "write 512345678, in mm" in found[0].mend
    meant = SiteDatum(512345678.0, 3456789012.0, 12500.0, unit="m")
    assert datum_findings(meant) == ()
    assert meant.of(np.zeros(3)) == pytest.approx([512345.678, 3456789.012, 12.5])


def test_what_is_nowhere_on_earth_in_metres_is_in_millimetres():
    """Half a millimetre of a UTM easting is no sign of metres; an easting with its zone may be."""
    assert warned(512345678.5, 3398765432.1, 45000.5) == []
    zoned = SiteDatum(39512345.678, 0.0, 0.0, unit="m")
    (found,) = datum_findings(zoned)
    assert found.mend == "if it is in metres write 39512345678, in mm"
    assert "site_x is read in mm: 39512345.678 mm is 39512.345678 m" in found.message


def test_whole_millimetres_and_lists_in_mm_are_not_warned_of():
    assert warned(512345.678, 0.0, 0.5, unit="mm") == []
    assert warned(100000.0, -250000.0, 450.0) == []
    assert warned(0.0, 0.0, 0.0) == []
    assert warned(500.0, 0.0, 0.0) == ["site_x"]
