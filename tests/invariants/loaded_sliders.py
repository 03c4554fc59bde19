"""A slider-crank under laws of every kind with loads of every kind, a five-bar with two cranks and a triad."""

from tests.store import text

import linkwright as lw

SLIDER = """
format: 1
name: slider-crank
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 1 m}
  rod: {points: [A, B], length: 3 m}
  piston: {points: [B]}
joints: {cylinder: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}}
driver: {turn: crank, about: O, speed: SPEED}
loads:
  work: LOAD
"""
TO_AND_FRO, UNEVEN, SEVERAL_TURNS = (
    'position: "2 rad*sin(3*t/(1 s))"',
    'position: "3 rad*t/(1 s) + 0.3 rad*sin(t/(1 s))"',
    "speed: 10 rad/s",
)
LOADS = {
    "interval": "ramp: [3 N, 18 N], phase: {input: [30 deg, 200 deg]}",
    "expression": 'magnitude: "3 N*sin(input) + 2 N/m*B.x + 1 N*t/(1 s) + 2 N*rod/rad"',
    "one way": "magnitude: 7 N, phase: {moving: B.x, direction: decreasing}",
    "table over the input": "table: {over: input, x: [0 deg, 90 deg, 360 deg], y: [1 N, 9 N, 1 N]}",
    "table over the time": "table: {over: time, x: [0 s, 1 s, 4 s], y: [1 N, 9 N, 1 N]}",
    "table over an output": "table: {over: cylinder, x: [1 m, 3 m, 4.5 m], y: [1 N, 9 N, 1 N]}",
    "smooth table over an output": "table: {over: cylinder, x: [1 m, 2.4 m, 3 m, 4.5 m], y: [1 N, 2 N, 9 N, 1 N],"
    " interpolation: cubic}",
    "periodic table over the input": "table: {over: input, x: [0 deg, 90 deg, 200 deg, 360 deg],"
    " y: [1 N, 9 N, 2 N, 1 N], interpolation: periodic}",
}
#: The rod's angle goes once from its smallest value to its largest one; in several turns it does so in every turn.
ONE_WAY = (UNEVEN, SEVERAL_TURNS)
BETWEEN_LIMITS = {
    "stroke": "magnitude: 7 N, phase: {of: rod, from: min, to: max}",
    "ramp": "ramp: [3 N, 18 N], phase: {of: rod, from: min, to: max}",
    "ramp of a velocity": "ramp: [3 N, 18 N], phase: {moving: rod, direction: increasing}",
    "part of a stroke": "magnitude: 7 N, phase: {of: rod, from: min, to: max, first: 10 deg}",
}
TWO_DRIVERS = """
format: 1
name: five-bar with two cranks
frame: {points: {O: [0 m, 0 m], Q: [2 m, 0 m]}}
links:
  left: {points: [O, A], length: 1 m}
  right: {points: [Q, B], length: 0.8 m}
  rod: {points: [A, P], length: 3 m}
  arm: {points: [B, P], length: 2.5 m}
assembly: {P: left}
drivers:
  first: {turn: left, about: O, speed: 10 rad/s}
  second: {turn: right, about: Q, speed: -20 rad/s}
loads:
  work: {kind: force, on: rod, at: P, direction: 0 deg, magnitude: "3 N*sin(input) + 2 N/m*P.y + 1 N*rod/rad"}
"""


def machine(law: str, load: str) -> lw.Mechanism:
    text = SLIDER.replace("loads:", "cycle: {duration: 1.5 s}\nloads:").replace("speed: SPEED", law)
    return lw.loads(text.replace("LOAD", f"{{kind: force, on: piston, at: B, direction: 0 deg, {load}}}"))


#: Loads on the plate of a triad, which Newton's method places.
ON_THE_PLATE = (
    'at: R, direction: 30 deg, magnitude: "20 N + 400 N/m*R.x + 9 N*sin(plate)"',
    "at: R, direction: 30 deg, ramp: [40 N, 10 N], phase: {input: [330 deg, 130 deg]}",
    "at: R, direction: 30 deg, table: {over: input, x: [0 deg, 90 deg, 360 deg], y: [1 N, 30 N, 1 N]}",
    "at: R, direction: 30 deg, table: {over: time, x: [0 s, 0.2 s, 1 s], y: [1 N, 30 N, 8 N]}",
    "at: R, opposes: velocity, magnitude: 30 N",
    "at: R, direction: 30 deg, magnitude: 30 N, phase: {moving: R.x, direction: increasing}",
)


def pushed_triad(load: str) -> lw.Mechanism:
    return lw.loads(
        text("triad").replace("gravity:", f"loads: {{work: {{kind: force, on: plate, {load}}}}}\ngravity:")
    )
