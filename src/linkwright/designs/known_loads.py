"""What the loads of one machine take while they are differentiated.

Limit positions are numbers with derivatives, the rest is known per position.
A limit position moves with the dimensions by the implicit function theorem; at a fixed position a load that acts goes
on acting.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.magnitude import Magnitude
from linkwright.applied_loads.over_cycle import activity
from linkwright.applied_loads.phases import Always
from linkwright.core.arrays import Floats
from linkwright.core.outputs import kind_of, owners_of
from linkwright.designs.loaded_cycle import full_turns, with_limits
from linkwright.designs.traced_outputs import Traced
from linkwright.errors import LinkwrightError
from linkwright.formula.table import Tables
from linkwright.kinetostatics.friction_stage import MOST, can_be_traced
from linkwright.kinetostatics.load_site import acts_name, middle_name
from linkwright.kinetostatics.run import run_forces
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.kinetostatics.traced_loads import AlongInput, numbers_of_loads
from linkwright.words import _

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
