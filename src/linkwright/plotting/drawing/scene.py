"""A machine laid out on paper: its parts at one position, and the ink that labels keep clear of."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.placement import placements, with_placements_of
from linkwright.pictures.labels import Label
from linkwright.pictures.picture import Circle, Line, SvgNode, Vec
from linkwright.pictures.svg.element import group, number
from linkwright.pictures.symbols.base import SYMBOLS, points, vec
from linkwright.plotting.drawing.guides import guides, input_arrows, welds
from linkwright.plotting.drawing.joint_marks import wheels
from linkwright.plotting.drawing.machine import (
    DIAGONAL,
    LAYERS,
    DrawnMechanism,
    Part,
    View,
    bodies,
    fitted,
    flat,
    moved,
    pins,
)


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

    def items(self, index: int) -> Iterator[tuple[Part, Line | Circle]]:
        """The lines and circles of the machine at one position, on the paper, with the parts to which they belong."""
        for _, link, parts in self.layered():
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
        """Whether the last position is followed by the first."""
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
    diagonal: float = DIAGONAL,
    view: View | None = None,
) -> Scene:
    """The scene of a motion; arrows of the drivers stand as at the position ``index``.

    ``beside``: positions of other motions of the mechanism, counted on after its own; ``view``: instead of one in
    which the machine has the ``diagonal``.
    """
    placed = with_placements_of(placements(motion), others)
    machine = DrawnMechanism(motion, placed, view or fitted(motion, placed, diagonal), others)
    parts = parts_of(machine)
    if inputs:
        parts += input_arrows(machine, index)
    if centres:
        parts += mass_centres(machine)
    return Scene(machine, tuple(parts))


def parts_of(machine: DrawnMechanism) -> list[Part]:
    """Wheels, bodies and joints."""
    return [*wheels(machine), *bodies(machine), *guides(machine), *pins(machine), *welds(machine)]


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
    """Names of all moving links, beside their bodies."""
    machine = scene.machine
    for name in machine.motion.mechanism.links:
        cloud = machine.cloud(name)
        if len(cloud) < 2:
            cloud = _middle_of_ink(scene, name, cloud)
        cloud = moved(cloud, machine.view.transform(machine.placed[name], index))
        yield Label(name, _anchors(cloud), "lw-link", LINK_SIZE, clearance=5.0)


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
