"""Groups without closed form over the cycles of many designs: the coordinates on their paths, and one step of these.

A path is a quintic on each of its equal steps. It only says where Newton's method begins at any time; formulas end
that themselves, with a last step through which derivatives go, so that neither values nor slopes depend on paths.

A step is predicted with the exact rates and the last third derivative, corrected by Newton's method, and judged by
the rule of steps (:mod:`linkwright.kinematics.branch`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.curves.pieces import HIGH, LOW, Columns
from linkwright.events.course import Course
from linkwright.events.formula import PLACE, ROW, Formula, Known
from linkwright.formula.program import Program
from linkwright.formula.replay import inlined
from linkwright.formula.trace import Mask, Scalar, Trace, absolute, angle, cos, maximum, select, sin
from linkwright.kinematics.branch import LARGEST, doubt, misfit
from linkwright.kinematics.groups import CONVERGED, state_name
from linkwright.kinematics.rotations import geared, turn_state
from linkwright.kinematics.trace import MotionTrace

#: Misfit of a quintic (rad, or share of the mechanism's size) from which two of Newton's steps end well also near
#: singular positions; and the largest correction that leaves no doubt of the assembly.
FIT, NEAR = 5e-5, 2e-3
#: Newton's steps in formulas that begin on a path; derivatives go through the last one.
ITERATIONS = 2
#: Degree of the polynomials.
DEGREE = 5


@dataclass(frozen=True)
class ChainCoordinate:
    """An angle, rad, or a displacement, m, that is tracked; ``states``: its names in programs, two for a direction.

    ``group``: the group that Newton's method solves, empty where turns are only counted; ``scale``: 1 rad, or the
    mechanism's size; ``rate`` and ``second``: its derivatives by the time.
    """

    name: str
    states: tuple[str, ...]
    turns: bool
    group: str
    scale: float
    rate: Scalar
    second: Scalar

    def field(self, k: int) -> str:
        """Name of a coefficient of its path."""
        return f"path:{self.name}:{k}"

    def as_inputs(self, value: Scalar) -> dict[str, Scalar]:
        """What programs take of it."""
        known = (cos(value), sin(value)) if len(self.states) > 1 else (value,)
        return dict(zip(self.states, known, strict=True))

    def value(self, states: Mapping[str, Floats]) -> Floats:
        """Its value from states."""
        first, *rest = (states[name] for name in self.states)
        return np.asarray(np.arctan2(rest[0], first) if rest else first)

    def found(self, states: Mapping[str, Scalar], near: Scalar) -> Scalar:
        """Its value by what programs give, an angle with the turns of one that is near."""
        first, *rest = (states[name] for name in self.states)
        if not rest:
            return first
        c, s = cos(near), sin(near)
        return near + angle(rest[0] * c - first * s, first * c + rest[0] * s)

    def on_path(self, t: Trace) -> Scalar:
        """Its value on a path, from the path's fields."""
        value, place = t.field_input(self.field(DEGREE)), t.field_input(PLACE)
        for k in reversed(range(DEGREE)):
            value = value * place + t.field_input(self.field(k))  # type: ignore[assignment]
        return value


def chain_coordinates(motion: MotionTrace) -> tuple[ChainCoordinate, ...]:
    """What must be tracked of a traced motion: what no closed form gives, and turns that are counted."""
    found, size = [], motion.mechanism.size
    for placed in motion.placed.values():
        for step in placed.coordinates:
            name, group = state_name(step), placed.group
            kinds = (".s",) if step.slides else (".angle",) if geared(group) else (".x", ".y")
            states, scale = tuple(name + kind for kind in kinds), size if step.slides else 1.0
            rates = placed.rates[step], placed.seconds[step]
            found.append(ChainCoordinate(name, states, step.turns, group.name, scale, *rates))
    for link in motion.angles.counted:
        name, state = turn_state(link), motion.states[link]
        found.append(ChainCoordinate(name, (name,), True, "", 1.0, state.omega, state.alpha))
    return tuple(found)


def path_states(coordinates: Iterable[ChainCoordinate], t: Trace) -> dict[str, Scalar]:
    """The states of a motion's programs from the fields of paths."""
    return {name: x for each in coordinates for name, x in each.as_inputs(each.on_path(t)).items()}


def stays_on_path(motion: MotionTrace, signs: Mapping[str, Scalar]) -> Mask:
    """Whether Newton's method ends near where it begins, and the determinants of groups have their ``signs``."""
    trace = motion.trace
    on_path: Mask = True
    for name, sign in signs.items():
        placed = motion.placed[name]
        on_path = trace.logic("and", on_path, trace.compare("less", placed.residual, CONVERGED))
        on_path = trace.logic("and", on_path, trace.compare("less", 0.0, placed.determinant * sign))
    for each in chain_coordinates(motion):
        for name in each.states:
            off = absolute(motion.next_states[name] - trace.field_input(name)) * (1.0 / each.scale)
            on_path = trace.logic("and", on_path, trace.compare("less", off, NEAR))
    return on_path


@dataclass(frozen=True)
class Paths:
    """Paths of chain coordinates of some designs, from ``begin``, s, for a ``duration``, s, (designs,) each.

    ``steps``: equal steps of each design; ``first`` and ``parts``: of every step of all designs the number of its
    first quintic, and how many it has; ``series``: the coefficients of all quintics by the names of fields;
    ``laps``: by how much coordinates with turns have grown after a closed cycle, (designs,); ``reached``: share of
    the duration up to which the path goes; ``returns``: whether it ends where it begins; ``margin``: 1 less the
    largest doubt of a step.
    """

    begin: Floats
    duration: Floats
    steps: int
    first: Indices
    parts: Indices
    series: Mapping[str, Floats]
    laps: Mapping[str, Floats]
    closed: bool
    reached: Floats
    returns: Flags
    margin: Floats

    @property
    def passed(self) -> Flags:
        """The designs whose paths go to the end, and in a closed cycle come back."""
        return np.asarray((self.reached == 1.0) & self.returns)

    def fields(self, columns: Columns, nodes: Floats) -> dict[str, Floats]:
        """What formulas take of the paths at nodes of pieces, (nodes, pieces) by name; NaN where paths do not go."""
        row, low = columns[ROW].astype(np.intp), columns[LOW]
        duration = self.duration[row]
        share = (low - self.begin[row]) / duration + ((columns[HIGH] - low) / duration) * nodes[:, None]
        lap = np.floor(share) if self.closed else 0.0
        share -= lap
        place = share * self.steps
        step = np.clip(place, 0.0, self.steps - 1.0).astype(np.intp)
        place -= step
        step += row * self.steps
        if len(self.first) < len(next(iter(self.series.values()))):
            parts = self.parts[step]
            place *= parts
            part = np.clip(place, 0.0, parts - 1.0).astype(np.intp)
            place -= part
            step = self.first[step] + part
        found = {name: np.take(series, step, mode="clip") for name, series in self.series.items()}
        for name, gained in self.laps.items():
            found[name] += lap * gained[row]
        if (self.reached < 1.0).any():
            place[share > self.reached[row]] = np.nan
        return found | {PLACE: place}


#: Columns of a step: its length, s, and what a correction may be in addition to its share of it.
STEP_COLUMN, ROOM_COLUMN = "step", "room"
_NOW = np.zeros(1)


@dataclass(frozen=True)
class Place:
    """Where designs are: coordinates with two rates, ``values`` (3, n, designs); the ``doubt`` of the step there and
    Newton's last correction, squared, (designs,); ``signs`` of determinants (groups, designs)."""

    values: Floats
    doubt: Floats
    residual: Floats
    signs: Floats


class TracedStep:
    """A step of the chain coordinates of a motion, written into another trace: ``before`` gives values there by name,
    ``h`` is its length, s.

    ``begin``: the coordinates with so many ``derivatives`` at its beginning; ``near``: what is expected at its end;
    ``groups``: names of those that Newton's method solves.
    """

    def __init__(self, motion: MotionTrace, before: Callable[[str], Scalar], h: Scalar, derivatives: int = 3) -> None:
        self.motion, self.h = motion, h
        self.coordinates = chain_coordinates(motion)
        self.groups = tuple(name for name, placed in motion.placed.items() if placed.coordinates)
        self.begin: dict[ChainCoordinate, list[Scalar]] = {
            each: [before(f"{each.name}|{k}") if k <= derivatives else 0.0 for k in range(4)]
            for each in self.coordinates
        }
        self.near: dict[ChainCoordinate, Scalar] = {
            each: x + h * (v + h * (0.5 * a + (1.0 / 6.0) * h * j)) for each, (x, v, a, j) in self.begin.items()
        }

    @property
    def outputs(self) -> dict[str, Scalar]:
        """What it takes of the motion at its end."""
        found, residual = dict(self.motion.next_states), 0.0
        for each in self.coordinates:
            found |= {f"{each.name}'": each.rate, f"{each.name}''": each.second}
        for name in self.groups:
            residual = residual + self.motion.placed[name].residual  # type: ignore[assignment]
            found[f"determinant {name}"] = self.motion.placed[name].determinant
        return {**found, "residual": residual}

    @property
    def states(self) -> dict[str, Scalar]:
        """What the motion takes."""
        return {name: value for each, x in self.near.items() for name, value in each.as_inputs(x).items()}

    def values(self, found: Mapping[str, Scalar]) -> dict[str, Scalar]:
        """The coordinates at its end, by name, from outputs there."""
        return {each.name: each.found(found, x) for each, x in self.near.items()}

    def doubt(self, t: Trace, found: Mapping[str, Scalar], groups: Iterable[str], room: Scalar) -> Scalar:
        """The doubt of the step, the largest one of some groups, from outputs and coordinates at its end; infinite
        where Newton's method finds no assembly."""
        h, good = self.h, t.compare("less", found["residual"], CONVERGED)
        worst: Scalar = 0.0
        for group in groups:
            change: Scalar = 0.0
            correction: Scalar = 0.0
            gap: Scalar = 0.0
            for each in self.coordinates:
                if each.group == group:
                    x, v, a, _ = self.begin[each]
                    share, value = 1.0 / each.scale, found[each.name]
                    rate, second = found[f"{each.name}'"], found[f"{each.name}''"]
                    off = misfit(value - x, h * v, h * h * a, h * rate, h * h * second)
                    way = absolute(value - x) * share
                    good = t.logic("and", good, t.compare("less", way, LARGEST))
                    change = maximum(change, way)
                    correction = maximum(correction, absolute(value - self.near[each]) * share)
                    gap = maximum(gap, absolute(off) * share)
            worst = maximum(worst, doubt(change, correction, gap, room))
        return select(t.logic("and", good, t.compare("less", worst, np.inf)), worst, np.inf)


class PathStep:
    """The formula of a step of all machines of one shape; ``varied``: dimensions that are columns."""

    def __init__(self, motion: MotionTrace, course: Course, varied: frozenset[str]) -> None:
        t = Trace()
        self._step = TracedStep(motion, t.position, t.position(STEP_COLUMN))
        self.coordinates, self.groups = self._step.coordinates, self._step.groups
        self.scale = np.array([[each.scale] for each in self.coordinates])
        self._formula = self._traced(t, course, varied)
        row = self._formula.place
        self._values = [[row[each.name + mark] for each in self.coordinates] for mark in ("", "'", "''")]
        self._signs = [row[f"determinant {name}"] for name in self.groups]
        self.varied = tuple(name for name in self._formula.columns if name in varied)

    def _traced(self, t: Trace, course: Course, varied: frozenset[str]) -> Formula:
        """Coordinates with two rates after a step, and what it is judged by."""
        step, motion = self._step, self._step.motion
        once = Program.of(motion.trace, motion.next_states)
        step_program = Program.of(motion.trace, step.outputs)
        inputs = course.inputs(t, t.position(LOW), varied)
        inputs |= {name: t.position(name) for name in step_program.parameters if name in varied}
        found = inlined(step_program, t, inputs | inlined(once, t, inputs | step.states))
        rest = {name: found[name] for name in step_program.output_names if name not in motion.next_states}
        made = {**step.values(found), **rest}
        groups = dict.fromkeys(each.group for each in self.coordinates)
        return Formula(Program.of(t, {**made, "doubt": step.doubt(t, made, groups, t.position(ROOM_COLUMN))}))

    def place(
        self,
        known: Known,
        designs: Columns,
        time: Floats,
        before: Floats,
        h: Floats | None = None,
        room: Floats | None = None,
    ) -> Place:
        """The places of designs at some times, s, after steps ``h``, s, from coordinates with three derivatives
        ``before``, (4, n, designs)."""
        zero = np.zeros_like(time)
        columns = {
            **designs,
            LOW: time,
            STEP_COLUMN: zero if h is None else h,
            ROOM_COLUMN: zero if room is None else room,
        }
        for k, each in enumerate(self.coordinates):
            columns |= {f"{each.name}|{order}": before[order, k] for order in range(4)}
        found = self._formula.run(known, columns, _NOW)[0]
        row = self._formula.place
        return Place(found[self._values], found[row["doubt"]], found[row["residual"]], np.sign(found[self._signs]))
