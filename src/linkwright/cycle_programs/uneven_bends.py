"""Pieces of the cycle between the bends of a cam that turns through, but in no fixed ratio to the driver.

A cam on a crank of a linkage passes all bends of its lift in the same order in every design, but not at inputs that
a formula gives. At every Gauss point Newton's method finds the bends about it, from where the machine as it is has
them; derivatives are those of the places found (implicit function theorem).
"""

from __future__ import annotations

from functools import cached_property
from itertools import pairwise

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.core.dataclass import dataclass
from linkwright.cycle_programs.joint_bends import turning
from linkwright.cycle_programs.traced_outputs import Traced
from linkwright.engine.program import Program
from linkwright.engine.trace import Mask, Scalar, Trace, absolute, atan, cos, select, sin, stop
from linkwright.joints.base import Bends
from linkwright.loads.strokes import TURN

#: Newton steps to a bend, and the last one that ends the search well, rad.
STEPS, CONVERGED = 6, 1e-10
#: How far behind the next one a bend may come out, as share of the cycle; the most cuts that are put in among them.
ORDER, MOST = 1e-12, 12


@dataclass(frozen=True)
class UnevenBends:
    """The bends of one joint in the order of the cycle, the first of them once more at its end.

    ``angles`` (k + 1,): of the link to its carrier, rad, without the phase; ``near`` (k + 1,): inputs, rad, about
    which the machine as it is has them.
    """

    traced: Traced
    bends: Bends
    angles: Floats
    near: Floats

    @property
    def stretches(self) -> int:
        """Number of stretches between them."""
        return len(self.near) - 1

    @property
    def longest(self) -> float:
        """The longest of these, as share of the cycle, in the machine as it is."""
        return float(np.abs(np.diff(self.near)).max() / abs(self.near[-1] - self.near[0]))

    def around(self, stretch: Indices, cuts: int) -> dict[str, Floats]:
        """Angles and inputs of the bends (n,) that can bound the stretches (n,), with ``cuts`` among them."""
        found: dict[str, Floats] = {}
        for k in range(cuts + 2):
            index = np.clip(stretch - cuts + k, 0, self.stretches)
            found |= {f"bend {k}": self.angles[index], f"near bend {k}": self.near[index]}
        return found

    def first(self, t: Trace) -> Scalar:
        """The input of the first bend, rad."""
        return self._input(t, float(self.angles[0]), float(self.near[0]))[0]

    def bounds(self, t: Trace, first: Scalar, way: Scalar, cuts: list[Scalar]) -> tuple[Scalar, Scalar]:
        """Where the stretch of a position begins and ends, as shares of the ``way`` from the ``first`` bend; the
        ``cuts``, such shares in any order, are put in among the bends. NaN where a bend is not found."""
        found: Mask = True
        edges: list[Scalar] = []
        for k in range(len(cuts) + 2):
            x, met = self._input(t, t.position(f"bend {k}"), t.position(f"near bend {k}"))
            edges.append((x - first) / way)
            found = t.logic("and", found, met)
        for before, after in pairwise(edges):
            found = t.logic("and", found, before <= after + ORDER)
        for cut in cuts:
            edges = [_middle(before, cut, after) for before, after in pairwise(edges)]
        low, high = edges
        return select(found, low, np.nan), high

    def _input(self, t: Trace, angle: Scalar, near: Scalar) -> tuple[Scalar, Mask]:
        """The input at which the link has the angle and the phase, rad, and whether it is found."""
        x = near
        for _ in range(STEPS):
            x = stop(x)
            there = self.traced.at_input(self.program, t, x)
            c, s = (function(angle + there["phase"]) for function in (cos, sin))
            along, across = there["along"], there["across"]
            step = (
                2.0 * atan((across * c - along * s) / (1.0 + along * c + across * s)) / stop(there["ratio"])
            )
            x = x - step
        return x, absolute(step) <= CONVERGED

    @cached_property
    def program(self) -> Program:
        """Direction of the link from its carrier, and its angle's change with the input."""
        source, bends = self.traced.solver.motion, self.bends
        a, b = (source.poses[link].direction for link in (bends.carrier, bends.link))
        (driver,) = self.traced.mechanism.drivers
        speed = source.states[bends.link].omega - source.states[bends.carrier].omega
        ratio = speed / source.trace.parameter(f"{driver}.speed")
        phase = source.dimensions(bends.phase)
        outputs = {"along": a.dot(b), "across": a.cross(b), "ratio": ratio, "phase": phase}
        return Program.of(source.trace, outputs)


def uneven_bends(traced: Traced) -> UnevenBends | None:
    """The bends of the only joint whose link turns through, but not steadily, as the machine passes them; None where
    there is none, or where it follows a group without closed form."""
    uneven = turning(traced, steady=False)
    if len(uneven) != 1:
        return None
    bends, laps = uneven[0].bends, uneven[0].turns
    turned = uneven[0].angle - traced.mechanism.dimension(bends.phase)
    q = next(iter(traced.positions.coordinates.values()))[0]
    step, sense = q[1] - q[0], np.sign(turned[1] - turned[0])
    q, turned = np.append(q, q[0] + len(q) * step), np.append(turned, turned[0] + sense * TURN * laps)
    lap = TURN * np.arange(laps)
    behind = np.sort(np.mod(sense * (np.array(bends.angles) - turned[0]), TURN)[:, None] + lap, axis=None)
    angles, near = turned[0] + sense * behind, np.interp(behind, sense * (turned - turned[0]), q)
    angles, near = np.append(angles, angles[0]), np.append(near, near[0] + q[-1] - q[0])
    found = UnevenBends(traced, bends, angles, near)
    return None if found.program.states else found


def _middle(low: Scalar, x: Scalar, high: Scalar) -> Scalar:
    """The number between the two others, ``low`` being no larger than ``high``."""
    inside = select(x < high, x, high)
    return select(inside < low, low, inside)
