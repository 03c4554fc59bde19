"""Peak torque and reactions of a candidate whose links are given a mass per length."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from linkwright.analysis.evaluate import metrics
from linkwright.core.arguments import real
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.run import solve_forces
from linkwright.synthesis.linkage import Linkage


def peak_loads(linkage: Linkage, mass_per_length: float, speed: str | float, steps: int) -> dict[str, float]:
    """``peak_input_torque`` (N·m) and ``peak_reaction`` (N) over the cycle, links as slender rods, no gravity.

    Raises PositionError where the linkage does not pass its cycle.
    """
    mass_per_length = real("mass_per_length", mass_per_length)
    mechanism = linkage.mechanism(speed=speed)
    links = {}
    for name, link in mechanism.links.items():
        points = linkage.links[name]
        length = linkage.length(*points[:2]) if len(points) > 1 else 0.0
        mass = mass_per_length * length
        middle = np.mean([link.points[each] for each in points[:2]], axis=0)
        centre = (float(middle[0]), float(middle[1]))
        links[name] = replace(link, mass=mass, inertia=mass * length**2 / 12, mass_centre=centre)
    forces = solve_forces(solve_motion(replace(mechanism, links=links), steps=steps))
    peaks = metrics(forces, ["peak_input_torque", "peak_reaction"])
    return {name: max(row.value for row in peaks[name]) for name in ("peak_input_torque", "peak_reaction")}
