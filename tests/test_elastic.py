# SPDX-License-Identifier: LGPL-2.1-or-later
"""The elastic optimum against plate theory, finer splines and its own neighbours."""

from dataclasses import replace

import curved_members
import numpy as np
import pytest
import ruled_patches

from BendTorsionWB.core.flattening.development import develop, principal_strains
from BendTorsionWB.core.flattening.elastic import distance, membrane_energy, relaxed
from BendTorsionWB.core.geometry.piecewise import Piecewise
from BendTorsionWB.core.plates.plates import Joints, split_plates

WIDTH = 800.0


def start(rails):
    return develop(rails, mode="energy")


@pytest.mark.parametrize("twist", [0.01, 0.06, 0.1])
def test_within_a_hundredth_of_the_converged_optimum(twist):
    ruling = start(ruled_patches.helicoid(twist))
    converged = relaxed(ruling, refinement=2, terms=8)
    assert distance(relaxed(ruling), converged) < 0.01
    # The measured distance of the ruling development, 0.06 mm at 0.06 rad/m (K grows with τ²).
    assert distance(ruling, converged) == pytest.approx(0.0584 * (twist / 0.06) ** 2, rel=0.02)


@pytest.mark.parametrize(
    "width",
    [
        lambda s: np.full(len(s), 800.0),
        lambda s: 700.0 + 200.0 * np.sin(np.pi * s / 1500.0),
        lambda s: 10.0 + 890.0 * np.sin(np.pi * s / 6000.0) ** 2,
    ],
    ids=["constant", "wavy", "sliver"],
)
def test_strongly_bent_plates_converge_too(width):
    ruling = start(ruled_patches.bent_in_plane(width))
    optimum = relaxed(ruling)
    converged = relaxed(ruling, refinement=2, terms=8)
    assert distance(optimum, converged) < 0.01
    energies = [membrane_energy(d) for d in (develop(ruling.surface), ruling, optimum, converged)]
    assert energies[0] > energies[1] > energies[2] >= energies[3]


def test_energy_per_length_is_that_of_a_long_strip_of_constant_curvature():
    twist = 0.03
    energies = [
        membrane_energy(relaxed(start(ruled_patches.helicoid(twist, WIDTH, length))))
        for length in (4000.0, 8000.0)
    ]
    # ∇⁴Φ = K between clamped edges, K = −τ²/W⁴; ends cancel in the difference.
    curvature = (1e-3 * twist) ** 2
    strip = curvature**2 * WIDTH**5 / 1440.0 * 4000.0
    assert energies[1] - energies[0] == pytest.approx(strip, rel=1e-3)


def test_edges_come_out_short_by_the_curvature_less_the_relief_at_the_ends():
    twist, length = 0.06, 6000.0
    optimum = relaxed(start(ruled_patches.helicoid(twist, WIDTH, length)))
    s = np.linspace(0.0, length, 4001)
    steps = np.diff(optimum.flat(s, np.zeros(4001)), axis=0)
    flat = np.linalg.norm(steps, axis=1).sum()
    true = length * np.sqrt(1.0 + (0.5e-3 * twist * WIDTH) ** 2)
    law = WIDTH**2 / 12.0 * (1e-3 * twist) ** 2 * length
    assert 0.88 * law < true - flat < 0.95 * law


def test_no_neighbour_has_less_energy():
    optimum = relaxed(start(ruled_patches.helicoid(0.06)))
    least = membrane_energy(optimum)
    own = optimum.correction
    phase = own.nodes / 6000.0
    random = np.random.default_rng(11)
    for _ in range(6):
        change = np.zeros_like(own.values)
        for wave in range(4):
            shape = np.cos(wave * np.pi * phase + random.uniform(0.0, 6.0))
            change += 0.02 * random.normal(size=own.values.shape[2]) * shape[..., None]
        moved = replace(optimum, correction=Piecewise(own.breaks, own.values + change))
        assert membrane_energy(moved) > least


def test_edges_and_ends_are_free_of_the_stress_across_them():
    # One principal strain lies along the free line, the other is its Poisson contraction.
    optimum = relaxed(start(ruled_patches.helicoid(0.06)), refinement=2, terms=8)
    places, across = np.array([0.0, 3000.0, 6000.0]), np.array([0.0, 0.5, 1.0])
    pair = np.stack(principal_strains(optimum, places, across))
    for i, j in ((0, 1), (2, 1), (1, 0), (1, 2)):
        one, two = sorted(pair[:, i, j], key=abs)
        assert one / two == pytest.approx(-0.3, abs=0.02)


@pytest.mark.parametrize("patch", [ruled_patches.cylinder, ruled_patches.cone])
def test_nothing_to_correct_on_a_developable_plate(patch):
    ruling = start(patch())
    assert distance(ruling, relaxed(ruling)) < 1e-6


def test_a_folded_plate_is_relaxed_across_its_fold():
    member = curved_members.tapered()
    plates, _ = split_plates(member, {"top": Joints((0.3,))})
    plate = next(plate for plate in plates if plate.folds)
    folds = plate.rails.mid_folds
    ruling = start(plate.rails.mid)
    optimum = relaxed(ruling, folds, plate.mark)
    assert distance(optimum, relaxed(ruling, folds, refinement=2, terms=8)) < 0.001
    assert membrane_energy(optimum, folds) < membrane_energy(ruling, folds)


def test_same_rails_same_bits_wherever_they_lie_in_memory():
    rails = ruled_patches.helicoid(0.06)
    first = relaxed(start(rails)).correction.values.tobytes()
    for shift in (1, 3):
        room = np.empty(rails.values.size + shift)
        copy = room[shift:].reshape(rails.values.shape)
        copy[...] = rails.values
        again = relaxed(start(Piecewise(rails.breaks, copy)))
        assert again.correction.values.tobytes() == first
