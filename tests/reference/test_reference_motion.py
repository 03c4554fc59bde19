"""Motions of the package against the independent multibody code: gallery files and well-placed random mechanisms."""

from __future__ import annotations

import numpy as np
import pytest
from tests.reference.adapter import driver_values, reference_motion, reference_system
from tests.reference.agreement import floors, motion_comparison
from tests.reference.plain_machines import BATCH, BATCHES, GALLERY, gallery_inputs
from tests.reference.random_mechanisms import random_case

import linkwright as lw

TOLERANCE = 1e-9


@pytest.mark.rotating
@pytest.mark.parametrize("name", GALLERY)
def test_gallery(name: str) -> None:
    mechanism = lw.load(f"gallery:{name}")
    motion = lw.solve_motion(mechanism, steps=72, at=gallery_inputs(name))
    reference = reference_motion(mechanism, motion.time)
    comparison = motion_comparison(mechanism, motion, reference)
    assert not comparison.failures(TOLERANCE, floors(mechanism, reference))


@pytest.mark.parametrize("batch", BATCHES)
def test_random_mechanisms(batch: int) -> None:
    wrong = []
    for seed in range(batch * BATCH, (batch + 1) * BATCH):
        wrong += [f"seed {seed}: {line}" for line in random_failures(seed)[:3]]
    assert not wrong, "\n".join(wrong)


def random_failures(seed: int) -> list[str]:
    case = random_case(seed)
    try:
        mechanism = lw.loads(case.text)
        motion = lw.solve_motion(mechanism, steps=6)
    except lw.LinkwrightError as error:
        return [f"refused: {error}"]
    for law in case.laws:
        driver = next(iter(mechanism.drivers)) if len(case.laws) == 1 else law.name
        if not np.allclose(motion.inputs[driver], law.start + law.speed * motion.time, rtol=1e-12, atol=1e-12):
            return [f"input {driver} does not follow its law"]
    if abs(motion.time[0] - case.span[0]) > 1e-9 or abs(motion.time[-1] - case.span[1]) > 1e-9:
        return [f"times {motion.time[0]} to {motion.time[-1]}, expected {case.span}"]
    reference = case.motion(motion.time)
    comparison = motion_comparison(mechanism, motion, reference, derived=seed % 3 == 0)
    return comparison.failures(TOLERANCE, floors(mechanism, reference))


@pytest.mark.long
@pytest.mark.parametrize("seed", range(30))
def test_the_adapter_reads_the_system_that_the_generator_made(seed: int) -> None:
    """Reference from the Mechanism's data against the reference from the generator's numbers."""
    case = random_case(seed)
    mechanism = lw.loads(case.text)
    assert [body.name for body in reference_system(mechanism).bodies] == [b.name for b in case.system.bodies]
    time = np.linspace(*case.span, 4)
    u, ud, _ = driver_values(mechanism, time)
    assert u == pytest.approx(np.array([law.start + law.speed * time for law in case.laws]).T, abs=1e-12)
    assert ud == pytest.approx(np.array([[law.speed] * 4 for law in case.laws]).T)
    found, expected = reference_motion(mechanism, time), case.motion(time)
    for body in case.system.bodies:
        (p, v, a), (pp, vv, aa) = (m.point(body.name, (0.0, 0.0)) for m in (found, expected))
        assert p == pytest.approx(pp, abs=1e-10)
        assert v == pytest.approx(vv, abs=1e-10 * max(1.0, np.abs(expected.qd).max()))
        assert a == pytest.approx(aa, abs=1e-10 * max(1.0, np.abs(expected.qdd).max()))
