"""A machine that is let go: its run under forces, and the positions in which it stays at rest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from pydantic import Field

from linkwright.assistants.answers import Answered, number
from linkwright.dynamics.equilibrium import equilibrium
from linkwright.dynamics.result import Happening
from linkwright.dynamics.run import run
from linkwright.dynamics.run_text import RunText
from linkwright.errors import Finding
from linkwright.kinetostatics.forces import Forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _
from linkwright.words.message import code_of

#: Events of a run that are told, the first and the last ones.
EVENTS = 12


class RestEntry(Answered):
    """A position at rest."""

    inputs: dict[str, float | None] = Field(description="coordinates of the drivers there, rad or m")
    stability: str = Field(
        description=(
            "stable, unstable, neutral, or what holds it: stopped (at an end stop), held (by friction or a brake)"
        )
    )
    frequencies: list[float | None] = Field(description="natural frequencies of small vibrations about it, Hz")


@dataclass(frozen=True)
class Released:
    """The course of a run as forces at steps of its time, how it ended, and what happened."""

    forces: Forces
    ending: Message
    events: tuple[Finding, ...]


def released(mechanism: Mechanism, steps: int) -> Released:
    """The run that the model's section ``run`` asks for; raises LinkwrightError."""
    found = run(mechanism)
    told = RunText(found, steps)
    ending = _(
        "{name}: runs for {time:.6g} s, then: {reason}", name=mechanism.name, time=found.end, reason=told.reason
    )
    events = [
        Finding(
            "note", "", "", _("at {time:.6g} s: {event}", time=each.time, event=each), "", f"dynamics.{each.kind}"
        )
        for each in _some(found.events)
    ]
    stuck = [Finding("warning", "", "", each, "", code_of(each)) for each in (told.stalled, found.note) if each]
    return Released(told.forces, ending, (*stuck, *events))


def rests(mechanism: Mechanism) -> list[RestEntry]:
    """All positions in which a machine stays at rest by itself; raises LinkwrightError."""
    return [
        RestEntry(
            inputs={name: number(value) for name, value in each.inputs.items()},
            stability=str(each.stability),
            frequencies=[number(value) for value in each.frequencies],
        )
        for each in equilibrium(mechanism)
    ]


def _some(events: Sequence[Happening]) -> list[Happening]:
    """The first and the last of many events."""
    if len(events) <= EVENTS:
        return list(events)
    return [*events[: EVENTS // 2], *events[-EVENTS // 2 :]]
