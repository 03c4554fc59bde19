"""Syntheses whose parts are kept in a file give results that are equal to the bit."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest
from tests.refusals import refused

import linkwright as lw

pytest.importorskip("llvmlite")
pytestmark = pytest.mark.rotating
RING = [(20, 10), (17.66, 15.142), (11.736, 17.878), (5, 16.928), (0.6, 12.736), (1, 6), (6, 2)]
ANGLES = [0, 0.3, 0.5, *[math.nan] * 4]
TASKS: dict[str, dict[str, Any]] = {
    "path": {"points": RING},
    "motion": {"poses": [(x, y, angle) for (x, y), angle in zip(RING, ANGLES, strict=True)]},
}


def data(task: str) -> str:
    try:
        return json.dumps(lw.synthesize(task, **TASKS[task]).data())
    except lw.SynthesisError as error:
        return json.dumps(error.nearest and error.nearest.data())


@pytest.mark.parametrize("task", TASKS)
def test_a_search_that_has_its_parts_in_a_file_gives_the_same_bits(task: str, tmp_path: Path) -> None:
    whole, state = data(task), tmp_path / "a.state"
    for _ in range(2):
        with lw.checkpointing(state, task):
            assert data(task) == whole
        assert state.exists()


def test_a_file_of_another_search_is_refused(tmp_path: Path) -> None:
    state = tmp_path / "a.state"
    with lw.checkpointing(state, "path", 1):
        data("path")
    with refused("optimize.other_state", path=state), lw.checkpointing(state, "path", 2):
        data("path")
