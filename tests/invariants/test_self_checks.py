"""Results that are right pass their own check; components and resultants are those of plain geometry."""

from __future__ import annotations

import numpy as np
import pytest
from tests.invariants.checked_machines import FALSIFIED, MODEL
from tests.refusals import refused

import linkwright as lw


@pytest.fixture(scope="module")
def forces() -> lw.Forces:
    return lw.solve_forces(lw.solve_motion(lw.loads(MODEL), steps=16))


def test_a_right_result_passes(forces: lw.Forces) -> None:
    assert forces.balance_residual.shape == forces.power_residual.shape == (16,)
    assert forces.balance_residual.max() < 1e-9 and np.abs(forces.power_residual).max() < 1e-9


def test_components_in_the_axes_of_a_link(forces: lw.Forces) -> None:
    """Axes of the crank at the input angle: plain rotation of the frame's components."""
    plain = forces.reaction("A", on="die")
    turned = forces.reaction("A", on="die", axes="crank")
    c, s = np.cos(forces.motion.input), np.sin(forces.motion.input)
    assert turned[:, 0] == pytest.approx(c * plain[:, 0] + s * plain[:, 1], rel=1e-10, abs=1e-9)
    assert turned[:, 1] == pytest.approx(-s * plain[:, 0] + c * plain[:, 1], rel=1e-10, abs=1e-9)
    with refused("names.no_such", noun="link", name="crnk", offer="crank"):
        forces.reaction("A", on="die", axes="crnk")


def test_the_resultant_on_a_block_lies_where_its_couple_says(forces: lw.Forces) -> None:
    """Couple = offset times the force across the guide; on the bed's ram the guide is the x axis."""
    normal, couple = forces.reaction("bed", on="ram")[:, 1], forces.couple("bed", on="ram")
    assert forces.resultant_offset("bed") * normal == pytest.approx(couple, rel=1e-10, abs=1e-10)
    assert forces.couple("bed", on="frame") == pytest.approx(-couple)
    across = forces.couple("slot", on="die")
    e = forces.motion.link("lever").direction
    f = forces.reaction("slot", on="die")
    assert forces.resultant_offset("slot") * (e[:, 0] * f[:, 1] - e[:, 1] * f[:, 0]) == pytest.approx(
        across, abs=1e-9
    )


@pytest.mark.parametrize("near", [1e-2, 1e-4, 1e-5])
def test_near_a_singular_position_rounding_passes(near: float) -> None:
    """An input that is so near (rad) to the dead point of a lever that drives its crank."""
    text = FALSIFIED.replace("turn: falsified_crank, about: O", "turn: falsified_lever, about: Q")
    text = text.replace("{B: left}", "{A: left}")
    stretched = np.pi - np.arccos((0.9**2 + 0.6**2 - 1.0**2) / (2 * 0.9 * 0.6))
    forces = lw.solve_forces(lw.solve_motion(lw.loads(text), at=[stretched + near]))
    assert np.abs(forces.reaction("A", on="falsified_rod")).max() > 10 / np.sqrt(near)
