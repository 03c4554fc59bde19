"""Questions to results and settings of a cycle that make no sense: each is refused with its full sentence."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

import linkwright as lw
from linkwright.engine.program import Program
from linkwright.engine.reductions import Accumulation, Reduction
from linkwright.engine.trace import Trace
from linkwright.kinematics.cycle import at_inputs, over_cycle
from linkwright.kinetostatics.forces import Forces
from linkwright.machine.balancing import balance


@cache
def forces(name: str) -> Forces:
    return lw.solve_forces(lw.solve_motion(lw.load(f"gallery:{name}"), steps=4))


def rocker() -> Forces:
    return forces("crank_rocker")


def truss() -> Forces:
    return forces("truss")


def model(name: str = "crank_rocker") -> lw.Mechanism:
    return lw.load(f"gallery:{name}")


TRUSS = "'Triangular truss on a pin and a roller' has no driver, so "


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (lambda: truss().motion.input, TRUSS + "it has no input"),
        (lambda: truss().input_torque, TRUSS + "it has no input torque"),
        (lambda: rocker().motion.joint("Bx"), "there is no joint 'Bx' with a coordinate; did you mean \"B\"?"),
        (lambda: rocker().motion.link("rockre"), 'there is no link "rockre"; did you mean "rocker"?'),
        (lambda: rocker().motion.point("rockr.B"), 'there is no link "rockr"; did you mean "rocker"?'),
        (lambda: rocker().motion.point("rocker.C"), 'there is no point of link rocker: "C"; there is O2, B'),
        (lambda: rocker().motion.point("Z"), 'there is no point "Z"; there is O1, O2, A, B, P'),
        (lambda: rocker().driver_effort("drver"), 'there is no driver "drver"; did you mean "driver"?'),
        (lambda: rocker().reaction("B"), "joint 'B' joins coupler, rocker; say on which link: on='coupler'"),
        (lambda: rocker().reaction("B", on="crank"),
         "joint 'B' does not touch link 'crank'; it joins coupler, rocker"),
        (lambda: rocker().couple("Bb", on="crank"), 'there is no joint "Bb"; did you mean "B"?'),
        (lambda: rocker().reaction("B", on="rocker", axes="rockr"),
         'there is no link "rockr"; did you mean "rocker"?'),
        (lambda: forces("excavator").input_torque_from_power,
         "with several drivers the powers give one sum, not the effort of one driver"),
        (lambda: balance(model(), radius=0.1, share=1.5),
         "share is 1.5; give a number from 0 (nothing) to 1 (everything)"),
        (lambda: balance(model(), radius=0.1, share=-0.1),
         "share is -0.1; give a number from 0 (nothing) to 1 (everything)"),
        (lambda: balance(model(), radius=0.0),
         "the radius of the counterweight on 'crank' is 0 m; give a positive one"),
        (lambda: balance(model(), radius={"crank": 0.1}),
         "no radius is given for the counterweight on 'rocker'; add it to the radii, or give one for all"),
        (lambda: balance(model("triad"), radius=0.1),
         "'Triad (class III group)' is neither a four-bar nor a slider-crank; counterweights by formula are for "
         "these two, other mechanisms are balanced by varying masses and mass centres in a study"),
        (lambda: over_cycle(model(), 0), "steps is 0; give a whole number, 1 or more"),
        (lambda: at_inputs(model("truss"), [0.0]), TRUSS + "there is no input to set; leave the input out"),
        (lambda: at_inputs(model(), {}),
         "no input is given; give the coordinates of a driver, as in at={'driver': [0.5]}"),
        (lambda: at_inputs(model(), {"x": [0.0]}), 'there is no driver "x"; there is driver'),
        (lambda: at_inputs(model(), [np.nan]), "an input of driver 'driver' is not a finite number"),
    ],
)  # fmt: skip
def test_the_refusal_names_what_was_asked_and_what_there_is(asked: Callable[[], Any], said: str) -> None:
    with pytest.raises(lw.LinkwrightError) as caught:
        asked()
    assert str(caught.value) == said


def test_a_sum_over_what_is_not_there_is_refused() -> None:
    t = Trace()
    program = Program.of(t, {"y": t.position("x") * 2.0})
    along = Program.of(t, {"z": t.position("x")})
    for more, said in (
        ({"valid": "nope"}, "the program has no output 'nope' that says which positions are valid"),
        ({"after": along}, "only a program per design, without states, can follow the positions"),
        ({"reductions": (Reduction("y", "max", "y"),)}, "the reduction 'y.max.y' must not say of what"),
        ({"reductions": (Reduction("y", "at_max"),)}, "the reduction 'y.at_max' must say of what"),
        ({"reductions": (Reduction("q", "max"),)}, "the program has no output 'q' to reduce"),
        ({"reductions": (Reduction("y", "at_max", "q"),)}, "the program has no output 'q' to reduce"),
    ):
        given: dict[str, Any] = {"reductions": (), **more}
        with pytest.raises(ValueError, match="^" + said.replace(".", r"\.") + "$"):
            Accumulation(program, **given)
    assert Accumulation(program, (Reduction("#", "max"), Reduction("y", "at_max", "#"))).valid is None
