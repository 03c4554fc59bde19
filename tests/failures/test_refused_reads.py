"""Questions to results and settings of a cycle that make no sense: each is refused, with what was asked."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw
from linkwright import Forces, balance


def rocker() -> Forces:
    return store.forces("crank_rocker", 4)


def truss() -> Forces:
    return store.forces("truss", 4)


def model(name: str = "crank_rocker") -> lw.Mechanism:
    return store.machine(name)


@pytest.mark.parametrize(
    ("asked", "code", "values"),
    [
        (lambda: truss().motion.input, "motion.no_input", {"name": "Triangular truss on a pin and a roller"}),
        (lambda: truss().input_torque, "forces.no_driver", {"name": "Triangular truss on a pin and a roller"}),
        (lambda: rocker().motion.joint("Bx"), "motion.no_coordinate", {"offer": "B", "name": "Bx"}),
        (
            lambda: rocker().motion.link("rockre"),
            "names.no_such",
            {"offer": "rocker", "noun": "link", "name": "rockre"},
        ),
        (
            lambda: rocker().motion.point("rockr.B"),
            "names.no_such",
            {"offer": "rocker", "noun": "link", "name": "rockr"},
        ),
        (
            lambda: rocker().motion.point("rocker.C"),
            "names.no_such_point",
            {"names": ("O2", "B"), "link": "rocker", "name": "C"},
        ),
        (
            lambda: rocker().motion.point("Z"),
            "names.no_such",
            {"names": ("O1", "O2", "A", "B", "P"), "noun": "point", "name": "Z"},
        ),
        (
            lambda: rocker().driver_effort("drver"),
            "names.no_such",
            {"offer": "driver", "noun": "driver", "name": "drver"},
        ),
        (
            lambda: rocker().reaction("B"),
            "forces.say_link",
            {"joint": "B", "links": ("coupler", "rocker"), "first": "coupler"},
        ),
        (
            lambda: rocker().reaction("B", on="crank"),
            "forces.not_touching",
            {"joint": "B", "link": "crank", "links": ("coupler", "rocker")},
        ),
        (lambda: rocker().couple("Bb", on="crank"), "names.no_such", {"offer": "B", "noun": "joint", "name": "Bb"}),
        (
            lambda: rocker().reaction("B", on="rocker", axes="rockr"),
            "names.no_such",
            {"offer": "rocker", "noun": "link", "name": "rockr"},
        ),
        (lambda: store.forces("excavator", 4).input_torque_from_power, "forces.one_sum", {}),
        (lambda: balance(model(), radius=0.1, share=1.5), "forces.share", {"share": 1.5}),
        (lambda: balance(model(), radius=0.1, share=-0.1), "forces.share", {"share": -0.1}),
        (lambda: balance(model(), radius=0.0), "forces.weight_radius", {"link": "crank", "distance": 0.0}),
        (lambda: balance(model(), radius={"crank": 0.1}), "forces.weight_no_radius", {"link": "rocker"}),
        (lambda: balance(model("triad"), radius=0.1), "forces.not_balanced", {"name": "Triad (class III group)"}),
        (
            lambda: lw.solve_motion(model(), steps=0),
            "given_instead.no_whole_from",
            {"option": "steps", "value": "0", "minimum": 1},
        ),
        (
            lambda: lw.solve_motion(model("truss"), at=[0.0]),
            "motion.no_input_to_set",
            {"name": "Triangular truss on a pin and a roller"},
        ),
        (lambda: lw.solve_motion(model(), at={}), "motion.no_inputs", {"driver": "driver"}),
        (
            lambda: lw.solve_motion(model(), at={"x": [0.0]}),
            "names.no_such",
            {"names": ("driver",), "noun": "driver", "name": "x"},
        ),
        (lambda: lw.solve_motion(model(), at=[np.nan]), "motion.bad_input", {"name": "driver"}),
    ],
)
def test_the_refusal_names_what_was_asked_and_what_there_is(
    asked: Callable[[], Any], code: str, values: dict[str, object]
) -> None:
    with refused(code, **values):
        asked()
