"""The cognates of a four-bar: three four-bars draw every coupler curve.

With λ = (P - A)/(B - A) the third pivot is O3 = O1 + λ (O2 - O1); the cognate at O1 has the pins A' = O1 + P - A and
B' = A' + λ (A - O1), that at O2 the pins A' = O2 + P - B and B' = A' + (1 - λ)(B - O2).
Source: Roberts 1875, Proc. London Math. Soc. 7.
"""

from __future__ import annotations

import numpy as np

from linkwright.core.arguments import require
from linkwright.synthesis.assessment import Assessment, assess_four_bars
from linkwright.synthesis.build import four_bar_candidate, path_of_four_bar
from linkwright.synthesis.linkage import Linkage
from linkwright.synthesis.result import Candidate, Synthesis, SynthesisError
from linkwright.words import _

Four = tuple[complex, complex, complex, complex]


def cognates(linkage: Linkage) -> Synthesis:
    """The linkage and its two cognates, in the same pose, each with its facts.

    Raises:
        SynthesisError: the linkage is not a four-bar with a coupler point P, or P lies on a pin.
    """
    require(linkage, Linkage)
    points = linkage.points
    if linkage.guides or not {"O1", "A", "B", "O2", "P"} <= set(points):
        raise SynthesisError(
            _(
                "cognates belong to a four-bar with pins and a coupler point P; give one",
                code="synthesize.cognates.four_bar",
            )
        )
    o1, a, b, o2, p = (points[name] for name in ("O1", "A", "B", "O2", "P"))
    if min(abs(p - a), abs(p - b)) < 1e-9 * abs(b - a):
        raise SynthesisError(
            _(
                "the coupler point lies on a pin, so its path is a circle without cognates; move it",
                code="synthesize.cognates.pin",
            )
        )
    found = tuple(_candidate(each, p) for each in ((o1, a, b, o2), *both(o1, a, b, o2, p)))
    return Synthesis("cognates", found)


def both(o1: complex, a: complex, b: complex, o2: complex, p: complex) -> tuple[Four, Four]:
    """(O1, A, B, O2) of the cognates that keep the first and the second pivot."""
    share = (p - a) / (b - a)
    o3 = o1 + share * (o2 - o1)
    first, second = o1 + p - a, o2 + p - b
    return (o1, first, first + share * (a - o1), o3), (o2, second, second + (1 - share) * (b - o2), o3)


def _candidate(four: Four, p: complex) -> Candidate:
    o1, a, b, o2 = four
    pins = np.array([a]), np.array([b])
    facts: Assessment = assess_four_bars(np.array([o1]), pins[0][None], pins[1][None], np.array([o2]))
    return four_bar_candidate(o1, *pins, o2, facts, 0, 0.0, p=p, curve=path_of_four_bar(o1, a, b, o2, p))
