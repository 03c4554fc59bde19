"""Forces of the package against the independent Newton-Euler equations with Lagrange multipliers."""

from __future__ import annotations

import numpy as np
import pytest
from tests.reference.adapted_loads import reference_loads
from tests.reference.adapter import reference_motion
from tests.reference.agreement import force_floors, forces_comparison
from tests.reference.plain_machines import BATCH, BATCHES, GALLERY, gallery_inputs
from tests.reference.random_mechanisms import random_case

import linkwright as lw

TOLERANCE = 1e-9


@pytest.mark.rotating
@pytest.mark.parametrize("name", GALLERY)
def test_gallery(name: str) -> None:
    mechanism = lw.load(f"gallery:{name}")
    if any(getattr(joint, "friction", 0.0) for joint in mechanism.joints.values()):
        pytest.skip("the reference has no friction")
    forces = lw.solve_forces(lw.solve_motion(mechanism, steps=36, at=gallery_inputs(name)))
    motion = reference_motion(mechanism, forces.motion.time)
    if motion.system.redundant:
        pytest.skip("reactions of redundant joints are not unique")
    try:
        loads = reference_loads(mechanism, motion, forces.motion.time)
    except NotImplementedError as unknown:
        pytest.skip(f"the reference has no formula for {unknown}")
    reference = motion.forces(loads)
    assert not forces_comparison(mechanism, forces, reference).failures(TOLERANCE, force_floors(reference))


@pytest.mark.parametrize("batch", BATCHES)
def test_random_mechanisms(batch: int) -> None:
    wrong = []
    for seed in range(1000 + batch * BATCH, 1000 + (batch + 1) * BATCH):
        wrong += [f"seed {seed}: {line}" for line in random_failures(seed)[:3]]
    assert not wrong, "\n".join(wrong)


def random_failures(seed: int) -> list[str]:
    case = random_case(seed, with_loads=True)
    static = seed % 7 == 0
    try:
        mechanism = lw.loads(case.text)
        forces = lw.solve_forces(lw.solve_motion(mechanism, steps=4), static=static)
    except lw.LinkwrightError as error:
        return [f"refused: {error}"]
    motion = reference_motion(mechanism, forces.motion.time)
    reference = motion.forces(reference_loads(mechanism, motion, forces.motion.time), static=static)
    floors = force_floors(reference)
    lines = forces_comparison(mechanism, forces, reference).failures(TOLERANCE, floors)
    power = floors["force"] * float(np.abs(motion.qd[..., :2]).max()) + 1.0
    if not np.abs(forces.power_residual).max() < 1e-9 * power:
        lines.append(f"power residual {np.abs(forces.power_residual).max():.3g} W of {power:.3g} W")
    return lines
