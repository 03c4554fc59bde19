"""The one algorithm over the cycle: events, the loads that they switch, pieces between them, summaries.

``Cycle(machine, parts).solve(designs)`` serves one machine and thousands of designs: a formula of one position,
pieces of all designs behind each other, whatever pattern of events each has.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cached_property
from math import pi

import numpy as np

from linkwright.core.arrays import EQUAL, Flags, Floats, Indices
from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output, RelativeAngle
from linkwright.curves.pieces import HIGH, LOW, Layout, Pieces, Wanted
from linkwright.curves.polynomials import NODES, best_of, climbed, largest
from linkwright.cycle.loads import Acting, InPart, OnStrokes, WithinInput
from linkwright.cycle.machine import VALID, Machine, Swing
from linkwright.cycle.summary import STROKES, TRUE_SPEED, Summary, one, output_of, signal_of
from linkwright.events.events import AT, Events, events
from linkwright.events.formula import NODE, ROW, Formula
from linkwright.events.inputs import AtInput
from linkwright.events.limits import Limits
from linkwright.events.stretches import Cuts, Span, Stretches
from linkwright.events.strokes import Repeated, between, of_limits
from linkwright.formula.trace import Scalar, Trace, absolute, sin
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.loads.base import Load
from linkwright.loads.phases import InputPhase, MovingPhase, SwingPhase
from linkwright.loads.sizes import Table
from linkwright.loads.strokes import NEAR

#: Pieces of a lap of the input to begin with, and where the whole course of signals is asked for, as of curves whose
#: hull is sought among their nodes.
PIECES, PIECES_OF_COURSES = 12, 24
#: Sides of a signal on which its summaries lie.
SIDES: Mapping[str, tuple[float, ...]] = {
    "max": (1.0,), "min": (-1.0,), "peak": (1.0, -1.0), "range": (1.0, -1.0), "argmax": (1.0,), "argmin": (-1.0,),
    **dict.fromkeys(STROKES.values(), (-1.0,)),
}  # fmt: skip
EVEN = ("mean", "rms", "excess")
#: A side of a signal: its number, sign, and the output on whose rising or falling strokes it is asked for.
Side = tuple[int, float, tuple[Output, str] | None]


@dataclass(frozen=True)
class Signal:
    """An output in the user's words, or its square."""

    words: str
    squared: bool = False

    def __str__(self) -> str:
        return f"{self.words}²" if self.squared else self.words


class Cycle:
    """What is wanted of a machine: ``parts``, summaries in words such as ``"driver.effort peak"``; ``limited``:
    outputs of which
    places and extremes are those of their limit positions; ``never``: outputs by whose reversals designs are told
    apart."""

    def __init__(
        self,
        machine: Machine,
        parts: Iterable[str],
        limited: Collection[Output] = (),
        never: Iterable[Output] = (),
        even: Iterable[str] = (),
    ) -> None:
        self.machine = machine
        self.parts = {text: one(text) for text in dict.fromkeys(parts)}
        plain = {text: part for text, part in self.parts.items() if part.kind not in TRUE_SPEED}
        self.meant = {text: machine.meant(part.output) for text, part in plain.items()
                      if part.kind not in STROKES.values()}  # fmt: skip
        self.limited = {
            text: self.meant[text]
            for text, part in plain.items()
            if text in self.meant and self.meant[text] in limited
            and part.kind in ("max", "min", "range", "argmax", "argmin")
        }  # fmt: skip
        self.on_strokes = {
            text: machine.meant(output_of(part))
            for text, part in plain.items()
            if part.kind in STROKES.values()
        }
        signals = {text: part for text, part in plain.items() if text not in self.limited}
        self.words = {
            text: self._signal(signal_of(p) if text in self.on_strokes else p.output, p.kind)
            for text, p in signals.items()
        }
        self.even_words = tuple(Signal(each) for each in dict.fromkeys(even))
        self._trace(tuple(dict.fromkeys([*self.words.values(), *self.even_words])), signals)
        self.never = tuple(dict.fromkeys(never))
        self._follow()

    def _signal(self, words: str, kind: str) -> Signal:
        """The signal from which a summary is found: of sizes their square where that tells as much."""
        squared = kind in ("max", "peak", "rms", "argmax") and self.machine.traces.square(words) is not None
        return Signal(words, squared)

    def _trace(self, signals: tuple[Signal, ...], parts: Mapping[str, Summary]) -> None:
        """The formula of all signals, and what its pieces must be met for."""
        traces = self.machine.traces
        kinds: dict[tuple[str, bool], int] = {}
        alike = [
            kinds.setdefault((traces.quantity(each.words).dimension, each.squared), len(kinds))
            for each in signals
        ]
        self.formula = self.machine.formula(("signals", signals), lambda: self._outputs(signals))
        self.number = {each: k for k, each in enumerate(signals)}
        self.alike = (*alike, len(kinds))
        even = [self.number[self.words[text]] for text, part in parts.items() if part.kind in EVEN]
        self.even = tuple(dict.fromkeys([*even, *(self.number[each] for each in self.even_words)]))
        self.sides_of: dict[str, tuple[Side, ...]] = {}
        for text, part in parts.items():
            own = self.words[text]
            signs = (1.0,) if own.squared and part.kind == "peak" else SIDES.get(part.kind, ())
            stroke = (self.on_strokes[text], part.kind) if text in self.on_strokes else None
            self.sides_of[text] = tuple((self.number[own], sign, stroke) for sign in signs)
        self.sides = tuple(dict.fromkeys(side for sides in self.sides_of.values() for side in sides))

    def _outputs(self, signals: Iterable[Signal]) -> dict[str, Scalar]:
        traces = self.machine.traces
        found: dict[str, Scalar] = {}
        for each in signals:
            square = traces.square(each.words) if each.squared else None
            found[str(each)] = traces.quantity(each.words).value if square is None else square
        return {**found, VALID: traces.valid()}

    def _follow(self) -> None:
        """The formulas of what turns round, and of the values of outputs at their limits."""
        machine = self.machine
        phases = {name: load.magnitude.phase for name, load in machine.mechanism.loads.items()}
        by_phases = tuple(
            dict.fromkeys(
                each.output for each in phases.values() if isinstance(each, SwingPhase | MovingPhase)
            )
        )
        self.turned = machine.turned if by_phases else None
        reversing = [load.reverses(machine.mechanism) for load in machine.mechanism.loads.values()]
        self.opposed = tuple(dict.fromkeys(each for each in reversing if isinstance(each, Output)))
        turning: list[Swing] = [each for each in reversing if isinstance(each, RelativeAngle)]
        self.turning = tuple(each for each in dict.fromkeys([*turning, *machine.terms])
                             if not isinstance(each, Output) and machine.swings(each))  # fmt: skip
        shown = [*self.limited.values(), *self.on_strokes.values()]
        moving = [each.output for each in phases.values() if isinstance(each, MovingPhase)]
        own = by_phases if self.turned is None else moving
        self.outputs = tuple(dict.fromkeys([*own, *self.opposed, *shown, *self.never]))
        self.swings: tuple[Swing, ...] = (*self.outputs, *self.turning)
        self.rates = _rates(machine, self.swings)
        swung = [phase.output for phase in phases.values() if isinstance(phase, SwingPhase)]
        valued = [*self.limited.values(), *(() if self.turned else swung)]
        self.values = {output: value_of(machine, output) for output in dict.fromkeys(valued)}
        self.load_outputs = by_phases
        self.load_machine = self.turned or machine
        self.load_rates = _rates(self.turned, by_phases) if self.turned else None
        self.load_values = {output: value_of(self.load_machine, output) for output in dict.fromkeys(swung)}
        self.signed = self._signed()

    def _signed(self) -> Formula | None:
        """Forces, N, at whose zeros the signals bend: those that press guides with friction, and between teeth."""
        programs, trace = self.machine.traces.programs, self.machine.traces.motion.trace
        if not programs.signed:
            return None
        outputs = self._outputs(self.number)
        needed = set(trace.needed([trace.lift(value) for value in outputs.values()]))
        bending = {
            name: force
            for name, force in programs.signed.items()
            if programs.friction is not None or trace.lift(absolute(force)) in needed
        }
        every = self.machine.formula(("signed", tuple(bending)), lambda: bending)
        varying = every.varying(NODE)
        if not varying:
            return None
        return self.machine.formula(
            ("varying signed", tuple(varying)), lambda: {name: bending[name] for name in varying}
        )

    @cached_property
    def columns(self) -> frozenset[str]:
        """The dimensions that vary on which anything depends."""
        bends, machine = self.machine.bends() or (), self.machine
        formulas = [
            self.formula,
            *bends,
            *self.values.values(),
            *(each for each in (self.rates, self.signed) if each),
        ]
        taken = {name for formula in formulas for name in formula.columns}
        first = machine.course.first.name
        taken |= {f"loads.{name}.phase.input.{k}" for name in machine.phases for k in (0, 1)}
        return frozenset(machine.varied) & (taken | {f"{first}.speed", f"{first}.start"})

    def solve(self, designs: Mapping[str, Floats]) -> Solved:
        """The cycles of designs with some columns (designs,); of the machine itself where there are none."""
        count = len(next(iter(designs.values()))) if designs else 1
        return Solved(
            self,
            {**{k: np.asarray(v, dtype=float) for k, v in designs.items()}, ROW: np.arange(float(count))},
        )


def _rates(machine: Machine, swings: Sequence[Swing]) -> Formula | None:
    """The rates of what goes to and fro as a formula, by their numbers; None where none varies."""
    traces = machine.traces
    every = machine.formula(
        ("rates", tuple(swings)), lambda: {str(k): traces.rates(each) for k, each in enumerate(swings)}
    )
    varying = every.varying(NODE)
    if not varying:
        return None
    return machine.formula(
        ("varying rates", tuple(swings)), lambda: {k: traces.rates(swings[int(k)]) for k in varying}
    )


def value_of(machine: Machine, output: Output) -> Formula:
    """The value of an output as a formula."""
    return machine.formula(("value", output), lambda: {"value": machine.traces.value(output)})


class Solved:
    """The cycles of some designs."""

    def __init__(self, cycle: Cycle, designs: dict[str, Floats]) -> None:
        self.cycle, self.machine, self.designs = cycle, cycle.machine, designs
        self.count = len(designs[ROW])
        self.span = Span(self.machine.course, self._periods(), np.zeros(self.count))
        self.known = self.machine.tracked(designs, self.span.period)
        self.bends = self._bends()
        self.base = Stretches(self.span, self.bends)
        rates = self._events(cycle.rates, self.base) if cycle.rates else []
        self.whole = None if cycle.turned is None else _Turned(self, cycle.turned)
        found = {cycle.swings[int(each.name)]: each for each in rates}
        self.limits = {
            output: Limits(found[output], cycle.values.get(output), self.span)
            for output in cycle.outputs if output in found
        }  # fmt: skip
        self.reversals = [found[each] for each in cycle.turning if each in found]
        self.reached: list[tuple[Events, InPart, int]] = []
        self.inputs: list[AtInput | Events] = []
        self.reached_inputs: dict[int, str] = {}
        self.repeated: list[Repeated] = []
        self.lacking = np.zeros(self.count, dtype=np.bool_)
        self.acting = [self._acting(name) for name in self.machine.phases]
        families = self._families()
        self.stretches = Stretches(self.span, families, self._knots)
        self.corners: list[Events] = []
        if cycle.signed is not None:
            self.corners = events(cycle.signed, self.known, designs, self.stretches, self._loaded)
            self.stretches = Stretches(self.span, [*families, *self.corners], self._knots)
        formula, known = cycle.formula, self.known
        wanted = Wanted(cycle.even, tuple((k, sign) for k, sign, _ in cycle.sides), alike=cycle.alike)
        layout = Layout(self.stretches.design, self.count, self._columns)
        self.pieces = Pieces(
            lambda columns, nodes: formula.run(known, columns, nodes),
            layout,
            *self.stretches.first_pieces(PIECES_OF_COURSES if cycle.even_words else PIECES),
            wanted,
        )

    def _periods(self) -> Floats:
        return self.periods(self.machine)

    def periods(self, machine: Machine) -> Floats:
        """How long the cycles of the designs are, (designs,) s."""
        course = machine.course
        speed = self.designs.get(f"{course.first.name}.speed")
        if not course.turns or speed is None:
            return np.full(self.count, course.duration)
        return np.asarray(2.0 * pi * course.turns / np.abs(speed))

    @property
    def speed(self) -> Floats:
        """Rate of the first driver where the cycle begins, (designs,) rad/s or m/s."""
        course = self.machine.course
        if f"{course.first.name}.speed" in self.designs:
            return self.designs[f"{course.first.name}.speed"]
        rate = float(course.first.law.coordinate(np.array([course.begin]))[1][0])
        return np.full(self.count, rate)

    def _events(
        self, formula: Formula, stretches: Stretches, more: Mapping[str, Floats] | None = None
    ) -> list[Events]:
        return events(formula, self.known, {**self.designs, **(more or {})}, stretches)

    def _bends(self) -> list[Events]:
        """Where joints go over from one formula to the next."""
        formulas = self.machine.bends()
        if formulas is None:
            return []
        sines, cosines = formulas
        plain, known = Stretches(self.span, []), self.known
        found = []
        for k, each in enumerate(self._events(sines, plain)):
            found.append(
                each.kept(cosines.run(known, each.columns(), AT)[0, k] > 0.0) if len(each.time) else each
            )
        return found

    # loads ----------------------------------------------------------------------------------------------
    def _acting(self, name: str) -> Acting:
        """When a load acts."""
        load = self.machine.mechanism.loads[name]
        phase = load.magnitude.phase
        if isinstance(phase, InputPhase):
            found: Acting = self._between_inputs(name, phase)
        else:
            assert isinstance(phase, SwingPhase | MovingPhase)
            limits = (self.whole or self).limits.get(phase.output)
            if limits is None:
                return _Never(load, self.span)
            events_ = limits.events.kept(limits.is_outermost()) if phase.outermost else limits.events
            self.kept_limits.append((limits, events_))
            strokes = of_limits(events_, (phase.start == "min", phase.end == "min"), limits.span)
            if not phase.in_part:
                found = OnStrokes(load, strokes, by_time=bool(self.machine.course.turns))
            else:
                assert isinstance(phase, SwingPhase)
                value = self.cycle.load_values[phase.output]
                found = InPart(load, phase, strokes, limits, value, (self.whole or self).known, self.designs)
                self._thresholds(found, phase)
        self.lacking |= found.missing
        return found

    @cached_property
    def kept_limits(self) -> list[tuple[Limits, Events]]:
        """The limits of outputs by which loads go, and those of them that count."""
        return []

    def _thresholds(self, part: InPart, phase: SwingPhase) -> None:
        """Where an output reaches the beginning and the end of a part of its stroke."""
        output, machine = phase.output, self.machine

        def beyond(t: Trace, found: Mapping[str, Scalar]) -> dict[str, Scalar]:
            return {"g": found["value"] - t.position(REACH)}

        formula = machine.formula(("reach", output), lambda: {"value": machine.traces.value(output)}, beyond)
        for which in phase.part_edges:
            (found,) = self._events(formula, self.base, {REACH: np.nan_to_num(part.reach(which))})
            self.reached.append((found, part, which))

    def _between_inputs(self, name: str, phase: InputPhase) -> Acting:
        """Between two values of the input."""
        course, load = self.machine.course, self.machine.mechanism.loads[name]
        ends = [
            self._at_input(f"loads.{name}.phase.input.{k}", x, 1)
            for k, x in enumerate((phase.start, phase.end))
        ]
        self.inputs += ends
        if not course.turns:
            values = self._dimension(name, phase, 0), self._dimension(name, phase, 1)
            return WithinInput(load, self.span, values, MotionSignals(self.machine.nominal).heading, [*ends])
        grows = bool((self.speed > 0.0).all())
        start, finish = ends
        backwards = not grows and phase.end > phase.start
        if backwards:
            start, finish = finish, start
        gap = np.abs(self._dimension(name, phase, 1) - self._dimension(name, phase, 0))
        fits, strokes = gap <= 2.0 * pi + NEAR, between(start, finish, self.span)
        return OnStrokes(load, strokes, by_time=True, backwards=backwards, fits=fits)

    def _dimension(self, name: str, phase: InputPhase, which: int) -> Floats:
        """The value of the input at which a phase begins or ends, (designs,)."""
        plain = np.full(self.count, (phase.start, phase.end)[which])
        return self.designs.get(f"loads.{name}.phase.input.{which}", plain)

    def _at_input(self, address: str, value: float, every: int) -> AtInput | Events:
        """Where the input has a value."""
        course, varied = self.machine.course, address in self.designs
        x = self.designs[address] if varied else np.full(self.count, value)
        if course.turns:
            start = self.designs.get(
                f"{course.first.name}.start", np.full(self.count, course.first.law.at(0.0))
            )
            return AtInput(self.span, x, every, address if varied else "", self.speed, start)
        rotary = course.first.law.rotary

        def beyond(t: Trace, found: Mapping[str, Scalar]) -> dict[str, Scalar]:
            gone = found["input"] - t.position(REACH)
            return {"g": sin(0.5 / every * gone) if rotary else gone}

        formula = self.machine.formula(("input", every), dict, beyond)
        (found,) = self._events(formula, self.base, {REACH: x})
        self.reached_inputs[id(found)] = address
        return found

    @cached_property
    def _knots(self) -> Floats:
        """Times, s, at which tables over the time bend, and over inputs that follow laws."""
        signals, found = MotionSignals(self.machine.nominal), [np.empty(0)]
        for name in self.machine.loads.names:
            size = self.machine.mechanism.loads[name].magnitude.size
            if (
                isinstance(size, Table)
                and size.known_at
                and not (self.machine.course.turns and size.over == "input")
            ):
                found.append(size.bends(signals))
        course = self.machine.course
        times = np.concatenate(found)
        if course.closed:
            times = course.begin + (times - course.begin) % course.duration
        return np.unique(times[(times > course.begin) & (times < course.begin + course.duration)])

    def _families(self) -> list[Cuts]:
        """All events at which signals jump or bend."""
        machine, found = self.machine, list[Cuts](self.bends)
        for name in machine.loads.names:
            size = machine.mechanism.loads[name].magnitude.size
            if isinstance(size, Table) and size.known_at and machine.course.turns and size.over == "input":
                every = max(1, round((size.x[-1] - size.x[0]) / (2.0 * pi)))
                self.inputs += [self._at_input("", x, every) for x in size.x]
        ends = {id(each): each for acting in self.acting for each in acting.events}
        if self.whole is not None:
            limited = {id(kept) for _, kept in self.kept_limits}
            period = self.whole.span.period
            self.repeated = [
                Repeated(each, period, self.span) for key, each in ends.items() if key in limited
            ]
            found += self.repeated
            ends = {key: each for key, each in ends.items() if key not in limited}
        found += ends.values()
        found += [*self.inputs, *self.reversals, *(each for each, _, _ in self.reached)]
        asked = {*self.cycle.opposed, *self.cycle.on_strokes.values()}
        asked |= {load.magnitude.phase.output for load in machine.mechanism.loads.values()
                  if isinstance(load.magnitude.phase, MovingPhase)}  # fmt: skip
        found += [self.limits[each].events for each in asked if each in self.limits]
        return list({id(each): each for each in found}.values())

    def _loaded(self, design: Indices, time: Floats, middle: Floats) -> dict[str, Floats]:
        return {k: v for acting in self.acting for k, v in acting.columns(design, middle).items()}

    def _columns(self, stretch: Indices, first: Floats, last: Floats) -> dict[str, Floats]:
        design = self.stretches.design[stretch]
        low, high = self.stretches.ends(stretch, first, last)
        found = {name: each[design] for name, each in self.designs.items()} | {LOW: low, HIGH: high}
        return found | self._loaded(design, low, 0.5 * (low + high))

    # summaries ------------------------------------------------------------------------------------------
    @cached_property
    def passed(self) -> Flags:
        """Designs that pass the whole cycle, with friction that is certain, and loads that have values,
        (designs,)."""
        valid = self.pieces.most(-self.pieces.bottom[-1]) == -1.0
        tracked = self.known.paths is None or self.known.paths.passed
        return np.asarray(self.pieces.passed & valid & tracked & ~self.lacking)

    @cached_property
    def turned_round(self) -> Flags:
        """Designs in which an output reverses that never does where the numbers are meant, (designs,)."""
        found = np.zeros(self.count, dtype=np.bool_)
        for output in self.cycle.never:
            if output in self.limits:
                found |= np.bincount(self.limits[output].events.design, minlength=self.count) > 0
        return found

    @cached_property
    def means(self) -> dict[int, Floats]:
        """Means over the time of signals that are met everywhere, (designs,)."""
        return {k: self.pieces.mean(k) for k in self.cycle.even}

    @cached_property
    def extremes(self) -> dict[Side, tuple[Indices, Floats, Floats]]:
        """Piece, place in it (-1 to 1) and value of the extremes of all sides, (designs,) each."""
        sides = self.cycle.sides
        if not sides:
            return {}
        rows, side, piece = self.pieces.contenders(
            [(k, sign) for k, sign, _ in sides], [self._on_stroke(stroke) for *_, stroke in sides]
        )
        place, value = climbed(rows)
        design, signal = self.pieces.design[piece], np.array([k for k, *_ in sides])[side]
        jumps = self.pieces.unresolved(signal, piece)
        if jumps.any():
            node = rows[:, jumps].argmax(axis=0)
            place[jumps], value[jumps] = 2.0 * NODES[node] - 1.0, rows[:, jumps].max(axis=0)
        alike = EQUAL * self.pieces.size[signal, design]
        place = np.where((self.pieces.top - self.pieces.bottom)[signal, piece] <= alike, -1.0, place)
        time = self._inside(self._time(piece, place), design)
        best = best_of(value, side * self.count + design, alike, time)
        shape = (len(sides), -1)
        signs = np.array([sign for _, sign, _ in sides])[:, None]
        found = piece[best].reshape(shape), place[best].reshape(shape), value[best].reshape(shape) * signs
        return {each: (found[0][k], found[1][k], found[2][k]) for k, each in enumerate(sides)}

    def _on_stroke(self, stroke: tuple[Output, str] | None) -> Flags | None:
        """The pieces in which an output rises, or falls; None for all."""
        if stroke is None:
            return None
        output, kind = stroke
        pieces = self.pieces
        middle = pieces.columns[LOW] + 0.5 * pieces.width
        rising = self.limits[output].rising_at(pieces.design, middle)
        has = pieces.each(self.limits[output].complete)
        return np.asarray(has & (rising == (kind == "rising")))

    @cached_property
    def values(self) -> dict[str, Floats]:
        """All parts, (designs,) each; NaN of designs that do not pass."""
        with np.errstate(invalid="ignore"):
            found = {
                text: self._value(text, part)
                for text, part in self.cycle.parts.items()
                if part.kind not in TRUE_SPEED
            }
        return {text: np.where(self.passed, each, np.nan) for text, each in found.items()}

    def _value(self, text: str, part: Summary) -> Floats:
        kind = part.kind
        if text in self.cycle.limited:
            limits = self.limits.get(self.cycle.limited[text])
            if limits is None:
                return np.full(self.count, np.nan)
            if kind == "range":
                return limits.at("max") - limits.at("min")
            return self.input_at(limits.time(kind[3:])) if kind.startswith("arg") else limits.at(kind)
        signal = self.cycle.words[text]
        k, rooted = self.cycle.number[signal], signal.squared
        if kind == "mean":
            return self.means[k]
        if kind == "rms":
            return np.sqrt(self.means[k] if rooted else self.pieces.mean_square(k))
        if kind == "excess":
            high, low = self.excess(k)
            return (high[2] - low[2]) * np.abs(self.speed)
        if kind.startswith("arg"):
            return self.input_at(self.time_of(text))
        sides = [self.extremes[side][2] for side in self.cycle.sides_of[text]]
        if rooted:
            sides = [np.sqrt(np.maximum(each, 0.0)) for each in sides]
        if kind == "range":
            return sides[0] - sides[1]
        return np.maximum(np.abs(sides[0]), np.abs(sides[-1])) if kind == "peak" else sides[0]

    def time_of(self, text: str) -> Floats:
        """When a part is there, (designs,) s; NaN of what belongs to no time."""
        kind = self.cycle.parts[text].kind
        if text in self.cycle.limited:
            limits = self.limits.get(self.cycle.limited[text])
            none = kind == "range" or limits is None
            return (
                np.full(self.count, np.nan)
                if none or limits is None
                else limits.time(kind.removeprefix("arg"))
            )
        sides = self.cycle.sides_of.get(text, ())
        if not sides or kind == "range":
            return np.full(self.count, np.nan)
        times = [self._inside(self._time(*self.extremes[side][:2])) for side in sides]
        if len(times) > 1:
            high, low = (np.abs(self.extremes[side][2]) for side in sides)
            upwards = np.where(
                np.abs(high - low) <= EQUAL * np.maximum(high, low), times[0] <= times[1], high > low
            )
            times[0] = np.where(upwards, *times)
        k, _, stroke = sides[0]
        return times[0] if stroke else np.where(self._constant[k], self.span.begin, times[0])

    @cached_property
    def _constant(self) -> Flags:
        """Signals that are the same over the whole cycle, (signals, designs)."""
        pieces = self.pieces
        return np.asarray(pieces.most(pieces.top) + pieces.most(-pieces.bottom) <= EQUAL * pieces.size)

    def _time(self, piece: Indices, place: Floats) -> Floats:
        """Times of places, -1 to 1, in pieces, s."""
        return np.asarray(self.pieces.columns[LOW][piece] + 0.5 * (1.0 + place) * self.pieces.width[piece])

    def _inside(self, time: Floats, design: Indices | slice = slice(None)) -> Floats:
        """The same times in the cycle that begins where the course does."""
        course = self.machine.course
        if not course.closed:
            return time
        period = self.span.period[design]
        share = (time - course.begin) / period
        return np.asarray(time - np.floor(share + 1e-12) * period)

    def input_at(self, time: Floats) -> Floats:
        """The first driver's coordinate at times, (designs,) rad or m."""
        course = self.machine.course
        if not course.turns:
            known = np.isfinite(time)
            value = course.first.law.coordinate(np.where(known, time, course.begin))[0]
            return np.where(known, value, np.nan)
        start = self.designs.get(f"{course.first.name}.start", course.first.law.at(0.0))
        return np.asarray(start + self.speed * self._inside(time))

    def excess(self, k: int) -> list[tuple[Indices, Floats, Floats]]:
        """Piece, place and value of the largest and of the smallest integral over the time of a signal's lack of its
        mean."""
        if k not in self._excess:
            lack, design = self.pieces.excess(k, self.means[k]), self.pieces.design
            found = []
            for sign in (1.0, -1.0):
                piece, place, value = largest(sign * lack, design)
                found.append((piece, place, sign * value))
            self._excess[k] = found
        return self._excess[k]

    @cached_property
    def _excess(self) -> dict[int, list[tuple[Indices, Floats, Floats]]]:
        return {}


class _Turned:
    """Limits of the outputs by which loads go over the whole cycle, of which the course is a part."""

    def __init__(self, solved: Solved, machine: Machine) -> None:
        cycle, designs = solved.cycle, solved.designs
        self.span = Span(machine.course, solved.periods(machine), np.zeros(solved.count))
        self.base = Stretches(self.span, [])
        self.known = machine.tracked(designs, self.span.period)
        rates = events(cycle.load_rates, self.known, designs, self.base) if cycle.load_rates else []
        self.limits = {
            output: Limits(each, cycle.load_values.get(output), self.span)
            for each in rates
            for output in [cycle.load_outputs[int(each.name)]]
        }


class _Never(Acting):
    """A load whose phase no design has."""

    def __init__(self, load: Load, span: Span) -> None:
        super().__init__(load, span)
        self.events = []

    @property
    def missing(self) -> Flags:
        return np.ones(self.span.count, dtype=np.bool_)

    def columns(self, design: Indices, middle: Floats) -> dict[str, Floats]:
        nothing = np.zeros(len(design))
        return self._named(nothing > 0.0, nothing, nothing + 1.0)

    def pull(self, design: Indices, middle: Floats, by_columns: Mapping[str, Floats]) -> None:
        """Nothing follows from it."""


#: The column that is a value which is reached.
REACH = "reach"
