# SPDX-License-Identifier: LGPL-2.1-or-later
"""Outlines of all plates in one file, for a later build to compare with: what would be cut."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Iterable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from BendTorsionWB.core.lofting import DevelopedPlate
from BendTorsionWB.core.patterns.gross import as_cut
from BendTorsionWB.exchange.whole_file import write_changed


@dataclass(frozen=True, eq=False)
class CutOutline:
    """A plate as it is cut. outline (n, 2) and holes, each (k, 2), in the pattern frame, mm;
    end_first: the line E-2 lies at the lower u."""

    mark: str
    member: str
    thickness: float
    material: str
    length: float
    width: float
    mass: float
    end_first: bool
    outline: np.ndarray
    holes: tuple[np.ndarray, ...] = ()


def cut_outline(plate: DevelopedPlate) -> CutOutline:
    """The outline of a developed plate, allowances included."""
    cut = as_cut(plate)
    ends = {
        line.label: float(line.flat[:, 0].mean())
        for line in cut.lines
        if line.label in ("E-1", "E-2")
    }
    return CutOutline(
        plate.mark,
        plate.member,
        float(plate.thickness),
        plate.material,
        float(cut.length),
        float(cut.width),
        float(cut.mass),
        ends.get("E-1", 0.0) > ends.get("E-2", 1.0),
        _closed(cut.outline),
        tuple(_closed(hole.runs) for hole in cut.holes),
    )


def _closed(runs) -> np.ndarray:
    """Runs head to tail as one closed polygon, each point once."""
    runs = [np.asarray(run, float) for run in (runs if isinstance(runs, tuple) else (runs,))]
    points = np.vstack([run[:-1] if len(run) > 1 else run for run in runs])
    step = np.empty_like(points)
    step[0], step[1:] = points[0] - points[-1], points[1:] - points[:-1]
    return points[np.hypot(step[:, 0], step[:, 1]) > 1e-9]


def write_outlines(plates: Iterable[CutOutline], path: Path) -> None:
    """Keep outlines. Raises BendTorsionError."""
    write_changed(path, outlines_bytes(plates))


def start_packing(plates: Iterable[CutOutline]) -> Future[bytes]:
    """Have `outlines_bytes` made in a thread: while it packs it leaves Python to others."""
    thread = ThreadPoolExecutor(1)
    try:
        return thread.submit(outlines_bytes, list(plates))
    finally:
        thread.shutdown(wait=False)


def outlines_bytes(plates: Iterable[CutOutline]) -> bytes:
    """The file of these outlines; the same plates give the same bytes."""
    plates = list(plates)
    rings = [ring for plate in plates for ring in (plate.outline, *plate.holes)]
    figures = [[p.thickness, p.length, p.width, p.mass, p.end_first] for p in plates]
    kept = {
        "marks": np.array([plate.mark for plate in plates], dtype=str),
        "members": np.array([plate.member for plate in plates], dtype=str),
        "materials": np.array([plate.material for plate in plates], dtype=str),
        "figures": np.array(figures, float).reshape(-1, 5),
        "rings": np.array([1 + len(plate.holes) for plate in plates], int),
        "counts": np.array([len(ring) for ring in rings], int),
        "points": np.vstack([*rings, np.zeros((0, 2))]),
    }
    stream = io.BytesIO()
    # Packed lightly: coordinates hardly become smaller, however long one tries.
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as file:
        for name, values in kept.items():
            with file.open(f"{name}.npy", "w", force_zip64=True) as part:
                np.lib.format.write_array(part, values, allow_pickle=False)
    return stream.getvalue()


def read_outlines(path: Path) -> Mapping[str, CutOutline]:
    """The outlines of a file by mark; none when it is missing or damaged."""
    try:
        with np.load(path, allow_pickle=False) as held:
            data = {name: held[name] for name in held.files}
        rings = iter(np.split(data["points"], np.cumsum(data["counts"])[:-1]))
        found = {}
        for mark, member, material, figures, count in zip(
            data["marks"].tolist(),
            data["members"].tolist(),
            data["materials"].tolist(),
            data["figures"].tolist(),
            data["rings"].tolist(),
        ):
            outline, *holes = [next(rings) for _ in range(count)]
            thickness, length, width, mass, end_first = figures
            found[mark] = CutOutline(
                mark,
                member,
                thickness,
                material,
                length,
                width,
                mass,
                bool(end_first),
                outline,
                tuple(holes),
            )
        return found
    except (OSError, ValueError, KeyError, EOFError, StopIteration, zipfile.BadZipFile):
        return {}
