"""The machines of a comparison, each solved over its cycle, and whether they do the same work."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain, count
from os import PathLike
from pathlib import Path

import numpy as np

from linkwright.analysis import Analysis
from linkwright.analysis.by_name import Asked, pivot
from linkwright.analysis.outputs import mechanism_outputs
from linkwright.core.arguments import require
from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.cycle.summaries import Summary
from linkwright.errors import LinkwrightError, RequestError
from linkwright.files.model_file import load
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import place_meant
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.machine import flywheel_inertia
from linkwright.machine.running import require_steady
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _

#: A mean torque of this share of the largest one is zero but for rounding.
IDLE = 1e-9
#: Of the torque of its driver what a written evaluation tells.
EFFORTS = tuple(Summary("input_torque", kind) for kind in ("max", "min", "rms"))


@dataclass(eq=False)
class Alternative:
    """A machine of the comparison: ``label`` its name there, ``output`` what it moves."""

    label: str
    mechanism: Mechanism
    output: Output
    steps: int
    fluctuation: float
    notes: list[str] = field(default_factory=list)

    @cached_property
    def motion(self) -> Motion:
        """Its motion; raises PositionError where it cannot pass its cycle."""
        return solve_motion(self.mechanism, steps=self.steps)

    @cached_property
    def forces(self) -> Forces:
        """Its forces."""
        return solve_forces(self.motion)

    @cached_property
    def analysis(self) -> Analysis:
        """What its metrics share."""
        return Analysis.of(self.forces)

    @cached_property
    def takes_flywheel(self) -> bool:
        """Whether there is a flywheel to lay out; if not, a note says why."""
        torque = self.forces.input_torque
        if abs(torque.mean()) <= IDLE * np.abs(torque).max():
            self.notes.append(
                _(
                    "{label}: the mean torque over its cycle is zero, so no work is done and there is no "
                    "flywheel to lay out",
                    code="study.no_work",
                    label=self.label,
                )
            )
            return False
        try:
            require_steady(self.forces)
        except LinkwrightError as error:
            self.notes.append(_("{name}: {cause}", name=self.label, cause=error))
            return False
        return True

    @property
    def asked(self) -> Asked:
        """What numbers of its own output depend on."""
        return Asked(self.output, self.fluctuation)

    @property
    def loaded(self) -> bool:
        """Whether anything in it has mass or a load."""
        return self.mechanism.has_loads

    @property
    def pivot(self) -> tuple[str, str]:
        """Joint and link where the output is carried by the frame."""
        return pivot(self.mechanism, self.output)

    @property
    def reactions(self) -> tuple[Summary, Summary]:
        """The largest and the smallest reaction there."""
        joint, link = self.pivot
        return Summary(f"reaction {joint} on {link}", "max"), Summary(f"reaction {joint} on {link}", "min")

    @property
    def force_summaries(self) -> tuple[Summary, ...]:
        """Of its forces what a written evaluation tells."""
        return (*self.reactions, *EFFORTS) if self.loaded else ()

    @property
    def pivot_force(self) -> Floats:
        """Force on the output link at its pivot, (n, 2) N."""
        joint, link = self.pivot
        return self.forces.reaction(joint, on=link)

    def forces_at(self, time: float) -> Forces:
        """The forces at a time of the cycle, s."""
        resolver = self.analysis.resolver
        if not resolver.possible:
            index = int(np.abs(self.motion.time - time).argmin())
            return solve_forces(solve_motion(self.mechanism, times=[float(self.motion.time[index])]))
        forces: Forces = resolver.at(np.array([time]), "forces")
        return forces

    @property
    def way(self) -> float:
        """How far the output gets over the cycle, the last step to where it begins again included (rad or m)."""
        places = self.travel()[0]
        turns = round((places[-1] - places[0]) / (2 * np.pi)) if self.output.dimension == "angle" else 0
        back = places[0] + 2 * np.pi * turns if self.motion.positions.closed else places[-1]
        return float(np.ptp(np.append(places, back)))

    def travel(self) -> tuple[Floats, Floats, Floats]:
        """The output and its rates in time, (n,) each."""
        place, rate, second = map(self.motion.read, self.output.course)
        return place, rate, second


def alternatives(
    sources: Sequence[Mechanism | str | Path],
    output: str | Mapping[str, str] | Sequence[str] | None,
    steps: int,
    fluctuation: float,
) -> list[Alternative]:
    """The machines with their shared output.

    Raises:
        LinkwrightError: fewer than two machines, an unknown output, or none that all share.
    """
    if not isinstance(sources, Sequence) or isinstance(sources, str) or len(sources) < 2:
        raise RequestError(
            _(
                "a comparison needs two or more alternatives; give a list of mechanisms or files",
                code="study.two_or_more",
            )
        )
    for source in sources:
        require(source, Mechanism, str, PathLike)
    flywheel_inertia(1.0, 1.0, fluctuation)
    machines = [each if isinstance(each, Mechanism) else load(each) for each in sources]
    labels = _labels(machines)
    names = _outputs(machines, labels, sources, output)
    return [
        Alternative(label, machine, place_meant(machine, name), steps, fluctuation)
        for label, machine, name in zip(labels, machines, names, strict=True)
    ]


def _labels(machines: Sequence[Mechanism]) -> list[str]:
    """Names of the machines, numbered where they are the same."""
    found: list[str] = []
    for machine in machines:
        numbered = (f"{machine.name} ({k})" for k in count(2))
        found.append(next(name for name in chain([machine.name], numbered) if name not in found))
    return found


def _outputs(
    machines: Sequence[Mechanism],
    labels: Sequence[str],
    sources: Sequence[Mechanism | str | Path],
    output: str | Mapping[str, str] | Sequence[str] | None,
) -> list[str]:
    """The name of every machine's output."""
    if isinstance(output, str):
        return [output] * len(machines)
    if isinstance(output, Mapping):
        return [_mapped(output, label, source) for label, source in zip(labels, sources, strict=True)]
    if output is not None:
        if len(output) != len(machines):
            raise RequestError(
                _(
                    "{outputs} outputs are named for {machines} alternatives; name one for each",
                    code="study.outputs_for",
                    outputs=len(output),
                    machines=len(machines),
                )
            )
        return list(output)
    own = [[str(each) for each in mechanism_outputs(machine)] for machine in machines]
    shared = [name for name in own[0] if all(name in names for names in own[1:])]
    if shared:
        return [shared[-1]] * len(machines)
    if all(len(names) == 1 for names in own):
        kinds = {mechanism_outputs(machine)[0].kind for machine in machines}
        if len(kinds) == 1:
            return [names[0] for names in own]
    raise LinkwrightError(_nothing_shared(labels, own))


def _mapped(output: Mapping[str, str], label: str, source: Mechanism | str | Path) -> str:
    keys = (
        [label]
        if isinstance(source, Mechanism)
        else [label, str(source), Path(str(source).removeprefix("gallery:")).stem]
    )
    for key in keys:
        if key in output:
            return output[key]
    raise RequestError(
        _(
            "no output is named for {label!r}; output names them for {named}",
            code="study.no_output_for",
            label=label,
            named=tuple(map(repr, output)),
        )
    )


def _nothing_shared(labels: Sequence[str], own: Sequence[Sequence[str]]) -> str:
    named = [
        _("{label!r} has {names}", label=label, names=tuple(names)) if names else _("{label!r} has none", label=label)
        for label, names in zip(labels, own, strict=True)
    ]
    example = ", ".join(f"{label!r}: {(names or ['…'])[0]!r}" for label, names in zip(labels, own, strict=True))
    return _(
        "the alternatives share no output to compare: {alternatives}; specify which output of each is "
        "meant, such as output={{{example}}} (on the command line --of, one name per file)",
        code="study.no_common_output",
        alternatives=named,
        example=example,
    )


#: Keys of a load that say where it acts, not how large it is.
PLACES = ("on", "at", "between", "joint", "links", "direction", "in_link", "normal_to", "along", "against")


def unlike(alternatives: Sequence[Alternative]) -> tuple[str, ...]:
    """Sentences on loads, inputs and outputs in which the alternatives differ."""
    tasks: dict[Message, Callable[[Alternative], tuple[str, ...]]] = {
        _(
            "! The alternatives carry different loads ({values}): torque, power, reactions and "
            "flywheel compare unlike things.",
            code="compare.unlike_loads",
        ): lambda each: _loads(each.mechanism),
        _(
            "! The alternatives are driven at different speeds ({values}): rates, forces and powers "
            "compare unlike things.",
            code="compare.unlike_speeds",
        ): lambda each: _speeds(each.mechanism),
        _(
            "! The outputs of the alternatives are of different kinds ({values}): their travels and "
            "rates compare unlike things.",
            code="compare.unlike_outputs",
        ): lambda each: (each.output.dimension,),
    }
    return tuple(
        message.format(values=[_named_facts(each, read(each)) for each in alternatives])
        for message, read in tasks.items()
        if len({_rounded(read(each)) for each in alternatives}) > 1
    )


def _named_facts(each: Alternative, facts: tuple[str, ...]) -> Message:
    cause = facts or _("none")
    return _("{name}: {cause}", name=each.label, cause=cause)


def _rounded(facts: tuple[str, ...]) -> Hashable:
    return tuple(sorted(facts))


def _loads(mechanism: Mechanism) -> tuple[str, ...]:
    """Kind and size of every load."""
    found = []
    for each in mechanism.loads.values():
        written = {key: value for key, value in each.written().items() if key not in (*PLACES, "phase")}
        kind = str(written.pop("kind"))
        found.append(" ".join([kind, *(_size(value) for value in written.values())]))
    return tuple(found)


def _size(value: object) -> str:
    if isinstance(value, dict):
        return "{" + " ".join(_size(each) for each in value.values()) + "}"
    if isinstance(value, list | tuple):
        return " ".join(_size(each) for each in value)
    return str(value)


def _speeds(mechanism: Mechanism) -> tuple[str, ...]:
    """Sizes of the drivers' constant speeds."""
    laws = (driver.law for driver in mechanism.drivers.values())
    return tuple(
        f"{abs(law.constant_speed):.6g} {'rad/s' if law.rotary else 'm/s'}"
        for law in laws
        if law.constant_speed is not None
    )
