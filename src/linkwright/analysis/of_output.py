"""Metrics of the one output that alternatives share or a search is about, and of the flywheel for a coefficient δ."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import Better, Metric, Number
from linkwright.analysis.flywheel import SIZED
from linkwright.analysis.outputs import turns_fully
from linkwright.core.outputs import Output
from linkwright.cycle.summaries import Summary
from linkwright.kinematics.names import find_point
from linkwright.mechanism.mechanism import Mechanism


@dataclass(frozen=True)
class Asked:
    """What these metrics depend on besides the machine: its ``output``, and δ, the coefficient of speed
    ``fluctuation``."""

    output: Output
    fluctuation: float


class OfOutput(Metric):
    """A metric of one output."""

    source = "kinematics and kinetostatics of the output"

    def __init__(self, output: Output) -> None:
        self.output = output


class Travel(OfOutput):
    """The way of the output between its outermost positions, where it does not turn through."""

    name = "travel"
    dimension = "length"

    def suits(self, analysis: Analysis) -> bool:
        return not turns_fully(analysis.motion, self.output)

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        summary = Summary(self.output.name, "range")
        yield Number(str(self.output), (summary,), dimension=self.output.dimension)


class OutputVelocity(OfOutput):
    """Largest size of the output's velocity."""

    name = "output_velocity"
    dimension = "velocity"
    order: ClassVar[int] = 1

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        rate = self.output.course[self.order]
        yield Number(str(self.output), (Summary(rate.name, "peak"),), dimension=rate.dimension)


class OutputAcceleration(OutputVelocity):
    """Largest size of the output's acceleration."""

    name = "output_acceleration"
    dimension = "acceleration"
    better: ClassVar[Better | None] = "lower"
    order = 2


class PivotReaction(OfOutput):
    """Largest size of the reaction where the output is carried by the frame."""

    name = "pivot_reaction"
    dimension = "force"
    better: ClassVar[Better | None] = "lower"
    needs_forces = True

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        joint, link = pivot(analysis.motion.mechanism, self.output)
        yield Number(joint, (Summary(Output("reaction", joint, on=link).name, "max"),))


_OF_OUTPUT: Mapping[str, type[OfOutput]] = {
    each.name: each for each in (Travel, OutputVelocity, OutputAcceleration, PivotReaction)
}
#: All of them by name.
OWN: Mapping[str, type[Metric]] = {**_OF_OUTPUT, **SIZED}


def own_metric(name: str, asked: Asked) -> Metric:
    """One of them, of an output or for a coefficient."""
    return SIZED[name](asked.fluctuation) if name in SIZED else _OF_OUTPUT[name](asked.output)


def pivot(mechanism: Mechanism, output: Output) -> tuple[str, str]:
    """Joint and link where an output is carried by the frame."""
    if output.kind == "displacement":
        joint = mechanism.joints[output.owner]
        return output.owner, next(link for link in joint.joined if link not in mechanism.grounded)
    owner = output.owner if output.kind == "angle" else find_point(mechanism, output.owner)[0]
    at_frame = [n for n, j in mechanism.joints.items() if owner in j.joined and mechanism.grounded & set(j.joined)]
    return next(iter(at_frame), _first_joint(mechanism, owner)), owner


def _first_joint(mechanism: Mechanism, link: str) -> str:
    return next(name for name, joint in mechanism.joints.items() if link in joint.joined)
