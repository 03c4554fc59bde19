"""Machines whose results are checked: a press with a slotted lever, and a four-bar with links of any names."""

MODEL = """
format: 1
name: slotted press
frame: {points: {O: [0 m, 0 m], Q: [0 m, -0.4 m], R: [0 m, 0.5 m]}}
links:
  crank: {points: [O, A], length: 0.15 m, mass: 2 kg, inertia: 0.01 kg·m²}
  die: {points: [A], mass: 1 kg}
  lever: {points: [Q, B], length: 0.8 m, mass: 5 kg, inertia: 0.3 kg·m²}
  rod: {points: [B, C], length: 0.5 m, mass: 3 kg, inertia: 0.1 kg·m²}
  ram: {points: [C], mass: 8 kg}
joints:
  slot: {kind: prismatic, guide: lever, through: Q, direction: [Q, B], block: die, at: A}
  bed: {kind: prismatic, guide: frame, through: R, direction: 0 deg, block: ram, at: C}
drawing: {A: [0.15 m, 0 m], B: [0.28 m, 0.35 m], C: [0.75 m, 0.5 m]}
driver: {turn: crank, about: O, speed: 6 rad/s}
gravity: [0, -9.81 m/s²]
loads: {work: {kind: force, on: ram, at: C, components: [-300 N, 0 N]}}
"""
FALSIFIED = """
format: 1
name: falsified four-bar
frame: {points: {O: [0 m, 0 m], Q: [0.9 m, 0 m]}}
links:
  falsified_crank: {points: [O, A], length: 0.2 m, mass: 2 kg, inertia: 0.01 kg·m²}
  falsified_rod: {points: [A, B], length: 0.8 m, mass: 3 kg, inertia: 0.1 kg·m²}
  falsified_lever: {points: [Q, B], length: 0.6 m, mass: 5 kg, inertia: 0.3 kg·m²}
assembly: {B: left}
driver: {turn: falsified_crank, about: O, speed: 6 rad/s}
loads: {work: {kind: torque, on: falsified_lever, magnitude: 90 N·m}}
"""
