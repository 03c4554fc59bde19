"""Four-bars by their sides, and many of them one behind the other."""

from __future__ import annotations

import linkwright as lw


def fourbar(a: float, b: float, c: float, d: float, *, start: float, mode: str = "left") -> lw.Mechanism:
    """Crank a, coupler b, rocker c and frame d, m; the crank begins at a start, deg."""
    return lw.loads(f"""
format: 1
name: four-bar
frame: {{points: {{O1: [0 m, 0 m], O2: [{d} m, 0 m]}}}}
links:
  crank: {{points: [O1, A], length: {a} m}}
  coupler: {{points: [A, B], length: {b} m}}
  rocker: {{points: [O2, B], length: {c} m}}
assembly: {{B: {mode}}}
driver: {{turn: crank, about: O1, speed: 1 rad/s, start: {start} deg}}
""")


def four_bars(count: int) -> lw.Mechanism:
    """Four-bars one behind the other: the rocker of each moves the coupler of the next."""
    bars = range(1, count + 1)
    links = [
        f"  rod{k}: {{points: [P{k - 1}, P{k}], length: {0.4 if k > 1 else 0.35} m, mass: 0.5 kg, "
        "inertia: 0.01 kg·m²}\n"
        f"  rocker{k}: {{points: [Q{k}, P{k}], length: 0.3 m, mass: 0.8 kg, inertia: 0.01 kg·m²}}\n"
        for k in bars
    ]
    return lw.loads(f"""
format: 1
name: four-bars
frame: {{points: {{O: [0 m, 0 m], {", ".join(f"Q{k}: [{0.4 * k} m, -0.3 m]" for k in bars)}}}}}
links:
  crank: {{points: [O, P0], length: 0.05 m}}
{"".join(links)}
drawing: {{P0: [0.05 m, 0 m], {", ".join(f"P{k}: [{0.4 * k} m, 0 m]" for k in bars)}}}
driver: {{turn: crank, about: O, speed: 9 rad/s}}
gravity: [0, -9.81 m/s²]
loads: {{work: {{kind: torque, on: rocker{count}, magnitude: -3 N·m}}}}
""")
