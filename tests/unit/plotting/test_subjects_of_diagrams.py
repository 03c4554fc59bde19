"""What diagrams are about where nothing is asked for."""

from typing import Any

import pytest
from tests.invariants.bracket_machines import on_a_bracket

import linkwright as lw
from linkwright.plotting.diagrams.source import joint_and_link, main_output, traced_points


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "shaper_quick_return", "whitworth", "dyad_rpr"])
def test_diagrams_are_about_the_same_whatever_is_welded_to_the_frame(name: str) -> None:
    def subjects(machine: lw.Mechanism) -> tuple[Any, ...]:
        forces = lw.solve_forces(machine, steps=60)
        main = str(main_output(forces.motion))
        return main, traced_points(machine), joint_and_link(forces, None, None)

    assert subjects(on_a_bracket(name)) == subjects(lw.load(f"gallery:{name}"))
