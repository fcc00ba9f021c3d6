# SPDX-License-Identifier: LGPL-2.1-or-later
"""Piecewise interpolants: calculus to rounding, one-sided limits, refinement, breaks."""

import numpy as np
import pytest

from BendTorsionWB.core.geometry.piecewise import (
    antiderivatives_together,
    integrals_together,
    merged_breaks,
    resolve,
    sample,
    span_nodes,
)

BREAKS = np.array([0.0, 700.0, 1500.0, 4000.0])


def wave(s):
    return np.column_stack([np.sin(s / 900), np.exp(-s / 2000)])


def wave_rate(s):
    return np.column_stack([np.cos(s / 900) / 900, -np.exp(-s / 2000) / 2000])


def kinked(s):
    return np.abs(s - 1500.0)[:, None]


def test_calculus_agrees_with_closed_forms_to_rounding():
    function = sample(wave, BREAKS)
    s = np.linspace(0, 4000, 97)
    assert np.abs(function(s) - wave(s)).max() < 1e-12
    assert np.abs(function.derivative(s) - wave_rate(s)).max() < 1e-13
    back = function.derivative.antiderivative(wave(BREAKS[:1])[0])
    assert np.abs(back(s) - wave(s)).max() < 1e-11
    exact = [900 * (1 - np.cos(4000 / 900)), 2000 * (1 - np.exp(-2))]
    assert function.integral() == pytest.approx(exact, rel=1e-13)
    assert function.antiderivative()(np.array([4000.0]))[0] == pytest.approx(exact, rel=1e-13)


def test_integrals_of_several_functions_in_one_sweep_agree_with_closed_forms():
    """Of other spans each."""
    several = (
        BREAKS,
        np.array([0.0, 2000.0, 4000.0]),
        np.array([0.0, 100.0, 1500.0, 3000.0, 4000.0]),
    )
    values = np.concatenate([sample(wave, breaks).values for breaks in several])
    exact = [900 * (1 - np.cos(4000 / 900)), 2000 * (1 - np.exp(-2))]
    for found in integrals_together(values, several):
        assert found == pytest.approx(exact, rel=1e-13)
    sums = antiderivatives_together(values, several)
    ends = np.cumsum([len(breaks) - 1 for breaks in several])
    for breaks, own in zip(several, np.split(sums, ends[:-1]), strict=True):
        at = span_nodes(breaks)
        whole = np.stack([900 * (1 - np.cos(at / 900)), 2000 * (1 - np.exp(-at / 2000))], axis=2)
        assert np.abs(own - whole).max() < 1e-10


def test_a_kink_at_a_break_has_two_slopes_and_both_are_kept():
    rate = sample(kinked, BREAKS).derivative
    at = np.array([1500.0])
    assert rate(at, "earlier")[0, 0] == pytest.approx(-1, abs=1e-12)
    assert rate(at)[0, 0] == pytest.approx(1, abs=1e-12)
    assert sample(kinked, BREAKS).integral()[0] == pytest.approx((1500**2 + 2500**2) / 2, rel=1e-14)


def test_outside_its_range_the_end_spans_go_on():
    line = sample(lambda s: 3 * s[:, None] - 1, BREAKS)
    assert line(np.array([-10.0, 4010.0]))[:, 0] == pytest.approx([-31, 12029], abs=1e-8)


def test_resolve_refines_until_the_function_is_reproduced():
    def sharp(s):
        return (1 / (1 + ((s - 2100) / 60) ** 2))[:, None]

    coarse, fine = sample(sharp, BREAKS), resolve(sharp, BREAKS, 1.0)
    s = np.linspace(0, 4000, 1001)
    assert np.abs(coarse(s) - sharp(s)).max() > 1e-2
    assert np.abs(fine(s) - sharp(s)).max() < 1e-11
    assert set(BREAKS) <= set(fine.breaks)
    assert len(resolve(wave, BREAKS, 1.0).breaks) < 10


def test_a_kink_inside_a_span_ends_in_a_span_too_short_to_matter():
    found = resolve(lambda s: np.abs(s - np.pi * 1000)[:, None], np.array([0.0, 4000.0]), 4000.0)
    s = np.linspace(0, 4000, 999)
    assert np.abs(found(s)[:, 0] - np.abs(s - np.pi * 1000)).max() < 1.0
    assert np.diff(found.breaks).min() < 1.0


def test_merged_breaks_keep_both_ends_and_no_sliver():
    merged = merged_breaks([10.0, 500.0], [500.0005, 999.9999], start=0.0, end=1000.0, least=1e-3)
    assert merged.tolist() == [0.0, 10.0, 500.0, 1000.0]
