"""A worked solution, and how it is printed as plain text."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from linkwright.equations.steps import Equation, Note, Relation, Step, Tabulated, Written
from linkwright.words.characters import cells, folded

WIDTH = 100


def page(heading: Iterable[str], steps: Iterable[Step]) -> str:
    """All steps, equal signs in line within a step."""
    title, *legend = heading
    lines = [title, *(line for text in legend for line in _folded(text))]
    for step in steps:
        title = f"{step.number}  {step.title}"
        lines += ["", title, ("=" if "." not in step.number else "-") * cells(title), *_step(step)]
    return "\n".join(line for i, line in enumerate(lines) if line or i == 0 or lines[i - 1])


def _step(step: Step) -> Iterator[str]:
    names = [cells(item.symbol) for item in step.equations if cells(item.symbol) <= 14]
    margin = max(names, default=0)
    previous_note = False
    for item in step.items:
        if isinstance(item, Note):
            if not previous_note and item is not step.items[0]:
                yield ""
            yield from _folded(item.text)
        elif isinstance(item, Relation):
            yield from _long("    ", item.text, "    ")
        elif isinstance(item, Written | Tabulated):
            lines = [f"    {line}".rstrip() for line in item.text.splitlines()]
            yield from ["", *lines, ""] if len(lines) > 1 else lines
        else:
            yield from _equation(item, margin)
        previous_note = isinstance(item, Note)


def _equation(item: Equation, margin: int) -> Iterator[str]:
    gap = " " * max(margin - cells(item.symbol), 0)
    start = f"    {item.symbol}{gap} = "
    unit = f" {item.unit}" if item.unit and item.unit != "°" else item.unit
    result = f"{item.result}{unit}"
    parts = [part for part in (item.formula, item.numbers) if part]
    one_line = start + " = ".join([*parts, result])
    if cells(one_line) <= WIDTH:
        yield one_line
        return
    indent = " " * (4 + max(margin, cells(item.symbol)))
    yield from _long(start, parts[0] if parts else result, indent)
    for part in [*parts[1:], result] if parts else []:
        yield from _long(f"{indent} = ", part, indent)


def _long(start: str, text: str, indent: str) -> Iterator[str]:
    """A side of an equation, broken before a plus or a minus between its terms where it is too wide."""
    line = start
    for i, token in enumerate(_terms(text)):
        if i and cells(line) + cells(token) + 1 > WIDTH:
            yield line
            line = f"{indent}     {token}"
        else:
            line += (" " if i else "") + token
    yield line


def _terms(text: str) -> list[str]:
    """Parts that begin with a plus or a minus in at most one pair of parentheses."""
    parts, depth = [""], 0
    for word in text.split(" "):
        if word in ("+", "-") and depth <= 1:
            parts.append(word)
        else:
            parts[-1] += f" {word}" if parts[-1] else word
        depth += word.count("(") - word.count(")")
    return parts


def _folded(text: str) -> list[str]:
    """A sentence in lines."""
    return [f"  {line}".rstrip() for line in folded(text, WIDTH - 2)]


@dataclass(frozen=True)
class Solution:
    """A worked solution: ``steps`` in the order in which a textbook prints them."""

    title: str
    steps: tuple[Step, ...]

    @property
    def equations(self) -> tuple[Equation, ...]:
        """All results in order."""
        return tuple(equation for step in self.steps for equation in step.equations)

    def text(self) -> str:
        """Plain text, up to 100 columns wide but for tables and matrices."""
        return page((self.title,), self.steps)

    def data(self) -> dict[str, object]:
        """Plain data for programs and reports."""
        return {"title": self.title, "steps": [step.data() for step in self.steps]}

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.title!r}: {len(self.steps)} steps, {len(self.equations)} equations)"
