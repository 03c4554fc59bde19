"""Every self-check reacts: a falsified reaction, couple, effort, load or power shows in it, by its size."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from tests.invariants.checked_machines import FALSIFIED, MODEL
from tests.refusals import refused

import linkwright as lw
from linkwright.designs.sweep import sweep_curves
from linkwright.errors import SelfCheckError
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Scalar
from linkwright.kinematics.equation import Equation
from linkwright.kinematics.motion import Evaluate, Rows
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.trace import ForceTrace


@pytest.fixture(scope="module")
def forces() -> Forces:
    return lw.solve_forces(lw.solve_motion(lw.loads(MODEL), steps=16))


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
def test_a_falsified_couple_shows_in_the_balance(forces: Forces, joint: str, monkeypatch: pytest.MonkeyPatch) -> None:
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


def solved(name: str, steps: int = 12) -> Forces:
    """The four-bar with links of its own names, for which no formula is kept."""
    return lw.solve_forces(lw.solve_motion(lw.loads(FALSIFIED.replace("falsified", name)), steps=steps))


def unbalance(patch: pytest.MonkeyPatch) -> None:
    """Let a cut pin give one link 1 % more than it takes from the other."""
    right = Equation.wrenches

    def wrong(self: Equation, multipliers: Any, poses: Any) -> dict[str, tuple[Vec, Scalar]]:
        found, a = right(self, multipliers, poses), self.connection.a
        return found | {a: (found[a][0] * 1.01, found[a][1] * 1.01)}

    patch.setattr(Equation, "wrenches", wrong)


def test_a_formula_that_leaves_a_link_out_of_balance_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patch:
        unbalance(patch)
        with refused("forces.unbalanced", SelfCheckError) as said:
            solved("unbalanced")
    assert str(said.value.values["link"]).startswith("unbalanced_")
    assert np.isfinite(solved("balanced").input_torque).all()


def test_in_sweeps_it_is_an_outcome(monkeypatch: pytest.MonkeyPatch) -> None:
    swept = lw.loads(FALSIFIED.replace("falsified", "swept"))
    vary = {"swept_rod.length": np.array([0.7, 0.75, 0.8, 0.85])}
    with monkeypatch.context() as patch:
        unbalance(patch)
        found = lw.sweep(swept, vary, outputs=["reaction Q on swept_lever max"], backend="numpy")
        with refused("forces.unbalanced", SelfCheckError):
            next(iter(sweep_curves(swept, vary, outputs=["driver.effort"], backend="numpy")))
        prepared = lw.prepare(lw.loads(FALSIFIED.replace("falsified", "prepared")), vary=["prepared_rod.length"])
        with refused("forces.unbalanced", SelfCheckError):
            prepared.solve({"prepared_rod.length": 0.75})
    assert not found.ok.any() and np.isnan(found["reaction Q on swept_lever max"]).all()
    (failure,) = found.failures()
    assert (failure.count, failure.example.code) == (4, "forces.unbalanced")


def test_a_power_that_is_not_the_drivers_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    right = ForceTrace.power.fget
    assert right is not None
    with monkeypatch.context() as patch:
        patch.setattr(ForceTrace, "power", property(lambda self: right(self) * 1.001))
        with refused("forces.powers_differ", SelfCheckError):
            solved("powerless")


def test_results_out_of_balance_are_not_given_away(monkeypatch: pytest.MonkeyPatch) -> None:
    right, forces = Forces.couple, lw.solve_forces(lw.solve_motion(lw.loads(MODEL), steps=16))
    monkeypatch.setattr(Forces, "couple", lambda self, name, *, on=None: right(self, name, on=on) + 0.01)
    with refused("forces.results_unbalanced", SelfCheckError):
        forces.columns()
