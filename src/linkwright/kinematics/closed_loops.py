r"""Closed loops of the groups without closed form and of all that they hang on, as sums of turned arms.

Links that a guide or a weld joins share a rotation, links that a driver turns against each other one rotation and
the driver's angle. So every closed loop is, as complex numbers,

    F = Σ_c e^{iθ_c} (a_c + Σ_{j on c} b_j s_j) = 0,      θ_c = φ_c + (turns of drivers),

with as many unknown rotations φ and slides s as real equations. Terms of one rotation each have second derivatives
that the arms bound, which is what :mod:`linkwright.kinematics.certificate` lives on.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Mapping
from copy import copy
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linkwright.joints.prismatic import PrismaticJoint
from linkwright.joints.revolute import RevoluteJoint
from linkwright.joints.weld import WeldJoint
from linkwright.kinematics.drawing import guide_angle
from linkwright.kinematics.groups import dyad_shape
from linkwright.kinematics.size import mechanism_size
from linkwright.model.mechanism import Mechanism
from linkwright.structure.group import Connection, Group, Structure, TreeJoint

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
#: Coefficients of a place, by rotation and slide (-1: of no slide).
Terms = dict[tuple[int, int], complex]


@dataclass(frozen=True)
class _Body:
    """A link: number of its rotation, angle of its x axis beyond it, and its point ``anchor`` at ``place``."""

    rotation: int
    offset: float
    anchor: complex
    place: Terms


@dataclass(frozen=True)
class Turned:
    """Loops at some coordinates: unit vectors (…, C), arms (…, C, K), turned directions of slides (…, S, K)."""

    unit: Complexes
    arms: Complexes
    slides: Complexes


def iterated(structure: Structure) -> list[Group]:
    """The groups that have no closed form."""
    return [group for group in structure.groups if group.unknowns and dyad_shape(group) is None]


def upstream(structure: Structure) -> list[Group]:
    """The groups without closed form and all that they hang on, in solving order."""
    wanted = {link for group in iterated(structure) for link in group.links}
    found = []
    for group in reversed(structure.groups):
        if wanted & set(group.links):
            found.append(group)
            wanted |= {end for c in group.joints for end in (c.a, c.b)}
    return found[::-1]


class ClosedLoops:
    """The equations of K loops in coordinates y = (n unknowns, d drivers), n = 2K; lengths in m, angles in rad.

    ``turning`` (C, n + d): the rotations θ of y; ``sliding`` (S, n + d): the slides of y; ``owner`` (S,): the
    rotation on which a slide lies; ``scale`` (n,): 1 for a rotation, the mechanism's size for a slide;
    ``groups`` (n,): the group of every unknown.
    """

    def __init__(self, mechanism: Mechanism, structure: Structure) -> None:
        self.mechanism = mechanism
        self.size = mechanism_size(mechanism)
        self.drivers = list(mechanism.drivers)
        build = _Builder(mechanism)
        for group in upstream(structure):
            build.add(group)
        self.unknowns = build.unknowns
        self.groups = build.groups
        self.links = {name: (body.rotation, body.offset) for name, body in build.bodies.items()}
        self.n, self.d = len(build.unknowns), len(self.drivers)
        self.C, self.S, self.K = len(build.rotations), len(build.slides), len(build.loops)
        self._matrices(build)
        self.scale = np.where([kind == "turn" for kind, _ in self.unknowns], 1.0, self.size)
        self.row_scale = 1.0 / self.size

    def _matrices(self, build: _Builder) -> None:
        columns = {key: i for i, key in enumerate([*self.unknowns, *(("drive", d) for d in self.drivers)])}
        self.turning = np.zeros((self.C, len(columns)))
        for c, (unknown, turns) in enumerate(build.rotations):
            if unknown:
                self.turning[c, columns["turn", unknown]] = 1.0
            for driver, sign in turns:
                self.turning[c, columns["drive", driver]] += sign
        self.sliding = np.zeros((self.S, len(columns)))
        self.owner = np.array([owner for _, owner in build.slides], dtype=int)
        for j, (key, _) in enumerate(build.slides):
            self.sliding[j, columns[key]] = 1.0
        self.a = np.zeros((self.C, self.K), complex)
        self.b = np.zeros((self.S, self.K), complex)
        for k, (_, terms) in enumerate(build.loops):
            for (c, j), value in terms.items():
                if j < 0:
                    self.a[c, k] += value
                else:
                    self.b[j, k] += value
        self.loop_groups = [group for group, _ in build.loops]
        self.own = np.zeros((self.S, self.C))
        self.own[np.arange(self.S), self.owner] = 1.0
        self.coordinates = np.concatenate([self.turning, self.sliding])

    def with_gap(self, gap: Complexes) -> ClosedLoops:
        """The same loops open by ``gap`` (K,) times one more driver coordinate, the last of y."""
        other = copy(self)
        other.d, other.S = self.d + 1, self.S + 1
        other.turning = np.pad(self.turning, ((0, 0), (0, 1)))
        other.sliding = np.pad(self.sliding, ((0, 1), (0, 1)))
        other.sliding[-1, -1] = 1.0
        other.owner = np.append(self.owner, 0)
        other.b = np.concatenate([self.b, -gap[None, :]])
        other.own = np.pad(self.own, ((0, 1), (0, 0)))
        other.own[-1, 0] = 1.0
        other.coordinates = np.concatenate([other.turning, other.sliding])
        return other

    # values ---------------------------------------------------------------------------------
    def turned(self, y: Floats) -> Turned:
        """The loops at coordinates y (…, n + d)."""
        unit = np.exp(1j * (y @ self.turning.T))
        if not self.S:
            return Turned(
                unit, np.broadcast_to(self.a, (*y.shape[:-1], *self.a.shape)), np.zeros(self.b.shape, complex)
            )
        slid = (y @ self.sliding.T)[..., None] * self.b
        arms: Complexes = np.asarray(self.a + self.own.T @ slid, complex)
        return Turned(unit, arms, unit[..., self.owner, None] * self.b)

    def gap(self, at: Turned) -> Floats:
        """F (…, n): real parts, then imaginary parts."""
        return _real((at.unit[..., None] * at.arms).sum(axis=-2))

    def slopes(self, at: Turned) -> Complexes:
        """∂F/∂y, (…, n + d, K)."""
        columns = [1j * at.unit[..., None] * at.arms]
        if self.S:
            columns.append(at.slides)
        found: Complexes = self.coordinates.T @ np.concatenate(columns, axis=-2)
        return found

    def jacobian(self, slopes: Complexes) -> Floats:
        """∂F/∂z (…, n, n), real parts above imaginary parts."""
        return np.swapaxes(_real(slopes[..., : self.n, :]), -1, -2)

    def rates(self, y: Floats, first: Floats, second: Floats) -> tuple[Floats, Floats, Floats]:
        """y′ and y″ (n + d,) along a way on which the drivers have the given first and second derivatives (d,), and
        the Jacobian. Both orders have the same matrix. Raises LinAlgError where it is singular."""
        at = self.turned(y)
        slopes = self.slopes(at)
        jacobian = self.jacobian(slopes)
        inverse = np.linalg.inv(jacobian)
        rate = np.concatenate([-inverse @ _real(first @ slopes[self.n :]), first])
        theta = self.turning @ rate
        bend = -(at.unit * theta**2) @ at.arms
        if self.S:
            bend = bend + (2j * (at.unit * theta)[self.owner] * (self.sliding @ rate)) @ self.b
        return rate, np.concatenate([-inverse @ _real(bend + second @ slopes[self.n :]), second]), jacobian

    def tangents(self, y: Floats, drive: Floats) -> Floats:
        """First derivatives of the unknowns (m, n) at roots y (m, n + d) for those of the drivers (m, d)."""
        slopes = self.slopes(self.turned(y))
        right = _real((drive[..., None] * slopes[..., self.n :, :]).sum(axis=-2))
        return np.asarray(np.linalg.solve(self.jacobian(slopes), -right[..., None])[..., 0])

    # solving --------------------------------------------------------------------------------
    def newton(self, y: Floats, iterations: int = 8) -> Floats | None:
        """The root near y (n + d,) with the same drivers, to rounding; None where Newton's method fails."""
        last = np.inf
        y = y.copy()
        for _ in range(iterations):
            at = self.turned(y)
            try:
                step = np.asarray(np.linalg.solve(self.jacobian(self.slopes(at)), self.gap(at)), float)
            except np.linalg.LinAlgError:
                return None
            y[: self.n] -= step
            size = self.largest(step)
            if not size < 1e3:
                return None
            if size < 1e-8 and (size < 1e-13 or size * size < 1e-16 or size > 0.3 * last):
                return y
            last = size
        return None

    def polished(self, y: Floats, iterations: int = 3) -> tuple[Floats, Floats]:
        """Roots near y (m, n + d), and the last correction (m,), relative."""
        y = y.copy()
        step: Floats = np.zeros((len(y), self.n))
        for _ in range(iterations):
            at = self.turned(y)
            change = np.linalg.solve(self.jacobian(self.slopes(at)), self.gap(at)[..., None])
            step = np.asarray(change[..., 0], float)
            y[:, : self.n] -= step
        return y, np.asarray(np.abs(step / self.scale).max(axis=-1))

    def largest(self, step: Floats) -> float:
        """The largest change of an unknown: rad, or share of the mechanism's size."""
        return float(np.abs(step[: self.n] / self.scale).max())

    def weakest_group(self, y: Floats) -> str:
        """The group whose own equations are nearest to singular at y."""
        jacobian = self.jacobian(self.slopes(self.turned(y))) * self.scale * self.row_scale
        least: dict[str, float] = {}
        for group in dict.fromkeys(self.groups):
            rows = [k for k, name in enumerate(self.loop_groups) if name == group]
            columns = [i for i, name in enumerate(self.groups) if name == group]
            block = jacobian[np.ix_([*rows, *(self.K + k for k in rows)], columns)]
            least[group] = float(np.linalg.svd(block, compute_uv=False)[-1])
        return min(least, key=least.__getitem__)


def _real(v: Complexes) -> Floats:
    return np.concatenate([v.real, v.imag], axis=-1)


class _Builder:
    """Walks the chains of the groups and writes down where every link is."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.unknowns: list[tuple[str, str]] = []
        self.groups: list[str] = []
        self.rotations: list[tuple[str, tuple[tuple[str, float], ...]]] = [("", ())]
        self.slides: list[tuple[tuple[str, str], int]] = []
        self.loops: list[tuple[str, Terms]] = []
        self.bodies = {"frame": _Body(0, 0.0, 0j, {})}

    def add(self, group: Group) -> None:
        """The links of a group on the links before, and the loops that its cuts close."""
        for step in group.tree:
            self.bodies[step.child] = self._hung(step, group.name)
        for cut in group.cuts:
            self.loops.append((group.name, self._loop(cut, group.name)))

    def _unknown(self, kind: str, name: str, group: str) -> tuple[str, str]:
        self.unknowns.append((kind, name))
        self.groups.append(group)
        return kind, name

    def _hung(self, step: TreeJoint, group: str) -> _Body:
        parent = self.bodies[step.parent]
        joint = self.mechanism.joints[step.joint]
        if isinstance(joint, RevoluteJoint):
            place, anchor = self._place(step.parent, joint.name), self._local(step.child, joint.name)
            if step.driver is None:
                self._unknown("turn", step.child, group)
                return _Body(self._rotation(step.child, ()), 0.0, anchor, place)
            sign = 1.0 if step.child == self.mechanism.drivers[step.driver].link else -1.0
            unknown, turns = self.rotations[parent.rotation]
            rotation = self._rotation(unknown, (*turns, (step.driver, sign)))
            return _Body(rotation, parent.offset, anchor, place)
        if isinstance(joint, WeldJoint):
            turn = joint.angle if step.child == joint.links[1] else -joint.angle
            place, anchor = self._place(step.parent, joint.at), self._local(step.child, joint.at)
            return _Body(parent.rotation, parent.offset + turn, anchor, place)
        assert isinstance(joint, PrismaticJoint)
        key = ("drive", step.driver) if step.driver else self._unknown("slide", joint.name, group)
        turn = guide_angle(self.mechanism, joint) - joint.block_angle
        on_parent, on_child = (
            (joint.through, joint.at) if step.child == joint.block else (joint.at, joint.through)
        )
        sign = 1.0 if step.child == joint.block else -1.0
        place = dict(self._place(step.parent, on_parent))
        along = parent.offset + (guide_angle(self.mechanism, joint) if sign > 0 else joint.block_angle)
        self._slide(place, key, parent.rotation, sign * cmath.exp(1j * along), joint.offset)
        return _Body(parent.rotation, parent.offset + sign * turn, self._local(step.child, on_child), place)

    def _loop(self, cut: Connection, group: str) -> Terms:
        joint = self.mechanism.joints[cut.joint]
        if isinstance(joint, RevoluteJoint):
            return _added(self._place(cut.a, joint.name), self._place(cut.b, joint.name), -1.0)
        assert isinstance(joint, PrismaticJoint)
        start = dict(self._place(joint.guide, joint.through))
        guide = self.bodies[joint.guide]
        along = cmath.exp(1j * (guide.offset + guide_angle(self.mechanism, joint)))
        self._slide(start, self._unknown("slide", joint.name, group), guide.rotation, along, joint.offset)
        return _added(start, self._place(joint.block, joint.at), -1.0)

    def _slide(
        self, place: Terms, key: tuple[str, str], rotation: int, direction: complex, offset: float
    ) -> None:
        self.slides.append((key, rotation))
        place[rotation, len(self.slides) - 1] = direction
        place[rotation, -1] = place.get((rotation, -1), 0j) + 1j * direction * offset

    def _rotation(self, unknown: str, turns: tuple[tuple[str, float], ...]) -> int:
        if (unknown, turns) not in self.rotations:
            self.rotations.append((unknown, turns))
        return self.rotations.index((unknown, turns))

    def _place(self, link: str, point: str) -> Terms:
        body = self.bodies[link]
        arm = cmath.exp(1j * body.offset) * (self._local(link, point) - body.anchor)
        return _added(body.place, {(body.rotation, -1): arm}, 1.0)

    def _local(self, link: str, point: str) -> complex:
        return complex(*self.mechanism.link(link).points[point])


def _added(a: Mapping[tuple[int, int], complex], b: Mapping[tuple[int, int], complex], sign: float) -> Terms:
    keys: Iterable[tuple[int, int]] = dict.fromkeys([*a, *b])
    return {key: a.get(key, 0j) + sign * b.get(key, 0j) for key in keys}
