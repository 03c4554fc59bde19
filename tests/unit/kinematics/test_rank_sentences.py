"""The sentence about the rank of the Jacobian."""

import re

from tests.failures.limited_machines import SWUNG, fourbar

import linkwright as lw
from linkwright.kinematics.rank_of_motion import rank_sentence


def test_no_rank_is_said_where_no_position_is_reached() -> None:
    assert rank_sentence(fourbar(1, 1, 1, 9, start=0)) == ""
    assert rank_sentence(lw.loads(re.sub("cycle:.*\n", "", SWUNG))) == ""
    assert "mobility 1" in rank_sentence(lw.loads(SWUNG))
