"""Outputs in the user's words, summed up by a sweep: those of the solved motion and forces of each design."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from tests.outputs_in_words import DRY, OF_THE_PUSHED, OF_THE_SHAPER, PUSHED, Reading

import linkwright as lw

WORDS = [
    *(("shaper", name, reading) for name, _, reading in OF_THE_SHAPER),
    *(("pushed", name, reading) for name, _, reading in OF_THE_PUSHED),
]
TEXTS = {"shaper": (DRY, 24, "crank.length"), "pushed": (PUSHED, 12, "rod.length")}


def designs(machine: str) -> list[lw.Mechanism]:
    """The machine as it is, and another one."""
    text, _, address = TEXTS[machine]
    mechanism = lw.loads(text)
    return [mechanism.with_dimensions({address: share * mechanism.dimension(address)}) for share in (1.0, 1.01)]


@cache
def solved(machine: str) -> list[lw.Forces]:
    """Both alone, over the positions of the sweep."""
    return [lw.solve_forces(lw.solve_motion(each, steps=TEXTS[machine][1])) for each in designs(machine)]


@pytest.fixture(scope="module")
def swept() -> dict[str, lw.Sweep]:
    """Least and largest of all words, of the machine as it is and of another."""
    found = {}
    for machine, (text, steps, address) in TEXTS.items():
        mechanism = lw.loads(text)
        outputs = [f"{name} {kind}" for which, name, _ in WORDS if which == machine for kind in ("min", "max")]
        lengths = mechanism.dimension(address) * np.array([1.0, 1.01])
        found[machine] = lw.sweep(mechanism, {address: lengths}, outputs=outputs, steps=steps)
    return found


@pytest.mark.parametrize(("machine", "name", "reading"), WORDS)
def test_words_give_what_the_solved_machine_does(
    machine: str, name: str, reading: Reading, swept: dict[str, lw.Sweep]
) -> None:
    for k, forces in enumerate(solved(machine)):
        wanted = reading(forces.motion, forces)
        least, most = (swept[machine][f"{name} {kind}"][k] for kind in ("min", "max"))
        turns = 2.0 * np.pi * np.round((wanted.min() - least) / (2.0 * np.pi)) if "angle" in name else 0.0
        assert (least + turns, most + turns) == pytest.approx(
            (wanted.min(), wanted.max()), rel=1e-9, abs=1e-9 * (1.0 + np.abs(wanted).max())
        )
