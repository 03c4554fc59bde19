"""A triad behind a cam over the whole cycle, with its dwells and the ends of its rises, against its bars' lengths."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import fsolve
from tests.invariants.triad_behind_cam import TEXT
from tests.reference import joint_cells
from tests.reference.geared_judge import disagreements, well_placed
from tests.reference.geared_mechanisms import GearedDraft, case_of
from tests.reference.multibody import FRAME

import linkwright as lw

BARS = (("T", "A"), ("O2", "B"), ("O3", "C"), ("A", "B"), ("B", "C"), ("A", "C"))
#: The second derivative of the lift is continuous, or jumps.
LAWS = ("cycloidal", "simple_harmonic", "constant_acceleration")


@pytest.mark.parametrize("law", LAWS)
def test_the_cycle_is_that_of_the_bars(law: str) -> None:
    mechanism = lw.loads(TEXT.replace("LAW", law))
    motion = lw.solve_motion(mechanism, steps=90, endpoint=True)
    turned = motion.link("plate").angle
    assert turned[-1] == pytest.approx(turned[0], abs=1e-10) and np.ptp(turned) > 1e-3
    fixed = {name: np.array(at) for name, at in (mechanism.frame.points | mechanism.drawing).items()}
    lengths = [np.hypot(*(fixed[p] - fixed[q])) for p, q in BARS]
    x = np.concatenate([fixed[name] for name in "ABC"])

    def open_by(x: np.ndarray, t: np.ndarray) -> list[float]:
        at = fixed | {"T": t} | {name: x[2 * k : 2 * k + 2] for k, name in enumerate("ABC")}
        return [float(((at[p] - at[q]) ** 2).sum() - r**2) for (p, q), r in zip(BARS, lengths, strict=True)]

    for i, t in enumerate(motion.point("T").position):
        x = fsolve(open_by, x, args=(t,), xtol=1e-13)
        found = np.concatenate([motion.point(name).position[i] for name in "ABC"])
        assert found == pytest.approx(x, abs=1e-10)
    forces = lw.solve_forces(motion)
    assert np.abs(forces.power_residual).max() < 1e-13
    assert np.abs(forces.balance_residual).max() < 1e-12


@pytest.mark.rotating
@pytest.mark.parametrize("law", LAWS)
def test_sweeps_pass_where_a_rise_begins(law: str) -> None:
    """The prediction from a dwell misses the whole step there."""
    mechanism = lw.loads(TEXT.replace("LAW", law))
    radii = np.array([0.0499, 0.0501])
    swept = lw.sweep(mechanism, {"lobe.base_radius": radii}, outputs=["plate.angle max"], steps=72)
    for radius, largest in zip(radii, swept["plate.angle", "max"], strict=True):
        alone = lw.solve_motion(mechanism.with_dimensions({"lobe.base_radius": radius}), steps=72)
        assert largest == pytest.approx(alone.link("plate").angle.max(), abs=1e-3)


def test_wheels_behind_a_cam_that_a_linkage_turns_are_followed() -> None:
    """Against the reference, as far as it comes."""
    compared = 0
    for seed in range(6):
        d = GearedDraft(np.random.default_rng([91, seed]))
        crank = d.link((0.0, 0.0))
        d.pin(FRAME, crank, (0.0, 0.0))
        d.mark(crank, (0.3, 0.0), joint_cells.CRANK_END)
        joint_cells.GROUPS["RRR"](d)
        joint_cells.JOINTS["cam"](d, d.pins[-1])
        joint_cells.JOINTS["revolute"](d, d.pins[-1])
        joint_cells.JOINTS["gear"](d, d.pins[-1])
        case = case_of(d)
        reference = well_placed(case)
        if reference is not None:
            assert list(disagreements(case, reference, case.text)) == []
            compared += 1
    assert compared > 1
