# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random members of every kind: no corner is paired with another one's, every solid is exact."""

import numpy as np
import pytest
from random_members import random_member

from BendTorsionWB.core import tolerances
from BendTorsionWB.core.members.volume import skin_volumes
from BendTorsionWB.core.plates.plates import split_plates
from BendTorsionWB.core.solids import solid_skins
from BendTorsionWB.shapes import brep


@pytest.mark.parametrize("seed", range(0, 60, 5))
def test_solids_of_random_members_are_valid_and_exact(seed):
    m = random_member(seed)
    plates, _ = split_plates(m, {})
    skins = [solid_skins.plate_skin(plate) for plate in plates]
    volumes = skin_volumes(skins)
    solids = brep.tube_solids([[(p.knots, p.poles) for p in skin] for skin in skins])
    for plate, volume, solid in zip(plates, volumes, solids, strict=True):
        assert volume == pytest.approx(plate.volume, rel=tolerances.VOLUME_RELATIVE)
        assert solid.isValid() and solid.isClosed()
        # The kernel's quadrature is coarse on faces of many knots; a wrong pairing is not.
        assert solid.Volume == pytest.approx(plate.volume, rel=2e-3)


@pytest.mark.parametrize("first", range(0, 300, 50))
def test_corners_of_random_members_lie_on_their_own_lines(first):
    """Between stations, where a wrong pairing shows as half the section's breadth."""
    for seed in range(first, first + 50):
        m = random_member(seed)
        for tube in solid_skins.corner_tubes(m):
            for piece in tube:
                s = np.linspace(piece.knots[0], piece.knots[-1], 33)[1:-1]
                truth = m.corners(0.0, m.length)(s).reshape(len(s), -1, 3)
                miss = np.linalg.norm(piece.at(s) - truth, axis=2).max()
                assert miss < 2 * tolerances.SKIN_CORNER, seed
