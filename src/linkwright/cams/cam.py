"""A cam as a calculation: its program, follower, sizes and loads, from a file or from code."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from linkwright.cams.curves import CamCurve
from linkwright.cams.fields import CamLimits, program_of
from linkwright.cams.loading import leverage
from linkwright.cams.result import CamDesign
from linkwright.cams.shape import CamShape
from linkwright.cams.sizes import chosen
from linkwright.cams.undercut import undercuts
from linkwright.core.dataclass import dataclass
from linkwright.core.search import first_largest
from linkwright.errors import Finding, ModelError
from linkwright.parts.base import fault


@dataclass(frozen=True)
class Cam(CamShape):
    """A cam that moves its follower by a program; lengths in m, angles in rad, forces in N.

    ``base_radius``: left out, the smallest that keeps the ``limits`` is chosen, with what ``choose`` allows.
    ``turn``: +1 counter-clockwise. ``closure``: ``force`` (a spring holds the contact), ``groove`` (the roller runs
    between two walls), ``conjugate`` (a second cam and follower). ``barrel_radius``: a groove around a cylinder,
    unrolled. ``loading`` with speed, mass, load and spring (oscillating: inertia, torques); ``width`` of the contact
    and ``material`` for Hertz's pressure; ``elasticity`` for its vibration.
    """

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

    def _contact_lost(self) -> list[Finding]:
        """Where a given spring does not hold the contact."""
        loading = self.loaded
        unloaded = not loading.mass and not loading.load and loading.spring.preload is None
        if self.closure != "force" or self.barrel_radius is not None or unloaded:
            return []
        phi = self.tried
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
