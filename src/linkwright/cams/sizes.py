"""The smallest base circle with which a cam keeps its limits; offset and roller chosen with it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from linkwright.cams.loading import contact_pressure, leverage
from linkwright.cams.result import CamDesign
from linkwright.cams.shape import CamShape
from linkwright.core.arrays import Floats
from linkwright.errors import ModelError, fault
from linkwright.laws.program import Program
from linkwright.words import _

#: Base radii that are tried: first and last over the size of the lift, ratio of neighbours; offsets that are tried.
_FIRST, _LAST, _RATIO, _OFFSETS = 0.05, 400.0, 1.12, 21
#: Places of the turn for a first look; accuracy of the first look, of the offset and of the base radius.
_LOOKS = 360
_ROUGH, _OFFSET, _FINE = 1e-4, 1e-3, 1e-9


Sized = TypeVar("Sized", bound=CamShape)


def chosen(cam: Sized) -> Sized:
    """The cam with the smallest base circle that keeps its limits; raises ModelError where none does."""
    best: Sized | None = None
    program = Sampled(cam.program, _places(cam.program, _LOOKS))
    for roller in cam.choose.roller_radii or (cam.follower.roller_radius,):
        there = _with(cam, roller, cam.follower.offset)
        offset = _best_offset(there, program) if cam.choose.offset is not None else cam.follower.offset
        there = _with(cam, roller, offset)
        radius = _exactly(there, _smallest(_rule(there, program), _scale(cam)))
        if radius is not None and (best is None or radius < (best.base_radius or 0.0) - _FINE):
            best = replace(there, base_radius=radius)
    if best is None:
        raise ModelError(
            [
                fault(
                    "no_size",
                    "limits",
                    _("no base circle keeps all limits with this follower"),
                    _("widen a limit, allow other offsets or rollers, or take a smoother program"),
                )
            ]
        )
    return best


def _with(cam: Sized, roller: float, offset: float) -> Sized:
    return replace(cam, follower=replace(cam.follower, roller_radius=roller, offset=offset))


def _scale(cam: CamShape) -> float:
    """A length of the size of the cam."""
    low, high = cam.program.lifts
    follower = cam.follower
    return (high - low) * ((follower.arm or follower.pivot_distance or 1.0) if follower.oscillating else 1.0)


def _best_offset(cam: CamShape, program: Sampled) -> float:
    """The offset with the smallest base circle, from equal ones between the bounds, then between the best ones."""
    assert cam.choose.offset is not None
    low, high = cam.choose.offset
    span = high - low
    while True:
        offsets = np.linspace(low, high, _OFFSETS)
        cams = [_with(cam, cam.follower.roller_radius, e) for e in offsets.tolist()]
        radii = [_smallest(_rule(each, program), _scale(cam)) for each in cams]
        known = np.array([np.inf if each is None else each for each in radii])
        k = int(known.argmin())
        if high - low <= _OFFSET * span:
            return float(offsets[k])
        low, high = float(offsets[max(k - 1, 0)]), float(offsets[min(k + 1, _OFFSETS - 1)])


def _rule(cam: CamShape, program: Sampled) -> Callable[[float], bool]:
    """Whether a base circle keeps all limits at the places of a first look."""
    there = replace(cam, program=program)
    return lambda radius: keeps(there, radius, program.at)


def _exactly(cam: CamShape, radius: float | None) -> float | None:
    """The base radius near the one of a first look with which the limits hold between its places as well."""
    if radius is None:
        return None
    low, high = (1 - 2 * _ROUGH) * radius, radius
    for _unused in range(40):
        if _keeps_exactly(cam, high):
            break
        low, high = high, high + 2 * (high - low)
    else:
        return None
    while high - low > _FINE * high:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if _keeps_exactly(cam, middle) else (middle, high)
    return high


def _keeps_exactly(cam: CamShape, radius: float) -> bool:
    there = replace(cam, base_radius=radius)
    if there.misfit() is not None:
        return False
    design = CamDesign(there)
    rise, fall = cam.limits.angles
    smallest = design.smallest_radius
    if smallest is not None and smallest.value < (cam.limits.curvature_radius or 0.0):
        return False
    flat = abs(design.pressure_angle_rise.value) <= rise and abs(design.pressure_angle_fall.value) <= fall
    if not (flat and design.minimum_growth > 0):
        return False
    most = cam.limits.contact_pressure
    return most is None or (largest := design.largest_pressure) is None or largest.value <= most


@dataclass(frozen=True)
class Sampled(Program):
    """A program with its curves at places ``at`` (n,) at hand."""

    of: Program
    at: Floats

    @property
    def period(self) -> float:  # type: ignore[override]
        return self.of.period

    @property
    def edges(self) -> Floats:
        return self.of.edges

    @property
    def breaks(self) -> Floats:
        return self.of.breaks

    @cached_property
    def lifts(self) -> tuple[float, float]:
        return self.of.lifts

    @cached_property
    def _known(self) -> tuple[Any, Any, Any, Any]:
        return self.of.curves(self.at)

    @cached_property
    def fastest(self) -> float:
        """Largest size of the velocity."""
        return self.of.fastest

    def curves(self, x: Any) -> tuple[Any, Any, Any, Any]:
        return self._known if x is self.at else self.of.curves(x)


def _smallest(holds: Callable[[float], bool], scale: float) -> float | None:
    """The smallest radius from which on, among those tried, it holds, refined by halving."""
    low, high = _FIRST * scale, _FIRST * scale
    while not holds(high):
        low, high = high, _RATIO * high
        if high > _LAST * scale:
            return None
    while high - low > _ROUGH * high:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if holds(middle) else (middle, high)
    return high


def keeps(cam: CamShape, radius: float, phi: Floats) -> bool:
    """Whether with a base circle of ``radius`` (m) the follower fits and every limit holds at angles ``phi``."""
    there = replace(cam, base_radius=radius)
    if there.misfit() is not None:
        return False
    for curve in there.walls:
        contact = curve.contact(phi)
        limit = cam.limits.curvature_radius or 0.0
        if cam.follower.kind == "flat":
            if contact.growth.min() < max(limit, 0.0):
                return False
        elif contact.growth.min() <= 0 or (limit and contact.curvature.max() > 1.0 / limit):
            return False
        if not _angles_within(there, phi, contact.pressure_angle):
            return False
        if cam.limits.contact_pressure is not None and cam.width:
            force = there.loading.effort(cam.program, phi) / leverage(cam.follower, contact)
            pressure = contact_pressure(np.abs(force), contact, cam.follower, cam.width, cam.material)
            if pressure.max() > cam.limits.contact_pressure:
                return False
    return True


def _angles_within(cam: CamShape, phi: Floats, angle: Floats) -> bool:
    rise, fall = cam.limits.angles
    rate = cam.program.curves(phi)[1]
    moving = 1e-9 * float(np.abs(rate).max())
    return not bool((np.abs(angle[rate > moving]) > rise).any() or (np.abs(angle[rate < -moving]) > fall).any())


def _places(program: Program, looks: int) -> Floats:
    """Equal places of the turn, and those of the extremes of lift, velocity and acceleration."""
    own = [each.place for order in (0, 1, 2) for each in program.extremes(order)]
    return np.unique(np.concatenate([program.places(looks), own]))
