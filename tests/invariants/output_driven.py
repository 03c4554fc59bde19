"""Stephenson's third six-bar driven at its output, a triad, with more bars on it where they are wanted."""

from __future__ import annotations

from math import cos, degrees, radians, sin, sqrt

import linkwright as lw

TRIAD = """
format: 1
frame: {points: {O1: [0 mm, 0 mm], O2: [200 mm, 0 mm], O3: [300 mm, 200 mm]MORE}}
links:
  crank: {points: [O1, A], length: 50 mm}
  coupler: {points: [A, B], length: 180 mm, also: {C: [110 mm, 70 mm]}}
  rocker: {points: [O2, B], length: 130 mm}
  bar: {points: [C, D], length: 190 mm}
  output: {points: [O3, D], length: 140 mm, also: {E: [60 mm, 0 mm]}}
  LINKS
drawing: {A: [-47.0 mm, 17.1 mm], B: [114.0 mm, 97.5 mm], C: [20.1 mm, 128.9 mm], D: [168.4 mm, 247.7 mm]}
ASSEMBLY
driver: {turn: DRIVEN, position: "START deg + 15 deg*sin(2*pi*t/(2 s))"}
cycle: {duration: 2 s}
"""


def triad(links: str, more: str, assembly: str, driven: str = "output, about: O3", start: float = 160) -> str:
    text = TRIAD.replace("LINKS", links).replace("MORE", more).replace("ASSEMBLY", assembly)
    return text.replace("DRIVEN", driven).replace("START", f"{start}")


def turned(radius: float, angle: float) -> tuple[float, float]:
    """A place at a distance (mm) and an angle (deg) from O3."""
    return 300 + radius * cos(radians(angle)), 200 + radius * sin(radians(angle))


def tied(end: float, side: int, begin: float = 160) -> lw.Mechanism:
    """The triad with two bars from D to the frame that are stretched with the output at ``end``, rad."""
    far = degrees(end) - side * 75
    x, y = turned(300, far)
    reach = sqrt(140**2 + 300**2 - 2 * 140 * 300 * cos(radians(75)))
    links = (
        f"arm: {{points: [D, F], length: {0.5 * reach!r} mm}}\n  leg: {{points: [O5, F], length: {0.5 * reach!r} mm}}"
    )
    return lw.loads(triad(links, f", O5: [{x!r} mm, {y!r} mm]", "assembly: {F: left}", start=begin))


def turning(speed: float) -> str:
    """The six-bar whose output turns at a speed, rad/s."""
    law = f"driver: {{turn: output, about: O3, speed: {speed} rad/s, start: 160 deg}}\n"
    return triad("", "", "").split("driver:", maxsplit=1)[0].replace("format: 1", "format: 1\nname: six-bar") + law
