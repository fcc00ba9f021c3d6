# SPDX-License-Identifier: LGPL-2.1-or-later
"""What joints of a face are solved on: its lengths, width and turn, sampled along the axis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..flattening.development import develop
from ..geometry.piecewise import Piecewise
from ..members.member import Member
from ..members.strips import StripRails, rails_between

SAMPLE = 50.0
"""Spacing of the samples a face's lengths, width and turn are read from, mm."""


@dataclass(frozen=True, eq=False)
class FaceRun:
    """A face between two forced cuts: its neighbours; at places s (n,), rising: arc lengths of
    its edges (2, n) from the start, its width (n,) and the turn (n,) of its flat centre line,
    rad, summed up from the start. given: joints that stay, or None to solve for them. forced:
    its thickness joints, which stay and are not solved for."""

    face: str
    neighbours: tuple[str, ...]
    s: np.ndarray
    edges: np.ndarray
    width: np.ndarray
    turn: np.ndarray
    given: tuple[float, ...] | None = None
    forced: tuple[float, ...] = ()

    def at(self, places: np.ndarray) -> FaceRun:
        """The run at other places, by interpolation."""
        edges = np.stack([np.interp(places, self.s, edge) for edge in self.edges])
        width, turn = (np.interp(places, self.s, v) for v in (self.width, self.turn))
        return replace(self, s=places, edges=edges, width=width, turn=turn)


def face_runs(
    member: Member,
    neighbours: Mapping[str, tuple[str, ...]],
    start: float,
    end: float,
    lanes: Mapping[str, Sequence[float]],
) -> list[FaceRun]:
    """The faces between two forced cuts, sampled on their mid-surfaces."""
    runs = []
    for k, strip in enumerate(member.law.strips):
        own = tuple(p for p in member.law.joints_of(k) if start < p < end)
        ends = [start, *own, end]
        spans = [(k, a, b) for a, b in zip(ends[:-1], ends[1:], strict=True)]
        parts = [
            _sampled(rails, a, b, f"{member.name} face {strip.face}")
            for rails, (_, a, b) in zip(rails_between(member, spans), spans, strict=True)
        ]
        s, width = (np.concatenate([part[i] for part in parts]) for i in (0, 3))
        along, turn = (
            np.concatenate(_summed([part[i] for part in parts]), axis=-1) for i in (1, 2)
        )
        widest_lane = float(np.diff(lanes.get(strip.face, (0.0, 1.0))).max())
        runs.append(
            FaceRun(
                strip.face, neighbours[strip.face], s, along, widest_lane * width, turn, forced=own
            )
        )
    return runs


def _sampled(rails: StripRails, start: float, end: float, name: str) -> tuple[np.ndarray, ...]:
    """Places (n,), edge lengths (2, n) and turn (n,) from the start, and width (n,) of a stretch
    of a face."""
    s = np.linspace(start, end, max(17, int((end - start) / SAMPLE) + 1))
    development = develop(rails.mid, name)
    rate = rails.mid.derivative
    speed = np.sqrt((rate.values.reshape(*rate.values.shape[:2], 2, 3) ** 2).sum(axis=3))
    along = Piecewise(rate.breaks, speed).antiderivative()(s)
    by_s, _ = development.jacobian(s, np.full(len(s), 0.5))
    heading = np.unwrap(np.arctan2(by_s[:, 1].copy(), by_s[:, 0].copy()))
    turn = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(heading)))])
    return s, along.T.copy(), turn, development.plane(s)[:, 3].copy()


def _summed(parts: Sequence[np.ndarray]) -> list[np.ndarray]:
    """Each part (…, n) from where the one before it ends."""
    summed = list(parts[:1])
    for part in parts[1:]:
        summed.append(part + summed[-1][..., -1:])
    return summed
