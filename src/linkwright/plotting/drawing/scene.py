"""A machine laid out on paper: the positions that are shown, its parts at one of them, the ink that labels avoid."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats, runs
from linkwright.errors import LinkwrightError
from linkwright.events.limit_positions import LimitPosition
from linkwright.fields.colour import as_rgb
from linkwright.joints.lower_pair import SlidingJoint
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.placement import placements, with_placements_of
from linkwright.kinematics.positions import at_inputs
from linkwright.kinematics.solve import solve_motion, with_times
from linkwright.pictures.labels import Label
from linkwright.pictures.picture import Inked, Line, SvgNode, Vec
from linkwright.pictures.svg import group, number
from linkwright.pictures.symbols.base import LINE, SYMBOLS, points, vec
from linkwright.plotting.drawing.actuators import actuators, flywheels, stops
from linkwright.plotting.drawing.guides import guides, input_arrows, welds
from linkwright.plotting.drawing.joint_marks import wheels
from linkwright.plotting.drawing.machine import (
    DIAGONAL,
    LAYERS,
    DrawnMechanism,
    Part,
    View,
    bodies,
    coloured,
    fitted,
    flat,
    moved,
    pins,
)
from linkwright.plotting.drawing.outlines import outlines_of
from linkwright.words import _


@dataclass(frozen=True)
class Scene:
    """The machine and all its parts, each in the axes of its link."""

    machine: DrawnMechanism
    parts: tuple[Part, ...]

    def layered(self, carriers: Iterable[str] | None = None) -> Iterator[tuple[str, str, list[Part]]]:
        """Layer, link and parts, from the bottom of the paper upwards."""
        chosen = None if carriers is None else set(carriers)
        for layer in LAYERS:
            links = dict.fromkeys(part.carrier for part in self.parts if part.layer == layer)
            for link in links:
                if chosen is None or link in chosen:
                    yield layer, link, [p for p in self.parts if p.layer == layer and p.carrier == link]

    def at(self, index: int, *, moving_only: bool = False) -> list[SvgNode]:
        """The elements of the machine at one position."""
        links = tuple(self.machine.motion.mechanism.links)
        return [
            group((e for p in parts for e in p.shape.elements), f"lw-{layer}", transform=self._transform(link, index))
            for layer, link, parts in self.layered(links if moving_only else None)
            if not (moving_only and layer == "marks")
        ]

    def items(self, index: int) -> Iterator[tuple[Part, Inked]]:
        """The lines and circles of the machine at one position, on the paper, with the parts to which they belong."""
        for _layer, link, parts in self.layered():
            x, y, turn = self.machine.view.transform(self.machine.placed[link], index)
            for part in parts:
                for each in part.shape.elements:
                    yield part, each.placed(np.array([x, y]), math.radians(turn))

    def ink(self, index: int, *, moving_only: bool = False) -> list[Floats]:
        """The polylines of everything at one position, on the paper."""
        return [
            moved(line, self.machine.view.transform(self.machine.placed[part.carrier], index))
            for part in self.parts
            if not (moving_only and (part.carrier == "frame" or part.layer == "marks"))
            for line in part.shape.ink
        ]

    def _transform(self, link: str, index: int) -> str | None:
        if link == "frame":
            x, y, _ = self.machine.view.transform(self.machine.placed[link], index)
            return f"translate({number(x)} {number(y)})"
        x, y, turn = self.machine.view.transform(self.machine.placed[link], index)
        return f"translate({number(x)} {number(y)}) rotate({turn:.3f})"

    @cached_property
    def closed(self) -> bool:
        """Whether the first position comes after the last."""
        return self.machine.motion.positions.closed

    def trace(self, point: str) -> Floats:
        """The path of a point on the paper; closed where the cycle is."""
        track = self.machine.view.paper(self.machine.motion.point(point).position)
        return np.vstack([track, track[:1]]) if self.closed and len(track) > 1 else track

    def traces(self, names: Sequence[str]) -> list[SvgNode]:
        """Paths of several points, each in its own colour."""
        return [Line(self.trace(name), f"lw-trace lw-trace-{k % 4}") for k, name in enumerate(names)]


def laid_out(
    motion: Motion,
    index: int,
    *,
    inputs: bool = True,
    centres: bool = False,
    others: Sequence[tuple[Motion, int]] = (),
    outlines: bool = False,
    diagonal: float = DIAGONAL,
    view: View | None = None,
) -> Scene:
    """The scene of a motion; ``inputs``: with what drives, brakes and stops it, arrows of the drivers as at the
    position ``index``; ``outlines``: with parts as they are made in place of symbols.

    ``beside``: positions of other motions of the mechanism, counted on after its own; ``view``: instead of one in
    which the machine has the ``diagonal``.
    """
    placed = with_placements_of(placements(motion), others)
    machine = DrawnMechanism(motion, placed, view or fitted(motion, placed, diagonal), others)
    parts = [*outlines_of(machine)] if outlines else parts_of(machine)
    parts = _in_colours(machine, parts)
    if inputs:
        parts = [part for part, _pin in flywheels(machine)] + parts
        parts += [*(part for part, _pin in actuators(machine, index)), *stops(machine)]
        parts += input_arrows(machine, index)
    if centres:
        parts += mass_centres(machine)
    return Scene(machine, tuple(parts))


def parts_of(machine: DrawnMechanism) -> list[Part]:
    """Wheels, bodies and joints."""
    return [*wheels(machine), *bodies(machine), *guides(machine), *pins(machine), *welds(machine)]


def _in_colours(machine: DrawnMechanism, parts: list[Part]) -> list[Part]:
    """Parts in the colours of their links."""
    colours = {link.name: as_rgb(link.colour) for link in machine.motion.mechanism.links.values() if link.colour}
    return [coloured(part, colours[part.carrier]) if part.carrier in colours else part for part in parts]


def mass_centres(machine: DrawnMechanism) -> Iterator[Part]:
    """The mass centre of every link that has a mass."""
    for link in machine.motion.mechanism.links.values():
        if link.mass > 0:
            yield Part("marks", link.name, SYMBOLS["mass_centre"](at=machine.view.local(link.centre)))


LINK_SIZE = 12.0


def point_labels(machine: DrawnMechanism, index: int, links: Iterable[str] | None = None) -> Iterator[Label]:
    """Names of all pins and points of moving links at one position; of some links where these are named."""
    labelled: set[tuple[str, float, float]] = set()
    for link in machine.motion.mechanism.links if links is None else links:
        for point in machine.motion.mechanism.links[link].points:
            x, y = machine.paper(link, point, index)
            key = (point, round(x), round(y))
            if key not in labelled:
                labelled.add(key)
                yield Label(point, ((x, y),), clearance=8.0, point=f"{link}.{point}")


def link_labels(scene: Scene, index: int) -> Iterator[Label]:
    """Names of all moving links, next to their bodies."""
    machine = scene.machine
    for name in machine.motion.mechanism.links:
        cloud = machine.cloud(name)
        if len(cloud) < 2:
            cloud = _middle_of_ink(scene, name, cloud)
        cloud = moved(cloud, machine.view.transform(machine.placed[name], index))
        yield Label(name, _anchors(cloud), "lw-link", LINK_SIZE, clearance=5.0)


def body_labels(scene: Scene, index: int) -> Iterator[Label]:
    """The same, with one name for the two links of a cylinder: the driver's, which is none where it is alone."""
    mechanism = scene.machine.motion.mechanism
    parts = mechanism.cylinder_parts
    for label in link_labels(scene, index):
        if label.text not in parts:
            yield label
        elif (driver := mechanism.drivers[parts[label.text]]).relative_to == label.text and driver.name != "driver":
            yield replace(label, text=driver.name)


def _middle_of_ink(scene: Scene, link: str, cloud: Floats) -> Floats:
    """The middle of what is drawn of a link that has one point only."""
    layers = ("blocks", "bodies")
    ink = [
        line
        for layer in layers
        for p in scene.parts
        if p.carrier == link and p.layer == layer
        for line in p.shape.ink
    ]
    if not ink:
        return cloud
    everything = np.concatenate(ink)
    return points([(everything.min(axis=0) + everything.max(axis=0)) / 2])


def _anchors(cloud: Floats) -> tuple[Vec, ...]:
    ends = flat(cloud)
    if ends is None:
        sides = (cloud + np.roll(cloud, 1, axis=0)) / 2
        return (vec(cloud.mean(axis=0)), *map(vec, sides))
    if len(ends) == 1 or np.hypot(*(ends[1] - ends[0])) < 1.0:
        return (vec(cloud[0]),)
    return tuple(vec(ends[0] + share * (ends[1] - ends[0])) for share in (0.5, 0.38, 0.62, 0.27, 0.73))


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
    longest stretch that was; motion under forces goes forth only.
    """
    start, stop = _longest_stretch(motion.ok)
    count = stop - start
    if motion.positions.closed and count == motion.steps:
        chosen = np.unique(np.linspace(0, count, min(frames, count) + 1).round().astype(int)) % count
        return [int(k) for k in chosen]
    if not motion.by_law:
        return [int(k) for k in np.unique(np.linspace(start, stop - 1, min(frames, count)).round())]
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
    if not motion.by_law:
        return float(np.clip(times[-1] - times[0], 0.05, 3600.0))
    span = motion.positions.period or 2.0 * abs(float(times[-1] - times[0]))
    return float(np.clip(span, 2.0, 6.0))


def _longest_stretch(ok: np.ndarray) -> tuple[int, int]:
    reached = runs(ok)
    if not reached:
        raise LinkwrightError(
            _("no position of the motion was reached, so there is nothing to show", code="picture.nothing_reached")
        )
    first, last = max(reached, key=lambda run: run[1] - run[0])
    return first, last + 1
