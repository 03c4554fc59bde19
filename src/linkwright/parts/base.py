"""What every machine-part calculation has in common: a problem that is checked, and a result that speaks.

A problem is a frozen dataclass: ``findings`` lists what is wrong with it, ``solve`` gives its result. A result has
``text`` (the numbers), ``worked`` (the way to them), ``data`` (for programs), ``columns`` (curves) and ``plot``.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, is_dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from linkwright.core.attached import PlotMixin, attached
from linkwright.core.quantity import number
from linkwright.core.table import ROUNDING, Numbers, unused
from linkwright.equations.steps import Equation, Step
from linkwright.errors import Finding, ModelError, speaker
from linkwright.fields.base import Field, FileKeys, file_keys
from linkwright.words import Translate
from linkwright.words.message import in_language

if TYPE_CHECKING:
    from typing import Self

    from linkwright.pictures.drawing import Drawing


@dataclass(frozen=True, kw_only=True)
class Heading:
    """What a file holds besides the problem: its ``purpose``, the settings of its ``report``, all
    of its values as plain data (``file_values``, for the given data of the report) with the attributes ``as_read``
    from them, and ``warnings`` about its words."""

    purpose: str = field(default="", repr=False)
    report: Mapping[str, Any] = field(default_factory=dict, repr=False)
    file_values: Mapping[str, Any] = field(default_factory=dict, repr=False, compare=False)
    as_read: tuple[object, ...] = field(default=(), repr=False, compare=False)
    warnings: tuple[Finding, ...] = field(default=(), repr=False, compare=False)

    @property
    def attributes(self) -> tuple[object, ...]:
        """The values of the problem itself."""
        own = (each.name for each in fields(self) if each.name not in HEADING)
        return tuple(getattr(self, name) for name in own)


HEADING = ("name", "source", *(each.name for each in fields(Heading)))


class Problem(Heading, ABC):
    """One calculation as the file or the code gave it; subclasses are frozen dataclasses in SI units.

    ``kind`` is its name in files, ``fields`` the keys of its file after the heading: its own attributes.
    """

    kind: ClassVar[str]
    fields = FileKeys()
    name: str
    source: str

    @classmethod
    def of_file(cls, values: Mapping[str, Any], folder: Path) -> Self:
        """The problem of a file's values; ``folder`` is where the file lies."""
        return cls(**values)

    @abstractmethod
    def findings(self) -> list[Finding]:
        """Everything that is wrong with the problem, keys as in a file."""

    @abstractmethod
    def solve(self) -> Result:
        """The result. Raises ModelError with all findings."""

    @attached
    def sketch(self, language: str = "en") -> Drawing | None:
        """The sketch of what is given, with supports, loads and dimensions; None where its kind has none.

        Raises LinkwrightError where it cannot be drawn.
        """
        raise NotImplementedError

    def given(self) -> Mapping[str, Any]:
        """What is given as plain data: as the file says it, or as one would say what was changed since."""
        if self.file_values and all(a is b for a, b in zip(self.attributes, self.as_read, strict=True)):
            return self.file_values
        found = {key: _plain(getattr(self, key, None), each) for key, each in self.fields.items()}
        return {key: value for key, value in found.items() if value not in EMPTY}

    def require(self) -> None:
        """Raises ModelError where anything is wrong."""
        found = self.findings()
        if found:
            raise ModelError(found)


#: What a file leaves out.
EMPTY: tuple[Any, ...] = (None, {}, [], (), "", False)


def _plain(value: Any, kind: Field | None = None) -> Any:
    """A value as plain data of a file."""
    own = file_keys(type(value)) if is_dataclass(value) else {}
    if own:
        found = {each.key or key: _plain(getattr(value, key), each) for key, each in own.items()}
        return {key: each for key, each in found.items() if each not in EMPTY}
    if isinstance(value, Mapping):
        return {key: _plain(each) for key, each in value.items()}
    if value is None or kind is None or is_dataclass(value):
        named = getattr(value, "label", None) or getattr(value, "text", None) or getattr(value, "name", None)
        bare = {each.name: getattr(value, each.name) for each in fields(value)} if is_dataclass(value) else value
        return named or bare
    return kind.written(value)


class Result(PlotMixin, Numbers):
    """What was found: its numbers in blocks, the way to them in steps."""

    @property
    def title(self) -> str:
        """Name of the problem, which is the result's first field."""
        name: str = getattr(self, fields(self)[0].name).name  # type: ignore[arg-type]
        return name

    @abstractmethod
    def steps(self, translate: Translate) -> list[Step]:
        """The worked solution in a language."""

    def tidy_steps(self, translate: Translate) -> list[Step]:
        """The worked solution, its results rounded to zero likewise, unit by unit."""
        steps = self.steps(translate)
        largest: dict[str, float] = {}
        for each in (item for step in steps for item in step.equations):
            largest[each.unit] = max(largest.get(each.unit, 0.0), abs(each.value))
        for step in steps:
            step.items[:] = [
                replace(item, result="0")
                if isinstance(item, Equation) and item.unit and abs(item.value) <= ROUNDING * largest[item.unit]
                else item
                for item in step.items
            ]
        return steps

    def data(self) -> dict[str, Any]:
        """The numbers by block and label, SI, each with its unit; notes and remarks in English."""
        found: dict[str, Any] = {"name": self.title}
        for block in self.blocks(speaker("en")):
            found[unused(block.key, found)] = block.data()
        return found

    def worked(self, language: str = "en") -> str:
        """The worked solution as plain text."""
        from linkwright.equations.steps import page

        return page((in_language(self.title, language),), self.tidy_steps(speaker(language)))

    def __repr__(self) -> str:
        return self.text()


def signed(parts: Sequence[float], dimension: str = "") -> str:
    """Numbers as a sum, ``40 − 110``, what is zero or rounding against the largest left out."""
    largest = max((abs(part) for part in parts), default=0.0)
    terms = [float(part) for part in parts if abs(part) > ROUNDING * largest]
    text = " ".join(f"{'−' if part < 0 else '+'} {number(abs(part), dimension)}" for part in terms)
    return f"−{text[2:]}" if text.startswith("−") else text.removeprefix("+ ") or "0"
