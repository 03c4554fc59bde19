"""What reductions of a program refuse."""

from typing import Any

import pytest

from linkwright.formula.program import Program
from linkwright.formula.reductions import Accumulation, Reduction
from linkwright.formula.trace import Trace


def test_a_sum_over_what_is_not_there_is_refused() -> None:
    t = Trace()
    program = Program.of(t, {"y": t.position("x") * 2.0})
    for more, named in (({"valid": "nope"}, "'nope'"), ({"reductions": (Reduction("q", "max"),)}, "'q'")):
        given: dict[str, Any] = {"reductions": (), **more}
        with pytest.raises(ValueError, match=named):
            Accumulation(program, **given)
    assert Accumulation(program, (Reduction("y", "max"),)).valid is None
