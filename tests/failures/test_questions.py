"""Questions about results that a machine cannot answer: each is refused with what was asked and what there is."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

import linkwright as lw
from linkwright.kinematics.cycle import at_inputs, at_times, over_cycle
from linkwright.study.criteria import criteria
from linkwright.study.study import study

SIX = "gallery:jaw_crusher_sixbar"


@cache
def six() -> lw.Mechanism:
    return lw.load(SIX)


@cache
def forces() -> lw.Forces:
    return lw.solve_forces(lw.solve_motion(six(), steps=12))


@cache
def still() -> lw.Mechanism:
    """A truss: no driver, nothing moves."""
    return lw.load("gallery:truss")


def swept(*outputs: str) -> object:
    return lw.sweep(six(), {"crank.length": [0.1]}, outputs=[f"{name} max" for name in outputs], steps=12)


def measured(metrics: list[str], **options: Any) -> Any:
    return study(six(), {"crank.length": [0.09, 0.1]}, metrics=metrics, steps=24, **options)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("input_torque now", ["'input_torque now'", "input_torque"]),
        ("power of crank", ["'power of crank'"]),
        ("shaking_force O1", ["'shaking_force O1'"]),
        ("shaking_moment O1", ["'shaking_moment O1'"]),
        ("load crushign", ["'load crushign'", "Hinged jaw crusher"]),
        ("load", ["'load'"]),
        ("transmission_angle", ["'transmission_angle'"]),
        ("transmission_angle B C", ["'transmission_angle B C'"]),
        ("conditioning", ["'conditioning'"]),
        ("velocity_ratio", ["'velocity_ratio'"]),
        ("velocity_ratio jwa", ["'velocity_ratio jwa'"]),
        ("heat O5", ["'heat O5'"]),
        ("equivalent_inertia jaw", ["'equivalent_inertia jaw'"]),
        ("closeness O5", ["'closeness O5'", "inner joint"]),
        ("reaction O5 at jaw", ["'reaction O5 at jaw'"]),
        ("reaction O9", ["'reaction O9'"]),
        ("reaction O5 on crank", ["'reaction O5 on crank'", "does not touch", "frame", "jaw"]),
        ("reaction B", ["'reaction B'", "say on which link", "pitman"]),
        ("jaw.anlge", ["'jaw.anlge'"]),
    ],
)
def test_outputs_that_a_sweep_does_not_know(name: str, words: list[str]) -> None:
    with pytest.raises(lw.LinkwrightError) as caught:
        swept(name)
    for word in words:
        assert word in str(caught.value)


def test_components_of_forces_in_a_sweep_are_those_of_a_solution() -> None:
    names = ["reaction O5 on jaw.x", "reaction O5 on jaw.y", "shaking_force.x", "shaking_force.y"]
    found = lw.sweep(six(), {"crank.length": [0.1]}, outputs=[f"{name} max" for name in names], steps=12)
    reaction, shaking = forces().reaction("O5", on="jaw"), forces().shaking_force
    expected = [*reaction.max(axis=0), *shaking.max(axis=0)]
    assert [found[f"{name} max"][0] for name in names] == pytest.approx(expected, rel=1e-9)
    assert {found.quantities[name].dimension for name in names} == {"force"}


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda: forces().reaction("O5", on="jaw", axes="jwa"), ["jwa", "jaw"]),
        (lambda: forces().reaction("O9"), ["O9", "joint"]),
        (lambda: forces().reaction("B"), ["joint 'B'", "say on which link", "on='pitman'"]),
        (lambda: forces().reaction("O5", on="crank"), ["'O5'", "does not touch", "'crank'"]),
        (lambda: forces().driver_effort("motor"), ["motor", "driver"]),
        (lambda: forces().load("crushign"), ["crushign", "crushing"]),
        (lambda: lw.solve_forces(lw.solve_motion(still())).input_torque, [still().name, "driver"]),
        (lambda: at_inputs(still(), [0.0]), [still().name, "no driver"]),
        (lambda: at_inputs(six(), {"motor": [0.0]}), ["motor", "driver"]),
        (lambda: at_inputs(six(), {}), ["no input is given", "at={'driver': [0.5]}"]),
        (lambda: at_inputs(six(), [np.nan]), ["driver"]),
        (lambda: at_times(six(), [0.0, np.inf]), ["time"]),
        (lambda: over_cycle(six(), 0), ["0"]),
        (lambda: measured(["peak_reaction"], sampling="lattice"), ["lattice", "sobol"]),
        (lambda: criteria([]), ["metric"]),
        (lambda: measured(["travel"])["travle"], ["'travle'", "travel"]),
        (lambda: measured(["travel"]).best("travel"), ["travel"]),
        (lambda: measured(["peak_reaction O9"]), ["peak_reaction", "O9"]),
        (lambda: lw.sweep(six(), {}, outputs=["jaw.angle max"]), ["nothing varies"]),
        (lambda: lw.sweep(six(), {"crank.length": []}, outputs=["jaw.angle max"]), ["crank.length"]),
        (lambda: lw.sweep(six(), {"crank.length": [[0.1]]}, outputs=["jaw.angle max"]), ["(1, 1)"]),
    ],
)
def test_what_a_machine_cannot_be_asked(ask: Callable[[], Any], words: list[str]) -> None:
    with pytest.raises(lw.LinkwrightError) as caught:
        ask()
    for word in words:
        assert word in str(caught.value)
