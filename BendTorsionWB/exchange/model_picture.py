# SPDX-License-Identifier: LGPL-2.1-or-later
"""A picture of the members from outside, as SVG text: shaded faces between their corner lines."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

import numpy as np

from ..core.lofting import MemberRecord

MOST_FACES = 9000
"""Faces drawn at most; long lines are thinned until they are fewer."""

LIGHT = np.array([0.35, -0.45, 0.82])
_WIDTH, _HEIGHT, _MARGIN = 1100.0, 700.0, 12.0


def model_svg(
    records: Sequence[MemberRecord],
    colours: dict[str, tuple[float, float, float]] | None = None,
    azimuth: float = -55.0,
    height: float = 32.0,
) -> str:
    """The members seen from a direction (degrees), nearest drawn last; empty text without any.

    colours: of members by name, 0 … 1; the others are steel blue.
    """
    quads, owner = _faces(records)
    if not len(quads):
        return ""
    turn = _view(np.radians(azimuth), np.radians(height))
    seen = quads @ turn.T
    normal = np.cross(quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    shade = 0.55 + 0.45 * np.abs(normal @ (LIGHT / np.linalg.norm(LIGHT)))
    flat = seen[:, :, :2]
    low, high = flat.min(axis=(0, 1)), flat.max(axis=(0, 1))
    room = np.array([_WIDTH, _HEIGHT]) - 2 * _MARGIN
    scale = float((room / np.maximum(high - low, 1.0)).min())
    wide, tall = (high - low) * scale + 2 * _MARGIN
    points = (flat - low) * scale + _MARGIN
    points[..., 1] = tall - points[..., 1]
    base = np.array([(colours or {}).get(record.member, (0.42, 0.55, 0.68)) for record in records])[
        owner
    ]
    rgb = np.rint(255.0 * np.clip(base * shade[:, None], 0.0, 1.0)).astype(int)
    lines = []
    for k in np.argsort(seen[:, :, 2].mean(axis=1), kind="stable"):
        corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in points[k])
        fill = "#{:02x}{:02x}{:02x}".format(*rgb[k])
        lines.append(f'<polygon points="{corners}" fill="{fill}" stroke="{fill}"/>')
    for k, record in enumerate(records):
        own = points[owner == k]
        if len(own):
            x, y = own[:, :, 0].mean(), own[:, :, 1].mean()
            nearest = own.reshape(-1, 2)
            x, y = nearest[np.argmin(((nearest - [x, y]) ** 2).sum(axis=1))]
            place = f'x="{x:.1f}" y="{y:.1f}" text-anchor="middle"'
            place += ' paint-order="stroke" stroke="#ffffff" stroke-width="3"'
            lines.append(f"<text {place}>{escape(record.member)}</text>")
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide:.0f} {tall:.0f}" '
        'stroke-width="0.4" stroke-linejoin="round" role="img" font-size="12" '
        'font-family="DejaVu Sans, sans-serif">\n' + "\n".join(lines) + "\n</svg>"
    )


def _faces(records: Sequence[MemberRecord]) -> tuple[np.ndarray, np.ndarray]:
    """Quadrangles (n, 4, 3) between neighbouring corner lines, and the record (n,) of each."""
    rings = []
    for number, record in enumerate(records):
        corners = [line for name, line in record.wireframe.items() if _is_corner(name, record)]
        if len(corners) > 2:
            rings.append((number, np.stack(corners)))
    total = sum(len(lines) * (lines.shape[1] - 1) for _, lines in rings)
    every = max(1, int(np.ceil(total / MOST_FACES)))
    quads, owner = [], []
    for number, lines in rings:
        count = lines.shape[1]
        keep = np.unique(np.concatenate([np.arange(0, count, every), [count - 1]]))
        lines = lines[:, keep]
        following = np.roll(lines, -1, axis=0)
        faces = np.stack(
            [lines[:, :-1], lines[:, 1:], following[:, 1:], following[:, :-1]], axis=2
        ).reshape(-1, 4, 3)
        # Corner lines hold each place from both sides: most of those faces are nothing.
        faces = faces[np.ptp(faces, axis=1).max(axis=1) > 0.0]
        faces = faces[np.linalg.norm(faces[:, 1] - faces[:, 0], axis=1) > 1e-6]
        quads.append(faces)
        owner.append(np.full(len(faces), number))
    if not quads:
        return np.zeros((0, 4, 3)), np.zeros(0, int)
    return np.concatenate(quads), np.concatenate(owner)


def _is_corner(name: str, record: MemberRecord) -> bool:
    """True for the corner lines of a wireframe, which are as long as the axis's polyline allows."""
    line = record.wireframe[name]
    return name != "axis" and len(line) == 2 * len(record.wireframe["axis"])


def _view(azimuth: float, height: float) -> np.ndarray:
    """(3, 3) rows: right, up and towards the eye."""
    eye = np.array(
        [np.cos(height) * np.cos(azimuth), np.cos(height) * np.sin(azimuth), np.sin(height)]
    )
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
    return np.array([right, np.cross(eye, right), eye])
