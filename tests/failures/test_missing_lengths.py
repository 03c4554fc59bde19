"""How much a group lacks to reach, and in which direction: the sentence gives the length that must be added."""

from __future__ import annotations

from collections.abc import Mapping

import pytest
from tests.refusals import noted

from linkwright.groups import DYADS


@pytest.mark.parametrize(
    ("dyad", "facts", "code", "values"),
    [
        (
            "RRR",
            {"distance²": 16.0, "first²": 1.0, "second²": 4.0},
            "rrr_far",
            {"distance": "4 m", "reach": "3 m", "missing": "1 m"},
        ),
        (
            "RRR",
            {"distance²": 0.25, "first²": 9.0, "second²": 1.0},
            "rrr_near",
            {"distance": "0.5 m", "reach": "2 m", "missing": "1.5 m"},
        ),
        (
            "RRR",
            {"distance²": 0.25, "first²": 1.0, "second²": 9.0},
            "rrr_near",
            {"distance": "0.5 m", "reach": "2 m", "missing": "1.5 m"},
        ),
        (
            "RRP",
            {"height": 3.0, "length²": 4.0},
            "rrp_far",
            {"height": "3 m", "length": "2 m", "missing": "1 m"},
        ),
        (
            "RRP",
            {"height": -3.0, "length²": 4.0},
            "rrp_far",
            {"height": "3 m", "length": "2 m", "missing": "1 m"},
        ),
        (
            "RPR",
            {"distance²": 0.04, "offset": 0.5},
            "rpr_near",
            {"distance": "0.2 m", "offset": "0.5 m", "missing": "0.3 m"},
        ),
        (
            "RPR",
            {"distance²": 0.04, "offset": -0.5},
            "rpr_near",
            {"distance": "0.2 m", "offset": "0.5 m", "missing": "0.3 m"},
        ),
    ],
)
def test_what_is_missing_is_said_as_a_length(
    dyad: str, facts: Mapping[str, float], code: str, values: dict[str, object]
) -> None:
    told = DYADS[dyad]().explain(facts)
    noted([told], f"outcome.{code}", **values)
