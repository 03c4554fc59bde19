"""The equation of motion M(q) q'' + h(q, q', t) = 0 of a mechanism under forces, from the formulas of joint forces.

A driver's effort T is affine in the accelerations of the inputs. Where nothing drives but actuators and loads it is
zero: M is the exact derivative of T by the accelerations, h is T without them. ½ M' q'² never has to be formed, for
it is in h. With friction in joints T bends with the accelerations; Newton's steps on its exact slope then find q''.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import Input, driven
from linkwright.core.outputs import row_name
from linkwright.drivers.base import Driver
from linkwright.dynamics.site import FreeSite, SeenFromModel, coordinate_of, freed, load_numbers, near_name
from linkwright.dynamics.stops import contact_name, stop_gap
from linkwright.dynamics.switches import Held, Switches, gap_name, gap_rate_name
from linkwright.errors import LinkwrightError
from linkwright.formula.differentiation import slope
from linkwright.formula.linear_algebra import determinant, product, solution
from linkwright.formula.numpy_backend import numpy_program
from linkwright.formula.program import Program
from linkwright.formula.trace import Scalar, Trace, Value, cos, sin
from linkwright.kinematics.assembly import Assembly, modal_groups
from linkwright.kinematics.groups import jacobian
from linkwright.kinematics.programs import Manner, motion_programs
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinematics.trace import MotionTrace
from linkwright.kinetostatics.load_site import TracedSite
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: Newton's steps for the accelerations where joints rub.
RUBBING_STEPS = 4
#: Newton's steps of groups without closed form in one evaluation.
ITERATIONS = 2


class EquationOfMotion:
    """The equation of motion of a mechanism; every driver's coordinate is free but the ``prescribed`` ones.

    Its programs take positions (all of them inputs per lane): ``q:NAME``, ``qd:NAME`` of every driver (rad, rad/s or
    m, m/s), ``second:NAME`` of the prescribed ones, ``time``, ``switch:K`` (1 or 0; see ``Switches``), ``mode:GROUP``
    where ``flipping``, the chain coordinates of groups without closed form, and ``varied`` dimensions.
    Outputs: ``qdd:NAME`` q'' of the free ones; ``M:A:B``, ``h:A``; ``power`` (W) of all forces, ``kinetic`` (J),
    whose difference to the work since the start is the residual of a run; ``gap:K``; ``closure:GROUP``, 0 where a
    group is singular; ``outcome``; ``next:STATE``.

    Source: d'Alembert's principle in the inputs (Lagrange's equations); Wittenburg, Dynamics of Multibody Systems.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        *,
        prescribed: Iterable[str] = (),
        varied: Iterable[str] = (),
        flipping: bool = False,
        assembly: Assembly | None = None,
        coordinates: Mapping[str, Driver] | None = None,
    ) -> None:
        """``coordinates``: the joints whose coordinates are free, instead of those of the drivers."""
        self.source = mechanism
        self.mechanism = model = freed(mechanism)
        site: Callable[..., TracedSite] = FreeSite
        if coordinates is not None:
            site = SeenFromModel.of(model)
            self.mechanism = replace(model, drivers=coordinates, assembly={}, drawing={})
        if not self.mechanism.drivers:
            raise LinkwrightError(
                _(
                    "{name!r} has no driver, so nothing says which coordinates its motion is found in; add a driver "
                    "with free: true",
                    code="dynamics.no_coordinate",
                    name=mechanism.name,
                )
            )
        self.names = list(self.mechanism.drivers)
        kept = set(prescribed)
        self.free = [name for name in self.names if name not in kept]
        self.prescribed = [name for name in self.names if name in kept]
        self.rotary = {name: each.law.rotary for name, each in self.mechanism.drivers.items()}
        self.varied = frozenset(varied)
        manner = Manner(self.varied, iterations=ITERATIONS)
        if flipping:
            groups = modal_groups(motion_programs(self.mechanism, manner).structure)
            manner = Manner(self.varied, frozenset(groups), ITERATIONS)
        self.solver = MotionSolver(self.mechanism, manner, assembly)
        self.load_numbers, self.tables = load_numbers(model)
        magnitudes = frozenset(self.mechanism.loads)
        self.rubs = any(joint.friction_arm for joint in self.mechanism.joints.values())
        self.forces = ForceSolver(self.solver, along_input=magnitudes, rubbing=self.rubs, site=site)
        self.plain = ForceSolver(self.solver, along_input=magnitudes, site=site)
        self.resting = ForceSolver(self.solver, along_input=magnitudes, inertia=False, site=site)

    def __getstate__(self) -> dict[str, Any]:
        """All but what every process traces for itself."""
        own = ("traced", "_source", "switches", "_programs")
        return {name: each for name, each in self.__dict__.items() if name not in own}

    @cached_property
    def _programs(self) -> dict[tuple[str, ...], Program]:
        return {}

    # numbers and inputs ---------------------------------------------------------------------------------
    @cached_property
    def numbers(self) -> dict[str, float]:
        """Values of all parameters of the programs."""
        return {**self.solver.nominal.parameters, **self.load_numbers}

    @cached_property
    def start(self) -> Floats:
        """Where the drivers' laws begin; of one without a law its ``start``, else its place in the drawing, rad or m,
        (drivers,)."""
        follows = self.source.path is not None
        laws = {name: each.law if follows else each.law.own for name, each in self.source.drivers.items()}
        begins = {name: law.at(0.0) for name, law in laws.items() if law.prescribed or law.at(0.0) != 0.0}
        return np.array([begins.get(name, self.solver.assembly.inputs[name]) for name in self.names])

    @cached_property
    def groups(self) -> list[str]:
        """The groups that close a loop."""
        return [name for name, placed in self.solver.motion.placed.items() if placed.cuts]

    @cached_property
    def modes(self) -> list[str]:
        """The groups whose assembly modes are inputs."""
        return [name for name in modal_groups(self.solver.structure) if name in self.solver.manner.flipping]

    @cached_property
    def states(self) -> dict[str, float]:
        """Chain coordinates of the groups without closed form, in the drawing."""
        return {name: self.solver.assembly.states[name] for name in self.solver.motion.next_states}

    @cached_property
    def replaced(self) -> list[str]:
        """The model's drivers whose joints are no coordinates."""
        return [name for name in self.source.drivers if name not in self.names]

    # traced ---------------------------------------------------------------------------------------------
    @cached_property
    def _source(self) -> dict[str, Scalar]:
        """Efforts with their derivatives by the accelerations, and what else is taken from the motion's trace."""
        motion = self.solver.motion
        seconds = {name: motion.trace.position(Input("second", name).name) for name in self.names}
        out: dict[str, Scalar] = {}
        for name in self.names:
            effort, plain = (each.outputs.value(row_name("effort", name)) for each in (self.forces, self.plain))
            out[f"T:{name}"] = effort
            out[f"S:{name}"] = self.resting.outputs.value(row_name("effort", name))
            out |= {f"T:{name}:{other}": slope(effort, {second: 1.0}) for other, second in seconds.items()}
            out |= {f"M:{name}:{other}": slope(plain, {second: 1.0}) for other, second in seconds.items()}
        if self.rubs:
            out["rubbing"] = self.forces.forces.friction_power
        out |= {f"closure:{group}": group_quality(motion, group) for group in self.groups}
        out |= {f"next:{name}": value for name, value in motion.next_states.items()}
        out |= {f"stop:{name}": stop_gap(motion, stop) for name, stop in self.mechanism.stops.items()}
        for name in self.replaced:
            out[f"input:{name}"], out[f"input_rate:{name}"] = coordinate_of(motion, self.source.drivers[name])
        return {**out, "outcome": motion.outcome}

    def _kinematic(self) -> list[Scalar]:
        """All that the motion is found from."""
        found = [self.solver.motion.outcome]
        for state in self.solver.motion.states.values():
            place, velocity, direction = state.pose.place, state.velocity, state.pose.direction
            found += [place.x, place.y, direction.x, direction.y, velocity.x, velocity.y, state.omega, state.alpha]
        return found

    @cached_property
    def switches(self) -> Switches:
        """The comparisons that are held between events."""
        seconds = {Input("second", name).name for name in self.names}
        return Switches.of(self.solver.motion.trace, self._source.values(), self._kinematic(), seconds)

    @cached_property
    def traced(self) -> tuple[Trace, dict[str, Scalar | bool]]:
        """All outputs in a trace of their own."""
        t = Trace()
        zero: dict[str, Scalar] = dict.fromkeys(self.names, 0.0)
        seconds = zero | {name: t.position(Input("second", name).name) for name in self.prescribed}
        found, gaps = self._inlined(t, seconds)
        second = self._accelerations(found, seconds)
        for _step in range(RUBBING_STEPS if self.rubs else 0):
            found, _again = self._inlined(t, second)
            second = self._accelerations(found, second)
        if self.rubs or self.prescribed:
            found, _again = self._inlined(t, second)
        out: dict[str, Scalar | bool] = {f"qdd:{name}": second[name] for name in self.free}
        out |= self._energies(t, found)
        out |= {name: value for name, value in found.items() if not name.startswith("T:")}
        out |= {f"h:{name}": found[f"T:{name}"] for name in self.names} | gaps
        return t, out | self._rates(t, out, second)

    def _rates(
        self, t: Trace, out: Mapping[str, Scalar | bool], second: Mapping[str, Scalar]
    ) -> dict[str, Scalar | bool]:
        """Rates of gaps, ``gap_rate:K``, and of stops, ``stop_rate:NAME``, ``stop_second:NAME``, along the motion,
        and their derivatives by the free rates, ``by:K:NAME`` and ``stop_by:NAME:NAME``."""
        rates = {name: t.position(f"qd:{name}") for name in self.names}
        along: dict[Value, Scalar] = {t.position(f"q:{name}"): rate for name, rate in rates.items()}
        along |= {rates[name]: second[name] for name in self.names} | {t.position("time"): 1.0}
        found: dict[str, Scalar | bool] = {}
        for number in range(len(self.switches.lines)):
            gap = _number(out[gap_name(number)])
            found[gap_rate_name(number)] = slope(gap, along)
            found |= {f"by:{number}:{name}": slope(gap, {rates[name]: 1.0}) for name in self.free}
        for stop in self.mechanism.stops:
            rate = slope(_number(out[f"stop:{stop}"]), along)
            found |= {f"stop_rate:{stop}": rate, f"stop_second:{stop}": slope(rate, along)}
            found |= {f"stop_by:{stop}:{name}": slope(rate, {rates[name]: 1.0}) for name in self.free}
        return found

    def _accelerations(self, found: Mapping[str, Scalar | bool], second: Mapping[str, Scalar]) -> dict[str, Scalar]:
        """One step of Newton's method for the free accelerations: the last one where nothing rubs."""
        matrix = [[_number(found[f"T:{a}:{b}"]) for b in self.free] for a in self.free]
        change = solution(matrix, [-_number(found[f"T:{a}"]) for a in self.free]) if self.free else []
        return {**second, **{name: second[name] + each for name, each in zip(self.free, change, strict=True)}}

    def _energies(self, t: Trace, found: Mapping[str, Scalar | bool]) -> dict[str, Scalar]:
        """Power of all forces, of the prescribed inputs as well, and kinetic energy."""
        rates = [t.position(f"qd:{name}") for name in self.names]
        power: Scalar = 0.0
        for name, rate in zip(self.names, rates, strict=True):
            power = power - _number(found[f"S:{name}"]) * rate
            if name in self.prescribed:
                power = power + _number(found[f"T:{name}"]) * rate
        if self.rubs:
            power = power - _number(found["rubbing"])
        mass = [[_number(found[f"M:{a}:{b}"]) for b in self.names] for a in self.names]
        kinetic: Scalar = 0.0
        for rate, row in zip(rates, product(mass, rates), strict=True):
            kinetic = kinetic + 0.5 * rate * row
        return {"power": power, "kinetic": kinetic}

    def _inlined(self, t: Trace, seconds: Mapping[str, Scalar]) -> tuple[dict[str, Scalar | bool], dict[str, Scalar]]:
        source, held = self.switches.program(self._source)
        replay = Held(source, held, t, self._given(t, source, seconds))
        return replay.outputs, replay.gaps

    def _given(self, t: Trace, source: Program, seconds: Mapping[str, Scalar]) -> dict[str, Scalar]:
        """The inputs of a program of the motion's trace as values of another trace."""
        given: dict[str, Scalar] = {}
        for name in self.names:
            course = (t.position(f"q:{name}"), t.position(f"qd:{name}"), seconds[name])
            given |= driven(name, self.rotary[name], course, cos, sin)
        carried = self.solver.motion.next_states
        for name in source.fields:
            given[name] = t.position(name) if name in carried else 0.0
        given |= {name: t.position(name) for name in source.parameters if name in self.varied}
        given |= {name: t.position(name) for name in map(contact_name, self.mechanism.stops)}
        given |= {name: t.position(name) for name in map(near_name, self.replaced)}
        return given | {"time": t.position("time"), "input": t.position(f"q:{self.names[0]}")}

    # programs -------------------------------------------------------------------------------------------
    def program(self, names: Iterable[str]) -> Program:
        """The program of some outputs."""
        key = tuple(names)
        if key not in self._programs:
            t, out = self.traced
            self._programs[key] = Program.of(t, {name: out[name] for name in key})
        return self._programs[key]

    def row_program(self, names: Iterable[str], *, forces: bool) -> Program:
        """The program of rows of the motion, or of it and its forces (see ``core.outputs``), at given accelerations
        ``second:NAME`` of all inputs, switches held."""
        key = ("forces" if forces else "motion", *names)
        if key not in self._programs:
            value = self.forces.programs.value if forces else self.solver.outputs.value
            self._programs[key] = self.value_program({name: value(name) for name in key[1:]})
        return self._programs[key]

    def value_program(self, values: Mapping[str, Scalar | bool]) -> Program:
        """The same of any values of the trace of the motion, such as those of ``forces``, ``plain``, ``resting``."""
        t = Trace()
        seconds = {name: t.position(Input("second", name).name) for name in self.names}
        return Program.of(t, self.written(t, values, seconds))

    def unaccelerated(self, t: Trace) -> tuple[dict[str, Scalar | bool], dict[str, Scalar]]:
        """Efforts ``T:A`` without acceleration, and without friction of joints ``S:A``, ``M:A:B`` and the rest, in
        another trace; and the gaps of the switches."""
        return self._inlined(t, dict.fromkeys(self.names, 0.0))

    def written(
        self, t: Trace, outputs: Mapping[str, Scalar | bool], seconds: Mapping[str, Scalar]
    ) -> dict[str, Scalar | bool]:
        """Values of the motion's trace as values of another trace, at accelerations of all inputs, switches held."""
        source, held = self.switches.program(outputs)
        return Held(source, held, t, self._given(t, source, seconds)).outputs

    def evaluate(self, names: Iterable[str], given: Mapping[str, Floats | float], count: int) -> Floats:
        """Outputs (names, n) at inputs by name, arrays (n,) or numbers; 0 for those that are not given."""
        return self.run(self.program(names), given, count)

    def run(self, program: Program, given: Mapping[str, Floats | float], count: int) -> Floats:
        """The outputs of one of its programs, likewise."""
        inputs = {name: np.zeros(count) + given.get(name, 0.0) for name in program.positions}
        numbers = [self.numbers[name] for name in program.parameters]
        return np.asarray(numpy_program(program).run(numbers, inputs, length=count, tables=self.tables))


def _number(value: Scalar | bool) -> Scalar:
    return float(value) if isinstance(value, bool) else value


def group_quality(motion: MotionTrace, group: str) -> Scalar:
    """Square of the determinant of a group's Jacobian over those of its columns: of two pinned bars the square of the
    sine between them; 0 where a joint of the group moves none of its ends, so that it never determines it.

    A dyad's own square root does not do: where the outer joints of equal bars coincide it has its best value, and the
    position is open.
    """
    placed = motion.placed[group]
    matrix = jacobian(placed.group, placed.cuts, motion.poses, motion.dimensions)
    value = determinant(matrix) if len(matrix) > 1 else matrix[0][0]
    size: Scalar = 1.0
    for column in zip(*matrix, strict=True):
        size = size * sum((each * each for each in column), 0.0)
    if isinstance(size, float) and size == 0.0:
        return 0.0
    return value * value / size
