# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plates of a member laid flat in one sweep: as by themselves, faults by name, as columns."""

import pickle
from dataclasses import fields

import curved_members
import numpy as np
import pytest
import ruled_patches

from BendTorsionWB.core.columns import Columns
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.flattening.development import develop_together
from BendTorsionWB.core.geometry.piecewise import Piecewise
from BendTorsionWB.core.lofting import LoftingPoint, PanelMeasure
from BendTorsionWB.core.patterns.pattern import MODES, develop_plate, develop_plates
from BendTorsionWB.core.plates.plates import Joints, split_plates

JOINTS = {"top": Joints((0.4,)), "left": Joints((0.3, 0.6))}


@pytest.fixture(scope="module")
def plates():
    return split_plates(curved_members.tapered(), JOINTS)[0]


def flat_numbers(value) -> list[np.ndarray]:
    """All numbers of a record, in order."""
    if isinstance(value, str) or value is None:
        return []
    if hasattr(value, "__dataclass_fields__") and not isinstance(value, Columns):
        value = [getattr(value, field.name) for field in fields(value)]
    if isinstance(value, (bool, int, float, np.number, np.ndarray)):
        return [np.ravel(value).astype(float)]
    return [number for item in value for number in flat_numbers(item)]


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("which", ["plates", "twisted_plates"])
def test_plates_laid_flat_together_are_as_laid_flat_alone(mode, which, request):
    given = request.getfixturevalue(which)[:: 4 if mode == "elastic" else 1]
    together = develop_plates(given, "outside", mode, surface="outer")
    for plate, record in zip(given, together, strict=True):
        alone = develop_plate(plate, "outside", mode, surface="outer")
        one, other = (np.concatenate(flat_numbers(own)) for own in (alone, record))
        finite = np.isfinite(one)
        assert (finite == np.isfinite(other)).all()
        np.testing.assert_allclose(other[finite], one[finite], rtol=1e-7, atol=1e-8)


def test_the_plate_that_folds_over_is_named_among_the_others():
    good = ruled_patches.cylinder(skew=0.0, wave=0.0)
    back = Piecewise(good.breaks, good.values.copy())
    back.values[..., 3] *= -1.0
    with pytest.raises(BendTorsionError) as caught:
        develop_together([good, back, good], ["M1-T1", "M1-T2", "M1-T3"])
    [finding] = caught.value.findings
    assert finding.code == "plate-folds-over" and finding.object == "M1-T2"


def test_records_in_columns_read_as_records(plates):
    record = develop_plate(plates[0])
    points, panels = list(record.points), list(record.panels)
    assert all(isinstance(point, LoftingPoint) for point in points)
    assert all(isinstance(panel, PanelMeasure) for panel in panels)
    assert len(record.points) == len(points) == 4 * len(record.lines)
    assert len(panels) == 4 * (len(record.lines) - 1)
    assert record.points[-1].label == points[-1].label == f"W-{2 * len(record.lines)}"
    assert [p.label for p in record.points[1:3]] == ["P-2", "P-3"]
    assert type(points[0].s) is float and type(panels[0].flat) is float
    with pytest.raises(IndexError):
        record.points[len(points)]
    again = pickle.loads(pickle.dumps(record, 5))
    assert list(again.panels) == panels
    for one, other in zip(again.points, points, strict=True):
        assert (one.label, one.line, one.s) == (other.label, other.line, other.s)
        np.testing.assert_array_equal(one.xyz, other.xyz)


def test_functions_are_sent_without_what_follows_from_them(plates):
    rails = plates[0].rails.mid
    bare = len(pickle.dumps(Piecewise(rails.breaks, rails.values), 5))
    rails.with_rates(np.array([rails.start]))
    assert len(pickle.dumps(rails, 5)) == bare
    again = pickle.loads(pickle.dumps(rails, 5))
    np.testing.assert_array_equal(again.derivative.values, rails.derivative.values)
