"""The worked solution of a synthesis, and which task writes which steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import field
from importlib import import_module

from linkwright.core.dataclass import dataclass
from linkwright.errors import require_language
from linkwright.synthesis.result import Synthesis, refuse
from linkwright.synthesis.steps.choice import write_choice
from linkwright.synthesis.steps.writing import Writer
from linkwright.words import speaker
from linkwright.worked.page import Equation, Step
from linkwright.worked.text import page

#: Writers of steps by the name of the derivation's class, each in a module of this package.
WRITERS: Mapping[str, str] = {
    "SliderCrankDerivation": "closed_forms.slider_crank",
    "QuickReturnDerivation": "closed_forms.quick_return",
    "ToggleDerivation": "closed_forms.toggle",
    "CrankRockerDerivation": "limit_positions.crank_rocker",
    "DragLinkDerivation": "limit_positions.drag_link",
    "FunctionDerivation": "functions.function",
    "MotionDerivation": "motions.motion",
    "PathDerivation": "paths.path",
    "NinePointDerivation": "paths.nine_points",
    "StraightLineDerivation": "paths.straight_line",
    "DwellDerivation": "paths.dwell",
    "FreeCurveDerivation": "paths.free_curve",
}


@dataclass(frozen=True)
class WorkedSynthesis:
    """How the first candidate of a synthesis was found, as a textbook prints it.

    ``steps`` hold sentences, equations with their numbers, matrices and tables; lengths in mm, or in m where the
    linkage is large, angles in degrees. ``pictures``: kinds of diagrams of the result by the number of the step that
    they belong to.
    """

    title: str
    steps: tuple[Step, ...]
    pictures: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    @property
    def equations(self) -> tuple[Equation, ...]:
        """All results in order."""
        return tuple(equation for step in self.steps for equation in step.equations)

    def text(self) -> str:
        """Plain text, up to 100 columns wide but for tables and matrices."""
        return page((self.title,), self.steps)

    def data(self) -> dict[str, object]:
        """Plain data for programs."""
        return {"title": self.title, "steps": [step.data() for step in self.steps]}

    def __repr__(self) -> str:
        return f"WorkedSynthesis({self.title!r}: {len(self.steps)} steps)"


def worked(found: Synthesis, language: str = "en") -> WorkedSynthesis:
    """The worked solution of a synthesis in a language.

    Raises LinkwrightError for an unknown language, and for cognates, which follow from a linkage that is given.
    """
    require_language(language)
    if found.derivation is None or not len(found):
        raise refuse("no_derivation", task=found.task)
    writer = Writer(found, speaker(language))
    module, name = WRITERS[type(found.derivation).__name__].split(".")
    write: Callable[[Writer, object], None] = getattr(import_module(f"{__package__}.{module}"), name)
    write(writer, found.derivation)
    write_choice(writer)
    pictures = {number: tuple(kinds) for number, kinds in writer.pictures.items()}
    steps = tuple(step for step in writer.steps if step.items)
    return WorkedSynthesis(writer.words(f"task.{found.task}"), steps, pictures)
