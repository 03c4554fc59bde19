"""Measures of designs that are found one by one, and of fronts."""

from pathlib import Path

import numpy as np
import pytest
from tests.invariants.meshing_pair import GEARS

import linkwright as lw
from linkwright.designs.optimise.evolution import crowding
from linkwright.designs.optimise.measures import Measures
from linkwright.designs.optimise.optimum import hypervolume


def test_designs_that_go_one_by_one_are_kept_by_an_interruption_before_the_first_population(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    state, judged, measured = tmp_path / "state.json", list[float](), Measures.measured

    def one(self: Measures, dimensions: dict[str, float]) -> tuple[float, ...]:
        if len(judged) == 5:
            raise KeyboardInterrupt
        judged.append(dimensions["count"])
        return measured(self, dimensions)

    settings = {
        "vary": {"count": {"whole": "45..60"}},
        "minimize": "count",
        "keep": {"peak_input_torque": "at most 15 N·m"},
    }
    whole = lw.optimize(lw.loads(GEARS), **settings, evaluations=60)
    monkeypatch.setattr(Measures, "measured", one)
    with pytest.raises(lw.Interrupted) as stopped:
        lw.optimize(lw.loads(GEARS), **settings, evaluations=60, state=state)
    assert stopped.value.state == state
    first = judged[:]
    judged.append(0.0)
    rest = lw.optimize(lw.loads(GEARS), **settings, evaluations=60, state=state)
    assert len(set(first)) == 5 and not set(first) & set(judged[6:])
    assert rest.history == whole.history and dict(rest.best.values) == dict(whole.best.values)


def test_hypervolume_and_crowding_in_closed_form() -> None:
    points = np.array([[0.0, 2.0], [1.0, 1.0], [2.0, 0.0]])
    assert hypervolume(points, np.array([3.0, 3.0])) == pytest.approx(6 / 9)
    cube = np.array([[0.0, 0.0, 1.0], [1.0, 1.0, 0.0]])
    assert hypervolume(cube, np.array([2.0, 2.0, 2.0])) == pytest.approx((4 + 1) / 8)
    assert crowding(points)[1] == pytest.approx(2.0)
