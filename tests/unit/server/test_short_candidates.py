"""Candidates of searches have short numbers in the unit of a person, and do what the card says."""

from __future__ import annotations

import re
import time
from typing import Any

import numpy as np
import pytest

import linkwright as lw
from linkwright.errors import LinkwrightError
from linkwright.server.background import Background
from linkwright.server.request import length_unit
from linkwright.server.search import linkages
from linkwright.server.synthesis import designed

NUMBER = r"(-?\d+(?:\.\d+)?)"
POSES = [[0, 0, 0], [50, 20, 30], [90, 60, 70]]
PLACES = [[round(50 * np.cos(t) + 8 * np.cos(3 * t), 1), round(30 * np.sin(t), 1)] for t in np.linspace(0.0, 5.8, 14)]


def _candidates(work: Any) -> list[dict[str, Any]]:
    background = Background()
    background.begin("synthesis", work, "en")
    for _ in range(3000):
        found = background.state()
        if not found["running"]:
            return list(found["candidates"])
        time.sleep(0.02)
    raise AssertionError("the search does not end")


def _significant(text: str, unit: str) -> int:
    """The most digits of a length."""
    found = [each.strip("-0").replace(".", "").strip("0") for each in re.findall(rf"{NUMBER} {unit}\b", _model(text))]
    return max(len(each) for each in found)


def _model(text: str) -> str:
    return "\n".join(line for line in text.splitlines() if not line.startswith(("name:", "purpose:")))


def _path(text: str, steps: int = 3600) -> np.ndarray:
    x, y = lw.solve_motion(lw.loads(text, "found.yaml"), steps=steps).point("P").position.T
    return np.asarray(x + 1j * y)


def test_poses_are_met_to_the_micrometre_by_lengths_of_few_digits() -> None:
    for candidate in _candidates(designed("motion", {"poses": POSES})):
        assert _significant(candidate["text"], "mm") <= 7
        path = _path(candidate["text"])
        for x, y, _angle in POSES:
            # Positions are up to 0.1 mm apart: what lies between them is on the chord.
            nearest = int(np.argmin(np.abs(path - 1e-3 * (x + 1j * y))))
            ends = path[max(0, nearest - 1)], path[min(len(path) - 1, nearest + 1)]
            along = (ends[1] - ends[0]) / abs(ends[1] - ends[0])
            assert abs(((1e-3 * (x + 1j * y) - ends[0]) * along.conjugate()).imag) < 5e-6


def test_an_error_that_is_larger_leaves_fewer_digits_and_grows_by_a_tenth_at_most() -> None:
    found = _candidates(designed("path", {"points": PLACES}))
    assert found
    for candidate in found:
        number, unit = candidate["error"].split()
        squares = (float(number) * {"mm": 1e-3, "m": 1.0}[unit]) ** 2
        path, places = _path(candidate["text"]), [1e-3 * complex(x, y) for x, y in PLACES]
        solved = sum(float(np.abs(path - place).min()) ** 2 for place in places)
        # Nearest distances of n places, each of which may grow by a tenth of the root of the sum.
        assert np.sqrt(solved) <= np.sqrt(squares) * (1 + 0.1 * np.sqrt(len(places))) + 1e-5
        assert _significant(candidate["text"], "mm") <= 6


def test_a_straight_line_is_as_straight_as_its_card_says() -> None:
    for candidate in _candidates(designed("straight_line", {"length": "100 mm"})):
        if not candidate["error"] or "cycle:" not in candidate["text"]:
            # The line itself, or one that is a part of a turn.
            continue
        number, unit = candidate["error"].split()
        error = float(number) * {"mm": 1e-3, "m": 1.0}[unit]
        path = _path(candidate["text"])
        line = np.polyfit(path.real, path.imag, 1) if np.ptp(path.real) > np.ptp(path.imag) else None
        off = (
            np.abs(np.polyval(line, path.real) - path.imag)
            if line is not None
            else np.abs(path.real - path.real.mean())
        )
        assert off.max() <= 2.2 * error
        assert _significant(candidate["text"], "mm") <= 6


@pytest.mark.parametrize("unit", ["mm", pytest.param("in", marks=pytest.mark.rotating)])
def test_linkages_of_a_drawn_curve_are_as_near_as_their_card_says(unit: str) -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, 60, endpoint=False)
    goal = 0.08 * np.cos(turn) + 0.05j * np.sin(turn) * (1 + 0.3 * np.cos(turn))
    found = _candidates(linkages([[z.real, z.imag] for z in goal], True, unit))
    assert found
    for candidate in found:
        mechanism = lw.loads(candidate["text"], "found.yaml")
        motion = lw.solve_motion(mechanism, steps=1440)
        names = {name for link in mechanism.links.values() for name in link.points}
        paths = [motion.point(name).position for name in names]
        # The point that draws the curve is the one that is nearest to it.
        off = min(
            np.abs(goal[:, None] - (x + 1j * y)[None, :]).min(axis=1).max() for x, y in (each.T for each in paths)
        )
        assert off <= 1.1 * candidate["error"] + 2e-4
        assert _significant(candidate["text"], unit) <= 6
        assert " m," not in _model(candidate["text"])


def test_other_units_are_refused() -> None:
    assert length_unit({}) == "mm"
    with pytest.raises(LinkwrightError):
        length_unit({"unit": "furlong"})
