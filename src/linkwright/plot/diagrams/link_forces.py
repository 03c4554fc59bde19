"""All forces on one link at one position, so that they close a polygon."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from linkwright.joints.prismatic import PrismaticJoint
from linkwright.kinematics.cycle import Floats
from linkwright.kinetostatics.forces import Forces


@dataclass(frozen=True)
class LinkForce:
    """A force on a link, N in frame axes; ``role``: ``load``, ``weight``, ``inertia``, ``driver``, ``reaction``."""

    name: str
    role: str
    force: Floats

    @property
    def size(self) -> float:
        """Its size, N."""
        return float(np.hypot(*self.force))


def link_forces(forces: Forces, link: str, index: int) -> list[LinkForce]:
    """Loads, weight, inertia force -m a, drivers and joint forces on a link; their sum is zero but for rounding.

    Forces of less than 1e-9 of the largest are left out.
    """
    mechanism = forces.mechanism
    part = mechanism.links[link]
    applied = np.array([row[index] for row in forces.fetch((f"on:{link}.x", f"on:{link}.y"))])
    found = [LinkForce(_load_name(forces, link), "load", applied)]
    found.append(LinkForce("G", "weight", part.mass * np.asarray(mechanism.gravity)))
    if not forces.static:
        found.append(
            LinkForce("−m·a", "inertia", -part.mass * forces.motion.link(link).centre.acceleration[index])
        )
    found += _drivers(forces, link, index)
    for name, joint in mechanism.joints.items():
        if link in joint.joined:
            found.append(LinkForce(f"F {name}", "reaction", forces.reaction(name, on=link)[index]))
    largest = max(float(np.hypot(*each.force)) for each in found)
    return [each for each in found if float(np.hypot(*each.force)) > 1e-9 * largest]


def _load_name(forces: Forces, link: str) -> str:
    names = [name for name, load in forces.mechanism.loads.items() if getattr(load, "on", None) == link]
    return names[0] if len(names) == 1 else "ΣP"


def _drivers(forces: Forces, link: str, index: int) -> list[LinkForce]:
    found = []
    for name, driver in forces.mechanism.drivers.items():
        if link not in (driver.link, driver.relative_to):
            continue
        if isinstance(forces.mechanism.joints[driver.joint], PrismaticJoint):
            sign = 1.0 if link == driver.link else -1.0
            along = forces.guide_direction(driver.joint)[index]
            found.append(LinkForce(name, "driver", sign * forces.driver_effort(name)[index] * along))
    return found
