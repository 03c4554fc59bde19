"""Results depend on the numbers of a mechanism only, never on what was solved before, to the bit."""

from __future__ import annotations

import pickle
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.every import every
from tests.invariants.edited_machines import EDITS, RUBBING, torque
from tests.store import machine

import linkwright as lw

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> dict[str, NDArray[np.float64]]:
    """Torques of the edited machines, found by a process that has solved nothing else."""
    file = tmp_path_factory.mktemp("alone") / "torques.npz"
    subprocess.run(
        [sys.executable, "-m", "tests.invariants.edited_machines", str(file)], cwd=ROOT, check=True, timeout=300
    )
    with np.load(file) as found:
        return dict(found)


@pytest.mark.parametrize("name", EDITS)
def test_an_edited_machine_gives_the_same_bits_whatever_was_solved_before(
    name: str, alone: dict[str, NDArray[np.float64]]
) -> None:
    before, after = EDITS[name]()
    was = torque(before)
    now = torque(after)
    assert np.array_equal(now, alone[name])
    assert not np.array_equal(now, was)


@pytest.mark.parametrize("static", [False, True])
@pytest.mark.parametrize(
    "name",
    [
        "jaw_crusher_sixbar",
        "swing_conveyor",
        "toggle_press",
        "excavator",
        "parallelogram",
        "triad",
        "change_point_fourbar",
    ],
)
def test_motion_and_forces_together_have_the_bits_of_one_after_the_other(name: str, static: bool) -> None:
    mechanism = machine(name)
    apart = lw.solve_forces(lw.solve_motion(mechanism, steps=144), static=static)
    together = lw.solve_forces(mechanism, steps=144, static=static)
    for other in (together, lw.solve_forces(apart.motion, static=static)):
        assert (other.notes, other.motion.notes) == (apart.notes, apart.motion.notes)
        for one, two in zip(every(apart.columns().items()), other.columns().items(), strict=True):
            assert one[0] == two[0] and np.array_equal(one[1], two[1], equal_nan=True), one[0]


def test_eight_threads_find_what_one_does() -> None:
    """A machine of names of its own, of which nothing is known before the threads begin."""
    given = lw.loads(RUBBING.replace("rod", "shared_rod"))
    designs = [given.with_dimensions({"crank.length": 0.1 + 1e-3 * k}) for k in range(16)]
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(torque, designs))
    for one, design in zip(found, designs, strict=True):
        assert np.array_equal(one, torque(design))


@pytest.mark.parametrize(
    "name", ["jaw_crusher_sixbar", "excavator", "planetary_two_inputs", "rack_and_rocker", "swing_conveyor"]
)
def test_every_changed_value_is_in_the_elements_of_the_new_mechanism(name: str) -> None:
    mechanism = machine(name)
    for address, value in every(mechanism.dimensions().items()):
        if value and address not in mechanism.expressions:
            changed = mechanism.with_dimensions({address: 1.0001 * value})
            found_anew = pickle.loads(pickle.dumps(changed)).dimensions()
            assert found_anew == changed.dimensions()
            assert found_anew[address] == 1.0001 * value
