"""Which labels a drawing needs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.plot.drawing.labels import Label
from linkwright.plot.drawing.machine import Machine, flat
from linkwright.plot.drawing.scene import Scene
from linkwright.plot.drawing.view import moved
from linkwright.plot.symbols.base import Vec, points, vec

LINK_SIZE = 12.0


def point_labels(machine: Machine, index: int) -> Iterator[Label]:
    """Names of all pins and points at one position."""
    seen: set[tuple[str, float, float]] = set()
    for link in machine.motion.mechanism.links.values():
        for point in link.points:
            x, y = machine.paper(link.name, point, index)
            key = (point, round(x), round(y))
            if key not in seen:
                seen.add(key)
                yield Label(point, ((x, y),), clearance=8.0, point=f"{link.name}.{point}")


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
    ink = [line for layer in layers for p in scene.parts if p.carrier == link and p.layer == layer
           for line in p.shape.ink]  # fmt: skip
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
