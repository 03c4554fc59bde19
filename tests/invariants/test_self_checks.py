"""Every self-check reacts: a falsified reaction, couple, effort, load or power shows in it, by its size."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import linkwright as lw
from linkwright.engine.trace import Scalar
from linkwright.engine.vector import Vec
from linkwright.errors import SelfCheckError
from linkwright.joints.revolute import PinCut
from linkwright.kinematics.motion import Evaluate, Rows
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.trace import ForceTrace
from linkwright.study.designs import sweep_curves

MODEL = """
format: 1
name: slotted press
frame: {points: {O: [0 m, 0 m], Q: [0 m, -0.4 m], R: [0 m, 0.5 m]}}
links:
  crank: {points: [O, A], length: 0.15 m, mass: 2 kg, inertia: 0.01 kg·m²}
  die: {points: [A], mass: 1 kg}
  lever: {points: [Q, B], length: 0.8 m, mass: 5 kg, inertia: 0.3 kg·m²}
  rod: {points: [B, C], length: 0.5 m, mass: 3 kg, inertia: 0.1 kg·m²}
  ram: {points: [C], mass: 8 kg}
joints:
  slot: {kind: prismatic, guide: lever, through: Q, direction: [Q, B], block: die, at: A}
  bed: {kind: prismatic, guide: frame, through: R, direction: 0 deg, block: ram, at: C}
drawing: {A: [0.15 m, 0 m], B: [0.28 m, 0.35 m], C: [0.75 m, 0.5 m]}
driver: {turn: crank, about: O, speed: 6 rad/s}
gravity: [0, -9.81 m/s²]
loads: {work: {kind: force, on: ram, at: C, components: [-300 N, 0 N]}}
"""


@pytest.fixture(scope="module")
def forces() -> Forces:
    return lw.solve_forces(lw.solve_motion(lw.loads(MODEL), steps=16))


def test_a_right_result_passes(forces: Forces) -> None:
    assert forces.balance_residual.shape == forces.power_residual.shape == (16,)
    assert forces.balance_residual.max() < 1e-9 and np.abs(forces.power_residual).max() < 1e-9


def again(forces: Forces) -> Forces:
    """The same result without what it has kept."""
    return lw.solve_forces(forces.motion)


@pytest.mark.parametrize("joint", ["O", "A", "B", "C", "Q", "slot", "bed"])
def test_a_falsified_reaction_shows_in_the_balance(
    forces: Forces, joint: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = Forces.reaction

    def wrong(self: Forces, name: str, *, on: str | None = None, axes: str = "frame") -> np.ndarray:
        return right(self, name, on=on, axes=axes) + (np.array([3.0, 4.0]) if name == joint else 0.0)

    fresh = again(forces)
    monkeypatch.setattr(Forces, "reaction", wrong)
    assert (fresh.balance_residual >= 5.0 - 1e-9).all()


@pytest.mark.parametrize("joint", ["slot", "bed"])
def test_a_falsified_couple_shows_in_the_balance(
    forces: Forces, joint: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = Forces.couple
    monkeypatch.setattr(
        Forces, "couple", lambda self, name, *, on=None: right(self, name, on=on) + 1.6 * (name == joint)
    )
    assert again(forces).balance_residual == pytest.approx(np.full(16, 1.6 / 0.8), rel=1e-6)


def test_a_falsified_effort_shows_in_both_checks(forces: Forces, monkeypatch: pytest.MonkeyPatch) -> None:
    right = Forces.driver_effort
    monkeypatch.setattr(Forces, "driver_effort", lambda self, name: right(self, name) + 0.8)
    assert again(forces).balance_residual == pytest.approx(np.full(16, 1.0), rel=1e-6)


def test_a_falsified_load_shows_in_the_balance(forces: Forces, monkeypatch: pytest.MonkeyPatch) -> None:
    right = Forces.fetch

    def wrong(self: Forces, names: tuple[str, ...]) -> list[np.ndarray]:
        rows = right(self, names)
        return [row * 1.01 if name == "on:ram.x" else row for name, row in zip(names, rows, strict=True)]

    monkeypatch.setattr(Forces, "fetch", wrong)
    assert again(forces).balance_residual == pytest.approx(np.full(16, 3.0), rel=0.2)


def test_a_falsified_mass_shows_in_the_balance(forces: Forces) -> None:
    """1 kg more on the ram than the reactions were found with: 1 kg times its acceleration is missing."""
    fresh = again(forces)
    ram = forces.mechanism.links["ram"]
    links = {**forces.mechanism.links, "ram": replace(ram, mass=ram.mass + 1.0)}
    heavier = replace(forces.mechanism, links=links)
    missing = np.hypot(*(forces.motion.link("ram").centre.acceleration - (0.0, -9.81)).T)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Forces, "mechanism", heavier)
        assert (fresh.balance_residual >= missing - 1e-8).all()


def falsify(patch: pytest.MonkeyPatch, part: str, by: float) -> None:
    """Let a row of the results be larger than it is."""
    right = Rows.row

    def wrong(self: Rows, name: str, evaluate: Evaluate) -> np.ndarray:
        return right(self, name, evaluate) + by * (name == part)

    patch.setattr(Rows, "row", wrong)


@pytest.mark.parametrize("part", ["driver_power", "power"])
def test_falsified_powers_show_in_the_power_residual(
    forces: Forces, part: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    fresh = again(forces)
    falsify(monkeypatch, part, 7.0)
    sign = 1.0 if part == "driver_power" else -1.0
    assert fresh.power_residual == pytest.approx(np.full(16, 7.0 * sign), abs=1e-8)


def test_both_ways_to_the_torque_are_two_ways(forces: Forces, monkeypatch: pytest.MonkeyPatch) -> None:
    assert forces.input_torque_from_power == pytest.approx(forces.input_torque, rel=1e-10, abs=1e-9)
    fresh = again(forces)
    falsify(monkeypatch, "power", 6.0)
    assert fresh.input_torque_from_power - fresh.input_torque == pytest.approx(np.ones(16), abs=1e-8)


def test_components_in_the_axes_of_a_link(forces: Forces) -> None:
    """Axes of the crank at the input angle: plain rotation of the frame's components."""
    plain = forces.reaction("A", on="die")
    turned = forces.reaction("A", on="die", axes="crank")
    c, s = np.cos(forces.motion.input), np.sin(forces.motion.input)
    assert turned[:, 0] == pytest.approx(c * plain[:, 0] + s * plain[:, 1], rel=1e-10, abs=1e-9)
    assert turned[:, 1] == pytest.approx(-s * plain[:, 0] + c * plain[:, 1], rel=1e-10, abs=1e-9)
    with pytest.raises(lw.LinkwrightError, match="crnk"):
        forces.reaction("A", on="die", axes="crnk")


def test_the_resultant_on_a_block_lies_where_its_couple_says(forces: Forces) -> None:
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


FALSIFIED = """
format: 1
name: falsified four-bar
frame: {points: {O: [0 m, 0 m], Q: [0.9 m, 0 m]}}
links:
  falsified_crank: {points: [O, A], length: 0.2 m, mass: 2 kg, inertia: 0.01 kg·m²}
  falsified_rod: {points: [A, B], length: 0.8 m, mass: 3 kg, inertia: 0.1 kg·m²}
  falsified_lever: {points: [Q, B], length: 0.6 m, mass: 5 kg, inertia: 0.3 kg·m²}
assembly: {B: left}
driver: {turn: falsified_crank, about: O, speed: 6 rad/s}
loads: {work: {kind: torque, on: falsified_lever, magnitude: 90 N·m}}
"""


def solved(name: str, steps: int = 12) -> Forces:
    """The four-bar with links of its own names, for which no formula is kept."""
    return lw.solve_forces(lw.solve_motion(lw.loads(FALSIFIED.replace("falsified", name)), steps=steps))


def unbalance(patch: pytest.MonkeyPatch) -> None:
    """Let a cut pin give one link 1 % more than it takes from the other."""
    right = PinCut.force_on

    def wrong(self: PinCut, end: str, multipliers: Any, poses: Any) -> tuple[Vec, Scalar]:
        force, couple = right(self, end, multipliers, poses)
        return (force * 1.01 if end == self.connection.a else force), couple

    patch.setattr(PinCut, "force_on", wrong)


def test_a_formula_that_leaves_a_link_out_of_balance_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patch:
        unbalance(patch)
        with pytest.raises(
            SelfCheckError, match=r"link 'unbalanced_\w+' is out of balance at joint '\w' by"
        ) as said:
            solved("unbalanced")
    assert "report it with the model file" in str(said.value) and "未通过自校核" in said.value.say("zh")
    assert np.isfinite(solved("balanced").input_torque).all()


def test_in_sweeps_it_is_an_outcome(monkeypatch: pytest.MonkeyPatch) -> None:
    swept = lw.loads(FALSIFIED.replace("falsified", "swept"))
    vary = {"swept_rod.length": np.array([0.7, 0.75, 0.8, 0.85])}
    with monkeypatch.context() as patch:
        unbalance(patch)
        found = lw.sweep(swept, vary, outputs=["reaction Q on swept_lever max"], backend="numpy")
        with pytest.raises(SelfCheckError, match="out of balance"):
            next(iter(sweep_curves(swept, vary, outputs=["driver.effort"], backend="numpy")))
        prepared = lw.prepare(
            lw.loads(FALSIFIED.replace("falsified", "prepared")), vary=["prepared_rod.length"]
        )
        with pytest.raises(SelfCheckError, match="out of balance"):
            prepared.solve({"prepared_rod.length": 0.75})
    assert not found.ok.any() and np.isnan(found["reaction Q on swept_lever max"]).all()
    (failure,) = found.failures()
    assert failure.count == 4 and "do not pass their own check" in failure.example


def test_a_power_that_is_not_the_drivers_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    right = ForceTrace.power.fget
    assert right is not None
    with monkeypatch.context() as patch:
        patch.setattr(ForceTrace, "power", property(lambda self: right(self) * 1.001))
        with pytest.raises(
            SelfCheckError, match="the power of the drivers and that of all other forces differ by"
        ):
            solved("powerless")


def test_results_out_of_balance_are_not_given_away(monkeypatch: pytest.MonkeyPatch) -> None:
    right, forces = Forces.couple, lw.solve_forces(lw.solve_motion(lw.loads(MODEL), steps=16))
    monkeypatch.setattr(Forces, "couple", lambda self, name, *, on=None: right(self, name, on=on) + 0.01)
    with pytest.raises(SelfCheckError, match="put together leave a link out of balance"):
        forces.columns()


@pytest.mark.parametrize("near", [1e-2, 1e-4, 1e-5])
def test_near_a_singular_position_rounding_passes(near: float) -> None:
    """An input that is so near (rad) to the dead point of a lever that drives its crank."""
    text = FALSIFIED.replace("turn: falsified_crank, about: O", "turn: falsified_lever, about: Q")
    text = text.replace("{B: left}", "{A: left}")
    stretched = np.pi - np.arccos((0.9**2 + 0.6**2 - 1.0**2) / (2 * 0.9 * 0.6))
    forces = lw.solve_forces(lw.solve_motion(lw.loads(text), at=[stretched + near]))
    assert np.abs(forces.reaction("A", on="falsified_rod")).max() > 10 / np.sqrt(near)
