"""A ram driven on ways that are no whole number of turns, with loads that go by its velocity or its limits."""

import numpy as np

import linkwright as lw

#: An offset slider-crank without masses, whose ram turns back at another time in every design.
RAM = """
format: 1
name: ram
frame: {points: {O: [0 m, 0 m], Y: [0 m, -0.02 m]}}
links:
  crank: {points: [O, A], length: 0.05 m}
  rod: {points: [A, B], length: 0.16 m}
  ram: {points: [B]}
joints: {guide: {kind: prismatic, guide: frame, through: Y, direction: 0 deg, block: ram, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, LAW}
cycle: {CYCLE}
loads: {work: {kind: force, on: ram, at: B, LOAD}}
"""

#: Laws with their cycles, the time that these take, s, and the angles, rad, between which the crank goes one way.
COURSES = {
    "expression": (
        'position: "3 rad*t/(1 s) + 0.3 rad*sin(t/(1 s))"',
        "duration: 1.5 s",
        1.5,
        [0.0, 4.5 + 0.3 * np.sin(1.5)],
    ),
    "to and fro": (
        'position: "2.5 rad + 1.2 rad*sin(3*t/(1 s))"',
        "duration: 2 s",
        2.0,
        [2.5, 3.7, 1.3, 2.5 + 1.2 * np.sin(6.0)],
    ),
    "part of a turn": ("speed: 3 rad/s", "from: 0.3 rad, to: 4.5 rad", 1.4, [0.3, 4.5]),
    "table": (
        "table: {time: [0 s, 0.5 s, 1.2 s, 2 s], position: [0 rad, 1.1 rad, 3.1 rad, 5 rad], interpolation: cubic}",
        "duration: 2 s",
        2.0,
        [0.0, 5.0],
    ),
    "program": (
        "program: [{rise: 4 rad, over: 0.7 s, law: modified_sine}, {dwell: 0.2 s}, {fall: 4 rad, over: 1.1 s}]",
        "duration: 2 s",
        2.0,
        [0.0, 4.0, 0.0],
    ),
}


def ram(course: str, load: str) -> lw.Mechanism:
    law, cycle, *_ = COURSES[course]
    return lw.loads(RAM.replace("LAW", law).replace("CYCLE", cycle).replace("LOAD", load))


#: Laws with their cycles, the time that these take, s, and the angles, rad, that the crank has gone through in order
#: when it has gone inwards as far as it does.
INWARDS = {
    "expression": (
        'position: "-0.5 rad + 3 rad*t/(1 s) + 0.3 rad*sin(t/(1 s))"',
        "duration: 1.6 s",
        1.6,
        (-0.5, 4.3),
    ),
    "part of a turn": ("speed: 3 rad/s", "from: 0.3 rad, to: 4.5 rad", 1.4, (0.3, 4.5)),
    "table": (
        "table: {time: [0 s, 0.5 s, 1.2 s, 2 s], position: [-0.5 rad, 1.1 rad, 3.1 rad, 5.2 rad], "
        "interpolation: cubic}",
        "duration: 2 s",
        2.0,
        (-0.5, 5.2),
    ),
    "program": (
        "program: [{rise: 2.6 rad, over: 0.7 s, law: modified_sine}, {dwell: 0.2 s}, {fall: 2.6 rad, over: 1.1 s}]",
        "duration: 2 s",
        2.0,
        (0.0, 2.6),
    ),
}

#: Loads between the outermost and the innermost place of the ram, with the forces, N, with which they begin and end.
BETWEEN = {
    "magnitude: 100 N, phase: {of: guide, from: max, to: min}": (100.0, 100.0),
    "ramp: [10 N, 100 N], phase: {of: guide, from: max, to: min}": (10.0, 100.0),
    "ramp: [100 N, 0 N], phase: {moving: guide, direction: decreasing}": (100.0, 0.0),
    "magnitude: 100 N, phase: {of: guide, from: max, to: min, last: 20 mm}": None,
}
