"""What all kinds of diagrams have in common, and their registry.

A kind is one file with one class, registered under its name; its title is the word ``plot.kind.NAME``.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar

from linkwright.core.dataclass import dataclass
from linkwright.registry import Registry
from linkwright.words import Say, say

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from linkwright.plot.diagrams.source import Source


#: What may be asked of some kinds of diagrams only.
OPTIONS = ("of", "joint", "on", "axes", "at", "fluctuation", "static")


@dataclass(frozen=True)
class Request:
    """What is asked of a diagram.

    ``of``: names of outputs, links or points; ``joint`` and ``on``: a joint, and the link on which it acts; ``axes``:
    ``frame`` or a link; ``at``: coordinate of the first driver (rad or m; time in s where the driver follows a law)
    of the one position of a polygon; ``fluctuation``: required δ of the flywheel; ``marks``: limit positions, peaks,
    phases; ``title``: a title of one's own, or none where empty; ``size``: width and height in inches.
    """

    of: tuple[str, ...] = ()
    joint: str | None = None
    on: str | None = None
    axes: str | None = None
    at: float | None = None
    fluctuation: float = 0.03
    marks: bool = True
    title: str | None = None
    size: tuple[float, float] | None = None
    language: str = "en"

    @property
    def say(self) -> Say:
        """Words of diagrams by key, in the language that is asked for."""
        return partial(_word, language=self.language)

    def titled(self, name: str, subject: str) -> str:
        """The title of a diagram: ``Crank-rocker: joint forces``."""
        return self.say("titled", name=name, subject=subject)


class Kind(ABC):
    """A kind of diagram; ``options``: those of OPTIONS that it has a use for."""

    name: ClassVar[str]
    options: ClassVar[tuple[str, ...]] = ()

    @abstractmethod
    def draw(self, sources: Sequence[Source], request: Request) -> Figure:
        """The figure; several sources lie over each other, told apart by colour.

        Raises LinkwrightError for unknown names, and where the diagram makes no sense for a mechanism.
        """


class ResultKind(ABC):
    """A kind of diagram of one result that has no single motion behind it: a comparison, a study, a balancing."""

    name: ClassVar[str]
    options: ClassVar[tuple[str, ...]] = ()
    takes: ClassVar[type]
    usual: ClassVar[bool] = True

    def suits(self, result: object) -> bool:
        """Whether this kind draws such a result."""
        return isinstance(result, self.takes)

    @abstractmethod
    def draw(self, result: Any, request: Request) -> Figure:
        """The figure; raises LinkwrightError for unknown names, and where there is nothing to draw."""


DIAGRAMS: Registry[type[Kind]] = Registry("diagram", "linkwright.plot.diagrams")
RESULT_DIAGRAMS: Registry[type[ResultKind]] = Registry("diagram", "linkwright.plot.result_diagrams")


def _word(key: str, *, language: str, **values: object) -> str:
    return say(f"plot.{key}", language, **values)
