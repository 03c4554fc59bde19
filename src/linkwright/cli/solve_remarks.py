"""The data of ``solve``, and what stands beneath its table: largest values, checks, notes, failed positions."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from linkwright.analysis.analysis import Kind
from linkwright.cli.options import Options
from linkwright.cli.solving import Solved, named_columns
from linkwright.core.arrays import Floats, largest
from linkwright.core.search import first_largest
from linkwright.core.table import Column, Table
from linkwright.errors import LinkwrightError
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.mechanism.force_names import reaction_pairs, rubbing_guides
from linkwright.words import Translate, _, language_of, pgettext

Wanted = tuple[Callable[[Forces], Floats], Kind]


@dataclass(frozen=True)
class Place:
    """A number of a result where it is largest or smallest: ``value``, the input there as text, the forces there and
    the number of their position."""

    value: float
    input: str
    forces: Forces
    row: int


def extremes(solved: Solved, say: Translate, *, degrees: bool) -> list[str]:
    """The largest force in every joint and the range of every driver's effort.

    Over the whole cycle these are found between the positions, as the design numbers are; of chosen positions, or of
    a cycle that is not passed, they are those of the positions, and the title says so.
    """
    forces = solved.forces
    if forces is None or not solved.motion.ok.any():
        return []
    several = solved.motion.steps > 1
    title = (
        _("Largest joint forces over the cycle (between the positions, too)")
        if solved.between
        else _("Largest joint forces, over {count} positions", count=int(solved.motion.ok.sum()))
        if several
        else pgettext("solve", "Joint forces")
    )
    pairs = reaction_pairs(forces.mechanism)
    peaks = largest_reactions(solved, degrees=degrees)
    heads = (_("joint"), pgettext("solve", "on"), _("force N"), "Fx N", "Fy N", pgettext("solve", "at input"))
    rows: list[tuple[str, ...]] = [heads]
    for (joint, link), peak in zip(pairs, peaks, strict=True):
        force = peak.forces.reaction(joint, on=link)[peak.row]
        number = Column("", "", "N", np.array([peak.value]), solved.force_scale).text
        rows.append((joint, link, number(peak.value), number(force[0]), number(force[1]), peak.input))
    wide = 6 if several else 5
    rubbing = ", ".join(rubbing_guides(forces.mechanism))
    guides = _(
        "The force in a guide is what presses its parts together; its friction, μ times "
        "that, along the guide, comes on top: {names}",
        names=rubbing,
    )
    notes = [*([guides] if rubbing else []), *_efforts(solved, forces, say, degrees=degrees)]
    return Table((), [row[:wide] for row in rows], "<<>>>>", title, notes).lines(language_of(say))


def largest_reactions(solved: Solved, *, degrees: bool = True) -> list[Place]:
    """The largest force of every joint on a link, in the order of ``reaction_pairs``."""
    pairs = reaction_pairs(solved.motion.mechanism)
    return _places(solved, [(partial(_size, joint=joint, on=link), "max") for joint, link in pairs], degrees)


def _size(forces: Forces, joint: str, on: str) -> Floats:
    """Size of a joint's force on a link, (n,) N."""
    return np.asarray(np.hypot(*forces.reaction(joint, on=on).T))


def _places(solved: Solved, wanted: Sequence[Wanted], degrees: bool) -> list[Place]:
    """Extremes of what the forces give: refined between the positions of a whole cycle, else those of positions."""
    forces = solved.forces
    assert forces is not None
    if not solved.between:
        rows = [first_largest(signal(forces) if kind == "max" else -signal(forces)) for signal, kind in wanted]
        values = [float(signal(forces)[row]) for (signal, _unused), row in zip(wanted, rows, strict=True)]
    else:
        found = [(signal, solved.analysis.extreme(signal, kind, of="forces")) for signal, kind in wanted]
        known = [(signal, each.time, each.value) for signal, each in found if each is not None]
        forces, rows = solved.analysis.resolver.forces_at(known)
        values = [value for _unused, _unused2, value in known]
    return [
        Place(value, input_text(forces.motion, row, degrees=degrees), forces, row)
        for value, row in zip(values, rows, strict=True)
    ]


def checks(solved: Solved, say: Translate) -> list[str]:
    """The residuals that belong to the forces."""
    forces = solved.forces
    if forces is None or not solved.motion.ok.any():
        return []
    power = largest(forces.power_residual)
    lines = []
    if forces.mechanism.drivers:
        lines.append(
            say(
                _(
                    "Check: driver power from joint forces and from all powers differ by {residual} W at "
                    "most (of {size} W)",
                    residual=f"{power:.1e}",
                    size=f"{largest(forces.power):.3g}",
                )
            )
        )
    size = solved.force_scale
    lines.append(
        say(
            _(
                "Check: forces on every link balance within {residual} N (of {size} N)",
                residual=f"{largest(forces.balance_residual):.1e}",
                size=f"{size:.3g}",
            )
        )
    )
    return lines


def closeness(motion: Motion, language: str) -> list[str]:
    """Warnings about groups whose cycle passes close to a singular position, each with the place.

    Of chosen inputs or times the whole cycle is looked at where there is one.
    """
    if not motion.inputs or not motion.ok.any():
        return []
    from linkwright.analysis.singularity import Singularity

    cycle = motion
    if not motion.positions.closed:
        with contextlib.suppress(LinkwrightError):
            cycle = solve_motion(motion.mechanism, failures="mark")
    values = Singularity().evaluate(cycle)
    return [f"! {remark.text(language)}" for value in values for remark in value.warnings]


def failures(solved: Solved, say: Translate, language: str, *, degrees: bool) -> list[str]:
    """Stretches of positions that are not reached, each with the sentence of its first position."""
    ok = solved.motion.ok
    failed = np.flatnonzero(~ok)
    if not len(failed):
        return []
    lines = [say(_("Not reached: {count} of {of} positions", count=len(failed), of=len(ok)))]
    outcomes = solved.motion.outcomes
    for run in np.split(failed, np.flatnonzero(np.diff(failed) > 1) + 1):
        first, last = (input_text(solved.motion, int(place), degrees=degrees) for place in (run[0], run[-1]))
        where = first if first == last else f"{first} … {last}"
        lines.append(f"  {where}: {outcomes[int(run[0])].say(language)}")
    return lines


def input_text(motion: Motion, place: int, *, degrees: bool) -> str:
    """Where a position is: the drivers' coordinates, or the time where drivers follow laws of their own."""
    if not motion.mechanism.steady:
        return f"t = {_short(motion.time[place])} s"
    texts = []
    for name, values in motion.inputs.items():
        turn = motion.positions.rotary[name]
        in_degrees = turn and degrees
        unit = "°" if in_degrees else " rad" if turn else " m"
        texts.append(f"{_short(np.degrees(values[place]) if in_degrees else values[place])}{unit}")
    return ", ".join(texts)


def _short(value: float) -> str:
    return f"{round(float(value), 4) + 0.0:g}"


def _efforts(solved: Solved, forces: Forces, say: Translate, *, degrees: bool) -> list[str]:
    """Largest, smallest and mean effort of every driver; the mean over a closed cycle counts its end once."""
    rows = []
    for key, driver in forces.mechanism.drivers.items():
        values = forces.driver_effort(key)
        name = key if len(forces.mechanism.drivers) > 1 else say(_("driver"))
        if not np.isfinite(values).any():
            continue
        unit = "N·m" if forces.mechanism.joints[driver.joint].coordinate == "turn" else "N"
        number = Column("", "", unit, values, solved.force_scale).text
        if len(values) == 1:
            rows.append(say(_("{name}: {value} {unit}", name=name, value=number(values[0]), unit=unit)))
            continue
        effort = partial(Forces.driver_effort, name=key)
        high, low = _places(solved, [(effort, "max"), (effort, "min")], degrees)
        at = _("at {place}")
        sentence = say(
            _(
                "{name}: from {low} {unit} {low_at} to {high} {unit} {high_at}",
                name=name,
                high=number(high.value),
                low=number(low.value),
                unit=unit,
                high_at=at.format(place=high.input),
                low_at=at.format(place=low.input),
            )
        )
        if solved.between and solved.motion.positions.closed:
            sentence += say(_(", mean {mean} {unit}", mean=number(solved.analysis.mean_of(effort)), unit=unit))
        rows.append(sentence)
    return rows


def data(solved: Solved, options: Options) -> dict[str, object]:
    """Everything that the table and what stands beneath it say."""
    motion, forces = solved.motion, solved.forces
    failed = [int(row) for row in solved.rows if not motion.ok[row]]
    found: dict[str, object] = {
        "ok": motion.complete and solved.trouble is None,
        "name": motion.mechanism.name,
        "mobility": motion.structure.mobility,
        "turned": motion.structure.data()["turned"],
        "positions": len(solved.rows),
        "columns": named_columns(solved, options),
        "reached": motion.ok[solved.rows],
        "not_reached": {str(list(solved.rows).index(row)): motion.outcomes[row].sentence for row in failed},
        "notes": list(solved.notes),
        "warnings": [each.removeprefix("! ") for each in closeness(motion, "en")],
        "findings": [finding.data() for finding in solved.warnings],
    }
    if options.prove:
        proof = solved.proof
        found["proof"] = {"said": proof.explain(), "proved": proof.proved, "margin": proof.margin}
    if forces is not None:
        found["static"] = forces.static
        found["checks"] = {
            "power_residual [W]": largest(forces.power_residual),
            "balance_residual [N]": largest(forces.balance_residual),
        }
        peaks = largest_reactions(solved) if motion.ok.any() else []
        found["largest_reactions [N]"] = {
            f"{joint} on {link}": peak.value
            for (joint, link), peak in zip(reaction_pairs(forces.mechanism), peaks, strict=bool(peaks))
        }
    if solved.trouble is not None:
        found["error"] = str(solved.trouble)
    return found
