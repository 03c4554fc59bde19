"""Text of an equilibrium analysis: table of the positions at rest, remarks, and the sums of each one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.quantity import shown
from linkwright.core.table import Amount, Cell, Table
from linkwright.dynamics.static_forces import WEIGHT
from linkwright.words import Message, _

if TYPE_CHECKING:
    from linkwright.dynamics.displacement import Displacement
    from linkwright.dynamics.equilibria import Equilibria, Equilibrium

STABILITY = {
    "stable": _("stable"),
    "unstable": _("unstable"),
    "neutral": _("neutral"),
    "one_sided": _("unstable to one side"),
    "held": _("held by resistance"),
    "stopped": _("rests at stop {stop}"),
}
#: Work of a turn, as share of the effort's size over a turn, that is rounding.
NO_WORK = 1e-9


def tables(found: Equilibria, language: str = "en", *, worked: bool = False) -> Sequence[Table]:
    """The positions, the remarks, and where ``worked`` the sums of every position."""
    title = Table(title=found.mechanism.name, notes=[_searched(found)])
    notes = Table(notes=found.remarks)
    if not found.positions:
        return title, notes
    sums = [_sums(found, each, number) for number, each in enumerate(found, 1)] if worked else []
    moved = [_moved(found)] if found.moved else []
    return (title, _positions(found), *sums, *moved, notes)


def _searched(found: Equilibria) -> Message:
    ((name, (low, high)), *more) = found.ranges.items()
    if more:
        return _("positions at rest of {inputs}", inputs=tuple(found.ranges))
    kind = found.dimension_of(name)
    if found.closed:
        return _("positions at rest over a full turn of {input}", input=name)
    return _(
        "positions at rest from {low} to {high} of {input}", low=shown(low, kind), high=shown(high, kind), input=name
    )


def _positions(found: Equilibria) -> Table:
    names = found.forces.equation.names
    vibrates = any(np.isfinite(each.frequencies).any() for each in found)
    damped = any((np.nan_to_num(each.damping_ratios) > 0.0).any() for each in found)
    barred = any(barrier is not None for each in found for barrier in each.barriers)
    head: list[str] = ["", *names, _("equilibrium")]
    beyond = any(each.beyond for each in found)
    head += [_("assembly")] * beyond
    head += [_("natural frequency")] * vibrates + [_("damping ratio")] * damped
    head += [_("energy barrier downwards"), _("energy barrier upwards")] * barred
    rows: list[list[Cell]] = []
    for number, each in enumerate(found, 1):
        row: list[Cell] = [number, *(_place(found, each, name) for name in names), _state(each)]
        row += [_("beyond a dead point") if each.beyond else _("as drawn")] * beyond
        row += [_several(each.frequencies, "frequency")] * vibrates
        row += [_several(each.damping_ratios, "")] * damped
        row += [None if barrier is None else Amount(barrier, "energy") for barrier in each.barriers] * barred
        rows.append(row)
    return Table(head, rows, ">" + ">" * len(names) + "<" + "<" * beyond + ">" * 4)


def _state(each: Equilibrium) -> Message:
    return STABILITY[each.stability].format(stop=each.stop) if each.stop else STABILITY[each.stability]


def _place(found: Equilibria, each: Equilibrium, name: str) -> Cell:
    kind = found.dimension_of(name)
    if each.low is not None and name == found.forces.free[0]:
        return Amount(each.low, kind, end=each.high)
    return Amount(each.inputs[name], kind, 7)


def _several(values: np.ndarray[tuple[int], np.dtype[np.float64]], dimension: str) -> Cell:
    known = values[np.isfinite(values)]
    if not len(known):
        return None
    return ", ".join(shown(float(each), dimension, 7 if dimension else 4) for each in known)


def _sums(found: Equilibria, each: Equilibrium, number: int) -> Table:
    """What every load contributes along the free inputs, which adds up to zero, and what follows."""
    names = found.forces.free
    kinds = ["torque" if found.dimension_of(name) == "angle" else "force" for name in names]
    head: list[str] = [_("position {number}", number=number), *names]
    rows: list[list[Cell]] = []
    for load, shares in each.shares.items():
        label = _("weight of {link}", link=load.removeprefix(WEIGHT)) if load.startswith(WEIGHT) else load
        rows.append([label, *(Amount(float(s), kind) for s, kind in zip(shares, kinds, strict=True))])
    total = np.sum([*each.shares.values()], axis=0) if each.shares else np.zeros(len(names))
    size = max((float(np.abs(shares).max()) for shares in each.shares.values()), default=0.0)
    total = np.where(np.abs(total) <= NO_WORK * size, 0.0, total)
    if total.any():
        holds = _("stop {stop}", stop=each.stop) if each.stop else _("resistance")
        rows.append([holds, *(Amount(-float(s), kind) for s, kind in zip(total, kinds, strict=True))])
        total = 0.0 * total
    rows.append([_("sum"), *(Amount(float(s), kind) for s, kind in zip(total, kinds, strict=True))])
    return Table(head, rows, notes=_worked(found, each))


def _worked(found: Equilibria, each: Equilibrium) -> list[Message]:
    if len(found.forces.free) > 1:
        rows = [tuple(f"{value:.6g}" for value in row) for row in each.stiffness]
        notes = [_("K = dS/dq: {rows}", rows=tuple(f"[{', '.join(row)}]" for row in rows))]
        rows = [tuple(f"{value:.6g}" for value in row) for row in each.inertia]
        notes.append(_("M: {rows}", rows=tuple(f"[{', '.join(row)}]" for row in rows)))
        if each.vibrations is not None:
            shapes = each.vibrations.shapes.T
            for frequency, shape in zip(each.frequencies, shapes, strict=True):
                if np.isfinite(frequency):
                    notes.append(
                        _(
                            "det(K − ω²M) = 0: f = {frequency}, mode {shape}",
                            frequency=shown(float(frequency), "frequency", 7),
                            shape=tuple(f"{value:.5g}" for value in shape),
                        )
                    )
        return notes
    turns = found.dimension_of(found.forces.free[0]) == "angle"
    stiffness, inertia, damping = (float(m[0, 0]) for m in (each.stiffness, each.inertia, each.damping))
    units = ("N·m/rad", "kg·m²", "N·m·s/rad") if turns else ("N/m", "kg", "N·s/m")
    if each.stop:
        angle = found.mechanism.stops[each.stop].of.dimension == "angle"
        contact = shown(each.contact, "torque" if angle else "force")
        return [_("the stop {stop} pushes back with {contact}", stop=each.stop, contact=contact)]
    value, verdict = f"{stiffness:.7g}", _state(each)
    notes = [_("stiffness K = dS/dq = {value} {unit}: {verdict}", value=value, unit=units[0], verdict=verdict)]
    frequency = each.frequencies[0] if len(each.frequencies) else float("nan")
    if np.isfinite(frequency):
        notes.append(
            _(
                "M = {inertia} {unit}, ω = √(K/M) = {omega} rad/s, f = ω/(2π) = {frequency}",
                inertia=f"{inertia:.7g}",
                unit=units[1],
                omega=f"{2.0 * np.pi * frequency:.7g}",
                frequency=shown(float(frequency), "frequency", 7),
            )
        )
    if np.isfinite(frequency) and damping:
        notes.append(
            _(
                "C = {damping} {unit}, ζ = C/(2√(K·M)) = {ratio}",
                damping=f"{damping:.7g}",
                unit=units[2],
                ratio=f"{float(each.damping_ratios[0]):.5g}",
            )
        )
    return notes


def _moved(found: Equilibria) -> Table:
    """How far forces on points move the stable positions."""
    head = (_("position"), _("point"), _("force"), "Δx", "Δy", _("Δx linear"), _("Δy linear"), *found.forces.free)
    kinds = [found.dimension_of(name) for name in found.forces.free]
    rows: list[list[Cell]] = []
    for number, each in found.moved:
        lengths = [Amount(float(value), "length") for value in (*each.exact, *each.linear)]
        places = [Amount(float(value), kind, 7) for value, kind in zip(each.inputs, kinds, strict=True)]
        force = ", ".join(shown(float(value), "force") for value in each.force)
        rows.append([number + 1, each.point, force, *lengths, *places])
    notes = [_gives_way(each) for _number, each in found.moved if each.carried < 1.0]
    return Table(head, rows, "><<" + ">" * 12, notes=notes)


def _gives_way(each: Displacement) -> Message:
    return _(
        "Under the force on {point} the machine gives way at {share} of it and snaps over; the displacement is that "
        "of just before.",
        point=each.point,
        share=f"{100.0 * each.carried:.4g} %",
    )


def remarks(found: Equilibria) -> list[Message]:
    """Sentences about the result."""
    notes: list[Message] = []
    if not found.forces.loads:
        notes.append(
            _(
                "Nothing acts on {name!r}, so it rests in every position: give it gravity with masses, or loads.",
                name=found.mechanism.name,
            )
        )
    elif found.neutral:
        notes.append(
            _(
                "{name!r} is at rest in every position of its range: what acts on it is balanced everywhere (neutral "
                "equilibrium)",
                name=found.mechanism.name,
            )
        )
    elif not found.positions:
        notes.append(_nowhere(found))
    if any(each.stability == "held" for each in found):
        notes.append(
            _(
                "What only resists motion (friction, a brake, the load of a working stroke) holds the machine at "
                "rest everywhere in the intervals given."
            )
        )
    elif found.forces.equation.rubs and found.starts:
        notes.append(
            _(
                "Friction holds the machine at rest in a region about these positions too, which is not found with "
                "several free inputs; the positions are those without friction."
            )
        )
    if any(each.jump for each in found):
        notes.append(_("A load begins or ends to act at a position of the table; there the force jumps."))
    if found.starts:
        notes.append(
            _(
                "Found by Newton's method from {starts} starts; with several free inputs other positions at rest may "
                "exist.",
                starts=found.starts,
            )
        )
    notes += _of_turn(found)
    if found.positions and not any(len(each.frequencies) for each in found):
        notes.append(_("The moving links have no inertia, so nothing vibrates; give masses for natural frequencies."))
    return notes


def _nowhere(found: Equilibria) -> Message:
    name = found.mechanism.name
    if found.holding is None or found.least is None:
        return _("{name!r} is nowhere at rest in its ranges", name=name)
    ((input_, _range),) = found.ranges.items()
    kind = found.dimension_of(input_)
    effort = "torque" if kind == "angle" else "force"
    sides = {
        True: _(
            "{name!r} is nowhere at rest by itself: what acts on it moves {input} towards smaller coordinates "
            "everywhere. Holding it takes from {least} (at {least_at}) to {most} (at {most_at})."
        ),
        False: _(
            "{name!r} is nowhere at rest by itself: what acts on it moves {input} towards larger coordinates "
            "everywhere. Holding it takes from {least} (at {least_at}) to {most} (at {most_at})."
        ),
    }
    return sides[found.holding.effort > 0.0].format(
        name=name,
        input=input_,
        least=shown(abs(found.least.effort), effort),
        least_at=shown(found.least.at, kind),
        most=shown(abs(found.holding.effort), effort),
        most_at=shown(found.holding.at, kind),
    )


def _of_turn(found: Equilibria) -> list[Message]:
    work = found.work_of_turn
    if work is None or found.holding is None or abs(work) <= NO_WORK * abs(found.holding.effort):
        return []
    return [
        _(
            "Over a full turn what acts does {work} of work: it is no potential, so a machine set going may go on.",
            work=shown(-work, "energy"),
        )
    ]
