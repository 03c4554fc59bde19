"""What every joint kind gives the solvers, on links that move anyhow: derivatives, powers, chains and cuts agree.

The links' motions are written down with their exact derivatives; nothing of the solvers takes part.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import pytest
from tests.contract.joints_of_every_kind import KINDS, MODEL, WELDS
from tests.unit.joints.plain_dimensions import Numbers

import linkwright as lw
from linkwright.elements import TreeJoint
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Trace
from linkwright.joints.base import JOINTS
from linkwright.joints.pose import Pose, Rotor, State
from linkwright.kinematics.equation import ChainPair, Equation, Wrench

Jet = tuple[complex, complex, complex]  # a value with its first two derivatives in time


def times(a: Jet, b: Jet) -> Jet:
    return a[0] * b[0], a[1] * b[0] + a[0] * b[1], a[2] * b[0] + 2 * a[1] * b[1] + a[0] * b[2]


def plus(a: Jet, b: Jet, sign: float = 1.0) -> Jet:
    return a[0] + sign * b[0], a[1] + sign * b[1], a[2] + sign * b[2]


def wave(t: float, start: complex, size: complex, speed: float) -> Jet:
    """start + size sin(speed t)."""
    s, c = np.sin(speed * t), np.cos(speed * t)
    return start + size * s, size * speed * c, -size * speed**2 * s


def vec(z: complex) -> Vec:
    return Vec(float(np.real(z)), float(np.imag(z)))


@dataclass(frozen=True)
class Body:
    """Where the origin of a link's axes is, and their rotation."""

    origin: Jet
    angle: Jet

    def turned(self, local: complex) -> Jet:
        way, (_, w, a) = cmath.exp(1j * self.angle[0].real), self.angle
        return way * local, 1j * w * way * local, (1j * a - w * w) * way * local

    def point(self, local: complex) -> Jet:
        return plus(self.origin, self.turned(local))

    @classmethod
    def pinned(cls, at: Jet, local: complex, angle: Jet) -> Body:
        return cls(plus(at, cls((0, 0, 0), angle).turned(local), -1.0), angle)

    def state(self, anchor: complex, along: complex) -> State:
        """As the solvers carry it, from any anchor and any vector of the link."""
        rotor = Rotor(vec(self.turned(along)[0]), vec(along))
        place, velocity, acceleration = (vec(each) for each in self.point(anchor))
        _, omega, alpha = (float(each.real) for each in self.angle)
        return State(Pose(vec(anchor), place, rotor), velocity, omega, acceleration, alpha)


class Moving:
    """A model whose links move as its joints beside the last one allow, and ``closed`` that one too; ``base`` moves
    anyhow, or not at all."""

    def __init__(self, kind: str, *, still: bool = False, closed: bool = False) -> None:
        self.mechanism = loaded(kind)
        self.kind, self.still, self.closed = kind.split(",", maxsplit=1)[0], still, closed
        entries = KINDS[kind]
        name = "pair" if "pair:" in entries else entries.split(":")[0]
        self.joint = self.mechanism.joints[name]
        a, b = self.joint.joined[:2]
        self.connection = self.joint.between(a, b)
        self.dimensions = Numbers(self.mechanism, Trace())
        self.turned: dict[str, float] = {}
        self.cut = Equation(self.joint, self.connection, self.dimensions, lambda link: self.turned[link])

    def local(self, link: str, point: str) -> complex:
        return complex(*self.mechanism.links[link].points[point])

    def bodies(self, t: float) -> dict[str, Body]:
        base = Body(wave(t, 0.2 - 0.1j, 0.3 + 0.2j, 1.3), wave(t, 0.4, 0.9, 1.1))
        if self.still:
            base = Body((0.2 - 0.1j, 0, 0), (0.4, 0, 0))
        angles = wave(t, 0.7, 1.2, 0.8), wave(t, -1.1, -0.8, 1.7)
        one, two = (
            Body.pinned(base.point(self.local("base", pin)), self.local(link, pin), angle)
            for link, pin, angle in zip(("one", "two"), ("A", "B"), angles, strict=True)
        )
        slide = self.mechanism.joints.get("slide")
        if slide is None:
            free = self.kind == "revolute"
            return {"base": base, "one": one, "two": two if not free else Body(wave(t, 1j, 0.4, 2.1), angles[1])}
        moved = "two" if self.kind == "rack" else "one"
        held = self.guided(base, moved, wave(t, 0.35, 0.1, 1.9), t)
        if self.kind == "rack":
            one = Body.pinned(held.point(self.local("two", "K")), self.local("one", "K"), angles[0])
            return {"base": base, "two": held, "one": one}
        return {"base": base, "two": two, "one": held}

    def guided(self, base: Body, moved: str, s: Jet, t: float) -> Body:
        """A link on its guide, or, as long as that guide is the cut joint, only in its direction."""
        slide = self.mechanism.joints["slide"]
        turn = slide.direction - slide.block_angle
        outward = slide.block == moved
        angle = plus(base.angle, (turn if outward else -turn, 0, 0))
        free = Body((0, 0, 0), angle)
        guide = base if outward else free
        n = guide.turned(cmath.exp(1j * slide.direction))
        gap = times(n, plus(s, (1j * slide.offset, 0, 0)))
        if self.kind == "prismatic" and not self.closed:
            gap = plus(gap, wave(t, 0.1j, 0.2 - 0.1j, 0.7))
        mine, other = (slide.at, slide.through) if outward else (slide.through, slide.at)
        place = plus(base.point(self.local("base", other)), gap, 1.0 if outward else -1.0)
        return Body.pinned(place, self.local(moved, mine), angle)

    def states(self, t: float) -> dict[str, State]:
        anchors = {"base": (0.11 - 0.2j, 0.4 + 0.3j), "one": (0.3 + 0.1j, -0.2 + 0.9j), "two": (0.2j, 1.5 + 0j)}
        bodies = self.bodies(t)
        self.turned = {name: float(body.angle[0].real) for name, body in bodies.items()}
        return {name: body.state(*anchors[name]) for name, body in bodies.items()}

    def residual(self, t: float) -> np.ndarray:
        states = self.states(t)
        poses = {name: state.pose for name, state in states.items()}
        return np.array(self.cut.residual(poses), float)

    def velocity(self, link: str, place: Vec, t: float) -> Vec:
        """Of the point of a link that is at a place of the frame."""
        body = self.bodies(t)[link]
        local = (complex(place.x, place.y) - body.origin[0]) * cmath.exp(-1j * body.angle[0].real)
        return vec(body.point(local)[1])


@lru_cache
def loaded(kind: str) -> lw.Mechanism:
    return lw.loads(MODEL.replace("JOINTS", {**KINDS, **WELDS}[kind]))


def slope(value: Callable[[float], np.ndarray], t: float, h: float = 1e-3) -> np.ndarray:
    """A derivative by differences of fourth order."""
    return np.asarray((8 * (value(t + h) - value(t - h)) - (value(t + 2 * h) - value(t - 2 * h))) / (12 * h))


TIMES = (0.31, 1.27, 2.9)
kinds = pytest.mark.parametrize("kind", KINDS)


def test_every_kind_that_can_be_cut_is_here() -> None:
    assert {kind.split(",", maxsplit=1)[0] for kind in KINDS} == set(JOINTS) - {"weld"}


@kinds
def test_first_and_second_derivatives_are_those_of_the_equations(kind: str) -> None:
    moving = Moving(kind)
    for t in TIMES:
        drift = np.array(moving.cut.drift(moving.states(t)), float)
        bend = np.array(moving.cut.bend(moving.states(t)), float)
        assert len(drift) == len(bend) == moving.cut.rows
        assert drift == pytest.approx(slope(moving.residual, t), abs=1e-9)
        rate = slope(lambda x: np.array(moving.cut.drift(moving.states(x)), float), t)
        assert bend == pytest.approx(rate, abs=1e-7)


@kinds
def test_derivatives_by_the_links_add_up_to_the_first_derivative_in_time(kind: str) -> None:
    moving = Moving(kind)
    cut = moving.cut
    for t in TIMES:
        states = moving.states(t)
        total = np.zeros(cut.rows)
        for end, parts in cut.parts({name: state.pose for name, state in states.items()}).items():
            v, omega = states[end].velocity, states[end].omega
            total += np.array([x * v.x + y * v.y + turn * omega for x, y, turn in parts], float)
        assert total == pytest.approx(np.array(cut.drift(states), float), abs=1e-12)


def power(wrenches: dict[str, Wrench], states: dict[str, State]) -> float:
    return float(sum(f.dot(states[end].velocity) + m * states[end].omega for end, (f, m) in wrenches.items()))


def moment_about(place: Vec, wrench: Wrench, pose: Pose) -> float:
    return float(wrench[1] + (pose.place - place).cross(wrench[0]))


@kinds
def test_forces_do_the_work_of_their_equations_and_what_others_hold_does_none(kind: str) -> None:
    """F·v + M ω of both links is λ times the rate of the equations, on a carrier that stands; action is reaction."""
    moving = Moving(kind, still=True)
    cut = moving.cut
    for t in TIMES:
        states = moving.states(t)
        poses = {name: state.pose for name, state in states.items()}
        for multipliers in ([3.0, -1.4][: cut.rows], [-2.0, 0.6][: cut.rows]):
            own, held = cut.wrenches(multipliers, poses), cut.held(multipliers[0], poses, abs)
            assert power(own, states) == pytest.approx(float(np.dot(multipliers, cut.drift(states))), abs=1e-12)
            assert power(held, states) == pytest.approx(0.0, abs=1e-12)
            forces, moments = [], []
            for end in (moving.connection.a, moving.connection.b):
                each = [wrenches[end] for wrenches in (own, held) if wrenches]
                forces += [force for force, _ in each]
                moments += [moment_about(Vec(0.0, 0.0), wrench, poses[end]) for wrench in each]
            assert sum(force.x for force in forces) == pytest.approx(0.0, abs=1e-12)
            assert sum(force.y for force in forces) == pytest.approx(0.0, abs=1e-12)
            if moving.kind not in ("prismatic", "revolute"):  # which is open, and whose moment another joint takes
                assert sum(moments) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind.startswith("cam")])
def test_a_roller_or_an_edge_is_pressed_through_its_point_and_a_flat_face_at_right_angles(kind: str) -> None:
    """The force of the equation and what is held besides are one force where the cam touches."""
    moving = Moving(kind, still=True)
    cut, joint = moving.cut, moving.joint
    for t in TIMES:
        poses = {name: state.pose for name, state in moving.states(t).items()}
        bodies = moving.bodies(t)
        at = vec(bodies["one"].point(moving.local("one", "P"))[0])
        own, held = cut.wrenches([2.5], poses), cut.held(2.5, poses, abs)
        force, moment = own["one"]
        if held:
            force, moment = force + held["one"][0], moment + held["one"][1]
        assert abs(force.x) + abs(force.y) > 1.0
        if joint.touch != "flat":
            assert moment_about(at, (force, moment), poses["one"]) == pytest.approx(0.0, abs=1e-12)
        elif joint.side:
            arm = at - vec(bodies["one"].point(moving.local("one", "A"))[0])
            assert force.dot(arm) == pytest.approx(0.0, abs=1e-12)
        else:
            assert not held
            guide = bodies["base"].turned(cmath.exp(1j * moving.mechanism.joints["slide"].direction))[0]
            if kind.endswith("out"):
                assert force.cross(vec(guide)) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("child", ["one", "base"])
@pytest.mark.parametrize("kind", ["prismatic", "prismatic, back", "weld", "revolute"])
def test_a_link_hung_on_another_moves_as_the_joint_lets_it(kind: str, child: str) -> None:
    """Place, velocity and acceleration of any of its points against the motion that is written down."""
    if kind == "revolute":
        mechanism, joint = loaded("revolute"), loaded("revolute").joints["A"]
    else:
        mechanism = loaded(kind)
        joint = mechanism.joints["stiff" if kind == "weld" else "slide"]
    a, b = joint.joined[:2]
    parent = "base" if child == "one" else "one"
    step = TreeJoint(joint.between(a, b), parent, child)
    dimensions = Numbers(mechanism, Trace())
    pair = ChainPair(joint, step, dimensions)
    for t in TIMES:
        slid = wave(t, 0.35, 0.1, 1.9)
        if kind.startswith("prismatic"):
            moving = Moving(kind, closed=True)
            bodies = {**moving.bodies(t), "one": moving.guided(moving.bodies(t)["base"], "one", slid, t)}
        else:
            bodies = Moving("revolute").bodies(t)
            if kind == "weld":
                base, at = bodies["base"], complex(*mechanism.links["base"].points["A"])
                angle = plus(base.angle, (math.radians(35), 0, 0))
                bodies["one"] = Body.pinned(base.point(at), complex(*mechanism.links["one"].points["A"]), angle)
        carrier = bodies[parent].state(0.11 - 0.2j, 0.4 + 0.3j)
        angle = tuple(float(each.real) for each in bodies[child].angle)
        rates = (angle[1], angle[2]) if kind == "revolute" else (float(slid[1]), float(slid[2]))
        rotor = bodies[child].state(0j, 1 + 0j).pose.rotor
        pose = pair.place(carrier.pose, rotor if kind == "revolute" else float(slid[0]))
        state = pair.accelerate(carrier, pair.rates(carrier, pose, rates[0]), *rates)
        assert (state.omega, state.alpha) == pytest.approx(angle[1:], abs=1e-13)
        if kind != "revolute":
            turned = joint.turned(step, dimensions)
            assert turned == pytest.approx(angle[0] - float(bodies[parent].angle[0].real), abs=1e-13)
            assert joint.turn_of(child, mechanism) == pytest.approx(turned, abs=1e-13)
        for local in (0.3 - 0.7j, complex(*mechanism.links[child].points["A"])):
            exact = [vec(each) for each in bodies[child].point(local)]
            found = (state.pose.point(vec(local)), state.velocity_of(vec(local)), state.acceleration_of(vec(local)))
            for one, other in zip(found, exact, strict=True):
                assert (one.x, one.y) == pytest.approx((other.x, other.y), abs=1e-12)


def test_a_point_in_line_with_the_vector_that_a_link_is_carried_by_moves_as_any_other() -> None:
    """Its motion is then a part of that vector's."""
    body = Moving("revolute").bodies(1.27)["one"]
    state = body.state(0.2 + 0.1j, 2.0 + 0j)
    for local in (0.9 + 0.1j, -0.4 + 0.1j, 0.9 + 0.3j):
        exact = [vec(each) for each in body.point(local)]
        found = state.pose.point(vec(local)), state.velocity_of(vec(local)), state.acceleration_of(vec(local))
        for one, other in zip(found, exact, strict=True):
            assert (one.x, one.y) == pytest.approx((other.x, other.y), abs=1e-14)
