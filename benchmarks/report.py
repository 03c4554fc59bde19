"""Tables: aligned on the terminal, the same text as Markdown in the documentation."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from benchmarks.timing import Rounds

BEGIN, END = "<!-- tables: written by python -m benchmarks -->", "<!-- end of tables -->"
PAGE = Path(__file__).parents[1] / "docs" / "en" / "benchmarks.md"


@dataclass(frozen=True)
class Goal:
    """A ratio that must be reached: ``measured`` at least (or at most) ``limit``."""

    text: str
    measured: float
    limit: float
    at_least: bool

    @property
    def met(self) -> bool:
        """Whether it is reached."""
        return self.measured >= self.limit if self.at_least else self.measured <= self.limit

    def cells(self) -> list[str]:
        """A row of the table of goals."""
        bound = f"{'≥' if self.at_least else '≤'} {self.limit:g}"
        return [self.text, bound, short(self.measured), "yes" if self.met else "no"]


@dataclass
class Section:
    """One table with its goals and remarks."""

    title: str
    header: Sequence[str]
    rows: list[list[str]]
    goals: list[Goal] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def text(self) -> str:
        """Markdown."""
        remarks = "".join(f"\n- {note}" for note in self.notes)
        return f"### {self.title}\n\n{table(self.header, self.rows)}\n{remarks}".rstrip() + "\n"


def timings(rounds: Rounds, reference: str, unit: str, configurations: int = 0) -> tuple[list[str], list[list[str]]]:
    """Header and rows of a table of times; ratios to ``reference`` are medians over the rounds."""
    scale = {"µs": 1e6, "ms": 1e3, "s": 1.0}[unit]
    rate = ["million configurations/s"] if configurations else []
    header = ["", f"median, {unit}", f"best, {unit}", f"time ÷ {reference}", *rate, "remark"]
    rows = []
    for name, timing in rounds.timings.items():
        speed = [short(configurations / timing.median / 1e6)] if configurations else []
        numbers = [short(scale * timing.median), short(scale * timing.best), short(rounds.ratio(name, reference))]
        rows.append([name, *numbers, *speed, timing.note])
    return header, rows


def short(number: float) -> str:
    """Three significant digits, without an exponent where it is not needed."""
    if number != number:
        return "–"
    return f"{number:.0f}" if abs(number) >= 1000 else f"{number:.3g}"


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A Markdown table with aligned columns."""
    lines = [list(header), *map(list, rows)]
    used = [k for k in range(len(header)) if k == 0 or any(line[k] for line in lines[1:])]
    lines = [[line[k] for k in used] for line in lines]
    widths = [max(_width(line[k]) for line in lines) for k in range(len(used))]
    texts = [
        "| " + " | ".join(_padded(cell, w) for cell, w in zip(line, widths, strict=True)) + " |" for line in lines
    ]
    rule = "|" + "|".join("-" * (w + 2) for w in widths) + "|"
    return "\n".join([texts[0], rule, *texts[1:]])


def _width(text: str) -> int:
    return sum(2 if unicodedata.east_asian_width(c) in "WF" else 1 for c in text)


def _padded(text: str, width: int) -> str:
    return text + " " * (width - _width(text))


def summary(sections: Iterable[Section]) -> str:
    """The goals of all sections in one table."""
    rows = [goal.cells() for section in sections for goal in section.goals]
    return table(["ratio", "wanted", "measured", "reached"], rows)


def write_page(text: str) -> None:
    """Put the tables between the marks of the documentation's page."""
    page = PAGE.read_text(encoding="utf-8")
    head, _, rest = page.partition(BEGIN)
    _, mark, tail = rest.partition(END)
    if not mark:
        raise ValueError(f"{PAGE.name} has lost the marks between which the tables stand")
    PAGE.write_text(f"{head}{BEGIN}\n\n{text.strip()}\n\n{END}{tail}", encoding="utf-8")
