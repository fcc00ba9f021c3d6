# SPDX-License-Identifier: LGPL-2.1-or-later
"""Surfaces members lie on: the closest point, its outward normal and the signed distance."""

from __future__ import annotations

import hashlib
import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, fields, is_dataclass

import numpy as np

from ..finding import BendTorsionError, Finding, error
from .ellipsoid import ellipsoid_feet

# A foot point is ambiguous when the point is nearer than this, relative to the surface's size, to
# the places that have several feet (centre, axis, middle plane).
AMBIGUITY = 1e-9


@dataclass(frozen=True, eq=False)
class Foot:
    """Closest points of a surface.

    points (n, 3) mm; normals (n, 3) unit, outward; distance (n,) mm from the foot to the given
    point, positive outwards; ambiguous (n,) bool: other feet are as near, or the surface has no
    single normal there; outside (n,) bool: the foot is on the border and the given point lies
    beyond it.
    """

    points: np.ndarray
    normals: np.ndarray
    distance: np.ndarray
    ambiguous: np.ndarray
    outside: np.ndarray


class Surface(ABC):
    """What all surfaces share: `closest(points (n, 3)) -> Foot` and a content `key`."""

    @abstractmethod
    def closest(self, points: np.ndarray) -> Foot:
        """Closest points to points (n, 3) mm."""

    @property
    def offset_range(self) -> tuple[float, float]:
        """Offsets (mm) along the outward normals between which the surface stays regular."""
        return -math.inf, math.inf

    @property
    def key(self) -> str:
        """Hash of kind and numbers; equal surfaces have equal keys in every process."""
        return hashlib.sha256(_content(self)).hexdigest()


def _content(value) -> bytes:
    if is_dataclass(value):
        parts = [_content(getattr(value, field.name)) for field in fields(value)]
        return type(value).__name__.encode() + b"(" + b",".join(parts) + b")"
    if isinstance(value, np.ndarray):
        return repr((value.shape, value.dtype.str)).encode() + value.tobytes()
    if isinstance(value, tuple):
        return b"(" + b",".join(_content(item) for item in value) + b")"
    if isinstance(value, (int, float)):
        return float(value).hex().encode()
    if value is None:
        return b"None"
    # A value left out here would give different surfaces one key.
    raise TypeError(f"no content hash for {type(value).__name__}")


@dataclass(frozen=True)
class Plane(Surface):
    """The horizontal plane through `origin`, normal +z."""

    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def closest(self, points: np.ndarray) -> Foot:
        local = _local(points, self.origin)
        feet = local * [1.0, 1.0, 0.0]
        normals = np.broadcast_to([0.0, 0.0, 1.0], local.shape).copy()
        return _foot(self.origin, local, feet, normals, np.zeros(len(local), bool))


@dataclass(frozen=True)
class _Round(Surface):
    """Of radius r about `origin`: offset inwards by less than r."""

    r: float
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @property
    def offset_range(self) -> tuple[float, float]:
        return -self.r, math.inf


@dataclass(frozen=True)
class Sphere(_Round):
    """A sphere of radius r about `origin`."""

    def closest(self, points: np.ndarray) -> Foot:
        local = _local(points, self.origin)
        normals, length = _directions(local, [0.0, 0.0, 1.0])
        ambiguous = length <= AMBIGUITY * self.r
        return _foot(self.origin, local, self.r * normals, normals, ambiguous)


@dataclass(frozen=True)
class Cylinder(_Round):
    """An endless cylinder of radius r about the vertical through `origin`."""

    def closest(self, points: np.ndarray) -> Foot:
        local = _local(points, self.origin)
        normals, rho = _radial(local)
        feet = self.r * normals
        feet[:, 2] = local[:, 2]
        return _foot(self.origin, local, feet, normals, rho <= AMBIGUITY * self.r)


@dataclass(frozen=True)
class Cone(Surface):
    """One nappe of a cone about the vertical through `origin`.

    r: radius at the height of the origin. angle: half-angle in radians between axis and ruling;
    positive when the cone widens upwards, negative when it narrows upwards. The apex and whatever
    lies beyond it is ambiguous: the foot is the apex, which has no single normal.
    """

    r: float
    angle: float
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @property
    def offset_range(self) -> tuple[float, float]:
        # Where z = 0: towards the apex any offset inwards meets the axis.
        return -self.r / math.cos(self.angle), math.inf

    def closest(self, points: np.ndarray) -> Foot:
        local = _local(points, self.origin)
        outward, rho = _radial(local)
        sine, cosine = math.sin(abs(self.angle)), math.cos(self.angle)
        upward = math.copysign(1.0, self.angle)
        # In the meridian plane, measured from the point of the ruling at z = 0: cancellation at a
        # far apex (slender cones) is avoided.
        along = (rho - self.r) * sine + upward * local[:, 2] * cosine
        apex_along = -self.r / sine
        beyond = along <= apex_along * (1 - AMBIGUITY)
        along = np.maximum(along, apex_along)
        radius = np.where(along == apex_along, 0.0, self.r + along * sine)
        feet = radius[:, None] * outward
        feet[:, 2] = upward * along * cosine
        normals = cosine * outward
        normals[:, 2] = -upward * sine
        if beyond.any():
            normals[beyond] = _directions(
                local[beyond] - [0.0, 0.0, upward * apex_along * cosine], [0.0, 0.0, -upward]
            )[0]
        ambiguous = beyond | (rho <= AMBIGUITY * np.maximum(radius, self.r))
        return _foot(self.origin, local, feet, normals, ambiguous)


@dataclass(frozen=True)
class Torus(Surface):
    """A ring torus about the vertical through `origin`: R to the tube's centre, r of the tube."""

    R: float
    r: float
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @property
    def offset_range(self) -> tuple[float, float]:
        return -self.r, self.R - self.r

    def closest(self, points: np.ndarray) -> Foot:
        local = _local(points, self.origin)
        outward, rho = _radial(local)
        tube = local - self.R * outward
        normals, length = _directions(tube, [1.0, 0.0, 0.0])
        centre = length <= AMBIGUITY * self.r
        normals[centre] = outward[centre]
        feet = self.R * outward + self.r * normals
        ambiguous = centre | (rho <= AMBIGUITY * self.R)
        return _foot(self.origin, local, feet, normals, ambiguous)


@dataclass(frozen=True)
class Ellipsoid(Surface):
    """An ellipsoid with half-axes a, b, c along x, y, z about `origin`."""

    a: float
    b: float
    c: float
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @property
    def offset_range(self) -> tuple[float, float]:
        axes = (self.a, self.b, self.c)
        return -(min(axes) ** 2) / max(axes), math.inf

    def closest(self, points: np.ndarray) -> Foot:
        local = _local(points, self.origin)
        axes = np.array([self.a, self.b, self.c])
        unit, root = ellipsoid_feet(local, axes)
        normals = _directions(unit / axes, [0.0, 0.0, 1.0])[0]
        ambiguous = root <= AMBIGUITY * axes.min() ** 2
        return _foot(self.origin, local, unit * axes, normals, ambiguous)


@dataclass(frozen=True)
class Offset(Surface):
    """`surface` moved by `distance` mm along its outward normals, which it keeps.

    The foot is the foot on `surface`, moved. That is the closest point as long as the distance is
    below the radii of curvature on its side.
    """

    surface: Surface
    distance: float

    def closest(self, points: np.ndarray) -> Foot:
        foot = self.surface.closest(points)
        return Foot(
            foot.points + self.distance * foot.normals,
            foot.normals,
            foot.distance - self.distance,
            foot.ambiguous,
            foot.outside,
        )


@dataclass(frozen=True)
class Flipped(Surface):
    """`surface` with its outward side reversed."""

    surface: Surface

    def closest(self, points: np.ndarray) -> Foot:
        foot = self.surface.closest(points)
        return Foot(foot.points, -foot.normals, -foot.distance, foot.ambiguous, foot.outside)


KINDS: dict[str, type[Surface]] = {
    "ellipsoid": Ellipsoid,
    "sphere": Sphere,
    "cylinder": Cylinder,
    "cone": Cone,
    "torus": Torus,
    "plane": Plane,
}


def parameter_names(kind: str) -> tuple[str, ...]:
    """Names of the parameters an analytic kind needs, in their usual order."""
    return tuple(field.name for field in fields(KINDS[kind]) if field.name != "origin")


def analytic_surface(
    kind: str,
    parameters: Mapping[str, float],
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0),
    offset: float = 0.0,
    flip: bool = False,
    object: str = "surface",
) -> Surface:
    """The surface of an analytic kind at `origin`, flipped, then offset along its outward side.

    parameters: ellipsoid a b c, sphere r, cylinder r, cone r angle (radians), torus R r, plane
    none; lengths in mm. A positive offset follows the outward side after `flip`. object: name used
    in findings. Raises BendTorsionError for an unknown kind, missing, unknown, non-finite or
    non-positive parameters, and an offset beyond the radius of curvature.
    """
    if kind not in KINDS:
        raise BendTorsionError(
            error(
                "surface-kind",
                object,
                f"no surface kind {kind!r}",
                f"use {', '.join(KINDS)}",
                value=str(kind),
            )
        )
    names = parameter_names(kind)
    usual = " ".join(f"{name}=" for name in names) or "no parameters"
    findings = [
        error(
            "surface-parameter",
            object,
            f"a {kind} has no parameter {name!r}",
            f"give {usual}",
            position=str(name),
        )
        for name in parameters
        if name not in names
    ]
    findings += [
        error(
            "surface-parameter",
            object,
            f"parameter {name} of the {kind} is missing",
            f"give {usual}",
            position=name,
        )
        for name in names
        if name not in parameters
    ]
    numbers: dict[str, float] = {}
    for name in names:
        if name in parameters:
            numbers[name] = _number(parameters[name], name, object, findings)
    place = tuple(
        _number(value, axis, object, findings) for axis, value in zip("xyz", origin, strict=True)
    )
    shift = _number(offset, "offset", object, findings)
    if not findings:
        findings += _improper(kind, numbers, object)
    if findings:
        raise BendTorsionError(findings)
    plain = KINDS[kind](**numbers, origin=place)
    surface: Surface = Flipped(plain) if flip else plain
    if shift == 0.0:
        return surface
    low, high = plain.offset_range
    if flip:
        low, high = -high, -low
    if not low < shift < high:
        raise BendTorsionError(
            error(
                "surface-offset",
                object,
                "the offset reaches the surface's centre of curvature",
                "use a smaller offset",
                position="offset",
                value=shift,
                limit=low if shift <= low else high,
                unit="mm",
            )
        )
    return Offset(surface, shift)


def _number(value, name: str, object: str, findings: list[Finding]) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        findings.append(
            error(
                "surface-parameter",
                object,
                f"{name} is not a finite number",
                "give a number",
                position=name,
                value=str(value),
            )
        )
    return number


def _improper(kind: str, numbers: Mapping[str, float], object: str) -> list[Finding]:
    """Findings for numbers that describe no surface of this kind."""
    findings = [
        error(
            "surface-parameter",
            object,
            f"{name} of the {kind} must be greater than 0",
            "give a positive length",
            position=name,
            value=value,
            limit=0.0,
            unit="mm",
        )
        for name, value in numbers.items()
        if name != "angle" and value <= 0
    ]
    angle = numbers.get("angle")
    if angle is not None and not 0 < abs(angle) < math.pi / 2:
        findings.append(
            error(
                "surface-parameter",
                object,
                "the cone's half-angle must lie between 0° and 90°",
                "use a cylinder for 0°, a plane for 90°; below 0 the cone narrows upwards",
                position="angle",
                value=math.degrees(angle),
                limit=90.0,
                unit="°",
            )
        )
    if kind == "torus" and not findings and numbers["R"] <= numbers["r"]:
        findings.append(
            error(
                "surface-parameter",
                object,
                "R of the torus must be greater than r",
                "R is the radius to the tube's centre",
                position="R",
                value=numbers["R"],
                limit=numbers["r"],
                unit="mm",
            )
        )
    return findings


def _local(points: np.ndarray, origin: tuple[float, float, float]) -> np.ndarray:
    return np.asarray(points, float).reshape(-1, 3) - np.asarray(origin, float)


def _directions(vectors: np.ndarray, fallback: list[float]) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors and lengths; zero vectors give the fallback."""
    length = np.sqrt((vectors**2).sum(1))
    unit = np.empty_like(vectors)
    unit[:] = fallback
    np.divide(vectors, length[:, None], out=unit, where=length[:, None] > 0)
    return unit, length


def _radial(local: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors away from the z axis and distances to it."""
    return _directions(local * [1.0, 1.0, 0.0], [1.0, 0.0, 0.0])


def _foot(origin, local, feet, normals, ambiguous) -> Foot:
    distance = ((local - feet) * normals).sum(1)
    return Foot(
        feet + np.asarray(origin, float), normals, distance, ambiguous, np.zeros(len(feet), bool)
    )
