"""Programs of derivatives, forward and reverse, at one design, and the loads of its machine in them.

Limit positions are numbers with derivatives, the rest is known per position.
A limit position moves with the dimensions by the implicit function theorem; at a fixed position a load that acts goes
on acting.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.magnitude import Magnitude
from linkwright.applied_loads.over_cycle import activity
from linkwright.applied_loads.phases import Always
from linkwright.core.arrays import Floats
from linkwright.core.outputs import kind_of, owners_of
from linkwright.designs.traced_outputs import RUBBING, VALID, Traced, friction_doubt, full_turns, with_limits
from linkwright.errors import LinkwrightError
from linkwright.formula.gradient import forward, reverse
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.summaries import Backend
from linkwright.formula.table import Tables
from linkwright.kinetostatics.friction import MOST, can_be_traced
from linkwright.kinetostatics.load_site import acts_name, middle_name
from linkwright.kinetostatics.named_outputs import Quantity
from linkwright.kinetostatics.run import run_forces
from linkwright.kinetostatics.signals import AlongInput, MotionSignals, numbers_of_loads
from linkwright.words import _


class Slopes:
    """Values and derivatives of quantities over the positions of a mechanism as it is.

    What groups without closed form carry is given as known numbers, from which the program does one more Newton
    step: its derivative is exact. Limit positions between which loads act enter by the chain rule.
    """

    def __init__(
        self,
        traced: Traced,
        quantities: Mapping[str, Quantity],
        by: tuple[str, ...],
        backend: Backend,
        loads: KnownLoads,
    ) -> None:
        self.traced, self.quantities, self.by = traced, quantities, by
        self.backend, self.loads = backend, loads
        self.program = _known_as_fields(traced.program(quantities, {RUBBING: friction_doubt(traced)}))
        self.own = tuple(each for each in by if each in self.program.parameters)
        self.moving = tuple(each for each in loads.slopes if each in self.program.parameters)
        self._rows: dict[str, Floats] = {}

    @cached_property
    def inputs(self) -> dict[str, Floats]:
        """All inputs per position except the drivers'."""
        return {**self.traced.nominal.states, **self.loads.fields}

    @cached_property
    def numbers(self) -> dict[str, float]:
        """All that the program takes of the mechanism."""
        return {**self.traced.solver.nominal.parameters, **self.loads.numbers}

    @property
    def certain(self) -> bool:
        """Whether the friction is, at all positions."""
        return not self.loads.rubbing or not self.values(RUBBING).any()

    def values(self, name: str) -> Floats:
        """The carrier of a quantity, (n,)."""
        return np.asarray(self._forward(name)[0])

    def forward(self, name: str) -> Floats:
        """Derivatives (dimensions, n) of a quantity."""
        found = self._forward(name)
        values, slopes = found[0], found[1:]
        return np.where(np.isnan(slopes) & (values == 0.0), 0.0, slopes * self.quantities[name].slope(values))

    def reverse(self, name: str, weights: Floats) -> Floats:
        """Gradient (dimensions,) of the sum of ``weights`` times the quantity."""
        seeds = weights * self.quantities[name].slope(self.values(name))
        program = self.program.only([name, VALID])
        by = [each for each in (*self.own, *self.moving) if each in program.parameters]
        found = np.zeros(len(self.by))
        if not by:
            return found
        gradient = reverse(program, [name], by, VALID)
        table = np.array([[self.numbers[each] for each in gradient.parameters]])
        known = {each: self.inputs[each] for each in program.fields}
        fields = {each: row[None, :] for each, row in {**known, f"seed:{name}": seeds}.items()}
        slopes = gradient.evaluate(table, self.traced.arrays, fields, tables=self.loads.tables, backend=self.backend)[
            1
        ][0]
        for each, slope in zip(by, slopes, strict=True):
            found += slope * self._by(each)
        return found

    def _by(self, parameter: str) -> Floats:
        """Derivatives (dimensions,) of a parameter of the program."""
        if parameter in self.loads.slopes:
            return self.loads.slopes[parameter]
        return np.array([1.0 if each == parameter else 0.0 for each in self.by])

    def _forward(self, name: str) -> Floats:
        """Carrier (n,) and its derivatives (dimensions, n) below it."""
        if name not in self._rows:
            program = self.program.only([name])
            by = [each for each in (*self.own, *self.moving) if each in program.parameters]
            rows = self._run(forward(program, by))
            slopes = np.zeros((len(self.by), len(rows[name])))
            for each in by:
                if f"{name}|{each}" in rows:
                    slopes += self._by(each)[:, None] * rows[f"{name}|{each}"]
            self._rows[name] = np.vstack([rows[name], slopes])
        return self._rows[name]

    def _run(self, program: Program) -> dict[str, Floats]:
        numbers = np.array([self.numbers[each] for each in program.parameters])
        inputs = {name: self.inputs[name] for name in program.fields}
        return dict(zip(program.output_names, self._evaluated(program, numbers, inputs), strict=True))

    def _evaluated(self, program: Program, numbers: Floats, inputs: Mapping[str, Floats]) -> Floats:
        arrays, count, tables = self.traced.arrays, self.traced.positions.count, self.loads.tables
        if self.backend == "llvm":
            from linkwright.formula.llvm_backend import compile_program

            compiled = compile_program(program)
            if compiled is None:
                raise LinkwrightError(
                    _("llvmlite cannot be loaded: install it, or use the numpy back end", code="study.no_llvmlite")
                )
            rows = {name: row[None, :] for name, row in inputs.items()}
            return np.array(compiled.store(numbers[None, :], arrays, rows, length=count, tables=tables)[0])
        return NumpyProgram(program).run(numbers, arrays, inputs, length=count, tables=tables)


def _known_as_fields(program: Program) -> Program:
    """The program with the angles near which angles stay taken per position."""
    known = middle_name("", "").partition(":")[0]
    return program.with_inputs([name for name in program.parameters if name.startswith(f"{known}:")])


FRICTION_SLOPE = _(
    "friction has a derivative where it is far from self-locking and no group has it in "
    "more than {most} pairs; leave the friction out of the model, or vary the dimension "
    "in a study",
    code="study.friction_slope",
    most=MOST,
)


@dataclass(frozen=True)
class KnownLoads:
    """``names``: loads as ``Traced`` takes them; ``numbers`` by name, ``slopes`` (dimensions,) of those that move,
    ``fields`` (n,) by name, and ``tables``; ``rubbing``: the friction of joints is traced."""

    names: frozenset[str] = frozenset()
    numbers: Mapping[str, float] = field(default_factory=dict)
    slopes: Mapping[str, Floats] = field(default_factory=dict)
    fields: Mapping[str, Floats] = field(default_factory=dict)
    tables: Tables = field(default_factory=dict)
    rubbing: bool = False


def known_loads(plain: Traced, fields: Iterable[str], by: tuple[str, ...]) -> KnownLoads:
    """What the loads behind a program's inputs per position take at the mechanism as it is.

    Raises:
        LinkwrightError: friction in too many pairs of one group; loads that have no value somewhere, or no
            derivative.
    """
    rubbing = any(kind_of(name) == "friction" for name in fields)
    if rubbing and not can_be_traced(plain.forces.friction):
        raise LinkwrightError(FRICTION_SLOPE)
    fields_needed = [
        name for name in (plain.forces.fields_needed() if rubbing else fields) if name not in plain.nominal.states
    ]
    if not fields_needed:
        return KnownLoads()
    run_forces(plain.nominal, False)
    named = owners_of("magnitude", fields_needed)
    loads = [plain.mechanism.loads[name] for name in named]
    for load in loads:
        if not load.magnitude.has_formula:
            raise LinkwrightError(
                _(
                    "loads.{name}: a load of the kind {kind!r} is found from the complete cycle, for which "
                    "no derivative is known; vary the dimension in a study instead",
                    code="study.cycle_load_slope",
                    name=load.name,
                    kind=load.kind,
                )
            )
    signals = MotionSignals(plain.nominal)
    along = numbers_of_loads(loads, plain.mechanism)
    known = {middle_name(a, b): signals.angle_of(a, b, near) for (a, b), near in along.angles.items()}
    moving = _moving(plain, [load.magnitude for load in loads], along, by)
    names = set(along.names)
    if moving is None:
        for load in loads:
            if not isinstance(load.magnitude.phase, Always):
                names = names - {load.name} | {acts_name(load.name)}
                known |= _phase(load, signals)
        moving = {}, {}
    numbers = {**along.constants, **moving[0]}
    return KnownLoads(frozenset(names), numbers, moving[1], known, along.tables, rubbing)


def _moving(
    plain: Traced, sizes: Collection[Magnitude], along: AlongInput, by: tuple[str, ...]
) -> tuple[dict[str, float], dict[str, Floats]] | None:
    """Limit positions and values there, with their derivatives; None where others are not certain to be missing."""
    if all(each.rate is not None or isinstance(each.phase, Always) for each in sizes):
        return {}, {}
    if plain.solver.motion.angles.carried or plain.solver.manner.flipping:
        return None
    over_time = not full_turns(plain)
    if over_time and (plain.nominal.states or not along.outputs or any(each.through_end for each in sizes)):
        return None
    columns = {name: np.array([plain.mechanism.dimension(name)]) for name in by}
    if not along.outputs:
        return {}, {}
    loaded = with_limits(plain, along)
    if loaded is None or loaded.limits is None:
        return None
    numbers, limits = dict(loaded.limits.numbers), loaded.limits.solve(columns)
    if not limits.certain.all():
        return None
    slopes = {}
    for name, value in limits.numbers.items():
        numbers[name] = float(value[0])
        found = limits.pull({name: np.ones(1)})
        slopes[name] = np.array([found[each][0] if each in found else 0.0 for each in by])
    return numbers, slopes


def _phase(load: Load, signals: MotionSignals) -> dict[str, Floats]:
    """Where a load acts, and the share of its phase; raises for a ramp whose ends are limit positions that move."""
    if load.magnitude.size.ramp and load.magnitude.limits is not None:
        raise LinkwrightError(
            _(
                "loads.{name}: a ramp between limit positions has a derivative where these are the "
                "only two in the cycle and no turns of links are counted, under other laws than "
                "constant speed also where all groups have a closed form; change the dimension in "
                "study instead",
                code="study.ramp_slope",
                name=load.name,
            )
        )
    active = activity(load, signals)
    return {acts_name(load.name): active.where.astype(float), f"share:{load.name}": active.share}
