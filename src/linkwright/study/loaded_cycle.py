"""The cycle program of a mechanism whose loads follow the input: limit positions first, then forces and summaries."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linkwright.drivers.constant_speed import ConstantSpeed
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.reductions import VALID_COUNT, Reduction, Results
from linkwright.engine.stage import Backend, Stage
from linkwright.errors import LinkwrightError
from linkwright.loads.along_input import follows_input
from linkwright.loads.phases import TURN
from linkwright.model.signal_fields import Output, SwingPhase
from linkwright.study.limit_stages import constants, limit_stages
from linkwright.study.traced import VALID, Traced

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class LoadedCycle:
    """The cycle program, and the outputs whose limit positions it finds."""

    traced: Traced
    cycle: CycleProgram
    outputs: tuple[Output, ...]

    def evaluate(
        self, part: Mapping[str, Floats], threads: int | None, backend: Backend
    ) -> tuple[Results, NDArray[np.intp]]:
        """Results of designs with the given columns, and the numbers of those whose limits are not certain."""
        results = self.cycle.evaluate(
            self.table(part), self.traced.positions.arrays, threads=threads, backend=backend
        )
        doubt = sum((np.asarray(results[f"doubt:{each}"]) for each in self.outputs), np.zeros(1))
        doubt = np.broadcast_to(doubt, (len(next(iter(part.values()))),))
        return results, np.flatnonzero(~(doubt == 0.0))

    def table(self, part: Mapping[str, Floats]) -> Floats:
        """What the cycle program takes of the designs with the given columns, (designs, dimensions)."""
        known = {**self.traced.solver.nominal.parameters, **constants(self.traced)}
        designs = len(next(iter(part.values())))
        columns = [part.get(name, known.get(name, 0.0)) for name in self.cycle.dimensions]
        return np.stack([np.broadcast_to(each, designs) for each in columns], axis=1)


@dataclass(frozen=True)
class AlongInput:
    """Loads whose magnitudes are traced over the input, and the outputs whose limit positions they need."""

    names: frozenset[str]
    outputs: tuple[Output, ...]


def along_input(traced: Traced, varied: Iterable[str], fields: Iterable[str]) -> AlongInput | None:
    """The loads behind a program's inputs per position; None where some input is no load that follows the input, or
    the cycle is no single turn of one driver of constant speed."""
    mechanism, given = traced.mechanism, tuple(fields)
    names = frozenset(name.removeprefix("load:") for name in given)
    if not given:
        return AlongInput(names, ())
    if not one_turn(traced, varied) or any(not name.startswith("load:") for name in given):
        return None
    loads = [mechanism.loads[name] for name in names]
    addresses = tuple(f"loads.{each.name}." for each in loads)
    if any(address.startswith(addresses) for address in mechanism.expressions):
        return None
    if not all(follows_input(load, frozenset(mechanism.parameters)) for load in loads):
        return None
    phases = [phase for each in loads if isinstance(phase := getattr(each, "phase", None), SwingPhase)]
    return AlongInput(names, tuple(dict.fromkeys(phase.output for phase in phases)))


def loaded_cycle(
    traced: Traced, varied: Iterable[str], names: Iterable[str], reductions: Iterable[Reduction]
) -> LoadedCycle | None:
    """The cycle program of all designs; None where the loads do not follow the input."""
    known = along_input(traced, varied, traced.program(traced.quantities(names)).fields)
    if known is None:
        return None
    over_input = Traced(traced.mechanism, varied, traced.positions, along_input=known.names)
    try:
        stages = limit_stages(over_input, known.outputs)
    except LinkwrightError:
        return None
    program = over_input.program(over_input.quantities(names))
    stages.append(Stage(program, {each.name: each for each in reductions}, valid=VALID, count=VALID_COUNT))
    return LoadedCycle(over_input, CycleProgram(tuple(stages)), known.outputs)


def one_turn(traced: Traced, varied: Iterable[str]) -> bool:
    """Whether the cycle is one closed turn of the only driver, of constant speed, whatever varies."""
    drivers = list(traced.mechanism.drivers.values())
    if len(drivers) != 1 or not isinstance(drivers[0].law, ConstantSpeed):
        return False
    span = abs(drivers[0].law.speed) * (traced.positions.period or 0.0)
    turns = traced.positions.closed and traced.positions.rotary[drivers[0].name]
    return turns and abs(span - TURN) <= 1e-9 and f"{drivers[0].name}.speed" not in set(varied)
