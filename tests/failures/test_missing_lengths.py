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
            {"distance": "4000 mm", "reach": "3000 mm", "missing": "1000 mm"},
        ),
        (
            "RRR",
            {"distance²": 0.25, "first²": 9.0, "second²": 1.0},
            "rrr_near",
            {"distance": "500 mm", "reach": "2000 mm", "missing": "1500 mm"},
        ),
        (
            "RRR",
            {"distance²": 0.25, "first²": 1.0, "second²": 9.0},
            "rrr_near",
            {"distance": "500 mm", "reach": "2000 mm", "missing": "1500 mm"},
        ),
        (
            "RRP",
            {"height": 3.0, "length²": 4.0},
            "rrp_far",
            {"height": "3000 mm", "length": "2000 mm", "missing": "1000 mm"},
        ),
        (
            "RRP",
            {"height": -3.0, "length²": 4.0},
            "rrp_far",
            {"height": "3000 mm", "length": "2000 mm", "missing": "1000 mm"},
        ),
        (
            "RPR",
            {"distance²": 0.04, "offset": 0.5},
            "rpr_near",
            {"distance": "200 mm", "offset": "500 mm", "missing": "300 mm"},
        ),
        (
            "RPR",
            {"distance²": 0.04, "offset": -0.5},
            "rpr_near",
            {"distance": "200 mm", "offset": "500 mm", "missing": "300 mm"},
        ),
    ],
)
def test_what_is_missing_is_said_as_a_length(
    dyad: str, facts: Mapping[str, float], code: str, values: dict[str, object]
) -> None:
    told = DYADS[dyad]().explain(facts)
    noted([told], f"outcome.{code}", **values)
