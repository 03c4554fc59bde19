"""The worked solution of a synthesis: which task writes which steps, and the last one, the choice."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from importlib import import_module

from linkwright.equations.steps import Step
from linkwright.errors import speaker
from linkwright.synthesis.names import ERRORS, TYPE_NAMES, display_name
from linkwright.synthesis.result import Synthesis, SynthesisError, WorkedSynthesis, defects_text, error_texts, merits
from linkwright.synthesis.steps.writing import Writer, decimals, numbers
from linkwright.words import _, pgettext

#: Writers of steps by the name of the derivation's class, each in a module of this package.
WRITERS: Mapping[str, str] = {
    "SliderCrankDerivation": "requirements.slider_crank",
    "QuickReturnDerivation": "requirements.quick_return",
    "ToggleDerivation": "requirements.toggle",
    "CrankRockerDerivation": "requirements.crank_rocker",
    "DragLinkDerivation": "requirements.drag_link",
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
    translate = speaker(language)
    if found.derivation is None or not len(found):
        raise SynthesisError(
            _(
                "the task {task} has no worked solution: its linkages follow from one that is given; "
                "print its text instead",
                code="synthesize.no_derivation",
                task=found.task,
            )
        )
    writer = Writer(found, translate)
    module, name = WRITERS[type(found.derivation).__name__].split(".")
    write: Callable[[Writer, object], None] = getattr(import_module(f"{__package__}.{module}"), name)
    write(writer, found.derivation)
    write_choice(writer)
    pictures = {number: tuple(kinds) for number, kinds in writer.pictures.items()}
    steps = tuple(step for step in writer.steps if step.items)
    return WorkedSynthesis(translate(TITLES[found.task]), steps, pictures)


#: Tasks whose demands leave one linkage.
DETERMINED = ("slider_crank", "quick_return", "toggle")
#: Tasks whose candidates are ranked by defects, error and merit.
RANKED = ("function", "motion", "path", "exact_path")
#: Share by which errors must differ to count.
EQUAL_ERRORS = 0.0025
#: Why the first candidate was taken, by the task.
REASONS = {
    "crank_rocker": _(
        "Candidate 1 has the largest smallest transmission angle of the family, {angle}°; the "
        "others lie evenly over it."
    ),
    "drag_link": _(
        "It has the largest smallest transmission angle that was found, {angle}°, with a ratio of links of {ratio}."
    ),
    "dwell": _(
        "Candidate 1 is taken for its smallest deviation during the rest; its smallest "
        "transmission angle is {angle}°."
    ),
    "straight_line": _("Candidate 1 is the smallest linkage that is straight enough."),
    "free_curve": _(
        "No candidate is beaten by another in error, number of links, transmission angle and "
        "size at once; the first has the smallest error, or the fewest links among those that "
        "are good enough. Its smallest transmission angle is {angle}°."
    ),
}


def write_choice(w: Writer) -> None:
    """Table of the candidates, their lengths, and the reason of the choice."""
    step = w.step(_("Choice among the candidates"))
    _facts(w, step)
    _lengths(w, step)
    step.note(_reason(w))


def _facts(w: Writer, step: Step) -> None:
    found, translate = w.found, w.translate
    each = found.candidates
    errors, worst = zip(*(error_texts(one) for one in each), strict=True)
    columns = [
        (translate(_("no.")), numbers(len(each))),
        (translate(_("type")), [translate(TYPE_NAMES[one.grashof_type]) for one in each]),
        (translate(pgettext("synthesize", "error")), errors),
        (translate(_("worst")), worst),
        (translate(_("defects")), [defects_text(one, translate) for one in each]),
        (
            translate(pgettext("synthesize", "input")),
            [translate(pgettext("synthesize", "turns") if one.turns else _("swings")) for one in each],
        ),
        ("μ_min / °", decimals([math.degrees(one.transmission_angle) for one in each], 2)),
        (translate(_("l max/min")), decimals([one.link_ratio for one in each], 3)),
        (w.over(translate(_("l max"))), w.lengths([one.linkage.longest() for one in each])),
    ]
    align = "><>><<>>>"
    if found.task in RANKED and len(each) > 1:
        columns.append((w.translate(_("merit")), decimals(merits(each, found.extent), 4)))
        align += ">"
    w.table(step, _("Candidates"), columns, align)
    step.note(translate(ERRORS[found.error_name]))


def _lengths(w: Writer, step: Step) -> None:
    """Lengths of the links, candidates of the same links in one table."""
    groups: dict[tuple[str, ...], list[tuple[int, dict[str, float]]]] = {}
    for number, each in enumerate(w.found.candidates, 1):
        lengths = each.linkage.lengths()
        groups.setdefault(tuple(lengths), []).append((number, lengths))
    for names, rows in groups.items():
        columns = [(w.translate(_("no.")), [str(number) for number, _unused in rows])]
        columns += [
            (w.over(display_name(name, w.translate)), w.lengths([lengths[name] for _unused, lengths in rows]))
            for name in names
        ]
        w.table(step, _("Link lengths"), columns)


def _reason(w: Writer) -> str:
    """Why the first candidate was taken."""
    found, best = w.found, w.found.best
    angle = f"{math.degrees(best.transmission_angle):.2f}"
    if found.task in DETERMINED:
        return w.translate(_("The demands determine the linkage; there is nothing to choose."))
    if found.task not in RANKED:
        return w.translate(REASONS[found.task].format(angle=angle, ratio=f"{best.link_ratio:.3g}"))
    if getattr(found.derivation, "method", "") == "equation":
        return w.translate(
            _(
                "The linear equations have one solution. Of both assembly modes the one with the "
                "smaller structural error was taken; its smallest transmission angle is {angle}°.",
                angle=angle,
            )
        )
    if len(found) == 1:
        return w.translate(
            _("No other different candidate was found; its smallest transmission angle is {angle}°.", angle=angle)
        )
    second = found[1]
    if bool(second.defects) != bool(best.defects):
        return w.translate(
            _(
                "Candidate 1 is taken because candidate 2 has defects: {defects}.",
                defects=defects_text(second, w.translate),
            )
        )
    both_exact = error_texts(best)[0] == "0" and error_texts(second)[0] == "0"
    if not both_exact and abs(best.error - second.error) > EQUAL_ERRORS * second.error:
        return w.translate(
            _(
                "Candidate 1 is taken for its smaller error: {error} against {next}.",
                error=error_texts(best)[0],
                next=error_texts(second)[0],
            )
        )
    first, other = merits(found.candidates[:2], found.extent)
    return w.translate(
        _(
            "Errors and defects are equal, so the merit decides, {merit} against {next}: the "
            "sine of the smallest transmission angle (here {angle}°), less for a linkage larger "
            "than three times the demand, or with links more unequal than 1:10.",
            merit=f"{first:.4f}",
            next=f"{other:.4f}",
            angle=angle,
        )
    )
