"""Changes that give a machine layers: each is tried, alone and then two together."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from math import floor, log10
from time import monotonic

from linkwright.core.quantity import length_text
from linkwright.layering.demands import Demands
from linkwright.layering.orders import Undecided, any_layers
from linkwright.layering.problem import Apart, Demand, Fixed, Problem, names_of
from linkwright.words import Message, _

#: Seconds for trying changes, and how many are tried two together.
TIME_LIMIT, MOST_COMBINED = 5.0, 12


@dataclass(frozen=True)
class Change:
    """A change of a machine: what it is, and what it makes of its problem of layers."""

    text: Message
    apply: Callable[[Problem], Problem]


def remedies(demands: Demands, problem: Problem, contradicting: Sequence[Demand]) -> tuple[Message, ...]:
    """Sentences about changes that are enough for layers, or that none of them is."""
    changes, until = [*_changes(demands, problem, contradicting)], monotonic() + TIME_LIMIT
    alone = [each for each in changes if _is_enough(problem, [each], until)]
    if alone:
        return tuple(_("Enough alone: {change}.", change=each.text) for each in alone)
    for pair in combinations(changes[:MOST_COMBINED], 2):
        if _is_enough(problem, pair, until):
            return (_("Enough together: {change}, and {other}.", change=pair[0].text, other=pair[1].text),)
    tried = [each.text for each in changes]
    return (_("No one and no two of these changes are enough: {changes}.", changes=tried),) if tried else ()


def _is_enough(problem: Problem, changes: Sequence[Change], until: float) -> bool:
    for each in changes:
        problem = each.apply(problem)
    try:
        return any_layers(problem, until) is not None
    except Undecided:
        return False


def _changes(demands: Demands, problem: Problem, contradicting: Sequence[Demand]) -> Iterator[Change]:
    if problem.cover:
        yield Change(_("support the pins on one side only (`supports: cantilevered`)"), _without_cover)
    if any(_is_about_heads(each) for each in problem.demands):
        yield Change(_("make the ends of the pins flush (`ends: flush`)"), _with_flush_ends)
    for each in contradicting:
        if isinstance(each, Fixed):
            yield Change(_("do not fix the layer of {plate}", plate=each.plate), _without_layer(each.plate))
    yield from _smaller_clearance(problem)
    pairs = dict.fromkeys(frozenset(names_of(each)) for each in contradicting if isinstance(each, Apart))
    for pair in pairs:
        first, second = sorted(pair, key=[*problem.bodies].index)
        plates = [name for name in (first, second) if problem.bodies[name] == (name,)]
        if not plates:
            yield from _thinner(demands, first, second)
        for plate in plates:
            yield _clear_of(demands, plate, second if plate == first else first)


def _thinner(demands: Demands, first: str, second: str) -> Iterator[Change]:
    """Two pins, blocks or posts of less radius, where these have one and are not at one place."""
    distance = demands.distance(first, second)
    if distance > 0.0:
        text = _(
            "make the radii of {first} and {second} together less than {distance}",
            first=first,
            second=second,
            distance=_rounded_down(distance),
        )
        yield Change(text, _without_pair(frozenset((first, second))))


def _clear_of(demands: Demands, plate: str, other: str) -> Change:
    """A plate kept clear of another body: by less width, unless it would still run over it as a mere line, or is a
    wheel or a cam, which has none."""
    sort = demands.solids.by_name[plate].sort
    width = 0.0 if sort in ("wheel", "cam", "roller") else demands.clear_width(plate, other)
    names = {"plate": plate, "other": other}
    if width > 0.0:
        text = _("make {plate} less than {width} wide, clear of {other}", width=_rounded_down(width), **names)
    elif sort == "link":
        text = _(
            "keep {plate} clear of {other} by a bent bar or other dimensions (less width is not enough)", **names
        )
    else:
        text = _("keep {plate} clear of {other} by other dimensions", **names)
    return Change(text, _without_pair(frozenset((plate, other))))


def _rounded_down(length: float) -> str:
    """A length with three digits, no longer than it is."""
    digit = 10.0 ** (floor(log10(length)) - 2)
    return length_text(floor(length / digit * (1.0 + 1e-12)) * digit, 3)


def _smaller_clearance(problem: Problem) -> Iterator[Change]:
    """The largest clearance with which there are layers."""
    gaps = (each.gap for each in problem.apart if each.gap is not None)
    sizes = sorted({each.size for each in gaps if each.size > 0.0}, reverse=True)
    until = monotonic() + TIME_LIMIT

    def enough(size: float) -> bool:
        return any_layers(_with_clearance(size)(problem), until) is not None

    try:
        place = bisect_left(sizes, True, key=enough)
    except Undecided:
        return
    if place < len(sizes):
        size = sizes[place]
        yield Change(_("allow a clearance of {size}", size=_rounded_down(size)), _with_clearance(size))


def _with_clearance(size: float) -> Callable[[Problem], Problem]:
    def allowed(demand: Demand) -> bool:
        return isinstance(demand, Apart) and demand.gap is not None and demand.gap.size >= size

    return lambda problem: _left(problem, lambda each: not allowed(each))


def _without_cover(problem: Problem) -> Problem:
    bodies = {
        name: tuple(each for each in plates if each != problem.cover) for name, plates in problem.bodies.items()
    }
    left = _left(problem, lambda each: problem.cover not in names_of(each))
    return replace(left, bodies={name: plates for name, plates in bodies.items() if plates}, cover="")


def _with_flush_ends(problem: Problem) -> Problem:
    return _left(problem, lambda each: not _is_about_heads(each))


def _without_layer(plate: str) -> Callable[[Problem], Problem]:
    return lambda problem: _left(problem, lambda each: not (isinstance(each, Fixed) and each.plate == plate))


def _without_pair(pair: frozenset[str]) -> Callable[[Problem], Problem]:
    return lambda problem: _left(
        problem, lambda each: not (isinstance(each, Apart) and frozenset(names_of(each)) == pair)
    )


def _left(problem: Problem, stays: Callable[[Demand], bool]) -> Problem:
    return replace(problem, demands=tuple(each for each in problem.demands if stays(each)))


def _is_about_heads(demand: Demand) -> bool:
    return isinstance(demand, Apart) and "heads" in demand.parts
