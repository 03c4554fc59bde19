"""Machines and what edits make of them: lengths, values that become zero or cease to be, angles, friction.

``python -m tests.invariants.edited_machines FILE`` writes the driver's torques of the edited ones, found by a process
that has solved nothing else.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

import linkwright as lw

RUBBING = """
format: 1
name: slider-crank with friction
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m}
  rod: {points: [A, B], length: 0.4 m, mass: 1 kg, inertia: 0.01 kg·m²}
  slider: {points: [B], mass: 2 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: 0 rad, block: slider, at: B, friction: 0.1}
driver: {turn: crank, about: O, speed: 10 rad/s}
gravity: [0, -9.81 m/s²]
"""
Edit = Callable[[], tuple[lw.Mechanism, lw.Mechanism]]


def longer(name: str, ending: str = ".length") -> tuple[lw.Mechanism, lw.Mechanism]:
    """All dimensions of a name a little larger."""
    machine = lw.load(f"gallery:{name}")
    lengths = [address for address in machine.dimensions() if address.endswith(ending)]
    return machine, machine.with_dimensions({a: machine.dimension(a) * 1.0002 for a in lengths})


def changed(name: str, changes: Mapping[str, float]) -> tuple[lw.Mechanism, lw.Mechanism]:
    machine = lw.load(f"gallery:{name}")
    return machine, machine.with_dimensions(dict(changes))


def turned(first: float, second: float) -> tuple[lw.Mechanism, lw.Mechanism]:
    """The guide of a slider-crank at two shares of half a turn."""
    given = lw.load("gallery:slider_crank_inline")
    one, other = (given.with_dimensions({"cylinder.direction": x * np.pi}) for x in (first, second))
    return one, other


EDITS: dict[str, Edit] = {
    **{
        name: lambda name=name: longer(name)
        for name in ("jaw_crusher_sixbar", "swing_conveyor", "scotch_yoke", "excavator")
    },
    "triad": lambda: longer("triad", "crank.A.x"),
    **{
        f"{address} {value}": lambda address=address, value=value: changed("jaw_crusher_sixbar", {address: value})
        for address, value in (
            ("crank.mass", 3.0),
            ("jaw.mass", 0.0),
            ("gravity.x", 1.0),
            ("frame.O1.x", 0.01),
            ("jaw.D.y", 0.1),
        )
    },
    **{
        f"guide from {first} to {second}": lambda first=first, second=second: turned(first, second)
        for first, second in ((0.0, 0.5), (0.5, 0.0), (0.5, 1.0), (0.0, 0.1), (0.1, 0.2))
    },
    "friction": lambda: (lw.loads(RUBBING), lw.loads(RUBBING.replace("friction: 0.1", "friction: 0.2"))),
}


def torque(machine: lw.Mechanism) -> NDArray[np.float64]:
    return lw.solve_forces(lw.solve_motion(machine, steps=24)).input_torque


if __name__ == "__main__":
    np.savez(sys.argv[1], **{name: torque(make()[1]) for name, make in EDITS.items()})
