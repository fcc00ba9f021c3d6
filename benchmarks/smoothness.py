# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curvature along an axis before and after refinement (the paper's figure 3), as data and plots.

Writes one CSV per curve to build/smoothness, and SVG plots of the three hardest to docs/images.
"""

import csv
import sys
from html import escape
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from exact_axes import curves  # noqa: E402

from BendTorsionWB.core.axes.axis import fit_axis  # noqa: E402
from BendTorsionWB.core.axes.axis_smoothness import smoothness  # noqa: E402

DATA, IMAGES = ROOT / "build" / "smoothness", ROOT / "docs" / "images"
COUNT, RATIO = 15, 10.0
WIDE, HIGH = 760, 340
LEFT, RIGHT, TOP, BOTTOM = 62, 16, 44, 46


def main():
    DATA.mkdir(parents=True, exist_ok=True)
    IMAGES.mkdir(parents=True, exist_ok=True)
    print(
        f"{COUNT} irregular exact points (rings {COUNT + 10}), gaps up to 1:{RATIO:.0f}; "
        "curvature against the exact "
        "one, RMS, 1e-6/mm; distance to the surface, RMS, mm"
    )
    print(
        f"{'curve':9}{'length m':>9}{'largest':>9}{'polygon':>10}{'before':>10}{'after':>10}"
        f"{'before mm':>12}{'after mm':>12}"
    )
    found = []
    for name, curve in curves().items():
        points = curve.points(COUNT + 10 * curve.closed, 11, RATIO)
        axis = fit_axis(name, points, curve.surface, closed=curve.closed)
        bare = fit_axis(name, points, curve.surface, fit="keep", closed=curve.closed)
        data, exact = smoothness(axis), curve.axis()
        truth = np.linalg.norm(exact.curvature(data.after * exact.length / axis.length), axis=1)
        rows = _resampled(data, axis.length)
        errors = [np.sqrt(np.mean((row - truth) ** 2)) * 1e6 for row in rows]
        at_points = np.interp(data.polygon, data.after, truth)
        polygon = np.sqrt(np.mean((data.polygon_curvature - at_points) ** 2)) * 1e6
        off = [each.distance_to(curve.surface)[0] for each in (bare, axis)]
        print(
            f"{name:9}{axis.length / 1e3:9.1f}{truth.max() * 1e6:9.1f}{polygon:10.2f}"
            f"{errors[0]:10.2f}{errors[1]:10.2f}{off[0]:12.4f}{off[1]:12.4f}"
        )
        _write_csv(DATA / f"{name}.csv", data.after, rows, truth)
        found.append((errors[0] / max(truth.max() * 1e6, 1.0), name, data, rows, truth))
    for old in IMAGES.glob("smoothness-*.svg"):
        old.unlink()
    for _, name, data, rows, truth in sorted(found, key=lambda item: -item[0])[:3]:
        path = IMAGES / f"smoothness-{name}.svg"
        path.write_text(_plot(name, data, rows, truth), encoding="utf-8")
        print(f"wrote {path.relative_to(ROOT)}")


def _resampled(data, length):
    """Curvature before and after, both at the stations of the axis after."""
    before = np.interp(data.after, data.before * length / data.before[-1], data.before_curvature)
    return before, data.after_curvature


def _write_csv(path, s, rows, truth):
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["s_mm", "before_per_m", "after_per_m", "exact_per_m"])
        for values in zip(s, *rows, truth, strict=True):
            writer.writerow([f"{values[0]:.3f}", *(f"{1000 * value:.9f}" for value in values[1:])])


def _plot(name, data, rows, truth):
    """The curvature plot of one axis as SVG text."""
    s, top = data.after, 1.15 * 1000 * max(rows[0].max(), truth.max(), rows[1].max())
    width, height = WIDE - LEFT - RIGHT, HIGH - TOP - BOTTOM

    def spot(x, y):
        return f"{LEFT + x / s[-1] * width:.2f},{TOP + (1 - min(1000 * y / top, 1)) * height:.2f}"

    def line(values, style):
        points = " ".join(spot(x, y) for x, y in zip(s, values, strict=True))
        return f'<polyline points="{points}" fill="none" {style}/>'

    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDE} {HIGH}" width="{WIDE}" '
        f'height="{HIGH}" font-family="sans-serif" font-size="12">',
        f'<rect width="{WIDE}" height="{HIGH}" fill="white"/>',
        f'<text x="{LEFT}" y="18" font-size="14">Curvature along {escape(name)}: given '
        "points, before and after refinement</text>",
    ]
    for k in range(6):
        x, y = s[-1] * k / 5, top * k / 5
        sx = LEFT + width * k / 5
        sy = TOP + height * (1 - k / 5)
        parts += [
            f'<path d="M{LEFT} {sy:.1f}H{WIDE - RIGHT}M{sx:.1f} {TOP}V{HIGH - BOTTOM}" '
            'stroke="#ddd" fill="none"/>',
            f'<text x="{LEFT - 6}" y="{sy + 4:.1f}" text-anchor="end">{y:.3f}</text>',
            f'<text x="{sx:.1f}" y="{HIGH - BOTTOM + 16}" text-anchor="middle">{x / 1000:.1f}'
            "</text>",
        ]
    parts += [
        f'<text x="{LEFT + width / 2:.0f}" y="{HIGH - 8}" text-anchor="middle">arc length, m'
        "</text>",
        f'<text transform="translate(14 {TOP + height / 2:.0f}) rotate(-90)" '
        'text-anchor="middle">curvature, 1/m</text>',
        line(rows[0], 'stroke="#d2691e" stroke-width="1.4"'),
        line(rows[1], 'stroke="#1f5fa8" stroke-width="2"'),
        line(truth, 'stroke="black" stroke-width="1" stroke-dasharray="5 4"'),
    ]
    scale = s[-1] / data.before[-1]
    for x, y in zip(data.polygon * scale, data.polygon_curvature, strict=True):
        px, py = spot(x, y).split(",")
        parts.append(f'<circle cx="{px}" cy="{py}" r="3" fill="none" stroke="#666"/>')
    legend = (
        ("#d2691e", "", "before: through the points"),
        ("#1f5fa8", "", "after: on the surface"),
        ("black", "5 4", "exact"),
    )
    for k, (colour, dash, text) in enumerate(legend):
        x = LEFT + 10 + 200 * k
        parts += [
            f'<path d="M{x} {TOP - 10}h26" stroke="{colour}" stroke-width="2" '
            f'stroke-dasharray="{dash or "none"}"/>',
            f'<text x="{x + 32}" y="{TOP - 6}">{text}</text>',
        ]
    parts.append(
        f'<circle cx="{LEFT + 560}" cy="{TOP - 10}" r="3" fill="none" stroke="#666"/>'
        f'<text x="{LEFT + 570}" y="{TOP - 6}">points alone</text>'
    )
    return "\n".join([*parts, "</svg>", ""])


if __name__ == "__main__":
    main()
