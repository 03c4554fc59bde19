"""The worked solution of a synthesis, and which task writes which steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module

from linkwright.errors import speaker
from linkwright.synthesis.result import Synthesis, WorkedSynthesis, refuse
from linkwright.synthesis.steps.choice import write_choice
from linkwright.synthesis.steps.writing import Writer

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


def worked(found: Synthesis, language: str = "en") -> WorkedSynthesis:
    """The worked solution of a synthesis in a language.

    Raises LinkwrightError for an unknown language, and for cognates, which follow from a linkage that is given.
    """
    say = speaker(language)
    if found.derivation is None or not len(found):
        raise refuse("no_derivation", task=found.task)
    writer = Writer(found, say)
    module, name = WRITERS[type(found.derivation).__name__].split(".")
    write: Callable[[Writer, object], None] = getattr(import_module(f"{__package__}.{module}"), name)
    write(writer, found.derivation)
    write_choice(writer)
    pictures = {number: tuple(kinds) for number, kinds in writer.pictures.items()}
    steps = tuple(step for step in writer.steps if step.items)
    return WorkedSynthesis(writer.words(f"task.{found.task}"), steps, pictures)
