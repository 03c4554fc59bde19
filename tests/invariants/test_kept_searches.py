"""Syntheses that are stopped go on from a file, with results equal to the bit."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

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
def test_an_interrupted_search_goes_on_with_the_same_bits(task: str, tmp_path: Path) -> None:
    whole, calls, state = data(task), list[float](), tmp_path / "a.state"

    def interrupt(done: int, total: int) -> None:
        calls.append(done / total)
        if calls[-1] > 0.4:
            raise KeyboardInterrupt

    with pytest.raises(lw.Interrupted) as stopped, lw.kept_in(state, task), lw.reporting(interrupt):
        data(task)
    assert stopped.value.state == state and state.exists()
    with lw.kept_in(state, task):
        assert data(task) == whole
