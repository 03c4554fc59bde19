"""Friction on pins between moving links and on turning guides, against the reference with friction of its own.

The reference puts couples on pins and forces along guides as loads, from the sizes of its own multipliers, and
repeats until they agree.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tests.reference.adapted_loads import friction_loads, reference_loads
from tests.reference.adapter import reference_motion
from tests.reference.geared import pressed_forces
from tests.reference.geared_judge import TIMES, well_placed
from tests.reference.geared_mechanisms import geared_case

import linkwright as lw

SHAPER = """
format: 1
name: shaper with dry joints
frame: {points: {O: [0 m, 0.5 m], Q: [0 m, 0 m], R: [0 m, 0.95 m]}}
links:
  crank: {points: [O, A], length: 0.15 m, mass: 4 kg, inertia: 0.02 kg·m²}
  die: {points: [A], mass: 1 kg}
  lever: {points: [Q, B], length: 0.9 m, mass: 6 kg, inertia: 0.4 kg·m²}
  rod: {points: [B, C], length: 0.4 m, mass: 2 kg, inertia: 0.04 kg·m²}
  ram: {points: [C], mass: 9 kg}
joints:
  A: {kind: revolute, pin_radius: 25 mm, friction: PIN}
  B: {kind: revolute, pin_radius: 20 mm, friction: PIN}
  Q: {kind: revolute, pin_radius: 30 mm, friction: PIN}
  slot: {kind: prismatic, guide: lever, through: Q, direction: [Q, B], block: die, at: A, friction: SLOT}
  bed: {kind: prismatic, guide: frame, through: R, direction: 0 deg, block: ram, at: C, friction: 0.1}
drawing: {A: [0.15 m, 0.5 m], B: [0.25 m, 0.86 m], C: [0.64 m, 0.95 m]}
driver: {turn: crank, about: O, speed: SPEED rad/s}
gravity: [0, -9.81 m/s²]
loads: {cutting: {kind: force, on: ram, at: C, components: [-200 N, 0 N]}}
"""


@pytest.mark.parametrize("speed", [7.0, -7.0])
@pytest.mark.parametrize(("pin", "slot"), [(0.2, 0.0), (0.0, 0.15), (0.15, 0.1)])
def test_friction_of_moving_joints(pin: float, slot: float, speed: float) -> None:
    text = SHAPER.replace("PIN", str(pin)).replace("SLOT", str(slot)).replace("SPEED", str(speed))
    mechanism = lw.loads(text)
    forces = lw.solve_forces(lw.solve_motion(mechanism, steps=30))
    motion = reference_motion(mechanism, forces.motion.time)
    applied = reference_loads(mechanism, motion, forces.motion.time)
    found = motion.forces(applied)
    smooth = found.effort("driver driver")
    for _ in range(200):
        found = motion.forces([*applied, *friction_loads(mechanism, motion, found).values()])
    assert forces.input_torque == pytest.approx(found.effort("driver driver"), rel=1e-9, abs=1e-8)
    for name, joint in mechanism.joints.items():
        for link in joint.joined:
            assert forces.reaction(name, on=link) == pytest.approx(found.on(name, link)[0], rel=1e-8, abs=1e-7)
    assert forces.balance_residual.max() < 1e-7 and np.abs(forces.power_residual).max() < 1e-7
    lost = (found.effort("driver driver") - smooth) * speed
    assert lost.mean() > 1.0


@pytest.mark.parametrize("seed", [4, 6, 8, 25, 39])
def test_friction_beside_wheels_belts_and_racks(seed: int) -> None:
    """What presses teeth apart presses the joints, whose friction changes the forces of the teeth."""
    case = geared_case(seed)
    reference = well_placed(case)
    assert reference is not None
    plain = lw.loads(case.text)
    rubbing = {
        name: replace(joint, friction=0.1, pin_radius=0.01)
        if joint.coordinate == "turn"
        else replace(joint, friction=0.1)
        for name, joint in plain.joints.items()
        if joint.coordinate in ("turn", "slide") and len(joint.joined) == 2
    }
    mechanism = replace(plain, joints={**plain.joints, **rubbing})
    forces = lw.solve_forces(lw.solve_motion(mechanism, times=TIMES))
    found, _ = pressed_forces(reference, case.loads())
    smooth = found.effort("driver driver")
    for _ in range(60):
        friction = friction_loads(mechanism, reference, found).values()
        found, _ = pressed_forces(reference, [*case.loads(), *friction])
    effort = found.effort("driver driver")
    largest = float(np.abs(found.lam).max())
    assert forces.input_torque == pytest.approx(effort, rel=1e-9, abs=1e-9 * largest)
    for name in rubbing:
        link = mechanism.joints[name].joined[-1]
        near = found.on(name, link)[0]
        assert forces.reaction(name, on=link) == pytest.approx(near, rel=1e-9, abs=1e-9 * largest)
    assert np.abs(effort - smooth).max() > 1e-4 * np.abs(smooth).max()
