"""A study as text: its table, the best designs, what failed."""

from __future__ import annotations

import numpy as np

from linkwright.core.quantity import shown, shown_unit
from linkwright.core.table import Amount, Cell, Table
from linkwright.designs.criteria import criterion
from linkwright.designs.failures import Failure
from linkwright.designs.study import Study
from linkwright.errors import speaker
from linkwright.words import Say, _, pgettext
from linkwright.words.sentence import in_language


def text(study: Study, language: str = "en", rows: int = 40, width: int | None = None) -> str:
    """Table, best designs, failures, notes."""
    say = speaker(language)
    lines = [
        say(
            _(
                "{name}: {designs} designs, {movable} can move",
                name=study.mechanism.name,
                designs=study.designs,
                movable=int(study.ok.sum()),
            )
        ),
        "",
    ]
    lines += _table(study, language, rows, width, say)
    best = _best(study, language, say)
    if best:
        lines += ["", say(_("Best designs")), *best]
    if study.failures:
        lines += [
            "",
            say(_("Designs that fail")),
            *(_failure(each, say, language) for each in study.failures),
        ]
    notes = [in_language(note, language) for note in study.notes]
    return "\n".join([*lines, *([""] if notes else []), *notes])


def _table(study: Study, language: str, rows: int, width: int | None, say: Say) -> list[str]:
    chosen = _chosen(study.designs, rows)
    head = [say(pgettext("study", "no.")), *(each.address for each in study.ranges)]
    head += [_heading(study, name, language) for name in study.metrics]
    table: list[list[Cell]] = []
    for index in chosen:
        cells: list[Cell] = [index, *(each.shown(study.varied[each.address][index]) for each in study.ranges)]
        for name, values in study.metrics.items():
            value = Amount(float(values[index]), study.dimensions[name], 5, bare=True)
            cells.append("—" if np.isnan(value.value) else value)
        table.append(cells)
    lines = Table(head, table, ">" * len(head)).lines(language, width)
    if len(chosen) < study.designs:
        lines.append(
            say(
                _(
                    "({shown} of {designs} designs shown; write all of them with --output FILE.csv)",
                    shown=len(chosen),
                    designs=study.designs,
                )
            )
        )
    return lines


def _chosen(designs: int, rows: int) -> list[int]:
    """Evenly chosen numbers, the first and the last among them."""
    if designs <= rows:
        return list(range(designs))
    return sorted({round(i * (designs - 1) / max(rows - 1, 1)) for i in range(rows)})


def _heading(study: Study, name: str, language: str) -> str:
    unit = shown_unit(study.dimensions[name])
    label = criterion(name).label(language, study.dimensions[name])
    return f"{label} [{unit}]" if unit else label


def _best(study: Study, language: str, say: Say) -> list[str]:
    """The best design in every metric that has a better direction."""
    lines = []
    for name, values in study.metrics.items():
        if study.better[name] is None or not np.isfinite(values).any():
            continue
        index = study.best(name)
        place = ", ".join(
            f"{each.address} = {each.shown(study.varied[each.address][index])}" for each in study.ranges
        )
        value = shown(float(values[index]), study.dimensions[name], 5)
        lines.append(
            say(
                _(
                    "{name}: {value} in design {number} ({place})",
                    name=criterion(name).label(language),
                    value=value,
                    number=index,
                    place=place,
                )
            )
        )
    return lines


def _failure(failure: Failure, say: Say, language: str) -> str:
    place, example = in_language(failure.place, language), in_language(failure.example, language)
    return say(_("{count} {place}; the first: {example}", count=failure.count, place=place, example=example))
