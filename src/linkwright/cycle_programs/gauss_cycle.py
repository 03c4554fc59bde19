"""The cycle of many designs at Gauss points: exact means and extremes of signals that loads switch on and off.

Every design's way of the input is cut where its own loads begin or end to act, and each stretch into pieces with
sixteen Gauss points: what ``metrics/cycle_grid.py`` does for one machine. The cuts are cycle values of the design
(limit positions, ends of phases), so derivatives pass through them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import field, replace
from functools import cached_property
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.inputs import turned
from linkwright.core.outputs import Output, owners_of
from linkwright.core.piecewise import NODES, POINTS, WEIGHTS
from linkwright.cycle_programs.corners import (
    AROUND,
    REACH,
    REST,
    Corner,
    Signed,
    corner_stages,
    corners_of,
    signed_values,
)
from linkwright.cycle_programs.iterated_groups import limits_beside
from linkwright.cycle_programs.joint_bends import FIRST, bend_names, bend_stage, turning
from linkwright.cycle_programs.limit_stages import (
    constants,
    limit_stages,
    part_edge,
    part_edge_beside,
    part_edges,
    part_of_stroke,
    rates,
    whole_turns,
)
from linkwright.cycle_programs.loaded_cycle import friction_doubt
from linkwright.cycle_programs.traced_outputs import VALID, Traced
from linkwright.cycle_programs.uneven_bends import MOST, UnevenBends, uneven_bends
from linkwright.engine.program import Program
from linkwright.engine.reductions import Reduction
from linkwright.engine.stage import Stage
from linkwright.engine.trace import Mask, Scalar, Trace, floor, maximum, minimum, select, sign
from linkwright.kinetostatics.friction import Swinging
from linkwright.kinetostatics.load_site import limit_name
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.kinetostatics.traced_loads import AlongInput
from linkwright.loads.base import Load
from linkwright.loads.phases import InputPhase
from linkwright.loads.sizes import Formula, Table
from linkwright.loads.strokes import TURN

#: Numbers of pieces of the whole turn to try one after another, and the share of them that a stretch between two cuts
#: has at least.
PIECES, LEAST = (12, 28, 56, 112), 0.25
#: Share of the turn within which two cuts are one.
SAME = 1e-9
#: The output that is a node's share of the cycle's time.
SHARE = "share of the cycle"


def side_by_side(traced: Traced, varied: Iterable[str]) -> bool:
    """Whether designs can go through the Gauss points of one cycle: of whole turns of one driver of constant speed,
    passed without change points, all rotations counted."""
    if not whole_turns(traced, varied):
        return False
    return traced.nominal.whole and not traced.nominal.modes and traced.countable


def iterated(traced: Traced) -> tuple[str, ...]:
    """The chain coordinates of groups without closed form, by the names of the states that carry them."""
    return tuple(name for placed in traced.solver.motion.placed.values() for name in placed.next_states)


def can_have_corners(traced: Traced) -> bool:
    """Whether the cycle can be cut where friction bends: all groups have a closed form."""
    return not iterated(traced)


def at_point(state: str) -> str:
    """The field that is a chain coordinate at the Gauss points."""
    return f"at:{state}"


@dataclass(frozen=True)
class GaussCycle:
    """The stages that lead to signals at the Gauss points of every design.

    ``cuts``: names of what gives the inputs, rad, of the cuts, cycle values and dimensions, with the turns after
    which they come again, none where they do once; ``wanted``: pieces of a turn; ``bends``: places at which the cycle
    is cut as well, from the first of which it then runs; ``corners``: those of the cuts where ``signed`` values are
    zero.
    """

    traced: Traced
    cuts: tuple[tuple[str, int], ...]
    wanted: int
    bends: UnevenBends | None = None
    corners: tuple[Corner, ...] = ()
    signed: Mapping[str, Signed] = field(default_factory=dict)

    @classmethod
    def of(cls, traced: Traced, loads: AlongInput, wanted: int) -> GaussCycle:
        """For the loads whose magnitudes are traced, and the friction."""
        found: dict[tuple[str, int], None] = {}
        for name in sorted(loads.names):
            found |= dict.fromkeys(_cuts(traced.mechanism.loads[name]))
        for term in loads.swinging:
            found |= dict.fromkeys((limit_name(term, kind), 0) for kind in ("max", "min"))
        found |= dict.fromkeys((name, 0) for name in bend_names(traced))
        cycle = cls(traced, tuple(found), wanted)
        return replace(cycle, bends=uneven_bends(traced)) if cycle._moving <= MOST else cycle

    def cornered(
        self, loads: AlongInput, signals: Iterable[Scalar], rubbing: Iterable[Swinging]
    ) -> GaussCycle:
        """The same with cuts where friction and the forces of teeth in ``signals`` bend and what is ``rubbing``
        turns round, in the machine as it is; pieces are shorter near all cuts, where such forces are small."""
        if not can_have_corners(self.traced):
            return self
        signed = signed_values(self.traced, signals, rubbing)
        limits = limit_stages(
            self.traced, [*loads.outputs, *loads.moving, *loads.swinging], valued=loads.valued, judged=False
        )
        known = {**self.traced.solver.nominal.parameters, **self.constants, **loads.constants}
        known |= constants(self.traced, self.count)
        before = [*limits, *self.cut_stages()]
        corners = corners_of(self, signed, before, known, self.positions, loads.tables)
        if not corners:
            return self
        cuts = (*self.cuts, *((corner.name, 0) for corner in corners))
        return replace(self, cuts=cuts, corners=corners, signed=signed)

    @property
    def stretches(self) -> int:
        """Number of stretches between cuts."""
        between = 0 if self.bends is None else self.bends.stretches
        return max(1, self._moving + between)

    @property
    def _moving(self) -> int:
        """Number of cuts, each as often as it comes."""
        return sum(len(self._laps(every)) for _, every in self.cuts)

    def _laps(self, every: int) -> range:
        """Turns after which a cut comes again within the cycle."""
        return range(0, self.turns, every or self.turns)

    @property
    def pieces(self) -> int:
        """Number of pieces of the cycle."""
        return self.stretches * self._each

    @property
    def _each(self) -> int:
        longest = (
            max(min(LEAST, self._apart), 1.0 / self.stretches) if self.bends is None else self.bends.longest
        )
        return math.ceil(self.wanted * self.turns * longest)

    @cached_property
    def _apart(self) -> float:
        """The longest stretch between bends of a joint that turns steadily, as share of the cycle; 1 without one."""
        return min((each.longest for each in turning(self.traced, steady=True)), default=1.0)

    @cached_property
    def turns(self) -> int:
        """Number of turns of the driver in the cycle."""
        return whole_turns(self.traced)

    @property
    def finer(self) -> GaussCycle | None:
        """The same with the next number of pieces."""
        following = [pieces for pieces in PIECES if pieces > self.wanted]
        return replace(self, wanted=following[0]) if following else None

    @property
    def speed(self) -> float:
        """Speed of the driver, rad/s."""
        (driver,) = self.traced.positions.coordinates
        return self.constants[f"{driver}.speed"]

    @property
    def way(self) -> float:
        """What the driver turns in the cycle, rad."""
        return TURN * self.turns

    @property
    def count(self) -> int:
        """Number of Gauss points."""
        return self.pieces * POINTS

    @cached_property
    def positions(self) -> dict[str, Floats]:
        """Inputs (n,): the uniform turn for limit stages, and how places and widths follow from the cuts."""
        shares = np.arange(self.count) / self.count
        first, time, speed = list(self.constants.values())[:3]
        angle = first + np.sign(speed) * self.way * shares
        (driver,) = self.traced.mechanism.drivers
        found = turned(driver, angle, np.cos, np.sin)
        found |= {"input": angle, "time": time + shares * self.way / abs(speed), **self._along}
        reach = np.full(self.count, REST * self.way / self.count)
        return {**found, REACH: reach, AROUND: np.where(shares == shares[-1], reach, 0.0)}

    @property
    def constants(self) -> dict[str, float]:
        """Input, rad, and time, s, at which the cycle begins, and the driver's speed, rad/s."""
        known = self.traced.positions
        (driver,) = known.coordinates
        q, rate, _ = known.coordinates[driver]
        found = {FIRST: float(q[0]), "first time": float(known.time[0]), f"{driver}.speed": float(rate[0])}
        for load in self.traced.mechanism.loads.values():
            table = load.magnitude.size
            if isinstance(table, Table) and table.known_at:
                knots = np.array(table.x)
                inputs = knots if table.over == "input" else q[0] + rate[0] * (knots - known.time[0])
                found |= {f"knot {load.name} {k}": float(at) for k, at in enumerate(inputs)}
        return found

    @property
    def _along(self) -> dict[str, Floats]:
        """Weights of every cut's share in a node's share of the turn and in its width; the first nodes of all pieces
        come first, so that a function's values are (POINTS, pieces)."""
        stretch = np.tile(np.repeat(np.arange(self.stretches), self._each), POINTS)
        edges = np.arange(self._each + 1) / self._each
        if self.corners:
            edges = np.sin(0.5 * np.pi * edges) ** 2
        half = 0.5 * np.diff(edges)
        inside = np.tile(edges[:-1] + half * (1.0 + NODES[:, None]), self.stretches).ravel()
        width = np.tile(WEIGHTS[:, None] * half, self.stretches).ravel()
        if self.bends is not None:
            return {"inside": inside, "width": width, **self.bends.around(stretch, self._moving)}
        found = {}
        for k in range(self.stretches):
            begins, ends = stretch == k, (stretch + 1) % self.stretches == k
            found[f"place {k}"] = np.where(begins, 1.0 - inside, 0.0) + np.where(ends, inside, 0.0)
            found[f"width {k}"] = np.where(ends, width, 0.0) - np.where(begins, width, 0.0)
        last = stretch == self.stretches - 1
        found["place after"] = np.where(last, inside, 0.0)
        found["width after"] = np.where(last, width, 0.0)
        return found

    def limit_stages(
        self, outputs: Iterable[Swinging], valued: Iterable[Output], shown: Iterable[Output]
    ) -> list[Stage]:
        """The stages that find limits of outputs, see ``limit_stages.limit_stages``."""
        find = limits_beside if iterated(self.traced) else limit_stages
        return find(self.traced, outputs, valued=valued, shown=shown)

    def cut_stages(self, beside: Traced | None = None) -> list[Stage]:
        """The stages that find the cuts, but for limit positions: where parts of strokes begin and end, where joints
        bend, and the cuts in order; ``beside``: programs with Newton's steps from positions, where groups have no
        closed form."""
        bending, known = bend_stage(self.traced), dict(self.cuts)
        found = [] if bending is None else [bending]
        for load in self.traced.mechanism.loads.values():
            if phase := part_of_stroke(load):
                edges = [k for k, name in part_edges(load).items() if name in known]
                for k in edges:
                    found += (
                        [part_edge(self.traced, load, phase, k)]
                        if beside is None
                        else part_edge_beside(beside, load, phase, k)
                    )
        found += corner_stages(self, self.signed, self.corners)
        return [*found, self._cutting()] if self.cuts else found

    def _cutting(self) -> Stage:
        """The stage that brings the cuts into order, as shares of the cycle from its beginning."""
        t = Trace()
        (driver,) = self.traced.mechanism.drivers
        start, sense = t.parameter(FIRST), sign(t.parameter(f"{driver}.speed"))
        shares: list[Scalar] = []
        for name, every in self.cuts:
            period = every or self.turns
            share = (t.parameter(name) - start) * sense / (TURN * period)
            first = (share - floor(share)) * (period / self.turns)
            for lap in self._laps(every):
                share = first + lap / self.turns
                shares.append(share - floor(share) if lap or period > self.turns else share)
        return ordered_cuts(t, shares)

    def signals(
        self, outputs: Mapping[str, Scalar], one_way: Iterable[Output] = ()
    ) -> tuple[Trace, dict[str, Scalar]]:
        """A trace over the Gauss points with the outputs, whether they are valid, and the share of the time; the
        chain coordinates of groups without closed form are fields. Valid is what moves ``one_way`` as in the machine
        itself."""
        trace = self.traced.solver.motion.trace
        source = Program.of(trace, {**outputs, VALID: certain(self.traced, one_way)})
        t = Trace()
        point, width = self.point(t)
        carried = {name: t.field_input(at_point(name)) for name in iterated(self.traced)}
        found = self.traced.at_input(source, t, point["input"], {**point, **carried})
        return t, {**found, SHARE: width}

    def span(self, t: Trace) -> tuple[Scalar, Scalar]:
        """The input, rad, where the cycle begins, and how far it goes."""
        (driver,) = self.traced.mechanism.drivers
        return t.parameter(FIRST), sign(t.parameter(f"{driver}.speed")) * self.way

    def place(self, t: Trace) -> Scalar:
        """The inputs of the uniform turn, rad."""
        return t.position("input")

    def over_places(self, program: Program) -> Program:
        """A program of the motion over these."""
        t = Trace()
        more = {name: t.position(name) for name in ("input", "time")}
        return Program.of(t, self.traced.at_input(program, t, more["input"], more))

    def there(self, program: Program, t: Trace, x: Scalar) -> dict[str, Any]:
        """The outputs of a program of the motion at an input, rad."""
        (driver,) = self.traced.mechanism.drivers
        first, whole = self.span(t)
        share = (x - first) / whole
        inside = first + (share - floor(share)) * whole
        time = t.parameter("first time") + (inside - first) / t.parameter(f"{driver}.speed")
        return self.traced.at_input(program, t, inside, {"input": inside, "time": time})

    def point(self, t: Trace) -> tuple[dict[str, Scalar], Scalar]:
        """Input, rad, and time, s, of the Gauss points, and their shares of the time."""
        (driver,) = self.traced.mechanism.drivers
        first, whole = self.span(t)
        cuts: list[Scalar] = [t.parameter(f"cut {k}") for k in range(self._moving)]
        place, width = (
            self._between_cuts(t, cuts) if self.bends is None else self._between_bends(t, cuts, whole)
        )
        way = whole * (place - floor(place))
        time = t.parameter("first time") + way / t.parameter(f"{driver}.speed")
        return {"input": first + way, "time": time}, width

    def _between_cuts(self, t: Trace, cuts: list[Scalar]) -> tuple[Scalar, Scalar]:
        """Place and share of a Gauss point, as shares of the cycle."""
        place: Scalar = t.position("place after")
        width: Scalar = t.position("width after")
        for k, cut in enumerate(cuts):
            place = place + t.position(f"place {k}") * cut
            width = width + t.position(f"width {k}") * cut
        return place, width

    def _between_bends(self, t: Trace, cuts: list[Scalar], whole: Scalar) -> tuple[Scalar, Scalar]:
        """The same where the cycle begins with a bend."""
        assert self.bends is not None
        first = self.bends.first(t)
        begin = (first - t.parameter(FIRST)) / whole
        later = [cut - begin - floor(cut - begin) for cut in cuts]
        low, high = self.bends.bounds(t, first, whole, later)
        return begin + low + t.position("inside") * (high - low), t.position("width") * (high - low)


def certain(traced: Traced, one_way: Iterable[Output]) -> Mask:
    """Where a position is reached, rotations are counted, friction is certain, and some outputs go the way that they
    go in the machine itself."""
    logic = traced.solver.motion.trace.logic
    found = logic("and", traced.counted_for_certain, friction_doubt(traced) < 0.5)
    nominal = MotionSignals(traced.nominal)
    for output in one_way:
        sense = float(np.sign(nominal.output(output)[1].mean()))
        found = logic("and", found, rates(traced, output)[0] * sense > 0.0)
    return found


def ordered_cuts(t: Trace, shares: list[Scalar]) -> Stage:
    """The stage that finds cuts, shares of the cycle, in order."""
    _sort(shares)
    outputs = {f"cut {k}": share for k, share in enumerate(_apart(shares))}
    return Stage(Program.of(t, outputs), {name: Reduction(name, "first") for name in outputs}, steps=1)


def _sort(shares: list[Scalar]) -> None:
    """Brings traced values into order, by merging that exchanges (Batcher 1968; Knuth 5.2.2, algorithm M)."""
    top = 1 << max(0, (len(shares) - 1).bit_length() - 1)
    p = top
    while p:
        q, r, d = top, 0, p
        while d:
            for i in range(len(shares) - d):
                if i & p == r:
                    low, high = shares[i], shares[i + d]
                    shares[i], shares[i + d] = minimum(low, high), maximum(low, high)
            d, q, r = q - p, q >> 1, p
        p >>= 1


def _apart(shares: list[Scalar]) -> list[Scalar]:
    """The same cuts, in order, those that coincide moved into the stretches beside them.

    Where two limit positions are one, as of links that turn together, a stretch of no width would lie between them,
    in which loads and friction are what rounding makes of them.
    """
    found, last = list(shares), len(shares) - 1
    for k in range(last, 0, -1):
        following = found[k + 1] if k < last else found[0] + 1.0
        together = found[k] - found[k - 1] <= SAME
        found[k] = select(together, 0.5 * (found[k] + following), found[k])
    if last:
        around = found[0] + 1.0 - found[last] <= SAME
        found[last] = select(around, 0.5 * (found[last - 1] + found[last]), found[last])
    return found


def reversing(traced: Traced, program: Program) -> tuple[tuple[Output, ...], tuple[Swinging, ...]]:
    """What goes to and fro, at whose limits loads on which a program depends change their signs: outputs with two
    limits, and angles between links and outputs with more."""
    taken = {name.split(".")[1] for name in program.parameters if name.startswith("loads.")}
    taken |= set(owners_of("magnitude", program.fields))
    found = dict.fromkeys(traced.mechanism.loads[name].reverses(traced.mechanism) for name in sorted(taken))
    signals = MotionSignals(traced.nominal)
    speeds = {each: signals.rate(each) for each in found if each is not None}
    both = [each for each, speed in speeds.items() if speed.min() < 0.0 < speed.max()]
    twice = tuple(each for each in both if isinstance(each, Output) and len(signals.limits(each)) == 2)
    return twice, tuple(each for each in both if each not in twice)


def _cuts(load: Load) -> Iterable[tuple[str, int]]:
    """What gives the inputs at which a load jumps or kinks, with the turns after which it does so again."""
    size, phase = load.magnitude.size, load.magnitude.phase
    if isinstance(phase, InputPhase):
        yield from ((f"loads.{load.name}.phase.input.{k}", 1) for k in (0, 1))
    yield from ((limit_name(output, kind), 0) for output in phase.outputs for kind in ("max", "min"))
    yield from ((name, 0) for name in part_edges(load).values())
    if isinstance(size, Formula) and size.expression.names & {"t", "input"}:
        yield FIRST, 0
    if isinstance(size, Table) and size.known_at:
        yield FIRST, 0
        every = max(1, round((size.x[-1] - size.x[0]) / TURN)) if size.over == "input" else 0
        yield from ((f"knot {load.name} {k}", every) for k in range(len(size.x)))
