"""Whether motion and forces of a geared mechanism are those of the reference."""

from __future__ import annotations

import numpy as np
from tests.reference.agreement import Comparison, floors, force_floors, motion_comparison
from tests.reference.geared import pressed_forces
from tests.reference.geared_mechanisms import GearedCase
from tests.reference.multibody import Motion, Unreachable

import linkwright as lw

TIMES = np.linspace(0.0, 0.12, 5)
TOLERANCE = 1e-9
#: Condition of the reference's equations and its largest rate, up to which rounding stays below the tolerance.
WELL_PLACED, CALM = 400.0, 30.0


def well_placed(case: GearedCase) -> Motion | None:
    """The reference's motion, None where it does not get there or where rounding would be judged."""
    try:
        motion = case.motion(TIMES)
    except Unreachable:
        return None
    calm = motion.condition().max() < WELL_PLACED and np.abs(motion.qd).max() < CALM
    return motion if calm else None


def disagreements(case: GearedCase, reference: Motion) -> list[str]:
    """What of motion, forces, powers and balance is not as it must be, a line each."""
    mechanism = lw.loads(case.text)
    motion = lw.solve_motion(mechanism, times=TIMES)
    moved = motion_comparison(mechanism, motion, reference, derived=False)
    found = list(moved.failures(TOLERANCE, floors(mechanism, reference)))
    forces = lw.solve_forces(motion)
    expected, pressing = pressed_forces(reference, case.loads())
    compared = Comparison()
    for joint in mechanism.joints.values():
        for link in joint.joined:
            force, _ = expected.on(joint.name, link)
            if joint.name in pressing:
                force = force + pressing[joint.name] * (1.0 if link == joint.joined[0] else -1.0)
            compared.add("force", f"{joint.name} on {link}", forces.reaction(joint.name, on=link), force)
    compared.add("moment", "driver", forces.input_torque, expected.effort("driver driver"))
    found += compared.failures(TOLERANCE, force_floors(expected))
    scale = 1e-11 * float(np.abs(expected.lam).max())
    checks = {"balance": forces.balance_residual.max(), "power": np.abs(forces.power_residual).max()}
    return found + [f"{name} residual {value:.3g}" for name, value in checks.items() if not value < scale]
