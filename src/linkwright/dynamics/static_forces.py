"""Forces on a mechanism at rest: what holds it, its stiffness, inertia and damping, what each load contributes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from copy import copy
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import Input
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.stops import contact_name
from linkwright.dynamics.switches import agreeing, gap_name
from linkwright.formula.differentiation import Slopes
from linkwright.formula.linear_algebra import ZERO, Vec
from linkwright.formula.numpy_backend import numpy_program
from linkwright.formula.program import Program
from linkwright.formula.trace import Scalar, Trace, Value
from linkwright.kinematics.names import point_key
from linkwright.kinematics.positions import Positions
from linkwright.mechanism.mechanism import Mechanism

#: Rate, rad/s or m/s, that tells the sense in which a machine at rest begins to move.
CREEP = 1e-9
#: Before the name of a link whose weight is meant, among the names of loads.
WEIGHT = "weight of "


class StaticForces:
    """Efforts of the ``free`` inputs of a mechanism at rest, the others where they begin, or as ``held``.

    Positions are rows (freedoms, n) of the free inputs, rad or m; efforts are what holds the machine: N·m or N,
    positive along the input. ``sense`` 1 or -1: about to move that way, by which friction and brakes go; 0: friction
    of joints left out. ``time``: when actuators are looked at, s.
    """

    def __init__(self, mechanism: Mechanism, *, held: Mapping[str, float] | None = None, time: float = 0.0) -> None:
        self.held = dict(held or {})
        self.equation = EquationOfMotion(mechanism, prescribed=self.held)
        self.mechanism, self.time = self.equation.mechanism, time
        self.free = self.equation.free
        self.modes: Mapping[str, float] = {}
        self._programs: dict[tuple[str, ...], Program] = {}

    def of(self, modes: Mapping[str, float]) -> StaticForces:
        """The same in other assembly modes, values of parameters by name."""
        if modes == self.modes:
            return self
        other = copy(self)
        other.modes = modes
        return other

    @property
    def freedoms(self) -> int:
        """Number of free inputs."""
        return len(self.free)

    @cached_property
    def start(self) -> Floats:
        """The free inputs in the drawing, (freedoms,)."""
        begin = dict(zip(self.equation.names, self.equation.start, strict=True))
        return np.array([begin[name] for name in self.free])

    @property
    def directed(self) -> bool:
        """Whether forces may go by the sense of motion, as friction and brakes do."""
        return self.equation.rubs or bool(self.equation.switches.lines)

    # traced -----------------------------------------------------------------------------------------------
    @cached_property
    def _values(self) -> tuple[Trace, dict[str, Scalar | bool]]:
        t = Trace()
        found, gaps = self.equation.unaccelerated(t)
        values = found | gaps
        for other in self.free:
            along = self._by(t, other)
            rate = Slopes({t.position(f"qd:{other}"): 1.0})
            for name in self.free:
                values[f"K:{name}:{other}"] = _slope(along, values[f"S:{name}"])
                values[f"B:{name}:{other}"] = _slope(along, values[f"T:{name}"])
                values[f"C:{name}:{other}"] = _slope(rate, values[f"S:{name}"])
            for stop in self.stops:
                values[f"stop:{stop}:{other}"] = _slope(along, values[f"stop:{stop}"])
        return t, values

    def _program(self, names: tuple[str, ...]) -> Program:
        if names not in self._programs:
            t, values = self._values
            self._programs[names] = Program.of(t, {name: values[name] for name in names})
        return self._programs[names]

    # evaluated --------------------------------------------------------------------------------------------
    def evaluate(self, names: Iterable[str], q: Floats, sense: int = 0) -> Floats:
        """Outputs by name (names, n): ``S:A`` without friction of joints, ``T:A`` with it, and their slopes ``K:A:B``
        and ``B:A:B``; ``M:A:B``, ``C:A:B``, ``outcome``."""
        return self._of(self._program(tuple(names)), q, sense)

    def _of(self, program: Program, q: Floats, sense: int) -> Floats:
        """Outputs as it begins to move in a sense, or the mean of both."""
        senses = [sense] if sense else [1, -1] if self.equation.switches.lines else [1]
        found = [self._run(program, q, self._switches(q, each)) for each in senses]
        return np.asarray(sum(found) / len(found))

    def _switches(self, q: Floats, sense: int) -> dict[str, Floats]:
        switches = self.equation.switches.names
        names = tuple(gap_name(number) for number in range(len(switches)))
        rates: dict[str, Floats] = {f"qd:{name}": np.full(q.shape[1], CREEP * sense) for name in self.free}
        return agreeing(lambda held: self._run(self._program(names), q, {**rates, **held}), switches, q.shape[1])

    def _run(self, program: Program, q: Floats, more: Mapping[str, Floats]) -> Floats:
        given: dict[str, Floats | float] = {f"q:{name}": row for name, row in zip(self.free, q, strict=True)}
        given |= {f"q:{name}": value for name, value in self.held.items()}
        given |= {"time": self.time, **self.states(q), **more}
        numbers = {**self.equation.numbers, **self.modes}
        inputs = {name: np.zeros(q.shape[1]) + given.get(name, 0.0) for name in program.positions}
        values, tables = [numbers[name] for name in program.parameters], self.equation.tables
        with np.errstate(all="ignore"):
            return np.asarray(numpy_program(program).run(values, inputs, length=q.shape[1], tables=tables))

    def states(self, q: Floats) -> dict[str, Floats]:
        """Chain coordinates of groups without closed form, tracked from the drawing."""
        if not self.equation.states:
            return {}
        tracked = self.equation.solver.track(self.positions(q), separate=True)
        return {} if tracked is None else dict(tracked.states)

    def positions(self, q: Floats) -> Positions:
        """The machine at rest there."""
        none, rows = np.zeros(q.shape[1]), dict(zip(self.free, q, strict=True))
        places = {name: rows[name] if name in rows else none + self.held[name] for name in self.equation.names}
        return Positions(none, {name: (row, none, none) for name, row in places.items()}, self.equation.rotary)

    def reached(self, q: Floats) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        """Which positions can be assembled, (n,)."""
        return np.asarray(self.evaluate(("outcome",), q)[0] == 0.0)

    def efforts(self, q: Floats, sense: int = 0) -> Floats:
        """What holds the machine, (freedoms, n)."""
        return self.evaluate([f"{'T' if sense else 'S'}:{name}" for name in self.free], q, sense)

    def slopes(self, q: Floats, sense: int = 0) -> Floats:
        """Derivatives of the efforts by the inputs, (freedoms, freedoms, n)."""
        return self._matrix("B" if sense else "K", q, sense)

    def inertia(self, q: Floats) -> Floats:
        """Inertia on the inputs, (freedoms, freedoms, n)."""
        return self._matrix("M", q, 0)

    def damping(self, q: Floats) -> Floats:
        """Derivatives of the efforts by the rates of the inputs, (freedoms, freedoms, n)."""
        return self._matrix("C", q, 0)

    def _matrix(self, symbol: str, q: Floats, sense: int) -> Floats:
        n = self.freedoms
        names = [f"{symbol}:{a}:{b}" for a in self.free for b in self.free]
        return self.evaluate(names, q, sense).reshape(n, n, -1)

    # stops and singular positions -----------------------------------------------------------------------
    @cached_property
    def stops(self) -> list[str]:
        """Names of the stops."""
        return list(self.mechanism.stops)

    def stop_gaps(self, q: Floats) -> Floats:
        """How far it is from every stop, (stops, n) rad or m; negative beyond."""
        return self.evaluate([f"stop:{name}" for name in self.stops], q)

    def stop_levers(self, stop: str, q: Floats) -> Floats:
        """Derivatives of the gap of a stop by the free inputs, (freedoms, n)."""
        return self.evaluate([f"stop:{stop}:{name}" for name in self.free], q)

    def weakest_group(self, place: Floats) -> str:
        """The group that is nearest to a singular position, at a place (freedoms,)."""
        groups = self.equation.groups
        qualities = self.evaluate([f"closure:{name}" for name in groups], place[:, None])[:, 0]
        return groups[int(np.argmin(qualities))]

    # what acts --------------------------------------------------------------------------------------------
    @cached_property
    def loads(self) -> list[str]:
        """Names of what acts: weights of links, loads and actuators."""
        weighs = any(self.mechanism.gravity)
        heavy = [f"{WEIGHT}{name}" for name, link in self.mechanism.links.items() if link.mass and weighs]
        contacts = {contact_name(stop) for stop in self.stops}
        return [*heavy, *(name for name in self.mechanism.loads if name not in contacts)]

    @cached_property
    def _shares(self) -> Program:
        """What every load contributes to the force along every free input."""
        forces, t = self.equation.resting.forces, Trace()
        shares: dict[str, Scalar] = {}
        for name in self.free:
            along = self._along(name)
            for load in self.loads:
                if load.startswith(WEIGHT) and load not in self.mechanism.loads:
                    shares[f"{load}|{name}"] = self._weight(load.removeprefix(WEIGHT), along)
                    continue
                total: Scalar = 0.0
                for wrench in forces.wrenches[load]:
                    if wrench.link != "frame":
                        state = self.equation.solver.motion.states[wrench.link]
                        moment = (wrench.place - state.pose.place).cross(wrench.force) + wrench.torque
                        total = total + wrench.force.dot(_of_vector(along, state.velocity))
                        total = total + moment * _slope(along, state.omega)
                shares[f"{load}|{name}"] = total
        none: dict[str, Scalar] = dict.fromkeys(self.equation.names, 0.0)
        return Program.of(t, self.equation.written(t, shares, none))

    def _along(self, name: str) -> Slopes:
        """Derivatives by the rate of an input: of a velocity, where a place goes with the input."""
        return Slopes({self.equation.solver.motion.trace.position(Input("rate", name).name): 1.0})

    def _weight(self, link: str, along: Slopes) -> Scalar:
        motion = self.equation.solver.motion
        gravity = Vec(motion.dimensions("gravity.x"), motion.dimensions("gravity.y"))
        velocity = motion.states[link].velocity_of(motion.dimensions.centre(link))
        return motion.dimensions(f"{link}.mass") * gravity.dot(_of_vector(along, velocity))

    def shares(self, q: Floats) -> Floats:
        """Forces of the ``loads`` along the free inputs, (loads, freedoms, n), N·m or N; their sum is the effort that
        holds the machine, with the other sign."""
        found = self._of(self._shares, q, 0)
        rows = dict(zip(self._shares.output_names, found, strict=True))
        shares = [rows[f"{load}|{name}"] for load in self.loads for name in self.free]
        return np.array(shares).reshape(len(self.loads), self.freedoms, q.shape[1])

    def point(self, name: str, q: Floats) -> tuple[Floats, Floats]:
        """Place (2, n) of a point, m, and its derivatives by the free inputs, (2, freedoms, n)."""
        found = self._of_point(name, q)
        return found[:2], found[2 : 2 + 2 * self.freedoms].reshape(2, self.freedoms, -1)

    def point_curvature(self, name: str, q: Floats) -> Floats:
        """Second derivatives of a point's place by the free inputs, (2, freedoms, freedoms, n)."""
        n = self.freedoms
        return self._of_point(name, q)[2 + 2 * n :].reshape(2, n, n, -1)

    def _of_point(self, name: str, q: Floats) -> Floats:
        return self._run(self._point(point_key(self.mechanism, name)), q, {})

    def _point(self, key: str) -> Program:
        names = (key,)
        if names not in self._programs:
            place, velocity, _unused = self.equation.solver.outputs.point(key)
            moved = {name: _of_vector(self._along(name), velocity) for name in self.free}
            rows: dict[str, Scalar] = {"x": place.x, "y": place.y}
            rows |= {f"x:{name}": each.x for name, each in moved.items()}
            rows |= {f"y:{name}": each.y for name, each in moved.items()}
            t, none = Trace(), dict.fromkeys(self.equation.names, 0.0)
            found = self.equation.written(t, rows, none)
            for row in [each for each in rows if ":" in each]:
                found |= {f"{row}:{other}": _slope(self._by(t, other), found[row]) for other in self.free}
            self._programs[names] = Program.of(t, found)
        return self._programs[names]

    def _by(self, t: Trace, name: str) -> Slopes:
        """Derivatives by an input of what is written into a trace."""
        return Slopes({t.position(f"q:{name}"): 1.0})


def _slope(slopes: Slopes, value: Scalar | bool) -> Scalar:
    return slopes(value) if isinstance(value, Value) else 0.0


def _of_vector(slopes: Slopes, vector: Vec) -> Vec:
    if vector is ZERO:
        return ZERO
    return Vec(_slope(slopes, vector.x), _slope(slopes, vector.y))
