"""Machines whose loads and friction are traced over positions, and what these take of the cycles of designs."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import inf

import numpy as np

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.strokes import TURN
from linkwright.core.arrays import Flags, Floats
from linkwright.core.outputs import kind_of, owners_of, row_name
from linkwright.cycle.load_limits import FoundLimits, LoadLimits
from linkwright.cycle.machine import Machine, NotTogether
from linkwright.designs.traced_outputs import Traced, design_table
from linkwright.errors import LinkwrightError
from linkwright.formula.reductions import VALID_COUNT, Results
from linkwright.formula.trace import Mask, Scalar, absolute, select
from linkwright.kinetostatics.friction_stage import can_be_traced
from linkwright.kinetostatics.load_site import turns_steadily
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.kinetostatics.traced_loads import AlongInput, numbers_of_loads, traced_magnitude
from linkwright.mechanism.mechanism import Mechanism

#: The output that is the sum of magnitudes which may not exist, and that is 1 where friction is not certain.
SIZES, RUBBING = "sizes of loads", "doubt of friction"


@dataclass(frozen=True)
class LoadedCycle:
    """A mechanism whose loads and friction are traced, and the ``limits`` between which these act; None where they
    need none; ``constants``: numbers that programs take in addition to dimensions."""

    traced: Traced
    loads: AlongInput = AlongInput(frozenset())
    limits: LoadLimits | None = None
    constants: Mapping[str, float] = field(default_factory=dict)

    def solve(self, part: Mapping[str, Floats]) -> FoundLimits | None:
        """The limits of the designs with the given columns."""
        return None if self.limits is None else self.limits.solve(part)

    def table(self, names: Sequence[str], part: Mapping[str, Floats], limits: Mapping[str, Floats]) -> Floats:
        """What a program takes of the designs with the given columns and limits, (designs, names)."""
        known = {**self.traced.solver.nominal.parameters, **self.constants}
        return design_table(names, known, {**part, **limits})

    @cached_property
    def sizes(self) -> dict[str, Scalar]:
        """Magnitudes of loads, and the friction, by the names of the fields that forces know them by."""
        motion, friction = self.traced.solver.motion, self.traced.forces.programs.friction
        loads = {row_name("magnitude", name): traced_magnitude(motion, name) for name in sorted(self.loads.names)}
        return loads if friction is None else {**loads, **friction.sizes}

    @property
    def sound(self) -> Mask:
        """Whether every load has a value at a position, and the friction is certain."""
        trace, friction = self.traced.solver.motion.trace, self.traced.forces.programs.friction
        found: Mask = True if friction is None else friction.certain
        for name in self.loads.fallible:
            found = trace.logic("and", found, absolute(self.sizes[row_name("magnitude", name)]) < inf)
        return found

    @cached_property
    def doubts(self) -> dict[str, Scalar]:
        """Traced values whose sums tell where loads have no value, and where friction is not certain."""
        found: dict[str, Scalar] = {}
        if self.loads.fallible:
            found[SIZES] = self.loads.sizes(self.traced.solver.motion)
        if self.loads.rubbing:
            found[RUBBING] = friction_doubt(self.traced)
        return found

    def doubtful(self, results: Results, limits: FoundLimits | None) -> Flags:
        """Designs with limits or friction that are not certain, or loads that have no value somewhere."""
        doubt = np.zeros(len(results[VALID_COUNT]))
        if self.loads.fallible:
            doubt += 0.0 * results[f"{SIZES}.sum"]
        if self.loads.rubbing:
            doubt += results[f"{RUBBING}.sum"]
        sure = doubt == 0.0
        return np.asarray(~(sure if limits is None else sure & limits.certain))


def loaded_cycle(traced: Traced, varied: Collection[str], fields: Iterable[str]) -> LoadedCycle | None:
    """That of the loads and the friction behind a program's inputs per position; None where these cannot be
    traced, or their limits not be found for many designs at once."""
    known = _loads_of(traced, varied, fields)
    return None if known is None else with_limits(traced, known)


def with_limits(traced: Traced, known: AlongInput) -> LoadedCycle | None:
    """The same with loads that are known; None where the limits cannot be found for many designs at once."""
    limits = None
    if known.outputs:
        phases = [traced.mechanism.loads[name].magnitude.limits for name in sorted(known.names)]
        try:
            cycle = MotionSignals(traced.nominal).turned
            machine = Machine(traced.mechanism, cycle, traced.solver.manner.free)
            limits = LoadLimits(machine, [phase for phase in phases if phase is not None])
        except (NotTogether, LinkwrightError):
            return None
    constants = {**known.constants, **({} if limits is None else limits.numbers)}
    return LoadedCycle(traced.with_loads(known.names, rubbing=known.rubbing), known, limits, constants)


def _loads_of(traced: Traced, varied: Collection[str], fields: Iterable[str]) -> AlongInput | None:
    """The loads behind a program's inputs per position; None where some input is no load that can be traced."""
    mechanism, carried = traced.mechanism, traced.solver.motion.next_states
    inputs = tuple(name for name in fields if name not in carried)
    rubbing = any(kind_of(name) == "friction" for name in inputs)
    if rubbing:
        inputs = traced.forces.fields_needed()
    names = owners_of("magnitude", inputs)
    terms = traced.forces.friction.terms if rubbing else ()
    if len(names) + len(terms) < len(inputs) or (rubbing and not can_be_traced(traced.forces.friction)):
        return None
    if not names:
        return AlongInput(frozenset(), rubbing=rubbing)
    loads = [mechanism.loads[name] for name in sorted(names)]
    sizes = [load.magnitude for load in loads]
    if not all(each.traceable(mechanism) for each in sizes):
        return None
    if not full_turns(traced, varied) and (
        (any(each.through_end for each in sizes) and not turns_steadily(mechanism))
        or _moves_phases(loads, varied, mechanism)
    ):
        return None
    known = numbers_of_loads(loads, mechanism)
    signals = MotionSignals(traced.nominal)
    middles = known.middles(signals) if known.angles else {}
    if middles is None:
        return None
    constants = {**known.constants, **middles}
    return replace(known, constants=constants, rubbing=rubbing)


def _moves_phases(loads: Iterable[Load], varied: Iterable[str], mechanism: Mechanism) -> bool:
    """Whether the laws of drivers vary, which give the times, or the ends of intervals."""
    begins = (*(f"{name}." for name in mechanism.drivers), *(f"loads.{load.name}.phase." for load in loads))
    return any(address.startswith(begins) for address in varied)


def friction_doubt(traced: Traced) -> Scalar:
    """1 where the traced friction is not certain, as a traced value."""
    friction = traced.forces.programs.friction
    return 0.0 if friction is None else select(friction.certain, 0.0, 1.0)


def full_turns(traced: Traced, varied: Iterable[str] = ()) -> int:
    """Of how many turns of the only driver the cycle is, closed and of constant speed, whatever varies; else 0."""
    drivers = list(traced.mechanism.drivers.values())
    speed = drivers[0].law.constant_speed if len(drivers) == 1 else None
    if speed is None or not traced.positions.closed or not traced.positions.rotary[drivers[0].name]:
        return 0
    turns = abs(speed) * (traced.positions.period or 0.0) / TURN
    steady = abs(turns - round(turns)) * TURN <= 1e-9 and f"{drivers[0].name}.speed" not in set(varied)
    return round(turns) if steady else 0
