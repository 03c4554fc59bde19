"""Outputs in the user's words: each against the solved motion and forces, or textbook formulas of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray
from tests import store
from tests.every import every
from tests.outputs_in_words import DRY, OF_THE_PUSHED, OF_THE_SHAPER, PUSHED, Reading
from tests.refusals import refused

import linkwright as lw
from linkwright.errors import RequestError
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import output_names
from linkwright.kinematics.programs import AS_IT_IS, motion_programs
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.named_outputs import Named, Quantity
from linkwright.kinetostatics.solver import force_programs

Floats = NDArray[np.float64]


@dataclass
class Solved:
    motion: Motion
    forces: Forces
    named: Named

    def row(self, quantity: Quantity) -> tuple[Floats, Floats, Floats]:
        """Carrier and value over the positions as the program computes them, and the value from the carrier."""
        trace = self.named.motion.motion.trace
        program = Program.of(trace, {"carrier": quantity.carrier, "value": quantity.value})
        numbers = self.motion.design.parameters
        given = [numbers[name] for name in program.parameters]
        arrays, states = self.motion.positions.arrays, self.motion.states
        rows = NumpyProgram(program).run(given, arrays, states, length=self.motion.steps)
        return rows[0], rows[1], quantity.shown(rows[0])


def solved(text: str, steps: int, times: Floats | None = None) -> Solved:
    mechanism = lw.loads(text)
    motion = lw.solve_motion(mechanism, steps=steps) if times is None else lw.solve_motion(mechanism, times=times)
    programs = force_programs(motion_programs(mechanism, AS_IT_IS))
    return Solved(motion, lw.solve_forces(motion), Named(programs, lambda link: 0.4, lambda link: (0.4, 0.0)))


@pytest.fixture(scope="module")
def shaper() -> Solved:
    return solved(DRY, 24)


@pytest.fixture(scope="module")
def pushed() -> Solved:
    return solved(PUSHED, 12)


def check(case: Solved, name: str, dimension: str, reading: Reading) -> None:
    quantity = case.named.quantity(name)
    assert (quantity.name, quantity.dimension) == (name, dimension)
    carrier, value, shown = case.row(quantity)
    wanted = reading(case.motion, case.forces)
    assert value == pytest.approx(shown, rel=1e-12, abs=1e-12)
    if dimension == "angle":
        shown = shown + 2.0 * np.pi * np.round((wanted - shown) / (2.0 * np.pi))
    assert shown == pytest.approx(wanted, rel=1e-9, abs=1e-9 * (1.0 + np.abs(wanted).max()))
    step = 1e-6 * (1.0 + np.abs(carrier))
    rise = (quantity.shown(carrier + step) - quantity.shown(carrier - step)) / (2.0 * step)
    assert quantity.slope(carrier) == pytest.approx(rise, rel=1e-6)


@pytest.mark.parametrize(("name", "dimension", "reading"), OF_THE_SHAPER)
def test_words_give_what_the_solved_machine_does(shaper: Solved, name: str, dimension: str, reading: Reading) -> None:
    check(shaper, name, dimension, reading)


@pytest.mark.parametrize(("name", "dimension", "reading"), OF_THE_PUSHED)
def test_words_of_a_machine_that_a_sliding_driver_moves(
    pushed: Solved, name: str, dimension: str, reading: Reading
) -> None:
    check(pushed, name, dimension, reading)


@pytest.mark.parametrize(
    ("text", "names"),
    [
        (
            DRY,
            {
                "rod.angular_jerk": lambda m: m.link("rod").angular_acceleration,
                "slot.jerk": lambda m: m.joint("slot").acceleration,
                "B.jerk.x": lambda m: m.point("B").acceleration[:, 0],
            },
        ),
        (
            PUSHED,
            {
                "rod.angular_jerk": lambda m: m.link("rod").angular_acceleration,
                "A.jerk.y": lambda m: m.point("A").acceleration[:, 1],
            },
        ),
    ],
)
def test_jerks_are_the_rates_of_accelerations(text: str, names: dict[str, Callable[[Motion], Floats]]) -> None:
    h = 2e-3
    case = solved(text, 0, np.array([0.1, 0.31]))
    aside = {k: solved_motion(text, np.array([0.1, 0.31]) + k * h) for k in (-2, -1, 1, 2)}
    for name, reading in names.items():
        a = {k: reading(m) for k, m in aside.items()}
        rate = (8.0 * (a[1] - a[-1]) - (a[2] - a[-2])) / (12.0 * h)
        quantity = case.named.quantity(name)
        assert case.row(quantity)[1] == pytest.approx(rate, rel=1e-5)
    both = case.named.quantity("A.jerk")
    x, y = (case.row(case.named.quantity(f"A.jerk.{axis}"))[1] for axis in "xy")
    assert case.row(both)[1] == pytest.approx(np.hypot(x, y), rel=1e-12)


def solved_motion(text: str, times: Floats) -> Motion:
    return lw.solve_motion(lw.loads(text), times=times)


def test_every_name_that_is_offered_is_an_output(shaper: Solved, pushed: Solved) -> None:
    for case in (shaper, pushed):
        names = list(output_names(case.motion.mechanism))
        assert len(names) == len(set(names)) > 40
        for name in names:
            assert case.named.quantity(name).name == name
    names = list(output_names(shaper.motion.mechanism))
    assert names[:6] == ["driver.effort", "input_torque", "power", "shaking_force", "shaking_moment", "closeness"]
    assert {"couple slot on die", "slot.jerk", "reaction A on crank", "reaction A on die", "B.acceleration"} < set(
        names
    )
    assert "reaction bed on frame" not in names


#: Words that are no output, and the one that is offered, if any.
OTHERS = {
    "couple A at die": "couple slot on die",
    "reaction A on die now": "reaction A on die",
    "reaction Z": None,
    "heat bed": None,
    "heat O": None,
    "power x": "power",
    "input_torque x": "input_torque",
    "shaking_moment x": "shaking_moment",
    "shaking_force x": "shaking_force",
    "load a b": None,
    "load none": None,
    "velocity_ratio none": None,
    "velocity_ratio lever rod": None,
    "equivalent_inertia x": None,
    "transmission_angle": None,
    "conditioning": None,
    "lever.speed": "lever.angular_velocity",
    "driver.speed": "driver.effort",
    "bed.speed": "bed.velocity",
    "B.position": "B.velocity",
    "velocity": None,
    "x": None,
}


@pytest.mark.parametrize(("name", "offer"), OTHERS.items())
def test_other_words_are_refused_with_what_was_meant(shaper: Solved, name: str, offer: str | None) -> None:
    meant = {} if offer is None else {"offer": offer}
    with refused("study.no_such_output", RequestError, name=name, mechanism="shaper with dry joints", **meant):
        shaper.named.quantity(name)


def test_a_joint_is_named_with_a_link_that_it_touches(shaper: Solved) -> None:
    with refused("study.say_link", RequestError, joint="A", joined=("crank", "die")):
        shaper.named.quantity("reaction A")
    with refused("study.not_touching", RequestError, joint="A", link="rod", joined=("crank", "die")):
        shaper.named.quantity("reaction A on rod")
    with refused("study.not_inner", RequestError, joint="O", names=("die+lever", "rod+ram", "slot", "C")):
        shaper.named.quantity("conditioning O")


@pytest.mark.parametrize("name", ["class_four_group", "fourth_order_group"])
def test_conditioning_is_the_determinant_of_the_cuts_rates(name: str) -> None:
    """Each column by turning or pushing all that hangs from one joint a little, and looking how far the cuts open."""
    motion = store.motion(name, 7)
    group = next(each for each in motion.structure.groups if len(each.cuts) > 1)
    named = Named(
        force_programs(motion_programs(motion.mechanism, AS_IT_IS)), lambda link: 0.0, lambda link: (0.0, 0.0)
    )
    case = Solved(motion, lw.solve_forces(motion), named)
    for cut in every(group.cuts, least=2):
        assert not cut.slides
    columns = []
    for step in every(group.unknowns):
        assert step.turns
        pivot = motion.point(step.joint).position
        column = []
        for cut in group.cuts:
            gap = np.zeros((motion.steps, 2))
            for sense, end in ((1.0, cut.a), (-1.0, cut.b)):
                place = motion.point(cut.joint).position
                if step in group.path(end):
                    arm, (c, s) = place - pivot, (np.cos(1e-6), np.sin(1e-6))
                    place = pivot + arm @ np.array([[c, s], [-s, c]])
                gap = gap + sense * place
            column.append(gap / 1e-6)
        columns.append(np.concatenate(column, axis=1))
    matrix = np.stack(columns, axis=2)
    wanted = np.abs(np.linalg.det(matrix / np.linalg.norm(matrix, axis=1, keepdims=True)))
    quantity = case.named.quantity(f"conditioning {group.cuts[0].joint}")
    assert case.row(quantity)[2] == pytest.approx(wanted, rel=1e-5)


def test_no_jerk_is_known_of_a_driver_with_a_law_of_its_own() -> None:
    law = DRY.replace("speed: 3 rad/s}", "position: 1 rad*sin(t/(1 s))}\ncycle: {duration: 1 s}")
    with refused("study.no_jerk", RequestError, name="rod.angular_jerk", driver="driver"):
        solved(law, 6).named.quantity("rod.angular_jerk")
