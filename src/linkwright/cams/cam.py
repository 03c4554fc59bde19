"""A cam as a calculation, with its program, follower, sizes and loads, from a file, from code or from a mechanism."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from linkwright.cams.curves import CamCurve, undercuts
from linkwright.cams.follower import Follower
from linkwright.cams.loading import CamLoading, leverage
from linkwright.cams.result import CamDesign
from linkwright.cams.shape import CamLimits, CamShape, program_of
from linkwright.cams.sizes import chosen
from linkwright.core.arrays import Floats
from linkwright.core.search import first_largest
from linkwright.errors import Finding, ModelError, fault
from linkwright.joints.cam import CamJoint
from linkwright.laws.program import TURN, Program
from linkwright.laws.traced import LiftCurve
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _


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
            found.append(
                fault(
                    "base_negative",
                    "base_radius",
                    _("the base circle has a radius of {radius} mm"),
                    _("give one above zero"),
                    radius=1e3 * self.base_radius,
                )
            )
        if follower.kind == "roller" and not follower.roller_radius > 0 and not self.choose.roller_radii:
            found.append(
                fault(
                    "no_roller",
                    "follower",
                    _("the roller has no radius"),
                    _("add roller_radius: 10 mm to the follower, or choose: {{roller_radii: [8 mm, 10 mm]}}"),
                )
            )
        if follower.oscillating and (
            not (follower.pivot_distance or 0) > 0 or (follower.kind != "flat" and not (follower.arm or 0) > 0)
        ):
            found.append(
                fault(
                    "no_arm",
                    "follower",
                    _("an oscillating follower needs its pivot and its arm"),
                    _("add pivot_distance: 120 mm and arm: 100 mm to the follower (a flat face needs no arm)"),
                )
            )
        if self.barrel_radius is not None and (follower.oscillating or follower.kind != "roller"):
            found.append(
                fault(
                    "barrel_follower",
                    "follower",
                    _("a barrel cam moves a translating roller"),
                    _("write follower: {{kind: roller, roller_radius: 8 mm}}, or leave barrel_radius out"),
                )
            )
        if self.closure != "force" and follower.kind != "roller":
            found.append(
                fault(
                    "closure_follower",
                    "closure",
                    _("only a roller can run with the closure {closure}"),
                    _("take a roller, or closure: force"),
                    closure=self.closure,
                )
            )
        if (self.closure == "conjugate") != (self.conjugate is not None):
            found.append(
                fault(
                    "conjugate",
                    "closure",
                    _("closure: conjugate and the second cam go together"),
                    _("write closure: conjugate and conjugate: {{base_radius: 40 mm}}, or neither"),
                )
            )
        if self.base_radius is None and self.barrel_radius is None and self.limits == CamLimits():
            found.append(
                fault(
                    "no_base",
                    "base_radius",
                    _("neither a base circle nor limits by which to choose it"),
                    _("add base_radius: 40 mm, or limits: {{pressure_angle: 30 deg}}"),
                )
            )
        elif self.base_radius is None and self.barrel_radius is None and not np.ptp(self.program.lifts):
            found.append(
                fault(
                    "nothing_moves",
                    "program",
                    _("the program moves nothing, so that no limit tells a base circle"),
                    _("give a rise, or a base_radius"),
                )
            )
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
                        fault(
                            "undercut_flat",
                            "base_radius",
                            _(
                                "from {start}° to {end}° the flat face cuts away {depth} mm of the profile it should "
                                "touch"
                            ),
                            _("make the base circle larger by more than {more} mm, or the program smoother there"),
                            **places,
                            depth=depth,
                            more=1e3 * more,
                        )
                    )
                    continue
                radius = self._tightest(wall, each.start, each.end)
                key = "choose" if self.choose.roller_radii else "follower.roller_radius"
                roller = 1e3 * self.follower.roller_radius
                found.append(
                    fault(
                        "undercut",
                        key,
                        _(
                            "from {start}° to {end}° the roller of {roller} mm cuts away {depth} mm of the "
                            "profile it should touch: the pitch curve bends there with a radius of {radius} mm"
                        ),
                        _(
                            "take a roller of less than {radius} mm or a larger base circle, or a longer or "
                            "smoother rise there"
                        ),
                        **places,
                        depth=depth,
                        roller=roller,
                        radius=1e3 * radius,
                    )
                )
        return found

    def _tightest(self, wall: CamCurve, start: float, end: float) -> float:
        """Smallest radius of curvature of the pitch curve there, m."""
        contact = wall.contact(np.linspace(start, end, 801))
        curvature = (1.0 - contact.growth) / self.follower.roller_radius
        return 1.0 / max(float(curvature.max()), 1e-12)

    def _contact_lost(self) -> list[Finding]:
        """Where a set spring does not maintain the contact."""
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
            return [
                fault(
                    "jam",
                    "limits",
                    _("at {place}° the contact cannot move the follower: the pressure angle reaches 90°"),
                    _("take a larger base circle or another offset"),
                    place=math.degrees(float(worst)),
                )
            ]
        values = {"place": math.degrees(float(phi[k])), "missing": -float(effort[k])}
        unit = "N·m" if self.follower.oscillating else "N"
        return [
            fault(
                "contact_lost",
                "spring",
                _("the contact is lost at {place}°: {missing} {unit} are missing to hold the follower down"),
                _(
                    "give a preload larger by {missing} {unit}, a stiffer spring, or a lower speed; "
                    "spring: {{}} chooses one"
                ),
                **values,
                unit=unit,
            )
        ]


@dataclass(frozen=True, eq=False)
class TabledLift(Program):
    """A lift through the points of a table, as the mechanism runs on it."""

    lift: LiftCurve
    period: float = TURN

    @property
    def edges(self) -> Floats:
        return self.lift.edges

    @property
    def breaks(self) -> Floats:
        return self.lift.edges

    def curves(self, x: Any) -> tuple[Any, Any, Any, Any]:
        s, v, a, j = self.lift.derivatives(x, 3)
        return s, v, a, j


def cam_of(mechanism: Mechanism, name: str, *, speed: float = 0.0) -> Cam:
    """The cam of a joint, turned so that its follower rises upward (oscillating: so that its pivot is on the x axis).

    ``speed``: size of the cam's angular velocity, rad/s, where it is constant.

    Raises KeyError where there is no such joint, TypeError where it is no cam.
    """
    joint = mechanism.joints[name]
    if not isinstance(joint, CamJoint):
        raise TypeError(name)
    geometry = joint.geometry(mechanism)
    return Cam(
        program=joint.program or TabledLift(joint.lift),
        follower=_follower(joint, mechanism)
        if joint.side
        else Follower(joint.touch, roller_radius=joint.roller_radius, offset=-geometry.aside),
        base_radius=joint.base_radius,
        turn=joint.sense,
        closure="groove" if joint.closure == "groove" and joint.touch == "roller" else "force",
        loading=CamLoading(speed=abs(speed)),
        name=name,
    )


def _follower(joint: CamJoint, mechanism: Mechanism) -> Follower:
    """A follower that swings: looking from its pivot the left side is below the line to the cam."""
    carrier, own = mechanism.link(joint.carrier).points, mechanism.link(joint.follower).points
    line = np.subtract(carrier[joint.centre], carrier[joint.holder])
    arm = np.subtract(own[joint.at], own[joint.holder])
    return Follower(
        joint.touch,
        "oscillating",
        roller_radius=joint.roller_radius,
        pivot_distance=float(np.hypot(*line)),
        arm=float(np.hypot(*arm)),
        below=joint.side == "left",
    )
