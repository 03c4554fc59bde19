"""Long chains of dyads cost what their links cost: no program of its own for every link or group."""

from itertools import pairwise

import numpy as np
import pytest
from tests.invariants.fourbars import four_bars

import linkwright as lw
from linkwright.engine.program import Program
from linkwright.kinematics.solver import MotionSolver
from linkwright.metrics import Analysis
from linkwright.plot.drawing.labels import Obstacles
from linkwright.plot.drawing.view import placements


def programs_of(count: int, monkeypatch: pytest.MonkeyPatch) -> int:
    """How many programs it takes to assemble, place and analyse a chain of so many four-bars."""
    made, of = [], Program.of
    with monkeypatch.context() as patch:
        patch.setattr(Program, "of", lambda *given, **more: made.append(given) or of(*given, **more))
        machine = four_bars(count)
        _ = MotionSolver(machine).assembly
        motion = lw.solve_motion(machine, steps=12)
        placements(motion)
        analysis = Analysis.of(motion)
        analysis.limits(analysis.outputs[0])
    return len(made)


def test_programs_do_not_grow_with_the_links(monkeypatch: pytest.MonkeyPatch) -> None:
    assert programs_of(5, monkeypatch) == programs_of(9, monkeypatch)


def test_ink_under_boxes_is_that_of_densely_sampled_segments() -> None:
    noise = np.random.default_rng(3)
    line = noise.uniform(0.0, 40.0, (30, 2))
    corner = noise.uniform(0.0, 30.0, (12, 2))
    boxes = np.hstack([corner, corner + noise.uniform(2.0, 15.0, (12, 2))])
    found = Obstacles.of([line]).under(boxes)
    share = (np.arange(20000) + 0.5) / 20000
    for box, length in zip(boxes, found, strict=True):
        expected = 0.0
        for start, end in pairwise(line):
            places = start + share[:, None] * (end - start)
            inside = float(((places >= box[:2]) & (places <= box[2:])).all(axis=1).mean())
            expected += inside * float(np.hypot(*(end - start))) + 4.0 * (inside > 0)
        assert length == pytest.approx(expected, rel=1e-3, abs=5e-3)
