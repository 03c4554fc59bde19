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


def loaded_cycle(
    traced: Traced, columns: Mapping[str, Floats], names: Iterable[str], reductions: Iterable[Reduction]
) -> LoadedCycle | None:
    """The cycle program of all designs; None where some load does not follow the input, or the cycle is no single
    turn of one driver of constant speed.

    Raises LinkwrightError where the loads of the mechanism as it is cannot be found.
    """
    mechanism = traced.mechanism
    fields = traced.program(traced.quantities(names)).fields
    wanted = frozenset(name.removeprefix("load:") for name in fields)
    if not _one_turn(traced, columns) or any(not name.startswith("load:") for name in fields):
        return None
    loads = [mechanism.loads[name] for name in wanted]
    parameters = frozenset(mechanism.parameters)
    given = [a for a in mechanism.expressions if a.startswith(tuple(f"loads.{each.name}." for each in loads))]
    if given or not all(follows_input(load, parameters) for load in loads):
        return None
    phases = [phase for each in loads if isinstance(phase := getattr(each, "phase", None), SwingPhase)]
    outputs = tuple(dict.fromkeys(phase.output for phase in phases))
    over_input = Traced(mechanism, columns, traced.positions, along_input=wanted)
    try:
        stages = limit_stages(over_input, outputs)
    except LinkwrightError:
        return None
    program = over_input.program(over_input.quantities(names))
    stages.append(Stage(program, {each.name: each for each in reductions}, valid=VALID, count=VALID_COUNT))
    return LoadedCycle(over_input, CycleProgram(tuple(stages)), outputs)


def _one_turn(traced: Traced, columns: Mapping[str, Floats]) -> bool:
    """Whether the cycle is one closed turn of the only driver, of constant speed, whatever varies."""
    drivers = list(traced.mechanism.drivers.values())
    if len(drivers) != 1 or not isinstance(drivers[0].law, ConstantSpeed):
        return False
    span = abs(drivers[0].law.speed) * (traced.positions.period or 0.0)
    turns = traced.positions.closed and traced.positions.rotary[drivers[0].name]
    return turns and abs(span - TURN) <= 1e-9 and f"{drivers[0].name}.speed" not in columns
