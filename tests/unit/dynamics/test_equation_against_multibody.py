"""Accelerations and joint forces of the equation of motion in random states of random mechanisms with random loads,
against the equations of all links with Lagrange multipliers."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
from tests.multibody import FreeMultibody
from tests.reference.multibody import Motion
from tests.reference.random_mechanisms import random_case

import linkwright as lw
from linkwright.core.inputs import Input
from linkwright.core.outputs import row_name
from linkwright.dynamics.equation import EquationOfMotion

TOLERANCE = 1e-10
BATCH = 6


@pytest.mark.rotating
@pytest.mark.parametrize("batch", range(14))
def test_random_states(batch: int) -> None:
    wrong = []
    for seed in range(batch * BATCH, (batch + 1) * BATCH):
        found = differences(seed)
        wrong += [f"seed {seed}: {what} differs by {by:.1e}" for what, by in found.items() if not by < TOLERANCE]
    assert not wrong, "\n".join(wrong)


def differences(seed: int) -> dict[str, float]:
    """Relative differences of accelerations and forces; none where the machine has no inertia, or no motion of its
    own, for a torsion spring is wound by a link that turns through."""
    case, rng = random_case(seed, with_loads=True), np.random.default_rng(seed)
    if "torsion_spring" in case.text:
        return {}
    mechanism = lw.loads(case.text)
    equation = EquationOfMotion(mechanism)
    at = dict(zip(equation.names, map(float, equation.start), strict=True))
    rates = {name: float(rng.uniform(-3, 3)) for name in at}
    owner = FreeMultibody(mechanism)
    q, qd = owner.start(at, rates)
    if np.linalg.eigvalsh(reduced_masses(owner, q))[0] < 1e-9:
        return {}
    qdd = owner.acceleration(0.0, q, qd)
    motion = Motion(owner.system, q[None], qd[None], qdd[None], owner.system.jacobian(q[None]))
    given = {f"q:{name}": value for name, value in at.items()} | {f"qd:{name}": rate for name, rate in rates.items()}
    given |= switched(equation, given | equation.states)
    own = equation.evaluate([f"qdd:{name}" for name in equation.free], given, 1)[:, 0]
    expected = driven_seconds(owner, q, qd, qdd)
    found = {"acceleration": _relative(own, expected)}
    given |= {Input("second", name).name: float(value) for name, value in zip(equation.free, own, strict=True)}
    names, forces = joint_forces(owner, motion)
    return found | {
        "force": _relative(equation.run(equation.row_program(names, forces=True), given, 1)[:, 0], forces)
    }


def switched(equation: EquationOfMotion, given: Mapping[str, float]) -> dict[str, float]:
    """The state with all switches as their gaps say."""
    known, found = dict(given), {}
    gaps = [name for name in equation.traced[1] if name.startswith("gap:")]
    for _ in range(2 if gaps else 0):
        values = equation.evaluate(gaps, known, 1)[:, 0]
        found = {name.replace("gap", "switch"): float(value > 0) for name, value in zip(gaps, values, strict=True)}
        known |= found
    return known | found


def driven_seconds(owner: FreeMultibody, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray) -> np.ndarray:
    """Second rates of the drivers' coordinates."""
    rows = [int(np.flatnonzero(owner.driven.selection[:, k])[0]) for k in range(owner.driven.drivers)]
    second = owner.driven.jacobian(q)[:, 3:] @ qdd[1:].ravel() + owner.driven.quadratic(q, qd)
    return np.asarray(second[rows])


def reduced_masses(owner: FreeMultibody, q: np.ndarray) -> np.ndarray:
    """The mass matrix in the drivers' coordinates."""
    basis = np.linalg.lstsq(owner.driven.jacobian(q)[:, 3:], owner.driven.selection, rcond=None)[0]
    return np.asarray(basis.T @ owner.masses(q) @ basis)


def joint_forces(owner: FreeMultibody, motion: Motion) -> tuple[list[str], np.ndarray]:
    """Names of rows, and the forces on every link of every joint."""
    wrenches = owner.wrenches(motion, np.zeros(1))
    forces, names, values = motion.forces([lambda _motion: wrenches]), [], []
    for joint in owner.mechanism.joints.values():
        for link in joint.joined:
            names += [row_name("reaction", joint.name, axis, link) for axis in "xy"]
            values += list(forces.on(joint.name, link)[0][0])
    return names, np.array(values)


def _relative(found: np.ndarray, expected: np.ndarray) -> float:
    return float(np.abs(found - expected).max() / max(1.0, np.abs(expected).max()))
