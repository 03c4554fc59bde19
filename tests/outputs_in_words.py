"""Outputs in the user's words of two machines, and what they are by public results or textbook formulas of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkwright import Forces, Motion, solve_forces

Floats = NDArray[np.float64]

DRY = """
format: 1
name: shaper with dry joints
frame: {points: {O: [0 m, 0.5 m], Q: [0 m, 0 m], R: [0 m, 0.95 m]}}
links:
  crank: {points: [O, A], length: 0.15 m, mass: 4 kg, inertia: 0.02 kg·m²}
  die: {points: [A], mass: 1 kg}
  lever: {points: [Q, B], length: 0.9 m, mass: 6 kg, inertia: 0.4 kg·m²}
  rod: {points: [B, C], length: 0.4 m, mass: 2 kg, inertia: 0.04 kg·m²}
  ram: {points: [C], mass: 9 kg}
joints:
  A: {kind: revolute, pin_radius: 25 mm}
  B: {kind: revolute, pin_radius: 20 mm}
  Q: {kind: revolute, pin_radius: 30 mm}
  slot: {kind: prismatic, guide: lever, through: Q, direction: [Q, B], block: die, at: A}
  bed: {kind: prismatic, guide: frame, through: R, direction: 0 deg, block: ram, at: C}
drawing: {A: [0.15 m, 0.5 m], B: [0.25 m, 0.86 m], C: [0.64 m, 0.95 m]}
driver: {turn: crank, about: O, speed: 3 rad/s}
gravity: [0, -9.81 m/s²]
loads: {cutting: {kind: force, on: ram, at: C, components: [-200 N, 0 N]}}
"""

PUSHED = """
format: 1
name: slider-crank pushed by its slider
frame: {points: {O: [0 m, 0 m], G: [0 m, 0.1 m]}}
links:
  crank: {points: [O, A], length: 0.2 m, mass: 2 kg, inertia: 0.02 kg·m²}
  rod: {points: [A, B], length: 0.7 m, also: {centre: [0.3 m, 0.05 m]}, mass: 3 kg, inertia: 0.1 kg·m²}
  slide: {points: [B], mass: 5 kg}
joints: {bed: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: slide, at: B}}
drawing: {A: [0.1 m, 0.17320508 m], B: [0.79616305 m, 0.1 m]}
driver: {slide: bed, speed: -0.2 m/s, start: 0.79616305 m}
cycle: {duration: 0.5 s}
gravity: [0, -9.81 m/s²]
loads: {drag: {kind: torque, on: crank, magnitude: 4 N·m}}
"""


def size(vectors: Floats) -> Floats:
    return np.asarray(np.hypot(*vectors.T))


def kinetic(m: Motion) -> Floats:
    total = np.zeros(m.steps)
    for name, link in m.mechanism.links.items():
        if not link.mass:
            continue
        v = m.point(f"{name}.centre").velocity
        total = total + link.mass * (v * v).sum(axis=1) + (link.inertia or 0.0) * m.link(name).angular_velocity ** 2
    return total


def kinetic_with_own_centre(m: Motion) -> Floats:
    """The rod's point ``centre`` is a point like others; its mass centre lies in the middle of A–B."""
    total = 5.0 * (m.point("B").velocity ** 2).sum(axis=1)
    for name, a, b, mass, inertia in (("crank", "O", "A", 2.0, 0.02), ("rod", "A", "B", 3.0, 0.1)):
        v = 0.5 * (m.point(a).velocity + m.point(b).velocity)
        total = total + mass * (v * v).sum(axis=1) + inertia * m.link(name).angular_velocity ** 2
    return np.asarray(total)


def acute(a: Floats, b: Floats) -> Floats:
    """The angle between two directions without sense, rad."""
    across, along = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]), np.abs((a * b).sum(axis=1))
    return np.asarray(np.arctan2(across, along))


def heat(m: Motion, f: Forces) -> Floats:
    return np.asarray(
        size(f.reaction("A", on="die")) * 0.025 * (m.link("die").angular_velocity - m.link("crank").angular_velocity)
    )


def held_at(m: Motion, point: str) -> Floats:
    """Force along a point's path of the same power as the torque that holds the machine still."""
    return np.asarray(solve_forces(m, static=True).input_torque * 3.0 / size(m.point(point).velocity))


def mu(m: Motion) -> Floats:
    """Between the rod B–C and the normal of the horizontal bed."""
    rod = m.point("C").position - m.point("B").position
    return acute(rod, np.tile([0.0, 1.0], (m.steps, 1)))


Reading = Callable[[Any, Any], Floats]

OF_THE_SHAPER: list[tuple[str, str, Reading]] = [
    ("B.x", "length", lambda m, f: m.point("B").position[:, 0]),
    ("B.position.y", "length", lambda m, f: m.point("B").position[:, 1]),
    ("B.velocity", "velocity", lambda m, f: size(m.point("B").velocity)),
    ("B.velocity.x", "velocity", lambda m, f: m.point("B").velocity[:, 0]),
    ("C.velocity", "velocity", lambda m, f: np.abs(m.point("C").velocity[:, 0])),
    ("rod.centre.acceleration", "acceleration", lambda m, f: size(m.point("rod.centre").acceleration)),
    ("rod.C.acceleration.x", "acceleration", lambda m, f: m.point("C").acceleration[:, 0]),
    ("lever.angle", "angle", lambda m, f: m.link("lever").angle),
    ("lever.angular_velocity", "angular_velocity", lambda m, f: m.link("lever").angular_velocity),
    ("rod.angular_acceleration", "angular_acceleration", lambda m, f: m.link("rod").angular_acceleration),
    ("slot.displacement", "length", lambda m, f: m.joint("slot").displacement),
    ("slot.velocity", "velocity", lambda m, f: m.joint("slot").velocity),
    ("bed.acceleration", "acceleration", lambda m, f: m.joint("bed").acceleration),
    ("driver.effort", "torque", lambda m, f: f.input_torque),
    ("input_torque", "torque", lambda m, f: f.input_torque),
    ("driver.holding_effort", "torque", lambda m, f: solve_forces(m, static=True).input_torque),
    ("hand_force C", "force", lambda m, f: held_at(m, "C")),
    ("hand_force lever.B", "force", lambda m, f: held_at(m, "B")),
    ("power", "power", lambda m, f: f.input_torque * 3.0),
    ("shaking_force", "force", lambda m, f: size(f.shaking_force)),
    ("shaking_force.y", "force", lambda m, f: f.shaking_force[:, 1]),
    ("shaking_moment", "torque", lambda m, f: f.shaking_moment),
    ("reaction A on die", "force", lambda m, f: size(f.reaction("A", on="die"))),
    ("reaction A on crank.y", "force", lambda m, f: -f.reaction("A", on="die")[:, 1]),
    ("reaction Q.x", "force", lambda m, f: f.reaction("Q", on="lever")[:, 0]),
    ("couple bed", "torque", lambda m, f: f.couple("bed", on="ram")),
    ("couple slot on lever", "torque", lambda m, f: f.couple("slot", on="lever")),
    ("load cutting", "force", lambda m, f: np.full(m.steps, 200.0)),
    ("heat A on die", "power", heat),
    ("heat A on crank", "power", lambda m, f: -heat(m, f)),
    ("heat Q", "power", lambda m, f: size(f.reaction("Q", on="lever")) * 0.03 * m.link("lever").angular_velocity),
    ("equivalent_inertia", "inertia", lambda m, f: kinetic(m) / 9.0),
    ("velocity_ratio lever", "dimensionless", lambda m, f: m.link("lever").angular_velocity / 3.0),
    ("velocity_ratio bed", "length_per_angle", lambda m, f: m.joint("bed").velocity / 3.0),
    ("transmission_angle C", "angle", lambda m, f: mu(m)),
    ("conditioning C", "dimensionless", lambda m, f: np.sin(mu(m))),
    ("closeness C", "dimensionless", lambda m, f: np.sin(mu(m)) ** 2),
]

OF_THE_PUSHED: list[tuple[str, str, Reading]] = [
    ("driver.effort", "force", lambda m, f: f.driver_effort("driver")),
    ("input_torque", "force", lambda m, f: f.driver_effort("driver")),
    ("driver.holding_effort", "force", lambda m, f: solve_forces(m, static=True).driver_effort("driver")),
    ("power", "power", lambda m, f: f.driver_effort("driver") * -0.2),
    ("velocity_ratio bed", "dimensionless", lambda m, f: np.ones(m.steps)),
    ("velocity_ratio rod", "angle_per_length", lambda m, f: m.link("rod").angular_velocity / -0.2),
    ("rod.centre.x", "length", lambda m, f: m.point("rod.centre").position[:, 0]),
    ("equivalent_inertia", "inertia", lambda m, f: kinetic_with_own_centre(m) / 0.2**2),
    (
        "transmission_angle A",
        "angle",
        lambda m, f: acute(
            m.point("A").position - m.point("O").position, m.point("B").position - m.point("A").position
        ),
    ),
]
