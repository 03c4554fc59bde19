"""The table of design numbers of a result."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from linkwright.analysis.base import CELLS, METRICS, REMARK, MetricValue
from linkwright.core.attached import PlotMixin
from linkwright.core.table import Amount, Cell, Table, Tabular, dataframe
from linkwright.errors import RequestError
from linkwright.registry import offered
from linkwright.words import _
from linkwright.words.message import in_language, in_words, together

if TYPE_CHECKING:
    import pandas

#: How many values of one number and subject tables show at most.
REPEATED = 6
COLUMNS = ("metric", "subject", "value", "unit", "at", "at_unit", "limit", "exact", "warning", "remark")


def cells_of_values(
    rows: Sequence[MetricValue], language: str
) -> Iterator[tuple[tuple[Cell, ...], MetricValue | None]]:
    """What tables write of values, each with its value; of a number that comes many times over the cycle the first,
    then how many more there are, between which values and inputs."""
    found: dict[tuple[str, str], list[MetricValue]] = {}
    for row in rows:
        found.setdefault((row.metric, row.subject), []).append(row)
    for same in found.values():
        few = len(same) if len(same) == REPEATED + 1 else REPEATED
        yield from ((row.cells(language), row) for row in same[:few])
        if rest := same[few:]:
            label, subject, value, unit, at, _unused = rest[0].cells(language)
            more = _("{subject}, {count} more", subject=subject, count=len(rest)).translate(language)
            places = [row.at for row in rest if row.at is not None]
            yield ((label, more, _between(value, [row.value for row in rest]), unit, _between(at, places), ""), None)


def _between(first: Cell, values: Sequence[float]) -> Cell:
    """The cell of the first of some values, from the smallest to the largest of them."""
    if not isinstance(first, Amount):
        return first
    found = replace(first, value=min(values), end=max(values))
    return found if len(set(found.number.split(" … "))) > 1 else replace(found, end=None)


def _remarks(row: MetricValue | None, language: str) -> str:
    """Remarks of a row, if it is that of a value; its warnings stand beneath the table, and are marked here."""
    if row is None:
        return ""
    texts = [remark.text(language) for remark in row.remarks if not remark.warning]
    mark = "!" if row.warnings else ""
    return f"{mark} {_('; ').translate(language).join(texts)}".strip()


class MetricsTable(PlotMixin, Tabular, Sequence[MetricValue]):
    """Values of design numbers, in rows.

    ``table["stroke"]``: all values of one number; ``table["stroke", "guide"]``: the one of a subject;
    ``table.value("stroke")``: the governing value (the worst of its subjects where a direction is better, else the
    only or first one). ``skipped``: names that were not asked for by name and do not apply; ``notes``: sentences
    about the complete result.
    """

    def __init__(
        self, title: str, rows: Sequence[MetricValue], skipped: Sequence[str] = (), notes: Sequence[str] = ()
    ) -> None:
        self.title = title
        self.notes = tuple(notes)
        self.rows = tuple(rows)
        self.skipped = tuple(skipped)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the numbers in the table, in order."""
        return tuple(dict.fromkeys(row.metric for row in self.rows))

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences about what needs attention, each with its subject."""
        return self.warnings_in("en")

    def warnings_in(self, language: str) -> tuple[str, ...]:
        """The same in a language, closeness to a singular position first; subjects with the same remark are
        together."""
        notes = (in_language(note, language) for note in self.notes)
        subjects_by_text: dict[str, list[str]] = {}
        for row in sorted(self.rows, key=lambda row: row.metric != "singularity"):
            for remark in row.warnings:
                subjects_by_text.setdefault(remark.text(language), []).append(in_words(row.subject, language))
        about = {cause: together(tuple(dict.fromkeys(subjects))) for cause, subjects in subjects_by_text.items()}
        cells_of_values = (
            _("{name}: {cause}", name=in_language(names, language), cause=cause).translate(language)
            for cause, names in about.items()
        )
        return (*notes, *cells_of_values)

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            return self._of(key)
        if isinstance(key, tuple):
            return self._one(*key)
        return self.rows[key]

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[MetricValue]:
        return iter(self.rows)

    def __contains__(self, key: object) -> bool:
        return key in self.names if isinstance(key, str) else key in self.rows

    def value(self, name: str, subject: str | None = None) -> float:
        """SI value of a number: of a subject, or the governing one. Raises LinkwrightError for unknown names."""
        if subject is not None:
            return self._one(name, subject).value
        values = [row.value for row in self._of(name)]
        better = METRICS[name].better
        return values[0] if better is None else min(values) if better == "higher" else max(values)

    def _of(self, name: str) -> tuple[MetricValue, ...]:
        found = tuple(row for row in self.rows if row.metric == name)
        if found:
            return found
        METRICS[name]
        raise RequestError(
            _(
                '"{name}" is not in the table: it does not apply here or was not asked for',
                code="metrics.not_in_table",
                name=name,
            )
        )

    def _one(self, name: str, subject: str) -> MetricValue:
        rows = self._of(name)
        for row in rows:
            if row.subject == subject:
                return row
        subjects = [row.subject for row in rows]
        hint = offered(subject, subjects)
        raise RequestError(
            _(
                '"{name}" has no value for "{subject}"; {hint}',
                code="metrics.no_value",
                name=name,
                subject=subject,
                hint=hint,
            )
        )

    def tables(self, language: str = "en") -> tuple[Table]:
        """The rows, limits and remarks where there are any, and the warnings."""
        if not self.rows:
            return (Table(title=self.title, notes=["", _("none of the design numbers applies to this mechanism")]),)
        head = (*CELLS, REMARK)
        rows = [[*texts, _remarks(row, language)] for texts, row in cells_of_values(self.rows, language)]
        shown_columns = [i for i in range(len(head)) if i < 5 or any(row[i] for row in rows)]
        notes = [f"! {warning}" for warning in self.warnings_in(language)]
        align = "".join("<<><>><"[i] for i in shown_columns)
        cells = [[row[i] for i in shown_columns] for row in rows]
        return (Table([head[i] for i in shown_columns], cells, align, self.title, notes),)

    def data(self, language: str = "en") -> dict[str, Any]:
        """Plain data, SI, one mapping per row; remarks and warnings in a language."""
        return {
            "name": self.title,
            "metrics": [row.data(language) for row in self.rows],
            "warnings": list(self.warnings_in(language)),
            "not_applicable": list(self.skipped),
        }

    def columns(self, language: str = "en") -> dict[str, list[Any]]:
        """What is known of every value but its place, by name, SI; remarks in a language."""
        rows = [row.data(language) for row in self.rows]
        return {name: [row[name] for row in rows] for name in COLUMNS}

    def to_dataframe(self) -> pandas.DataFrame:
        """The rows as a table; needs pandas. Raises LinkwrightError without it."""
        return dataframe({**self.columns(), "place": [row.place for row in self.rows]})

    def __repr__(self) -> str:
        return f"MetricsTable({self.title!r}: {len(self.rows)} values of {', '.join(self.names)})"
