"""An optimisation in tables."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from linkwright import units
from linkwright.core.quantity import in_kind, number, unit_of_kind, with_unit, written
from linkwright.core.table import Cell, Table
from linkwright.designs.checkpoints import RESUME
from linkwright.designs.criteria import Criterion
from linkwright.designs.optimise.optimum import Choice, Optimum
from linkwright.errors import speaker
from linkwright.words import Translate, _

#: Designs of a front that are listed.
LISTED = 24


def tables(found: Optimum, language: str = "en") -> tuple[Table, ...]:
    """The best design next to the start, the front, and notes."""
    name = found.problem.mechanism.name
    best = comparison(found, found.best, language)
    title = _("{name}: {goals}", name=name, goals=_goals(found, language))
    front = [_front(found, language)] if len(found.problem.goals) > 1 else []
    return replace(best, title=title), *front, Table(notes=tuple(_notes(found)))


def _notes(found: Optimum) -> Iterator[str]:
    """What to know about the search."""
    yield _(
        "{evaluations} designs judged in {generations} generations; every design passes the "
        "full cycle with the start's assembly",
        evaluations=found.evaluations,
        generations=found.generations,
    )
    moved = any(each.choices is None for each in found.problem.variables)
    if moved and found.exact:
        yield _("The last steps used exact gradients.")
    elif moved and not found.problem.robust:
        yield _(
            "This machine's designs go one after the other, and the last steps used "
            "differences: slower, and less exact."
        )
    if found.best.worst:
        yield _("At the worst within the tolerances: {numbers}.", numbers=", ".join(_worst(found)))
    if found.best.made is not None:
        yield _(
            "{share} % of the machines made within the tolerances meet all demands (512 samples).",
            share=f"{100 * found.best.made:.1f}",
        )
    for each in found.without_effect:
        yield _(
            "{address} changes none of these numbers; leave it out of vary:, or ask for a number that it changes.",
            address=each,
        )
    if found.interrupted:
        yield RESUME.format(path=found.state)


def _goals(found: Optimum, language: str) -> str:
    words = {1.0: _("minimum {number}"), -1.0: _("maximum {number}")}
    texts = (
        words[goal.sign].format(number=label(found, goal.text, language)).translate(language)
        for goal in found.problem.goals
    )
    return _("; ").translate(language).join(texts)


def label(found: Optimum, text: str, language: str) -> str:
    """A number in words; expressions and summaries as they are written."""
    if text in found.problem.define:
        return text
    kinds = {kind: name for name, kind in units.DIMENSIONS.items()}
    return Criterion(text).label(language, kinds.get(found.kinds[text], ""))


def comparison(found: Optimum, choice: Choice, language: str) -> Table:
    """A row for every variable and number: name, start, design, change, bounds."""
    tell = speaker(language)
    head = (_("number"), _("start"), _("found"), _("change"), _("bounds"))
    rows: list[list[str]] = []
    for variable, was in zip(found.problem.variables, found.problem.start, strict=True):
        now = choice.values[variable.address]
        bounds = "..".join(written(each, variable.unit, bare=True) for each in (variable.low, variable.high))
        shown = [variable.shown(value) for value in (was, now)]
        rows.append([variable.address, *shown, _change(was, now), bounds])
    for text, now in choice.numbers.items():
        was = found.start[text]
        shown = [in_kind(value, found.kinds[text]) for value in (was, now)]
        name = label(found, text, language)
        rows.append([name, *shown, _change(was, now), _limits(found, choice, text, tell)])
    return Table(head, rows, "<>>><")


def _limits(found: Optimum, choice: Choice, text: str, tell: Translate) -> str:
    goals = {goal.text: goal.sign for goal in found.problem.goals}
    texts = [tell(_("minimized") if goals[text] > 0 else _("maximized"))] if text in goals else []
    if text in found.limits:
        texts.append(_between(found, text)[0])
    if text in choice.missed:
        texts.append(tell(_("missed")))
    return ", ".join(texts)


def _change(was: float, now: float) -> str:
    if not math.isfinite(was) or was == 0:
        return "–"
    return f"{100 * (now - was) / abs(was):+.2f} %"


def _front(found: Optimum, language: str) -> Table:
    texts = [goal.text for goal in found.problem.goals]
    addresses = [variable.address for variable in found.problem.variables]
    head = ["", *(label(found, text, language) for text in texts), *addresses]
    rows: list[list[Cell]] = []
    count = len(found)
    listed = {round(k * (count - 1) / max(1, LISTED - 1)) for k in range(LISTED)} if count > LISTED else None
    for index, choice in enumerate(found.choices, 1):
        if listed is not None and index - 1 not in listed:
            continue
        cells = [in_kind(choice.numbers[text], found.kinds[text]) for text in texts]
        cells += [each.shown(choice.values[each.address]) for each in found.problem.variables]
        rows.append([index, *cells])
    title = _(
        "Designs on the front: {count}, none beaten by another in all objectives; "
        "hypervolume {hypervolume} of the box to the worst values",
        count=count,
        hypervolume=f"{found.hypervolume or 0.0:.4f}",
    )
    return Table(head, rows, ">" * len(head), title)


def _worst(found: Optimum) -> list[str]:
    """What the numbers of the first design come to at the worst within the tolerances."""
    texts = []
    for text, ends in found.best.worst.items():
        unit, factor = unit_of_kind(found.kinds[text])
        texts.append(f"{text} {with_unit('..'.join(number(end * factor) for end in sorted(ends)), unit)}")
    return texts


def missing(found: Optimum) -> list[str]:
    """The demands that the first design misses, with what is demanded and what it has."""
    texts = []
    for text in found.best.missed:
        ends = sorted(found.best.worst.get(text, (found.best.numbers[text],)))
        has = "..".join(in_kind(end, found.kinds[text]) for end in ends)
        texts.append(f"{text} {with_unit(*_between(found, text))} ({has})")
    return texts


def _between(found: Optimum, text: str) -> tuple[str, str]:
    """The limits of a number, and their unit."""
    unit, factor = unit_of_kind(found.kinds[text])
    low, high = (number(each * factor) for each in found.limits[text])
    if "∞" in low or "∞" in high:
        return (f"≤ {high}" if "∞" in low else f"≥ {low}"), unit
    return f"{low}..{high}", unit
