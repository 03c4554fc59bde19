"""A run as tables: how it ended, what happened, and its course over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

from linkwright.core.arrays import Floats, largest
from linkwright.core.table import Amount, Cell, Table, Tabular
from linkwright.dynamics.result import KINDS, Happening, Run
from linkwright.dynamics.states import FoundForces
from linkwright.dynamics.verdicts.stalled_run import stalled
from linkwright.errors import RequestError
from linkwright.kinematics.positions import coordinate_text
from linkwright.words import Message, _, in_language, pgettext
from linkwright.words.message import together

#: Steps of the course unless others are asked for.
STEPS = 24
#: Events that are listed; the last one, by which it ended, always.
SHOWN = 20
#: Events by which a run ends as it was to.
ENDS = ("turns", "steady", "rest")


class RunText(Tabular):
    """The tables of a run; ``steps``: equal steps of its time in the course."""

    def __init__(self, run: Run, steps: int = STEPS) -> None:
        if run.end <= 0.0:
            held = [each.name for each in run.events if each.kind == "sticks"]
            raise RequestError(
                _(
                    "{name!r} stays at rest where it begins: {held} holds it; begin with a speed, at another "
                    "position, or give it a stronger drive",
                    code="dynamics.nothing_ran",
                    name=run.mechanism.name,
                    held=", ".join(held) or _("something"),
                )
            )
        self.run = run
        self.steps = steps
        self._forces: FoundForces | None = None

    @property
    def forces(self) -> FoundForces:
        """Motion and forces at equal steps of the time."""
        if self._forces is None:
            self._forces = self.run.joint_forces(self.steps)
        return self._forces

    @cached_property
    def stalled(self) -> Message | None:
        """That its drive cannot start it, or move it on, with what is missing."""
        return stalled(self.run)

    @property
    def reason(self) -> Message:
        """Why it ended."""
        if self.run.note is not None:
            return self.run.note
        last = self.run.events[-1] if self.run.events else None
        if last is not None and last.kind in ENDS and last.time == self.run.end:
            return KINDS[last.kind]
        return _("the time is over")

    def tables(self, language: str = "en", *args: Any, **options: Any) -> Sequence[Table]:
        """How it ended, and what happened."""
        found = [self._summary(language)]
        if self.run.events:
            found.append(self._events(language))
        return found

    def _summary(self, language: str) -> Table:
        run = self.run
        rows: list[Sequence[Cell]] = [[_("runs for"), Amount(run.end, "time"), in_language(self.reason, language)]]
        for name, (q, rate) in run.end_state.items():
            turning = run.equation.rotary[name]
            own = in_language(_("driver", code="nouns.driver"), language) if name == "driver" else name
            speed = Amount(rate, "angular_velocity" if turning else "velocity")
            rows.append([_("{name} at the end", name=own), Amount(q, "angle" if turning else "length"), speed.text])
        largest_energy = _("of {energy}", energy=Amount(run.largest, "energy", 4).text)
        rows.append([_("energy missing at most"), Amount(run.residual, "energy", 2), largest_energy])
        notes = [] if self.stalled is None else [in_language(self.stalled, language)]
        return Table((), rows, "<><", in_language(run.mechanism.name, language), notes)

    def _events(self, language: str) -> Table:
        events = self._once
        shown = events if len(events) <= SHOWN else [*events[: SHOWN - 1], events[-1]]
        rows: list[Sequence[Cell]] = [
            [Amount(each.time, "time"), self._what(each), in_language(self._where(each), language)] for each in shown
        ]
        notes = [_("{shown} of {count} events; all in a .json file", shown=len(shown), count=len(events))]
        title = pgettext("run", "What happened")
        return Table(
            (_("time"), _("event"), pgettext("run", "at")), rows, "><<", title, notes if len(events) > SHOWN else []
        )

    @property
    def _once(self) -> list[Happening]:
        """The events, those of one load at one time once: it has a comparison for each end of its phase."""
        return list({(each.time, each.kind, each.name): each for each in self.run.events}.values())

    def _what(self, event: Happening) -> Message:
        what = KINDS[event.kind].format(name=event.name)
        if event.kind != "impact":
            return what
        return _("{event}, impulse {value}", event=what, value=f"{event.value:.4g} N·s")

    def _where(self, event: Happening) -> str:
        rotary = self.run.equation.rotary
        pairs = zip(self.run.coordinates, event.coordinates, strict=True)
        return together([coordinate_text(name, value, rotary[name]) for name, value in pairs])

    def columns(self) -> dict[str, Floats]:
        """Everything over time by name with unit, SI, and the work of all forces since the beginning."""
        forces = self.forces
        samples = self.run.samples(forces.motion.time)
        return {**forces.columns(), "work [J]": samples.work}

    def data(self) -> Mapping[str, Any]:
        """Plain data, SI."""
        run = self.run
        return {
            "name": run.mechanism.name,
            "end [s]": run.end,
            "reason": str(self.reason),
            **({} if self.stalled is None else {"stalled": str(self.stalled)}),
            "interrupted": run.note is not None,
            "end_state": {name: {"coordinate": q, "rate": rate} for name, (q, rate) in run.end_state.items()},
            "events": [
                {
                    "time [s]": each.time,
                    "kind": each.kind,
                    "of": each.name,
                    "value": each.value,
                    "coordinates": dict(zip(run.coordinates, each.coordinates, strict=True)),
                }
                for each in run.events
            ],
            "energy_residual [J]": run.residual,
            "largest_energy [J]": run.largest,
            "balance_residual [N]": largest(self.forces.balance_residual),
            "columns": self.columns(),
        }
