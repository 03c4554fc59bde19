"""Which cycles are passed for certain before they are solved."""

from collections.abc import Callable
from dataclasses import replace

import pytest
from tests.failures.limited_machines import fourbar

import linkwright as lw
from linkwright.kinematics.passing import plainly_passed
from linkwright.mechanism.cycle import Cycle
from linkwright.mechanism.mechanism import Mechanism

PASSED = (
    "crank_rocker",
    "slider_crank_offset",
    "dyad_rpr",
    "parallelogram",
    "change_point_fourbar",
    "triad",
    "scotch_yoke",
    "external_gear_pair",
    "double_slider",
    "truss",
)


@pytest.mark.parametrize("name", PASSED)
def test_what_plainly_passes_its_cycle_is_so_when_it_is_solved(name: str) -> None:
    """Nothing is asked of machines of which plain numbers cannot tell."""
    mechanism = lw.load(f"gallery:{name}")
    motion = lw.solve_motion(mechanism, steps=36, failures="mark")
    whole = len(mechanism.drivers) == 1 and mechanism.cycle is None
    law = next(iter(mechanism.drivers.values())).law if mechanism.drivers else None
    groups = [p for p in motion.solver.motion.placed.values() if p.group.unknowns]
    closed = all("sine" not in p.facts and p.dyad is not None for p in groups)
    wheels = any(joint.higher for joint in mechanism.joints.values())
    plain = whole and law is not None and law.constant_speed is not None and law.rotary and closed and not wheels
    found = plainly_passed(mechanism, lw.structure(mechanism), 36)
    assert (found is not None) == (plain and bool(motion.ok.all()) and not motion.notes)


@pytest.mark.parametrize(
    ("make", "passed"),
    [
        (lambda: fourbar(1, 3, 2.5, 2, start=20), True),
        (lambda: fourbar(3, 1, 2.8, 3.2, start=50), False),
        (lambda: fourbar(1.00001, 3, 2, 4, start=20.5), False),
        (lambda: fourbar(0.99999, 3, 2, 4, start=20.5), False),
        (lambda: fourbar(0.9, 3, 2, 4, start=20.5), True),
        (lambda: replace(fourbar(1, 3, 2.5, 2, start=20), cycle=Cycle(turns=1.0)), False),
    ],
)
@pytest.mark.parametrize("steps", [5, 90])
def test_a_crank_that_comes_near_to_its_end_is_not_said_to_pass(
    make: Callable[[], Mechanism], passed: bool, steps: int
) -> None:
    mechanism = make()
    assert (plainly_passed(mechanism, lw.structure(mechanism), steps) is not None) is passed
