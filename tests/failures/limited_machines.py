"""Machines that cannot go everywhere: four-bars of any lengths, a triad driven at its output, a triple rocker."""

from __future__ import annotations

import linkwright as lw


def fourbar(a: float, b: float, c: float, d: float, *, start: float = 0.0, cycle: str = "") -> lw.Mechanism:
    return lw.loads(f"""
format: 1
name: four-bar
frame: {{points: {{O1: [0 m, 0 m], O2: [{d} m, 0 m]}}}}
links:
  crank: {{points: [O1, A], length: {a} m}}
  coupler: {{points: [A, B], length: {b} m}}
  rocker: {{points: [O2, B], length: {c} m}}
assembly: {{B: left}}
driver: {{turn: crank, about: O1, speed: 1 rad/s, start: {start} deg}}
{cycle}
""")


TRIAD = """
format: 1
frame: {points: {O1: [0 mm, 0 mm], O2: [200 mm, 0 mm], O3: [300 mm, 200 mm]}}
links:
  crank: {points: [O1, A], length: 50 mm}
  coupler: {points: [A, B], length: 180 mm, also: {C: [110 mm, 70 mm]}}
  rocker: {points: [O2, B], length: 130 mm}
  bar: {points: [C, D], length: 190 mm}
  output: {points: [O3, D], length: 140 mm}
drawing: {A: [-47.0 mm, 17.1 mm], B: [114.0 mm, 97.5 mm], C: [20.1 mm, 128.9 mm], D: [168.4 mm, 247.7 mm]}
driver: {turn: output, about: O3, speed: SPEED rad/s, start: START deg}
cycle: {duration: 0.3 s}
"""
#: The largest angle of the output that the crank gives, to 1e-9 rad.
FOLD = 3.215568041626


def triad(start: float, speed: float = 1.0) -> lw.Mechanism:
    return lw.loads(TRIAD.replace("START", f"{start}").replace("SPEED", f"{speed}"))


TRIPLE_ROCKER = """
format: 1
name: triple rocker
frame: {{points: {{O1: [0 m, 0 m], O2: [{x!r} m, {y!r} m]}}}}
links:
  crank: {{points: [O1, A], length: 2.6 m}}
  coupler: {{points: [A, B], length: 2 m}}
  rocker: {{points: [O2, B], length: 2.2 m}}
assembly: {{B: left}}
driver: {{turn: crank, about: O1, speed: 10 rpm, start: {start!r} rad}}
"""

#: A crank that swings by a law without constant speed.
SWUNG = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 1 m}
  coupler: {points: [A, B], length: 3 m}
  rocker: {points: [O2, B], length: 2.5 m}
assembly: {B: left}
driver: {turn: crank, about: O1, position: "70 deg + 65 deg*sin(2*pi*t/(3 s))"}
cycle: {duration: 3 s}
"""
