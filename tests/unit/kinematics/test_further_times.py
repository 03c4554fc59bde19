"""Times between those of a motion, solved from it."""

import numpy as np
import pytest
from tests.failures.limited_machines import TRIPLE_ROCKER
from tests.reference.general_case import general_case

import linkwright as lw
from linkwright.kinematics.solve import with_times


@pytest.mark.parametrize("tracked", [True, False])
def test_further_times_of_a_motion_lie_on_its_way(tracked: bool) -> None:
    """They are reached where the positions on both sides are, and these are what they were."""
    text = general_case(7017).text if tracked else TRIPLE_ROCKER.format(x=4.0, y=0.0, start=0.0)
    known = lw.solve_motion(lw.loads(text), steps=90, failures="mark")
    period, ahead = known.positions.period, np.roll(known.ok, -1)
    assert period is not None and known.ok.any() and not known.ok.all()
    between = known.time + 0.37 * period / 90
    found, rows = with_times(known, between)
    own = np.searchsorted(found.time, known.time)
    assert np.array_equal(found.time[own], known.time) and found.time[rows] == pytest.approx(between)
    assert np.array_equal(found.ok[own], known.ok)
    for link in known.mechanism.links:
        there = found.link(link).direction[own]
        assert there[known.ok] == pytest.approx(known.link(link).direction[known.ok], abs=1e-12)
    assert found.ok[rows][known.ok & ahead].all() and not found.ok[rows][~known.ok & ~ahead].any()
