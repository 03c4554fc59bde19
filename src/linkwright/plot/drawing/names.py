"""Which labels a drawing needs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from linkwright.kinematics.names import canonical
from linkwright.plot.drawing.guides import is_cylinder
from linkwright.plot.drawing.labels import Label
from linkwright.plot.drawing.machine import Machine, flat
from linkwright.plot.drawing.view import moved
from linkwright.plot.symbols.base import Vec

LINK_SIZE = 12.0


def point_labels(machine: Machine, index: int) -> Iterator[Label]:
    """Names of all pins and points at one position; points that coincide share a label."""
    mechanism = machine.motion.mechanism
    found: dict[tuple[float, float], list[str]] = {}
    for link in mechanism.links.values():
        for point in link.points:
            x, y = machine.paper(link.name, point, index)
            key = (round(x, 0), round(y, 0))
            names = found.setdefault(key, [])
            if point not in names:
                names.append(point)
    for names in found.values():
        owner = next(link.name for link in mechanism.links.values() if names[0] in link.points
                     and canonical(mechanism, link.name, names[0]))  # fmt: skip
        yield Label(", ".join(names), (machine.paper(owner, names[0], index),), clearance=8.0)


def link_labels(machine: Machine, index: int) -> Iterator[Label]:
    """Names of all moving links, beside their bodies."""
    for name in machine.motion.mechanism.links:
        cloud = moved(machine.cloud(name), machine.view.transform(machine.placed[name], index))
        yield Label(name, _anchors(machine, name, cloud), "lw-link", LINK_SIZE, clearance=5.0)


def _anchors(machine: Machine, name: str, cloud: np.ndarray) -> tuple[Vec, ...]:
    ends = flat(cloud)
    if ends is None:
        centre = cloud.mean(axis=0)
        return (_vec(centre), *(_vec((a + b) / 2) for a, b in zip(cloud, np.roll(cloud, 1, axis=0), strict=True)))
    if len(ends) == 1 or np.hypot(*(ends[1] - ends[0])) < 1.0:
        return (_vec(cloud[0]),)
    return tuple(_vec(ends[0] + share * (ends[1] - ends[0])) for share in (0.5, 0.38, 0.62, 0.27, 0.73))


def _vec(row: np.ndarray) -> Vec:
    return float(row[0]), float(row[1])


def cylinders(machine: Machine) -> set[str]:
    """Links that are drawn as barrels or piston rods."""
    return {link for name in machine.guides if is_cylinder(machine, name) for link in machine.guides[name].joined}
