"""What every section of a report supplies, and their registry.

A section is one file with one class, registered under its name; its title is the word ``report.title_NAME``.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from typing import ClassVar

from linkwright.registry import Registry
from linkwright.report.case import Case
from linkwright.report.document import Block


class Section(ABC):
    """One section; ``rank``: where it stands unless the user orders them; ``optional``: left out without a word where
    it has nothing to show, unless it is asked for by name."""

    name: ClassVar[str]
    rank: ClassVar[float]
    optional: ClassVar[bool] = False

    @abstractmethod
    def blocks(self, case: Case) -> Iterator[Block]:
        """Its blocks for one machine; raises Missing, or another LinkwrightError, where it has none."""


class CommonSection(ABC):
    """A section about all machines of a report together."""

    name: ClassVar[str]
    rank: ClassVar[float]
    optional: ClassVar[bool] = False

    @abstractmethod
    def blocks(self, cases: Sequence[Case]) -> Iterator[Block]:
        """Its blocks; raises LinkwrightError where it has none."""


SECTIONS: Registry[type[Section] | type[CommonSection]] = Registry(
    "report_section", "linkwright.report.sections"
)
