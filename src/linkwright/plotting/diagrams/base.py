"""What all kinds of diagrams have in common, and their registry.

A kind is one class, a diagram of a result one function, registered under its name.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar, TypeVar

from linkwright.machine.flywheel import FLUCTUATION
from linkwright.pictures.diagram import INK, Figure
from linkwright.pictures.drawing import Drawing
from linkwright.plotting.diagrams.axes import Legend, wrapped
from linkwright.plotting.diagrams.source import PlotInput
from linkwright.registry import Registry
from linkwright.words import Message, Translate, _, say
from linkwright.words.characters import printable
from linkwright.words.sentence import in_language

T = TypeVar("T")
D = TypeVar("D", Figure, Drawing)
#: What may be asked of some kinds of diagrams only.
OPTIONS = ("of", "joint", "on", "axes", "at", "fluctuation", "static")


@dataclass(frozen=True)
class Request:
    """What is asked of a diagram.

    ``kind``: its name; ``of``: names of outputs, links or points; ``joint`` and ``on``: a joint, and the link on
    which it acts; ``axes``: ``frame`` or a link; ``at``: coordinate of the first driver (rad or m; time in s where
    the driver follows a law) of the one position of a polygon; ``fluctuation``: required δ of the flywheel;
    ``marks``: limit positions, peaks, phases; ``title``: a title of one's own, or none where empty; ``size``: width
    and height in inches.
    """

    kind: str
    of: tuple[str, ...] = ()
    joint: str | None = None
    on: str | None = None
    axes: str | None = None
    at: float | None = None
    fluctuation: float = FLUCTUATION
    marks: bool = True
    title: str | None = None
    size: tuple[float, float] | None = None
    language: str = "en"

    @property
    def say(self) -> Translate:
        """Messages in the language that is asked for."""
        return partial(say, language=self.language)

    def titled(self, name: str, subject: str = "") -> str:
        """The title of a diagram, ``Crank-rocker: joint forces``: its subject is its kind unless given."""
        name_shown = subject or self.say(title_of(self.kind))
        return (
            self.say(_("{name}: {subject}", name=in_language(name, self.language), subject=name_shown))
            if name
            else name_shown
        )

    def heading(self, title: str) -> str:
        """The line above a diagram: the title that is asked for, else its own."""
        return title if self.title is None else self.title


def framed(figure: Figure, title: str, request: Request, legend: Legend | None = None) -> Figure:
    """The figure with its title, the one asked for (none where that is empty) or this one, and the legend below."""
    text = printable(request.heading(title))
    if text:
        figure.suptitle(wrapped(text, figure.get_size_inches()[0]), x=0.02, ha="left", color=INK)
    if legend is not None:
        legend.put(figure)
    return figure


class Kind(ABC):
    """A kind of diagram with what it is called in titles; ``options``: those of OPTIONS that it has a use for;
    ``single``: what is said where several results are given to a kind that shows one."""

    name: ClassVar[str]
    title: ClassVar[Message]
    single: ClassVar[Message | None] = None
    options: ClassVar[tuple[str, ...]] = ()

    @abstractmethod
    def draw(self, sources: Sequence[PlotInput], request: Request) -> Figure | Drawing:
        """The figure, or a drawing; several sources are overlaid in different colours.

        Raises LinkwrightError for unknown names, and where the diagram makes no sense for a mechanism.
        """


@dataclass(frozen=True)
class ResultDiagram:
    """A diagram of one result that has no single motion behind it: a comparison, a study, a balancing.

    ``title``: what it is called in titles; ``takes``: the type of the results; ``options``: those of OPTIONS that it
    has a use for; ``usual``: whether it may be drawn where no kind is named; ``draw(result, request)`` raises
    LinkwrightError for unknown names, and where there is nothing to draw; ``when``: which results of the type have
    something to draw; ``to_scale``: whether it is printed to the scale that it states.
    """

    title: Message
    takes: type
    options: tuple[str, ...]
    usual: bool
    draw: Callable[[Any, Request], Figure | Drawing] = field(repr=False)
    when: Callable[[Any], bool] = field(repr=False)
    to_scale: bool

    def suits(self, result: object) -> bool:
        """Whether it draws such a result."""
        return isinstance(result, self.takes) and self.when(result)


DIAGRAMS: Registry[type[Kind]] = Registry(_("kind of diagram"), "linkwright.plotting.diagrams", attribute="name")
RESULT_DIAGRAMS: Registry[ResultDiagram] = Registry(_("kind of diagram"), "linkwright.plotting.result_diagrams")


def title_of(kind: str) -> Message:
    """What a kind of diagram is called in titles."""
    return (DIAGRAMS[kind] if kind in DIAGRAMS else RESULT_DIAGRAMS[kind]).title


def result_diagram(
    name: str,
    title: Message,
    takes: type[T],
    *,
    options: tuple[str, ...] = (),
    usual: bool = True,
    when: Callable[[T], bool] = lambda result: True,
    to_scale: bool = False,
) -> Callable[[Callable[[T, Request], D]], Callable[[T, Request], D]]:
    """Decorator that registers a function as the diagram ``name`` of results; see :class:`ResultDiagram`."""

    def registered(draw: Callable[[T, Request], D]) -> Callable[[T, Request], D]:
        RESULT_DIAGRAMS.register(name)(ResultDiagram(title, takes, options, usual, draw, when, to_scale))
        return draw

    return registered
