# SPDX-License-Identifier: LGPL-2.1-or-later
"""Developed plates with exactly known outlines, for the tests of the writers."""

import numpy as np

from BendTorsionWB.core.lofting import (
    DevelopedPlate,
    FoldLine,
    LoftingPoint,
    MemberRecord,
    PanelMeasure,
    StationLine,
)


def rectangle(mark="M1-T1", length=2400.0, width=800.0, **changed):
    """A flat rectangle."""
    return strip(
        mark,
        lambda s: np.stack((s, np.zeros_like(s)), axis=-1),
        lambda s: np.stack((s, np.full_like(s, width)), axis=-1),
        length,
        area=length * width,
        **changed,
    )


def annular_sector(mark="M1-L1", radius=9000.0, width=600.0, angle=0.5, **changed):
    """A developed cone: two concentric arcs and two radial ends; area in closed form."""
    low = np.array([-radius * np.sin(angle / 2), radius * np.cos(angle / 2)])

    def arc(r):
        def place(s):
            a = angle / 2 - s / radius
            return np.stack((-r * np.sin(a), r * np.cos(a)), axis=-1) - low

        return place

    return strip(
        mark,
        arc(radius),
        arc(radius + width),
        radius * angle,
        area=0.5 * angle * ((radius + width) ** 2 - radius**2),
        **changed,
    )


def wavy(mark="M2-B1", length=13000.0, width=700.0, amplitude=60.0, waves=1.5, **changed):
    """A strip between two parallel sine waves; its area is length times width exactly."""

    def edge(offset):
        def place(s):
            v = offset + amplitude * (1.0 + np.sin(2 * np.pi * waves * s / length))
            return np.stack((s, v), axis=-1)

        return place

    return strip(mark, edge(0.0), edge(width), length, area=length * width, **changed)


def strip(mark, first, second, length, *, area, dense=500, folds=(), member="M1", **changed):
    """A plate between two edges given as functions of s; lines at s = 500, 1000, ..."""
    s = np.linspace(0.0, length, dense)
    ends = (np.array([0.0]), np.array([length]))
    outline = (
        first(s),
        np.concatenate((first(ends[1]), second(ends[1]))),
        second(s[::-1]),
        np.concatenate((second(ends[0]), first(ends[0]))),
    )
    low = np.concatenate(outline).min(axis=0)
    outline = tuple(run - low for run in outline)
    stations = np.concatenate(([0.0], np.arange(500.0, length - 1.0, 500.0), [length]))
    labels = ["E-1", *(f"L-{k}" for k in range(1, len(stations) - 1)), "E-2"]
    lines, points = [], []
    for k, (station, label) in enumerate(zip(stations, labels)):
        at = np.array([station])
        flat = np.concatenate((first(at), second(at))) - low
        across = float(np.hypot(*(flat[1] - flat[0])))
        lines.append(StationLine(label, station, flat, across + 1e-7, across))
        inward = (flat[1] - flat[0]) / across
        for letter, kind, inset in (("P", "arris", 0.0), ("W", "witness", 50.0)):
            for side, edge, place in (
                (1, "left", flat[0] + inset * inward),
                (2, "right", flat[1] - inset * inward),
            ):
                xyz = np.array([place[0] + 1e4, place[1] - 2e4, 3000.123456789])
                points.append(
                    LoftingPoint(
                        f"{letter}-{2 * k + side}",
                        label,
                        edge,
                        kind,
                        station,
                        xyz,
                        xyz - xyz[2],
                        place,
                    )
                )
    fold_lines = []
    for n, (station, angle) in enumerate(folds, start=1):
        at = np.array([station])
        flat = np.concatenate((first(at), second(at))) - low
        fold_lines.append(FoldLine(f"F-{n}", station, angle, flat))
    panels = [
        PanelMeasure(f"{a}/{b}", what, 500.0 + n, 500.0 + n + 1e-6, 499.9 + n)
        for a, b in zip(labels[:-1], labels[1:])
        for n, what in enumerate(("edge left", "edge right", "diagonal 1", "diagonal 2"))
    ]
    extent = np.ptp(np.concatenate(outline), axis=0)
    fields = {
        "member": member,
        "mark": mark,
        "part": mark,
        "face": "top",
        "letter": "T",
        "piece": 1,
        "thickness": 20.0,
        "material": "Q355B",
        "outline": outline,
        "lines": tuple(lines),
        "folds": tuple(fold_lines),
        "points": tuple(points),
        "panels": tuple(panels),
        "length": float(extent[0]),
        "width": float(extent[1]),
        "area": area,
        "mass": area * 20.0 * 7.85e-6,
        "volume": area * 20.0,
        "s_start": 0.0,
        "s_end": length,
        "length_error_max": 0.004,
        "length_error_rms": 0.001,
        "length_error_bound": 0.003,
        "strain_max": 2.5e-5,
        "locked_in_stress": 5.0,
        "bending_radius_min": 18000.0,
        "forming": None,
        "marking_face": "inside",
        "placing": np.eye(4),
        "flat_to_placing": np.eye(4),
    }
    return DevelopedPlate(**{**fields, **changed})


def member(name="M1", plates=(), **changed):
    """A member's record with figures within the limits."""
    fields = {
        "sections": "800x800x20 / 600x600x16",
        "section_type": "box1",
        "length": 15234.5678901234,
        "mass": 6543.21,
        "axis_to_surface_rms": 0.0012,
        "axis_to_surface_max": 0.0031,
        "torsion_error_max": 1e-6,
        "total_torsion": 0.25,
        "plates": tuple(plates),
    }
    return MemberRecord(name, **{**fields, **changed})
