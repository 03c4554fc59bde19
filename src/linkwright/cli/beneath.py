"""What stands beneath the table of ``solve``: largest values, checks, notes, warnings, positions that failed."""

from __future__ import annotations

import contextlib

import numpy as np

from linkwright.cli.columns import Column
from linkwright.cli.solving import Solved, reaction_pairs
from linkwright.errors import LinkwrightError
from linkwright.joints.revolute import RevoluteJoint
from linkwright.kinematics.cycle import Floats
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.words import Say
from linkwright.words.width import aligned


def extremes(solved: Solved, say: Say, *, degrees: bool) -> list[str]:
    """The largest force in every joint and the range of every driver's effort, over the fine grid."""
    forces = solved.forces
    if forces is None or not solved.motion.ok.any():
        return []
    several = solved.motion.steps > 1
    title = (
        say("solve.largest_forces", count=int(solved.motion.ok.sum()))
        if several
        else say("solve.joint_forces")
    )
    rows = [
        tuple(say(f"solve.{key}") for key in ("joint", "on", "force_there", "x_there", "y_there", "at_input"))
    ]
    for joint, link in reaction_pairs(forces.mechanism):
        force = forces.reaction(joint, on=link)
        size = np.hypot(force[:, 0], force[:, 1])
        place = int(np.nanargmax(size))
        number = Column("", "", "", "N", size[place : place + 1], solved.force_scale).text
        texts = (number(size[place]), number(force[place, 0]), number(force[place, 1]))
        rows.append((joint, link, *texts, input_text(solved, place, degrees=degrees)))
    wide = 6 if several else 5
    table = aligned([row[:wide] for row in rows], "<<>>>>"[:wide])
    return [title, *(f"  {line}" for line in table), *_efforts(solved, forces, say, degrees=degrees)]


def checks(solved: Solved, say: Say) -> list[str]:
    """The residuals that belong to the forces."""
    forces = solved.forces
    if forces is None or not solved.motion.ok.any():
        return []
    power = largest(forces.power_residual)
    lines = []
    if forces.mechanism.drivers:
        lines.append(say("solve.power_check", residual=f"{power:.1e}", size=f"{largest(forces.power):.3g}"))
    size = solved.force_scale
    lines.append(
        say("solve.balance_check", residual=f"{largest(forces.balance_residual):.1e}", size=f"{size:.3g}")
    )
    return lines


def closeness(motion: Motion, language: str) -> list[str]:
    """Warnings about groups whose cycle passes close to a singular position, each with the place.

    Of chosen inputs or times the whole cycle is looked at where there is one.
    """
    if not motion.inputs or not motion.ok.any():
        return []
    from linkwright.metrics.singularity import Singularity

    cycle = motion
    if not motion.positions.closed:
        with contextlib.suppress(LinkwrightError):
            cycle = solve_motion(motion.mechanism, steps=360, failures="mark")
    values = Singularity().evaluate(cycle)
    return [f"! {remark.text(language)}" for value in values for remark in value.warnings]


def failures(solved: Solved, say: Say, language: str, *, degrees: bool) -> list[str]:
    """Stretches of positions that are not reached, each with the sentence of its first position."""
    ok = solved.motion.ok
    failed = np.flatnonzero(~ok)
    if not len(failed):
        return []
    lines = [say("solve.not_reached", count=len(failed), of=len(ok))]
    outcomes = solved.motion.outcomes
    for run in np.split(failed, np.flatnonzero(np.diff(failed) > 1) + 1):
        first, last = (input_text(solved, int(place), degrees=degrees) for place in (run[0], run[-1]))
        where = first if first == last else f"{first} … {last}"
        lines.append(f"  {where}: {outcomes[int(run[0])].say(language)}")
    return lines


def input_text(solved: Solved, place: int, *, degrees: bool) -> str:
    """Where a position is: the drivers' coordinates, or the time where drivers follow laws of their own."""
    motion = solved.motion
    if not solved.steady:
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


def _efforts(solved: Solved, forces: Forces, say: Say, *, degrees: bool) -> list[str]:
    """Largest, smallest and mean effort of every driver; the mean over a closed cycle counts its end once."""
    rows = []
    for key, driver in forces.mechanism.drivers.items():
        values = forces.driver_effort(key)
        name = key if len(forces.mechanism.drivers) > 1 else say("solve.driver")
        if not np.isfinite(values).any():
            continue
        unit = "N·m" if isinstance(forces.mechanism.joints[driver.joint], RevoluteJoint) else "N"
        number = Column("", "", "", unit, values, solved.force_scale).text
        high, low = int(np.nanargmax(values)), int(np.nanargmin(values))
        if len(values) == 1:
            rows.append(say("solve.effort", name=name, value=number(values[0]), unit=unit))
            continue
        places = [say("solve.at", place=input_text(solved, place, degrees=degrees)) for place in (high, low)]
        said = say("solve.effort_range", name=name, high=number(values[high]), low=number(values[low]), unit=unit,
                   high_at=places[0], low_at=places[1])  # fmt: skip
        if solved.motion.positions.closed and solved.motion.ok.all():
            said += say("solve.effort_mean", mean=number(float(values[:-1].mean())), unit=unit)
        rows.append(said)
    return rows


def largest(values: Floats) -> float:
    """Largest size of an array's numbers, those that are not finite left out."""
    return float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0))
