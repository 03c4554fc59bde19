"""Chosen outputs of a mechanism in one program for many designs, with loads and friction traced over the cycle."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import inf

import numpy as np

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.strokes import TURN
from linkwright.core.arrays import Flags, Floats
from linkwright.core.inputs import mode_inputs
from linkwright.core.outputs import kind_of, owners_of, row_name
from linkwright.cycle.load_limits import FoundLimits, LoadLimits
from linkwright.cycle.machine import CLEAR, Machine, NotTogether, line_near
from linkwright.errors import LinkwrightError, RequestError
from linkwright.formula.program import Program
from linkwright.formula.reductions import VALID_COUNT, Results
from linkwright.formula.trace import Mask, Scalar, absolute, select
from linkwright.kinematics.assembly import modal_groups
from linkwright.kinematics.change_points import nearness
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.programs import Manner, motion_programs
from linkwright.kinematics.solve import solve_motion
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.friction import can_be_traced
from linkwright.kinetostatics.load_site import turns_steadily
from linkwright.kinetostatics.named_outputs import Named, Quantity
from linkwright.kinetostatics.signals import TURNING, AlongInput, MotionSignals, numbers_of_loads, traced_magnitude
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: The truth output that says which positions of a design are solved.
VALID = "valid"
#: The output that tells how near the dyads are to a change point.
NEAREST = "nearest change point"


class TurnsThrough(RequestError):
    """An angle is wanted of a link that turns by more than programs can tell from each other."""


class Traced:
    """Programs of one mechanism for outputs in the user's words.

    ``free``: dimensions that will vary; ``iterations``: Newton steps of groups without closed form;
    ``turning``: angles of links that turn through may be asked; ``flipping``: the programs take the signs of assembly
    modes per position.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        free: Iterable[str],
        positions: Positions,
        *,
        iterations: int = 1,
        turning: bool = False,
        flipping: bool = False,
    ) -> None:
        self.mechanism = mechanism
        self.positions = positions
        self.turning = turning
        manner = Manner(frozenset(free), iterations=iterations)
        if flipping:
            groups = modal_groups(motion_programs(mechanism, manner).structure)
            manner = replace(manner, flipping=frozenset(groups))
        self.solver = MotionSolver(mechanism, manner)
        self._under_loads(frozenset(), rubbing=False)

    def _under_loads(self, names: frozenset[str], *, rubbing: bool) -> None:
        self.forces = ForceSolver(self.solver, along_input=names, rubbing=rubbing)
        self.named = Named(self.forces, self._middle, self._line)

    def with_loads(self, names: frozenset[str], *, rubbing: bool) -> Traced:
        """The same with the magnitudes of some loads traced over the input, and with the friction."""
        if not names and not rubbing:
            return self
        found = copy(self)
        found._under_loads(names, rubbing=rubbing)
        return found

    @cached_property
    def nominal(self) -> Motion:
        """The motion of the mechanism as it is."""
        return solve_motion(self.mechanism, steps=self.positions.steps, failures="mark")

    @cached_property
    def arrays(self) -> dict[str, Floats]:
        """Inputs per position; with ``flipping`` the signs of the assembly modes of the mechanism as it is."""
        found = dict(self.positions.arrays)
        if self.solver.manner.flipping:
            signs, count = mode_inputs(self.solver.assembly.modes), self.positions.count
            found |= {name: np.full(count, sign) for name, sign in signs.items()}
            found |= self.nominal.modes
        return found

    def quantities(self, names: Iterable[str]) -> dict[str, Quantity]:
        """The outputs by their names."""
        return {name: self.named.quantity(name) for name in dict.fromkeys(names)}

    def program(self, quantities: Mapping[str, Quantity], more: Mapping[str, Scalar | bool] | None = None) -> Program:
        """What the quantities need, ``more`` outputs, the truth output ``valid``, and how near change points are."""
        motion = self.solver.motion
        outputs: dict[str, Scalar | bool] = {name: each.carrier for name, each in quantities.items()}
        outputs[NEAREST] = self.nearest
        outputs[VALID] = motion.valid
        return Program.of(motion.trace, {**outputs, **(more or {})})

    @cached_property
    def nearest(self) -> Scalar:
        """How near the dyads are to a change point or a gap, as a traced value."""
        return nearness(self.solver)

    def table(
        self, program: Program, columns: Mapping[str, Floats], known: Mapping[str, float] | None = None
    ) -> Floats:
        """The parameters of the designs with the given columns, (designs, parameters); ``known``: of those that are
        no dimensions."""
        numbers = {**self.solver.nominal.parameters, **(known or {})}
        return design_table(program.parameters, numbers, columns)

    @property
    def counted_for_certain(self) -> Mask:
        """Where a position is reached, and no such rotation is far from its line."""
        motion = self.solver.motion
        found: Mask = motion.valid
        for name, rotation in motion.angles.carried.items():
            near = absolute(rotation - motion.trace.field_input(name)) < CLEAR
            found = motion.trace.logic("and", found, near)
        return found

    def failure_flags(self) -> dict[str, Scalar]:
        """Per group 1 where it is the first that fails, by the rows of ``unreachable`` and ``singular``."""
        motion = self.solver.motion
        flags: dict[str, Scalar] = {}
        before: Mask = True
        logic = motion.trace.logic
        for name, placed in motion.placed.items():
            if placed.valid is True:
                continue
            bad = logic("and", before, _not(placed.valid))
            flags[row_name("unreachable", name)] = select(logic("and", bad, _not(placed.reached)), 1.0, 0.0)
            flags[row_name("singular", name)] = select(logic("and", bad, placed.reached), 1.0, 0.0)
            before = logic("and", before, placed.valid)
        return flags

    def _line(self, link: str) -> tuple[float, float]:
        """The line near which the angle of a link runs: rad where the input is zero, and turns in a turn of it."""
        rotation, rotary = self.nominal.link(link).angle, next(iter(self.positions.rotary.values()), False)
        good = np.isfinite(rotation)
        if not good.any():
            return 0.0, 0.0
        q = self.nominal.input[good] if rotary else np.zeros(int(good.sum()))
        line = line_near(rotation[good], q)
        if line is None:
            raise TurnsThrough(
                _(
                    "{link!r} turns unevenly with the input, so its turns cannot be counted; use another "
                    "output in the formula",
                    code="study.turns_unevenly",
                    link=link,
                )
            )
        return line

    def _middle(self, link: str) -> float:
        """The direction that is farthest from where the link never points: the middle of its swing."""
        angle = self.nominal.link(link).angle
        angle = angle[np.isfinite(angle)]
        if not len(angle):
            return 0.0
        low, high = float(angle.min()), float(angle.max())
        if high - low <= TURNING:
            return 0.5 * (low + high)
        if not self.turning:
            raise TurnsThrough(
                _(
                    "{link!r} turns through, so its angle has no smallest and largest value; ask for "
                    "{link}.angular_velocity instead",
                    code="study.turns_through",
                    link=link,
                )
            )
        around = np.sort(angle % (2 * np.pi))
        gaps = np.diff(np.append(around, around[0] + 2 * np.pi))
        widest = int(np.argmax(gaps))
        return float(around[widest] + 0.5 * gaps[widest] - np.pi)


def design_table(names: Sequence[str], known: Mapping[str, float], columns: Mapping[str, Floats]) -> Floats:
    """What a program takes of some designs, (designs, names): the columns (designs,), else what is known of all."""
    count = len(next(iter(columns.values())))
    table = np.empty((count, len(names)))
    for place, name in enumerate(names):
        table[:, place] = columns[name] if name in columns else known[name]
    return table


def _not(mask: Mask) -> Mask:
    return (not mask) if isinstance(mask, bool) else ~mask


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
