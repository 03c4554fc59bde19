"""Dyads as functions refuse what cannot be assembled, and what is no number, with a sentence that says which."""

from __future__ import annotations

import numpy as np
import pytest
from tests.refusals import refused

import linkwright as lw
from linkwright.dyads import Body, Line, Load, bar_forces, forces, prp, rpp, rpr, rrp, rrr
from linkwright.errors import RequestError


def test_says_in_which_position_and_by_how_much():
    with refused("dyads.apart", lw.PositionError, index="1", count=2, of=3, signature="RRR") as caught:
        rrr((0, 0), [(0.3, 0), (0.6, 0), (0.7, 0)], (0.25, 0.25))
    assert caught.value.failed == (1, 2)
    assert "outcome.rrr_far" in str(caught.value.values["reason"].code)
    assert caught.value.values["missing"] == "100 mm"


@pytest.mark.parametrize(
    ("solve", "reason", "missing"),
    [
        (lambda: rrr((0, 0), (0.1, 0), (0.4, 0.2)), "outcome.rrr_near", "100 mm"),
        (lambda: rrp((0, 0.5), Line((0, 0)), 0.3, 0.1), "outcome.rrp_far", "100 mm"),
        (lambda: rpr((0, 0), (0.3, 0), (0.2, 0.2)), "outcome.rpr_near", "100 mm"),
        (lambda: prp(Line((0, 0), 0.3), Line((1, 0), 0.3)), "outcome.prp_parallel", None),
        (lambda: rpp((0, 0), Line((1, 0), 0.3), np.pi), "outcome.rpp_parallel", None),
        (lambda: rrr((0, 0), (0.5, 0), (0.25, 0.25)), "dyads.singular", None),
        (lambda: rrr((0, 0), (np.nan, 0), (0.25, 0.25)), "dyads.not_finite", None),
    ],
)
def test_why_a_dyad_is_not_assembled(solve, reason, missing):
    with refused("dyads.apart_alone", lw.PositionError) as caught:
        solve()
    assert caught.value.values["reason"].code == reason
    if missing:
        assert caught.value.values["missing"] == missing
    assert caught.value.translate("zh") != str(caught.value)


def test_what_is_no_number_point_line_mode_or_body():
    with refused("given_instead.no_choice", RequestError, option="mode"):
        rrr((0, 0), (0.3, 0), (0.25, 0.25), "forward")
    with refused("dyads.no_pairs", RequestError, name="second"):
        rrr((0, 0), 0.3, (0.25, 0.25))
    with refused("dyads.no_numbers", RequestError, name="lengths"):
        rrr((0, 0), (0.3, 0), ("a", 0.25))
    with refused("dyads.no_two", RequestError, name="lengths"):
        rrr((0, 0), (0.3, 0), 0.25)
    with refused("dyads.no_length", RequestError, name="lengths", value="-0.2"):
        rrr((0, 0), (0.3, 0), (0.25, [-0.2, 0.2]))
    with refused("dyads.no_length", RequestError, name="length", value="0"):
        rrp((0, 0), Line((0, 0)), 0.0)
    with refused("dyads.no_line", RequestError, name="guide"):
        rrp((0, 0), (0, 0), 0.3)
    with refused("dyads.no_shape", RequestError):
        rrr(np.zeros((3, 2)), np.full((4, 2), 0.3), (0.25, 0.25))
    found = rrr((0, 0), (0.3, 0), (0.25, 0.25))
    with refused("dyads.no_slide", RequestError, signature="RRR"):
        _ = found.slide
    with refused("dyads.no_place", RequestError, name="second"):
        forces(found, None, Body(loads=[Load((1.0, 0.0))]))
    with refused("dyads.no_body", RequestError, name="first"):
        forces(found, 2.0)
    with refused("dyads.no_motion", RequestError):
        forces(found.first)
    with refused("dyads.no_line", RequestError, name="bar"):
        bar_forces(found)
    with refused("given_instead.no_choice", RequestError, option="joint"):
        forces(found).reaction("B")
    with refused("given_instead.no_choice", RequestError, option="on"):
        forces(found).reaction("outer_1", on="second")
