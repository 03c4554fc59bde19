"""Largest values of machines with a fast shaft, whose many peaks are nearly equal: no position is higher."""

import numpy as np
import pytest

import linkwright as lw

DENSE = 36000
MACHINE = """
format: 1
frame:
  points: {{O1: [0 mm, 0 mm], O2: [220 mm, 0 mm]}}
links:
  crank_1: {{points: [O1, A], length: {slow} mm, mass: 1.6 kg, inertia: 0.0002 kg·m²}}
  crank_2: {{points: [O2, B], length: {fast} mm, mass: 0.5 kg, inertia: 0.0001 kg·m²}}
  bar_1: {{points: [A, C], length: {first} mm, mass: 1.8 kg, inertia: 0.0041 kg·m²}}
  bar_2: {{points: [B, C], length: {second} mm, mass: 1.2 kg, inertia: 0.0045 kg·m²}}
joints:
  mesh: {{kind: gear, links: [crank_1, crank_2], teeth: [200, 20], module: 2 mm, phase: {phase} deg}}
assembly: {{C: left}}
driver: {{turn: crank_1, about: O1, speed: 60 rpm}}
gravity: [0, -9.81 m/s²]
loads:
  work: {{kind: force, on: bar_2, at: C, components: [-2.3 N, -7 N]}}
"""


@pytest.mark.parametrize("seed", range(8))
def test_no_position_is_beyond_the_largest_values(seed):
    random = np.random.default_rng(seed)
    sizes = {
        "slow": random.uniform(0.05, 2.0) if seed % 2 else random.uniform(20.0, 40.0),
        "fast": random.uniform(5.0, 12.0),
        "first": random.uniform(170.0, 200.0),
        "second": random.uniform(170.0, 200.0),
        "phase": random.uniform(0.0, 360.0),
    }
    mechanism = lw.loads(MACHINE.format(**sizes))
    table, dense = lw.metrics(lw.solve_forces(mechanism, steps=60)), lw.solve_forces(mechanism, steps=DENSE)
    signals = {
        ("peak_input_torque", "driver"): np.abs(dense.input_torque),
        ("peak_shaking_force", "frame"): np.hypot(*dense.shaking_force.T),
        ("peak_shaking_moment", "frame"): np.abs(dense.shaking_moment),
    }
    for name, joint in mechanism.joints.items():
        signals["peak_reaction", name] = np.hypot(*dense.reaction(name, on=joint.joined[0]).T)
    for key, values in signals.items():
        found = table[key]
        assert found.exact
        assert values.max() <= found.value * (1 + 1e-9), key
        assert values.max() >= found.value * (1 - 1e-3), key  # a jump lies between two positions
