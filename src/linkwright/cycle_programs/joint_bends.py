"""Where in the cycle of many designs cams and the like go over from one formula to the next."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.cycle_programs.limit_stages import whole_turns
from linkwright.cycle_programs.traced_outputs import Traced
from linkwright.engine.program import Program
from linkwright.engine.reductions import Reduction
from linkwright.engine.stage import Stage
from linkwright.engine.trace import Scalar, Trace, atan, cos, sin
from linkwright.joints.base import Bends
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.loads.strokes import TURN

#: The constant that is the input where the cycle begins.
FIRST = "first input"
#: Change of a ratio of speeds over the cycle, as share of it, up to which it is fixed.
FIXED = 1e-9


@dataclass(frozen=True)
class Turning:
    """A joint with bends whose link turns through, always the same way: how often in the cycle, and at what ``angle``
    (n,) to its carrier, rad, in the machine as it is."""

    joint: str
    bends: Bends
    turns: int
    angle: Floats

    def names(self) -> Iterator[tuple[str, float]]:
        """Names of the cycle values that are the inputs of the bends, with the angles, rad."""
        for k, angle in enumerate(self.bends.angles):
            for lap in range(self.turns):
                yield f"bend:{self.joint}:{k}:{lap}", angle + TURN * lap

    @property
    def longest(self) -> float:
        """The longest stretch between two bends, as share of the cycle."""
        angles = np.sort(np.mod(self.bends.angles, TURN))
        return float(np.diff(angles, append=angles[0] + TURN).max()) / (TURN * self.turns)


def turning(traced: Traced, *, steady: bool) -> list[Turning]:
    """The joints with bends whose links turn through, in fixed ratios to the driver or in none."""
    rate, found = next(iter(traced.positions.coordinates.values()))[1], []
    for name, joint in traced.mechanism.joints.items():
        if (bends := joint.bends) is not None:
            link, carrier = traced.nominal.link(bends.link), traced.nominal.link(bends.carrier)
            ratios = (link.angular_velocity - carrier.angular_velocity) / rate
            turns = round(abs(float(ratios.mean())) * whole_turns(traced))
            fixed = bool(np.ptp(ratios) <= FIXED * np.abs(ratios).max())
            if turns >= 1 and fixed == steady and (ratios * ratios[0] > 0.0).all():
                found.append(Turning(name, bends, turns, link.angle - carrier.angle))
    return found


def bend_names(traced: Traced) -> tuple[str, ...]:
    """Names of the cycle values that are the inputs, rad, at which joints go over from one formula to the next; of
    those joints whose links turn in a fixed ratio to the driver."""
    return tuple(name for each in turning(traced, steady=True) for name, _ in each.names())


def other_bends(traced: Traced) -> dict[str, Scalar]:
    """What is zero where the other joints go over from one formula to the next, by name: whose links rock, or more
    than one in no fixed ratio."""
    uneven, found, source = turning(traced, steady=False), dict[str, Scalar](), traced.solver.motion
    known = {each.joint for each in turning(traced, steady=True) + (uneven if len(uneven) == 1 else [])}
    for name, joint in traced.mechanism.joints.items():
        if (bends := joint.bends) is None or name in known:
            continue
        turned = traced.nominal.link(bends.link).angle - traced.nominal.link(bends.carrier).angle
        turned = turned - traced.mechanism.dimension(bends.phase)
        a, b = (source.poses[link].direction for link in (bends.carrier, bends.link))
        along, across, phase = a.dot(b), a.cross(b), source.dimensions(bends.phase)
        for k, angle in enumerate(bends.angles):
            if np.floor((turned.max() - angle) / TURN) >= np.ceil((turned.min() - angle) / TURN):
                c, s = cos(angle + phase), sin(angle + phase)
                found[f"bend {name} {k}"] = (across * c - along * s) / (1.0 + along * c + across * s)
    return found


def bend_stage(traced: Traced) -> Stage | None:
    """The stage that finds them from where the links stand as the cycle begins; None where there are none."""
    source, t = traced.solver.motion, Trace()
    found: dict[str, Scalar] = {}
    (driver,) = traced.mechanism.drivers
    for each in turning(traced, steady=True):
        a, b = (source.poses[link].direction for link in (each.bends.carrier, each.bends.link))
        along, across = a.dot(b), a.cross(b)
        rest = float(each.angle[0])
        c, s = float(np.cos(rest)), float(np.sin(rest))
        moved = 2.0 * atan((across * c - along * s) / (1.0 + along * c + across * s))
        phase = source.dimensions(each.bends.phase)
        speed = source.states[each.bends.link].omega - source.states[each.bends.carrier].omega
        program = Program.of(source.trace, {"behind": phase - moved - rest, "speed": speed})
        there = traced.at_input(program, t, t.parameter(FIRST))
        ratio = there["speed"] / t.parameter(f"{driver}.speed")
        found |= {
            name: t.parameter(FIRST) + (there["behind"] + angle) / ratio for name, angle in each.names()
        }
    if not found:
        return None
    return Stage(Program.of(t, found), {name: Reduction(name, "first") for name in found}, steps=1)


def rests(motion: Motion, output: Output) -> bool:
    """Whether an output stands still for a part of the cycle, so that no position alone is its limit."""
    rate = np.abs(MotionSignals(motion).output(output)[1])
    still = rate <= FIXED * np.nanmax(rate, initial=0.0)
    return bool((still[1:] & still[:-1]).any())
