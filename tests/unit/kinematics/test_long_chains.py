"""Long chains of dyads cost what their links cost: no program of its own for every link or group."""

import pytest
from tests.invariants.fourbars import four_bars

import linkwright as lw
from linkwright.analysis import Analysis
from linkwright.formula.program import Program
from linkwright.kinematics.placement import placements
from linkwright.kinematics.solver import MotionSolver


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
