"""Which of many designs touch a change point between two positions: those by formula, wherever it lies."""

from __future__ import annotations

import numpy as np
import pytest
from tests.invariants.just_turning import FOURBAR, SLIDE

import linkwright as lw
from linkwright.designs.failures import ChangePoints, near_enough
from linkwright.designs.traced_outputs import Traced
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.passing import NEAR


def found(text: str, address: str, values: list[float], steps: int, backend: str = "numpy") -> list[int]:
    mechanism = lw.loads(text)
    columns = {address: np.array(values)}
    traced = Traced(mechanism, columns, over_cycle(mechanism, steps))
    return ChangePoints(traced, backend).designs(columns).tolist()  # type: ignore[arg-type]


@pytest.mark.parametrize("speed", [3, -3])
@pytest.mark.parametrize("start", [0, 175, 180, 183, 5])
@pytest.mark.parametrize("steps", [36, 37])
def test_a_crank_that_just_turns(steps: int, start: int, speed: int) -> None:
    """Crank 1 m, coupler 3.5 m, rocker 2.5 m: they are stretched over a frame of 5 m at 180°, folded over one of 2 m
    at 0°; beyond they part, for little or for much of the turn."""
    text = FOURBAR.replace("SPEED", str(speed)).replace("START", str(start))
    frames = [4.0, 5.0, 4.99, 5.0 + 1e-7, 4.9999, 5.00001, 2.5, 2.0, 2.01, 2.0 - 1e-7, 5.0, 3.0]
    assert found(text, "frame.Q.x", frames, steps) == [1, 3, 5, 7, 9, 10]


def test_blocks_of_designs_and_compiled_ones_are_numbered_through(monkeypatch: pytest.MonkeyPatch) -> None:
    text = FOURBAR.replace("SPEED", "3").replace("START", "5")
    frames = [4.0, 5.0, 4.0, 4.0, 4.5, 5.0, 4.0]
    assert found(text, "frame.Q.x", frames, 36, "llvm") == [1, 5]
    monkeypatch.setattr("linkwright.designs.failures.BLOCK", 3)
    assert found(text, "frame.Q.x", frames, 36) == [1, 5]
    assert found(text, "frame.Q.x", [], 36) == []


@pytest.mark.parametrize("shift", [0.0, 0.1, 0.13, 1.3, 3.1])
@pytest.mark.parametrize("steps", [24, 35])
def test_a_block_to_and_fro(steps: int, shift: float) -> None:
    """It goes from 0.6 m to 2.4 m; the arms of 1 m and r are stretched over 1 m + r and folded over |r - 1 m|."""
    text = SLIDE.replace("SHIFT", str(shift))
    rockers = [1.5, 1.4, 1.45, 1.6, 1.4 - 1e-7, 1.41, 1.6 + 1e-7, 1.59]
    assert found(text, "rocker.length", rockers, steps) == [1, 3, 4, 6]


def test_quality_is_looked_at_the_closer_the_finer_the_positions() -> None:
    mechanism = lw.loads(FOURBAR.replace("SPEED", "3").replace("START", "5"))
    few, many, most = (near_enough(over_cycle(mechanism, steps)) for steps in (36, 72, 100_000))
    assert few == pytest.approx(4 * many) and few == pytest.approx(25 * (2 * np.pi / 36) ** 2)
    assert most == NEAR < many


@pytest.mark.parametrize("steps", [36, 37])
def test_a_table_that_covers_one_cycle_is_looked_at_across_its_end(steps: int) -> None:
    """The block goes from 2.4 m to 1 m and back: the links are stretched where the table begins and ends."""
    text = SLIDE[: SLIDE.index("driver")] + (
        "driver: {slide: guide, table: {time: [0 s, 0.3 s, 0.7 s, 1 s], position: [2.4 m, 1.1 m, 1.1 m, 2.4 m], "
        "interpolation: linear}}\n"
    )
    assert found(text, "rocker.length", [1.5, 1.4, 1.45, 1.4], steps) == [1, 3]
