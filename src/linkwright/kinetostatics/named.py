"""Outputs in the user's words: ``C.velocity``, ``jaw.angle``, ``reaction O5 on jaw``, ``driver.effort``."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from linkwright.core.dataclass import dataclass
from linkwright.engine.trace import Scalar, Value, absolute, atan, minimum, slope, sqrt
from linkwright.engine.vector import Vec
from linkwright.errors import RequestError
from linkwright.kinematics.names import canonical, find_point
from linkwright.kinematics.programs import MotionPrograms
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.closure import closable, conditioning, transmission
from linkwright.kinetostatics.outputs import ForceOutputs
from linkwright.kinetostatics.trace import ForceTrace
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.structure.group import Group
from linkwright.words.sentence import Sentence

Floats = NDArray[np.float64]

POINT_PARTS = {
    "position": ("p", "length"),
    "velocity": ("v", "velocity"),
    "acceleration": ("a", "acceleration"),
    "jerk": ("j", "jerk"),
}
LINK_PARTS = {"angular_velocity": "w", "angular_acceleration": "g", "angular_jerk": "g"}
SLIDE_PARTS = {
    "displacement": ("s", "length"),
    "velocity": ("sv", "velocity"),
    "acceleration": ("sa", "acceleration"),
    "jerk": ("sa", "jerk"),
}
#: Dimension of output rate over input rate, by the kinds of output and input.
RATIO = {
    ("angle", "angle"): "dimensionless",
    ("length", "length"): "dimensionless",
    ("length", "angle"): "length_per_angle",
    ("angle", "length"): "angle_per_length",
}


@dataclass(frozen=True)
class Quantity:
    """An output that a program computes.

    ``name`` as the user wrote it; ``dimension``: name of its dimension; ``carrier``: what the program computes, the
    number itself, or the tangent of half a link's angle from the direction ``reference`` (rad).
    """

    name: str
    dimension: str
    carrier: Scalar
    reference: float | None = None

    def shown(self, values: Floats) -> Floats:
        """The quantity from its carrier: both grow together, so extremes of one are extremes of the other."""
        return values if self.reference is None else np.asarray(self.reference + 2.0 * np.arctan(values))

    @property
    def value(self) -> Scalar:
        """The quantity itself as a traced value."""
        return self.carrier if self.reference is None else self.reference + 2.0 * atan(self.carrier)

    def slope(self, values: Floats) -> Floats:
        """Derivative of the quantity by its carrier."""
        return np.ones_like(values) if self.reference is None else np.asarray(2.0 / (1.0 + values * values))


class Traces(Protocol):
    """Traced motion and forces of a mechanism."""

    @property
    def motion(self) -> MotionPrograms | MotionSolver:
        """The motion."""
        ...

    @property
    def forces(self) -> ForceTrace:
        """Reactions and efforts."""
        ...

    @property
    def outputs(self) -> ForceOutputs:
        """Outputs of the forces by name."""
        ...


class Named:
    """Looks outputs up by the user's words, in the programs of one mechanism.

    ``middle(link)``: an angle near which a link's angle stays, (rad); asked for links whose angle is wanted.
    """

    def __init__(self, forces: Traces, middle: Callable[[str], float]) -> None:
        self.forces = forces
        self.motion = forces.motion
        self.mechanism: Mechanism = forces.motion.mechanism
        self.middle = middle

    def quantity(self, name: str) -> Quantity:
        """The output of that name; raises RequestError with the nearest known name."""
        words = name.split()
        if words and words[0] in _PHRASES:
            return _PHRASES[words[0]](self, name, words[1:])
        base, _, axis = name.rpartition(".")
        if axis in ("x", "y") and base in ("shaking_force",):
            return Quantity(name, "force", self.forces.outputs.value(f"shake.{axis}"))
        for reader in (self._driver, self._link, self._slide, self._point):
            found = reader(name)
            if found is not None:
                return found
        raise self._unknown(name)

    # readers ------------------------------------------------------------------------------
    def _driver(self, name: str) -> Quantity | None:
        owner, _, part = name.rpartition(".")
        if part == "effort" and owner in self.mechanism.drivers:
            return Quantity(name, self._effort_dimension(owner), self.forces.outputs.value(f"effort:{owner}"))
        return None

    def _link(self, name: str) -> Quantity | None:
        owner, _, part = name.rpartition(".")
        if owner not in self.mechanism.links:
            return None
        if part == "angle":
            return self._angle(name, owner)
        if part in LINK_PARTS:
            value = self.motion.outputs.value(f"{LINK_PARTS[part]}:{owner}")
            return Quantity(name, part, self._in_time(name, value) if part == "angular_jerk" else value)
        return None

    def _slide(self, name: str) -> Quantity | None:
        owner, _, part = name.rpartition(".")
        if owner in self.mechanism.guides and part in SLIDE_PARTS:
            kind, dimension = SLIDE_PARTS[part]
            value = self.motion.outputs.value(f"{kind}:{owner}")
            return Quantity(name, dimension, self._in_time(name, value) if part == "jerk" else value)
        return None

    def _point(self, name: str) -> Quantity | None:
        base, _, last = name.rpartition(".")
        part, axis = last, ""
        if last in ("x", "y"):
            axis = last
            owner, _, part = base.rpartition(".")
            if part not in POINT_PARTS:
                owner, part = base, "position"
        else:
            owner = base
        if part not in POINT_PARTS or not owner or (part == "position" and not axis):
            return None
        kind, dimension = POINT_PARTS[part]
        vector = self.motion.outputs.point(self.point_key(owner))[min("pvaj".index(kind), 2)]
        if kind == "j":
            vector = Vec(self._in_time(name, vector.x), self._in_time(name, vector.y))
        return Quantity(name, dimension, _component(vector, axis))

    def _in_time(self, name: str, value: Scalar) -> Scalar:
        """Exact derivative in time at constant speed."""
        trace = self.motion.motion.trace
        seeds: dict[Value, Scalar] = {}
        for driver in self.mechanism.drivers.values():
            if driver.law.constant_speed is None:
                raise RequestError(Sentence("study.no_jerk", name=name, driver=driver.name))
            given = self.motion.motion.drivers[driver.name]
            if given.turn is None:
                seeds[trace.position(f"slide:{driver.name}")] = given.rate
            else:
                seeds[trace.position(f"turn:{driver.name}")] = given.rate
                seeds[trace.position(f"cos:{driver.name}")] = -given.turn.y * given.rate
                seeds[trace.position(f"sin:{driver.name}")] = given.turn.x * given.rate
        return slope(value, seeds)

    def point_key(self, owner: str) -> str:
        """The canonical key of a point, or of a link's mass centre."""
        link = self.mechanism.links.get(owner.removesuffix(".centre"))
        if owner.endswith(".centre") and link is not None and "centre" not in link.points:
            return owner.removesuffix("centre") + "@centre"
        return canonical(self.mechanism, *find_point(self.mechanism, owner))

    def _angle(self, name: str, link: str) -> Quantity:
        """Tangent of half the angle from the middle direction: it grows with the angle over a whole turn."""
        middle = self.middle(link)
        e = self.motion.motion.poses[link].direction
        c, s = float(np.cos(middle)), float(np.sin(middle))
        along, across = e.x * c + e.y * s, e.y * c - e.x * s
        return Quantity(name, "angle", across / (1.0 + along), middle)

    def _effort_dimension(self, driver: str) -> str:
        joint = self.mechanism.joints[self.mechanism.drivers[driver].joint]
        return "torque" if joint.coordinate == "turn" else "force"

    # phrases ------------------------------------------------------------------------------
    def input_torque(self, name: str, rest: list[str]) -> Quantity:
        if rest or not self.mechanism.drivers:
            raise self._unknown(name)
        first = next(iter(self.mechanism.drivers))
        return Quantity(name, self._effort_dimension(first), self.forces.outputs.value(f"effort:{first}"))

    def power(self, name: str, rest: list[str]) -> Quantity:
        if rest:
            raise self._unknown(name)
        return Quantity(name, "power", self.forces.outputs.value("driver_power"))

    def shaking_force(self, name: str, rest: list[str]) -> Quantity:
        if rest:
            raise self._unknown(name)
        x, y = (self.forces.outputs.value(f"shake.{axis}") for axis in "xy")
        return Quantity(name, "force", _component(Vec(x, y), ""))

    def shaking_moment(self, name: str, rest: list[str]) -> Quantity:
        if rest:
            raise self._unknown(name)
        return Quantity(name, "torque", self.forces.outputs.value("shake_moment"))

    def reaction(self, name: str, rest: list[str]) -> Quantity:
        """``reaction O5 on jaw``, with ``.x`` or ``.y`` for a component."""
        joint, link, axis = self._at_joint(name, rest)
        return Quantity(name, "force", _component(self.forces.forces.reaction(joint, link), axis))

    def couple(self, name: str, rest: list[str]) -> Quantity:
        joint, link, _ = self._at_joint(name, rest)
        return Quantity(name, "torque", self.forces.forces.couple(joint, link))

    def load(self, name: str, rest: list[str]) -> Quantity:
        """Size of a load's force."""
        if len(rest) != 1 or rest[0] not in self.mechanism.loads:
            raise self._unknown(name)
        x, y = (self.forces.outputs.value(f"lf:{rest[0]}.{axis}") for axis in "xy")
        return Quantity(name, "force", _component(Vec(x, y), ""))

    def closeness(self, name: str, rest: list[str]) -> Quantity:
        """Square under a dyad's root as a share of its largest value: 0 at a singular position."""
        placed = self.motion.motion.placed
        groups = [self._group(name, rest[0])] if rest else [g for g in self.motion.structure.groups if g.cuts]
        total: Scalar | None = None
        for group in groups:
            if placed[group.name].dyad is None:
                continue
            quality = placed[group.name].quality
            total = quality if total is None else minimum(total, quality)
        if total is None:
            raise RequestError(Sentence("study.no_closed_form", name=name))
        return Quantity(name, "dimensionless", total)

    def transmission_angle(self, name: str, rest: list[str]) -> Quantity:
        """Transmission angle of a dyad, named by its inner pin or by its links."""
        if len(rest) != 1:
            raise self._unknown(name)
        group = self._group(name, rest[0])
        if len(group.unknowns) != 2 or group not in closable(self.motion.structure):
            raise RequestError(
                Sentence("study.no_dyad", name=name, links=tuple(group.links), group=group.signature)
            )
        return Quantity(name, "angle", transmission(self.motion.outputs, group))

    def conditioning(self, name: str, rest: list[str]) -> Quantity:
        """Determinant of a group's closure equations with unit columns: 0 at a singular position."""
        if len(rest) != 1:
            raise self._unknown(name)
        group = self._group(name, rest[0])
        return Quantity(name, "dimensionless", conditioning(self.motion.outputs, group))

    def velocity_ratio(self, name: str, rest: list[str]) -> Quantity:
        """Rate of a link's angle, or of a guide's displacement, over the first driver's."""
        if len(rest) != 1 or not self.mechanism.drivers:
            raise self._unknown(name)
        slides = rest[0] in self.mechanism.guides
        if not slides and rest[0] not in self.mechanism.links:
            raise self._unknown(name)
        rate = self.motion.outputs.value(f"{'sv' if slides else 'w'}:{rest[0]}")
        driver = self.mechanism.drivers[next(iter(self.mechanism.drivers))]
        turns = self.mechanism.joints[driver.joint].coordinate == "turn"
        dimension = RATIO["length" if slides else "angle", "angle" if turns else "length"]
        return Quantity(name, dimension, rate / self.motion.motion.drivers[driver.name].rate)

    def heat(self, name: str, rest: list[str]) -> Quantity:
        """Force of a pin times its pin radius times the relative speed of its two links, with the speed's sign."""
        joint, link, _ = self._at_joint(name, rest)
        pin = self.mechanism.pins.get(joint)
        if pin is None or not pin.pin_radius:
            raise self._unknown(name)
        other = next(each for each in pin.joined if each != link)
        states = self.motion.motion.states
        force = sqrt(self.forces.forces.reaction(joint, link).square)
        radius = self.motion.motion.dimensions(f"{joint}.pin_radius")
        return Quantity(name, "power", force * radius * (states[link].omega - states[other].omega))

    def areal_velocity(self, name: str, rest: list[str]) -> Quantity:
        """Area per time that the line from the frame's origin to a point sweeps over, counter-clockwise positive."""
        if len(rest) != 1:
            raise self._unknown(name)
        place, velocity, _ = self.motion.outputs.point(self.point_key(rest[0]))
        return Quantity(name, "areal_velocity", 0.5 * place.cross(velocity))

    def distance(self, name: str, rest: list[str]) -> Quantity:
        """Distance of two points, a length of the link that both are written of, ``distance coupler.A coupler.B``."""
        if len(rest) != 2:
            raise self._unknown(name)
        (link, a), (other, b) = (find_point(self.mechanism, each) for each in rest)
        if link == other:
            dimensions = self.motion.motion.dimensions
            between = dimensions.point(link, b) - dimensions.point(link, a)
        else:
            first, second = (self.motion.outputs.point(self.point_key(each))[0] for each in rest)
            between = second - first
        return Quantity(name, "length", sqrt(between.square))

    def equivalent_inertia(self, name: str, rest: list[str]) -> Quantity:
        """Inertia on the first driver's link of the same kinetic energy as all links."""
        if rest or not self.mechanism.drivers:
            raise self._unknown(name)
        motion = self.motion.motion
        total: Scalar = 0.0
        for link in self.mechanism.links:
            state = motion.states[link]
            velocity = state.velocity_of(motion.dimensions.centre(link))
            total = total + motion.dimensions(f"{link}.mass") * velocity.square
            total = total + motion.dimensions(f"{link}.inertia") * state.omega * state.omega
        rate = next(iter(motion.drivers.values())).rate
        return Quantity(name, "inertia", total / (rate * rate))

    def _group(self, name: str, joint: str) -> Group:
        inner = {g.name: g for g in self.motion.structure.groups if g.cuts}
        inner |= {c.joint: g for g in self.motion.structure.groups for c in g.inner_joints}
        if joint not in inner:
            hint = offered(joint, inner, "study.inner_joints")
            raise RequestError(Sentence("study.not_inner", name=name, joint=joint, hint=hint))
        return inner[joint]

    def _at_joint(self, name: str, rest: list[str]) -> tuple[str, str, str]:
        axis = ""
        if rest and rest[-1].endswith((".x", ".y")):
            rest = [*rest[:-1], rest[-1][:-2]]
            axis = name[-1]
        joints = self.mechanism.joints
        if len(rest) not in (1, 3) or rest[0] not in joints or (len(rest) == 3 and rest[1] != "on"):
            raise self._unknown(name)
        joined = joints[rest[0]].joined
        if len(rest) == 3:
            if rest[2] not in joined:
                raise RequestError(
                    Sentence(
                        "study.not_touching", name=name, joint=rest[0], link=rest[2], joined=tuple(joined)
                    )
                )
            return rest[0], rest[2], axis
        moving = [link for link in joined if link != "frame"]
        if len(moving) != 1:
            raise RequestError(
                Sentence("study.say_link", name=name, joint=rest[0], joined=tuple(joined), moving=moving[0])
            )
        return rest[0], moving[0], axis

    def _unknown(self, name: str) -> RequestError:
        known = list(output_names(self.mechanism))
        hint = offered(name, known, "study.such_as", most=6)
        return RequestError(
            Sentence("study.no_such_output", name=name, mechanism=self.mechanism.name, hint=hint)
        )


_PHRASES: dict[str, Callable[[Named, str, list[str]], Quantity]] = {
    "input_torque": Named.input_torque,
    "power": Named.power,
    "shaking_force": Named.shaking_force,
    "shaking_moment": Named.shaking_moment,
    "reaction": Named.reaction,
    "couple": Named.couple,
    "load": Named.load,
    "closeness": Named.closeness,
    "transmission_angle": Named.transmission_angle,
    "conditioning": Named.conditioning,
    "velocity_ratio": Named.velocity_ratio,
    "heat": Named.heat,
    "areal_velocity": Named.areal_velocity,
    "distance": Named.distance,
    "equivalent_inertia": Named.equivalent_inertia,
}
#: First words of outputs that are phrases, ``transmission_angle B``.
PHRASES = frozenset(_PHRASES)


def output_names(mechanism: Mechanism) -> Iterator[str]:
    """Names of outputs that a study can ask for, most of them."""
    for driver in mechanism.drivers:
        yield f"{driver}.effort"
    yield from ("input_torque", "power", "shaking_force", "shaking_moment", "closeness")
    for link in mechanism.links:
        yield from (f"{link}.angle", f"{link}.angular_velocity", f"{link}.angular_acceleration")
    for name, joint in mechanism.joints.items():
        if name in mechanism.guides:
            yield from (f"{name}.{part}" for part in SLIDE_PARTS)
            yield f"couple {name} on {mechanism.guides[name].block}"
        yield from (f"reaction {name} on {link}" for link in joint.joined if link != "frame")
    keys = {canonical(mechanism, name, p) for name, link in mechanism.links.items() for p in link.points}
    for key in sorted(keys):
        yield from (f"{key}.x", f"{key}.y", f"{key}.velocity", f"{key}.acceleration")


def _component(vector: Vec, axis: str) -> Scalar:
    """A component, or the size."""
    if axis:
        return vector.x if axis == "x" else vector.y
    if _still(vector.x):
        return absolute(vector.y)
    return absolute(vector.x) if _still(vector.y) else sqrt(vector.square)


def _still(value: Scalar) -> bool:
    return isinstance(value, float) and value == 0.0
