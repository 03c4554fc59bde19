"""Questions about results that a machine cannot answer: each is refused with what was asked and what there is."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw
from linkwright import study


def six() -> lw.Mechanism:
    return store.machine("jaw_crusher_sixbar")


def forces() -> lw.Forces:
    return store.forces("jaw_crusher_sixbar", 12)


def still() -> lw.Mechanism:
    """A truss: no driver, nothing moves."""
    return store.machine("truss")


def swept(*outputs: str) -> object:
    return lw.sweep(six(), {"crank.length": [0.1]}, outputs=[f"{name} max" for name in outputs], steps=12)


def measured(metrics: list[str], **options: Any) -> Any:
    return study(six(), {"crank.length": [0.09, 0.1]}, metrics=metrics, steps=24, **options)


@pytest.mark.parametrize(
    ("name", "code", "values"),
    [
        ("input_torque now", "study.no_such_output", {"offer": "input_torque", "name": "input_torque now"}),
        ("power of crank", "study.no_such_output", {"offer": "power", "name": "power of crank"}),
        ("shaking_force O1", "study.no_such_output", {"offer": "shaking_force", "name": "shaking_force O1"}),
        ("shaking_moment O1", "study.no_such_output", {"offer": "shaking_moment", "name": "shaking_moment O1"}),
        ("load crushign", "study.no_such_output", {"name": "load crushign"}),
        ("load", "study.no_such_output", {"name": "load"}),
        ("transmission_angle", "study.no_such_output", {"name": "transmission_angle"}),
        ("transmission_angle B C", "study.no_such_output", {"name": "transmission_angle B C"}),
        ("conditioning", "study.no_such_output", {"name": "conditioning"}),
        ("velocity_ratio", "study.no_such_output", {"name": "velocity_ratio"}),
        ("velocity_ratio jwa", "study.no_such_output", {"name": "velocity_ratio jwa"}),
        ("heat O5", "study.no_such_output", {"name": "heat O5"}),
        ("equivalent_inertia jaw", "study.no_such_output", {"name": "equivalent_inertia jaw"}),
        ("closeness O5", "study.not_inner", {"name": "closeness O5", "joint": "O5"}),
        ("reaction O5 at jaw", "study.no_such_output", {"name": "reaction O5 at jaw"}),
        ("reaction O9", "study.no_such_output", {"name": "reaction O9"}),
        (
            "reaction O5 on crank",
            "study.not_touching",
            {"name": "reaction O5 on crank", "joint": "O5", "link": "crank"},
        ),
        ("reaction B", "study.say_link", {"name": "reaction B", "joint": "B", "moving": "pitman"}),
        ("jaw.anlge", "study.no_such_output", {"name": "jaw.anlge"}),
    ],
)
def test_outputs_that_a_sweep_does_not_know(name: str, code: str, values: dict[str, object]) -> None:
    with refused(code, **values):
        swept(name)


def test_components_of_forces_in_a_sweep_are_those_of_a_solution() -> None:
    names = ["reaction O5 on jaw.x", "reaction O5 on jaw.y", "shaking_force.x", "shaking_force.y"]
    found = lw.sweep(six(), {"crank.length": [0.1]}, outputs=[f"{name} max" for name in names], steps=12)
    reaction, shaking = forces().reaction("O5", on="jaw"), forces().shaking_force
    expected = [*reaction.max(axis=0), *shaking.max(axis=0)]
    assert [found[f"{name} max"][0] for name in names] == pytest.approx(expected, rel=1e-9)
    assert {found.quantities[name].dimension for name in names} == {"force"}


@pytest.mark.parametrize(
    ("ask", "code", "values"),
    [
        (lambda: forces().reaction("O5", on="jaw", axes="jwa"), "names.no_such", {"offer": "jaw", "name": "jwa"}),
        (lambda: forces().reaction("O9"), "names.no_such", {"noun": "joint", "name": "O9"}),
        (lambda: forces().reaction("B"), "forces.say_link", {"joint": "B", "first": "pitman"}),
        (lambda: forces().reaction("O5", on="crank"), "forces.not_touching", {"joint": "O5", "link": "crank"}),
        (
            lambda: forces().driver_effort("motor"),
            "names.no_such",
            {"offer": "driver", "noun": "driver", "name": "motor"},
        ),
        (lambda: forces().load("crushign"), "names.no_such", {"offer": "crushing", "name": "crushign"}),
        (
            lambda: lw.solve_forces(lw.solve_motion(still())).input_torque,
            "forces.no_driver",
            {"name": "Triangular truss on a pin and a roller"},
        ),
        (
            lambda: lw.solve_motion(still(), at=[0.0]),
            "motion.no_input_to_set",
            {"name": "Triangular truss on a pin and a roller"},
        ),
        (
            lambda: lw.solve_motion(six(), at={"motor": [0.0]}),
            "names.no_such",
            {"offer": "driver", "noun": "driver", "name": "motor"},
        ),
        (lambda: lw.solve_motion(six(), at={}), "motion.no_inputs", {"driver": "driver"}),
        (lambda: lw.solve_motion(six(), at=[np.nan]), "motion.bad_input", {"name": "driver"}),
        (lambda: lw.solve_motion(six(), times=[0.0, np.inf]), "motion.bad_time", {}),
        (lambda: lw.solve_motion(six(), steps=0), "given_instead.no_whole_from", {"value": "0"}),
        (lambda: measured(["peak_reaction"], sampling="lattice"), "study.no_sampling", {"sampling": "lattice"}),
        (lambda: lw.compare([six(), six()], metrics=[]), "study.no_metric_named", {}),
        (lambda: measured(["travel"])["travle"], "study.not_in_study", {"offer": "travel", "name": "travle"}),
        (lambda: measured(["travel"]).best("travel"), "study.no_best", {"metric": "travel"}),
        (lambda: measured(["peak_reaction O9"]), "study.no_value_for", {"name": "peak_reaction", "subject": "O9"}),
        (lambda: lw.sweep(six(), {}, outputs=["jaw.angle max"]), "study.nothing_varied", {}),
        (
            lambda: lw.sweep(six(), {"crank.length": []}, outputs=["jaw.angle max"]),
            "study.no_values",
            {"address": "crank.length"},
        ),
        (
            lambda: lw.sweep(six(), {"crank.length": [[0.1]]}, outputs=["jaw.angle max"]),
            "study.bad_shape",
            {"shape": "(1, 1)"},
        ),
    ],
)
def test_what_a_machine_cannot_be_asked(ask: Callable[[], Any], code: str, values: dict[str, object]) -> None:
    with refused(code, **values):
        ask()
