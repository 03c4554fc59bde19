"""What each dyad says of its limits, from the numbers at hand."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from linkwright.groups.base import DYADS


@pytest.mark.parametrize(
    ("signature", "facts", "end", "reason"),
    [
        ("RRR", {"distance²": 25.0, "first²": 4.0, "second²": 6.25}, "is stretched",
         "the outer pins are 5 m apart, links of 2 m and 2.5 m reach 4.5 m: 0.5 m missing"),
        ("RRR", {"distance²": 0.04, "first²": 4.0, "second²": 6.25}, "is folded",
         "the outer pins are 0.2 m apart, links of 2 m and 2.5 m need at least 0.5 m: 0.3 m too close"),
        ("RRR", {"distance²": 6.25, "first²": 4.0, "second²": 6.25}, "is folded", None),
        ("RRR", {"distance²": 6.5, "first²": 4.0, "second²": 6.25}, "is stretched", None),
        ("RRP", {"height": -3.0, "length²": 6.25}, "has its link perpendicular to the guide",
         "the outer pin is 3 m from the path of the slider's pin, the link reaches 2.5 m: 0.5 m missing"),
        ("RPR", {"distance²": 4.0, "offset": -2.25}, "has its outer pins as close as the offset of the guide allows",
         "the outer pins are 2 m apart, the guide holds them 2.25 m apart across its direction: 0.25 m too close"),
        ("PRP", {"sine": -1.25e-13}, "has its guides parallel",
         "the two guides are parallel (sine of the angle between them -1.2e-13)"),
        ("RPP", {"sine": 0.0}, "has its guides parallel",
         "the two slides are parallel (sine of the angle between them 0.0e+00)"),
    ],
)  # fmt: skip
def test_a_dyad_names_its_end_and_what_is_missing(
    signature: str, facts: Mapping[str, float], end: str, reason: str | None
) -> None:
    dyad = DYADS[signature]()
    assert str(dyad.at_end(facts)) == end
    assert reason is None or str(dyad.explain(facts)) == reason
