"""A slider-crank that two parameters scale."""

SCALED = """
format: 1
name: scaled slider-crank
parameters: {r: 50 mm, ratio: 4}
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: r}
  rod: {points: [A, B], length: ratio*r}
  piston: {points: [B]}
joints:
  cylinder: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}
driver: {turn: crank, about: O, speed: 10 rad/s}
"""
