"""What each dyad says of its limits, from the numbers at hand."""

from __future__ import annotations

from collections.abc import Mapping

import pytest
from tests.refusals import agrees

from linkwright.groups.base import DYADS


@pytest.mark.parametrize(
    ("signature", "facts", "end", "reason", "values"),
    [
        (
            "RRR",
            {"distance²": 25.0, "first²": 4.0, "second²": 6.25},
            "range.stretched",
            "outcome.rrr_far",
            {"distance": "5000 mm", "first": "2000 mm", "second": "2500 mm", "reach": "4500 mm", "missing": "500 mm"},
        ),
        (
            "RRR",
            {"distance²": 0.04, "first²": 4.0, "second²": 6.25},
            "range.folded",
            "outcome.rrr_near",
            {"distance": "200 mm", "first": "2000 mm", "second": "2500 mm", "reach": "500 mm", "missing": "300 mm"},
        ),
        ("RRR", {"distance²": 6.25, "first²": 4.0, "second²": 6.25}, "range.folded", None, {}),
        ("RRR", {"distance²": 6.5, "first²": 4.0, "second²": 6.25}, "range.stretched", None, {}),
        (
            "RRP",
            {"height": -3.0, "length²": 6.25},
            "range.perpendicular",
            "outcome.rrp_far",
            {"height": "3000 mm", "length": "2500 mm", "missing": "500 mm"},
        ),
        (
            "RPR",
            {"distance²": 4.0, "offset": -2.25},
            "range.closest",
            "outcome.rpr_near",
            {"distance": "2000 mm", "offset": "2250 mm", "missing": "250 mm"},
        ),
        ("PRP", {"sine": -1.25e-13}, "range.parallel", "outcome.prp_parallel", {"sine": "-1.2e-13"}),
        ("RPP", {"sine": 0.0}, "range.parallel", "outcome.rpp_parallel", {"sine": "0.0e+00"}),
    ],
)
def test_a_dyad_names_its_end_and_what_is_missing(
    signature: str, facts: Mapping[str, float], end: str, reason: str | None, values: Mapping[str, str]
) -> None:
    dyad = DYADS[signature]()
    assert dyad.at_end(facts).code == end
    if reason is not None:
        said = dyad.explain(facts)
        assert said.code == reason
        agrees(said.values, values)
