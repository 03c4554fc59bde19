"""The cycle program of a mechanism with traced loads: limit positions first, then forces and summaries."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import field, replace

import numpy as np
from numpy.typing import NDArray

from linkwright.core.dataclass import dataclass
from linkwright.core.expressions import Expression
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.reductions import VALID_COUNT, Reduction, Results
from linkwright.engine.stage import Backend, Stage
from linkwright.engine.table import Table
from linkwright.engine.trace import Scalar, select
from linkwright.errors import LinkwrightError
from linkwright.fields.signals import MovingPhase, Output, SwingPhase
from linkwright.kinetostatics.friction import FrictionTerm
from linkwright.kinetostatics.friction_stage import can_be_traced, still_name
from linkwright.kinetostatics.run import STILL, joint_rate
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.kinetostatics.site import TracedSite, constant_name, middle_name
from linkwright.loads.along_input import constants as of_load
from linkwright.loads.along_input import followed, magnitude, outputs_of
from linkwright.loads.base import Load
from linkwright.loads.formulas import denominators
from linkwright.loads.phases import TURN
from linkwright.study.limit_stages import Swinging, constants, limit_stages
from linkwright.study.traced import TURNING, VALID, Traced

Floats = NDArray[np.float64]
#: The output that is the sum of magnitudes which may not exist, and that is 1 where friction is not certain.
SIZES, RUBBING = "sizes of loads", "doubt of friction"


@dataclass(frozen=True)
class LoadedCycle:
    """The cycle program, and what its loads need."""

    traced: Traced
    cycle: CycleProgram
    loads: AlongInput

    def evaluate(
        self, part: Mapping[str, Floats], threads: int | None, backend: Backend
    ) -> tuple[Results, NDArray[np.intp]]:
        """Results of designs with the given columns, and the numbers of those of which limits or friction are not
        certain, or loads have no value somewhere."""
        results = self.cycle.evaluate(
            self.table(part),
            self.traced.positions.arrays,
            tables=self.loads.tables,
            threads=threads,
            backend=backend,
        )
        doubt = np.zeros(len(next(iter(part.values()))))
        for each in self.loads.outputs:
            doubt += results[f"doubt:{each}"]
        if self.loads.fallible:
            doubt += 0.0 * results[SIZES]
        if self.loads.rubbing:
            doubt += results[RUBBING]
        doubt[results[VALID_COUNT] != self.traced.positions.count] = 0.0
        return results, np.flatnonzero(~(doubt == 0.0))

    def table(self, part: Mapping[str, Floats]) -> Floats:
        """What the cycle program takes of the designs with the given columns, (designs, dimensions)."""
        known = {**self.traced.solver.nominal.parameters, **constants(self.traced), **self.loads.constants}
        designs = len(next(iter(part.values())))
        columns = [part[name] if name in part else known[name] for name in self.cycle.dimensions]
        return np.stack([np.broadcast_to(each, designs) for each in columns], axis=1)


@dataclass(frozen=True)
class AlongInput:
    """Loads whose magnitudes are traced, and what these take.

    ``outputs``: those whose limit positions they need; ``valued``: of which also the values there; ``constants`` by
    name and ``tables`` by name: numbers of the loads that are no dimensions; ``fallible``: loads that may have no
    value for some designs; ``rubbing``: the friction of joints is traced as well; ``swinging``: what turns round at
    two positions, where friction and loads against velocities change their signs.
    """

    names: frozenset[str]
    outputs: tuple[Output, ...] = ()
    valued: tuple[Output, ...] = ()
    constants: Mapping[str, float] = field(default_factory=dict)
    tables: Mapping[str, Table] = field(default_factory=dict)
    fallible: tuple[str, ...] = ()
    rubbing: bool = False
    swinging: tuple[Swinging, ...] = ()

    def traced(self, plain: Traced) -> Traced:
        """The same outputs with these loads, and the friction, traced."""
        if not self.names and not self.rubbing:
            return plain
        manner = plain.solver.manner
        return Traced(
            plain.mechanism, manner.free, plain.positions, along_input=self.names, rubbing=self.rubbing
        )

    def stages(self, traced: Traced, *, judged: bool = True) -> list[Stage]:
        """The stages that find the limit positions."""
        return limit_stages(traced, self.outputs, judged=judged, valued=self.valued)

    def sizes(self, traced: Traced) -> Scalar:
        """Sum of the magnitudes of the fallible loads: not finite where one has no value."""
        motion = traced.solver.motion
        total: Scalar = 0.0
        for name in self.fallible:
            load = traced.mechanism.loads[name]
            total = total + magnitude(load, TracedSite(motion, load, along_input=True))
        return total


def along_input(traced: Traced, varied: Iterable[str], fields: Iterable[str]) -> AlongInput | None:
    """The loads behind a program's inputs per position; None where some input is no load that can be traced, or the
    cycle is no single turn of one driver of constant speed."""
    mechanism, given = traced.mechanism, tuple(fields)
    rubbing = any(name.startswith("friction:") for name in given)
    if rubbing:
        given = traced.forces.fields_needed()
    names = [name.removeprefix("load:") for name in given if name.startswith("load:")]
    terms = traced.forces.friction.terms if rubbing else ()
    if len(names) + len(terms) < len(given) or not can_be_traced(mechanism, len(terms)):
        return None
    still = still_rates(traced, terms)
    swinging = dict.fromkeys(_swinging(term) for term in terms if _swings(traced, term))
    plain = AlongInput(frozenset(), constants=still, rubbing=rubbing, swinging=tuple(swinging))
    if not names:
        return plain
    loads = [mechanism.loads[name] for name in sorted(names)]
    if not one_turn(traced, varied) or not all(followed(load, mechanism) for load in loads):
        return None
    middles = _middles(traced, loads)
    if middles is None:
        return None
    known = numbers_of_loads(loads)
    constants = {**known.constants, **middles, **still}
    return replace(known, constants=constants, rubbing=rubbing, swinging=plain.swinging)


def _swinging(term: FrictionTerm) -> Swinging:
    """What comes and goes with a joint, the motion of a link where that tells it."""
    if term.slides:
        return Output("displacement", term.joint, term.joint)
    moving = [link for link in (term.a, term.b) if link != "frame"]
    return Output("angle", moving[0], moving[0]) if len(moving) == 1 else term


def _swings(traced: Traced, term: FrictionTerm) -> bool:
    """Whether the parts of a joint move both ways."""
    rate = joint_rate(traced.nominal, term)
    largest = STILL * float(np.nanmax(np.abs(rate), initial=0.0))
    return bool(np.nanmin(rate) < -largest and np.nanmax(rate) > largest)


def friction_doubt(traced: Traced) -> Scalar:
    """1 where the traced friction is not certain, as a traced value."""
    friction = traced.forces.programs.friction
    return 0.0 if friction is None else select(friction.certain, 0.0, 1.0)


def still_rates(traced: Traced, terms: Iterable[FrictionTerm]) -> dict[str, float]:
    """Rates below which joints with friction stand still."""
    rates = {still_name(term): np.abs(joint_rate(traced.nominal, term)) for term in terms}
    return {name: STILL * float(np.nanmax(rate, initial=0.0)) for name, rate in rates.items()}


def numbers_of_loads(loads: Iterable[Load]) -> AlongInput:
    """What the magnitudes of loads take, but for the angles near which angles stay."""
    given = tuple(loads)
    phases = [
        phase for each in given if isinstance(phase := getattr(each, "phase", None), SwingPhase | MovingPhase)
    ]
    parts = [phase.output for phase in phases if isinstance(phase, SwingPhase) and phase.part is not None]
    numbers = {constant_name(each.name, key): value for each in given for key, value in of_load(each).items()}
    over = {
        f"load:{each.name}": table for each in given if (table := getattr(each, "table", None)) is not None
    }
    fallible = [each.name for each in given if f"load:{each.name}" in over or of_load(each) or _divides(each)]
    return AlongInput(
        frozenset(each.name for each in given),
        tuple(dict.fromkeys(phase.output for phase in phases)),
        tuple(dict.fromkeys(parts)),
        numbers,
        {name: Table.linear(table.x, table.y) for name, table in over.items()},
        tuple(fallible),
    )


def _divides(load: Load) -> bool:
    given = getattr(load, "magnitude", None)
    return isinstance(given, Expression) and any(True for _ in denominators(given.tree))


def _middles(traced: Traced, loads: Iterable[Load]) -> dict[str, float] | None:
    """Angles near which the angles that loads take stay; None where a link turns through."""
    pairs: dict[tuple[str, str], float | None] = {}
    for load in loads:
        for output in outputs_of(load, traced.mechanism):
            if output.kind == "angle":
                pairs["frame", output.owner] = None
        if load.twist is not None:
            pairs[load.twist[0]] = load.twist[1]
    found = {}
    signals = MotionSignals(traced.nominal) if pairs else None
    for (a, b), near in pairs.items():
        assert signals is not None
        angle = traced.nominal.link(b).angle if near is None else signals.angle_between(a, b, near)
        low, high = float(np.nanmin(angle)), float(np.nanmax(angle))
        if not high - low <= TURNING or (near is not None and abs(angle[0] - near) > 0.9 * np.pi):
            return None
        found[middle_name(a, b)] = 0.5 * (low + high)
    return found


def loaded_cycle(
    traced: Traced, varied: Iterable[str], names: Iterable[str], reductions: Iterable[Reduction]
) -> LoadedCycle | None:
    """The cycle program of all designs; None where the loads cannot be traced."""
    known = along_input(traced, varied, traced.program(traced.quantities(names)).fields)
    if known is None:
        return None
    over_input = known.traced(traced)
    try:
        stages = known.stages(over_input)
    except LinkwrightError:
        return None
    made, more = {each.name: each for each in reductions}, dict[str, Scalar]()
    if known.fallible:
        more[SIZES] = known.sizes(over_input)
    if known.rubbing:
        more[RUBBING] = friction_doubt(over_input)
    program = over_input.program(over_input.quantities(names), more=more)
    made |= {name: Reduction(name, "sum") for name in more}
    stages.append(Stage(program, made, valid=VALID, count=VALID_COUNT))
    return LoadedCycle(over_input, CycleProgram(tuple(stages)), known)


def one_turn(traced: Traced, varied: Iterable[str]) -> bool:
    """Whether the cycle is one closed turn of the only driver, of constant speed, whatever varies."""
    drivers = list(traced.mechanism.drivers.values())
    speed = drivers[0].law.constant_speed if len(drivers) == 1 else None
    if speed is None:
        return False
    span = abs(speed) * (traced.positions.period or 0.0)
    turns = traced.positions.closed and traced.positions.rotary[drivers[0].name]
    return turns and abs(span - TURN) <= 1e-9 and f"{drivers[0].name}.speed" not in set(varied)
