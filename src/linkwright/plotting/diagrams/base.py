"""Kinds of diagrams: what all have in common, their registries, and the one call behind ``plot``.

A kind is one class, a diagram of a result one function, registered under its name.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar, TypeAlias, TypeVar, cast

from linkwright.core.arguments import CURVE_STEPS, real, require
from linkwright.core.attached import PlotMixin
from linkwright.dynamics.result import Run
from linkwright.errors import RequestError, about, require_language
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import Forces
from linkwright.machine.flywheel import FLUCTUATION
from linkwright.machine.running import SteadyRunning
from linkwright.mechanism.mechanism import Mechanism
from linkwright.pictures.diagram import INK, Diagram, Figure, drawing_in
from linkwright.pictures.drawing import Drawing
from linkwright.plotting.diagrams.axes import Legend, wrapped
from linkwright.plotting.diagrams.source import PlotInput, Result
from linkwright.registry import Registry, listed
from linkwright.units import parse
from linkwright.words import Message, Translate, _, translate
from linkwright.words.characters import printable
from linkwright.words.message import in_language

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
    def translate(self) -> Translate:
        """Messages in the language that is asked for."""
        return partial(translate, language=self.language)

    def titled(self, name: str, subject: str = "") -> str:
        """The title of a diagram, ``Crank-rocker: joint forces``: its subject is its kind unless given."""
        name_shown = subject or self.translate(title_of(self.kind))
        return (
            self.translate(_("{name}: {subject}", name=in_language(name, self.language), subject=name_shown))
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
    ``single``: the message where several results are given to a kind that shows one."""

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


_Solved: TypeAlias = Result | Sequence[Result] | Mapping[str, Result]


def plot(
    result: _Solved | PlotMixin,
    kind: str | None = None,
    *,
    of: str | Sequence[str] = (),
    joint: str | None = None,
    on: str | None = None,
    axes: str | None = None,
    at: float | str | None = None,
    fluctuation: float | None = None,
    static: bool = False,
    marks: bool = True,
    title: str | None = None,
    size: tuple[float, float] | None = None,
    language: str = "en",
) -> Diagram:
    """A diagram of a result, or of several over each other.

    Args:
        result: a mechanism (solved first), motion, forces, or steady running; a list, or a mapping from labels, of
            several are compared in one diagram. Or one comparison, study, sweep, sensitivity, table of design
            numbers, torque curve, balancing or coupler curve.
        kind: ``sva`` (of a motion the default), ``angles``, ``paths``, ``torque`` (of forces the default), ``power``,
            ``energy``, ``speed`` (of steady running the default), ``reactions``, ``hodograph``, ``hodographs``,
            ``shaking``, ``velocity_polygon``, ``acceleration_polygon``, ``force_polygon``, ``free_bodies``,
            ``flow_chart``, ``drive_margin``, ``operating_points``. Of a comparison
            ``comparison`` (the default) or ``pivot_hodograph``, of a sensitivity ``sensitivity`` or
            ``sensitivity_curves``, of layers and parts ``side`` (the default) or ``exploded``; most other results
            have one kind each.
        of: outputs, links, points or joints that it is about: ``"jaw"``, ``"guide"``, ``"C"``, ``"jaw.D.x"``;
            metrics or curves of a study, a comparison or a table.
        joint, on: the joint of reactions and hodographs, and the link on which its force acts.
        axes: ``"frame"``, or a link in whose axes forces are resolved.
        at: the input of a polygon or an exploded view: rad, m or s, or a text with its unit (``"30 deg"``).
        fluctuation: required δ of the flywheel in ``speed``, 0.02 unless given.
        static: leave the inertia forces out; of forces that are solved here.
        marks: limit positions, peaks, phases and inputs along curves.
        title: a title of your own; ``""`` for none.
        size: width and height in inches, 1 to 100; polygons have their own, by their scale.
        language: ``en`` or ``zh``.

    Returns:
        The diagram; ``save("x.svg")``, ``.pdf``, ``.png``.

    Raises:
        LinkwrightError: an unknown kind or name, an option that the kind has no use for, a diagram that makes no
            sense for the mechanism, curves without matplotlib or without a font for Chinese.
    """
    require_language(language)
    own = _own_kind(result, kind)
    sources = [] if own else _sources(result, static=static)
    name = own or kind or _usual(cast(_Solved, result))
    if not own:
        require_kind(name)
    options = {
        "of": of,
        "joint": joint,
        "on": on,
        "axes": axes,
        "at": at,
        "fluctuation": fluctuation,
        "static": static,
    }
    require_options(name, [option for option, value in options.items() if value not in (None, (), "", [], False)])
    if size is not None:
        _require_inches(size)
    request = Request(
        kind=name,
        of=(of,) if isinstance(of, str) else tuple(of),
        joint=joint,
        on=on,
        axes=axes,
        at=_place(at, sources[0] if sources else _machine_of(result)),
        fluctuation=FLUCTUATION if fluctuation is None else fluctuation,
        marks=marks,
        title=None if title is None else printable(str(title)).replace("\t", " "),
        size=size,
        language=language,
    )
    if len(sources) > 1 and (single_message := DIAGRAMS[name].single) is not None:
        raise RequestError(single_message)
    with drawing_in(language):
        drawn = RESULT_DIAGRAMS[name].draw(result, request) if own else DIAGRAMS[name]().draw(sources, request)
    return Diagram(name, drawn, language)


def _require_inches(size: object) -> None:
    """Raises RequestError for what are no width and height of a diagram."""
    numbers = size if isinstance(size, Sequence) and not isinstance(size, str) else ()
    if len(numbers) != 2 or not all(1.0 <= real("size", each) <= 100.0 for each in numbers):
        raise RequestError(
            _(
                "a diagram cannot be {size} inches large; give width and height, 1 to 100 each, as in size=(6, 4)",
                code="picture.bad_inches",
                size=repr(size)[:60],
            )
        )


def kinds() -> tuple[str, ...]:
    """Names of all kinds of diagrams."""
    return tuple(DIAGRAMS)


def require_kind(name: str) -> None:
    """Raises LinkwrightError, with the nearest kind and the list of all, where there is no kind of that name."""
    if name in DIAGRAMS:
        return
    raise RequestError(
        _(
            'there is no kind of diagram "{name}"; {hint}',
            code="picture.no_kind",
            name=name,
            hint=listed(name, DIAGRAMS, "one_of"),
        )
    )


def require_options(name: str, options: Sequence[str]) -> None:
    """Raises LinkwrightError where a kind has no use for an option, with the kinds that have."""
    known = DIAGRAMS[name].options if name in DIAGRAMS else RESULT_DIAGRAMS[name].options
    for option in options:
        if option not in known:
            users = tuple(each for each in DIAGRAMS if option in DIAGRAMS[each].options)
            raise RequestError(
                _(
                    'a diagram of the kind {kind} has no use for "{option}"; leave it out, or draw one of {users}',
                    code="picture.no_use",
                    kind=name,
                    option=option,
                    users=users,
                )
            )


def _own_kind(result: object, kind: str | None) -> str | None:
    """The kind for a result that is no motion, forces or running; None for those."""
    if isinstance(result, Mechanism | Motion | Forces | SteadyRunning | Run | dict | list | tuple):
        return None
    own = [name for name in RESULT_DIAGRAMS if RESULT_DIAGRAMS[name].suits(result)]
    if not own:
        return None
    if kind is None:
        return next(name for name in own if RESULT_DIAGRAMS[name].usual)
    if kind not in own:
        raise RequestError(
            _(
                'there is no kind of diagram "{kind}" of this result; the kinds are {names}',
                code="picture.not_of_this",
                kind=kind,
                names=tuple(own),
            )
        )
    return kind


def _sources(result: object, *, static: bool) -> list[PlotInput]:
    results: list[tuple[str | None, Any]]
    if isinstance(result, Mapping):
        results = [(label, each) for label, each in result.items()]
    elif isinstance(result, Sequence) and not isinstance(result, str):
        results = [(None, each) for each in result]
    else:
        results = [(None, result)]
    for _unused, each in results:
        require(each, Mechanism, Motion, Forces, SteadyRunning, Run)
    results = [(label, each.joint_forces(CURVE_STEPS) if isinstance(each, Run) else each) for label, each in results]
    found = [PlotInput(each, label, static=static) for label, each in results]
    if not found:
        raise RequestError(_("there is nothing to draw; give at least one result", code="picture.nothing_given"))
    if len(found) > 1 and len({source.label for source in found}) < len(found):
        raise RequestError(
            _("results have equal names; give labels: plot({{'a': …, 'b': …}})", code="picture.equal_names")
        )
    return found


def _usual(result: _Solved) -> str:
    values = list(result.values()) if isinstance(result, Mapping) else result
    first = values[0] if isinstance(values, Sequence) and values else values
    return "speed" if isinstance(first, SteadyRunning) else "torque" if isinstance(first, Forces) else "sva"


def _machine_of(result: object) -> PlotInput | None:
    """The machine of a result that has one."""
    mechanism = getattr(result, "mechanism", None)
    return PlotInput(mechanism) if isinstance(mechanism, Mechanism) else None


def _place(at: float | str | None, source: PlotInput | None) -> float | None:
    """The coordinate of one position, SI."""
    if not isinstance(at, str) or source is None:
        return None if isinstance(at, str) else at
    if not source.mechanism.drivers:
        raise RequestError(
            _(
                '"{name}" has no driver, so there is no input to set; leave at out',
                code="picture.no_driver",
                name=source.mechanism.name,
            )
        )
    with about("at"):
        return parse(at, source.input_dimension)
