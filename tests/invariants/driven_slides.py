"""A slide driven by any law, and a crank with an arm that turns on it."""

import linkwright as lw

SLIDE = """
format: 1
name: driven slide
frame: {{points: {{O: [0 m, 0 m]}}}}
links: {{slide: {{points: [A]}}}}
joints: {{guide: {{kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slide, at: A}}}}
driver: {{slide: guide, {law}}}
cycle: {{duration: 2 s}}
"""
ARM = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, C], length: 1 m}, arm: {points: [C, T], length: LENGTH m}}
drivers:
  spin: {turn: crank, about: O, speed: SPEED rad/s, start: START deg}
  wrist: {turn: arm, about: C, speed: SPEED rad/s, start: START deg}
"""


def driven(law: str) -> lw.Mechanism:
    return lw.loads(SLIDE.format(law=law))
