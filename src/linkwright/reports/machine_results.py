"""One machine of a report: its results, each found once and when a section asks for it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.errors import LinkwrightError, speaker
from linkwright.events.limit_positions import LimitPosition
from linkwright.events.position_list import PositionList
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.positions import at_inputs
from linkwright.kinematics.solve import solve_motion, with_times
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.kinetostatics.table import results_of
from linkwright.mechanism.mechanism import Mechanism
from linkwright.reports.numbers import ColumnHeadings, without_rounding
from linkwright.reports.settings import Settings, worked_place
from linkwright.topology.analysis import Structure
from linkwright.words import Translate, _
from linkwright.words.message import in_language, numbered_links

if TYPE_CHECKING:
    from linkwright.analysis.evaluate import MetricsTable
    from linkwright.machine.running import SteadyRunning
    from linkwright.pictures.diagram import Diagram
    from linkwright.worked_solutions.solution import Worked


#: Why a machine has no forces.
NO_LOADS = _(
    "the links have no mass and nothing acts on them, so no forces arise; give masses (mass: 5 kg) or loads",
    code="report.no_loads",
)


class Missing(LinkwrightError):
    """Why a section, or a part of one, has nothing to show."""


@dataclass(frozen=True)
class Numbered:
    """Positions of the tables, numbered from 1: a motion that passes them, and where in it they are.

    ``listed``: they are those that the file lists, in its order.
    """

    motion: Motion
    rows: tuple[int, ...]
    start: LimitPosition | None
    output: str
    listed: bool = False


class ReportContext:
    """A machine with its settings and language; ``source``: the file's name."""

    def __init__(self, mechanism: Mechanism, settings: Settings, language: str, source: str = "") -> None:
        self.mechanism, self.settings, self.language, self.source = mechanism, settings, language, source
        self.translate: Translate = speaker(language)
        #: Why the numbered positions do not begin at the limit position that the file names.
        self.unnumbered = ""
        #: Metrics that the report shows.
        self.used: dict[str, None] = {}

    @property
    def purpose(self) -> str:
        """What the machine is for."""
        return self.settings.purpose or self.mechanism.purpose

    @property
    def origin(self) -> str:
        """Where the machine comes from."""
        return self.settings.source or self.mechanism.source

    @cached_property
    def structure(self) -> Structure:
        """Mobility and groups."""
        from linkwright.kinematics.structure_with_rank import analysed

        return analysed(self.mechanism)

    @cached_property
    def motion(self) -> Motion:
        """The full cycle; positions that are not reached are marked."""
        found = solve_motion(self.mechanism, failures="mark")
        if not found.ok.any():
            raise LinkwrightError(found.outcomes[0].sentence)
        return found

    @cached_property
    def forces(self) -> Forces:
        """Joint forces over the cycle; raises Missing where nothing acts."""
        if not self.mechanism.has_loads:
            raise Missing(NO_LOADS)
        return solve_forces(self.motion)

    @cached_property
    def result(self) -> Forces | Motion:
        """Forces where there are some, else the motion."""
        try:
            return self.forces
        except LinkwrightError:
            return self.motion

    @cached_property
    def metrics(self) -> MetricsTable:
        """Metrics."""
        from linkwright.analysis import metrics

        return metrics(self.result)

    @cached_property
    def running(self) -> SteadyRunning:
        """Motor and flywheel."""
        from linkwright.machine.running import steady_running

        return steady_running(self.forces, fluctuation=self.settings.fluctuation)

    @cached_property
    def rotary(self) -> bool:
        """Whether the first driver turns."""
        drivers = self.mechanism.drivers.values()
        return all(self.mechanism.joints[each.joint].coordinate == "turn" for each in list(drivers)[:1])

    def input_text(self, value: float) -> str:
        """An input as the tables print it, without its unit."""
        return f"{(np.degrees(value) if self.rotary else 1e3 * value) + 0.0:.2f}"

    @property
    def input_unit(self) -> str:
        """Unit of inputs in tables."""
        return "°" if self.rotary else "mm"

    # the worked position ----------------------------------------------------------------------
    @cached_property
    def asked_place(self) -> float | None:
        """The input (rad or m) or time (s) that is asked for as worked position; raises QuantityError."""
        return worked_place(self.mechanism, self.settings.position)

    @cached_property
    def moment(self) -> float:
        """Time of the worked position, s: a sixth of the cycle unless the file says another."""
        place = self.asked_place
        if place is None:
            reached = np.flatnonzero(self.motion.ok)
            return float(self.motion.time[reached[len(reached) // 6]])
        return float(at_inputs(self.mechanism, [place]).time[0]) if self.mechanism.steady else place

    @cached_property
    def worked_result(self) -> tuple[Forces | Motion, int]:
        """The result at the worked position, on the way of the cycle, and its index."""
        motion, index = self.motion, 0
        if self.mechanism.drivers:
            motion, (index,) = with_times(motion, [self.moment])
        if not motion.ok[index]:
            raise LinkwrightError(motion.outcomes[index].sentence)
        return (solve_forces(motion) if self.mechanism.has_loads else motion), index

    @property
    def worked_place(self) -> float | None:
        """The worked position as diagrams take it: input (rad or m), or time (s); None of what is at rest."""
        if not self.mechanism.drivers:
            return None
        motion, index = self.worked_motion
        return float(motion.input[index]) if self.mechanism.steady else float(motion.time[index])

    @property
    def worked_text(self) -> str:
        """The worked position in words."""
        place = self.worked_place
        if place is None:
            return ""
        return f"q = {self.input_text(place)}{self.input_unit}" if self.mechanism.steady else f"t = {place:.6g} s"

    @property
    def worked_motion(self) -> tuple[Motion, int]:
        """The motion that passes the worked position, and its index."""
        source, index = self.worked_result
        return (source.motion if isinstance(source, Forces) else source), index

    def require_position(self) -> None:
        """Raises LinkwrightError where the worked position is not reached, or nothing can be solved."""
        _unused = self.worked_result

    @cached_property
    def worked(self) -> Worked:
        """The worked solution of that position."""
        from linkwright.worked_solutions.solution import worked

        source, index = self.worked_result
        return worked(source, index, language=self.language)

    # numbered positions -------------------------------------------------------------------------
    @cached_property
    def numbered(self) -> Numbered:
        """Equally spaced positions from a limit position of the output on (else from the start), or those that are
        listed."""
        motion, asked = self.motion, self.settings.positions
        if not self.mechanism.drivers:
            return Numbered(motion, (0,), None, "")
        if isinstance(asked, PositionList):
            found = asked.solved(self.mechanism, self.settings.numbered_from.partition(" ")[0])
            return Numbered(found, tuple(range(found.steps)), None, "", listed=True)
        count = asked or self._usual
        output, limit = self._first_limit()
        period = motion.positions.period
        if period is None:
            reached = np.unique(np.linspace(0, motion.steps - 1, count).round().astype(int))
            return Numbered(motion, tuple(int(i) for i in reached), None, output)
        start = float(motion.time[0]) if limit is None else limit.time
        wanted = [
            float(motion.time[0]) + (start - float(motion.time[0]) + k * period / count) % period
            for k in range(count)
        ]
        denser, rows = with_times(motion, wanted)
        return Numbered(denser, tuple(rows), limit, output)

    @property
    def _usual(self) -> int:
        """24 positions; one more where these would differ by full turns of the input."""
        law = next(iter(self.mechanism.drivers.values())).law
        turns = abs(law.constant_speed or 0.0) * (self.motion.positions.period or 0.0) / (48.0 * np.pi)
        return 25 if law.rotary and turns > 0.5 and abs(turns - round(turns)) < 1e-9 else 24

    @cached_property
    def varying(self) -> frozenset[Output]:
        """Results that change over the cycle, or from one numbered position to another."""
        found = without_rounding(results_of(self.motion, self.forces if self.mechanism.has_loads else None))
        forces = self.numbered_forces if self.mechanism.has_loads else None
        chosen = without_rounding(results_of(self.numbered.motion, forces))
        return frozenset(each for each in found if varies(found[each]) or varies(chosen[each]))

    def _first_limit(self) -> tuple[str, LimitPosition | None]:
        """The output that the positions are numbered by, and its limit position; none where it reverses nowhere."""
        from linkwright.events.limit_positions import limits_of

        chosen = self.settings.numbered_from
        name, _unused, kind = chosen.partition(" ")
        try:
            limits = limits_of(self.motion, name or None)
        except LinkwrightError as error:
            if chosen:
                reason = self.message(error)
                self.unnumbered = self.translate(
                    _(
                        "The positions are numbered from the start of the motion, not from {text}: {reason}.",
                        text=chosen,
                        reason=reason,
                    )
                )
            return "", None
        wanted = kind or "min"
        found = [each for each in limits if each.kind == wanted] or list(limits)
        return name, found[0]

    @cached_property
    def numbered_forces(self) -> Forces:
        """Forces at the numbered positions."""
        if not self.mechanism.has_loads:
            raise Missing(NO_LOADS)
        return solve_forces(self.numbered.motion)

    @cached_property
    def heads(self) -> ColumnHeadings:
        """Symbols of results as heads of columns."""
        return ColumnHeadings(self.mechanism, self.translate)

    @property
    def links_text(self) -> str:
        """The links with the numbers that stand in symbols."""
        return self.translate(
            _("Links: {links}.", links=", ".join(numbered_links(self.heads.numbers, self.language)))
        )

    # pictures -----------------------------------------------------------------------------------
    def diagram(self, kind: str, source: object = None, **options: object) -> str:
        """A diagram as SVG text."""
        from linkwright.plotting.diagrams.base import plot

        shown: Diagram = plot(
            self.result if source is None else source,  # type: ignore[arg-type]
            kind,
            title="",
            language=self.language,
            **options,  # type: ignore[arg-type]
        )
        return picture(shown)

    def message(self, error: LinkwrightError) -> str:
        """What an error says, in the report's language."""
        return error.translate(self.language)

    def sentence(self, text: str) -> str:
        """A sentence in the report's language."""
        return in_language(text, self.language)


def varies(values: Floats) -> bool:
    """Whether a result changes over the positions."""
    known = values[np.isfinite(values)]
    return bool(len(known)) and float(np.ptp(known)) > 1e-12 * max(float(np.abs(known).max()), 1e-300)


def picture(diagram: Diagram) -> str:
    """A diagram as SVG text that begins with its element, its size without a unit (points)."""
    svg = diagram.svg()
    return re.sub(r'="([\d.]+)pt"', r'="\1"', svg[svg.index("<svg") :], count=2)
