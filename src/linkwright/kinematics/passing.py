"""A cycle in which nothing is passed: what shows it, and where a motion passes a place at which modes meet."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import chain
from math import ceil, cos, inf, isfinite, nan, sin, tau
from typing import TYPE_CHECKING, Literal

from linkwright.core.inputs import mode_inputs, turned
from linkwright.core.outputs import Output, kind_of, row_name
from linkwright.formula.program import Program
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.kinematics.assembly import assemble
from linkwright.kinematics.names import program_names
from linkwright.kinematics.trace import MotionOutputs, MotionTrace, trace_motion
from linkwright.topology import Structure

if TYPE_CHECKING:
    from linkwright.mechanism.mechanism import Mechanism


#: Groups whose quality (square of the sine of their transmission angle) stays above this are left alone, unless
#: it changes more than that from one position to the next.
NEAR = 0.02
#: Largest step of a driver, rad or share of the size, in which a cycle is looked through.
FINE = 0.05
#: Ways of less than this share of the largest one, or of the size, are rounding errors.
REVERSED = 1e-6


def modal(motion: MotionTrace) -> list[str]:
    """Names of the groups with two assembly modes, in solving order."""
    return [name for name, p in motion.placed.items() if p.dyad is not None and p.dyad.words[0]]


def measures(motion: MotionTrace, group: str) -> list[str]:
    """Outputs that come near to zero where the modes or the outer pins of a group meet."""
    facts = motion.placed[group].facts
    return [row_name("quality", group), *([row_name("fact", group, on="distance²")] if "distance²" in facts else [])]


def clear_of_zero(
    names: Sequence[str], lows: Sequence[float], highs: Sequence[float], leap: Callable[[int], float]
) -> bool:
    """Whether these outputs stay so far from zero that nothing can lie between two positions.

    ``lows``, ``highs``: the smallest and the largest value of each, NaN where one is; ``leap``: the largest change of
    an output, by its number, from one position to the next.
    """
    for k, (name, low, high) in enumerate(zip(names, lows, highs, strict=True)):
        if kind_of(name) == "fact":
            margin = NEAR * high
        elif low > max(NEAR, high - low):
            margin = NEAR
        else:
            margin = max(NEAR, leap(k))
        if not (low > margin and isfinite(high)):
            return False
    return True


def nothing_passed(names: Sequence[str], rows: Sequence[Sequence[float]]) -> bool:
    """The same of outputs (names, n) as plain numbers."""
    sound = [isfinite(sum(row)) for row in rows]
    lows, highs = ([end(row) if good else nan for row, good in zip(rows, sound, strict=True)] for end in (min, max))

    def leap(k: int) -> float:
        return max(abs(b - a) for a, b in zip(rows[k], [*rows[k][1:], rows[k][0]], strict=True))

    return clear_of_zero(names, lows, highs, leap)


def plainly_passed(
    mechanism: Mechanism, structure: Structure, steps: int, outputs: Sequence[Output] = ()
) -> list[bool] | None:
    """Which outputs of a machine of dyads go to and fro as positions show, where its crank turns at constant speed,
    it reaches all positions of its cycle and nothing lies between two of them. None where this does not tell: then
    its motion is to be solved.

    Raises:
        AssemblyError: as :func:`linkwright.kinematics.assembly.assemble`.
    """
    if len(mechanism.drivers) != 1 or mechanism.cycle is not None:
        return None
    (driver,) = mechanism.drivers.values()
    if not driver.law.constant_speed or mechanism.joints[driver.joint].coordinate != "turn":
        return None
    if mechanism.higher:
        return None
    motion = trace_motion(mechanism, structure, rates=bool(outputs))
    if motion.next_states or any("sine" in placed.facts for placed in motion.placed.values()):
        return None
    names = [each for group in modal(motion) for each in measures(motion, group)]
    names_of_outputs = [program_names(mechanism, output)[0] for output in outputs]
    wanted = tuple(dict.fromkeys((*names, *chain.from_iterable(names_of_outputs))))
    rows = _turned(mechanism, structure, motion, wanted, steps)
    if rows is None or not nothing_passed(names, rows[: len(names)]):
        return None
    found = dict(zip(wanted, rows, strict=True))
    return [_reverses([found[name] for name in each], mechanism.size) for each in names_of_outputs]


def _reverses(rows: Sequence[Sequence[float]], size: float) -> bool:
    """Whether an output goes to and fro: its values over a cycle, or cosine and sine of its direction."""
    ahead = [[*row[1:], row[0]] for row in rows]
    if len(rows) == 2:
        size, (c, s), (d, e) = 1.0, rows, ahead
        increments = [c[k] * e[k] - s[k] * d[k] for k in range(len(c))]
    else:
        increments = [b - a for a, b in zip(rows[0], ahead[0], strict=True)]
    low, high = min(increments), max(increments)
    minimum_travel = REVERSED * (high - low)
    return low < -minimum_travel < 0.0 < minimum_travel < high and high - low > REVERSED * size


def _turned(
    mechanism: Mechanism, structure: Structure, motion: MotionTrace, names: Sequence[str], steps: int
) -> list[list[float]] | None:
    ((name, driver),) = mechanism.drivers.items()
    outputs = MotionOutputs(motion)
    program = Program.of(motion.trace, {each: outputs.value(each) for each in (*names, "outcome")})
    modes = mode_inputs(assemble(mechanism, structure).modes)
    known = {**mechanism.dimensions(), **modes}
    numbers, scalar = [known[each] for each in program.parameters], ScalarProgram(program)
    count = steps * ceil(tau / steps / FINE)
    start, found = driver.law.at(0.0), []
    for k in range(count):
        q = start + tau * k / count
        inputs = turned(name, q, cos, sin)
        found.append(scalar.step(numbers, [inputs.get(each, inf) for each in program.positions]))
        if found[-1][-1] != 0.0:
            return None
    return [list(row) for row in zip(*found, strict=True)][:-1]


Kind = Literal["change", "meeting", "end", "gap", "pole"]


@dataclass(frozen=True)
class ChangePointCrossing:
    """Where a group's modes meet (``change``), its outer pins meet (``meeting``), or it cannot pass: out of reach
    (``gap``), or infinitely far as its guides become parallel (``pole``). An ``end`` is one of the first two beneath
    a group without closed form, which cannot be tracked through it.

    It lies at ``share`` of the step from the position ``before`` to the position ``after``, ``at`` the first driver's
    coordinate (rad or m); ``quality`` is the minimum square of the sine of the group's transmission angle there.
    ``flips``: the places between which the group has its other sign because of it.
    """

    group: str
    before: int
    after: int
    share: float
    quality: float
    kind: Kind
    at: float
    flips: tuple[float, float] = (0.0, math.inf)

    @property
    def touches(self) -> bool:
        """Whether the motion passes, with the other sign."""
        return self.kind in ("change", "meeting")

    @property
    def barred(self) -> bool:
        """Whether the group cannot be assembled there, though it can be before and after."""
        return self.kind in ("gap", "pole")

    @property
    def singular(self) -> bool:
        """Whether its modes or its outer pins meet."""
        return self.touches or self.kind == "end"

    @property
    def place(self) -> float:
        """Number of the position, counted on in between."""
        return self.before + self.share
