"""Where in the cycle of many designs friction and the forces of teeth bend or jump: where a signed value is zero.

Friction goes with the size of a guide's normal force and against the joint's rate, the forces of wheels on their pins
with the size of that between the teeth. Sign changes between neighbouring positions bracket these places.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Protocol

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.cycle_programs.joint_bends import other_bends
from linkwright.cycle_programs.limit_stages import CONVERGED, narrowed, rates
from linkwright.cycle_programs.traced_outputs import Traced
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.program import Program
from linkwright.engine.reductions import Reduction
from linkwright.engine.stage import Stage
from linkwright.engine.table import Tables
from linkwright.engine.trace import Scalar, Trace, absolute, select
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.friction import Swinging, joint_rate

#: Share of all joint forces below which a force is none, and of the largest rate below which one is.
NONE = 1e-11
#: Steps of the search for one place, and the most places of a machine.
STEPS, MOST = 9, 24
#: Steps from position to position over which a value that is zero rests, as it does where a cam does.
REST = 2.5
_BRACKET = ("x", "a", "b", "at a", "at b")
#: Inputs per place: how far behind it another one may lie, and, at the last one, how far before the first one of the
#: next cycle, between which a value may change its sign.
REACH, AROUND = "reach of a change", "reach around"


class Along(Protocol):
    """The cycle in which corners are sought, over its input, rad, or its time, s."""

    @property
    def traced(self) -> Traced:
        """Programs of the machine."""
        ...

    def span(self, t: Trace) -> tuple[Scalar, Scalar]:
        """Where it begins, and how far it goes."""
        ...

    def place(self, t: Trace) -> Scalar:
        """The places, in order, between which signs are compared."""
        ...

    def over_places(self, program: Program) -> Program:
        """A program of the motion over these places."""
        ...

    def there(self, program: Program, t: Trace, x: Scalar) -> dict[str, Any]:
        """The outputs of a program of the motion at any place."""
        ...


@dataclass(frozen=True)
class Corner:
    """The ``number``-th change of sign in the cycle of a value, by its name."""

    of: str
    number: int

    @property
    def name(self) -> str:
        """The cycle value that is its input, rad."""
        return f"corner:{self.of}:{self.number}"

    @property
    def met(self) -> str:
        """The cycle value that is 1 where it is found, else 0."""
        return f"met:{self.of}:{self.number}"

    @property
    def before(self) -> str:
        """The cycle value that has the sign of the value before it."""
        return f"at a:{self.of}:{self.number}"


@dataclass(frozen=True)
class Signed:
    """A traced value whose sign matters, and what it is rounding ``beside``."""

    value: Scalar
    beside: Scalar


def signed_values(
    traced: Traced, outputs: Iterable[Scalar], swinging: Iterable[Swinging]
) -> dict[str, Signed]:
    """What the ``outputs`` bend or jump at, by names: forces, N, that press guides with friction, those between teeth
    or in strands, the rates of what is ``swinging`` with friction, and what lifts of cams that rock bend at."""
    programs, trace = traced.forces.programs, traced.solver.motion.trace
    joints = programs.forces.joints
    total = sum((absolute(each.force.x) + absolute(each.force.y) for each in joints), start=0.0)
    needed = set(trace.needed([trace.lift(value) for value in outputs]))
    found = {
        name: Signed(force, total)
        for name, force in programs.signed.items()
        if programs.friction is not None or trace.lift(absolute(force)) in needed
    }
    found |= rates_of(traced, swinging)
    return found | {name: Signed(value, 0.0) for name, value in other_bends(traced).items()}


def rate_name(each: Swinging) -> str:
    """The name of the rate of what swings among signed values."""
    return f"rate {each}"


def rates_of(traced: Traced, swinging: Iterable[Swinging]) -> dict[str, Signed]:
    """The rates of what swings, by their names."""
    return {
        rate_name(each): Signed(rates(traced, each)[0], _fastest(traced.nominal, each)) for each in swinging
    }


def _fastest(motion: Motion, each: Swinging) -> float:
    """The largest rate of what swings, rad/s or m/s."""
    rate = motion.read(each.rate) if isinstance(each, Output) else joint_rate(motion, each)
    return float(np.abs(rate).max())


def corner_stages(
    along: Along, values: Mapping[str, Signed], corners: Iterable[Corner], counted: Iterable[str] = ()
) -> list[Stage]:
    """The stages that find these places of some values by name; those that a design lacks are put evenly over its
    cycle, where nothing bends. Of the ``counted`` values changes are told even where they have no corners."""
    asked = tuple(corners)
    names = dict.fromkeys([*counted, *(corner.of for corner in asked)])
    found = [_values_there(along, {name: values[name] for name in names})] if names else []
    for name in names:
        own = [corner for corner in asked if corner.of == name]
        found.append(_crossings(along, name, len(own)))
        found += [_place(along, corner, values[name].value, len(own)) for corner in own]
    return found


def corners_of(
    along: Along,
    values: Mapping[str, Signed],
    before: Iterable[Stage],
    known: Mapping[str, float],
    positions: Mapping[str, Floats],
    tables: Tables | None,
) -> tuple[Corner, ...]:
    """The corners of the machine as it is; none of those that have too many. ``before``: the stages that find what
    its loads take; ``known``: its numbers."""
    if not values:
        return ()
    counting = (_crossings(along, name, 0) for name in values)
    cycle = CycleProgram((*before, _values_there(along, values), *counting))
    table = np.array([[known[name] for name in cycle.dimensions]])
    results = cycle.evaluate(table, positions, tables=tables, threads=1)
    counts = {name: int(np.nan_to_num(results[changes_name(name)][0])) for name in values}
    if sum(counts.values()) > MOST:
        return ()
    return tuple(Corner(name, number) for name, count in counts.items() for number in range(count))


def changes_name(name: str) -> str:
    """The cycle value that tells how often a value changes its sign."""
    return f"changes:{name}"


def began_name(name: str) -> str:
    """The cycle value that has the sign of a value where the cycle begins."""
    return f"began:{name}"


def _field(name: str) -> str:
    return f"signed {name}"


def _values_there(along: Along, values: Mapping[str, Signed]) -> Stage:
    """The values at all places, zero where they are rounding."""
    found = {
        _field(name): select(absolute(each.value) > NONE * each.beside, each.value, 0.0)
        for name, each in values.items()
    }
    program = Program.of(along.traced.solver.motion.trace, found)
    return Stage(along.over_places(program), keep=tuple(found))


def _crossings(along: Along, name: str, count: int) -> Stage:
    """How often a value changes its sign, and what brackets the first ``count`` places; the change from
    the last place to the first is the last one."""
    t = Trace()
    x, value, lap = along.place(t), t.field_input(_field(name)), along.span(t)[1]
    last, at, first, start, changes = (t.state(name) for name in ("last", "at", "first", "start", "changes"))
    decided = absolute(value) > 0.0
    now, place = select(decided, value, last), select(decided, x, at)
    began, beginning = select(absolute(first) > 0.0, first, value), select(absolute(first) > 0.0, start, x)
    changed = select(absolute(x - at) < t.position(REACH), select(value * last < 0.0, 1.0, 0.0), 0.0)
    around = select(
        absolute(beginning + lap - place) < t.position(AROUND),
        select(now * began < 0.0, 1.0 - changed, 0.0),
        0.0,
    )
    ordinary = changed > 0.5
    a, b = select(ordinary, at, place), select(ordinary, x, beginning + lap)
    at_a, at_b = select(ordinary, last, now), select(ordinary, value, began)
    outputs = {"a": a, "b": b, "at a": at_a, "at b": at_b, "x": a - at_a * (b - a) / (at_b - at_a)}
    outputs["began"] = began
    wanted = {changes_name(name): Reduction("changes", "last"), began_name(name): Reduction("began", "last")}
    total = changes + changed + around
    for k in range(count):
        outputs[f"mark {k}"] = select(
            absolute(changes - float(k)) < 0.5, select(changed + around > 0.5, 1.0, 0.0), 0.0
        )
        wanted |= {f"{each}:{name}:{k}": Reduction(each, "at_max", f"mark {k}") for each in _BRACKET}
        wanted[f"marked:{name}:{k}"] = Reduction(f"mark {k}", "max")
    following = {"last": now, "at": place, "first": began, "start": beginning, "changes": total}
    program = Program.of(t, {**outputs, "changes": total}, following)
    return Stage(program, wanted, starts=dict.fromkeys(following, 0.0))


def _place(along: Along, corner: Corner, value: Scalar, count: int) -> Stage:
    """One place by secants within a bracket; a jump through zero is none."""
    t, begins = Trace(), {each: f"{each}:{corner.of}:{corner.number}" for each in (*_BRACKET, "marked")}
    x, low, high, last, at_last = (t.state(name) for name in ("x", "low", "high", "last", "at last"))
    first, lap = along.span(t)
    program = Program.of(along.traced.solver.motion.trace, {"value": value})
    there = along.there(program, t, x)["value"]
    still = absolute(there) * absolute(x - last) <= 0.0
    secant = select(still, x, x - there * (x - last) / (there - at_last))
    following, low1, high1 = narrowed(x, low, high, there * t.parameter(begins["at a"]) > 0.0, secant)
    parked = first + (corner.number + 0.5) / count * lap
    moved = select(still, 0.0, absolute(following - x))
    met = select(moved <= CONVERGED, t.parameter(begins["marked"]), 0.0) > 0.5
    program = Program.of(
        t,
        {
            "place": select(met, x, parked),
            "met": select(met, 1.0, 0.0),
            "gap": select(met, there, x - parked),
        },
        {"x": select(still, x, following), "low": low1, "high": high1, "last": x, "at last": there},
    )
    starts = {"x": "x", "low": "a", "high": "b", "last": "a", "at last": "at a"}
    return Stage(
        program,
        {corner.name: Reduction("place", "last"), corner.met: Reduction("met", "last")},
        steps=STEPS,
        starts={name: begins[each] for name, each in starts.items()},
        roots={"x": "gap"},
    )
