"""A press with loads of every kind, its crank turned directly and by a motor through wheels."""

import linkwright as lw

MODEL = """
format: 1
name: press
parameters: {F0: 900 N, k: 3000 N/m, unused: 1 N}
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.2 m, mass: 1 kg, inertia: 0.01 kg·m²}
  rod: {points: [A, B], length: 0.7 m, mass: 2 kg, inertia: 0.05 kg·m²}
  piston: {points: [B], mass: 3 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B, offset: 0.05 m}}
driver: {turn: crank, about: O, speed: 120 rpm, start: 20 deg}
loads:
  process: {LOAD}
  weight_of_what_is_pressed: {kind: force, on: piston, at: B, direction: -90 deg, magnitude: F0 + k*(0.1 m)}
"""
AT = "kind: force, on: piston, at: B, direction: 180 deg"
LOADS = {
    "while moving": f"{AT}, magnitude: 800 N, phase: {{moving: guide, direction: increasing}}",
    "ramp while moving": f"{AT}, ramp: [100 N, 900 N], phase: {{moving: guide, direction: decreasing}}",
    "between limits": f"{AT}, magnitude: F0, phase: {{of: guide, from: min, to: max}}",
    "last share": f"{AT}, magnitude: 800 N, phase: {{of: guide, from: min, to: max, last: 0.2}}",
    "first way": f"{AT}, ramp: [100 N, 900 N], phase: {{of: guide, from: max, to: min, first: 60 mm}}",
    "whole share": f"{AT}, ramp: [100 N, 900 N], phase: {{of: guide, from: max, to: min, first: 1}}",
    "free ends": f"{AT}, magnitude: 800 N, phase: {{of: guide, from: min, to: max, free: [0.05, 30 mm]}}",
    "free at its end": f"{AT}, magnitude: 800 N, phase: {{of: guide, from: min, to: max, free: [0, 30 mm]}}",
    "input": f"{AT}, magnitude: 800 N, phase: {{input: [150 deg, 30 deg]}}",
    "displacement": f"{AT}, magnitude: F0 + k*guide",
    "angle": f"{AT}, magnitude: F0*(1 + sin(rod)) + 100 N*cos(3*input)",
    "time": f"{AT}, magnitude: F0*t/(1 s)",
    "table": f"{AT}, table: {{over: input, x: [0 deg, 90 deg, 200 deg, 360 deg], y: [0 N, 500 N, 900 N, 0 N]}}",
    "table from within the turn": f"{AT}, table: {{over: input, x: [30 deg, 90 deg, 200 deg, 390 deg], "
    "y: [0 N, 500 N, 900 N, 0 N]}",
    "short ramp": f"{AT}, ramp: [100 N, 900 N], phase: {{input: [-30 deg, 20 deg]}}",
    "table of output": f"{AT}, table: {{over: guide, x: [300 mm, 600 mm, 700 mm, 1 m], y: [0 N, 500 N, 900 N, 0 N]}}",
    "torsion spring": "kind: torsion_spring, links: [frame, rod], stiffness: 30 N·m/rad, free_angle: 10 deg",
}
OTHER_WAY = {
    **{
        name: LOADS[name]
        for name in ("while moving", "ramp while moving", "last share", "free ends", "input", "table")
    },
    "limits of an angle": f"{AT}, magnitude: 800 N, phase: {{of: rod, from: max, to: min}}",
    "last degrees": f"{AT}, ramp: [100 N, 900 N], phase: {{of: rod, from: min, to: max, last: 4 deg}}",
    "limits across": f"{AT}, magnitude: 800 N, phase: {{of: rod.A.y, from: min, to: max}}",
    "first way along": f"{AT}, magnitude: 800 N, phase: {{of: rod.B.x, from: min, to: max, first: 90 mm}}",
}
#: A motor without mass that turns the crank through wheels, three times as fast and the other way.
GEARED = (
    MODEL.replace("frame: {points: {", "frame: {points: {M: [-0.4 m, 0 m], ")
    .replace("links:\n", "links:\n  motor: {points: [M]}\n")
    .replace("joints: {", "joints: {gears: {kind: gear, links: [motor, crank], teeth: [20, 60]}, ")
    .replace("{turn: crank, about: O, speed: 120 rpm", "{turn: motor, about: M, speed: 360 rpm")
)
BY_LIMITS = ("ramp while moving", "last share", "free ends")


def machine(load: str) -> lw.Mechanism:
    return lw.loads(MODEL.replace("LOAD", LOADS[load]))
