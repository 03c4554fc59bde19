"""What the formulas of a machine's cycle are made of: its traced motion and forces, and the numbers they take."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import replace
from functools import cached_property, partial
from typing import NoReturn

import numpy as np

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.phases import Always, MovingPhase
from linkwright.applied_loads.sizes import Formula as Expression
from linkwright.applied_loads.sizes import Table
from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output, RelativeAngle
from linkwright.curves.pieces import HIGH, LOW
from linkwright.events.course import Course
from linkwright.events.formula import NODE, Formula, Known
from linkwright.events.path_tracker import PathTracker
from linkwright.events.tracked_groups import (
    ITERATIONS,
    ChainCoordinate,
    PathStep,
    chain_coordinates,
    path_states,
    stays_on_path,
)
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.replay import inlined
from linkwright.formula.trace import Mask, Scalar, Trace, Value, absolute, cos, nearest_turn, select, sin
from linkwright.formula.trace import angle as angle_of
from linkwright.kinematics.groups import iterated
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import output_meant, program_names
from linkwright.kinematics.programs import Manner
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.friction import FrictionTerm, can_be_traced, moving_rate
from linkwright.kinetostatics.load_site import ACTS, acts_name, angle_between, guide_state, middle_name, output_value
from linkwright.kinetostatics.named_outputs import Named, Quantity
from linkwright.kinetostatics.signals import TURNING, AlongInput, MotionSignals, numbers_of_loads
from linkwright.kinetostatics.solver import ForcePrograms, force_programs
from linkwright.mechanism.mechanism import Mechanism

#: Change of an angle between two positions, or from a line, rad, up to which there is no doubt how often it turned.
CLEAR = 0.75 * np.pi
#: The output that is 1 where a position is reached, its rotations counted and its friction certain.
VALID = "valid"
#: Parameters that are the signs of the determinants of groups, by name.
SIGN = "sign:"
#: What goes to and fro: an output, the angle between two links, the parts of a joint with friction.
Swing = Output | RelativeAngle | FrictionTerm


class NotTogether(Exception):
    """A machine whose cycle cannot be written as formulas of one position each."""


class _Named(Named):
    """Outputs in the user's words, angles near numbers that the machine tells."""

    def __init__(self, forces: ForcePrograms) -> None:
        super().__init__(forces, _no_angle, _no_line)

    def _angle(self, name: str, output: Output) -> Quantity:
        return Quantity(name, output, "angle", angle_between(self.motion.motion, "frame", output.owner))

    def _continuous(self, link: str) -> Scalar:
        """The angle of a link with its turns over the cycle."""
        motion = self.motion.motion
        first, turns = (motion.trace.parameter(_line_name(link, which)) for which in ("first", "turns"))
        line = first + turns * self._of_formula(None, 0)
        if motion.angles.follows(link):
            return nearest_turn(motion.angles(link), line)
        e = motion.poses[link].direction
        return nearest_turn(angle_of(e.y, e.x), line)


def _no_angle(link: str) -> NoReturn:
    raise AssertionError(f"the angle of {link} is found near a number of the machine")


_no_line = _no_angle


def _line_name(link: str, which: str) -> str:
    """Names of the parameters of a line near which a rotation runs over the input: its place where that is zero, rad,
    and its turns in a turn of it."""
    return f"line {which}:{link}"


class Traces:
    """The formulas of all machines of one shape over courses of one kind; ``varied``: dimensions that are columns."""

    def __init__(self, programs: ForcePrograms, varied: frozenset[str], course: Course) -> None:
        self.programs, self.varied, self.course = programs, varied, course
        self.motion, self.named = programs.motion.motion, _Named(programs)
        self.tracked: tuple[ChainCoordinate, ...] = ()
        if iterated(self.motion.structure):
            self.tracked = chain_coordinates(self.motion)
        self._formulas: dict[Hashable, Formula] = {}
        self._quantities: dict[str, Quantity] = {}

    @cached_property
    def path_step(self) -> PathStep:
        """The formula by which groups without closed form are tracked."""
        with self.programs.motion.lock:
            return PathStep(self.motion, self.course, self.varied)

    def quantity(self, words: str) -> Quantity:
        """An output in the user's words."""
        if words not in self._quantities:
            self._quantities[words] = self.named.quantity(words)
        return self._quantities[words]

    def square(self, words: str) -> Scalar | None:
        """The square of an output that is a root or a size; None of others.

        It is smooth where the size comes near zero, and has its extremes where that has.
        """
        value = self.quantity(words).value
        op, *args = value.trace.lines[value.index] if isinstance(value, Value) else ("",)
        if op not in ("sqrt", "abs"):
            return None
        inside = Value(value.trace, args[0])  # type: ignore[union-attr]
        return inside if op == "sqrt" else inside * inside

    def rates(self, each: Swing) -> Scalar:
        """The rate of what goes to and fro, rad/s or m/s."""
        if isinstance(each, Output):
            return self.programs.motion.outputs.value(program_names(self.motion.mechanism, each)[1][0])
        if isinstance(each, FrictionTerm) and each.slides:
            return guide_state(self.motion, each.joint)[2]
        a, b = (self.motion.states[link] for link in (each.a, each.b))
        return b.omega - a.omega

    def value(self, output: Output) -> Scalar:
        """The value of an output, of an angle near a number of the machine."""
        return output_value(self.motion, output)

    def valid(self) -> Scalar:
        """1 where a position is reached, rotations are counted and friction is certain, else 0."""
        motion, friction = self.motion, self.programs.friction
        found: Mask = motion.valid
        for name, rotation in motion.angles.carried.items():
            near = absolute(rotation - motion.trace.field_input(name)) < CLEAR
            found = motion.trace.logic("and", found, near)
        if self.tracked:
            signs = {name: motion.trace.parameter(f"{SIGN}{name}") for name in self.path_step.groups}
            found = motion.trace.logic("and", found, stays_on_path(motion, signs))
        if friction is not None:
            found = motion.trace.logic("and", found, friction.certain)
        return select(found, 1.0, 0.0)

    def formula(
        self,
        key: Hashable,
        outputs: Callable[[], Mapping[str, Scalar]],
        then: Callable[[Trace, dict[str, Scalar]], Mapping[str, Scalar]] | None = None,
    ) -> Formula:
        """Traced outputs as a formula over pieces, or what is made of them and of columns ``then``."""
        if key not in self._formulas:
            with self.programs.motion.lock:
                self._formulas[key] = self._made(outputs(), then)
        return self._formulas[key]

    def _made(
        self, outputs: Mapping[str, Scalar], then: Callable[[Trace, dict[str, Scalar]], Mapping[str, Scalar]] | None
    ) -> Formula:
        t = Trace()
        node, low, high = t.parameter(NODE), t.position(LOW), t.position(HIGH)
        inputs = self.course.inputs(t, low + (high - low) * node, self.varied)
        source = Program.of(self.motion.trace, outputs)
        more: dict[str, Scalar] = {name: t.position(name) for name in source.parameters if name in self.varied}
        more |= path_states(self.tracked, t)
        for name in source.fields:
            kind, _, load = name.partition(":")
            if name in self.motion.angles.carried and not self.tracked:
                first, turns = (t.parameter(_line_name(name, which)) for which in ("first", "turns"))
                more[name] = first + turns * inputs["input"]
            elif kind == ACTS:
                more[name] = t.position(name)
            elif kind == "share":
                more[name] = self._share(t, load, inputs, more)
        found = inlined(source, t, {**inputs, **more})
        return Formula(Program.of(t, found if then is None else then(t, {**found, "input": inputs["input"]})))

    def _share(self, t: Trace, load: str, inputs: Mapping[str, Scalar], more: Mapping[str, Scalar]) -> Scalar:
        """The share of a load's phase that is passed, along the input, or the value of an output."""
        phase = self.motion.mechanism.loads[load].magnitude.phase
        along = inputs["time" if self.course.turns else "input"]
        if phase.in_part:
            source = Program.of(self.motion.trace, {"along": self.value(phase.outputs[0])})
            columns = {n: t.position(n) for n in source.parameters if n in self.varied}
            along = inlined(source, t, {**inputs, **more, **columns})["along"]
        return (along - t.position(since_name(load))) / t.position(length_name(load))


def since_name(load: str) -> str:
    """The column that is the place, along the input or an output, where a load's phase begins."""
    return f"since:{load}"


def length_name(load: str) -> str:
    """The column that is how far a load's phase goes along it."""
    return f"length:{load}"


_traces: Recent[ForcePrograms, Traces] = Recent(32)


class Machine:
    """One mechanism over a course of its input, or many designs of it with some dimensions ``varied``; ``unloaded``
    where nothing but the motion is wanted, whatever loads and friction there are.

    Raises NotTogether where its cycle is no formula of one position: it passes change points or not all of its
    cycle, a load has no formula, or an angle that one takes turns through.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        nominal: Motion,
        varied: Iterable[str] = (),
        *,
        static: bool = False,
        unloaded: bool = False,
    ) -> None:
        self.mechanism = replace(mechanism, loads={}) if unloaded else mechanism
        self.nominal, self.varied = nominal, tuple(varied)
        if not nominal.complete or nominal.modes or nominal.steps < 3 or not mechanism.drivers:
            raise NotTogether
        self.loads = self._traced_loads()
        self.course = Course.of(mechanism, nominal.positions, seam=self._seamed())
        self.terms: tuple[FrictionTerm, ...] = ()
        manner = Manner(frozenset(self.varied), iterations=ITERATIONS if iterated(nominal.structure) else 1)
        solver = MotionSolver(mechanism, manner, nominal.solver.assembly)
        rubbing = not unloaded and any(joint.friction_arm for joint in mechanism.joints.values())
        names = frozenset(acts_name(name) if self._phased(name) else name for name in self.loads.names)
        programs = force_programs(solver.programs, inertia=not static, along_input=names, rubbing=rubbing)
        if rubbing:
            terms = programs._terms
            if not can_be_traced(terms):
                raise NotTogether
            self.terms = terms.terms
        columns = frozenset(self.varied)
        key = (columns, self.course.key)
        self.traces = _traces.get(programs, key, lambda: Traces(programs, columns, self.course))
        parameters = nominal.design.parameters if not self.varied else solver.nominal.parameters
        self._numbers = {**parameters, **self.loads.constants}
        self.compiled: bool | None = None

    def _traced_loads(self) -> AlongInput:
        """The loads that vary, and the numbers that they take."""
        varying = [each for each in self.mechanism.loads.values() if not each.magnitude.constant]
        for load in varying:
            if not load.magnitude.has_formula or None in load.magnitude.size.outputs(self.mechanism):
                raise NotTogether
        known = numbers_of_loads(varying, self.mechanism)
        if known.angles:
            middles = known.middles(MotionSignals(self.nominal))
            if middles is None:
                raise NotTogether
            known = AlongInput(known.names, constants={**known.constants, **middles}, tables=known.tables)
        return known

    def _phased(self, name: str) -> bool:
        """Whether a load acts in a phase whose ends are events."""
        own = self.mechanism.loads[name].magnitude
        return not isinstance(own.phase, Always) and not (isinstance(own.phase, MovingPhase) and not own.size.ramp)

    def _seamed(self) -> bool:
        """Whether a load goes by the time, or by the turns of the input."""
        sizes = (self.mechanism.loads[name].magnitude.size for name in self.loads.names)
        return any(
            (isinstance(size, Expression) and bool(size.expression.names & {"t", "input"}))
            or (isinstance(size, Table) and bool(size.known_at))
            for size in sizes
        )

    @cached_property
    def turned(self) -> Machine | None:
        """The machine over the full cycle in which its loads find the limits of outputs; None where that is its
        own."""
        motion = MotionSignals(self.nominal).turned
        found = Course.of(self.mechanism, motion.positions)
        own = self.course
        if found.closed == own.closed and (found.begin, found.duration) == (own.begin, own.duration):
            return None
        return Machine(self.mechanism, motion, self.varied)

    @cached_property
    def phases(self) -> dict[str, Load]:
        """The loads with such phases, by name."""
        return {name: self.mechanism.loads[name] for name in sorted(self.loads.names) if self._phased(name)}

    def meant(self, words: str) -> Output:
        """The output that words mean."""
        known = self.nominal.solver.programs.meanings
        if words not in known:
            known[words] = output_meant(self.mechanism, words)
        return known[words]

    # formulas -------------------------------------------------------------------------------------------
    def formula(
        self,
        key: Hashable,
        outputs: Callable[[], Mapping[str, Scalar]],
        then: Callable[[Trace, dict[str, Scalar]], Mapping[str, Scalar]] | None = None,
    ) -> Formula:
        """As :meth:`Traces.formula`, with the numbers that it takes found."""
        found = self.traces.formula(key, outputs, then)
        for name in found.program.parameters:
            if name not in self._numbers and name != NODE:
                self._numbers[name] = self._number(name)
        return found

    def varying(self, key: Hashable, outputs: Callable[[], Mapping[str, Scalar]]) -> Formula | None:
        """Those of some outputs that change over the cycle, as a formula; None where none does."""
        names = self.formula(key, outputs).varying
        if not names:
            return None
        return self.formula(("varying", key), lambda: {k: v for k, v in outputs().items() if k in names})

    def taken(self, formulas: Iterable[Formula]) -> frozenset[str]:
        """The dimensions that vary which some formulas take, or the input."""
        first = self.course.first.name
        names = {name for formula in formulas for name in formula.columns}
        return frozenset(self.varied) & (names | {f"{first}.speed", f"{first}.start"})

    def tells(self, words: str) -> bool:
        """Whether a formula gives an output: not the angle of a link that turns through."""
        try:
            self.formula(("output", words), lambda: {words: self.traces.quantity(words).value})
        except NotTogether:
            return False
        return True

    @property
    def known(self) -> Known:
        """The numbers that formulas take besides columns."""
        return Known(self._numbers, self.loads.tables, self.compiled)

    @cached_property
    def tracker(self) -> PathTracker | None:
        """What tracks groups without closed form; None where there are none."""
        if not self.traces.tracked:
            return None
        first = int(np.argmin(self.nominal.time))
        start = {name: row[first] for name, row in self.nominal.states.items()}
        return PathTracker(self.traces.path_step, self.course, self.known, start)

    def tracked(self, designs: Mapping[str, Floats], period: Floats) -> Known:
        """The numbers that formulas take, with the paths of groups without closed form of designs over their cycles,
        (designs,) s long."""
        if self.tracker is None:
            return self.known
        begin = np.full(len(period), self.course.begin)
        return replace(self.known, paths=self.tracker.track(designs, begin, period))

    def _number(self, name: str) -> float:
        """An angle near which one of the machine runs, or a line near which it does; the sign of a determinant."""
        if name.startswith("middle:"):
            link = name.removeprefix(middle_name("frame", ""))
            angle = self.nominal.link(link).angle
            low, high = float(np.nanmin(angle)), float(np.nanmax(angle))
            if high - low > TURNING:
                raise NotTogether
            return 0.5 * (low + high)
        if name.startswith(SIGN):
            assert self.tracker is not None
            return self.tracker.signs_by_group[name.removeprefix(SIGN)]
        if not name.startswith("line "):
            return float("nan")
        which, _, owner = name.removeprefix("line ").partition(":")
        rotation = self.nominal.states[owner] if owner in self.nominal.states else self.nominal.link(owner).angle
        rotary = next(iter(self.nominal.positions.rotary.values()))
        line = line_near(rotation, self.nominal.input if rotary else np.zeros(len(rotation)))
        if line is None:
            raise NotTogether
        return line[which == "turns"]

    def swings(self, term: FrictionTerm | RelativeAngle) -> bool:
        """Whether the parts of a joint, or two links, move against each other at all."""
        return bool(np.nanmax(np.abs(moving_rate(self.nominal, term)), initial=0.0) > 0.0)

    def kinks(self) -> tuple[Formula, Formula] | None:
        """Zero where joints go over from one formula to the next, or half a turn from there; cosines that tell
        which."""
        joints = {name: joint.kinks for name, joint in self.mechanism.joints.items() if joint.kinks}
        if not joints:
            return None
        motion = self.traces.motion

        def turned(*, cosines: bool) -> dict[str, Scalar]:
            found: dict[str, Scalar] = {}
            for name, kinks in joints.items():
                a, b = (motion.poses[link].direction for link in (kinks.carrier, kinks.link))
                for k, angle in enumerate(kinks.angles):
                    turn = angle + motion.dimensions(kinks.phase)
                    c, s, along, across = cos(turn), sin(turn), a.dot(b), a.cross(b)
                    found[f"{name} {k}"] = along * c + across * s if cosines else across * c - along * s
            return found

        key = tuple((name, kinks.angles) for name, kinks in joints.items())
        sines = self.formula(("bends", key), partial(turned, cosines=False))
        return sines, self.formula(("bends there", key), partial(turned, cosines=True))


def line_near(rotation: Floats, q: Floats) -> tuple[float, float] | None:
    """The line near which a rotation (n,) runs over the input (n,), rad where that is zero and turns in a turn of it;
    None where it is too far from any."""
    way = float(q[-1] - q[0])
    laps = max(1.0, np.round(abs(way) / (2.0 * np.pi)))
    turns = float(np.round(laps * (rotation[-1] - rotation[0]) / way) / laps) if way else 0.0
    rest = rotation - turns * q
    return (0.5 * float(rest.max() + rest.min()), turns) if np.ptp(rest) < 2.0 * CLEAR else None
