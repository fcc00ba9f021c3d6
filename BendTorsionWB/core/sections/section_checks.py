# SPDX-License-Identifier: LGPL-2.1-or-later
"""What every section must be: gaps, breadths and plates that do not overlap."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..finding import BendTorsionError, Finding, error
from .section import Section
from .strip_lines import section_polygons


def refuse(findings: Sequence[Finding]) -> None:
    """Raises BendTorsionError with the findings, if there are any."""
    if findings:
        raise BendTorsionError(findings)


def unknown(name: str, what: str, value, known: Sequence[str]) -> Finding:
    """The error of a word that is none of the known ones."""
    return error(
        f"section-{what}",
        name,
        f"{what} {value!r} is not known",
        f"use {', '.join(known)}",
        value=str(value),
    )


def centred(name, kind, points, names, strips, material, closed) -> Section:
    """The section of corners (n, 2), moved to the middle of their box and checked."""
    low, high = points.min(axis=0), points.max(axis=0)
    breadth, height = (high - low).tolist()
    corners = tuple(map(tuple, (points - 0.5 * (low + high)).tolist()))
    return checked(
        Section(name, kind, height, breadth, corners, names, tuple(strips), material, closed)
    )


def checked(section: Section) -> Section:
    """The section; raises BendTorsionError for gaps below zero, plates without breadth between
    their neighbours, and plates that overlap."""
    findings = []
    for strip in section.strips:
        for stop in strip.stops:
            if stop and not (np.isfinite(stop.gap) and stop.gap >= 0):
                findings.append(
                    error(
                        "section-gap",
                        section.name,
                        "gap must be zero or a positive length",
                        "give the gap in mm",
                        position=f"face {strip.face}",
                        value=float(stop.gap),
                        limit=0.0,
                        unit="mm",
                    )
                )
    if findings:
        raise BendTorsionError(findings)
    with np.errstate(divide="ignore", invalid="ignore"):
        plates = section_polygons(section)
    corners = np.array(section.corners)
    for strip, plate in zip(section.strips, plates, strict=True):
        along = corners[strip.second] - corners[strip.first]
        breadths = [(plate[1] - plate[0]) @ along, (plate[2] - plate[3]) @ along]
        clear = min(breadths) / max(float(np.hypot(*along)), 1e-9)
        if not clear > 1e-6:
            findings.append(
                error(
                    "gap-too-wide",
                    section.name,
                    "nothing is left of the plate between its neighbours",
                    "use smaller gaps, thinner neighbours or a wider section",
                    position=f"face {strip.face}",
                    value=float(clear),
                    limit=0.0,
                    unit="mm",
                )
            )
    if not findings:
        findings += [
            error(
                "plates-overlap",
                section.name,
                f"plates {one.face} and {other.face} overlap",
                "let one stop at the other, or make them thinner",
            )
            for i, one in enumerate(section.strips)
            for j, other in enumerate(section.strips[:i])
            if overlap(plates[i], plates[j]) > 1e-6
        ]
    if findings:
        raise BendTorsionError(findings)
    return section


def overlap(one: np.ndarray, other: np.ndarray) -> float:
    """How deep two convex polygons (n, 2) enter each other, mm; below zero when they are clear."""
    depths = []
    for ring in (one, other):
        edges = np.roll(ring, -1, axis=0) - ring
        normals = np.column_stack([-edges[:, 1], edges[:, 0]])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        a, b = one @ normals.T, other @ normals.T
        depths.append(np.minimum(a.max(axis=0) - b.min(axis=0), b.max(axis=0) - a.min(axis=0)))
    return float(np.concatenate(depths).min())
