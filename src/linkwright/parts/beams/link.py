"""Bending of a mechanism's straight link under its joint forces, loads, weight and inertia, over the cycle."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.polynomial import Polynomial

from linkwright.errors import Finding, LinkwrightError
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.kinetostatics.forces import Forces, solve_forces
from linkwright.model.fields import Quantity, Text
from linkwright.model.mechanism import Link, Mechanism
from linkwright.parts.base import Block, Floats, Problem, Result, Row, fault
from linkwright.parts.beams.beam import polynomial_text
from linkwright.parts.beams.materials import Material, material_field
from linkwright.parts.beams.sections import Section, require_modulus, section_field
from linkwright.parts.display import shown
from linkwright.parts.fields import Whole
from linkwright.parts.mechanism_field import MECHANISM, load_beside
from linkwright.parts.steps import put
from linkwright.words import Say
from linkwright.worked.page import Step

#: Points of a link lie on a line within this share of its length.
STRAIGHT = 1e-6
#: Stations along the link.
STATIONS = 201


@dataclass(frozen=True)
class LinkBending(Problem):
    """The straight ``link`` of a ``mechanism`` with one ``section`` along its length; ``safety`` wanted at least."""

    kind: ClassVar[str] = "link_bending"
    fields: ClassVar[Mapping[str, Any]] = {
        "mechanism": MECHANISM,
        "link": Text(required=True, doc="name of the link"),
        "material": material_field(),
        "section": section_field(required=True, doc="cross section, bent in the plane of the mechanism"),
        "safety": Quantity(
            "dimensionless", above=0.0, doc="safety against the strength, for the needed section"
        ),
        "steps": Whole(1, doc="positions over the cycle, 360 unless given"),
    }
    mechanism: Mechanism
    link: str
    material: Material
    section: Section
    safety: float = 1.0
    steps: int = 360
    name: str = ""
    source: str = ""

    @classmethod
    def of_file(cls, values: Mapping[str, Any], folder: Path) -> LinkBending:
        return cls(**{**values, "mechanism": load_beside(values["mechanism"], folder)})

    def findings(self) -> list[Finding]:
        links = self.mechanism.links
        if self.link not in links:
            return [fault("beam.no_link", "link", link=self.link, mechanism=self.mechanism.name,
                          links=", ".join(links))]  # fmt: skip
        link = links[self.link]
        if len(link.points) < 2:
            return [fault("beam.one_point", "link", link=self.link)]
        found = require_modulus(self.section, "section")
        off = _off_line(link)
        if off:
            found.append(fault("beam.crooked", "link", link=self.link, names=", ".join(off)))
        return found

    def solve(self) -> LinkStress:
        """Stress over the cycle. Raises ModelError with all findings, and where the cycle is not passed."""
        self.require()
        try:
            forces = solve_forces(self.mechanism, steps=self.steps)
        except LinkwrightError as error:
            from linkwright.errors import ModelError

            raise ModelError([fault("beam.not_passed", "mechanism", why=error.sentence)]) from None
        return LinkStress(self, forces)


def axis_of(link: Link) -> tuple[Floats, Floats]:
    """A point and the unit vector of the line through the two points of a link that are farthest apart."""
    places = np.array(list(link.points.values()))
    gaps = np.linalg.norm(places[:, None] - places[None], axis=2)
    first, last = np.unravel_index(int(gaps.argmax()), gaps.shape)
    start, end = places[min(first, last)], places[max(first, last)]
    return start, (end - start) / np.linalg.norm(end - start)


def _off_line(link: Link) -> list[str]:
    """Names of points, and of the mass centre of a link with mass, that do not lie on its line."""
    start, along = axis_of(link)
    places = {**link.points, **({"mass_centre": link.centre} if link.mass else {})}
    length = max(abs(float(np.dot(np.subtract(p, start), along))) for p in link.points.values())
    across = {
        name: float(np.cross([*along, 0], [*np.subtract(p, start), 0])[2]) for name, p in places.items()
    }
    return [name for name, gap in across.items() if abs(gap) > STRAIGHT * length]


@dataclass(frozen=True, repr=False)
class LinkStress(Result):
    """Bending moment, shear and normal force along a link at every position of the cycle, and what they mean.

    The link's mass is spread evenly about its centre over the length √(12 J/m) that gives its inertia J (a uniform
    bar: over its length); where that does not fit, as ρ(s) = r0 + r1 s + r2 s² with the same ∫ρ, ∫ρs, ∫ρs². So joint
    forces, loads, weight and −ρ(s)·a(s) are in exact balance: beyond the last point no force is left
    (``closure``). With the cut at s, V(s) = Σ F below, M(s) = Σ F·(s − s_k) − Σ C,
    both with the line loads; N is positive in tension. Stress |N|/A + |M|/W.

    ``stations`` (k,) m along the link, those of forces twice (left and right); ``moment``, ``shear``, ``normal``
    (n, k).
    """

    area: ClassVar[str] = "beam"
    problem: LinkBending
    forces: Forces

    @property
    def title(self) -> str:
        return self.problem.name

    @property
    def link(self) -> Link:
        """The link."""
        return self.problem.mechanism.links[self.problem.link]

    @cached_property
    def line(self) -> tuple[Floats, Floats]:
        """Origin and direction of the s axis in the link's axes."""
        return axis_of(self.link)

    def place(self, point: tuple[float, float]) -> float:
        """s of a point of the link, m."""
        return float(np.dot(np.subtract(point, self.line[0]), self.line[1]))

    @cached_property
    def span(self) -> tuple[float, float]:
        """Ends of the link along s, m."""
        places = [self.place(p) for p in self.link.points.values()]
        return min(places), max(places)

    @cached_property
    def mass_span(self) -> tuple[float, float]:
        """Where the mass lies, m: evenly about its centre over √(12 J/m); all over, where that is too long."""
        link, (a, b) = self.link, self.span
        if not link.mass or not link.inertia:
            return a, b
        centre, half = self.place(link.centre), math.sqrt(3.0 * link.inertia / link.mass)
        within = 1e-9 * (b - a)
        if centre - half >= a - within and centre + half <= b + within:
            return max(centre - half, a), min(centre + half, b)
        return a, b

    @cached_property
    def density(self) -> Polynomial:
        """ρ(s) within ``mass_span``, kg/m."""
        link, (a, b) = self.link, self.mass_span
        if not link.mass:
            return Polynomial([0.0])
        centre, middle, half = self.place(link.centre), (a + b) / 2, (b - a) / 2
        offset = (centre - middle) / half
        moments = np.array([1.0, offset, link.inertia / (link.mass * half**2) + offset**2])
        legendre = [[2.0, 0.0, 2 / 3], [0.0, 2 / 3, 0.0], [2 / 3, 0.0, 2 / 5]]
        coefficients = np.linalg.solve(np.array(legendre), moments) * link.mass / half
        tidy = np.where(np.abs(coefficients) < 1e-9 * np.abs(coefficients).max(), 0.0, coefficients)
        return Polynomial(tidy)(Polynomial([-middle / half, 1.0 / half]))

    @cached_property
    def stations(self) -> Floats:
        """Places along the link, m, every point of the link twice."""
        places = [self.place(p) for p in self.link.points.values()]
        return np.sort(np.concatenate([np.linspace(*self.span, STATIONS), places, places]))

    @cached_property
    def _axes(self) -> tuple[Floats, Floats]:
        """Unit vectors along and across the link, (n, 2) each, in frame axes."""
        e = self.forces.motion.link(self.problem.link).direction
        tx, ty = self.line[1]
        along = np.stack([e[:, 0] * tx - e[:, 1] * ty, e[:, 1] * tx + e[:, 0] * ty], axis=1)
        return along, np.stack([-along[:, 1], along[:, 0]], axis=1)

    @cached_property
    def point_forces(self) -> list[tuple[str, Floats, Floats, Floats, Floats]]:
        """Name, place s, forces along and across (N) and couple (N·m) of all that acts at points, (n,) each."""
        return [*self._joint_forces(), *self._driver_forces(), *self._load_forces()]

    def _parts(self, force: Floats) -> tuple[Floats, Floats]:
        along, across = self._axes
        return (force * along).sum(axis=1), (force * across).sum(axis=1)

    def _joint_place(self, joint: str) -> float:
        given = self.problem.mechanism.joints[joint]
        point = given.at if isinstance(given, PrismaticJoint) else getattr(given, "at", joint)
        if point in self.link.points:
            return self.place(self.link.points[point])
        through = getattr(given, "through", None)
        return self.place(self.link.points.get(str(through), next(iter(self.link.points.values()))))

    def _joint_forces(self) -> list[tuple[str, Floats, Floats, Floats, Floats]]:
        found, name = [], self.problem.link
        for joint, given in self.problem.mechanism.joints.items():
            if name in given.joined:
                force = self.forces.reaction(joint, on=name)
                place = self._block_place(joint)
                found.append((joint, place, *self._parts(force), self.forces.couple(joint, on=name)))
        return found

    def _block_place(self, joint: str) -> Floats:
        """s of a joint's force, (n,): the block's point where the link is the guide."""
        given = self.problem.mechanism.joints[joint]
        count = self.forces.steps
        if not (isinstance(given, PrismaticJoint) and given.guide == self.problem.link):
            return np.full(count, self._joint_place(joint))
        motion = self.forces.motion
        block = motion.point(f"{given.block}.{given.at}").position
        return self._along(block)

    def _along(self, places: Floats) -> Floats:
        """s of places of the frame, (n,)."""
        first = next(iter(self.link.points))
        origin = self.forces.motion.point(f"{self.problem.link}.{first}").position
        return self._parts(places - origin)[0] + self.place(self.link.points[first])

    def _driver_forces(self) -> list[tuple[str, Floats, Floats, Floats, Floats]]:
        found = []
        for name, driver in self.problem.mechanism.drivers.items():
            if self.problem.link not in (driver.link, driver.relative_to):
                continue
            effort = self.forces.driver_effort(name) * (1.0 if driver.link == self.problem.link else -1.0)
            place = self._block_place(driver.joint)
            if isinstance(self.problem.mechanism.joints[driver.joint], PrismaticJoint):
                force = effort[:, None] * self.forces.guide_direction(driver.joint)
                found.append((name, place, *self._parts(force), np.zeros_like(effort)))
            else:
                found.append((name, place, np.zeros_like(effort), np.zeros_like(effort), effort))
        return found

    def _load_forces(self) -> list[tuple[str, Floats, Floats, Floats, Floats]]:
        """The resultant of all loads on the link, where its line meets the link, the rest of its moment a couple."""
        link = self.problem.link
        fx, fy, moment = self.forces.fetch((f"on:{link}.x", f"on:{link}.y", f"on:{link}.m"))
        if not (np.any(fx) or np.any(fy) or np.any(moment)):
            return []
        force = np.stack([fx, fy], axis=1)
        first = next(iter(self.link.points))
        origin = self.forces.motion.point(f"{link}.{first}").position
        about = moment - (origin[:, 0] * fy - origin[:, 1] * fx)
        along, across = self._parts(force)
        with np.errstate(all="ignore"):
            place = np.where(across != 0.0, about / across, 0.0) + self.place(self.link.points[first])
        place = np.clip(np.nan_to_num(place), *self.span)
        couple = about - across * (place - self.place(self.link.points[first]))
        return [("loads", place, along, across, couple)]

    @cached_property
    def _spread(self) -> tuple[list[Polynomial], list[Floats]]:
        """Line loads: polynomials of s with weights (n,): across ρ·(−a_n + g_n), ρ·s·(−α); along the same way."""
        motion, link = self.forces.motion.link(self.problem.link), self.link
        gravity = np.asarray(self.problem.mechanism.gravity)
        still = np.zeros((self.forces.steps, 2))
        acceleration = motion.centre.acceleration if link.mass else still
        along, across = self._parts(gravity - acceleration)
        arm = Polynomial([-self.place(link.centre), 1.0])
        return [self.density, self.density * arm], [across, -motion.angular_acceleration, along,
                                                   motion.angular_velocity**2]  # fmt: skip

    @cached_property
    def _cut(self) -> tuple[Floats, Floats, Floats]:
        """Shear, moment, normal (n, k): sums of all that acts below every station."""
        s, (start, end) = self.stations, self.mass_span
        shapes, (across, turning, along, swinging) = self._spread
        inside, beyond = np.clip(s, start, end), np.maximum(s - end, 0.0)
        once = [p.integ(lbnd=start) for p in shapes]
        first = [p(inside) for p in once]
        second = [p.integ(lbnd=start)(inside) + p(end) * beyond for p in once]
        shear = np.outer(across, first[0]) + np.outer(turning, first[1])
        moment = np.outer(across, second[0]) + np.outer(turning, second[1])
        normal = -np.outer(along, first[0]) - np.outer(swinging, first[1])
        for _, place, force_along, force_across, couple in self.point_forces:
            below = self._below(place)
            reach = s[None, :] - place[:, None]
            shear += below * force_across[:, None]
            moment += below * (force_across[:, None] * reach - couple[:, None])
            normal -= below * force_along[:, None]
        return shear, moment, normal

    def _below(self, place: Floats) -> Floats:
        """1 where a force at ``place`` (n,) is below a station: of equal stations from the second on."""
        s = self.stations
        repeated = np.append(False, np.isclose(s[1:], s[:-1], atol=1e-12 * max(abs(s[0]), abs(s[-1]))))
        gap = s[None, :] - place[:, None]
        near = np.abs(gap) <= 1e-9 * (self.span[1] - self.span[0])
        final = np.zeros(len(s), dtype=bool)
        final[-1] = True
        return np.where(near, (repeated | final)[None, :], gap > 0).astype(float)

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

    @cached_property
    def stress(self) -> Floats:
        """|N|/A + |M|/W, (n, k) Pa."""
        section = self.problem.section
        return np.abs(self.normal) / (section.area or 1.0) + np.abs(self.moment) / (section.modulus or 1.0)

    @property
    def closure(self) -> float:
        """Largest force (N) left beyond the last point: zero but for rounding."""
        ends = [np.abs(each[:, -1]).max() for each in (self.shear, self.normal)]
        return float(max(*ends, np.abs(self.moment[:, -1]).max() / (self.span[1] - self.span[0])))

    def worst(self, values: Floats) -> tuple[int, int]:
        """Position and station of the largest size."""
        index = np.unravel_index(int(np.abs(values).argmax()), values.shape)
        return int(index[0]), int(index[1])

    @property
    def safety(self) -> float | None:
        """Strength over the largest stress."""
        strength = self.problem.material.strength
        return None if strength is None else strength / float(self.stress.max())

    @property
    def needed_modulus(self) -> float | None:
        """W (m³) with which the largest stress of bending alone keeps the wanted safety."""
        strength = self.problem.material.strength
        return None if strength is None else float(np.abs(self.moment).max()) * self.problem.safety / strength

    def columns(self) -> dict[str, Floats]:
        """Over the cycle: input, the largest moment and normal force by size, the largest stress."""
        return {
            "input": self.forces.motion.input,
            "moment [N·m]": np.abs(self.moment).max(axis=1),
            "normal [N]": np.abs(self.normal).max(axis=1),
            "stress [Pa]": self.stress.max(axis=1),
        }

    def blocks(self, say: Say) -> list[Block]:
        rows = [
            self._row("largest_moment", self.moment, "torque", say),
            self._row("largest_normal", self.normal, "force", say),
            self._row("largest_stress", self.stress, "pressure", say),
        ]
        if self.safety is not None and self.needed_modulus is not None:
            rows += [
                Row("safety", self.safety),
                Row("needed_modulus", self.needed_modulus, "section_modulus"),
            ]
        rows.append(Row("closure", self.closure, "force"))
        return [Block("cycle", say("beam.cycle"), rows, self._remarks(say))]

    def _row(self, key: str, values: Floats, dimension: str, say: Say) -> Row:
        i, k = self.worst(values)
        note = say("beam.at_input", at=self._input(i), x=shown(self.stations[k], "length"))
        return Row(key, float(values[i, k]), dimension, "", note)

    def _input(self, index: int) -> str:
        turning = next(iter(self.forces.motion.positions.rotary.values()), True)
        return shown(float(self.forces.motion.input[index]), "angle" if turning else "length")

    def _remarks(self, say: Say) -> list[str]:
        found = []
        a, b = self.mass_span
        if (a, b) != self.span:
            found.append(
                say(
                    "beam.mass_span", link=self.problem.link, start=shown(a, "length"), end=shown(b, "length")
                )
            )
        if self.density(np.linspace(a, b, 101)).min() < -1e-9 * max(self.link.mass, 1e-300) / (b - a):
            found.append(say("beam.negative_density", link=self.problem.link))
        if any(name == "loads" for name, *_ in self.point_forces):
            found.append(say("beam.as_resultant", link=self.problem.link))
        return found

    def steps(self, say: Say) -> list[Step]:
        i, k = self.worst(self.stress)
        step = Step("1", say("beam.link_position", at=self._input(i)))
        a, b = self.mass_span
        density = np.asarray(self.density.coef, dtype=float)
        largest = np.abs(density * (b - a) ** np.arange(len(density))).max()
        text = polynomial_text(density, largest, b - a).replace("ξ", "s")
        step.say(f"{say('beam.link_density')} {text} kg/m")
        step.say(say("beam.link_forces"))
        for name, place, along, across, couple in self.point_forces:
            where = shown(float(place[i]), "length")
            values = f"({shown(float(along[i]), 'force')}, {shown(float(across[i]), 'force')})"
            step.say(f"  {name}, s = {where}: {values}, {shown(float(couple[i]), 'torque')}")
        cut = Step("2", say("beam.link_cut"))
        put(cut, "s", "", float(self.stations[k]), "length")
        put(cut, "V", "Σ F + ∫ q ds", float(self.shear[i, k]), "force")
        put(cut, "M", "Σ F·(s − s_k) − Σ C + ∫∫ q ds²", float(self.moment[i, k]), "torque")
        put(cut, "N", "−Σ F − ∫ p ds", float(self.normal[i, k]), "force")
        put(cut, "σ", "|N|/A + |M|/W", float(self.stress[i, k]), "pressure")
        if self.safety is not None and self.needed_modulus is not None:
            put(cut, "S", "Re/σ", self.safety)
            put(cut, "W", "|M|·S/Re", self.needed_modulus, "section_modulus")
        return [step, cut]
