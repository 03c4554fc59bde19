"""Candidates with short numbers: as many decimals, in the unit of a person, as what a linkage does asks for."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.errors import LinkwrightError
from linkwright.files.model_file import loads
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.synthesis.linkage import Linkage
from linkwright.synthesis.result import Candidate, Synthesis
from linkwright.units import unit as parsed

#: Share of the error of a candidate that rounding may add to it.
SHARE = 0.1
#: Shares of the longest length: what rounding of an exact linkage may be off, and the most for any.
EXACT, COARSEST = 1e-5, 5e-4
#: Positions that are compared; decimals more than the fewest that are tried.
POSITIONS, TRIED = 90, 5
#: Numbers with the units that linkages are written in.
_AMOUNT = re.compile(r"(?<![\w.])(-?\d+(?:\.\d+)?(?:e[-+]?\d+)?) (mm|m|deg)\b")
#: Lines of a model file that hold words.
_WORDS = ("name:", "purpose:", "source:")


def tolerance(found: Synthesis, candidate: Candidate) -> tuple[float, bool]:
    """How far rounding may move a candidate, and whether that is an angle of its links (rad), not a place (m)."""
    error = candidate.error * SHARE
    if found.error_name == "squares":
        error = math.sqrt(candidate.error) * SHARE
    elif found.error_name == "curve" and candidate.curve is not None:
        # A share of the curve's root mean square radius.
        curve = np.asarray(candidate.curve, dtype=complex).ravel()
        curve = curve[np.isfinite(curve)]
        error *= float(np.sqrt(np.mean(np.abs(curve - curve.mean()) ** 2))) if len(curve) else 0.0
    return error, found.error_name in ("angle", "rest")


def short_text(linkage: Linkage, text: str, allowed: float, *, of_angles: bool = False, unit: str = "mm") -> str:
    """The model file of a linkage with the fewest decimals that keep all that moves within ``allowed``.

    Lengths are in ``unit``. ``allowed``: m, or rad of links where it is ``of_angles``; little of an exact linkage's
    size is allowed as well. One that does not pass its cycle is written as finely as an exact one.
    """
    longest, factor = linkage.longest(), parsed(unit)[0]
    size = 1.0 if of_angles else longest
    allowed = min(max(allowed, EXACT * size), COARSEST * size)
    exact = _moved(text)
    if exact is None or not exact.complete:
        # Nothing to compare with all through.
        return _written(text, unit, _decimals(EXACT * longest / factor), longest)
    # A few roundings add up at least: one of four times the tolerance may still be within it.
    fewest = _decimals(4.0 * allowed * (longest if of_angles else 1.0) / factor)
    for decimals in range(fewest, fewest + TRIED):
        short = _written(text, unit, decimals, longest)
        moved = _moved(short)
        if moved is not None and _off(exact, moved, of_angles) <= allowed:
            return short
    return _written(text, unit, None, longest)


def _decimals(step: float) -> int:
    """The decimals of numbers that are no farther apart than a step."""
    return max(0, math.ceil(-math.log10(step)))


def _moved(text: str) -> Motion | None:
    try:
        return solve_motion(loads(text, "candidate.yaml"), steps=POSITIONS)
    except LinkwrightError:
        return None


def _off(exact: Motion, short: Motion, of_angles: bool) -> float:
    """The farthest that any moving point, or the most that any link, is elsewhere; infinite where one stops first."""
    if not short.complete or short.steps != exact.steps:
        return math.inf
    mechanism = exact.mechanism
    if of_angles:
        pairs = [(exact.link(name).direction, short.link(name).direction) for name in mechanism.links]
        return _most(np.abs(_between(a, b)) for a, b in pairs)
    names = {point for link in mechanism.links.values() for point in link.points}
    places = ((exact.point(name).position, short.point(name).position) for name in sorted(names))
    return _most(np.hypot(*(b - a).T) for a, b in places)


def _between(a: Floats, b: Floats) -> Floats:
    """Angles between directions, rad."""
    return np.asarray(np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], np.sum(a * b, axis=1)))


def _most(each: Iterable[Floats]) -> float:
    return max(float(np.nanmax(found)) for found in each)


def _written(text: str, unit: str, decimals: int | None, longest: float) -> str:
    """The text with lengths in a unit and so many decimals, angles as fine; none: as many digits as it has."""
    factor = parsed(unit)[0]
    fine = None if decimals is None else max(0, decimals + math.ceil(math.log10(math.radians(longest / factor))))

    def amount(found: re.Match[str]) -> str:
        value, own = float(found[1]), found[2]
        if own == "deg":
            return f"{_plain(value, fine)} deg"
        return f"{_plain(value * parsed(own)[0] / factor, decimals)} {unit}"

    lines = text.splitlines()
    return "\n".join(each if each.startswith(_WORDS) else _AMOUNT.sub(amount, each) for each in lines) + "\n"


def _plain(value: float, decimals: int | None) -> str:
    if decimals is None:
        return f"{value:.12g}"
    short = f"{value:.{decimals}f}"
    if "." in short:
        short = short.rstrip("0").rstrip(".")
    return "0" if float(short) == 0.0 else short
