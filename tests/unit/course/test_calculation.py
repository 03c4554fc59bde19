"""Worked solutions as chains of calculation, from which the answers of mistakes are reckoned."""

import pytest
from tests import store

import linkwright as lw
from linkwright.course.grade import MISTAKE_NAMES
from linkwright.course.mistakes import MISTAKES, Calculation, lines_of


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "shaper_quick_return", "dyad_rpr", "triad", "toggle_press"])
def test_a_worked_solution_can_be_reckoned_again(name: str) -> None:
    """Every line from those before it gives the solver's numbers."""
    forces = store.forces(name, 36)
    values = Calculation(lines_of(lw.worked(forces, 5))).values()
    columns = forces.columns()
    seen = [output for output in values if output.heading in columns and output.dimension != "angle"]
    assert len(seen) > 10
    for output in seen:
        assert values[output] == pytest.approx(columns[output.heading][5], rel=1e-6, abs=1e-6), output


def test_every_mistake_has_its_word() -> None:
    assert len(MISTAKES) == 8
    assert set(MISTAKE_NAMES) == set(MISTAKES)
