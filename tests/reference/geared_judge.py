"""Whether motion and forces of a geared mechanism are those of the reference."""

from __future__ import annotations

import numpy as np
from tests.reference.agreement import Comparison, floors, force_floors, motion_comparison
from tests.reference.geared import pressed_forces
from tests.reference.geared_mechanisms import GearedCase
from tests.reference.multibody import Array, Motion, Unreachable

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


def disagreements(case: GearedCase, reference: Motion, text: str = "") -> list[str]:
    """What of motion, forces, powers and balance is not as it must be, a line each; ``text``: the file in another
    order."""
    mechanism = lw.loads(text or case.text)
    motion = lw.solve_motion(mechanism, times=TIMES)
    moved = motion_comparison(mechanism, motion, reference, derived=False)
    found = list(moved.failures(TOLERANCE, floors(mechanism, reference)))
    forces = lw.solve_forces(motion)
    forces.columns()  # evaluates what is compared in one program
    expected, beside = pressed_forces(reference, case.loads())
    compared = Comparison()
    for joint in mechanism.joints.values():
        place = motion.reaction_place(joint.name)
        for link in joint.joined:
            force, couple = expected.on(joint.name, link, place)
            for wrench in beside.get(joint.name, ()):
                if wrench.body == link:
                    force = force + wrench.force
                    couple = couple + wrench.torque + _cross(wrench.point - place, wrench.force)
            compared.add("force", f"{joint.name} on {link}", forces.reaction(joint.name, on=link), force)
            if joint.couples:
                compared.add("moment", f"{joint.name} on {link}", forces.couple(joint.name, on=link), couple)
    compared.add("moment", "driver", forces.input_torque, expected.effort("driver driver"))
    found += compared.failures(TOLERANCE, force_floors(expected))
    scale = 1e-11 * float(np.abs(expected.lam).max())
    checks = {"balance": forces.balance_residual.max(), "power": np.abs(forces.power_residual).max()}
    return found + [f"{name} residual {value:.3g}" for name, value in checks.items() if not value < scale]


def _cross(arm: Array, force: Array) -> Array:
    return np.asarray(arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0])
