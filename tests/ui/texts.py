"""Models that pages are made of, beside those of the gallery."""

from __future__ import annotations

from tests import store

GEARED = """\
format: 1
name: Geared five-bar
frame:
  points: {A: [0 mm, 0 mm], E: [200 mm, 0 mm]}
links:
  first: {points: [A, B], length: 50 mm, mass: 1 kg}
  second: {points: [E, D], length: 50 mm, mass: 1 kg}
  left: {points: [B, C], length: 180 mm, mass: 2 kg}
  right: {points: [D, C], length: 180 mm, mass: 2 kg}
joints:
  mesh: {kind: gear, links: [first, second], ratio: -1, carrier: frame}
drawing: {B: [0 mm, 50 mm], D: [200 mm, 50 mm], C: [100 mm, 199.66629547095765 mm]}
driver: {turn: first, about: A, speed: 60 rpm}
"""
FOURBAR = """format: 1
frame:
  points: {O1: [0 mm, 0 mm], O2: [200 mm, 0 mm]}  # on the base
drawing: {A: [30 mm, 40 mm], B: [160 mm, 120 mm]}
links:
  crank: {points: [O1, A]}
  coupler: {points: [A, B]}
  rocker: {points: [B, O2]}  # of steel
driver: {turn: crank, about: O1, speed: 60 rpm}
"""
#: Loads that no cycle program finds beforehand: a file of the gallery, its loads, changes.
PER_POSITION = (
    ("printing_press", None, {"rod.length": 0.71, "loads.impression.magnitude": 2000.0}),
    (
        "triad",
        "{kind: torque, on: plate, ramp: [1 N·m, 9 N·m], phase: {of: plate, from: max, to: min}}",
        {"plate.Q.x": 0.0805, "driver.speed": 8.0},
    ),
    (
        "triad",
        "{kind: force, on: bar_3, at: R, direction: 30 deg, magnitude: 5 N,"
        " phase: {of: R.x, from: min, to: max, free: [0.1, 4 mm]}}",
        {"plate.Q.x": 0.0805},
    ),
    ("triad", "{kind: torsion_spring, links: [crank, bar_1], stiffness: 2 N·m/rad}", {"plate.Q.x": 0.0805}),
    ("triad", "{kind: torque, on: bar_2, magnitude: 0.2 N·m/rad * bar_2}", {"plate.Q.x": 0.0805}),
    (
        "geared_fivebar_third",
        "{kind: torque, on: crank_2, ramp: [2 N·m, 6 N·m], phase: {moving: C.x, direction: increasing}}",
        {"bar_1.length": 0.215},
    ),
    (
        "geared_fivebar_third",
        "{kind: torque, on: bar_2, ramp: [0 N·m, 3 N·m], phase: {input: [300 deg, 40 deg]}}",
        {"bar_1.length": 0.215},
    ),
    (
        "slider_crank_inline",
        "{kind: force, on: piston, at: B, direction: 180 deg,"
        " table: {over: input, x: [0 deg, 70 deg, 200 deg, 360 deg], y: [0 N, 900 N, 100 N, 0 N]}}",
        {"rod.length": 0.21},
    ),
    (
        "slider_crank_inline",
        "{kind: force, on: piston, at: B, direction: 180 deg, table: {over: input, interpolation: periodic,"
        " x: [0 deg, 70 deg, 200 deg, 360 deg], y: [0 N, 900 N, 100 N, 0 N]}}",
        {"rod.length": 0.21},
    ),
    (
        "triad",
        "{kind: torque, on: bar_2, table: {over: input, x: [0 deg, 90 deg, 360 deg], y: [0 N·m, 2 N·m, 0 N·m]}}",
        {"plate.Q.x": 0.0805},
    ),
    (
        "planetary_two_inputs",
        "{kind: torque, on: carrier, magnitude: -9 N·m, phase: {moving: A.x, direction: increasing}}",
        {"carrier.mass": 2.5},
    ),
    (
        "dyad_rrr",
        "{kind: force, on: bar_1, at: B, direction: 30 deg, ramp: [5 N, 50 N],"
        " phase: {of: B.x, from: max, to: min, last: 0.3}}",
        {"bar_1.length": 0.152},
    ),
    (
        "stephenson_sixbar_triad",
        "{kind: torque, on: rocker, ramp: [5 N·m, 50 N·m], phase: {of: rocker, from: max, to: min}}",
        {"frame.O2.x": 0.202},
    ),
    (
        "double_slider",
        "{kind: force, on: bar, at: P, direction: 30 deg, ramp: [5 N, 50 N], phase: {of: wall, from: min, to: max}}",
        {"foot.mass": 2.1},
    ),
)
#: Numbers of pairs of PER_POSITION by what they are.
RAMP_ON_A_TRIAD, PART_OF_A_STROKE, ANGLE_THAT_TURNS, SEVERAL_TURNS = 1, 2, 3, 5
#: The shaper with a guide's and a pin's friction.
FRICTION = (
    store.text("shaper_quick_return")
    .replace("offset: 528.5 mm}", "offset: 528.5 mm, friction: 0.1}")
    .replace("joints:\n", "joints:\n  O3: {kind: revolute, friction: 0.15, pin_radius: 20 mm}\n", 1)
)


def with_load(name: str, load: str | None) -> str:
    """A gallery file with one more load."""
    text = store.text(name)
    if load is None:
        return text
    if "\nloads:" in text:
        return text.replace("loads:\n", f"loads:\n  extra: {load}\n")
    return text + f"loads:\n  extra: {load}\n"
