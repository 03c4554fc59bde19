"""A study in tables: its designs, the best ones, what failed."""

from __future__ import annotations

import numpy as np

from linkwright.core.quantity import shown, shown_unit
from linkwright.core.table import Amount, Cell, Table
from linkwright.designs.criteria import criterion
from linkwright.designs.study import Study
from linkwright.words import Message, _, pgettext


def tables(study: Study, language: str = "en", rows: int = 40) -> tuple[Table, ...]:
    """Table, best designs, failures, notes."""
    failures = [
        _("{count} {place}; the first: {example}", count=each.count, place=each.place, example=each.example)
        for each in study.failures
    ]
    below = (
        Table(title=_("Best designs"), notes=_best(study, language)),
        Table(title=_("Designs that fail"), notes=failures),
        Table(notes=study.notes),
    )
    return (_designs(study, language, rows), *(each for each in below if each.notes))


def _designs(study: Study, language: str, rows: int) -> Table:
    chosen = _chosen(study.designs, rows)
    head = [pgettext("study", "no."), *(each.address for each in study.ranges)]
    head += [_heading(study, name, language) for name in study.metrics]
    table: list[list[Cell]] = []
    for index in chosen:
        cells: list[Cell] = [index, *(each.shown(study.varied[each.address][index]) for each in study.ranges)]
        for name, values in study.metrics.items():
            value = Amount(float(values[index]), study.dimensions[name], 5, bare=True)
            cells.append("—" if np.isnan(value.value) else value)
        table.append(cells)
    title = _(
        "{name}: {designs} designs, {movable} can move",
        name=study.mechanism.name,
        designs=study.designs,
        movable=int(study.ok.sum()),
    )
    more = _(
        "({shown} of {designs} designs shown; write all of them with --output FILE.csv)",
        shown=len(chosen),
        designs=study.designs,
    )
    notes = [more] if len(chosen) < study.designs else []
    return Table(head, table, ">" * len(head), title, notes)


def _chosen(designs: int, rows: int) -> list[int]:
    """Evenly chosen numbers, the first and the last among them."""
    if designs <= rows:
        return list(range(designs))
    return sorted({round(i * (designs - 1) / max(rows - 1, 1)) for i in range(rows)})


def _heading(study: Study, name: str, language: str) -> str:
    unit = shown_unit(study.dimensions[name])
    label = criterion(name).label(language, study.dimensions[name])
    return f"{label} [{unit}]" if unit else label


def _best(study: Study, language: str) -> list[Message]:
    """The best design in every metric that has a better direction."""
    lines = []
    for name, values in study.metrics.items():
        if not study.has_best(name):
            continue
        index = study.best(name)
        place = ", ".join(
            f"{each.address} = {each.shown(study.varied[each.address][index])}" for each in study.ranges
        )
        lines.append(
            _(
                "{name}: {value} in design {number} ({place})",
                name=criterion(name).label(language),
                value=shown(float(values[index]), study.dimensions[name], 5),
                number=index,
                place=place,
            )
        )
    return lines
