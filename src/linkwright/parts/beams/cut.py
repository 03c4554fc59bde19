"""Shear, bending moment and normal force along the axis of a link, at every position of a motion."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.plane import cross
from linkwright.core.quantity import shown
from linkwright.errors import SelfCheckError
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.self_check import LIMIT
from linkwright.mechanism.link import Link
from linkwright.parts.beams.axis import STATIONS, LinkAxis, LinkForces, PointForce, SpreadMass
from linkwright.words import _

#: Points of a link lie on a line, and its mass along it, within this share of its length.
STRAIGHT = 1e-6


@dataclass(frozen=True, eq=False)
class LinkLine:
    """The line along which a ``link`` carries forces: its ``axis`` with so many stations between two corners, and the
    link's mass.

    The mass is spread along the axis (see :class:`SpreadMass`), or where it cannot lie there it acts at the mass
    centre, held by the nearest place of the axis.
    """

    link: Link
    axis: LinkAxis
    count: int = STATIONS

    @cached_property
    def mass(self) -> SpreadMass:
        """The link's mass along its axis."""
        return SpreadMass(self.axis, self.link)

    @cached_property
    def spread(self) -> bool:
        """Whether the link's mass can lie along its axis."""
        return self.mass.gap <= STRAIGHT and bool(self.link.mass or not self.link.inertia)

    @cached_property
    def point_places(self) -> dict[str, float]:
        """Places along the axis nearest to the link's points, m."""
        found = self.axis.nearest(np.array(list(self.link.points.values())))[0]
        return {name: float(s) for name, s in zip(self.link.points, found, strict=True)}

    @cached_property
    def _laid_out(self) -> tuple[Floats, Indices]:
        return self.axis.stations([*self.point_places.values()], self.count)

    @property
    def stations(self) -> Floats:
        """Places along the axis (k,), m, every point of the link twice."""
        return self._laid_out[0]

    @cached_property
    def directions(self) -> tuple[Floats, Floats, Floats]:
        """Points of the stations, unit vectors along and across the axis there, (k, 2) each, in the link's axes."""
        s, piece = self._laid_out
        along = self.axis.tangents[piece]
        return self.axis.at(s, piece), along, np.stack([-along[:, 1], along[:, 0]], axis=1)

    @cached_property
    def mass_below(self) -> tuple[Floats, Floats, Floats]:
        """∫ρ ds, ∫ρ r ds, ∫ρ |r|² ds below every station, (k,), (k, 2), (k,), r from the mass centre."""
        return self.mass.below(*self._laid_out)

    @cached_property
    def _behind(self) -> Flags:
        """Stations that lie behind a force at their place: of equal ones from the second on, and the last, (k,)."""
        s = self.stations
        found = np.append(False, np.isclose(s[1:], s[:-1], atol=1e-12 * self.axis.length))
        found[-1] = True
        return found

    def below(self, place: Floats) -> Floats:
        """1 where a force at ``place`` (n,) is below a station, else 0, (n, k)."""
        gap = self.stations[None, :] - place[:, None]
        near = np.abs(gap) <= 1e-9 * self.axis.length
        return np.where(near, self._behind[None, :], gap > 0).astype(float)


@dataclass(frozen=True, eq=False)
class LinkCut:
    """A link cut across its ``line``.

    With the cut at s, V(s) = Σ F below across the axis, M(s) = Σ F·(s − s_k) − Σ C, both with the line loads of the
    mass; N is positive in tension.
    """

    forces: Forces
    line: LinkLine

    @property
    def name(self) -> str:
        """Name of the link."""
        return self.line.link.name

    @cached_property
    def acting(self) -> LinkForces:
        """What acts on the link."""
        return LinkForces(self.forces, self.name, self.line.axis)

    @cached_property
    def point_forces(self) -> list[PointForce]:
        """All that acts at points."""
        at_points = self.acting.at_points()
        return at_points if self.line.spread else [*at_points, self._held_mass()]

    def _held_mass(self) -> PointForce:
        """Weight and inertia at the mass centre."""
        link, motion = self.line.link, self.forces.motion.link(self.name)
        pull = np.asarray(self.forces.mechanism.gravity) - motion.centre.acceleration
        centre = np.tile(np.array(link.centre, dtype=float), (self.forces.steps, 1))
        place = self.line.axis.nearest(centre)[0]
        return PointForce(
            "mass", place, link.mass * self.acting.turned(pull), centre, -link.inertia * motion.angular_acceleration
        )

    @cached_property
    def _cut(self) -> tuple[Floats, Floats, Floats]:
        """Shear, moment, normal (n, k): sums of all that acts below every station."""
        points, along, across = self.line.directions
        force, moment = self._of_mass() if self.line.spread else (np.zeros((1, 1, 2)), np.zeros((1, 1)))
        for each in self.point_forces:
            below = self.line.below(each.place)
            force = force + below[:, :, None] * each.force[:, None]
            moment = moment + below * (cross(each.point, each.force) + each.couple)[:, None]
        left = cross(points[None], force) - moment
        found = (force * across).sum(axis=2), left, -(force * along).sum(axis=2)
        self._require_closed(*found)
        return found

    def _of_mass(self) -> tuple[Floats, Floats]:
        """Force (n, k, 2) of the mass below every station, and its moment (n, k) about the link's origin."""
        motion, link = self.forces.motion.link(self.name), self.line.link
        still = np.zeros((self.forces.steps, 2))
        acceleration = motion.centre.acceleration if link.mass else still
        pull = self.acting.turned(np.asarray(self.forces.mechanism.gravity) - acceleration)
        alpha, swing = motion.angular_acceleration[:, None], motion.angular_velocity[:, None] ** 2
        m0, m1, m2 = self.line.mass_below
        turned = np.stack([-m1[:, 1], m1[:, 0]], axis=1)
        force = m0[:, None] * pull[:, None] - alpha[:, :, None] * turned + swing[:, :, None] * m1
        centre = np.array(link.centre, dtype=float)
        return force, cross(centre, force) + cross(m1[None], pull[:, None]) - alpha * m2

    def _require_closed(self, shear: Floats, moment: Floats, normal: Floats) -> None:
        """Raises SelfCheckError where more than rounding is left beyond the last point."""
        sizes = [np.abs(each) for each in (shear, moment / self.line.axis.length, normal)]
        gap = max(float(each[:, -1].max()) for each in sizes)
        most = max(float(each.max()) for each in sizes)
        if gap > LIMIT * most:
            raise SelfCheckError(
                _(
                    "the forces on {link!r} do not pass their own check: beyond its last point {gap} are "
                    "left, with forces of up to {size}. This is an error of the program, and no result "
                    "may be used: please report it with the model file",
                    code="beam.not_closed",
                    link=self.name,
                    gap=shown(gap, "force", 3),
                    size=shown(most, "force", 3),
                )
            )

    @property
    def shear(self) -> Floats:
        """V (n, k), N."""
        return self._cut[0]

    @property
    def moment(self) -> Floats:
        """M (n, k), N·m."""
        return self._cut[1]

    @property
    def normal(self) -> Floats:
        """N (n, k), N, tension positive."""
        return self._cut[2]

    @property
    def closure(self) -> float:
        """Largest force (N) left beyond the last point: zero but for rounding."""
        ends = [np.abs(each[:, -1]).max() for each in (self.shear, self.normal)]
        return float(max(*ends, np.abs(self.moment[:, -1]).max() / self.line.axis.length))
