"""A cam's input data: its program, follower, sizes and loads; its walls, and what its spring holds."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from linkwright.cams.curves import BarrelCurve, CamCurve, FlatCurve, RollerCurve
from linkwright.cams.fields import CAM_FIELDS, CamChoice, CamConjugate, CamElasticity, CamLimits
from linkwright.cams.follower import Follower
from linkwright.cams.loading import CamLoading, CamMaterial
from linkwright.core.arrays import Floats
from linkwright.errors import Finding, fault
from linkwright.fields.base import FileKeys
from linkwright.laws.program import Program
from linkwright.parts.base import Problem
from linkwright.words import _


@dataclass(frozen=True)
class Mirrored(Program):
    """The lift that a second follower on the other side makes: the largest lift less the first one's."""

    of: Program
    largest: float

    @property
    def period(self) -> float:  # type: ignore[override]
        return self.of.period

    @property
    def edges(self) -> Any:
        return self.of.edges

    @property
    def breaks(self) -> Any:
        return self.of.breaks

    def curves(self, x: Any) -> tuple[Any, Any, Any, Any]:
        s, v, a, j = self.of.curves(x)
        return self.largest - s, -v, -a, -j


@dataclass(frozen=True)
class CamShape(Problem):
    """Input data of a cam: see ``Cam``."""

    kind: ClassVar[str] = "cam"
    fields = FileKeys(CAM_FIELDS)
    program: Program
    follower: Follower = field(default_factory=Follower)
    base_radius: float | None = None
    turn: float = 1.0
    closure: str = "force"
    barrel_radius: float | None = None
    conjugate: CamConjugate | None = None
    loading: CamLoading = field(default_factory=CamLoading)
    spring_wanted: bool = False
    width: float | None = None
    material: CamMaterial = field(default_factory=CamMaterial)
    elasticity: CamElasticity | None = None
    limits: CamLimits = field(default_factory=CamLimits)
    choose: CamChoice = field(default_factory=CamChoice)
    cutter_radius: float | None = None
    name: str = ""
    source: str = ""

    @property
    def walls(self) -> tuple[CamCurve, ...]:
        """The walls that the follower touches: one, or both of a groove, or those of a pair."""
        follower = self.follower
        if self.barrel_radius is not None:
            base = (self.program, follower, 0.0, 1.0)
            return tuple(BarrelCurve(*base, outer, self.barrel_radius) for outer in (False, True))
        assert self.base_radius is not None
        if follower.kind == "flat":
            return (FlatCurve(self.program, follower, self.base_radius, self.turn),)
        walls = [RollerCurve(self.program, follower, self.base_radius, self.turn)]
        if self.closure == "groove":
            walls.append(RollerCurve(self.program, follower, self.base_radius, self.turn, True))
        if self.conjugate is not None:
            walls.append(self._second(self.conjugate))
        return tuple(walls)

    def _second(self, pair: CamConjugate) -> RollerCurve:
        """The wall of the second cam; of a translating pair in axes turned by half a turn."""
        mirrored = Mirrored(self.program, self.program.lifts[1])
        return RollerCurve(mirrored, self._other_follower(pair), pair.base_radius, self.turn)

    def _other_follower(self, pair: CamConjugate) -> Follower:
        if not self.follower.oscillating:
            return replace(self.follower, offset=-pair.offset)
        return replace(self.follower, below=not self.follower.below, arm=pair.arm or self.follower.arm)

    def misfit(self) -> Finding | None:
        """Why the follower cannot be where the program sends it, None where it can."""
        if self.barrel_radius is not None:
            return None
        assert self.base_radius is not None
        low, high = self.program.lifts
        found = self._reach(self.follower, self.base_radius, low, high, "follower")
        if found is None and self.conjugate is not None:
            other, radius = self._other_follower(self.conjugate), self.conjugate.base_radius
            found = self._reach(other, radius, 0.0, high - low, "conjugate")
        return found

    def _reach(self, follower: Follower, radius: float, low: float, high: float, key: str) -> Finding | None:
        """Why a follower on a base circle cannot be at all lifts, None where it can."""
        if not follower.oscillating:
            height = follower.start_height(radius)
            if height is None or height + low <= 0:
                return fault(
                    "offset",
                    key,
                    _(
                        "with an offset of {offset} mm and a base circle of {radius} mm the follower does "
                        "not reach the cam at every lift"
                    ),
                    _("take a smaller offset or a larger base circle, or lifts that do not go below the base circle"),
                    offset=1e3 * follower.offset,
                    radius=1e3 * radius,
                )
            return None
        start = follower.start_angle(radius)
        largest = math.pi / 2 if follower.kind == "flat" else math.pi
        if start is None or start + low <= 0 or start + high >= largest:
            return fault(
                "arm_reach",
                key,
                _("with a base circle of {radius} mm the oscillating follower does not reach the cam at every lift"),
                _("change arm, pivot distance or base circle so that the triangle of centre, pivot and arm closes"),
                radius=1e3 * radius,
            )
        if follower.kind == "flat" and self.program.fastest >= 1:
            return fault(
                "too_fast",
                "program",
                _("the flat face turns {rate} times as fast as the cam at its fastest: nothing envelops it"),
                _("let it rise less or over a larger angle"),
                rate=self.program.fastest,
            )
        return None

    @cached_property
    def loaded(self) -> CamLoading:
        """The loading with its spring, chosen where it is wanted and not set."""
        if not self.spring_wanted or self.closure != "force":
            return self.loading
        return self.loading.with_spring(self.program, self.tried, self.limits.contact_force)

    @property
    def tried(self) -> Floats:
        """Places at which the contact is looked at, rad: both sides of every edge of the program among them."""
        program = self.program
        return np.sort(np.append(program.places(2880), np.nextafter(program.edges[1:], 0.0)))
