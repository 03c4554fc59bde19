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


@pytest.mark.rotating
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


GEARED = """
format: 1
frame:
  points: {{O1: [0 mm, 0 mm], O2: [{distance} mm, 0 mm]}}
links:
  first: {{points: [O1, A], length: 20 mm}}
  second: {{points: [O2, B], length: 15 mm}}
  rod_1: {{points: [A, C], length: 70 mm}}
  ram: {{points: [C], mass: 2 kg}}
  rod_2: {{points: [B, D], length: 60 mm}}
  piston: {{points: [D]}}
joints:
  mesh: {{kind: gear, links: [first, second], teeth: [{teeth}, {others}], module: 2 mm}}
  way: {{kind: prismatic, guide: frame, through: O1, direction: 95 deg, block: ram, at: C, offset: 2 mm}}
  guide: {{kind: prismatic, guide: frame, through: O2, direction: 80 deg, block: piston, at: D, offset: 3 mm}}
assembly: {{C: forward, D: forward}}
driver: {{turn: first, about: O1, speed: 60 rpm}}
"""


@pytest.mark.rotating
@pytest.mark.parametrize(("teeth", "others"), [(20, 361), (361, 360), (97, 101)])
@pytest.mark.parametrize("steps", [12, 360])
def test_numbers_of_a_cycle_of_hundreds_of_turns(teeth, others, steps):
    """Each crank turns hundreds of times between few positions, at best at the same place each time."""
    model = lw.loads(GEARED.format(distance=teeth + others, teeth=teeth, others=others))
    table = lw.metrics(lw.solve_motion(model, steps=steps))
    for guide, crank, rod, offset, rate in (("way", 20, 70, 2, 1.0), ("guide", 15, 60, 3, teeth / others)):
        stroke = np.sqrt((rod + crank) ** 2 - offset**2) - np.sqrt((rod - crank) ** 2 - offset**2)
        assert table.value("stroke", guide) == pytest.approx(1e-3 * stroke, rel=1e-9)
        angle = np.linspace(0.0, 2 * np.pi, 20001)
        place = crank * np.cos(angle) + np.sqrt(rod**2 - (crank * np.sin(angle) - offset) ** 2)
        bend = np.gradient(np.gradient(place, angle), angle)[2:-2]
        largest = 1e-3 * np.abs(bend).max() * (2 * np.pi * rate) ** 2
        assert table.value("peak_acceleration", guide) == pytest.approx(largest, rel=1e-6)
        turns = sum(row.metric == "limit_position" and row.subject.startswith(guide) for row in table.rows)
        assert turns == 2 * (others if guide == "way" else teeth) // np.gcd(teeth, others)


TURNED_FAR = """
format: 1
frame:
  points: {O: [0 mm, 0 mm]}
links:
  crank: {points: [O, A], length: 20 mm}
  rod: {points: [A, C], length: 70 mm}
  ram: {points: [C]}
joints:
  way: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: ram, at: C, offset: 0 mm}
assembly: {C: forward}
driver: {turn: crank, about: O, position: "300 rad*(t/(2 s) - sin(pi*t/(1 s))/(2*pi))"}
cycle: {duration: 2 s}
"""


@pytest.mark.parametrize("steps", [12, 60, 360])
def test_a_crank_that_a_law_turns_far_between_two_positions_shows_all_its_limits(steps):
    """The ram reverses at every half turn of the crank, whose angle grows from 0 to 300 rad."""
    motion = lw.solve_motion(lw.loads(TURNED_FAR), steps=steps)
    limits = lw.limit_positions(motion, "way")
    angles = [limit.input for limit in limits]
    assert angles == pytest.approx(np.pi * np.arange(1, int(300 / np.pi) + 1), rel=1e-12)
    time = np.linspace(0.0, 2.0, 400001)
    crank = 300 * (time / 2 - np.sin(np.pi * time) / (2 * np.pi))
    place = 0.02 * np.cos(crank) + np.sqrt(0.07**2 - (0.02 * np.sin(crank)) ** 2)
    largest = np.abs(np.gradient(np.gradient(place, time), time)[2:-2]).max()
    assert lw.metrics(motion).value("peak_acceleration", "way") == pytest.approx(largest, rel=1e-5)
