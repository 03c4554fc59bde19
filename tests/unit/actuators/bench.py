"""A rotor, a slide and a rod on a rotor, on which actuators act; their equations of motion at one state."""

from collections.abc import Mapping

import numpy as np

import linkwright as lw
from linkwright.dynamics.equation import EquationOfMotion

ROTOR = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  wheel: {points: [O, A], length: 1 m, mass: 3 kg, inertia: 2 kg·m², mass_centre: O}
driver: {turn: wheel, about: O, SPEED}
actuators:
  main: {ACTUATOR}
"""
SLIDE = """
format: 1
frame: {points: {O: [0 m, 0 m], S: [0 m, 3 m]}}
links:
  table: {points: [P], mass: 5 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: table, at: P}
driver: {slide: guide, SPEED}
actuators:
  main: {ACTUATOR}
"""
ARM = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  upper: {points: [O, A], length: 1 m, mass: 1 kg, inertia: 0.5 kg·m², mass_centre: O}
  lower: {points: [A, B], length: 1 m, mass: 1 kg, inertia: 0.25 kg·m², mass_centre: A}
drivers:
  one: {turn: upper, about: O, speed: 1 rad/s}
  two: {turn: lower, about: A, speed: 1 rad/s}
cycle: {duration: 1 s}
actuators:
  main: {ACTUATOR}
"""


def machine(actuator: str, text: str = ROTOR, speed: str = "free: true") -> EquationOfMotion:
    """The equation of motion of a text with one actuator."""
    return EquationOfMotion(lw.loads(text.replace("ACTUATOR", actuator).replace("SPEED", speed)))


def found(equation: EquationOfMotion, names: list[str], given: Mapping[str, float]) -> list[float]:
    """Outputs at a state, all comparisons as their gaps say."""
    gaps = [f"gap:{k}" for k in range(len(equation.switches.names))]
    held = dict.fromkeys(equation.switches.names, 0.0)
    for _ in range(8):
        values = equation.evaluate(gaps, {**given, **held}, 1)[:, 0] if gaps else np.empty(0)
        again = {name: float(value > 0.0) for name, value in zip(held, values, strict=True)}
        if again == held:
            break
        held = again
    assert again == held
    return equation.evaluate(names, {**given, **held}, 1)[:, 0].tolist()


def effort(equation: EquationOfMotion, w: float = 0.0, *, time: float = 0.0, q: float = 0.0) -> float:
    """Torque (N·m) or force (N) that the actuator gives on the only driver's coordinate, at its rate."""
    return -found(equation, ["h:driver"], {"q:driver": q, "qd:driver": w, "time": time})[0]


def inertia(equation: EquationOfMotion) -> float:
    """The inertia (kg·m² or kg) of the only driver's coordinate."""
    return found(equation, ["M:driver:driver"], {})[0]
