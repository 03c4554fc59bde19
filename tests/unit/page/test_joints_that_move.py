"""A page is told which joints move against each other."""

from tests.invariants.brackets import BRACKET

import linkwright as lw
from linkwright.page.programs import PagePrograms


def test_a_page_is_told_which_joints_move() -> None:
    motion = lw.solve_motion(lw.loads(BRACKET), steps=36)
    programs = PagePrograms(motion)
    program, (first, *_) = programs.main, programs.friction()
    assert {each["rate"] for each in programs.friction()} <= set(dict(program.outputs))
    assert str(first["rate"]).startswith("moving ")
