"""The generator's mechanisms (repeatable, of every kind, well placed) and the 50-digit variant."""

from __future__ import annotations

from collections import Counter

import mpmath
import numpy as np
import pytest
from tests.reference.formulas import gravity
from tests.reference.multibody import FRAME
from tests.reference.precise import PreciseState, precise_state
from tests.reference.random_mechanisms import RandomCase, random_case, random_mechanism


def inputs(case: RandomCase, time: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    start, speed = (np.array([getattr(law, key) for law in case.laws]) for key in ("start", "speed"))
    return start + time * speed, speed, 0.0 * speed


def test_the_same_seed_gives_the_same_mechanism() -> None:
    assert random_mechanism(11) == random_mechanism(11)
    assert random_mechanism(11) != random_mechanism(12)


@pytest.mark.long
def test_every_kind_of_group_and_driver_comes_up() -> None:
    cases = [random_case(seed) for seed in range(120)]
    kinds = Counter(kind for case in cases for kind in case.signatures)
    assert min(kinds[kind] for kind in ("RRR", "RRP", "RPR", "PRP", "RPP")) >= 15
    assert any(len(case.laws) == 2 for case in cases)
    assert any(case.laws[0].kind == "slide" and case.laws[0].relative_to == FRAME for case in cases)
    assert any(case.laws[0].kind == "slide" and case.laws[0].relative_to != FRAME for case in cases)
    assert any("kind: weld" in case.text for case in cases)
    assert any("assembly:" in case.text for case in cases)
    assert max(len(case.links) - 1 for case in cases) == 10
    assert {link.geometry for case in cases for link in case.links.values()} == {
        "point",
        "length",
        "bent",
        "coordinates",
        "drawing",
    }


@pytest.mark.parametrize("seed", range(8))
def test_start_is_assembled_and_the_span_is_reachable(seed: int) -> None:
    case = random_case(seed)
    u, _, _ = inputs(case, 0.0)
    assert np.abs(case.system.residual(case.start, u)).max() < 1e-13
    motion = case.motion(np.linspace(*case.span, 7))
    assert motion.condition().max() < 2000
    ends = [inputs(case, t)[0] for t in np.linspace(*case.span, 7)]
    worst = max(np.abs(case.system.residual(q, u)).max() for q, u in zip(motion.q, ends, strict=True))
    assert worst < 1e-13


@pytest.mark.parametrize("seed", range(40, 52))
def test_drivers_give_the_power_that_the_bodies_and_the_weights_take(seed: int) -> None:
    case = random_case(seed)
    motion = case.motion(np.linspace(*case.span, 5))
    efforts = motion.forces([gravity((1.0, -9.81))])
    given = sum(efforts.effort(law.name) * law.speed for law in case.laws)
    taken = np.zeros(5)
    for body in case.system.bodies:
        _, v, a = motion.point(body.name, body.centre)
        _, w, e = motion.angle(body.name)
        taken += body.mass * (v * (a - (1.0, -9.81))).sum(1) + body.inertia * w * e
    assert given == pytest.approx(taken, rel=1e-9, abs=1e-9 * max(np.abs(taken).max(), 1.0))


@pytest.mark.long
@pytest.mark.parametrize("seed", [1, 4, 9])
def test_fifty_digits_agree_with_the_arrays(seed: int) -> None:
    case = random_case(seed)
    time = np.array([0.0, case.span[1]])
    motion = case.motion(time)
    forces = motion.forces([gravity((0.0, -9.81))])
    u, ud, udd = inputs(case, time[1])
    state = precise_state(case.system, motion.q[1], u, ud, udd, (0.0, -9.81))
    for precise, found in ((state.q, motion.q), (state.qd, motion.qd), (state.qdd, motion.qdd)):
        exact = np.array([[float(v) for v in precise[body.name]] for body in case.system.bodies])
        assert found[1, 1:] == pytest.approx(exact, rel=1e-11, abs=1e-11 * np.abs(exact).max())
    lam = np.array([float(v) for v in state.lam])
    assert forces.lam[1] == pytest.approx(lam, rel=1e-10, abs=1e-10 * np.abs(lam).max())


@pytest.mark.long
def test_precise_rates_are_the_differences_of_precise_positions() -> None:
    """Velocities and accelerations in 50 digits against central differences (step 2**-50 s)."""
    case = random_case(17)
    h = mpmath.mpf(2) ** -50
    q = case.motion(np.zeros(1)).q[0]
    speed = [mpmath.mpf(law.speed) for law in case.laws]

    def at(k: int) -> PreciseState:
        with mpmath.workdps(60):
            u = [mpmath.mpf(law.start) + k * h * law.speed for law in case.laws]
        return precise_state(case.system, q, u, speed, [mpmath.mpf(0)] * len(speed))

    before, now, after = (at(k) for k in (-1, 0, 1))
    for body in case.system.bodies:
        for k in range(3):
            a, b, c = (state.q[body.name][k] for state in (before, now, after))
            with mpmath.workdps(60):
                first, second = (c - a) / (2 * h), (c - 2 * b + a) / h**2
            assert float(first) == pytest.approx(float(now.qd[body.name][k]), rel=1e-13, abs=1e-13)
            assert float(second) == pytest.approx(float(now.qdd[body.name][k]), rel=1e-13, abs=1e-13)
