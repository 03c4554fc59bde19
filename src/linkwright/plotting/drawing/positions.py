"""Positions that drawings and animations show: at an input, at a time, among limits, and how fast."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.errors import LinkwrightError
from linkwright.events.limit_positions import LimitPosition
from linkwright.joints.lower_pair import SlidingJoint
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.positions import at_inputs
from linkwright.kinematics.solve import solve_motion, with_times
from linkwright.pictures.picture import Vec
from linkwright.pictures.symbols.base import LINE
from linkwright.plotting.drawing.machine import DrawnMechanism
from linkwright.words import _

At = float | Mapping[str, float]


@dataclass(frozen=True)
class Shown:
    """One position of a motion."""

    motion: Motion
    index: int

    def checked(self) -> Shown:
        """The same; raises LinkwrightError where the position was not reached."""
        if not self.motion.ok[self.index]:
            sentence = self.motion.outcomes[self.index].sentence
            raise LinkwrightError(
                _("the position cannot be drawn: {sentence}", code="picture.the_position", sentence=sentence)
            )
        return self


def at_input(motion: Motion, at: At) -> Shown:
    """The position at a coordinate of the first driver, or of drivers by name (rad or m).

    Within the cycle it is the position that the motion passes, in the same assembly.
    """
    inputs = {name: [value] for name, value in at.items()} if isinstance(at, Mapping) else [at]
    time = at_inputs(motion.mechanism, inputs).time
    several = isinstance(at, Mapping) and len(at) > 1
    return (None if several else _passed(motion, float(time[0]))) or Shown(
        solve_motion(motion.mechanism, at=inputs, failures="mark"), 0
    )


def at_time(motion: Motion, time: float) -> Shown:
    """The position at a time, s."""
    return _passed(motion, time) or Shown(solve_motion(motion.mechanism, times=[time], failures="mark"), 0)


def with_limits(motion: Motion, limits: Sequence[LimitPosition]) -> tuple[Motion, list[int]]:
    """The motion with limit positions among its positions, and their indices."""
    return with_times(motion, (each.time for each in sorted(limits, key=lambda each: each.index)))


def _passed(motion: Motion, time: float) -> Shown | None:
    """The position at a time within the motion; None where the motion does not run along a way through it."""
    way = np.diff(motion.time)
    if not len(way) or not (np.all(way > 0) or np.all(way < 0)):
        return None
    forward = 1.0 if way[0] > 0 else -1.0
    since, length = forward * (time - motion.time[0]), abs(float(motion.time[-1] - motion.time[0]))
    if motion.positions.period is not None:
        length = motion.positions.period
        since %= length
    if not -1e-12 <= since <= length * (1.0 + 1e-12):
        return None
    courses = forward * (motion.time - motion.time[0])
    near = int(np.argmin(np.abs(courses - since)))
    if abs(courses[near] - since) <= 1e-9 * length:
        return Shown(motion, near)
    denser, (index,) = with_times(motion, [float(motion.time[0]) + forward * since])
    return Shown(denser, index)


def frame_indices(motion: Motion, frames: int) -> list[int]:
    """Positions of one cycle on the screen, the first repeated at the end.

    A closed cycle goes round; an open one, or one with positions that were not reached, goes to and fro over the
    longest stretch that was.
    """
    start, stop = _longest_stretch(motion.ok)
    count = stop - start
    if motion.positions.closed and count == motion.steps:
        chosen = np.unique(np.linspace(0, count, min(frames, count) + 1).round().astype(int)) % count
        return [int(k) for k in chosen]
    way = np.unique(np.linspace(start, stop - 1, min(max(frames // 2, 2), count)).round().astype(int)).tolist()
    there_and_back = [*way, *way[-2::-1]]
    return there_and_back if len(there_and_back) > 1 else [start, start]


def key_indices(machine: DrawnMechanism, frames: int) -> list[int]:
    """Positions of one cycle between which links move evenly: so many that pins part by half a line at most.

    At least as many as ``frame_indices`` gives; no more than the motion has.
    """
    run = frame_indices(machine.motion, frames)
    while parting(machine, run) > LINE / 2:
        finer = frame_indices(machine.motion, 2 * frames)
        if len(finer) == len(run):
            break
        run, frames = finer, 2 * frames
    return run


def parting(machine: DrawnMechanism, run: list[int]) -> float:
    """How far links part at pins, and blocks leave their guides, half-way between keyframes; units of the paper.

    Shift and turn of each link change evenly from one keyframe to the next, so its pins run along flat arcs.
    """
    largest = max((_distance_from_guide(machine, joint, run) for joint in machine.guides.values()), default=0.0)
    for name, joint in machine.pins.items():
        places = [
            _half_way(machine, link, machine.motion.mechanism.link(link).points[name], run) for link in joint.links
        ]
        for other in places[1:]:
            largest = max(largest, float(np.hypot(*(other - places[0]).T).max(initial=0.0)))
    return largest


def _distance_from_guide(machine: DrawnMechanism, joint: SlidingJoint, run: list[int]) -> float:
    """How far a block's point is from the line of its guide half-way between keyframes."""
    link = machine.motion.mechanism.link
    block = _half_way(machine, joint.block, link(joint.block).points[joint.at], run)
    base = _half_way(machine, joint.guide, link(joint.guide).points[joint.through], run)
    angle = joint.direction - _half_turn(machine, joint.guide, run)
    across = np.stack([-np.sin(angle), -np.cos(angle)], axis=1)
    aside = ((block - base) * across).sum(axis=1) - joint.offset * machine.view.scale
    return float(np.abs(aside).max(initial=0.0))


def _half_way(machine: DrawnMechanism, link: str, point: Vec, run: list[int]) -> Floats:
    """Where a point of a link is half-way between keyframes, on the paper, (k - 1, 2)."""
    origin = machine.view.paper(machine.placed[link].origin[run])
    (x, y), middle = machine.view.local(point), _half_turn(machine, link, run)
    c, s = np.cos(middle), np.sin(middle)
    local = np.stack([c * x - s * y, s * x + c * y], axis=1)
    return np.asarray((origin[1:] + origin[:-1]) / 2 + local)


def _half_turn(machine: DrawnMechanism, link: str, run: list[int]) -> Floats:
    """Turn of a link on the paper half-way between keyframes, rad, clockwise."""
    way = machine.placed[link].direction[run]
    turn = np.unwrap(np.arctan2(way[:, 1], way[:, 0]))
    return np.asarray(-(turn[1:] + turn[:-1]) / 2)


def usual_seconds(motion: Motion) -> float:
    """The true time of a cycle where an eye can follow it, else the nearest such time, within 2 to 6 s."""
    times = motion.time
    span = motion.positions.period or 2.0 * abs(float(times[-1] - times[0]))
    return float(np.clip(span, 2.0, 6.0))


def _longest_stretch(ok: np.ndarray) -> tuple[int, int]:
    edges = np.flatnonzero(np.diff(np.concatenate([[0], ok.astype(int), [0]])))
    runs = [(int(a), int(b)) for a, b in zip(edges[::2], edges[1::2], strict=True)]
    if not runs:
        raise LinkwrightError(
            _("no position of the motion was reached, so there is nothing to show", code="picture.nothing_reached")
        )
    return max(runs, key=lambda run: run[1] - run[0])
