"""The sentence of an input range, where there is one."""

from tests.invariants.fourbars import fourbar

import linkwright as lw
from linkwright.kinematics.refusal import range_sentence


def test_range_sentence_never_raises() -> None:
    assert range_sentence(fourbar(1.0, 1.0, 1.0, 9.0, start=0)) == ""
    assert range_sentence(lw.load("gallery:truss")) == ""
    assert "-78.58484°" in range_sentence(fourbar(3.0, 2.0, 2.5, 4.0, start=0))
