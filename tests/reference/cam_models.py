"""Cams as joints of a mechanism, as model files, with a guided and with an oscillating follower."""

from __future__ import annotations

import math

import linkwright as lw

PROGRAM = """
      - {rise: LIFT, over: 110 deg, law: cycloidal}
      - {dwell: 60 deg}
      - {fall: LIFT, over: 100 deg, law: {kind: modified_sine, crossover: 0.45}}
      - {dwell: 90 deg}"""
GUIDED = """
format: 1
name: guided follower
frame: {points: {O: [0 mm, 0 mm], G: [OFFSET, 0 mm]}}
links:
  cam: {points: {O: [0 mm, 0 mm], X: [30 mm, 0 mm]}, mass_centre: [0 mm, 0 mm], mass: 1 kg, inertia: 0.001 kg·m²}
  slide: {points: {P: [0 mm, 0 mm], Q: [0 mm, 40 mm]}, mass: 0.5 kg, inertia: 0.001 kg·m²}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 90 deg, block: slide, at: P, block_angle: 90 deg}
  lobe:
    kind: cam
    cam: cam
    follower: slide
    at: P
    touch: TOUCH
    base_radius: 50 mm
    phase: 20 deg
    turn: SENSE
    program: PROGRAM
driver: {turn: cam, about: O, speed: SPEED}
gravity: [0, -9.81 m/s²]
loads: {spring: {kind: force, on: slide, at: P, direction: -90 deg, magnitude: 60 N}}
"""
SWINGING = """
format: 1
name: oscillating follower
frame: {points: {O: [0 mm, 0 mm], A: [160 mm, 0 mm]}}
links:
  cam: {points: {O: [0 mm, 0 mm], X: [30 mm, 0 mm]}, mass_centre: [0 mm, 0 mm], mass: 1 kg, inertia: 0.001 kg·m²}
  arm: {points: [A, P], length: 130 mm, mass: 0.4 kg, inertia: 0.002 kg·m², mass_centre: [0 mm, 0 mm]}
joints:
  lobe:
    kind: cam
    cam: cam
    follower: arm
    at: P
    touch: TOUCH
    side: SIDE
    base_radius: 70 mm
    turn: SENSE
    program: PROGRAM
driver: {turn: cam, about: O, speed: SPEED}
loads: {spring: {kind: torque, on: arm, magnitude: MOMENT}}
"""
SPEED = 2 * math.pi * 1.5


def model(text: str, sense: str, touch: str, lift: str, **values: str) -> str:
    """The file for a sense of turning and a kind of contact."""
    speed = "90 rpm" if sense == "counterclockwise" else "-90 rpm"
    roller = "roller\n    roller_radius: 10 mm" if touch == "roller" else touch
    given = {"PROGRAM": PROGRAM, "SENSE": sense, "SPEED": speed, "TOUCH": roller, "LIFT": lift, **values}
    for key, value in given.items():
        text = text.replace(key, value)
    return text


def follower(touch: str, **values: object) -> lw.Follower:
    return lw.Follower(touch, roller_radius=0.01 if touch == "roller" else 0.0, **values)  # type: ignore[arg-type]
