"""Worked solutions reckoned again: every line from its printed numbers, every result against the solver."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.reference.geared_loops import looped_case, reordered
from tests.reference.geared_mechanisms import geared_case
from tests.reference.random_mechanisms import random_mechanism
from tests.worked_reading import against_solver, last_digit, reckon, reckon_lines

import linkwright as lw

GALLERY = tuple(lw.gallery_names())
#: Columns that a worked solution does not print: times, checks, totals.
BESIDE = ("time", "residual", "shaking")


def forces_of(mechanism: lw.Mechanism, steps: int = 5) -> lw.Forces:
    return lw.solve_forces(lw.solve_motion(mechanism, steps=steps, failures="mark"))


def reached(forces: lw.Forces) -> int:
    """A position in the middle that was reached."""
    good = np.flatnonzero(forces.motion.ok)
    return int(good[len(good) // 2])


@cache
def gallery_page(name: str) -> tuple[lw.Forces, lw.Worked]:
    forces = forces_of(store.machine(name))
    return forces, lw.worked(forces, reached(forces))


@pytest.mark.rotating
@pytest.mark.parametrize("name", GALLERY)
def test_gallery_comes_out_with_a_calculator(name: str) -> None:
    forces, page = gallery_page(name)
    assert reckon_lines(page) == []
    wrong, _ = against_solver(page, forces)
    assert wrong == []


@pytest.mark.rotating
@pytest.mark.parametrize("seed", range(24))
def test_any_mechanism_comes_out_with_a_calculator(seed: int) -> None:
    forces = forces_of(lw.loads(random_mechanism(seed, with_loads=True)), steps=3)
    page = lw.worked(forces, 1)
    assert reckon_lines(page) == []
    wrong, _ = against_solver(page, forces)
    assert wrong == []


@pytest.mark.rotating
@pytest.mark.parametrize("seed", [10, 13, 18, 23, 26, 33])
def test_geared_loops_and_racks_come_out_with_a_calculator(seed: int) -> None:
    times = np.linspace(0.0, 0.12, 5)
    forces = lw.solve_forces(lw.solve_motion(lw.loads(geared_case(seed).text), times=times))
    page = lw.worked(forces, 3)
    assert reckon_lines(page) == []
    wrong, seen = against_solver(page, forces)
    assert wrong == []
    columns = forces.motion.columns()
    moving = [name for name, values in columns.items() if abs(values[3]) > 1e-9]
    assert [name for name in moving if name not in seen and not any(word in name for word in BESIDE)] == []


@pytest.mark.rotating
@pytest.mark.parametrize("seed", [2, 7, 8, 13, 20])
def test_loops_whose_pairs_act_on_cut_pins_come_out_with_a_calculator(seed: int) -> None:
    """Gears, belts and racks between links of a loop, read in an order in which a pin beside them is cut."""
    text = reordered(looped_case(seed).text, np.random.default_rng([seed, 0 if seed != 7 else 1]))
    forces = lw.solve_forces(lw.solve_motion(lw.loads(text), times=np.linspace(0.0, 0.12, 5)))
    page = lw.worked(forces, 3)
    assert "λ_" in page.text()
    assert reckon_lines(page) == []
    wrong, _ = against_solver(page, forces)
    assert wrong == []


def test_the_row_of_a_pair_is_put_into_the_closure_equations() -> None:
    """Geared five-bar on an arm: φ4 = 2 φ3 - φ1 + β by hand (ratio 2 on carrier 1), in all four components."""
    motion = lw.solve_motion(lw.loads(geared_case(23).text), times=[0.0, 0.05])
    (group,) = [g for g in motion.structure.groups if len(g.cuts) > 1]
    steps = [step for step in lw.worked(motion, 1).data()["steps"] if step["group"] == group.name]
    positions = next(step for step in steps if any("relation" in item for item in step["items"]))
    tied, *closures = [item["relation"] for item in positions["items"] if "relation" in item]
    assert tied == "φ4 = i_g1,3·φ3 + i_g1,1·φ1 + β_g1"
    lines = {line.symbol: line for line in lw.worked(motion, 1).equations}
    assert (lines["i_g1,3"].value, lines["i_g1,1"].value) == (2.0, -1.0)
    assert len(closures) == 4
    assert sum("cos(i_g1,3·φ3 + i_g1,1·φ1 + β_g1)" in each for each in closures) == 2
    assert not any("φ4" in each for each in closures)


@pytest.mark.rotating
@pytest.mark.parametrize("name", GALLERY)
def test_nothing_of_the_motion_is_left_out(name: str) -> None:
    forces, page = gallery_page(name)
    _, seen = against_solver(page, forces)
    columns = forces.motion.columns()
    moving = [
        column
        for column, values in columns.items()
        if not any(word in column for word in BESIDE) and abs(values[page.position]) > 1e-9
    ]
    assert [column for column in moving if column not in seen] == []


@pytest.mark.rotating
@pytest.mark.parametrize("name", GALLERY)
def test_every_joint_force_and_effort_is_found(name: str) -> None:
    forces, page = gallery_page(name)
    _, seen = against_solver(page, forces)
    for joint, held in every(forces.mechanism.joints.items()):
        links = [link for link in held.joined if link != "frame"]
        printed = [link for link in links if f"{joint} on {link}.x [N]" in seen]
        assert len(printed) >= (len(links) if len(held.joined) > 2 else 1), joint
    efforts = [column for column in forces.columns() if ".effort" in column]
    assert set(efforts) <= seen


@pytest.mark.long
def test_a_wrong_line_would_be_found() -> None:
    assert reckon("2·(-3)² - √(16)/cos(60°)") == pytest.approx(10.0)
    assert reckon("-3²") == -9.0
    assert reckon("atan2(-1, -1) + 10°") == pytest.approx(-125.0)
    assert last_digit("12.30") == pytest.approx(0.01)
    assert last_digit("1.25e-7") == pytest.approx(1e-9)
