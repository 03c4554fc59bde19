"""The worked solution of a synthesis, and which task writes which steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module

from linkwright.errors import speaker
from linkwright.synthesis.result import Synthesis, SynthesisError, WorkedSynthesis
from linkwright.synthesis.steps.choice import write_choice
from linkwright.synthesis.steps.writing import Writer
from linkwright.words import _

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
#: Titles, by the task.
TITLES = {
    "slider_crank": _("Synthesis of a slider-crank: worked solution"),
    "crank_rocker": _("Synthesis of a crank-rocker from swing angle and quick-return ratio: worked solution"),
    "quick_return": _("Synthesis of a crank and slotted lever from its quick-return ratio: worked solution"),
    "drag_link": _("Synthesis of a drag link from its quick-return ratio: worked solution"),
    "toggle": _("Synthesis of a toggle from its force ratio: worked solution"),
    "dwell": _("Synthesis of a dwell mechanism: worked solution"),
    "straight_line": _("Synthesis of a straight-line linkage: worked solution"),
    "function": _("Function generation: worked solution"),
    "motion": _("Motion generation: worked solution"),
    "path": _("Path generation: worked solution"),
    "exact_path": _("Path generation through precision points: worked solution"),
    "free_curve": _("Linkage for a free curve: worked solution"),
}


def worked(found: Synthesis, language: str = "en") -> WorkedSynthesis:
    """The worked solution of a synthesis in a language.

    Raises LinkwrightError for an unknown language, and for cognates, which follow from a linkage that is given.
    """
    say = speaker(language)
    if found.derivation is None or not len(found):
        raise SynthesisError(
            _(
                "the task {task} has no worked solution: its linkages follow from one that is given; "
                "print its text instead",
                code="synthesize.no_derivation",
                task=found.task,
            )
        )
    writer = Writer(found, say)
    module, name = WRITERS[type(found.derivation).__name__].split(".")
    write: Callable[[Writer, object], None] = getattr(import_module(f"{__package__}.{module}"), name)
    write(writer, found.derivation)
    write_choice(writer)
    pictures = {number: tuple(kinds) for number, kinds in writer.pictures.items()}
    steps = tuple(step for step in writer.steps if step.items)
    return WorkedSynthesis(say(TITLES[found.task]), steps, pictures)
