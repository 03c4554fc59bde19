"""Examples of findings and of their mends: parts of a model file, wrong and right."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Mend:
    """A section of a model that has a finding, and the same without it."""

    wrong: str
    right: str


MENDS: Mapping[str, Mend] = {
    "missing-unit": Mend(
        "links:\n  crank: {points: [O1, A], length: 100}", "links:\n  crank: {points: [O1, A], length: 100 mm}"
    ),
    "unknown-key": Mend(
        "links:\n  crank: {points: [O1, A], lenght: 100 mm}", "links:\n  crank: {points: [O1, A], length: 100 mm}"
    ),
}
