"""A triad whose first bar slides on its plate."""

SLOTTED = """format: 1
name: Triad with a slot
frame: {points: {O1: [0 mm, 0 mm], O2: [130 mm, -210 mm], O3: [360 mm, 90 mm]}}
links: {crank: {points: [O1, A]}, bar: {points: [A, E]}, bar_2: {points: [O2, Q]}, bar_3: {points: [O3, R]},
  plate: {points: [P, Q, R]}}
drawing: {A: [30 mm, 0 mm], P: [210 mm, 90 mm], Q: [190 mm, -10 mm], R: [235 mm, 5 mm], E: [210 mm, 90 mm]}
joints: {slot: {kind: prismatic, guide: bar, through: A, direction: [A, E], block: plate, at: P}}
driver: {turn: crank, about: O1, speed: 10 rad/s}
"""
