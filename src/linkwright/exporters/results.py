"""What is exported: a motion, with its forces and design numbers where there are any."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from linkwright.analysis.table import MetricsTable
from linkwright.core.arguments import STEPS, require
from linkwright.errors import LinkwrightError
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.topology import Structure


@dataclass(frozen=True)
class Results:
    """A motion and, where they were solved, its forces; ``language`` is that of headings (``en`` or ``zh``)."""

    motion: Motion
    forces: Forces | None = None
    language: str = "en"

    @classmethod
    def of(cls, source: Mechanism | Motion | Forces, steps: int = STEPS, language: str = "en") -> Results:
        """The results of a motion or of forces as they are; a mechanism is solved first over ``steps``.

        Forces are solved where the mechanism has masses or loads. Raises LinkwrightError for another type.
        """
        if isinstance(source, Forces):
            return cls(source.motion, source, language)
        if isinstance(source, Motion):
            return cls(source, None, language)
        require(source, Mechanism, Motion, Forces)
        motion = solve_motion(source, steps=steps)
        return cls(motion, solve_forces(motion) if source.has_loads else None, language)

    @property
    def mechanism(self) -> Mechanism:
        """What was solved."""
        return self.motion.mechanism

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes of motion and forces."""
        return (*self.motion.notes, *(self.forces.notes if self.forces is not None else ()))

    @property
    def structure(self) -> Structure:
        """Its Assur groups."""
        return self.motion.structure

    @cached_property
    def metrics(self) -> MetricsTable:
        """Design numbers; none where positions were not reached."""
        from linkwright.analysis import metrics

        if not self.motion.complete:
            return MetricsTable(self.mechanism.name, ())
        return metrics(self.motion if self.forces is None else self.forces)

    def first_ok(self) -> int:
        """Index of the first position that was reached; raises LinkwrightError if there is none."""
        if not self.motion.ok.any():
            raise LinkwrightError(
                _(
                    "no position of {name!r} was reached, so there is nothing to export",
                    code="export.nothing_reached",
                    name=self.mechanism.name,
                )
            )
        return int(self.motion.ok.argmax())
