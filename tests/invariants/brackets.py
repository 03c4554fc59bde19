"""Bars on two pins of a crank, with friction in joints that never move."""

BRACKET = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: {O: [0 m, 0 m], P: [0.3 m, 0 m], Q: [0.5 m, 0.1 m]}}
  bar_1: {points: [P, T], length: 0.3 m}
  bar_2: {points: [Q, T], length: 0.25 m, mass: 5 kg, inertia: 0.05 kg·m²}
joints:
  P: {kind: revolute, pin_radius: 20 mm, friction: 0.3}
  Q: {kind: revolute, pin_radius: 20 mm, friction: 0.3}
  T: {kind: revolute, pin_radius: 20 mm, friction: 0.3}
assembly: {T: left}
driver: {turn: crank, about: O, speed: 60 rpm}
gravity: [0, -9.81 m/s²]
"""
