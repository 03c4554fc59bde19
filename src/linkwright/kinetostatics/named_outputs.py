"""Outputs in the user's words: ``C.velocity``, ``jaw.angle``, ``reaction O5 on jaw``, ``driver.effort``."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal, Protocol

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import Input
from linkwright.core.outputs import NAMED, Output
from linkwright.elements import Group
from linkwright.errors import RequestError
from linkwright.formula.differentiation import Slopes
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Scalar, Value, absolute, angle, atan, minimum, nearest_turn, select, sqrt
from linkwright.joints.pose import Rotor
from linkwright.kinematics.names import HARMONIC, canonical, find_point, no_output, output_meant
from linkwright.kinematics.output_formulas import traced_course
from linkwright.kinematics.programs import MotionPrograms
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.closure import closable, conditioning, half_transmission, transmission
from linkwright.kinetostatics.trace import ForceOutputs, ForceTrace
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.words import _

#: What jerks are the rates of.
_ACCELERATIONS = {"jerk": "acceleration", "angular_jerk": "angular_acceleration", "slide_jerk": "slide_acceleration"}


@dataclass(frozen=True)
class Quantity:
    """An output that a program computes.

    ``name`` as the user wrote it; ``output``: what it means; ``dimension``: name of its dimension; ``carrier``: what
    the program computes, the number itself, or the tangent of half a link's angle from the direction ``reference``
    (rad).
    """

    name: str
    output: Output
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
    def resting(self) -> ForceTrace:
        """Efforts that hold the mechanism still."""
        ...

    @property
    def outputs(self) -> ForceOutputs:
        """Outputs of the forces by name."""
        ...


class Named:
    """Looks outputs up by the user's words, in the programs of one mechanism.

    ``middle(link)``: an angle near which a link's angle stays, (rad); asked for links whose angle is wanted.
    ``line(link)``: the angle where the input is zero and the turns in a turn of it, of the line near which a link's
    angle runs over the cycle; asked for links whose angle is in the formula of a named output.
    """

    def __init__(
        self, forces: Traces, middle: Callable[[str], float], line: Callable[[str], tuple[float, float]]
    ) -> None:
        self.forces = forces
        self.motion = forces.motion
        self.mechanism: Mechanism = forces.motion.mechanism
        self.middle, self.line = middle, line
        self._slopes: Slopes | None = None

    def quantity(self, name: str) -> Quantity:
        """The output of that name; raises RequestError with the nearest known name."""
        output = output_meant(self.mechanism, name)
        if output.kind == "angle":
            return self._angle(name, output)
        if output.kind in NAMED:
            return Quantity(name, output, output.dimension, self._named(output)[NAMED.index(output.kind)])
        if output.kind in HARMONIC:
            inner = self.quantity(output.owner)
            return Quantity(name, output, output.dimension, inner.value * self._wave(name, output))
        found = self._traced(name, output)
        value = _component(found, output.component) if isinstance(found, Vec) else found
        return Quantity(name, output, output.dimension, value)

    def _traced(self, name: str, output: Output) -> Scalar | Vec:
        if output.kind in _FORMULAS:
            return _FORMULAS[output.kind](self, name, output)
        if output.kind in _ACCELERATIONS:
            found = self._traced(name, replace(output, kind=_ACCELERATIONS[output.kind]))
            if isinstance(found, Vec):
                return Vec(self._in_time(name, found.x), self._in_time(name, found.y))
            return self._in_time(name, found)
        return (self.motion.outputs if output.of_motion else self.forces.outputs).of(output)

    def _in_time(self, name: str, value: Scalar) -> Scalar:
        """Exact derivative in time at constant speed."""
        if self._slopes is None:
            self._slopes = Slopes(self._rates_of_inputs(name))
        return self._slopes(value) if isinstance(value, Value) else 0.0

    def _rates_of_inputs(self, name: str) -> dict[Value, Scalar]:
        trace = self.motion.motion.trace
        seeds: dict[Value, Scalar] = {}
        for driver in self.mechanism.drivers.values():
            if driver.law.constant_speed is None:
                raise RequestError(
                    _(
                        "{name!r}: a jerk needs drivers of constant speed, but the driver {driver} has another law",
                        code="study.no_jerk",
                        name=name,
                        driver=driver.name,
                    )
                )
            driver_motion = self.motion.motion.drivers[driver.name]
            if driver_motion.turn is None:
                seeds[trace.position(Input("slide", driver.name).name)] = driver_motion.rate
            else:
                turn, cosine, sine = (Input(kind, driver.name).name for kind in ("turn", "cos", "sin"))
                seeds[trace.position(turn)] = driver_motion.rate
                seeds[trace.position(cosine)] = -driver_motion.turn.y * driver_motion.rate
                seeds[trace.position(sine)] = driver_motion.turn.x * driver_motion.rate
        return {**seeds, **self._iterated_rates()}

    def _iterated_rates(self) -> dict[Value, Scalar]:
        """Coordinates of groups without closed form with their exact rates.

        A derivative through Newton's step to them would itself have no exact derivative: that needs two steps.
        """
        found: dict[Scalar, Scalar] = {}
        for placed in self.motion.motion.placed.values():
            for joint, coordinate in placed.coordinates.items():
                rate = placed.rates[joint]
                if isinstance(coordinate, Rotor):
                    now = coordinate.now
                    found |= {now.x: -now.y * rate, now.y: now.x * rate}
                elif coordinate is not None:
                    found[coordinate] = rate
        return {value: rate for value, rate in found.items() if isinstance(value, Value)}

    def _angle(self, name: str, output: Output) -> Quantity:
        """Tangent of half the angle from the middle direction: it grows with the angle over a full turn."""
        middle = self.middle(output.owner)
        e = self.motion.motion.poses[output.owner].direction
        c, s = float(np.cos(middle)), float(np.sin(middle))
        along, across = e.x * c + e.y * s, e.y * c - e.x * s
        return Quantity(name, output, "angle", across / (1.0 + along), middle)

    def _named(self, output: Output) -> list[Scalar]:
        """Value and rates of an output that the model names."""
        return traced_course(self.motion.motion, self.mechanism.outputs[output.owner], self._of_formula)

    def _of_formula(self, output: Output | None, order: int) -> Scalar:
        """What moves in the formula of a named output, the input for None, or one of its rates."""
        if output is None:
            name, driver_motion = next(iter(self.motion.motion.drivers.items()))
            kind: Literal["turn", "slide"] = "slide" if driver_motion.turn is None else "turn"
            return (
                self.motion.motion.trace.position(Input(kind, name).name),
                driver_motion.rate,
                driver_motion.second,
            )[order]
        if output.kind in NAMED:
            return self._named(output)[NAMED.index(output.kind) + order]
        if output.kind == "angle" and order == 0:
            return self._continuous(output.owner)
        for _unused in range(order):
            output = output.rate
        found = self._traced(str(output), output)
        return _component(found, output.component) if isinstance(found, Vec) else found

    def _continuous(self, link: str) -> Scalar:
        """The angle of a link with its turns over the cycle."""
        motion, (first, turns) = self.motion.motion, self.line(link)
        line = first + turns * self._of_formula(None, 0) if turns else first
        if motion.angles.follows(link):
            return nearest_turn(motion.angles(link), line)
        e = motion.poses[link].direction
        return nearest_turn(angle(e.y, e.x), line)

    def _wave(self, name: str, output: Output) -> Scalar:
        """Cosine or sine of a multiple of the first driver's angle, by the addition theorem."""
        first = next(iter(self.mechanism.drivers), None)
        turn = None if first is None else self.motion.motion.drivers[first].turn
        if turn is None:
            return no_output(self.mechanism, name)
        cosine, sine = turn.x, turn.y
        for _unused in range(int(output.on) - 1):
            cosine, sine = cosine * turn.x - sine * turn.y, sine * turn.x + cosine * turn.y
        return cosine if output.kind == "cosine" else sine

    # formulas -----------------------------------------------------------------------------
    def closeness(self, name: str, output: Output) -> Scalar:
        """Square under a dyad's root as a share of its largest value: 0 at a singular position."""
        placed = self.motion.motion.placed
        every = [g for g in self.motion.structure.groups if g.cuts]
        total: Scalar | None = None
        for group in [self._group(name, output)] if output.owner else every:
            if placed[group.name].dyad is None:
                continue
            quality = placed[group.name].quality
            total = quality if total is None else minimum(total, quality)
        if total is None:
            raise RequestError(
                _(
                    "{name!r}: there is no group with a closed form, and only those tell how near they "
                    "are to a singular position; choose another output",
                    code="study.no_closed_form",
                    name=name,
                )
            )
        return total

    def transmission_angle(self, name: str, output: Output) -> Scalar:
        """Transmission angle of a dyad, named by its inner pin or by its links."""
        return transmission(self.motion.outputs, self._dyad(name, output))

    def half_transmission(self, name: str) -> Scalar:
        """Tangent of half a transmission angle, by the words for the angle."""
        return half_transmission(self.motion.outputs, self._dyad(name, output_meant(self.mechanism, name)))

    def conditioning(self, name: str, output: Output) -> Scalar:
        """Determinant of a group's closure equations with unit columns: 0 at a singular position."""
        return conditioning(self.motion.outputs, self._group(name, output))

    def velocity_ratio(self, name: str, output: Output) -> Scalar:
        """Rate of a link's angle, or of a guide's displacement, over the first driver's."""
        slides = output.owner in self.mechanism.guides
        rate = Output("slide_velocity" if slides else "angular_velocity", output.owner)
        return self.motion.outputs.value(rate.row) / self._first_rate(name)

    def heat(self, name: str, output: Output) -> Scalar:
        """Force of a pin times its pin radius times the relative speed of its two links, with the speed's sign."""
        joint, link = output.owner, output.on
        pin = self.mechanism.pins.get(joint)
        if pin is None or not pin.pin_radius:
            no_output(self.mechanism, name)
        other = next(each for each in pin.joined if each != link)
        force = sqrt(self.forces.forces.reaction(joint, link).square)
        radius = self.motion.motion.dimensions(f"{joint}.pin_radius")
        return force * radius * self.motion.motion.turning(link, other)

    def reaction_direction(self, name: str, output: Output) -> Scalar:
        """Direction of a joint's force from the x axis, above -π up to π; NaN where there is no force."""
        force = self.forces.forces.reaction(output.owner, output.on)
        return select(force.square > 0.0, angle(force.y + 0.0, force.x), math.nan)

    def areal_velocity(self, name: str, output: Output) -> Scalar:
        """Area per time that the line from the frame's origin to a point sweeps over, counter-clockwise positive."""
        place, velocity, _unused = self.motion.outputs.point(output.owner)
        return 0.5 * place.cross(velocity)

    def distance(self, name: str, output: Output) -> Scalar:
        """Distance of two points, a length of the link that both are written of, ``distance coupler.A coupler.B``."""
        (link, a), (other, b) = (find_point(self.mechanism, each) for each in (output.owner, output.on))
        if link == other:
            return self.motion.motion.dimensions.distance(link, a, b)
        keys = canonical(self.mechanism, link, a), canonical(self.mechanism, other, b)
        first, second = (self.motion.outputs.point(each)[0] for each in keys)
        return sqrt((second - first).square)

    def holding_effort(self, name: str, output: Output) -> Scalar:
        """Effort of a driver that holds the machine still in its position, without friction of joints."""
        return self.forces.resting.efforts[output.owner]

    def hand_force(self, name: str, output: Output) -> Scalar:
        """Force on a point, along its path in the sense of the first driver, that holds the machine still."""
        first = next(iter(self.mechanism.drivers), None)
        if first is None:
            no_output(self.mechanism, name)
        velocity = self.motion.outputs.point(output.owner)[1]
        return self.forces.resting.efforts[first] * self._first_rate(name) / sqrt(velocity.square)

    def equivalent_inertia(self, name: str, output: Output) -> Scalar:
        """Inertia on the first driver's link of the same kinetic energy as all links."""
        motion = self.motion.motion
        total: Scalar = 0.0
        for link in self.mechanism.links:
            state = motion.states[link]
            velocity = state.velocity_of(motion.dimensions.centre(link))
            total = total + motion.dimensions(f"{link}.mass") * velocity.square
            total = total + motion.dimensions(f"{link}.inertia") * state.omega * state.omega
        rate = self._first_rate(name)
        return total / (rate * rate)

    def _first_rate(self, name: str) -> Scalar:
        driver_motion = next(iter(self.motion.motion.drivers.values()), None)
        return no_output(self.mechanism, name) if driver_motion is None else driver_motion.rate

    def _dyad(self, name: str, output: Output) -> Group:
        group = self._group(name, output)
        if len(group.unknowns) != 2 or group not in closable(self.motion.structure):
            raise RequestError(
                _(
                    "{name!r}: a transmission angle is that of a dyad cut at a pin; {group} ({links}) is "
                    "none; use conditioning",
                    code="study.no_dyad",
                    name=name,
                    links=tuple(group.links),
                    group=group.signature,
                )
            )
        return group

    def _group(self, name: str, output: Output) -> Group:
        joint = output.owner
        inner = {g.name: g for g in self.motion.structure.groups if g.cuts}
        inner |= {c.joint: g for g in self.motion.structure.groups for c in g.inner_joints}
        if joint not in inner:
            hint = offered(joint, inner, _("inner joints are: {names}"))
            raise RequestError(
                _(
                    "{name!r}: {joint!r} is not the inner joint of a group; {hint}",
                    code="study.not_inner",
                    name=name,
                    joint=joint,
                    hint=hint,
                )
            )
        return inner[joint]


#: What programs have no row of.
_FORMULAS: dict[str, Callable[[Named, str, Output], Scalar]] = {
    "closeness": Named.closeness,
    "transmission_angle": Named.transmission_angle,
    "conditioning": Named.conditioning,
    "velocity_ratio": Named.velocity_ratio,
    "heat": Named.heat,
    "reaction_direction": Named.reaction_direction,
    "areal_velocity": Named.areal_velocity,
    "distance": Named.distance,
    "equivalent_inertia": Named.equivalent_inertia,
    "holding_effort": Named.holding_effort,
    "hand_force": Named.hand_force,
}


def _component(vector: Vec, axis: str) -> Scalar:
    """A component, or the size."""
    if axis:
        return vector.x if axis == "x" else vector.y
    if _still(vector.x):
        return absolute(vector.y)
    return absolute(vector.x) if _still(vector.y) else sqrt(vector.square)


def _still(value: Scalar) -> bool:
    return isinstance(value, float) and value == 0.0
