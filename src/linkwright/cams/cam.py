"""A cam as a calculation: its program, follower, sizes and loads, from a file or from code."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import field, replace
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from linkwright.cams.curves import BarrelCurve, CamCurve, FlatCurve, RollerCurve
from linkwright.cams.fields import CAM_FIELDS, CamConjugate, CamElasticity, CamLimits, program_of
from linkwright.cams.follower import Follower
from linkwright.cams.loading import CamLoading, CamMaterial, leverage
from linkwright.cams.result import CamDesign
from linkwright.cams.sizes import CamChoice, chosen
from linkwright.cams.undercut import undercuts
from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.search import first_largest
from linkwright.errors import Finding, ModelError
from linkwright.fields.base import GivenByFile
from linkwright.laws.program import Program
from linkwright.parts.base import Problem, fault


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
class Cam(Problem):
    """A cam that moves its follower by a program; lengths in m, angles in rad, forces in N.

    ``base_radius``: left out, the smallest that keeps the ``limits`` is chosen, with what ``choose`` allows.
    ``turn``: +1 counter-clockwise. ``closure``: ``force`` (a spring holds the contact), ``groove`` (the roller runs
    between two walls), ``conjugate`` (a second cam and follower). ``barrel_radius``: a groove around a cylinder,
    unrolled. ``loading`` with speed, mass, load and spring (oscillating: inertia, torques); ``width`` of the contact
    and ``material`` for Hertz's pressure; ``elasticity`` for its vibration.
    """

    kind: ClassVar[str] = "cam"
    fields = GivenByFile(CAM_FIELDS)
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

    @classmethod
    def of_file(cls, values: Mapping[str, Any], folder: Path) -> Cam:
        return cls(**program_of(values))

    def solve(self) -> CamDesign:
        """The cam, with sizes and spring chosen where they are left out. Raises ModelError with all findings."""
        self.require()
        return CamDesign(self.sized)

    @cached_property
    def sized(self) -> Cam:
        """The same cam with its base circle, raises ModelError where none keeps the limits."""
        return self if self.base_radius is not None or self.barrel_radius is not None else chosen(self)

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

    # what can be wrong --------------------------------------------------------------------
    def findings(self) -> list[Finding]:
        found = self._incomplete()
        if found:
            return found
        try:
            there = self.sized
        except ModelError as error:
            return list(error.findings)
        misfit = there.misfit()
        if misfit is not None:
            return [misfit]
        return [*there._cut_away(), *there._contact_lost()]

    def _incomplete(self) -> list[Finding]:
        follower, found = self.follower, []
        if self.base_radius is not None and not self.base_radius > 0:
            found.append(fault("cams.base_negative", "base_radius", radius=1e3 * self.base_radius))
        if follower.kind == "roller" and not follower.roller_radius > 0 and not self.choose.roller_radii:
            found.append(fault("cams.no_roller", "follower"))
        if follower.oscillating and (
            not (follower.pivot_distance or 0) > 0
            or (follower.kind != "flat" and not (follower.arm or 0) > 0)
        ):
            found.append(fault("cams.no_arm", "follower"))
        if self.barrel_radius is not None and (follower.oscillating or follower.kind != "roller"):
            found.append(fault("cams.barrel_follower", "follower"))
        if self.closure != "force" and follower.kind != "roller":
            found.append(fault("cams.closure_follower", "closure", closure=self.closure))
        if (self.closure == "conjugate") != (self.conjugate is not None):
            found.append(fault("cams.conjugate", "closure"))
        if self.base_radius is None and self.barrel_radius is None and self.limits == CamLimits():
            found.append(fault("cams.no_base", "base_radius"))
        elif self.base_radius is None and self.barrel_radius is None and not np.ptp(self.program.lifts):
            found.append(fault("cams.nothing_moves", "program"))
        return found

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
                return fault("cams.offset", key, offset=1e3 * follower.offset, radius=1e3 * radius)
            return None
        start = follower.start_angle(radius)
        largest = math.pi / 2 if follower.kind == "flat" else math.pi
        if start is None or start + low <= 0 or start + high >= largest:
            return fault("cams.arm_reach", key, radius=1e3 * radius)
        if follower.kind == "flat" and self.program.fastest >= 1:
            return fault("cams.too_fast", "program", rate=self.program.fastest)
        return None

    def _cut_away(self) -> list[Finding]:
        """Undercut, with its place and what avoids it."""
        found = []
        for wall in self.walls:
            for each in undercuts(wall):
                places = {"start": math.degrees(each.start), "end": math.degrees(each.end) % 360}
                depth = 1e3 * each.depth
                if self.follower.kind == "flat":
                    more = -float(wall.contact(np.linspace(each.start, each.end, 201)).growth.min())
                    found.append(
                        fault("cams.undercut_flat", "base_radius", **places, depth=depth, more=1e3 * more)
                    )
                    continue
                radius = self._tightest(wall, each.start, each.end)
                key = "choose" if self.choose.roller_radii else "follower.roller_radius"
                roller = 1e3 * self.follower.roller_radius
                found.append(
                    fault("cams.undercut", key, **places, depth=depth, roller=roller, radius=1e3 * radius)
                )
        return found

    def _tightest(self, wall: CamCurve, start: float, end: float) -> float:
        """Smallest radius of curvature of the pitch curve there, m."""
        contact = wall.contact(np.linspace(start, end, 801))
        bend = (1.0 - contact.growth) / self.follower.roller_radius
        return 1.0 / max(float(bend.max()), 1e-12)

    @cached_property
    def loaded(self) -> CamLoading:
        """The loading with its spring, chosen where it is wanted and not given."""
        if not self.spring_wanted or self.closure != "force":
            return self.loading
        return self.loading.with_spring(self.program, self._tried, self.limits.contact_force)

    @property
    def _tried(self) -> Floats:
        """Places at which the contact is looked at, rad: both sides of every edge of the program among them."""
        program = self.program
        return np.sort(np.append(program.places(2880), np.nextafter(program.edges[1:], 0.0)))

    def _contact_lost(self) -> list[Finding]:
        """Where a given spring does not hold the contact."""
        loading = self.loaded
        unloaded = not loading.mass and not loading.load and loading.spring.preload is None
        if self.closure != "force" or self.barrel_radius is not None or unloaded:
            return []
        phi = self._tried
        effort = loading.effort(self.program, phi)
        k = first_largest(-effort)
        size = float(np.abs(effort).max())
        if effort[k] >= -1e-9 * size:
            lever = leverage(self.follower, self.walls[0].contact(phi))
            if lever.min() > 0:
                return []
            worst = phi[first_largest(-lever)]
            return [fault("cams.jam", "limits", place=math.degrees(float(worst)))]
        values = {"place": math.degrees(float(phi[k])), "missing": -float(effort[k])}
        unit = "N·m" if self.follower.oscillating else "N"
        return [fault("cams.contact_lost", "spring", **values, unit=unit)]
