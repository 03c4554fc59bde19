"""One force analysis: magnitudes of the loads, friction by iteration, then all reactions."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial

import numpy as np

from linkwright.applied_loads.over_cycle import evaluate
from linkwright.core.arguments import STEPS, require
from linkwright.core.arrays import Floats, runs
from linkwright.core.outputs import Output, kind_of, row_name
from linkwright.core.quantity import shown
from linkwright.core.search import first_largest
from linkwright.errors import LinkwrightError
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.motion import Motion, Rows
from linkwright.kinematics.reach_messages import input_at
from linkwright.kinematics.solve import MotionRun
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.friction import FrictionTerm
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.kinetostatics.solver import ForceSolver, caused_name
from linkwright.mechanism.mechanism import Mechanism
from linkwright.units import format as spelled
from linkwright.words import Message, _
from linkwright.words.message import together

#: Iterations of the friction, and the change, as share of what the largest reaction causes, at which these end.
FRICTION_STEPS = 400
FRICTION_CHANGE = 1e-12


class FrictionError(LinkwrightError):
    """Friction for which no finite driver effort is found."""


def solve_forces(source: Motion | Mechanism, *, static: bool = False, steps: int = STEPS) -> Forces:
    """Reactions of all joints and the effort of every driver, by Assur group in reverse solving order.

    Args:
        source: a motion, or a mechanism whose cycle is solved first over ``steps``.
        static: leave the inertia forces out.

    Returns:
        The forces; with power and balance residuals.

    Raises:
        LinkwrightError: a load that cannot be evaluated, friction that does not converge or locks.
    """
    if isinstance(source, Motion):
        return run_forces(source, static)
    require(source, Motion, Mechanism)
    return run_forces(MotionRun(MotionSolver(source), over_cycle(source, steps)).solve("raise"), static)


def run_forces(
    motion: Motion,
    static: bool,
    solver: ForceSolver | None = None,
    signals: MotionSignals | None = None,
    asked: tuple[str, ...] = (),
) -> Forces:
    """Solves the forces of a motion; with a ``solver`` of the same motion solver nothing is traced again.

    ``signals``: what its loads follow, where more of its cycle is known than the motion tells; ``asked``: outputs
    that are stored with those that forces store.
    """
    solver = solver or ForceSolver(motion.solver, inertia=not static)
    names = tuple(dict.fromkeys((*solver.programs.checks.names, *asked)))
    fields = _load_fields(motion, solver.fields_needed(), signals or MotionSignals(motion))
    if solver.friction.terms:
        fields = _with_friction(motion, solver, fields)
    values = solver.evaluate(names, motion, fields)
    if not motion.ok.all():
        values[:, ~motion.ok] = np.nan
    rows = Rows(values, {name: i for i, name in enumerate(names)})
    solver.programs.checks.require(rows, motion)
    forces = Forces(motion, solver, fields, static, rows)
    forces.notes = (*_indeterminate(motion), *contacts_lost(forces))
    return forces


_LOST = {
    "": _(
        "the pair {name} ({kind}) can only push, but would have to pull {places}, with up to "
        "{most} at {where}; press its links together with a spring or a load",
        code="forces.contact_lost",
    ),
    "cam": _(
        "the cam {name} cannot hold its follower {places}: it would have to pull, with up to "
        "{most} at {where}; press it on with a spring or a load, or run it in a groove",
        code="forces.contact_lost_cam",
    ),
    "belt": _(
        "the belt {name} is too loose {places}: it transmits more than twice its pretension, "
        "so that its slack strand would have to push; raise the pretension, or leave it out: "
        "then the slack strand carries nothing",
        code="forces.contact_lost_belt",
    ),
}


def contacts_lost(forces: Forces) -> Iterable[Message]:
    """Where pairs that can only push would have to pull, and belts to push."""
    motion = forces.motion
    drivers = motion.mechanism.drivers.values()
    unit = ("angle", "deg") if all(driver.law.rotary for driver in drivers) else ("length", "mm")
    for name, joint in motion.mechanism.joints.items():
        pulls = joint.pulls(partial(forces.rows.row, row_name("multiplier", name), forces.evaluate))
        if pulls is None or not pulls.any():
            continue
        ends = [(float(motion.input[first]), float(motion.input[last])) for first, last in runs(pulls)]
        places = tuple(
            _("from {first} to {last} of the input", first=spelled(first, *unit), last=spelled(last, *unit))
            for first, last in ends
        )
        sizes = np.linalg.norm(forces.reaction(name, on=joint.joined[-1]), axis=1)[pulls]
        most, where = float(sizes.max()), float(motion.input[pulls][first_largest(sizes)])
        yield _LOST.get(joint.kind, _LOST[""]).format(
            name=name,
            kind=joint.word(),
            places=together(places),
            most=shown(most, "force", 4),
            where=spelled(where, *unit),
        )


def _indeterminate(motion: Motion) -> tuple[str, ...]:
    """Says which couples and forces statics cannot tell, because others prevent the same rotation."""
    guides = [c.joint for group in motion.structure.groups for c in group.cuts if c.slides]
    messages = [
        _(
            "the couple of guide {name!r} is statically indeterminate, as other guides prevent "
            "the same rotation: it is taken as zero, and the couples of those guides carry all",
            code="forces.indeterminate",
            name=name,
        )
        for name in guides
    ]
    if passive := motion.structure.passive:
        messages.append(
            _(
                "how the passive pairs {names} and the pairs parallel to them share the load is "
                "statically indeterminate: the passive ones are taken as unloaded",
                code="forces.passive",
                names=passive,
            )
        )
    return tuple(messages)


def _load_fields(motion: Motion, names: Iterable[str], signals: MotionSignals) -> dict[str, Floats]:
    """Load magnitudes that depend on the position; friction starts from zero."""
    fields: dict[str, Floats] = {}
    for name in names:
        if kind_of(name) == "magnitude":
            fields[name] = evaluate(motion.mechanism.loads[Output.of_row(name).owner], signals)
        elif kind_of(name) == "friction":
            fields[name] = np.zeros(motion.steps)
    return fields


def _with_friction(motion: Motion, solver: ForceSolver, fields: dict[str, Floats]) -> dict[str, Floats]:
    """Friction that agrees with the reactions it causes, by fixed-point iteration; exact to the largest reaction."""
    terms, ok = solver.friction.terms, motion.ok
    names = [term.field for term in terms]
    reactions = [name for name in solver.outputs.standard if kind_of(name) == "reaction"]
    wanted = (*(caused_name(name) for name in names), *reactions)
    most = max(term.arm for term in terms)
    previous, growing = np.inf, 0
    for _unused in range(FRICTION_STEPS):
        values = solver.evaluate(wanted, motion, fields)
        values[:, ~ok] = np.nan
        sizes = values[: len(names)]
        gap = np.abs(sizes - [fields[name] for name in names])[:, ok]
        change = float(np.max(gap, initial=0.0))
        fields = {**fields, **dict(zip(names, sizes, strict=True))}
        if change <= FRICTION_CHANGE * most * float(np.max(np.abs(values[len(names) :, ok]), initial=0.0)):
            return fields
        growing = growing + 1 if change > previous else 0
        if growing > 25 or not np.isfinite(change):
            break
        previous = change
    raise FrictionError(_locked(motion, terms, fields))


def _locked(motion: Motion, terms: tuple[FrictionTerm, ...], fields: dict[str, Floats]) -> str:
    worst = max(terms, key=lambda t: float(np.nanmax(np.abs(fields[t.field]), initial=0.0)))
    place = int(np.nanargmax(np.abs(fields[worst.field])))
    where = input_at(motion, place)
    return _(
        "{name!r} is self-locking by friction near {where}: the friction in joint {joint!r} "
        "grows without bound in the iteration, so no driver effort moves it; reduce the "
        "friction coefficient or the pin radius, or improve the transmission angle there",
        code="forces.self_locking",
        name=motion.mechanism.name,
        where=where,
        joint=worst.joint,
    )
